// What neighbours tell of a point, and cubics of windows, by hand.
#include <array>
#include <cmath>

#include "check.hpp"
#include "shapespline/analysis/cubic_windows.hpp"
#include "shapespline/analysis/told_by_others.hpp"

using namespace shapespline;
using namespace shapespline::analysis;

TEST(a_point_beside_a_line_through_its_neighbours_is_off_by_its_distance) {
    std::vector<Vec2> points;
    for (int i = 0; i < 12; ++i) points.push_back({1.0 * i, i == 5 ? 3.0 : 0.0});
    const std::array<std::int64_t, 3> offsets{1, 2, 3};
    // Least squares through 1, 2, 3: slope (-1/2, 0, 1/2), place at 0 (4/3, 1/3, -2/3).
    const std::array<double, 6> rows{-0.5, 0.0, 0.5, 4.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0};
    const ThroughNeighbours fit{offsets, rows};
    const std::vector<double> noise(points.size(), 0.5);
    const std::array<std::int64_t, 2> told{5, 6};
    std::array<double, 2> off{}, rest{};
    told_by_others(points, told, fit, noise, off.data(), rest.data());
    const double error = std::sqrt(1.0 + (16.0 + 1.0 + 4.0) / 9.0);
    CHECK_NEAR(fit.error(), error, 1e-15);
    CHECK_NEAR(off[0], 3.0 / (error * 0.5), 1e-14);
    CHECK_NEAR(off[1], 0.0, 1e-14);
    CHECK_NEAR(rest[0], 0.0, 1e-14);
    // Of the last ones the first are neighbours: indices go round.
    const std::array<std::int64_t, 1> last{11};
    told_by_others(points, last, fit, noise, off.data(), rest.data());
    CHECK_NEAR(rest[0], 0.0, 1e-14);
}

TEST(windows_go_round_a_closed_outline_only) {
    std::vector<Vec2> points;
    for (int i = 0; i < 10; ++i) points.push_back({1.0 + i, 2.0 * i});
    std::vector<double> windows(2 * 7 * 10);
    windows_of_seven(points, true, 1, windows);
    CHECK(windows[0] == 7.0 && windows[3] == 0.0 && windows[6] == 3.0);
    CHECK(windows[70 + 3] == 0.0 && windows[70 + 4] == 2.0);
    std::vector<double> some(2 * 7 * 2);
    windows_of_seven(points, false, 3, some);
    CHECK(some[0] == 0.0 && some[6] == 6.0 && some[7] == 3.0 && some[13] == 9.0);
    CHECK(some[14 + 1] == 2.0);
}

TEST(what_is_left_counts_across_the_slope) {
    // One window along x: what is left along it does not count, 2 across in two points.
    const std::array<double, 16> rows{3, 1, 1, 1, 1, 1, 1, 1, 0, 2, 0, 0, -2, 0, 0, 0};
    const CubicWindows windows(rows);
    double sum = 0.0;
    windows.across(&sum);
    CHECK_NEAR(sum, 8.0, 1e-14);
    // The middle point is off by (1, -2).
    const Vec2 twice = windows.twice_direction();
    CHECK_NEAR(twice.x, -0.6, 1e-15);
    CHECK_NEAR(twice.y, -0.8, 1e-15);
}
