// The part of a spline that one local fit may change, with its data, in plain local arrays.
//
// A change of an interval or a control point is felt a degree of spans away. So a window holds as
// many control points fixed on either side, and everything outside keeps its distances, bit by bit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/spline/state.hpp"

namespace shapespline::spline {

// What a fit changes together, and what is derived from it.
struct LocalCurve {
    std::vector<Vec2> points;
    std::vector<double> intervals;
    std::vector<int> span;      // local, of every data point of the window
    std::vector<double> local_parameter;  // in [-1, 1]
};

inline constexpr int kNotFree = -1;
// A segment of the polyline with its unit normal; its inverse squared length is zero if it has
// none.
struct Segment {
    Vec2 begin, along, normal;
    double inverse_length_sq;
};

inline Segment segment_between(Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double length = norm(along);
    if (!(length > 0.0)) return {a, along, {1.0, 0.0}, 0.0};
    return {a, along, (1.0 / length) * Vec2{-along.y, along.x}, 1.0 / (length * length)};
}

// Polyline vertices kept beyond the window's data, for the distance from curve to polyline.
inline constexpr int kPolylineMargin = 8;

template <int Degree>
struct Window {
    int origin = 0;      // state index of local control point 0
    int data_begin = 0;  // unwrapped index of the first data point
    LocalCurve curve;
    std::vector<int> point_slot, interval_slot;  // number among the free ones, or kNotFree
    int n_free_points = 0, n_free_intervals = 0;
    int first_span = 0, last_span = 0;      // where data may lie
    int first_sampled = 0, last_sampled = 0;  // where the curve is held to the polyline
    bool starts_open_curve = false, ends_open_curve = false;
    std::vector<Vec2> data;      // of the window
    std::vector<Segment> segments;  // of the polyline, with a margin of neighbours
    int segment_offset = 0;         // segments[segment_offset + j] begins at data[j]

    int n_data() const { return static_cast<int>(data.size()); }
    int n_points() const { return static_cast<int>(curve.points.size()); }
    SpanRange sampled_spans() const { return {origin + first_sampled, origin + last_sampled + 1}; }

    // n_side free control points on each side of where control point centre begins; all of a
    // small closed curve.
    void open_around(const SplineState<Degree> &state, std::span<const Vec2> all, int centre,
                     int n_side) {
        const int m = state.n_points(), reach = n_side + Degree;
        if (state.closed && 2 * reach + 1 > m) return open_whole(state, all);
        int first = centre - reach, last = centre - 1 + reach;
        if (!state.closed) {
            first = std::max(first, 0);
            last = std::min(last, m - 1);
        }
        starts_open_curve = !state.closed && first == 0;
        ends_open_curve = !state.closed && last == m - 1;
        copy_curve(state, first, last - first + 1);
        const int count = n_points();
        const int fixed_left = starts_open_curve ? 1 : Degree;
        const int fixed_right = ends_open_curve ? 1 : Degree;
        n_free_points = n_free_intervals = 0;
        for (int i = fixed_left; i < count - fixed_right; ++i) point_slot[i] = n_free_points++;
        const int begin = starts_open_curve ? Degree : 2 * Degree - 1;
        const int end = ends_open_curve ? count : count - Degree + 1;
        for (int k = begin; k < end; ++k)
            if (curve.intervals[k] > 0.0) interval_slot[k] = n_free_intervals++;
        first_sampled = Degree;
        last_sampled = count - 1;
        copy_data(state, all, state.first_data(first + Degree),
                  state.first_data(first + count));
    }

    // The whole curve; a closed one continues a little beyond its seam, so that data may cross it.
    void open_whole(const SplineState<Degree> &state, std::span<const Vec2> all) {
        const int m = state.n_points(), n = state.n_data();
        if (!state.closed) return open_around(state, all, m / 2, m);
        starts_open_curve = ends_open_curve = false;
        const int first = state.span[0] - Degree - kSeamMargin;
        copy_curve(state, first, m + Degree + 2 * kSeamMargin);
        n_free_points = n_free_intervals = m;
        for (int i = 0; i < n_points(); ++i) point_slot[i] = wrap(i, m);
        for (std::size_t k = 0; k < curve.intervals.size(); ++k)
            if (curve.intervals[k] > 0.0) interval_slot[k] = wrap(static_cast<int>(k), m);
        first_sampled = Degree + kSeamMargin;
        last_sampled = first_sampled + m - 1;
        copy_data(state, all, 0, n);
    }

    // Writes the curve back to where it was read.
    void write_back(SplineState<Degree> &state) const {
        const int m = state.n_points(), n = state.n_data();
        for (int i = 0; i < n_points(); ++i)
            if (point_slot[i] != kNotFree)
                state.points[state.closed ? wrap(origin + i, m) : origin + i] = curve.points[i];
        for (std::size_t k = 0; k < curve.intervals.size(); ++k)
            if (interval_slot[k] != kNotFree)
                state.intervals[state.interval_index(origin + static_cast<int>(k))] =
                    curve.intervals[k];
        for (int j = 0; j < n_data(); ++j) {
            const int turn = state.closed ? floor_div(data_begin + j, n) : 0;
            const int at = data_begin + j - turn * n;
            state.span[at] = curve.span[j] + origin - turn * m;
            state.local_parameter[at] = curve.local_parameter[j];
        }
        if (state.closed) keep_within_one_turn(state);
        state.normalize();
    }

    // Local control points 0 .. count - 1 from state index `first` on, all fixed.
    void copy_curve(const SplineState<Degree> &state, int first, int count) {
        origin = first;
        curve.points.resize(count);
        for (int i = 0; i < count; ++i) curve.points[i] = state.point(first + i);
        curve.intervals.resize(count + Degree - 1);
        for (int k = 0; k < count + Degree - 1; ++k) curve.intervals[k] = state.interval(first + k);
        point_slot.assign(count, kNotFree);
        interval_slot.assign(count + Degree - 1, kNotFree);
        first_span = Degree;
        last_span = count - 1;
        while (first_span < last_span && !(curve.intervals[first_span] > 0.0)) ++first_span;
        while (last_span > first_span && !(curve.intervals[last_span] > 0.0)) --last_span;
    }

  private:
    static constexpr int kSeamMargin = 2;

    void copy_data(const SplineState<Degree> &state, std::span<const Vec2> all, int begin,
                   int end) {
        const int n = static_cast<int>(all.size());
        data_begin = begin;
        const int count = end - begin;
        data.resize(count);
        curve.span.resize(count);
        curve.local_parameter.resize(count);
        const auto index = [&](int j) { return state.closed ? wrap(j, n) : j; };
        for (int j = 0; j < count; ++j) {
            data[j] = all[index(begin + j)];
            curve.span[j] = state.span_of(begin + j) - origin;
            curve.local_parameter[j] = state.local_parameter[index(begin + j)];
        }
        int low = begin - kPolylineMargin, high = end + kPolylineMargin;
        if (!state.closed) {
            low = std::max(low, 0);
            high = std::min(high, n);
        }
        segments.clear();
        for (int j = low; j + 1 < high; ++j)
            segments.push_back(segment_between(all[index(j)], all[index(j + 1)]));
        segment_offset = begin - low;
    }

    // The last data point may not lie beyond the first one of the next turn.
    static void keep_within_one_turn(SplineState<Degree> &state) {
        const int end = state.span[0] + state.n_points();
        for (int j = state.n_data() - 1; j > 0; --j) {
            const bool beyond = state.span[j] > end ||
                                (state.span[j] == end &&
                                 state.local_parameter[j] > state.local_parameter[0]);
            if (!beyond) break;
            state.span[j] = end;
            state.local_parameter[j] = state.local_parameter[0];
        }
    }
};

}  // namespace shapespline::spline
