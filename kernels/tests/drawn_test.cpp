// Moments, circles and segmentation of outlines that are known.
#include <numbers>

#include "check.hpp"
#include "shapespline/drawn/elimination.hpp"
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

std::vector<DrawnPiece> pieces_of(const std::vector<Vec2> &points, double deviation) {
    std::vector<double> stations{0.0}, weights(points.size(), 1.0);
    for (std::size_t i = 1; i < points.size(); ++i)
        stations.push_back(stations.back() + norm(points[i] - points[i - 1]));
    const double step = stations.back() / static_cast<double>(points.size() - 1);
    const SegmentationSettings settings{deviation, 0.0, 2.5 * step, 4.0, 4.0, 0.14, 4, kJoints};
    return Segmentation(points, stations, weights, {}, {}, settings).run();
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
    std::vector<double> onto(3), basis(9);
    const std::vector<char> free = null_space(values, rows, units, 1e-8, onto, basis);
    CHECK(std::count(free.begin(), free.end(), 1) == 1);
    CHECK(onto[0] + onto[1] == 1.0 && onto[2] == 2.0);
    for (int j = 0; j < 3; ++j) CHECK(basis[j] + basis[3 + j] == 0.0 && basis[6 + j] == 0.0);
}
