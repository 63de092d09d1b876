// Basis functions as polynomials, Bezier pieces and cursors against the Cox-de Boor definition.
#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/curve/bezier.hpp"
#include "shapespline/curve/span_basis.hpp"
#include "shapespline/curve/span_cursor.hpp"

using namespace shapespline;

namespace {

// Rounding of monomials on [-1, 1] grows by a digit a degree.
double rounding(int degree) { return 1e-15 * std::pow(10.0, 0.5 * degree); }

template <int Degree>
void compare(std::mt19937 &random) {
    constexpr int kPoints = 9 + Degree;
    const std::vector<double> values = clamped_knots(random, kPoints, Degree);
    const std::vector<Vec2> points = random_points(random, kPoints);
    const Knots knots{values, Degree, false};
    SpanCursor<Degree> cursor(knots, points);
    CurveCursor<Degree> plain(knots, points);
    const auto pieces = bezier_pieces<Degree>(knots, points);
    for (int trial = 0; trial < 40; ++trial) {
        const double u = random_parameter(random, knots);
        cursor.seek(u);
        plain.seek(u);
        const Vec2 expected = point_by_definition(values, points, Degree, u);
        CHECK(norm(cursor.point() - expected) <= 20.0 * rounding(Degree));
        CHECK(norm(plain.point() - expected) <= 1e-14);
        CHECK(cursor.first_index() == plain.first_index());
        double sum = 0.0;
        for (int l = 0; l <= Degree; ++l) {
            double value = 0.0;
            for (int q = Degree; q >= 0; --q)
                value = value * cursor.local_parameter() + cursor.basis().of_point[l][q];
            const int i = static_cast<int>(cursor.first_index()) + l;
            CHECK_NEAR(value, basis_by_definition(values, i, Degree, u), 5.0 * rounding(Degree));
            sum += value;
        }
        CHECK_NEAR(sum, 1.0, 10.0 * rounding(Degree));
        for (const auto &piece : pieces)
            if (piece.begin <= u && u < piece.end)
                CHECK(norm(piece.at((u - piece.begin) / (piece.end - piece.begin)).point -
                           expected) <= 1e-13);
        // The tangent is the central difference quotient to its square, away from knots.
        const double h = 1e-5;
        if (Degree > 1 && knots.span_of(u - h, 0) == knots.span_of(u + h, 0)) {
            const Vec2 quotient =
                (0.5 / h) * (point_by_definition(values, points, Degree, u + h) -
                             point_by_definition(values, points, Degree, u - h));
            const double scale = 1.0 + norm(quotient);
            CHECK(norm(cursor.tangent() - quotient) <= 1e-5 * scale);
            CHECK(norm(plain.tangent() - cursor.tangent()) <= 1e3 * rounding(Degree) * scale);
        }
    }
}

template <int Degree>
void compare_bernstein_form(std::mt19937 &random) {
    SpanCurve<Degree> curve;
    for (Vec2 &c : curve.c) c = random_points(random, 1)[0];
    const Bezier<Degree> piece = curve.bezier();
    for (int i = 0; i <= 8; ++i) {
        const double s = i / 8.0;
        CHECK(norm(piece.at(s).point - curve.point(2.0 * s - 1.0)) <= 100.0 * rounding(Degree));
    }
    const auto [left, right] = piece.halves();
    CHECK(norm(left.at(1.0).point - right.at(0.0).point) <= 1e-13);
    CHECK(norm(left.at(0.5).point - piece.at(0.25).point) <= 1e-13);
}

}  // namespace

TEST(span_polynomials_are_the_basis_functions) {
    std::mt19937 random(2);
    for (int degree = 1; degree <= 5; ++degree)
        dispatch_degree(degree, [&]<int Degree>() { compare<Degree>(random); });
}

TEST(the_bernstein_form_is_the_same_curve) {
    std::mt19937 random(3);
    for (int degree = 1; degree <= 5; ++degree)
        dispatch_degree(degree, [&]<int Degree>() { compare_bernstein_form<Degree>(random); });
}
