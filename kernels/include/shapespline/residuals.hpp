// The least-squares problem in control points P and location parameters t:
//     f(P, t) = 1/2 sum_j w_j |C(t_j) - Q_j|^2
// its gradient, the Gauss-Newton diagonal of its Hessian, and the Levenberg-Marquardt step with
// the parameters eliminated. All O(n); sums run in fixed chunks, in order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "shapespline/bspline.hpp"
#include "shapespline/envelope.hpp"
#include "shapespline/span_cursor.hpp"

namespace shapespline {

// Points per partial sum: long enough to cost nothing, short enough that rounding does not grow
// with n but with n / kChunk + kChunk.
inline constexpr std::size_t kChunk = 1024;

// Which location parameters stay where they are.
enum class Held : int { none = 0, ends = 1, all = 2 };

struct Samples {
    std::span<const Vec2> points;
    std::span<const double> parameters;
    const double *weights;  // null for all ones
    Held held = Held::none;
    bool control_ends_fixed = false;  // the first and last control point do not move
    double stray_weight = 0.0;        // of the stray residuals; 0 for the plain problem
    // The part in [0, 1] of each squared residual along the tangent that a step counts, where the
    // parameters are found by projection and not by the step; null where they are eliminated.
    const double *along = nullptr;

    std::size_t size() const { return points.size(); }
    double weight(std::size_t j) const { return weights ? weights[j] : 1.0; }
    bool is_held(std::size_t j) const {
        return held == Held::all || (held == Held::ends && (j == 0 || j + 1 == size()));
    }
};

// Stray residuals hold the curve where it passes between two data points on a long way of its own,
// which the residuals of the data cannot see: bumps beside corners, loops in spans that lost their
// points. Where neighbours' parameters are more than kFreeGap of a span apart, the curve between
// them is compared with the segment between the points, at matching fractions (the Frechet term of
// METHOD 6). The weight grows smoothly from zero, so that points may still drift apart.
inline constexpr double kFreeGap = 0.125;
inline constexpr double kStraySamples = 8.0;  // a span

struct Stray {
    std::size_t before, after;  // the data points it lies between
    double fraction;            // of the way from one to the other
    double parameter;
    Vec2 target;
    double weight;
    double weight_slope;  // derivative of the weight with respect to the gap
};

template <class Visit>
void for_each_stray(const Knots &knots, const Samples &samples, Visit &&visit) {
    if (samples.stray_weight == 0.0) return;
    std::size_t n_spans = 0;
    for (std::size_t k = knots.degree; k < knots.n_coefficients(); ++k)
        n_spans += knots.values[k] < knots.values[k + 1];
    const double span = knots.period() / static_cast<double>(n_spans);
    const std::size_t n = samples.size();
    for (std::size_t j = 0; j + 1 < n + (knots.periodic ? 1 : 0); ++j) {
        const bool closing = j + 1 == n;
        const double begin = samples.parameters[j];
        const double end = closing ? samples.parameters[0] + knots.period()
                                   : samples.parameters[j + 1];
        const double excess = (end - begin) / (kFreeGap * span) - 1.0;
        if (!(excess > 0.0)) continue;
        const Vec2 a = samples.points[j], b = samples.points[closing ? 0 : j + 1];
        // No more than the whole domain deserves, however far a parameter may have flown.
        const double n_samples =
            kStraySamples *
            std::clamp(std::ceil((end - begin) / span), 1.0, static_cast<double>(n_spans));
        const double unit = samples.stray_weight / n_samples;
        const double slope = 2.0 * unit * excess / (kFreeGap * span);
        for (double i = 1.0; i <= n_samples; ++i) {
            const double s = i / (n_samples + 1.0);
            visit(Stray{j, closing ? 0 : j + 1, s, begin + s * (end - begin), a + s * (b - a),
                        unit * excess * excess, slope});
        }
    }
}

// Adds what was collected in unrolled control points onto the distinct ones.
template <class Value>
void fold(std::span<const Value> unrolled, std::span<Value> distinct) {
    std::fill(distinct.begin(), distinct.end(), Value{});
    for (std::size_t i = 0; i < unrolled.size(); ++i)
        distinct[i % distinct.size()] += unrolled[i];
}

inline std::vector<Vec2> unroll(std::span<const Vec2> distinct, std::size_t n_coefficients) {
    std::vector<Vec2> unrolled(n_coefficients);
    for (std::size_t i = 0; i < n_coefficients; ++i) unrolled[i] = distinct[i % distinct.size()];
    return unrolled;
}

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
                const Vec2 pull = samples.weight(j) * residual;
                partial += dot(pull, residual);
                parameter_gradient[j] = samples.is_held(j) ? 0.0 : dot(pull, cursor.tangent());
                Vec2 *local = gradient.data() + cursor.first_index();
                for (int i = 0; i <= Degree; ++i) local[i] += cursor.basis()[i] * pull;
            }
            total += partial;
        }
        for_each_stray(knots, samples, [&](const Stray &stray) {
            cursor.seek(stray.parameter);
            const Vec2 residual = cursor.point() - stray.target;
            const Vec2 pull = stray.weight * residual;
            total += dot(pull, residual);
            Vec2 *local = gradient.data() + cursor.first_index();
            for (int i = 0; i <= Degree; ++i) local[i] += cursor.basis()[i] * pull;
            // The sample moves with both neighbours, and its weight with the gap between them.
            const double along = dot(pull, cursor.tangent());
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

// The part of the normal equations that one span's points make, kept apart until the span is left:
// the points come nearly in order, so the large matrix is touched once a span.
template <int Degree>
class LocalSystem {
  public:
    void enter(const CurveCursor<Degree> &) {}

    // Adds N N' (x) W and -N (x) W r for W = w (I - inv_h t t').
    void add(const CurveCursor<Degree> &cursor, Vec2 r, Vec2 t, double w, double inv_h) {
        const std::array<double, Degree + 1> &basis = cursor.basis();
        const double wxx = w * (1.0 - t.x * t.x * inv_h), wxy = -w * t.x * t.y * inv_h,
                     wyy = w * (1.0 - t.y * t.y * inv_h);
        const Vec2 pull{wxx * r.x + wxy * r.y, wxy * r.x + wyy * r.y};
        std::array<double, kWidth> bxx{}, bxy{}, byy{};
        for (int b = 0; b <= Degree; ++b) {
            bxx[b] = basis[b] * wxx;
            bxy[b] = basis[b] * wxy;
            byy[b] = basis[b] * wyy;
        }
        for (int a = 0; a <= Degree; ++a) {
            rhs_[a] += -basis[a] * pull;
            const double na = basis[a];
            for (int b = 0; b < kWidth; ++b) {
                xx_[a][b] += na * bxx[b];
                xy_[a][b] += na * bxy[b];
                yy_[a][b] += na * byy[b];
            }
        }
    }

    // Moves what was collected for control points first .. first + Degree into the system.
    void flush(std::size_t first, EnvelopeMatrix &matrix, std::vector<double> &rhs) {
        const std::size_t m = matrix.size() / 2;
        for (int a = 0; a <= Degree; ++a) {
            const std::size_t ia = (first + a) % m;
            rhs[2 * ia] += rhs_[a].x;
            rhs[2 * ia + 1] += rhs_[a].y;
            for (int b = 0; b <= a; ++b) {
                const std::size_t ib = (first + b) % m;
                const std::size_t i = std::max(ia, ib), k = std::min(ia, ib);
                matrix.at(2 * i, 2 * k) += xx_[a][b];
                matrix.at(2 * i + 1, 2 * k) += xy_[a][b];
                matrix.at(2 * i + 1, 2 * k + 1) += yy_[a][b];
                if (k < i) matrix.at(2 * i, 2 * k + 1) += xy_[a][b];
            }
        }
        *this = LocalSystem{};
    }

  private:
    // Whole rows of an even number of columns, of which flush reads the lower triangle: twice the
    // products, but all of them in vector registers.
    static constexpr int kWidth = (Degree + 2) / 2 * 2;
    std::array<std::array<double, kWidth>, Degree + 1> xx_{}, xy_{}, yy_{};
    std::array<Vec2, Degree + 1> rhs_{};
};

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
    EnvelopeMatrix matrix = normal_matrix(m, knots.degree, knots.periodic);
    std::vector<double> rhs(2 * m, 0.0);
    StepResult result{false, 0.0, 0.0, 0.0};

    double largest_speed_sq = 0.0;
    for (const Vec2 d : derivative_points(knots, unrolled))
        largest_speed_sq = std::max(largest_speed_sq, norm_sq(d));
    const double speed_floor = 1e-12 * largest_speed_sq;
    // 1 / h_j, zero where the parameter does not move: fixed, or the curve stands still.
    const auto inverse_h = [&](std::size_t j, Vec2 tangent) {
        const double speed_sq = norm_sq(tangent);
        if (samples.is_held(j) || speed_sq == 0.0) return 0.0;
        if (samples.along) return (1.0 - samples.along[j]) / std::max(speed_sq, speed_floor);
        return 1.0 / (std::max(speed_sq, speed_floor) * (1.0 + damping));
    };

    dispatch_degree(knots.degree, [&]<int Degree>() {
        constexpr bool kMoments = Degree <= kMomentDegree;
        std::conditional_t<kMoments, SpanCursor<Degree>, CurveCursor<Degree>> cursor(knots,
                                                                                     unrolled);
        std::conditional_t<kMoments, LocalMoments<Degree>, LocalSystem<Degree>> local;
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
            result.cost += 0.5 * w * norm_sq(r);
        }
        for_each_stray(knots, samples, [&](const Stray &stray) {
            cursor.seek(stray.parameter);
            follow();
            const Vec2 r = cursor.point() - stray.target;
            local.add(cursor, r, Vec2{}, stray.weight, 0.0);
            result.cost += 0.5 * stray.weight * norm_sq(r);
        });
        local.flush(first, matrix, rhs);
    });

    double largest = 0.0;
    for (std::size_t i = 0; i < 2 * m; ++i) largest = std::max(largest, matrix.at(i, i));
    for (std::size_t i = 0; i < 2 * m; ++i)
        matrix.at(i, i) += damping * (matrix.at(i, i) + 1e-11 * largest);
    if (samples.control_ends_fixed) {
        for (const std::size_t fixed : {std::size_t{0}, std::size_t{1}, 2 * m - 2, 2 * m - 1}) {
            for (std::size_t k = matrix.first_column(fixed); k < fixed; ++k)
                matrix.at(fixed, k) = 0.0;
            for (std::size_t i = fixed + 1; i < 2 * m; ++i)
                if (matrix.first_column(i) <= fixed) matrix.at(i, fixed) = 0.0;
            matrix.at(fixed, fixed) = 1.0;
            rhs[fixed] = 0.0;
        }
    }
    for (const double g : rhs) result.gradient_norm += g * g;
    result.gradient_norm = std::sqrt(result.gradient_norm);
    if (!matrix.factorize()) return result;
    result.solved = true;
    matrix.solve(rhs);
    for (std::size_t i = 0; i < m; ++i) control_step[i] = {rhs[2 * i], rhs[2 * i + 1]};

    std::vector<Vec2> moved = unroll(control_step, unrolled.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += unrolled[i];
    dispatch_degree(knots.degree, [&]<int Degree>() {
        using Cursor = std::conditional_t<Degree <= kMomentDegree, SpanCursor<Degree>,
                                          CurveCursor<Degree>>;
        Cursor cursor(knots, unrolled), next(knots, moved);
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

}  // namespace shapespline
