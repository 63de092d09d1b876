// Knots that come and go: what stays where it was.
#include <algorithm>

#include "check.hpp"
#include "shapespline/curve/bspline.hpp"
#include "shapespline/spline/span_shape.hpp"
#include "states.hpp"

using namespace shapespline;
using namespace shapespline::spline;

namespace {

constexpr int kPoints = 14;

template <int Degree>
Vec2 point_at_data(const SplineState<Degree> &state, int j) {
    return SpanShape<Degree>(state, state.span[j]).curve.point(state.local_parameter[j]);
}

template <int Degree>
void insert_everywhere(const SplineState<Degree> &state) {
    const auto [begin, end] = state.all_spans();
    for (int k = begin; k < end; ++k) {
        if (!(state.interval(k) > 0.0)) continue;
        auto split = state;
        insert_knot(split, k, 0.2, 100);
        CHECK(split.knot_with_id(100) == k + 1);
        CHECK(std::is_sorted(split.span.begin(), split.span.end()));
        // Rounding of monomials grows by half a digit a degree; short intervals take a digit.
        const double rounding = 1e-13 * std::pow(10.0, 0.5 * Degree);
        for (int j = 0; j < state.n_data(); ++j)
            CHECK(norm(point_at_data(split, j) - point_at_data(state, j)) <= rounding);
    }
}

template <int Degree>
void remove_each(const SplineState<Degree> &state) {
    for (int r = 0; r < kPoints; ++r) {
        if (!state.removable(r)) continue;
        auto removed = state;
        remove_knot(removed, r);
        CHECK(removed.n_points() == kPoints - 1);
        CHECK(removed.knot_with_id(state.knot_ids[r]) < 0);
        CHECK(std::is_sorted(removed.span.begin(), removed.span.end()));
        // Beyond the reach of the knot the curve keeps its bits.
        for (int k = r + Degree; k < r + kPoints - Degree; ++k) {
            if (!state.closed && k >= kPoints) break;
            if (!(state.interval(k) > 0.0)) continue;
            const int after = removed.knot_with_id(state.knot_ids[state.interval_index(k)]);
            const auto was = SpanShape<Degree>(state, k), is = SpanShape<Degree>(removed, after);
            for (int q = 0; q <= Degree; ++q) CHECK(norm(was.curve.c[q] - is.curve.c[q]) == 0.0);
        }
        const double before = state.interval(r - 1), merged = before + state.interval(r);
        for (int j = 0; j < state.n_data(); ++j) {
            const int from_merged = state.span[j] - r + 1;
            const int offset = state.closed ? wrap(from_merged, kPoints) : from_merged;
            if (offset != 0 && offset != 1) {
                CHECK(removed.local_parameter[j] == state.local_parameter[j]);
                continue;
            }
            const double along = 0.5 * (state.local_parameter[j] + 1.0);
            const double from = offset == 0 ? 0.0 : before;
            CHECK_NEAR(0.5 * (removed.local_parameter[j] + 1.0) * merged,
                       from + along * (offset == 0 ? before : merged - before), 1e-14);
            CHECK(removed.knot_ids[removed.interval_index(removed.span[j])] ==
                  state.knot_ids[state.interval_index(r - 1)]);
        }
    }
}

// Open and closed ones in turn.
template <class Check>
void each_degree(unsigned seed, Check &&check) {
    std::mt19937 random(seed);
    for (int degree = 1; degree <= 5; ++degree)
        dispatch_degree(degree, [&]<int Degree>() {
            for (int i = 0; i < 20; ++i)
                check(random_state<Degree>(random, kPoints, i % 2 == 0));
        });
}

}  // namespace

TEST(a_knot_that_is_inserted_leaves_the_curve) {
    each_degree(4, [](const auto &state) { insert_everywhere(state); });
}

TEST(a_knot_that_is_removed_changes_what_it_reaches) {
    each_degree(5, [](const auto &state) { remove_each(state); });
}
