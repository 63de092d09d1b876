// Cholesky factorisation of a symmetric positive definite matrix in envelope (skyline) storage.
//
// Row i holds the entries from its first non-zero column to the diagonal. Fill-in stays inside the
// envelope (George and Liu 1981, chapter 4), so one routine serves banded, cyclic banded (the last
// rows reach back to column 0) and small dense matrices, in O(sum of squared row widths).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace shapespline {

class EnvelopeMatrix {
  public:
    // first_column[i] <= i is the first stored column of row i.
    explicit EnvelopeMatrix(std::vector<std::size_t> first_column)
        : first_(std::move(first_column)), offset_(first_.size() + 1, 0) {
        for (std::size_t i = 0; i < first_.size(); ++i)
            offset_[i + 1] = offset_[i] + (i - first_[i] + 1);
        values_.assign(offset_.back(), 0.0);
        inverse_.resize(first_.size());
    }

    std::size_t size() const { return first_.size(); }
    std::size_t first_column(std::size_t row) const { return first_[row]; }
    double &at(std::size_t row, std::size_t column) {
        return values_[offset_[row] + column - first_[row]];
    }

    // Row by row.
    std::span<double> values() { return values_; }

    // Those of a matrix with the same envelope.
    void take_values(const EnvelopeMatrix &other) {
        std::copy(other.values_.begin(), other.values_.end(), values_.begin());
    }

    void clear() { std::fill(values_.begin(), values_.end(), 0.0); }

    // Replaces the matrix by its Cholesky factor; false if it is not positive definite.
    bool factorize() {
        for (std::size_t i = 0; i < size(); ++i) {
            double *row_i = row(i);
            for (std::size_t j = first_[i]; j <= i; ++j) {
                const double *row_j = row(j);
                // Two sums: each product need not wait for the one before it.
                double sum = row_i[j], other = 0.0;
                std::size_t k = std::max(first_[i], first_[j]);
                for (; k + 1 < j; k += 2) {
                    sum -= row_i[k] * row_j[k];
                    other -= row_i[k + 1] * row_j[k + 1];
                }
                if (k < j) sum -= row_i[k] * row_j[k];
                sum += other;
                if (j < i) {
                    row_i[j] = sum * inverse_[j];
                } else {
                    if (!(sum > 0.0)) return false;
                    row_i[i] = std::sqrt(sum);
                    inverse_[i] = 1.0 / row_i[i];
                }
            }
        }
        return true;
    }

    // Solves L L' x = b in place; after factorize().
    void solve(std::span<double> x) {
        for (std::size_t i = 0; i < size(); ++i) {
            const double *row_i = row(i);
            for (std::size_t k = first_[i]; k < i; ++k) x[i] -= row_i[k] * x[k];
            x[i] *= inverse_[i];
        }
        for (std::size_t i = size(); i-- > 0;) {
            const double *row_i = row(i);
            x[i] *= inverse_[i];
            for (std::size_t k = first_[i]; k < i; ++k) x[k] -= row_i[k] * x[i];
        }
    }

  private:
    // Pointer that makes row(i)[j] the entry of column j.
    double *row(std::size_t i) { return values_.data() + offset_[i] - first_[i]; }

    std::vector<std::size_t> first_, offset_;
    std::vector<double> values_, inverse_;  // the factor's diagonal inverted: divisions are slow
};

}  // namespace shapespline
