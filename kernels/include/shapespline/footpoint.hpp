// Nearest points on a B-spline curve.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/bezier.hpp"
#include "shapespline/box_tree.hpp"

namespace shapespline {

template <int Degree>
class CurveSearch {
  public:
    struct Nearest {
        double distance_sq;
        double parameter;
        std::size_t piece;
    };

    CurveSearch(const Knots &knots, std::span<const Vec2> points)
        : pieces_(gentle_pieces(knots, points)), tree_(hull_boxes(pieces_)) {}

    // Every piece whose convex hull's box comes nearer than the best so far is searched: global up
    // to the convergence of Newton's method on a gentle piece.
    Nearest nearest(Vec2 q, std::size_t hint) const {
        Nearest best{std::numeric_limits<double>::infinity(), 0.0, 0};
        tree_.search(q, best.distance_sq, hint, [&](std::size_t i) {
            const Nearest found = nearest_on_piece(q, i);
            if (found.distance_sq < best.distance_sq) best = found;
        });
        return best;
    }

  private:
    static constexpr int kMaxDepth = 8, kMinDepth = 2, kNewtonSteps = 32;

    // Pieces whose control polygon is at most 2 % longer than its chord: on them the squared
    // distance to a point has one minimum, unless the point is near the centre of curvature, where
    // all distances are nearly equal.
    static std::vector<Bezier<Degree>> gentle_pieces(const Knots &knots,
                                                     std::span<const Vec2> points) {
        std::vector<Bezier<Degree>> gentle;
        for (const Bezier<Degree> &piece : bezier_pieces<Degree>(knots, points))
            append_gentle(piece, 0, gentle);
        return gentle;
    }

    static void append_gentle(const Bezier<Degree> &piece, int depth,
                              std::vector<Bezier<Degree>> &gentle) {
        double polygon = 0.0;
        for (int i = 0; i < Degree; ++i) polygon += norm(piece.points[i + 1] - piece.points[i]);
        const double chord = norm(piece.points[Degree] - piece.points[0]);
        if (Degree == 1 || depth == kMaxDepth || (depth >= kMinDepth && polygon <= 1.02 * chord)) {
            gentle.push_back(piece);
            return;
        }
        const auto [left, right] = piece.halves();
        append_gentle(left, depth + 1, gentle);
        append_gentle(right, depth + 1, gentle);
    }

    static std::vector<Box> hull_boxes(const std::vector<Bezier<Degree>> &pieces) {
        std::vector<Box> boxes(pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (const Vec2 p : pieces[i].points) boxes[i].include(p);
        return boxes;
    }

    Nearest nearest_on_piece(Vec2 q, std::size_t index) const {
        const Bezier<Degree> &piece = pieces_[index];
        const Vec2 chord = piece.points[Degree] - piece.points[0];
        const double chord_sq = norm_sq(chord);
        double s = chord_sq > 0.0
                       ? std::clamp(dot(q - piece.points[0], chord) / chord_sq, 0.0, 1.0)
                       : 0.5;
        double best_s = 0.0, best_sq = norm_sq(piece.points[0] - q);
        const auto consider = [&](double at, double distance_sq) {
            if (distance_sq < best_sq) best_s = at, best_sq = distance_sq;
        };
        consider(1.0, norm_sq(piece.points[Degree] - q));
        for (int iteration = 0; iteration < kNewtonSteps; ++iteration) {
            const auto jet = piece.at(s);
            const Vec2 r = jet.point - q;
            consider(s, norm_sq(r));
            const double slope = dot(r, jet.first);
            const double newton = norm_sq(jet.first) + dot(r, jet.second);
            // Where the second derivative is not safely positive, Gauss-Newton still descends.
            const double curvature = std::max(newton, 0.25 * norm_sq(jet.first));
            if (!(curvature > 0.0)) break;
            const double next = std::clamp(s - slope / curvature, 0.0, 1.0);
            if (std::abs(next - s) <= 1e-15) break;
            s = next;
        }
        return {best_sq, piece.begin + best_s * (piece.end - piece.begin), index};
    }

    std::vector<Bezier<Degree>> pieces_;
    BoxTree tree_;
};

inline void nearest_on_curve(const Knots &knots, std::span<const Vec2> points,
                             std::span<const Vec2> queries, double *parameters,
                             double *distances_sq) {
    dispatch_degree(knots.degree, [&]<int Degree>() {
        const CurveSearch<Degree> search(knots, points);
        std::size_t hint = 0;
        for (std::size_t j = 0; j < queries.size(); ++j) {
            const auto found = search.nearest(queries[j], hint);
            parameters[j] = found.parameter;
            distances_sq[j] = found.distance_sq;
            hint = found.piece;
        }
    });
}

}  // namespace shapespline
