// B-spline basis functions of one span as polynomials, from the knot intervals around it.
//
// With intervals (knot differences) instead of knots every change is local: moving one knot or
// removing it changes two intervals, whatever follows stays as it is, and a closed curve is a ring
// of intervals. The polynomials are in u in [-1, 1], -1 where the span begins; monomial moments are
// then good to 2e-15 at degree 3 and 4e-12 at degree 9.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "shapespline/curve/bezier.hpp"

namespace shapespline {

template <int Degree>
struct SpanBasis {
    // of_point[l][q] is the coefficient of u^q in the l-th of the basis functions on the span.
    std::array<std::array<double, Degree + 1>, Degree + 1> of_point;

    // `interval` points at that of the span; Degree - 1 intervals on either side are read. This is
    // the recursion of Basis::evaluate (bspline.hpp) with linear factors in place of numbers.
    void evaluate(const double *interval) {
        std::array<double, Degree + 1> left{}, right{};
        const double half = 0.5 * interval[0];
        if constexpr (Degree >= 1) left[1] = right[1] = half;
        for (int j = 2; j <= Degree; ++j) {
            left[j] = left[j - 1] + interval[1 - j];
            right[j] = right[j - 1] + interval[j - 1];
        }
        of_point[0][0] = 1.0;
        raise<1>(half, left, right);
    }

  private:
    // From degree J - 1 to J; the degree is a constant so that the loops unroll.
    template <int J>
    void raise(double half, const std::array<double, Degree + 1> &left,
               const std::array<double, Degree + 1> &right) {
        if constexpr (J <= Degree) {
            std::array<double, J + 1> saved{};
            for (int r = 0; r < J; ++r) {
                const double a = right[r + 1], b = left[J - r], inverse = 1.0 / (a + b);
                std::array<double, J + 1> ratio{}, shifted{};
                for (int q = 0; q < J; ++q) {
                    ratio[q] = of_point[r][q] * inverse;
                    shifted[q + 1] = half * ratio[q];
                }
                for (int q = 0; q <= J; ++q) {
                    of_point[r][q] = saved[q] + (a * ratio[q] - shifted[q]);
                    saved[q] = b * ratio[q] + shifted[q];
                }
            }
            for (int q = 0; q <= J; ++q) of_point[J][q] = saved[q];
            raise<J + 1>(half, left, right);
        }
    }
};

// The curve on one span, sum_q c[q] u^q.
template <int Degree>
struct SpanCurve {
    std::array<Vec2, Degree + 1> c;

    void combine(const SpanBasis<Degree> &basis, const Vec2 *points) {
        c = {};
        for (int l = 0; l <= Degree; ++l)
            for (int q = 0; q <= Degree; ++q) c[q] += basis.of_point[l][q] * points[l];
    }
    Vec2 point(double u) const {
        Vec2 value = c[Degree];
        for (int q = Degree - 1; q >= 0; --q) value = u * value + c[q];
        return value;
    }
    Vec2 tangent(double u) const {
        Vec2 value = static_cast<double>(Degree) * c[Degree];
        for (int q = Degree - 1; q >= 1; --q) value = u * value + static_cast<double>(q) * c[q];
        return value;
    }
    Vec2 second(double u) const {
        Vec2 value{};
        for (int q = Degree; q >= 2; --q)
            value = u * value + static_cast<double>(q * (q - 1)) * c[q];
        return value;
    }

    // Bernstein form over the span: the control point j is the blossom at j times 1, else -1.
    Bezier<Degree> bezier() const {
        Bezier<Degree> piece{{}, -1.0, 1.0};
        for (int j = 0; j <= Degree; ++j)
            for (int q = 0; q <= Degree; ++q) piece.points[j] += kBlossom[j][q] * c[q];
        return piece;
    }

  private:
    using Table = std::array<std::array<double, Degree + 1>, Degree + 1>;

    static constexpr double binomial(int n, int k) {
        if (k < 0 || k > n) return 0.0;
        double value = 1.0;
        for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
        return value;
    }
    // Blossom of u^q at j times 1 and Degree - j times -1.
    static constexpr Table blossoms() {
        Table table{};
        for (int j = 0; j <= Degree; ++j)
            for (int q = 0; q <= Degree; ++q) {
                double sum = 0.0;
                for (int i = 0; i <= q; ++i)
                    sum += ((q - i) % 2 ? -1.0 : 1.0) * binomial(j, i) *
                           binomial(Degree - j, q - i);
                table[j][q] = sum / binomial(Degree, q);
            }
        return table;
    }
    static constexpr Table kBlossom = blossoms();
};

}  // namespace shapespline
