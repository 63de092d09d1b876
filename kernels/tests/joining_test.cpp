// Pieces end to end as one curve, their tangents made common, against the pieces themselves.
#include <cmath>
#include <numbers>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/curve/arc_length.hpp"
#include "shapespline/curve/common_tangents.hpp"
#include "shapespline/curve/joining.hpp"

using namespace shapespline;

namespace {

constexpr double kSame = 1e-9;

// A line, a parabola, a cubic and a cubic spline of two spans, whose joints turn by these degrees.
struct Chain {
    std::vector<int> degrees{1, 2, 3, 3}, counts{2, 3, 4, 5};
    std::vector<double> knots{0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1,
                              0, 0, 0, 0, 0.4, 1, 1, 1, 1};
    std::vector<Vec2> points{{0, 0}};

    explicit Chain(double turn) {
        double angle = 0.3;
        for (const int count : counts) {
            if (points.size() > 1) points.push_back(points.back());
            for (int i = 1; i < count; ++i) {
                points.push_back(points.back() + Vec2{std::cos(angle), std::sin(angle)});
                if (i + 1 < count) angle += 0.4;
            }
            angle += turn * std::numbers::pi / 180.0;
        }
    }
    auto row() const {
        return piece_row(degrees, counts, knots, std::span<const Vec2>(points));
    }
};

}  // namespace

TEST(lengths_are_those_of_long_numbers) {
    std::mt19937 random(3);
    for (const double size : {1e-200, 1e-9, 1.0, 1e30, 1e200})
        for (const Vec2 v : random_points(random, 500, size)) {
            const long double x = v.x / size, y = v.y / size;
            const auto expected = static_cast<double>(std::sqrt(x * x + y * y) * size);
            CHECK_NEAR(length(v), expected, 3e-16 * expected);
        }
    CHECK(length({3.0, -4.0}) == 5.0 && length({0.0, 0.0}) == 0.0);
}

TEST(a_joined_curve_is_its_pieces_one_after_another) {
    for (const double turn : {0.0, 20.0})
        for (const int degree : {3, 4, 7}) {
            const Chain chain(turn);
            auto row = chain.row();
            if (degree > 3) row.pop_back();  // a spline is raised elsewhere
            const JoinedPieces joined(row, degree, kSame);
            std::vector<Vec2> points(joined.n_points());
            std::vector<double> knots(points.size() + degree + 1);
            joined.write(knots.data(), points.data());
            CHECK(knots.front() == 0.0 && knots.back() == 1.0);
            // Each piece ends at a knot of full multiplicity, or of one less where it goes on.
            std::vector<double> ends{0.0};
            std::size_t spans = 0;
            for (const auto &piece : row) spans += piece.points.size() - piece.degree;
            for (std::size_t i = 1; i < knots.size(); ++i)
                if (knots[i] > knots[i - 1]) ends.push_back(knots[i]);
            CHECK(ends.size() == spans + 1);
            std::size_t span = 0;
            for (const auto &piece : row) {
                const std::size_t n = piece.points.size() - piece.degree;
                const double begin = ends[span], end = ends[span += n];
                const std::vector<double> own(piece.knots.begin(), piece.knots.end());
                const std::vector<Vec2> polygon(piece.points.begin(), piece.points.end());
                for (const double u : {0.01, 0.3, 0.7, 0.99}) {
                    const Vec2 expected = point_by_definition(own, polygon, piece.degree, u);
                    const Vec2 found =
                        point_by_definition(knots, points, degree, begin + u * (end - begin));
                    CHECK_NEAR(norm(found - expected), 0.0, 1e-12);
                }
            }
        }
    const auto count = [](double turn) {
        return JoinedPieces(Chain(turn).row(), 3, kSame).n_points();
    };
    CHECK(count(20.0) == 14 && count(0.0) == 11);
}

TEST(pieces_next_to_no_length_leave_intervals_that_can_be_told) {
    const std::vector<int> degrees{1, 1, 1}, counts{2, 2, 2};
    const std::vector<double> knots{0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1};
    const std::vector<Vec2> points{{0, 0}, {1, 0}, {1, 0}, {1, 1e-18}, {1, 1e-18}, {2, 1}};
    const JoinedPieces joined(
        piece_row(degrees, counts, knots, std::span<const Vec2>(points)), 1, kSame);
    std::vector<Vec2> found(joined.n_points());
    std::vector<double> all(found.size() + 2);
    joined.write(all.data(), found.data());
    for (std::size_t i = 2; i + 1 < all.size(); ++i) CHECK(all[i] > all[i - 1]);
}

TEST(tangents_that_nearly_agree_are_one_and_others_stay) {
    for (const double turn : {0.5, 5.0}) {
        const Chain chain(turn);
        std::vector<Vec2> points = chain.points;
        make_tangents_common(piece_row(chain.degrees, chain.counts, {}, std::span<Vec2>(points)),
                             0.1, 1.001 * std::numbers::pi / 180.0, false);
        const auto row = piece_row(chain.degrees, chain.counts, {}, std::span<Vec2>(points));
        // The joints of a parabola share a control point: the second one has it.
        for (std::size_t i = 2; i < row.size(); ++i) {
            const Vec2 u = row[i - 1].last_leg(), v = row[i].first_leg();
            CHECK_NEAR(std::fabs(std::atan2(cross(u, v), dot(u, v))),
                       turn < 1.0 ? 0.0 : turn * std::numbers::pi / 180.0, 1e-12);
        }
        CHECK(norm(points[1] - chain.points[1]) == 0.0);  // lines stay lines
    }
    const Chain chain(0.5);
    std::vector<Vec2> points = chain.points;
    make_tangents_common(piece_row(chain.degrees, chain.counts, {}, std::span<Vec2>(points)), 1e-6,
                         0.02, false);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(norm(points[i] - chain.points[i]) == 0.0);
}

TEST(polygons_and_polylines_are_as_long_as_their_steps) {
    const Chain chain(3.0);
    const auto lengths = polygon_lengths(chain.counts, chain.points);
    CHECK(lengths.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK_NEAR(lengths[i], chain.counts[i] - 1.0, 1e-14);
    std::vector<double> along(chain.points.size());
    arc_length(chain.points, along.data());
    CHECK(along.front() == 0.0);
    CHECK_NEAR(along.back(), 1.0 + 2.0 + 3.0 + 4.0, 1e-13);
}
