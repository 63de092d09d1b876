// Minimax fit of one quadratic or cubic Bezier between two nodes that are fixed.
//
// The search asks thousands of times how far a section reaches, so this case has its own least
// squares. Rounds and bounds are those of `LawsonFit`; what the other data add to a few active
// ones is found by Remez exchange (1934): those that are too far become active.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "shapespline/pieces/bezier_squares.hpp"
#include "shapespline/pieces/lawson.hpp"

namespace shapespline::pieces {

template <int Degree>
class BezierFit {
  public:
    BezierFit(std::span<const Vec2> data, const Section &start, const LawsonLimits &limits)
        : data_(data),
          start_(start),
          limits_(limits),
          check_(data, limits.tolerance),
          squares_(points_of(start)) {
        const Index stride = std::max<Index>(1, start.count() / kActive);
        for (Index j = 0; j < start.count(); j += stride) {
            squares_.insert(squares_.size(), datum(j), start.parameters[j], 1.0);
            active_.push_back(j);
        }
    }

    // Whether both distances can be brought within the tolerance.
    bool succeeds() {
        squares_.solve_at_fixed_parameters();
        squares_.improve(4, 3e-2);
        int stalls = 0, strays = 0;
        for (int round = 0; round < limits_.rounds; ++round) {
            // A start that is good enough, or far too bad, needs no more.
            if (round > 0) squares_.improve(round < 2 ? 6 : 4, 2e-2);
            const double distance = active_distance();
            const bool all_seen = distance <= limits_.tolerance;
            const double measure = all_seen ? distance_of_all() : distance;
            stalls = measure < 0.995 * best_ ? 0 : stalls + 1;
            if (measure < best_) keep_if_better(measure);
            strays += !kept_ && measure <= limits_.tolerance;
            if (kept_ || out_of_reach(round) || stalls >= LawsonStop::kMostStalls ||
                strays >= limits_.strays || !(distance > 1e-12))
                break;
            if (all_seen && measure > limits_.tolerance && !exchange(measure)) break;
            if (round > 0) reweight();
        }
        return kept_;
    }

    // The best section found, with the feet of all its data.
    LawsonResult run() {
        succeeds();
        if (!kept_) {
            squares_.move_to(best_points_);
            distance_of_all();
        }
        LawsonResult result{kept_, best_, {start_}};
        Section &section = result.sections.front();
        section.points.assign(best_points_.begin(), best_points_.end());
        section.parameters = parameters_;
        return result;
    }

  private:
    using Squares = BezierSquares<Degree>;
    static constexpr Index kActive = 6 + 3 * Degree;
    static constexpr int kFootSteps = 3;
    static constexpr double kLeastWeight = 1e-4;
    static constexpr double kFootPart = 1e-4;  // of the squared tolerance, see improve_feet

    static typename Squares::Points points_of(const Section &section) {
        typename Squares::Points points;
        std::copy(section.points.begin(), section.points.end(), points.begin());
        return points;
    }

    Vec2 datum(Index j) const { return data_[start_.first + j]; }
    Feet feet() { return {parameters_.data(), spans_.data(), distances_sq_.data()}; }

    double active_distance() const {
        double worst = 0.0;
        for (int i = 0; i < squares_.size(); ++i)
            worst = std::max(worst, squares_.distance_sq(i));
        return std::sqrt(worst);
    }

    // The same of all data, whose feet start between those of the active ones.
    double distance_of_all() {
        const Index n = start_.count();
        if (every_.empty()) {
            distances_sq_.resize(n);
            spans_.assign(n, 0);
            every_.resize(n);
            std::iota(every_.begin(), every_.end(), Index{0});
        }
        parameters_ = start_.parameters;
        const int last = squares_.size() - 1;
        for (int i = 0; i < last; ++i) {
            const Index a = active_[i], b = active_[i + 1];
            const double u = squares_.parameter(i);
            const double rise = (squares_.parameter(i + 1) - u) / static_cast<double>(b - a);
            for (Index j = a; j < b; ++j) parameters_[j] = u + rise * static_cast<double>(j - a);
        }
        for (Index j = active_[last]; j < n; ++j)
            parameters_[j] = std::max(parameters_[j], squares_.parameter(last));
        polynomial_ = squares_.polynomial();
        improve_feet(&polynomial_, 1, data_.data() + start_.first, every_, 0, kFootSteps,
                     kFootPart * limits_.tolerance * limits_.tolerance, feet());
        return std::sqrt(*std::max_element(distances_sq_.begin(), distances_sq_.end()));
    }

    // Between active data those that are farthest, if they are too far, become active, with the
    // weight of the one before; false if they are too many. What was best so far was so for some.
    bool exchange(double distance) {
        std::vector<Index> fresh;
        for (std::size_t i = 0; i < active_.size(); ++i) {
            const auto begin = distances_sq_.begin() + active_[i] + 1;
            const auto end = i + 1 < active_.size() ? distances_sq_.begin() + active_[i + 1]
                                                    : distances_sq_.end();
            const auto worst = std::max_element(begin, end);
            if (worst != end && *worst > limits_.tolerance * limits_.tolerance)
                fresh.push_back(worst - distances_sq_.begin());
        }
        if (squares_.size() + fresh.size() > Squares::kMostData) return false;
        for (const Index j : fresh) {
            const auto at = std::upper_bound(active_.begin(), active_.end(), j);
            const int i = static_cast<int>(at - active_.begin());
            squares_.insert(i, datum(j), parameters_[j], squares_.weight(i - 1));
            active_.insert(at, j);
        }
        squares_.project(1);
        best_ = distance;
        best_points_ = squares_.points();
        return true;
    }

    void keep_if_better(double measure) {
        bool within = false;
        if (measure <= limits_.tolerance) {
            within = check_.distance(&polynomial_, 1, feet(), start_.first, start_.last) <=
                     limits_.tolerance;
            if (!within && best_ <= limits_.tolerance) return;
        }
        best_ = measure;
        kept_ = within;
        best_points_ = squares_.points();
    }

    bool out_of_reach(int round) const {
        return LawsonStop::out_of_reach(squares_.cost(), squares_.total_weight(), best_,
                                        limits_.tolerance, round, round > 0);
    }

    void reweight() {
        const double distance = active_distance();
        double total = 0.0;
        for (int i = 0; i < squares_.size(); ++i) {
            const double factor = LawsonStop::reweighted(squares_.distance_sq(i), distance);
            squares_.set_weight(i, factor * squares_.weight(i));
            total += squares_.weight(i);
        }
        const double scale = squares_.size() / total;
        for (int i = 0; i < squares_.size(); ++i)
            squares_.set_weight(i, std::max(scale * squares_.weight(i), kLeastWeight));
    }

    std::span<const Vec2> data_;
    const Section &start_;
    LawsonLimits limits_;
    ReverseCheck check_;
    Squares squares_;
    std::vector<Index> active_;  // numbers of the data in the squares, ascending
    typename Squares::Points best_points_;
    double best_ = std::numeric_limits<double>::infinity();
    bool kept_ = false;
    // Of all data, once the active ones allow the tolerance.
    SpanPolynomial polynomial_;
    std::vector<double> parameters_, distances_sq_;
    std::vector<int> spans_;
    std::vector<Index> every_;
};

}  // namespace shapespline::pieces
