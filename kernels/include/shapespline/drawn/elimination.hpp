// The steps that meet linear equations (Gauss, the largest entry first; each equation
// takes one unknown out of those that are left), and of these the best.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace shapespline::drawn {

// All steps that meet equations: one of them, and a basis of what may be added.
class MeetingSteps {
  public:
    // Equations `values` + `rows` step = 0, row by row over n unknowns, each counted in its unit.
    // An equation that leaves less than the part `implied` of its entries follows from others.
    MeetingSteps(std::span<const double> values, std::span<const double> rows,
                 std::span<const double> units, double implied)
        : n_(units.size()), onto_(n_, 0.0) {
        std::vector<double> basis(n_ * n_, 0.0), told(n_);
        std::vector<char> free(n_, 1);
        for (std::size_t i = 0; i < n_; ++i) basis[i * n_ + i] = units[i];
        for (std::size_t k = 0; k < values.size(); ++k) {
            const std::span<const double> row = rows.subspan(k * n_, n_);
            double value = values[k], largest = 0.0;
            std::fill(told.begin(), told.end(), 0.0);
            for (std::size_t i = 0; i < n_; ++i) {
                if (row[i] == 0.0) continue;
                value += row[i] * onto_[i];
                largest = std::max(largest, std::abs(row[i] * units[i]));
                for (std::size_t j = 0; j < n_; ++j) told[j] += row[i] * basis[i * n_ + j];
            }
            std::size_t pivot = 0;
            for (std::size_t j = 1; j < n_; ++j)
                if (std::abs(told[j]) > std::abs(told[pivot])) pivot = j;
            if (!(std::abs(told[pivot]) > implied * largest)) continue;
            for (std::size_t i = 0; i < n_; ++i) {
                const double share = basis[i * n_ + pivot] / told[pivot];
                if (share == 0.0) continue;
                onto_[i] -= share * value;
                for (std::size_t j = 0; j < n_; ++j) basis[i * n_ + j] -= share * told[j];
                basis[i * n_ + pivot] = 0.0;
            }
            free[pivot] = 0;
        }
        for (std::size_t j = 0; j < n_; ++j)
            if (free[j]) ++n_free_;
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j)
                if (free[j]) basis_.push_back(basis[i * n_ + j]);
    }

    std::size_t n_free() const { return n_free_; }

    // The one that lowers gradient' step + 1/2 step' matrix step most. Unknowns that no data tell,
    // of a motion that is determined, stay.
    void best(std::span<const double> matrix, std::span<const double> gradient,
              std::span<double> step) const {
        const std::size_t m = n_free_;
        std::vector<double> down(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            down[i] = -gradient[i];
            for (std::size_t j = 0; j < n_; ++j) down[i] -= matrix[i * n_ + j] * onto_[j];
        }
        std::vector<double> way(m, 0.0);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t a = 0; a < m; ++a) way[a] += basis_[i * m + a] * down[i];
        std::vector<double> told = reduced(matrix);
        double trace = 0.0;
        for (std::size_t a = 0; a < m; ++a) trace += told[a * m + a];
        for (std::size_t a = 0; a < m; ++a) told[a * m + a] += kNothing * std::max(trace, 1e-300);
        const std::vector<double> factor = factor_of(std::move(told));
        for (std::size_t a = 0; a < m; ++a) {
            for (std::size_t b = 0; b < a; ++b) way[a] -= factor[a * m + b] * way[b];
            way[a] *= factor[a * m + a];
        }
        for (std::size_t a = m; a-- > 0;) {
            for (std::size_t b = a + 1; b < m; ++b) way[a] -= factor[b * m + a] * way[b];
            way[a] *= factor[a * m + a];
        }
        for (std::size_t i = 0; i < n_; ++i) {
            step[i] = onto_[i];
            for (std::size_t a = 0; a < m; ++a) step[i] += basis_[i * m + a] * way[a];
        }
    }

    // The covariance of an estimate that meets the equations, from its inverse without them.
    void covariance(std::span<const double> precision, std::span<double> covariance) const {
        const std::size_t m = n_free_;
        const std::vector<double> factor = factor_of(reduced(precision));
        std::vector<double> scaled(n_ * m);  // basis over the transposed factor
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t a = 0; a < m; ++a) {
                double rest = basis_[i * m + a];
                for (std::size_t b = 0; b < a; ++b) rest -= factor[a * m + b] * scaled[i * m + b];
                scaled[i * m + a] = rest * factor[a * m + a];
            }
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = 0.0;
                for (std::size_t a = 0; a < m; ++a) sum += scaled[i * m + a] * scaled[j * m + a];
                covariance[i * n_ + j] = covariance[j * n_ + i] = sum;
            }
    }

  private:
    static constexpr double kNothing = 1e-12;  // of the trace

    // A matrix over the free unknowns.
    std::vector<double> reduced(std::span<const double> matrix) const {
        const std::size_t m = n_free_;
        std::vector<double> found(m * m, 0.0), row(m);
        for (std::size_t i = 0; i < n_; ++i) {
            std::fill(row.begin(), row.end(), 0.0);
            for (std::size_t j = 0; j < n_; ++j) {
                const double entry = matrix[i * n_ + j];
                if (entry == 0.0) continue;
                for (std::size_t a = 0; a < m; ++a) row[a] += entry * basis_[j * m + a];
            }
            for (std::size_t a = 0; a < m; ++a) {
                const double share = basis_[i * m + a];
                if (share == 0.0) continue;
                for (std::size_t b = 0; b < m; ++b) found[a * m + b] += share * row[b];
            }
        }
        return found;
    }

    // Cholesky's lower factor, its diagonal inverted; 0 where rounding leaves nothing.
    std::vector<double> factor_of(std::vector<double> a) const {
        const std::size_t m = n_free_;
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double rest = a[i * m + j];
                for (std::size_t k = 0; k < j; ++k) rest -= a[i * m + k] * a[j * m + k];
                if (j < i)
                    a[i * m + j] = rest * a[j * m + j];
                else
                    a[i * m + i] = rest > 0.0 ? 1.0 / std::sqrt(rest) : 0.0;
            }
        return a;
    }

    std::size_t n_, n_free_ = 0;
    std::vector<double> onto_, basis_;  // n, and n rows of n_free
};

}  // namespace shapespline::drawn
