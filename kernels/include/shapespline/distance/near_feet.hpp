// Parameters moved to feet near them, where the data are known to belong.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "shapespline/curve/span_cursor.hpp"
#include "shapespline/distance/newton.hpp"

namespace shapespline {

// Some Newton steps for every parameter, each taken only if it leads nearer.
inline void near_feet(const Knots &knots, std::span<const Vec2> control_points,
                      std::span<const Vec2> points, int steps, std::span<double> parameters) {
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    dispatch_degree(knots.degree, [&]<int Degree>() {
        SpanCursor<Degree> cursor(knots, unrolled);
        for (std::size_t j = 0; j < points.size(); ++j) {
            cursor.seek(parameters[j]);
            Vec2 r = cursor.point() - points[j];
            for (int step = 0; step < steps; ++step) {
                const Vec2 t = cursor.tangent();
                const double speed_sq = norm_sq(t), newton = speed_sq + dot(r, cursor.bend());
                const double hessian = descent_curvature(speed_sq, newton);
                if (!(hessian > 0.0)) break;
                double trial = parameters[j] - dot(r, t) / hessian;
                if (!knots.periodic) trial = std::clamp(trial, knots.begin(), knots.end());
                if (trial == parameters[j]) break;
                cursor.seek(trial);
                const Vec2 next = cursor.point() - points[j];
                if (!(norm_sq(next) < norm_sq(r))) break;
                parameters[j] = trial;
                r = next;
            }
        }
    });
}

}  // namespace shapespline
