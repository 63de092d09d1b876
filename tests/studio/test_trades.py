"""The page in a browser, as people of three trades use it: from its address to their files."""

import io

import numpy as np
import pytest
from benchmarks.studio import DONE, give, logo, until
from tests.support.places import IMAGES
from tests.support.studio_page import text

import shapespline as ss

pytestmark = pytest.mark.slow


def exported(page, ending):
    page.click("#export")
    page.select_option("#format", ending)
    with page.expect_download() as download:
        page.click("#export-go")
    return download.value.path().read_bytes()


def test_a_sign_maker_takes_a_logo_to_lines_and_arcs_in_millimetres(page):
    give(page, "logo.png", logo(600))
    page.fill("#p-width", "120")
    page.press("#p-width", "Enter")
    until(page, "() => studio.scene.shape.unit === 'mm'")
    page.fill("#tolerance-number", "0.1")
    page.press("#tolerance-number", "Enter")
    page.select_option("#form", "arcs")
    until(page, DONE)
    assert "All 12 outlines are kept" in text(page)
    # A tolerance of half a pixel is also said in pixels: five to a millimetre.
    page.select_option("#tolerance-unit", "px")
    assert float(page.input_value("#tolerance-number")) == pytest.approx(0.5)
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.read(io.StringIO(exported(page, ".dxf").decode()))
    kinds = {entity.dxftype() for entity in drawing.modelspace()}
    assert "SPLINE" not in kinds
    assert kinds & {"LWPOLYLINE", "ARC", "CIRCLE"}
    # The discs have radii of 0.12 of the width; a trace of such a picture is off by some 0.05 mm.
    bores = [e.dxf.radius for e in drawing.modelspace() if e.dxftype() == "CIRCLE"]
    assert all(abs(radius - 14.4) < 0.1 for radius in bores)


def test_a_type_designer_gets_a_glyph_within_0_3_units(page):
    pytest.importorskip("fontTools", exc_type=ImportError)
    t = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    # A bowl, 1000 units to the em.
    points = np.column_stack([300 + 260 * np.cos(t), 350 + 350 * np.sin(t) + 8 * np.cos(3 * t)])
    give(page, "o.csv", "".join(f"{x:.4f},{y:.4f}\n" for x, y in points).encode())
    page.fill("#tolerance-number", "0.3")
    page.press("#tolerance-number", "Enter")
    until(page, DONE)
    (fit,) = ss.read(io.BytesIO(exported(page, ".glif")), format=".glif")
    curve = fit.points(6000)
    step = np.hypot(*np.diff(curve, axis=0).T).max()
    near = np.sqrt(((points[:, None] - curve[None]) ** 2).sum(axis=2)).min(axis=1)
    # The nearest sample is at most half a step from the foot.
    assert near.max() <= 0.3 + 0.5 * step
    assert fit.n_stored_points < 30


def test_a_researcher_makes_the_papers_figures_of_a_photograph(page):
    photograph = (IMAGES / "opencv_apple.jpg").read_bytes()
    # Nobody waits for the fits of all its specks.
    page.set_input_files(
        "#file", {"name": "apple.jpg", "mimeType": "image/jpeg", "buffer": photograph}
    )
    until(page, "() => studio.scene.shape?.name === 'apple.jpg'", 40)
    # The longest outline is the apple.
    longest = "studio.scene.shape.outlines.map(o => o.length)"
    index = int(np.argmax(page.evaluate(longest)))
    page.click(f"#outline-{index}")
    page.evaluate("document.querySelector('#length').value = 60")
    page.click("#paper")
    until(page, "() => Object.keys(studio.paper.films).length === 1", 40)
    assert page.evaluate("studio.paper.start.outline") == index
    assert page.evaluate("studio.paper.start.maxima.length") > 10
    error = "studio.paper.films['d-bfgs'].error"
    assert page.evaluate(f"{error} < studio.paper.start.error")
    for step in ("points", "maxima", "frames", "initial", "film"):
        page.check(f"[name=step][value={step}]")
    page.click("#copy")
    with page.expect_download() as download:
        page.click("#copy-view")
    assert download.value.path().read_bytes().startswith(b"\x89PNG")
