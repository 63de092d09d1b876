// The spline that removal begins with: few knots by chord length, more where it is too far away.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "shapespline/base/interruption.hpp"
#include "shapespline/spline/pnorm.hpp"
#include "shapespline/spline/search_polyline.hpp"

namespace shapespline::spline {

// Knots at given data points, repeated as often as they are named; control points at their Greville
// abscissae on the polyline through these points. Indices do not decrease; an open curve's begin
// with 0 and end with n - 1, a closed curve's begin with 0.
template <int Degree>
SplineState<Degree> chord_length_spline(const ArcPolyline &data, std::span<const int> at) {
    const int n = data.size();
    const bool closed = data.closed;
    const std::vector<double> &length = data.at;
    const double total = data.total;

    SplineState<Degree> state;
    state.closed = closed;
    std::vector<double> knots;
    if (!closed) knots.assign(Degree, 0.0);
    for (const int j : at) knots.push_back(length[j]);
    if (!closed) knots.insert(knots.end(), Degree, total);
    const int m = closed ? static_cast<int>(knots.size())
                         : static_cast<int>(knots.size()) - Degree - 1;
    const auto knot = [&](int i) {
        return closed ? knots[wrap(i, m)] + floor_div(i, m) * total : knots[i];
    };
    const int n_intervals = closed ? m : m + Degree;
    for (int k = 0; k < n_intervals; ++k) {
        state.intervals.push_back(knot(k + 1) - knot(k));
        state.knot_ids.push_back(k);
    }
    for (int i = 0; i < m; ++i) {
        double greville = 0.0;
        for (int q = 1; q <= Degree; ++q) greville += knot(i + q) / Degree;
        if (closed) greville -= std::floor(greville / total) * total;
        const auto next = std::upper_bound(at.begin(), at.end(), greville, [&](double g, int j) {
            return g < length[j];
        });
        const std::size_t last = closed ? at.size() - 1 : at.size() - 2;
        const std::size_t i0 = std::clamp<std::size_t>(next - at.begin(), 1, last + 1) - 1;
        const int j0 = at[i0], j1 = i0 + 1 < at.size() ? at[i0 + 1] : n;
        const double step = data.arc(j1) - data.arc(j0);
        const double s = step > 0.0 ? std::clamp((greville - data.arc(j0)) / step, 0.0, 1.0) : 0.0;
        state.points.push_back(data.point(j0) + s * (data.point(j1) - data.point(j0)));
    }
    int k = closed ? -1 : Degree;
    for (int j = 0; j < n; ++j) {
        while (k + 1 < (closed ? 2 * m : m) && knot(k + 1) <= length[j]) ++k;
        state.span.push_back(k);
        const double width = knot(k + 1) - knot(k);
        state.local_parameter.push_back(
            width > 0.0 ? std::clamp(2.0 * (length[j] - knot(k)) / width - 1.0, -1.0, 1.0) : 1.0);
    }
    if (!closed) {
        state.points.front() = data.points.front();
        state.points.back() = data.points.back();
    }
    state.normalize();
    return state;
}

// So many data points, all if there are fewer, evenly spread by their number.
inline std::vector<int> even_points(const ArcPolyline &data, int count) {
    const int n = data.size();
    count = std::min(n, count);
    std::vector<int> at;
    for (int i = 0; i < count; ++i)
        at.push_back(static_cast<int>(static_cast<long>(i) * (data.closed ? n : n - 1) /
                                      (data.closed ? count : count - 1)));
    return at;
}

// Data points for first knots, as dense as the curve bends: a spline of degree d whose knots are h
// apart misses a bend of radius r by about (h / r)^d h, so that a length h which turns by an angle
// asks for (angle^d h / tolerance)^(1 / (d + 1)) knots (after de Boor 1973). How the data bend is
// told by chords within the tolerance. `density` knots are spread for each that is asked for, and
// kEven or more of them evenly, on straight runs too.
template <int Degree>
std::vector<int> points_by_bending(const ArcPolyline &data, double tolerance, double density) {
    constexpr int kEven = 4, kLeast = 3 * Degree + 4;
    std::vector<int> at = chord_vertices(data, tolerance, data.total);
    if (data.closed) at.push_back(data.size());
    const int n = static_cast<int>(at.size()), n_chords = n - 1;
    const auto chord = [&](int i) { return data.point(at[i + 1]) - data.point(at[i]); };
    std::vector<double> asked(n, 0.0);
    for (int i = data.closed ? 0 : 1; i < n_chords; ++i) {
        const Vec2 before = chord(i > 0 ? i - 1 : n_chords - 1), after = chord(i);
        const double angle = std::abs(std::atan2(cross(before, after), dot(before, after)));
        const double length = 0.5 * (norm(before) + norm(after));
        asked[i] = density * std::pow(std::pow(angle, Degree) * length / tolerance,
                                      1.0 / (Degree + 1));
    }
    if (data.closed) asked.back() = asked.front();
    double even = kLeast;
    for (int i = 0; i < n_chords; ++i) even -= asked[i];
    even = std::max<double>(even, kEven);
    std::vector<double> sum{0.0};  // of knots up to each vertex
    for (int i = 0; i < n_chords; ++i) {
        const double part = (data.arc(at[i + 1]) - data.arc(at[i])) / data.total;
        sum.push_back(sum.back() + 0.5 * (asked[i] + asked[i + 1]) + even * part);
    }
    const int count = static_cast<int>(std::ceil(sum.back()));
    std::vector<int> chosen;
    for (int i = 0, k = 0; k < count; ++k) {
        const double wanted = k * sum.back() / (data.closed ? count : count - 1);
        while (i + 1 < n_chords && sum[i + 1] < wanted) ++i;
        const double from = data.arc(at[i]), part = (wanted - sum[i]) / (sum[i + 1] - sum[i]);
        const double place = from + part * (data.arc(at[i + 1]) - from);
        int j = std::min(data.first_at(place), at.back());
        if (j > 0 && data.arc(j) - place > place - data.arc(j - 1)) --j;
        if (data.closed && j == data.size()) break;
        if (chosen.empty() || j > chosen.back()) chosen.push_back(j);
    }
    // Where all that bends is a few corners, one point stands for many.
    if (static_cast<int>(chosen.size()) < kLeast) return even_points(data, kLeast);
    return chosen;
}

// A polyline within a distance of the data as a spline: its vertices are knots of full
// multiplicity.
template <int Degree>
SplineState<Degree> polyline_spline(const ArcPolyline &data, double distance) {
    std::vector<int> at;
    for (const int j : chord_vertices(data, distance, data.total)) {
        const bool end = !data.closed && (j == 0 || j + 1 == data.size());
        at.insert(at.end(), end ? 1 : Degree, j);
    }
    return chord_length_spline<Degree>(data, at);
}

template <int Degree>
class KnotInsertion {
  public:
    KnotInsertion(std::span<const Vec2> data, const FitLimits &limits)
        : data_(data), limits_(limits) {
        limits_.samples_move = false;  // else more spans are halved than need be (SPL-22)
    }

    // Fits all of the curve and halves the worse half of the spans that are farther than `enough`
    // tolerances away, until none is; false when that does not come about.
    bool run(SplineState<Degree> &state, double enough, int most_points,
             Interruption &interruption) {
        limits_.enough = enough;
        int next_id = 1 + *std::max_element(state.knot_ids.begin(), state.knot_ids.end());
        const FitStage stage{1, kIterations, false, std::numeric_limits<double>::infinity()};
        for (int round = 0; round < kRounds; ++round) {
            if (interruption.ends([] { return 0; })) return false;
            window_.open_whole(state, data_);
            const double largest = fit_.run(window_, limits_, {&stage, 1}, round == 0);
            window_.write_back(state);
            if (largest <= limits_.enough) return true;
            if (state.n_points() >= most_points) return false;
            if (!split(state, next_id)) return false;
        }
        return false;
    }

  private:
    // Rounds of insertion at most, and iterations between them (SPL-09).
    static constexpr int kRounds = 40, kIterations = 5;

    bool split(SplineState<Degree> &state, int &next_id) {
        window_.open_whole(state, data_);
        Tracking<Degree>::span_curves(window_.curve, bases_, curves_);
        Tracking<Degree>::residuals(window_, window_.curve, curves_, residuals_);
        plan_.make(window_, window_.curve, limits_.samples_per_span, limits_.samples_move);
        Tracking<Degree>::sample(window_, window_.curve, curves_, plan_, 0.0, nullptr, samples_);
        const int m = state.n_points();
        std::vector<double> worst(state.closed ? m : m + Degree, 0.0);
        const auto note = [&](int local, double distance_sq) {
            double &value = worst[state.interval_index(window_.origin + local)];
            value = std::max(value, distance_sq);
        };
        for (int j = 0; j < window_.n_data(); ++j)
            note(window_.curve.span[j], norm_sq(residuals_[j]));
        for (const CurveSample &s : samples_) note(s.span, s.distance_sq);

        const double enough = limits_.enough * limits_.tolerance;
        std::vector<std::pair<double, int>> failing;
        for (int k = 0; k < static_cast<int>(worst.size()); ++k)
            if (worst[k] > enough * enough && state.intervals[k] >= 2.0 * limits_.least_interval)
                failing.emplace_back(-worst[k], k);
        if (failing.empty()) return false;
        std::sort(failing.begin(), failing.end());
        failing.resize((failing.size() + 1) / 2);
        // From the last span to the first, so that indices before it stay.
        std::sort(failing.begin(), failing.end(),
                  [](const auto &a, const auto &b) { return a.second > b.second; });
        for (const auto &[_, k] : failing) insert_knot(state, k, 0.0, next_id++);
        return true;
    }

    std::span<const Vec2> data_;
    FitLimits limits_;
    Window<Degree> window_;
    PNormFit<Degree> fit_;
    typename Tracking<Degree>::Bases bases_;
    typename Tracking<Degree>::Curves curves_;
    std::vector<Vec2> residuals_;
    SamplePlan<Degree> plan_;
    std::vector<CurveSample> samples_;
};

}  // namespace shapespline::spline
