// Lines (direction of travel, offset along the left normal) and circles (centre, radius) against
// their points by distances across: the best one of a stretch, and the normal equations of many
// (Gauss and Newton's method; Nievergelt 1994 for circles).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/base/vec2.hpp"
#include "shapespline/drawn/circle_fit.hpp"
#include "shapespline/drawn/moments.hpp"

namespace shapespline::drawn {

// A symmetric matrix of two or three unknowns; entries beyond its size are not read.
using Block = std::array<std::array<double, 3>, 3>;

// A matrix that is positive definite, inverted in place (Gauss and Jordan). A pivot that rounding
// made nothing leaves its unknown alone.
inline Block inverse_of(Block a, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
        const double pivot = a[k][k];
        const double over = pivot != 0.0 ? 1.0 / pivot : 0.0;
        a[k][k] = 1.0;
        for (std::size_t j = 0; j < size; ++j) a[k][j] *= over;
        for (std::size_t i = 0; i < size; ++i) {
            if (i == k) continue;
            const double share = a[i][k];
            a[i][k] = 0.0;
            for (std::size_t j = 0; j < size; ++j) a[i][j] -= share * a[k][j];
        }
    }
    return a;
}

// Of one element: the half gradient and Hessian of the weighted sum of squared distances, that sum,
// what its points count together and the largest distance, of each as if it were as sure as most.
struct Across {
    Block hessian{};
    std::array<double, 3> gradient{};
    double sum_sq = 0.0, count = 0.0, largest = 0.0;

    // A point that counts `n` has the weight n unless it is less sure than others, or surer.
    void add(double off, double w, double n, const std::array<double, 3> &slope,
             std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) {
            gradient[i] += w * slope[i] * off;
            for (std::size_t j = 0; j < size; ++j) hessian[i][j] += w * slope[i] * slope[j];
        }
        sum_sq += w * off * off;
        count += n;
        largest = std::max(largest, std::abs(w == n ? off : off * std::sqrt(w / n)));
    }
};

inline Across across_line(std::span<const Vec2> points, std::span<const double> weights,
                          std::span<const double> counts, double direction, double offset) {
    Across found;
    const double c = std::cos(direction), s = std::sin(direction);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [x, y] = points[i];
        found.add(c * y - s * x - offset, weights[i], counts[i], {-c * x - s * y, -1.0, 0.0}, 2);
    }
    return found;
}

inline Across across_circle(std::span<const Vec2> points, std::span<const double> weights,
                            std::span<const double> counts, Vec2 centre, double radius) {
    Across found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 out = points[i] - centre;
        const double far = std::max(norm(out), 1e-300);
        found.add(far - radius, weights[i], counts[i], {-out.x / far, -out.y / far, -1.0}, 3);
    }
    return found;
}

// Direction and offset of the line nearest to points, travelled from the first to the last.
inline std::pair<double, double> line_through(std::span<const Vec2> points,
                                              std::span<const double> weights) {
    Vec2 middle;
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        middle = middle + weights[i] * points[i];
        total += weights[i];
    }
    middle = (1.0 / total) * middle;
    Moments about;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [x, y] = points[i] - middle;
        about.xx += weights[i] * x * x;
        about.xy += weights[i] * x * y;
        about.yy += weights[i] * y * y;
    }
    about.w = total;
    Vec2 along = along_line(Scatter(about));
    if (dot(along, points.back() - points.front()) < 0.0) along = -1.0 * along;
    return {std::atan2(along.y, along.x), cross(along, middle)};
}

// Centre and radius of the circle nearest to points: Taubin's, then least squares across.
inline std::pair<Vec2, double> circle_through(std::span<const Vec2> points,
                                              std::span<const double> weights) {
    constexpr int kRounds = 5;
    constexpr double kFlat = 1e4, kLongest = 0.2, kNothing = 1e-14;
    Vec2 middle;
    for (const Vec2 p : points) middle = middle + p;
    middle = (1.0 / static_cast<double>(points.size())) * middle;
    double size = 1e-300;
    for (const Vec2 p : points)
        size = std::max({size, std::abs(p.x - middle.x), std::abs(p.y - middle.y)});
    std::vector<Vec2> unit;
    for (const Vec2 p : points) unit.push_back((1.0 / size) * (p - middle));
    const CircleFit taubin =
        fit_circle(CentralMoments(PrefixMoments(unit, weights).of(0, unit.size() - 1)));
    Vec2 centre = taubin.centre;
    double radius = taubin.radius > 0.0 ? taubin.radius : kFlat;
    for (int round = 0; round < kRounds; ++round) {
        const Across off = across_circle(unit, weights, weights, centre, radius);
        Block hessian = off.hessian;
        for (std::size_t i = 0; i < 3; ++i) hessian[i][i] += kNothing * off.count;
        const Block inverse = inverse_of(hessian, 3);
        std::array<double, 3> step{};
        double largest = 1e-300;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) step[i] -= inverse[i][j] * off.gradient[j];
            largest = std::max(largest, std::abs(step[i]));
        }
        const double part = std::min(1.0, kLongest * radius / largest);
        centre = centre + part * Vec2{step[0], step[1]};
        radius += part * step[2];
    }
    return {middle + size * centre, size * radius};
}

// What an element misses its points by: chi squared, what these count, the largest distance.
struct Misfit {
    double chi_sq, count, largest;
};

// Lines and circles that together have a vector of unknowns, each with points of its own.
class Elements {
  public:
    // Element k has the unknowns from `at[k]` on and the points from `begins[k]` to the next.
    Elements(std::vector<char> is_line, std::vector<std::int64_t> at,
             std::vector<std::int64_t> begins, std::vector<Vec2> points,
             std::vector<double> weights, std::vector<double> counts, double deviation)
        : is_line_(std::move(is_line)), at_(std::move(at)), begins_(std::move(begins)),
          points_(std::move(points)), weights_(std::move(weights)), counts_(std::move(counts)),
          precision_(1.0 / (deviation * deviation)) {}

    std::size_t size() const { return at_.size(); }

    // What n unknowns count in: directions in arcs of the extent, as the others are lengths.
    std::vector<double> units(std::size_t n, double extent) const {
        std::vector<double> found(n, 1.0);
        for (std::size_t k = 0; k < size(); ++k)
            if (is_line_[k]) found[at_[k]] = 1.0 / extent;
        return found;
    }

    std::vector<Misfit> misfits(std::span<const double> x) const {
        std::vector<Misfit> found;
        for (std::size_t k = 0; k < size(); ++k) {
            const Across off = across(k, x);
            found.push_back({precision_ * off.sum_sq, off.count, off.largest});
        }
        return found;
    }

    // Half the Hessian and the gradient of chi squared, added to n by n and n numbers.
    void normal(std::span<const double> x, std::span<double> matrix,
                std::span<double> gradient) const {
        for (std::size_t k = 0; k < size(); ++k) {
            const Across off = across(k, x);
            const std::size_t at = at_[k], n = unknowns(k);
            for (std::size_t i = 0; i < n; ++i) {
                gradient[at + i] += precision_ * off.gradient[i];
                for (std::size_t j = 0; j < n; ++j)
                    matrix[(at + i) * x.size() + at + j] += precision_ * off.hessian[i][j];
            }
        }
    }

    // Blocks of the covariance of the estimate without equations and of its inverse, written into
    // n by n. `floors` are the three systematic errors of the unknowns of each element.
    void covariance(std::span<const double> x, std::span<const double> floors,
                    std::span<double> covariance, std::span<double> precision) const {
        constexpr double kNothing = 1e-13;
        for (std::size_t k = 0; k < size(); ++k) {
            const Across off = across(k, x);
            const std::size_t at = at_[k], n = unknowns(k);
            Block block{};
            double trace = 0.0;
            for (std::size_t i = 0; i < n; ++i) trace += precision_ * off.hessian[i][i];
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) block[i][j] = precision_ * off.hessian[i][j];
                block[i][i] += kNothing * trace;
            }
            block = inverse_of(block, n);
            // Points that scatter by more than was thought tell less.
            const double freedom = std::max(off.count - static_cast<double>(n), 1.0);
            const double worse = std::max(precision_ * off.sum_sq / freedom, 1.0);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) block[i][j] *= worse;
                block[i][i] += floors[3 * k + i] * floors[3 * k + i];
            }
            const Block inverse = inverse_of(block, n);
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    covariance[(at + i) * x.size() + at + j] = block[i][j];
                    precision[(at + i) * x.size() + at + j] = inverse[i][j];
                }
        }
    }

  private:
    std::size_t unknowns(std::size_t k) const { return is_line_[k] ? 2 : 3; }

    Across across(std::size_t k, std::span<const double> x) const {
        const std::size_t first = begins_[k];
        const std::size_t last = k + 1 < size() ? begins_[k + 1] : points_.size();
        const auto points = std::span(points_).subspan(first, last - first);
        const auto weights = std::span(weights_).subspan(first, last - first);
        const auto counts = std::span(counts_).subspan(first, last - first);
        const double *own = x.data() + at_[k];
        return is_line_[k] ? across_line(points, weights, counts, own[0], own[1])
                           : across_circle(points, weights, counts, {own[0], own[1]}, own[2]);
    }

    std::vector<char> is_line_;
    std::vector<std::int64_t> at_, begins_;
    std::vector<Vec2> points_;
    std::vector<double> weights_, counts_;
    double precision_;
};

}  // namespace shapespline::drawn
