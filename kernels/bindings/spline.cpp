// One spline by knot removal: a search is a few calls, each a whole stage.
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "shapespline/spline/search.hpp"

using namespace nb::literals;
using Removal = ss::spline::RemovalSearch;

void bind_spline(nb::module_ &m) {
    nb::class_<ss::spline::RemovalSearch>(m, "RemovalSearch")
        .def(
            "__init__",
            [](ss::spline::RemovalSearch *self, In2 data, bool closed, int degree,
               double tolerance,
               bool keep_rule, int start, double gap_ratio, double speed_ratio,
               double least_gap, double largest_gap, double enough, double accept,
               int samples_per_span,
               double sample_weight, double hope, double worth_trying,
               double worth_insisting, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                const ss::spline::FitLimits fit{tolerance,     enough,    samples_per_span,
                                        sample_weight, least_gap, largest_gap,
                                        hope};
                new (self) ss::spline::RemovalSearch(
                    vectors(data), closed, degree,
                    {tolerance, keep_rule, start, {gap_ratio, speed_ratio}, fit,
                     accept, worth_trying, worth_insisting},
                    asking);
            },
            "data"_a.noconvert(), "closed"_a, "degree"_a, "tolerance"_a, "keep_rule"_a,
            "start"_a, "gap_ratio"_a, "speed_ratio"_a, "least_gap"_a,
            "largest_gap"_a, "enough"_a,
            "accept"_a, "samples_per_span"_a, "sample_weight"_a, "hope"_a,
            "worth_trying"_a, "worth_insisting"_a, "ask"_a)
        .def(
            "remove_cheapest",
            [](Removal &self, const Removal::EffortTuple &rank, const Removal::EffortTuple &effort,
               long most_trials, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                return self.remove_cheapest(rank, effort, most_trials, asking);
            },
            "rank"_a, "effort"_a, "most_trials"_a, "ask"_a)
        .def(
            "remove_stubborn",
            [](Removal &self, const Removal::EffortTuple &effort, const std::vector<int> &spreads,
               nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                return self.retry(effort, spreads, asking);
            },
            "effort"_a, "spreads"_a, "ask"_a)
        .def("curve", &ss::spline::RemovalSearch::curve)
        .def("n_points", &ss::spline::RemovalSearch::n_points)
        .def("from_polyline", &ss::spline::RemovalSearch::from_polyline)
        .def("counts", &ss::spline::RemovalSearch::counts);
}
