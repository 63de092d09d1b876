// Where a curve turns abruptly: at the ends of its Bezier pieces.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "shapespline/curve/bezier.hpp"

namespace shapespline {

// Parameters where it turns by more than `least` radians; of a closed curve where it begins, too.
inline std::vector<double> corner_parameters(const Knots &knots, std::span<const Vec2> points,
                                             bool closed, double least) {
    std::vector<double> corners;
    dispatch_degree(knots.degree, [&]<int Degree>() {
        const auto pieces = bezier_pieces<Degree>(knots, points);
        for (std::size_t k = closed ? 0 : 1; k < pieces.size(); ++k) {
            const auto &before = pieces[(k + pieces.size() - 1) % pieces.size()].points;
            const Vec2 arriving = before[Degree] - before[Degree - 1];
            const Vec2 leaving = pieces[k].points[1] - pieces[k].points[0];
            const double turn = std::atan2(cross(arriving, leaving), dot(arriving, leaving));
            if (std::fabs(turn) > least) corners.push_back(pieces[k].begin);
        }
    });
    return corners;
}

}  // namespace shapespline
