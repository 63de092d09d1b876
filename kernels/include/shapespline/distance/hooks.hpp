// Hooks: places where a curve turns by more than 90 degrees within one tolerance of its length
// and the data by less than 45 within six (PIE-26).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "shapespline/distance/polyline.hpp"

namespace shapespline {

// The nearest place of a side of a polyline, which leads from vertex `side` to the next.
struct Foot {
    long side;
    double share, distance_sq;
};

template <class Vertex>
Foot foot_on(Vec2 place, Vertex &&vertex, long side) {
    const Vec2 begin = vertex(side), along = vertex(side + 1) - begin;
    const double length_sq = norm_sq(along);
    const double share =
        length_sq > 0.0 ? std::clamp(dot(place - begin, along) / length_sq, 0.0, 1.0) : 0.0;
    return {side, share, norm_sq(begin + share * along - place)};
}

// The largest difference of the directions of a polyline's sides within `reach` of arc length
// about a foot; sides first .. last - 1 count.
template <class Vertex>
double turn_around(const Foot &foot, Vertex &&vertex, long first, long last, double reach) {
    const auto side = [&](long j) { return vertex(j + 1) - vertex(j); };
    double low = 0.0, high = 0.0;
    for (const int way : {1, -1}) {
        double turn = 0.0;
        double length = (way > 0 ? 1.0 - foot.share : foot.share) * norm(side(foot.side));
        for (long j = foot.side + way; length < reach && j >= first && j < last; j += way) {
            const Vec2 before = side(j - way), after = side(j);
            turn += std::atan2(cross(before, after), dot(before, after));
            low = std::min(low, turn);
            high = std::max(high, turn);
            length += norm(after);
        }
    }
    return high - low;
}

// The same about the foot of a place on the sides from .. to - 1.
template <class Vertex>
double turn_about(Vec2 place, Vertex &&vertex, long from, long to, long first, long last,
                  double reach) {
    Foot nearest{from, 0.0, INFINITY};
    for (long j = from; j < to; ++j)
        if (const Foot foot = foot_on(place, vertex, j); foot.distance_sq < nearest.distance_sq)
            nearest = foot;
    return turn_around(nearest, vertex, first, last, reach);
}

// A curve in steps, shorter where it bends, and how much it turns along each.
class TurningSteps {
  public:
    explicit TurningSteps(double tolerance) : tolerance_(tolerance) {}

    void clear() {
        steps_.clear();
        direction_ = {};
    }

    // Goes on along a part of the curve, point and velocity functions of its parameter. `owner` is
    // what the data are asked by, `see` hears of the speeds at both ends of every step, and whether
    // it is one of the first `kSteps`.
    template <class Point, class Velocity, class See>
    void add(long owner, Point &&point, Velocity &&velocity, double from, double to, See &&see) {
        const double width = to - from;
        for (int k = 0; k < kSteps; ++k)
            look(owner, point, velocity, from + width * k / kSteps,
                 from + width * (k + 1) / kSteps, kDepth, see);
    }

    void add_line(long owner, Vec2 begin, Vec2 end) {
        turn_to(owner, end - begin, begin);
        steps_.push_back({{}, norm(end - begin), begin, owner});
    }

    // Where hooks are; `data_turn` of a place and owner tells how much the data turn within 2.5
    // tolerances on both sides of it.
    template <class DataTurn>
    std::vector<Vec2> hooks(DataTurn &&data_turn) const {
        std::vector<Vec2> places;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const std::size_t end = sharp_from(i);
            if (end == i) continue;
            const std::size_t middle = (i + end - 1) / 2;
            const Vec2 place = 0.5 * (steps_[i].place + steps_[end - 1].place);
            if (data_turn(place, steps_[middle].owner) >= kDataTurn) continue;
            places.push_back(place);
            i = end - 1;
        }
        return places;
    }
    // Windows of a tolerance whose middle is up to half of one from the turn are looked at.
    double data_reach() const { return kDataReach * tolerance_; }

  private:
    // Steps of a part, and how often they are halved where it bends.
    static constexpr int kSteps = 8, kDepth = 8;
    // Steps that turn by more are halved, down to a part of the tolerance.
    static constexpr double kLargestTurn = 0.35, kShort = 1e-3;
    static constexpr double kHookTurn = 0.5 * std::numbers::pi;
    // Half of six tolerances less the half that windows are shifted by (PIE-27). Rows of pixels
    // turn by the limit itself, up to the grid of a pose: that is no excuse for a hook.
    static constexpr double kDataTurn = 0.25 * std::numbers::pi * (1 + 1e-3), kDataReach = 2.5;

    // The turn from a direction to another; its angle is told where it is asked for, as few are.
    struct Turn {
        double across = 0.0, along = 1.0;

        Turn() = default;
        Turn(Vec2 a, Vec2 b) : across(cross(a, b)), along(dot(a, b)) {}
        double angle() const {
            if (std::isnan(angle_)) angle_ = std::atan2(across, along);
            return angle_;
        }
        // The angle is no larger.
        double most() const {
            constexpr double kRounding = 1e-12;
            return along > 0.0 ? (1.0 + kRounding) * std::fabs(across) / along : INFINITY;
        }
        bool is_none() const {
            constexpr double kClearly = 1e-100;  // over this the angle is no zero
            const bool clear = std::fabs(across) > kClearly && std::fabs(along) < 1.0 / kClearly;
            return !clear && angle() == 0.0;
        }
        bool is_large() const {
            const bool small = std::fabs(across) < kLargestTurn * along;  // tangents are larger
            return !small && std::fabs(angle()) > kLargestTurn;
        }

      private:
        mutable double angle_ = std::numeric_limits<double>::quiet_NaN();
    };
    struct Step {
        Turn turn;
        double length;
        Vec2 place;  // where it begins
        long owner;
    };

    // The turn between parts.
    void turn_to(long owner, Vec2 direction, Vec2 place) {
        if (!(norm_sq(direction) > 0.0)) return;
        // Nothing is before the first part: the angle to no direction could be a half turn of -0.
        const bool first = direction_.x == 0.0 && direction_.y == 0.0;
        const Turn turn = first ? Turn() : Turn(direction_, direction);
        if (!turn.is_none()) steps_.push_back({turn, 0.0, place, owner});
        direction_ = direction;
    }

    template <class Point, class Velocity, class See>
    void look(long owner, Point &&point, Velocity &&velocity, double from, double to, int depth,
              See &&see) {
        const Vec2 before = velocity(from), after = velocity(to), begin = point(from);
        const Turn turn(before, after);
        const double length = norm(point(to) - begin);
        if (depth > 0 && turn.is_large() && length > kShort * tolerance_) {
            const double middle = 0.5 * (from + to);
            look(owner, point, velocity, from, middle, depth - 1, see);
            look(owner, point, velocity, middle, to, depth - 1, see);
            return;
        }
        see(norm(before), norm(after), depth == kDepth);
        turn_to(owner, before, begin);
        steps_.push_back({turn, length, begin, owner});
        if (norm_sq(after) > 0.0) direction_ = after;
    }

    // One past the last of the fewest steps from i on that turn by more than a hook within one
    // tolerance; i if there are none.
    std::size_t sharp_from(std::size_t i) const {
        double most = 0.0, way = 0.0;
        for (std::size_t k = i; k < steps_.size() && most <= kHookTurn; ++k) {
            way += steps_[k].length;
            if (way > tolerance_) return i;
            most += steps_[k].turn.most();
        }
        double turn = 0.0, low = 0.0, high = 0.0, length = 0.0;
        for (std::size_t k = i; k < steps_.size(); ++k) {
            length += steps_[k].length;
            if (length > tolerance_) return i;
            turn += steps_[k].turn.angle();
            low = std::min(low, turn);
            high = std::max(high, turn);
            if (high - low > kHookTurn) return k + 1;
        }
        return i;
    }

    double tolerance_;
    Vec2 direction_{};
    std::vector<Step> steps_;
};

// Where hooks are of a curve, given by its chords, beside a data polyline. Where data pass several
// times within a tolerance the pass that turns most counts: the curve may stand for it. Of closed
// data, what ends where it begins is looked at across its seam, where a hook may be named twice.
inline std::vector<Vec2> hook_places(std::span<const Vec2> chords, std::span<const Vec2> polyline,
                                     double tolerance, bool closed_data) {
    const auto is_closed = [&](std::span<const Vec2> line) {
        return closed_data && line.front().x == line.back().x && line.front().y == line.back().y;
    };
    TurningSteps turning(tolerance);
    for (std::size_t i = 0; i + 1 < chords.size(); ++i)
        turning.add_line(0, chords[i], chords[i + 1]);
    double beyond = is_closed(chords) ? tolerance : 0.0;
    for (std::size_t i = 0; i + 1 < chords.size() && beyond > 0.0; ++i) {
        turning.add_line(0, chords[i], chords[i + 1]);
        beyond -= norm(chords[i + 1] - chords[i]);
    }
    const long n = static_cast<long>(polyline.size()) - 1;
    const bool closed = is_closed(polyline);
    const auto vertex = [&](long j) { return polyline[closed ? (j % n + n) % n : j]; };
    const long first = closed ? -n : 0, last = closed ? 2 * n : n;
    const Polyline data(polyline);
    std::vector<Foot> near;
    return turning.hooks([&](Vec2 place, long) {
        const auto turn = [&](const Foot &foot) {
            return turn_around(foot, vertex, first, last, turning.data_reach());
        };
        Box about;
        about.include(place);
        near.clear();
        data.visit_near(about, tolerance * tolerance, [&](std::size_t j) {
            near.push_back(foot_on(place, vertex, static_cast<long>(j)));
        });
        std::erase_if(near, [&](const Foot &f) { return f.distance_sq > tolerance * tolerance; });
        std::sort(near.begin(), near.end(),
                  [](const Foot &a, const Foot &b) { return a.side < b.side; });
        if (near.empty())
            return turn(foot_on(place, vertex, static_cast<long>(data.nearest(place, 0).segment)));
        double most = 0.0;
        for (std::size_t i = 0, end; i < near.size(); i = end) {
            Foot nearest = near[i];
            for (end = i + 1; end < near.size() && near[end].side == near[end - 1].side + 1; ++end)
                if (near[end].distance_sq < nearest.distance_sq) nearest = near[end];
            most = std::max(most, turn(nearest));
        }
        return most;
    });
}

}  // namespace shapespline
