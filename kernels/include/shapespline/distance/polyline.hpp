// Distance to a polyline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/base/box_tree.hpp"

namespace shapespline {

// The point of the segment a b that is nearest to p; the end where a and b coincide.
inline Vec2 segment_foot(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 d = b - a;
    const double length_sq = norm_sq(d);
    const double s = length_sq > 0.0 ? std::clamp(dot(p - a, d) / length_sq, 0.0, 1.0) : 0.0;
    return a + s * d;
}

inline double segment_distance_sq(Vec2 p, Vec2 a, Vec2 b) {
    return norm_sq(p - segment_foot(p, a, b));
}

class Polyline {
  public:
    struct Nearest {
        double distance_sq;
        std::size_t segment;
    };

    explicit Polyline(std::span<const Vec2> vertices)
        : vertices_(vertices), tree_(vertices.size() - 1, [&](std::size_t i, Box &box) {
              box.include(vertices[i]);
              box.include(vertices[i + 1]);
          }) {}

    Vec2 vertex(std::size_t i) const { return vertices_[i]; }
    std::size_t n_segments() const { return vertices_.size() - 1; }

    double distance_sq(Vec2 p, std::size_t segment) const {
        return segment_distance_sq(p, vertices_[segment], vertices_[segment + 1]);
    }

    // The nearest segment to p; a hint makes it fast, never wrong.
    Nearest nearest(Vec2 p, std::size_t hint) const {
        Nearest best{std::numeric_limits<double>::infinity(), 0};
        tree_.search(p, best.distance_sq, hint, [&](std::size_t segment) {
            const double d = distance_sq(p, segment);
            if (d < best.distance_sq) best = {d, segment};
        });
        return best;
    }

    // The nearest of the hint and the segments after it where that is near enough: where an outline
    // is retraced thousands of times, the tree looks at every pass.
    Nearest near_enough(Vec2 p, std::size_t hint, double enough_sq) const {
        Nearest best{std::numeric_limits<double>::infinity(), hint};
        const std::size_t end = std::min(hint + kWalk, n_segments());
        for (std::size_t segment = hint; segment < end; ++segment) {
            const double d = distance_sq(p, segment);
            if (d < best.distance_sq) best = {d, segment};
        }
        return best.distance_sq <= enough_sq ? best : nearest(p, best.segment);
    }

    // Calls visit(segment) for all that may come nearer to a box than a distance.
    template <class Visit>
    void visit_near(const Box &box, double distance_sq, Visit &&visit) const {
        tree_.visit_near(box, distance_sq, visit);
    }

  private:
    // The hint and so many less one after it (KER-09).
    static constexpr std::size_t kWalk = 8;

    std::span<const Vec2> vertices_;
    BoxTree tree_;
};

}  // namespace shapespline
