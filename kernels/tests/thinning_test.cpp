// Thinned polylines against the definition: every vertex near its chord.
#include <algorithm>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/distance/polyline.hpp"
#include "shapespline/distance/thinning.hpp"

using namespace shapespline;

namespace {

std::vector<Vec2> wave(int count) {
    std::vector<Vec2> points(count);
    for (int i = 0; i < count; ++i) points[i] = {0.01 * i, std::sin(0.05 * i)};
    return points;
}

// Whether all vertices between kept ones lie within a distance of their chords.
bool is_near(const std::vector<Vec2> &points, const std::vector<std::int64_t> &kept,
             double distance) {
    for (std::size_t k = 0; k + 1 < kept.size(); ++k)
        for (std::int64_t j = kept[k] + 1; j < kept[k + 1]; ++j)
            if (segment_distance_sq(points[j], points[kept[k]], points[kept[k + 1]]) >
                distance * distance * (1.0 + 1e-9))
                return false;
    return true;
}

}  // namespace

TEST(thinned_vertices_stay_near_their_chords) {
    std::mt19937 random(7);
    for (const double distance : {0.003, 0.05, 0.3})
        for (int trial = 0; trial < 20; ++trial) {
            const auto points = trial == 0 ? wave(400) : random_walk(random, 200);
            const auto kept = thinned(points, distance, 1e9);
            CHECK(kept.front() == 0);
            CHECK(kept.back() == static_cast<std::int64_t>(points.size()) - 1);
            CHECK(std::is_sorted(kept.begin(), kept.end()));
            CHECK(is_near(points, kept, distance));
            if (trial == 0) CHECK(kept.size() < points.size() / 3);
        }
}

TEST(long_ways_are_cut_and_marked_vertices_kept) {
    std::vector<Vec2> line(101);
    for (int i = 0; i <= 100; ++i) line[i] = {0.01 * i, 0.0};
    CHECK(thinned(line, 1e-3, 1e9).size() == 2);
    const auto cut = thinned(line, 1e-3, 0.255);
    CHECK(cut.size() == 5);
    for (std::size_t k = 0; k + 1 < cut.size(); ++k) CHECK(cut[k + 1] - cut[k] <= 25);
    std::vector<std::int64_t> marked(101, 0);
    marked[37] = 1;
    CHECK(thinned(line, 1e-3, 1e9, marked) == (std::vector<std::int64_t>{0, 37, 100}));
}
