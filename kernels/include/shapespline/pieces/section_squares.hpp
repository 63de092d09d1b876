// Least squares on sections whose kinds and knots are given: the nodes and control points nearest
// to noisy data, joints tangent where they were. Knots that were free would follow the noise.
#pragma once

#include <algorithm>
#include <vector>

#include "shapespline/pieces/chain_solver.hpp"
#include "shapespline/pieces/section_ring.hpp"

namespace shapespline::pieces {

class SectionSquares {
  public:
    // Data as for OutlineSearch: three laps of a closed outline. The noise is the scale of joints.
    SectionSquares(std::span<const Vec2> data, SectionRing &ring, double noise)
        : data_(data), ring_(ring), noise_(noise) {}

    // Twice round a closed outline, from opposite nodes: the one that it is cut at is held.
    void run() {
        if (!ring_.closed()) return fit();
        const long half = ring_.size() / 2;
        for (int round = 0; round < 2; ++round) {
            fit();
            ring_.rotate(half);
            fit();
            ring_.rotate(ring_.size() - half);
        }
    }

  private:
    static constexpr int kRounds = 6, kSteps = 8;
    static constexpr double kEnough = 1e-3, kFootPart = 1e-2;
    // Nodes are drawn to the data a little, so that a piece with few data keeps its place; joints
    // are pulled straight ever more strongly.
    static constexpr double kNodeWeight = 1e-2, kJointWeight = 1.0, kJointGrowth = 4.0;
    static constexpr double kJointAngle = 2.0 / 57.3;

    void fit() {
        const long n = ring_.size();
        const std::vector<Section> sections = ring_.window(0, n - 1);
        ChainModel model(data_, sections, ring_.begin_of(0), ring_.end_before(n),
                         kFootPart * noise_);
        ChainState state = model.initial_state();
        if (model.thinned()) {
            model.project(state, 6);
            model.activate_all(state);
        }
        ChainSolver solver(model);
        ChainWeights weights;
        weights.data.assign(state.parameters.size(), 1.0);
        weights.nodes.assign(sections.size() + 1, kNodeWeight);
        weights.joints = kJointWeight;
        weights.joint_scale = noise_ / kJointAngle;
        model.project(state, 6);
        for (int round = 0; round < kRounds; ++round) {
            solver.improve(state, weights, false, kSteps, kEnough);
            if (n > 1) model.reassign(state);
            weights.joints *= kJointGrowth;
        }
        ring_.replace(0, n - 1, model.sections(state));
    }

    std::span<const Vec2> data_;
    SectionRing &ring_;
    double noise_;
};

// The sections of a smoothed outline, fitted to the points that were observed, index for index.
inline std::vector<Section> fit_observed(std::span<const Vec2> observed, bool closed,
                                         std::vector<Section> sections, double noise) {
    std::vector<Vec2> data;
    for (int lap = 0; lap < (closed ? 3 : 1); ++lap)
        data.insert(data.end(), observed.begin(), observed.end());
    if (closed) data.push_back(observed[0]);
    SectionRing ring(std::move(sections), closed ? static_cast<Index>(observed.size()) : 0, false);
    SectionSquares(data, ring, noise).run();
    return ring.sections();
}

}  // namespace shapespline::pieces
