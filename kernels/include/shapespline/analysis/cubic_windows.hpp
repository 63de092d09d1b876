// What cubics through windows of seven neighbours leave of them (Savitzky and Golay 1964).
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/base/pairwise_sum.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// Every so many-th window of points, about the first of them: seven numbers each, first x of all
// windows, then y. Those of a closed outline are about its points, those of an open one about all
// but three at either end.
inline void windows_of_seven(std::span<const Vec2> points, bool closed, std::size_t step,
                             std::span<double> windows) {
    constexpr std::size_t kHalf = 3, kWidth = 2 * kHalf + 1;
    const std::size_t n = points.size(), count = windows.size() / (2 * kWidth);
    double *x = windows.data(), *y = x + count * kWidth;
    for (std::size_t w = 0; w < count; ++w) {
        std::size_t i = closed ? (w * step + n * kHalf - kHalf) % n : w * step;
        for (std::size_t k = 0; k < kWidth; ++k) {
            const Vec2 p = points[i] - points[0];
            *x++ = p.x;
            *y++ = p.y;
            if (++i == n) i = 0;
        }
    }
}

// Rows of eight numbers, first x of all windows, then y: the slope of the cubic in the middle and
// what is left of each point.
class CubicWindows {
  public:
    explicit CubicWindows(std::span<const double> rows)
        : rows_(rows), n_(rows.size() / (2 * kRow)) {}

    // Sums of squares across the slope.
    void across(double *out) const {
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec2 slope = at(i, 0);
            double sum = 0.0;
            for (std::size_t j = 1; j < kRow; ++j) {
                const Vec2 rest = at(i, j);
                const double across = rest.x * slope.y - rest.y * slope.x;
                sum += across * across;
            }
            out[i] = sum / at_least_tiny(norm_sq(slope));
        }
    }

    // Mean of the directions that middle points are off in, each at twice its angle.
    Vec2 twice_direction() const {
        std::vector<double> x(n_), y(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec2 off = at(i, kMiddle);
            const double size = at_least_tiny(norm_sq(off));
            x[i] = (off.x * off.x - off.y * off.y) / size;
            y[i] = 2.0 * off.x * off.y / size;
        }
        return {pairwise_sum(x) / static_cast<double>(n_),
                pairwise_sum(y) / static_cast<double>(n_)};
    }

  private:
    static constexpr std::size_t kRow = 8, kMiddle = 4;

    Vec2 at(std::size_t i, std::size_t j) const {
        return {rows_[kRow * i + j], rows_[kRow * (n_ + i) + j]};
    }
    static double at_least_tiny(double a) {
        return std::max(a, std::numeric_limits<double>::min());
    }

    std::span<const double> rows_;
    std::size_t n_;
};

}  // namespace shapespline::analysis
