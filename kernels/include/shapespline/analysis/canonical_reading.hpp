// The order in which a contour is read, whatever the one it came in, and the pose in which it is
// searched, wherever it lies: turned, mirrored and scaled outlines are the same points there, up to
// a grid that hides rounding (ANA-16).
//
// The reading is the greatest rotation, of both directions, of the distances from the mean (the
// least rotation of Booth 1980, found with two pointers). Distances are compared as parts of 2^-32
// of the largest; where they cannot tell, coordinates and weights decide.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/analysis/centroid_distance.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// The first point, and 1 or -1.
struct Reading {
    std::int64_t start = 0;
    std::int64_t step = 1;

    // Index of the k-th of n points, k <= n.
    std::int64_t at(std::int64_t k, std::int64_t n) const {
        const std::int64_t i = start + step * k;
        return i < 0 ? i + n : i >= n ? i - n : i;
    }
};

inline constexpr double kDistanceSteps = 4294967296.0;  // 2^32

// Distances squared from the mean in whole parts of the largest.
inline std::vector<double> ranked_distances(std::span<const Vec2> points) {
    std::vector<double> ranks(points.size());
    centroid_distances_sq(points, ranks.data());
    const double unit = kDistanceSteps / *std::max_element(ranks.begin(), ranks.end());
    for (double &rank : ranks) rank = std::nearbyint(rank * unit);
    return ranks;
}

// Start of the greatest rotation of n values and the period after which it comes again.
template <class Value>
std::pair<std::int64_t, std::int64_t> greatest_rotation(std::int64_t n, Value value) {
    std::int64_t i = 0, j = 1, k = 0;
    const auto wrapped = [n](std::int64_t m) { return m < n ? m : m - n; };
    while (i < n && j < n && k < n) {
        const double a = value(wrapped(i + k)), b = value(wrapped(j + k));
        if (a == b) {
            ++k;
            continue;
        }
        (a < b ? i : j) += k + 1;
        if (i == j) ++j;
        k = 0;
    }
    return {std::min(i, j), k == n ? std::abs(i - j) : n};
}

// Below 0 if the values read one way come before those read the other way, 0 if they are the same.
template <class Less>
int compared(Reading a, Reading b, std::int64_t n, Less less) {
    for (std::int64_t k = 0; k < n; ++k) {
        const std::int64_t i = a.at(k, n), j = b.at(k, n);
        if (less(i, j)) return -1;
        if (less(j, i)) return 1;
    }
    return 0;
}

// Closed contours are read from a point that is farthest from the mean, open ones from the end that
// is farther. `weights` may be empty.
inline Reading canonical_reading(std::span<const Vec2> points, std::span<const double> weights,
                                 std::span<const double> ranks, bool closed) {
    const auto n = static_cast<std::int64_t>(points.size());
    const auto less = [&](std::int64_t i, std::int64_t j) { return ranks[i] < ranks[j]; };
    std::vector<Reading> readings;
    if (closed) {
        const auto [ahead, period] =
            greatest_rotation(n, [&](std::int64_t i) { return ranks[i]; });
        const std::int64_t back = n - 1 - greatest_rotation(n, [&](std::int64_t i) {
                                              return ranks[n - 1 - i];
                                          }).first;
        const int order = compared({ahead, 1}, {back, -1}, n, less);
        for (std::int64_t k = 0; k < n; k += period) {
            if (order >= 0) readings.push_back({(ahead + k) % n, 1});
            if (order <= 0) readings.push_back({(back + k) % n, -1});
        }
    } else {
        const int order = compared({0, 1}, {n - 1, -1}, n, less);
        if (order >= 0) readings.push_back({0, 1});
        if (order <= 0) readings.push_back({n - 1, -1});
    }
    const auto before = [&](std::int64_t i, std::int64_t j) {
        return points[i].x != points[j].x ? points[i].x < points[j].x : points[i].y < points[j].y;
    };
    const auto lighter = [&](std::int64_t i, std::int64_t j) { return weights[i] < weights[j]; };
    Reading best = readings.front();
    for (const Reading other : readings) {
        int order = compared(other, best, n, before);
        if (order == 0 && !weights.empty()) order = compared(other, best, n, lighter);
        if (order < 0) best = other;
    }
    return best;
}

inline Reading canonical_reading(std::span<const Vec2> points, std::span<const double> weights,
                                 bool closed) {
    return canonical_reading(points, weights, ranked_distances(points), closed);
}

// A similarity: p goes to scale (x', y'), where x' is the part of p - middle along a unit vector
// and y' that across it, to its left or right (side 1 or -1).
struct Pose {
    Vec2 middle;
    Vec2 axis;
    double side = 1.0;
    double scale = 1.0;

    Vec2 of(Vec2 p) const {
        const Vec2 away = p - middle;
        return {scale * dot(axis, away), scale * side * cross(axis, away)};
    }
};

// The mean at the origin, the farthest point (the first one that is read) at (radius, 0), the first
// one that is off the axis above it.
inline Pose canonical_pose(std::span<const Vec2> points, std::span<const double> ranks,
                           Reading reading, double radius) {
    constexpr double kOffAxis = 1.0 / 65536.0;
    const auto n = static_cast<std::int64_t>(points.size());
    Pose pose;
    pose.middle = centroid(points);
    std::int64_t farthest = 0;
    while (ranks[reading.at(farthest, n)] < kDistanceSteps) ++farthest;
    const Vec2 arm = points[reading.at(farthest, n)] - pose.middle;
    const double length = norm(arm);
    pose.axis = (1.0 / length) * arm;
    pose.scale = radius / length;
    for (std::int64_t k = 0; k < n; ++k) {
        const double off = cross(pose.axis, points[reading.at(k, n)] - pose.middle);
        if (std::fabs(off) <= kOffAxis * length) continue;
        pose.side = off < 0.0 ? -1.0 : 1.0;
        break;
    }
    return pose;
}

// The points as they are read, in their pose, on a grid of a power of two: as fine as a length of
// the data, but no finer than one of the pose. `apart` tells whether neighbours stay apart there.
struct PosedContour {
    Reading reading;
    Pose pose;
    bool apart = true;

    PosedContour(std::span<const Vec2> points, bool closed, double radius, double fine,
                 double finest, std::span<Vec2> out) {
        const auto ranks = ranked_distances(points);
        const auto n = static_cast<std::int64_t>(points.size());
        reading = canonical_reading(points, {}, ranks, closed);
        pose = canonical_pose(points, ranks, reading, radius);
        const double grid = std::exp2(std::floor(std::log2(std::max(pose.scale * fine, finest))));
        const auto same = [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; };
        for (std::int64_t k = 0; k < n; ++k) {
            const Vec2 p = pose.of(points[reading.at(k, n)]);
            out[k] = {grid * std::nearbyint(p.x / grid), grid * std::nearbyint(p.y / grid)};
            if (k > 0 && same(out[k], out[k - 1])) apart = false;
        }
        if (closed && same(out[0], out[n - 1])) apart = false;
    }
};

}  // namespace shapespline::analysis
