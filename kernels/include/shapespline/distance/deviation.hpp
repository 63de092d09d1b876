// The largest distance from a curve to a polyline, with a certified upper bound: branch and bound
// with convex hulls, as interval Hausdorff bounds do.
//
// Two bounds of a piece. The distance to a convex set is convex, so the largest distance of its
// control points to one segment is one. The other takes the polyline between the segments that are
// nearest to the piece's ends: where it stays in a strip about the piece's chord it passes every
// point of the chord within the strip or, beyond its own ends, as near as the piece's ends are.
// Pieces are halved until their bound is within a relative gap of a distance that some curve point
// really has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/curve/bezier.hpp"
#include "shapespline/distance/polyline.hpp"

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
        // A first look everywhere makes the lower bound good before anything is refined, but for
        // pieces that lie on one segment: lines through all points.
        std::vector<const Bezier<Degree> *> open;
        std::vector<Stop> stops;
        stops.reserve(pieces.size() * (kFirstLook + 1));
        std::size_t hint = 0;
        for (const Bezier<Degree> &piece : pieces) {
            const Stop begin = look(piece, 0.0, hint);
            hint = begin.segment;
            if (lies_along(begin.segment, piece)) continue;
            open.push_back(&piece);
            stops.push_back(begin);
            for (int i = 1; i <= kFirstLook; ++i) {
                stops.push_back(look(piece, static_cast<double>(i) / kFirstLook, hint));
                hint = stops.back().segment;
            }
        }
        for (std::size_t i = 0; i < open.size(); ++i)
            refine(*open[i], std::span(stops).subspan(i * (kFirstLook + 1), kFirstLook + 1), 0);
        result_.upper = std::max(result_.upper, result_.lower);
        return result_;
    }

  private:
    // A point of the curve, with the segment that is nearest to it.
    struct Stop {
        Vec2 point;
        double distance;
        std::size_t segment;
    };

    // Lines come many at a time, as polylines, and bend nowhere between their ends. Else a power of
    // two: pieces are halved.
    static constexpr int kFirstLook = Degree == 1 ? 1 : 16, kMaxDepth = 48;

    Stop look(const Bezier<Degree> &piece, double s, std::size_t hint) {
        const Vec2 point = piece.at(s).point;
        const auto near = polyline_.near_enough(point, hint, 0.25 * result_.lower * result_.lower);
        const double distance = std::sqrt(near.distance_sq);
        if (distance > result_.lower) {
            result_.lower = distance;
            result_.parameter = piece.begin + s * (piece.end - piece.begin);
        }
        return {point, distance, near.segment};
    }

    // On a segment or on one of its neighbours: at a vertex each of two is the nearest.
    bool lies_along(std::size_t segment, const Bezier<Degree> &piece) {
        const std::size_t n = polyline_.n_segments();
        for (const std::size_t near : {segment, (segment + 1) % n, (segment + n - 1) % n}) {
            const double bound = bound_by(near, piece);
            if (bound > floor_) continue;
            result_.upper = std::max(result_.upper, bound);
            return true;
        }
        return false;
    }

    double enough() const { return std::max(result_.lower * (1.0 + relative_gap_), floor_); }

    double bound_by(std::size_t segment, const Bezier<Degree> &piece) const {
        double bound_sq = 0.0;
        for (const Vec2 p : piece.points)
            bound_sq = std::max(bound_sq, polyline_.distance_sq(p, segment));
        return std::sqrt(bound_sq);
    }

    // By the polyline between the segments of both ends; not looked at further than is enough.
    double bound_between(const Bezier<Degree> &piece, const Stop &begin, const Stop &end) const {
        double second_sq = 0.0;
        for (int i = 2; i <= Degree; ++i)
            second_sq = std::max(second_sq, norm_sq(piece.points[i] - 2.0 * piece.points[i - 1] +
                                                    piece.points[i - 2]));
        const double from_chord = 0.125 * Degree * (Degree - 1) * std::sqrt(second_sq);
        const Vec2 chord = end.point - begin.point;
        const double length = norm(chord), most = length * (enough() - from_chord);
        double widest = length * std::max(begin.distance, end.distance);
        const auto [low, high] = std::minmax(begin.segment, end.segment);
        for (std::size_t i = low + 1; i <= high && widest <= most; ++i)
            widest = std::max(widest, std::abs(cross(chord, polyline_.vertex(i) - begin.point)));
        if (!(length > 0.0)) return std::max(begin.distance, end.distance) + from_chord;
        return widest / length + from_chord;
    }

    void refine(const Bezier<Degree> &piece, std::span<const Stop> stops, int depth) {
        const Stop &begin = stops.front(), &end = stops.back();
        double bound = bound_between(piece, begin, end);
        if (bound > enough()) bound = std::min(bound, bound_by(begin.segment, piece));
        if (bound > enough()) bound = std::min(bound, bound_by(end.segment, piece));
        if (bound <= enough() || depth == kMaxDepth) {
            result_.upper = std::max(result_.upper, bound);
            return;
        }
        const auto [left, right] = piece.halves();
        if (stops.size() > 2) {
            const std::size_t middle = stops.size() / 2;
            refine(left, stops.first(middle + 1), depth + 1);
            refine(right, stops.subspan(middle), depth + 1);
            return;
        }
        const std::array<Stop, 3> halved{begin, look(piece, 0.5, begin.segment), end};
        refine(left, std::span(halved).first(2), depth + 1);
        refine(right, std::span(halved).last(2), depth + 1);
    }

    const Polyline &polyline_;
    double relative_gap_, floor_;
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
