// Levenberg-Marquardt on a chain: control points, nodes and knots together, parameters eliminated.
#pragma once

#include <vector>

#include "shapespline/pieces/chain_model.hpp"
#include "shapespline/base/envelope.hpp"
#include "shapespline/pieces/section_normal.hpp"

namespace shapespline::pieces {

// Weights of the terms of the sum of squares that a chain minimises.
struct ChainWeights {
    std::vector<double> data, nodes;
    double joints = 0.0;
    double joint_scale = 0.0;  // residual of a tangent joint over the sine of its angle
};

class ChainSolver {
  public:
    explicit ChainSolver(ChainModel &model) : model_(model) {}

    // The sum of squares at a state whose feet are known.
    double cost(const ChainState &state, const ChainWeights &weights) const {
        double sum = 0.0;
        for (const Index j : model_.active())
            sum += weights.data[j - model_.base()] * state.distances_sq[j - model_.base()];
        for (std::size_t i = 0; i <= model_.size(); ++i)
            if (model_.node_free(i)) sum += weights.nodes[i] * state.node_distances_sq[i];
        for (const std::size_t i : model_.tangent_joints()) {
            const double e = model_.joint_term(state, i, weights.joint_scale).residual;
            sum += weights.joints * e * e;
        }
        return sum;
    }

    // Control points that fit the data at the parameters they have, nodes fixed or not.
    void solve_at_fixed_parameters(ChainState &state, const ChainWeights &weights) {
        set_unknowns(false);
        model_.expand(state);
        for (std::size_t s = 0; s < model_.size(); ++s) find_spans(state, s);
        assemble(state, weights, 0.0, false);
        if (!solve(1e-9)) return;
        move_points(state, state);
        model_.project(state, 6);
    }

    // Steps until the cost falls, or a step promises that it falls, by less than the part `enough`,
    // or no damping lowers it. Needs projected feet, leaves them so.
    double improve(ChainState &state, const ChainWeights &weights, bool free_knots, int iterations,
                   double enough) {
        set_unknowns(free_knots);
        damping_ = std::max(damping_, kLeastDamping);
        double now = cost(state, weights);
        for (int iteration = 0; iteration < iterations && now > 0.0; ++iteration) {
            assemble(state, weights, damping_, true);
            double next = now;
            bool lower = false;
            for (int trial = 0; trial < kTrials && !lower; ++trial) {
                if (solve(damping_)) {
                    if (promised(damping_) < enough * now) break;
                    trial_ = state;
                    move_points(state, trial_);
                    if (free_knots) move_knots(state, trial_);
                    model_.project(trial_, kNewtonSteps);
                    next = cost(trial_, weights);
                    lower = next < now;
                }
                if (!lower) damping_ = kRaise * damping_ + kLeastDamping;
            }
            if (!lower) {
                model_.expand(state);
                break;
            }
            std::swap(state, trial_);
            damping_ /= kLower;
            const double fall = (now - next) / now;
            now = next;
            if (fall < enough) break;
        }
        return now;
    }

  private:
    static constexpr int kTrials = 6, kNewtonSteps = 2;
    static constexpr double kLeastScale = 1e-10, kLeastDamping = 1e-6, kRaise = 8.0, kLower = 6.0;
    // No knot interval shrinks by more than this part in a step, nor below this part of the mean
    // interval.
    static constexpr double kLargestShrink = 0.6, kLeastInterval = 0.02;
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    // Numbers the unknowns along the chain: node, inner control points with the knots in the middle
    // of what they shape, next node. Only neighbours meet in a span: the matrix is narrow.
    void set_unknowns(bool free_knots) {
        if (!unknown_.empty() && free_knots == free_knots_) return;
        free_knots_ = free_knots;
        unknown_.assign(model_.size(), {});
        std::size_t next = 0, node = model_.node_free(0) ? next : kNone;
        if (node != kNone) next += 2;
        for (std::size_t s = 0; s < model_.size(); ++s) {
            const SectionView section = model_.shape(s);
            const std::size_t n = section.n_points;
            const std::size_t n_knots = free_knots ? section.n_interior_knots() : 0;
            auto &unknown = unknown_[s];
            unknown.assign(2 * n + n_knots, kNone);
            if (node != kNone) {
                unknown[0] = node;
                unknown[1] = node + 1;
            }
            std::size_t knot = 0;
            for (std::size_t l = 1; l + 1 < n; ++l) {
                unknown[2 * l] = next++;
                unknown[2 * l + 1] = next++;
                if (l >= (section.degree + 1u) / 2 && knot < n_knots)
                    unknown[2 * n + knot++] = next++;
            }
            while (knot < n_knots) unknown[2 * n + knot++] = next++;
            node = model_.node_free(s + 1) ? next : kNone;
            if (node != kNone) {
                unknown[2 * n - 2] = next++;
                unknown[2 * n - 1] = next++;
            }
        }
        is_abscissa_.assign(next, false);
        for (std::size_t s = 0; s < model_.size(); ++s)
            for (std::size_t l = 0; l < model_.shape(s).n_points; ++l)
                if (unknown_[s][2 * l] != kNone) is_abscissa_[unknown_[s][2 * l]] = true;
        std::vector<std::size_t> first_column(next);
        for (std::size_t i = 0; i < next; ++i) first_column[i] = i;
        for (std::size_t s = 0; s < model_.size(); ++s) couple(s, first_column);
        for (const std::size_t i : model_.tangent_joints()) {
            const auto at = joint_unknowns(i);
            const std::size_t lowest = *std::min_element(at.begin(), at.end());
            for (const std::size_t g : at)
                if (g != kNone) first_column[g] = std::min(first_column[g], lowest);
        }
        matrix_ = EnvelopeMatrix(std::move(first_column));
        factor_ = matrix_;
        step_.resize(next);
        scale_.resize(next);
        least_.resize(next);
        gradient_.resize(next);
    }

    // Widens the rows of the unknowns that shape a span to the lowest of them.
    void couple(std::size_t s, std::vector<std::size_t> &first_column) const {
        const SectionView section = model_.shape(s);
        const std::size_t p = section.degree, n = section.n_points;
        const std::size_t n_knots = unknown_[s].size() - 2 * n;
        std::vector<std::size_t> active;
        for (std::size_t span = 0; span < section.n_spans(); ++span) {
            active.clear();
            for (std::size_t l = 2 * span; l < 2 * (span + p + 1); ++l)
                active.push_back(unknown_[s][l]);
            for (std::size_t k = span > p ? span - p : 0; k < std::min(n_knots, span + p); ++k)
                active.push_back(unknown_[s][2 * n + k]);
            const std::size_t lowest = *std::min_element(active.begin(), active.end());
            for (const std::size_t u : active)
                if (u != kNone) first_column[u] = std::min(first_column[u], lowest);
        }
    }

    // Unknowns of the control points before, at and after a joint.
    std::array<std::size_t, 6> joint_unknowns(std::size_t i) const {
        std::array<std::size_t, 6> at;
        at.fill(kNone);
        if (i > 0) {
            const std::size_t last = 2 * model_.shape(i - 1).n_points - 1;
            for (int k = 0; k < 4; ++k) at[k] = unknown_[i - 1][last - 3 + k];
        }
        if (i < model_.size())
            for (int k = 0; k < 4; ++k) at[2 + k] = unknown_[i][k];
        return at;
    }

    void find_spans(ChainState &state, std::size_t s) const {
        const Feet feet = model_.feet(state, state.first[s]);
        for (Index j = 0; j <= state.last[s] - state.first[s]; ++j)
            feet.spans[j] =
                walk_to_span(model_.spans(s), model_.n_spans(s), 0, feet.parameters[j]);
    }

    void assemble(ChainState &state, const ChainWeights &weights, double damping,
                  bool eliminate) {
        matrix_.clear();
        std::fill(gradient_.begin(), gradient_.end(), 0.0);
        for (std::size_t s = 0; s < model_.size(); ++s) {
            const Index base = model_.base();
            normal_.assemble(model_.section(state, s), model_.taylor(s), model_.spans(s),
                             model_.data().data() + base, weights.data.data(),
                             model_.active(state, s), base, model_.feet(state, base), damping,
                             eliminate, free_knots_);
            const auto &unknown = unknown_[s];
            for (std::size_t i = 0; i < normal_.size(); ++i) {
                if (unknown[i] == kNone) continue;
                gradient_[unknown[i]] += normal_.gradient(i);
                for (std::size_t j = 0; j <= i; ++j) {
                    if (unknown[j] == kNone) continue;
                    const auto [column, row] = std::minmax(unknown[i], unknown[j]);
                    if (column >= matrix_.first_column(row))
                        matrix_.at(row, column) += normal_.matrix(i, j);
                }
            }
        }
        for (std::size_t i = 0; i <= model_.size(); ++i) add_node(state, weights, i);
        for (const std::size_t i : model_.tangent_joints()) add_joint(state, weights, i);
        set_scales();
    }

    void add_node(const ChainState &state, const ChainWeights &weights, std::size_t i) {
        if (!model_.node_free(i)) return;
        const std::size_t last = model_.size() - 1;
        const std::size_t g =
            i <= last ? unknown_[i][0]
                      : unknown_[last][2 * model_.section(state, last).n_points - 2];
        const Vec2 residual = model_.node(state, i) - state.node_feet[i];
        matrix_.at(g, g) += weights.nodes[i];
        matrix_.at(g + 1, g + 1) += weights.nodes[i];
        gradient_[g] += weights.nodes[i] * residual.x;
        gradient_[g + 1] += weights.nodes[i] * residual.y;
    }

    void add_joint(const ChainState &state, const ChainWeights &weights, std::size_t i) {
        const JointTerm term = model_.joint_term(state, i, weights.joint_scale);
        const auto at = joint_unknowns(i);
        for (int a = 0; a < 6; ++a) {
            if (at[a] == kNone) continue;
            gradient_[at[a]] += weights.joints * term.residual * term.gradient[a];
            for (int b = 0; b < 6; ++b)
                if (at[b] <= at[a])
                    matrix_.at(at[a], at[b]) +=
                        weights.joints * term.gradient[a] * term.gradient[b];
        }
    }

    // What unknowns are damped in proportion to: the diagonal, one value for both coordinates of a
    // point, so that no step depends on the axes, and in parts of the largest among points and
    // among knots, so that none depends on the unit of length.
    void set_scales() {
        double points = 0.0, knots = 0.0;
        for (std::size_t i = 0; i < scale_.size(); ++i) {
            scale_[i] = matrix_.at(i, i);
            if (is_abscissa_[i]) {
                scale_[i] = scale_[i + 1] = 0.5 * (scale_[i] + matrix_.at(i + 1, i + 1));
                points = std::max(points, scale_[i++]);
            } else {
                knots = std::max(knots, scale_[i]);
            }
        }
        for (std::size_t i = 0; i < scale_.size(); ++i) {
            least_[i] = kLeastScale * (is_abscissa_[i] ? points : knots);
            if (is_abscissa_[i]) ++i, least_[i] = least_[i - 1];
        }
    }

    // The damped step, -(A + damping S)^-1 g, S the scale of the unknowns.
    bool solve(double damping) {
        factor_.take_values(matrix_);
        for (std::size_t i = 0; i < gradient_.size(); ++i) {
            factor_.at(i, i) += damping * scale_[i] + least_[i];
            step_[i] = -gradient_[i];
        }
        if (!factor_.factorize()) return false;
        factor_.solve(step_);
        return true;
    }

    // By how much the linearised sum of squares falls with the step.
    double promised(double damping) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < step_.size(); ++i)
            sum += step_[i] * (damping * scale_[i] * step_[i] - gradient_[i]);
        return sum;
    }

    void move_points(const ChainState &from, ChainState &to) const {
        for (std::size_t s = 0; s < model_.size(); ++s) {
            const std::size_t n = model_.section(from, s).n_points;
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t gx = unknown_[s][2 * i];
                if (gx == kNone) continue;
                const std::size_t at = model_.point_offset(s) + i;
                to.points[at] = from.points[at] + Vec2{step_[gx], step_[unknown_[s][2 * i + 1]]};
            }
        }
    }

    void move_knots(const ChainState &from, ChainState &to) const {
        for (std::size_t s = 0; s < model_.size(); ++s) {
            const SectionView section = model_.section(from, s);
            const std::size_t n = section.n_interior_knots(), p = section.degree;
            const std::size_t *unknown = unknown_[s].data() + 2 * section.n_points;
            const auto move = [&](std::size_t k) {  // of knot p + k
                return k == 0 || k > n ? 0.0 : step_[unknown[k - 1]];
            };
            double scale = 1.0;
            for (std::size_t k = 0; k <= n; ++k) {
                const double interval = section.knots[p + k + 1] - section.knots[p + k];
                const double shrink = move(k) - move(k + 1);
                if (shrink * scale > kLargestShrink * interval)
                    scale = kLargestShrink * interval / shrink;
            }
            double *knots = to.knots.data() + model_.knot_offset(s);
            bool apart = true;
            for (std::size_t k = 1; k <= n; ++k)
                knots[p + k] = section.knots[p + k] + scale * move(k);
            for (std::size_t k = 0; k <= n; ++k)
                apart &= knots[p + k + 1] - knots[p + k] >= kLeastInterval / (n + 1.0);
            if (!apart) std::copy_n(section.knots, section.n_points + p + 1, knots);
        }
    }

    ChainModel &model_;
    SectionNormal normal_;
    std::vector<std::vector<std::size_t>> unknown_;
    EnvelopeMatrix matrix_{std::vector<std::size_t>{}}, factor_ = matrix_;
    std::vector<bool> is_abscissa_;  // x of a point, whose y is the next unknown
    std::vector<double> gradient_, step_, scale_, least_;
    ChainState trial_;
    double damping_ = 1e-3;
    bool free_knots_ = false;
};

}  // namespace shapespline::pieces
