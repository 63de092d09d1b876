// The envelope factorisation against Gaussian elimination of the full matrix.
#include "check.hpp"
#include "shapespline/base/envelope.hpp"

using shapespline::EnvelopeMatrix;
using Dense = std::vector<std::vector<double>>;

namespace {

std::vector<double> solved_by_elimination(Dense a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
        std::swap(a[k], a[pivot]);
        std::swap(b[k], b[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

// Diagonally dominant, so its condition is small and both solutions are good to rounding.
void compare(const std::vector<std::size_t> &first_column, std::mt19937 &random) {
    std::uniform_real_distribution<double> entry(-1.0, 1.0);
    const std::size_t n = first_column.size();
    EnvelopeMatrix matrix(first_column);
    Dense full(n, std::vector<double>(n, 0.0));
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = entry(random);
        for (std::size_t j = first_column[i]; j < i; ++j)
            matrix.at(i, j) = full[i][j] = full[j][i] = entry(random);
        matrix.at(i, i) = full[i][i] = static_cast<double>(2 * n);
    }
    const std::vector<double> expected = solved_by_elimination(full, x);
    CHECK(matrix.factorize());
    matrix.solve(x);
    for (std::size_t i = 0; i < n; ++i) CHECK_NEAR(x[i], expected[i], 1e-14);
}

}  // namespace

TEST(banded_cyclic_and_dense_envelopes_solve) {
    std::mt19937 random(1);
    for (const std::size_t n : {1, 2, 3, 8, 21}) {
        std::vector<std::size_t> banded(n), cyclic(n), dense(n, 0), diagonal(n);
        for (std::size_t i = 0; i < n; ++i) {
            banded[i] = i < 3 ? 0 : i - 3;
            cyclic[i] = i + 3 >= n ? 0 : banded[i];
            diagonal[i] = i;
        }
        for (const auto &first : {banded, cyclic, dense, diagonal}) compare(first, random);
    }
}

TEST(an_indefinite_matrix_is_refused) {
    EnvelopeMatrix matrix({0, 0});
    matrix.at(0, 0) = matrix.at(1, 1) = 1.0;
    matrix.at(1, 0) = 2.0;
    CHECK(!matrix.factorize());
    EnvelopeMatrix not_a_number({0});
    not_a_number.at(0, 0) = std::nan("");
    CHECK(!not_a_number.factorize());
}
