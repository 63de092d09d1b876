// Arc length at the vertices of a noisy polyline, as that of the outline it stands for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "shapespline/base/pairwise_sum.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

using Index = std::int64_t;

// The middle of some numbers, one or more; of an even count the mean of the two.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double above = *middle;
    if (values.size() % 2 == 1) return above;
    return 0.5 * (*std::max_element(values.begin(), middle) + above);
}

inline std::vector<double> steps_between(std::span<const double> stations) {
    std::vector<double> steps(stations.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = stations[i + 1] - stations[i];
    return steps;
}

// Lengths of the steps between averages of `half` neighbours on each side and the point.
inline std::vector<double> averaged_steps(std::span<const Vec2> points, bool closed, Index half) {
    const auto n = static_cast<Index>(points.size());
    const Index width = 2 * half + 1;
    std::vector<Vec2> sums{{}};
    for (Index i = -half; i < n + half; ++i) {
        const Index at = closed ? ((i % n) + n) % n : std::clamp<Index>(i, 0, n - 1);
        sums.push_back(sums.back() + points[at]);
    }
    const auto mean = [&](Index i) {
        const Vec2 sum = sums[i % n + width] - sums[i % n];
        return Vec2{sum.x / static_cast<double>(width), sum.y / static_cast<double>(width)};
    };
    std::vector<double> steps(closed ? n : n - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Vec2 step = mean(static_cast<Index>(i) + 1) - mean(static_cast<Index>(i));
        steps[i] = std::hypot(step.x, step.y);
    }
    return steps;
}

// Noise makes a polyline longer than the outline it stands for. So neighbours are averaged until
// the noise of deviation `sigma` that is left in their differences is small against the steps.
inline std::vector<double> smoothed_stations(std::span<const Vec2> points, bool closed,
                                             std::span<const double> arc_length, double sigma) {
    // Neighbours on each side that are averaged, until the noise in a difference is this part of a
    // step.
    constexpr Index kHalfWindows[] = {1, 2, 4, 8, 16, 32};
    constexpr double kQuietStep = 0.3;
    std::vector<double> steps = steps_between(arc_length);
    Index width = 1;
    for (const Index half : kHalfWindows) {
        const bool quiet = std::sqrt(2.0) * sigma / static_cast<double>(width) <=
                           kQuietStep * median(steps);
        width = 2 * half + 1;
        if (quiet || width > static_cast<Index>(points.size()) / 4) break;
        steps = averaged_steps(points, closed, half);
    }
    // Averaging may stall at the ends; a station must not repeat.
    const double least = 1e-3 * (pairwise_sum(steps) / static_cast<double>(steps.size()));
    std::vector<double> stations{0.0};
    for (const double step : steps) stations.push_back(stations.back() + std::max(step, least));
    return stations;
}

}  // namespace shapespline::analysis
