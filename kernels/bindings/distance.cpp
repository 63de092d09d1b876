// Distances between curves, points and polylines.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "arrays.hpp"
#include "shapespline/distance/crossing_pairs.hpp"
#include "shapespline/distance/hooks.hpp"
#include "shapespline/distance/crossings.hpp"
#include "shapespline/distance/deviation.hpp"
#include "shapespline/distance/near_feet.hpp"
#include "shapespline/distance/nearest.hpp"
#include "shapespline/distance/nearest_points.hpp"
#include "shapespline/distance/sides.hpp"
#include "shapespline/distance/thinning.hpp"

using namespace nb::literals;

void bind_distance(nb::module_ &m) {
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
        "nearest_points",
        [](In2 points, In2 queries, OutIndices nearest, Out1 distances) {
            nb::gil_scoped_release release;
            ss::nearest_points(vectors(points), vectors(queries), nearest.data(),
                               distances.data());
        },
        "points"_a.noconvert(), "queries"_a.noconvert(), "nearest"_a.noconvert(),
        "distances"_a.noconvert());

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

    m.def(
        "count_crossings",
        [](In2 vertices) {
            nb::gil_scoped_release release;
            return ss::count_crossings(std::span<const ss::Vec2>(vectors(vertices)));
        },
        "vertices"_a.noconvert());

    m.def(
        "hook_places",
        [](In2 vertices, In2 polyline, double tolerance, bool closed) {
            std::vector<std::pair<double, double>> places;
            nb::gil_scoped_release release;
            const auto found = ss::hook_places(vectors(vertices), vectors(polyline), tolerance,
                                                 closed);
            for (const ss::Vec2 p : found) places.emplace_back(p.x, p.y);
            return places;
        },
        "vertices"_a.noconvert(), "polyline"_a.noconvert(), "tolerance"_a, "closed"_a);

    m.def(
        "crossing_pairs",
        [](In2 vertices, InIndices starts, bool at_vertices) {
            nb::gil_scoped_release release;
            return ss::CrossingPairs(vectors(vertices), {starts.data(), starts.shape(0)},
                                     at_vertices)
                .run();
        },
        "vertices"_a.noconvert(), "starts"_a.noconvert(), "at_vertices"_a);

    nb::class_<ss::Sides>(m, "Sides")
        .def(
            "__init__",
            [](ss::Sides *made, In2 vertices, In1 along, InIndices starts, In1 rounds) {
                const auto points = vectors(vertices);
                std::vector<ss::Sides::Segment> segments;
                for (std::size_t k = 0; k + 1 < starts.shape(0); ++k)
                    for (std::int64_t i = starts(k); i + 1 < starts(k + 1); ++i)
                        segments.push_back({points[i], points[i + 1], along(i),
                                            static_cast<std::int64_t>(k)});
                const auto given = numbers(rounds);
                new (made) ss::Sides(std::move(segments), {given.begin(), given.end()});
            },
            "vertices"_a.noconvert(), "along"_a.noconvert(), "starts"_a.noconvert(),
            "rounds"_a.noconvert())
        .def(
            "across",
            [](const ss::Sides &self, In2 points, In1 along, std::int64_t own, double reach,
               double around, double least, OutPoints across) {
                nb::gil_scoped_release release;
                const auto at = vectors(points);
                for (std::size_t i = 0; i < at.size(); ++i)
                    vectors(across)[i] =
                        self.across(at[i], along(i), own, {reach, around, least});
            },
            "points"_a.noconvert(), "along"_a.noconvert(), "own"_a, "reach"_a, "around"_a,
            "least"_a, "across"_a.noconvert());
}
