// Sections that stand still or turn back where their data do not.
#include <cmath>
#include <numbers>

#include "check.hpp"
#include "shapespline/pieces/section_fairness.hpp"

using namespace shapespline;
using namespace shapespline::pieces;

namespace {

Section cubic(std::vector<Vec2> points, Index count) {
    Section section;
    section.degree = 3;
    section.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    section.points = std::move(points);
    section.last = count - 1;
    return section;
}

std::vector<Vec2> straight_data() {
    std::vector<Vec2> data;
    for (int i = 0; i <= 100; ++i) data.push_back({0.1 * i, 0.0});
    return data;
}

bool is_fair(const std::vector<Vec2> &data, double tolerance, const Section &section) {
    return SectionFairness(data, tolerance).n_unfair({&section, 1}) == 0;
}

}  // namespace

TEST(an_arch_is_fair) {
    const auto data = straight_data();
    CHECK(is_fair(data, 0.5, cubic({{0, 0}, {3, 1}, {7, 1}, {10, 0}}, 101)));
}

TEST(an_arch_is_fair_whichever_way_it_leads) {
    std::vector<Vec2> data = straight_data();
    for (Vec2 &point : data) point = -1.0 * point;
    // Both coordinates of its first direction are negative.
    CHECK(is_fair(data, 0.5, cubic({{0, 0}, {-3, -1}, {-7, -1}, {-10, 0}}, 101)));
}

TEST(a_section_that_stands_still_has_a_near_cusp) {
    const auto data = straight_data();
    // The crossed handles of a cubic meet in a cusp where they are as long as this.
    CHECK(!is_fair(data, 0.5, cubic({{0, 0}, {10, 3}, {0, 3}, {10, 0}}, 101)));
}

TEST(a_loop_within_a_tolerance_is_a_hook_unless_the_data_turn_too) {
    std::vector<Vec2> data = straight_data();
    const Section loop = cubic({{4, 0}, {7.2, 1}, {2.8, 1}, {6, 0}}, 101);
    CHECK(!is_fair(data, 3.0, loop));
    CHECK(is_fair(data, 0.05, loop));
    for (std::size_t i = 0; i < data.size(); ++i) data[i].y = i % 20 < 10 ? 0.0 : 3.0;
    CHECK(is_fair(data, 3.0, loop));
}

TEST(a_turn_back_at_a_joint_is_a_hook_where_the_data_go_on) {
    const auto data = straight_data();
    Section there = cubic({{0, 0}, {2, 0}, {4, 0}, {6, 0}}, 61);
    Section back = cubic({{6, 0}, {5.9, 0.01}, {5.8, 0.01}, {5.7, 0}}, 2);
    Section on = cubic({{5.7, 0}, {7, 0}, {9, 0}, {10, 0}}, 101);
    back.first = 61, back.last = 62, on.first = 63;
    const std::vector<Section> row{there, back, on};
    CHECK(SectionFairness(data, 0.5).n_unfair(row) == 2);
    for (const Section &one : row) CHECK(is_fair(data, 0.5, one));
}

TEST(a_joint_where_a_closed_outline_begins_may_be_a_hook_too) {
    // Three laps of a circle of 100 data, in two sections.
    const auto at = [](double k) {
        const double angle = 0.02 * std::numbers::pi * k;
        return Vec2{10.0 * std::cos(angle), 10.0 * std::sin(angle)};
    };
    std::vector<Vec2> data;
    for (int k = 0; k <= 300; ++k) data.push_back(at(k));
    const auto arc = [&](Index first, Vec2 end) {
        const double along = 40.0 / 3.0;
        const Vec2 a = at(first), v = {-0.1 * a.y, 0.1 * a.x}, w = {-0.1 * end.y, 0.1 * end.x};
        Section section = cubic({a, a + along * v, end - along * w, end}, 50);
        section.first += first, section.last += first;
        return section;
    };
    const Section upper = arc(100, at(150)), lower = arc(150, at(200));
    const SectionRing ring({upper, lower}, 100, false);
    Section past = lower;
    past.points = {at(150), at(160), at(202) + Vec2{0.0, 1.0}, at(200)};
    SectionFairness fairness(data, 1.0);
    CHECK(fairness.may_replace(ring, 1, 1, std::vector<Section>{lower}));
    CHECK(!fairness.may_replace(ring, 1, 1, std::vector<Section>{past}));
    CHECK(fairness.may_replace(ring, 0, 1, std::vector<Section>{upper, lower}));
    CHECK(!fairness.may_replace(ring, 0, 1, std::vector<Section>{upper, past}));
}
