// The data of a least-squares fit, and the stray residuals that hold the curve between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/curve/bspline.hpp"

namespace shapespline::least_squares {

// Which location parameters stay where they are.
enum class Held : int { none = 0, ends = 1, all = 2 };

struct Samples {
    std::span<const Vec2> points;
    std::span<const double> parameters;
    const double *weights;  // null for all ones
    Held held = Held::none;
    bool control_ends_fixed = false;  // the first and last control point do not move
    double stray_weight = 0.0;        // of the stray residuals; 0 for the plain problem
    // The part in [0, 1] of each squared residual along the tangent that a step counts, where the
    // parameters are found by projection and not by the step; null where they are eliminated.
    const double *along = nullptr;

    std::size_t size() const { return points.size(); }
    double weight(std::size_t j) const { return weights ? weights[j] : 1.0; }
    bool is_held(std::size_t j) const {
        return held == Held::all || (held == Held::ends && (j == 0 || j + 1 == size()));
    }
};

// Stray residuals hold the curve where it passes between two data points on a long way of its own,
// which the residuals of the data cannot see: bumps beside corners, loops in spans that lost their
// points. Where neighbours' parameters are more than kFreeGap of a span apart, the curve between
// them is compared with the segment between the points, at matching fractions (a Frechet distance).
// The weight grows smoothly from zero, so that points may still drift apart (LSQ-01).
inline constexpr double kFreeGap = 0.125;
inline constexpr double kStraySamples = 8.0;  // a span
// Spans that all gaps together get samples for, times those of the domain. Parameters in data order
// never want more: 8 gaps a span are wider than kFreeGap, and rounding up adds one span to each. A
// line search tries parameters that a bad direction has thrown about, every gap as long as the
// domain: there the samples are thinned out (LSQ-08).
inline constexpr double kMostSpans = 1.0 + 1.0 / kFreeGap;

struct Stray {
    std::size_t before, after;  // the data points it lies between
    double fraction;            // of the way from one to the other
    double parameter;
    Vec2 target;
    double weight;
    double weight_slope;  // derivative of the weight with respect to the gap
};

template <class Visit>
void for_each_stray(const Knots &knots, const Samples &samples, Visit &&visit) {
    if (samples.stray_weight == 0.0) return;
    std::size_t n_spans = 0;
    for (std::size_t k = knots.degree; k < knots.n_coefficients(); ++k)
        n_spans += knots.values[k] < knots.values[k + 1];
    const double span = knots.period() / static_cast<double>(n_spans);
    const std::size_t n = samples.size();
    const std::size_t n_gaps = knots.periodic ? n : n - 1;
    const auto gap_after = [&](std::size_t j) {
        const bool closing = j + 1 == n;
        const double end = closing ? samples.parameters[0] + knots.period()
                                   : samples.parameters[j + 1];
        return end - samples.parameters[j];
    };
    // No more than the whole domain deserves, however far a parameter may have flown.
    const auto spans_of = [&](double gap) {
        return std::clamp(std::ceil(gap / span), 1.0, static_cast<double>(n_spans));
    };
    double wanted = 0.0;
    for (std::size_t j = 0; j < n_gaps; ++j) {
        const double gap = gap_after(j);
        if (gap > kFreeGap * span) wanted += spans_of(gap);
    }
    const double most = kMostSpans * static_cast<double>(n_spans);
    const double thinning = wanted > most ? most / wanted : 1.0;
    for (std::size_t j = 0; j < n_gaps; ++j) {
        const double gap = gap_after(j);
        const double excess = gap / (kFreeGap * span) - 1.0;
        if (!(excess > 0.0)) continue;
        const std::size_t after = j + 1 == n ? 0 : j + 1;
        const Vec2 a = samples.points[j], b = samples.points[after];
        const double n_samples =
            std::max(1.0, std::floor(thinning * (kStraySamples * spans_of(gap))));
        const double unit = samples.stray_weight / n_samples;
        const double slope = 2.0 * unit * excess / (kFreeGap * span);
        for (double i = 1.0; i <= n_samples; ++i) {
            const double s = i / (n_samples + 1.0);
            visit(Stray{j, after, s, samples.parameters[j] + s * gap, a + s * (b - a),
                        unit * excess * excess, slope});
        }
    }
}

}  // namespace shapespline::least_squares
