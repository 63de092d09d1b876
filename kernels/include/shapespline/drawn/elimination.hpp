// The steps that meet linear equations: one of them, and a basis of all (Gauss's elimination, the
// largest entry first; each equation takes one unknown out of those that are left).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace shapespline::drawn {

// Equations `values` + `rows` step = 0, row by row over n unknowns, each counted in its unit. An
// equation that leaves less than the part `implied` of its entries follows from those before.
// Written: `onto`, a step that meets all, and `basis`, n by n, whose columns are the basis where
// they are free, else zero. Told: which are free.
inline std::vector<char> null_space(std::span<const double> values, std::span<const double> rows,
                                    std::span<const double> units, double implied,
                                    std::span<double> onto, std::span<double> basis) {
    const std::size_t n = units.size();
    std::vector<char> free(n, 1);
    std::vector<double> told(n);
    std::fill(onto.begin(), onto.end(), 0.0);
    std::fill(basis.begin(), basis.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i) basis[i * n + i] = units[i];
    for (std::size_t k = 0; k < values.size(); ++k) {
        const std::span<const double> row = rows.subspan(k * n, n);
        double value = values[k], largest = 0.0;
        std::fill(told.begin(), told.end(), 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            if (row[i] == 0.0) continue;
            value += row[i] * onto[i];
            largest = std::max(largest, std::abs(row[i] * units[i]));
            for (std::size_t j = 0; j < n; ++j) told[j] += row[i] * basis[i * n + j];
        }
        std::size_t pivot = 0;
        for (std::size_t j = 1; j < n; ++j)
            if (std::abs(told[j]) > std::abs(told[pivot])) pivot = j;
        if (!(std::abs(told[pivot]) > implied * largest)) continue;
        for (std::size_t i = 0; i < n; ++i) {
            const double share = basis[i * n + pivot] / told[pivot];
            if (share == 0.0) continue;
            onto[i] -= share * value;
            for (std::size_t j = 0; j < n; ++j) basis[i * n + j] -= share * told[j];
            basis[i * n + pivot] = 0.0;
        }
        free[pivot] = 0;
    }
    return free;
}

}  // namespace shapespline::drawn
