"""The watch over a search: what it tells its caller, and when it has to end."""

from __future__ import annotations

from math import inf, nan
from time import monotonic
from typing import TYPE_CHECKING

from shapespline.arrays import is_number
from shapespline.drawing import Iteration, Status
from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from collections.abc import Callable


class Watch:
    """Reports the progress of a search to a callback, and ends it when told to or when time is up.

    Parameters
    ----------
    callback : callable, optional
        Called with an Iteration; a true answer ends the search.
    time_limit : float, optional
        Seconds from now.

    Attributes
    ----------
    ended_as : Status or None
        CANCELLED or BUDGET once the search has to end.
    history : list of Iteration
        One record per stage.

    Examples
    --------
    >>> watch = Watch(callback=lambda record: record.cost < 50)
    >>> watch.stage(80), watch.ends(60), watch.ends(40), watch.ended_as == Status.CANCELLED
    (False, False, True, True)
    """

    def __init__(
        self,
        callback: Callable[[Iteration], bool | None] | None = None,
        time_limit: float | None = None,
    ) -> None:
        if time_limit is not None and not (is_number(time_limit) and time_limit > 0):
            raise InvalidInputError(
                f"time_limit must be a positive number of seconds, got {time_limit!r};"
                " leave it out for none"
            )
        self._callback = callback
        self._begin = monotonic()
        self._limit = inf if time_limit is None else float(time_limit)
        self.ended_as: Status | None = None
        self.history: list[Iteration] = []

    @property
    def seconds(self) -> float:
        """Time since the watch was set."""
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
        if self.ended_as is None:
            if self._callback is not None and self._callback(record):
                self.ended_as = Status.CANCELLED
            elif self.seconds > self._limit:
                self.ended_as = Status.BUDGET
        return self.ended_as is not None

    def verdict(self, found: Status) -> Status:
        """The status of a fit that this watch may have ended: how, and what was found."""
        if self.ended_as is None:
            return found
        if self.ended_as == Status.CANCELLED:
            how = f"cancelled by the callback after {self.seconds:.3g} s"
        else:
            how = f"the time limit of {self._limit:.6g} s ran out, give more to go on"
        return self.ended_as.saying(f"{how}: {found.value}")

    def _record(self, n_points: int) -> Iteration:
        index = max(len(self.history) - 1, 0)
        return Iteration(index, float(n_points), nan, nan, 0, nan, self.seconds)
