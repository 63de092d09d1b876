// A curve read span by span as polynomials: parameters come nearly in order, so a span's serves
// many.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "shapespline/curve/bspline.hpp"
#include "shapespline/curve/span_basis.hpp"

namespace shapespline {

// Point and derivatives of a curve at one parameter after another, nearly in order.
template <int Degree>
class SpanCursor {
  public:
    SpanCursor(const Knots &knots, std::span<const Vec2> points) : knots_(knots), points_(points) {}

    void seek(double parameter) {
        const double u = knots_.wrapped(parameter);
        const std::size_t k = knots_.span_of(u, span_);
        if (k != span_) load(k);
        local_parameter_ = scale_ * (u - knots_.values[k]) - 1.0;
    }
    std::size_t first_index() const { return span_ - Degree; }
    double local_parameter() const { return local_parameter_; }
    const SpanBasis<Degree> &basis() const { return basis_; }
    Vec2 point() const { return curve_.point(local_parameter_); }
    Vec2 tangent() const { return scale_ * curve_.tangent(local_parameter_); }
    Vec2 bend() const { return scale_ * scale_ * curve_.second(local_parameter_); }

  private:
    void load(std::size_t k) {
        span_ = k;
        std::array<double, 2 * Degree - 1> intervals;
        for (int j = 0; j < 2 * Degree - 1; ++j) {
            const std::size_t i = k + 1 - Degree + j;
            intervals[j] = knots_.values[i + 1] - knots_.values[i];
        }
        basis_.evaluate(intervals.data() + Degree - 1);
        curve_.combine(basis_, points_.data() + first_index());
        scale_ = 2.0 / intervals[Degree - 1];
    }

    Knots knots_;
    std::span<const Vec2> points_;
    SpanBasis<Degree> basis_;
    SpanCurve<Degree> curve_;
    std::size_t span_ = 0;  // none: spans begin at the degree
    double local_parameter_ = 0.0, scale_ = 0.0;
};

}  // namespace shapespline
