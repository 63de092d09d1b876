// Pieces laid end to end as one clamped B-spline over [0, 1], the same curve.
//
// Where tangents agree the widths of the parameter intervals are chosen so that speeds agree, too:
// the curve is C1 there and has one knot less. Any other node is a knot of full multiplicity.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "shapespline/base/length.hpp"
#include "shapespline/curve/piece_row.hpp"

namespace shapespline {

// Control points of a Bezier with a higher degree. Products and sums are fused: the same bits
// wherever it runs.
inline std::vector<Vec2> elevated(std::span<const Vec2> points, int degree) {
    const auto choose = [](int n, int k) {
        double count = k < 0 || k > n ? 0.0 : 1.0;
        for (int i = 0; i < k && count > 0.0; ++i) count = count * (n - i) / (i + 1);
        return count;
    };
    const int p = static_cast<int>(points.size()) - 1;
    std::vector<Vec2> raised(degree + 1);
    for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= std::min(i, p); ++j) {
            const double share = choose(p, j) * choose(degree - p, i - j) / choose(degree, i);
            raised[i].x = std::fma(share, points[j].x, raised[i].x);
            raised[i].y = std::fma(share, points[j].y, raised[i].y);
        }
    return raised;
}

class JoinedPieces {
  public:
    // Pieces of a lower degree are Beziers. Directions that differ by less than `same` radians are
    // one tangent.
    JoinedPieces(const std::vector<PieceView<const Vec2>> &row, int degree, double same)
        : degree_(degree), same_(same) {
        for (const PieceView<const Vec2> &piece : row) {
            const int p = piece.degree;
            Raised raised;
            if (p < degree) raised.points = elevated(piece.points, degree);
            else raised.points.assign(piece.points.begin(), piece.points.end());
            const std::span<const double> knots = piece.knots;
            raised.inner.assign(knots.begin() + p + 1, knots.end() - p - 1);
            raised.first_gap = knots[p + 1] - knots[p];
            raised.last_gap = knots[knots.size() - p - 1] - knots[knots.size() - p - 2];
            for (std::size_t i = 1; i < raised.points.size(); ++i)
                raised.length += length(raised.points[i] - raised.points[i - 1]);
            n_inner_ += raised.inner.size();
            pieces_.push_back(std::move(raised));
        }
        choose_widths();
    }

    std::size_t n_points() const {
        const auto n_smooth = std::count(smooth_.begin(), smooth_.end(), 1);
        return 1 + pieces_.size() * degree_ + n_inner_ - n_smooth;
    }

    void write(double *knots, Vec2 *points) const {
        const double total = std::accumulate(widths_.begin(), widths_.end(), 0.0);
        knots = std::fill_n(knots, degree_ + 1, 0.0);
        *points++ = pieces_.front().points.front();
        double along = 0.0, begin = 0.0;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const bool is_last = i + 1 == pieces_.size();
            const int drop = is_last ? 0 : smooth_[i + 1];
            along += widths_[i];
            const double end = is_last ? 1.0 : along / total;
            for (const double u : pieces_[i].inner) *knots++ = begin + u * (end - begin);
            knots = std::fill_n(knots, is_last ? degree_ + 1 : degree_ - drop, end);
            const std::vector<Vec2> &own = pieces_[i].points;
            points = std::copy(own.begin() + 1, own.end() - drop, points);
            begin = end;
        }
    }

  private:
    // Control points beside a node that are closer to it than this part of the others leave the
    // node a full knot; so does a parameter interval so many times as long, or short, as the piece
    // asks for (GEO-11).
    static constexpr double kLargestRatio = 1e5, kMostUneven = 10.0;
    // Parameter intervals are at least this part of all, so that their sums can be told apart
    // (GEO-08).
    static constexpr double kLeastPart = 1e-12;

    struct Raised {
        std::vector<Vec2> points;
        std::vector<double> inner;  // knots
        double first_gap = 0.0, last_gap = 0.0, length = 0.0;

        Vec2 first_leg() const { return points[1] - points[0]; }
        Vec2 last_leg() const { return points.back() - points[points.size() - 2]; }
    };

    // Widths are lengths of polygons, scaled along smooth chains so that speeds agree; a piece that
    // would be so much faster or slower than its length asks for begins a chain of its own.
    void choose_widths() {
        widths_.push_back(pieces_.front().length);
        smooth_.push_back(0);
        for (std::size_t i = 1; i < pieces_.size(); ++i) {
            const Raised &before = pieces_[i - 1], &piece = pieces_[i];
            const double u = shapespline::length(before.last_leg());
            const double v = shapespline::length(piece.first_leg());
            const bool goes_on = degree_ > 1 && same_way(before, piece) &&
                                 u < kLargestRatio * v && v < kLargestRatio * u;
            const double width =
                goes_on ? widths_.back() * before.last_gap * v / u / piece.first_gap : piece.length;
            const bool is_even =
                piece.length <= kMostUneven * width && width <= kMostUneven * piece.length;
            smooth_.push_back(goes_on && is_even);
            widths_.push_back(is_even ? width : piece.length);
        }
        const double total = std::accumulate(widths_.begin(), widths_.end(), 0.0);
        if (*std::min_element(widths_.begin(), widths_.end()) < kLeastPart * total) apart();
    }
    bool same_way(const Raised &before, const Raised &piece) const {
        const Vec2 arriving = before.last_leg(), leaving = piece.first_leg();
        return std::fabs(std::atan2(cross(arriving, leaving), dot(arriving, leaving))) < same_;
    }
    // No node smooth, and no interval shorter than can be told.
    void apart() {
        double total = 0.0;
        for (const Raised &piece : pieces_) total += piece.length;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            smooth_[i] = 0;
            widths_[i] = std::max(pieces_[i].length, kLeastPart * total);
        }
    }

    int degree_;
    double same_;
    std::size_t n_inner_ = 0;
    std::vector<Raised> pieces_;
    std::vector<double> widths_;
    std::vector<char> smooth_;  // whether a piece goes on as fast as the one before ends
};

}  // namespace shapespline
