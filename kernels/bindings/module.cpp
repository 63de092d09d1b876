// The Python face of the kernels: checks nothing, converts nothing, releases the GIL.
//
// Callers validate and allocate; every array is C-contiguous float64 or int64 as declared in
// _kernels.pyi, and outputs are written in place.
#include "arrays.hpp"

void bind_curve(nb::module_ &m);
void bind_distance(nb::module_ &m);
void bind_analysis(nb::module_ &m);
void bind_least_squares(nb::module_ &m);
void bind_pieces(nb::module_ &m);
void bind_spline(nb::module_ &m);
void bind_drawn(nb::module_ &m);

NB_MODULE(_kernels, m) {
    // An interpreter that ends while a traceback or a worker still holds an object is no leak; a
    // user would read a page of warnings.
    nb::set_leak_warnings(false);
    m.attr("MAX_DEGREE") = ss::kMaxDegree;
    bind_curve(m);
    bind_distance(m);
    bind_analysis(m);
    bind_least_squares(m);
    bind_pieces(m);
    bind_spline(m);
    bind_drawn(m);
}
