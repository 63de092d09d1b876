// A chain of sections: neighbours share a node that is free to move, data belong to one section.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "shapespline/pieces/section_feet.hpp"

namespace shapespline::pieces {

// Everything about a chain that a step changes. Plain arrays, so that a trial is a cheap copy.
struct ChainState {
    std::vector<double> knots;
    std::vector<Vec2> points;
    std::vector<double> parameters, distances_sq;  // of the data
    std::vector<int> spans;
    std::vector<double> node_distances_sq;  // of the free nodes, to the data polyline
    std::vector<Vec2> node_feet;
    std::vector<Index> first, last;  // data of each section
};

// A tangent joint: its residual scale * sin(angle) and the gradient by the three points around.
struct JointTerm {
    double residual;
    std::array<double, 6> gradient;  // previous point, node, next point
};

// How a chain is held at one end: its node may be fixed, and so may the direction there, by the
// control point beyond it; exactly, if that is required.
struct ChainEnd {
    bool fixed = false;
    std::optional<Vec2> beyond = std::nullopt;
    bool exact = false;
};

class ChainModel {
  public:
    ChainModel(std::span<const Vec2> data, const std::vector<Section> &sections,
               const ChainEnd &begin, const ChainEnd &end, double tolerance)
        : data_(data),
          sections_(sections),
          begin_(begin),
          end_(end),
          enough_sq_(kFootPart * tolerance * tolerance) {
        std::size_t n_knots = 0, n_points = 0, n_spans = 0;
        for (const Section &s : sections) {
            knot_offset_.push_back(n_knots);
            point_offset_.push_back(n_points);
            span_offset_.push_back(n_spans);
            n_knots += s.knots.size();
            n_points += s.points.size();
            n_spans += s.points.size() - s.degree;
        }
        taylor_.resize(n_spans);
        spans_.resize(n_spans);
        if (begin.beyond) tangent_joints_.push_back(0);
        for (std::size_t i = 1; i < sections.size(); ++i)
            if (sections[i].tangent) tangent_joints_.push_back(i);
        if (end.beyond) tangent_joints_.push_back(sections.size());
        for (const Section &s : sections) {
            const Index stride =
                std::max<Index>(1, s.count() / (kActiveData + kActivePerPoint * s.cost()));
            for (Index j = s.first; j <= s.last; j += stride) active_.push_back(j);
            thinned_ |= stride > 1;
        }
    }

    // Where data are dense a part of them, the active ones, does for most rounds.
    bool thinned() const { return thinned_; }
    std::span<const Index> active() const { return active_; }
    std::span<const Index> active(const ChainState &state, std::size_t s) const {
        const auto begin = std::lower_bound(active_.begin(), active_.end(), state.first[s]);
        return {begin, std::upper_bound(begin, active_.end(), state.last[s])};
    }

    // Makes all data active; the others start between the feet of their active neighbours.
    void activate_all(ChainState &state) {
        for (std::size_t s = 0; s < size(); ++s) {
            const auto chosen = active(state, s);
            if (chosen.empty()) continue;
            const Feet f = feet(state, state.first[s]);
            const Index first = state.first[s];
            for (std::size_t k = 0; k + 1 < chosen.size(); ++k) {
                const Index a = chosen[k] - first, b = chosen[k + 1] - first;
                for (Index j = a + 1; j < b; ++j)
                    f.parameters[j] =
                        f.parameters[a] +
                        (f.parameters[b] - f.parameters[a]) * static_cast<double>(j - a) / (b - a);
            }
            for (Index j = chosen.back() - first + 1; j <= state.last[s] - first; ++j)
                f.parameters[j] = std::max(f.parameters[j], f.parameters[chosen.back() - first]);
        }
        active_.clear();
        for (Index j = base(); j <= state.last[size() - 1]; ++j) active_.push_back(j);
        thinned_ = false;
    }

    ChainState initial_state() const {
        ChainState state;
        for (const Section &s : sections_) {
            state.knots.insert(state.knots.end(), s.knots.begin(), s.knots.end());
            state.points.insert(state.points.end(), s.points.begin(), s.points.end());
            state.parameters.insert(state.parameters.end(), s.parameters.begin(),
                                    s.parameters.end());
            state.first.push_back(s.first);
            state.last.push_back(s.last);
        }
        state.spans.assign(state.parameters.size(), 0);
        state.distances_sq.assign(state.parameters.size(), 0.0);
        state.node_distances_sq.assign(size() + 1, 0.0);
        state.node_feet.assign(size() + 1, {});
        return state;
    }

    // The sections as a state has them.
    std::vector<Section> sections(const ChainState &state) const {
        std::vector<Section> result = sections_;
        for (std::size_t s = 0; s < size(); ++s) {
            Section &r = result[s];
            std::copy_n(state.knots.begin() + knot_offset_[s], r.knots.size(), r.knots.begin());
            std::copy_n(state.points.begin() + point_offset_[s], r.points.size(),
                        r.points.begin());
            r.first = state.first[s];
            r.last = state.last[s];
            const auto begin = state.parameters.begin() + (r.first - base());
            r.parameters.assign(begin, begin + r.count());
        }
        return result;
    }

    std::size_t size() const { return sections_.size(); }
    std::span<const Vec2> data() const { return data_; }
    Index base() const { return sections_.front().first; }
    bool node_free(std::size_t i) const {
        if (i == 0) return !begin_.fixed;
        return i == size() ? !end_.fixed : !sections_[i].pinned;
    }
    const std::vector<std::size_t> &tangent_joints() const { return tangent_joints_; }
    // Whether a tangent joint is one that is required.
    bool exact() const {
        return begin_.exact || end_.exact ||
               std::any_of(tangent_joints_.begin(), tangent_joints_.end(), [&](std::size_t i) {
                   return i > 0 && i < size() && sections_[i].required;
               });
    }
    std::size_t point_offset(std::size_t s) const { return point_offset_[s]; }
    std::size_t knot_offset(std::size_t s) const { return knot_offset_[s]; }
    SectionView section(const ChainState &state, std::size_t s) const {
        return {sections_[s].degree, sections_[s].points.size(),
                state.knots.data() + knot_offset_[s], state.points.data() + point_offset_[s]};
    }
    // The same as it began: its kind is that of every state.
    SectionView shape(std::size_t s) const { return view(sections_[s]); }
    const BasisTaylor *taylor(std::size_t s) const { return taylor_.data() + span_offset_[s]; }
    const SpanPolynomial *spans(std::size_t s) const { return spans_.data() + span_offset_[s]; }
    int n_spans(std::size_t s) const {
        return static_cast<int>(sections_[s].points.size()) - sections_[s].degree;
    }
    Feet feet(ChainState &state, Index j) const {
        const auto at = j - base();
        return {state.parameters.data() + at, state.spans.data() + at,
                state.distances_sq.data() + at};
    }
    Vec2 node(const ChainState &state, std::size_t i) const {
        return i < size() ? state.points[point_offset_[i]] : state.points.back();
    }

    // Polynomials of all sections; what follows reads them.
    void expand(const ChainState &state) {
        for (std::size_t s = 0; s < size(); ++s)
            expand_spans(section(state, s), taylor_.data() + span_offset_[s],
                         spans_.data() + span_offset_[s]);
    }

    // Polynomials, then foot points of all data and of the free nodes.
    void project(ChainState &state, int iterations) {
        expand(state);
        for (std::size_t s = 0; s < size(); ++s)
            improve_feet(spans(s), n_spans(s), data_.data() + base(), active(state, s), base(),
                         iterations, enough_sq_, feet(state, base()));
        for (std::size_t i = 0; i <= size(); ++i) {
            if (!node_free(i)) continue;
            const Vec2 p = node(state, i);
            state.node_feet[i] = nearest_near(data_, p, node_index(state, i));
            state.node_distances_sq[i] = norm_sq(p - state.node_feet[i]);
        }
    }

    JointTerm joint_term(const ChainState &state, std::size_t i, double scale) const {
        // Neighbouring sections both store the node between them.
        const Vec2 at = node(state, i);
        const Vec2 u = at - (i == 0 ? *begin_.beyond
                             : i < size() ? state.points[point_offset_[i] - 2]
                                          : state.points[state.points.size() - 2]);
        const Vec2 v = (i < size() ? state.points[point_offset_[i] + 1] : *end_.beyond) - at;
        const double length = std::sqrt(norm_sq(u) * norm_sq(v)) + 1e-300;
        const double f = scale / length;
        JointTerm term;
        term.residual = f * cross(u, v);
        // A tangent that runs backwards has a small sine too: keep pushing.
        if (dot(u, v) < 0.0) term.residual = std::copysign(scale, term.residual);
        term.gradient = {-f * v.y, f * v.x, 0.0, 0.0, -f * u.y, f * u.x};
        term.gradient[2] = -term.gradient[0] - term.gradient[4];
        term.gradient[3] = -term.gradient[1] - term.gradient[5];
        return term;
    }

    // Moves data across the joints, up to kShift either way, to the section that is nearer: the
    // split that makes the sum of squared distances least. Needs the polynomials.
    void reassign(ChainState &state) {
        for (std::size_t i = 0; i + 1 < size(); ++i) reassign_joint(state, i);
    }

    double reverse_distance(ChainState &state, const ReverseCheck &check) const {
        double worst = 0.0;
        for (std::size_t s = 0; s < size(); ++s)
            worst = std::max(worst, check.distance(spans(s), n_spans(s),
                                                   feet(state, state.first[s]),
                                                   state.first[s], state.last[s]));
        return worst;
    }

  private:
    static constexpr Index kShift = 6;
    // Squared distances of feet are exact to this part of the squared tolerance.
    static constexpr double kFootPart = 1e-4;
    static constexpr int kWindow = 2 * kShift + 2;
    static constexpr Index kActiveData = 6, kActivePerPoint = 3;
    struct Side {
        std::array<double, kWindow> parameters, distances_sq;
        std::array<int, kWindow> spans;
        Feet feet() { return {parameters.data(), spans.data(), distances_sq.data()}; }
    };

    Index node_index(const ChainState &state, std::size_t i) const {
        return i < size() ? state.first[i] : state.last[size() - 1];
    }

    void reassign_joint(ChainState &state, std::size_t i) {
        const Index end = state.last[i];
        const Index from = std::max(state.first[i], end - kShift);
        const Index to = std::min(state.last[i + 1] - 1, end + kShift) + 1;
        const Index count = to - from + 1;
        Side left, right;
        const Feet now = feet(state, from);
        for (Index k = 0; k < count; ++k) {
            const bool mine = from + k <= end;
            left.parameters[k] = mine ? now.parameters[k] : 1.0;
            left.spans[k] = mine ? now.spans[k] : n_spans(i) - 1;
            right.parameters[k] = mine ? 0.0 : now.parameters[k];
            right.spans[k] = mine ? 0 : now.spans[k];
        }
        std::array<Index, kWindow> all;
        for (Index k = 0; k < count; ++k) all[k] = k;
        const std::span<const Index> window(all.data(), count);
        improve_feet(spans(i), n_spans(i), data_.data() + from, window, 0, 3, enough_sq_,
                     left.feet());
        improve_feet(spans(i + 1), n_spans(i + 1), data_.data() + from, window, 0, 3, enough_sq_,
                     right.feet());
        double sum = 0.0;
        for (Index k = 0; k < count; ++k) sum += right.distances_sq[k];
        double best = std::numeric_limits<double>::infinity();
        Index split = end - from;
        for (Index k = 0; k + 1 < count; ++k) {
            sum += left.distances_sq[k] - right.distances_sq[k];
            if (sum < best - 1e-15) {
                best = sum;
                split = k;
            }
        }
        for (Index k = 0; k < count; ++k) {
            const Side &side = k <= split ? left : right;
            now.parameters[k] = side.parameters[k];
            now.spans[k] = side.spans[k];
            now.distances_sq[k] = side.distances_sq[k];
        }
        state.last[i] = from + split;
        state.first[i + 1] = from + split + 1;
    }

    std::span<const Vec2> data_;
    const std::vector<Section> &sections_;
    ChainEnd begin_, end_;
    double enough_sq_;
    std::vector<std::size_t> knot_offset_, point_offset_, span_offset_, tangent_joints_;
    std::vector<Index> active_;
    bool thinned_ = false;
    std::vector<BasisTaylor> taylor_;
    std::vector<SpanPolynomial> spans_;
};

}  // namespace shapespline::pieces
