// Crossings among segments by a sweep line (Shamos and Hoey 1976) without a status structure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <vector>

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

// Number of crossings among segments: a sweep over them sorted by x. A point on a segment lies to
// the left of it, so that a way through a vertex crosses once, and one that only touches it not at
// all or twice. Neighbours that share an end, to rounding, do not cross: the last one and the first
// of a closed way neither.
inline int count_crossings(std::span<const Chord> chords) {
    const int n = static_cast<int>(chords.size());
    struct Item {
        double low, high;
        int chord;
    };
    std::vector<Item> items(n);
    for (int i = 0; i < n; ++i)
        items[i] = {std::min(chords[i].begin.x, chords[i].end.x),
                    std::max(chords[i].begin.x, chords[i].end.x), i};
    std::sort(items.begin(), items.end(), [](const Item &a, const Item &b) {
        return a.low != b.low ? a.low < b.low : a.chord < b.chord;
    });
    const auto crosses = [&](int i, int k) {
        const auto [a, b] = chords[i];
        const auto [c, d] = chords[k];
        if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
            return false;
        const auto left = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p) >= 0.0; };
        return left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b);
    };
    const int most_apart = n > 0 && closes(chords) ? n - 1 : n;
    int count = 0;
    for (int i = 0; i < n; ++i)
        for (int k = i + 1; k < n && items[k].low <= items[i].high; ++k) {
            const int apart = std::abs(items[i].chord - items[k].chord);
            if (apart > 1 && apart < most_apart && crosses(items[i].chord, items[k].chord)) ++count;
        }
    return count;
}

// Of a polyline with itself.
inline int count_crossings(std::span<const Vec2> vertices) {
    std::vector<Chord> chords;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        chords.push_back({vertices[i], vertices[i + 1]});
    return count_crossings(std::span<const Chord>(chords));
}

}  // namespace shapespline
