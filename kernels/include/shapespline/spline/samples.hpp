// Where the curve of a window is compared with the polyline of its data.
//
// Sharp tips sit on knots, so one sample rests on each. Where data are few a curve bulges most in
// the middle of the chords between them, wherever its parameters go: samples move with the data
// there. Else all of them rest on their spans, at even steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapespline/spline/window.hpp"

namespace shapespline::spline {

// A point of the curve and the nearest point of the polyline around it.
struct CurveSample {
    int span;
    double local_parameter;
    Vec2 residual;
    Vec2 normal;  // of the segment, or away from the vertex that is nearest
    double distance_sq;
    int segment;
};

template <int Degree>
class SamplePlan {
  public:
    // So many samples of every span that is held to the polyline. They `may_move` with the data
    // where these are few.
    void make(const Window<Degree> &window, const LocalCurve &curve, int n_per_span,
              bool may_move) {
        const int n_spans = window.last_sampled - window.first_sampled + 1;
        const bool moves = may_move && kPerDatum * window.n_data() < n_per_span * n_spans;
        place_knots(curve);
        resting_.clear();
        moving_.clear();
        int j = -1;  // the last datum before a sample
        for (int k = window.first_sampled; k <= window.last_sampled; ++k) {
            if (!(curve.intervals[k] > 0.0)) continue;
            for (int i = 0; i < n_per_span; ++i) {
                const double u = 2.0 * i / n_per_span - 1.0, t = parameter(curve, k, u);
                while (j + 1 < window.n_data() && of_datum(curve, j + 1) <= t) ++j;
                if (moves && i > 0 && j >= 0 && j + 1 < window.n_data()) {
                    const double begin = of_datum(curve, j), end = of_datum(curve, j + 1);
                    moving_.push_back({j, (t - begin) / (end - begin)});
                } else {
                    resting_.push_back({k, u});
                }
            }
        }
        move_to_middles();
    }
    bool moves() const { return !moving_.empty(); }

    // Samples of a curve with the same spans and data, in its order, and the segment to look at
    // first: where all rest that of `nearby`, the samples of a curve nearby, or else the one that
    // begins at the datum before.
    void place(const Window<Degree> &window, const LocalCurve &curve,
               const std::vector<CurveSample> *nearby, std::vector<CurveSample> &out) {
        if (nearby && !moves()) {
            out = *nearby;
            return;
        }
        place_knots(curve);
        out.clear();
        int j = -1;  // the last datum before a sample
        std::size_t n_rested = 0;
        const auto add = [&](int span, double u, int datum) {
            const int last = static_cast<int>(window.segments.size()) - 1;
            const int segment = std::clamp(datum + window.segment_offset, 0, last);
            out.push_back({span, u, {}, {}, 0.0, segment});
        };
        const auto rest_before = [&](double t) {
            for (; n_rested < resting_.size(); ++n_rested) {
                const auto [span, u] = resting_[n_rested];
                if (parameter(curve, span, u) > t) return;
                while (j + 1 < window.n_data() && is_before(curve, j + 1, span, u)) ++j;
                add(span, u, j);
            }
        };
        const double begin = knots_[window.first_sampled], end = knots_[window.last_sampled + 1];
        int k = window.first_sampled;
        for (const auto &[datum, part] : moving_) {
            const double before = of_datum(curve, datum);
            const double t = before + part * (of_datum(curve, datum + 1) - before);
            if (t < begin || t >= end) continue;  // over the seam of a whole curve
            rest_before(t);
            while (t >= knots_[k + 1]) ++k;
            add(k, 2.0 * (t - knots_[k]) / curve.intervals[k] - 1.0, datum);
        }
        rest_before(end);
    }

  private:
    static constexpr int kPerDatum = 2;  // samples, or more, where data are few (SPL-22)

    struct Resting {
        int span;
        double local_parameter;
    };
    struct Moving {
        int datum;    // the last one before
        double part;  // of the way from there to the next one
    };

    // Of those between the same two data the nearest one goes to the middle.
    void move_to_middles() {
        const auto off = [](const Moving &one) { return std::abs(one.part - 0.5); };
        for (auto first = moving_.begin(); first != moving_.end();) {
            const int datum = first->datum;
            const auto next = std::find_if(first, moving_.end(), [&](const Moving &one) {
                return one.datum != datum;
            });
            std::min_element(first, next, [&](const Moving &a, const Moving &b) {
                return off(a) < off(b);
            })->part = 0.5;
            first = next;
        }
    }

    void place_knots(const LocalCurve &curve) {
        knots_.assign(curve.intervals.size() + 1, 0.0);
        for (std::size_t k = 0; k < curve.intervals.size(); ++k)
            knots_[k + 1] = knots_[k] + curve.intervals[k];
    }
    double parameter(const LocalCurve &curve, int span, double u) const {
        return knots_[span] + 0.5 * (u + 1.0) * curve.intervals[span];
    }
    double of_datum(const LocalCurve &curve, int j) const {
        return parameter(curve, curve.span[j], curve.local_parameter[j]);
    }
    static bool is_before(const LocalCurve &curve, int j, int span, double u) {
        return curve.span[j] < span || (curve.span[j] == span && curve.local_parameter[j] < u);
    }

    std::vector<Resting> resting_;
    std::vector<Moving> moving_;
    std::vector<double> knots_;
};

}  // namespace shapespline::spline
