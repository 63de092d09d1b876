// Cone intersection: fewer vertices for the same polyline, in one pass.
//
// From a vertex that is kept the chord to a later one passes within a distance of all between if it
// lies in the cones that their discs span (Williams 1978; Sklansky and Gonzalez 1980).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

// Directions from a vertex that pass every disc met so far.
class ChordCone {
  public:
    explicit ChordCone(double radius) : radius_sq_(radius * radius), radius_(radius) {}

    // Whether the chord to a point passes within the radius of all that were added, in their order
    // or in one that goes back by no more than the radius.
    bool contains(Vec2 v) const {
        return norm_sq(v) >= farthest_sq_ &&
               (open_ || (cross(low_, v) >= 0.0 && cross(v, high_) >= 0.0 &&
                          dot(low_ + high_, v) > 0.0));
    }
    bool empty() const { return empty_; }

    void add(Vec2 v) {
        const double length_sq = norm_sq(v);
        farthest_sq_ = std::max(farthest_sq_, length_sq);
        const double along_sq = length_sq - radius_sq_;
        if (!(along_sq > 0.0)) return;  // the vertex itself is near enough
        const double along = std::sqrt(along_sq);
        const Vec2 low{v.x * along + v.y * radius_, v.y * along - v.x * radius_};
        const Vec2 high{v.x * along - v.y * radius_, v.y * along + v.x * radius_};
        if (open_) {
            open_ = false;
            low_ = low;
            high_ = high;
            return;
        }
        // A disc behind leaves no direction.
        empty_ = empty_ || !(dot(low_ + high_, v) > 0.0) || cross(low_, high) < 0.0 ||
                 cross(low, high_) < 0.0;
        if (cross(low_, low) > 0.0) low_ = low;
        if (cross(high, high_) > 0.0) high_ = high;
    }

  private:
    double radius_sq_, radius_, farthest_sq_ = 0.0;
    bool open_ = true, empty_ = false;
    Vec2 low_{}, high_{};
};

// Indices of vertices, the first and the last among them, such that all between two of them lie
// within a distance of their chord, the chord within it of the polyline, and no chord skips over a
// longer way than `longest`. What is marked is kept.
inline std::vector<std::int64_t> thinned(std::span<const Vec2> points, double distance,
                                         double longest,
                                         std::span<const std::int64_t> marked = {}) {
    constexpr std::int64_t kPatience = 8;
    const auto n = static_cast<std::int64_t>(points.size());
    std::vector<std::int64_t> kept{0};
    while (kept.back() + 1 < n) {
        const std::int64_t from = kept.back();
        std::int64_t reached = from + 1;
        ChordCone cone(distance);
        double way = 0.0;
        // Looks on past vertices that cannot end the chord, but not far: the pass stays linear.
        for (std::int64_t j = from + 1; j < n && j <= from + 2 * (reached - from) + kPatience;
             ++j) {
            way += norm(points[j] - points[j - 1]);
            const Vec2 v = points[j] - points[from];
            if (cone.empty() || (way > longest && j > from + 1)) break;
            if (cone.contains(v)) reached = j;
            if (!marked.empty() && marked[j] != 0) break;
            cone.add(v);
        }
        kept.push_back(reached);
    }
    return kept;
}

}  // namespace shapespline
