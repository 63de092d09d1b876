// Distances of points from their mean, to the last bit the same whatever the order of the points.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// A power of two above the largest coordinate, and the mean in parts of it: one of whole numbers,
// whose sums are exact.
struct ScaledCentroid {
    double unit = 1.0;
    Vec2 mean;
};

inline ScaledCentroid scaled_centroid(std::span<const Vec2> points) {
    double largest = 0.0;
    for (const Vec2 p : points) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    const double grid = std::ldexp(1.0, 62 - static_cast<int>(std::bit_width(points.size())));
    std::int64_t x = 0, y = 0;
    for (const Vec2 p : points) {
        x += static_cast<std::int64_t>(p.x * scale * grid);
        y += static_cast<std::int64_t>(p.y * scale * grid);
    }
    const double part = 1.0 / (grid * static_cast<double>(points.size()));
    const Vec2 mean{static_cast<double>(x) * part, static_cast<double>(y) * part};
    return {std::ldexp(1.0, exponent), mean};
}

inline Vec2 centroid(std::span<const Vec2> points) {
    const auto [unit, mean] = scaled_centroid(points);
    return unit * mean;
}

// Squared distances, in parts of a power of two above the largest coordinate, so that a square is
// always a number.
inline void centroid_distances_sq(std::span<const Vec2> points, double *distances_sq) {
    const auto [unit, mean] = scaled_centroid(points);
    const double scale = 1.0 / unit;
    for (std::size_t i = 0; i < points.size(); ++i)
        distances_sq[i] = norm_sq(scale * points[i] - mean);
}

}  // namespace shapespline::analysis
