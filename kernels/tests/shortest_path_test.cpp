// The shortest path over the feasibility graph against every path there is.
#include <limits>

#include "check.hpp"
#include "shapespline/pieces/shortest_path.hpp"

using namespace shapespline::pieces;

namespace {

struct Graph {
    std::vector<FeasibleExtension> extensions;
    std::vector<Joint> nodes;
    JointCosts costs;
};

double joint_cost(const Graph &graph, std::size_t node, bool line_before, bool line_after) {
    if (graph.nodes[node].corner || graph.nodes[node].required) return 0.0;
    if (!line_before && !line_after) return graph.costs.any + graph.costs.curve_curve;
    if (line_before && line_after) return graph.costs.any + graph.costs.line_line;
    return graph.costs.any;
}

// The least cost from a node to the end, over all edges; `before` is -1 at the start, else 1
// behind a line.
double least_by_trying(const Graph &graph, std::size_t begin, std::size_t node, std::size_t end,
                       int before) {
    if (node == end) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (const FeasibleExtension &extension : graph.extensions)
        for (std::size_t to = node + 1; to <= std::min(end, extension.last[node]); ++to) {
            const bool line = extension.cost == 1;
            const double joint =
                node == begin ? 0.0 : joint_cost(graph, node, before == 1, line);
            least = std::min(least, joint + extension.cost +
                                        least_by_trying(graph, begin, to, end, line));
        }
    return least;
}

Graph random_graph(std::mt19937 &random, std::size_t n) {
    Graph graph{{}, std::vector<Joint>(n), {0.02, 0.3, 0.4}};
    for (Joint &node : graph.nodes) node.corner = random() % 4 == 0;
    for (int cost = 1; cost <= 3; ++cost) {
        FeasibleExtension extension{cost, std::vector<std::size_t>(n)};
        std::size_t last = 1;
        for (std::size_t k = 0; k < n; ++k) {
            last = std::min(n - 1, std::max(last, k + 1) + random() % (1 + cost));
            extension.last[k] = last;
        }
        graph.extensions.push_back(extension);
    }
    return graph;
}

}  // namespace

TEST(no_path_is_cheaper) {
    std::mt19937 random(8);
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t n = 3 + random() % 7, begin = random() % 2, end = n - 1;
        const Graph graph = random_graph(random, n);
        const Path path = PathSearch(graph.extensions, graph.nodes, graph.costs).run(begin, end);
        CHECK_NEAR(path.cost, least_by_trying(graph, begin, begin, end, -1), 1e-12);
        double cost = 0.0;
        std::size_t at = begin;
        int before = -1;
        for (const PathStep &step : path.steps) {
            const FeasibleExtension &extension = graph.extensions[step.extension];
            CHECK(step.from == at && step.to > at && step.to <= extension.last[at]);
            const bool line = extension.cost == 1;
            if (at != begin) cost += joint_cost(graph, at, before == 1, line);
            cost += extension.cost;
            before = line;
            at = step.to;
        }
        CHECK(at == end);
        CHECK_NEAR(cost, path.cost, 1e-12);
    }
}
