// Both distances of a part of a spline proven against all the data, which the search has thinned.
#pragma once

#include <algorithm>
#include <vector>

#include "shapespline/spline/search_polyline.hpp"
#include "shapespline/spline/tracking.hpp"

namespace shapespline::spline {

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
        Tracking<Degree>::span_curves(window_.curve, bases_, curves_);
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
        std::vector<double> knots(window_.curve.intervals.size() + 1, 0.0);
        for (std::size_t k = 0; k < window_.curve.intervals.size(); ++k)
            knots[k + 1] = knots[k] + window_.curve.intervals[k];
        const auto parameter = [&](int k) {
            const int span = state.span_of(k) - window_.origin;
            const double local =
                state.local_parameter[state.closed ? wrap(k, search.size()) : k];
            return knots[span] + 0.5 * (local + 1.0) * window_.curve.intervals[span];
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
        window_.curve.local_parameter.clear();
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
                   (!(window_.curve.intervals[span] > 0.0) || t > knots[span + 1]))
                ++span;
            window_.data.push_back(data.point(j));
            window_.curve.span.push_back(span);
            window_.curve.local_parameter.push_back(std::clamp(
                2.0 * (t - knots[span]) / window_.curve.intervals[span] - 1.0, -1.0, 1.0));
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
    typename Tracking<Degree>::Bases bases_;
    typename Tracking<Degree>::Curves curves_;
};

}  // namespace shapespline::spline
