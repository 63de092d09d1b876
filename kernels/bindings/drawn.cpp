// Lines, arcs and free-form runs of an outline.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "shapespline/drawn/conditioning.hpp"
#include "shapespline/drawn/elements.hpp"
#include "shapespline/drawn/elimination.hpp"
#include "shapespline/drawn/segmentation.hpp"

using namespace nb::literals;
namespace drawn = ss::drawn;
using Rows = Array<const double, nb::ndim<2>>;

void bind_drawn(nb::module_ &m) {
    nb::class_<drawn::JointPrices>(m, "JointPrices")
        .def(nb::init<double, double, double, double, double, double, double, double>(),
             nb::kw_only(), "line_line_smooth"_a, "line_arc_smooth"_a, "arc_arc_smooth"_a,
             "arc_arc_corner"_a, "line_free_smooth"_a, "arc_free_smooth"_a, "free_corner"_a,
             "arc_free_corner"_a);
    nb::class_<drawn::SegmentationSettings>(m, "SegmentationSettings")
        .def(nb::init<double, double, double, double, double, double, std::int64_t,
                      drawn::JointPrices>(),
             nb::kw_only(), "deviation"_a, "skip"_a, "shortest"_a, "price"_a, "free_parameters"_a,
             "smooth_turn"_a,
             "stride"_a, "joints"_a);
    m.def(
        "drawn_pieces",
        [](In2 points, In1 stations, In1 weights, InIndices candidates, InIndices nodes,
           const drawn::SegmentationSettings &settings) {
            nb::gil_scoped_release release;
            drawn::Segmentation search(vectors(points), numbers(stations), numbers(weights),
                                       indices(candidates), indices(nodes), settings);
            std::vector<std::tuple<std::int64_t, std::int64_t, int>> pieces;
            for (const drawn::DrawnPiece &piece : search.run())
                pieces.emplace_back(piece.begin, piece.end, piece.kind);
            return std::pair{pieces, search.cost()};
        },
        "points"_a.noconvert(), "stations"_a.noconvert(), "weights"_a.noconvert(),
        "candidates"_a.noconvert(), "nodes"_a.noconvert(), "settings"_a);
    m.def(
        "line_through",
        [](In2 points, In1 weights) {
            return drawn::line_through(vectors(points), numbers(weights));
        },
        "points"_a.noconvert(), "weights"_a.noconvert());
    m.def(
        "circle_through",
        [](In2 points, In1 weights) {
            const auto [centre, radius] = drawn::circle_through(vectors(points), numbers(weights));
            return std::tuple{centre.x, centre.y, radius};
        },
        "points"_a.noconvert(), "weights"_a.noconvert());
    nb::class_<drawn::Elements>(m, "Elements")
        .def(
            "__init__",
            [](drawn::Elements *made, const std::vector<bool> &is_line,
               std::vector<std::int64_t> at, std::vector<std::int64_t> begins, In2 points,
               In1 weights, double deviation) {
                const auto data = vectors(points);
                const auto weighed = numbers(weights);
                new (made) drawn::Elements({is_line.begin(), is_line.end()}, std::move(at),
                                           std::move(begins), {data.begin(), data.end()},
                                           {weighed.begin(), weighed.end()}, deviation);
            },
            "is_line"_a, "at"_a, "begins"_a, "points"_a.noconvert(), "weights"_a.noconvert(),
            "deviation"_a)
        .def(
            "normal",
            [](const drawn::Elements &self, In1 x, Out2 matrix, Out1 gradient) {
                std::vector<std::tuple<double, double, double>> misfits;
                for (const drawn::Misfit &one : self.normal(
                         numbers(x), {matrix.data(), matrix.size()}, numbers(gradient)))
                    misfits.emplace_back(one.chi_sq, one.weight, one.largest);
                return misfits;
            },
            "x"_a.noconvert(), "matrix"_a.noconvert(), "gradient"_a.noconvert())
        .def(
            "covariance",
            [](const drawn::Elements &self, In1 x, Rows floors, Out2 covariance, Out2 precision) {
                self.covariance(numbers(x), {floors.data(), floors.size()},
                                {covariance.data(), covariance.size()},
                                {precision.data(), precision.size()});
            },
            "x"_a.noconvert(), "floors"_a.noconvert(), "covariance"_a.noconvert(),
            "precision"_a.noconvert());
    nb::class_<drawn::EquationLimits>(m, "EquationLimits")
        .def(nb::init<double, double, double, double, double, double>(), nb::kw_only(),
             "largest"_a, "largest_each"_a, "span"_a, "least_surprise"_a, "implied"_a, "met"_a);
    m.def(
        "take_equation",
        [](Out1 x, Out2 covariance, const std::vector<std::int64_t> &index, In1 values, Rows rows,
           const drawn::EquationLimits &limits) {
            return drawn::take_equation(numbers(x), {covariance.data(), covariance.size()}, index,
                                        numbers(values), {rows.data(), rows.size()}, limits);
        },
        "x"_a.noconvert(), "covariance"_a.noconvert(), "index"_a, "values"_a.noconvert(),
        "rows"_a.noconvert(), "limits"_a);
    nb::class_<drawn::MeetingSteps>(m, "MeetingSteps")
        .def(
            "__init__",
            [](drawn::MeetingSteps *made, In1 values, Rows rows, In1 units, double implied) {
                new (made) drawn::MeetingSteps(numbers(values), {rows.data(), rows.size()},
                                               numbers(units), implied);
            },
            "values"_a.noconvert(), "rows"_a.noconvert(), "units"_a.noconvert(), "implied"_a)
        .def("n_free", &drawn::MeetingSteps::n_free)
        .def(
            "best",
            [](const drawn::MeetingSteps &self, Rows matrix, In1 gradient, Out1 step) {
                self.best({matrix.data(), matrix.size()}, numbers(gradient), numbers(step));
            },
            "matrix"_a.noconvert(), "gradient"_a.noconvert(), "step"_a.noconvert())
        .def(
            "covariance",
            [](const drawn::MeetingSteps &self, Rows precision, Out2 covariance) {
                self.covariance({precision.data(), precision.size()},
                                {covariance.data(), covariance.size()});
            },
            "precision"_a.noconvert(), "covariance"_a.noconvert());
}
