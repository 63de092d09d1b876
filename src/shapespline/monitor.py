"""Monitor: what a search tells its caller (a callback), and when it has to end (a time limit)."""

from __future__ import annotations

from enum import Enum
from math import inf, nan
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from shapespline.errors import InvalidInputError
from shapespline.validation import is_number

if TYPE_CHECKING:
    from collections.abc import Callable

    Callback: TypeAlias = Callable[["Iteration"], bool | None]
    # What is told what comes next, in words; an exception that it raises ends the work.
    Say: TypeAlias = Callable[[str], object]


def silent(sentence: str) -> None:
    """Nobody listens."""


class Iteration(NamedTuple):
    """One record of a fit's history, the start's first; evaluations and seconds count from there.

    ``paper_error`` is the paper's E_i, the root of the sum of squared residuals over n - 1.
    ``step`` is the accepted step length (line search) or the damping (Levenberg-Marquardt), 0 where
    nothing moved; ``gradient_norm`` is the norm that the solver works in. With a tolerance a record
    stands for a stage of the search: ``cost`` is its number of points (0 before there is a curve).
    What does not apply is NaN.
    """

    iteration: int
    cost: float
    paper_error: float
    gradient_norm: float
    evaluations: int
    step: float
    seconds: float


class End(Enum):
    """Why a monitor ended a search."""

    CANCELLED = "cancelled by the callback"
    TIME = "the time limit ran out"


class Monitor:
    """Reports the progress of a search to a callback, and ends it when told to or when time is up.

    Parameters
    ----------
    callback : callable, optional
        Called with an Iteration; a true answer ends the search.
    time_limit : float, optional
        Seconds from now.

    Attributes
    ----------
    ended : End or None
        Why the search has to end, once it has to.
    history : list of Iteration
        One record per stage.

    Examples
    --------
    >>> monitor = Monitor(callback=lambda record: record.cost < 50)
    >>> monitor.stage(80), monitor.ends(60), monitor.ends(40), monitor.ended
    (False, False, True, <End.CANCELLED: 'cancelled by the callback'>)
    """

    def __init__(self, callback: Callback | None = None, time_limit: float | None = None) -> None:
        self._callback = callback
        self._begin = monotonic()
        limit = checked_time_limit(time_limit)
        self.time_limit = inf if limit is None else limit
        self.ended: End | None = None
        self.history: list[Iteration] = []

    @property
    def of_iterations(self) -> Callback | None:
        """What a solver calls after each iteration; None where nobody listens and time is no limit.

        Then it need not come out of the kernel for each of them, and asks `ends` now and then.
        """
        unheard = self._callback is None and self.time_limit == inf
        return None if unheard else self.iterated

    @property
    def seconds(self) -> float:
        """Time since the monitor was made."""
        return monotonic() - self._begin

    def stage(self, n_points: int) -> bool:
        """Note a stage that begins with so many points, 0 for no curve yet; whether to end."""
        record = self._record(n_points)._replace(iteration=len(self.history))
        self.history.append(record)
        return self.iterated(record)

    def ends(self, n_points: int) -> bool:
        """Whether the search has to end, which has so many points."""
        return self.iterated(self._record(n_points))

    def iterated(self, record: Iteration) -> bool:
        """Whether the search has to end after this iteration."""
        if self.ended is None:
            if self._callback is not None and self._callback(record):
                self.ended = End.CANCELLED
            elif self.seconds > self.time_limit:
                self.ended = End.TIME
        return self.ended is not None

    def _record(self, n_points: int) -> Iteration:
        index = max(len(self.history) - 1, 0)
        return Iteration(index, float(n_points), nan, nan, 0, nan, self.seconds)


def checked_time_limit(value: object) -> float | None:
    """A positive number of seconds, None for no limit."""
    if value is None:
        return None
    if not (is_number(value) and value > 0):  # type: ignore[operator]
        raise InvalidInputError(
            f"time_limit must be a positive number of seconds, got {value!r}; leave it out for none"
        )
    return float(value)  # type: ignore[arg-type]
