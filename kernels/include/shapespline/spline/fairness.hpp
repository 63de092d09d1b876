// What makes a spline fit for use, beside its distance: even intervals, no near-cusp, no new
// crossing, no hook.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/base/box_tree.hpp"
#include "shapespline/curve/flatten.hpp"
#include "shapespline/curve/span_basis.hpp"
#include "shapespline/distance/crossings.hpp"
#include "shapespline/distance/hooks.hpp"
#include "shapespline/spline/search_polyline.hpp"
#include "shapespline/spline/state.hpp"

namespace shapespline::spline {

struct Fairness {
    double interval_ratio;    // largest over smallest non-empty span, at most
    double speed_ratio;  // slowest over median speed, at least
};

// The curves of all spans of a state, in order; empty spans left out.
template <int Degree>
struct StateCurves {
    std::vector<SpanCurve<Degree>> curves;
    std::vector<double> intervals;
    std::vector<int> spans;  // unwrapped
    // Whether the curve goes on across a knot of multiplicity >= degree there.
    std::vector<char> sharp_start, sharp_end;

    explicit StateCurves(const SplineState<Degree> &state)
        : StateCurves(state, state.first_span(), state.n_points()) {}

    // Of spans begin .. end - 1 only, unwrapped.
    StateCurves(const SplineState<Degree> &state, int begin, int end) {
        std::array<double, 2 * Degree - 1> around;
        std::array<Vec2, Degree + 1> points;
        SpanBasis<Degree> basis;
        for (int k = begin; k < end; ++k) {
            if (!(state.interval(k) > 0.0)) continue;
            for (int g = 0; g < 2 * Degree - 1; ++g) around[g] = state.interval(k - Degree + 1 + g);
            for (int l = 0; l <= Degree; ++l) points[l] = state.point(k - Degree + l);
            basis.evaluate(&around[Degree - 1]);
            curves.emplace_back().combine(basis, points.data());
            intervals.push_back(state.interval(k));
            spans.push_back(k);
            const bool begins = !state.closed && k == Degree;
            const bool ends = !state.closed && k + 1 == state.n_points();
            sharp_start.push_back(!begins && empty_intervals(state, k - 1, -1) >= Degree - 1);
            sharp_end.push_back(!ends && empty_intervals(state, k + 1, 1) >= Degree - 1);
        }
    }

  private:
    static int empty_intervals(const SplineState<Degree> &state, int k, int direction) {
        int count = 0;
        const int size = static_cast<int>(state.intervals.size());
        while (count < Degree && (state.closed || (k >= 0 && k < size)) &&
               !(state.interval(k) > 0.0))
            ++count, k += direction;
        return count;
    }
};

inline constexpr int kSpeedSamples = 8;  // of every span

// Speed with respect to the parameter.
template <int Degree>
double speed(const StateCurves<Degree> &all, std::size_t span, double u) {
    return norm(all.curves[span].tangent(u)) * 2.0 / all.intervals[span];
}

// Median of the speed over the parameter.
template <int Degree>
double median_speed(const StateCurves<Degree> &all) {
    std::vector<std::pair<double, double>> weighted;  // speed, parameter that it stands for
    double total = 0.0;
    for (std::size_t s = 0; s < all.curves.size(); ++s) {
        for (int i = 0; i < kSpeedSamples; ++i)
            weighted.emplace_back(speed(all, s, (2.0 * i + 1.0) / kSpeedSamples - 1.0),
                                  all.intervals[s] / kSpeedSamples);
        total += all.intervals[s];
    }
    // Halves are parted until one value is left: of all of them only their order about it counts.
    auto low = weighted.begin(), high = weighted.end();
    double below = 0.0;
    while (high - low > 1) {
        const auto middle = low + (high - low) / 2;
        std::nth_element(low, middle, high);
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

// The slowest speed, where it matters exactly: the least sample of a span is refined unless it
// is many times `critical`, for samples alone are not enough beside a cusp. The neighbourhood of
// knots of multiplicity >= degree, where the curve may stand still, is left out.
template <int Degree>
double slowest_speed(const StateCurves<Degree> &all, double critical) {
    constexpr double kSuspect = 10.0;
    double slowest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < all.curves.size(); ++s) {
        const double begin = all.sharp_start[s] ? -0.9 : -1.0, end = all.sharp_end[s] ? 0.9 : 1.0;
        const double step = (end - begin) / kSpeedSamples;
        double least = std::numeric_limits<double>::infinity(), at = begin;
        for (int i = 0; i <= kSpeedSamples; ++i) {
            const double value = speed(all, s, begin + i * step);
            if (value < least) least = value, at = begin + i * step;
        }
        if (least < kSuspect * critical) {
            double low = std::max(begin, at - step), high = std::min(end, at + step);
            for (int i = 0; i < 24; ++i) {
                const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
                if (speed(all, s, a) < speed(all, s, b))
                    high = b;
                else
                    low = a;
            }
            least = std::min(least, speed(all, s, 0.5 * (low + high)));
        }
        slowest = std::min(slowest, least);
    }
    return slowest;
}

// Ratio of the largest to the smallest non-empty interval.
template <int Degree>
double interval_ratio(const StateCurves<Degree> &all) {
    const auto [low, high] = std::minmax_element(all.intervals.begin(), all.intervals.end());
    return *high / *low;
}

// Hooks of some spans; `search` are the data that the state knows the spans of.
template <int Degree>
long count_hooks(const SplineState<Degree> &state, const StateCurves<Degree> &part,
                 const ArcPolyline &search, TurningSteps &turning) {
    turning.clear();
    for (std::size_t s = 0; s < part.curves.size(); ++s)
        turning.add(
            part.spans[s], [&](double u) { return part.curves[s].point(u); },
            [&](double u) { return part.curves[s].tangent(u); }, -1.0, 1.0,
            [](double, double, bool) {});
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

// Hooks that there are more after a removal than before, where spans first .. last were changed.
template <int Degree>
long new_hooks(const SplineState<Degree> &before, const SplineState<Degree> &after, int first,
               int last, const ArcPolyline &search, TurningSteps &turning) {
    constexpr int kBeside = 2;  // spans that hooks reach into
    const auto count = [&](const SplineState<Degree> &state, int end) {
        int begin = first - kBeside;
        end += kBeside;
        if (!state.closed) {
            begin = std::max(begin, Degree);
            end = std::min(end, state.n_points());
        } else {
            end = std::min(end, begin + state.n_points());
        }
        const StateCurves<Degree> part(state, begin, end);
        return count_hooks(state, part, search, turning);
    };
    return count(after, last + 1) - count(before, last + 2);
}

// Chords within a flatness of the curve, of the spans whose hull meets a box.
template <int Degree>
std::vector<Chord> flattened(const StateCurves<Degree> &all, double flatness, const Box &box) {
    constexpr int kLeast = 8, kMost = 64;
    constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    std::vector<Chord> chords;
    for (const auto &curve : all.curves) {
        const auto b = curve.bezier().points;
        Box hull;
        for (const Vec2 p : b) hull.include(p);
        if (!hull.meets(box)) continue;
        const double wanted = steps_wanted<Degree>(b, flatness, kNoLimit);
        const int n = static_cast<int>(std::clamp(std::ceil(wanted), 1.0 * kLeast, 1.0 * kMost));
        Vec2 begin = b[0];
        for (int i = 1; i <= n; ++i) {
            const Vec2 end = i < n ? curve.point(2.0 * i / n - 1.0) : b[Degree];
            chords.push_back({begin, end});
            begin = end;
        }
    }
    return chords;
}

}  // namespace shapespline::spline
