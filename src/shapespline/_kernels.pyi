# The compiled loops (kernels/bindings.cpp). They check and convert nothing: arrays must be
# C-contiguous float64 (first: int64) of the shapes said here, outputs are written in place.
# nc = len(knots) - degree - 1 unrolled coefficients, m distinct control points, n data points.
from shapespline.typing import FloatArray, IntArray

MAX_DEGREE: int

def basis_functions(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    parameters: FloatArray,
    values: FloatArray,  # out (n, degree + 1)
    first: IntArray,  # out (n,)
) -> None: ...
def evaluate(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    coefficients: FloatArray,  # (nc, 2)
    parameters: FloatArray,
    out: FloatArray,  # out (n, 2)
) -> None: ...
def bezier_pieces(
    knots: FloatArray,
    degree: int,
    coefficients: FloatArray,
    points: FloatArray,  # out (spans * (degree + 1), 2)
    breakpoints: FloatArray,  # out (spans + 1,)
) -> None: ...
def nearest_on_curve(
    knots: FloatArray,
    degree: int,
    coefficients: FloatArray,
    queries: FloatArray,  # (n, 2)
    parameters: FloatArray,  # out (n,)
    distances_sq: FloatArray,  # out (n,)
) -> None: ...
def curve_deviation(
    knots: FloatArray,
    degree: int,
    coefficients: FloatArray,
    vertices: FloatArray,  # (k, 2), k >= 2
    relative_gap: float,
    floor: float,
) -> tuple[float, float, float]: ...  # lower, upper, parameter
def accumulate_chord_distances(
    points: FloatArray,
    length: int,
    closed: bool,
    signed_sums: FloatArray,  # out (n,)
    unsigned_sums: FloatArray,  # out (n,)
) -> None: ...
def cost(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,  # (m, 2)
    points: FloatArray,  # (n, 2)
    parameters: FloatArray,
    weights: FloatArray | None,
    stray_weight: float,
) -> float: ...
def cost_and_gradient(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    weights: FloatArray | None,
    held: int,  # parameters that stay: 0 none, 1 the ends, 2 all
    control_ends_fixed: bool,
    stray_weight: float,
    control_gradient: FloatArray,  # out (m, 2)
    parameter_gradient: FloatArray,  # out (n,)
) -> float: ...
def gauss_newton_diagonal(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    weights: FloatArray | None,
    control_diagonal: FloatArray,  # out (m,)
    parameter_diagonal: FloatArray,  # out (n,)
) -> None: ...
def damped_step(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    weights: FloatArray | None,
    held: int,  # parameters that stay: 0 none, 1 the ends, 2 all
    control_ends_fixed: bool,
    stray_weight: float,
    damping: float,
    control_step: FloatArray,  # out (m, 2)
    parameter_step: FloatArray,  # out (n,)
) -> tuple[bool, float, float, float]: ...  # solved, cost, predicted cost, gradient norm
