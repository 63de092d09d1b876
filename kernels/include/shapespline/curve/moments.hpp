// Weighted residuals of one knot span as moments, and the normal equations made of them.
//
// On one span the basis functions are polynomials in u in [-1, 1], so that each point adds its
// weights times 1, u, ..., u^2p to the moments of its span; the matrix is made of them once a span.
// Monomial moments are good to 2e-15 at degree 3 and lose a digit a degree.
#pragma once

#include <array>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

// A symmetric 2 x 2 matrix: what x and y of a residual weigh.
struct Weight2 {
    double xx, xy, yy;

    Vec2 operator*(Vec2 r) const { return {xx * r.x + xy * r.y, xy * r.x + yy * r.y}; }
};

// What is left of a weight w when the parameter of the residual is eliminated (the Schur
// complement of orthogonal distance regression): w (I - inverse_h t t'), t the tangent.
inline Weight2 eliminated(double w, Vec2 t, double inverse_h) {
    return {w * (1.0 - t.x * t.x * inverse_h), -w * t.x * t.y * inverse_h,
            w * (1.0 - t.y * t.y * inverse_h)};
}

template <int Degree>
struct SpanMoments {
    std::array<double, 2 * Degree + 1> xx{}, xy{}, yy{};  // of the weights
    std::array<Vec2, Degree + 1> weighted_residual{};

    void add(double u, const Weight2 &weight, Vec2 weighted) {
        double power = 1.0;
        for (int q = 0; q <= 2 * Degree; ++q) {
            xx[q] += weight.xx * power;
            xy[q] += weight.xy * power;
            yy[q] += weight.yy * power;
            if (q <= Degree) weighted_residual[q] += power * weighted;
            power *= u;
        }
    }
};

// A polynomial on a span, by its coefficients: a basis function.
template <int Degree>
using BasisFunction = std::array<double, Degree + 1>;

// Moments of the weights times one basis function; entry q is that with u^q besides.
template <int Degree>
struct WeighedFunction {
    BasisFunction<Degree> xx{}, xy{}, yy{};

    WeighedFunction() = default;
    // Of SpanMoments, or of anything else with xx, xy and yy.
    template <class Moments>
    WeighedFunction(const Moments &moments, const BasisFunction<Degree> &f) {
        for (int p = 0; p <= Degree; ++p)
            for (int q = 0; q <= Degree; ++q) {
                xx[q] += f[p] * moments.xx[p + q];
                xy[q] += f[p] * moments.xy[p + q];
                yy[q] += f[p] * moments.yy[p + q];
            }
    }

    // The block of the normal matrix that it makes with another function.
    Weight2 times(const BasisFunction<Degree> &f) const {
        Weight2 block{0.0, 0.0, 0.0};
        for (int q = 0; q <= Degree; ++q) {
            block.xx += f[q] * xx[q];
            block.xy += f[q] * xy[q];
            block.yy += f[q] * yy[q];
        }
        return block;
    }
};

// Takes from x and y of a right side what the weighted residuals make with a basis function.
template <int Degree>
void subtract_residuals(const SpanMoments<Degree> &moments, const BasisFunction<Degree> &f,
                        double &x, double &y) {
    for (int q = 0; q <= Degree; ++q) {
        x -= f[q] * moments.weighted_residual[q].x;
        y -= f[q] * moments.weighted_residual[q].y;
    }
}

}  // namespace shapespline
