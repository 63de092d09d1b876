// The sections of a whole outline, from which windows are taken and into which they are put back.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "shapespline/pieces/lawson.hpp"

namespace shapespline::pieces {

class SectionRing {
  public:
    // The period is the number of data of a closed outline, 0 for an open one.
    SectionRing(std::vector<Section> sections, Index period, bool ends_fixed)
        : sections_(std::move(sections)), period_(period), ends_fixed_(ends_fixed) {
        renumber();
    }

    bool closed() const { return period_ > 0; }
    Index period() const { return period_; }
    long size() const { return static_cast<long>(sections_.size()); }
    const std::vector<Section> &sections() const { return sections_; }
    Section &at(long i) { return sections_[wrapped(i)]; }
    const Section &at(long i) const { return sections_[wrapped(i)]; }
    bool has(long i) const { return closed() || (i >= 0 && i < size()); }
    // Where the data of a section begin, whatever the lap.
    Index origin(const Section &s) const { return closed() ? s.first % period_ : s.first; }

    int cost() const {
        int sum = 0;
        for (const Section &s : sections_) sum += s.cost();
        return sum;
    }

    // Sections i0 .. i1, their data increasing from the middle lap on: no window of a lap at most
    // leaves the three.
    std::vector<Section> window(long i0, long i1) const {
        std::vector<Section> result;
        for (long i = i0; i <= i1; ++i) {
            result.push_back(at(i));
            Section &last = result.back();
            if (result.size() > 1)
                shift_to(last, result[result.size() - 2].last + 1);
            else if (closed())
                shift_to(last, origin(last) + period_);
        }
        return result;
    }

    // Puts other sections where i0 .. i1 were; the first of them becomes section i0 (wrapped
    // windows: section 0). All others stay the same objects: a copy of the ring for each move
    // would make searches quadratic.
    void replace(long i0, long i1, std::vector<Section> with) {
        const long n = size(), count = i1 - i0 + 1;
        long a = static_cast<long>(wrapped(i0));
        if (a + count > n) {
            const auto begin = sections_.begin();
            std::rotate(begin, begin + (a + count - n), begin + a);
            sections_.erase(begin + (n - count), sections_.end());
            a = 0;
        } else {
            sections_.erase(sections_.begin() + a, sections_.begin() + a + count);
        }
        sections_.insert(sections_.begin() + a, std::make_move_iterator(with.begin()),
                         std::make_move_iterator(with.end()));
        renumber();
    }

    // How a window that begins with section i, or ends before it, is held there.
    ChainEnd begin_of(long i) const {
        if (!has(i - 1)) return {ends_fixed_};
        if (!at(i).tangent) return {true};
        return {true, at(i - 1).points[at(i - 1).points.size() - 2], at(i).required};
    }
    ChainEnd end_before(long i) const {
        if (!has(i)) return {ends_fixed_};
        if (!at(i).tangent) return {true};
        return {true, at(i).points[1], at(i).required};
    }

    // Makes section i the first.
    void rotate(long i) {
        std::rotate(sections_.begin(), sections_.begin() + static_cast<long>(wrapped(i)),
                    sections_.end());
        renumber();
    }

    // The turn at the start of section i, radians; 0 at the ends of an open outline.
    double turn(long i) const {
        if (!has(i - 1) || !has(i)) return 0.0;
        const Vec2 u = at(i - 1).end_direction(), v = at(i).begin_direction();
        return std::atan2(cross(u, v), dot(u, v));
    }

  private:
    std::size_t wrapped(long i) const {
        const long n = size();
        return static_cast<std::size_t>(((i % n) + n) % n);
    }
    static void shift_to(Section &s, Index first) {
        s.last += first - s.first;
        s.first = first;
    }
    void renumber() {
        if (!closed() || sections_.empty()) return;
        shift_to(sections_[0], origin(sections_[0]) + period_);
        for (std::size_t i = 1; i < sections_.size(); ++i)
            shift_to(sections_[i], sections_[i - 1].last + 1);
    }

    std::vector<Section> sections_;
    Index period_;
    bool ends_fixed_;
};

}  // namespace shapespline::pieces
