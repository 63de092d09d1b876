// Foot points of data on a section, and how far the section strays from the data between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapespline/base/pair.hpp"
#include "shapespline/distance/newton.hpp"
#include "shapespline/distance/polyline.hpp"
#include "shapespline/pieces/section.hpp"

namespace shapespline::pieces {

// Foot parameter, span and squared distance of the data of a section, as parallel arrays.
struct Feet {
    double *parameters;
    int *spans;
    double *distances_sq;
};

// The steps of `improve_feet` for two data of a section of one span: the same bits. Parameters in,
// offsets along the span out. One that has stopped comes no nearer in steps for the other.
inline void improve_two_feet(const SpanPolynomial &span, Pair x, Pair y, int iterations,
                             double enough_sq, Pair &offset, Pair &distance_sq) {
    const auto at = [](const auto &c, Pair v) {
        return ((c[3] * v + c[2]) * v + c[1]) * v + c[0];
    };
    const auto slope_at = [](const auto &c, Pair v) {
        return (3.0 * c[3] * v + 2.0 * c[2]) * v + c[1];
    };
    const auto bend_at = [](const auto &c, Pair v) { return 6.0 * c[3] * v + 2.0 * c[2]; };
    Pair v = clamped(offset, 0.0, 1.0) - both(span.begin);
    offset = v;
    distance_sq = both(std::numeric_limits<double>::infinity());
    for (int step = 0; step <= iterations; ++step) {
        const Pair rx = at(span.x, v) - x, ry = at(span.y, v) - y;
        const Pair now_sq = rx * rx + ry * ry;
        const auto nearer = now_sq < distance_sq;
        distance_sq = chosen(nearer, now_sq, distance_sq);
        offset = chosen(nearer, v, offset);
        if (step == iterations) break;
        const Pair tx = slope_at(span.x, v), ty = slope_at(span.y, v);
        const Pair speed_sq = tx * tx + ty * ty;
        const Pair bend = rx * bend_at(span.x, v) + ry * bend_at(span.y, v);
        const Pair curvature = descent_curvature(speed_sq, speed_sq + bend);
        const Pair slope = rx * tx + ry * ty;
        const Pair moved = v + clamped(-slope / curvature, -span.width, span.width);
        Pair next = clamped(moved, 0.0, span.width);
        next = chosen(slope * slope < enough_sq * curvature, v, next);
        next = chosen(nearer, chosen(curvature > both(0.0), next, v), v);
        if (next[0] == v[0] && next[1] == v[1]) break;
        v = next;
    }
}

// Moves every foot point downhill by safeguarded Newton steps along the section.
//
// A step stays within one span width, and the best point met is kept: a distance never rises. Done
// when a step would lower the squared distance by less than `enough_sq`. Local by purpose: a global
// search would jump branches where the outline comes near itself. `data` and `feet` begin at the
// datum `base`.
inline void improve_feet(const SpanPolynomial *spans, int n_spans, const Vec2 *data,
                         std::span<const Index> active, Index base, int iterations,
                         double enough_sq, Feet feet) {
    if (n_spans == 1) {
        for (std::size_t i = 0; i < active.size(); i += 2) {
            const Index j = active[i] - base, k = active[std::min(i + 1, active.size() - 1)] - base;
            Pair offset{feet.parameters[j], feet.parameters[k]}, distance_sq;
            improve_two_feet(spans[0], Pair{data[j].x, data[k].x},
                             Pair{data[j].y, data[k].y}, iterations,
                             enough_sq, offset, distance_sq);
            feet.spans[j] = feet.spans[k] = 0;
            feet.parameters[j] = spans[0].begin + offset[0];
            feet.parameters[k] = spans[0].begin + offset[1];
            feet.distances_sq[j] = distance_sq[0];
            feet.distances_sq[k] = distance_sq[1];
        }
        return;
    }
    for (const Index at : active) {
        const Index j = at - base;
        const double u = std::clamp(feet.parameters[j], 0.0, 1.0);
        int s = walk_to_span(spans, n_spans, std::clamp(feet.spans[j], 0, n_spans - 1), u);
        double v = u - spans[s].begin;
        double best = std::numeric_limits<double>::infinity(), best_v = v;
        int best_s = s;
        for (int step = 0; step <= iterations; ++step) {
            const Vec2 residual = spans[s].point(v) - data[j];
            const double distance_sq = norm_sq(residual);
            if (!(distance_sq < best)) break;
            best = distance_sq;
            best_s = s;
            best_v = v;
            if (step == iterations) break;
            const Vec2 tangent = spans[s].velocity(v);
            const double speed_sq = norm_sq(tangent);
            const double curvature =
                descent_curvature(speed_sq, speed_sq + dot(residual, spans[s].acceleration(v)));
            if (!(curvature > 0.0)) break;
            const double width = spans[s].width;
            const double slope = dot(residual, tangent);
            if (slope * slope < enough_sq * curvature) break;
            v += std::clamp(-slope / curvature, -width, width);
            while (v < 0.0 && s > 0) v += spans[--s].width;
            while (v > spans[s].width && s < n_spans - 1) v -= spans[s++].width;
            v = std::clamp(v, 0.0, spans[s].width);
        }
        feet.spans[j] = best_s;
        feet.parameters[j] = spans[best_s].begin + best_v;
        feet.distances_sq[j] = best;
    }
}

// Distance from curve samples to the data polyline near the segment where they are expected. The
// feet, known already, bound most of it, and other segments than those around would be of another
// branch: a check of its own beside those of distance/deviation.hpp, which asks all segments, and
// spline/tracking.hpp, which has no feet (KER-05).
class ReverseCheck {
  public:
    ReverseCheck(std::span<const Vec2> data, double tolerance)
        : data_(data), tolerance_(tolerance), tolerance_sq_(tolerance * tolerance) {}

    // The largest distance found, an upper bound but where a gap runs over a knot.
    //
    // Between two foot points the curve differs from its chord by no more than dt^2 / 8 |C''|, so
    // it is as far from its data segment as the larger residual and that. Where this does not
    // suffice the gap is divided, into n parts with n^2 times less to add; over a knot and at the
    // ends into parts below 0.4 tolerances.
    double distance(const SpanPolynomial *spans, int n_spans, const Feet &feet, Index first,
                    Index last) const {
        double worst = tail_distance(spans, n_spans, 0.0, feet.parameters[0], first - 1);
        for (Index a = first; a < last && worst <= tolerance_; ++a) {
            const Index j = a - first;
            const int s = feet.spans[j];
            if (feet.spans[j + 1] != s) {
                worst = std::max(worst, tail_distance(spans, n_spans, feet.parameters[j],
                                                      feet.parameters[j + 1], a));
                continue;
            }
            const double v = feet.parameters[j] - spans[s].begin;
            const double w = feet.parameters[j + 1] - spans[s].begin;
            const double bend =
                0.125 * (w - v) * (w - v) *
                std::sqrt(std::max(norm_sq(spans[s].acceleration(v)),
                                   norm_sq(spans[s].acceleration(w))));
            const double residual =
                std::sqrt(std::max(feet.distances_sq[j], feet.distances_sq[j + 1]));
            if (residual + bend <= tolerance_) continue;
            const int n = 1 + static_cast<int>(std::min(
                                  kMostSamples, std::sqrt(bend / (kResolution * tolerance_))));
            double farthest = residual;
            for (int k = 1; k < n; ++k)
                farthest =
                    std::max(farthest, near_distance(spans[s].point(v + (w - v) * k / n), a));
            worst = std::max(worst, farthest + bend / (n * n));
        }
        return std::max(worst, tail_distance(spans, n_spans,
                                             feet.parameters[last - first], 1.0, last));
    }

  private:
    static constexpr double kMostSamples = 400.0;
    static constexpr double kResolution = 1e-3;  // of the tolerance
    static constexpr Index kReach = 3;

    double tail_distance(const SpanPolynomial *spans, int n_spans, double from, double to,
                         Index segment) const {
        if (std::fabs(to - from) <= 1e-12) return 0.0;
        double fastest = 0.0;
        const int begin = walk_to_span(spans, n_spans, 0, std::min(from, to));
        for (int s = begin; s < n_spans && spans[s].begin < std::max(from, to); ++s)
            for (int z = 0; z < 3; ++z)
                fastest = std::max(fastest, norm_sq(spans[s].velocity(0.5 * z * spans[s].width)));
        const double length = std::sqrt(fastest) * std::fabs(to - from);
        const int n =
            4 + static_cast<int>(std::min(kMostSamples, length / (0.4 * tolerance_)));
        double worst = 0.0;
        for (int k = 1, s = begin; k < n; ++k) {
            const double u = from + (to - from) * k / n;
            s = walk_to_span(spans, n_spans, s, u);
            worst = std::max(worst, near_distance(spans[s].point(u - spans[s].begin), segment));
        }
        return worst;
    }

    // Distance to the segments near one, to no more of them than need be.
    double near_distance(Vec2 p, Index segment) const {
        double best = std::numeric_limits<double>::infinity();
        const Index n_segments = static_cast<Index>(data_.size()) - 1;
        for (Index offset = 0; offset <= kReach && best > tolerance_sq_; ++offset)
            for (const Index c : {segment - offset, segment + offset})
                if (c >= 0 && c < n_segments)
                    best = std::min(best, segment_distance_sq(p, data_[c], data_[c + 1]));
        return std::sqrt(best);
    }

    std::span<const Vec2> data_;
    double tolerance_, tolerance_sq_;
};

// The point of the polyline near vertex c that is nearest to p.
inline Vec2 nearest_near(std::span<const Vec2> data, Vec2 p, Index c) {
    constexpr Index kWindow = 5;
    const Index last = static_cast<Index>(data.size()) - 2;
    Vec2 nearest = data[c];
    double best = std::numeric_limits<double>::infinity();
    for (Index k = std::max<Index>(0, c - kWindow); k <= std::min(last, c + kWindow); ++k) {
        const Vec2 q = segment_foot(p, data[k], data[k + 1]);
        if (norm_sq(q - p) < best) {
            best = norm_sq(q - p);
            nearest = q;
        }
    }
    return nearest;
}

}  // namespace shapespline::pieces
