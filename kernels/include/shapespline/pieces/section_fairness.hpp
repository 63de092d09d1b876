// Whether sections look like their data: no near-cusp inside, no hook that the data have not.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/distance/hooks.hpp"
#include "shapespline/pieces/section_ring.hpp"

namespace shapespline::pieces {

// A near-cusp: the slowest place of a section has less than a fiftieth of its middle speed. Hooks
// are those of hooks.hpp, across joints, too.
class SectionFairness {
  public:
    SectionFairness(std::span<const Vec2> data, double tolerance)
        : data_(data), turning_(tolerance) {}

    // Whether a section has a near-cusp.
    bool stands_still(const Section &section) {
        turning_.clear();
        return stands_still(0, section);
    }

    // Whether the sections i0 .. i1 of a ring may become others: there are no more near-cusps and
    // hooks than before, the joints with their neighbours among them; or no more hooks.
    bool may_replace(const SectionRing &ring, long i0, long i1, std::span<const Section> fresh,
                     bool near_cusps_count = true) {
        const bool all = i1 - i0 + 1 == ring.size();
        const long before = !all && ring.has(i0 - 1), after = !all && ring.has(i1 + 1);
        std::vector<Section> old = ring.window(i0 - before, i1 + after);
        std::vector<Section> now(old.begin(), old.begin() + before);
        // The window of the neighbours, too, may be one lap further.
        const Index shift = old[before].first - fresh.front().first;
        for (const Section &section : fresh) now.push_back(moved(section, shift));
        now.insert(now.end(), old.end() - after, old.end());
        if (ring.closed() && all)
            for (auto *sections : {&old, &now})
                sections->push_back(moved(sections->front(), ring.period()));
        // More than a lap may leave the three of the data.
        const Index n = static_cast<Index>(data_.size());
        if (ring.closed() && now.back().last >= n)
            for (auto *sections : {&old, &now})
                for (Section &section : *sections) section = moved(section, -ring.period());
        const long found = n_unfair(now, near_cusps_count);
        return found == 0 || found <= n_unfair(old, near_cusps_count);
    }

    // Near-cusps, if they count, and hooks of sections end to end. A direction that was asked for
    // may need a turn that the data have not: beside it all is fair.
    long n_unfair(std::span<const Section> sections, bool near_cusps_count = true) {
        long count = 0;
        turning_.clear();
        for (std::size_t i = 0; i < sections.size(); ++i) {
            const bool asked = sections[i].required ||
                               (i + 1 < sections.size() && sections[i + 1].required);
            if (asked) {
                count += n_hooks(sections);
                turning_.clear();
            } else {
                const bool near_cusp = stands_still(static_cast<long>(i), sections[i]);
                count += near_cusps_count && near_cusp;
            }
        }
        return count + n_hooks(sections);
    }

  private:
    static constexpr double kNearCusp = 0.02;  // of the middle speed (PIE-26)

    static Section moved(Section section, Index by) {
        section.first += by;
        section.last += by;
        return section;
    }

    // Whether a section has a near-cusp; its steps are added.
    bool stands_still(long owner, const Section &section) {
        if (section.degree == 1) {
            turning_.add_line(owner, section.points.front(), section.points.back());
            return false;
        }
        const SectionView all = view(section);
        taylor_.resize(all.n_spans());
        spans_.resize(all.n_spans());
        expand_spans(all, taylor_.data(), spans_.data());
        speeds_.clear();
        double slowest = std::numeric_limits<double>::infinity();
        const auto see = [&](double begin, double end, bool first) {
            slowest = std::min({slowest, begin, end});
            if (first || speeds_.empty()) speeds_.push_back(begin);
        };
        for (const SpanPolynomial &span : spans_)
            turning_.add(
                owner, [&](double v) { return span.point(v); },
                [&](double v) { return span.velocity(v); }, 0.0, span.width, see);
        std::nth_element(speeds_.begin(), speeds_.begin() + speeds_.size() / 2, speeds_.end());
        return slowest < kNearCusp * speeds_[speeds_.size() / 2];
    }

    long n_hooks(std::span<const Section> sections) const {
        const long n = static_cast<long>(data_.size());
        const auto places = turning_.hooks([&](Vec2 place, long owner) {
            // The foot may belong to a neighbour, or lie between two sections.
            const long count = static_cast<long>(sections.size());
            const Section &first = sections[std::max(owner - 1, 0L)];
            const Section &last = sections[std::min(owner + 1, count - 1)];
            return turn_about(
                place, [&](long j) { return data_[j]; }, std::max<long>(first.first - 1, 0),
                std::min<long>(last.last + 1, n - 1), 0, n - 1, turning_.data_reach());
        });
        return static_cast<long>(places.size());
    }

    std::span<const Vec2> data_;
    TurningSteps turning_;
    std::vector<BasisTaylor> taylor_;
    std::vector<SpanPolynomial> spans_;
    std::vector<double> speeds_;
};

}  // namespace shapespline::pieces
