"""``shapespline fit``."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import click

import shapespline as ss
from shapespline.cli import options, settings_file
from shapespline.cli.declared import Option
from shapespline.cli.gathering import gathers
from shapespline.cli.panels import FIT, OUTPUT
from shapespline.cli.places import never_the_input
from shapespline.cli.reports import Report, drawing_record, drawing_remarks, drawing_text
from shapespline.cli.run_files import Batch, run_files
from shapespline.cli.waiting import said_when_long

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np

    from shapespline.fitting import Settings

# Bytes of an array file from which on it is passed over, not read at once, where nothing is asked
# that needs all points.
LARGE_FILE = 32_000_000
WANTED = {"tolerance", "n_control_points"}
# Setting -> the parameter of the command, where their names differ.
PARAMETERS = {"n_control_points": "control_points"}
IN_PASSES = WANTED | {"degree", "corners", "form", "effort", "time_limit"}


# Areas of colours are fitted within so many pixels if no tolerance is given, or so many times their
# accuracy: estimated one by one, borders of illustrations take longer and more points.
AREA_TOLERANCE, AREA_ACCURACIES = 0.2, 3.0


@dataclass(frozen=True)
class FitFile:
    """Read, fit, write and draw one file; sent to other processes as it is."""

    reading: options.Reading
    writing: options.Writing
    settings: Settings
    sigma_columns: str | None
    shared_boundaries: bool
    plot: Path | None
    many: bool
    alone: bool

    def __call__(self, source: Path, target: Path) -> Report:
        """Report of the file."""
        with said_when_long(self.alone) as say:
            say(f"reading {source.name}")
            large = self.mapped(source)
            if large is None:
                shape = self.reading.outlines(source, self.settings.tolerance, say)
                began = time.perf_counter()
                drawing = self.fitted(shape, source, say)
            else:
                began = time.perf_counter()
                drawing = self.fitted_in_passes(large, say)
            seconds = time.perf_counter() - began
            say(f"writing {target.name}")
            ss.write(target, drawing, **self.writing.given())
            picture = self.picture(source)
            if picture is not None:
                from shapespline.plotting import plot_fit

                say(f"drawing {picture.name}")
                plot_fit(drawing, picture)
        return Report(
            str(source),
            text=drawing_text(str(target), drawing, seconds, self.settings),
            record={"output": str(target), "seconds": seconds, **drawing_record(drawing)},
            remarks=drawing_remarks(drawing),
            exceeded=any(not fit.kept for fit in drawing),
        )

    def fitted(self, shape: ss.Shape, source: Path, say: Callable[[str], None]) -> ss.Drawing:
        """The fit of a shape in memory; areas of a picture's colours share their boundaries."""
        asked = self.settings.to_dict()
        if self.sigma_columns is not None:
            asked["sigma"] = self.reading.errors(source, self.sigma_columns)
        # A picture's areas lie side by side; a drawing's, upon each other, have no accuracy.
        accuracy = shape.longest.accuracy if any(shape.colors) else None
        shared = self.shared_boundaries or accuracy is not None
        if accuracy and not asked.keys() & WANTED:
            asked["tolerance"] = max(AREA_TOLERANCE, AREA_ACCURACIES * accuracy)
        n_points = sum(len(contour) for contour in shape)

        def tell(done: int, total: int) -> None:
            if done == total:
                say(f"all {total} curves fitted, now those that cross")
            else:
                say(f"curve {done + 1} of {total}, {n_points} points in all; --time-limit ends it")

        return ss.fit_shape(shape, shared_boundaries=shared, progress=tell, **asked)

    def mapped(self, source: Path) -> np.memmap | None:
        """The points of a file that is too large to be read at once, if there is no other need."""
        asked = set(self.settings.to_dict())
        if self.plot is not None or self.shared_boundaries or self.sigma_columns is not None:
            return None
        if not (asked & WANTED and asked <= IN_PASSES):
            return None
        if source.suffix.lower() != ".npy" or source.stat().st_size < LARGE_FILE:
            return None
        if set(self.reading.given()) - {"closed"}:
            return None
        import numpy as np

        try:
            points = np.load(source, mmap_mode="r", allow_pickle=False)
        except (ValueError, OSError):  # the reader says what is wrong with it
            return None
        return points if isinstance(points, np.memmap) else None

    def fitted_in_passes(self, points: np.memmap, say: Callable[[str], None]) -> ss.Drawing:
        """The fit of one outline of any number of points."""
        options = self.settings.to_dict()
        fit = ss.fit_large(
            points,
            closed=self.reading.closed,
            progress=lambda done, total: say(f"{done} of {total} points passed"),
            **options,
        )
        return ss.Drawing([fit])

    def picture(self, source: Path) -> Path | None:
        """Where the picture of one input goes."""
        if self.plot is None or not self.many:
            return self.plot
        return self.plot / f"{source.name}.png"

    def check(self, sources: Sequence[Path]) -> None:
        """Raise unless the pictures can be written."""
        if self.plot is None:
            return
        from shapespline.plotting import check_picture

        if self.many and not self.plot.is_dir():
            raise ss.InvalidInputError(
                f"--plot must name a folder for {len(sources)} inputs, got {self.plot};"
                " create it first"
            )
        for source in sources:
            picture = self.picture(source)
            if picture is not None:
                check_picture(picture)
                never_the_input(source, picture)


# long: every parameter is an option of the command.
@gathers(reading=options.Reading, writing=options.Writing)
def fit(
    sources: options.Inputs,
    output: options.OptionalOutput = None,
    ending: options.Format = None,
    tolerance: Annotated[
        str | None,
        Option(
            "--tolerance",
            "-t",
            help="Largest distance between data and curve, both ways: in the unit of the data, or a"
            " part of the box diagonal such as 0.1%.",
            panel=FIT,
        ),
    ] = None,
    control_points: Annotated[
        int | None,
        Option(
            "--control-points",
            "-n",
            help="Control points of each curve (default without a tolerance: found from the"
            " noise of the points or from what they can show).",
            panel=FIT,
        ),
    ] = None,
    degree: options.Degree = 3,
    corners: Annotated[
        Literal["auto", "free", "none"],
        Option(help="Keep corners, be free to round them, or know none.", panel=FIT),
    ] = "auto",
    form: Annotated[
        Literal["pieces", "spline", "arcs"],
        Option(
            help="Lines, Beziers and splines; one spline; or lines and arcs (within a tolerance).",
            panel=FIT,
        ),
    ] = "pieces",
    effort: Annotated[
        Literal["fast", "balanced", "smallest"],
        Option(help="How long to search for a smaller curve.", panel=FIT),
    ] = "balanced",
    ends: Annotated[
        Literal["free", "fixed"],
        Option(
            help="Of open curves: fixed ends are the first and last point, exactly.",
            panel=FIT,
        ),
    ] = "free",
    symmetric: Annotated[
        bool,
        Option("--symmetric", help="Keep a mirror symmetry of closed outlines exactly.", panel=FIT),
    ] = False,
    character: Annotated[
        Literal["drawn", "fewest"] | None,
        Option(
            help="Lines, arcs and corners as they were drawn first (where nothing speaks against"
            " it), or the fewest points.",
            panel=FIT,
        ),
    ] = None,
    smoothness: Annotated[int, Option(least=1, most=2, help="2: G2 joints.", panel=FIT)] = 1,
    regularities: Annotated[
        str,
        Option(
            help="As it was drawn, what may be kept exactly: auto, none, or names such as"
            " axis-parallel,tangent.",
            panel=FIT,
        ),
    ] = "auto",
    simplify: Annotated[
        bool,
        Option("--simplify", help="Drawn, without details below -t.", panel=FIT),
    ] = False,
    outliers: Annotated[
        bool,
        Option(
            "--outliers",
            help="Leave out points that jump off the path and back.",
            panel=FIT,
        ),
    ] = False,
    sigma: Annotated[
        str | None,
        Option(
            metavar="LENGTH|COLUMNS",
            help="Error of the points, one standard deviation: a length, or the column of a table"
            " (two for x and y), by name or as @3; the result says how sure it is.",
            panel=FIT,
        ),
    ] = None,
    loss: Annotated[
        Literal["huber", "tukey"] | None,
        Option(
            help="Large errors of the points count less, or no more; without a tolerance.",
            panel=FIT,
        ),
    ] = None,
    shared_boundaries: Annotated[
        bool,
        Option(
            "--shared-boundaries",
            help="Boundaries of two outlines are fitted once.",
            panel=FIT,
        ),
    ] = False,
    time_limit: Annotated[
        float | None,
        Option(
            help="Seconds for each curve; the best one so far is written after them.",
            panel=FIT,
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        Option(
            help="Also draw data, control polygon, curve and error as a PNG picture; a folder for"
            " many inputs.",
            panel=OUTPUT,
        ),
    ] = None,
    settings_path: Annotated[
        Path | None,
        Option(
            "--settings",
            help="Settings of the fit from a TOML or JSON file; what is typed goes before it.",
            panel=FIT,
        ),
    ] = None,
    save_settings: Annotated[
        Path | None,
        Option(
            "--save-settings",
            help="Write the settings of this fit to a file.",
            panel=OUTPUT,
        ),
    ] = None,
    force: options.Force = False,
    jobs: options.Jobs = 1,
    scheduler: options.Scheduler = None,
    resume: options.Resume = False,
    as_json: options.AsJson = False,
    stdin_format: options.StdinFormat = "csv",
    *,
    reading: options.Reading,
    writing: options.Writing,
) -> None:
    """Fit B-spline curves to the outlines of every INPUT and write them to files."""
    from shapespline.fitting import Settings

    asked = {
        "tolerance": tolerance,
        "n_control_points": control_points,
        "degree": degree,
        "corners": None if corners == "none" else corners,
        "form": form,
        "effort": effort,
        "ends": ends,
        "symmetric": symmetric,
        "character": character,
        "regularities": _regularities(regularities),
        "simplify": simplify,
        "smoothness": smoothness,
        "outliers": outliers,
        "sigma": length_of(sigma),
        "loss": loss,
        "time_limit": time_limit,
    }
    if settings_path is not None:
        typed = {name: value for name, value in asked.items() if _typed(name)}
        asked = settings_file.merged(settings_file.load(settings_path), typed)
    asked, writing = _as_arcs(asked, writing, ending or Path(output or "").suffix)
    sigma_columns = None if sigma is None or asked.get("sigma") is not None else sigma
    settings = Settings.from_dict(asked)
    if sigma_columns is not None:  # any length: refused beside what it would not act with
        Settings.from_dict({**asked, "sigma": 1.0})
    if save_settings is not None:
        settings_file.save(save_settings, settings)

    batch = Batch(
        sources,
        output,
        ending,
        stdin_format,
        as_json,
        jobs,
        scheduler,
        resume,
        writing.given(),
        force,
    )

    def work_on(found: Sequence[Path]) -> FitFile:
        work = FitFile(
            reading,
            writing,
            settings,
            sigma_columns,
            shared_boundaries,
            plot,
            many=len(found) > 1,
            alone=len(found) == 1,
        )
        work.check(found)
        return work

    run_files(work_on, batch)


def _as_arcs(
    asked: dict[str, Any], writing: options.Writing, ending: str
) -> tuple[dict[str, Any], options.Writing]:
    """What ``--arcs`` means: arcs fitted within a tolerance, else those that DXF makes of curves.

    With an accuracy of their own the arcs stand beside the curves that were fitted, as before.
    """
    fitted = asked.get("tolerance") is not None and writing.arc_tolerance is None
    if not (writing.arcs and fitted) or asked.get("form", "pieces") != "pieces":
        return asked, writing
    drawn = ending.lower().removeprefix(".") == "dxf"  # one polyline for each outline
    return asked | {"form": "arcs"}, replace(writing, arcs=drawn)


def length_of(sigma: str | None) -> float | None:
    """The length that was typed, None if it was the name of a column or nothing."""
    try:
        return None if sigma is None else float(sigma)
    except ValueError:
        return None


def _regularities(said: str) -> str | tuple[str, ...] | None:
    """Names between commas, auto, or none."""
    if said in ("auto", "none"):
        return said if said == "auto" else None
    return tuple(name.strip() for name in said.split(","))


def _typed(setting: str) -> bool:
    """Whether a setting was given on the command line, be it its default."""
    source = click.get_current_context().get_parameter_source(PARAMETERS.get(setting, setting))
    return source is not None and source.name == "COMMANDLINE"
