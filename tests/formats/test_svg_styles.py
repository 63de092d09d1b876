"""Style sheets of SVG: which rules hold for an element, which of them wins, what is not read."""

from __future__ import annotations

import io
import warnings
from xml.etree import ElementTree

import pytest

import shapespline as ss
from shapespline.errors import SkippedContentWarning
from shapespline.formats import svg_styles as subject

BODY = (
    '<g class="a outer" id="g"><g><rect class="b c" id="r" width="1" height="1" fill="red"'
    ' style="stroke: blue"/></g></g>'
)


def rect(sheet, body=BODY):
    """Attributes of the rect under a style sheet, and what is left out."""
    root = ElementTree.fromstring(f"<svg><defs><style>{sheet}</style></defs>{body}</svg>")
    unread = subject.styled(root)
    return next(root.iter("rect")).attrib, unread


@pytest.mark.parametrize(
    ("selector", "holds"),
    [
        ("rect", True),
        ("*", True),
        (".b", True),
        ("#r", True),
        ("rect.b.c#r", True),
        (".b, path", True),
        ("path, .b", True),
        ("g .b", True),
        (".a .b", True),
        ("svg .outer g rect", True),
        ("g&gt;rect", True),
        ("g.a &gt; g &gt; rect", True),
        ("svg #g &gt; g rect", True),
        ("circle", False),
        (".d", False),
        ("rect.d", False),
        (".b .c", False),
        (".a &gt; rect", False),
        ("svg &gt; rect", False),
        ("g g g rect", False),
        ("#r g", False),
    ],
)
def test_selectors(selector, holds):
    found, unread = rect(f"{selector} {{fill: none; cursor: pointer}}")
    assert found["fill"] == ("none" if holds else "red")
    assert found["stroke"] == "blue"
    assert "style" not in found
    assert "cursor" not in found
    assert unread == []


@pytest.mark.parametrize(
    ("sheet", "fill", "stroke"),
    [
        (".b{fill:one} .c{fill:two}", "two", "blue"),
        (".b{fill:one} rect{fill:two}", "one", "blue"),
        ("#r{fill:one} .a .b.c{fill:two}", "one", "blue"),
        ("g rect{fill:one} rect{fill:two}", "one", "blue"),
        ("rect{stroke:one}", "red", "blue"),
        ("rect{stroke:one !important}", "red", "one"),
        ("rect{fill:one ! important} #r{fill:two}", "one", "blue"),
        ("rect{fill:one!important;fill:two}", "one", "blue"),
        ("@import url(x.css); @media print{.b{fill:one} .c{fill:two}} rect{fill:three}",
         "three", "blue"),
        ("@font-face{src:url(a)} /* .b{fill:one} */ rect{fill:two}", "two", "blue"),
        ("rect{fill:inherit}", None, "blue"),
        ("rect{FILL : one", "one", "blue"),
    ],
)  # fmt: skip
def test_which_rule_wins(sheet, fill, stroke):
    found, unread = rect(sheet)
    assert (found.get("fill"), found["stroke"]) == (fill, stroke)
    assert unread == []


def test_an_important_style_of_an_element_wins():
    body = '<rect style="fill: one !important"/>'
    assert rect("rect{fill:two !important}", body)[0]["fill"] == "one"


def test_sizes_come_from_rules_but_for_pages():
    found, _ = rect("rect{width:7px}")
    assert found["width"] == "7px"
    root = ElementTree.fromstring('<svg width="4in" style="width:100%"><style/></svg>')
    subject.styled(root)
    assert root.attrib == {"width": "4in"}


def test_selectors_that_need_more_are_named_once():
    sheet = (
        "a:hover{fill:red} .b + .c{fill:none} .b+.c{stroke:none} [x]{cursor:move} &gt;g{fill:red}"
    )
    found, unread = rect(sheet)
    assert (found["fill"], found["stroke"]) == ("red", "blue")
    assert unread == ["a:hover", ".b + .c", ".b+.c", ">g"]


def test_rules_hold_for_what_is_read():
    """A rule for the page, and one for an element where it is used again."""
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><style>{}</style>'
    body = '<g class="a"><rect id="r" width="1" height="1"/></g><use href="#r" x="3"/></svg>'

    def read(sheet):
        return ss.read(io.BytesIO((head.format(sheet) + body).encode()), format=".svg")

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(read("")) == 2
        with pytest.raises(ss.ShapesplineError, match="no visible path or shape"):
            read("svg{fill:none}")
        with pytest.raises(ss.ShapesplineError, match="no visible path or shape"):
            read(".a rect{display:none}")
        assert len(read(".a{display:none}")) == 1
    with pytest.warns(SkippedContentWarning, match="left out: style rules for 'a:hover', 'x~y';"):
        read("a:hover, x~y{fill:none}")
