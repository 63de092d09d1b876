// How abruptly an outline turns at each point: the angle between one-sided tangents.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// The outline as one function of arc length s: vertices and stations of an open outline, or of
// three laps of a closed one.
struct StationedOutline {
    std::span<const Vec2> points;
    std::span<const double> stations;
};

// The tangent at a vertex of the parabola in s that fits its neighbours on one side within a
// length (a line for fewer than five): a bend of the outline itself does not look like a corner.
// Zero where there are fewer than two.
inline Vec2 one_sided_tangent(const StationedOutline &outline, std::int64_t vertex, int direction,
                              double length) {
    const auto n = static_cast<std::int64_t>(outline.points.size());
    double s[5] = {};
    Vec2 m[3] = {};
    std::int64_t count = 0;
    const Vec2 origin = outline.points[vertex];
    for (std::int64_t k = vertex; k >= 0 && k < n; k += direction, ++count) {
        const double x = (outline.stations[k] - outline.stations[vertex]) / length;
        if (std::fabs(x) > 1.0) break;
        double power = 1.0;
        for (int q = 0; q < 5; ++q, power *= x) {
            s[q] += power;
            if (q < 3) m[q] += power * (outline.points[k] - origin);
        }
    }
    if (count < 2) return {};
    if (count < 5) return (1.0 / (s[0] * s[2] - s[1] * s[1])) * (s[0] * m[1] - s[1] * m[0]);
    // The middle row of the inverse of the symmetric 3 x 3 moment matrix (Cramer).
    const double c10 = s[2] * s[3] - s[1] * s[4], c11 = s[0] * s[4] - s[2] * s[2],
                 c12 = s[1] * s[2] - s[0] * s[3];
    const double determinant = s[1] * c10 + s[2] * c11 + s[3] * c12;
    return (1.0 / determinant) * (c10 * m[0] + c11 * m[1] + c12 * m[2]);
}

// Signed angle from the left to the right tangent at some vertices, radians; 0 where the outline
// has less than 0.6 lengths on a side.
inline void corner_turns(const StationedOutline &outline, std::span<const std::int64_t> vertices,
                         double length, double *turns) {
    const double begin = outline.stations.front() + 0.6 * length;
    const double end = outline.stations.back() - 0.6 * length;
    for (const std::int64_t vertex : vertices) {
        double &turn = *turns++ = 0.0;
        const double s = outline.stations[vertex];
        if (s < begin || s > end) continue;
        const Vec2 u = one_sided_tangent(outline, vertex, -1, length);
        const Vec2 v = one_sided_tangent(outline, vertex, 1, length);
        if (norm_sq(u) > 0.0 && norm_sq(v) > 0.0) turn = std::atan2(cross(u, v), dot(u, v));
    }
}

}  // namespace shapespline::analysis
