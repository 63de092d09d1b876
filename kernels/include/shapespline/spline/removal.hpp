// Knot removal: one knot after another, each removal refitted with everything near it free.
//
// Lyche and Morken (1987) rank knots by the error that their removal makes and keep the data's
// parameters. Here control points, parameters and knot intervals of a window are free in each
// removal, in a rising p-norm, which needs less than half as many knots. A removal is accepted only
// if both distances are proven to keep the tolerance and the fairness holds.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <queue>
#include <span>
#include <vector>

#include "shapespline/spline/fairness.hpp"
#include "shapespline/spline/settings.hpp"
#include "shapespline/spline/proof.hpp"
#include "shapespline/spline/search_polyline.hpp"
#include "shapespline/spline/start.hpp"

namespace shapespline::spline {

template <int Degree>
class KnotRemoval {
  public:
    // Ended early, it begins with the data polyline.
    KnotRemoval(std::span<const Vec2> data, bool closed, const SplineSettings &settings,
                Interruption &interruption)
        : settings_(settings),
          data_(arc_polyline(data, closed)),
          search_(search_polyline(data_, kThinning * settings.fit.tolerance,
                                  data_.total / kSearchPoints)),
          turning_(settings.fit.tolerance) {
        std::vector<Vec2> polyline = search_.points;
        if (closed) polyline.push_back(polyline.front());
        n_data_crossings_ = count_crossings(std::span<const Vec2>(polyline));
        if (!start_by_insertion(interruption)) {
            from_polyline_ = true;
            state_ = polyline_spline<Degree>(search_, kPolylinePart * settings.fit.tolerance);
            measure_fairness();
        }
    }

    const SplineState<Degree> &state() const { return state_; }
    bool from_polyline() const { return from_polyline_; }
    const RemovalCounts &counts() {
        counts_.iterations = fit_.iterations();
        counts_.hooks = n_hooks_;
        return counts_;
    }

    // Removes the cheapest knot first. A rank is renewed when the knot comes up after a neighbour
    // went, unless its removal was feasible at that; a knot whose removal failed comes back when a
    // neighbour has gone. Returns the number of knots that were removed; at most `most` trials are
    // made.
    int remove_cheapest(const Effort &rank, const Effort &effort, long most,
                        Interruption &interruption) {
        const long before = counts_.accepted;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        std::vector<Standing> standing(1 + *std::max_element(state_.knot_ids.begin(),
                                                             state_.knot_ids.end()));
        for (std::size_t r = 0; r < state_.knot_ids.size(); ++r) {
            if (ends(interruption)) return 0;
            if (!state_.removable(static_cast<int>(r))) continue;
            const int id = state_.knot_ids[r];
            queue.push({cost(static_cast<int>(r), rank), id});
            standing[id] = {true, false};
        }
        consecutive_failures_ = 0;
        for (long trials = 0; !queue.empty() && trials < most && !ends(interruption);) {
            const auto [cost_before, id] = queue.top();
            queue.pop();
            const int r = state_.knot_with_id(id);
            standing[id].queued = false;
            if (r < 0 || !state_.removable(r)) continue;
            if (standing[id].stale && cost_before > kTryStale) {
                queue.push({cost(r, rank), id});
                standing[id] = {true, false};
                continue;
            }
            if (is_hopeless(cost_before, settings_.trying)) {
                missed_by_[id] = cost_before;
                continue;
            }
            ++trials;
            ++consecutive_failures_;
            if (!try_removal(r, effort, 0)) continue;
            consecutive_failures_ = 0;
            for_each_near(r, effort, [&](int near) {
                standing[near].stale = true;
                if (standing[near].queued) return;
                queue.push({1.0, near});
                standing[near].queued = true;
            });
        }
        return static_cast<int>(counts_.accepted - before);
    }

    // One harder attempt at every knot: the merged interval as it is, then redistributed over
    // neighbouring intervals. Returns the number of knots that were removed.
    int retry(const Effort &effort, std::span<const int> redistributions,
                        Interruption &interruption) {
        const long before = counts_.accepted;
        std::vector<int> ids;
        for (std::size_t r = 0; r < state_.knot_ids.size(); ++r) ids.push_back(state_.knot_ids[r]);
        consecutive_failures_ = 0;
        for (const int id : ids) {
            if (ends(interruption)) break;
            retry_knot(id, effort, redistributions);
        }
        return static_cast<int>(counts_.accepted - before);
    }

  private:
    bool ends(Interruption &interruption) const {
        return interruption.ends([&] { return state_.n_points(); });
    }

    bool is_hopeless(double distance, const Patience &patience) const {
        return consecutive_failures_ >= patience.failures && distance > patience.distance;
    }

    // Not again where nothing near has changed since it failed.
    void retry_knot(int id, const Effort &effort, std::span<const int> redistributions) {
        if (const auto failed = failed_at_.find(id);
            failed != failed_at_.end() && failed->second >= changed_at_[id])
            return;
        if (const auto missed = missed_by_.find(id);
            missed != missed_by_.end() && is_hopeless(missed->second, settings_.retrying))
            return;
        ++consecutive_failures_;
        for (const int n_beside : redistributions) {
            const int r = state_.knot_with_id(id);
            if (r < 0 || !state_.removable(r)) return;
            if (!try_removal(r, effort, n_beside)) continue;
            consecutive_failures_ = 0;
            for_each_near(r, effort, [&](int near) {
                changed_at_[near] = counts_.accepted;
                missed_by_.erase(near);
            });
            return;
        }
        failed_at_[id] = counts_.accepted;
    }

    // Ids of the knots whose windows overlap with what a removal at r changed.
    template <class Visit>
    void for_each_near(int r, const Effort &effort, Visit &&visit) const {
        const int reach = effort.n_side + Degree, size = static_cast<int>(state_.knot_ids.size());
        for (int i = r - reach; i < r + reach; ++i)
            if (state_.closed || (i >= 0 && i < size))
                visit(state_.knot_ids[state_.interval_index(i)]);
    }

    struct Entry {
        double cost;
        int id;
        bool operator>(const Entry &other) const {
            return cost != other.cost ? cost > other.cost : id > other.id;
        }
    };
    struct Standing {
        bool queued = false, stale = false;
    };
    static constexpr int kRefitSamples = 24;  // of every span
    static constexpr double kLeastEnough = 0.5, kTighter = 0.9, kPolylinePart = 0.5;
    static constexpr double kThinning = 0.025;  // of the tolerance (SPL-04)
    static constexpr int kSearchPoints = 150;  // at least (SPL-03)
    // First knots for each that bends ask for, in one search and, if that misses the product rule,
    // in the next one (SPL-15).
    static constexpr std::array<std::array<double, 2>, 2> kDensities{{{0.6, 1.0}, {1.4, 2.0}}};
    static constexpr int kMedianAge = 256;  // control points for one removal that it may be old
    static constexpr double kTryStale = 0.97;
    static constexpr double kFlatness = 0.01;  // of the tolerance, for crossings

    // Where the first knots fall decides whether sharp corners are met; another number of them
    // often cures what more insertions cannot. Of two starts that are proven the one that keeps the
    // fairness is taken, or else the first.
    bool start_by_insertion(Interruption &interruption) {
        SplineState<Degree> first;
        for (const std::vector<int> &knots : first_knots()) {
            if (!start_by_insertion(knots, interruption)) continue;
            measure_fairness();
            if (!settings_.keep_fair || start_is_fair()) return true;
            if (!first.points.empty()) break;
            first = state_;
        }
        if (first.points.empty()) return false;
        state_ = std::move(first);
        measure_fairness();
        return true;
    }
    std::vector<std::vector<int>> first_knots() const {
        if (settings_.start >= static_cast<int>(kDensities.size())) return {};
        std::vector<std::vector<int>> found;
        for (const double density : kDensities[settings_.start])
            found.push_back(points_by_bending<Degree>(search_, settings_.fit.tolerance, density));
        return found;
    }
    bool start_is_fair() const {
        return slowest_ >= settings_.fairness.speed_ratio && n_hooks_ == 0 &&
               n_crossings_ <= n_data_crossings_;
    }
    void measure_fairness() {
        shapes_.measure(state_);
        const ShapeRow<Degree> all = shapes_.kept(state_, state_.all_spans());
        Box everywhere;
        for (const Vec2 p : state_.points) everywhere.include(p);
        n_crossings_ = crossings(all, everywhere, flatness());
        median_ = median_speed(all);
        slowest_ = slowest_speed(all, settings_.fairness.speed_ratio * median_) / median_;
        interval_ratio_ = interval_ratio(all);
        n_hooks_ = count_hooks(state_, all, search_, turning_);
    }
    bool start_by_insertion(const std::vector<int> &knots, Interruption &interruption) {
        state_ = chord_length_spline<Degree>(search_, knots);
        KnotInsertion<Degree> insertion(search_.points, settings_.fit);
        const int most = std::min(search_.size(), settings_.most_at_start);
        for (double enough = settings_.fit.enough; enough > kLeastEnough; enough *= kTighter) {
            if (!insertion.run(state_, enough, most, interruption)) return false;
            if (is_proven(state_)) return true;
        }
        return false;
    }

    bool is_proven(const SplineState<Degree> &state) {
        const int first = state.closed ? state.span[0] : Degree;
        const int last = state.closed ? first + state.n_points() : state.n_points() - 1;
        return proof_.within(state, search_, data_, first, last,
                             settings_.accept * settings_.fit.tolerance);
    }

    // Merges the spans beside knot r in a copy of the state; false where too few would be left.
    bool make_candidate(int r, int n_beside) {
        if (state_.n_points() <= (state_.closed ? Degree + 2 : Degree + 1)) return false;
        candidate_ = state_;
        remove_knot(candidate_, r);
        double &merged = candidate_.intervals[candidate_.interval_index(r - 1)];
        merged = std::min(merged, settings_.fit.largest_interval);
        return n_beside == 0 || redistribute(candidate_, r - 1, n_beside);
    }

    double fit_candidate(int r, const Effort &effort, const FitLimits &limits) {
        window_.open_around(candidate_, search_.points, central_point<Degree>(r), effort.n_side);
        return fit_.run(window_, limits, effort.stages, true);
    }

    double cost(int r, const Effort &rank) {
        ++counts_.ranks;
        if (!make_candidate(r, 0)) return std::numeric_limits<double>::infinity();
        return fit_candidate(r, rank, settings_.fit);
    }

    bool try_removal(int r, const Effort &effort, int n_beside) {
        ++counts_.trials;
        if (!make_candidate(r, n_beside)) return false;
        const double distance = fit_candidate(r, effort, settings_.fit);
        missed_by_[state_.knot_ids[state_.interval_index(r)]] = distance;
        if (distance > settings_.fit.enough) return false;
        if (!accept_distance()) {
            // A tip between two samples: once more with a closer look.
            ++counts_.refits;
            FitLimits closer = settings_.fit;
            closer.samples_per_span = kRefitSamples;
            closer.samples_move = false;
            make_candidate(r, n_beside);
            if (fit_candidate(r, effort, closer) > closer.enough || !accept_distance()) {
                ++counts_.missed_bound;
                return false;
            }
        }
        if (settings_.keep_fair && !is_fair()) return false;
        std::swap(state_, candidate_);
        ++counts_.accepted;
        return true;
    }

    // Writes the window's curve into the candidate and proves both of its distances.
    bool accept_distance() {
        window_.write_back(candidate_);
        const auto [first, end] = window_.sampled_spans();
        return proof_.within(candidate_, search_, data_, first, end - 1,
                             settings_.accept * settings_.fit.tolerance);
    }

    // Of the candidate, the window first. What the start could not keep must not become worse.
    bool is_fair() {
        const double least = std::min(settings_.fairness.speed_ratio, slowest_);
        const SpanRange window = window_.sampled_spans();
        // Of a high degree intervals that are redistributed may shape a span beside the window.
        const SpanRange changed = with_beside(candidate_, window);
        shapes_.change(candidate_, changed);
        const ShapeRow<Degree> part = shapes_.tried(candidate_, window);
        // The median changes little in one removal; what fails clearly needs no second look.
        if (slowest_speed(part, settings_.fairness.speed_ratio * median_) < 0.8 * least * median_) {
            ++counts_.missed_speed;
            return false;
        }
        const ShapeRow<Degree> all = shapes_.tried(candidate_, candidate_.all_spans());
        const double ratio = interval_ratio(all);
        if (ratio > std::max(settings_.fairness.interval_ratio, interval_ratio_)) {
            ++counts_.missed_intervals;
            return false;
        }
        // Sorting speeds is the dear part: of many knots one more or less moves the median little.
        const long every = 1 + state_.n_points() / kMedianAge;
        if (counts_.accepted % every == 0) median_ = median_speed(all);
        const double critical = settings_.fairness.speed_ratio * median_;
        const double slowest = slowest_speed(all, critical) / median_;
        if (slowest < least * (1.0 - 1e-6)) {
            ++counts_.missed_speed;
            return false;
        }
        long hooks = count_hooks(candidate_, shapes_.tried(candidate_, changed), search_, turning_);
        if (hooks > 0 || n_hooks_ > 0) {  // else there were none before either
            const SpanRange before = with_beside(state_, {window.begin, window.end + 1});
            hooks -= count_hooks(state_, shapes_.kept(state_, before), search_, turning_);
        }
        counts_.missed_hooks += hooks > 0;
        if (hooks > 0) return false;
        const int n_crossings = n_crossings_ + new_crossings(part, all);
        if (n_crossings > std::max(n_data_crossings_, n_crossings_)) {
            ++counts_.missed_crossings;
            return false;
        }
        n_crossings_ = n_crossings;
        n_hooks_ += hooks;
        slowest_ = slowest;
        interval_ratio_ = ratio;
        shapes_.accept();
        return true;
    }
    // Crossings that the candidate has more than the state, looked for where they differ: both lie
    // within the tolerance of the data.
    int new_crossings(const ShapeRow<Degree> &part, const ShapeRow<Degree> &all) {
        Box box;
        for (const auto &[_, shape] : part) box.include(shape->hull);
        const Vec2 margin{2.0 * settings_.fit.tolerance, 2.0 * settings_.fit.tolerance};
        box.include(box.low - margin);
        box.include(box.high + margin);
        const int after = crossings(all, box, flatness());
        if (n_crossings_ == 0) return after;
        return after - crossings(shapes_.kept(state_, state_.all_spans()), box, flatness());
    }
    double flatness() const { return kFlatness * settings_.fit.tolerance; }

    SplineSettings settings_;
    ArcPolyline data_, search_;
    Proof<Degree> proof_;
    SplineState<Degree> state_, candidate_;
    SpanShapes<Degree> shapes_;
    bool from_polyline_ = false;
    int n_data_crossings_ = 0, n_crossings_ = 0;
    TurningSteps turning_;
    long n_hooks_ = 0;
    double median_ = 0.0, slowest_ = 0.0, interval_ratio_ = 0.0;  // slowest in medians
    Window<Degree> window_;
    PNormFit<Degree> fit_;
    RemovalCounts counts_;
    std::map<int, long> failed_at_, changed_at_;  // by knot id, in removals
    std::map<int, double> missed_by_;  // by knot id, distance of its last trial in tolerances
    int consecutive_failures_ = 0;  // knots tried since a removal succeeded
};

}  // namespace shapespline::spline
