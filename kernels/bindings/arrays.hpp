// Arrays as they come from Python, the spans that the kernels read and write, and the caller's
// question.
#pragma once

#include <nanobind/ndarray.h>

#include <cstdint>
#include <span>

#include "shapespline/base/interruption.hpp"
#include "shapespline/curve/bspline.hpp"

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

// The caller's question, and its Ctrl-C; called while the GIL is released.
inline ss::Interruption interruption(const nb::object &ask) {
    return ss::Interruption([&ask](long n_points) {
        nb::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        return nb::cast<bool>(ask(n_points));
    });
}
