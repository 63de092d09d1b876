// The shapes of all spans of a spline, and of what a trial changes: a trial costs what it changes.
//
// A removal renumbers spans, so shapes are kept by the id of the knot that each begins at.
#pragma once

#include <algorithm>
#include <vector>

#include "shapespline/spline/span_shape.hpp"

namespace shapespline::spline {

template <int Degree>
struct PlacedShape {
    int span;  // unwrapped
    SpanShape<Degree> *shape;
};

// Of spans in order; empty ones left out.
template <int Degree>
using ShapeRow = std::vector<PlacedShape<Degree>>;

template <int Degree>
class SpanShapes {
  public:
    // Keeps the shapes of a state.
    void measure(const SplineState<Degree> &state) {
        const int most = *std::max_element(state.knot_ids.begin(), state.knot_ids.end());
        kept_.assign(1 + most, {});
        changed_at_.assign(1 + most, kUnchanged);
        changed_.clear();
        change(state, state.all_spans());
        accept();
    }
    // A trial: a state whose curve differs from the kept one's on these spans only.
    void change(const SplineState<Degree> &state, SpanRange spans) {
        forget();
        for (int k = spans.begin; k < spans.end; ++k) {
            if (!(state.interval(k) > 0.0)) continue;
            const int id = state.knot_ids[state.interval_index(k)];
            changed_at_[id] = static_cast<int>(changed_.size());
            changed_.push_back({id, SpanShape<Degree>(state, k)});
        }
    }
    // Keeps what the trial has changed.
    void accept() {
        for (const Changed &one : changed_) kept_[one.id] = one.shape;
        forget();
    }

    // The kept state's, and the trial's; valid until shapes change.
    ShapeRow<Degree> kept(const SplineState<Degree> &state, SpanRange spans) {
        return row(state, spans, [&](int id) { return &kept_[id]; });
    }
    ShapeRow<Degree> tried(const SplineState<Degree> &state, SpanRange spans) {
        return row(state, spans, [&](int id) {
            const int at = changed_at_[id];
            return at == kUnchanged ? &kept_[id] : &changed_[at].shape;
        });
    }

  private:
    static constexpr int kUnchanged = -1;
    struct Changed {
        int id;
        SpanShape<Degree> shape;
    };

    void forget() {
        for (const Changed &one : changed_) changed_at_[one.id] = kUnchanged;
        changed_.clear();
    }
    template <class ShapeOf>
    static ShapeRow<Degree> row(const SplineState<Degree> &state, SpanRange spans,
                                ShapeOf &&shape_of) {
        ShapeRow<Degree> found;
        found.reserve(spans.end - spans.begin);
        for (int k = spans.begin; k < spans.end; ++k) {
            const int at = state.interval_index(k);
            if (state.intervals[at] > 0.0) found.push_back({k, shape_of(state.knot_ids[at])});
        }
        return found;
    }

    std::vector<SpanShape<Degree>> kept_;  // by knot id
    std::vector<int> changed_at_;          // by knot id
    std::vector<Changed> changed_;
};

}  // namespace shapespline::spline
