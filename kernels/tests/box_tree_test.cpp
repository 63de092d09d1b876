// Nearest items and items near a box against a look at all of them.
#include <algorithm>
#include <limits>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/base/box_tree.hpp"
#include "shapespline/distance/polyline.hpp"

using namespace shapespline;

TEST(the_nearest_segment_is_found_from_any_hint) {
    std::mt19937 random(9);
    for (const int count : {2, 3, 5, 6, 40, 333}) {
        const auto vertices = random_walk(random, count);
        const Polyline polyline(vertices);
        for (const Vec2 p : random_points(random, 50)) {
            double best = std::numeric_limits<double>::infinity();
            for (int i = 0; i + 1 < count; ++i)
                best = std::min(best, segment_distance_sq(p, vertices[i], vertices[i + 1]));
            const auto found = polyline.nearest(p, random() % (2 * count));
            CHECK(found.distance_sq == best);
            CHECK(polyline.distance_sq(p, found.segment) == best);
        }
    }
}

TEST(all_items_near_a_box_are_visited_once) {
    std::mt19937 random(10);
    for (const int count : {1, 4, 5, 100}) {
        const auto points = random_walk(random, count);
        const BoxTree tree(count, [&](std::size_t i, Box &box) { box.include(points[i]); });
        for (int trial = 0; trial < 30; ++trial) {
            Box box;
            for (const Vec2 p : random_points(random, 2, 0.5)) box.include(p);
            const double distance_sq = 0.01;
            std::vector<int> visits(count, 0);
            tree.visit_near(box, distance_sq, [&](std::size_t i) { ++visits[i]; });
            for (int i = 0; i < count; ++i) {
                CHECK(visits[i] <= 1);
                if (box.distance_sq(points[i]) < distance_sq) CHECK(visits[i] == 1);
            }
        }
    }
}

TEST(all_pairs_of_items_whose_boxes_meet_are_visited_once) {
    std::mt19937 random(11);
    for (const int count : {0, 1, 2, 4, 5, 9, 100}) {
        const auto vertices = random_walk(random, count + 1);
        std::vector<Box> boxes(count);
        const BoxTree tree(count, [&](std::size_t i, Box &box) {
            boxes[i].include(vertices[i]);
            boxes[i].include(vertices[i + 1]);
            box.include(boxes[i]);
        });
        std::vector<int> visits(count * count, 0);
        tree.visit_pairs([&](std::size_t i, std::size_t k) {
            CHECK(i < k);
            ++visits[i * count + k];
        });
        for (int i = 0; i < count; ++i)
            for (int k = i + 1; k < count; ++k) {
                CHECK(visits[i * count + k] <= 1);
                if (boxes[i].meets(boxes[k])) CHECK(visits[i * count + k] == 1);
            }
        // What lies in 20 .. 70 from the first to the last item is left out, all else is not.
        const auto apart = [](std::size_t first, std::size_t last) {
            return first >= 20 && last <= 70;
        };
        std::vector<int> again(count * count, 0);
        tree.visit_pairs([&](std::size_t i, std::size_t k) { ++again[i * count + k]; }, apart);
        for (int i = 0; i < count; ++i)
            for (int k = i + 1; k < count; ++k) {
                CHECK(again[i * count + k] <= visits[i * count + k]);
                if (!apart(i, k)) CHECK(again[i * count + k] == visits[i * count + k]);
            }
    }
}
