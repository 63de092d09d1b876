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
    tree.visit_pairs([&](std::size_t i, std::size_t k) {
        if (k - i <= 1 || k - i >= most_apart || !boxes[i].meets(boxes[k])) return;
        const auto [on_left, on_right] = crosses(i, k);
        left += on_left;
        right += on_right;
    });
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
