# The compiled loops (kernels/bindings). They check and convert nothing: arrays must be
# C-contiguous float64 (first: int64) of the shapes said here, outputs are written in place.
# nc = len(knots) - degree - 1 unrolled coefficients, m distinct control points, n data points.
from collections.abc import Callable

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
def steps_wanted(
    beziers: FloatArray,  # (s * (degree + 1), 2)
    degree: int,
    distance: float,
    longest: float,
    wanted: FloatArray,  # out (s,)
) -> None: ...
def chord_points(
    beziers: FloatArray,  # (s * (degree + 1), 2)
    degree: int,
    breakpoints: FloatArray,  # (s + 1,)
    counts: IntArray,  # (s,)
    points: FloatArray,  # out (sum of counts + 1, 2)
    parameters: FloatArray,  # out (sum of counts + 1,)
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
    along: FloatArray | None = None,  # (n,), parts of the residuals along the tangent that count
) -> tuple[bool, float, float, float]: ...  # solved, cost, predicted cost, gradient norm
def near_feet(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    steps: int,
    parameters: FloatArray,  # in and out (n,)
) -> None: ...
def eliminated_equations(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    weights: FloatArray | None,
    stray_weight: float,
    equations: FloatArray,  # out: the cost, the right side, the matrix; of chunks they add up
) -> None: ...
def eliminated_size(n_points: int, degree: int, periodic: bool) -> int: ...
def eliminated_step(
    degree: int,
    periodic: bool,
    sums: FloatArray,  # of the equations of all chunks
    damping: float,
    control_step: FloatArray,  # out (m, 2)
) -> tuple[bool, float, float]: ...  # solved, predicted decrease, gradient norm
def corner_turns(
    points: FloatArray,  # (k, 2)
    stations: FloatArray,  # (k,), increasing
    vertices: IntArray,  # (n,), below k
    length: float,
    turns: FloatArray,  # out (n,)
) -> None: ...

# Asked now and then with the number of points, 0 before there is a curve; true ends the search.
_Ask = Callable[[int], bool]

def mean_distances(points: FloatArray, distances_sq: FloatArray) -> None: ...  # (n, 2), (n,)
def thinned(
    points: FloatArray, distance: float, longest: float, marked: IntArray | None
) -> list[int]: ...  # indices that stay
def fit_sections(
    points: FloatArray,  # (n, 2)
    closed: bool,
    joint: IntArray,  # (n,), sum of 1 corner, 2 pinned, 4 and 8 tangent to a stub
    forced: IntArray,  # (n,), 0 or 1
    gentle: IntArray,  # (n,), 0 or 1
    stride: int,
    resolution: float,
    every: int,
    tolerance: float,
    largest_degree: int,  # 1 to 3
    smooth: bool,
    ends_fixed: bool,
    least_corner: float,
    passes: int,
    thorough: bool,
    ask: _Ask,
    observed: FloatArray | None = None,  # (n, 2): the sections are fitted to these in the end
    noise: float = 0.0,
) -> tuple[
    list[int], list[int], list[float], list[float]
]: ...  # of each section: degree, number of points, knots and coordinates end to end

# Stages of a fit: half the power p, iterations, whether gaps are free, and the largest distance in
# tolerances at which the next stage is still begun.
_Effort = tuple[int, list[tuple[int, int, bool, float]]]  # free control points a side, stages

class RemovalSearch:
    def __init__(
        self,
        data: FloatArray,  # (n, 2)
        closed: bool,
        degree: int,
        tolerance: float,
        keep_rule: bool,
        start: int,
        gap_ratio: float,
        speed_ratio: float,
        least_gap: float,
        largest_gap: float,
        enough: float,
        accept: float,
        samples_per_span: int,
        sample_weight: float,
        hope: float,
        worth_trying: float,
        worth_insisting: float,
        ask: _Ask,
    ) -> None: ...
    def remove_cheapest(
        self, rank: _Effort, effort: _Effort, most_trials: int, ask: _Ask
    ) -> int: ...
    def remove_stubborn(self, effort: _Effort, spreads: list[int], ask: _Ask) -> int: ...
    def curve(self) -> tuple[list[float], list[float]]: ...  # gaps, control points x, y in turn
    def n_points(self) -> int: ...
    def from_polyline(self) -> bool: ...
    def counts(self) -> dict[str, int]: ...

def count_crossings(vertices: FloatArray) -> int: ...  # (k, 2), an open polyline
