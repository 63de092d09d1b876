// Lines, arcs and free-form runs of an outline.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
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
        "taubin_circle",
        [](In2 points, In1 weights) {
            const drawn::PrefixMoments moments(vectors(points), numbers(weights));
            const drawn::CentralMoments central(moments.of(0, points.shape(0) - 1));
            const drawn::CircleFit found = drawn::fit_circle(central);
            return std::tuple{found.centre.x, found.centre.y, found.radius, found.sum_sq};
        },
        "points"_a.noconvert(), "weights"_a.noconvert());
    m.def(
        "null_space",
        [](In1 values, Rows rows, In1 units, double implied, Out1 onto, Out2 basis) {
            const std::vector<char> free = drawn::null_space(
                numbers(values), {rows.data(), rows.size()}, numbers(units), implied,
                numbers(onto), {basis.data(), basis.size()});
            return std::vector<bool>(free.begin(), free.end());
        },
        "values"_a.noconvert(), "rows"_a.noconvert(), "units"_a.noconvert(), "implied"_a,
        "onto"_a.noconvert(), "basis"_a.noconvert());
}
