// What a smooth free-form curve leaves of a stretch of points: quintics in arc length, which follow
// what a cubic Bezier can and are found without looking for feet. Chords telescope, so a point
// shifted along the outline shifts its arc length alike and leaves nothing.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline::drawn {

struct FreeForm {
    double sum_sq = 0.0;
    Vec2 begin, end;  // tangents, not normalised
};

// Sums over a growing stretch of points, from one point on.
class GrowingQuintic {
  public:
    static constexpr int kTerms = 6;

    // `unit` makes arc lengths of order one.
    GrowingQuintic(Vec2 origin, double station, double unit)
        : origin_(origin), station_(station), unit_(unit) {}

    void add(Vec2 point, double station, double weight) {
        const Vec2 p = point - origin_;
        const long double u = (station - station_) / unit_;
        long double power = weight;
        for (int k = 0; k < 2 * kTerms - 1; ++k, power *= u) {
            powers_[k] += power;
            if (k < kTerms) {
                x_[k] += power * p.x;
                y_[k] += power * p.y;
            }
        }
        const long double px = p.x, py = p.y;
        squares_ += weight * (px * px + py * py);
        last_ = static_cast<double>(u);
    }

    // Least squares over what was added, tangents at two arc lengths.
    FreeForm solved(double begin, double end) const {
        // Powers of u / last, which run to one.
        std::array<long double, 2 * kTerms - 1> scale{};
        scale[0] = 1.0L;
        for (std::size_t k = 1; k < scale.size(); ++k) scale[k] = scale[k - 1] / last_;
        std::array<std::array<long double, kTerms>, kTerms> l{};
        std::array<long double, kTerms> x{}, y{};
        long double left = squares_;
        for (int i = 0; i < kTerms; ++i) {
            for (int j = 0; j <= i; ++j) {
                long double sum = powers_[i + j] * scale[i + j];
                for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
                if (i == j)
                    l[i][i] = std::sqrt(std::max(sum, 1e-30L * powers_[0]));
                else
                    l[i][j] = sum / l[j][j];
            }
            x[i] = x_[i] * scale[i];
            y[i] = y_[i] * scale[i];
            for (int k = 0; k < i; ++k) {
                x[i] -= l[i][k] * x[k];
                y[i] -= l[i][k] * y[k];
            }
            x[i] /= l[i][i];
            y[i] /= l[i][i];
            left -= x[i] * x[i] + y[i] * y[i];
        }
        for (int i = kTerms - 1; i >= 0; --i) {
            for (int k = i + 1; k < kTerms; ++k) {
                x[i] -= l[k][i] * x[k];
                y[i] -= l[k][i] * y[k];
            }
            x[i] /= l[i][i];
            y[i] /= l[i][i];
        }
        const auto slope = [&](double station) {
            const double u = (station - station_) / unit_ / last_;
            long double dx = 0.0L, dy = 0.0L, power = 1.0L;
            for (int k = 1; k < kTerms; ++k, power *= u) {
                dx += k * power * x[k];
                dy += k * power * y[k];
            }
            return Vec2{static_cast<double>(dx), static_cast<double>(dy)};
        };
        return {static_cast<double>(std::max(left, 0.0L)), slope(begin), slope(end)};
    }

  private:
    Vec2 origin_;
    double station_, unit_, last_ = 1.0;
    std::array<long double, 2 * kTerms - 1> powers_{};
    std::array<long double, kTerms> x_{}, y_{};
    long double squares_ = 0.0L;
};

}  // namespace shapespline::drawn
