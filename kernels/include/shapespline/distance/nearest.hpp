// Nearest points on a B-spline curve.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/curve/bezier.hpp"
#include "shapespline/base/box_tree.hpp"

namespace shapespline {

template <int Degree>
class CurveSearch {
  public:
    struct Nearest {
        double distance_sq;
        double parameter;
        double local_parameter;  // of the foot on the piece, 0 to 1
        std::size_t piece;
        bool inside;  // the foot is no end of the piece
    };

    CurveSearch(const Knots &knots, std::span<const Vec2> points)
        : pieces_(nearly_straight_pieces(knots, points)),
          boxes_(hull_boxes(pieces_)),
          tree_(pieces_.size(), [&](std::size_t i, Box &box) { box.include(boxes_[i]); }) {}

    // Calls found(j, nearest) for every query, in any order.
    //
    // Every piece whose convex hull's box comes nearer than the best so far is searched: global up
    // to the convergence of Newton's method on a nearly straight piece. Neighbours mostly have
    // their feet inside the same piece, as far apart as those before them: Newton's method begins
    // there, and one look into the tree serves them all.
    template <class Found>
    void nearest(std::span<const Vec2> queries, Found &&found) const {
        Run run;
        std::vector<std::size_t> others;
        const auto finish = [&] {
            if (run.n == 0) return;
            others.clear();
            tree_.visit_near(run.box, run.farthest_sq, [&](std::size_t i) {
                if (i != run.piece && boxes_[i].distance_sq(run.box) < run.farthest_sq)
                    others.push_back(i);
            });
            for (std::size_t k = 0; k < run.n; ++k) {
                for (const std::size_t i : others)
                    improve(queries[run.begin + k], i, run.nearest[k]);
                found(run.begin + k, run.nearest[k]);
            }
            run.go_on_at(run.nearest[run.n - 1]);
            run.n = 0;
        };
        for (std::size_t j = 0; j < queries.size(); ++j) {
            Nearest best = nearest_on_piece(queries[j], run.piece, run.ahead);
            if (!best.inside) best = with_foot_on_chord(queries[j], best);
            if (best.inside) {
                if (run.n == 0) run.start(j);
                run.add(queries[j], best);
                if (run.n == kLongestRun) finish();
                continue;
            }
            finish();
            tree_.search(queries[j], best.distance_sq, best.piece,
                         [&](std::size_t i) { improve(queries[j], i, best); });
            found(j, best);
            run.go_on_at(best);
        }
        finish();
    }

  private:
    static constexpr std::size_t kLongestRun = 16;
    static constexpr double kUnknown = -2.0;

    // Consecutive queries with their feet inside one piece.
    struct Run {
        std::size_t piece = 0, begin = 0, n = 0;
        Box box;
        double farthest_sq = 0.0;
        double before = kUnknown, ahead = kUnknown;  // parameters of the last foot and the next
        std::array<Nearest, kLongestRun> nearest;

        void start(std::size_t j) {
            begin = j;
            box = Box{};
            farthest_sq = 0.0;
        }
        void add(Vec2 q, const Nearest &best) {
            box.include(q);
            farthest_sq = std::max(farthest_sq, best.distance_sq);
            nearest[n++] = best;
            ahead = before == kUnknown ? best.local_parameter : 2.0 * best.local_parameter - before;
            before = best.local_parameter;
        }
        // A foot inside a piece may be far away: the piece that was found to be nearer is the next.
        void go_on_at(const Nearest &last) {
            if (last.piece == piece && last.local_parameter == before) return;
            piece = last.piece;
            before = ahead = last.local_parameter;
        }
    };

    // An end of a piece that turns back beside it, as at a near-cusp, may be a minimum of its own:
    // who comes from there does not find the foot that lies beyond.
    Nearest with_foot_on_chord(Vec2 q, const Nearest &at_end) const {
        const Nearest other = nearest_on_piece(q, at_end.piece, kUnknown);
        return other.distance_sq < at_end.distance_sq ? other : at_end;
    }

    void improve(Vec2 q, std::size_t piece, Nearest &best) const {
        if (piece == best.piece || boxes_[piece].distance_sq(q) >= best.distance_sq) return;
        const Nearest other = nearest_on_piece(q, piece, kUnknown);
        if (other.distance_sq < best.distance_sq) best = other;
    }

    static constexpr int kMaxDepth = 8, kMinDepth = 2, kNewtonSteps = 32;
    // Newton's method squares its error: what is left after a step so small is nothing to the
    // distance, which it changes by its square again (GEO-05).
    static constexpr double kLastStep = 1e-7;
    // The distance after such a step is not asked for where it shortens the square by this part of
    // it at most: that before it will do, 5e-14 of the length of the piece too long at most.
    static constexpr double kNothing = 1e-12;

    // Pieces whose control polygon is at most 2 % longer than its chord: on them the squared
    // distance to a point has one minimum, unless the point is near the centre of curvature, where
    // all distances are nearly equal.
    static std::vector<Bezier<Degree>> nearly_straight_pieces(const Knots &knots,
                                                     std::span<const Vec2> points) {
        std::vector<Bezier<Degree>> pieces;
        for (const Bezier<Degree> &piece : bezier_pieces<Degree>(knots, points))
            append_nearly_straight(piece, 0, pieces);
        return pieces;
    }

    static void append_nearly_straight(const Bezier<Degree> &piece, int depth,
                              std::vector<Bezier<Degree>> &pieces) {
        double polygon = 0.0;
        for (int i = 0; i < Degree; ++i) polygon += norm(piece.points[i + 1] - piece.points[i]);
        const double chord = norm(piece.points[Degree] - piece.points[0]);
        if (Degree == 1 || depth == kMaxDepth || (depth >= kMinDepth && polygon <= 1.02 * chord)) {
            pieces.push_back(piece);
            return;
        }
        const auto [left, right] = piece.halves();
        append_nearly_straight(left, depth + 1, pieces);
        append_nearly_straight(right, depth + 1, pieces);
    }

    static std::vector<Box> hull_boxes(const std::vector<Bezier<Degree>> &pieces) {
        std::vector<Box> boxes(pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (const Vec2 p : pieces[i].points) boxes[i].include(p);
        return boxes;
    }

    // From a place where the foot may be, or the foot on the chord.
    Nearest nearest_on_piece(Vec2 q, std::size_t index, double guess) const {
        const Bezier<Degree> &piece = pieces_[index];
        double s = std::clamp(guess, 0.0, 1.0);
        if (guess == kUnknown) {
            const Vec2 chord = piece.points[Degree] - piece.points[0];
            const double chord_sq = norm_sq(chord);
            s = chord_sq > 0.0
                    ? std::clamp(dot(q - piece.points[0], chord) / chord_sq, 0.0, 1.0)
                    : 0.5;
        }
        double best_s = 0.0, best_sq = norm_sq(piece.points[0] - q);
        const auto consider = [&](double at, double distance_sq) {
            if (distance_sq < best_sq) best_s = at, best_sq = distance_sq;
        };
        consider(1.0, norm_sq(piece.points[Degree] - q));
        bool last = false;
        // The distance falls on to the foot from both sides. Steps that leave what is left between
        // them, as where the curve is far from evenly fast, halve it.
        double low = 0.0, high = 1.0;
        bool from_low = false, from_high = false;
        for (int iteration = 0; iteration < kNewtonSteps; ++iteration) {
            const auto jet = piece.at(s);
            const Vec2 r = jet.point - q;
            consider(s, norm_sq(r));
            const double slope = dot(r, jet.first);
            const double newton = norm_sq(jet.first) + dot(r, jet.second);
            // Where the second derivative is not safely positive, Gauss-Newton still descends.
            const double curvature = std::max(newton, 0.25 * norm_sq(jet.first));
            if (last || !(curvature > 0.0)) break;
            (slope > 0.0 ? from_high : from_low) = true;
            (slope > 0.0 ? high : low) = s;
            double next = s - slope / curvature;
            if (next == s) break;
            if (next <= low) next = from_low ? 0.5 * (low + high) : low;
            if (next >= high) next = from_high ? 0.5 * (low + high) : high;
            if (next == s) break;
            last = curvature == newton && std::abs(next - s) <= kLastStep;
            if (last && slope * slope <= kNothing * newton * norm_sq(r)) {
                if (best_s == s) best_s = next;
                break;
            }
            s = next;
        }
        return {best_sq, piece.begin + best_s * (piece.end - piece.begin), best_s, index,
                best_s > 0.0 && best_s < 1.0};
    }

    std::vector<Bezier<Degree>> pieces_;
    std::vector<Box> boxes_;
    BoxTree tree_;
};

inline void nearest_on_curve(const Knots &knots, std::span<const Vec2> points,
                             std::span<const Vec2> queries, double *parameters,
                             double *distances_sq) {
    dispatch_degree(knots.degree, [&]<int Degree>() {
        const CurveSearch<Degree> search(knots, points);
        search.nearest(queries, [&](std::size_t j, const auto &found) {
            parameters[j] = found.parameter;
            distances_sq[j] = found.distance_sq;
        });
    });
}

}  // namespace shapespline
