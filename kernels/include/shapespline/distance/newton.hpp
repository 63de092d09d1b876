// Newton's method for a foot point: the one safeguard that all who look near a known place share.
//
// Half the squared distance |C(u) - q|^2 / 2 has the derivatives r . C' and |C'|^2 + r . C''. Who
// steps, and how far a step may go, differs: along a whole curve (near_feet.hpp), over the knot
// intervals of a window (spline/tracking.hpp), over the spans of a section, of one span two data at
// once (pieces/section_feet.hpp), and within one Bezier (pieces/bezier_squares.hpp).
// The global search (nearest.hpp) begins far from the foot and has a safeguard of its own.
#pragma once

#include "shapespline/base/pair.hpp"

namespace shapespline {

// The second derivative where it is safely positive, else its Gauss-Newton part, with which a step
// still descends. Numbers or pairs of them.
template <class Number>
inline Number descent_curvature(Number speed_sq, Number newton) {
    constexpr double kSafely = 0.3;
    return chosen(newton < kSafely * speed_sq, speed_sq, newton);
}

}  // namespace shapespline
