// The smallest largest distance that a chain of sections can have: Lawson's algorithm (1961), an
// iteratively reweighted least squares.
//
// Weighted least squares with weights multiplied by the distances of the last round tends to the
// minimax fit, and its weighted RMS bounds the minimax distance from below: a chain that cannot
// keep the tolerance says so after a few rounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/pieces/chain_solver.hpp"

namespace shapespline::pieces {

struct LawsonLimits {
    double tolerance;
    int rounds;
    // Rounds in which all data are within the tolerance but the curve between them is not: other
    // weights of the data seldom help.
    int strays = std::numeric_limits<int>::max();
    // Beziers are fitted like all others: where joints are free that saves a point of fifty.
    bool general = false;
};

// Two are enough where much is tried and little succeeds, but where joints are free (PIE-07).
inline constexpr int most_strays(bool smooth) {
    return smooth ? 2 : std::numeric_limits<int>::max();
}

// When rounds cannot help any more, for one Bezier and for chains alike.
struct LawsonStop {
    static constexpr int kMostStalls = 5;

    // Whether the lower bound of the largest distance, the mean of the squared distances by
    // weight, forbids the tolerance, or the best so far is too far from it: rounds that help at
    // all bring it near at a rate of this kind (measured).
    static bool out_of_reach(double sum, double total_weight, double best, double tolerance,
                             int round, bool converged) {
        // The bound of a start that has not converged may be too large by this factor, squared;
        // a lower rate gives up what would succeed (PIE-14).
        constexpr double kStartFactor = 9.0, kRate = 20.0;
        const double factor = converged ? 1.0 : kStartFactor;
        return sum > factor * tolerance * tolerance * total_weight ||
               best > tolerance * (1.0 + kRate / ((round + 1) * (round + 1)));
    }

    // By what a weight is multiplied after a round.
    static double reweighted(double distance_sq, double largest) {
        return std::sqrt(distance_sq) / largest + 1e-3;
    }
};

struct LawsonResult {
    bool kept = false;        // both distances are within the tolerance, tangent joints are
    double distance = 0.0;    // from the data and the free nodes
    std::vector<Section> sections;
};

// A section this many tolerances away between fixed nodes is hopeless with free ones (PIE-10).
inline constexpr double kWorthFreeing = 6.0;

class LawsonFit {
  public:
    LawsonFit(std::span<const Vec2> data, const std::vector<Section> &sections,
               const ChainEnd &begin, const ChainEnd &end, const LawsonLimits &limits)
        : model_(data, sections, begin, end, limits.tolerance),
          solver_(model_),
          limits_(limits),
          check_(data, limits.tolerance),
          state_(model_.initial_state()) {
        for (const Section &s : sections) has_knots_ |= s.points.size() > s.degree + 1u;
        const std::size_t n = state_.parameters.size();
        weights_.data.assign(n, 1.0);
        weights_.nodes.assign(sections.size() + 1, kNodeWeight);
        weights_.joints = kJointWeight * static_cast<double>(model_.active().size());
        weights_.joint_scale = limits.tolerance / kJointAngle;
    }

    // For a section whose control points and knots mean nothing yet.
    void start_from_parameters() {
        solver_.solve_at_fixed_parameters(state_, weights_);
        solver_.improve(state_, weights_, false, 4, 3e-2);
        started_ = true;
    }

    LawsonResult run() {
        model_.project(state_, 3);
        int stalls = 0, strays = 0;
        for (int round = 0; round < limits_.rounds; ++round) {
            // A start that is good enough, or far too bad, needs no more.
            if (round > 0 || !started_)
                solver_.improve(state_, weights_, has_knots_, round < 2 ? 6 : 4, 2e-2);
            if (model_.size() > 1) model_.reassign(state_);
            double distance = largest_distance(), measure = measured(distance);
            if (model_.thinned() && measure <= limits_.tolerance) {
                use_all_data();
                distance = largest_distance(), measure = measured(distance);
            }
            stalls = measure < 0.995 * best_ ? 0 : stalls + 1;
            if (measure < best_) keep_if_better(measure);
            strays += !kept_ && measure <= limits_.tolerance;
            if (kept_ || out_of_reach(round) || stalls >= LawsonStop::kMostStalls ||
                strays >= limits_.strays || !(distance > 1e-12))
                break;
            if (round > 0 || !started_) reweight(distance);
        }
        if (model_.thinned()) model_.activate_all(best_state_);
        return {kept_, best_, model_.sections(best_state_)};
    }

  private:
    // The largest distance; a joint that turns too far counts as one just beyond the tolerance.
    double measured(double distance) const {
        const double excess = largest_turn() - (model_.exact() ? kExactTurn : kLargestTurn);
        if (!(excess > 0.0)) return distance;
        return std::max(distance, 1.001 * limits_.tolerance) * (1.0 + 0.02 * excess);
    }

    // What the active data allow is tried on all: each weighs as the active one before it.
    void use_all_data() {
        const std::vector<Index> active(model_.active().begin(), model_.active().end());
        for (std::size_t k = 0; k < active.size(); ++k) {
            const Index end = k + 1 < active.size() ? active[k + 1] - model_.base()
                                                    : static_cast<Index>(weights_.data.size());
            for (Index j = active[k] - model_.base() + 1; j < end; ++j)
                weights_.data[j] = weights_.data[j - 1];
        }
        weights_.joints *= static_cast<double>(weights_.data.size()) / active.size();
        model_.activate_all(state_);
        model_.project(state_, 3);
        best_ = std::numeric_limits<double>::infinity();
    }

    // Degrees that a tangent joint may turn.
    static constexpr double kLargestTurn = 1.0, kExactTurn = 0.02;
    static constexpr double kNodeWeight = 0.1, kLeastDataWeight = 1e-4, kLeastNodeWeight = 1e-2;
    static constexpr double kJointWeight = 0.2, kJointGrowth = 1.3, kJointAngle = 2.0 / 57.3;

    double largest_distance() const {
        double worst = 0.0;
        for (const Index j : model_.active())
            worst = std::max(worst, state_.distances_sq[j - model_.base()]);
        for (std::size_t i = 0; i <= model_.size(); ++i)
            if (model_.node_free(i)) worst = std::max(worst, state_.node_distances_sq[i]);
        return std::sqrt(worst);
    }

    // Degrees, by the sine; 90 for a joint that turns back.
    double largest_turn() const {
        double worst = 0.0;
        for (const std::size_t i : model_.tangent_joints())
            worst = std::max(worst, std::fabs(model_.joint_term(state_, i, 1.0).residual));
        return std::asin(std::min(worst, 1.0)) * 57.29577951308232;
    }

    void keep_if_better(double measure) {
        bool within = false;
        if (measure <= limits_.tolerance) {
            within = model_.reverse_distance(state_, check_) <= limits_.tolerance;
            if (!within && best_ <= limits_.tolerance) return;
        }
        best_ = measure;
        kept_ = within;
        best_state_ = state_;
    }

    bool out_of_reach(int round) const {
        double sum = 0.0, total = 0.0;
        for (const Index j : model_.active()) {
            sum += weights_.data[j - model_.base()] * state_.distances_sq[j - model_.base()];
            total += weights_.data[j - model_.base()];
        }
        for (std::size_t i = 0; i <= model_.size(); ++i) {
            if (!model_.node_free(i)) continue;
            sum += weights_.nodes[i] * state_.node_distances_sq[i];
            total += weights_.nodes[i];
        }
        return LawsonStop::out_of_reach(sum, total, best_, limits_.tolerance, round,
                                        round > 0 || !started_);
    }

    void reweight(double distance) {
        double total = 0.0;
        for (const Index at : model_.active()) {
            const Index j = at - model_.base();
            total += weights_.data[j] *= LawsonStop::reweighted(state_.distances_sq[j], distance);
        }
        for (std::size_t i = 0; i <= model_.size(); ++i)
            total += weights_.nodes[i] *=
                LawsonStop::reweighted(state_.node_distances_sq[i], distance);
        const double scale = static_cast<double>(model_.active().size()) / total;
        for (const Index at : model_.active()) {
            double &w = weights_.data[at - model_.base()];
            w = std::max(w * scale, kLeastDataWeight);
        }
        for (double &w : weights_.nodes) w = std::max(w * scale, kLeastNodeWeight);
        weights_.joints *= kJointGrowth;
    }

    ChainModel model_;
    ChainSolver solver_;
    LawsonLimits limits_;
    ReverseCheck check_;
    ChainState state_, best_state_ = state_;
    ChainWeights weights_;
    bool has_knots_ = false, kept_ = false, started_ = false;
    double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace shapespline::pieces
