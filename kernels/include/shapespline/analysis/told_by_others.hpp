// How far points are off lines or parabolas through some of their neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// Least squares through neighbours at some offsets: rows of numbers that make the coefficients of
// powers of the offset of what is there, the highest power first.
struct ThroughNeighbours {
    static constexpr std::size_t kMostTerms = 3;
    std::span<const std::int64_t> offsets;
    std::span<const double> rows;

    std::size_t n_terms() const { return rows.size() / offsets.size(); }
    double power(std::size_t k, std::size_t term) const {
        double value = 1.0;
        for (std::size_t i = term + 1; i < n_terms(); ++i)
            value *= static_cast<double>(offsets[k]);
        return value;
    }
    // Of the difference between a point and what is told of it, in deviations of one point.
    double error() const {
        double sum = 0.0;
        for (const double share : rows.last(offsets.size())) sum += share * share;
        return std::sqrt(1.0 + sum);
    }
};

// Both in deviations: how far each of some points is off what its neighbours tell, with the error
// of that, and what these leave of it. Indices go round.
inline void told_by_others(std::span<const Vec2> points, std::span<const std::int64_t> told,
                           const ThroughNeighbours &fit, std::span<const double> noise,
                           double *off, double *rest) {
    const std::size_t n_beside = fit.offsets.size(), n_terms = fit.n_terms();
    const auto n = static_cast<std::int64_t>(points.size());
    const double error = fit.error();
    for (const std::int64_t at : told) {
        const auto beside = [&](std::size_t k) {
            const std::int64_t i = (at + fit.offsets[k]) % n;
            return points[i < 0 ? i + n : i];
        };
        std::array<Vec2, ThroughNeighbours::kMostTerms> found{};
        for (std::size_t c = 0; c < n_terms; ++c)
            for (std::size_t k = 0; k < n_beside; ++k)
                found[c] += fit.rows[c * n_beside + k] * beside(k);
        const Vec2 slope = found[n_terms - 2], away = points[at] - found[n_terms - 1];
        const double speed =
            std::max(std::hypot(slope.x, slope.y), std::numeric_limits<double>::min());
        *off++ = std::fabs(cross(away, slope)) / (speed * error * noise[at]);
        double sum = 0.0;
        for (std::size_t k = 0; k < n_beside; ++k) {
            Vec2 there;
            for (std::size_t c = 0; c < n_terms; ++c) there += fit.power(k, c) * found[c];
            const double across = cross(beside(k) - there, slope) / speed;
            sum += across * across;
        }
        *rest++ = std::sqrt(sum / static_cast<double>(n_beside - n_terms)) / noise[at];
    }
}

}  // namespace shapespline::analysis
