// Smooth joints: curves that meet smoothly become one spline, lines and curves meet tangentially.
#pragma once

#include <set>
#include <vector>

#include "shapespline/reduction.hpp"

namespace shapespline {

class JointSmoother {
  public:
    // `gentle` tells of each datum of a lap whether the data hardly turn there.
    JointSmoother(std::span<const Vec2> data, SectionRing &ring, double tolerance,
                  int largest_degree, std::span<const Index> gentle)
        : data_(data),
          ring_(ring),
          tolerance_(tolerance),
          largest_degree_(largest_degree),
          gentle_(gentle) {}

    // The last time a joint where the data hardly turn gets more points before it is given up.
    void run(bool last) {
        most_raise_ = last ? kMostRaise : 0;
        while (merge_one()) {
        }
        if (ring_.closed()) start_at_corner();
        for (long i = 1; i < ring_.size(); ++i)
            if (ring_.at(i).required) bend(i);
        for (long i = 0; i < ring_.size(); ++i) mark(i);
        for (long i = 0; i < ring_.size();) i = align_chain(i);
        if (ring_.closed() && ring_.size() > 1) align_seam();
    }

  private:
    static constexpr int kRounds = 20, kAlignRounds = 40, kStartRounds = 12, kMostRaise = 4;
    // A joint that turns more than this, in radians, is not worth the attempt.
    static constexpr double kSteepest = 0.785;
    // In longer chains the sections are not raised one by one.
    static constexpr long kLongChain = 12;

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
            const MinimaxResult merged = merged_section(data_, *at, *(at + 1), cost,
                                                        {tolerance_, kStartRounds},
                                                        largest_degree_);
            if (merged.distance > kWorthFreeing * tolerance_) continue;
            *at = merged.sections.front();
            window.erase(at + 1);
            if (accept(i0, i1, window, kRounds)) return true;
        }
        return false;
    }

    void start_at_corner() {
        for (long i = 0; i < ring_.size(); ++i)
            if (ring_.at(i).barred()) return ring_.rotate(i);
    }

    void mark(long i) { ring_.at(i).tangent = i > 0 && smooth_at(i); }

    bool smooth_at(long i) const {
        const Section &s = ring_.at(i);
        return s.required || (!s.corner && (s.curved() || ring_.at(i - 1).curved()) &&
                              std::fabs(ring_.turn(i)) < kSteepest);
    }

    // Of two lines at a joint that must be tangent the one that is no stub becomes a curve.
    void bend(long i) {
        if (ring_.at(i - 1).curved() || ring_.at(i).curved()) return;
        ring_.at(i).tangent = true;
        const bool at_end = ring_.at(i).at_end;
        const std::vector<int> raise{at_end ? 2 : 0, at_end ? 0 : 2};
        if (!align(i - 1, i, raise)) ring_.at(i).tangent = false;
    }

    // Fits the chain of tangent joints from section i; returns the section to go on with. Where the
    // tolerance forbids it, one curve after another gets a point more, then all of them, then the
    // two sections that turn most some more if the data do not turn, lines too; then the chain is
    // broken there, which is a corner after all (in a long chain at all that turn half as much).
    long align_chain(long i) {
        long last = i;
        while (last + 1 < ring_.size() && ring_.at(last + 1).tangent) ++last;
        if (last == i) return last + 1;
        if (align(i, last)) return last + 1;
        if (!turned_ && turn_to_stubs()) return i;
        const auto turn = [&](long k) {  // what is required is given up last
            return (ring_.at(k).required ? 1e-3 : 1.0) * std::fabs(ring_.turn(k));
        };
        long steepest = i + 1;
        for (long k = i + 2; k <= last; ++k)
            if (turn(k) > turn(steepest)) steepest = k;
        const Section &bend = ring_.at(steepest);
        const bool worth = bend.required || gentle_[ring_.origin(bend)] != 0;
        for (int by = 2; worth && by <= most_raise_; by += 2) {
            std::vector<int> raise(last - i + 1, 0);
            raise[steepest - 1 - i] = raise[steepest - i] = by;
            if (align(i, last, raise)) return last + 1;
        }
        const double least = last - i >= kLongChain ? 0.5 * turn(steepest) : 4.0;
        for (long k = i + 1; k <= last; ++k)
            if (k == steepest || turn(k) >= least) ring_.at(k).tangent = false;
        return i;
    }

    // Short curves at both ends of an open outline turn into the directions of their stubs; once.
    bool turn_to_stubs() {
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
        for (const double reach : {30.0, 10.0, 3.0, 1.0}) {
            const double enough = reach * tolerance_;
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
            const Section stub = ring_.at(at_end ? k : k - 1);
            window.insert(at_end ? window.end() : window.begin(), stub);
            if (accept(k - 1, k, window, kAlignRounds)) return true;
        }
        return false;
    }

    // The joint where the sections of an outline without corners begin and end: turned inside the
    // row, then fitted with its neighbours.
    void align_seam() {
        if (!smooth_at(0)) return;
        const long seam = ring_.size() - ring_.size() / 2;
        ring_.rotate(ring_.size() / 2);
        ring_.at(seam).tangent = true;
        if (!align(std::max(seam - 2, 0L), std::min(seam + 1, ring_.size() - 1)))
            ring_.at(seam).tangent = false;
    }

    // Fits sections first .. last with their tangent joints, some of them raised if need be.
    bool align(long first, long last) {
        for (const std::vector<int> &raise : raises(first, last))
            if (align(first, last, raise)) return true;
        return false;
    }

    bool align(long first, long last, const std::vector<int> &raise) {
        std::vector<Section> window = ring_.window(first, last);
        for (std::size_t k = 0; k < window.size(); ++k)
            if (raise[k] > 0) window[k] = raised(window[k], raise[k]);
        return accept(first, last, window, kAlignRounds);
    }

    // Points to add to each section of a chain, cheapest first.
    std::vector<std::vector<int>> raises(long first, long last) const {
        const std::vector<int> none(last - first + 1, 0);
        std::vector<int> all = none;
        std::vector<std::vector<int>> result{none};
        for (long k = first; k <= last; ++k) {
            if (!ring_.at(k).curved()) continue;
            all[k - first] = 1;
            if (last - first >= kLongChain) continue;
            result.push_back(none);
            result.back()[k - first] = 1;
        }
        result.push_back(all);
        for (int &a : all) a *= 2;
        result.push_back(all);
        return result;
    }

    Section raised(const Section &s, int by) const {
        const Section start = blank_section(data_, s.first, s.last, s.points.front(),
                                            s.points.back(), s.cost() + by, largest_degree_);
        Section result = fit_section(data_, start, {tolerance_, kStartRounds}).sections.front();
        result.join_like(s);
        return result;
    }

    bool accept(long i0, long i1, const std::vector<Section> &window, int rounds) {
        const MinimaxResult result = MinimaxFit(data_, window, ring_.begin_of(i0),
                                                ring_.end_before(i1 + 1), {tolerance_, rounds})
                                         .run();
        if (result.kept) ring_.replace(i0, i1, result.sections);
        return result.kept;
    }

    std::span<const Vec2> data_;
    SectionRing &ring_;
    double tolerance_;
    int largest_degree_, most_raise_ = 0;
    std::span<const Index> gentle_;
    std::set<Index> failed_;
    bool turned_ = false;
};

}  // namespace shapespline
