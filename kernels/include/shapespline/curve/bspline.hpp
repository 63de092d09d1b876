// B-spline basis functions and curves.
//
// A curve is its full knot array, its degree and its *unrolled* control points: knots.size() ==
// n_coefficients + degree + 1. A periodic curve repeats its first `degree` control points at the
// end and reads parameters modulo its period; an open one extends its end polynomials beyond its
// domain [knots[degree], knots[n_coefficients]].
//
// Piegl and Tiller, The NURBS Book, 2nd ed., algorithms A2.1 and A2.2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

inline constexpr int kMaxDegree = 9;

struct Knots {
    std::span<const double> values;
    int degree;
    bool periodic;

    std::size_t n_coefficients() const { return values.size() - degree - 1; }
    double begin() const { return values[degree]; }
    double end() const { return values[n_coefficients()]; }
    double period() const { return end() - begin(); }

    // The parameter at which the basis is evaluated: modulo the period, or itself.
    double wrapped(double u) const {
        if (!periodic || (u >= begin() && u < end())) return u;
        const double v = u - std::floor((u - begin()) / period()) * period();
        return v < end() ? std::max(v, begin()) : begin();
    }

    // The k with knots[k] <= u < knots[k + 1], clamped to the first and the last non-empty span of
    // the domain. Parameters come nearly sorted, so the span of the last one is tried first.
    std::size_t span_of(double u, std::size_t hint) const {
        const std::size_t first = degree, last = n_coefficients() - 1;
        std::size_t k = std::clamp(hint, first, last);
        const auto holds = [&](std::size_t i) { return values[i] <= u && u < values[i + 1]; };
        if (holds(k)) return k;
        if (k < last && holds(k + 1)) return k + 1;
        if (k > first && holds(k - 1)) return k - 1;
        const auto domain = values.subspan(first + 1, last - first);
        k = first + (std::upper_bound(domain.begin(), domain.end(), u) - domain.begin());
        while (k > first && values[k] == values[k + 1]) --k;
        return k;
    }
};

// Values of the degree + 1 basis functions that live on span k, and of the degree basis functions
// of the next lower degree, from which the derivative is made.
template <int Degree>
struct Basis {
    std::array<double, Degree + 1> values;
    std::array<double, Degree> lower;

    void evaluate(const double *knots, std::size_t k, double u) {
        std::array<double, Degree + 1> left, right;
        values[0] = 1.0;
        for (int j = 1; j <= Degree; ++j) {
            if (j == Degree) std::copy_n(values.begin(), Degree, lower.begin());
            left[j] = u - knots[k + 1 - j];
            right[j] = knots[k + j] - u;
            double saved = 0.0;
            for (int r = 0; r < j; ++r) {
                const double ratio = values[r] / (right[r + 1] + left[j - r]);
                values[r] = saved + right[r + 1] * ratio;
                saved = left[j - r] * ratio;
            }
            values[j] = saved;
        }
    }
};

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

// Control points of the derivative: d_i = p (P_{i+1} - P_i) / (u_{i+p+1} - u_{i+1}). No knot of the
// domain repeats more than p times, so the p knots between are never all equal.
inline std::vector<Vec2> derivative_points(const Knots &knots, std::span<const Vec2> points) {
    const int p = knots.degree;
    std::vector<Vec2> derivative(points.size() - 1);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double width = knots.values[i + p + 1] - knots.values[i + 1];
        derivative[i] = (p / width) * (points[i + 1] - points[i]);
    }
    return derivative;
}

// Calls body.template operator()<Degree>() for a degree known at run time only.
template <class Body>
decltype(auto) dispatch_degree(int degree, Body &&body) {
    switch (degree) {
        case 1: return body.template operator()<1>();
        case 2: return body.template operator()<2>();
        case 3: return body.template operator()<3>();
        case 4: return body.template operator()<4>();
        case 5: return body.template operator()<5>();
        case 6: return body.template operator()<6>();
        case 7: return body.template operator()<7>();
        case 8: return body.template operator()<8>();
        case 9: return body.template operator()<9>();
        default: throw std::invalid_argument("degree must be 1 to 9");
    }
}

// Point and first derivative of a curve at one parameter after another.
template <int Degree>
class CurveCursor {
  public:
    CurveCursor(const Knots &knots, std::span<const Vec2> points)
        : knots_(knots), points_(points), derivative_(derivative_points(knots, points)) {}

    // Moves to a parameter; what follows reads there.
    void seek(double parameter) {
        const double u = knots_.wrapped(parameter);
        span_ = knots_.span_of(u, span_);
        basis_.evaluate(knots_.values.data(), span_, u);
    }
    std::size_t first_index() const { return span_ - Degree; }
    const std::array<double, Degree + 1> &basis() const { return basis_.values; }
    Vec2 point() const { return combine(points_.data(), basis_.values); }
    Vec2 tangent() const { return combine(derivative_.data(), basis_.lower); }
    template <class Values>
    Vec2 combine(const Vec2 *coefficients, const Values &weights) const {
        const Vec2 *local = coefficients + first_index();
        Vec2 sum = weights[0] * local[0];
        for (std::size_t i = 1; i < weights.size(); ++i) sum += weights[i] * local[i];
        return sum;
    }

  private:
    Knots knots_;
    std::span<const Vec2> points_;
    std::vector<Vec2> derivative_;
    Basis<Degree> basis_;
    std::size_t span_ = 0;
};

// Non-zero basis functions at each parameter, (k, degree + 1), and the index of the first of them.
inline void basis_functions(const Knots &knots, std::span<const double> parameters, double *values,
                            std::int64_t *first) {
    dispatch_degree(knots.degree, [&]<int Degree>() {
        Basis<Degree> basis;
        std::size_t k = 0;
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            const double u = knots.wrapped(parameters[j]);
            k = knots.span_of(u, k);
            basis.evaluate(knots.values.data(), k, u);
            std::copy_n(basis.values.begin(), Degree + 1, values + j * (Degree + 1));
            first[j] = static_cast<std::int64_t>(k - Degree);
        }
    });
}

// Curve points at each parameter.
inline void evaluate(const Knots &knots, std::span<const Vec2> points,
                     std::span<const double> parameters, Vec2 *out) {
    dispatch_degree(knots.degree, [&]<int Degree>() {
        CurveCursor<Degree> cursor(knots, points);
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            cursor.seek(parameters[j]);
            out[j] = cursor.point();
        }
    });
}

}  // namespace shapespline
