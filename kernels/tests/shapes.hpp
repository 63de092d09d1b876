// Random curves and points for the tests, and the slow evaluation that they are compared with.
#pragma once

#include <random>
#include <vector>

#include "shapespline/curve/bspline.hpp"

using shapespline::Vec2;

inline std::vector<Vec2> random_points(std::mt19937 &random, int count, double size = 1.0) {
    std::uniform_real_distribution<double> coordinate(-size, size);
    std::vector<Vec2> points(count);
    for (Vec2 &p : points) p = {coordinate(random), coordinate(random)};
    return points;
}

// Points on a way that goes on, as outlines do.
inline std::vector<Vec2> random_walk(std::mt19937 &random, int count, double step = 0.1) {
    std::vector<Vec2> points = random_points(random, count, step);
    for (int i = 1; i < count; ++i) points[i] += points[i - 1];
    return points;
}

// Clamped knots with random intervals, some interior ones double where the degree allows.
inline std::vector<double> clamped_knots(std::mt19937 &random, int n_points, int degree) {
    std::uniform_real_distribution<double> interval(0.2, 1.0);
    std::vector<double> knots(degree + 1, 0.0);
    while (static_cast<int>(knots.size()) < n_points) {
        const bool repeats = degree > 2 && knots.back() > 0.0 && random() % 5 == 0 &&
                             knots[knots.size() - 2] < knots.back();
        knots.push_back(knots.back() + (repeats ? 0.0 : interval(random)));
    }
    knots.insert(knots.end(), degree + 1, knots.back() + interval(random));
    return knots;
}

// A periodic knot vector: so many intervals, repeated beyond both ends.
inline std::vector<double> periodic_knots(std::mt19937 &random, int n_points, int degree) {
    std::uniform_real_distribution<double> interval(0.2, 1.0);
    std::vector<double> intervals(n_points);
    for (double &width : intervals) width = interval(random);
    std::vector<double> knots{0.0};
    for (int k = 0; k < n_points + 2 * degree; ++k)
        knots.push_back(knots.back() + intervals[(k + n_points - degree % n_points) % n_points]);
    return knots;
}

// N_{i,p}(u) by its definition, zero over zero being zero; right-continuous.
inline double basis_by_definition(const std::vector<double> &knots, int i, int p, double u) {
    if (p == 0) return knots[i] <= u && u < knots[i + 1] ? 1.0 : 0.0;
    const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
    double value = 0.0;
    if (left > 0.0)
        value += (u - knots[i]) / left * basis_by_definition(knots, i, p - 1, u);
    if (right > 0.0)
        value += (knots[i + p + 1] - u) / right * basis_by_definition(knots, i + 1, p - 1, u);
    return value;
}

inline Vec2 point_by_definition(const std::vector<double> &knots, const std::vector<Vec2> &points,
                                int degree, double u) {
    Vec2 sum{};
    for (std::size_t i = 0; i < points.size(); ++i)
        sum += basis_by_definition(knots, static_cast<int>(i), degree, u) * points[i];
    return sum;
}

// A parameter inside the domain of a curve.
inline double random_parameter(std::mt19937 &random, const shapespline::Knots &knots) {
    return std::uniform_real_distribution<double>(knots.begin(), knots.end())(random);
}
