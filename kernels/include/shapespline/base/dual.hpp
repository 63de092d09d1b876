// Numbers that carry their slopes over N unknowns, exact to rounding (Wengert 1964).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace shapespline {

template <std::size_t N>
struct Dual {
    double value = 0.0;
    std::array<double, N> slopes{};

    static Dual unknown(double value, std::size_t i) {
        Dual x{value};
        x.slopes[i] = 1.0;
        return x;
    }

    // A function of this number with such a value and derivative there.
    Dual mapped(double at, double derivative) const {
        Dual found{at};
        for (std::size_t i = 0; i < N; ++i) found.slopes[i] = derivative * slopes[i];
        return found;
    }
    // a of this number and b of another one, with such a value.
    Dual joined(double at, double a, const Dual &other, double b) const {
        Dual found{at};
        for (std::size_t i = 0; i < N; ++i) found.slopes[i] = a * slopes[i] + b * other.slopes[i];
        return found;
    }

    friend Dual operator+(const Dual &a, const Dual &b) {
        return a.joined(a.value + b.value, 1.0, b, 1.0);
    }
    friend Dual operator-(const Dual &a, const Dual &b) {
        return a.joined(a.value - b.value, 1.0, b, -1.0);
    }
    friend Dual operator*(const Dual &a, const Dual &b) {
        return a.joined(a.value * b.value, b.value, b, a.value);
    }
    friend Dual operator/(const Dual &a, const Dual &b) {
        const double part = a.value / b.value;
        return a.joined(part, 1.0 / b.value, b, -part / b.value);
    }
    friend Dual operator+(const Dual &a, double b) { return a.mapped(a.value + b, 1.0); }
    friend Dual operator-(const Dual &a, double b) { return a.mapped(a.value - b, 1.0); }
    friend Dual operator*(double a, const Dual &b) { return b.mapped(a * b.value, a); }
};

template <std::size_t N>
Dual<N> sin(const Dual<N> &a) {
    return a.mapped(std::sin(a.value), std::cos(a.value));
}

template <std::size_t N>
Dual<N> cos(const Dual<N> &a) {
    return a.mapped(std::cos(a.value), -std::sin(a.value));
}

// The root of a number, or `least` where that is larger, with the slope of such a root.
template <std::size_t N>
Dual<N> sqrt(const Dual<N> &a, double least) {
    const double root = a.value > least * least ? std::sqrt(a.value) : least;
    return a.mapped(root, 0.5 / root);
}

}  // namespace shapespline
