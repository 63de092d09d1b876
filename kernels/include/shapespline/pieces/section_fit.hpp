// One section fitted between two nodes that are fixed, from nothing.
#pragma once

#include "shapespline/pieces/bezier_fit.hpp"

namespace shapespline::pieces {

// A new section of a cost over data between two nodes: chord length parameters, equal knots.
inline Section blank_section(std::span<const Vec2> data, Index first, Index last, Vec2 begin,
                             Vec2 end, int cost, int largest_degree) {
    if (cost == 1) return line_section(begin, end, first, last, data);
    Section s;
    s.degree = std::min(cost, largest_degree);
    const int n = cost + 1, spans = n - s.degree;
    s.knots.assign(n + s.degree + 1, 0.0);
    for (int k = 0; k <= s.degree + spans; ++k)
        s.knots[s.degree + k] = std::min(1.0, static_cast<double>(k) / spans);
    s.points.resize(n);
    for (int i = 0; i < n; ++i)
        s.points[i] = begin + (static_cast<double>(i) / (n - 1)) * (end - begin);
    s.points.back() = end;
    s.first = first;
    s.last = last;
    s.parameters.assign(s.count(), 0.0);
    for (Index j = 1; j < s.count(); ++j)
        s.parameters[j] = s.parameters[j - 1] + norm(data[first + j] - data[first + j - 1]);
    const double length = s.parameters.back();
    for (double &u : s.parameters) u = length > 0.0 ? u / length : 0.0;
    return s;
}

inline bool is_bezier(const Section &section) {
    return section.curved() && section.cost() == section.degree;
}

// The same, fitted between its nodes.
inline LawsonResult fit_section(std::span<const Vec2> data, const Section &start,
                                 const LawsonLimits &limits) {
    if (is_bezier(start) && !limits.general)
        return start.degree == 2 ? BezierFit<2>(data, start, limits).run()
                                 : BezierFit<3>(data, start, limits).run();
    const std::vector<Section> one{start};
    LawsonFit fit(data, one, {true}, {true}, limits);
    fit.start_from_parameters();
    return fit.run();
}

// Whether such a fit keeps the tolerance.
inline bool section_fits(std::span<const Vec2> data, const Section &start,
                         const LawsonLimits &limits) {
    if (is_bezier(start) && !limits.general)
        return start.degree == 2 ? BezierFit<2>(data, start, limits).succeeds()
                                 : BezierFit<3>(data, start, limits).succeeds();
    return fit_section(data, start, limits).kept;
}

}  // namespace shapespline::pieces
