// Lines and circles nearest to their points under equations: Gauss and Newton's method on distances
// across, in the null space of the linearised equations.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/drawn/elements.hpp"
#include "shapespline/drawn/elimination.hpp"
#include "shapespline/drawn/equations.hpp"

namespace shapespline::drawn {

struct EstimateLimits {
    int rounds;
    double extent;        // of the outline
    double least_step;    // in parts of it: a shorter one is the last
    double longest_step;  // in parts of it, or of the largest unknown: none is longer
    double implied;       // an equation follows from others if it leaves less of its entries
};

// The steps from x that meet equations, linearised there.
inline MeetingSteps meeting_steps(const Elements &elements, std::span<const Equation> equations,
                                  std::span<const double> x, double extent, double implied) {
    const Linearised told = linearised(equations, x);
    return {told.values(), told.rows(), elements.units(x.size(), extent), implied};
}

// The best estimate, from x on and written there.
inline void estimate(const Elements &elements, std::span<const Equation> equations,
                     std::span<double> x, const EstimateLimits &limits) {
    const std::size_t n = x.size();
    std::vector<double> step(n);
    for (int round = 0; round < limits.rounds; ++round) {
        std::vector<double> matrix(n * n, 0.0), gradient(n, 0.0);
        elements.normal(x, matrix, gradient);
        meeting_steps(elements, equations, x, limits.extent, limits.implied)
            .best(matrix, gradient, step);
        double largest = 0.0, farthest = limits.extent;
        for (std::size_t i = 0; i < n; ++i) {
            largest = std::max(largest, std::abs(step[i]));
            farthest = std::max(farthest, std::abs(x[i]));
        }
        const double far = limits.longest_step * farthest;
        const double part = std::min(1.0, far / std::max(largest, 1e-300));
        for (std::size_t i = 0; i < n; ++i) x[i] += part * step[i];
        if (largest < limits.least_step * limits.extent) return;
    }
}

}  // namespace shapespline::drawn
