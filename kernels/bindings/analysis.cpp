// What points tell before any fit.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>

#include "arrays.hpp"
#include "shapespline/analysis/canonical_reading.hpp"
#include "shapespline/analysis/centroid_distance.hpp"
#include "shapespline/analysis/corners.hpp"
#include "shapespline/analysis/cpda.hpp"
#include "shapespline/analysis/cubic_windows.hpp"
#include "shapespline/analysis/largest_bulge.hpp"
#include "shapespline/analysis/told_by_others.hpp"

using namespace nb::literals;

void bind_analysis(nb::module_ &m) {
    m.def(
        "accumulate_chord_distances",
        [](In2 points, std::int64_t length, bool closed, Out1 signed_sums, Out1 unsigned_sums) {
            nb::gil_scoped_release release;
            ss::analysis::accumulate_chord_distances(vectors(points), length, closed,
                                                     signed_sums.data(), unsigned_sums.data());
        },
        "points"_a.noconvert(), "length"_a, "closed"_a, "signed_sums"_a.noconvert(),
        "unsigned_sums"_a.noconvert());

    m.def(
        "centroid_distances_sq",
        [](In2 points, Out1 distances_sq) {
            nb::gil_scoped_release release;
            ss::analysis::centroid_distances_sq(vectors(points), distances_sq.data());
        },
        "points"_a.noconvert(), "distances_sq"_a.noconvert());

    m.def(
        "canonical_reading",
        [](In2 points, bool closed, std::optional<In1> weights) {
            nb::gil_scoped_release release;
            const auto heavy = weights ? numbers(*weights) : std::span<const double>{};
            const auto reading = ss::analysis::canonical_reading(vectors(points), heavy, closed);
            return std::pair{reading.start, reading.step};
        },
        "points"_a.noconvert(), "closed"_a, "weights"_a.noconvert().none() = nb::none());

    using ss::analysis::PosedContour;
    nb::class_<PosedContour>(m, "PosedContour")
        .def(
            "__init__",
            [](PosedContour *self, In2 points, bool closed, double radius, double fine,
               double finest, OutPoints out) {
                nb::gil_scoped_release release;
                new (self)
                    PosedContour(vectors(points), closed, radius, fine, finest, vectors(out));
            },
            "points"_a.noconvert(), "closed"_a, "radius"_a, "fine"_a, "finest"_a,
            "out"_a.noconvert())
        .def_prop_ro("start", [](const PosedContour &self) { return self.reading.start; })
        .def_prop_ro("step", [](const PosedContour &self) { return self.reading.step; })
        .def_prop_ro("middle",
                     [](const PosedContour &self) {
                         return std::pair{self.pose.middle.x, self.pose.middle.y};
                     })
        .def_prop_ro(
            "axis",
            [](const PosedContour &self) { return std::pair{self.pose.axis.x, self.pose.axis.y}; })
        .def_prop_ro("side", [](const PosedContour &self) { return self.pose.side; })
        .def_prop_ro("scale", [](const PosedContour &self) { return self.pose.scale; })
        .def_ro("apart", &PosedContour::apart);

    m.def(
        "told_by_others",
        [](In2 points, InIndices told, InIndices offsets, Array<const double, nb::ndim<2>> rows,
           In1 noise, Out1 off, Out1 rest) {
            ss::analysis::told_by_others(vectors(points), indices(told),
                                         {indices(offsets), {rows.data(), rows.size()}},
                                         numbers(noise), off.data(), rest.data());
        },
        "points"_a.noconvert(), "told"_a.noconvert(), "offsets"_a.noconvert(),
        "rows"_a.noconvert(), "noise"_a.noconvert(), "off"_a.noconvert(), "rest"_a.noconvert());

    m.def(
        "windows_of_seven",
        [](In2 points, bool closed, std::size_t step, Array<double, nb::shape<2, -1, 7>> windows) {
            ss::analysis::windows_of_seven(vectors(points), closed, step,
                                           {windows.data(), windows.size()});
        },
        "points"_a.noconvert(), "closed"_a, "step"_a, "windows"_a.noconvert());
    using Windows = Array<const double, nb::shape<2, -1, 8>>;
    const auto windows = [](const Windows &rows) {
        return ss::analysis::CubicWindows({rows.data(), rows.size()});
    };
    m.def(
        "left_across",
        [windows](Windows rows, Out1 sums) { windows(rows).across(sums.data()); },
        "rows"_a.noconvert(), "sums"_a.noconvert());
    m.def(
        "left_at_twice_the_angle",
        [windows](Windows rows) {
            const ss::Vec2 mean = windows(rows).twice_direction();
            return std::pair{mean.x, mean.y};
        },
        "rows"_a.noconvert());

    m.def(
        "largest_bulge",
        [](In2 points, bool closed) {
            nb::gil_scoped_release release;
            return ss::analysis::largest_bulge(vectors(points), closed);
        },
        "points"_a.noconvert(), "closed"_a);

    m.attr("LEAST_TURN") = ss::analysis::kLeastTurn;
    m.attr("LOW_TURN") = ss::analysis::kLowTurn;
    m.def(
        "find_corners",
        [](In2 points, bool closed, In1 arc_length, double sigma, double tolerance, Out1 turns) {
            nb::gil_scoped_release release;
            const ss::analysis::CornerSearch found(vectors(points), closed, numbers(arc_length),
                                                   sigma, tolerance, numbers(turns));
            return std::pair{found.indices(), found.length()};
        },
        "points"_a.noconvert(), "closed"_a, "arc_length"_a.noconvert(), "sigma"_a, "tolerance"_a,
        "turns"_a.noconvert());
}
