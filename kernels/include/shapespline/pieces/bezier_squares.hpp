// Weighted least squares of one quadratic or cubic Bezier between two fixed nodes, the parameters
// eliminated (Schur complement): at most four unknowns, the data in pairs, nothing allocated.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "shapespline/base/pair.hpp"
#include "shapespline/distance/newton.hpp"
#include "shapespline/pieces/section.hpp"

namespace shapespline::pieces {

template <int Degree>
class BezierSquares {
  public:
    using Points = std::array<Vec2, Degree + 1>;
    static constexpr int kMostData = 96;

    explicit BezierSquares(const Points &points) { now_->points = points; }

    int size() const { return size_; }
    const Points &points() const { return now_->points; }
    double parameter(int i) const { return now_->u[i]; }
    double weight(int i) const { return weight_[i]; }
    double distance_sq(int i) const { return now_->distance_sq[i]; }
    void set_weight(int i, double weight) { weight_.set(i, weight); }

    // A datum before the i-th; its distance is known after `project`. At most kMostData.
    void insert(int i, Vec2 q, double parameter, double weight) {
        for (int k = size_++; k > i; --k)
            put(k, {x_[k - 1], y_[k - 1]}, now_->u[k - 1], weight_[k - 1]);
        put(i, q, parameter, weight);
        // An odd one is followed by its like, without weight.
        const int last = size_ - 1;
        if (size_ % 2 == 1) put(size_, {x_[last], y_[last]}, now_->u[last], 0.0);
    }

    void move_to(const Points &points) {
        now_->points = points;
        project(kFirstSteps);
    }

    double cost() const { return cost(*now_); }
    double total_weight() const {
        Pair total = both(0.0);
        for (int k = 0; k < n_pairs(); ++k) total += weight_.pair(k);
        return sum(total);
    }

    void project(int steps) { project(*now_, steps); }

    // Control points that fit the data at the parameters they have.
    void solve_at_fixed_parameters() {
        project(0);
        assemble(false);
        if (solve(1e-9)) move_points(*now_);
        project(kFirstSteps);
    }

    // Levenberg-Marquardt until the cost falls, or a step promises that it falls, by less than the
    // part `enough`, or no damping lowers it.
    void improve(int iterations, double enough) {
        damping_ = std::max(damping_, kLeastDamping);
        double value = cost();
        for (int iteration = 0; iteration < iterations && value > 0.0; ++iteration) {
            assemble(true);
            double next_value = value;
            bool lower = false;
            for (int trial = 0; trial < kTrials && !lower; ++trial) {
                if (solve(damping_)) {
                    if (promised() < enough * value) break;
                    move_points(*next_);
                    next_->u = now_->u;
                    project(*next_, kNewtonSteps);
                    next_value = cost(*next_);
                    lower = next_value < value;
                }
                if (!lower) damping_ = kRaise * damping_ + kLeastDamping;
            }
            if (!lower) return;
            std::swap(now_, next_);
            damping_ /= kLower;
            const double fall = (value - next_value) / value;
            value = next_value;
            if (fall < enough) return;
        }
    }

    SpanPolynomial polynomial() const { return polynomial(now_->points); }

  private:
    static constexpr int kInner = Degree - 1, kUnknowns = 2 * kInner;
    static constexpr int kTrials = 6, kFirstSteps = 6, kNewtonSteps = 2;
    static constexpr double kLeastScale = 1e-10, kLeastDamping = 1e-6, kRaise = 8.0, kLower = 6.0;

    using Numbers = PairArray<kMostData>;
    using Unknowns = std::array<double, kUnknowns>;
    // Control points, and parameters of the data with residuals, tangents and distances there.
    struct State {
        Points points;
        Numbers u, rx, ry, tx, ty, distance_sq;
    };
    struct Look {
        Pair u, rx, ry, tx, ty, distance_sq;
    };

    int n_pairs() const { return (size_ + 1) / 2; }

    void put(int i, Vec2 q, double parameter, double weight) {
        x_.set(i, q.x);
        y_.set(i, q.y);
        now_->u.set(i, parameter);
        weight_.set(i, weight);
    }

    static SpanPolynomial polynomial(const Points &p) {
        SpanPolynomial s{0.0, 1.0, {}, {}};
        const auto set = [&](int power, Vec2 c) {
            s.x[power] = c.x;
            s.y[power] = c.y;
        };
        set(0, p[0]);
        set(1, static_cast<double>(Degree) * (p[1] - p[0]));
        if constexpr (Degree == 2) set(2, p[0] - 2.0 * p[1] + p[2]);
        if constexpr (Degree == 3) {
            set(2, 3.0 * (p[0] - 2.0 * p[1] + p[2]));
            set(3, p[3] - p[0] + 3.0 * (p[1] - p[2]));
        }
        return s;
    }

    Look look(const SpanPolynomial &c, int k, Pair u) const {
        Look at;
        at.u = u;
        at.rx = ((c.x[3] * u + c.x[2]) * u + c.x[1]) * u + c.x[0] - x_.pair(k);
        at.ry = ((c.y[3] * u + c.y[2]) * u + c.y[1]) * u + c.y[0] - y_.pair(k);
        at.tx = (3.0 * c.x[3] * u + 2.0 * c.x[2]) * u + c.x[1];
        at.ty = (3.0 * c.y[3] * u + 2.0 * c.y[2]) * u + c.y[1];
        at.distance_sq = at.rx * at.rx + at.ry * at.ry;
        return at;
    }

    // Safeguarded Newton steps of the parameters as in `improve_feet`; no distance rises.
    void project(State &state, int steps) const {
        const SpanPolynomial c = polynomial(state.points);
        for (int k = 0; k < n_pairs(); ++k) {
            Look best = look(c, k, state.u.pair(k));
            for (int step = 0; step < steps; ++step) {
                const Pair speed_sq = best.tx * best.tx + best.ty * best.ty;
                const Pair newton = speed_sq + best.rx * (6.0 * c.x[3] * best.u + 2.0 * c.x[2]) +
                                    best.ry * (6.0 * c.y[3] * best.u + 2.0 * c.y[2]);
                const Pair curvature = descent_curvature(speed_sq, newton);
                const Pair slope = best.rx * best.tx + best.ry * best.ty;
                const Pair u = best.u - slope / (curvature + both(1e-300));
                const Look next = look(c, k, clamped(u, 0.0, 1.0));
                const auto nearer = next.distance_sq < best.distance_sq;
                best.u = chosen(nearer, next.u, best.u);
                best.rx = chosen(nearer, next.rx, best.rx);
                best.ry = chosen(nearer, next.ry, best.ry);
                best.tx = chosen(nearer, next.tx, best.tx);
                best.ty = chosen(nearer, next.ty, best.ty);
                best.distance_sq = chosen(nearer, next.distance_sq, best.distance_sq);
            }
            state.u.pair(k) = best.u;
            state.rx.pair(k) = best.rx;
            state.ry.pair(k) = best.ry;
            state.tx.pair(k) = best.tx;
            state.ty.pair(k) = best.ty;
            state.distance_sq.pair(k) = best.distance_sq;
        }
    }

    double cost(const State &state) const {
        Pair total = both(0.0);
        for (int k = 0; k < n_pairs(); ++k) total += weight_.pair(k) * state.distance_sq.pair(k);
        return sum(total);
    }

    // Bernstein functions of the inner control points.
    static std::array<Pair, kInner> inner_basis(Pair u) {
        const Pair rest = both(1.0) - u;
        if constexpr (Degree == 2)
            return {2.0 * u * rest};
        else
            return {3.0 * u * rest * rest, 3.0 * u * u * rest};
    }

    // Normal equations; with eliminate false the parameters stay.
    void assemble(bool eliminate) {
        constexpr int n_products = kInner * (kInner + 1) / 2;
        Pair xx[n_products] = {}, xy[n_products] = {}, yy[n_products] = {};
        Pair gx[kInner] = {}, gy[kInner] = {};
        for (int k = 0; k < n_pairs(); ++k) {
            const Pair tx = now_->tx.pair(k), ty = now_->ty.pair(k);
            const Pair rx = now_->rx.pair(k), ry = now_->ry.pair(k), w = weight_.pair(k);
            const Pair damped_speed_sq = (1.0 + damping_) * (tx * tx + ty * ty) + both(1e-300);
            const Pair h = eliminate ? both(1.0) / damped_speed_sq : both(0.0);
            const Pair along = (rx * tx + ry * ty) * h, wh = w * h;
            const Pair wxx = w - wh * tx * tx, wxy = -wh * tx * ty, wyy = w - wh * ty * ty;
            const Pair wx = w * (rx - tx * along), wy = w * (ry - ty * along);
            const auto basis = inner_basis(now_->u.pair(k));
            for (int i = 0, at = 0; i < kInner; ++i) {
                gx[i] += basis[i] * wx;
                gy[i] += basis[i] * wy;
                for (int j = 0; j <= i; ++j, ++at) {
                    const Pair product = basis[i] * basis[j];
                    xx[at] += product * wxx;
                    xy[at] += product * wxy;
                    yy[at] += product * wyy;
                }
            }
        }
        double largest = 0.0;
        for (int i = 0, at = 0; i < kInner; ++i) {
            gradient_[2 * i] = sum(gx[i]);
            gradient_[2 * i + 1] = sum(gy[i]);
            for (int j = 0; j <= i; ++j, ++at) {
                matrix_[2 * i][2 * j] = sum(xx[at]);
                matrix_[2 * i + 1][2 * j] = sum(xy[at]);
                if (j < i) matrix_[2 * i][2 * j + 1] = sum(xy[at]);
                matrix_[2 * i + 1][2 * j + 1] = sum(yy[at]);
            }
            // One scale for both coordinates: a step does not depend on the axes.
            scale_[i] = 0.5 * (matrix_[2 * i][2 * i] + matrix_[2 * i + 1][2 * i + 1]);
            largest = std::max(largest, scale_[i]);
        }
        least_ = kLeastScale * largest;
    }

    // The damped step by Cholesky's factorisation; false if there is none.
    bool solve(double damping) {
        std::array<Unknowns, kUnknowns> factor;
        for (int i = 0; i < kUnknowns; ++i) {
            double right_side = -gradient_[i];
            for (int j = 0; j <= i; ++j) {
                double rest = matrix_[i][j];
                if (i == j) rest += damping * scale_[i / 2] + least_;
                for (int k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
                if (i == j && !(rest > 0.0)) return false;
                factor[i][j] = i == j ? std::sqrt(rest) : rest / factor[j][j];
                if (j < i) right_side -= factor[i][j] * step_[j];
            }
            step_[i] = right_side / factor[i][i];
        }
        for (int i = kUnknowns - 1; i >= 0; --i) {
            for (int k = i + 1; k < kUnknowns; ++k) step_[i] -= factor[k][i] * step_[k];
            step_[i] /= factor[i][i];
        }
        return true;
    }

    // By how much the linearised sum of squares falls with the step.
    double promised() const {
        double total = 0.0;
        for (int i = 0; i < kUnknowns; ++i)
            total += step_[i] * (damping_ * scale_[i / 2] * step_[i] - gradient_[i]);
        return total;
    }

    void move_points(State &state) const {
        state.points = now_->points;
        for (int i = 0; i < kInner; ++i)
            state.points[i + 1] += Vec2{step_[2 * i], step_[2 * i + 1]};
    }

    int size_ = 0;
    Numbers x_, y_, weight_;
    State states_[2], *now_ = &states_[0], *next_ = &states_[1];
    std::array<Unknowns, kUnknowns> matrix_;
    Unknowns gradient_, step_;
    std::array<double, kInner> scale_;
    double least_ = 0.0, damping_ = 1e-3;
};

}  // namespace shapespline::pieces
