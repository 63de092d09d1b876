// Crossings among segments, looked for where boxes of a tree meet.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/base/box_tree.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline {

struct Chord {
    Vec2 begin, end;
};

// Whether the last one ends where the first one begins, to rounding.
inline bool closes(std::span<const Chord> chords) {
    const Chord &first = chords.front(), &last = chords.back();
    constexpr double kRounding = 1e-9;
    return norm(last.end - first.begin) <=
           kRounding * (norm(first.end - first.begin) + norm(last.end - last.begin));
}

// Rows of segments that go on to one side, each beginning where the one before it ended or beyond:
// the boxes of two that are no neighbours do not meet.
class OneWay {
  public:
    explicit OneWay(std::span<const Chord> chords) : rows_(chords.size()) {
        const auto way = [](double from, double to) { return (to > from) - (to < from); };
        const auto goes_on = [&](double from, double to, double begin, double end) {
            const int before = way(from, to);
            return before != 0 && way(begin, end) == before && way(to, begin) != -before;
        };
        for (std::size_t i = 1; i < chords.size(); ++i) {
            const auto &[a, b] = chords[i - 1];
            const auto &[c, d] = chords[i];
            rows_[i] = {goes_on(a.x, b.x, c.x, d.x) ? rows_[i - 1].x : i,
                        goes_on(a.y, b.y, c.y, d.y) ? rows_[i - 1].y : i};
        }
    }

    bool holds(std::size_t first, std::size_t last) const {
        return rows_[last].x <= first || rows_[last].y <= first;
    }

  private:
    struct Begins {
        std::size_t x = 0, y = 0;  // of the row of each segment, by either coordinate
    };
    std::vector<Begins> rows_;
};

// Number of crossings among segments that come in order along a curve. A point on a segment lies to
// one side of it, so that a way through a vertex crosses once, and one that only touches it not at
// all or twice; of both sides the one with more counts, and mirrored segments cross as often.
// Neighbours that share an end, to rounding, do not cross: the last one and the first of a closed
// way neither.
inline int count_crossings(std::span<const Chord> chords) {
    const std::size_t n = chords.size();
    std::vector<Box> boxes(n);
    const BoxTree tree(n, [&](std::size_t i, Box &box) {
        boxes[i].include(chords[i].begin);
        boxes[i].include(chords[i].end);
        box.include(boxes[i]);
    });
    // Whether two cross if points on a segment lie to the left of it, and if to the right.
    const auto crosses = [&](std::size_t i, std::size_t k) -> std::array<bool, 2> {
        const auto [a, b] = chords[i];
        const auto [c, d] = chords[k];
        const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); };
        const double abc = side(a, b, c), abd = side(a, b, d);
        const double cda = side(c, d, a), cdb = side(c, d, b);
        return {(abc >= 0.0) != (abd >= 0.0) && (cda >= 0.0) != (cdb >= 0.0),
                (abc > 0.0) != (abd > 0.0) && (cda > 0.0) != (cdb > 0.0)};
    };
    const std::size_t most_apart = n > 0 && closes(chords) ? n - 1 : n;
    int left = 0, right = 0;
    const auto visit = [&](std::size_t i, std::size_t k) {
        if (k - i <= 1 || k - i >= most_apart || !boxes[i].meets(boxes[k])) return;
        const auto [on_left, on_right] = crosses(i, k);
        left += on_left;
        right += on_right;
    };
    const OneWay one_way(chords);
    tree.visit_pairs(visit, [&](std::size_t i, std::size_t k) { return one_way.holds(i, k); });
    return std::max(left, right);
}

// Of a polyline with itself.
inline int count_crossings(std::span<const Vec2> vertices) {
    std::vector<Chord> chords;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        chords.push_back({vertices[i], vertices[i + 1]});
    return count_crossings(std::span<const Chord>(chords));
}

}  // namespace shapespline
