// A spline being changed knot by knot: intervals, control points, and the local parameter of every
// data point.
//
// Span k lies between knots k and k + 1, intervals[k] wide, and is made by control points k -
// degree .. k. Open: knots clamped, control points 0 .. m - 1, intervals 0 .. m + degree - 1, of
// which degree at either end are zero. Closed: m intervals and m control points, all indices modulo
// m; the spans of data points are *unwrapped*: they do not decrease along the data, and the data of
// the next turn (index + n) lie on span + m. A multiple knot is a interval of zero.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline::spline {

inline int floor_div(int a, int b) { return a / b - (a % b < 0 ? 1 : 0); }
inline int wrap(int a, int b) { return a - b * floor_div(a, b); }

// Spans begin .. end - 1, unwrapped.
struct SpanRange {
    int begin, end;
};

template <int Degree>
struct SplineState {
    bool closed = false;
    std::vector<double> intervals;
    std::vector<Vec2> points;
    std::vector<int> knot_ids;  // of the knot that each interval begins at: survive renumbering
    std::vector<int> span;      // of every data point
    std::vector<double> local_parameter;  // of every data point on its span, in [-1, 1]

    int n_points() const { return static_cast<int>(points.size()); }
    int n_data() const { return static_cast<int>(span.size()); }
    SpanRange all_spans() const { return {closed ? 0 : Degree, n_points()}; }
    int interval_index(int k) const { return closed ? wrap(k, n_points()) : k; }
    double interval(int k) const { return intervals[interval_index(k)]; }
    Vec2 point(int i) const { return points[closed ? wrap(i, n_points()) : i]; }

    // Span of data point j, unwrapped beyond 0 .. n - 1 if closed.
    int span_of(int j) const {
        const int n = n_data();
        if (!closed) return span[j];
        const int turn = floor_div(j, n);
        return span[j - turn * n] + turn * n_points();
    }
    // The first (unwrapped) data point whose span is at least k.
    int first_data(int k) const {
        const int n = n_data();
        if (!closed)
            return static_cast<int>(std::lower_bound(span.begin(), span.end(), k) - span.begin());
        const int turn = floor_div(k - span[0], n_points());
        int low = (turn - 1) * n, high = (turn + 1) * n;
        while (low < high) {
            const int middle = low + (high - low) / 2;
            if (span_of(middle) < k)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
    // Knots that may be removed: the first of every group, ends of an open curve excepted.
    bool removable(int r) const {
        if (!closed && (r <= Degree || r >= n_points())) return false;
        return interval(r - 1) > 0.0;
    }
    int knot_with_id(int id) const {
        const auto at = std::find(knot_ids.begin(), knot_ids.end(), id);
        return at == knot_ids.end() ? -1 : static_cast<int>(at - knot_ids.begin());
    }
    // Keeps unwrapped spans from walking away as turns are added up.
    void normalize() {
        if (!closed || span.empty()) return;
        const int shift = n_points() * floor_div(span[0], n_points());
        for (int &s : span) s -= shift;
    }
};

// The control point that goes with knot r, the middle one of those that it shapes.
template <int Degree>
int central_point(int r) {
    return r - (Degree + 1) / 2;
}

// Removes knot r, in [0, m), which is removable: its two spans become one, one control point goes,
// the others stay as they are (a start for a fit, not an approximation).
template <int Degree>
void remove_knot(SplineState<Degree> &state, int r) {
    const int m = state.n_points(), c = central_point<Degree>(r);
    const double before = state.interval(r - 1), after = state.interval(r), merged = before + after;
    for (int j = state.first_data(r - 1), end = state.first_data(r + 1); j < end; ++j) {
        double &local = state.local_parameter[state.closed ? wrap(j, state.n_data()) : j];
        if (state.span_of(j) < r)
            local = (local + 1.0) * before / merged - 1.0;
        else
            local = (2.0 * before + (local + 1.0) * after) / merged - 1.0;
    }
    // Spans do not decrease along the data: how often r has passed need not be divided for.
    int passed = 1 + floor_div(state.span[0] - r, m), next = r + passed * m;
    for (auto at = state.span.begin(); at != state.span.end(); ++passed, next += m) {
        const auto end = std::lower_bound(at, state.span.end(), next);
        for (; at != end; ++at) *at -= passed;
    }
    state.intervals[state.interval_index(r - 1)] = merged;
    state.intervals.erase(state.intervals.begin() + r);
    state.knot_ids.erase(state.knot_ids.begin() + r);
    if (c >= 0) {
        state.points.erase(state.points.begin() + c);
    } else {  // a point of the turn before: those after it, 0 too, are one less
        state.points.erase(state.points.begin() + m + c);
        std::rotate(state.points.begin(), state.points.begin() + 1, state.points.end());
    }
    state.normalize();
}

// Redistributes the merged interval k over up to `reach` intervals on each side, in equal parts
// of the sequence that the intervals had with the merged one cut in two. False if there is none
// beside it.
template <int Degree>
bool redistribute(SplineState<Degree> &s, int k, int reach) {
    const int m = s.n_points();
    reach = s.closed ? std::min(reach, (m - 1) / 2) : reach;
    int low = k, high = k;
    while (k - low < reach && (s.closed || low - 1 >= Degree) && s.interval(low - 1) > 0.0)
        --low;
    while (high - k < reach && (s.closed || high + 1 < m) && s.interval(high + 1) > 0.0)
        ++high;
    if (low == high) return false;
    const int count = high - low + 1;
    std::vector<double> old{0.0}, breaks{0.0}, after{0.0};
    for (int i = low; i <= high; ++i) {
        breaks.push_back(breaks.back() + s.interval(i));
        if (i == k) old.push_back(old.back() + 0.5 * s.interval(i));
        old.push_back(breaks.back());
    }
    for (int i = 1; i < count; ++i) {
        const double x = static_cast<double>(i) * (count + 1) / count;
        const int cell = std::min(static_cast<int>(x), count);
        after.push_back(old[cell] + (x - cell) * (old[cell + 1] - old[cell]));
    }
    after.push_back(old.back());
    for (int j = s.first_data(low), end = s.first_data(high + 1); j < end; ++j) {
        const int turn = s.closed ? floor_div(j, s.n_data()) : 0;
        const int at = j - turn * s.n_data(), local = s.span_of(j) - low;
        const double t = breaks[local] + 0.5 * (s.local_parameter[at] + 1.0) *
                                             (breaks[local + 1] - breaks[local]);
        const auto next = std::upper_bound(after.begin(), after.end(), t);
        const int cell = std::clamp(static_cast<int>(next - after.begin()) - 1, 0, count - 1);
        s.span[at] = cell + low - turn * m;
        s.local_parameter[at] = std::clamp(
            2.0 * (t - after[cell]) / (after[cell + 1] - after[cell]) - 1.0, -1.0, 1.0);
    }
    for (int i = 0; i < count; ++i)
        s.intervals[s.interval_index(low + i)] = after[i + 1] - after[i];
    s.normalize();
    return true;
}

// Splits span k, a state index, at local parameter u; the curve stays the same (Boehm 1980).
template <int Degree>
void insert_knot(SplineState<Degree> &state, int k, double u, int id) {
    const int m = state.n_points();
    const double width = state.interval(k), t = 0.5 * (u + 1.0) * width;
    std::array<Vec2, Degree> blended;
    for (int l = 0; l < Degree; ++l) {
        const int i = k - Degree + 1 + l;
        double low = 0.0, high = 0.0;  // knots i and i + degree, from knot k
        for (int q = i; q < k; ++q) low -= state.interval(q);
        for (int q = k; q < i + Degree; ++q) high += state.interval(q);
        const double share = (t - low) / (high - low);
        blended[l] = share * state.point(i) + (1.0 - share) * state.point(i - 1);
    }
    int turn = floor_div(state.span[0] - k, m), at = k + turn * m;  // the last one of span k
    for (int j = 0; j < state.n_data(); ++j) {
        int &span = state.span[j];
        double &local_parameter = state.local_parameter[j];
        for (; span >= at + m; at += m) ++turn;
        bool after = span > at;
        if (span == at) {
            after = local_parameter >= u;
            local_parameter = after ? 2.0 * (local_parameter - u) / (1.0 - u) - 1.0
                          : 2.0 * (local_parameter + 1.0) / (u + 1.0) - 1.0;
        }
        span += turn + (after ? 1 : 0);
    }
    state.intervals[k] = t;
    state.intervals.insert(state.intervals.begin() + k + 1, width - t);
    state.knot_ids.insert(state.knot_ids.begin() + k + 1, id);
    state.points.insert(state.points.begin() + k, Vec2{});
    for (int l = 0; l < Degree; ++l)
        state.points[wrap(k - Degree + 1 + l, m + 1)] = blended[l];
    state.normalize();
}

}  // namespace shapespline::spline
