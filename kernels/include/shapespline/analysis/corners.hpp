// Corners of an outline: where its direction jumps, at more than one length and above its noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/analysis/corner_turn.hpp"
#include "shapespline/analysis/stations.hpp"

namespace shapespline::analysis {

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

// A corner of the data turns at least this much over the lengths below, radians; what turns less
// than the second has a low turn, and is not looked at again. Neither is about joints of a curve:
// those are smooth by the values' SMOOTH_TURN (PIE-13, PIE-22).
inline constexpr double kLeastTurn = radians(25.0), kLowTurn = radians(8.0);

class CornerSearch {
  public:
    // `arc_length` at the vertices of the polyline, the deviation `sigma` of the points across it;
    // what is smaller than a few tolerances is no feature. `turns` gets the turn of every point
    // over the length; where that is not low the smallest of those over several lengths.
    CornerSearch(std::span<const Vec2> points, bool closed, std::span<const double> arc_length,
                 double sigma, double tolerance, std::span<double> turns)
        : points_(points), closed_(closed), turns_(turns) {
        const std::vector<double> stations =
            smoothed_stations(points, closed, arc_length, sigma);
        along_.assign(stations.begin(), stations.begin() + static_cast<long>(points.size()));
        const double total = stations.back();
        lap_ = closed ? total : std::numeric_limits<double>::infinity();
        const double spacing = median(steps_between(stations));
        const double noise_length =
            std::pow(kNoiseFactor * sigma * std::sqrt(spacing), 2.0 / 3.0);
        const double longest = kLongestPart * total;
        const double shortest = std::max(kSteps * spacing, noise_length);
        const double close = std::max(shortest, kCloseTolerances * tolerance);
        length_ = std::min(std::max(shortest, kTolerances * tolerance), longest);
        lay_out(stations);
        measure({std::min(2.0 * length_, longest), close});
        indices_ = separated_maxima(kApart * length_);
        if (close == shortest) drop_bends();  // no look from nearer
    }

    const std::vector<Index> &indices() const { return indices_; }
    double length() const { return length_; }

  private:
    // The test looks at a length on either side: at least so many median steps and tolerances
    // (ANA-03).
    static constexpr int kHalf = 5;
    static constexpr double kSteps = kHalf, kTolerances = 8.0;
    // A bend that is round within the first number of tolerances is no corner. The test looks so
    // near where that is less than the second part of the length above (ANA-04).
    static constexpr double kCloseTolerances = 2.0, kCloser = 0.65;
    // A parabola over a length L sampled at spacing d with noise sigma has a slope error of about
    // sigma sqrt(d / L^3) times a constant; this one makes it a small part of kLeastTurn.
    static constexpr double kNoiseFactor = 132.0;
    // Lengths beyond this part of the outline look past its features.
    static constexpr double kLongestPart = 0.125;
    // Around a bend that the points resolve the curvature changes by no more than this part of its
    // peak from one to the next; at a corner it springs up, and where a line runs into an arc
    // (ANA-05).
    static constexpr double kGradualPart = 0.45;
    // Corners keep this part of the length apart.
    static constexpr double kApart = 0.6;

    struct Lengths {
        double longer, closer;
    };

    // One function of arc length: three laps of a closed outline.
    void lay_out(std::span<const double> stations) {
        if (!closed_) {
            all_points_.assign(points_.begin(), points_.end());
            all_stations_.assign(stations.begin(), stations.end());
            return;
        }
        for (const double shift : {-lap_, 0.0, lap_}) {
            all_points_.insert(all_points_.end(), points_.begin(), points_.end());
            for (const double s : along_) all_stations_.push_back(s + shift);
        }
    }

    // The turns of all points, and those that are not low over other lengths, too.
    void measure(const Lengths &others) {
        std::vector<Index> every(points_.size());
        for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<Index>(i);
        const std::vector<double> fine = jumps(every, length_);
        std::vector<Index> abrupt;
        for (std::size_t i = 0; i < fine.size(); ++i) {
            turns_[i] = std::fabs(fine[i]);
            if (turns_[i] >= kLowTurn) abrupt.push_back(static_cast<Index>(i));
        }
        const auto look = [&](double length) {
            const std::vector<double> again = jumps(abrupt, length);
            for (std::size_t k = 0; k < abrupt.size(); ++k) {
                double &turn = turns_[abrupt[k]];
                const bool agree = again[k] * fine[abrupt[k]] > 0.0;
                turn = agree ? std::min(turn, std::fabs(again[k])) : 0.0;
            }
        };
        look(others.longer);
        if (others.closer < kCloser * length_) look(others.closer);
    }

    // Signed angles between the one-sided tangents at some points.
    std::vector<double> jumps(std::vector<Index> at, double length) const {
        if (closed_)
            for (Index &i : at) i += static_cast<Index>(points_.size());
        std::vector<double> turns(at.size());
        corner_turns({all_points_, all_stations_}, at, length, turns.data());
        return turns;
    }

    // Distance along the outline, the shorter way round a closed one.
    double gap(Index i, Index j) const {
        const double way = std::fabs(along_[i] - along_[j]);
        return std::min(way, lap_ - way);
    }

    // Points that turn enough and most within `apart` along the outline, the sharpest first.
    std::vector<Index> separated_maxima(double apart) const {
        std::vector<Index> enough;
        for (std::size_t i = 0; i < turns_.size(); ++i)
            if (turns_[i] >= kLeastTurn) enough.push_back(static_cast<Index>(i));
        // Most turn less than the one before or behind.
        const auto less = [&](std::size_t k, std::size_t other) {
            return std::fabs(along_[enough[k]] - along_[enough[other]]) <= apart &&
                   turns_[enough[k]] < turns_[enough[other]];
        };
        std::vector<Index> peaks;
        for (std::size_t k = 0; k < enough.size(); ++k)
            if (!(k + 1 < enough.size() && less(k, k + 1)) && !(k > 0 && less(k, k - 1)))
                peaks.push_back(enough[k]);
        std::stable_sort(peaks.begin(), peaks.end(),
                         [&](Index a, Index b) { return turns_[a] > turns_[b]; });
        std::vector<Index> chosen;
        for (const Index i : peaks) {
            const auto is_beside = [&](Index j) { return gap(j, i) <= apart; };
            const auto is_sharper = [&](Index j) { return turns_[j] > turns_[i] && is_beside(j); };
            if (std::none_of(chosen.begin(), chosen.end(), is_beside) &&
                std::none_of(enough.begin(), enough.end(), is_sharper))
                chosen.push_back(i);
        }
        std::sort(chosen.begin(), chosen.end());
        return chosen;
    }

    // Corners around which the curvature rises and falls gradually are bends.
    void drop_bends() {
        const auto bends = std::stable_partition(indices_.begin(), indices_.end(),
                                                 [&](Index corner) { return !is_bend(corner); });
        for (auto bend = bends; bend != indices_.end(); ++bend)
            for (std::size_t i = 0; i < along_.size(); ++i)
                if (gap(static_cast<Index>(i), *bend) <= length_) turns_[i] = 0.0;
        indices_.erase(bends, indices_.end());
    }

    bool is_bend(Index corner) const {
        double jump = 0.0, peak = 0.0, before = 0.0;
        for (int k = -kHalf; k <= kHalf; ++k) {
            const double here = curvature(corner + k);
            if (k > -kHalf) jump = std::max(jump, std::fabs(here - before));
            if (std::abs(k) <= 1) peak = std::max(peak, std::fabs(here));
            before = here;
        }
        return jump <= kGradualPart * peak;
    }

    // At a point beyond the seam, or the last one before an end, where it is 0.
    double curvature(Index i) const {
        const auto n = static_cast<Index>(points_.size());
        if (!closed_ && (i <= 0 || i >= n - 1)) return 0.0;
        const Index at = ((i % n) + n) % n;
        const Vec2 u = points_[at] - points_[(at + n - 1) % n];
        const Vec2 v = points_[(at + 1) % n] - points_[at];
        return 2.0 * std::atan2(cross(u, v), dot(u, v)) /
               (std::hypot(u.x, u.y) + std::hypot(v.x, v.y));
    }

    std::span<const Vec2> points_;
    bool closed_;
    std::span<double> turns_;
    std::vector<double> along_, all_stations_;
    std::vector<Vec2> all_points_;
    double lap_, length_;
    std::vector<Index> indices_;
};

}  // namespace shapespline::analysis
