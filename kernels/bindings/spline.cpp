// One spline by knot removal: a search is a few calls, each a whole stage.
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <vector>

#include "arrays.hpp"
#include "shapespline/spline/search.hpp"

using namespace nb::literals;
namespace spline = ss::spline;
using spline::RemovalSearch;

namespace {

void bind_settings(nb::module_ &m) {
    nb::class_<spline::FitStage>(m, "FitStage")
        .def(nb::init<int, int, bool, double>(), "half_power"_a, "iterations"_a,
             "intervals_free"_a, "give_up"_a);
    nb::class_<spline::Effort>(m, "RemovalEffort")
        .def(nb::init<int, std::vector<spline::FitStage>>(), "n_side"_a, "stages"_a);
    nb::class_<spline::FitLimits>(m, "FitLimits")
        .def(nb::init<double, double, int, double, double, double, double>(), nb::kw_only(),
             "tolerance"_a, "enough"_a, "samples_per_span"_a, "sample_weight"_a,
             "least_interval"_a, "largest_interval"_a, "stagnation_limit"_a);
    nb::class_<spline::Fairness>(m, "Fairness")
        .def(nb::init<double, double>(), nb::kw_only(), "interval_ratio"_a, "speed_ratio"_a);
    nb::class_<spline::Patience>(m, "Patience")
        .def(nb::init<int, double>(), "failures"_a, "distance"_a);
    nb::class_<spline::SplineSettings>(m, "SplineSettings")
        .def(nb::init<spline::FitLimits, spline::Fairness, bool, int, int, double,
                      spline::Patience, spline::Patience>(),
             nb::kw_only(), "fit"_a, "fairness"_a, "keep_fair"_a, "start"_a, "most_at_start"_a,
             "accept"_a, "trying"_a, "retrying"_a);
}

}  // namespace

void bind_spline(nb::module_ &m) {
    bind_settings(m);
    nb::class_<RemovalSearch>(m, "RemovalSearch")
        .def(
            "__init__",
            [](RemovalSearch *self, In2 data, bool closed, int degree,
               const spline::SplineSettings &settings, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                new (self) RemovalSearch(vectors(data), closed, degree, settings, asking);
            },
            "data"_a.noconvert(), "closed"_a, "degree"_a, "settings"_a, "ask"_a)
        .def(
            "remove_cheapest",
            [](RemovalSearch &self, const spline::Effort &rank, const spline::Effort &effort,
               long most_trials, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                return self.remove_cheapest(rank, effort, most_trials, asking);
            },
            "rank"_a, "effort"_a, "most_trials"_a, "ask"_a)
        .def(
            "retry",
            [](RemovalSearch &self, const spline::Effort &effort,
               const std::vector<int> &redistributions, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                return self.retry(effort, redistributions, asking);
            },
            "effort"_a, "redistributions"_a, "ask"_a)
        .def("curve", &RemovalSearch::curve)
        .def("n_points", &RemovalSearch::n_points)
        .def("from_polyline", &RemovalSearch::from_polyline)
        .def("counts", &RemovalSearch::counts);
}
