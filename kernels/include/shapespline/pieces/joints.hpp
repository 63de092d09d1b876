// Smooth joints: curves that meet smoothly become one spline, lines and curves meet tangentially.
#pragma once

#include <set>
#include <vector>

#include "shapespline/pieces/section_fairness.hpp"
#include "shapespline/pieces/reduction.hpp"

namespace shapespline::pieces {

class JointSmoother {
  public:
    // `low_turn` tells of each datum of a lap whether the data hardly turn there.
    JointSmoother(std::span<const Vec2> data, SectionRing &ring, const PiecesSettings &settings,
                  std::span<const Index> low_turn)
        : data_(data),
          ring_(ring),
          tolerance_(settings.tolerance),
          largest_degree_(settings.largest_degree),
          low_turn_(low_turn) {}

    // The first time neighbours are merged, too; the last time a joint where the data hardly turn
    // gets more points before it is given up.
    void run(bool last) {
        most_raise_ = last ? kMostRaise : 0;
        while (!last && merge_one()) {
        }
        if (ring_.closed()) start_at_corner();
        for (long i = 1; i < ring_.size(); ++i)
            if (ring_.at(i).required) bend(i);
        for (long i = 0; i < ring_.size(); ++i) mark(i);
        for (long i = 0; i < ring_.size();) i = align_chain(i);
        if (ring_.closed() && ring_.size() > 1) smooth_seam();
    }

  private:
    // Minimax rounds of a joint (PIE-11), and points that may make one smooth (PIE-13).
    static constexpr int kRounds = 20, kStartRounds = 12, kMostRaise = 4;
    // A joint that turns more than this, in radians, is not worth the attempt, unless it is a hook
    // where the data hardly turn (PIE-28).
    static constexpr double kSteepest = 0.785;
    // A joint that was made tangent turns less: the values' CORNER_TURN but for the fifth digit.
    static constexpr double kTangent = 1.01 / 57.3;
    static constexpr int kStrays = 3;  // rounds with stray curves (PIE-11)
    static constexpr int kWidest = 2;  // sections on either side of one joint (PIE-10)

    // A curve-curve joint that is no corner costs fewer points inside one spline: C1 saves one,
    // C2 two. The splines that fail are not tried again.
    bool merge_one() {
        for (long i = 0; i < (ring_.closed() ? ring_.size() : ring_.size() - 1); ++i) {
            const Section &a = ring_.at(i), &b = ring_.at(i + 1);
            if (ring_.size() <= 2 || !a.curved() || !b.curved() || b.barred()) continue;
            if (failed_.contains(ring_.origin(b))) continue;
            if (!merge(i)) failed_.insert(ring_.origin(b));
            return true;
        }
        return false;
    }

    bool merge(long i) {
        const int both = ring_.at(i).cost() + ring_.at(i + 1).cost();
        for (int cost = std::max(both - 2, 3); cost <= both + 2; ++cost) {
            const long i0 = ring_.has(i - 1) && ring_.size() > 3 ? i - 1 : i;
            const long i1 = ring_.has(i + 2) && ring_.size() > 3 ? i + 2 : i + 1;
            std::vector<Section> window = ring_.window(i0, i1);
            const auto at = window.begin() + (i - i0);
            const LawsonResult merged = merged_section(data_, *at, *(at + 1), cost,
                                                        {tolerance_, kStartRounds},
                                                        largest_degree_);
            if (merged.distance > kWorthFreeing * tolerance_) continue;
            *at = merged.sections.front();
            window.erase(at + 1);
            if (accept(i0, i1, window)) return true;
        }
        return false;
    }

    void start_at_corner() {
        for (long i = 0; i < ring_.size(); ++i)
            if (ring_.at(i).barred()) return ring_.rotate(i);
    }

    void mark(long i) { ring_.at(i).tangent = i > 0 && smooth_at(i); }

    bool smooth_at(long i) {
        const Section &s = ring_.at(i);
        if (s.required) return true;
        if (s.corner || !(s.curved() || ring_.at(i - 1).curved())) return false;
        return std::fabs(ring_.turn(i)) < kSteepest ||
               (low_turn_[ring_.origin(s)] != 0 && fairness_.n_unfair(ring_.window(i - 1, i)) > 0);
    }

    // Of two lines at a joint that must be tangent the one that is no virtual extension becomes a
    // curve.
    void bend(long i) {
        if (ring_.at(i - 1).curved() || ring_.at(i).curved()) return;
        ring_.at(i).tangent = true;
        const bool at_end = ring_.at(i).at_end;
        const std::vector<int> raise{at_end ? 2 : 0, at_end ? 0 : 2};
        asks_ = Asks::kNothing;  // it is required
        if (!align(i - 1, i, raise)) ring_.at(i).tangent = false;
        asks_ = Asks::kFair;
    }

    // Fits the chain of tangent joints from section i as a whole; where the tolerance forbids it,
    // one joint after another that is not tangent yet, required ones first. Returns the section to
    // go on with.
    long align_chain(long i) {
        long last = i;
        while (last + 1 < ring_.size() && ring_.at(last + 1).tangent) ++last;
        if (last == i || align(i, last, std::vector<int>(last - i + 1, 0))) return last + 1;
        for (long k = i + 1; k <= last; ++k)
            ring_.at(k).tangent =
                !ring_.at(k).required && std::fabs(ring_.turn(k)) <= kTangent;
        for (const bool required : {true, false})
            for (long k = i + 1; k <= last; ++k) {
                if (ring_.at(k).tangent || ring_.at(k).required != required) continue;
                smooth(k);
                if (merges_at(k)) {
                    --k, --last;
                    continue;
                }
                if (!required || ring_.at(k).tangent || turned_ || !turn_to_extensions()) continue;
                for (long j = i + 1; j < ring_.size(); ++j) mark(j);
                return i;
            }
        return last + 1;
    }

    // Where the data do not turn, what no more points make smooth is one curve, the last time.
    bool merges_at(long k) {
        const Section &s = ring_.at(k);
        return most_raise_ > 0 && !s.tangent && !s.required && !s.barred() &&
               ring_.size() > 2 && low_turn_[ring_.origin(s)] != 0 && merge(k - 1);
    }

    // Makes one joint tangent: by its neighbours, else with a point more in one of the curves that
    // meet there, in both, or two. Where the data do not turn lines get them too, and some more;
    // else the joint is a corner after all.
    void smooth(long k) {
        const bool before = ring_.at(k - 1).curved(), after = ring_.at(k).curved();
        const bool required = ring_.at(k).required;  // beside an extension, which stays a line
        const bool worth = required || low_turn_[ring_.origin(ring_.at(k))] != 0;
        std::vector<std::pair<int, int>> raises{{0, 0}};
        if (before) raises.emplace_back(1, 0);
        if (after) raises.emplace_back(0, 1);
        if (before && after) raises.insert(raises.end(), {{1, 1}, {2, 2}});
        for (int by = 2; worth && by <= (required ? kMostRaise : most_raise_); by += 2)
            raises.emplace_back(required && !before ? 0 : by, required && !after ? 0 : by);
        ring_.at(k).tangent = true;
        refused_ = false;
        if (align_by(k, raises)) return;
        // A turn is seen more than a section that nearly stands still somewhere, less than a hook.
        asks_ = required ? Asks::kNothing : Asks::kNoHook;
        ring_.at(k).tangent = refused_ && align_by(k, raises);
        asks_ = Asks::kFair;
    }

    bool align_by(long k, const std::vector<std::pair<int, int>> &raises) {
        for (const auto &raise : raises)
            for (int side = 1; side <= kWidest; ++side)
                if (align_around(k, side, raise)) return true;
        return false;
    }

    // With so many sections on either side, the two beside the joint raised.
    bool align_around(long k, int side, std::pair<int, int> by) {
        const long first = std::max(k - side, 0L);
        const long last = std::min(k - 1 + side, ring_.size() - 1);
        std::vector<int> raise(last - first + 1, 0);
        raise[k - 1 - first] = by.first;
        raise[k - first] = by.second;
        return align(first, last, raise);
    }

    // Short curves at both ends of an open outline turn into the directions of their virtual
    // extensions; once.
    bool turn_to_extensions() {
        turned_ = true;
        bool any = false;
        for (const bool at_end : {false, true})
            for (long k = 1; k < ring_.size(); ++k) {
                if (!ring_.at(k).required || ring_.at(k).at_end != at_end) continue;
                // The other end is not asked to be right already.
                for (long other = 1; other < ring_.size(); ++other)
                    if (ring_.at(other).required) ring_.at(other).tangent = other == k;
                any |= turn_at(k);
                break;
            }
        for (long k = 1; k < ring_.size(); ++k) ring_.at(k).tangent |= ring_.at(k).required;
        return any;
    }

    bool turn_at(long k) {
        const bool at_end = ring_.at(k).at_end;
        const Section whole = ring_.at(at_end ? k - 1 : k);
        const Vec2 node = at_end ? whole.points.back() : whole.points.front();
        for (const double tolerances : {30.0, 10.0, 3.0, 1.0}) {
            const double enough = tolerances * tolerance_;
            Index cut = at_end ? whole.last : whole.first;
            while (cut > whole.first && at_end && norm(data_[cut] - node) < enough) --cut;
            while (cut < whole.last && !at_end && norm(data_[cut] - node) < enough) ++cut;
            if (cut - whole.first < 2 || whole.last - cut < 2) continue;
            const auto part = [&](Index first, Index last, Vec2 begin, Vec2 end, bool is_near) {
                const int cost = is_near ? kSectionDegree : std::max(whole.cost(), 2);
                return fit_section(data_,
                                   blank_section(data_, first, last, begin, end, cost,
                                                 largest_degree_),
                                   {tolerance_, kStartRounds})
                    .sections.front();
            };
            std::vector<Section> window{
                part(whole.first, cut, whole.points.front(), data_[cut], !at_end),
                part(cut + 1, whole.last, data_[cut], whole.points.back(), at_end)};
            window[0].join_like(whole);
            window[1].join_like({.tangent = true});
            const Section extension = ring_.at(at_end ? k : k - 1);
            window.insert(at_end ? window.end() : window.begin(), extension);
            if (accept(k - 1, k, window)) return true;
        }
        return false;
    }

    // The joint where the sections of an outline without corners begin and end, turned inside the
    // row.
    void smooth_seam() {
        if (!smooth_at(0)) return;
        const long seam = ring_.size() - ring_.size() / 2;
        ring_.rotate(ring_.size() / 2);
        smooth(seam);
    }

    // Fits sections first .. last with their tangent joints, some of them raised.
    bool align(long first, long last, const std::vector<int> &raise) {
        std::vector<Section> window = ring_.window(first, last);
        for (std::size_t k = 0; k < window.size(); ++k)
            if (raise[k] > 0) window[k] = raised(window[k], raise[k]);
        return accept(first, last, window);
    }

    Section raised(const Section &s, int by) const {
        const Section start = blank_section(data_, s.first, s.last, s.points.front(),
                                            s.points.back(), s.cost() + by, largest_degree_);
        Section result = fit_section(data_, start, {tolerance_, kStartRounds}).sections.front();
        result.join_like(s);
        return result;
    }

    bool accept(long i0, long i1, const std::vector<Section> &window) {
        const LawsonLimits limits{tolerance_, kRounds, kStrays};
        LawsonResult result =
            LawsonFit(data_, window, ring_.begin_of(i0), ring_.end_before(i1 + 1), limits).run();
        if (!result.kept) return false;
        if (asks_ != Asks::kNothing &&
            !fairness_.may_replace(ring_, i0, i1, result.sections, asks_ == Asks::kFair)) {
            refused_ = true;
            return false;
        }
        ring_.replace(i0, i1, std::move(result.sections));
        return true;
    }

    std::span<const Vec2> data_;
    SectionRing &ring_;
    double tolerance_;
    int largest_degree_, most_raise_ = 0;
    std::span<const Index> low_turn_;
    std::set<Index> failed_;
    bool turned_ = false;
    SectionFairness fairness_{data_, tolerance_};
    // What sections that make a joint smooth must not have: near-cusps and hooks, or hooks.
    enum class Asks { kFair, kNoHook, kNothing };
    Asks asks_ = Asks::kFair;
    bool refused_ = false;
};

}  // namespace shapespline::pieces
