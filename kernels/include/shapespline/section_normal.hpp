// Normal equations of one section with the foot parameters eliminated and the knots free.
//
// Each parameter meets only its own residual r, so it is eliminated exactly: what is left of a
// point is W = I - T T' / (|T|^2 (1 + damping)), T the tangent (METHOD 4). On a span the curve is
// a cubic in v, and so is its derivative with respect to a knot: moments of W v^q (q to 6) and
// W r v^q (q to 3) serve all unknowns, and points are visited once.
#pragma once

#include <array>
#include <vector>

#include "shapespline/section_feet.hpp"

namespace shapespline {

class SectionNormal {
  public:
    // Local unknowns: x and y of every control point, then the interior knots.
    std::size_t size() const { return size_; }
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
        moments_.assign(section.n_spans(), {});
        for (const Index at : active) {
            const Index j = at - base;
            add_point(moments_[feet.spans[j]], spans[feet.spans[j]], data[j], weights[j],
                      feet.parameters[j], damping, eliminate);
        }
        for (std::size_t s = 0; s < section.n_spans(); ++s) {
            columns_.clear();
            add_point_columns(section, taylor[s], s);
            if (n_knots > 0) add_knot_columns(section, taylor[s], s);
            scatter(moments_[s]);
        }
    }

  private:
    static constexpr int kPowers = 2 * kSectionTerms - 1;
    struct Moments {
        std::array<double, kPowers> xx, xy, yy;
        std::array<double, kSectionTerms> x, y;
    };
    // How the polynomial of the span changes with one unknown.
    struct Column {
        std::size_t unknown;
        std::array<double, kSectionTerms> x, y;
    };

    static void add_point(Moments &m, const SpanPolynomial &span, Vec2 q, double weight,
                          double parameter, double damping, bool eliminate) {
        const double v = parameter - span.begin;
        const Vec2 t = span.velocity(v), r = span.point(v) - q;
        const double h = eliminate ? 1.0 / (norm_sq(t) * (1.0 + damping) + 1e-300) : 0.0;
        const double along = dot(r, t) * h;
        const double wxx = (1.0 - t.x * t.x * h) * weight, wxy = -t.x * t.y * h * weight,
                     wyy = (1.0 - t.y * t.y * h) * weight;
        const double wx = (r.x - t.x * along) * weight, wy = (r.y - t.y * along) * weight;
        double power = 1.0;
        for (int k = 0; k < kPowers; ++k) {
            m.xx[k] += wxx * power;
            m.xy[k] += wxy * power;
            m.yy[k] += wyy * power;
            if (k < kSectionTerms) {
                m.x[k] += wx * power;
                m.y[k] += wy * power;
            }
            power *= v;
        }
    }

    void add_point_columns(const SectionView &section, const BasisTaylor &taylor, std::size_t s) {
        for (int l = 0; l <= section.degree; ++l) {
            Column x{2 * (s + l), {}, {}}, y{2 * (s + l) + 1, {}, {}};
            for (int q = 0; q < kSectionTerms; ++q) x.x[q] = y.y[q] = taylor[q][l];
            columns_.push_back(x);
            columns_.push_back(y);
        }
    }

    // Knots by difference quotients of the span's basis, its origin held; exact enough, for the
    // basis is a rational function of the knots and the step is 1e-5 of the gaps beside them.
    void add_knot_columns(const SectionView &section, const BasisTaylor &taylor, std::size_t s) {
        const std::size_t p = section.degree;
        knots_.assign(section.knots, section.knots + section.n_points + p + 1);
        for (std::size_t i = std::max(p + 1, s + 1); i < std::min(section.n_points, s + 2 * p + 1);
             ++i) {
            const double u = knots_[i];
            const double step = 1e-5 * std::min(knots_[i + 1] - u, u - knots_[i - 1]) + 1e-12;
            knots_[i] = u + step;
            const BasisTaylor moved =
                basis_taylor(knots_.data(), section.degree, p + s, section.span_begin(s));
            knots_[i] = u;
            Column column{2 * section.n_points + i - p - 1, {}, {}};
            for (int q = 0; q < kSectionTerms; ++q)
                for (std::size_t l = 0; l <= p; ++l) {
                    const double slope = (moved[q][l] - taylor[q][l]) / step;
                    column.x[q] += slope * section.points[s + l].x;
                    column.y[q] += slope * section.points[s + l].y;
                }
            columns_.push_back(column);
        }
    }

    // Adds G' H G and G' g of one span, G the columns.
    void scatter(const Moments &m) {
        for (std::size_t a = 0; a < columns_.size(); ++a) {
            const Column &column = columns_[a];
            std::array<double, kSectionTerms> hx{}, hy{};
            double slope = 0.0;
            for (int q = 0; q < kSectionTerms; ++q) {
                for (int r = 0; r < kSectionTerms; ++r) {
                    hx[q] += m.xx[q + r] * column.x[r] + m.xy[q + r] * column.y[r];
                    hy[q] += m.xy[q + r] * column.x[r] + m.yy[q + r] * column.y[r];
                }
                slope += column.x[q] * m.x[q] + column.y[q] * m.y[q];
            }
            gradient_[column.unknown] += slope;
            for (std::size_t c = a; c < columns_.size(); ++c) {
                double sum = 0.0;
                for (int q = 0; q < kSectionTerms; ++q)
                    sum += columns_[c].x[q] * hx[q] + columns_[c].y[q] * hy[q];
                matrix_[column.unknown * size_ + columns_[c].unknown] += sum;
                if (c != a) matrix_[columns_[c].unknown * size_ + column.unknown] += sum;
            }
        }
    }

    std::size_t size_ = 0;
    std::vector<double> matrix_, gradient_, knots_;
    std::vector<Moments> moments_;
    std::vector<Column> columns_;
};

}  // namespace shapespline
