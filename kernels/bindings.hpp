// Arrays as they come from Python, and the spans that the kernels read and write.
#pragma once

#include <nanobind/ndarray.h>

#include <cstdint>
#include <optional>
#include <span>

#include "shapespline/bspline.hpp"
#include "shapespline/samples.hpp"

namespace nb = nanobind;
namespace ss = shapespline;

template <class T, class... Extra>
using Array = nb::ndarray<T, nb::device::cpu, nb::c_contig, Extra...>;
using In1 = Array<const double, nb::ndim<1>>;
using In2 = Array<const double, nb::shape<-1, 2>>;
using Out1 = Array<double, nb::ndim<1>>;
using Out2 = Array<double, nb::ndim<2>>;
using OutPoints = Array<double, nb::shape<-1, 2>>;
using OutIndices = Array<std::int64_t, nb::ndim<1>>;
using InIndices = Array<const std::int64_t, nb::ndim<1>>;

inline std::span<const double> numbers(const In1 &a) { return {a.data(), a.shape(0)}; }
inline std::span<double> numbers(const Out1 &a) { return {a.data(), a.shape(0)}; }
inline std::span<const ss::Vec2> vectors(const In2 &a) {
    return {reinterpret_cast<const ss::Vec2 *>(a.data()), a.shape(0)};
}
inline std::span<ss::Vec2> vectors(const OutPoints &a) {
    return {reinterpret_cast<ss::Vec2 *>(a.data()), a.shape(0)};
}
inline std::span<const std::int64_t> indices(const InIndices &a) { return {a.data(), a.shape(0)}; }
inline ss::Knots knot_vector(const In1 &knots, int degree, bool periodic) {
    return {numbers(knots), degree, periodic};
}
inline ss::Samples samples(const In2 &points, const In1 &parameters,
                           const std::optional<In1> &weights, int held = 0,
                           bool control_ends_fixed = false, double stray_weight = 0.0) {
    return {vectors(points), numbers(parameters), weights ? weights->data() : nullptr,
            static_cast<ss::Held>(held), control_ends_fixed, stray_weight};
}
