// p-norm continuation: fit of one window in a rising p-norm of the distances in both directions.
//
// Levenberg-Marquardt on control points and, in later stages, logarithms of knot intervals, the
// data's parameters eliminated. The sum of (d / tolerance)^p over data and curve samples tends to
// the largest distance as p rises; stages with p = 2, 6, 12 come near the minimax fit, and stop as
// soon as the tolerance is kept.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/spline/tracking.hpp"
#include "shapespline/spline/window_system.hpp"

namespace shapespline::spline {

struct FitStage {
    int half_power;     // p / 2
    int iterations;
    bool intervals_free;
    double give_up;     // leave if the largest distance is still this many tolerances
};

struct FitLimits {
    double tolerance;
    double enough;        // part of the tolerance at which a fit may stop
    int samples_per_span;
    double sample_weight;  // of a curve sample against a data point
    double least_interval, largest_interval;
    double stagnation_limit;  // leave a stage that would need this many times its present rate
    bool samples_move = true;  // with the data, where these are few
};

template <int Degree>
class PNormFit {
  public:
    // Improves the window's curve in place; returns the largest distance in tolerances. A linear
    // fit at the parameters of the data comes first if asked for.
    double run(Window<Degree> &window, const FitLimits &limits, std::span<const FitStage> stages,
               bool linear_first) {
        window_ = &window;
        limits_ = &limits;
        inverse_sq_ = 1.0 / (limits.tolerance * limits.tolerance);
        near_sq_ = kNear * kNear * limits.tolerance * limits.tolerance;
        best_ = std::numeric_limits<double>::infinity();
        damping_ = 1e-3;
        prepared_.reset();
        current_.curve = window.curve;
        Tracking<Degree>::span_curves(current_.curve, current_.bases, current_.curves);
        Tracking<Degree>::residuals(window, current_.curve, current_.curves, current_.residuals);
        plan_.make(window, current_.curve, limits.samples_per_span, limits.samples_move);
        Tracking<Degree>::sample(window, current_.curve, current_.curves, plan_, near_sq_, nullptr,
                                 current_.samples);
        measure(current_);
        keep_if_best();
        if (linear_first) linear_fit();
        for (const FitStage &stage : stages) {
            if (best_ <= limits.enough) break;
            run_stage(stage);
            if (best_ > stage.give_up) break;
        }
        window.curve = best_curve_;
        return best_;
    }
    long iterations() const { return iterations_; }

  private:
    struct Fitted {
        LocalCurve curve;
        typename Tracking<Degree>::Bases bases;
        typename Tracking<Degree>::Curves curves;
        std::vector<Vec2> residuals;
        std::vector<CurveSample> samples;
        double largest = 0.0;  // distance in tolerances
    };

    static constexpr int kTrials = 6, kFootSteps = 1;
    static constexpr double kDampingFactor = 6.0, kLeastDamping = 1e-7, kRestartDamping = 1e-4;
    static constexpr double kNear = 1.0;  // tolerances, see nearest_around
    static constexpr double kRelativeStop = 2e-3;
    static constexpr double kLargestIntervalStep = 0.5;   // of a logarithm, in one iteration
    static constexpr double kLeastIntervalRatio = 2e-3;   // of a interval to its larger neighbour
    static constexpr double kLinearSampleWeight = 0.1;

    static double power(double x, int n) {
        double value = 1.0;
        for (int i = 0; i < n; ++i) value *= x;
        return value;
    }

    void measure(Fitted &fitted) const {
        double largest = 0.0;
        for (const Vec2 r : fitted.residuals) largest = std::max(largest, norm_sq(r));
        for (const CurveSample &s : fitted.samples) largest = std::max(largest, s.distance_sq);
        fitted.largest = std::sqrt(largest * inverse_sq_);
    }

    double merit(const Fitted &fitted, int half_power) const {
        return merit_of_data(fitted, half_power) + merit_of_samples(fitted, half_power);
    }
    double merit_of_data(const Fitted &fitted, int half_power) const {
        double sum = 0.0;
        for (const Vec2 r : fitted.residuals) sum += power(norm_sq(r) * inverse_sq_, half_power);
        return sum;
    }
    double merit_of_samples(const Fitted &fitted, int half_power) const {
        double sum = 0.0;
        for (const CurveSample &s : fitted.samples)
            sum += power(s.distance_sq * inverse_sq_, half_power);
        return limits_->sample_weight * sum;
    }

    void keep_if_best() {
        if (!(current_.largest < best_)) return;
        best_ = current_.largest;
        best_curve_ = current_.curve;
    }

    // Not again for a stage with the unknowns of the one before.
    void prepare(bool intervals_free) {
        if (prepared_ != intervals_free) system_.prepare(*window_, intervals_free);
        prepared_ = intervals_free;
    }

    void linear_fit() {
        prepare(false);
        if (system_.size() == 0) return;
        assemble(1, false, kLinearSampleWeight);
        ++iterations_;
        if (!system_.solve(1e-6, step_)) return;
        advance(false);
        sample_next();
        std::swap(current_, next_);
        keep_if_best();
    }

    void run_stage(const FitStage &stage) {
        prepare(stage.intervals_free);
        if (system_.size() == 0) return;
        damping_ = std::max(damping_, kRestartDamping);
        double value = merit(current_, stage.half_power);
        for (int iteration = 0; iteration < stage.iterations; ++iteration) {
            ++iterations_;
            assemble(stage.half_power, true, 1.0);
            double next_value = 0.0;
            bool improved = false;
            for (int trial = 0; trial < kTrials && !improved; ++trial) {
                if (!system_.solve(damping_, step_)) {
                    damping_ = 10.0 * damping_ + 1e-9;
                    continue;
                }
                const double promised =
                    stage.half_power * inverse_sq_ * system_.promised(damping_, step_);
                if (promised < kRelativeStop * value) return;
                advance(stage.intervals_free);
                next_value = merit_of_data(next_, stage.half_power);
                if (next_value < value) {  // else nobody asks for the other direction
                    sample_next();
                    next_value += merit_of_samples(next_, stage.half_power);
                }
                improved = next_value < value;
                if (!improved) damping_ = kDampingFactor * damping_ + 1e-9;
            }
            if (!improved) return;
            std::swap(current_, next_);
            keep_if_best();
            damping_ = std::max(damping_ / kDampingFactor, kLeastDamping);
            const double decrease = (value - next_value) / value;
            value = next_value;
            if (best_ <= limits_->enough || decrease < kRelativeStop) return;
            // Out of reach: at some times the present rate the iterations left do not suffice.
            const int left = stage.iterations - iteration - 1;
            const double rate = decrease / (2.0 * stage.half_power);
            const double to_go = std::log(best_ / limits_->enough);
            if (stage.intervals_free && to_go > limits_->stagnation_limit * rate * left) return;
        }
    }

    // Weight d^(p - 2), Hessian of the normal direction times p - 1 (Newton on the p-th power);
    // W = I - T T' / (|T|^2 (1 + damping)) where the parameter is eliminated.
    void assemble(int half_power, bool parameters_free, double sample_factor) {
        const Window<Degree> &window = *window_;
        const LocalCurve &curve = current_.curve;
        const double newton = 2.0 * half_power - 1.0;
        system_.clear();
        int j = 0;
        std::size_t i = 0;
        for (int k = Degree; k < window.n_points(); ++k) {
            SpanMoments<Degree> moments;
            const int begin = j;
            const std::size_t first_sample = i;
            for (; j < window.n_data() && curve.span[j] == k; ++j) {
                const Vec2 r = current_.residuals[j];
                const double u = curve.local_parameter[j];
                const double w = power(norm_sq(r) * inverse_sq_, half_power - 1);
                const Vec2 t = current_.curves[k].tangent(u);
                const bool fixed = !parameters_free || (window.starts_open_curve && j == 0) ||
                                   (window.ends_open_curve && j + 1 == window.n_data());
                const double h =
                    fixed ? 0.0 : 1.0 / (norm_sq(t) * (1.0 + damping_) + 1e-300);
                const double along = dot(r, t) * h, wn = w * newton;
                moments.add(u, eliminated(wn, t, h), w * (r - along * t));
            }
            for (; i < current_.samples.size() && current_.samples[i].span == k; ++i) {
                const CurveSample &s = current_.samples[i];
                const double w = sample_factor * limits_->sample_weight *
                                 power(s.distance_sq * inverse_sq_, half_power - 1);
                const Vec2 n = s.normal;
                const Weight2 weight{w * newton * n.x * n.x, w * newton * n.x * n.y,
                                     w * newton * n.y * n.y};
                moments.add(s.local_parameter, weight, w * dot(s.residual, n) * n);
            }
            if (j > begin || i > first_sample)
                system_.add(window, curve, k, current_.bases[k], moments);
        }
    }

    // next_ = current_ moved by step_, data projected.
    void advance(bool intervals_free) {
        const Window<Degree> &window = *window_;
        next_.curve = current_.curve;
        double scale = 1.0;
        if (intervals_free)
            for (int g = 0; g < window.n_free_intervals; ++g)
                if (system_.interval_unknown(g) >= 0)
                    scale = std::min(scale, kLargestIntervalStep /
                                                std::abs(step_[system_.interval_unknown(g)]));
        for (int p = 0; p < window.n_points(); ++p) {
            if (window.point_slot[p] == kNotFree) continue;
            const int at = system_.point_unknown(window.point_slot[p]);
            next_.curve.points[p] += scale * Vec2{step_[at], step_[at + 1]};
        }
        if (intervals_free) move_intervals(scale);
        Tracking<Degree>::span_curves(next_.curve, next_.bases, next_.curves);
        Tracking<Degree>::project(window, next_.curve, next_.curves, kFootSteps, next_.residuals);
    }
    void sample_next() {
        Tracking<Degree>::sample(*window_, next_.curve, next_.curves, plan_, near_sq_,
                                 &current_.samples, next_.samples);
        measure(next_);
    }

    void move_intervals(double scale) {
        const Window<Degree> &window = *window_;
        std::vector<double> &intervals = next_.curve.intervals;
        const int count = static_cast<int>(intervals.size());
        for (int k = 0; k < count; ++k) {
            const int slot = window.interval_slot[k];
            if (slot == kNotFree || system_.interval_unknown(slot) < 0) continue;
            intervals[k] *= std::exp(scale * step_[system_.interval_unknown(slot)]);
        }
        for (int k = 1; k + 1 < count; ++k) {
            const int slot = window.interval_slot[k];
            if (slot == kNotFree || system_.interval_unknown(slot) < 0) continue;
            const double beside =
                kLeastIntervalRatio * std::max(intervals[k - 1], intervals[k + 1]);
            intervals[k] = std::clamp(std::max(intervals[k], beside), limits_->least_interval,
                                 limits_->largest_interval);
        }
        // A whole closed curve holds some intervals twice; those of the sampled spans count.
        const int period = window.n_free_intervals;
        for (int k = 0; k < count; ++k) {
            if (window.interval_slot[k] == kNotFree) continue;
            if (k < window.first_sampled && k + period < count &&
                window.interval_slot[k + period] == window.interval_slot[k])
                intervals[k] = intervals[k + period];
            else if (k > window.last_sampled && k >= period &&
                     window.interval_slot[k - period] == window.interval_slot[k])
                intervals[k] = intervals[k - period];
        }
    }

    Window<Degree> *window_ = nullptr;
    const FitLimits *limits_ = nullptr;
    double inverse_sq_ = 1.0, near_sq_ = 0.0, damping_ = 1e-3, best_ = 0.0;
    long iterations_ = 0;
    std::optional<bool> prepared_;  // with intervals among the unknowns or without
    Fitted current_, next_;
    LocalCurve best_curve_;
    SamplePlan<Degree> plan_;
    WindowSystem<Degree> system_;
    std::vector<double> step_;
};

}  // namespace shapespline::spline
