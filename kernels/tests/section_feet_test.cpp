// Feet on one span, two at once, against safeguarded steps of one after another.
#include <limits>

#include "check.hpp"
#include "shapes.hpp"
#include "shapespline/pieces/section_feet.hpp"

using namespace shapespline;
using namespace shapespline::pieces;

namespace {

struct Foot {
    double u, distance_sq;
};

Foot foot_alone(const SpanPolynomial &span, Vec2 q, double u, int iterations, double enough_sq) {
    Foot best{u, std::numeric_limits<double>::infinity()};
    for (int step = 0; step <= iterations; ++step) {
        const Vec2 r = span.point(u) - q;
        if (!(norm_sq(r) < best.distance_sq)) break;
        best = {u, norm_sq(r)};
        const Vec2 t = span.velocity(u);
        const double speed_sq = norm_sq(t);
        const double curvature =
            descent_curvature(speed_sq, speed_sq + dot(r, span.acceleration(u)));
        if (!(curvature > 0.0) || dot(r, t) * dot(r, t) < enough_sq * curvature) break;
        u = std::clamp(u + std::clamp(-dot(r, t) / curvature, -1.0, 1.0), 0.0, 1.0);
    }
    return best;
}

}  // namespace

TEST(two_feet_at_once_are_those_of_one_after_another) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> anywhere(-0.1, 1.1);
    const std::vector<Index> active{0, 1, 2, 4, 5, 7, 8};  // an odd number
    for (int trial = 0; trial < 200; ++trial) {
        const auto c = random_points(random, 4);
        SpanPolynomial span{0.0, 1.0, {}, {}};
        for (int q = 0; q < 4; ++q) span.x[q] = c[q].x, span.y[q] = c[q].y;
        const auto data = random_points(random, 9, 2.0);
        for (const int iterations : {0, 1, 3}) {
            std::vector<double> u(data.size()), distances_sq(data.size(), -1.0);
            std::vector<int> spans(data.size(), 5);
            for (double &parameter : u) parameter = anywhere(random);
            const std::vector<double> begun = u;
            improve_feet(&span, 1, data.data(), active, 0, iterations, 1e-9,
                         {u.data(), spans.data(), distances_sq.data()});
            for (const Index j : active) {
                const Foot expected = foot_alone(span, data[j], std::clamp(begun[j], 0.0, 1.0),
                                                 iterations, 1e-9);
                CHECK(u[j] == expected.u && distances_sq[j] == expected.distance_sq);
                CHECK(spans[j] == 0);
            }
            CHECK(u[3] == begun[3] && u[6] == begun[6]);
        }
    }
}
