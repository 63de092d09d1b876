// Points on Bezier pieces so dense that the chords between them stay near the curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "shapespline/curve/bezier.hpp"

namespace shapespline {

// A chord over a step h of the parameter strays from the curve by no more than h^2 / 8 times the
// largest second derivative, which the second differences of the control points bound (Wang 1984).
// Returns how many equal steps a piece asks for so that its chords stray by `distance` at most and
// none is longer than `longest`.
template <int Degree>
double steps_wanted(std::span<const Vec2> piece, double distance, double longest) {
    double length = 0.0, second_sq = 0.0;
    for (int i = 1; i <= Degree; ++i) length += norm(piece[i] - piece[i - 1]);
    for (int i = 2; i <= Degree; ++i)
        second_sq = std::max(second_sq,
                             norm_sq((piece[i] - piece[i - 1]) - (piece[i - 1] - piece[i - 2])));
    return std::max(length / longest, std::sqrt(Degree * (Degree - 1) * std::sqrt(second_sq) /
                                                (8.0 * distance)));
}

// The points at the given numbers of equal steps, then the last one of all, and their parameters.
template <int Degree>
void chord_points(std::span<const Vec2> beziers, const double *breakpoints,
                  std::span<const std::int64_t> counts, Vec2 *points, double *parameters) {
    for (std::size_t s = 0; s < counts.size(); ++s) {
        Bezier<Degree> piece;
        std::copy_n(beziers.begin() + s * (Degree + 1), Degree + 1, piece.points.begin());
        const double count = static_cast<double>(counts[s]);
        const double step = (breakpoints[s + 1] - breakpoints[s]) / count;
        for (std::int64_t i = 0; i < counts[s]; ++i) {
            *points++ = piece.at(static_cast<double>(i) / count).point;
            *parameters++ = breakpoints[s] + static_cast<double>(i) * step;
        }
    }
    *points = beziers.back();
    *parameters = breakpoints[counts.size()];
}

}  // namespace shapespline
