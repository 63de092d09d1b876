// The best line of a stretch of points (the smaller eigenvalue of its scatter) and its best circle
// (Taubin 1991, by Newton's iteration from zero on the characteristic quartic: Chernov, Circular
// and Linear Regression, 2010, section 5.9).
#pragma once

#include <algorithm>
#include <cmath>

#include "shapespline/drawn/moments.hpp"

namespace shapespline::drawn {

// `sum_sq` is the weighted sum of squared distances.
struct LineFit {
    double sum_sq = 0.0;
    Vec2 middle, direction;
};

// A radius of 0 says that there is no circle: the points lie on a line as far as numbers tell.
struct CircleFit {
    double sum_sq = 0.0;
    Vec2 centre;
    double radius = 0.0;
};

inline LineFit fit_line(const CentralMoments &m) {
    const double half = 0.5 * (m.xx + m.yy), apart = 0.5 * (m.xx - m.yy);
    const double root = std::sqrt(apart * apart + m.xy * m.xy);
    // The eigenvector of the larger eigenvalue, from the row with the larger entries.
    Vec2 along = apart >= 0.0 ? Vec2{apart + root, m.xy} : Vec2{m.xy, root - apart};
    const double length = norm(along);
    along = length > 0.0 ? (1.0 / length) * along : Vec2{1.0, 0.0};
    return {m.weight * std::max(half - root, 0.0), m.middle, along};
}

inline CircleFit fit_circle(const CentralMoments &m) {
    constexpr double kLargestRadius = 1e4;
    const double mz = m.xx + m.yy, det = m.xx * m.yy - m.xy * m.xy, var = m.zz - mz * mz;
    const double a3 = 4 * mz, a2 = -3 * mz * mz - m.zz;
    const double a1 = var * mz + 4 * det * mz - m.xz * m.xz - m.yz * m.yz;
    const double a0 = m.xz * (m.xz * m.yy - m.yz * m.xy) + m.yz * (m.yz * m.xx - m.xz * m.xy) -
                      var * det;
    double x = 0.0, f = a0;
    for (int round = 0; round < 12; ++round) {
        const double slope = a1 + x * (2 * a2 + 3 * a3 * x);
        const double next = x - f / slope;
        if (!std::isfinite(next) || next == x) break;
        const double value = a0 + next * (a1 + next * (a2 + next * a3));
        if (std::abs(value) >= std::abs(f)) break;
        x = next;
        f = value;
    }
    const double d = x * x - x * mz + det;
    const Vec2 off{0.5 * (m.xz * (m.yy - x) - m.yz * m.xy) / d,
                   0.5 * (m.yz * (m.xx - x) - m.xz * m.xy) / d};
    const double radius = std::sqrt(norm_sq(off) + mz);
    if (!(radius <= kLargestRadius)) return {};
    return {m.weight * std::max(x, 0.0), m.middle + off, radius};
}

}  // namespace shapespline::drawn
