// The structured fit in lines, Beziers and small splines.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "shapespline/pieces/outline_search.hpp"
#include "shapespline/pieces/section_squares.hpp"

using namespace nb::literals;
namespace pieces = ss::pieces;

namespace {

// The data, and what is known about each of them; it keeps the arrays that it is made of.
struct PiecesOutline {
    In2 points;
    bool closed;
    InIndices joint, forced, low_turn;

    pieces::LaidOutOutline laid_out(const pieces::PiecesSettings &settings) const {
        return {vectors(points), closed, {indices(joint), indices(forced), indices(low_turn)},
                settings};
    }
};

// Of each section: degree, number of points, knots and coordinates end to end.
using PiecesTuple = std::tuple<std::vector<int>, std::vector<std::size_t>, std::vector<double>,
                               std::vector<double>>;

PiecesTuple fit_pieces(const PiecesOutline &outline, const pieces::PiecesSettings &settings,
                       const nb::object &ask, const std::optional<In2> &observed, double noise) {
    ss::Interruption asking = interruption(ask);
    nb::gil_scoped_release release;
    auto sections = outline.laid_out(settings).search(asking);
    if (observed && !sections.empty())
        sections = pieces::fit_observed(vectors(*observed), outline.closed, std::move(sections),
                                        noise);
    PiecesTuple found;
    auto &[degrees, counts, knots, coordinates] = found;
    for (const pieces::Section &s : sections) {
        degrees.push_back(s.degree);
        counts.push_back(s.points.size());
        knots.insert(knots.end(), s.knots.begin(), s.knots.end());
        for (const ss::Vec2 p : s.points) coordinates.insert(coordinates.end(), {p.x, p.y});
    }
    return found;
}

}  // namespace

void bind_pieces(nb::module_ &m) {
    nb::class_<pieces::PiecesBudget>(m, "PiecesBudget")
        .def(nb::init<pieces::Index, double, pieces::Index, int, bool>(), nb::kw_only(),
             "stride"_a, "resolution"_a, "every"_a, "passes"_a, "thorough"_a);
    nb::class_<pieces::PiecesSettings>(m, "PiecesSettings")
        .def(nb::init<double, int, bool, bool, double, pieces::PiecesBudget>(), nb::kw_only(),
             "tolerance"_a, "largest_degree"_a, "smooth"_a, "ends_fixed"_a, "least_corner"_a,
             "budget"_a);
    nb::class_<PiecesOutline>(m, "PiecesOutline")
        .def(nb::init<In2, bool, InIndices, InIndices, InIndices>(), "points"_a.noconvert(),
             "closed"_a, "joint"_a.noconvert(), "forced"_a.noconvert(), "low_turn"_a.noconvert());
    m.def("fit_pieces", &fit_pieces, "outline"_a, "settings"_a, "ask"_a,
          "observed"_a.none().noconvert() = nb::none(), "noise"_a = 0.0);
}
