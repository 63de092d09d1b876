// Whether a section looks like its data: no near-cusp inside, no hook that the data have not.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "shapespline/pieces/section.hpp"

namespace shapespline::pieces {

// A near-cusp: the slowest place of a section has less than a fiftieth of its middle speed. A hook:
// the section turns by more than 90 degrees within one tolerance of its length where the data turn
// by less than 45 within six.
class SectionFairness {
  public:
    SectionFairness(std::span<const Vec2> data, double tolerance)
        : data_(data), tolerance_(tolerance) {}

    bool is_fair(const Section &section) {
        if (section.points.size() < 3 || section.degree == 1) return true;
        const SectionView all = view(section);
        taylor_.resize(all.n_spans());
        spans_.resize(all.n_spans());
        expand_spans(all, taylor_.data(), spans_.data());
        steps_.clear();
        speeds_.clear();
        slowest_ = std::numeric_limits<double>::infinity();
        for (const SpanPolynomial &span : spans_) {
            for (int k = 0; k < kSteps; ++k)
                look(span, span.width * k / kSteps, span.width * (k + 1) / kSteps, kDepth);
        }
        std::nth_element(speeds_.begin(), speeds_.begin() + speeds_.size() / 2, speeds_.end());
        if (slowest_ < kNearCusp * speeds_[speeds_.size() / 2]) return false;
        return !has_hook(section);
    }

    // Whether a move makes no section unfair: there are no more of them than before.
    bool may_replace(std::span<const Section> old, std::span<const Section> fresh) {
        const long found = n_unfair(fresh);
        return found == 0 || found <= n_unfair(old);
    }

  private:
    // A direction that was asked for may need a turn that the data have not: beside it all is fair.
    long n_unfair(std::span<const Section> sections) {
        long count = 0;
        for (std::size_t i = 0; i < sections.size(); ++i) {
            const bool asked = sections[i].required ||
                               (i + 1 < sections.size() && sections[i + 1].required);
            count += !asked && !is_fair(sections[i]);
        }
        return count;
    }

    // Samples of a span, and how often they are halved where it bends.
    static constexpr int kSteps = 8, kDepth = 8;
    static constexpr double kNearCusp = 0.02;  // of the middle speed (PIE-26)
    static constexpr double kHookTurn = 0.5 * std::numbers::pi;
    static constexpr double kDataTurn = 0.25 * std::numbers::pi, kDataReach = 6.0;
    // Steps that turn by more are halved, down to a part of the tolerance.
    static constexpr double kLargestTurn = 0.35, kShort = 1e-3;

    struct Step {
        double turn, length;
        Vec2 place;
    };

    static double turn_between(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

    void look(const SpanPolynomial &span, double from, double to, int depth) {
        const Vec2 before = span.velocity(from), after = span.velocity(to);
        const double turn = turn_between(before, after);
        const double length = norm(span.point(to) - span.point(from));
        if (depth > 0 && std::fabs(turn) > kLargestTurn && length > kShort * tolerance_) {
            const double middle = 0.5 * (from + to);
            look(span, from, middle, depth - 1);
            look(span, middle, to, depth - 1);
            return;
        }
        slowest_ = std::min({slowest_, norm(before), norm(after)});
        if (depth == kDepth || speeds_.empty()) speeds_.push_back(norm(before));
        steps_.push_back({turn, length, span.point(from)});
    }

    bool has_hook(const Section &section) const {
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            double turn = 0.0, low = 0.0, high = 0.0, length = 0.0;
            for (std::size_t k = i; k < steps_.size() && length <= tolerance_; ++k) {
                turn += steps_[k].turn;
                low = std::min(low, turn);
                high = std::max(high, turn);
                length += steps_[k].length;
                if (high - low > kHookTurn && length <= tolerance_)
                    if (data_turn(section, steps_[k].place) < kDataTurn) return true;
            }
        }
        return false;
    }

    // The largest difference of directions of the data's sides about the datum nearest to a place.
    double data_turn(const Section &section, Vec2 place) const {
        Index nearest = section.first;
        for (Index j = section.first; j <= section.last; ++j)
            if (norm_sq(data_[j] - place) < norm_sq(data_[nearest] - place)) nearest = j;
        const Index n = static_cast<Index>(data_.size());
        const double reach = 0.5 * kDataReach * tolerance_;
        double low = 0.0, high = 0.0;
        for (const int way : {1, -1}) {
            double turn = 0.0, length = 0.0;
            for (Index j = nearest; length <= reach; j += way) {
                if (j - 1 < 0 || j + 1 >= n) break;
                const Vec2 a = data_[j] - data_[j - 1], b = data_[j + 1] - data_[j];
                // Of the datum itself once.
                if (j != nearest || way > 0) turn += way * turn_between(a, b);
                low = std::min(low, turn);
                high = std::max(high, turn);
                length += norm(way > 0 ? b : a);
            }
        }
        return high - low;
    }

    std::span<const Vec2> data_;
    double tolerance_, slowest_ = 0.0;
    std::vector<BasisTaylor> taylor_;
    std::vector<SpanPolynomial> spans_;
    std::vector<Step> steps_;
    std::vector<double> speeds_;
};

}  // namespace shapespline::pieces
