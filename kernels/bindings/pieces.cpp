// The structured fit in lines, Beziers and small splines.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <utility>
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

struct PiecesFound {
    std::vector<pieces::Section> sections;

    template <class Of>
    std::vector<int> each(Of &&of) const {
        std::vector<int> found;
        for (const pieces::Section &s : sections) found.push_back(static_cast<int>(of(s)));
        return found;
    }
    void write(const Out1 &knots, const OutPoints &points) const {
        auto at_knot = knots.data();
        auto at_point = vectors(points).begin();
        for (const pieces::Section &s : sections) {
            at_knot = std::ranges::copy(s.knots, at_knot).out;
            at_point = std::ranges::copy(s.points, at_point).out;
        }
    }
};

PiecesFound fit_pieces(const PiecesOutline &outline, const pieces::PiecesSettings &settings,
                       const nb::object &ask, const std::optional<In2> &observed, double noise) {
    ss::Interruption asking = interruption(ask);
    nb::gil_scoped_release release;
    auto sections = outline.laid_out(settings).search(asking);
    if (observed && !sections.empty())
        sections = pieces::fit_observed(vectors(*observed), outline.closed, std::move(sections),
                                        noise);
    return {std::move(sections)};
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
    nb::class_<PiecesFound>(m, "PiecesFound")
        .def_prop_ro("degrees",
                     [](const PiecesFound &self) {
                         return self.each([](const auto &s) { return s.degree; });
                     })
        .def_prop_ro("counts",
                     [](const PiecesFound &self) {
                         return self.each([](const auto &s) { return s.points.size(); });
                     })
        .def("write", &PiecesFound::write, "knots"_a.noconvert(), "points"_a.noconvert());
    m.def("fit_pieces", &fit_pieces, "outline"_a, "settings"_a, "ask"_a,
          "observed"_a.none().noconvert() = nb::none(), "noise"_a = 0.0);
}
