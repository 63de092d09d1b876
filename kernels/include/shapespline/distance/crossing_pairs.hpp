// Which polylines cross each other: boxes swept in x, then sides of segments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/base/box_tree.hpp"
#include "shapespline/distance/crossings.hpp"

namespace shapespline {

// Where a point lies of the line through p and q: 1 to the left, -1 to the right, 0 on it. With
// `at_vertices` a point on it lies to the left, so that a way through a vertex is a crossing.
inline int side_of(Vec2 p, Vec2 q, Vec2 r, bool at_vertices) {
    const double area = cross(q - p, r - p);
    if (at_vertices) return area >= 0.0 ? 1 : -1;
    return (area > 0.0) - (area < 0.0);
}

inline bool chords_cross(const Chord &s, const Chord &t, bool at_vertices) {
    const auto parts = [&](const Chord &u, const Chord &v) {
        return side_of(u.begin, u.end, v.begin, at_vertices) *
                   side_of(u.begin, u.end, v.end, at_vertices) < 0;
    };
    return parts(s, t) && parts(t, s);
}

// Pairs of polylines of which a segment crosses one of the other, the smaller index first; polyline
// i has the vertices from starts[i] up to starts[i + 1].
class CrossingPairs {
  public:
    CrossingPairs(std::span<const Vec2> vertices, std::span<const std::int64_t> starts,
                  bool at_vertices)
        : vertices_(vertices), starts_(starts), at_vertices_(at_vertices) {}

    std::vector<std::pair<std::int64_t, std::int64_t>> run() {
        const std::int64_t n = static_cast<long>(starts_.size()) - 1;
        std::vector<Box> boxes(n);
        std::vector<std::int64_t> order(n);
        for (std::int64_t i = 0; i < n; ++i) {
            order[i] = i;
            for (const Vec2 p : vertices_of(i)) boxes[i].include(p);
        }
        std::stable_sort(order.begin(), order.end(), [&](auto i, auto k) {
            return boxes[i].low.x < boxes[k].low.x;
        });
        std::vector<std::pair<std::int64_t, std::int64_t>> found;
        for (std::int64_t at = 0; at < n; ++at)
            for (std::int64_t next = at + 1; next < n; ++next) {
                const auto [i, k] = std::minmax(order[at], order[next]);
                if (boxes[order[next]].low.x > boxes[order[at]].high.x) break;
                if (!boxes[i].meets(boxes[k])) continue;
                const Box common{
                    {std::max(boxes[i].low.x, boxes[k].low.x),
                     std::max(boxes[i].low.y, boxes[k].low.y)},
                    {std::min(boxes[i].high.x, boxes[k].high.x),
                     std::min(boxes[i].high.y, boxes[k].high.y)}};
                gather(i, common, first_);
                gather(k, common, second_);
                if (any_cross()) found.emplace_back(i, k);
            }
        return found;
    }

  private:
    struct Boxed {
        Chord chord;
        Box box;
    };

    std::span<const Vec2> vertices_of(std::int64_t i) const {
        return vertices_.subspan(starts_[i], starts_[i + 1] - starts_[i]);
    }

    // The segments of a polyline whose boxes meet another box, by where they begin in x.
    void gather(std::int64_t i, const Box &within, std::vector<Boxed> &segments) const {
        segments.clear();
        const auto points = vertices_of(i);
        for (std::size_t j = 0; j + 1 < points.size(); ++j) {
            Boxed next{{points[j], points[j + 1]}, {}};
            next.box.include(points[j]);
            next.box.include(points[j + 1]);
            if (next.box.meets(within)) segments.push_back(next);
        }
        std::sort(segments.begin(), segments.end(),
                  [](const Boxed &a, const Boxed &b) { return a.box.low.x < b.box.low.x; });
    }

    bool any_cross() const {
        std::size_t begin = 0;
        double widest = 0.0;
        for (const Boxed &t : second_) widest = std::max(widest, t.box.high.x - t.box.low.x);
        for (const Boxed &s : first_) {
            while (begin < second_.size() && second_[begin].box.low.x + widest < s.box.low.x)
                ++begin;
            for (std::size_t k = begin; k < second_.size(); ++k) {
                const Boxed &t = second_[k];
                if (t.box.low.x > s.box.high.x) break;
                if (s.box.meets(t.box) && chords_cross(s.chord, t.chord, at_vertices_)) return true;
            }
        }
        return false;
    }

    std::span<const Vec2> vertices_;
    std::span<const std::int64_t> starts_;
    bool at_vertices_;
    std::vector<Boxed> first_, second_;
};

}  // namespace shapespline
