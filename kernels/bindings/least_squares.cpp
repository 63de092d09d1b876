// Least squares in control points and location parameters.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>

#include "arrays.hpp"
#include "shapespline/least_squares/normal_equations.hpp"
#include "shapespline/least_squares/residuals.hpp"

using namespace nb::literals;
namespace ls = ss::least_squares;

namespace {

ls::Samples samples(const In2 &points, const In1 &parameters,
                           const std::optional<In1> &weights, int held = 0,
                           bool control_ends_fixed = false, double stray_weight = 0.0) {
    return {vectors(points), numbers(parameters), weights ? weights->data() : nullptr,
            static_cast<ls::Held>(held), control_ends_fixed, stray_weight};
}

}  // namespace

void bind_least_squares(nb::module_ &m) {
    m.def(
        "cost",
        [](In1 knots, int degree, bool periodic, In2 control_points, In2 points, In1 parameters,
           std::optional<In1> weights, double stray_weight) {
            nb::gil_scoped_release release;
            return ls::cost(knot_vector(knots, degree, periodic), vectors(control_points),
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
            return ls::cost_and_gradient(
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
            ls::gauss_newton_diagonal(
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
            const auto r = ls::damped_step(knot_vector(knots, degree, periodic),
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
            ls::eliminated_equations(
                knot_vector(knots, degree, periodic), vectors(control_points),
                samples(points, parameters, weights, 0, false, stray_weight), numbers(equations));
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "control_points"_a.noconvert(),
        "points"_a.noconvert(), "parameters"_a.noconvert(), "weights"_a.none().noconvert(),
        "stray_weight"_a, "equations"_a.noconvert());

    m.def("eliminated_size", &ls::eliminated_size, "n_points"_a, "degree"_a, "periodic"_a);

    m.def(
        "eliminated_step",
        [](int degree, bool periodic, In1 sums, double damping, OutPoints control_step) {
            const auto r = ls::eliminated_step(control_step.shape(0), degree, periodic,
                                               numbers(sums), damping, vectors(control_step));
            return std::make_tuple(r.solved, r.cost - r.predicted_cost, r.gradient_norm);
        },
        "degree"_a, "periodic"_a, "sums"_a.noconvert(), "damping"_a,
        "control_step"_a.noconvert());
}
