// The largest distance from a curve to a polyline, with a certified upper bound.
//
// The distance to a convex set is convex, so the largest distance of a Bezier's control points to
// one segment bounds the distance of the whole piece to the polyline. Pieces are halved until
// their bound is within a relative gap of a distance that some curve point really has.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "shapespline/bezier.hpp"
#include "shapespline/polyline.hpp"

namespace shapespline {

struct Deviation {
    double lower;  // a curve point is this far from the polyline
    double upper;  // no curve point is farther
    double parameter;
};

template <int Degree>
class DeviationSearch {
  public:
    DeviationSearch(const Polyline &polyline, double relative_gap, double floor)
        : polyline_(polyline), relative_gap_(relative_gap), floor_(floor) {}

    Deviation run(const Knots &knots, std::span<const Vec2> points) {
        const auto pieces = bezier_pieces<Degree>(knots, points);
        // A first look everywhere makes the lower bound good before anything is refined.
        for (const Bezier<Degree> &piece : pieces)
            for (int i = 0; i < kFirstLook; ++i) look(piece, static_cast<double>(i) / kFirstLook);
        look(pieces.back(), 1.0);
        for (const Bezier<Degree> &piece : pieces) refine(piece, 0);
        result_.upper = std::max(result_.upper, result_.lower);
        return result_;
    }

  private:
    // Lines come many at a time, as polylines, and bend nowhere between their ends.
    static constexpr int kFirstLook = Degree == 1 ? 1 : 16, kMaxDepth = 48;

    void look(const Bezier<Degree> &piece, double s) {
        const auto near = polyline_.nearest(piece.at(s).point, hint_);
        hint_ = near.segment;
        const double distance = std::sqrt(near.distance_sq);
        if (distance > result_.lower) {
            result_.lower = distance;
            result_.parameter = piece.begin + s * (piece.end - piece.begin);
        }
    }

    double enough() const { return std::max(result_.lower * (1.0 + relative_gap_), floor_); }

    // By the segment found last.
    double bound_of(const Bezier<Degree> &piece) const {
        double bound_sq = 0.0;
        for (const Vec2 p : piece.points)
            bound_sq = std::max(bound_sq, polyline_.distance_sq(p, hint_));
        return std::sqrt(bound_sq);
    }

    void refine(const Bezier<Degree> &piece, int depth) {
        double bound = bound_of(piece);
        if (bound > enough()) {
            look(piece, 0.5);
            bound = bound_of(piece);
        }
        if (bound <= enough() || depth == kMaxDepth) {
            result_.upper = std::max(result_.upper, bound);
            return;
        }
        const auto [left, right] = piece.halves();
        refine(left, depth + 1);
        refine(right, depth + 1);
    }

    const Polyline &polyline_;
    double relative_gap_, floor_;
    std::size_t hint_ = 0;
    Deviation result_{0.0, 0.0, 0.0};
};

inline Deviation curve_deviation(const Knots &knots, std::span<const Vec2> points,
                                 std::span<const Vec2> vertices, double relative_gap,
                                 double floor) {
    const Polyline polyline(vertices);
    return dispatch_degree(knots.degree, [&]<int Degree>() {
        return DeviationSearch<Degree>(polyline, relative_gap, floor).run(knots, points);
    });
}

}  // namespace shapespline
