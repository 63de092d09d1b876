// Distances of one window in both directions: data to curve, curve to polyline.
//
// Data keep their order along the curve, and the curve is compared with the polyline near the data
// around it only. Both make the distances upper bounds, and they keep the topology: no data point
// jumps to another branch, no branch of the curve hides behind another one of the polyline.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/distance/newton.hpp"
#include "shapespline/distance/polyline.hpp"
#include "shapespline/curve/span_basis.hpp"
#include "shapespline/spline/samples.hpp"
#include "shapespline/spline/window.hpp"

namespace shapespline::spline {

struct PolylineFoot {
    double distance_sq;
    Vec2 foot, normal;
    int segment;
};

// Nearest point of the segments around one of them; walks until some in a row are farther. Where
// the foot on the first one is inside and nearer than `near`, no other is asked: an upper bound
// does.
inline PolylineFoot nearest_around(Vec2 p, std::span<const Segment> segments, int start,
                                   int patience, double near_sq) {
    const auto foot_on = [&](int i, bool &inside) {
        const Segment &segment = segments[i];
        const double s = dot(p - segment.begin, segment.along) * segment.inverse_length_sq;
        inside = s >= 0.0 && s <= 1.0;
        const Vec2 foot = segment.begin + std::clamp(s, 0.0, 1.0) * segment.along;
        return PolylineFoot{norm_sq(p - foot), foot, segment.normal, i};
    };
    bool inside_best = false, inside = false;
    PolylineFoot best = foot_on(start, inside_best);
    if (inside_best && best.distance_sq < near_sq) return best;
    const int count = static_cast<int>(segments.size());
    for (const int direction : {1, -1}) {
        int failures = 0;
        for (int i = start + direction; i >= 0 && i < count && failures < patience;
             i += direction) {
            const PolylineFoot found = foot_on(i, inside);
            if (found.distance_sq < best.distance_sq)
                best = found, inside_best = inside, failures = 0;
            else
                ++failures;
        }
    }
    const double distance = std::sqrt(best.distance_sq);
    if (!inside_best && distance > 1e-12) best.normal = (1.0 / distance) * (p - best.foot);
    return best;
}

template <int Degree>
class Tracking {
  public:
    using Bases = std::vector<SpanBasis<Degree>>;
    using Curves = std::vector<SpanCurve<Degree>>;

    static void span_curves(const LocalCurve &curve, Bases &bases, Curves &out) {
        const int count = static_cast<int>(curve.points.size());
        bases.resize(count);
        out.resize(count);
        for (int k = Degree; k < count; ++k) {
            if (!(curve.intervals[k] > 0.0)) continue;
            bases[k].evaluate(&curve.intervals[k]);
            out[k].combine(bases[k], &curve.points[k - Degree]);
        }
    }

    // Residuals at the local parameters of the data.
    static void residuals(const Window<Degree> &window, const LocalCurve &curve,
                          const Curves &curves, std::vector<Vec2> &out) {
        out.resize(window.n_data());
        for (int j = 0; j < window.n_data(); ++j)
            out[j] = curves[curve.span[j]].point(curve.local_parameter[j]) - window.data[j];
    }

    // Moves the data to their feet: safeguarded Newton steps that walk over knots, then sorted back
    // into order. The ends of an open curve stay where they are.
    static void project(const Window<Degree> &window, LocalCurve &curve, const Curves &curves,
                        int n_steps, std::vector<Vec2> &out) {
        const int n = window.n_data();
        out.resize(n);
        for (int j = 0; j < n; ++j) {
            const bool at_begin = window.starts_open_curve && j == 0;
            if (at_begin || (window.ends_open_curve && j == n - 1)) {
                const int span = curve.span[j] = at_begin ? window.first_span : window.last_span;
                const double u = curve.local_parameter[j] = at_begin ? -1.0 : 1.0;
                out[j] = curves[span].point(u) - window.data[j];
            } else {
                out[j] = step_to_foot(window, curve, curves, n_steps, j);
            }
        }
        restore_order(window, curve, curves, out);
    }

    // Samples as planned. `nearby` are those of a curve nearby, or none; distances under `near` are
    // rough.
    static void sample(const Window<Degree> &window, const LocalCurve &curve, const Curves &curves,
                       SamplePlan<Degree> &plan, double near_sq,
                       const std::vector<CurveSample> *nearby, std::vector<CurveSample> &out) {
        plan.place(window, curve, nearby, out);
        const int patience = nearby || plan.moves() ? kHintPatience : kPatience;
        for (CurveSample &sample : out) {
            const Vec2 p = curves[sample.span].point(sample.local_parameter);
            const auto near = nearest_around(p, window.segments, sample.segment, patience, near_sq);
            sample.residual = p - near.foot;
            sample.normal = near.normal;
            sample.distance_sq = near.distance_sq;
            sample.segment = near.segment;
        }
    }

    // Whether all of the sampled spans lie within a distance of the polyline around them. Rigorous:
    // the distance to a segment is convex, so that of a Bezier's control points bounds the piece's.
    static bool within(const Window<Degree> &window, const LocalCurve &curve, const Curves &curves,
                       double distance) {
        Bracket bracket{&window, &curve};
        for (int k = window.first_sampled; k <= window.last_sampled; ++k) {
            if (!(curve.intervals[k] > 0.0)) continue;
            if (!piece_within(window, curves[k].bezier(), k, bracket, distance * distance, 0))
                return false;
        }
        return true;
    }

    // Whether the curve comes within a distance of data point j: where it is placed, at the foot
    // that Newton's method finds from there, or at one found from the nearest of many points around
    // (beside a sharp turn Newton's method may stop short).
    static bool reaches(const Window<Degree> &window, LocalCurve &curve, const Curves &curves,
                        int j, double distance) {
        constexpr int kLooks = 32, kSteps = 6;
        const auto near = [&] {
            const Vec2 p = curves[curve.span[j]].point(curve.local_parameter[j]);
            return norm_sq(p - window.data[j]) <= distance * distance;
        };
        if (near()) return true;
        const int span = curve.span[j];
        const double local_parameter = curve.local_parameter[j];
        step_to_foot(window, curve, curves, kSteps, j);
        bool found = near();
        double best_sq = std::numeric_limits<double>::infinity();
        for (int k = std::max(span - 1, window.first_span);
             !found && k <= std::min(span + 1, window.last_span); ++k)
            for (int i = 0; i <= kLooks && curve.intervals[k] > 0.0; ++i) {
                const double u = 2.0 * i / kLooks - 1.0;
                const double distance_sq = norm_sq(curves[k].point(u) - window.data[j]);
                if (distance_sq < best_sq)
                    best_sq = distance_sq, curve.span[j] = k, curve.local_parameter[j] = u;
            }
        if (!found) {
            step_to_foot(window, curve, curves, kSteps, j);
            found = near();
        }
        curve.span[j] = span;
        curve.local_parameter[j] = local_parameter;
        return found;
    }

  private:
    // Segments in a row that may be farther before a look ends; a proof looks again (SPL-05).
    static constexpr int kMaxDepth = 20, kPatience = 4, kHintPatience = 2, kProofPatience = 32;

    // The polyline segment that begins at the last data point before a point of the curve;
    // parameters must not decrease.
    struct Bracket {
        const Window<Degree> *window;
        const LocalCurve *curve;
        int next = 0;

        int segment(int span, double local_parameter) {
            while (next < window->n_data() &&
                   (curve->span[next] < span ||
                    (curve->span[next] == span && curve->local_parameter[next] < local_parameter)))
                ++next;
            return std::clamp(next - 1 + window->segment_offset, 0,
                              static_cast<int>(window->segments.size()) - 1);
        }
    };

    static bool piece_within(const Window<Degree> &window, const Bezier<Degree> &piece, int span,
                             Bracket &bracket, double most_sq, int depth) {
        const double middle = 0.5 * (piece.begin + piece.end);
        Bracket ahead = bracket;  // the left half is still to come
        const int start = ahead.segment(span, middle);
        const Vec2 p = piece.at(0.5).point;
        auto near = nearest_around(p, window.segments, start, kPatience, 0.0);
        if (near.distance_sq > most_sq)
            near = nearest_around(p, window.segments, start, kProofPatience, 0.0);
        if (near.distance_sq > most_sq) return false;
        const Segment &segment = window.segments[near.segment];
        const bool all_near = std::ranges::all_of(piece.points, [&](Vec2 q) {
            const Vec2 end = segment.begin + segment.along;
            return segment_distance_sq(q, segment.begin, end) <= most_sq;
        });
        if (all_near) {
            bracket = ahead;
            return true;
        }
        if (depth == kMaxDepth) return false;
        const auto [left, right] = piece.halves();
        return piece_within(window, left, span, bracket, most_sq, depth + 1) &&
               piece_within(window, right, span, bracket, most_sq, depth + 1);
    }

    // Moves data point j nearer to its foot; returns the residual there.
    static Vec2 step_to_foot(const Window<Degree> &window, LocalCurve &curve,
                             const Curves &curves, int n_steps, int j) {
        constexpr double kEnough = 1e-4;
        const Vec2 q = window.data[j];
        int span = curve.span[j], best_span = span;
        double u = curve.local_parameter[j], best_local = u;
        double best_sq = std::numeric_limits<double>::infinity();
        Vec2 best{};
        for (int step = 0;; ++step) {
            const SpanCurve<Degree> &c = curves[span];
            const Vec2 r = c.point(u) - q;
            const double distance_sq = norm_sq(r);
            if (!(distance_sq < best_sq)) break;
            best_sq = distance_sq, best_span = span, best_local = u, best = r;
            if (step == n_steps) break;
            const Vec2 tangent = c.tangent(u);
            const double speed_sq = norm_sq(tangent);
            const double curvature = descent_curvature(speed_sq, speed_sq + dot(r, c.second(u)));
            if (!(curvature > 0.0)) break;
            const double move = std::clamp(-dot(r, tangent) / curvature, -2.0, 2.0);
            if (std::abs(move) < kEnough) break;
            walk(window, curve.intervals, span, u, move);
        }
        curve.span[j] = best_span;
        curve.local_parameter[j] = best_local;
        return best;
    }

    // Moves a local parameter along the curve, over knots and empty spans, not beyond the window.
    static void walk(const Window<Degree> &window, const std::vector<double> &intervals, int &span,
                     double &u, double move) {
        if (u + move >= -1.0 && u + move <= 1.0) {
            u += move;
            return;
        }
        double t = 0.5 * (u + move + 1.0) * intervals[span];  // from the beginning of the span
        while (t < 0.0) {
            int k = span - 1;
            while (k >= window.first_span && !(intervals[k] > 0.0)) --k;
            if (k < window.first_span) t = 0.0;
            else span = k, t += intervals[k];
        }
        while (t > intervals[span]) {
            int k = span + 1;
            while (k <= window.last_span && !(intervals[k] > 0.0)) ++k;
            if (k > window.last_span) t = intervals[span];
            else t -= intervals[span], span = k;
        }
        u = std::min(2.0 * t / intervals[span] - 1.0, 1.0);
    }

    static void restore_order(const Window<Degree> &window, LocalCurve &curve,
                              const Curves &curves, std::vector<Vec2> &residual) {
        const auto before = [&](int span, double local_parameter, int k) {
            return span < curve.span[k] ||
                   (span == curve.span[k] && local_parameter < curve.local_parameter[k]);
        };
        for (int j = 1; j < window.n_data(); ++j) {
            const int span = curve.span[j];
            const double local_parameter = curve.local_parameter[j];
            if (!before(span, local_parameter, j - 1)) continue;
            int k = j;
            for (; k > 0 && before(span, local_parameter, k - 1); --k) {
                curve.span[k] = curve.span[k - 1];
                curve.local_parameter[k] = curve.local_parameter[k - 1];
            }
            curve.span[k] = span;
            curve.local_parameter[k] = local_parameter;
            for (int i = k; i <= j; ++i)
                residual[i] =
                    curves[curve.span[i]].point(curve.local_parameter[i]) - window.data[i];
        }
    }
};

}  // namespace shapespline::spline
