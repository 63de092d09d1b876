// An outline as lines, arcs and free-form runs of the shortest description (Rissanen 1978):
// dynamic programming over its points (Bellman 1961). A piece costs half its chi squared, a price
// per parameter and what its joint costs; points beside a node may be blunted and do not count.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/base/vec2.hpp"
#include "shapespline/drawn/circle_fit.hpp"
#include "shapespline/drawn/free_form.hpp"
#include "shapespline/drawn/moments.hpp"

namespace shapespline::drawn {

enum Kind : int { kLine, kArc, kFree, kKinds };

// What is drawn seldom costs more: prices of joints in those of a parameter.
struct JointPrices {
    double line_line_smooth, line_arc_smooth, arc_arc_smooth, arc_arc_corner;
    double line_free_smooth, arc_free_smooth, free_corner, arc_free_corner;

    double of(int a, int b, bool smooth) const {
        if (a > b) std::swap(a, b);
        if (b == kLine) return smooth ? line_line_smooth : 0.0;
        if (b == kArc && a == kLine) return smooth ? line_arc_smooth : 0.0;
        if (b == kArc) return smooth ? arc_arc_smooth : arc_arc_corner;
        if (a == kFree) return smooth ? 0.0 : free_corner;
        if (a == kLine) return smooth ? line_free_smooth : free_corner;
        return smooth ? arc_free_smooth : arc_free_corner;
    }
};

struct SegmentationSettings {
    double deviation;   // of a point across the outline
    double skip;        // points this near to a node do not count
    double shortest;    // length of a piece
    double price;       // nats per parameter
    double free_parameters;  // of a free-form curve
    double smooth_turn; // tangent of the largest turn of a smooth joint
    std::int64_t stride;// points between candidates for the nodes of free-form runs
    JointPrices joints;
};

struct DrawnPiece {
    std::int64_t begin, end;
    Kind kind;
};

class Segmentation {
  public:
    // A row of points, their arc lengths and weights; `candidates` are further nodes of free-form
    // runs, `nodes` the points that may be nodes at all, every one if there are none.
    Segmentation(std::span<const Vec2> points, std::span<const double> stations,
                 std::span<const double> weights, std::span<const std::int64_t> candidates,
                 std::span<const std::int64_t> nodes,
                 const SegmentationSettings &settings)
        : points_(points), s_(stations), weights_(weights), settings_(settings),
          moments_(points, weights), n_(points.size()), states_(n_) {
        precision_ = 1.0 / (settings.deviation * settings.deviation);
        // A stretch whose misfit is beyond noise by so much is given up.
        limit_ = 80.0 + 0.6 * std::min(moments_.weight(0, n_ - 1), 400.0);
        near_[0] = beside(settings.skip);
        near_[1] = beside(0.5 * settings.skip);
        lay_candidates(candidates, nodes);
        find_corners();
    }

    std::vector<DrawnPiece> run() {
        for (State &state : states_[0]) state.cost = 0.0;
        for (std::size_t i = 0; i + 1 < n_; ++i) {
            least_ = states_[i][best_at(i)].cost;
            if (least_ == kNever) continue;
            extend_primitives(i);
            if (is_candidate_[i]) extend_free(i);
        }
        return traced_back();
    }

    double cost() const { return states_[n_ - 1][best_at(n_ - 1)].cost; }

  private:
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    static constexpr std::size_t kFewest = 5;  // points of an arc

    struct State {
        double cost = kNever;
        std::size_t from = 0;
        int from_kind = -1;
        Vec2 direction;
    };
    // First point that counts behind each node, last one before each.
    struct Beside {
        std::vector<std::size_t> after, before;
    };
    struct Stretch {
        std::size_t first, last;
    };

    Beside beside(double distance) const {
        Beside found{std::vector<std::size_t>(n_), std::vector<std::size_t>(n_)};
        std::size_t a = 0, b = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            while (a + 1 < n_ && s_[a] < s_[i] + distance) ++a;
            while (b + 1 < n_ && s_[b + 1] <= s_[i] - distance) ++b;
            found.after[i] = a;
            found.before[i] = b;
        }
        return found;
    }

    void lay_candidates(std::span<const std::int64_t> more, std::span<const std::int64_t> nodes) {
        may_be_node_.assign(n_, nodes.empty());
        for (const std::int64_t i : nodes) may_be_node_[i] = 1;
        may_be_node_[0] = may_be_node_[n_ - 1] = 1;
        is_candidate_.assign(n_, 0);
        for (std::size_t i = 0; i < n_; i += settings_.stride) is_candidate_[i] = 1;
        for (const std::int64_t i : more) is_candidate_[i] = 1;
        is_candidate_[0] = is_candidate_[n_ - 1] = 1;
        for (std::size_t i = 0; i < n_; ++i)
            if (is_candidate_[i] && may_be_node_[i]) candidates_.push_back(i);
    }

    // The points that count of a piece between two nodes: of short ones more.
    Stretch counted(std::size_t i, std::size_t j) const {
        const Beside &near = near_[s_[j] - s_[i] < 8.0 * settings_.skip];
        Stretch found{near.after[i], near.before[j]};
        if (found.last < found.first + 2) found = {std::min(i + 1, j), j > 0 ? j - 1 : 0};
        if (found.last < found.first + 2) found = {i, j};
        return found;
    }

    // Points that do not count are paid for as if they lay as near as noise lets them.
    double uncounted(std::size_t i, std::size_t j, double weight) const {
        return 0.5 * (moments_.weight(i, j) - weight);
    }

    void extend_primitives(std::size_t i) {
        for (std::size_t j = i + 1; j < n_; ++j) {
            const double length = s_[j] - s_[i];
            if (!may_be_node_[j] || length < settings_.shortest) continue;
            const Stretch all = counted(i, j);
            double left = extend_primitive(i, j, all, 0.0);
            if (left > settings_.price && between_points(i, j))
                left = std::min(left, extend_primitive(i, j, {all.first + 1, all.last},
                                                       settings_.price));
            if (left > limit_ && length > 3.0 * settings_.shortest) break;
        }
    }

    // A corner may lie between two points, if no picture blunted it: the first of a piece is then
    // the last of the piece before it alone (DRA-15).
    bool between_points(std::size_t i, std::size_t j) const {
        return j > i + 2 && corner_behind_[i];
    }

    // Whether the outline turns at a point or at the next one by as much as half a corner does.
    void find_corners() {
        corner_behind_.assign(n_, 0);
        if (settings_.skip > 0.0) return;
        std::vector<char> turns(n_ + 1, 0);
        const bool closed = norm(points_[0] - points_[n_ - 1]) == 0.0;
        for (std::size_t k = closed ? 0 : 1; k + 1 < n_; ++k) {
            const Vec2 before = points_[k] - points_[k > 0 ? k - 1 : n_ - 2];
            const Vec2 after = points_[k + 1] - points_[k];
            turns[k] = std::abs(cross(before, after)) >
                       0.5 * settings_.smooth_turn * dot(before, after);
        }
        for (std::size_t i = 0; i + 1 < n_; ++i)
            corner_behind_[i] = (turns[i] || turns[i + 1]) &&
                                s_[i + 1] - s_[i] < settings_.shortest;
    }

    // A line and an arc through the points that count; what is left of the better one's misfit
    // beyond noise.
    double extend_primitive(std::size_t i, std::size_t j, Stretch counted, double more) {
        const double price = settings_.price;
        const auto [first, last] = counted;
        const CentralMoments central(moments_.of(first, last));
        const LineFit line = fit_line(central);
        const double rest = uncounted(i, j, central.weight) + more;
        const double of_line = 0.5 * precision_ * line.sum_sq;
        if (may_gain(j, kLine, of_line + rest + 2.0 * price)) {
            Vec2 along = line.direction;
            if (dot(along, points_[j] - points_[i]) < 0.0) along = -1.0 * along;
            offer(i, j, kLine, of_line + rest + 2.0 * price, along, along);
        }
        double least = of_line;
        if (of_line > price && last - first + 1 >= kFewest) {
            const CircleFit circle = fit_circle(central);
            const double of_arc = 0.5 * precision_ * circle.sum_sq;
            if (circle.radius > 0.0 && of_arc + price < of_line) {
                least = of_arc;
                const Vec2 inner = points_[(first + last) / 2];
                const double way =
                    cross(inner - points_[first], points_[last] - inner) > 0.0 ? 1.0 : -1.0;
                const auto tangent = [&](Vec2 p) {
                    const Vec2 out = p - circle.centre;
                    return Vec2{-way * out.y, way * out.x};
                };
                offer(i, j, kArc, of_arc + rest + 3.0 * price, tangent(points_[i]),
                      tangent(points_[j]));
            }
        }
        return least - 0.5 * central.weight;
    }

    void extend_free(std::size_t i) {
        const std::size_t first = near_[0].after[i];
        extend_free(i, first, 0.0);
        if (between_points(i, n_ - 1)) extend_free(i, first + 1, settings_.price);
    }

    void extend_free(std::size_t i, std::size_t first, double more) {
        const double unit = std::max(s_[n_ - 1] - s_[i], 1e-300) / 8.0;
        GrowingQuintic quintic(points_[first], s_[first], unit);
        std::size_t added = first;  // the next point to add
        double misfit = 0.0;
        int hopeless = 0;
        auto at = std::upper_bound(candidates_.begin(), candidates_.end(), i);
        for (; at != candidates_.end() && hopeless < 3; ++at) {
            const std::size_t j = *at, last = near_[0].before[j];
            if (last < first + GrowingQuintic::kTerms + 1) continue;
            for (; added <= last; ++added)
                quintic.add(points_[added], s_[added], weights_[added]);
            const double weight = moments_.weight(first, last);
            const double rest = uncounted(i, j, weight) + more +
                                settings_.free_parameters * settings_.price;
            // Misfit grows with the points.
            if (may_gain(j, kFree, misfit + rest)) {
                const FreeForm found = quintic.solved(s_[i], s_[j]);
                misfit = 0.5 * precision_ * found.sum_sq;
                offer(i, j, kFree, misfit + rest, found.begin, found.end);
            }
            hopeless = misfit - 0.5 * weight > limit_ ? hopeless + 1 : 0;
        }
    }

    // Whether a piece from the node where the search stands may be the cheapest of its kind.
    bool may_gain(std::size_t j, Kind kind, double own) const {
        return least_ + own < states_[j][kind].cost;
    }

    // A piece behind each of the states of its first node.
    void offer(std::size_t i, std::size_t j, Kind kind, double own, Vec2 begin, Vec2 end) {
        State &to = states_[j][kind];
        for (int before = 0; before < (i == 0 ? 1 : static_cast<int>(kKinds)); ++before) {
            const State &state = states_[i][before];
            double cost = state.cost + own;
            if (!(cost < to.cost)) continue;
            if (i > 0) {
                const double along = dot(state.direction, begin);
                const bool smooth = std::abs(cross(state.direction, begin)) <
                                    settings_.smooth_turn * along;
                cost += settings_.price * settings_.joints.of(before, kind, smooth);
            }
            if (cost < to.cost) to = {cost, i, before, end};
        }
    }

    int best_at(std::size_t j) const {
        int best = 0;
        for (int kind = 1; kind < kKinds; ++kind)
            if (states_[j][kind].cost < states_[j][best].cost) best = kind;
        return best;
    }

    std::vector<DrawnPiece> traced_back() const {
        std::vector<DrawnPiece> pieces;
        std::size_t j = n_ - 1;
        int kind = best_at(j);
        if (states_[j][kind].cost == kNever)
            return {{0, static_cast<std::int64_t>(n_ - 1), kFree}};
        while (j > 0) {
            const State &state = states_[j][kind];
            pieces.push_back({static_cast<std::int64_t>(state.from), static_cast<std::int64_t>(j),
                              static_cast<Kind>(kind)});
            j = state.from;
            kind = state.from_kind;
        }
        std::reverse(pieces.begin(), pieces.end());
        return pieces;
    }

    std::span<const Vec2> points_;
    std::span<const double> s_, weights_;
    SegmentationSettings settings_;
    PrefixMoments moments_;
    std::size_t n_;
    std::vector<std::array<State, kKinds>> states_;
    double precision_ = 0.0, limit_ = 0.0, least_ = 0.0;
    std::array<Beside, 2> near_;
    std::vector<char> is_candidate_, may_be_node_, corner_behind_;
    std::vector<std::size_t> candidates_;
};

}  // namespace shapespline::drawn
