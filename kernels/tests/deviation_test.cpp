// Certified distances against dense sampling: from a curve to a polyline, and to the curve.
#include <algorithm>
#include <limits>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/distance/deviation.hpp"
#include "shapespline/distance/near_feet.hpp"
#include "shapespline/distance/nearest.hpp"

using namespace shapespline;

namespace {

constexpr int kSamples = 4000;

double distance_to(Vec2 p, const std::vector<Vec2> &polyline) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
        best = std::min(best, segment_distance_sq(p, polyline[i], polyline[i + 1]));
    return std::sqrt(best);
}

struct Curve {
    std::vector<double> values;
    std::vector<Vec2> points;
    Knots knots;

    Curve(std::mt19937 &random, int degree)
        : values(clamped_knots(random, degree + 6, degree)),
          points(random_walk(random, degree + 6, 0.5)),
          knots{values, degree, false} {}

    Vec2 at(double u) const {
        Vec2 p;
        evaluate(knots, points, {&u, 1}, &p);
        return p;
    }
    double sample(int i) const {
        return knots.begin() + (knots.end() - knots.begin()) * i / kSamples;
    }
    // No two samples that follow each other are farther apart.
    double longest_step() const {
        double speed = 0.0;
        for (const Vec2 d : derivative_points(knots, points)) speed = std::max(speed, norm(d));
        return speed * knots.period() / kSamples;
    }
};

}  // namespace

TEST(the_deviation_encloses_the_largest_sampled_distance) {
    std::mt19937 random(11);
    for (int degree = 1; degree <= 5; ++degree)
        for (int trial = 0; trial < 4; ++trial) {
            const Curve curve(random, degree);
            const auto polyline = random_walk(random, 30, 0.3);
            const auto found = curve_deviation(curve.knots, curve.points, polyline, 1e-3, 0.0);
            double sampled = 0.0;
            for (int i = 0; i <= kSamples; ++i)
                sampled = std::max(sampled, distance_to(curve.at(curve.sample(i)), polyline));
            CHECK(sampled <= found.upper * (1.0 + 1e-12));
            CHECK(found.lower <= sampled + curve.longest_step());
            CHECK(found.upper <= found.lower * (1.0 + 1e-3) * (1.0 + 1e-12));
            CHECK_NEAR(distance_to(curve.at(found.parameter), polyline), found.lower, 1e-12);
        }
}

TEST(passes_that_retrace_each_other_are_as_far_as_one) {
    std::mt19937 random(14);
    const Curve curve(random, 3);
    const auto once = random_walk(random, 30, 0.3);
    const auto one = curve_deviation(curve.knots, curve.points, once, 1e-3, 0.0);
    auto often = once;
    for (int pass = 0; pass < 50; ++pass) {
        for (std::size_t k = once.size() - 1; k-- > 0;) often.push_back(once[k]);
        often.insert(often.end(), once.begin() + 1, once.end());
    }
    const auto all = curve_deviation(curve.knots, curve.points, often, 1e-3, 0.0);
    CHECK_NEAR(all.lower, one.lower, 1e-12);
    CHECK(all.upper <= all.lower * (1.0 + 1e-3) * (1.0 + 1e-12));
}

TEST(nearest_points_are_no_farther_than_any_sample) {
    std::mt19937 random(12);
    for (int degree = 1; degree <= 5; ++degree) {
        const Curve curve(random, degree);
        const auto queries = random_walk(random, 60, 0.3);
        std::vector<double> parameters(queries.size()), distances_sq(queries.size());
        nearest_on_curve(curve.knots, curve.points, queries, parameters.data(),
                         distances_sq.data());
        for (std::size_t j = 0; j < queries.size(); ++j) {
            double sampled = std::numeric_limits<double>::infinity();
            for (int i = 0; i <= kSamples; ++i)
                sampled = std::min(sampled, norm(curve.at(curve.sample(i)) - queries[j]));
            const double found = std::sqrt(distances_sq[j]);
            CHECK(found <= sampled + 1e-12);
            CHECK(found >= sampled - curve.longest_step());
            CHECK_NEAR(norm(curve.at(parameters[j]) - queries[j]), found, 1e-9);
        }
    }
}

TEST(near_feet_come_no_farther_and_end_at_right_angles) {
    std::mt19937 random(13);
    const Curve curve(random, 3);
    int n_right = 0, n_all = 0;
    for (int j = 0; j < 60; ++j) {
        const double start = random_parameter(random, curve.knots);
        const Vec2 q = curve.at(start) + random_points(random, 1, 0.01)[0];
        double moved = start;
        near_feet(curve.knots, curve.points, {&q, 1}, 12, {&moved, 1});
        CHECK(norm(curve.at(moved) - q) <= norm(curve.at(start) - q));
        if (moved <= curve.knots.begin() || moved >= curve.knots.end()) continue;
        SpanCursor<3> cursor(curve.knots, curve.points);
        cursor.seek(moved);
        const Vec2 r = cursor.point() - q;
        ++n_all;
        n_right += std::abs(dot(r, cursor.tangent())) <=
                   1e-6 * norm(cursor.tangent()) * std::max(norm(r), 1e-6);
    }
    CHECK(n_all > 40 && n_right >= 0.9 * n_all);
}
