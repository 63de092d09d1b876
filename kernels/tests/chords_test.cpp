// Curves cut into chords, finer towards corners; the nearest of points against a look at all.
#include <cmath>
#include <limits>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/curve/corner_parameters.hpp"
#include "shapespline/curve/flatten.hpp"
#include "shapespline/curve/line_to_corners.hpp"
#include "shapespline/distance/nearest_points.hpp"

using namespace shapespline;

TEST(chords_begin_and_end_with_the_curve_and_lie_on_it) {
    std::mt19937 random(4);
    for (const int degree : {1, 2, 3, 5}) {
        const auto values = clamped_knots(random, 12, degree);
        const Knots knots{values, degree, false};
        const auto points = random_points(random, 12);
        const Flattening found(knots, points, 1e-3, 0.05);
        std::vector<Vec2> line(found.n_points()), on_curve(found.n_points());
        std::vector<double> parameters(found.n_points());
        found.write(line.data(), parameters.data());
        evaluate(knots, points, parameters, on_curve.data());
        CHECK(found.wanted() > 0.0 && found.diagonal() > 0.0);
        CHECK(parameters.front() == values.front() && parameters.back() == values.back());
        for (std::size_t i = 0; i < line.size(); ++i) {
            CHECK_NEAR(norm(line[i] - on_curve[i]), 0.0, 1e-13);
            if (i > 0) CHECK(parameters[i] > parameters[i - 1]);
            if (i > 0) CHECK(norm(line[i] - line[i - 1]) <= 0.05 * found.diagonal() * 1.5);
        }
    }
}

TEST(a_line_is_finer_towards_corners_on_both_sides_and_beside_the_seam) {
    const std::vector<double> values{0, 0, 0, 0.5, 0.5, 1, 1, 1};
    const Knots knots{values, 2, false};
    const std::vector<Vec2> points{{0, 0}, {1, -1}, {2, 0}, {1, 1}, {0, 0}};
    const std::vector<double> corners = corner_parameters(knots, points, true, 0.1);
    CHECK(corners == (std::vector<double>{0.0, 0.5}));
    CHECK(corner_parameters(knots, points, false, 0.1) == std::vector<double>{0.5});
    const std::vector<double> parameters{0.0, 0.25, 0.5, 0.75, 1.0};
    std::vector<Vec2> vertices(parameters.size());
    evaluate(knots, points, parameters, vertices.data());
    const LineToCorners found(vertices, parameters, corners);
    std::vector<Vec2> line(vertices.size() + corners.size() * LineToCorners::kMostBeside);
    CHECK(found.write(knots, points, line.data()) == line.size());
    // Ten on each side of both, nearer and nearer; what is before the first lies before the seam.
    const auto step = [&](std::size_t i) { return norm(line[i + 1] - line[i]); };
    for (const std::size_t corner : {0, 22}) {
        CHECK(step(corner) < 1e-5);
        for (std::size_t i = corner; i < corner + 9; ++i) CHECK(step(i + 1) > step(i));
    }
    for (const std::size_t corner : {22, 44}) {
        CHECK(step(corner - 1) < 1e-5);
        for (std::size_t i = corner - 1; i > corner - 10; --i) CHECK(step(i - 1) > step(i));
    }
}

TEST(the_nearest_of_points_is_the_first_of_all_as_near) {
    std::mt19937 random(6);
    std::vector<Vec2> points, queries;
    for (int i = 0; i < 300; ++i)  // on a lattice many are as near
        points.push_back({static_cast<double>(random() % 12), static_cast<double>(random() % 12)});
    for (const Vec2 p : random_points(random, 60, 15.0)) queries.push_back(p);
    for (int i = 0; i < 60; ++i) queries.push_back({random() % 24 / 2.0, random() % 24 / 2.0});
    std::vector<std::int64_t> indices(queries.size());
    std::vector<double> distances(queries.size());
    nearest_points(points, queries, indices.data(), distances.data());
    for (std::size_t q = 0; q < queries.size(); ++q) {
        std::size_t best = 0;
        const auto far = [&](std::size_t i) {
            return std::hypot(points[i].x - queries[q].x, points[i].y - queries[q].y);
        };
        for (std::size_t i = 1; i < points.size(); ++i)
            if (far(i) < far(best)) best = i;
        CHECK(indices[q] == static_cast<std::int64_t>(best));
        CHECK(distances[q] == far(best));
    }
}
