// What pieces of an outline may be and what they cost.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

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

    double dearest() const {
        return std::max({line_line_smooth, line_arc_smooth, arc_arc_smooth, arc_arc_corner,
                         line_free_smooth, arc_free_smooth, free_corner, arc_free_corner});
    }
};

struct NodeLengths {
    double skip;      // points this near to a node do not count
    double shortest;  // length of a piece
    double gap;       // longest step beside which a corner may lie between two points
};

struct SegmentationSettings {
    double deviation;   // of a point across the outline
    NodeLengths lengths;
    double price;       // nats per parameter
    double free_parameters;  // of a free-form curve
    double smooth_turn; // tangent of the largest turn of a smooth joint
    std::int64_t stride;// points between candidates for the nodes of free-form runs
    JointPrices joints;
};

}  // namespace shapespline::drawn
