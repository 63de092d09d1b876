// Sums of powers of coordinates over stretches of points, by prefix sums: all that the best line
// and the best circle of a stretch need.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline::drawn {

// Sums over points of weight times powers; z is x^2 + y^2.
struct Moments {
    double w = 0.0, x = 0.0, y = 0.0;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    double xz = 0.0, yz = 0.0, zz = 0.0;
};

inline Moments operator+(const Moments &a, const Moments &b) {
    return {a.w + b.w,   a.x + b.x,   a.y + b.y,   a.xx + b.xx, a.xy + b.xy,
            a.yy + b.yy, a.xz + b.xz, a.yz + b.yz, a.zz + b.zz};
}
inline Moments operator-(const Moments &a, const Moments &b) {
    return {a.w - b.w,   a.x - b.x,   a.y - b.y,   a.xx - b.xx, a.xy - b.xy,
            a.yy - b.yy, a.xz - b.xz, a.yz - b.yz, a.zz - b.zz};
}

// Of points a..b, both included, in constant time. Coordinates should lie within [-1, 1], so that
// differences of sums keep their digits.
class PrefixMoments {
  public:
    PrefixMoments(std::span<const Vec2> points, std::span<const double> weights)
        : sums_(points.size() + 1) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto [x, y] = points[i];
            const double w = weights[i], z = x * x + y * y;
            const Moments one{w,         w * x,     w * y,     w * x * x, w * x * y,
                              w * y * y, w * x * z, w * y * z, w * z * z};
            sums_[i + 1] = sums_[i] + one;
        }
    }

    Moments of(std::size_t first, std::size_t last) const { return sums_[last + 1] - sums_[first]; }
    double weight(std::size_t first, std::size_t last) const {
        return sums_[last + 1].w - sums_[first].w;
    }

  private:
    std::vector<Moments> sums_;
};

// Means of squares about the middle of a stretch.
struct Scatter {
    double weight = 0.0;
    Vec2 middle;
    double xx = 0.0, xy = 0.0, yy = 0.0;

    explicit Scatter(const Moments &m) : weight(m.w), middle{m.x / m.w, m.y / m.w} {
        const auto [cx, cy] = middle;
        xx = m.xx / weight - cx * cx;
        xy = m.xy / weight - cx * cy;
        yy = m.yy / weight - cy * cy;
    }
};

// Those of higher powers, too.
struct CentralMoments : Scatter {
    double xz = 0.0, yz = 0.0, zz = 0.0;

    explicit CentralMoments(const Moments &m) : CentralMoments(Scatter(m), m) {}
    CentralMoments(const Scatter &scatter, const Moments &m) : Scatter(scatter) {
        const auto [cx, cy] = middle;
        const double n = m.w, c = cx * cx + cy * cy, sz = m.xx + m.yy;
        // With z' = z - 2 (cx x + cy y) + c, x' = x - cx, y' = y - cy.
        const double szp = sz - n * c;  // the sum of z'
        const double sxz = m.xz - 2 * (cx * m.xx + cy * m.xy) + c * m.x;
        const double syz = m.yz - 2 * (cx * m.xy + cy * m.yy) + c * m.y;
        const double szz = m.zz - 2 * (cx * m.xz + cy * m.yz) + c * sz;
        xz = (sxz - cx * szp) / n;
        yz = (syz - cy * szp) / n;
        zz = (szz - 2 * (cx * sxz + cy * syz) + c * szp) / n;
    }
};

}  // namespace shapespline::drawn
