// A curve as a polyline that is finer and finer towards corners: what meets there may cross beside.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "shapespline/curve/bspline.hpp"

namespace shapespline {

class LineToCorners {
  public:
    // Beside corners chords are shorter and shorter, a quarter of the one before each.
    static constexpr int kQuarters = 10;
    static constexpr std::size_t kMostBeside = 2 * kQuarters;

    // The vertices of a polyline, their parameters, and those of corners.
    LineToCorners(std::span<const Vec2> vertices, std::span<const double> parameters,
                  std::span<const double> corners)
        : vertices_(vertices), parameters_(parameters) {
        const double begin = parameters.front(), end = parameters.back();
        const bool is_ring = vertices.front().x == vertices.back().x &&
                             vertices.front().y == vertices.back().y;
        for (const double corner : corners) {
            const std::size_t n_steps = parameters.size() - 1;
            const auto at = std::lower_bound(parameters.begin(), parameters.end(), corner);
            const std::size_t after =
                std::min(static_cast<std::size_t>(at - parameters.begin()), n_steps) % n_steps;
            for (const bool is_before : {true, false}) {
                double step = this->step(is_before ? (after + n_steps - 1) % n_steps : after);
                for (int k = 0; k < kQuarters; ++k) {
                    step *= 0.25;
                    const double u = is_before ? corner - step : corner + step;
                    more_.push_back(is_ring && u < begin ? u + end - begin : u);  // the seam
                }
            }
        }
        std::sort(more_.begin(), more_.end());
        more_.erase(std::unique(more_.begin(), more_.end()), more_.end());
        std::erase_if(more_, [&](double u) {
            return !(u > begin && u < end) ||
                   std::binary_search(parameters.begin(), parameters.end(), u);
        });
    }

    // All vertices in order, at most kMostBeside for each corner more than there were; how many.
    std::size_t write(const Knots &knots, std::span<const Vec2> coefficients, Vec2 *out) const {
        std::vector<Vec2> added(more_.size());
        evaluate(knots, coefficients, more_, added.data());
        std::size_t k = 0;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            while (k < more_.size() && more_[k] < parameters_[i]) *out++ = added[k++];
            *out++ = vertices_[i];
        }
        return vertices_.size() + more_.size();
    }

  private:
    double step(std::size_t i) const { return parameters_[i + 1] - parameters_[i]; }

    std::span<const Vec2> vertices_;
    std::span<const double> parameters_;
    std::vector<double> more_;
};

}  // namespace shapespline
