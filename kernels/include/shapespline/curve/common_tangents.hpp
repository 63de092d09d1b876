// Nodes, where pieces meet: nearly common tangents made exactly common.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapespline/curve/piece_row.hpp"

namespace shapespline {

// At a node whose directions differ by less than `nearly` radians the control points beside it are
// moved onto one line: that of a straight piece, or the mean direction of two curves. Where that
// moves one by more than `largest_move` the node keeps its small turn.
inline void make_tangents_common(const std::vector<PieceView<Vec2>> &row, double largest_move,
                                 double nearly, bool closed) {
    const auto along = [](Vec2 v) {
        const double length = std::hypot(v.x, v.y);
        return Vec2{v.x / length, v.y / length};
    };
    const auto distance = [](Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); };
    const std::size_t n = row.size();
    for (std::size_t i = closed && n > 1 ? 0 : 1; i < n; ++i) {
        const PieceView<Vec2> &before = row[(i + n - 1) % n], &after = row[i];
        const bool from_line = before.degree == 1, to_line = after.degree == 1;
        if (from_line && to_line) continue;
        const Vec2 arriving = before.last_leg(), leaving = after.first_leg();
        if (!(std::fabs(std::atan2(cross(arriving, leaving), dot(arriving, leaving))) < nearly))
            continue;
        const Vec2 node = after.points.front();
        Vec2 &left = before.points[before.points.size() - 2], &right = after.points[1];
        const Vec2 u = node - left, v = right - node;
        if ((u.x == 0.0 && u.y == 0.0) || (v.x == 0.0 && v.y == 0.0)) continue;
        const Vec2 way = from_line ? along(u) : to_line ? along(v) : along(along(u) + along(v));
        const Vec2 moved_left = node - dot(u, way) * way;
        const Vec2 moved_right = node + dot(v, way) * way;
        if (std::max(distance(moved_left, left), distance(moved_right, right)) > largest_move)
            continue;
        if (!from_line) left = moved_left;
        if (!to_line) right = moved_right;
    }
}

}  // namespace shapespline
