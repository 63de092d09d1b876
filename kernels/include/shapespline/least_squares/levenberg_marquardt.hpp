// A run of Levenberg-Marquardt steps (Nielsen 1999; Madsen, Nielsen and Tingleff 2004, 3.16).
//
// Step for step and bit for bit what solvers/levenberg_marquardt.py and solvers/iteration.py do
// with a CurveProblem, whose constants and stopping tests these are: a test compares both (KER-06).
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shapespline/base/interruption.hpp"
#include "shapespline/least_squares/normal_equations.hpp"
#include "shapespline/least_squares/residuals.hpp"

namespace shapespline::least_squares {

struct DescentLimits {
    int max_iterations, max_evaluations;
    double relative_decrease, gradient_tolerance;
    double target_cost;  // minus infinity for none
    double start_damping;
    int patience;  // small decreases in a row that mean convergence
};

enum class Stop {
    gradient, decrease, target, no_decrease, iterations, evaluations, cancelled, not_finite, no_step
};

// One iteration; `step` is the damping that led to it, 0 where nothing moved.
struct IterationRecord {
    double cost, gradient_norm;
    int evaluations;
    double step, seconds;
};

class LevenbergMarquardt {
  public:
    // Moves the control points and parameters, given as a start, to the best ones found.
    LevenbergMarquardt(const Knots &knots, const Samples &samples, const DescentLimits &limits,
                       std::span<Vec2> control_points, std::span<double> parameters)
        : knots_(knots),
          samples_(samples),
          limits_(limits),
          control_points_(control_points),
          parameters_(parameters),
          damping_(limits.start_damping),
          trial_points_(control_points.size()),
          trial_parameters_(parameters.size()) {}

    Stop run(Interruption &interruption) {
        const auto began = Clock::now();
        cost_ = cost_at(control_points_, parameters_);
        propose();
        while (!proposed_) {
            raise_damping();
            if (damping_ > kMostDamping) return Stop::no_step;
            propose();
        }
        if (!std::isfinite(cost_) || !std::isfinite(gradient_norm_)) return Stop::not_finite;
        for (;;) {
            const std::chrono::duration<double> seconds = Clock::now() - began;
            history_.push_back({cost_, gradient_norm_, evaluations_, step_, seconds.count()});
            if (const auto stop = reason_to_stop()) return *stop;
            if (interruption.ends([&] { return control_points_.size(); })) return Stop::cancelled;
            step();
        }
    }

    const std::vector<IterationRecord> &history() const { return history_; }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr double kLeastDamping = 1e-15;  // below, it is lost in the diagonal
    static constexpr double kMostDamping = 1e16;    // beyond, a step is lost in rounding
    static constexpr double kLargestCut = 1.0 / 3.0;

    double cost_at(std::span<const Vec2> control_points, std::span<const double> parameters) const {
        Samples samples = samples_;
        samples.parameters = parameters;
        return cost(knots_, control_points, samples);
    }

    // A trial point for the damping; none if the factorisation failed.
    void propose() {
        Samples samples = samples_;
        samples.parameters = parameters_;
        const StepResult found = damped_step(knots_, control_points_, samples, damping_,
                                             trial_points_, trial_parameters_.data());
        proposed_ = found.solved;
        if (!proposed_) return;
        gradient_norm_ = found.gradient_norm;
        predicted_decrease_ = found.cost - found.predicted_cost;
        for (std::size_t i = 0; i < trial_points_.size(); ++i)
            trial_points_[i] += control_points_[i];
        for (std::size_t j = 0; j < trial_parameters_.size(); ++j)
            trial_parameters_[j] += parameters_[j];
        if (samples_.held != Held::none)
            for (double &t : trial_parameters_)
                t = std::clamp(t, parameters_.front(), parameters_.back());
        put_in_order(trial_parameters_, knots_);
    }

    // Data order, by sorting; of closed data what stretches past one period is clipped.
    static void put_in_order(std::vector<double> &t, const Knots &knots) {
        if (!std::ranges::is_sorted(t)) {
            const auto numbers = std::ranges::partition(t, [](double x) { return x == x; });
            std::sort(t.begin(), numbers.begin());
        }
        if (!knots.periodic || !(t.back() > t.front() + knots.period())) return;
        const double most = t.front() + knots.period();
        for (double &x : t) x = std::min(x, most);
    }

    void raise_damping() {
        damping_ *= factor_;
        factor_ *= 2.0;
        proposed_ = false;
    }

    // Tries proposals with rising damping until one lowers the cost.
    void step() {
        step_ = 0.0;
        while (evaluations_ < limits_.max_evaluations) {
            ++evaluations_;
            if (proposed_) {
                const double trial = cost_at(trial_points_, trial_parameters_);
                if (trial < cost_) return accept(trial);
                constexpr double kRounding = std::numeric_limits<double>::epsilon();
                if (predicted_decrease_ <= kRounding * std::abs(cost_)) break;
            }
            raise_damping();
            if (damping_ > kMostDamping) break;
            propose();
        }
        stalled_ = true;
    }

    // Takes the trial point and turns the damping by its gain ratio.
    void accept(double trial) {
        const double gain = cost_ - trial;
        const double ratio = predicted_decrease_ > 0.0 ? gain / predicted_decrease_ : 0.0;
        const double turn = 1.0 - std::pow(2.0 * std::min(ratio, 1.0) - 1.0, 3.0);
        step_ = damping_;
        damping_ = std::max(damping_ * std::max(kLargestCut, turn), kLeastDamping);
        factor_ = 2.0;
        cost_ = trial;
        std::ranges::copy(trial_points_, control_points_.begin());
        std::ranges::copy(trial_parameters_, parameters_.begin());
        propose();
    }

    // What was achieved comes before what ran out.
    std::optional<Stop> reason_to_stop() const {
        if (cost_ <= limits_.target_cost) return Stop::target;
        if (gradient_norm_ <= limits_.gradient_tolerance * history_.front().gradient_norm)
            return Stop::gradient;
        if (stalled_ && evaluations_ < limits_.max_evaluations) return Stop::no_decrease;
        if (evaluations_ >= limits_.max_evaluations) return Stop::evaluations;
        if (hardly_falls()) return Stop::decrease;
        if (static_cast<int>(history_.size()) > limits_.max_iterations) return Stop::iterations;
        return std::nullopt;
    }

    bool hardly_falls() const {
        const std::size_t n = history_.size(), patience = limits_.patience;
        if (n <= patience) return false;
        for (std::size_t i = n - patience; i < n; ++i) {
            const double before = history_[i - 1].cost;
            if (!(before - history_[i].cost <= limits_.relative_decrease * std::abs(before)))
                return false;
        }
        return true;
    }

    Knots knots_;
    Samples samples_;
    DescentLimits limits_;
    std::span<Vec2> control_points_;
    std::span<double> parameters_;
    double cost_ = 0.0, gradient_norm_ = std::numeric_limits<double>::quiet_NaN();
    double damping_, factor_ = 2.0, step_ = 0.0, predicted_decrease_ = 0.0;
    int evaluations_ = 1;
    bool proposed_ = false, stalled_ = false;
    std::vector<Vec2> trial_points_;
    std::vector<double> trial_parameters_;
    std::vector<IterationRecord> history_;
};

}  // namespace shapespline::least_squares
