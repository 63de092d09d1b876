// The Python face of the kernels: checks nothing, converts nothing, releases the GIL.
//
// Callers validate and allocate; every array is C-contiguous float64 or int64 as declared in
// _kernels.pyi, and outputs are written in place.
#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>

#include "bindings.hpp"
#include "shapespline/bezier.hpp"
#include "shapespline/bspline.hpp"
#include "shapespline/chords.hpp"
#include "shapespline/corner_turn.hpp"
#include "shapespline/cpda.hpp"
#include "shapespline/deviation.hpp"
#include "shapespline/footpoint.hpp"
#include "shapespline/mean_distance.hpp"
#include "shapespline/near_feet.hpp"
#include "shapespline/normal_equations.hpp"
#include "shapespline/outline_search.hpp"
#include "shapespline/removal_search.hpp"
#include "shapespline/residuals.hpp"
#include "shapespline/section_squares.hpp"
#include "shapespline/thinning.hpp"

using namespace nb::literals;
using Removal = ss::removal::RemovalSearch;

namespace {

// The caller's question, and its Ctrl-C; called while the GIL is released.
ss::Interruption interruption(const nb::object &ask) {
    return ss::Interruption([&ask](long n_points) {
        nb::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        return nb::cast<bool>(ask(n_points));
    });
}

}  // namespace

NB_MODULE(_kernels, m) {
    m.attr("MAX_DEGREE") = ss::kMaxDegree;

    m.def(
        "basis_functions",
        [](In1 knots, int degree, bool periodic, In1 parameters, Out2 values, OutIndices first) {
            nb::gil_scoped_release release;
            ss::basis_functions(knot_vector(knots, degree, periodic), numbers(parameters),
                                values.data(), first.data());
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "parameters"_a.noconvert(),
        "values"_a.noconvert(), "first"_a.noconvert());

    m.def(
        "evaluate",
        [](In1 knots, int degree, bool periodic, In2 coefficients, In1 parameters, OutPoints out) {
            nb::gil_scoped_release release;
            ss::evaluate(knot_vector(knots, degree, periodic), vectors(coefficients),
                         numbers(parameters), vectors(out).data());
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "coefficients"_a.noconvert(),
        "parameters"_a.noconvert(), "out"_a.noconvert());

    m.def(
        "bezier_pieces",
        [](In1 knots, int degree, In2 coefficients, OutPoints points, Out1 breakpoints) {
            nb::gil_scoped_release release;
            ss::dispatch_degree(degree, [&]<int Degree>() {
                std::size_t k = 0;
                for (const auto &piece : ss::bezier_pieces<Degree>(
                         knot_vector(knots, degree, false), vectors(coefficients))) {
                    std::copy_n(piece.points.begin(), Degree + 1,
                                vectors(points).begin() + k * (Degree + 1));
                    breakpoints.data()[k] = piece.begin;
                    breakpoints.data()[++k] = piece.end;
                }
            });
        },
        "knots"_a.noconvert(), "degree"_a, "coefficients"_a.noconvert(), "points"_a.noconvert(),
        "breakpoints"_a.noconvert());

    m.def(
        "steps_wanted",
        [](In2 beziers, int degree, double distance, double longest, Out1 wanted) {
            nb::gil_scoped_release release;
            ss::dispatch_degree(degree, [&]<int Degree>() {
                for (std::size_t s = 0; s < wanted.shape(0); ++s)
                    wanted.data()[s] = ss::steps_wanted<Degree>(
                        vectors(beziers).subspan(s * (Degree + 1), Degree + 1), distance, longest);
            });
        },
        "beziers"_a.noconvert(), "degree"_a, "distance"_a, "longest"_a, "wanted"_a.noconvert());

    m.def(
        "chord_points",
        [](In2 beziers, int degree, In1 breakpoints, InIndices counts, OutPoints points,
           Out1 parameters) {
            nb::gil_scoped_release release;
            ss::dispatch_degree(degree, [&]<int Degree>() {
                ss::chord_points<Degree>(vectors(beziers), breakpoints.data(), indices(counts),
                                         vectors(points).data(), parameters.data());
            });
        },
        "beziers"_a.noconvert(), "degree"_a, "breakpoints"_a.noconvert(), "counts"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert());

    m.def(
        "nearest_on_curve",
        [](In1 knots, int degree, In2 coefficients, In2 queries, Out1 parameters,
           Out1 distances_sq) {
            nb::gil_scoped_release release;
            ss::nearest_on_curve(knot_vector(knots, degree, false), vectors(coefficients),
                                 vectors(queries), parameters.data(), distances_sq.data());
        },
        "knots"_a.noconvert(), "degree"_a, "coefficients"_a.noconvert(), "queries"_a.noconvert(),
        "parameters"_a.noconvert(), "distances_sq"_a.noconvert());

    m.def(
        "curve_deviation",
        [](In1 knots, int degree, In2 coefficients, In2 vertices, double relative_gap,
           double floor) {
            nb::gil_scoped_release release;
            const auto d = ss::curve_deviation(knot_vector(knots, degree, false),
                                               vectors(coefficients), vectors(vertices),
                                               relative_gap, floor);
            return std::make_tuple(d.lower, d.upper, d.parameter);
        },
        "knots"_a.noconvert(), "degree"_a, "coefficients"_a.noconvert(), "vertices"_a.noconvert(),
        "relative_gap"_a, "floor"_a);

    m.def(
        "accumulate_chord_distances",
        [](In2 points, std::int64_t length, bool closed, Out1 signed_sums, Out1 unsigned_sums) {
            nb::gil_scoped_release release;
            ss::accumulate_chord_distances(vectors(points), length, closed, signed_sums.data(),
                                           unsigned_sums.data());
        },
        "points"_a.noconvert(), "length"_a, "closed"_a, "signed_sums"_a.noconvert(),
        "unsigned_sums"_a.noconvert());

    m.def(
        "cost",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, double stray_weight) {
            nb::gil_scoped_release release;
            return ss::cost(knot_vector(knots, degree, periodic), vectors(control_points),
                            samples(points, parameters, weights, 0, false, stray_weight));
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "stray_weight"_a);

    m.def(
        "cost_and_gradient",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, int held, bool control_ends_fixed, double stray_weight,
           OutPoints control_gradient,
           Out1 parameter_gradient) {
            nb::gil_scoped_release release;
            return ss::cost_and_gradient(
                knot_vector(knots, degree, periodic), vectors(control_points),
                samples(points, parameters, weights, held, control_ends_fixed, stray_weight),
                vectors(control_gradient), parameter_gradient.data());
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "held"_a, "control_ends_fixed"_a, "stray_weight"_a, "control_gradient"_a.noconvert(),
        "parameter_gradient"_a.noconvert());

    m.def(
        "gauss_newton_diagonal",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, Out1 control_diagonal, Out1 parameter_diagonal) {
            nb::gil_scoped_release release;
            ss::gauss_newton_diagonal(
                knot_vector(knots, degree, periodic), vectors(control_points),
                samples(points, parameters, weights),
                {control_diagonal.data(), control_diagonal.shape(0)}, parameter_diagonal.data());
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "control_diagonal"_a.noconvert(), "parameter_diagonal"_a.noconvert());

    m.def(
        "damped_step",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, int held, bool control_ends_fixed, double stray_weight,
           double damping, OutPoints control_step,
           Out1 parameter_step, std::optional<In1> along) {
            nb::gil_scoped_release release;
            auto data =
                samples(points, parameters, weights, held, control_ends_fixed, stray_weight);
            if (along) data.along = along->data();
            const auto r = ss::damped_step(knot_vector(knots, degree, periodic),
                                           vectors(control_points), data, damping,
                                           vectors(control_step), parameter_step.data());
            return std::make_tuple(r.solved, r.cost, r.predicted_cost, r.gradient_norm);
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "held"_a, "control_ends_fixed"_a, "stray_weight"_a, "damping"_a,
        "control_step"_a.noconvert(), "parameter_step"_a.noconvert(),
        "along"_a.none().noconvert() = nb::none());

    m.def(
        "eliminated_equations",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, double stray_weight, Out1 equations) {
            nb::gil_scoped_release release;
            ss::eliminated_equations(
                knot_vector(knots, degree, periodic), vectors(control_points),
                samples(points, parameters, weights, 0, false, stray_weight), numbers(equations));
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "stray_weight"_a, "equations"_a.noconvert());

    m.def("eliminated_size", &ss::eliminated_size, "n_points"_a, "degree"_a, "periodic"_a);

    m.def(
        "eliminated_step",
        [](int degree, bool periodic, In1 sums, double damping, OutPoints control_step) {
            const auto r = ss::eliminated_step(control_step.shape(0), degree, periodic,
                                               numbers(sums), damping, vectors(control_step));
            return std::make_tuple(r.solved, r.cost - r.predicted_cost, r.gradient_norm);
        },
        "degree"_a, "periodic"_a, "sums"_a.noconvert(), "damping"_a,
        "control_step"_a.noconvert());

    m.def(
        "near_feet",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, int steps,
           Out1 parameters) {
            nb::gil_scoped_release release;
            ss::near_feet(knot_vector(knots, degree, periodic), vectors(control_points),
                          vectors(points), steps, numbers(parameters));
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "steps"_a, "parameters"_a.noconvert());

    m.def(
        "mean_distances",
        [](In2 points, Out1 distances_sq) {
            nb::gil_scoped_release release;
            ss::mean_distances(vectors(points), distances_sq.data());
        },
        "points"_a.noconvert(), "distances_sq"_a.noconvert());

    m.def(
        "thinned",
        [](In2 points, double distance, double longest, std::optional<InIndices> marked) {
            std::vector<std::int64_t> kept;
            {
                nb::gil_scoped_release release;
                kept = ss::thinned(vectors(points), distance, longest,
                                   marked ? indices(*marked) : std::span<const std::int64_t>{});
            }
            return kept;
        },
        "points"_a.noconvert(), "distance"_a, "longest"_a, "marked"_a.none().noconvert());

    // The structured fit.
    m.def(
        "corner_turns",
        [](In2 points, In1 stations, InIndices vertices, double length, Out1 turns) {
            nb::gil_scoped_release release;
            ss::corner_turns({vectors(points), numbers(stations)}, indices(vertices), length,
                             turns.data());
        },
        "points"_a.noconvert(), "stations"_a.noconvert(), "vertices"_a.noconvert(), "length"_a,
        "turns"_a.noconvert());

    m.def(
        "fit_sections",
        [](In2 points, bool closed, InIndices joint, InIndices forced, InIndices gentle,
           std::int64_t stride, double resolution, std::int64_t every, double tolerance,
           int largest_degree, bool smooth, bool ends_fixed, double least_corner, int passes,
           bool thorough,
           nb::object ask,
           std::optional<In2> observed, double noise) {
            ss::Interruption asking = interruption(ask);
            nb::gil_scoped_release release;
            const ss::LaidOutOutline outline(
                vectors(points), closed, {indices(joint), indices(forced), indices(gentle)},
                stride, resolution);
            std::vector<std::int64_t> degrees, counts;
            std::vector<double> knots, coordinates;
            auto sections = outline.search(tolerance, every, largest_degree, smooth, ends_fixed,
                                           least_corner, passes, thorough, asking);
            if (observed)
                sections = ss::fit_observed(vectors(*observed), closed, std::move(sections), noise);
            for (const ss::Section &s : sections) {
                degrees.push_back(s.degree);
                counts.push_back(static_cast<std::int64_t>(s.points.size()));
                knots.insert(knots.end(), s.knots.begin(), s.knots.end());
                for (const ss::Vec2 p : s.points) coordinates.insert(coordinates.end(), {p.x, p.y});
            }
            return std::make_tuple(degrees, counts, knots, coordinates);
        },
        "points"_a.noconvert(), "closed"_a, "joint"_a.noconvert(),
        "forced"_a.noconvert(), "gentle"_a.noconvert(), "stride"_a, "resolution"_a, "every"_a,
        "tolerance"_a,
        "largest_degree"_a,
        "smooth"_a, "ends_fixed"_a, "least_corner"_a, "passes"_a, "thorough"_a, "ask"_a,
        "observed"_a.none().noconvert() = nb::none(), "noise"_a = 0.0);
    // Knot removal: a search is a few calls, each a whole stage; see removal.hpp.
    nb::class_<ss::removal::RemovalSearch>(m, "RemovalSearch")
        .def(
            "__init__",
            [](ss::removal::RemovalSearch *self, In2 data, bool closed, int degree,
               double tolerance,
               bool keep_rule, int start, double gap_ratio, double speed_ratio,
               double least_gap, double largest_gap, double enough, double accept,
               int samples_per_span,
               double sample_weight, double hope, double worth_trying,
               double worth_insisting, nb::object ask) {
                ss::Interruption asking = interruption(ask);
                nb::gil_scoped_release release;
                const ss::removal::FitLimits fit{tolerance,     enough,    samples_per_span,
                                        sample_weight, least_gap, largest_gap,
                                        hope};
                new (self) ss::removal::RemovalSearch(
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
                return self.remove_stubborn(effort, spreads, asking);
            },
            "effort"_a, "spreads"_a, "ask"_a)
        .def("curve", &ss::removal::RemovalSearch::curve)
        .def("n_points", &ss::removal::RemovalSearch::n_points)
        .def("from_polyline", &ss::removal::RemovalSearch::from_polyline)
        .def("counts", &ss::removal::RemovalSearch::counts);
    m.def(
        "count_crossings",
        [](In2 vertices) {
            nb::gil_scoped_release release;
            return ss::removal::count_crossings(std::span<const ss::Vec2>(vectors(vertices)));
        },
        "vertices"_a.noconvert());
}
