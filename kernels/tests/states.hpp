// Random splines in the form that knot removal works on, with data on them.
#pragma once

#include <random>

#include "shapes.hpp"
#include "shapespline/spline/state.hpp"

// Some intervals are empty where the degree allows; data begin on some span of a closed one.
template <int Degree>
shapespline::spline::SplineState<Degree> random_state(std::mt19937 &random, int m, bool closed) {
    constexpr int kData = 60;
    std::uniform_real_distribution<double> width(0.2, 1.0);
    shapespline::spline::SplineState<Degree> state;
    state.closed = closed;
    state.points = random_walk(random, m);
    for (int k = 0; k < (closed ? m : m + Degree); ++k) {
        const bool clamped = !closed && (k < Degree || k >= m);
        const bool may_repeat = Degree > 1 && k > state.all_spans().begin && k + 1 < m &&
                                state.intervals.back() > 0.0;
        const bool empty = clamped || (may_repeat && random() % 4 == 0);
        state.intervals.push_back(empty ? 0.0 : width(random));
        state.knot_ids.push_back(k);
    }
    double total = 0.0;
    for (const double interval : state.intervals) total += interval;
    int span = closed ? static_cast<int>(random() % m) : Degree;
    while (!(state.interval(span) > 0.0)) ++span;
    double begin = 0.0;
    for (int j = 0; j < kData; ++j) {
        const double at = total * j / (closed ? kData : kData - 1);
        while (at > begin + state.interval(span) && (closed || span + 1 < m))
            begin += state.interval(span++);
        state.span.push_back(span);
        state.local_parameter.push_back(
            std::min(2.0 * (at - begin) / state.interval(span) - 1.0, 1.0));
    }
    state.normalize();
    return state;
}
