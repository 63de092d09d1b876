// Corners: the signs of jumps, by hand; sums as NumPy forms them; stations of noisy points.
#include <numbers>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/analysis/corners.hpp"

using namespace shapespline;
using namespace shapespline::analysis;

namespace {

// Two laps of a square of side 20, a point every unit, and their stations.
StationedOutline square(std::vector<Vec2> &points, std::vector<double> &stations) {
    const Vec2 corners[] = {{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}, {0.0, 20.0}};
    for (int k = 0; k < 160; ++k) {
        const Vec2 a = corners[k / 20 % 4], b = corners[(k / 20 + 1) % 4];
        points.push_back(a + (k % 20 / 20.0) * (b - a));
        stations.push_back(k);
    }
    return {points, stations};
}

}  // namespace

TEST(a_tangent_jump_has_the_sign_of_the_turn) {
    std::vector<Vec2> points;
    std::vector<double> stations;
    const StationedOutline outline = square(points, stations);
    const Index at[] = {80, 90};
    double turns[2];
    corner_turns(outline, at, 4.0, turns);
    CHECK_NEAR(turns[0], std::numbers::pi / 2, 1e-12);
    CHECK_NEAR(turns[1], 0.0, 1e-12);
    for (Vec2 &p : points) p.x = -p.x;
    corner_turns(outline, at, 4.0, turns);
    CHECK_NEAR(turns[0], -std::numbers::pi / 2, 1e-12);
}

TEST(sums_by_halves_are_those_of_their_parts) {
    std::mt19937 random(3);
    for (const std::size_t n : {0, 1, 7, 8, 9, 128, 129, 1000}) {
        std::vector<double> values;
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            // Whole numbers: no order of summation rounds.
            values.push_back(static_cast<double>(random() % 1000));
            sum += values.back();
        }
        CHECK(pairwise_sum(values) == sum);
    }
}

TEST(the_median_is_the_middle_or_the_mean_of_two) {
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0, 2.0, 3.0}) == 2.5);
    CHECK(median({5.0}) == 5.0);
}

TEST(noise_does_not_make_stations_longer) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::vector<Vec2> points;
    std::vector<double> arc_length{0.0};
    for (int i = 0; i < 400; ++i) {
        points.push_back({static_cast<double>(i), noise(random)});
        if (i > 0) arc_length.push_back(arc_length.back() + norm(points[i] - points[i - 1]));
    }
    const auto stations = smoothed_stations(points, false, arc_length, 1.0);
    CHECK(stations.size() == points.size());
    CHECK(arc_length.back() > 1.5 * 399);
    CHECK(stations.back() < 1.1 * 399);
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) CHECK(stations[i + 1] > stations[i]);
}
