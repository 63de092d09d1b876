// The maximal feasible extension of a section of each cost from each candidate node.
#pragma once

#include <vector>

#include "shapespline/base/interruption.hpp"
#include "shapespline/pieces/section_fit.hpp"
#include "shapespline/pieces/settings.hpp"

namespace shapespline::pieces {

// Candidate nodes are data indices, increasing. On a closed outline they run over two laps and the
// first n_starts of them are starts; the second lap repeats the first.
struct Candidates {
    std::vector<Index> at;
    std::size_t n_starts;
    bool closed;
};

// A class of sections and the candidates it reaches: last[k] is the last one from candidate k.
struct FeasibleExtension {
    int cost;
    std::vector<std::size_t> last;
};

class ExtensionSearch {
  public:
    // How far curves reach is found from one candidate in `every`, and behind those that no
    // section may reach across.
    ExtensionSearch(std::span<const Vec2> data, const Candidates &candidates,
                    const PiecesSettings &settings)
        : data_(data),
          candidates_(candidates),
          limits_{settings.tolerance, kRounds, most_strays(settings.smooth), !settings.smooth},
          largest_degree_(settings.largest_degree),
          every_(static_cast<std::size_t>(settings.budget.every)) {}

    // Feasibility is nearly monotone: what starts later reaches at least as far. So the search
    // starts at the last answer, gallops and bisects: about 1.5 fits a candidate. A start that is
    // passed over reaches as far as the one before.
    // Ended early, what is left reaches as far as anything might.
    FeasibleExtension run(int cost, const std::vector<std::size_t> &barrier,
              Interruption &interruption) const {
        const std::size_t n = candidates_.at.size(), n_starts = candidates_.n_starts;
        FeasibleExtension extension{cost, std::vector<std::size_t>(n, n - 1)};
        std::size_t last = 1;
        for (std::size_t k = 0; k < n_starts; ++k) {
            if (interruption.ends([] { return 0; })) break;
            last = std::max(last, k + 1);
            if (cost > 1 && k % every_ != 0 && barrier[k - 1] != k) {
                extension.last[k] = last;
                continue;
            }
            // A section of a whole lap would begin and end in one node, a line even without length.
            const std::size_t lap = candidates_.closed ? n_starts - 1 : n_starts;
            const std::size_t top = std::min({n - 1, k + lap, barrier[k]});
            std::size_t good = std::min(last, top), bad = top + 1;
            for (std::size_t step = 1; good < top; step *= 2) {
                const std::size_t next = std::min(good + step, top);
                if (!fits(cost, candidates_.at[k], candidates_.at[next])) {
                    bad = next;
                    break;
                }
                good = next;
            }
            while (bad - good > 1) {
                const std::size_t middle = (good + bad) / 2;
                (fits(cost, candidates_.at[k], candidates_.at[middle]) ? good : bad) = middle;
            }
            extension.last[k] = last = good;
        }
        if (candidates_.closed)
            for (std::size_t k = n_starts; k < n; ++k)
                extension.last[k] = std::min(n - 1, extension.last[k - n_starts] + n_starts);
        return extension;
    }

    bool fits(int cost, Index first, Index last) const {
        if (last - first <= 1) return true;
        const Vec2 begin = data_[first], end = data_[last];
        if (cost == 1) return line_fits(begin, end, first, last);
        // Fewer data than unknowns: what such a fit does between them is verified later.
        if (last - first - 1 < cost - 1) return true;
        return section_fits(data_,
                            blank_section(data_, first, last, begin, end, cost, largest_degree_),
                            limits_);
    }

  private:
    static constexpr int kRounds = 12;

    // The projection on a line is continuous, so the data bound the line's own distance too.
    bool line_fits(Vec2 begin, Vec2 end, Index first, Index last) const {
        const double limit_sq = limits_.tolerance * limits_.tolerance;
        for (Index j = first + 1; j < last; ++j)
            if (segment_distance_sq(data_[j], begin, end) > limit_sq) return false;
        return true;
    }

    std::span<const Vec2> data_;
    const Candidates &candidates_;
    LawsonLimits limits_;
    int largest_degree_;
    std::size_t every_;
};

}  // namespace shapespline::pieces
