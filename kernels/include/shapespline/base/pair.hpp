// Two numbers that the processor works on at once, by the vector types of GCC and Clang: every
// x86-64 and ARM has them, and each number is rounded as it would be alone. Compilers without them,
// or SHAPESPLINE_PLAIN_VECTORS, get a struct of two numbers and the same bits.
#pragma once

#include <cstddef>

#if !defined(__GNUC__) && !defined(SHAPESPLINE_PLAIN_VECTORS)
#define SHAPESPLINE_PLAIN_VECTORS
#endif

namespace shapespline {

#ifdef SHAPESPLINE_PLAIN_VECTORS

struct Pair {
    double first, second;

    double operator[](std::size_t i) const { return i == 0 ? first : second; }
    double &operator[](std::size_t i) { return i == 0 ? first : second; }
    Pair operator-() const { return {-first, -second}; }
    Pair &operator+=(Pair b) { return *this = {first + b.first, second + b.second}; }

    friend Pair operator+(Pair a, Pair b) { return {a.first + b.first, a.second + b.second}; }
    friend Pair operator-(Pair a, Pair b) { return {a.first - b.first, a.second - b.second}; }
    friend Pair operator*(Pair a, Pair b) { return {a.first * b.first, a.second * b.second}; }
    friend Pair operator/(Pair a, Pair b) { return {a.first / b.first, a.second / b.second}; }
    friend Pair operator+(Pair a, double b) { return {a.first + b, a.second + b}; }
    friend Pair operator*(double a, Pair b) { return {a * b.first, a * b.second}; }
};

struct PairMask {
    bool first, second;
};
inline PairMask operator<(Pair a, Pair b) { return {a.first < b.first, a.second < b.second}; }
inline PairMask operator>(Pair a, Pair b) { return b < a; }

// Where the mask holds the one, else the other.
inline Pair chosen(PairMask mask, Pair a, Pair b) {
    return {mask.first ? a.first : b.first, mask.second ? a.second : b.second};
}

#else

using Pair = double __attribute__((vector_size(16)));

template <class Mask>
inline Pair chosen(Mask mask, Pair a, Pair b) {
    return mask ? a : b;
}

#endif

inline double chosen(bool mask, double a, double b) { return mask ? a : b; }
inline Pair both(double value) { return Pair{value, value}; }
inline double sum(Pair a) { return a[0] + a[1]; }
inline Pair clamped(Pair a, double low, double high) {
    const Pair raised = chosen(a < both(low), both(low), a);
    return chosen(raised > both(high), both(high), raised);
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
