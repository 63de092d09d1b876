"""Outlines of painted areas: which are seen, which are holes, and what the picture looks like."""

from __future__ import annotations

import io
import math
import shutil
import subprocess
import warnings

import numpy as np
import pytest
from PIL import Image

import shapespline as ss
from shapespline.errors import SkippedContentWarning
from shapespline.formats.svg_areas import Areas

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
GROUND = '<rect width="100" height="100" fill="white"/>'


def picture(body):
    return f"{HEAD}{body}</svg>".encode()


def read(body):
    return ss.read(io.BytesIO(picture(body)), format=".svg")


def square(half, **style):
    """A square around (50, 50)."""
    more = " ".join(f'{name}="{value}"' for name, value in style.items())
    return f'<rect x="{50 - half}" y="{50 - half}" width="{2 * half}" height="{2 * half}" {more}/>'


def sizes(drawing):
    return [round(math.sqrt(fit.area) / 2, 9) for fit in drawing]


NONZERO = "M10 10h80v80h-80z"
EVEN_ODD = {"fill-rule": "evenodd"}
ONE_WAY, OTHER_WAY = "M30 30h40v40h-40z", "M30 30v40h40v-40z"


@pytest.mark.parametrize(
    ("body", "parents"),
    [
        # One element: its fill rule decides.
        (f'<path d="{NONZERO}{ONE_WAY}"/>', (-1, -1)),
        (f'<path d="{NONZERO}{OTHER_WAY}"/>', (-1, 0)),
        (f'<path d="{OTHER_WAY}{NONZERO}"/>', (1, -1)),
        (f'<path fill-rule="evenodd" d="{NONZERO}{ONE_WAY}"/>', (-1, 0)),
        (f'<g fill-rule="evenodd"><path d="{NONZERO}{ONE_WAY}M40 40h9v9h-9z"/></g>', (-1, 0, 1)),
        (f'<path d="{NONZERO}{OTHER_WAY}M40 40h9v9h-9z"/>', (-1, 0, 1)),
        # Several elements: a change of colour does.
        (square(40) + square(20), (-1, -1)),
        (square(40) + square(20, fill="rgb(0,0,0)", opacity="0.3"), (-1, -1)),
        (square(20) + square(40), (-1, -1)),
        (square(40) + square(20, fill="white"), (-1, 0)),
        (square(40) + square(20, fill="#FFF") + square(5), (-1, 0, 1)),
        (square(40, fill="red") + square(20, fill="gold"), (-1, 0)),
        (square(40, fill="red") + square(20, fill="gold") + square(5, fill="white"), (-1, 0, 1)),
        (square(40, fill="url(#a)") + square(20, fill="url(#b)"), (-1, 0)),
        # Both: the hole of a frame shows what another element painted there.
        (f'<path d="{NONZERO}{OTHER_WAY}"/>' + square(10), (-1, 0, 1)),
        (square(45) + f'<path d="{NONZERO}{OTHER_WAY}" fill="white"/>', (-1, 0, 1)),
        # Only white is drawn: it is no paper.
        (square(40, fill="white"), (-1,)),
        # Strokes without a fill are outlines; others count where they are seen.
        (f'<g fill="none" stroke="red">{square(40)}{square(20)}</g>', (-1, 0)),
        (square(40, fill="none", stroke="red") + square(20), (-1, 0)),
        (square(40) + square(20, stroke="white"), (-1, 0)),
        (square(40) + square(20, stroke="black"), (-1, -1)),
        (square(40, fill="white", stroke="black"), (-1,)),
    ],
)
def test_nesting_is_what_is_seen(body, parents):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read(body).parents == parents


@pytest.mark.parametrize(
    ("body", "left"),
    [
        (GROUND + square(30), [30]),
        (GROUND + square(30) + square(10, fill="white") + square(8, fill="white"), [30, 10]),
        (square(45, fill="white") + square(30, fill="none", stroke="black"), [30]),
    ],
)
def test_white_on_white_is_left_out_and_said(body, left):
    with pytest.warns(SkippedContentWarning, match="left out: white areas on white;") as caught:
        drawing = read(body)
    assert len(caught) == 1
    assert sizes(drawing) == left
    assert drawing.frame == (0, 0, 100, 100)


def test_what_is_painted_over_is_left_out():
    hidden = square(10, fill="gold") + square(30) + square(20, fill="white")
    assert sizes(read(square(40) + hidden)) == [40, 20]


def test_a_hole_goes_through_all_areas_of_one_colour():
    drawing = read(square(40) + square(30) + square(20, fill="white"))
    assert (sizes(drawing), drawing.parents) == ([40, 20], (-1, 0))


def test_of_outlines_that_coincide_one_is_kept():
    drawing = read(square(40) + square(40, fill="none", stroke="red") + square(9, fill="white"))
    assert (sizes(drawing), drawing.parents) == ([40, 9], (-1, 0))
    covered = square(40) + square(40, fill="white") + square(9, fill="none", stroke="black")
    with pytest.warns(SkippedContentWarning, match="white areas on white"):
        assert sizes(read(covered)) == [9]


STAR = "M50 5L76 86 7 36 93 36 24 86z"


@pytest.mark.parametrize(
    "body",
    [
        '<circle cx="40" cy="50" r="20"/><circle cx="60" cy="50" r="20"/>',
        '<circle cx="40" cy="50" r="20"/><rect y="45" width="100" height="9" fill="white"/>',
        f'<path d="{STAR}"/>',
    ],
)
def test_areas_partly_over_each_other_are_said(body):
    with pytest.warns(SkippedContentWarning) as caught:
        read(body)
    said = [str(warning.message) for warning in caught if "partly over" in str(warning.message)]
    assert len(said) == 1
    assert "neither united nor cut" in said[0]


@pytest.mark.parametrize(
    "body",
    [
        f'<path d="{STAR}" fill-rule="evenodd"/>',
        '<path d="M10 10L90 90L90 10L10 90z"/>',  # once around either half
        f'<path d="{STAR}" fill="none" stroke="red"/>' + square(30, fill="none", stroke="red"),
        # Neighbours share a border, bent or slanted, either way round.
        '<path d="M10 10C70 30 30 70 90 90L10 90z"/><path d="M90 90C30 70 70 30 10 10L90 10z"/>',
        '<path d="M10 10L77 93L10 90z"/><path d="M77 93L10 10L90 10z" fill="red"/>',
    ],
)
def test_areas_side_by_side_are_not_said(body):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read(body)


def test_nothing_to_be_seen_is_an_error():
    with (
        pytest.warns(SkippedContentWarning, match="white areas on white"),
        pytest.raises(ss.ShapesplineError, match="no visible path or shape"),
    ):
        read(square(10) + GROUND)


def rendered(data):
    done = subprocess.run(
        ["rsvg-convert", "-w", "200", "--background-color", "white"],
        input=data, capture_output=True, check=True,
    )  # fmt: skip
    return np.asarray(Image.open(io.BytesIO(done.stdout)).convert("L")) < 128


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="rsvg-convert is not installed")
@pytest.mark.filterwarnings("ignore::shapespline.errors.SkippedContentWarning")
@pytest.mark.parametrize(
    "body",
    [
        GROUND + square(40) + square(20),
        square(40) + square(30) + square(20, fill="white") + square(10),
        # Frames, one inside the other's border, and a bar across both: a box of an icon set.
        '<path d="M10 10v80h80v-80zM20 20h60v60h-60z"/>'
        '<path d="M10 10v30h80v-30zM20 20h60v12h-60z"/><path d="M45 10h10v60h-10z"/>',
        # A disc fills the hole of a ring of its own colour, from above and from beneath.
        f'<path d="{NONZERO}{OTHER_WAY}"/>' + square(30),
        square(30) + f'<path d="{NONZERO}{OTHER_WAY}"/>',
        # A hole whose corners touch the border.
        '<path d="M10 10h60v60h-60zM20 30v20h50v-20z"/>',
        GROUND + f'<path d="{NONZERO}{OTHER_WAY}"/>' + square(10, fill="white"),
    ],
)
def test_the_written_picture_looks_the_same(tmp_path, body):
    ss.write(tmp_path / "again.svg", read(body))
    ours = rendered((tmp_path / "again.svg").read_bytes())
    # Edges lie on pixels; those that rounding puts across one are fewer than one row.
    assert (ours != rendered(picture(body))).sum() < 100


def test_an_outline_that_is_drawn_hundreds_of_times_takes_no_longer_than_others(monkeypatch):
    """Where many coincide each was asked at its own places what all of them show there."""
    asked = []
    top = Areas.top

    def counted(areas, within):
        asked.append(len(within))
        return top(areas, within)

    monkeypatch.setattr(Areas, "top", counted)
    count = 300
    assert len(read("".join(square(20, fill=f"#{k:06x}") for k in range(count)))) == 1
    assert sum(asked) < 200 * count
