// The polyline that a search works on in place of all the data, and the proof on the data.
//
// Dense data say the same thing many times, sparse data leave long segments unsaid. The search sees
// vertices of the data as far apart as the tolerance allows, and points on long segments; what it
// finds is then checked against every data point and the true polyline.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "shapespline/thinning.hpp"
#include "shapespline/tracking.hpp"

namespace shapespline::removal {

// Points along a polyline with their arc lengths; indices and lengths go on turn after turn if it
// is closed.
struct ArcPolyline {
    bool closed;
    double total = 0.0;
    std::vector<Vec2> points;
    std::vector<double> at;

    int size() const { return static_cast<int>(points.size()); }
    double arc(int j) const {
        if (!closed) return at[j];
        const int turn = floor_div(j, size());
        return at[j - turn * size()] + turn * total;
    }
    Vec2 point(int j) const { return points[closed ? wrap(j, size()) : j]; }
    // The first index, unwrapped if closed, whose arc length is at least a value.
    int first_at(double value) const {
        const int turn = closed ? static_cast<int>(std::floor(value / total)) : 0;
        const auto found = std::lower_bound(at.begin(), at.end(), value - turn * total);
        return turn * size() + static_cast<int>(found - at.begin());
    }
};

inline ArcPolyline arc_polyline(std::span<const Vec2> points, bool closed) {
    ArcPolyline out{closed, 0.0, {points.begin(), points.end()}, {0.0}};
    for (std::size_t j = 1; j < points.size(); ++j)
        out.at.push_back(out.at.back() + norm(points[j] - points[j - 1]));
    out.total = out.at.back() + (closed ? norm(points.front() - points.back()) : 0.0);
    return out;
}

// Indices of vertices, thinned as far as a distance and a longest way allow. The last one of open
// data is among them.
inline std::vector<int> chord_vertices(const ArcPolyline &data, double distance, double longest) {
    std::vector<Vec2> lap = data.points;
    if (data.closed) lap.push_back(lap.front());
    const std::vector<std::int64_t> kept = thinned(lap, distance, longest);
    return {kept.begin(), kept.end() - (data.closed ? 1 : 0)};
}

// The polyline through such vertices, with points on segments longer than `longest`.
inline ArcPolyline search_polyline(const ArcPolyline &data, double distance, double longest) {
    ArcPolyline out{data.closed, data.total, {}, {}};
    std::vector<int> vertices = chord_vertices(data, distance, longest);
    if (data.closed) vertices.push_back(data.size());
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        const int a = vertices[i], b = vertices[i + 1];
        const double length = data.arc(b) - data.arc(a);
        const int parts = static_cast<int>(std::ceil(length / longest));
        for (int k = 0; k < std::max(parts, 1); ++k) {
            const double s = static_cast<double>(k) / std::max(parts, 1);
            out.points.push_back(data.point(a) + s * (data.point(b) - data.point(a)));
            out.at.push_back(data.arc(a) + s * length);
        }
    }
    if (!data.closed) {
        out.points.push_back(data.points.back());
        out.at.push_back(data.total);
    }
    return out;
}

// Proves both distances of a part of a spline against the data.
template <int Degree>
class Proof {
  public:
    // The curve on spans low .. high, and the data from the last one before them to the first one
    // after them, which begin where their neighbours among the search points are.
    bool within(const SplineState<Degree> &state, const ArcPolyline &search,
                const ArcPolyline &data, int low, int high, double distance) {
        int before = state.first_data(low) - 1, after = state.first_data(high + 1);
        if (!state.closed) {
            before = std::max(before, 0);
            after = std::min(after, search.size() - 1);
        }
        copy(state, std::min(low, state.span_of(before)), std::max(high, state.span_of(after)));
        window_.first_sampled = low - window_.origin;
        window_.last_sampled = high - window_.origin;
        place_data(state, search, data, before, after);
        Tracking<Degree>::span_curves(window_.curve, curves_);
        for (int j = 0; j < window_.n_data(); ++j)
            if (!Tracking<Degree>::reaches(window_, window_.curve, curves_, j, distance))
                return false;
        return Tracking<Degree>::within(window_, window_.curve, curves_, distance);
    }

  private:
    void copy(const SplineState<Degree> &state, int low, int high) {
        window_.copy_curve(state, low - Degree, high - low + 1 + Degree);
    }

    void place_data(const SplineState<Degree> &state, const ArcPolyline &search,
                    const ArcPolyline &data, int before, int after) {
        std::vector<double> knots(window_.curve.gaps.size() + 1, 0.0);
        for (std::size_t k = 0; k < window_.curve.gaps.size(); ++k)
            knots[k + 1] = knots[k] + window_.curve.gaps[k];
        const auto parameter = [&](int k) {
            const int span = state.span_of(k) - window_.origin;
            const double place = state.place[state.closed ? wrap(k, search.size()) : k];
            return knots[span] + 0.5 * (place + 1.0) * window_.curve.gaps[span];
        };
        // The search points at either end lie where nothing has changed, so does what is beyond.
        const double rounding = 1e-12 * search.total;
        const bool from_start = !data.closed && before == 0;
        const bool to_end = !data.closed && after == search.size() - 1;
        const int begin = from_start ? 0 : data.first_at(search.arc(before) + rounding);
        const int end = to_end ? data.size() : data.first_at(search.arc(after) - rounding);
        window_.starts_open_curve = !data.closed && begin == 0;
        window_.ends_open_curve = !data.closed && end == data.size();
        window_.data.clear();
        window_.curve.span.clear();
        window_.curve.place.clear();
        int k = before, span = Degree;
        for (int j = begin; j < end; ++j) {
            const double at = data.arc(j);
            while (k + 1 < after && search.arc(k + 1) <= at) ++k;
            double t = parameter(k);
            if (k < after) {
                const double s = (at - search.arc(k)) / (search.arc(k + 1) - search.arc(k));
                t += std::clamp(s, 0.0, 1.0) * (parameter(k + 1) - t);
            }
            while (span < window_.last_span &&
                   (!(window_.curve.gaps[span] > 0.0) || t > knots[span + 1]))
                ++span;
            window_.data.push_back(data.point(j));
            window_.curve.span.push_back(span);
            window_.curve.place.push_back(std::clamp(
                2.0 * (t - knots[span]) / window_.curve.gaps[span] - 1.0, -1.0, 1.0));
        }
        int first = begin - kPolylineMargin, last = end + kPolylineMargin;
        if (!data.closed) {
            first = std::max(first, 0);
            last = std::min(last, data.size());
        }
        window_.segments.clear();
        for (int j = first; j + 1 < last; ++j)
            window_.segments.push_back(segment_between(data.point(j), data.point(j + 1)));
        window_.segment_offset = begin - first;
    }

    Window<Degree> window_;
    typename Tracking<Degree>::Curves curves_;
};

}  // namespace shapespline::removal
