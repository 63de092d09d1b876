// Chord-to-point distance accumulation, O(n L): H_r is the sum over the chords of L steps that
// contain point r of its perpendicular distance to them.
//
// The paper's section 4; Awrangjeb and Lu 2008. The chords s = 0 and s = L end at the point itself
// and add nothing.
#pragma once

#include <cstdint>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline::analysis {

// signed_sums[r] > 0 where the outline turns left. Beyond the ends of open data stands their point
// reflection, 2 Q_0 - Q_i. A chord whose ends coincide measures the distance to that point.
inline void accumulate_chord_distances(std::span<const Vec2> points, std::int64_t length,
                                       bool closed, double *signed_sums, double *unsigned_sums) {
    const auto n = static_cast<std::int64_t>(points.size());
    const auto at = [&](std::int64_t i) {
        if (i >= 0 && i < n) return points[i];
        if (closed) return points[(i % n + n) % n];
        return i < 0 ? 2.0 * points[0] - points[-i] : 2.0 * points[n - 1] - points[2 * (n - 1) - i];
    };
    for (std::int64_t r = 0; r < n; ++r) {
        double signed_sum = 0.0, unsigned_sum = 0.0;
        for (std::int64_t s = 1; s < length; ++s) {
            const Vec2 start = at(r - length + s);
            const Vec2 chord = at(r + s) - start;
            const Vec2 offset = points[r] - start;
            const double chord_length = norm(chord);
            const double turn =
                chord_length > 0.0 ? cross(offset, chord) / chord_length : norm(offset);
            signed_sum += turn;
            unsigned_sum += std::abs(turn);
        }
        signed_sums[r] = signed_sum;
        unsigned_sums[r] = unsigned_sum;
    }
}

}  // namespace shapespline::analysis
