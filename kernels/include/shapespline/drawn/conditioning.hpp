// An equation between unknowns that are estimated: whether it holds by Wald's test (1943), and the
// estimate and its covariance once it does (a Kalman step, one row after the other).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "shapespline/drawn/equations.hpp"

namespace shapespline::drawn {

struct EquationLimits {
    double largest;         // square of the standard errors that one row may be off by
    double largest_each;    // of several rows each has this part of it
    double span;            // what its values could be, by which it must surprise; 0: it need not
    double least_surprise;  // nats
    double implied;         // part of the largest variance below which there is none: a row follows
    double met;             // how far a row that follows may be off
};

// Whether an equation holds at x (n); then x and `covariance` (n by n) are conditioned by it.
inline bool take_equation(std::span<double> x, std::span<double> covariance,
                          const Equation &equation, const EquationLimits &limits) {
    const Linearised now = linearised({&equation, 1}, x);
    const std::span<const double> values = now.values(), rows = now.rows();
    const std::size_t n = x.size();
    std::vector<std::size_t> index;  // the unknowns that it joins
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < values.size(); ++k)
            if (rows[k * n + i] != 0.0) {
                index.push_back(i);
                break;
            }
    double widest = 0.0;
    for (const std::size_t i : index) widest = std::max(widest, covariance[i * n + i]);
    const double none = limits.implied * widest + 1e-300;
    struct Told {
        std::vector<double> gain;  // the covariance of all unknowns with the row
        double off, variance;
    };
    std::vector<Told> told;
    double statistic = 0.0, surprise = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto row = rows.subspan(k * n, n);
        const auto along = [&](const std::vector<double> &gain) {
            double sum = 0.0;
            for (const std::size_t a : index) sum += row[a] * gain[a];
            return sum;
        };
        Told one{std::vector<double>(n), values[k], 0.0};
        for (const std::size_t a : index)
            for (std::size_t i = 0; i < n; ++i) one.gain[i] += row[a] * covariance[a * n + i];
        for (const Told &before : told) {
            const double share = along(before.gain) / before.variance;
            one.off -= share * before.off;
            for (std::size_t i = 0; i < n; ++i) one.gain[i] -= share * before.gain[i];
        }
        one.variance = along(one.gain);
        if (!(one.variance > none)) {
            if (std::abs(one.off) > limits.met) return false;
            continue;
        }
        statistic += one.off * one.off / one.variance;
        if (limits.span > 0.0)
            surprise += std::log(limits.span / std::sqrt(2 * std::numbers::pi * one.variance));
        told.push_back(std::move(one));
    }
    if (told.empty()) return true;
    const double count = static_cast<double>(told.size());
    if (statistic > limits.largest * (told.size() == 1 ? 1.0 : limits.largest_each * count))
        return false;
    if (limits.span > 0.0 && surprise - 0.5 * statistic < limits.least_surprise) return false;
    for (const Told &one : told) {
        for (std::size_t i = 0; i < n; ++i) {
            if (one.gain[i] == 0.0) continue;
            const double share = one.gain[i] / one.variance;
            x[i] -= share * one.off;
            for (std::size_t j = 0; j < n; ++j) covariance[i * n + j] -= share * one.gain[j];
        }
    }
    return true;
}

}  // namespace shapespline::drawn
