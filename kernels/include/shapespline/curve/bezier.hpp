// Bezier pieces of a B-spline curve.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/curve/bspline.hpp"

namespace shapespline {

template <int Degree>
struct Bezier {
    std::array<Vec2, Degree + 1> points;
    double begin, end;  // parameters of the curve it was cut from

    // Both halves (de Casteljau at 1/2).
    std::pair<Bezier, Bezier> halves() const {
        Bezier left, right;
        std::array<Vec2, Degree + 1> work = points;
        const double middle = 0.5 * (begin + end);
        left.begin = begin;
        left.end = right.begin = middle;
        right.end = end;
        for (int level = 0; level <= Degree; ++level) {
            left.points[level] = work[0];
            right.points[Degree - level] = work[Degree - level];
            for (int i = 0; i < Degree - level; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
        }
        return {left, right};
    }

    struct Jet {
        Vec2 point, first, second;
    };

    // Point and derivatives with respect to the local parameter s in [0, 1].
    Jet at(double s) const {
        if constexpr (Degree == 3) {  // by powers, twice as fast; no worse about the first point
            const Vec2 a = 3.0 * (points[1] - points[0]);
            const Vec2 b = 3.0 * (points[2] - points[1]) - a;
            const Vec2 c = points[3] - points[0] - a - b;
            return {points[0] + s * (a + s * (b + s * c)), a + s * (2.0 * b + (3.0 * s) * c),
                    2.0 * b + (6.0 * s) * c};
        }
        std::array<Vec2, Degree + 1> work = points;
        Jet jet{};
        for (int n = Degree; n > 0; --n) {
            if (n == 2) jet.second = (Degree * (Degree - 1)) * (work[2] - 2.0 * work[1] + work[0]);
            if (n == 1) jet.first = Degree * (work[1] - work[0]);
            for (int i = 0; i < n; ++i) work[i] = (1.0 - s) * work[i] + s * work[i + 1];
        }
        jet.point = work[0];
        return jet;
    }
};

// One Bezier for each non-empty span of the domain. Its points are the blossom (polar form) of the
// span's polynomial at mixed arguments, b_j = f(a, .., a, b, .., b) with j times b (Ramshaw 1989).
template <int Degree>
std::vector<Bezier<Degree>> bezier_pieces(const Knots &knots, std::span<const Vec2> points) {
    const std::span<const double> u = knots.values;
    std::vector<Bezier<Degree>> pieces;
    for (std::size_t k = Degree; k < knots.n_coefficients(); ++k) {
        if (!(u[k] < u[k + 1])) continue;
        Bezier<Degree> piece{{}, u[k], u[k + 1]};
        for (int j = 0; j <= Degree; ++j) {
            std::array<Vec2, Degree + 1> work;
            std::copy_n(points.begin() + (k - Degree), Degree + 1, work.begin());
            for (int r = 1; r <= Degree; ++r) {
                const double argument = r <= Degree - j ? u[k] : u[k + 1];
                for (int i = Degree; i >= r; --i) {
                    const double low = u[k - Degree + i], high = u[k + 1 + i - r];
                    const double alpha = (argument - low) / (high - low);
                    work[i] = (1.0 - alpha) * work[i - 1] + alpha * work[i];
                }
            }
            piece.points[j] = work[Degree];
        }
        pieces.push_back(piece);
    }
    return pieces;
}

}  // namespace shapespline
