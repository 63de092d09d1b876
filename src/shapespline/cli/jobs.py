"""Work on many files: one after another, in several processes, or on a cluster."""

from __future__ import annotations

import contextlib
import signal
import sys
import warnings
from typing import TYPE_CHECKING

import shapespline as ss
from shapespline.cli.reports import Report

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor, Future
    from pathlib import Path

    from rich.progress import Progress, ProgressColumn

    Work = Callable[[Path, Path], Report]


def run_all(
    work: Work,
    pairs: Sequence[tuple[Path, Path]],
    *,
    n_jobs: int = 1,
    scheduler: str | None = None,
) -> Iterator[Report]:
    """Reports of all pairs of input and output, as they are done. One that fails stops no other.

    On Ctrl-C the work that has begun is finished, no other begins.
    """
    with _progress(len(pairs)) as advance, _executor(n_jobs, len(pairs), scheduler) as executor:
        if executor is None:
            for source, target in pairs:
                yield _guarded(work, source, target)
                advance()
            return
        from concurrent.futures import as_completed

        futures: dict[Future[Report], Path] = {
            executor.submit(_guarded, work, source, target): source for source, target in pairs
        }
        try:
            for future in as_completed(futures):
                error = future.exception()
                if error is None:
                    yield future.result()
                else:
                    yield Report(str(futures[future]), error=f"a worker failed: {error!r}")
                advance()
        finally:
            for future in futures:
                future.cancel()


def _guarded(work: Work, source: Path, target: Path) -> Report:
    """The report of one input, or of its failure; warnings become remarks."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", UserWarning)
        try:
            report = work(source, target)
        except (ss.ShapesplineError, OSError, MemoryError) as error:
            report = Report(str(source), error=" ".join(str(error).split()) or type(error).__name__)
    report.remarks[:0] = [str(warning.message) for warning in caught]
    return report


@contextlib.contextmanager
def _executor(n_jobs: int, n_pairs: int, scheduler: str | None) -> Iterator[Executor | None]:
    if scheduler is not None:
        try:
            from dask.distributed import Client
        except ImportError as error:
            raise ss.MissingExtraError(
                "--scheduler needs dask: pip install 'shapespline[cluster]'"
            ) from error
        try:
            client = Client(scheduler, timeout="10s")  # type: ignore[no-untyped-call]
        except (OSError, ValueError) as error:
            raise ss.InvalidInputError(f"no scheduler answers at {scheduler}: {error}") from error
        with client, client.get_executor() as executor:  # type: ignore[no-untyped-call]
            yield executor
    elif n_jobs == 1 or n_pairs == 1:
        yield None
    else:
        from concurrent.futures import ProcessPoolExecutor

        with ProcessPoolExecutor(min(n_jobs, n_pairs), initializer=_leave_to_parent) as executor:
            yield executor


def _leave_to_parent() -> None:
    """Ctrl-C reaches the workers too: they finish the file in hand, the parent stops the rest."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextlib.contextmanager
def _progress(total: int) -> Iterator[Callable[[], object]]:
    """A bar on a terminal, nothing in a pipe."""
    if total == 1 or not sys.stderr.isatty():
        yield lambda: None
        return
    from rich.progress import MofNCompleteColumn

    with _bar(MofNCompleteColumn()) as bar:
        task = bar.add_task("", total=total)
        yield lambda: bar.advance(task)


@contextlib.contextmanager
def point_progress() -> Iterator[Callable[[int, int], object] | None]:
    """A bar of the points passed of one long outline; not beside other workers."""
    import multiprocessing

    if not sys.stderr.isatty() or multiprocessing.parent_process() is not None:
        yield None
        return
    from rich.progress import TaskProgressColumn

    with _bar(TaskProgressColumn()) as bar:
        task = bar.add_task("")
        yield lambda done, total: bar.update(task, completed=done, total=total)


def _bar(how_far: ProgressColumn) -> Progress:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TimeRemainingColumn

    columns = (BarColumn(), how_far, TimeRemainingColumn())
    return Progress(*columns, console=Console(stderr=True), transient=True)
