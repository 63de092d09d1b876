// Points on a curve so dense that the chords between them stay near it (Wang 1984).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "shapespline/base/pairwise_sum.hpp"
#include "shapespline/curve/bezier.hpp"

namespace shapespline {

// A chord over a step h of the parameter strays from the curve by no more than h^2 / 8 times the
// largest second derivative, which the second differences of the control points bound (Wang 1984).
// Returns how many equal steps a piece asks for so that its chords stray by `distance` at most and
// none is longer than `longest`.
template <int Degree>
double steps_wanted(std::span<const Vec2> piece, double distance, double longest) {
    double length = 0.0, second_sq = 0.0;
    for (int i = 1; i <= Degree; ++i) length += norm(piece[i] - piece[i - 1]);
    for (int i = 2; i <= Degree; ++i)
        second_sq = std::max(second_sq,
                             norm_sq((piece[i] - piece[i - 1]) - (piece[i - 1] - piece[i - 2])));
    return std::max(length / longest, std::sqrt(Degree * (Degree - 1) * std::sqrt(second_sq) /
                                                (8.0 * distance)));
}

// Every Bezier piece of a curve cut at so many steps.
class Flattening {
  public:
    // Chordal distance where the caller names none, of the box diagonal of the outline, and the
    // largest that is taken (GEO-01).
    static constexpr double kSampling = 1e-4, kCoarsest = 1e-2;

    // Chords within `sampling` of the curve, none longer than `longest`, a part of the diagonal of
    // its box.
    Flattening(const Knots &knots, std::span<const Vec2> coefficients,
               std::optional<double> sampling, double longest)
        : degree_(knots.degree) {
        dispatch_degree(degree_, [&]<int Degree>() {
            for (const Bezier<Degree> &piece : bezier_pieces<Degree>(knots, coefficients)) {
                points_.insert(points_.end(), piece.points.begin(), piece.points.end());
                breakpoints_.push_back(piece.begin);
                last_ = piece.end;
            }
        });
        breakpoints_.push_back(last_);
        Vec2 low = points_[0], high = points_[0];
        for (const Vec2 p : points_) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        diagonal_ = std::hypot(high.x - low.x, high.y - low.y);
        const double distance =
            std::min(sampling.value_or(kSampling * diagonal_), kCoarsest * diagonal_);
        find_steps(distance, longest * diagonal_);
    }

    double diagonal() const { return diagonal_; }
    // Steps that all pieces ask for, not yet whole: more than anybody means if the unit is wrong.
    double wanted() const { return pairwise_sum(wanted_); }

    std::size_t n_points() const {
        std::size_t count = 1;
        for (std::size_t s = 0; s < wanted_.size(); ++s) count += n_steps(s);
        return count;
    }

    // The points where steps begin, then the last one of all, and their parameters.
    void write(Vec2 *points, double *parameters) const {
        dispatch_degree(degree_, [&]<int Degree>() {
            for (std::size_t s = 0; s < wanted_.size(); ++s) {
                Bezier<Degree> piece;
                std::copy_n(points_.begin() + s * (Degree + 1), Degree + 1,
                            piece.points.begin());
                const std::size_t n = n_steps(s);
                const double count = static_cast<double>(n);
                const double step = (breakpoints_[s + 1] - breakpoints_[s]) / count;
                for (std::size_t i = 0; i < n; ++i) {
                    *points++ = piece.at(static_cast<double>(i) / count).point;
                    *parameters++ = breakpoints_[s] + static_cast<double>(i) * step;
                }
            }
        });
        *points = points_.back();
        *parameters = last_;
    }

  private:
    // Straight spans that turn by no more than this, radians, from one to the next, neither so many
    // times as long as the other, are chords of a curve: its points are their ends alone (GEO-12).
    static constexpr double kChordTurn = 20.0 * (std::numbers::pi / 180.0), kChordRatio = 3.0;
    // Bends of less than this part of the box diagonal and turns of less are roundings (GEO-12).
    static constexpr double kStraight = 1e-9;

    std::span<const Vec2> piece(std::size_t s) const {
        return std::span(points_).subspan(s * (degree_ + 1), degree_ + 1);
    }
    std::size_t n_steps(std::size_t s) const {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(wanted_[s])));
    }

    void find_steps(double distance, double longest) {
        const std::size_t n = breakpoints_.size() - 1;
        const double least = kStraight * diagonal_;
        dispatch_degree(degree_, [&]<int Degree>() {
            for (std::size_t s = 0; s < n; ++s)
                wanted_.push_back(steps_wanted<Degree>(piece(s), distance, longest));
        });
        const Vec2 gap = points_.back() - points_.front();
        const bool is_ring = std::hypot(gap.x, gap.y) <= least;
        bool begins_straight = is_straight(piece(0), least);
        for (std::size_t s = 0; s < n; ++s) {
            const std::size_t next = (s + 1) % n;
            const bool goes_on_straight = is_straight(piece(next), least);
            if (begins_straight && goes_on_straight && (next > 0 || is_ring) &&
                bends_on(piece(s), piece(next)))
                wanted_[s] = wanted_[next] = 1.0;
            begins_straight = goes_on_straight;
        }
    }

    static bool is_straight(std::span<const Vec2> piece, double least) {
        const Vec2 along = piece.back() - piece.front();
        const double length = std::hypot(along.x, along.y);
        return length > least &&
               std::all_of(piece.begin() + 1, piece.end() - 1, [&](Vec2 inner) {
                   return std::fabs(cross(inner - piece.front(), along)) <= least * length;
               });
    }

    // Whether a straight piece goes on in the next one like the chords of a curve do.
    static bool bends_on(std::span<const Vec2> piece, std::span<const Vec2> next) {
        const Vec2 u = piece.back() - piece.front(), v = next.back() - next.front();
        const auto [shorter, longer] =
            std::minmax({std::hypot(u.x, u.y), std::hypot(v.x, v.y)});
        if (!(longer <= kChordRatio * shorter)) return false;
        const double turn = std::fabs(std::atan2(cross(u, v), dot(u, v)));
        return turn > kStraight && turn <= kChordTurn;
    }

    int degree_;
    std::vector<Vec2> points_;  // of the Bezier pieces, end to end
    std::vector<double> breakpoints_, wanted_;
    double last_ = 0.0, diagonal_ = 0.0;
};

}  // namespace shapespline
