// The part of the normal equations that one span's points make, kept apart until the span is left:
// the points come nearly in order, so the large matrix is touched once a span.
//
// Two kinds with one face. Moments take 3 (2p + 1) + 2 (p + 1) sums a point, products of basis
// functions 3 (p + 1) (p + 2) / 2 + 2 (p + 1), but moments lose a digit a degree: up to degree 5.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "shapespline/curve/bspline.hpp"
#include "shapespline/curve/moments.hpp"
#include "shapespline/curve/span_cursor.hpp"

namespace shapespline::least_squares {

// Adds a block of the normal matrix for control points ia and ib of m, taken modulo m.
template <class Matrix>
void add_block(Matrix &matrix, std::size_t ia, std::size_t ib, const Weight2 &block) {
    const std::size_t i = std::max(ia, ib), k = std::min(ia, ib);
    matrix.at(2 * i, 2 * k) += block.xx;
    matrix.at(2 * i + 1, 2 * k) += block.xy;
    matrix.at(2 * i + 1, 2 * k + 1) += block.yy;
    if (k < i) matrix.at(2 * i, 2 * k + 1) += block.xy;
}

template <int Degree>
class LocalMoments {
  public:
    // Begins the span that the cursor is on.
    void enter(const SpanCursor<Degree> &cursor) { basis_ = cursor.basis(); }

    // Adds N N' (x) W and -N (x) W r for W = w (I - inverse_h t t').
    void add(const SpanCursor<Degree> &cursor, Vec2 r, Vec2 t, double w, double inverse_h) {
        const Weight2 weight = eliminated(w, t, inverse_h);
        moments_.add(cursor.local_parameter(), weight, weight * r);
    }

    // Moves what was collected for control points first .. first + Degree into the system.
    template <class Matrix>
    void flush(std::size_t first, Matrix &matrix, std::vector<double> &rhs) {
        const std::size_t m = matrix.size() / 2;
        for (int a = 0; a <= Degree; ++a) {
            const std::size_t ia = (first + a) % m;
            subtract_residuals(moments_, basis_.of_point[a], rhs[2 * ia], rhs[2 * ia + 1]);
            const WeighedFunction<Degree> weighed(moments_, basis_.of_point[a]);
            for (int b = 0; b <= a; ++b)
                add_block(matrix, ia, (first + b) % m, weighed.times(basis_.of_point[b]));
        }
        moments_ = {};
    }

  private:
    SpanBasis<Degree> basis_;
    SpanMoments<Degree> moments_;
};

template <int Degree>
class LocalProducts {
  public:
    void enter(const CurveCursor<Degree> &) {}

    // Adds N N' (x) W and -N (x) W r for W = w (I - inverse_h t t').
    void add(const CurveCursor<Degree> &cursor, Vec2 r, Vec2 t, double w, double inverse_h) {
        const std::array<double, Degree + 1> &basis = cursor.basis();
        const Weight2 weight = eliminated(w, t, inverse_h);
        const Vec2 weighted = weight * r;
        std::array<double, kWidth> bxx{}, bxy{}, byy{};
        for (int b = 0; b <= Degree; ++b) {
            bxx[b] = basis[b] * weight.xx;
            bxy[b] = basis[b] * weight.xy;
            byy[b] = basis[b] * weight.yy;
        }
        for (int a = 0; a <= Degree; ++a) {
            rhs_[a] += -basis[a] * weighted;
            const double na = basis[a];
            for (int b = 0; b < kWidth; ++b) {
                xx_[a][b] += na * bxx[b];
                xy_[a][b] += na * bxy[b];
                yy_[a][b] += na * byy[b];
            }
        }
    }

    // Moves what was collected for control points first .. first + Degree into the system.
    template <class Matrix>
    void flush(std::size_t first, Matrix &matrix, std::vector<double> &rhs) {
        const std::size_t m = matrix.size() / 2;
        for (int a = 0; a <= Degree; ++a) {
            const std::size_t ia = (first + a) % m;
            rhs[2 * ia] += rhs_[a].x;
            rhs[2 * ia + 1] += rhs_[a].y;
            for (int b = 0; b <= a; ++b)
                add_block(matrix, ia, (first + b) % m, {xx_[a][b], xy_[a][b], yy_[a][b]});
        }
        *this = LocalProducts{};
    }

  private:
    // Whole rows of an even number of columns, of which flush reads the lower triangle: twice the
    // products, but all of them in vector registers (KER-01).
    static constexpr int kWidth = (Degree + 2) / 2 * 2;
    std::array<std::array<double, kWidth>, Degree + 1> xx_{}, xy_{}, yy_{};
    std::array<Vec2, Degree + 1> rhs_{};
};

// Moments lose a digit a degree, and their work grows: up to this one (KER-02).
inline constexpr int kMomentDegree = 5;

// How a curve of a degree is read along its data, and what collects their part of the equations.
template <int Degree>
using DataCursor =
    std::conditional_t<Degree <= kMomentDegree, SpanCursor<Degree>, CurveCursor<Degree>>;
template <int Degree>
using LocalSystem =
    std::conditional_t<Degree <= kMomentDegree, LocalMoments<Degree>, LocalProducts<Degree>>;

}  // namespace shapespline::least_squares
