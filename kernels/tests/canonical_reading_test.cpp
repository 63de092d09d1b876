// Readings against a look at all of them, and poses of moved points.
#include <cmath>
#include <vector>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/analysis/canonical_reading.hpp"

using namespace shapespline;
using namespace shapespline::analysis;

namespace {

// Few whole numbers, so that many rotations are the same.
std::vector<double> some_numbers(std::mt19937 &random, int n, int period) {
    std::vector<double> numbers(n);
    for (int i = 0; i < n; ++i)
        numbers[i] = i < period ? static_cast<double>(random() % 3) : numbers[i - period];
    return numbers;
}

}  // namespace

TEST(the_greatest_rotation_is_that_of_all) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 400; ++trial) {
        const int period = 1 + static_cast<int>(random() % 6);
        const int n = period * (1 + static_cast<int>(random() % 3));
        const std::vector<double> numbers = some_numbers(random, n, period);
        const auto [start, again] =
            greatest_rotation(n, [&](std::int64_t i) { return numbers[i]; });
        const auto less = [&](std::int64_t i, std::int64_t j) { return numbers[i] < numbers[j]; };
        for (int other = 0; other < n; ++other) {
            const int order = compared({other, 1}, {start, 1}, n, less);
            CHECK(order <= 0);
            // All that are the same begin a whole number of periods later.
            CHECK((order == 0) == ((other - start) % again == 0));
        }
    }
}

TEST(moved_points_have_the_same_pose) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 50; ++trial) {
        const std::vector<Vec2> walk = random_walk(random, 40);
        std::vector<Vec2> moved, once(walk.size()), again(walk.size());
        const double c = std::cos(0.1 * trial), s = std::sin(0.1 * trial), scale = 1.0 + trial;
        for (const Vec2 p : walk)
            moved.push_back({scale * (c * p.x - s * p.y) + 3.0, -scale * (s * p.x + c * p.y)});
        const PosedContour first(walk, trial % 2 == 0, 32.0, 1e-6, 1e-9, once);
        const PosedContour other(moved, trial % 2 == 0, 32.0, 1e-6 * scale, 1e-9, again);
        CHECK(first.apart && other.apart);
        CHECK(first.reading.start == other.reading.start);
        CHECK(first.reading.step == other.reading.step);
        for (std::size_t i = 0; i < once.size(); ++i) CHECK(norm(once[i] - again[i]) == 0.0);
    }
}
