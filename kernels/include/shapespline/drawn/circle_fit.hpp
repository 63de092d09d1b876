// The best line of a stretch of points (the smaller eigenvalue of its scatter) and its best circle
// (Taubin 1991, by Newton's iteration from zero on the characteristic quartic: Chernov, Circular
// and Linear Regression, 2010, section 5.9).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapespline/drawn/moments.hpp"

namespace shapespline::drawn {

// `sum_sq` is the weighted sum of squared distances. A radius of 0 says that there is no circle:
// the points lie on a line as far as numbers tell, or the sum is larger than this one, which was
// more than asked for.
struct CircleFit {
    double sum_sq = 0.0;
    Vec2 centre;
    double radius = 0.0;
};

// Half the difference of the eigenvalues.
inline double half_apart(const Scatter &m) {
    const double apart = 0.5 * (m.xx - m.yy);
    return std::sqrt(apart * apart + m.xy * m.xy);
}

// The weighted sum of squared distances from the best line.
inline double off_line(const Scatter &m) {
    return m.weight * std::max(0.5 * (m.xx + m.yy) - half_apart(m), 0.0);
}

// The same from the best line of a direction, a unit vector.
inline double off_line_along(const Scatter &m, Vec2 along) {
    const auto [x, y] = along;
    return m.weight * std::max(y * y * m.xx - 2.0 * x * y * m.xy + x * x * m.yy, 0.0);
}

// The direction of the best line: of the larger eigenvalue, from the row with the larger entries.
inline Vec2 along_line(const Scatter &m) {
    const double apart = 0.5 * (m.xx - m.yy), root = half_apart(m);
    const Vec2 along = apart >= 0.0 ? Vec2{apart + root, m.xy} : Vec2{m.xy, root - apart};
    const double length = norm(along);
    return length > 0.0 ? (1.0 / length) * along : Vec2{1.0, 0.0};
}

inline CircleFit fit_circle(const CentralMoments &m,
                            double most = std::numeric_limits<double>::infinity()) {
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
        // From zero the iteration rises to the root.
        if (m.weight * x > most) return {m.weight * x, m.middle, 0.0};
    }
    const double d = x * x - x * mz + det;
    const Vec2 off{0.5 * (m.xz * (m.yy - x) - m.yz * m.xy) / d,
                   0.5 * (m.yz * (m.xx - x) - m.xz * m.xy) / d};
    const double radius = std::sqrt(norm_sq(off) + mz);
    if (!(radius <= kLargestRadius)) return {};
    return {m.weight * std::max(x, 0.0), m.middle + off, radius};
}

}  // namespace shapespline::drawn
