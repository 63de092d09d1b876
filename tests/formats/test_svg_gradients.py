"""Gradients, patterns and opacities of an SVG as one colour each."""

from __future__ import annotations

import io

import pytest

import shapespline as ss
from shapespline.errors import SkippedContentWarning

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:x="http://www.w3.org/1999/xlink"'
SQUARE = '<rect x="10" y="10" width="80" height="80" fill="url(#a)"/>'
LATE = '<stop offset="50%" stop-color="#ff0000"/>'
OF_B = '<linearGradient id="a" x:href="#b"/>'
RED, BLUE = '<stop stop-color="#ff0000"/>', '<stop offset="1" stop-color="#0000ff"/>'


def read(body):
    text = f'{HEAD} viewBox="0 0 100 100">{body}</svg>'
    return ss.read(io.BytesIO(text.encode()), format=".svg")


@pytest.mark.parametrize(
    ("gradient", "color"),
    [
        (f'<linearGradient id="a">{RED}{BLUE}</linearGradient>', "#800080"),
        (f'<radialGradient id="a">{RED}{BLUE}</radialGradient>', "#800080"),
        # Half of the way red, then towards blue.
        (f'<linearGradient id="a">{LATE}{BLUE}</linearGradient>', "#bf0040"),
        (f'<linearGradient id="a">{RED}</linearGradient>', "#ff0000"),
        ('<linearGradient id="a"><stop style="stop-color:#00ff00"/></linearGradient>', "#00ff00"),
        (f'<linearGradient id="b">{RED}{BLUE}</linearGradient>{OF_B}', "#800080"),
        # What is transparent counts less, and lets white paper through.
        (
            f'<linearGradient id="a">{RED}<stop offset="1" stop-color="blue" stop-opacity="0"/>'
            "</linearGradient>",
            "#ff8080",
        ),
    ],
)
@pytest.mark.parametrize("before", [True, False])
def test_a_gradient_is_its_mean(gradient, color, before):
    body = f"<defs>{gradient}</defs>{SQUARE}" if before else f"{SQUARE}<defs>{gradient}</defs>"
    with pytest.warns(SkippedContentWarning, match="left out: shades of gradients;"):
        drawing = read(body)
    assert drawing.colors == (color,)


def test_gradients_that_refer_to_each_other_end():
    turned = '<linearGradient id="a" href="#b"/><linearGradient id="b" href="#a"/>'
    drawing = read(turned + SQUARE)
    assert drawing.colors[0].startswith("#")


def test_areas_of_two_patterns_have_two_colours():
    pattern = '<pattern id="{}"><path d="M0 0h3"/></pattern>'
    body = pattern.format("a") + pattern.format("b") + SQUARE
    inner = SQUARE.replace("80", "20").replace("10", "40").replace("#a", "#b")
    drawing = read(body + inner)
    assert len(set(drawing.colors)) == 2
    assert drawing.parents == (-1, 0)


@pytest.mark.parametrize(
    ("style", "color"),
    [
        ('fill="red" fill-opacity="0.5"', "#ff8080"),
        ('fill="rgba(255, 0, 0, 0.2)"', "#ffcccc"),
        ('fill="red" opacity="50%"', "#ff8080"),
        ('fill="red" opacity="0.5" fill-opacity="0.5"', "#ffbfbf"),
        ('fill="#f00"', "#ff0000"),
        ('style="fill:hsl(120, 100%, 50%)"', "#00ff00"),
        ('fill="rgb(255 0 0 / 20%)"', "#ffcccc"),
        ('fill="rebeccapurple"', "#663399"),
        ('fill="url(#nowhere) #00ff00"', "#00ff00"),
    ],
)
def test_what_lets_paper_through_is_paler(style, color):
    assert read(f'<rect x="10" y="10" width="80" height="80" {style}/>').colors == (color,)


@pytest.mark.parametrize(
    ("style", "words"),
    [
        ('stroke-dasharray="4 2"', "dashes of strokes"),
        ('marker-mid="url(#m)"', "markers"),
        ('style="marker-mid: url(#m)"', "markers"),
        ('style="marker: url(#m)"', "markers"),
    ],
)
def test_what_is_not_kept_of_strokes_is_said(style, words):
    with pytest.warns(SkippedContentWarning, match=words):
        read(f'<path fill="none" stroke="black" {style} d="M10 10L50 50L90 10"/>')
