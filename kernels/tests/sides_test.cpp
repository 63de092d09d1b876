// What lies across a clearance against a look at every segment, and hooks of chords beside data.
#include <cmath>
#include <limits>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/distance/hooks.hpp"
#include "shapespline/distance/sides.hpp"

using namespace shapespline;

namespace {

// Open random walks, one contour each.
std::vector<Sides::Segment> walks(std::mt19937 &random, int count, int n) {
    std::vector<Sides::Segment> segments;
    for (int owner = 0; owner < count; ++owner) {
        const auto walk = random_walk(random, n);
        double along = 0.0;
        for (int i = 0; i + 1 < n; along += norm(walk[i + 1] - walk[i]), ++i)
            segments.push_back({walk[i], walk[i + 1], along, owner});
    }
    return segments;
}

double nearest_of_all(const std::vector<Sides::Segment> &segments, Vec2 point, double along,
                      std::int64_t own, const Sides::Limits &limits) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto &side : segments) {
        const Vec2 foot = segment_foot(point, side.begin, side.end);
        const double distance = norm(point - foot);
        const double way = std::fabs(along - side.along - norm(foot - side.begin));
        if (side.owner == own && way <= std::max(limits.around * distance, limits.least)) continue;
        if (distance < limits.reach) best = std::min(best, distance);
    }
    return best;
}

}  // namespace

TEST(the_nearest_side_across_a_clearance_is_found) {
    std::mt19937 random(12);
    const Sides::Limits limits{0.2, 3.0, 0.15};
    int found = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const auto segments = walks(random, 3, 40);
        const double endless = std::numeric_limits<double>::infinity();
        const Sides sides(segments, {endless, endless, endless});
        for (const auto &at : segments) {
            const double expected = nearest_of_all(segments, at.begin, at.along, at.owner, limits);
            const Vec2 off = sides.across(at.begin, at.along, at.owner, limits);
            CHECK(std::isinf(off.x) == std::isinf(expected));
            if (std::isinf(expected)) continue;
            CHECK_NEAR(norm(off), expected, 1e-12);
            ++found;
        }
    }
    CHECK(found > 500);
}

TEST(the_way_round_a_closed_outline_is_the_shorter_one) {
    // A long slot: its seam is on the lower side, the points beside the seam are neighbours.
    const std::vector<Vec2> slot{{0, 0}, {5, 0}, {5, 1}, {-5, 1}, {-5, 0}, {0, 0}};
    std::vector<Sides::Segment> segments;
    double round = 0.0;
    for (std::size_t i = 0; i + 1 < slot.size(); round += norm(slot[i + 1] - slot[i]), ++i)
        segments.push_back({slot[i], slot[i + 1], round, 0});
    const Sides sides(segments, {round});
    const Vec2 off = sides.across({0.1, 0.0}, 0.1, 0, {2.0, 3.0, 0.5});
    CHECK_NEAR(off.x, 0.0, 1e-15);
    CHECK_NEAR(off.y, -1.0, 1e-15);
}

TEST(a_hook_is_where_the_curve_turns_back_and_the_data_do_not) {
    const std::vector<Vec2> data{{0, 0}, {10, 0}};
    const std::vector<Vec2> hooked{{0, 0}, {5, 0}, {4.6, 0.1}, {10, 0}};
    const auto places = hook_places(hooked, data, 1.0, false);
    CHECK(places.size() == 2);  // at both ends of the way back
    for (const Vec2 place : places) CHECK(norm(place - Vec2{4.8, 0.05}) <= 0.5);
    // Beside data that turn so it is theirs.
    CHECK(hook_places(hooked, hooked, 1.0, false).empty());
}

TEST(a_turn_over_more_than_a_tolerance_of_length_is_none) {
    std::vector<Vec2> turned{{0, 0.6}, {5, 0.6}};
    for (int i = 1; i <= 16; ++i)
        turned.push_back({5 + 0.3 * std::sin(i * M_PI / 16), 0.3 + 0.3 * std::cos(i * M_PI / 16)});
    turned.push_back({0, 0});
    const std::vector<Vec2> data{{0, 0.3}, {10, 0.3}};
    CHECK(hook_places(turned, data, 1.0, false).size() == 1);
    // A quarter of the circle is 0.47 long.
    CHECK(hook_places(turned, data, 0.4, false).empty());
}

TEST(a_hook_at_the_seam_of_a_closed_curve_is_found) {
    std::vector<Vec2> ring;
    for (int i = 0; i < 64; ++i)
        ring.push_back({10.0 * std::cos(i * M_PI / 32), 10.0 * std::sin(i * M_PI / 32)});
    std::vector<Vec2> hooked = ring;
    ring.push_back(ring.front());
    CHECK(hook_places(ring, ring, 1.0, true).empty());
    // The last chord runs 0.3 past the seam and comes back to it.
    hooked.push_back({10.05, 0.3});
    hooked.push_back(hooked.front());
    const auto places = hook_places(hooked, ring, 1.0, true);
    CHECK(!places.empty());
    for (const Vec2 place : places) CHECK(norm(place - hooked.front()) <= 1.0);
}
