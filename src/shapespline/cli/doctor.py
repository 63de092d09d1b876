"""``shapespline doctor``: whether this installation works, and what it can do."""

from __future__ import annotations

import os
import platform
import sys
import time

import click

import shapespline as ss

CORE = ("numpy", "scipy", "pillow", "svgelements", "click")
# Extra -> the package that it brings.
EXTRAS = {
    "dxf": "ezdxf",
    "plot": "matplotlib",
    "cad": "OCP",
    "rhino": "rhino3dm",
    "geo": "geopandas",
    "fonts": "fontTools",
    "cluster": "distributed",
    "studio": "uvicorn",
}


def doctor() -> None:
    """Print versions and extras, and fit a known curve, to see whether all is well."""
    click.echo(f"shapespline {ss.__version__}, Python {platform.python_version()}, {sys.platform}")
    click.echo(", ".join(f"{name} {_version(name)}" for name in CORE))
    from importlib import util

    for extra, module in EXTRAS.items():
        there = util.find_spec(module) is not None
        click.echo(f"{extra}: " + ("yes" if there else f'no; pip install "shapespline[{extra}]"'))
    click.echo(f"processors: {os.cpu_count()}; one fit takes one, --jobs takes more")
    began = time.perf_counter()
    fit = _known_fit()
    seconds = time.perf_counter() - began
    click.echo(f"self-check: {fit.n_stored_points} points, {seconds:.2f} s; {fit.status}")
    if not fit.kept:
        click.echo("the self-check failed: install the package again", err=True)
        raise click.exceptions.Exit(1)


def _version(name: str) -> str:
    from importlib import metadata

    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "missing"


def _known_fit() -> ss.Fit:
    """A flower of 2000 points, whose fit keeps its tolerance wherever the kernel is well."""
    import numpy as np

    t = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    r = 10 + 2 * np.sin(5 * t)
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    return ss.fit_curve(points, closed=True, tolerance="0.1%")
