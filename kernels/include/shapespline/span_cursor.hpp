// A curve read span by span as polynomials, and the normal equations collected as their moments.
//
// On one knot span the basis functions are polynomials in u in [-1, 1], so that each point adds its
// weights times 1, u, ..., u^2p to the moments of its span; the matrix is made of them once a span.
// Monomial moments are good to 2e-15 at degree 3 and lose a digit a degree: up to degree 5.
#pragma once

#include <array>
#include <vector>

#include "shapespline/bspline.hpp"
#include "shapespline/span_basis.hpp"
#include "shapespline/window_system.hpp"

namespace shapespline {

inline constexpr int kMomentDegree = 5;

// Point and derivatives of a curve at one parameter after another, nearly in order.
template <int Degree>
class SpanCursor {
  public:
    SpanCursor(const Knots &knots, std::span<const Vec2> points) : knots_(knots), points_(points) {}

    void seek(double parameter) {
        const double u = knots_.wrapped(parameter);
        const std::size_t k = knots_.span_of(u, span_);
        if (k != span_) load(k);
        place_ = scale_ * (u - knots_.values[k]) - 1.0;
    }
    std::size_t first_index() const { return span_ - Degree; }
    double place() const { return place_; }
    const removal::SpanBasis<Degree> &basis() const { return basis_; }
    Vec2 point() const { return curve_.point(place_); }
    Vec2 tangent() const { return scale_ * curve_.tangent(place_); }
    Vec2 bend() const { return scale_ * scale_ * curve_.second(place_); }

  private:
    void load(std::size_t k) {
        span_ = k;
        std::array<double, 2 * Degree - 1> gaps;
        for (int j = 0; j < 2 * Degree - 1; ++j) {
            const std::size_t i = k + 1 - Degree + j;
            gaps[j] = knots_.values[i + 1] - knots_.values[i];
        }
        basis_.evaluate(gaps.data() + Degree - 1);
        curve_.combine(basis_, points_.data() + first_index());
        scale_ = 2.0 / gaps[Degree - 1];
    }

    Knots knots_;
    std::span<const Vec2> points_;
    removal::SpanBasis<Degree> basis_;
    removal::SpanCurve<Degree> curve_;
    std::size_t span_ = 0;  // none: spans begin at the degree
    double place_ = 0.0, scale_ = 0.0;
};

// The moments of one span's points.
template <int Degree>
class LocalMoments {
  public:
    // Begins the span that the cursor is on.
    void enter(const SpanCursor<Degree> &cursor) { basis_ = cursor.basis(); }

    // Adds N N' (x) W and -N (x) W r for W = w (I - inv_h t t').
    void add(const SpanCursor<Degree> &cursor, Vec2 r, Vec2 t, double w, double inv_h) {
        const double wxx = w * (1.0 - t.x * t.x * inv_h), wxy = -w * t.x * t.y * inv_h,
                     wyy = w * (1.0 - t.y * t.y * inv_h);
        moments_.add(cursor.place(), wxx, wxy, wyy,
                     {wxx * r.x + wxy * r.y, wxy * r.x + wyy * r.y});
    }

    // Moves what was collected for control points first .. first + Degree into the system.
    template <class Matrix>
    void flush(std::size_t first, Matrix &matrix, std::vector<double> &rhs) {
        const std::size_t m = matrix.size() / 2;
        for (int a = 0; a <= Degree; ++a) {
            const std::size_t ia = (first + a) % m;
            std::array<double, Degree + 1> xx{}, xy{}, yy{};
            for (int q = 0; q <= Degree; ++q) {
                const double na = basis_.of_point[a][q];
                rhs[2 * ia] -= na * moments_.pull[q].x;
                rhs[2 * ia + 1] -= na * moments_.pull[q].y;
                for (int s = 0; s <= Degree; ++s) {
                    xx[s] += na * moments_.xx[q + s];
                    xy[s] += na * moments_.xy[q + s];
                    yy[s] += na * moments_.yy[q + s];
                }
            }
            for (int b = 0; b <= a; ++b) {
                double sxx = 0.0, sxy = 0.0, syy = 0.0;
                for (int s = 0; s <= Degree; ++s) {
                    sxx += basis_.of_point[b][s] * xx[s];
                    sxy += basis_.of_point[b][s] * xy[s];
                    syy += basis_.of_point[b][s] * yy[s];
                }
                const std::size_t ib = (first + b) % m;
                const std::size_t i = std::max(ia, ib), k = std::min(ia, ib);
                matrix.at(2 * i, 2 * k) += sxx;
                matrix.at(2 * i + 1, 2 * k) += sxy;
                matrix.at(2 * i + 1, 2 * k + 1) += syy;
                if (k < i) matrix.at(2 * i, 2 * k + 1) += sxy;
            }
        }
        moments_ = {};
    }

  private:
    removal::SpanBasis<Degree> basis_;
    removal::SpanMoments<Degree> moments_;
};

}  // namespace shapespline
