// The structured fit in lines, Beziers and small splines.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "arrays.hpp"
#include "shapespline/pieces/outline_search.hpp"
#include "shapespline/pieces/section_squares.hpp"

using namespace nb::literals;

void bind_pieces(nb::module_ &m) {
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
            const ss::pieces::LaidOutOutline outline(
                vectors(points), closed, {indices(joint), indices(forced), indices(gentle)},
                {tolerance, largest_degree, smooth, ends_fixed, least_corner, stride, resolution,
                 every, passes, thorough});
            std::vector<std::int64_t> degrees, counts;
            std::vector<double> knots, coordinates;
            auto sections = outline.search(asking);
            if (observed)
                sections = ss::pieces::fit_observed(vectors(*observed), closed,
                                                    std::move(sections), noise);
            for (const ss::pieces::Section &s : sections) {
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
}
