// A question put between the moves of a long search: shall it end with what it has?
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace shapespline {

// Asks at coarse intervals of time only, so that asking costs nothing; once told to end, it keeps
// saying so. Asking changes no result.
class Interruption {
  public:
    // Is told the number of points reached so far, 0 before there is a curve.
    using Ask = std::function<bool(long n_points)>;

    explicit Interruption(Ask ask) : ask_(std::move(ask)), last_(Clock::now()) {}

    bool ended() const { return ended_; }

    template <class Count>
    bool ends(Count &&n_points) {
        if (ended_) return true;
        const auto now = Clock::now();
        if (now - last_ < kInterval) return false;
        ended_ = ask_(static_cast<long>(n_points()));
        last_ = Clock::now();
        return ended_;
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kInterval{50};  // (KER-03)

    Ask ask_;
    Clock::time_point last_;
    bool ended_ = false;
};

}  // namespace shapespline
