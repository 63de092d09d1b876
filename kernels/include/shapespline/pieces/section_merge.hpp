// Two neighbouring sections fitted as one.
#pragma once

#include <vector>

#include "shapespline/pieces/section_fit.hpp"

namespace shapespline::pieces {

// A section fitted between fixed nodes; a line is what it is.
inline LawsonResult fitted_section(std::span<const Vec2> data, const Section &start,
                                    const LawsonLimits &limits) {
    if (start.curved()) return fit_section(data, start, limits);
    double farthest_sq = 0.0;
    for (Index j = start.first; j <= start.last; ++j)
        farthest_sq = std::max(
            farthest_sq, segment_distance_sq(data[j], start.points[0], start.points[1]));
    const double farthest = std::sqrt(farthest_sq);
    return {farthest <= limits.tolerance, farthest, {start}};
}

// A number of interior knots in (0, 1) from many or few: the closest are dropped, the widest
// intervals halved; intervals below 3 % of the mean are widened.
inline std::vector<double> thinned_knots(std::vector<double> u, std::size_t wanted) {
    u.insert(u.begin(), 0.0);
    u.push_back(1.0);
    while (u.size() > wanted + 2) {
        std::size_t closest = 1;
        for (std::size_t i = 2; i + 1 < u.size(); ++i)
            if (u[i + 1] - u[i - 1] < u[closest + 1] - u[closest - 1]) closest = i;
        u.erase(u.begin() + static_cast<long>(closest));
    }
    while (u.size() < wanted + 2) {
        std::size_t widest = 1;
        for (std::size_t i = 2; i < u.size(); ++i)
            if (u[i] - u[i - 1] > u[widest] - u[widest - 1]) widest = i;
        u.insert(u.begin() + static_cast<long>(widest), 0.5 * (u[widest - 1] + u[widest]));
    }
    std::vector<double> cumulated{0.0};
    for (std::size_t i = 1; i < u.size(); ++i)
        cumulated.push_back(cumulated.back() +
                         std::max(u[i] - u[i - 1], 0.03 / static_cast<double>(wanted + 1)));
    std::vector<double> knots(cumulated.begin() + 1, cumulated.end() - 1);
    for (double &k : knots) k /= cumulated.back();
    return knots;
}

// Knots for the union of two sections: theirs, and a close pair at the node between them, where
// the curve may bend abruptly.
inline std::vector<double> union_knots(const Section &a, const Section &b) {
    const auto length = [](const Section &s) {
        double sum = 0.0;
        for (std::size_t i = 1; i < s.points.size(); ++i)
            sum += norm(s.points[i] - s.points[i - 1]);
        return sum;
    };
    const double share = length(a) / (length(a) + length(b) + 1e-300);
    const double beside = 0.02 * std::min(share, 1.0 - share);
    std::vector<double> u;
    for (std::size_t i = a.degree + 1; i < a.points.size(); ++i) u.push_back(share * a.knots[i]);
    u.insert(u.end(), {share - beside, share + beside});
    for (std::size_t i = b.degree + 1; i < b.points.size(); ++i)
        u.push_back(share + (1.0 - share) * b.knots[i]);
    return u;
}

// One section over the data of two, of a given cost. Equal knots first; where they fail, those of
// the two.
inline LawsonResult merged_section(std::span<const Vec2> data, const Section &a, const Section &b,
                              int cost, const LawsonLimits &limits, int largest_degree) {
    Section start = blank_section(data, a.first, b.last, a.points.front(), b.points.back(), cost,
                                  largest_degree);
    LawsonResult result = fitted_section(data, start, limits);
    const std::size_t n_knots = start.points.size() - start.degree - 1;
    if (n_knots > 0 && !result.kept) {
        const std::vector<double> knots = thinned_knots(union_knots(a, b), n_knots);
        std::copy(knots.begin(), knots.end(), start.knots.begin() + start.degree + 1);
        LawsonResult other = fit_section(data, start, limits);
        if (other.distance < result.distance) result = std::move(other);
    }
    result.sections.front().join_like(a);
    return result;
}

}  // namespace shapespline::pieces
