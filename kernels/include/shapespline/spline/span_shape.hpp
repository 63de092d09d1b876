// The curve on one span of a spline, and what fairness asks of it.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "shapespline/base/box_tree.hpp"
#include "shapespline/curve/span_basis.hpp"
#include "shapespline/spline/state.hpp"

namespace shapespline::spline {

inline constexpr int kSpeedSamples = 8;  // of every span

template <int Degree>
class SpanShape {
  public:
    SpanCurve<Degree> curve;
    double interval = 0.0;
    Box hull;  // of its Bezier form
    std::array<double, kSpeedSamples> speeds{};  // in the middles of equal parts

    SpanShape() = default;
    // Of span k, unwrapped, which is not empty.
    SpanShape(const SplineState<Degree> &state, int k) : interval(state.interval(k)) {
        std::array<double, 2 * Degree - 1> around;
        for (int g = 0; g < 2 * Degree - 1; ++g) around[g] = state.interval(k - Degree + 1 + g);
        std::array<Vec2, Degree + 1> points;
        for (int l = 0; l <= Degree; ++l) points[l] = state.point(k - Degree + l);
        SpanBasis<Degree> basis;
        basis.evaluate(&around[Degree - 1]);
        curve.combine(basis, points.data());
        for (const Vec2 p : curve.bezier().points) hull.include(p);
        for (int i = 0; i < kSpeedSamples; ++i)
            speeds[i] = speed((2.0 * i + 1.0) / kSpeedSamples - 1.0);
        // Beside a knot of multiplicity >= degree, across which the curve goes on, it may stand
        // still: the neighbourhood is left out.
        const bool begins = !state.closed && k == Degree;
        const bool ends = !state.closed && k + 1 == state.n_points();
        if (!begins && empty_intervals(state, k - 1, -1) >= Degree - 1) begin_ = -0.9;
        if (!ends && empty_intervals(state, k + 1, 1) >= Degree - 1) end_ = 0.9;
        for (int i = 0; i <= kSpeedSamples; ++i) {
            const double u = begin_ + i * step(), value = speed(u);
            if (value < least_) least_ = value, at_ = u;
        }
    }

    // With respect to the parameter of the spline.
    double speed(double u) const { return norm(curve.tangent(u)) * 2.0 / interval; }

    // The least sampled speed, refined unless it is many times `critical`: samples alone are not
    // enough beside a cusp.
    double slowest(double critical) {
        constexpr double kSuspect = 10.0;
        if (!(least_ < kSuspect * critical)) return least_;
        if (!refined_) refined_ = std::min(least_, speed(slowest_place()));
        return *refined_;
    }

  private:
    static int empty_intervals(const SplineState<Degree> &state, int k, int direction) {
        int count = 0;
        const int size = static_cast<int>(state.intervals.size());
        while (count < Degree && (state.closed || (k >= 0 && k < size)) &&
               !(state.interval(k) > 0.0))
            ++count, k += direction;
        return count;
    }

    double step() const { return (end_ - begin_) / kSpeedSamples; }
    double slowest_place() const {
        double low = std::max(begin_, at_ - step()), high = std::min(end_, at_ + step());
        for (int i = 0; i < 24; ++i) {
            const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
            if (speed(a) < speed(b))
                high = b;
            else
                low = a;
        }
        return 0.5 * (low + high);
    }

    double begin_ = -1.0, end_ = 1.0;
    double least_ = std::numeric_limits<double>::infinity(), at_ = -1.0;  // of the samples
    std::optional<double> refined_;
};

}  // namespace shapespline::spline
