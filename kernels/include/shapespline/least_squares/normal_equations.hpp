// The Levenberg-Marquardt step with the location parameters eliminated (Schur complement, as in
// orthogonal distance regression, Boggs, Byrd and Schnabel 1987): the normal equations in the
// control points alone, collected in O(n) and solved in their envelope.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/base/envelope.hpp"
#include "shapespline/least_squares/local_system.hpp"
#include "shapespline/least_squares/samples.hpp"

namespace shapespline::least_squares {

// The normal matrix couples control points whose basis functions overlap: two unknowns a point, x
// and y interleaved, half-bandwidth 2 degree + 1, cyclic when periodic.
inline EnvelopeMatrix normal_matrix(std::size_t n_points, int degree, bool periodic) {
    std::vector<std::size_t> first(2 * n_points);
    for (std::size_t i = 0; i < n_points; ++i) {
        const bool wraps = periodic && i + degree >= n_points;
        const std::size_t reach = std::min<std::size_t>(i, degree);
        first[2 * i] = first[2 * i + 1] = wraps ? 0 : 2 * (i - reach);
    }
    return EnvelopeMatrix(std::move(first));
}

// A x = b for the control points, and half the sum of squares of the residuals that it was made of.
// What parts of the data make adds up.
struct NormalEquations {
    EnvelopeMatrix matrix;
    std::vector<double> rhs;
    double cost = 0.0;

    NormalEquations(std::size_t n_points, int degree, bool periodic)
        : matrix(normal_matrix(n_points, degree, periodic)), rhs(2 * n_points, 0.0) {}

    // Adds the data, and 1 / h_j = inverse_h(j, tangent), zero where a parameter does not move.
    template <class InverseH>
    void add(const Knots &knots, std::span<const Vec2> unrolled, const Samples &samples,
             InverseH &&inverse_h) {
        dispatch_degree(knots.degree, [&]<int Degree>() {
            DataCursor<Degree> cursor(knots, unrolled);
            LocalSystem<Degree> local;
            cursor.seek(samples.parameters[0]);
            std::size_t first = cursor.first_index();
            local.enter(cursor);
            const auto follow = [&] {
                if (cursor.first_index() == first) return;
                local.flush(first, matrix, rhs);
                first = cursor.first_index();
                local.enter(cursor);
            };
            for (std::size_t j = 0; j < samples.size(); ++j) {
                cursor.seek(samples.parameters[j]);
                follow();
                const Vec2 r = cursor.point() - samples.points[j];
                const Vec2 t = cursor.tangent();
                const double w = samples.weight(j);
                local.add(cursor, r, t, w, inverse_h(j, t));
                cost += 0.5 * w * norm_sq(r);
            }
            for_each_stray(knots, samples, [&](const Stray &stray) {
                cursor.seek(stray.parameter);
                follow();
                const Vec2 r = cursor.point() - stray.target;
                local.add(cursor, r, Vec2{}, stray.weight, 0.0);
                cost += 0.5 * stray.weight * norm_sq(r);
            });
            local.flush(first, matrix, rhs);
        });
    }

    // Adds damping times the diagonal, each entry with 1e-11 of the largest.
    void damp(double damping) {
        const std::size_t n = matrix.size();
        double largest = 0.0;
        for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, matrix.at(i, i));
        for (std::size_t i = 0; i < n; ++i)
            matrix.at(i, i) += damping * (matrix.at(i, i) + 1e-11 * largest);
    }

    // The first and the last control point do not move.
    void hold_ends() {
        const std::size_t n = matrix.size();
        for (const std::size_t fixed : {std::size_t{0}, std::size_t{1}, n - 2, n - 1}) {
            for (std::size_t k = matrix.first_column(fixed); k < fixed; ++k)
                matrix.at(fixed, k) = 0.0;
            for (std::size_t i = fixed + 1; i < n; ++i)
                if (matrix.first_column(i) <= fixed) matrix.at(i, fixed) = 0.0;
            matrix.at(fixed, fixed) = 1.0;
            rhs[fixed] = 0.0;
        }
    }
};

inline double norm_of(std::span<const double> x) {
    double sum = 0.0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum);
}

// Squared speeds below this part of the largest are raised to it.
inline double speed_floor(const Knots &knots, std::span<const Vec2> unrolled) {
    double largest_sq = 0.0;
    for (const Vec2 d : derivative_points(knots, unrolled))
        largest_sq = std::max(largest_sq, norm_sq(d));
    return 1e-12 * largest_sq;
}

struct StepResult {
    bool solved;
    double cost;
    double predicted_cost;  // of the linearised residuals after the step
    double gradient_norm;   // of f in the control points, parameters eliminated
};

// Levenberg-Marquardt step with the parameters eliminated: with h_j = |T_j|^2 (1 + lambda) and
// W_j = I - T_j T_j' / h_j,
//     (sum w N N' (x) W + lambda D) dP = -sum w N (x) W r,   dt_j = -T_j . (r_j + dC_j) / h_j.
// D is the diagonal of the matrix plus 1e-11 of its largest entry. With parts c_j of the residuals
// along the tangent to be counted, W_j = I - (1 - c_j) T_j T_j' / |T_j|^2 instead.
inline StepResult damped_step(const Knots &knots, std::span<const Vec2> control_points,
                              const Samples &samples, double damping,
                              std::span<Vec2> control_step, double *parameter_step) {
    const std::size_t m = control_points.size();
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    const double least_sq = speed_floor(knots, unrolled);
    // Zero where the parameter does not move: fixed, or the curve stands still.
    const auto inverse_h = [&](std::size_t j, Vec2 tangent) {
        const double speed_sq = norm_sq(tangent);
        if (samples.is_held(j) || speed_sq == 0.0) return 0.0;
        if (samples.along) return (1.0 - samples.along[j]) / std::max(speed_sq, least_sq);
        return 1.0 / (std::max(speed_sq, least_sq) * (1.0 + damping));
    };
    NormalEquations equations(m, knots.degree, knots.periodic);
    equations.add(knots, unrolled, samples, inverse_h);
    StepResult result{false, equations.cost, 0.0, 0.0};
    equations.damp(damping);
    if (samples.control_ends_fixed) equations.hold_ends();
    std::vector<double> &rhs = equations.rhs;
    result.gradient_norm = norm_of(rhs);
    if (!equations.matrix.factorize()) return result;
    result.solved = true;
    equations.matrix.solve(rhs);
    for (std::size_t i = 0; i < m; ++i) control_step[i] = {rhs[2 * i], rhs[2 * i + 1]};

    std::vector<Vec2> moved = unroll(control_step, unrolled.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += unrolled[i];
    dispatch_degree(knots.degree, [&]<int Degree>() {
        DataCursor<Degree> cursor(knots, unrolled), next(knots, moved);
        for (std::size_t j = 0; j < samples.size(); ++j) {
            cursor.seek(samples.parameters[j]);
            next.seek(samples.parameters[j]);
            const Vec2 t = cursor.tangent();
            const Vec2 residual = next.point() - samples.points[j];
            parameter_step[j] = -dot(t, residual) * inverse_h(j, t);
            result.predicted_cost +=
                0.5 * samples.weight(j) * norm_sq(residual + parameter_step[j] * t);
        }
        for_each_stray(knots, samples, [&](const Stray &stray) {
            next.seek(stray.parameter);
            result.predicted_cost += 0.5 * stray.weight * norm_sq(next.point() - stray.target);
        });
    });
    return result;
}

// Of the way along the tangent so much counts as a residual: none would leave control points on
// straight lines free to slide (LSQ-06).
inline constexpr double kAlongPart = 1e-3;

// The normal equations with the parameters eliminated, written out: the cost, the right side, the
// matrix in its envelope. A parameter at an end of an open curve does not move.
inline void eliminated_equations(const Knots &knots, std::span<const Vec2> control_points,
                                 const Samples &samples, std::span<double> out) {
    const std::span<const double> parameters = samples.parameters;
    const std::vector<Vec2> unrolled = unroll(control_points, knots.n_coefficients());
    const double least_sq = speed_floor(knots, unrolled);
    const auto inverse_h = [&](std::size_t j, Vec2 tangent) {
        const bool at_end =
            !knots.periodic && (parameters[j] <= knots.begin() || parameters[j] >= knots.end());
        const double speed_sq = norm_sq(tangent);
        if (at_end || speed_sq == 0.0) return 0.0;
        return (1.0 - kAlongPart) / std::max(speed_sq, least_sq);
    };
    NormalEquations equations(control_points.size(), knots.degree, knots.periodic);
    equations.add(knots, unrolled, samples, inverse_h);
    auto at = out.begin();
    *at++ = equations.cost;
    at = std::copy(equations.rhs.begin(), equations.rhs.end(), at);
    std::copy(equations.matrix.values().begin(), equations.matrix.values().end(), at);
}

inline std::size_t eliminated_size(std::size_t n_points, int degree, bool periodic) {
    return 1 + 2 * n_points + normal_matrix(n_points, degree, periodic).values().size();
}

// The step of the control points that sums of these ask for. The predicted cost is that of the
// quadratic model, in which the parameters follow the points.
inline StepResult eliminated_step(std::size_t n_points, int degree, bool periodic,
                                  std::span<const double> sums, double damping,
                                  std::span<Vec2> control_step) {
    const std::size_t n = 2 * n_points;
    NormalEquations equations(n_points, degree, periodic);
    EnvelopeMatrix &matrix = equations.matrix;
    std::copy_n(sums.begin() + 1, n, equations.rhs.begin());
    std::copy(sums.begin() + 1 + n, sums.end(), matrix.values().begin());
    std::vector<double> damped(n), x = equations.rhs;
    for (std::size_t i = 0; i < n; ++i) damped[i] = -matrix.at(i, i);
    equations.damp(damping);
    for (std::size_t i = 0; i < n; ++i) damped[i] += matrix.at(i, i);
    StepResult result{false, sums[0], sums[0], norm_of(x)};
    if (!matrix.factorize()) return result;
    result.solved = true;
    matrix.solve(x);
    // x' b - x' A x / 2 with (A + D) x = b.
    for (std::size_t i = 0; i < n; ++i)
        result.predicted_cost -= 0.5 * x[i] * (equations.rhs[i] + damped[i] * x[i]);
    for (std::size_t i = 0; i < n_points; ++i) control_step[i] = {x[2 * i], x[2 * i + 1]};
    return result;
}

}  // namespace shapespline::least_squares
