// The least-squares problem in control points P and location parameters t:
//     f(P, t) = 1/2 sum_j w_j |C(t_j) - Q_j|^2
// its gradient and the Gauss-Newton diagonal of its Hessian. All O(n); sums run in fixed chunks, in
// order. The Levenberg-Marquardt step is in normal_equations.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/least_squares/samples.hpp"

namespace shapespline::least_squares {

// Points per partial sum: long enough to cost nothing, short enough that rounding does not grow
// with n but with n / kChunk + kChunk.
inline constexpr std::size_t kChunk = 1024;

// f alone, stray residuals included.
inline double cost(const Knots &knots, std::span<const Vec2> control_points,
                   const Samples &samples) {
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    return dispatch_degree(knots.degree, [&]<int Degree>() {
        CurveCursor<Degree> cursor(knots, unrolled);
        double total = 0.0;
        for (std::size_t begin = 0; begin < samples.size(); begin += kChunk) {
            double partial = 0.0;
            for (std::size_t j = begin; j < std::min(begin + kChunk, samples.size()); ++j) {
                cursor.seek(samples.parameters[j]);
                partial += samples.weight(j) * norm_sq(cursor.point() - samples.points[j]);
            }
            total += partial;
        }
        for_each_stray(knots, samples, [&](const Stray &stray) {
            cursor.seek(stray.parameter);
            total += stray.weight * norm_sq(cursor.point() - stray.target);
        });
        return 0.5 * total;
    });
}

// f with df/dP_i = sum_j w_j N_i(t_j) r_j and df/dt_j = w_j r_j . C'(t_j); zero for what is fixed.
inline double cost_and_gradient(const Knots &knots, std::span<const Vec2> control_points,
                                const Samples &samples, std::span<Vec2> control_gradient,
                                double *parameter_gradient) {
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    std::vector<Vec2> gradient(unrolled.size());
    const double total = dispatch_degree(knots.degree, [&]<int Degree>() {
        CurveCursor<Degree> cursor(knots, unrolled);
        double total = 0.0;
        for (std::size_t begin = 0; begin < samples.size(); begin += kChunk) {
            double partial = 0.0;
            for (std::size_t j = begin; j < std::min(begin + kChunk, samples.size()); ++j) {
                cursor.seek(samples.parameters[j]);
                const Vec2 residual = cursor.point() - samples.points[j];
                const Vec2 weighted = samples.weight(j) * residual;
                partial += dot(weighted, residual);
                parameter_gradient[j] = samples.is_held(j) ? 0.0 : dot(weighted, cursor.tangent());
                Vec2 *local = gradient.data() + cursor.first_index();
                for (int i = 0; i <= Degree; ++i) local[i] += cursor.basis()[i] * weighted;
            }
            total += partial;
        }
        for_each_stray(knots, samples, [&](const Stray &stray) {
            cursor.seek(stray.parameter);
            const Vec2 residual = cursor.point() - stray.target;
            const Vec2 weighted = stray.weight * residual;
            total += dot(weighted, residual);
            Vec2 *local = gradient.data() + cursor.first_index();
            for (int i = 0; i <= Degree; ++i) local[i] += cursor.basis()[i] * weighted;
            // The sample moves with both neighbours, and its weight with the gap between them.
            const double along = dot(weighted, cursor.tangent());
            const double by_gap = 0.5 * stray.weight_slope * norm_sq(residual);
            if (!samples.is_held(stray.before))
                parameter_gradient[stray.before] += (1.0 - stray.fraction) * along - by_gap;
            if (!samples.is_held(stray.after))
                parameter_gradient[stray.after] += stray.fraction * along + by_gap;
        });
        return 0.5 * total;
    });
    fold<Vec2>(gradient, control_gradient);
    if (samples.control_ends_fixed) control_gradient.front() = control_gradient.back() = Vec2{};
    return total;
}

// sum_j w_j N_i(t_j)^2 for each control point and w_j |C'(t_j)|^2 for each parameter.
inline void gauss_newton_diagonal(const Knots &knots, std::span<const Vec2> control_points,
                                  const Samples &samples, std::span<double> control_diagonal,
                                  double *parameter_diagonal) {
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    std::vector<double> diagonal(unrolled.size(), 0.0);
    dispatch_degree(knots.degree, [&]<int Degree>() {
        CurveCursor<Degree> cursor(knots, unrolled);
        for (std::size_t j = 0; j < samples.size(); ++j) {
            cursor.seek(samples.parameters[j]);
            parameter_diagonal[j] = samples.weight(j) * norm_sq(cursor.tangent());
            for (int i = 0; i <= Degree; ++i)
                diagonal[cursor.first_index() + i] +=
                    samples.weight(j) * cursor.basis()[i] * cursor.basis()[i];
        }
    });
    fold<double>(diagonal, control_diagonal);
}

}  // namespace shapespline::least_squares
