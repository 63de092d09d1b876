// Equations h = 0 between lines and circles that together have a vector of unknowns, each written
// once: their slopes are those of the formula. Unknowns of a line are its direction of travel and
// its offset along the left normal, of a circle the centre and the radius.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "shapespline/base/dual.hpp"
#include "shapespline/base/vec2.hpp"

namespace shapespline::drawn {

// Values of equations at x and their rows of the Jacobian over its n unknowns.
class Linearised {
  public:
    explicit Linearised(std::span<const double> x) : x_(x) {}

    std::size_t n() const { return x_.size(); }
    double unknown(std::int64_t i) const { return x_[i]; }
    const std::vector<double> &values() const { return values_; }
    const std::vector<double> &rows() const { return rows_; }

    // The unknowns at some places; slopes are counted in that order.
    template <std::size_t N>
    std::array<Dual<N>, N> at(const std::array<std::int64_t, N> &places) const {
        std::array<Dual<N>, N> found;
        for (std::size_t i = 0; i < N; ++i) found[i] = Dual<N>::unknown(x_[places[i]], i);
        return found;
    }
    // An equation, its unknowns at these places.
    template <std::size_t N>
    void add(const Dual<N> &h, const std::array<std::int64_t, N> &places) {
        begin();
        add_part(1.0, h, places);
    }
    // An equation of parts, to which these are added.
    void begin() {
        values_.push_back(0.0);
        rows_.resize(rows_.size() + n(), 0.0);
    }
    template <std::size_t N>
    void add_part(double part, const Dual<N> &h, const std::array<std::int64_t, N> &places) {
        double *row = rows_.data() + rows_.size() - n();
        values_.back() += part * h.value;
        for (std::size_t i = 0; i < N; ++i) row[places[i]] += part * h.slopes[i];
    }

  private:
    std::span<const double> x_;
    std::vector<double> values_, rows_;
};

// x[a] - sign x[b] = turn, for each of some pairs; of one unknown where b is missing.
struct Difference {
    std::vector<std::int64_t> a, b;
    double turn, sign;

    void tell(Linearised &rows) const {
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::int64_t other = b.empty() ? a[k] : b[k];
            const double part = b.empty() ? 0.0 : sign;
            rows.add(Dual<2>{rows.unknown(a[k]) - turn - part * rows.unknown(other), {1.0, -part}},
                     {a[k], other});
        }
    }
};

// A line with unknowns at `a` touches the circle at `b`, which turns by `way`.
struct LineTouches {
    std::int64_t a, b;
    double way;

    void tell(Linearised &rows) const {
        const std::array<std::int64_t, 5> places{a, a + 1, b, b + 1, b + 2};
        const auto [phi, d, cx, cy, r] = rows.at(places);
        rows.add(cos(phi) * cy - sin(phi) * cx - d - way * r, places);
    }
};

// Two circles touch, one within the other if they turn alike.
struct CirclesTouch {
    std::int64_t a, b;
    bool alike;

    void tell(Linearised &rows) const {
        const std::array<std::int64_t, 6> places{a, a + 1, a + 2, b, b + 1, b + 2};
        const auto [ax, ay, r, bx, by, s] = rows.at(places);
        const auto x = ax - bx, y = ay - by;
        const double inner = alike ? (r.value > s.value ? 1.0 : -1.0) : 0.0;
        rows.add(sqrt(x * x + y * y, 1e-300) - (alike ? inner * (r - s) : r + s), places);
    }
};

// A line or a circle with unknowns at `a` goes through a point.
struct PassesThrough {
    std::int64_t a;
    bool is_line;
    Vec2 point;

    void tell(Linearised &rows) const {
        if (is_line) {
            const std::array<std::int64_t, 2> places{a, a + 1};
            const auto [phi, d] = rows.at(places);
            rows.add(point.y * cos(phi) - point.x * sin(phi) - d, places);
            return;
        }
        const std::array<std::int64_t, 3> places{a, a + 1, a + 2};
        const auto [cx, cy, r] = rows.at(places);
        const auto x = cx - point.x, y = cy - point.y;
        rows.add(sqrt(x * x + y * y, 1e-300) - r, places);
    }
};

// The elements at `b` are the images of those at `a`: turned by an angle about the centre that is
// at `at`, or mirrored; direction and offset of the axis are there then. All are lines, or circles.
struct Images {
    std::vector<std::int64_t> a, b;
    std::int64_t at;
    bool is_line;
    std::optional<double> angle;

    void tell(Linearised &rows) const {
        for (std::size_t k = 0; k < a.size(); ++k)
            if (is_line)
                tell_line(rows, a[k], b[k]);
            else
                tell_circle(rows, a[k], b[k]);
    }

  private:
    void tell_line(Linearised &rows, std::int64_t i, std::int64_t j) const {
        const std::array<std::int64_t, 6> places{i, i + 1, j, j + 1, at, at + 1};
        const auto [phi, d, psi, e, u, v] = rows.at(places);
        if (angle) {
            const auto turned = phi + *angle;
            const auto off = cos(phi) * v - sin(phi) * u - d;  // of the centre from the line
            rows.add(sin(psi - turned), places);
            rows.add(e - (cos(turned) * v - sin(turned) * u - off), places);
            return;
        }
        const auto turned = 2.0 * u - phi + std::numbers::pi;
        // The foot of the origin, mirrored.
        const auto [px, py] = mirrored(-1.0 * (sin(phi) * d), cos(phi) * d, u, v);
        rows.add(sin(psi - turned), places);
        rows.add(e - (cos(turned) * py - sin(turned) * px), places);
    }
    void tell_circle(Linearised &rows, std::int64_t i, std::int64_t j) const {
        const std::array<std::int64_t, 8> places{i, i + 1, i + 2, j, j + 1, j + 2, at, at + 1};
        const auto [cx, cy, r, dx, dy, s, u, v] = rows.at(places);
        const auto [px, py] = angle ? turned(cx, cy, u, v) : mirrored(cx, cy, u, v);
        // The radii first: centres of arcs that touch their neighbours follow from these.
        rows.add(s - r, places);
        rows.add(dx - px, places);
        rows.add(dy - py, places);
    }
    template <class T>
    std::pair<T, T> turned(const T &x, const T &y, const T &u, const T &v) const {
        const double c = std::cos(*angle), s = std::sin(*angle);
        return {u + c * (x - u) - s * (y - v), v + s * (x - u) + c * (y - v)};
    }
    // About the axis of direction u and offset v.
    template <class T>
    static std::pair<T, T> mirrored(const T &x, const T &y, const T &u, const T &v) {
        const T far = 2.0 * (cos(u) * y - sin(u) * x - v);
        return {x + far * sin(u), y - far * cos(u)};
    }
};

// What a line meets: the line or circle with unknowns at `at`. `side` of a circle is 1 or -1 where
// the line meets it after or before the foot of its centre, 0 where it touches it there.
struct End {
    std::int64_t at;
    bool is_line;
    double side;
};

// A line with unknowns at `at` between what it meets. Circles that it misses by the part `touches`
// of their radius touch.
struct Edge {
    std::int64_t at;
    End begin, end;
    double touches;

    // Adds the length in the line's direction, so many times, to the last equation.
    void add_length(Linearised &rows, double part) const {
        add_met(rows, part, end);
        add_met(rows, -part, begin);
    }
    double length(std::span<const double> x) const {
        Linearised rows(x);
        rows.begin();
        add_length(rows, 1.0);
        return rows.values().back();
    }

  private:
    // Where along the line it meets something.
    void add_met(Linearised &rows, double part, const End &one) const {
        if (one.is_line) {
            const std::array<std::int64_t, 4> places{at, at + 1, one.at, one.at + 1};
            const auto [phi, d, psi, e] = rows.at(places);
            const auto turn = phi - psi;
            rows.add_part(part, (e - d * cos(turn)) / sin(turn), places);
            return;
        }
        const std::array<std::int64_t, 5> places{at, at + 1, one.at, one.at + 1, one.at + 2};
        const auto [phi, d, cx, cy, r] = rows.at(places);
        auto along = cos(phi) * cx + sin(phi) * cy;
        if (one.side != 0.0) {  // half a chord from the foot of the centre
            const auto off = cos(phi) * cy - sin(phi) * cx - d;
            along = along + one.side * sqrt(r * r - off * off, touches * r.value);
        }
        rows.add_part(part, along, places);
    }
};

// Two edges are equally long.
struct EqualLengths {
    Edge a, b;

    void tell(Linearised &rows) const {
        rows.begin();
        a.add_length(rows, 1.0);
        b.add_length(rows, -1.0);
    }
};

using Equation =
    std::variant<Difference, LineTouches, CirclesTouch, PassesThrough, Images, EqualLengths>;

inline Linearised linearised(std::span<const Equation> equations, std::span<const double> x) {
    Linearised found(x);
    for (const Equation &one : equations)
        std::visit([&](const auto &equation) { equation.tell(found); }, one);
    return found;
}

}  // namespace shapespline::drawn
