"""Work on many files: one after another, in several processes, or on a cluster."""

from __future__ import annotations

import contextlib
import signal
import warnings
from typing import TYPE_CHECKING

import shapespline as ss
from shapespline.cli.reports import Report
from shapespline.cli.waiting import said_when_long
from shapespline.errors import require

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor, Future
    from pathlib import Path

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
    total = len(pairs)
    with said_when_long(total > 1) as say, _executor(n_jobs, total, scheduler) as executor:
        say(f"0 of {total} files")
        if executor is None:
            for done, (source, target) in enumerate(pairs, 1):
                report = _guarded(work, source, target)
                say.hide()
                yield report
                say(f"{done} of {total} files")
            return
        from concurrent.futures import as_completed

        futures: dict[Future[Report], Path] = {
            executor.submit(_guarded, work, source, target): source for source, target in pairs
        }
        try:
            for done, future in enumerate(as_completed(futures), 1):
                error = future.exception()
                say.hide()
                if error is None:
                    yield future.result()
                else:
                    yield Report(str(futures[future]), error=f"a worker failed: {error!r}")
                say(f"{done} of {total} files")
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
    # What holds for several outlines is said once.
    report.remarks[:0] = dict.fromkeys(str(warning.message) for warning in caught)
    return report


@contextlib.contextmanager
def _executor(n_jobs: int, n_pairs: int, scheduler: str | None) -> Iterator[Executor | None]:
    if scheduler is not None:
        require("dask.distributed", "cluster", "--scheduler needs")
        from dask.distributed import Client

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
