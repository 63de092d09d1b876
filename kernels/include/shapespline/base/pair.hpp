// Two numbers that the processor works on at once, by the vector types of GCC and Clang: every
// x86-64 and ARM has them, and each number is rounded as it would be alone.
#pragma once

#include <cstddef>

namespace shapespline {

using Pair = double __attribute__((vector_size(16)));

inline Pair both(double value) { return Pair{value, value}; }
inline double sum(Pair a) { return a[0] + a[1]; }
inline Pair clamped(Pair a, double low, double high) {
    const Pair raised = a < both(low) ? both(low) : a;
    return raised > both(high) ? both(high) : raised;
}

// An array of numbers that is read and written singly or in pairs.
template <std::size_t Size>
class PairArray {
  public:
    Pair &pair(std::size_t k) { return pairs_[k]; }
    const Pair &pair(std::size_t k) const { return pairs_[k]; }
    double operator[](std::size_t i) const { return pairs_[i / 2][i % 2]; }
    void set(std::size_t i, double value) { pairs_[i / 2][i % 2] = value; }

  private:
    static_assert(Size % 2 == 0);
    Pair pairs_[Size / 2];
};

}  // namespace shapespline
