// A section: one line, Bezier or small spline of an outline, with the data it stands for.
//
// Inside the search a section is handled by the Taylor polynomials of its knot spans: points,
// derivatives and normal equations all come from them, whatever the knots. They are not those of
// curve/span_basis.hpp, in u in [-1, 1] and of a degree that is a constant: see KER-05.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline::pieces {

// Sections are at most cubic; a curve of a higher degree is made by exact elevation afterwards.
inline constexpr int kSectionDegree = 3;
inline constexpr int kSectionTerms = kSectionDegree + 1;

// Index into the data; a closed outline is laid out in three laps, so that no window wraps.
using Index = std::int64_t;

// What a section's first node is, and how the section begins there.
struct Joint {
    bool corner = false;    // a corner that is kept
    bool pinned = false;    // the node stays where its datum is
    bool required = false;  // the joint must be tangent to a virtual end extension, before it ...
    bool at_end = false;    // ... or that behind it
    bool tangent = false;   // the section starts in the direction in which its neighbour ends

    // No section reaches across.
    bool barred() const { return corner || pinned; }
};

struct Section : Joint {
    int degree = 1;
    std::vector<double> knots;       // clamped, over [0, 1]
    std::vector<Vec2> points;        // control points; the first and the last are nodes
    Index first = 0, last = 0;       // its data, inclusive; neighbours share nodes but no data
    std::vector<double> parameters;  // foot parameters of its data

    // Stored points: each section counts its end node.
    int cost() const { return static_cast<int>(points.size()) - 1; }
    bool curved() const { return cost() > 1; }
    Index count() const { return last - first + 1; }
    void join_like(const Joint &other) { static_cast<Joint &>(*this) = other; }
    Vec2 begin_direction() const { return points[1] - points[0]; }
    Vec2 end_direction() const { return points.back() - points[points.size() - 2]; }
};

// The polynomial of one knot span in v = u - begin.
struct SpanPolynomial {
    double begin, width;
    std::array<double, kSectionTerms> x, y;

    Vec2 point(double v) const {
        return {((x[3] * v + x[2]) * v + x[1]) * v + x[0],
                ((y[3] * v + y[2]) * v + y[1]) * v + y[0]};
    }
    Vec2 velocity(double v) const {
        return {(3.0 * x[3] * v + 2.0 * x[2]) * v + x[1],
                (3.0 * y[3] * v + 2.0 * y[2]) * v + y[1]};
    }
    Vec2 acceleration(double v) const {
        return {6.0 * x[3] * v + 2.0 * x[2], 6.0 * y[3] * v + 2.0 * y[2]};
    }
};

// Taylor coefficients [power][function] of the basis functions that live on one span.
using BasisTaylor = std::array<std::array<double, kSectionTerms>, kSectionTerms>;

// Those of span k about the origin, by the Cox-de Boor recursion on polynomials: each function of
// one degree less, over the width of its support, is part of two neighbours.
template <int Degree>
BasisTaylor basis_taylor(const double *knots, std::size_t k, double origin) {
    std::array<std::array<double, kSectionTerms>, kSectionTerms> basis{};  // [function][power]
    basis[0][0] = 1.0;
    for (int d = 1; d <= Degree; ++d) {
        std::array<double, kSectionTerms> falling{};
        for (int l = 0; l < d; ++l) {
            const double begin = knots[k + l + 1 - d] - origin, end = knots[k + l + 1] - origin;
            const double part = 1.0 / (end - begin);
            auto next = falling;
            falling = {};
            for (int q = 0; q < d; ++q) {
                const double share = part * basis[l][q];
                next[q] += end * share;
                next[q + 1] -= share;
                falling[q] -= begin * share;
                falling[q + 1] += share;
            }
            basis[l] = next;
        }
        basis[d] = falling;
    }
    BasisTaylor taylor{};
    for (int l = 0; l <= Degree; ++l)
        for (int q = 0; q <= Degree; ++q) taylor[q][l] = basis[l][q];
    return taylor;
}

// Knots and control points of one section inside larger arrays.
struct SectionView {
    int degree;
    std::size_t n_points;
    const double *knots;
    const Vec2 *points;

    std::size_t n_spans() const { return n_points - degree; }
    std::size_t n_interior_knots() const { return n_spans() - 1; }
    double span_begin(std::size_t s) const { return knots[degree + s]; }
    double span_end(std::size_t s) const { return knots[degree + s + 1]; }

    BasisTaylor taylor(std::size_t s) const {
        // Without interior knots the basis is Bernstein's, whose coefficients are known.
        if (n_spans() == 1) {
            if (degree == 1) return {{{1, 0, 0, 0}, {-1, 1, 0, 0}, {}, {}}};
            if (degree == 2) return {{{1, 0, 0, 0}, {-2, 2, 0, 0}, {1, -2, 1, 0}, {}}};
            return {{{1, 0, 0, 0}, {-3, 3, 0, 0}, {3, -6, 3, 0}, {-1, 3, -3, 1}}};
        }
        if (degree == 1) return basis_taylor<1>(knots, 1 + s, span_begin(s));
        if (degree == 2) return basis_taylor<2>(knots, 2 + s, span_begin(s));
        return basis_taylor<3>(knots, 3 + s, span_begin(s));
    }
};

inline SectionView view(const Section &section) {
    return {section.degree, section.points.size(), section.knots.data(), section.points.data()};
}

// Basis and polynomial of every span.
inline void expand_spans(const SectionView &section, BasisTaylor *taylor, SpanPolynomial *spans) {
    for (std::size_t s = 0; s < section.n_spans(); ++s) {
        taylor[s] = section.taylor(s);
        SpanPolynomial &span = spans[s];
        span = {section.span_begin(s), section.span_end(s) - section.span_begin(s), {}, {}};
        for (int q = 0; q <= section.degree; ++q)
            for (int l = 0; l <= section.degree; ++l) {
                span.x[q] += taylor[s][q][l] * section.points[s + l].x;
                span.y[q] += taylor[s][q][l] * section.points[s + l].y;
            }
    }
}

// Span and offset of a parameter, walking from a span that is near.
inline int walk_to_span(const SpanPolynomial *spans, int n_spans, int s, double u) {
    while (s > 0 && u < spans[s].begin) --s;
    while (s < n_spans - 1 && u >= spans[s + 1].begin) ++s;
    return s;
}

// A straight section between two nodes.
inline Section line_section(Vec2 begin, Vec2 end, Index first, Index last,
                            std::span<const Vec2> data) {
    Section line;
    line.knots = {0.0, 0.0, 1.0, 1.0};
    line.points = {begin, end};
    line.first = first;
    line.last = last;
    const Vec2 along = end - begin;
    const double length_sq = norm_sq(along);
    line.parameters.resize(line.count());
    for (Index j = first; j <= last; ++j) {
        const double u = length_sq > 0.0 ? dot(data[j] - begin, along) / length_sq : 0.0;
        line.parameters[j - first] = std::fmin(1.0, std::fmax(0.0, u));
    }
    return line;
}

}  // namespace shapespline::pieces
