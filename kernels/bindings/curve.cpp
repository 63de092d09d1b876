// Curves: basis functions, points, Bezier pieces, chords.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "shapespline/curve/arc_length.hpp"
#include "shapespline/curve/bezier.hpp"
#include "shapespline/curve/bspline.hpp"
#include "shapespline/curve/common_tangents.hpp"
#include "shapespline/curve/corner_parameters.hpp"
#include "shapespline/curve/flatten.hpp"
#include "shapespline/curve/joining.hpp"
#include "shapespline/curve/line_to_corners.hpp"

using namespace nb::literals;

namespace {

void bind_splines(nb::module_ &m) {
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
}

void bind_beziers(nb::module_ &m) {
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
        "corner_parameters",
        [](In1 knots, int degree, In2 coefficients, bool closed, double least) {
            nb::gil_scoped_release release;
            return ss::corner_parameters(knot_vector(knots, degree, false), vectors(coefficients),
                                         closed, least);
        },
        "knots"_a.noconvert(), "degree"_a, "coefficients"_a.noconvert(), "closed"_a, "least"_a);
}

void bind_chords(nb::module_ &m) {
    m.def(
        "arc_length",
        [](In2 vertices, Out1 along) {
            nb::gil_scoped_release release;
            ss::arc_length(vectors(vertices), along.data());
        },
        "vertices"_a.noconvert(), "along"_a.noconvert());

    nb::class_<ss::Flattening> flattening(m, "Flattening");
    flattening.attr("SAMPLING") = ss::Flattening::kSampling;
    flattening.attr("COARSEST") = ss::Flattening::kCoarsest;
    flattening
        .def(
            "__init__",
            [](ss::Flattening *self, In1 knots, int degree, In2 coefficients,
               std::optional<double> sampling, double longest) {
                nb::gil_scoped_release release;
                new (self) ss::Flattening(knot_vector(knots, degree, false),
                                          vectors(coefficients), sampling, longest);
            },
            "knots"_a.noconvert(), "degree"_a, "coefficients"_a.noconvert(),
            "sampling"_a.none(), "longest"_a)
        .def_prop_ro("diagonal", &ss::Flattening::diagonal)
        .def_prop_ro("wanted", &ss::Flattening::wanted)
        .def_prop_ro("n_points", &ss::Flattening::n_points)
        .def(
            "write",
            [](const ss::Flattening &self, OutPoints points, Out1 parameters) {
                nb::gil_scoped_release release;
                self.write(vectors(points).data(), parameters.data());
            },
            "points"_a.noconvert(), "parameters"_a.noconvert());

    m.attr("MOST_BESIDE_CORNER") = ss::LineToCorners::kMostBeside;
    m.def(
        "line_to_corners",
        [](In1 knots, int degree, bool periodic, In2 coefficients, In2 vertices, In1 parameters,
           In1 corners, OutPoints line) {
            nb::gil_scoped_release release;
            return ss::LineToCorners(vectors(vertices), numbers(parameters), numbers(corners))
                .write(knot_vector(knots, degree, periodic), vectors(coefficients),
                       vectors(line).data());
        },
        "knots"_a.noconvert(), "degree"_a, "periodic"_a, "coefficients"_a.noconvert(),
        "vertices"_a.noconvert(), "parameters"_a.noconvert(), "corners"_a.noconvert(),
        "line"_a.noconvert());
}

void bind_pieces_end_to_end(nb::module_ &m) {
    using Numbers = std::vector<int>;
    m.def(
        "elevated",
        [](In2 points, int degree, OutPoints out) {
            std::ranges::copy(ss::elevated(vectors(points), degree), vectors(out).begin());
        },
        "points"_a.noconvert(), "degree"_a, "out"_a.noconvert());

    m.def(
        "polygon_lengths",
        [](const Numbers &counts, In2 points) {
            return ss::polygon_lengths(counts, vectors(points));
        },
        "counts"_a, "points"_a.noconvert());

    nb::class_<ss::JoinedPieces>(m, "JoinedPieces")
        .def(
            "__init__",
            [](ss::JoinedPieces *self, const Numbers &degrees, const Numbers &counts, In1 knots,
               In2 points, int degree, double same) {
                new (self) ss::JoinedPieces(
                    ss::piece_row(degrees, counts, numbers(knots), vectors(points)), degree, same);
            },
            "degrees"_a, "counts"_a, "knots"_a.noconvert(), "points"_a.noconvert(), "degree"_a,
            "same"_a)
        .def_prop_ro("n_points", &ss::JoinedPieces::n_points)
        .def(
            "write",
            [](const ss::JoinedPieces &self, Out1 knots, OutPoints points) {
                self.write(knots.data(), vectors(points).data());
            },
            "knots"_a.noconvert(), "points"_a.noconvert());

    m.def(
        "make_tangents_common",
        [](const Numbers &degrees, const Numbers &counts, OutPoints points, double largest_move,
           double nearly, bool closed) {
            ss::make_tangents_common(ss::piece_row(degrees, counts, {}, vectors(points)),
                                     largest_move, nearly, closed);
        },
        "degrees"_a, "counts"_a, "points"_a.noconvert(), "largest_move"_a, "nearly"_a, "closed"_a);
}

}  // namespace

void bind_curve(nb::module_ &m) {
    bind_splines(m);
    bind_beziers(m);
    bind_chords(m);
    bind_pieces_end_to_end(m);
}
