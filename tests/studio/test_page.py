"""The page in a browser: its first screen, keys, narrow and wide, and what it leaves behind."""

import re

import numpy as np
import pytest
from benchmarks.studio import DONE, opened, soak, until
from tests.support.studio_page import LEAF, example, own, text

pytestmark = pytest.mark.slow


def test_the_first_screen_shows_a_fit_and_its_sentence(page):
    assert re.match(r"All 8 outlines are kept, the farthest within 0\.\d+ both", text(page))
    assert page.is_visible("#hints")
    page.click("#hints-away")
    page.reload()
    until(page, DONE)
    assert not page.is_visible("#hints")
    # Something is drawn: more than one colour in the middle of the canvas.
    picture = np.frombuffer(page.locator("#canvas").screenshot(), np.uint8)
    assert len(picture) > 5000


def test_what_is_to_be_known_of_a_fit_stands_below_its_figures(page):
    for tolerance, items in (("0.04", 1), ("0.5", 0)):
        page.fill("#tolerance-number", tolerance)
        page.keyboard.press("Enter")
        until(page, f"() => document.querySelectorAll('#remarks li').length === {items}")
    assert page.inner_text("#remarks") == ""


def test_everything_by_keyboard(page):
    example(page, LEAF)
    page.focus("#canvas")
    tolerance = page.evaluate("studio.store.now.tolerance")
    page.keyboard.press("ArrowUp")
    until(page, "() => studio.store.before === null")
    until(page, DONE)
    assert page.evaluate("studio.store.now.tolerance") > tolerance
    page.keyboard.press("]")
    assert "at point" in page.inner_text("#under")
    page.keyboard.press("h")
    until(page, DONE)
    assert len(own(page)["0"]["through"]) == 1
    page.keyboard.press("Alt+ArrowUp")
    until(page, DONE)
    assert len(own(page)["0"]["moved"]) == 1
    for _ in range(3):
        page.keyboard.press("z")
    assert own(page) == {}
    page.keyboard.press("/")
    assert page.is_visible("#help-dialog")
    assert page.locator("#keys tr").count() > 15
    page.keyboard.press("Escape")
    page.keyboard.press("e")
    assert page.is_visible("#export-dialog")
    page.keyboard.press("Escape")
    # Tab reaches the slider and what stands beyond it.
    reached = set()
    page.evaluate("document.activeElement.blur()")
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id"))
    assert {"open", "outlines", "canvas", "tolerance", "corners", "degree"} <= reached


def test_a_phone_shows_the_drawing_the_slider_and_the_sentence(browser, address):
    page = opened(browser, address, viewport={"width": 390, "height": 760}, has_touch=True)
    page.click("#hints-away")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    boxes = [page.locator(name).bounding_box() for name in ("#canvas", "#tolerance", "#sentence")]
    assert boxes[0]["height"] > 300
    assert all(box["y"] + box["height"] <= 760 for box in boxes)
    for sheet in ("left", "right", "graphs"):
        page.click(f"#sheets [data-sheet={sheet}]")
        assert page.is_visible(f"#{sheet}")
    page.click("#sheets [data-sheet=graphs]")
    assert not page.is_visible("#graphs")
    page.context.close()


def test_twice_as_large_nothing_is_cut_off_and_motion_is_reduced(browser, address):
    size = {"width": 640, "height": 400}
    page = opened(browser, address, viewport=size, device_scale_factor=2, reduced_motion="reduce")
    # The button lies within the hints, which lie within the page.
    page.click("#hints-away")
    assert page.evaluate("document.documentElement.scrollWidth") == size["width"]
    for name in ("#canvas", "#tolerance", "#sentence", "#export", "#sheets"):
        box = page.locator(name).bounding_box()
        assert 0 <= box["x"] <= box["x"] + box["width"] <= size["width"], name
        assert 0 <= box["y"] <= box["y"] + box["height"] <= size["height"], name
    # The sentence can be read as a whole.
    assert page.evaluate("(({scrollHeight: h, clientHeight: c}) => h <= c + 1)"
                         "(document.querySelector('#sentence'))")  # fmt: skip
    # Frames of the film are skipped where less motion is wanted.
    page.evaluate("studio.paper.films = {x: {asked: 'x', iterations: [...Array(100).keys()]}};"
                  "studio.paper.filmOf = 'x'; studio.paper.turnTo = f => window.last = f;"
                  "studio.graph.show = () => 0; studio.paper.play()")  # fmt: skip
    until(page, "() => window.last >= 10")
    assert page.evaluate("window.last % 10") == 0
    page.evaluate("studio.paper.stop()")
    page.context.close()


def test_graph_and_drawing_mark_each_other_and_distances_are_measured(page):
    example(page, LEAF)
    page.click("#hints-away")
    canvas = page.locator("#graph").bounding_box()
    page.mouse.move(canvas["x"] + 0.4 * canvas["width"], canvas["y"] + 50)
    until(page, "() => studio.graph.place !== null")
    place = page.evaluate("studio.graph.place")
    points = np.array(page.evaluate("[...studio.scene.shape.points]")).reshape(-1, 2)
    assert np.hypot(*(points - [place["x"], place["y"]]).T).min() == 0
    assert "off" in page.inner_text("#under")
    # The other way: over a point of the drawing its place in the graph is marked.
    box = page.locator("#canvas").bounding_box()
    x, y = page.evaluate("studio.scene.view.toScreen(...studio.scene.shape.points.slice(40, 42))")
    page.mouse.move(box["x"] + x, box["y"] + y)
    until(page, "() => studio.tools.hover !== null")
    at = page.evaluate("[studio.graph.mark, studio.scene.shape.at[studio.tools.hover.point]]")
    assert at[0] == at[1]
    page.click("#measure")
    page.mouse.move(box["x"] + 200, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 260, box["y"] + 280, steps=3)
    page.mouse.up()
    # A hundred pixels of the screen, unless an end snapped to a point nearby.
    scale = page.evaluate("studio.scene.view.scale")
    length = float(page.inner_text("#under").split()[0].rstrip(","))
    assert length == pytest.approx(100 / scale, rel=0.2)
    page.keyboard.press("Escape")
    # To the pixel and back: the wheel zooms about the pointer, 0 fits.
    page.mouse.wheel(0, -3000)
    until(page, f"() => studio.scene.view.scale > {50 * scale}")
    page.keyboard.press("0")
    assert page.evaluate("studio.scene.view.scale") == scale


def test_axe_finds_nothing_to_mend(browser, address):
    axe = pytest.importorskip("axe_playwright_python", exc_type=ImportError)
    from pathlib import Path

    source = (Path(axe.__file__).parent / "axe.min.js").read_text("utf-8")
    for scheme in ("light", "dark"):
        page = opened(browser, address, color_scheme=scheme)
        page.evaluate(source)

        def check(page=page):
            found = page.evaluate("axe.run({resultTypes: ['violations']})")["violations"]
            assert [(one["id"], one["nodes"][0]["html"]) for one in found] == []

        page.click("#compare")
        check()
        page.click("#paper")
        until(page, "() => studio.paper.start !== null")
        check()
        if scheme == "light":
            for dialog in ("#export", "#copy", "#help"):
                page.click(dialog)
                check()
                page.keyboard.press("Escape")
            page.click("#tab-pieces")
            check()
            page.click("#paper")
            example(page, "plate")
            page.select_option("#word-character", "drawn")
            until(page, DONE)
            page.click("#regularities summary")
            check()
        page.context.close()


def test_many_moves_of_the_slider_leave_no_threads_and_little_memory(browser):
    told = soak(browser, 80)
    threads, memory = told["threads"], told["program, MB"]
    assert threads[-1] <= threads[1]
    # Allocators keep some; a leak of one message of 15 kB a move would be 1 MB, of a fit more.
    assert memory[-1] - memory[1] < 15
