// Moments, circles and segmentation of outlines that are known.
#include <numbers>

#include "check.hpp"
#include "shapespline/drawn/conditioning.hpp"
#include "shapespline/drawn/elements.hpp"
#include "shapespline/drawn/equations.hpp"
#include "shapespline/drawn/estimate.hpp"
#include "shapespline/drawn/segmentation.hpp"

using namespace shapespline;
using namespace shapespline::drawn;

namespace {

constexpr JointPrices kJoints{2.0, 1.0, 2.5, 0.5, 1.0, 2.0, 1.0, 1.5};

std::vector<Vec2> arc(Vec2 centre, double radius, double from, double sweep, int n) {
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) {
        const double angle = from + sweep * i / (n - 1);
        points.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    return points;
}

struct Told {
    std::vector<DrawnPiece> pieces;
    double cost;
};

Told told_by(const std::vector<Vec2> &points, double deviation,
             const std::vector<Vec2> &directions = {}) {
    std::vector<double> stations{0.0}, weights(points.size(), 1.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        stations.push_back(stations.back() + norm(points[i] - points[i - 1]));
    const double step = stations.back() / static_cast<double>(points.size() - 1);
    const SegmentationSettings settings{deviation, {0.0, 2.5 * step, 2.5 * step}, 4.0, 4.0,
                                        0.14, 4, kJoints};
    Segmentation search(points, stations, weights, {}, {}, directions, settings);
    auto pieces = search.run();
    return {std::move(pieces), search.cost()};
}
std::vector<DrawnPiece> pieces_of(const std::vector<Vec2> &points, double deviation) {
    return told_by(points, deviation).pieces;
}

}  // namespace

TEST(moments_of_a_stretch_are_those_of_its_points) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<Vec2> points;
    std::vector<double> weights;
    for (int i = 0; i < 40; ++i) {
        points.push_back({number(random), number(random)});
        weights.push_back(1.0 + number(random) * 0.5);
    }
    const CentralMoments found(PrefixMoments(points, weights).of(7, 31));
    double w = 0.0, xz = 0.0, zz = 0.0;
    for (int i = 7; i <= 31; ++i) {
        const Vec2 p = points[i] - found.middle;
        w += weights[i];
        xz += weights[i] * p.x * norm_sq(p);
        zz += weights[i] * norm_sq(p) * norm_sq(p);
    }
    CHECK_NEAR(found.weight, w, 1e-13);
    CHECK_NEAR(found.xz, xz / w, 1e-13);
    CHECK_NEAR(found.zz, zz / w, 1e-13);
}

TEST(a_circle_through_points_of_one_is_that_one) {
    const auto points = arc({0.3, -0.2}, 0.6, 0.4, 0.8, 30);
    const std::vector<double> weights(points.size(), 1.0);
    const CircleFit found = fit_circle(CentralMoments(PrefixMoments(points, weights).of(0, 29)));
    CHECK_NEAR(found.centre.x, 0.3, 1e-9);
    CHECK_NEAR(found.centre.y, -0.2, 1e-9);
    CHECK_NEAR(found.radius, 0.6, 1e-9);
    CHECK(found.sum_sq < 1e-15);
}

TEST(a_circle_that_leaves_more_than_is_asked_for_is_none) {
    std::vector<Vec2> points;
    for (int i = 0; i < 30; ++i) points.push_back({0.02 * i, 0.1 * std::sin(0.4 * i)});
    const std::vector<double> weights(points.size(), 1.0);
    const CentralMoments moments(PrefixMoments(points, weights).of(0, 29));
    const double least = fit_circle(moments).sum_sq;
    CHECK(fit_circle(moments, 1.01 * least).radius > 0.0);
    const CircleFit given_up = fit_circle(moments, 0.5 * least);
    CHECK(given_up.radius == 0.0);
    CHECK(0.5 * least < given_up.sum_sq && given_up.sum_sq <= least);
}

TEST(what_a_quintic_in_arc_length_leaves_is_found_to_rounding) {
    const auto at = [](double s, double wave) {
        return Vec2{0.3 + s - 0.4 * s * s * s, s * s - 0.2 * std::pow(s, 5) + wave};
    };
    GrowingQuintic exact(at(0.0, 0.0), 0.0, 0.1), wavy(at(0.0, 0.0), 0.0, 0.1);
    for (int i = 0; i < 60; ++i) {
        const double s = i / 60.0;
        exact.add(at(s, 0.0), s, 1.0);
        wavy.add(at(s, i % 2 == 0 ? 1e-4 : -1e-4), s, 1.0);
    }
    CHECK(exact.solved(0.0, 1.0).sum_sq < 1e-13);
    CHECK(std::abs(wavy.solved(0.0, 1.0).sum_sq / 60e-8 - 1.0) < 0.01);
    const Vec2 end = exact.solved(0.0, 1.0).end;  // the slope at 1: (-0.2, 1)
    CHECK_NEAR(end.x / end.y, -0.2, 1e-8);
}

TEST(a_line_an_arc_and_a_line_are_found_where_they_are) {
    std::vector<Vec2> points;
    for (int i = 0; i < 30; ++i) points.push_back({-0.6 + 0.02 * i, -0.3});
    // Tangent at (0, -0.3), a quarter to (0.3, 0).
    for (const Vec2 p : arc({0.0, 0.0}, 0.3, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi, 25))
        points.push_back(p);
    for (int i = 1; i < 30; ++i) points.push_back({0.3, 0.02 * i});
    const auto found = pieces_of(points, 1e-4);
    CHECK(found.size() == 3);
    CHECK(found[0].kind == kLine && found[1].kind == kArc && found[2].kind == kLine);
    CHECK(std::abs(found[0].end - 30) <= 2 && std::abs(found[2].begin - 54) <= 2);
}

TEST(a_line_along_a_direction_that_is_told_takes_its_offset_alone) {
    // Three edges at right angles, turned by 0.3, backwards along the last: prices are 4 each.
    const Vec2 along{std::cos(0.3), std::sin(0.3)}, across{-along.y, along.x};
    std::vector<Vec2> points;
    for (int i = 0; i < 20; ++i) points.push_back(0.02 * i * along);
    for (int i = 0; i < 20; ++i) points.push_back(0.4 * along + 0.02 * i * across);
    for (int i = 0; i <= 20; ++i) points.push_back(0.4 * across + (0.4 - 0.02 * i) * along);
    const Told free = told_by(points, 1e-3), told = told_by(points, 1e-3, {along, across});
    CHECK(free.pieces.size() == 3 && told.pieces.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(told.pieces[k].kind == kLine);
        CHECK(told.pieces[k].begin == free.pieces[k].begin);
    }
    // Misfits are none but for rounding over the squared deviation.
    CHECK_NEAR(free.cost - told.cost, 12.0, 1e-6);
    CHECK_NEAR(told_by(points, 1e-3, {along}).cost, told.cost + 4.0, 1e-6);
    // A direction that none of them has is of no use.
    CHECK_NEAR(told_by(points, 1e-3, {{1.0, 0.0}}).cost, free.cost, 1e-6);
}

TEST(waves_are_free_form) {
    std::vector<Vec2> points;
    for (int i = 0; i < 300; ++i) {
        const double x = -1.0 + i / 150.0;
        points.push_back({x, 0.2 * std::sin(5.0 * x) + 0.1 * std::sin(8.0 * x)});
    }
    for (const DrawnPiece &piece : pieces_of(points, 1e-4)) CHECK(piece.kind == kFree);
}

TEST(steps_that_meet_equations_are_one_and_a_basis_of_all) {
    // x + y = 1 and z = 2, the first said twice, from nothing: values are those at zero.
    const std::vector<double> values{-1.0, -2.0, -1.0}, units{1.0, 1.0, 1.0};
    const std::vector<double> rows{1, 1, 0, 0, 0, 1, 1, 1, 0};
    const MeetingSteps steps(values, rows, units, 1e-8);
    CHECK(steps.n_free() == 1);
    // Nearest to (3, 0, 0), and 1e-12 of the trace that holds back unknowns without data.
    const std::vector<double> identity{1, 0, 0, 0, 1, 0, 0, 0, 1}, gradient{-3.0, 0.0, 0.0};
    std::vector<double> step(3), covariance(9);
    steps.best(identity, gradient, step);
    CHECK_NEAR(step[0], 2.0, 1e-11);
    CHECK_NEAR(step[1], -1.0, 1e-11);
    CHECK_NEAR(step[2], 2.0, 1e-15);
    steps.covariance(identity, covariance);
    const double expected[]{0.5, -0.5, 0.0, -0.5, 0.5, 0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 9; ++i) CHECK_NEAR(covariance[i], expected[i], 1e-15);
}

TEST(without_equations_the_covariance_is_the_inverse_of_the_precision) {
    const MeetingSteps steps({}, {}, std::vector<double>{1.0, 0.1}, 1e-8);
    std::vector<double> step(2), covariance(4);
    const std::vector<double> precision{2.0, 1.0, 1.0, 2.0}, gradient{1.0, 0.0};
    steps.covariance(precision, covariance);
    const double expected[]{2.0 / 3, -1.0 / 3, -1.0 / 3, 2.0 / 3};
    for (int i = 0; i < 4; ++i) CHECK_NEAR(covariance[i], expected[i], 1e-15);
    steps.best(precision, gradient, step);
    CHECK_NEAR(step[0], -2.0 / 3, 1e-9);
    CHECK_NEAR(step[1], 1.0 / 3, 1e-9);
    // Of two unknowns that data only tell together neither moves without bound.
    const std::vector<double> together{1.0, 1.0, 1.0, 1.0}, both{1.0, 1.0};
    steps.best(together, both, step);
    CHECK_NEAR(step[0] + step[1], -1.0, 1e-6);
}

TEST(lines_and_circles_through_their_points_are_theirs) {
    std::vector<Vec2> edge;
    for (int i = 0; i < 20; ++i) edge.push_back({1e3 - 0.5 * i, 7.0});
    const auto [direction, offset] = line_through(edge, std::vector<double>(20, 1.0));
    CHECK_NEAR(std::abs(direction), std::numbers::pi, 1e-15);  // travelled to the left
    CHECK_NEAR(offset, -7.0, 1e-12);
    const auto points = arc({500.0, -20.0}, 60.0, 0.4, 0.3, 30);
    const auto [centre, radius] = circle_through(points, std::vector<double>(30, 1.0));
    // A sagitta of 0.67 known to rounding, eps * 500, magnified by 8 (radius / chord)^2.
    CHECK_NEAR(centre.x, 500.0, 1e-9);
    CHECK_NEAR(centre.y, -20.0, 1e-9);
    CHECK_NEAR(radius, 60.0, 1e-9);
}

TEST(normal_equations_are_the_derivatives_of_half_of_chi_squared) {
    auto points = arc({0.3, -0.2}, 0.6, 0.4, 0.8, 30);
    for (int i = 0; i < 10; ++i) points.push_back({0.1 * i, 0.01 * i * i});
    std::vector<double> weights(40, 1.0);
    weights[35] = 0.25;
    const Elements both({0, 1}, {0, 3}, {0, 30}, points, weights, weights, 0.5);
    const std::vector<double> x{0.31, -0.18, 0.57, 0.3, -0.1};
    const auto half = [&](std::vector<double> at, std::size_t i, double step) {
        at[i] += step;
        double sum = 0.0;
        for (const Misfit &one : both.misfits(at)) sum += 0.5 * one.chi_sq;
        return sum;
    };
    std::vector<double> matrix(25), gradient(5);
    both.normal(x, matrix, gradient);
    CHECK_NEAR(both.misfits(x)[1].count, 9.25, 1e-15);
    const double h = 1e-5;  // errors: h^2 times third derivatives of order 100, rounding over h
    for (std::size_t i = 0; i < 5; ++i)
        CHECK_NEAR(gradient[i], (half(x, i, h) - half(x, i, -h)) / (2 * h), 1e-7);
}

TEST(points_that_are_less_sure_count_but_miss_by_less) {
    // Ten points on a level line; one lies three above it, and is sure to a ninth of the others.
    std::vector<Vec2> points;
    for (int i = 0; i < 10; ++i) points.push_back({1.0 * i, i == 4 ? 3.0 : 0.0});
    std::vector<double> weights(10, 1.0);
    const std::vector<double> counts = weights, x{0.0, 0.0};
    const Misfit alike = Elements({1}, {0}, {0}, points, weights, counts, 0.5).misfits(x)[0];
    CHECK_NEAR(alike.chi_sq, 36.0, 1e-13);
    CHECK_NEAR(alike.largest, 3.0, 1e-15);
    weights[4] = 1.0 / 9.0;
    const Misfit less = Elements({1}, {0}, {0}, points, weights, counts, 0.5).misfits(x)[0];
    CHECK_NEAR(less.chi_sq, 4.0, 1e-13);
    CHECK_NEAR(less.count, 10.0, 1e-15);
    CHECK_NEAR(less.largest, 1.0, 1e-15);
}

TEST(a_corner_lies_in_a_step_that_is_a_gap_and_in_no_longer_one) {
    // Two edges at a right angle, the corner in the middle of a step of eight.
    std::vector<Vec2> points;
    for (int i = 0; i < 20; ++i) points.push_back({1.0 * i - 23.0, 0.0});
    for (int i = 0; i < 20; ++i) points.push_back({0.0, 4.0 + i});
    for (Vec2 &p : points) p = 0.02 * p;
    std::vector<double> stations{0.0}, weights(points.size(), 1.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        stations.push_back(stations.back() + norm(points[i] - points[i - 1]));
    const auto lines = [&](double gap) {
        const SegmentationSettings settings{1e-5, {0.0, 0.05, gap}, 4.0, 4.0, 0.14, 4, kJoints};
        return Segmentation(points, stations, weights, {}, {}, {}, settings).run();
    };
    CHECK(lines(1.0).size() == 2);
    CHECK(lines(0.05).size() > 2);
}

TEST(an_equation_that_holds_conditions_the_estimate) {
    // Two unknowns, correlated, said to be equal: the mean that their covariance weighs.
    std::vector<double> x{1.0, 1.5}, covariance{1.0, 0.2, 0.2, 0.5};
    const EquationLimits limits{9.0, 0.75, 0.0, 1.0, 1e-10, 1e-12};
    // The second row follows.
    CHECK(take_equation(x, covariance, Difference{{0, 0}, {1, 1}, 0.0, 1.0}, limits));
    // By hand: gain (0.8, -0.3), variance 1.1.
    CHECK_NEAR(x[0], 1.0 + 0.8 * 0.5 / 1.1, 1e-15);
    CHECK_NEAR(x[1], 1.5 - 0.3 * 0.5 / 1.1, 1e-15);
    for (const double c : covariance) CHECK_NEAR(c, 1.0 - 0.64 / 1.1, 1e-15);
    // They are equal now; that they differ by one is refused, and nothing changes.
    const auto before = x;
    CHECK(!take_equation(x, covariance, Difference{{0}, {1}, 1.0, 1.0}, limits));
    CHECK(x == before);
}

TEST(slopes_of_equations_are_difference_quotients) {
    std::vector<double> x;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> number(0.5, 1.5);
    for (int i = 0; i < 14; ++i) x.push_back(number(random));
    x[5] = 4.0;  // the radius of a circle around another
    const std::vector<Equation> all{
        Difference{{0, 3}, {9, 6}, 0.3, -1.0},
        Difference{{4}, {}, 0.3, 1.0},
        LineTouches{0, 3, -1.0},
        CirclesTouch{3, 6, true},
        CirclesTouch{6, 3, true},
        CirclesTouch{3, 6, false},
        PassesThrough{0, true, {0.3, 2.0}},
        PassesThrough{3, false, {0.3, 2.0}},
        Images{{0, 9}, {9, 0}, 12, true, 0.7},
        Images{{0}, {9}, 12, true, std::nullopt},
        Images{{3}, {6}, 12, false, 0.7},
        Images{{3, 6}, {6, 6}, 12, false, std::nullopt},
        EqualLengths{{0, {9, true, 0.0}, {3, false, 1.0}, 1e-4},
                     {9, {3, false, -1.0}, {3, false, 0.0}, 1e-4}},
    };
    const Linearised found = linearised(all, x);
    CHECK(found.values().size() == 25);
    const double h = 1e-6;  // errors: h^2 times third derivatives of order 100, rounding over h
    for (std::size_t i = 0; i < x.size(); ++i) {
        std::vector<double> there = x, here = x;
        there[i] += h;
        here[i] -= h;
        const auto more = linearised(all, there).values(), less = linearised(all, here).values();
        for (std::size_t k = 0; k < more.size(); ++k)
            CHECK_NEAR(found.rows()[k * x.size() + i], (more[k] - less[k]) / (2 * h), 2e-8);
    }
}
