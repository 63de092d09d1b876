// Normal equations of one section with the foot parameters eliminated and the knots free.
//
// Each parameter meets only its own residual r, so it is eliminated exactly: what is left of a
// point is W = I - T T' / (|T|^2 (1 + damping)), T the tangent (Schur complement, as in orthogonal
// distance regression). On a span the curve is a polynomial in v, and so is its derivative with
// respect to a knot: moments of W v^q and W r v^q serve all unknowns, and points are visited once.
#pragma once

#include <array>
#include <vector>

#include "shapespline/curve/moments.hpp"
#include "shapespline/pieces/section_feet.hpp"

namespace shapespline::pieces {

class SectionNormal {
  public:
    // Local unknowns: x and y of every control point, then the interior knots.
    std::size_t size() const { return size_; }
    // An entry of the lower triangle: j <= i.
    double matrix(std::size_t i, std::size_t j) const { return matrix_[i * size_ + j]; }
    double gradient(std::size_t i) const { return gradient_[i]; }

    // Data, weights and feet begin at the datum `base`. With eliminate false the parameters stay:
    // ordinary linear least squares.
    void assemble(const SectionView &section, const BasisTaylor *taylor,
                  const SpanPolynomial *spans, const Vec2 *data, const double *weights,
                  std::span<const Index> active, Index base, const Feet &feet, double damping,
                  bool eliminate, bool free_knots) {
        const std::size_t n_knots = free_knots ? section.n_interior_knots() : 0;
        size_ = 2 * section.n_points + n_knots;
        matrix_.assign(size_ * size_, 0.0);
        gradient_.assign(size_, 0.0);
        const auto run = [&]<int Degree>() {
            moments_.assign(section.n_spans(), {});
            knots_.assign(section.knots, section.knots + section.n_points + Degree + 1);
            for (const Index at : active) {
                const Index j = at - base;
                add_datum<Degree>(moments_[feet.spans[j]], spans[feet.spans[j]], data[j],
                                  weights[j], feet.parameters[j], damping, eliminate);
            }
            for (std::size_t s = 0; s < section.n_spans(); ++s) {
                add_points<Degree>(taylor[s], s);
                if (n_knots > 0) add_knots<Degree>(section, taylor[s], s);
            }
        };
        if (section.degree == 1) run.template operator()<1>();
        if (section.degree == 2) run.template operator()<2>();
        if (section.degree == 3) run.template operator()<3>();
    }

  private:
    // Rows of a length that processors add at once; the last number of some stays unused. Powers
    // are products of halves: not those of SpanMoments (KER-05).
    static constexpr int kPowers = 2 * kSectionTerms;
    using Powers = std::array<double, kPowers>;
    using Terms = std::array<double, kSectionTerms>;
    struct Moments {
        Powers xx, xy, yy;
        Terms x, y;
    };
    // How the polynomial of the span changes with one knot.
    struct Column {
        std::size_t unknown;
        Terms x, y;
    };

    template <int Degree>
    static void add_datum(Moments &m, const SpanPolynomial &span, Vec2 q, double weight,
                          double parameter, double damping, bool eliminate) {
        const double v = parameter - span.begin;
        const Vec2 t = span.velocity(v), r = span.point(v) - q;
        const double h = eliminate ? 1.0 / (norm_sq(t) * (1.0 + damping) + 1e-300) : 0.0;
        const double along = dot(r, t) * h;
        const double wxx = (1.0 - t.x * t.x * h) * weight, wxy = -t.x * t.y * h * weight,
                     wyy = (1.0 - t.y * t.y * h) * weight;
        const double wx = (r.x - t.x * along) * weight, wy = (r.y - t.y * along) * weight;
        constexpr int n_powers = 2 * (Degree + 1), n_terms = Degree == 2 ? 4 : Degree + 1;
        Powers power{1.0, v};
        for (int k = 2; k < n_powers; ++k) power[k] = power[k / 2] * power[k - k / 2];
        for (int k = 0; k < n_powers; ++k) m.xx[k] += wxx * power[k];
        for (int k = 0; k < n_powers; ++k) m.xy[k] += wxy * power[k];
        for (int k = 0; k < n_powers; ++k) m.yy[k] += wyy * power[k];
        for (int k = 0; k < n_terms; ++k) m.x[k] += wx * power[k];
        for (int k = 0; k < n_terms; ++k) m.y[k] += wy * power[k];
    }

    void add(std::size_t i, std::size_t j, double value) { matrix_[i * size_ + j] += value; }

    template <int Degree>
    void add_points(const BasisTaylor &taylor, std::size_t s) {
        const Moments &m = moments_[s];
        std::array<BasisFunction<Degree>, Degree + 1> basis;
        for (int l = 0; l <= Degree; ++l)
            for (int q = 0; q <= Degree; ++q) basis[l][q] = taylor[q][l];
        for (int l = 0; l <= Degree; ++l) {
            const std::size_t row = 2 * (s + l);
            double slope_x = 0.0, slope_y = 0.0;
            for (int q = 0; q <= Degree; ++q) {
                slope_x += basis[l][q] * m.x[q];
                slope_y += basis[l][q] * m.y[q];
            }
            gradient_[row] += slope_x;
            gradient_[row + 1] += slope_y;
            const WeighedFunction<Degree> weighed(m, basis[l]);
            for (int other = 0; other <= l; ++other) {
                const Weight2 block = weighed.times(basis[other]);
                const std::size_t column = 2 * (s + other);
                add(row, column, block.xx);
                add(row + 1, column, block.xy);
                if (other < l) add(row, column + 1, block.xy);
                add(row + 1, column + 1, block.yy);
            }
        }
    }

    // Knots by difference quotients of the span's basis, its origin held; exact enough, for the
    // basis is a rational function of the knots and the step is 1e-5 of the intervals beside them.
    template <int Degree>
    void add_knots(const SectionView &section, const BasisTaylor &taylor, std::size_t s) {
        columns_.clear();
        for (std::size_t i = std::max<std::size_t>(Degree + 1, s + 1);
             i < std::min<std::size_t>(section.n_points, s + 2 * Degree + 1); ++i) {
            const double u = knots_[i];
            const double step = 1e-5 * std::min(knots_[i + 1] - u, u - knots_[i - 1]) + 1e-12;
            const double part = 1.0 / step;
            knots_[i] = u + step;
            const BasisTaylor moved =
                basis_taylor<Degree>(knots_.data(), Degree + s, section.span_begin(s));
            knots_[i] = u;
            Column column{2 * section.n_points + i - Degree - 1, {}, {}};
            for (int q = 0; q <= Degree; ++q)
                for (int l = 0; l <= Degree; ++l) {
                    const double slope = (moved[q][l] - taylor[q][l]) * part;
                    column.x[q] += slope * section.points[s + l].x;
                    column.y[q] += slope * section.points[s + l].y;
                }
            columns_.push_back(column);
            add_knot<Degree>(taylor, s);
        }
    }

    // The last of the columns with itself, those before it, and the points.
    template <int Degree>
    void add_knot(const BasisTaylor &taylor, std::size_t s) {
        const Moments &m = moments_[s];
        const Column &knot = columns_.back();
        Terms hx{}, hy{};
        for (int q = 0; q <= Degree; ++q) {
            for (int r = 0; r <= Degree; ++r) {
                hx[q] += m.xx[q + r] * knot.x[r] + m.xy[q + r] * knot.y[r];
                hy[q] += m.xy[q + r] * knot.x[r] + m.yy[q + r] * knot.y[r];
            }
            gradient_[knot.unknown] += knot.x[q] * m.x[q] + knot.y[q] * m.y[q];
        }
        for (int l = 0; l <= Degree; ++l) {
            double sum_x = 0.0, sum_y = 0.0;
            for (int q = 0; q <= Degree; ++q) {
                sum_x += taylor[q][l] * hx[q];
                sum_y += taylor[q][l] * hy[q];
            }
            add(knot.unknown, 2 * (s + l), sum_x);
            add(knot.unknown, 2 * (s + l) + 1, sum_y);
        }
        for (const Column &other : columns_) {
            double sum = 0.0;
            for (int q = 0; q <= Degree; ++q) sum += other.x[q] * hx[q] + other.y[q] * hy[q];
            add(knot.unknown, other.unknown, sum);
        }
    }

    std::size_t size_ = 0;
    std::vector<double> matrix_, gradient_, knots_;
    std::vector<Moments> moments_;
    std::vector<Column> columns_;
};

}  // namespace shapespline::pieces
