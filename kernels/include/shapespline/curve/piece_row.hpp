// Pieces end to end, as arrays in which each piece follows the one before.
#pragma once

#include <span>
#include <vector>

#include "shapespline/base/length.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline {

// One piece, clamped over [0, 1].
template <class Point>
struct PieceView {
    int degree;
    std::span<const double> knots;
    std::span<Point> points;

    Vec2 first_leg() const { return points[1] - points[0]; }
    Vec2 last_leg() const { return points[points.size() - 1] - points[points.size() - 2]; }
};

// Views of all pieces; `counts` of their control points.
template <class Point>
std::vector<PieceView<Point>> piece_row(std::span<const int> degrees, std::span<const int> counts,
                                        std::span<const double> knots, std::span<Point> points) {
    std::vector<PieceView<Point>> row;
    std::size_t k = 0, m = 0;
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const std::size_t n = counts[i], n_knots = knots.empty() ? 0 : n + degrees[i] + 1;
        row.push_back({degrees[i], knots.subspan(k, n_knots), points.subspan(m, n)});
        k += n_knots;
        m += n;
    }
    return row;
}

// Lengths of the control polygons of all pieces.
inline std::vector<double> polygon_lengths(std::span<const int> counts,
                                           std::span<const Vec2> points) {
    std::vector<double> lengths;
    for (const int count : counts) {
        double sum = 0.0;
        for (int i = 1; i < count; ++i) sum += length(points[i] - points[i - 1]);
        lengths.push_back(sum);
        points = points.subspan(count);
    }
    return lengths;
}

}  // namespace shapespline
