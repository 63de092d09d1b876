// What a search by knot removal is asked for, what it may spend, and what it has done.
#pragma once

#include <vector>

#include "shapespline/spline/fairness.hpp"
#include "shapespline/spline/pnorm.hpp"

namespace shapespline::spline {

struct Effort {
    int n_side;  // free control points on each side
    std::vector<FitStage> stages;
};

struct SplineSettings {
    FitLimits fit;
    Fairness fairness;
    bool keep_fair;
    int start;      // which knots it begins with: 0 few, 1 more, 2 the data polyline
    int most_at_start;  // control points at which insertion gives up
    double accept;  // part of the tolerance that an accepted curve keeps
    // In tolerances, after several failures in a row: the rank beyond which a removal is not tried,
    // and the distance of a failed one beyond which it gets no harder attempt.
    double worth_trying, worth_retrying;
};

struct RemovalCounts {
    long ranks = 0, trials = 0, accepted = 0, refits = 0, iterations = 0;
    long missed_bound = 0, missed_intervals = 0, missed_speed = 0, missed_crossings = 0;
    long missed_hooks = 0, hooks = 0;  // the last: that are left
};

}  // namespace shapespline::spline
