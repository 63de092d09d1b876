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
#include "shapespline/drawn/settings.hpp"

namespace shapespline::drawn {

struct DrawnPiece {
    std::int64_t begin, end;
    Kind kind;
};

class Segmentation {
  public:
    // A row of points, their arc lengths and weights; `candidates` are further nodes of free-form
    // runs, `nodes` the points that may be nodes at all, every one if there are none; `directions`
    // are unit vectors along which a line takes one parameter, its offset, instead of two.
    Segmentation(std::span<const Vec2> points, std::span<const double> stations,
                 std::span<const double> weights, std::span<const std::int64_t> candidates,
                 std::span<const std::int64_t> nodes, std::span<const Vec2> directions,
                 const SegmentationSettings &settings)
        : points_(points), directions_(directions), s_(stations), weights_(weights),
          settings_(settings), moments_(points, weights), n_(points.size()), states_(n_) {
        half_precision_ = 0.5 / (settings.deviation * settings.deviation);
        dearest_joint_ = settings.price * settings.joints.dearest();
        // A stretch whose misfit is beyond noise by so much is given up.
        limit_ = 80.0 + 0.6 * std::min(moments_.weight(0, n_ - 1), 400.0);
        near_[0] = beside(settings.lengths.skip);
        near_[1] = beside(0.5 * settings.lengths.skip);
        lay_candidates(candidates, nodes);
        find_corners();
    }

    std::vector<DrawnPiece> run() {
        for (State &state : states_[0]) state.cost = 0.0;
        begin_at(0);
        std::size_t last = 0, last_free = 0;
        for (std::size_t j = 1; j < n_; ++j) {
            if (!may_be_node_[j]) continue;
            reach_ = kNever;
            extend_primitives(j, last);
            last = j;
            if (is_candidate_[j]) {
                extend_free(j, last_free);
                last_free = j;
            }
            if (j + 1 < n_ && states_[j][best_at(j)].cost < kNever) begin_at(j);
        }
        return traced_back();
    }

    double cost() const { return states_[n_ - 1][best_at(n_ - 1)].cost; }

  private:
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    static constexpr std::size_t kFewest = 5;  // points of an arc
    static constexpr int kHopeless = 3;        // free-form runs too far off end the search
    static constexpr double kLong = 8.0;       // a piece is short below so many lengths to skip

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
    // What a line and an arc leave of misfit at least, and the better one beyond noise.
    struct Left {
        double line, arc, beyond;
    };
    // A node where lines and arcs begin, what it costs at least to come there, and what they leave
    // at least up to the nodes that were looked at.
    struct Primitives {
        std::size_t i;
        double least, line = 0.0, arc = 0.0;
        bool is_open = true;
    };
    // A node where free-form runs begin, their first point that counts, what they cost `more`, the
    // next point to add, and what they leave.
    struct FreeForms {
        std::size_t i, first;
        double least, more;
        GrowingQuintic quintic;
        std::size_t added;
        double left = 0.0;
        int hopeless = 0;
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
    }

    // The points that count of a piece between two nodes: of short ones more.
    Stretch counted(std::size_t i, std::size_t j) const {
        const Beside &near = near_[s_[j] - s_[i] < kLong * settings_.lengths.skip];
        Stretch found{near.after[i], near.before[j]};
        if (found.last < found.first + 2) found = {std::min(i + 1, j), j > 0 ? j - 1 : 0};
        if (found.last < found.first + 2) found = {i, j};
        return found;
    }

    // Points that do not count are paid for as if they lay as near as noise lets them.
    double uncounted(std::size_t i, std::size_t j, double weight) const {
        return 0.5 * (moments_.weight(i, j) - weight);
    }

    // Pieces begin in a node once all that end there were looked at.
    void begin_at(std::size_t i) {
        const double least = states_[i][best_at(i)].cost;
        primitives_.push_back({i, least});
        if (!is_candidate_[i]) return;
        const double unit = std::max(s_[n_ - 1] - s_[i], 1e-300) / 8.0;
        const auto begin = [&](std::size_t first, double more) {
            const GrowingQuintic quintic(points_[first], s_[first], unit);
            free_.push_back({i, first, least, more, quintic, first});
        };
        const std::size_t first = near_[0].after[i];
        begin(first, 0.0);
        if (between_points(i, n_ - 1)) begin(first + 1, settings_.price);
    }

    // Lines and arcs from all nodes to one, first from where the cheapest ones to the last node
    // began: dearer ones need not be looked at then.
    void extend_primitives(std::size_t j, std::size_t last) {
        std::erase_if(primitives_, [](const Primitives &from) { return !from.is_open; });
        for (const Kind kind : {kLine, kArc}) {
            const std::size_t i = states_[last][kind].from;
            const auto at = std::ranges::lower_bound(primitives_, i, {}, &Primitives::i);
            if (at != primitives_.end() && at->i == i) extend_primitives(*at, j);
        }
        for (Primitives &from : primitives_) extend_primitives(from, j);
    }

    void extend_primitives(Primitives &from, std::size_t j) {
        const std::size_t i = from.i;
        const double price = settings_.price, length = s_[j] - s_[i];
        if (length < settings_.lengths.shortest) return;
        const bool is_long = length >= kLong * settings_.lengths.skip;
        const bool may_be_last = length > 3.0 * settings_.lengths.shortest;
        const double least_line = (directions_.empty() ? 2.0 : 1.0) * price;
        const bool may_gain = from.least + from.line + least_line <= most_at(j, kLine) ||
                              from.least + from.arc + 3.0 * price <= most_at(j, kArc);
        if (!may_gain && (is_long || !may_be_last)) return;
        const Stretch all = counted(i, j);
        Left left = extend_primitive(from, j, all, 0.0);
        if (left.beyond > price && between_points(i, j)) {
            const Stretch fewer{all.first + 1, all.last};
            const Left other = extend_primitive(from, j, fewer, price);
            left = {std::min(left.line, other.line + price), std::min(left.arc, other.arc + price),
                    std::min(left.beyond, other.beyond)};
        } else if (corner_behind_[i]) {
            left.line = left.arc = 0.0;
        }
        from.is_open = !(left.beyond > limit_ && may_be_last);
        if (!is_long) return;  // of a short piece other points count than of a long one
        from.line = std::max(from.line, left.line);
        from.arc = std::max(from.arc, left.arc);
    }

    // A corner may lie between two points, if no picture blunted it: the first of a piece is then
    // the last of the piece before it alone (DRA-15).
    bool between_points(std::size_t i, std::size_t j) const {
        return j > i + 2 && corner_behind_[i];
    }

    // Whether the outline turns at a point or at the next one by as much as half a corner does.
    void find_corners() {
        corner_behind_.assign(n_, 0);
        if (settings_.lengths.skip > 0.0) return;
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
                                s_[i + 1] - s_[i] < settings_.lengths.gap;
    }

    // A line and an arc through the points that count.
    Left extend_primitive(const Primitives &from, std::size_t j, Stretch counted, double more) {
        const std::size_t i = from.i;
        const double price = settings_.price;
        const auto [first, last] = counted;
        const Moments moments = moments_.of(first, last);
        const Scatter scatter(moments);
        const double noise = 0.5 * scatter.weight;
        const double rest = uncounted(i, j, scatter.weight) + more;
        const double of_line = half_precision_ * off_line(scatter);
        if (from.least + of_line + rest + 2.0 * price <= most_at(j, kLine)) {
            Vec2 along = along_line(scatter);
            if (dot(along, points_[j] - points_[i]) < 0.0) along = -1.0 * along;
            offer(i, j, kLine, of_line + rest + 2.0 * price, along, along);
        }
        for (const Vec2 direction : directions_) {
            const double own = half_precision_ * off_line_along(scatter, direction) + rest + price;
            if (from.least + own > most_at(j, kLine)) continue;
            const double way = dot(direction, points_[j] - points_[i]) < 0.0 ? -1.0 : 1.0;
            offer(i, j, kLine, own, way * direction, way * direction);
        }
        Left left{of_line, std::max(from.arc - more, 0.0), of_line - noise};
        if (of_line <= price || last - first + 1 < kFewest) return left;
        // What an arc that is looked at leaves at most: it is the cheapest, or tells whether longer
        // ones, or those without the first point, are looked at.
        double most = most_at(j, kArc) - from.least - rest - 3.0 * price;
        if (left.beyond > limit_ && s_[j] - s_[i] < kLong * settings_.lengths.skip)
            most = std::max(most, limit_ + noise);
        if (left.beyond > price && between_points(i, j)) most = std::max(most, price + noise);
        const auto dearer = [&](double of_arc) {
            left.arc = std::max(left.arc, of_arc);
            left.beyond = std::min(of_line, left.arc) - noise;
            return left;
        };
        if (left.arc > most) return dearer(0.0);
        const CircleFit circle =
            fit_circle(CentralMoments(scatter, moments), most / half_precision_);
        const double of_arc = half_precision_ * circle.sum_sq;
        if (circle.radius == 0.0) return of_arc > 0.0 ? dearer(of_arc) : left;
        left.arc = std::max(left.arc, of_arc);
        if (of_arc + price >= of_line) return left;
        left.beyond = of_arc - noise;
        const Vec2 inner = points_[(first + last) / 2];
        const double way = cross(inner - points_[first], points_[last] - inner) > 0.0 ? 1.0 : -1.0;
        const auto tangent = [&](Vec2 p) {
            const Vec2 out = p - circle.centre;
            return Vec2{-way * out.y, way * out.x};
        };
        offer(i, j, kArc, of_arc + rest + 3.0 * price, tangent(points_[i]), tangent(points_[j]));
        return left;
    }

    void extend_free(std::size_t j, std::size_t last) {
        std::erase_if(free_, [](const FreeForms &from) { return from.hopeless >= kHopeless; });
        const std::size_t i = states_[last][kFree].from;
        for (FreeForms &from : free_)
            if (from.i == i) extend_free(from, j);
        for (FreeForms &from : free_)
            if (from.i != i) extend_free(from, j);
    }

    void extend_free(FreeForms &from, std::size_t j) {
        const std::size_t i = from.i, first = from.first, last = near_[0].before[j];
        if (last < first + GrowingQuintic::kTerms + 1) return;
        const double weight = moments_.weight(first, last);
        const double rest = uncounted(i, j, weight) + from.more +
                            settings_.free_parameters * settings_.price;
        // Misfit grows with the points.
        if (from.least + from.left + rest <= most_at(j, kFree)) {
            for (; from.added <= last; ++from.added)
                from.quintic.add(points_[from.added], s_[from.added], weights_[from.added]);
            const FreeForm found = from.quintic.solved(s_[i], s_[j]);
            from.left = half_precision_ * found.sum_sq;
            offer(i, j, kFree, from.left + rest, found.begin, found.end);
        }
        from.hopeless = from.left - 0.5 * weight > limit_ ? from.hopeless + 1 : 0;
    }

    // What a way to the end of a piece costs at most: as much as one of its kind that is known, and
    // as the cheapest one if the joint behind that is the dearest.
    double most_at(std::size_t j, Kind kind) const {
        return std::min(states_[j][kind].cost, reach_);
    }

    // A piece behind each of the states of its first node; of equal ones the longest is taken.
    void offer(std::size_t i, std::size_t j, Kind kind, double own, Vec2 begin, Vec2 end) {
        State &to = states_[j][kind];
        for (int before = 0; before < (i == 0 ? 1 : static_cast<int>(kKinds)); ++before) {
            const State &state = states_[i][before];
            double cost = state.cost + own;
            if (cost > to.cost) continue;
            if (i > 0) {
                const double along = dot(state.direction, begin);
                const bool smooth = std::abs(cross(state.direction, begin)) <
                                    settings_.smooth_turn * along;
                cost += settings_.price * settings_.joints.of(before, kind, smooth);
            }
            if (cost < to.cost || (cost == to.cost && i < to.from)) {
                to = {cost, i, before, end};
                reach_ = std::min(reach_, cost + dearest_joint_);
            }
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

    std::span<const Vec2> points_, directions_;
    std::span<const double> s_, weights_;
    SegmentationSettings settings_;
    PrefixMoments moments_;
    std::size_t n_;
    std::vector<std::array<State, kKinds>> states_;
    double half_precision_ = 0.0, limit_ = 0.0, dearest_joint_ = 0.0;
    double reach_ = kNever;  // no dearer way to the node that is looked at is of use
    std::array<Beside, 2> near_;
    std::vector<char> is_candidate_, may_be_node_, corner_behind_;
    std::vector<Primitives> primitives_;
    std::vector<FreeForms> free_;
};

}  // namespace shapespline::drawn
