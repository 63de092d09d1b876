// Normal equations made of moments, or of products, against sums written out point by point.
#include <algorithm>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/least_squares/normal_equations.hpp"
#include "shapespline/least_squares/residuals.hpp"

using namespace shapespline;
namespace ls = shapespline::least_squares;

namespace {

struct Case {
    std::vector<double> knots, parameters, weights;
    std::vector<Vec2> control_points, data;
    Knots view;
    ls::Samples samples;

    Case(int degree, bool periodic, std::mt19937 &random) {
        constexpr int kData = 60;
        const int m = degree + 7;
        knots = periodic ? periodic_knots(random, m, degree) : clamped_knots(random, m, degree);
        view = {knots, degree, periodic};
        control_points = random_points(random, m);
        data = random_points(random, kData);
        for (int j = 0; j < kData; ++j) {
            parameters.push_back(random_parameter(random, view));
            weights.push_back(0.5 + (j % 3));
        }
        std::sort(parameters.begin(), parameters.end());
        samples = {data, parameters, weights.data()};
    }
};

void compare(int degree, bool periodic, std::mt19937 &random) {
    const Case c(degree, periodic, random);
    const std::size_t m = c.control_points.size();
    const double inverse_h = 0.3;
    const auto tangents_count = [&](std::size_t, Vec2 t) { return inverse_h / norm_sq(t); };
    ls::NormalEquations equations(m, degree, periodic);
    const std::vector<Vec2> unrolled = unroll(c.control_points, c.view.n_coefficients());
    equations.add(c.view, unrolled, c.samples, tangents_count);

    std::vector<std::vector<double>> matrix(2 * m, std::vector<double>(2 * m, 0.0));
    std::vector<double> rhs(2 * m, 0.0), values(degree + 1);
    double cost = 0.0;
    dispatch_degree(degree, [&]<int Degree>() {
        CurveCursor<Degree> cursor(c.view, unrolled);
        for (std::size_t j = 0; j < c.data.size(); ++j) {
            cursor.seek(c.parameters[j]);
            const Vec2 r = cursor.point() - c.data[j], t = cursor.tangent();
            const double w = c.weights[j], h = inverse_h / norm_sq(t);
            const double weight[2][2] = {{w * (1 - t.x * t.x * h), -w * t.x * t.y * h},
                                         {-w * t.x * t.y * h, w * (1 - t.y * t.y * h)}};
            const double residual[2] = {r.x, r.y};
            cost += 0.5 * w * norm_sq(r);
            for (int a = 0; a <= Degree; ++a)
                for (int i = 0; i < 2; ++i) {
                    const std::size_t row = 2 * ((cursor.first_index() + a) % m) + i;
                    for (int k = 0; k < 2; ++k) {
                        rhs[row] -= cursor.basis()[a] * weight[i][k] * residual[k];
                        for (int b = 0; b <= Degree; ++b)
                            matrix[row][2 * ((cursor.first_index() + b) % m) + k] +=
                                cursor.basis()[a] * cursor.basis()[b] * weight[i][k];
                    }
                }
        }
    });
    // Sums of 60 terms below 3; moments lose half a digit a degree.
    const double rounding = 1e-13 * std::pow(10.0, 0.5 * std::min(degree, ls::kMomentDegree));
    CHECK_NEAR(equations.cost, cost, 1e-12 * (1.0 + cost));
    for (std::size_t i = 0; i < 2 * m; ++i) {
        CHECK_NEAR(equations.rhs[i], rhs[i], rounding);
        for (std::size_t k = 0; k <= i; ++k) {
            const bool stored = k >= equations.matrix.first_column(i);
            CHECK(stored || matrix[i][k] == 0.0);
            if (stored) CHECK_NEAR(equations.matrix.at(i, k), matrix[i][k], rounding);
        }
    }
}

}  // namespace

TEST(normal_equations_are_the_sums_over_the_points) {
    std::mt19937 random(4);
    for (int degree = 1; degree <= kMaxDegree; ++degree)
        for (const bool periodic : {false, true}) compare(degree, periodic, random);
}

TEST(the_gradient_is_the_difference_quotient_of_the_cost) {
    std::mt19937 random(5);
    for (const bool periodic : {false, true}) {
        Case c(3, periodic, random);
        c.samples.stray_weight = 0.1;
        std::vector<Vec2> gradient(c.control_points.size());
        std::vector<double> of_parameters(c.parameters.size());
        ls::cost_and_gradient(c.view, c.control_points, c.samples, gradient,
                              of_parameters.data());
        const double h = 1e-6;
        const auto quotient = [&](double &x) {
            const double kept = x;
            x = kept + h;
            const double above = ls::cost(c.view, c.control_points, c.samples);
            x = kept - h;
            const double below = ls::cost(c.view, c.control_points, c.samples);
            x = kept;
            return (above - below) / (2.0 * h);
        };
        for (std::size_t i = 0; i < gradient.size(); ++i) {
            CHECK_NEAR(gradient[i].x, quotient(c.control_points[i].x), 1e-7);
            CHECK_NEAR(gradient[i].y, quotient(c.control_points[i].y), 1e-7);
        }
    }
}
