// Least squares in control points and location parameters.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "shapespline/least_squares/levenberg_marquardt.hpp"

using namespace nb::literals;
namespace ls = ss::least_squares;

namespace {

// What stays while control points and parameters move; it keeps the arrays that it is made of.
struct LeastSquares {
    In1 knot_array;
    int degree;
    bool periodic;
    In2 points;
    std::optional<In1> weights;
    ls::Held held;
    bool control_ends_fixed;
    double stray_weight;

    ss::Knots knots() const { return knot_vector(knot_array, degree, periodic); }
    ls::Samples samples(std::span<const double> parameters) const {
        return {vectors(points), parameters, weights ? weights->data() : nullptr,
                held, control_ends_fixed, stray_weight};
    }
};

using RecordTuple = std::tuple<double, double, int, double, double>;

std::tuple<int, std::vector<RecordTuple>> descend(const LeastSquares &self,
                                                  OutPoints control_points, Out1 parameters,
                                                  const ls::DescentLimits &limits,
                                                  const nb::object &ask) {
    ss::Interruption asking = interruption(ask);
    nb::gil_scoped_release release;
    ls::LevenbergMarquardt descent(self.knots(), self.samples({}), limits,
                                   vectors(control_points), numbers(parameters));
    const ls::Stop stop = descent.run(asking);
    std::vector<RecordTuple> history;
    for (const auto &[cost, gradient_norm, evaluations, step, seconds] : descent.history())
        history.emplace_back(cost, gradient_norm, evaluations, step, seconds);
    return {static_cast<int>(stop), history};
}

void bind_limits(nb::module_ &m) {
    nb::class_<ls::DescentLimits>(m, "DescentLimits")
        .def(nb::init<int, int, double, double, double, double, int>(), nb::kw_only(),
             "max_iterations"_a, "max_evaluations"_a, "relative_decrease"_a,
             "gradient_tolerance"_a, "target_cost"_a, "start_damping"_a, "patience"_a);
}

nb::class_<LeastSquares> bind_problem(nb::module_ &m) {
    return nb::class_<LeastSquares>(m, "LeastSquares")
        .def(
            "__init__",
            [](LeastSquares *self, In1 knots, int degree, bool periodic, In2 points,
               std::optional<In1> weights, int held, bool control_ends_fixed,
               double stray_weight) {
                new (self) LeastSquares{knots, degree, periodic, points, weights,
                                        static_cast<ls::Held>(held), control_ends_fixed,
                                        stray_weight};
            },
            "knots"_a.noconvert(), "degree"_a, "periodic"_a, "points"_a.noconvert(),
            "weights"_a.none().noconvert(), "held"_a = 0, "control_ends_fixed"_a = false,
            "stray_weight"_a = 0.0)
        .def(
            "cost",
            [](const LeastSquares &self, In2 control_points, In1 parameters) {
                nb::gil_scoped_release release;
                return ls::cost(self.knots(), vectors(control_points),
                                self.samples(numbers(parameters)));
            },
            "control_points"_a.noconvert(), "parameters"_a.noconvert())
        .def(
            "cost_and_gradient",
            [](const LeastSquares &self, In2 control_points, In1 parameters,
               OutPoints control_gradient, Out1 parameter_gradient) {
                nb::gil_scoped_release release;
                return ls::cost_and_gradient(self.knots(), vectors(control_points),
                                             self.samples(numbers(parameters)),
                                             vectors(control_gradient), parameter_gradient.data());
            },
            "control_points"_a.noconvert(), "parameters"_a.noconvert(),
            "control_gradient"_a.noconvert(), "parameter_gradient"_a.noconvert())
        .def(
            "gauss_newton_diagonal",
            [](const LeastSquares &self, In2 control_points, In1 parameters,
               Out1 control_diagonal, Out1 parameter_diagonal) {
                nb::gil_scoped_release release;
                ls::gauss_newton_diagonal(self.knots(), vectors(control_points),
                                          self.samples(numbers(parameters)),
                                          numbers(control_diagonal), parameter_diagonal.data());
            },
            "control_points"_a.noconvert(), "parameters"_a.noconvert(),
            "control_diagonal"_a.noconvert(), "parameter_diagonal"_a.noconvert());
}

void bind_steps(nb::class_<LeastSquares> problem) {
    problem
        .def(
            "damped_step",
            [](const LeastSquares &self, In2 control_points, In1 parameters, double damping,
               OutPoints control_step, Out1 parameter_step, std::optional<In1> along) {
                nb::gil_scoped_release release;
                ls::Samples samples = self.samples(numbers(parameters));
                if (along) samples.along = along->data();
                const auto r = ls::damped_step(self.knots(), vectors(control_points), samples,
                                               damping, vectors(control_step),
                                               parameter_step.data());
                return std::make_tuple(r.solved, r.cost, r.predicted_cost, r.gradient_norm);
            },
            "control_points"_a.noconvert(), "parameters"_a.noconvert(), "damping"_a,
            "control_step"_a.noconvert(), "parameter_step"_a.noconvert(),
            "along"_a.none().noconvert() = nb::none())
        .def("descend", &descend, "control_points"_a.noconvert(), "parameters"_a.noconvert(),
             "limits"_a, "ask"_a)
        .def(
            "eliminated_equations",
            [](const LeastSquares &self, In2 control_points, In1 parameters, Out1 equations) {
                nb::gil_scoped_release release;
                ls::eliminated_equations(self.knots(), vectors(control_points),
                                         self.samples(numbers(parameters)), numbers(equations));
            },
            "control_points"_a.noconvert(), "parameters"_a.noconvert(),
            "equations"_a.noconvert());
}

}  // namespace

void bind_least_squares(nb::module_ &m) {
    bind_limits(m);
    bind_steps(bind_problem(m));

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
