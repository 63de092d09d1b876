# The compiled loops (kernels/bindings). They check and convert nothing: arrays must be
# C-contiguous float64 (first: int64) of the shapes said here, outputs are written in place.
# nc = len(knots) - degree - 1 unrolled coefficients, m distinct control points, n data points.
from collections.abc import Callable, Sequence
from typing import TypeAlias

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
def arc_length(
    vertices: FloatArray,  # (k, 2)
    along: FloatArray,  # out (k,)
) -> None: ...

class Flattening:
    """Points on a curve so dense that the chords between them stay near it."""

    SAMPLING: float
    COARSEST: float

    def __init__(
        self,
        knots: FloatArray,
        degree: int,
        coefficients: FloatArray,  # (nc, 2)
        sampling: float | None,
        longest: float,  # of the diagonal
    ) -> None: ...
    @property
    def diagonal(self) -> float: ...
    @property
    def wanted(self) -> float: ...  # steps, not yet whole
    @property
    def n_points(self) -> int: ...  # while no more than memory holds are wanted
    def write(
        self,
        points: FloatArray,  # out (n_points, 2)
        parameters: FloatArray,  # out (n_points,)
    ) -> None: ...

def corner_parameters(
    knots: FloatArray,
    degree: int,
    coefficients: FloatArray,  # (nc, 2)
    closed: bool,
    least: float,  # radians
) -> list[float]: ...
def elevated(
    points: FloatArray,  # (p + 1, 2)
    degree: int,
    out: FloatArray,  # out (degree + 1, 2)
) -> None: ...
def polygon_lengths(
    counts: list[int],  # of the control points of pieces
    points: FloatArray,  # of all, (sum of counts, 2)
) -> list[float]: ...

class JoinedPieces:
    """Pieces end to end as one clamped B-spline over [0, 1]; those of lower degree are Beziers."""

    def __init__(
        self,
        degrees: list[int],  # of the pieces
        counts: list[int],  # of their control points
        knots: FloatArray,  # of all, one after another
        points: FloatArray,  # of all, (sum of counts, 2)
        degree: int,
        same: float,  # radians
    ) -> None: ...
    @property
    def n_points(self) -> int: ...
    def write(
        self,
        knots: FloatArray,  # out (n_points + degree + 1,)
        points: FloatArray,  # out (n_points, 2)
    ) -> None: ...

def make_tangents_common(
    degrees: list[int],
    counts: list[int],
    points: FloatArray,  # in and out (sum of counts, 2)
    largest_move: float,
    nearly: float,  # radians
    closed: bool,
) -> None: ...

MOST_BESIDE_CORNER: int

def line_to_corners(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    coefficients: FloatArray,  # (nc, 2)
    vertices: FloatArray,  # (k, 2), k >= 2
    parameters: FloatArray,  # (k,)
    corners: FloatArray,  # (c,)
    line: FloatArray,  # out (k + c * MOST_BESIDE_CORNER, 2)
) -> int: ...  # how many were written
def nearest_on_curve(
    knots: FloatArray,
    degree: int,
    coefficients: FloatArray,
    queries: FloatArray,  # (n, 2)
    parameters: FloatArray,  # out (n,)
    distances_sq: FloatArray,  # out (n,)
) -> None: ...
def nearest_points(
    points: FloatArray,  # (k, 2), k >= 1
    queries: FloatArray,  # (n, 2)
    nearest: IntArray,  # out (n,), of points as near the first
    distances: FloatArray,  # out (n,)
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

# Asked now and then with the number of points, 0 before there is a curve; true ends the search.
_Ask = Callable[[int], bool]

class DescentLimits:
    def __init__(
        self,
        *,
        max_iterations: int,
        max_evaluations: int,
        relative_decrease: float,
        gradient_tolerance: float,
        target_cost: float,  # minus infinity for none
        start_damping: float,
        patience: int,
    ) -> None: ...

class LeastSquares:
    """What stays while control points (m, 2) and parameters (n,) move."""

    def __init__(
        self,
        knots: FloatArray,
        degree: int,
        periodic: bool,
        points: FloatArray,  # (n, 2)
        weights: FloatArray | None,  # (n,)
        held: int = 0,  # parameters that stay: 0 none, 1 the ends, 2 all
        control_ends_fixed: bool = False,
        stray_weight: float = 0.0,
    ) -> None: ...
    def cost(self, control_points: FloatArray, parameters: FloatArray) -> float: ...
    def cost_and_gradient(
        self,
        control_points: FloatArray,
        parameters: FloatArray,
        control_gradient: FloatArray,  # out (m, 2)
        parameter_gradient: FloatArray,  # out (n,)
    ) -> float: ...
    def gauss_newton_diagonal(
        self,
        control_points: FloatArray,
        parameters: FloatArray,
        control_diagonal: FloatArray,  # out (m,)
        parameter_diagonal: FloatArray,  # out (n,)
    ) -> None: ...
    def damped_step(
        self,
        control_points: FloatArray,
        parameters: FloatArray,
        damping: float,
        control_step: FloatArray,  # out (m, 2)
        parameter_step: FloatArray,  # out (n,)
        # (n,), parts of the residuals along the tangent that count
        along: FloatArray | None = None,
    ) -> tuple[bool, float, float, float]: ...  # solved, cost, predicted cost, gradient norm
    def descend(
        self,
        control_points: FloatArray,  # in and out
        parameters: FloatArray,  # in and out
        limits: DescentLimits,
        ask: _Ask,
    ) -> tuple[
        int, list[tuple[float, float, int, float, float]]
    ]: ...  # why it ended; of each iteration cost, gradient norm, evaluations, step, seconds
    def eliminated_equations(
        self,
        control_points: FloatArray,
        parameters: FloatArray,
        equations: FloatArray,  # out: the cost, the right side, the matrix; of chunks they add up
    ) -> None: ...

def near_feet(
    knots: FloatArray,
    degree: int,
    periodic: bool,
    control_points: FloatArray,
    points: FloatArray,
    steps: int,
    parameters: FloatArray,  # in and out (n,)
) -> None: ...
def eliminated_size(n_points: int, degree: int, periodic: bool) -> int: ...
def eliminated_step(
    degree: int,
    periodic: bool,
    sums: FloatArray,  # of the equations of all chunks
    damping: float,
    control_step: FloatArray,  # out (m, 2)
) -> tuple[bool, float, float]: ...  # solved, predicted decrease, gradient norm
def told_by_others(
    points: FloatArray,  # (n, 2)
    told: IntArray,  # (m,)
    offsets: IntArray,  # (k,)
    rows: FloatArray,  # (terms, k)
    noise: FloatArray,  # (n,)
    off: FloatArray,  # out (m,)
    rest: FloatArray,  # out (m,)
) -> None: ...
def windows_of_seven(
    points: FloatArray,  # (n, 2)
    closed: bool,
    step: int,
    windows: FloatArray,  # out (2, m, 7): every so many-th of n, or of n - 6 if open
) -> None: ...
def left_across(
    rows: FloatArray,  # (2, m, 8)
    sums: FloatArray,  # out (m,)
) -> None: ...
def left_at_twice_the_angle(
    rows: FloatArray,  # (2, m, 8)
) -> tuple[float, float]: ...
def largest_bulge(points: FloatArray, closed: bool) -> float: ...  # (n, 2), n >= 5

LEAST_TURN: float
LOW_TURN: float

def find_corners(
    points: FloatArray,  # (n, 2)
    closed: bool,
    arc_length: FloatArray,  # (n,), or (n + 1,) if closed
    sigma: float,
    tolerance: float,
    turns: FloatArray,  # out (n,)
) -> tuple[list[int], float]: ...  # indices, the length looked at
def centroid_distances_sq(points: FloatArray, distances_sq: FloatArray) -> None: ...  # (n, 2), (n,)
def canonical_reading(
    points: FloatArray,  # (n, 2)
    closed: bool,
    weights: FloatArray | None = None,  # (n,)
) -> tuple[int, int]: ...  # first index, 1 or -1

class PosedContour:
    def __init__(
        self,
        points: FloatArray,  # (n, 2)
        closed: bool,
        radius: float,
        fine: float,  # of the grid, in the unit of the points
        finest: float,  # of the grid, where the radius is as long as said
        out: FloatArray,  # (n, 2)
    ) -> None: ...
    @property
    def start(self) -> int: ...
    @property
    def step(self) -> int: ...
    @property
    def middle(self) -> tuple[float, float]: ...
    @property
    def axis(self) -> tuple[float, float]: ...
    @property
    def side(self) -> float: ...
    @property
    def scale(self) -> float: ...
    @property
    def apart(self) -> bool: ...

def thinned(
    points: FloatArray, distance: float, longest: float, marked: IntArray | None
) -> list[int]: ...  # indices that stay

class PiecesBudget:
    def __init__(
        self, *, stride: int, resolution: float, every: int, passes: int, thorough: bool
    ) -> None: ...

class PiecesSettings:
    def __init__(
        self,
        *,
        tolerance: float,
        largest_degree: int,  # 1 to 3
        smooth: bool,
        ends_fixed: bool,
        least_corner: float,  # radians
        budget: PiecesBudget,
    ) -> None: ...

class PiecesOutline:
    def __init__(
        self,
        points: FloatArray,  # (n, 2)
        closed: bool,
        joint: IntArray,  # (n,), sum of 1 corner, 2 pinned, 4 and 8 tangent to an extension
        forced: IntArray,  # (n,), 0 or 1
        low_turn: IntArray,  # (n,), 0 or 1
    ) -> None: ...

class PiecesFound:
    """Sections end to end, none if the search was ended before there were any."""

    @property
    def degrees(self) -> list[int]: ...
    @property
    def counts(self) -> list[int]: ...  # of control points
    def write(
        self,
        knots: FloatArray,  # out (sum of counts + degrees + 1,)
        points: FloatArray,  # out (sum of counts, 2)
    ) -> None: ...

def fit_pieces(
    outline: PiecesOutline,
    settings: PiecesSettings,
    ask: _Ask,
    observed: FloatArray | None = None,  # (n, 2): the sections are fitted to these in the end
    noise: float = 0.0,
) -> PiecesFound: ...

class FitStage:
    def __init__(
        self,
        half_power: int,  # of the p-norm
        iterations: int,
        intervals_free: bool,
        give_up: float,  # the largest distance in tolerances to go on with
    ) -> None: ...

class RemovalEffort:
    def __init__(self, n_side: int, stages: list[FitStage]) -> None: ...

class FitLimits:
    def __init__(
        self,
        *,
        tolerance: float,
        enough: float,  # tolerances
        samples_per_span: int,
        sample_weight: float,
        least_interval: float,
        largest_interval: float,
        stagnation_limit: float,
    ) -> None: ...

class Fairness:
    def __init__(self, *, interval_ratio: float, speed_ratio: float) -> None: ...

class Patience:
    def __init__(
        self,
        failures: int,  # in a row
        distance: float,  # tolerances
    ) -> None: ...

class SplineSettings:
    def __init__(
        self,
        *,
        fit: FitLimits,
        fairness: Fairness,
        keep_fair: bool,
        start: int,  # 0 few knots, 1 more, 2 the data polyline
        most_at_start: int,  # control points
        accept: float,  # tolerances
        trying: Patience,
        retrying: Patience,
    ) -> None: ...

class RemovalSearch:
    def __init__(
        self,
        data: FloatArray,  # (n, 2)
        closed: bool,
        degree: int,
        settings: SplineSettings,
        ask: _Ask,
    ) -> None: ...
    def remove_cheapest(
        self, rank: RemovalEffort, effort: RemovalEffort, most_trials: int, ask: _Ask
    ) -> int: ...
    def retry(self, effort: RemovalEffort, redistributions: list[int], ask: _Ask) -> int: ...
    def curve(self) -> tuple[list[float], list[float]]: ...  # intervals; control points x, y, ...
    def n_points(self) -> int: ...
    def from_polyline(self) -> bool: ...
    def counts(self) -> dict[str, int]: ...

def count_crossings(vertices: FloatArray) -> int: ...  # (k, 2), an open polyline

# Of a curve by its chords (k, 2) beside a polyline (n, 2), n > 1.
def hook_places(
    vertices: FloatArray, polyline: FloatArray, tolerance: float, closed: bool
) -> list[tuple[float, float]]: ...

# Polyline i has the vertices from starts[i] up to starts[i + 1].
def crossing_pairs(
    vertices: FloatArray, starts: IntArray, at_vertices: bool
) -> list[tuple[int, int]]: ...

class Sides:
    # Polyline i as in crossing_pairs; how far along it each vertex is; the lengths of closed ones,
    # infinite of open ones.
    def __init__(
        self, vertices: FloatArray, along: FloatArray, starts: IntArray, rounds: FloatArray
    ) -> None: ...
    def across(
        self,
        points: FloatArray,  # (n, 2)
        along: FloatArray,  # of polyline `own`
        own: int,
        reach: float,
        around: float,  # times the distance
        least: float,
        across: FloatArray,  # (n, 2), written
    ) -> None: ...

class JointPrices:
    def __init__(
        self,
        *,
        line_line_smooth: float,  # in prices of a parameter
        line_arc_smooth: float,
        arc_arc_smooth: float,
        arc_arc_corner: float,
        line_free_smooth: float,
        arc_free_smooth: float,
        free_corner: float,
        arc_free_corner: float,
    ) -> None: ...

class NodeLengths:
    def __init__(
        self,
        *,
        skip: float,  # points this near to a node do not count
        shortest: float,  # of a piece
        gap: float,  # longest step beside which a corner may lie between two points
    ) -> None: ...

class SegmentationSettings:
    def __init__(
        self,
        *,
        deviation: float,
        lengths: NodeLengths,
        price: float,  # nats per parameter
        free_parameters: float,  # of a free-form curve
        smooth_turn: float,  # tangent
        stride: int,  # points
        joints: JointPrices,
    ) -> None: ...

def drawn_pieces(
    points: FloatArray,  # (n, 2) within [-1, 1]
    stations: FloatArray,  # (n,)
    weights: FloatArray,  # (n,)
    candidates: IntArray,
    nodes: IntArray,  # empty: all points
    directions: FloatArray,  # (n, 2) unit vectors: a line along one takes its offset alone
    settings: SegmentationSettings,
) -> tuple[list[tuple[int, int, int]], float]: ...  # begin, end, kind of each; the cost
def line_through(
    points: FloatArray,  # (n, 2)
    weights: FloatArray,  # (n,)
) -> tuple[float, float]: ...  # direction of travel, offset along the left normal
def circle_through(
    points: FloatArray,  # (n, 2)
    weights: FloatArray,  # (n,)
) -> tuple[float, float, float]: ...  # centre, radius

# Element k has the unknowns from at[k] on and the points from begins[k] up to begins[k + 1].
class Elements:
    def __init__(
        self,
        is_line: list[bool],
        at: list[int],
        begins: list[int],
        points: FloatArray,  # (n, 2)
        weights: FloatArray,  # (n,)
        counts: FloatArray,  # (n,), the weights if all points are as sure
        deviation: float,
    ) -> None: ...
    def misfits(
        self,
        x: FloatArray,  # (n,)
    ) -> list[tuple[float, float, float]]: ...  # chi squared, what points count, largest distance
    def covariance(
        self,
        x: FloatArray,  # (n,)
        floors: FloatArray,  # (n_elements, 3), systematic errors of their unknowns
        covariance: FloatArray,  # (n, n), blocks written
        precision: FloatArray,  # (n, n), blocks written
    ) -> None: ...

class EquationLimits:
    def __init__(
        self,
        *,
        largest: float,  # squared standard errors that one row may be off by
        largest_each: float,  # the part of it that each of several rows has
        span: float,  # 0: it need not be a surprise
        least_surprise: float,  # nats
        implied: float,  # part of a variance
        met: float,
    ) -> None: ...

class Difference:
    def __init__(
        self, a: Sequence[int], b: Sequence[int], turn: float = 0.0, sign: float = 1.0
    ) -> None: ...

class LineTouches:
    def __init__(self, a: int, b: int, way: float) -> None: ...

class CirclesTouch:
    def __init__(self, a: int, b: int, alike: bool) -> None: ...

class PassesThrough:
    def __init__(self, a: int, is_line: bool, x: float, y: float) -> None: ...

class Images:
    def __init__(
        self,
        a: Sequence[int],
        b: Sequence[int],
        at: int,
        is_line: bool,
        angle: float | None = None,
    ) -> None: ...

class End:
    def __init__(self, at: int, is_line: bool, side: float = 0.0) -> None: ...

class Edge:
    def __init__(self, at: int, begin: End, end: End, touches: float) -> None: ...
    def length(
        self,
        x: FloatArray,  # (n,)
    ) -> float: ...

class EqualLengths:
    def __init__(self, a: Edge, b: Edge) -> None: ...

Equation: TypeAlias = (
    Difference | LineTouches | CirclesTouch | PassesThrough | Images | EqualLengths
)

def equation_values(
    equations: Sequence[Equation],
    x: FloatArray,  # (n,)
) -> list[float]: ...
def take_equation(
    x: FloatArray,  # (n,), changed if the equation holds
    covariance: FloatArray,  # (n, n), changed if it does
    equation: Equation,
    limits: EquationLimits,
) -> bool: ...

class EstimateLimits:
    def __init__(
        self,
        *,
        rounds: int,
        extent: float,  # of the outline
        least_step: float,  # in parts of the extent
        longest_step: float,  # in parts of the extent, or of the largest unknown
        implied: float,  # part of its entries that an equation of its own leaves
    ) -> None: ...

def estimate(
    elements: Elements,
    equations: Sequence[Equation],
    x: FloatArray,  # (n,), changed
    limits: EstimateLimits,
) -> None: ...

class MeetingSteps:
    def __init__(
        self,
        elements: Elements,
        equations: Sequence[Equation],
        x: FloatArray,  # (n,)
        extent: float,
        implied: float,
    ) -> None: ...
    def n_free(self) -> int: ...
    def covariance(
        self,
        precision: FloatArray,  # (n, n)
        covariance: FloatArray,  # (n, n), written
    ) -> None: ...
