// Normal equations of one window in control points and logarithms of knot intervals.
//
// Every residual is linearised in what it depends on; the data's local parameters are eliminated
// (Schur complement). In a span all derivatives are polynomials in the local parameter u, so the
// data enter through moments sum W u^q only, which become matrix entries once per span.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "shapespline/base/envelope.hpp"
#include "shapespline/curve/moments.hpp"
#include "shapespline/curve/span_basis.hpp"
#include "shapespline/spline/window.hpp"

namespace shapespline::spline {

template <int Degree>
class WindowSystem {
  public:
    // Numbers the unknowns along the curve; intervals only if they are free.
    void prepare(const Window<Degree> &window, bool intervals_free) {
        intervals_free_ = intervals_free;
        point_unknown_.assign(window.n_free_points, -1);
        interval_unknown_.assign(window.n_free_intervals, -1);
        int count = 0;
        for (int i = 0; i < window.n_points(); ++i) {
            const int point = window.point_slot[i];
            if (point != kNotFree && point_unknown_[point] < 0) {
                point_unknown_[point] = count;
                count += 2;
            }
            const int k = i + (Degree + 1) / 2;  // in the middle of the point's support
            if (!intervals_free || k >= static_cast<int>(window.interval_slot.size())) continue;
            const int interval = window.interval_slot[k];
            if (interval != kNotFree && interval_unknown_[interval] < 0)
                interval_unknown_[interval] = count++;
        }
        std::vector<std::size_t> first(count);
        for (int i = 0; i < count; ++i) first[i] = i;
        for (int k = window.first_sampled; k <= window.last_sampled; ++k) {
            collect(window, k);
            std::size_t lowest = count;
            for (const int u : active_) lowest = std::min<std::size_t>(lowest, u);
            for (const int u : active_) first[u] = std::min(first[u], lowest);
        }
        matrix_ = EnvelopeMatrix(first);
        factor_ = matrix_;
        right_side_.assign(count, 0.0);
        scale_.resize(count);
    }

    std::size_t size() const { return right_side_.size(); }
    int point_unknown(int slot) const { return point_unknown_[slot]; }
    int interval_unknown(int slot) const { return interval_unknown_[slot]; }

    void clear() {
        matrix_.clear();
        std::fill(right_side_.begin(), right_side_.end(), 0.0);
    }

    // Adds what the data and samples of local span k weigh.
    void add(const Window<Degree> &window, const LocalCurve &curve, int k,
             const SpanBasis<Degree> &basis, const SpanMoments<Degree> &moments) {
        for (int l = 0; l <= Degree; ++l) {
            const int slot = window.point_slot[k - Degree + l];
            points_[l] = slot == kNotFree ? -1 : point_unknown_[slot];
        }
        weigh_points(basis, moments);
        for (int l = 0; l <= Degree; ++l)
            if (points_[l] >= 0) add_point_rows(basis, moments, l);
        if (intervals_free_) add_interval_rows(window, curve, k, basis, moments);
    }

    // Solves (A + damping S + a little) x = b, S the scale of the unknowns; false if A is not
    // positive definite.
    bool solve(double damping, std::vector<double> &x) {
        for (std::size_t i = 0; i < size(); ++i) scale_[i] = matrix_.at(i, i);
        // One for both coordinates of a point: a step does not depend on the axes.
        for (const int at : point_unknown_)
            if (at >= 0) scale_[at] = scale_[at + 1] = 0.5 * (scale_[at] + scale_[at + 1]);
        const double largest = *std::max_element(scale_.begin(), scale_.end());
        factor_.take_values(matrix_);
        for (std::size_t i = 0; i < size(); ++i)
            factor_.at(i, i) += damping * scale_[i] + 1e-9 * largest;
        if (!factor_.factorize()) return false;
        x = right_side_;
        factor_.solve(x);
        return true;
    }

    // By how much the linearised sum of squares falls with the step x of solve().
    double promised(double damping, const std::vector<double> &x) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i)
            sum += x[i] * (right_side_[i] + damping * scale_[i] * x[i]);
        return sum;
    }

  private:
    using Polynomial = std::array<Vec2, Degree + 1>;
    static constexpr int kIntervalReach = Degree - 1;  // intervals on either side that shape a span
    // Relative step of the difference quotient in an interval; the curve is smooth in its
    // logarithm.
    static constexpr double kIntervalStep = 1e-6;

    void collect(const Window<Degree> &window, int k) {
        active_.clear();
        for (int l = 0; l <= Degree; ++l) {
            const int slot = window.point_slot[k - Degree + l];
            if (slot == kNotFree) continue;
            active_.push_back(point_unknown_[slot]);
            active_.push_back(point_unknown_[slot] + 1);
        }
        if (!intervals_free_) return;
        for (int g = k - kIntervalReach; g <= k + kIntervalReach; ++g)
            if (const int slot = window.interval_slot[g];
                slot != kNotFree && interval_unknown_[slot] >= 0)
                active_.push_back(interval_unknown_[slot]);
    }

    void add_entry(int i, int k, double value) {
        if (i == k)
            matrix_.at(i, k) += 2.0 * value;  // one unknown twice on the span
        else
            matrix_.at(std::max(i, k), std::min(i, k)) += value;
    }

    void weigh_points(const SpanBasis<Degree> &basis, const SpanMoments<Degree> &moments) {
        for (int l = 0; l <= Degree; ++l) weighed_[l] = {moments, basis.of_point[l]};
    }

    void add_point_rows(const SpanBasis<Degree> &basis, const SpanMoments<Degree> &moments,
                        int l) {
        const int row = points_[l];
        subtract_residuals(moments, basis.of_point[l], right_side_[row], right_side_[row + 1]);
        for (int other = 0; other <= l; ++other) {
            const int column = points_[other];
            if (column < 0) continue;
            const auto [xx, xy, yy] = weighed_[other].times(basis.of_point[l]);
            if (other == l) {
                matrix_.at(row, row) += xx;
                matrix_.at(row + 1, row) += xy;
                matrix_.at(row + 1, row + 1) += yy;
            } else {
                add_entry(row, column, xx);
                add_entry(row, column + 1, xy);
                add_entry(row + 1, column, xy);
                add_entry(row + 1, column + 1, yy);
            }
        }
    }

    void add_interval_rows(const Window<Degree> &window, const LocalCurve &curve, int k,
                      const SpanBasis<Degree> &basis, const SpanMoments<Degree> &moments) {
        std::array<double, 2 * kIntervalReach + 1> around;
        std::copy_n(curve.intervals.begin() + (k - kIntervalReach), around.size(), around.begin());
        std::array<Polynomial, 2 * kIntervalReach + 1> change, weighted;
        std::array<int, 2 * kIntervalReach + 1> unknown{};
        int count = 0;
        SpanBasis<Degree> moved;
        for (int g = 0; g <= 2 * kIntervalReach; ++g) {
            const int slot = window.interval_slot[k - kIntervalReach + g];
            if (slot == kNotFree || interval_unknown_[slot] < 0) continue;
            const double kept = around[g];
            around[g] = kept * (1.0 + kIntervalStep);
            moved.evaluate(&around[kIntervalReach]);
            around[g] = kept;
            Polynomial &d = change[count] = {};
            for (int l = 0; l <= Degree; ++l)
                for (int q = 0; q <= Degree; ++q)
                    d[q] += ((moved.of_point[l][q] - basis.of_point[l][q]) / kIntervalStep) *
                            curve.points[k - Degree + l];
            weighted[count] = weigh(d, moments);
            unknown[count++] = interval_unknown_[slot];
        }
        for (int g = 0; g < count; ++g) {
            const int row = unknown[g];
            for (int q = 0; q <= Degree; ++q)
                right_side_[row] -= dot(change[g][q], moments.weighted_residual[q]);
            for (int l = 0; l <= Degree; ++l) {
                if (points_[l] < 0) continue;
                Vec2 sum{};
                for (int q = 0; q <= Degree; ++q) sum += basis.of_point[l][q] * weighted[g][q];
                add_entry(row, points_[l], sum.x);
                add_entry(row, points_[l] + 1, sum.y);
            }
            for (int other = 0; other <= g; ++other) {
                double sum = 0.0;
                for (int q = 0; q <= Degree; ++q) sum += dot(change[g][q], weighted[other][q]);
                if (other == g)
                    matrix_.at(row, row) += sum;
                else
                    add_entry(row, unknown[other], sum);
            }
        }
    }

    static Polynomial weigh(const Polynomial &d, const SpanMoments<Degree> &moments) {
        Polynomial out{};
        for (int q = 0; q <= Degree; ++q)
            for (int p = 0; p <= Degree; ++p)
                out[q] += Vec2{moments.xx[p + q] * d[p].x + moments.xy[p + q] * d[p].y,
                               moments.xy[p + q] * d[p].x + moments.yy[p + q] * d[p].y};
        return out;
    }

    bool intervals_free_ = false;
    std::vector<int> point_unknown_, interval_unknown_, active_;
    std::array<int, Degree + 1> points_;
    std::array<WeighedFunction<Degree>, Degree + 1> weighed_;
    EnvelopeMatrix matrix_{std::vector<std::size_t>{}}, factor_{std::vector<std::size_t>{}};
    std::vector<double> right_side_, scale_;
};

}  // namespace shapespline::spline
