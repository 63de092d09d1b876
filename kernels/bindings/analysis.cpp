// What points tell before any fit.
#include "arrays.hpp"
#include "shapespline/analysis/centroid_distance.hpp"
#include "shapespline/analysis/corner_turn.hpp"
#include "shapespline/analysis/cpda.hpp"

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
        "corner_turns",
        [](In2 points, In1 stations, InIndices vertices, double length, Out1 turns) {
            nb::gil_scoped_release release;
            ss::analysis::corner_turns({vectors(points), numbers(stations)}, indices(vertices),
                                       length, turns.data());
        },
        "points"_a.noconvert(), "stations"_a.noconvert(), "vertices"_a.noconvert(), "length"_a,
        "turns"_a.noconvert());
}
