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

// After so many failures in a row nothing is tried that is beyond a distance in tolerances.
struct Patience {
    int failures;
    double distance;
};

struct SplineSettings {
    FitLimits fit;
    Fairness fairness;
    bool keep_fair;
    int start;      // which knots it begins with: 0 few, 1 more, 2 the data polyline
    int most_at_start;  // control points at which insertion gives up
    double accept;  // part of the tolerance that an accepted curve keeps
    Patience trying, retrying;  // by the rank, by the distance of the attempt that failed
};

struct RemovalCounts {
    long ranks = 0, trials = 0, accepted = 0, refits = 0, iterations = 0;
    long missed_bound = 0, missed_intervals = 0, missed_speed = 0, missed_crossings = 0;
    long missed_hooks = 0, hooks = 0;  // the last: that are left
};

}  // namespace shapespline::spline
