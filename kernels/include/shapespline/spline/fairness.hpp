// What makes a spline fit for use, beside its distance: even intervals, no near-cusp, no new
// crossing, no hook.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/base/box_tree.hpp"
#include "shapespline/curve/flatten.hpp"
#include "shapespline/distance/crossings.hpp"
#include "shapespline/distance/hooks.hpp"
#include "shapespline/spline/search_polyline.hpp"
#include "shapespline/spline/span_shapes.hpp"

namespace shapespline::spline {

struct Fairness {
    double interval_ratio;    // largest over smallest non-empty span, at most
    double speed_ratio;  // slowest over median speed, at least
};

// Median of the speed over the parameter.
template <int Degree>
double median_speed(const ShapeRow<Degree> &all) {
    std::vector<std::pair<double, double>> weighted;  // speed, parameter that it stands for
    weighted.reserve(kSpeedSamples * all.size());
    double total = 0.0;
    for (const auto &[_, shape] : all) {
        for (const double speed : shape->speeds)
            weighted.emplace_back(speed, shape->interval / kSpeedSamples);
        total += shape->interval;
    }
    // Halves are parted until one value is left: of all of them only their order about it counts.
    auto low = weighted.begin(), high = weighted.end();
    double below = 0.0;
    while (high - low > 1) {
        const auto middle = low + (high - low) / 2;
        std::nth_element(low, middle, high,
                         [](const auto &a, const auto &b) { return a.first < b.first; });
        double sum = below;
        for (auto it = low; it != middle; ++it) sum += it->second;
        if (sum >= 0.5 * total) {
            high = middle;
        } else {
            low = middle;
            below = sum;
        }
    }
    return low == high ? 0.0 : low->first;
}

// The slowest speed, where it matters exactly: beside `critical`.
template <int Degree>
double slowest_speed(const ShapeRow<Degree> &spans, double critical) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const auto &[_, shape] : spans) slowest = std::min(slowest, shape->slowest(critical));
    return slowest;
}

// Ratio of the largest to the smallest non-empty interval.
template <int Degree>
double interval_ratio(const ShapeRow<Degree> &all) {
    double least = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (const auto &[_, shape] : all) {
        least = std::min(least, shape->interval);
        largest = std::max(largest, shape->interval);
    }
    return largest / least;
}

// With the spans beside that hooks reach into.
template <int Degree>
SpanRange with_beside(const SplineState<Degree> &state, SpanRange spans) {
    constexpr int kBeside = 2;
    const int begin = spans.begin - kBeside, end = spans.end + kBeside;
    if (state.closed) return {begin, std::min(end, begin + state.n_points())};
    return {std::max(begin, Degree), std::min(end, state.n_points())};
}

// Hooks of some spans; `search` are the data that the state knows the spans of.
template <int Degree>
long count_hooks(const SplineState<Degree> &state, const ShapeRow<Degree> &spans,
                 const ArcPolyline &search, TurningSteps &turning) {
    turning.clear();
    for (const PlacedShape<Degree> &placed : spans) {
        const SpanCurve<Degree> &curve = placed.shape->curve;
        turning.add(
            placed.span, [&](double u) { return curve.point(u); },
            [&](double u) { return curve.tangent(u); }, -1.0, 1.0, [](double, double, bool) {});
    }
    const long n = search.size();
    const auto places = turning.hooks([&](Vec2 place, long span) {
        // The foot may lie on a neighbour of the span.
        long from = state.first_data(static_cast<int>(span) - 1) - 1L;
        long to = state.first_data(static_cast<int>(span) + 2);
        if (!search.closed) {
            to = std::clamp(to, 1L, n - 1);
            from = std::clamp(from, 0L, to - 1);
        }
        return turn_about(
            place, [&](long j) { return search.point(static_cast<int>(j)); }, from, to,
            search.closed ? from - n : 0, search.closed ? to + n : n - 1, turning.data_reach());
    });
    return static_cast<long>(places.size());
}

// Crossings among the spans whose hull meets a box, of chords within a flatness of the curve.
template <int Degree>
int crossings(const ShapeRow<Degree> &all, const Box &box, double flatness) {
    constexpr int kLeast = 8, kMost = 64;
    constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    std::vector<Chord> chords;
    for (const auto &[_, shape] : all) {
        if (!shape->hull.meets(box)) continue;
        const SpanCurve<Degree> &curve = shape->curve;
        const auto b = curve.bezier().points;
        const double wanted = steps_wanted<Degree>(b, flatness, kNoLimit);
        const int n = static_cast<int>(std::clamp(std::ceil(wanted), 1.0 * kLeast, 1.0 * kMost));
        Vec2 begin = b[0];
        for (int i = 1; i <= n; ++i) {
            const Vec2 end = i < n ? curve.point(2.0 * i / n - 1.0) : b[Degree];
            chords.push_back({begin, end});
            begin = end;
        }
    }
    return count_crossings(std::span<const Chord>(chords));
}

}  // namespace shapespline::spline
