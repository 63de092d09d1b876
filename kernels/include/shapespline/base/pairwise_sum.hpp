// Sums by halves, whose rounding grows with the logarithm of the count alone (Higham 1993), in the
// order in which NumPy forms them: what was worked out there keeps its bits here.
#pragma once

#include <cstddef>
#include <span>

namespace shapespline {

inline double pairwise_sum(std::span<const double> values) {
    constexpr std::size_t kLanes = 8, kBlock = 128;
    const std::size_t n = values.size();
    if (n > kBlock) {
        const std::size_t half = n / 2 - n / 2 % kLanes;
        return pairwise_sum(values.first(half)) + pairwise_sum(values.subspan(half));
    }
    double sum = 0.0;
    std::size_t i = 0;
    if (n >= kLanes) {
        double r[kLanes] = {};
        for (; i + kLanes <= n; i += kLanes)
            for (std::size_t k = 0; k < kLanes; ++k) r[k] += values[i + k];
        sum = ((r[0] + r[1]) + (r[2] + r[3])) + ((r[4] + r[5]) + (r[6] + r[7]));
    }
    for (; i < n; ++i) sum += values[i];
    return sum;
}

}  // namespace shapespline
