// Lines, arcs and free-form runs of an outline.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "shapespline/drawn/conditioning.hpp"
#include "shapespline/drawn/elements.hpp"
#include "shapespline/drawn/equations.hpp"
#include "shapespline/drawn/estimate.hpp"
#include "shapespline/drawn/segmentation.hpp"

using namespace nb::literals;
namespace drawn = ss::drawn;
using Rows = Array<const double, nb::ndim<2>>;

using Places = std::vector<std::int64_t>;

// What elements may be asked to meet.
void bind_equations(nb::module_ &m) {
    nb::class_<drawn::Difference>(m, "Difference")
        .def(nb::init<Places, Places, double, double>(), "a"_a, "b"_a, "turn"_a = 0.0,
             "sign"_a = 1.0);
    nb::class_<drawn::LineTouches>(m, "LineTouches")
        .def(nb::init<std::int64_t, std::int64_t, double>(), "a"_a, "b"_a, "way"_a);
    nb::class_<drawn::CirclesTouch>(m, "CirclesTouch")
        .def(nb::init<std::int64_t, std::int64_t, bool>(), "a"_a, "b"_a, "alike"_a);
    nb::class_<drawn::PassesThrough>(m, "PassesThrough")
        .def(
            "__init__",
            [](drawn::PassesThrough *made, std::int64_t a, bool is_line, double x, double y) {
                new (made) drawn::PassesThrough{a, is_line, {x, y}};
            },
            "a"_a, "is_line"_a, "x"_a, "y"_a);
    nb::class_<drawn::Images>(m, "Images")
        .def(nb::init<Places, Places, std::int64_t, bool, std::optional<double>>(), "a"_a, "b"_a,
             "at"_a, "is_line"_a, "angle"_a = nb::none());
    nb::class_<drawn::End>(m, "End").def(nb::init<std::int64_t, bool, double>(), "at"_a,
                                         "is_line"_a, "side"_a = 0.0);
    nb::class_<drawn::Edge>(m, "Edge")
        .def(nb::init<std::int64_t, drawn::End, drawn::End, double>(), "at"_a, "begin"_a, "end"_a,
             "touches"_a)
        .def(
            "length",
            [](const drawn::Edge &self, In1 x) { return self.length(numbers(x)); },
            "x"_a.noconvert());
    nb::class_<drawn::EqualLengths>(m, "EqualLengths")
        .def(nb::init<drawn::Edge, drawn::Edge>(), "a"_a, "b"_a);
    m.def(
        "equation_values",
        [](const std::vector<drawn::Equation> &equations, In1 x) {
            return drawn::linearised(equations, numbers(x)).values();
        },
        "equations"_a, "x"_a.noconvert());
}

void bind_drawn(nb::module_ &m) {
    bind_equations(m);
    nb::class_<drawn::JointPrices>(m, "JointPrices")
        .def(nb::init<double, double, double, double, double, double, double, double>(),
             nb::kw_only(), "line_line_smooth"_a, "line_arc_smooth"_a, "arc_arc_smooth"_a,
             "arc_arc_corner"_a, "line_free_smooth"_a, "arc_free_smooth"_a, "free_corner"_a,
             "arc_free_corner"_a);
    nb::class_<drawn::NodeLengths>(m, "NodeLengths")
        .def(nb::init<double, double, double>(), nb::kw_only(), "skip"_a, "shortest"_a, "gap"_a);
    nb::class_<drawn::SegmentationSettings>(m, "SegmentationSettings")
        .def(nb::init<double, drawn::NodeLengths, double, double, double, std::int64_t,
                      drawn::JointPrices>(),
             nb::kw_only(), "deviation"_a, "lengths"_a, "price"_a, "free_parameters"_a,
             "smooth_turn"_a, "stride"_a, "joints"_a);
    m.def(
        "drawn_pieces",
        [](In2 points, In1 stations, In1 weights, InIndices candidates, InIndices nodes,
           In2 directions, const drawn::SegmentationSettings &settings) {
            nb::gil_scoped_release release;
            drawn::Segmentation search(vectors(points), numbers(stations), numbers(weights),
                                       indices(candidates), indices(nodes), vectors(directions),
                                       settings);
            std::vector<std::tuple<std::int64_t, std::int64_t, int>> pieces;
            for (const drawn::DrawnPiece &piece : search.run())
                pieces.emplace_back(piece.begin, piece.end, piece.kind);
            return std::pair{pieces, search.cost()};
        },
        "points"_a.noconvert(), "stations"_a.noconvert(), "weights"_a.noconvert(),
        "candidates"_a.noconvert(), "nodes"_a.noconvert(), "directions"_a.noconvert(),
        "settings"_a);
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
               In1 weights, In1 counts, double deviation) {
                const auto data = vectors(points);
                const auto weighed = numbers(weights), counted = numbers(counts);
                new (made) drawn::Elements({is_line.begin(), is_line.end()}, std::move(at),
                                           std::move(begins), {data.begin(), data.end()},
                                           {weighed.begin(), weighed.end()},
                                           {counted.begin(), counted.end()}, deviation);
            },
            "is_line"_a, "at"_a, "begins"_a, "points"_a.noconvert(), "weights"_a.noconvert(),
            "counts"_a.noconvert(), "deviation"_a)
        .def(
            "misfits",
            [](const drawn::Elements &self, In1 x) {
                std::vector<std::tuple<double, double, double>> misfits;
                for (const drawn::Misfit &one : self.misfits(numbers(x)))
                    misfits.emplace_back(one.chi_sq, one.count, one.largest);
                return misfits;
            },
            "x"_a.noconvert())
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
        [](Out1 x, Out2 covariance, const drawn::Equation &equation,
           const drawn::EquationLimits &limits) {
            return drawn::take_equation(numbers(x), {covariance.data(), covariance.size()},
                                        equation, limits);
        },
        "x"_a.noconvert(), "covariance"_a.noconvert(), "equation"_a, "limits"_a);
    nb::class_<drawn::EstimateLimits>(m, "EstimateLimits")
        .def(nb::init<int, double, double, double, double>(), nb::kw_only(), "rounds"_a,
             "extent"_a, "least_step"_a, "longest_step"_a, "implied"_a);
    m.def(
        "estimate",
        [](const drawn::Elements &elements, const std::vector<drawn::Equation> &equations, Out1 x,
           const drawn::EstimateLimits &limits) {
            drawn::estimate(elements, equations, numbers(x), limits);
        },
        "elements"_a, "equations"_a, "x"_a.noconvert(), "limits"_a);
    nb::class_<drawn::MeetingSteps>(m, "MeetingSteps")
        .def(
            "__init__",
            [](drawn::MeetingSteps *made, const drawn::Elements &elements,
               const std::vector<drawn::Equation> &equations, In1 x, double extent,
               double implied) {
                new (made) drawn::MeetingSteps(
                    drawn::meeting_steps(elements, equations, numbers(x), extent, implied));
            },
            "elements"_a, "equations"_a, "x"_a.noconvert(), "extent"_a, "implied"_a)
        .def("n_free", &drawn::MeetingSteps::n_free)
        .def(
            "covariance",
            [](const drawn::MeetingSteps &self, Rows precision, Out2 covariance) {
                self.covariance({precision.data(), precision.size()},
                                {covariance.data(), covariance.size()});
            },
            "precision"_a.noconvert(), "covariance"_a.noconvert());
}
