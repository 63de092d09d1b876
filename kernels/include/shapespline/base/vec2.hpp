// A point or vector of the plane.
#pragma once

#include <cmath>

namespace shapespline {

struct Vec2 {
    double x = 0.0;
    double y = 0.0;

    constexpr Vec2 &operator+=(Vec2 b) {
        x += b.x;
        y += b.y;
        return *this;
    }
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
constexpr double norm_sq(Vec2 a) { return dot(a, a); }
inline double norm(Vec2 a) { return std::sqrt(norm_sq(a)); }

}  // namespace shapespline
