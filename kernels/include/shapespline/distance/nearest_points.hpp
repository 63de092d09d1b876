// The nearest of some points to others, by a tree of boxes over their order.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "shapespline/base/box_tree.hpp"

namespace shapespline {

// For each query the index and distance of the point nearest to it; of those as near the first.
inline void nearest_points(std::span<const Vec2> points, std::span<const Vec2> queries,
                           std::int64_t *indices, double *distances) {
    // Points whose distances round to the same number must all be seen.
    constexpr double kRounding = 1.0 + 1e-12;
    const BoxTree tree(points.size(), [&](std::size_t i, Box &box) { box.include(points[i]); });
    std::size_t hint = 0;
    for (const Vec2 query : queries) {
        double best = std::numeric_limits<double>::infinity(), reach_sq = best;
        tree.search(query, reach_sq, hint, [&](std::size_t i) {
            const double distance = std::hypot(points[i].x - query.x, points[i].y - query.y);
            if (distance > best || (distance == best && i >= hint)) return;
            best = distance;
            hint = i;
            reach_sq = kRounding * distance * distance + std::numeric_limits<double>::min();
        });
        *indices++ = static_cast<std::int64_t>(hint);
        *distances++ = best;
    }
}

}  // namespace shapespline
