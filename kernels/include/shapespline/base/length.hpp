// The length of a vector to half a unit in the last place, whatever the machine's library does.
#pragma once

#include <algorithm>
#include <cmath>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

// A root, and what its square leaves of the sum of squares: each product is exact as two numbers.
inline double length(Vec2 v) {
    const double longer = std::max(std::fabs(v.x), std::fabs(v.y));
    if (!(longer > 0.0)) return longer;
    const int exponent = std::ilogb(longer);
    const double a = std::scalbn(longer, -exponent);
    const double b = std::scalbn(std::min(std::fabs(v.x), std::fabs(v.y)), -exponent);
    const double aa = a * a, bb = b * b, h = std::sqrt(aa + bb), hh = h * h;
    const double rest = ((aa - hh) + bb) +
                        ((std::fma(a, a, -aa) + std::fma(b, b, -bb)) - std::fma(h, h, -hh));
    return std::scalbn(h + rest / (2.0 * h), exponent);
}

}  // namespace shapespline
