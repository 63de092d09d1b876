"""fit_many: many contours, in order, with failures kept apart; on any executor."""

from __future__ import annotations

from collections.abc import Sized
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from shapespline.errors import ShapesplineError
from shapespline.fitting.request import Request
from shapespline.fitting.settings import Settings
from shapespline.fitting.solve import solve
from shapespline.monitor import Monitor

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from concurrent.futures import Executor, Future

    from shapespline.typing import ArrayLike
    from shapespline.values import Contour, Fit

    Outcome = Fit | Exception

# A task holds contours until it has so many points, or so many contours: small enough to share the
# work evenly and to report progress, large enough that handing it over costs next to nothing.
TASK_POINTS = 5_000
TASK_CONTOURS = 64


@dataclass(frozen=True, eq=False)
class Batch:
    """What became of many contours, in their order.

    Attributes
    ----------
    fits : tuple of Fit or None
        None where a contour could not be fitted.
    failures : dict of int to Exception
        Why, by index; a ShapesplineError says what to do.
    """

    fits: tuple[Fit | None, ...]
    failures: Mapping[int, Exception]

    def __len__(self) -> int:
        return len(self.fits)

    def __iter__(self) -> Iterator[Fit | None]:
        return iter(self.fits)

    def __getitem__(self, index: int) -> Fit | None:
        return self.fits[index]


def fit_many(
    contours: Iterable[ArrayLike | Contour],
    *,
    executor: Executor | None = None,
    progress: Callable[[int, int], object] | None = None,
    **options: Any,
) -> Batch:
    """Fit a curve to each of many contours; one that fails does not stop the others.

    Parameters
    ----------
    contours : iterable of Contour or array_like of shape (n, 2)
    executor : concurrent.futures.Executor, optional
        Where to work: a pool of processes or threads (the kernels let threads run side by side),
        or a dask ``Client``. In this thread when not given. The result is the same.
    progress : callable, optional
        Called with the number of contours done and of all; a true answer cancels what has not
        begun. The fits that are done are returned, the others count as failures.
    **options
        Those of `fit_curve`, but for its callback; the same for every contour.

    Returns
    -------
    Batch
        ``batch[i]`` is the Fit of contour i, or None, and then ``batch.failures[i]`` says why.

    Raises
    ------
    InvalidInputError
        If an option is not one of `fit_curve`, or is not usable whatever the contour.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    >>> circle = np.column_stack([np.cos(t), np.sin(t)])
    >>> batch = fit_many([circle, circle[:1], 3 * circle], tolerance=0.01)
    >>> [fit is not None and fit.kept for fit in batch], sorted(batch.failures)
    ([True, False, True], [1])
    """
    closed = options.pop("closed", None)
    settings = Settings.from_dict(options)
    given = list(contours)
    outcomes: list[Outcome] = [ShapesplineError("not fitted: the run was cancelled")] * len(given)
    done = 0
    for indices, found in _completed(given, executor, _Asked(closed, settings)):
        for index, outcome in zip(indices, found, strict=True):
            outcomes[index] = outcome
        done += len(indices)
        if progress is not None and progress(done, len(given)):
            break
    failures = {i: found for i, found in enumerate(outcomes) if isinstance(found, Exception)}
    fits = tuple(None if isinstance(found, Exception) else found for found in outcomes)
    return Batch(fits, failures)


def _completed(
    contours: Sequence[ArrayLike | Contour],
    executor: Executor | None,
    asked: _Asked,
) -> Iterator[tuple[range, Sequence[Outcome]]]:
    """Tasks as they are done; leaving the loop early cancels those that have not begun."""
    if executor is None:
        for index, contour in enumerate(contours):
            yield range(index, index + 1), _fit_all([contour], asked)
        return
    if hasattr(executor, "get_executor"):  # a dask client
        executor = executor.get_executor()
    from concurrent.futures import as_completed

    futures: dict[Future[list[Outcome]], range] = {}
    try:
        for task in _tasks(contours):
            futures[executor.submit(_fit_all, contours[task.start : task.stop], asked)] = task
        for future in as_completed(futures):
            error = future.exception()
            task = futures[future]
            if isinstance(error, Exception):  # the worker died, or the result did not get through
                yield task, [error] * len(task)
            elif error is not None:
                raise error
            else:
                yield task, future.result()
    finally:
        for future in futures:
            future.cancel()


def _tasks(contours: Sequence[ArrayLike | Contour]) -> Iterator[range]:
    """Runs of neighbouring contours of about equal work."""
    begin, n_points = 0, 0
    for index, contour in enumerate(contours):
        n_points += len(contour) if isinstance(contour, Sized) else 0
        if n_points >= TASK_POINTS or index + 1 - begin >= TASK_CONTOURS:
            yield range(begin, index + 1)
            begin, n_points = index + 1, 0
    if begin < len(contours):
        yield range(begin, len(contours))


class _Asked(NamedTuple):
    """What is asked of every contour."""

    closed: object
    settings: Settings


def _fit_all(contours: Sequence[ArrayLike | Contour], asked: _Asked) -> list[Outcome]:
    """The fit of each contour, or the exception that it raised."""
    outcomes: list[Outcome] = []
    for contour in contours:
        try:
            request = Request.of(contour, asked.closed, asked.settings)  # type: ignore[arg-type]
            outcomes.append(solve(request, Monitor(None, asked.settings.time_limit)))
        except Exception as error:  # whatever it is, it concerns this contour alone
            outcomes.append(error)
    return outcomes
