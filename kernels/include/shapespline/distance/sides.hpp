// What lies across a narrow clearance: the nearest place of outlines that is far along the way.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shapespline/distance/polyline.hpp"

namespace shapespline {

// The segments of some contours as other sides of each other.
class Sides {
  public:
    struct Segment {
        Vec2 begin, end;
        double along;        // where it begins on its contour
        std::int64_t owner;  // which that is
    };

    // `rounds[owner]` is the length of a closed contour, infinite of an open one.
    Sides(std::vector<Segment> segments, std::vector<double> rounds)
        : segments_(std::move(segments)),
          rounds_(std::move(rounds)),
          tree_(segments_.size(), [this](std::size_t i, Box &box) {
              box.include(segments_[i].begin);
              box.include(segments_[i].end);
          }) {}

    struct Limits {
        double reach;   // no place as far as this is another side
        double around;  // the way along the contour is longer than so many times the distance ...
        double least;   // ... and than this
    };

    // The vector to a point so far along contour `own` from the nearest place across a clearance;
    // infinite where there is none. On a contour of its own any place is another side.
    Vec2 across(Vec2 point, double along, std::int64_t own, const Limits &limits) const {
        constexpr double kNone = std::numeric_limits<double>::infinity();
        const double round = rounds_[own], at = std::fmod(along, round);
        Vec2 nearest{kNone, kNone};
        double best_sq = limits.reach * limits.reach;
        tree_.search(point, best_sq, 0, [&](std::size_t i) {
            const Segment &side = segments_[i];
            const Vec2 foot = segment_foot(point, side.begin, side.end), off = point - foot;
            const double distance_sq = norm_sq(off);
            if (!(distance_sq < best_sq)) return;
            if (side.owner == own) {
                const double way = std::abs(at - (side.along + norm(foot - side.begin)));
                // Of two ways round a closed outline the shorter.
                const double distance = std::sqrt(distance_sq);
                if (std::min(way, round - way) <= std::max(limits.around * distance, limits.least))
                    return;
            }
            best_sq = distance_sq;
            nearest = off;
        });
        return nearest;
    }

  private:
    std::vector<Segment> segments_;
    std::vector<double> rounds_;
    BoxTree tree_;
};

}  // namespace shapespline
