// Shapes that are kept from removal to removal against those of the whole spline.
#include "check.hpp"
#include "shapespline/curve/bspline.hpp"
#include "shapespline/spline/span_shapes.hpp"
#include "states.hpp"

using namespace shapespline;
using namespace shapespline::spline;

namespace {

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

// Bit by bit.
template <int Degree>
void compare(const ShapeRow<Degree> &row, const SplineState<Degree> &state) {
    std::size_t at = 0;
    for (int k = state.all_spans().begin; k < state.all_spans().end; ++k) {
        if (!(state.interval(k) > 0.0)) continue;
        CHECK(at < row.size() && row[at].span == k);
        SpanShape<Degree> &kept = *row[at++].shape, fresh(state, k);
        for (int q = 0; q <= Degree; ++q) CHECK(same(kept.curve.c[q], fresh.curve.c[q]));
        CHECK(kept.interval == fresh.interval);
        CHECK(same(kept.hull.low, fresh.hull.low) && same(kept.hull.high, fresh.hull.high));
        CHECK(kept.speeds == fresh.speeds);
        for (const double critical : {0.0, 1e3})
            CHECK(kept.slowest(critical) == fresh.slowest(critical));
    }
    CHECK(at == row.size());
}

// Removals one after another, each second one taken back.
template <int Degree>
void remove_some(std::mt19937 &random, bool closed) {
    auto state = random_state<Degree>(random, 24, closed);
    SpanShapes<Degree> shapes;
    shapes.measure(state);
    for (int trial = 0; trial < 16; ++trial) {
        const int r = static_cast<int>(random() % state.n_points());
        if (!state.removable(r)) continue;
        auto changed = state;
        remove_knot(changed, r);
        changed.points[closed ? wrap(r - 1, changed.n_points()) : r - 1] += Vec2{0.1, 0.2};
        SpanRange spans{r - Degree, r + Degree};
        if (!closed) spans = {std::max(spans.begin, Degree),
                              std::min(spans.end, changed.n_points())};
        shapes.change(changed, spans);
        compare(shapes.tried(changed, changed.all_spans()), changed);
        compare(shapes.kept(state, state.all_spans()), state);
        if (trial % 2) continue;
        shapes.accept();
        state = changed;
        compare(shapes.kept(state, state.all_spans()), state);
    }
}

}  // namespace

TEST(shapes_of_a_trial_are_those_of_its_whole_curve) {
    std::mt19937 random(6);
    for (int degree = 1; degree <= 5; ++degree)
        dispatch_degree(degree, [&]<int Degree>() {
            for (int i = 0; i < 20; ++i) remove_some<Degree>(random, i % 2 == 0);
        });
}

TEST(the_slowest_speed_is_refined_beside_a_cusp) {
    // A Bezier piece that stands still in its middle, between the samples that are taken of it.
    SplineState<3> state;
    state.intervals = {0, 0, 0, 1, 0, 0};
    state.points = {{0, 0}, {10, 3}, {0, 3}, {11, 0}};
    state.knot_ids = {0, 1, 2, 3, 4, 5};
    SpanShape<3> shape(state, 3);
    double least = shape.speed(-1.0);
    for (int i = 0; i <= 100000; ++i) least = std::min(least, shape.speed(-1.0 + 2e-5 * i));
    const double sampled = shape.slowest(0.0);
    CHECK(sampled > least);
    // The speed is smooth there: a hundred thousandth of the span is a ten thousandth of it.
    CHECK_NEAR(shape.slowest(sampled), least, 1e-4 * least);
}
