// What a smooth free-form curve leaves of a stretch of points: quintics in arc length, which follow
// what a cubic Bezier can and are found without looking for feet. Chords telescope, so a point
// shifted along the outline shifts its arc length alike and leaves nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "shapespline/base/pair.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline::drawn {

struct FreeForm {
    double sum_sq = 0.0;
    Vec2 begin, end;  // tangents, not normalised
};

// Sums over a growing stretch of points, from one point on.
class GrowingQuintic {
  public:
    static constexpr int kTerms = 6;

    // `unit` makes arc lengths of order one.
    GrowingQuintic(Vec2 origin, double station, double unit)
        : origin_(origin), station_(station), unit_(unit) {}

    void add(Vec2 point, double station, double weight) {
        const Vec2 p = point - origin_;
        const Pair xy{p.x, p.y};
        const double u = (station - station_) / unit_;
        Pair power{weight, weight * u};  // two neighbouring ones
        for (int k = 0; k < kTerms; ++k, power = u * u * power) {
            powers_.pair(k) += power;
            if (2 * k < kTerms) {
                moments_[2 * k] += power[0] * xy;
                moments_[2 * k + 1] += power[1] * xy;
            }
        }
        squares_ += weight * norm_sq(p);
        last_ = u;
    }

    // Least squares over what was added, tangents at two arc lengths.
    FreeForm solved(double begin, double end) const {
        // Powers of u / last, which run to one.
        std::array<double, 2 * kTerms - 1> scale{};
        scale[0] = 1.0;
        for (std::size_t k = 1; k < scale.size(); ++k) scale[k] = scale[k - 1] / last_;
        std::array<std::array<double, kTerms>, kTerms> l{};
        std::array<Pair, kTerms> c{};
        double left = squares_;
        for (int i = 0; i < kTerms; ++i) {
            for (int j = 0; j <= i; ++j) {
                double sum = powers_[i + j] * scale[i + j];
                for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
                // The diagonal is inverted.
                l[i][j] = i == j ? 1.0 / std::sqrt(std::max(sum, 1e-30 * powers_[0]))
                                 : sum * l[j][j];
            }
            c[i] = scale[i] * moments_[i];
            for (int k = 0; k < i; ++k) c[i] = c[i] - l[i][k] * c[k];
            c[i] = l[i][i] * c[i];
            left -= sum(c[i] * c[i]);
        }
        for (int i = kTerms - 1; i >= 0; --i) {
            for (int k = i + 1; k < kTerms; ++k) c[i] = c[i] - l[k][i] * c[k];
            c[i] = l[i][i] * c[i];
        }
        const auto slope = [&](double station) {
            const double u = (station - station_) / unit_ / last_;
            Pair found{0.0, 0.0};
            double power = 1.0;
            for (int k = 1; k < kTerms; ++k, power *= u) found += k * power * c[k];
            return Vec2{found[0], found[1]};
        };
        return {std::max(left, 0.0), slope(begin), slope(end)};
    }

  private:
    Vec2 origin_;
    double station_, unit_, last_ = 1.0;
    PairArray<2 * kTerms> powers_{};        // of u, times weights
    std::array<Pair, kTerms> moments_{};    // those of x and y
    double squares_ = 0.0;
};

}  // namespace shapespline::drawn
