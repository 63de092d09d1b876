// How far the smooth curve through points lies off their chords: by cubics through four neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// 0 where the points, five or more, are no smooth curve's: where their fourth differences, which
// corners and noise make large, exceed what bulges.
inline double largest_bulge(std::span<const Vec2> points, bool closed) {
    const std::size_t n = points.size(), first = closed ? 0 : 2;
    double bulge = 0.0, rest = 0.0;
    for (std::size_t i = first; i < n - first; ++i) {
        const auto at = [&](std::size_t k) { return points[(i + n + k - 2) % n] - points[0]; };
        const Vec2 a = at(0), b = at(1), c = at(2), d = at(3), e = at(4);
        const Vec2 off = b + c - a - d;
        const Vec2 left = a - 4.0 * b + 6.0 * c - 4.0 * d + e;
        bulge = std::max(bulge, std::hypot(off.x, off.y));
        rest = std::max(rest, std::hypot(left.x, left.y));
    }
    bulge /= 16.0;
    return rest / 6.0 < bulge ? bulge : 0.0;
}

}  // namespace shapespline::analysis
