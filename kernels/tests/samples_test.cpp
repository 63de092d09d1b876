// Where curves are compared with the polyline of their data.
#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "shapespline/spline/samples.hpp"
#include "states.hpp"

using namespace shapespline;
using namespace shapespline::spline;

namespace {

constexpr int kPoints = 14, kPerSpan = 16;
// Of parameters, which are sums of some ten intervals of one or less.
constexpr double kRounding = 1e-13;

double parameter(const LocalCurve &curve, int span, double u) {
    double begin = 0.0;
    for (int k = 0; k < span; ++k) begin += curve.intervals[k];
    return begin + 0.5 * (u + 1.0) * curve.intervals[span];
}
double of_datum(const LocalCurve &curve, int j) {
    return parameter(curve, curve.span[j], curve.local_parameter[j]);
}
double of_sample(const LocalCurve &curve, const CurveSample &sample) {
    return parameter(curve, sample.span, sample.local_parameter);
}
bool has_sample_at(const LocalCurve &curve, const std::vector<CurveSample> &samples, double t) {
    return std::ranges::any_of(samples, [&](const CurveSample &one) {
        return std::abs(of_sample(curve, one) - t) <= kRounding;
    });
}

template <int Degree>
void check_row(const Window<Degree> &window, const LocalCurve &curve,
               const std::vector<CurveSample> &samples) {
    const int n_segments = static_cast<int>(window.segments.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(samples[i].span >= window.first_sampled && samples[i].span <= window.last_sampled);
        CHECK(curve.intervals[samples[i].span] > 0.0);
        CHECK(std::abs(samples[i].local_parameter) <= 1.0 + kRounding);
        CHECK(samples[i].segment >= 0 && samples[i].segment < n_segments);
        if (i == 0) continue;
        CHECK(samples[i].span >= samples[i - 1].span);
        CHECK(of_sample(curve, samples[i]) >= of_sample(curve, samples[i - 1]) - kRounding);
    }
    for (int k = window.first_sampled; k <= window.last_sampled; ++k)
        if (curve.intervals[k] > 0.0)
            CHECK(has_sample_at(curve, samples, parameter(curve, k, -1.0)));
}

// How many pairs of data have a sample in the middle, and whether there is one wherever they have
// one between them that is on no knot.
template <int Degree>
int check_middles(const Window<Degree> &window, const LocalCurve &curve,
                  const std::vector<CurveSample> &samples) {
    int n_middles = 0;
    for (int j = 0; j + 1 < window.n_data(); ++j) {
        const double begin = of_datum(curve, j), end = of_datum(curve, j + 1);
        const bool seen = std::ranges::any_of(samples, [&](const CurveSample &one) {
            const double t = of_sample(curve, one);
            return one.local_parameter > -1.0 && t > begin + kRounding && t < end - kRounding;
        });
        const bool middle = has_sample_at(curve, samples, 0.5 * (begin + end));
        CHECK(middle || !seen);
        n_middles += middle;
    }
    return n_middles;
}

template <class Check>
void each_window(Check &&check) {
    std::mt19937 random(17);
    for (int degree = 1; degree <= 4; ++degree)
        dispatch_degree(degree, [&]<int Degree>() {
            for (int i = 0; i < 20; ++i) {
                const auto state = random_state<Degree>(random, kPoints, i % 2 == 0);
                const auto all = random_points(random, state.n_data());
                Window<Degree> window;
                if (i % 4 < 2) window.open_around(state, all, 6, 2);
                else window.open_whole(state, all);
                check(window);
            }
        });
}

}  // namespace

TEST(samples_of_few_data_lie_in_their_middles_and_move_with_them) {
    int n_middles = 0;
    each_window([&]<int Degree>(const Window<Degree> &window) {
        SamplePlan<Degree> plan;
        std::vector<CurveSample> samples, moved;
        plan.make(window, window.curve, kPerSpan, true);
        CHECK(plan.moves());
        plan.place(window, window.curve, nullptr, samples);
        check_row(window, window.curve, samples);
        n_middles += check_middles(window, window.curve, samples);
        // The same data at other parameters of the same spans.
        LocalCurve other = window.curve;
        for (double &u : other.local_parameter) u = 0.5 * (u - 0.2);
        plan.place(window, other, &samples, moved);
        check_row(window, other, moved);
        const double begin = parameter(other, window.first_sampled, -1.0);
        const double end = parameter(other, window.last_sampled, 1.0);
        for (int j = 0; j + 1 < window.n_data(); ++j) {
            const double was = 0.5 * (of_datum(window.curve, j) + of_datum(window.curve, j + 1));
            const double is = 0.5 * (of_datum(other, j) + of_datum(other, j + 1));
            if (is >= begin && is < end && has_sample_at(window.curve, samples, was))
                CHECK(has_sample_at(other, moved, is));
        }
    });
    CHECK(n_middles > 1000);
}

TEST(samples_of_many_data_rest_at_even_steps) {
    int n_planned = 0;
    each_window([&]<int Degree>(const Window<Degree> &window) {
        for (const auto &[n_per_span, may_move] :
             {std::pair{2, true}, std::pair{6, true}, std::pair{kPerSpan, false}}) {
            SamplePlan<Degree> plan;
            std::vector<CurveSample> samples, again;
            const int n_spans = window.last_sampled - window.first_sampled + 1;
            if (may_move && 2 * window.n_data() < n_per_span * n_spans) continue;
            n_planned += may_move && window.n_data() < n_per_span * n_spans;
            plan.make(window, window.curve, n_per_span, may_move);
            CHECK(!plan.moves());
            plan.place(window, window.curve, nullptr, samples);
            check_row(window, window.curve, samples);
            for (std::size_t i = 0; i < samples.size(); ++i)
                CHECK_NEAR(samples[i].local_parameter,
                           2.0 * (i % n_per_span) / n_per_span - 1.0, kRounding);
            plan.place(window, window.curve, &samples, again);
            CHECK(std::ranges::equal(again, samples, {}, &CurveSample::local_parameter,
                                     &CurveSample::local_parameter));
        }
    });
    CHECK(n_planned > 40);  // with more samples than data, but not twice as many
}
