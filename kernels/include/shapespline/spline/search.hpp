// KnotRemoval for a degree known at run time only, in plain types.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "shapespline/spline/removal.hpp"

namespace shapespline::spline {

class RemovalSearch {
  public:
    // Intervals, control points (x, y alternating).
    using CurveArrays = std::tuple<std::vector<double>, std::vector<double>>;

    RemovalSearch(std::span<const Vec2> data, bool closed, int degree,
                  const SplineSettings &settings, Interruption &interruption)
        : data_(data.begin(), data.end()) {
        dispatch_degree(degree, [&]<int Degree>() {
            search_ = std::make_unique<Search<Degree>>(data_, closed, settings, interruption);
        });
    }

    int remove_cheapest(const Effort &rank, const Effort &effort, long most,
                        Interruption &interruption) {
        return search_->remove_cheapest(rank, effort, most, interruption);
    }
    int retry(const Effort &effort, const std::vector<int> &redistributions,
              Interruption &interruption) {
        return search_->retry(effort, redistributions, interruption);
    }
    CurveArrays curve() const { return search_->curve(); }
    int n_points() const { return search_->n_points(); }
    bool from_polyline() const { return search_->from_polyline(); }
    std::map<std::string, long> counts() { return search_->counts(); }

  private:
    struct AnyDegree {
        virtual ~AnyDegree() = default;
        virtual int remove_cheapest(const Effort &rank, const Effort &effort, long most,
                                    Interruption &interruption) = 0;
        virtual int retry(const Effort &effort, std::span<const int> redistributions,
                          Interruption &interruption) = 0;
        virtual CurveArrays curve() const = 0;
        virtual int n_points() const = 0;
        virtual bool from_polyline() const = 0;
        virtual std::map<std::string, long> counts() = 0;
    };

    template <int Degree>
    struct Search : AnyDegree {
        KnotRemoval<Degree> removal;

        Search(std::span<const Vec2> data, bool closed, const SplineSettings &settings,
               Interruption &interruption)
            : removal(data, closed, settings, interruption) {}
        int remove_cheapest(const Effort &rank, const Effort &effort, long most,
                            Interruption &interruption) override {
            return removal.remove_cheapest(rank, effort, most, interruption);
        }
        int retry(const Effort &effort, std::span<const int> redistributions,
                  Interruption &interruption) override {
            return removal.retry(effort, redistributions, interruption);
        }
        int n_points() const override { return removal.state().n_points(); }
        bool from_polyline() const override { return removal.from_polyline(); }
        CurveArrays curve() const override {
            std::vector<double> points;
            for (const Vec2 p : removal.state().points) points.insert(points.end(), {p.x, p.y});
            return {removal.state().intervals, points};
        }
        std::map<std::string, long> counts() override {
            const RemovalCounts &c = removal.counts();
            return {{"ranks", c.ranks},
                    {"trials", c.trials},
                    {"accepted", c.accepted},
                    {"refits", c.refits},
                    {"iterations", c.iterations},
                    {"missed_bound", c.missed_bound},
                    {"missed_intervals", c.missed_intervals},
                    {"missed_speed", c.missed_speed},
                    {"missed_crossings", c.missed_crossings},
                    {"missed_hooks", c.missed_hooks},
                    {"hooks", c.hooks}};
        }
    };

    std::vector<Vec2> data_;
    std::unique_ptr<AnyDegree> search_;
};

}  // namespace shapespline::spline
