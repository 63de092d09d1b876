// Shortest path over the feasibility graph: the cheapest sequence of sections from candidate node
// to candidate node, by dynamic programming.
#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "shapespline/pieces/feasible_extension.hpp"

namespace shapespline::pieces {

struct PathStep {
    std::size_t from, to;
    std::size_t extension;  // index of its class
};

struct Path {
    double cost = std::numeric_limits<double>::infinity();
    std::vector<PathStep> steps;
};

// Costs of joints that are no corners, in points. With smooth joints two curves that meet are one
// spline, and two lines meet at corners only.
struct JointCosts {
    double any = 0.02, curve_curve = 0.0, line_line = 0.0;
};

class PathSearch {
  public:
    PathSearch(const std::vector<FeasibleExtension> &extensions, const std::vector<Joint> &nodes,
               const JointCosts &costs)
        : extensions_(extensions), nodes_(nodes), costs_(costs) {}

    // The best path from one candidate to another. The starts that reach a node form a window that
    // only moves forward, for extensions do not fall: a queue of falling values for each class
    // gives its least entry, so the whole costs O(nodes times classes).
    Path run(std::size_t begin, std::size_t end) const {
        std::vector<Label> labels(2 * (end - begin + 1));
        labels[0] = labels[1] = {0.0, begin, 0, 0};
        std::vector<std::deque<Entry>> queues(extensions_.size());
        for (std::size_t j = begin + 1; j <= end; ++j) {
            for (std::size_t r = 0; r < extensions_.size(); ++r) {
                push(queues[r], entry(labels, begin, j - 1, r));
                while (!queues[r].empty() && extensions_[r].last[queues[r].front().from] < j)
                    queues[r].pop_front();
                if (queues[r].empty()) continue;
                const Entry &best = queues[r].front();
                Label &label = labels[2 * (j - begin) + line(r)];
                const double cost = best.cost + extensions_[r].cost;
                if (cost < label.cost) label = {cost, best.from, r, best.state};
            }
        }
        return trace(labels, begin, end);
    }

  private:
    // The best path to a node whose last section is a curve (state 0) or a line (1).
    struct Label {
        double cost = std::numeric_limits<double>::infinity();
        std::size_t from = 0, extension = 0;
        int state = 0;
    };
    struct Entry {
        double cost;
        std::size_t from;
        int state;
    };

    int line(std::size_t r) const { return extensions_[r].cost == 1; }

    Entry entry(const std::vector<Label> &labels, std::size_t begin, std::size_t k,
                std::size_t r) const {
        Entry best{std::numeric_limits<double>::infinity(), k, 0};
        for (int state = 0; state < 2; ++state) {
            const double cost = labels[2 * (k - begin) + state].cost +
                                (k == begin ? 0.0 : joint(nodes_[k], state, line(r)));
            if (cost < best.cost) best = {cost, k, state};
        }
        return best;
    }

    double joint(const Joint &node, int before, int after) const {
        if (node.corner || node.required) return 0.0;
        double cost = costs_.any;
        if (before == 0 && after == 0) cost += costs_.curve_curve;
        if (before == 1 && after == 1) cost += costs_.line_line;
        return cost;
    }

    static void push(std::deque<Entry> &queue, const Entry &entry) {
        while (!queue.empty() && entry.cost < queue.back().cost) queue.pop_back();
        queue.push_back(entry);
    }

    Path trace(const std::vector<Label> &labels, std::size_t begin, std::size_t end) const {
        const auto at = [&](std::size_t k, int state) { return labels[2 * (k - begin) + state]; };
        int state = at(end, 0).cost <= at(end, 1).cost ? 0 : 1;
        Path path{at(end, state).cost, {}};
        for (std::size_t k = end; k > begin;) {
            const Label label = at(k, state);
            path.steps.push_back({label.from, k, label.extension});
            k = label.from;
            state = label.state;
        }
        std::reverse(path.steps.begin(), path.steps.end());
        return path;
    }

    const std::vector<FeasibleExtension> &extensions_;
    const std::vector<Joint> &nodes_;
    JointCosts costs_;
};

}  // namespace shapespline::pieces
