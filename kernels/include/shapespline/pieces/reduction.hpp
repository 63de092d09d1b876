// Fewer points by moves on windows of sections whose nodes are free.
//
// A move replaces one, two or three neighbours by something cheaper, then fits it with one or two
// neighbours on each side, all nodes between them unknowns. It is kept when the tolerance is.
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "shapespline/base/interruption.hpp"
#include "shapespline/pieces/section_fairness.hpp"
#include "shapespline/pieces/section_merge.hpp"
#include "shapespline/pieces/section_ring.hpp"
#include "shapespline/pieces/settings.hpp"

namespace shapespline::pieces {

class Reduction {
  public:
    Reduction(std::span<const Vec2> data, SectionRing &ring, const PiecesSettings &settings,
              Interruption &interruption)
        : data_(data), ring_(ring), settings_(settings), interruption_(interruption) {}

    // Moves until none helps any more, or the caller has had enough. What has failed is not tried
    // again, in a later run neither, unless a neighbour or its being a corner has changed.
    void run() {
        for (int pass = 0; pass < settings_.budget.passes; ++pass) {
            bool changed = false;
            for (int side = 1; side <= (settings_.budget.thorough ? 2 : 1); ++side)
                for (long i = 0; i < ring_.size();) {
                    if (interruption_.ends([&] { return n_points(); })) return;
                    const bool moved =
                        demote(i, side) || merge(i, side) || (is_bold(side) && squeeze(i, side));
                    changed |= moved;
                    if (!moved) ++i;
                }
            if (!changed) break;
        }
    }

  private:
    // Minimax rounds of a move; fewer cost points (PIE-14).
    static constexpr int kRounds = 25, kStartRounds = 8;

    long n_points() const { return ring_.cost() + (ring_.closed() ? 0 : 1); }

    // Of bold moves few succeed with more neighbours (measured), but where joints are free. Lines
    // have hardly any others.
    bool is_bold(int side) const {
        if (settings_.largest_degree == 1) return true;
        return settings_.budget.thorough && (side == 1 || !settings_.smooth);
    }

    // One section of one point less.
    bool demote(long i, int side) {
        const Section &s = ring_.at(i);
        return s.curved() && s.count() > 1 && attempt(i, 1, {s.cost() - 1}, side);
    }

    // Two sections into one.
    bool merge(long i, int side) {
        if (!ring_.has(i + 1) || ring_.size() <= 2 || ring_.at(i + 1).barred()) return false;
        const int both = ring_.at(i).cost() + ring_.at(i + 1).cost();
        const int most_saved = is_bold(side) ? 3 : settings_.budget.thorough ? 2 : 1;
        for (int cost = std::max(both - most_saved, 1); cost < both; ++cost)
            if (attempt(i, 2, {cost}, side)) return true;
        return false;
    }

    // Three sections into two.
    bool squeeze(long i, int side) {
        if (!ring_.has(i + 2) || ring_.size() <= 4 || ring_.at(i + 1).barred() ||
            ring_.at(i + 2).barred())
            return false;
        const int a = ring_.at(i).cost(), b = ring_.at(i + 1).cost(), c = ring_.at(i + 2).cost();
        const int total = a + b + c - 1;
        std::set<int> firsts{a, total - c};
        if (b > 1) firsts.insert(a + b / 2);
        for (const int first : firsts)
            if (total - first >= 1 && attempt(i, 3, {first, total - first}, side)) return true;
        return false;
    }

    // Replaces `old` sections from i by sections of the given costs, if that can be fitted.
    bool attempt(long i, long old, const std::vector<int> &costs, int side) {
        if (settings_.largest_degree == 1 && *std::max_element(costs.begin(), costs.end()) > 1)
            return false;
        // A line cannot turn into the direction that it must have.
        const bool required =
            ring_.at(i).required || (ring_.has(i + old) && ring_.at(i + old).required);
        if (required && *std::min_element(costs.begin(), costs.end()) == 1) return false;
        auto [i0, i1] = window_around(i, old, side);
        if (ring_.closed() && i1 - i0 + 1 >= ring_.size()) return false;
        std::vector<Section> window = ring_.window(i0, i1);
        std::vector<Index> key{i - i0, old};
        for (const int c : costs) key.push_back(c);
        for (const Section &s : window)
            key.insert(key.end(), {ring_.origin(s), s.cost(), s.corner});
        if (failed_.contains(key)) return false;
        std::vector<Section> fresh = replacement(window, i - i0, old, costs);
        if (!fresh.empty()) {
            window.erase(window.begin() + (i - i0), window.begin() + (i - i0 + old));
            window.insert(window.begin() + (i - i0), fresh.begin(), fresh.end());
            const LawsonLimits limits{settings_.tolerance, kRounds, most_strays(settings_.smooth)};
            LawsonResult result =
                LawsonFit(data_, window, ring_.begin_of(i0), ring_.end_before(i1 + 1), limits)
                    .run();
            if (result.kept && fairness_.may_replace(ring_, i0, i1, result.sections)) {
                ring_.replace(i0, i1, std::move(result.sections));
                return true;
            }
        }
        failed_.insert(std::move(key));
        return false;
    }

    // `side` neighbours on each side, as far as there are any and the window is not the whole ring.
    std::pair<long, long> window_around(long i, long old, int side) const {
        long i0 = i - side, i1 = i + old - 1 + side;
        if (!ring_.closed()) {
            i0 = std::max(i0, 0L);
            i1 = std::min(i1, ring_.size() - 1);
        }
        while (ring_.closed() && i1 - i0 + 1 >= ring_.size() && i0 < i) {
            ++i0;
            i1 = std::max(i1 - 1, i + old - 1);
        }
        return {i0, i1};
    }

    // Sections to put into a window, none if they are too far from the tolerance even before their
    // nodes are freed.
    std::vector<Section> replacement(const std::vector<Section> &window, long at, long old,
                                     const std::vector<int> &costs) const {
        const Section &a = window[at], &b = window[at + old - 1];
        const Vec2 begin = a.points.front(), end = b.points.back();
        std::vector<LawsonResult> fresh;
        if (costs.size() == 1) {
            if (b.last - a.first < costs[0]) return {};
            fresh.push_back(old == 1 ? section(a.first, b.last, begin, end, costs[0])
                                     : merged_section(data_, a, b, costs[0], start_limits(),
                                                      settings_.largest_degree));
        } else {
            const Section &middle = window[at + 1];
            const Index cut = (middle.first + middle.last) / 2;
            if (cut - a.first < 1 || b.last - cut < 2) return {};
            fresh.push_back(section(a.first, cut, begin, data_[cut], costs[0]));
            fresh.push_back(section(cut + 1, b.last, data_[cut], end, costs[1]));
            fresh[1].sections[0].join_like({.tangent = settings_.smooth});
        }
        fresh[0].sections[0].join_like(a);
        std::vector<Section> sections;
        for (const LawsonResult &result : fresh) {
            if (result.distance > kWorthFreeing * settings_.tolerance) return {};
            sections.push_back(result.sections.front());
        }
        return sections;
    }

    LawsonResult section(Index first, Index last, Vec2 begin, Vec2 end, int cost) const {
        return fitted_section(data_,
                              blank_section(data_, first, last, begin, end, cost,
                                            settings_.largest_degree),
                              start_limits());
    }
    LawsonLimits start_limits() const {
        return {settings_.tolerance, kStartRounds, most_strays(settings_.smooth),
                !settings_.smooth};
    }

    std::span<const Vec2> data_;
    SectionRing &ring_;
    PiecesSettings settings_;
    Interruption &interruption_;
    SectionFairness fairness_{data_, settings_.tolerance};
    std::set<std::vector<Index>> failed_;
};

}  // namespace shapespline::pieces
