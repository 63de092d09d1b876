// The polyline that a search works on in place of all the data.
//
// Dense data say the same thing many times, sparse data leave long segments unsaid. The search sees
// vertices of the data as far apart as the tolerance allows, and points on long segments; what it
// finds is then checked against every data point and the true polyline (proof.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "shapespline/distance/thinning.hpp"
#include "shapespline/spline/state.hpp"

namespace shapespline::spline {

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

// Points nearer along the way than this part of all of it cannot be told apart by sums of knot
// intervals (SPL-11).
inline constexpr double kLeastStep = 1e-12;

// A polyline with its arc lengths, which increase: points next to the one before are left out.
inline ArcPolyline arc_polyline(std::span<const Vec2> points, bool closed) {
    double total = closed ? norm(points.front() - points.back()) : 0.0;
    for (std::size_t j = 1; j < points.size(); ++j) total += norm(points[j] - points[j - 1]);
    ArcPolyline out{closed, 0.0, {points.front()}, {0.0}};
    const double least = kLeastStep * total;
    double at = 0.0;
    for (std::size_t j = 1; j < points.size(); ++j) {
        at += norm(points[j] - points[j - 1]);
        if (at - out.at.back() > least) {
            out.points.push_back(points[j]);
            out.at.push_back(at);
        } else if (!closed && j + 1 == points.size() && out.size() > 1) {
            out.points.back() = points[j];  // an open one ends where its data end
            out.at.back() = at;
        }
    }
    out.total = out.at.back();
    if (!closed) return out;
    const double seam = norm(points.front() - out.points.back());
    if (seam > least || out.size() == 1) {
        out.total += seam;
    } else {
        out.total = out.at.back();
        out.points.pop_back();
        out.at.pop_back();
    }
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

}  // namespace shapespline::spline
