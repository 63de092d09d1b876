// Crossings counted with boxes against every pair of segments solved for their common point.
#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/distance/crossing_pairs.hpp"
#include "shapespline/distance/crossings.hpp"

using namespace shapespline;

namespace {

bool cross_inside(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const double turn = cross(b - a, d - c);
    if (turn == 0.0) return false;
    const double s = cross(c - a, d - c) / turn, t = cross(c - a, b - a) / turn;
    return s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
}

int counted_by_pairs(const std::vector<Vec2> &vertices) {
    int count = 0;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        for (std::size_t k = i + 2; k + 1 < vertices.size(); ++k)
            count += cross_inside(vertices[i], vertices[i + 1], vertices[k], vertices[k + 1]);
    return count;
}

int counted(const std::vector<Vec2> &vertices) {
    return count_crossings(std::span<const Vec2>(vertices));
}

}  // namespace

TEST(boxes_miss_no_crossing_pair) {
    std::mt19937 random(6);
    int total = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const auto vertices = trial % 2 ? random_walk(random, 60) : random_points(random, 25);
        CHECK(counted(vertices) == counted_by_pairs(vertices));
        total += counted(vertices);
    }
    CHECK(total > 1000);
}

TEST(rows_that_go_on_to_one_side_are_left_out_alone) {
    // Long rows to one side and back, some of which cross others, and steps straight up and down.
    std::mt19937 random(4);
    std::uniform_real_distribution<double> step(0.1, 1.0), rise(-1.5, 1.5);
    std::bernoulli_distribution turns(0.05), stands(0.1);
    int total = 0;
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<Vec2> vertices{{0.0, 0.0}};
        double way = 1.0;
        for (int i = 0; i < 150; ++i) {
            const Vec2 last = vertices.back();
            if (turns(random)) way = -way;
            const bool stood = i > 0 && last.x == vertices[i - 1].x;
            const double along = !stood && stands(random) ? 0.0 : way * step(random);
            vertices.push_back({last.x + along, last.y + rise(random)});
        }
        if (trial % 2)
            for (Vec2 &vertex : vertices) vertex = {vertex.y, vertex.x};
        CHECK(counted(vertices) == counted_by_pairs(vertices));
        total += counted(vertices);
    }
    CHECK(total > 100);
}

TEST(ways_through_a_vertex_cross_once_and_touching_ones_evenly) {
    // Down through the vertex (2, 0) of a horizontal way, and down to it and up again.
    CHECK(counted({{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {2, -1}}) == 1);
    CHECK(counted({{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 0}, {1, 2}}) % 2 == 0);
    CHECK(counted({{0, 0}, {1, 1}, {1, 0}, {0, 1}}) == 1);
    CHECK(counted({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}) == 0);
    CHECK(counted({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1e-17}}) == 0);
    CHECK(counted({{0, 0}}) == 0);
}

TEST(mirrored_ways_cross_as_often) {
    // Vertices on a grid lie on the segments of others.
    std::mt19937 random(3);
    std::uniform_int_distribution<int> place(0, 6);
    int total = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Vec2> vertices, mirrored;
        for (int i = 0; i < 12; ++i) {
            vertices.push_back({double(place(random)), double(place(random))});
            mirrored.push_back({-vertices.back().x, vertices.back().y});
        }
        CHECK(counted(vertices) == counted(mirrored));
        total += counted(vertices);
    }
    CHECK(total > 1000);
}

TEST(pairs_of_polylines_cross_where_some_of_their_segments_do) {
    std::mt19937 random(8);
    long total = 0;
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<Vec2> vertices;
        std::vector<std::int64_t> starts{0};
        for (int i = 0; i < 12; ++i) {
            const Vec2 shift = random_points(random, 1)[0];
            for (const Vec2 p : random_walk(random, 6)) vertices.push_back(p + 0.2 * shift);
            starts.push_back(static_cast<std::int64_t>(vertices.size()));
        }
        const auto found = CrossingPairs(vertices, starts, false).run();
        std::size_t expected = 0;
        for (std::int64_t i = 0; i < 12; ++i)
            for (std::int64_t k = i + 1; k < 12; ++k) {
                bool crosses = false;
                for (auto a = starts[i]; a + 1 < starts[i + 1]; ++a)
                    for (auto c = starts[k]; c + 1 < starts[k + 1]; ++c)
                        crosses |= cross_inside(vertices[a], vertices[a + 1], vertices[c],
                                                vertices[c + 1]);
                expected += crosses;
                CHECK(crosses == (std::find(found.begin(), found.end(), std::pair{i, k}) !=
                                  found.end()));
            }
        CHECK(found.size() == expected);
        total += static_cast<long>(expected);
    }
    CHECK(total > 100);
}
