"""G-code, run by an interpreter of its own: what a machine cuts is the curve that was fitted."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from tests.support.gcode import Machine
from tests.support.pieces import bezier

import shapespline as ss
from checks import two_sided
from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats import gcode
from shapespline.geometry import exact_fit
from shapespline.values import Arc, Drawing, Piece

# Two units of the last decimal where a flat arc became a line, one of a rounded centre.
ROUNDED = 3e-4
STEP = 0.02


def ran(drawing, step=STEP, **options):
    return Machine(step).run(gcode.encode(drawing, **options).decode())


def apart(fit, cut, step=STEP):
    """Distances of a cut to a curve and back, by the outside checker."""
    found = two_sided(fit.curve, np.array(cut), closed=False, step=step)
    return found.larger - STEP**2 / 8  # what the chord of an arc of radius 1 bows by


def plate():
    """A square with a round hole and a slot, and an open mark."""
    square = [bezier((0, 0), (60, 0)), bezier((60, 0), (60, 40)), bezier((60, 40), (0, 40))]
    square.append(bezier((0, 40), (0, 0)))
    hole = [Piece.of_arc(Arc((15.0, 20.0), 6.0, 0.5, -2 * pi))]
    slot = [
        bezier((30, 15), (50, 15)),
        Piece.of_arc(Arc((50, 20), 5.0, -pi / 2, pi), begin=(50, 15), end=(50, 25)),
        bezier((50, 25), (30, 25)),
        Piece.of_arc(Arc((30, 20), 5.0, pi / 2, pi), begin=(30, 25), end=(30, 15)),
    ]
    mark = [bezier((70, 0), (75, 10), (80, -10), (90, 5))]
    fits = [exact_fit(pieces) for pieces in (square, hole, slot, mark)]
    return Drawing(fits, [-1, 0, 0, -1], unit="mm")


def test_a_machine_cuts_the_curves_holes_first():
    drawing = plate()
    machine = ran(drawing, depth=1.5, feed=250, arc_tolerance=0.01)
    assert (machine.unit, machine.feed, machine.depths) == ("mm", 250.0, {-1.5})
    order = [drawing.fits[index] for index in (1, 2, 0, 3)]
    for fit, cut in zip(order, machine.cuts, strict=True):
        is_exact = fit is not drawing.fits[3]
        assert apart(fit, cut) <= (0 if is_exact else 0.01) + ROUNDED
        assert np.abs(cut[0] - cut[-1]).max() == 0 or not fit.closed
    text = gcode.encode(drawing, arc_tolerance=0.01).decode()
    assert text.count("arcs within 0.01 mm of its curve") == 1
    # A circle in two halves, clockwise as it was drawn; the slot's two; biarcs of the mark.
    assert machine.moves["G2"] >= 2
    assert machine.moves["G3"] >= 2
    assert machine.place[2] == 5.0


@pytest.mark.slow
def test_splines_become_arcs_within_what_is_asked(outline):
    fit = ss.fit_curve(outline("hand620_closed"), tolerance=0.3)
    drawing = Drawing([fit], unit="mm")
    coarse, fine = ran(drawing, 0.2, arc_tolerance=0.1), ran(drawing, 0.1, arc_tolerance=0.02)
    assert 0.01 < apart(fit, coarse.cuts[0], 0.2) <= 0.1 + ROUNDED + 0.2**2 / 8
    assert apart(fit, fine.cuts[0], 0.2) <= 0.02 + ROUNDED + 0.1**2 / 8
    assert sum(coarse.moves.values()) < sum(fine.moves.values())
    # A quarter of the tolerance of the fit if nothing is said.
    assert apart(fit, ran(drawing, 0.2).cuts[0], 0.2) <= 0.25 * 0.3 + ROUNDED + 0.2**2 / 8


def test_units():
    line = exact_fit([bezier((0, 0), (1, 2))])
    inches = ran(Drawing([line], unit="in"))
    assert (inches.unit, inches.cuts[0][-1].tolist(), inches.place[2]) == ("in", [1, 2], 0.2)
    assert inches.feed == pytest.approx(500 / 25.4, abs=0.05)
    centimetres = ran(Drawing([line], unit="cm"))
    assert (centimetres.unit, centimetres.cuts[0][-1].tolist()) == ("mm", [10, 20])
    assert ran(Drawing([line])).cuts[0][-1].tolist() == [1, 2]
    with pytest.raises(FormatError, match="the drawing is in pixels: give unit='mm' and scale"):
        gcode.encode(Drawing([line], unit="px"))


def test_what_a_controller_would_misread():
    """Arcs too small to end elsewhere than they begin, too flat, or with a centre too far."""
    tiny = Piece.of_arc(Arc((1.0, 0.0), 1e-5, -pi, pi))
    flat = Arc.through((1 + 2e-5, 0), (9, 0), 1e-5)
    far = Arc.through((9, 0), (90, 0), 0.004)  # a radius of 20 m
    pieces = [bezier((0, 0), (1 - 1e-5, 0)), tiny, Piece.of_arc(flat), Piece.of_arc(far)]
    fit = exact_fit(pieces)
    machine = ran(Drawing([fit], unit="mm"), arc_tolerance=0.01)
    assert machine.moves["G2"] + machine.moves["G3"] == 0
    assert apart(fit, machine.cuts[0]) <= 0.01 + ROUNDED
    text = gcode.encode(Drawing([fit], unit="mm"), arc_tolerance=0.01).decode()
    assert "e-" not in text
    assert "-0 " not in text


def test_what_is_refused(tmp_path):
    fit = exact_fit([bezier((0, 0), (1, 2))])
    for options, message in (
        ({"feed": 0}, "feed must be a number, positive, got 0"),
        ({"depth": -1}, "depth must be a number, 0 or more, got -1"),
        ({"safe_height": float("inf")}, "safe_height must be a number, positive, got inf"),
        ({"arc_tolerance": 0}, "arc_tolerance must be a positive length, got 0"),
        ({"spindle": 5}, "spindle is not an option for x.nc"),
    ):
        with pytest.raises(InvalidInputError, match=message):
            ss.write(tmp_path / "x.nc", fit, **options)
    assert not list(tmp_path.iterdir())


def test_from_the_command_line(shapespline, tmp_path):
    ss.write(tmp_path / "plate.json", plate())
    typed = ["--depth", 2, "--feed", 300, "--safe-height", 8, "--arc-tolerance", 0.01]
    source, output = tmp_path / "plate.json", tmp_path / "plate.nc"
    code, _, err = shapespline("convert", source, "-o", output, *typed)
    assert (code, err) == (0, "")
    machine = Machine(STEP).run(output.read_text())
    assert (machine.depths, machine.feed, machine.place[2], len(machine.cuts)) == (
        {-2.0},
        300,
        8,
        4,
    )
