// KnotRemoval for a degree known at run time only, in plain types.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "shapespline/removal.hpp"

namespace shapespline::removal {

class RemovalSearch {
  public:
    // (half power, iterations, gaps free, give up at) of each stage.
    using Stages = std::vector<std::tuple<int, int, bool, double>>;
    using EffortTuple = std::tuple<int, Stages>;
    // Gaps, control points (x, y alternating).
    using CurveArrays = std::tuple<std::vector<double>, std::vector<double>>;

    RemovalSearch(std::span<const Vec2> data, bool closed, int degree,
                  const RemovalSettings &settings, Interruption &interruption)
        : data_(data.begin(), data.end()) {
        dispatch_degree(degree, [&]<int Degree>() {
            search_ = std::make_unique<Search<Degree>>(data_, closed, settings, interruption);
        });
    }

    int remove_cheapest(const EffortTuple &rank, const EffortTuple &effort, long most,
                        Interruption &interruption) {
        return search_->remove_cheapest(unpack(rank), unpack(effort), most, interruption);
    }
    int remove_stubborn(const EffortTuple &effort, const std::vector<int> &spreads,
                        Interruption &interruption) {
        return search_->remove_stubborn(unpack(effort), spreads, interruption);
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
        virtual int remove_stubborn(const Effort &effort, std::span<const int> spreads,
                                    Interruption &interruption) = 0;
        virtual CurveArrays curve() const = 0;
        virtual int n_points() const = 0;
        virtual bool from_polyline() const = 0;
        virtual std::map<std::string, long> counts() = 0;
    };

    template <int Degree>
    struct Search : AnyDegree {
        KnotRemoval<Degree> removal;

        Search(std::span<const Vec2> data, bool closed, const RemovalSettings &settings,
               Interruption &interruption)
            : removal(data, closed, settings, interruption) {}
        int remove_cheapest(const Effort &rank, const Effort &effort, long most,
                            Interruption &interruption) override {
            return removal.remove_cheapest(rank, effort, most, interruption);
        }
        int remove_stubborn(const Effort &effort, std::span<const int> spreads,
                            Interruption &interruption) override {
            return removal.remove_stubborn(effort, spreads, interruption);
        }
        int n_points() const override { return removal.state().n_points(); }
        bool from_polyline() const override { return removal.from_polyline(); }
        CurveArrays curve() const override {
            std::vector<double> points;
            for (const Vec2 p : removal.state().points) points.insert(points.end(), {p.x, p.y});
            return {removal.state().gaps, points};
        }
        std::map<std::string, long> counts() override {
            const RemovalCounts &c = removal.counts();
            return {{"ranks", c.ranks},
                    {"trials", c.trials},
                    {"accepted", c.accepted},
                    {"refits", c.refits},
                    {"iterations", c.iterations},
                    {"missed_bound", c.missed_bound},
                    {"missed_gaps", c.missed_gaps},
                    {"missed_speed", c.missed_speed},
                    {"missed_crossings", c.missed_crossings}};
        }
    };

    static Effort unpack(const EffortTuple &packed) {
        Effort effort{std::get<0>(packed), {}};
        for (const auto &[half_power, iterations, gaps_free, give_up] : std::get<1>(packed))
            effort.stages.push_back({half_power, iterations, gaps_free, give_up});
        return effort;
    }

    std::vector<Vec2> data_;
    std::unique_ptr<AnyDegree> search_;
};

}  // namespace shapespline::removal
