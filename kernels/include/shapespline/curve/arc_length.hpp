// How far along a polyline its vertices are.
#pragma once

#include <cmath>
#include <span>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

// One number for each vertex, 0 for the first.
inline void arc_length(std::span<const Vec2> vertices, double *along) {
    double sum = 0.0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (i > 0) {
            const Vec2 step = vertices[i] - vertices[i - 1];
            sum += std::hypot(step.x, step.y);
        }
        *along++ = sum;
    }
}

}  // namespace shapespline
