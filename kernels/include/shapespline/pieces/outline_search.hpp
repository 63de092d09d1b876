// The whole structured fit of an outline: extensions, path, smooth joints, reduction, in one run.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "shapespline/pieces/joints.hpp"
#include "shapespline/pieces/shortest_path.hpp"

namespace shapespline::pieces {

struct OutlineSearch {
    std::span<const Vec2> data;  // an open outline, or three laps of a closed one and its first
    Index period;                // data of one lap, 0 if open
    Candidates candidates;
    std::vector<Joint> nodes;  // of each candidate
    std::span<const Index> low_turn;  // of each datum of a lap: whether the data hardly turn there
    PiecesSettings settings;
    Interruption &interruption;

    // Ended before there is a path: no sections.
    std::vector<Section> run() const {
        std::vector<Section> path = sections_of_best_path();
        if (path.empty()) return path;
        SectionRing ring(std::move(path), period, settings.ends_fixed);
        JointSmoother smoother(data, ring, settings, low_turn);
        Reduction reducer(data, ring, settings, interruption);
        if (settings.smooth) smoother.run(false);
        reducer.run();
        for (int round = 0; round < 2 && release_corners(ring); ++round) reducer.run();
        if (settings.smooth) {
            drop_degenerate(ring);
            const int cost = ring.cost();
            smoother.run(true);
            // Points that made joints smooth may be too many now that they are.
            if (settings.budget.thorough && ring.cost() > cost) reducer.run();
        }
        return ring.sections();
    }

  private:
    static constexpr double kDegenerate = 1e-3;  // of the tolerance (PIE-12)
    static constexpr int kPathTrials = 200, kPathRounds = 30, kMostStarts = 16;

    // Where no path is fair the best one that keeps the tolerance.
    std::vector<Section> sections_of_best_path() const {
        const std::vector<FeasibleExtension> extensions = all_extensions();
        if (interruption.ended()) return {};
        std::vector<Section> sections = sections_of_best_path(extensions, true);
        if (sections.empty()) sections = sections_of_best_path(extensions, false);
        make_disjoint(sections);
        return sections;
    }

    std::vector<Section> sections_of_best_path(std::vector<FeasibleExtension> extensions,
                                               bool fair) const {
        std::map<std::array<std::size_t, 3>, LawsonResult> fits;
        SectionFairness fairness(data, settings.tolerance);
        std::vector<Section> sections;
        for (int trial = 0; trial < kPathTrials; ++trial) {
            bool all_kept = true;
            sections.clear();
            for (const PathStep &step : best_path(extensions).steps) {
                const auto [at, fresh] = fits.try_emplace({step.from, step.to, step.extension});
                if (fresh) {
                    at->second = fit(extensions[step.extension].cost, step);
                    const bool asked = nodes[step.from].required || nodes[step.to].required;
                    at->second.kept =
                        at->second.kept &&
                        (!fair || asked || !fairness.stands_still(at->second.sections.front()));
                }
                if (!at->second.kept) {
                    shorten(extensions[step.extension], step);
                    all_kept = false;
                }
                sections.push_back(at->second.sections.front());
                sections.back().join_like(nodes[step.from]);
            }
            if (all_kept) break;
        }
        return sections;
    }

    std::vector<FeasibleExtension> all_extensions() const {
        const std::size_t n = candidates.at.size();
        std::vector<std::size_t> barrier(n, n - 1);
        for (std::size_t k = n - 1; k-- > 0;)
            barrier[k] = nodes[k + 1].barred() ? k + 1 : barrier[k + 1];
        const ExtensionSearch search(data, candidates, settings);
        std::vector<FeasibleExtension> extensions;
        for (int cost = 1; cost <= settings.largest_degree; ++cost)
            extensions.push_back(search.run(cost, barrier, interruption));
        for (FeasibleExtension &extension : extensions)
            for (std::size_t k = 0; k + 1 < n; ++k)
                extension.last[k] = std::min(extension.last[k], barrier[k]);
        return extensions;
    }

    // Extensions are nearly monotone only: what the path takes from them is fitted to see.
    LawsonResult fit(int cost, const PathStep &step) const {
        const Index first = candidates.at[step.from], last = candidates.at[step.to];
        const Section start = blank_section(data, first, last, data[first], data[last], cost,
                                            settings.largest_degree);
        if (cost > 1)
            return fit_section(data, start,
                               {settings.tolerance, kPathRounds, most_strays(false),
                                !settings.smooth});
        const ExtensionSearch search(data, candidates, settings);
        return {search.fits(1, first, last), 0.0, {start}};
    }

    Path best_path(const std::vector<FeasibleExtension> &extensions) const {
        const JointCosts costs = settings.smooth ? JointCosts{0.02, 1.0, 1.5} : JointCosts{};
        const PathSearch search(extensions, nodes, costs);
        if (!candidates.closed) return search.run(0, candidates.at.size() - 1);
        Path best;
        for (const std::size_t start : starts(extensions)) {
            Path path = search.run(start, start + candidates.n_starts);
            if (path.cost < best.cost - 1e-9) best = std::move(path);
        }
        return best;
    }

    // A corner is a node of every path, a pinned one too. Without them some node lies in any window
    // that one section can span: the shortest such window is tried, at some places.
    std::vector<std::size_t> starts(const std::vector<FeasibleExtension> &extensions) const {
        for (std::size_t k = 0; k < candidates.n_starts; ++k)
            if (nodes[k].barred()) return {k};
        const auto span = [&](std::size_t k) {
            std::size_t furthest = 0;
            for (const FeasibleExtension &extension : extensions)
                furthest = std::max(furthest, extension.last[k] - k);
            return furthest;
        };
        std::size_t shortest = 0;
        for (std::size_t k = 1; k < candidates.n_starts; ++k)
            if (span(k) < span(shortest)) shortest = k;
        std::vector<std::size_t> result;
        const std::size_t width = span(shortest);
        for (std::size_t w = 0; w <= width; w += std::max<std::size_t>(1, width / kMostStarts))
            result.push_back((shortest + w) % candidates.n_starts);
        return result;
    }

    // A section of the path that cannot be fitted after all reaches one candidate less far; and
    // what starts before it, no farther.
    void shorten(FeasibleExtension &extension, const PathStep &step) const {
        const std::size_t lap = candidates.closed ? candidates.n_starts : 0;
        const std::size_t n = candidates.at.size();
        const auto cut = [&](std::size_t from, std::size_t last) {
            for (std::size_t k = from + 1; k-- > 0 && extension.last[k] > last;)
                extension.last[k] = last;
        };
        const std::size_t from = lap > 0 ? step.from % lap : step.from;
        const std::size_t last = step.to - 1 - (step.from - from);
        cut(from, last);
        if (lap > 0 && from + lap < n) cut(from + lap, std::min(n - 1, last + lap));
    }

    // Sections of a path share the datum at their node; it goes to the later one.
    void make_disjoint(std::vector<Section> &sections) const {
        for (std::size_t i = 0; i < sections.size(); ++i) {
            if (!candidates.closed && i + 1 == sections.size()) break;
            --sections[i].last;
            sections[i].parameters.pop_back();
        }
    }

    // Between two tangent joints a section of next to no length hides a turn: the next one takes
    // its data and its node.
    void drop_degenerate(SectionRing &ring) const {
        for (long i = 0; i < ring.size(); ++i) {
            if (!ring.has(i + 1) || ring.size() <= 2 || ring.at(i + 1).barred()) continue;
            double length = 0.0;
            const Section &degenerate = ring.at(i);
            for (std::size_t k = 1; k < degenerate.points.size(); ++k)
                length += norm(degenerate.points[k] - degenerate.points[k - 1]);
            if (length > kDegenerate * settings.tolerance) continue;
            const std::vector<Section> both = ring.window(i, i + 1);  // on one lap
            Section next = both[1];
            next.points.front() = degenerate.points.front();
            next.first = both[0].first;
            next.parameters.insert(next.parameters.begin(), degenerate.count(), 0.0);
            next.join_like(degenerate);
            next.tangent = false;
            ring.replace(i, i + 1, {next});
        }
    }

    // Corners of the data that the fit hardly turns at: the tolerance allows to round them.
    bool release_corners(SectionRing &ring) const {
        bool any = false;
        for (long i = 0; i < ring.size(); ++i) {
            if (!ring.has(i - 1) || !ring.at(i).corner) continue;
            if (std::fabs(ring.turn(i)) >= settings.least_corner) continue;
            ring.at(i).corner = ring.at(i).tangent = false;
            any = true;
        }
        return any;
    }
};

// An outline as the search wants it: closed data in three laps, candidates in two.
class LaidOutOutline {
  public:
    // What is known about each point: the sum of 1 for a corner that is kept, 2 for a node that
    // stays there, 4 and 8 for a joint that must be tangent to the virtual end extension before and
    // behind it; 1 for a point that must be a candidate node; 1 for one where the data hardly turn.
    struct Marks {
        std::span<const Index> joint, forced, low_turn;
    };

    // Candidates are every `stride`-th point and the forced ones, and more wherever the polyline
    // through them would leave the data by more than `resolution`.
    LaidOutOutline(std::span<const Vec2> points, bool closed, const Marks &marks,
                   const PiecesSettings &settings)
        : n_(static_cast<Index>(points.size())),
          closed_(closed),
          low_turn_(marks.low_turn),
          settings_(settings) {
        for (int lap = 0; lap < (closed ? 3 : 1); ++lap)
            data_.insert(data_.end(), points.begin(), points.end());
        if (closed) data_.push_back(points[0]);
        const std::vector<Index> once = choose(marks.forced);
        candidates_ = {{}, closed ? once.size() : once.size() - 1, closed};
        const auto add = [&](Index at) {
            candidates_.at.push_back(at);
            const Index kind = marks.joint[at % n_];
            nodes_.push_back(
                {(kind & 1) != 0, (kind & 2) != 0, (kind & 12) != 0, (kind & 8) != 0});
        };
        for (int lap = 0; lap < (closed ? 2 : 1); ++lap)
            for (const Index k : once) add(k + (closed ? (lap + 1) * n_ : 0));
        if (closed) add(once[0] + 3 * n_);
    }

    std::vector<Section> search(Interruption &interruption) const {
        return OutlineSearch{data_,     closed_ ? n_ : 0, candidates_, nodes_,
                             low_turn_, settings_,        interruption}
            .run();
    }

  private:
    std::vector<Index> choose(std::span<const Index> forced) const {
        const double limit_sq = settings_.budget.resolution * settings_.budget.resolution;
        std::vector<Index> chosen;
        const auto append = [&](Index at) {
            if (!chosen.empty()) split(chosen.back(), at, limit_sq, chosen);
            chosen.push_back(at);
        };
        for (Index i = 0; i < n_; ++i)
            if (i % settings_.budget.stride == 0 || forced[i] != 0 || (!closed_ && i == n_ - 1))
                append(i);
        if (closed_) split(chosen.back(), n_, limit_sq, chosen);
        return chosen;
    }

    // Appends points between two candidates, halving where the chord is too far from the data.
    void split(Index a, Index b, double limit_sq, std::vector<Index> &chosen) const {
        bool within = true;
        for (Index j = a + 1; j < b && within; ++j)
            within = segment_distance_sq(data_[j], data_[a], data_[b]) <= limit_sq;
        if (within) return;
        const Index middle = (a + b) / 2;
        split(a, middle, limit_sq, chosen);
        chosen.push_back(middle);
        split(middle, b, limit_sq, chosen);
    }

    std::vector<Vec2> data_;
    Index n_;
    bool closed_;
    std::span<const Index> low_turn_;
    PiecesSettings settings_;
    Candidates candidates_;
    std::vector<Joint> nodes_;
};

}  // namespace shapespline::pieces
