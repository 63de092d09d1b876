"""A session without a browser: what is asked is answered, newer fits end older ones."""

import io
import json
import queue
import time

import numpy as np
import pytest
from PIL import Image

import shapespline as ss
from shapespline.studio.asked import Asked
from shapespline.studio.documents import opened
from shapespline.studio.examples import EXAMPLES, example_bytes
from shapespline.studio.fits import fitted, splprep_fit, whole
from shapespline.studio.jobs import Cancelled, Lane, Ticket
from shapespline.studio.messages import packed, unpacked
from shapespline.studio.outputs import command_line, encoded, python_text, settings_text
from shapespline.studio.reading import Readers
from shapespline.studio.session import Session
from shapespline.studio.sketch import sketch

KINDS = {"f": "<f4", "i": "<i4", "u": "u1"}


class Page:
    """What a page does, without one."""

    def __init__(self):
        self.heard = queue.Queue()
        self.readers = Readers()
        # None stands ready before a test needs one.
        self.readers.prepare = lambda: None
        self.session = Session(self.heard.put, self.readers)
        self.session.greet()
        assert self.next("hello")

    def say(self, content=b"", **header):
        self.session.hear(packed(header) + content)

    def next(self, *kinds):
        """The next message of some kinds, arrays by their names."""
        while True:
            header, rest = unpacked(self.heard.get(timeout=20))
            for name, (kind, shape, at) in header.pop("arrays").items():
                count = int(np.prod(shape))
                header[name] = np.frombuffer(rest, KINDS[kind], count, at).reshape(shape)
            if header["type"] in kinds:
                return header
            assert header["type"] != "error", header


@pytest.fixture
def page():
    made = Page()
    yield made
    made.session.close()
    made.readers.close()


def test_an_example_is_opened_fitted_and_taken_away(page):
    page.say(type="example", id="wing", generation=1)
    shape = page.next("shape")
    assert (shape["name"], shape["outlines"][0]["closed"]) == ("wing.csv", True)
    assert shape["points"].shape == (200, 2)
    assert shape["file"].tobytes() == example_bytes("wing")
    page.say(type="fit", generation=2, settings={"tolerance": 0.0005})
    fit = page.next("fit")
    done = page.next("done")
    document = opened("wing.csv", example_bytes("wing"), {})
    expected = ss.fit_curve(document.shape.contours[0], tolerance=0.0005)
    assert fit["sentence"] == expected.status.value
    assert fit["n_stored_points"] == done["n_stored_points"] == expected.n_stored_points
    assert np.abs(fit["errors"]).max() <= expected.max_distance * (1 + 1e-6)
    assert np.abs(fit["samples"][:, 5]).max() <= expected.hausdorff_distance * (1 + 1e-6)
    page.say(type="export", format=".json", generation=3)
    content = page.next("file")["bytes"].tobytes()
    (back,) = ss.read(io.BytesIO(content), format=".json")
    assert back.spline == expected.spline
    page.say(type="export", format=".svg", generation=4, options={"path": "elsewhere.svg"})
    assert "no option of writing" in page.next("error")["sentence"]


@pytest.mark.filterwarnings("ignore:the picture tells")
def test_what_the_command_line_says_of_a_fit_is_said_once(page):
    page.say(type="example", id="gear", generation=1)
    page.next("shape")
    page.say(type="fit", generation=2, settings={"tolerance": 0.04})
    (remark,) = page.next("done")["remarks"]
    assert remark.startswith("the picture tells an outline to")
    page.say(type="fit", generation=3, settings={"tolerance": 0.5})
    assert page.next("done")["remarks"] == []
    corners = {str(k): {"corners": []} for k in range(8)}
    page.say(type="fit", generation=4, settings={"tolerance": 0.04}, own=corners)
    assert page.next("done")["remarks"] == []
    page.say(type="fit", generation=5, settings={})
    assert page.next("done")["remarks"] == []


def test_a_newer_fit_ends_the_older(page):
    page.say(type="example", id="gear", generation=1)
    page.next("shape")
    for generation in range(2, 12):
        page.say(type="fit", generation=generation, settings={"tolerance": 0.3})
    done = page.next("done")
    assert done["generation"] == 11
    assert page.session._lanes["a"]._waiting is None


def test_reading_says_what_comes_next_and_may_be_ended_there():
    file, side = io.BytesIO(), np.full((20, 20), 255, np.uint8)
    Image.fromarray(np.kron(np.eye(2, dtype=np.uint8), side)).save(file, "PNG")
    said = []
    opened("a.png", file.getvalue(), {}, said.append)
    assert said
    ticket = Ticket(1)
    ticket.end()
    with pytest.raises(Cancelled):
        opened("a.png", file.getvalue(), {}, ticket.say)


def test_wrong_settings_are_refused_with_the_programs_sentence(page):
    page.say(type="fit", settings={})
    assert "nothing is open" in page.next("error")["sentence"]
    page.say(type="example", id="loop", generation=1)
    page.next("shape")
    for options, said in [
        ({"settings": {"tolerance": -1}}, "tolerance must be a positive"),
        ({"settings": {"tolerance": 1, "colour": 3}}, "colour is not an option"),
        ({"settings": {"tolerance": 1}, "own": {"7": {"corners": [1]}}}, "outline must be below 1"),
        (
            {"settings": {"tolerance": 1}, "own": {"0": {"corners": [999]}}},
            "corners must be indices",
        ),
        ({"settings": {"tolerance": 1}, "own": {"0": {"moved": [[1]]}}}, "moved must hold"),
        ({"settings": {"tolerance": 1}, "slot": "c"}, "slot must be"),
    ]:
        page.say(type="fit", generation=5, **options)
        assert said in page.next("error")["sentence"]


def test_a_refused_file_leaves_the_document_that_was_open(page):
    page.say(type="example", id="loop", generation=1)
    page.next("shape")
    page.say(b"MZ", type="open", name="logo.exe", generation=2)
    assert "no reader for this ending" in page.next("error")["sentence"]
    page.say(type="fit", generation=3, settings={"tolerance": 0.02})
    fit = page.next("fit")
    assert fit["kept"]
    # It crosses itself once: two stretches of its samples come near that place, others do not.
    ((outline, *place),) = page.next("done")["crossings"].tolist()
    assert outline == 0
    near = np.flatnonzero(np.hypot(*(fit["samples"][:, :2] - place).T) < 0.2)
    assert np.count_nonzero(np.diff(near) > 10) == 1


def test_corners_held_and_moved_points_are_those_of_the_outline():
    document = opened("loop.csv", example_bytes("loop"), {})
    said = {
        "settings": {"tolerance": 0.02},
        "own": {"0": {"through": [40], "moved": [[120, 0.0, 0.3, 1.0, 1.0]], "corners": [200]}},
    }
    asked = Asked.of(said, document)
    assert not asked.is_plain
    assert asked.settings(0).through.tolist() == [40, 120]
    fit = fitted(asked, 0, Ticket(1))
    points = document.shape.contours[0].points
    near = fit.spline(np.linspace(0, 1, 40001))
    # Held up to rounding; the samples of the curve are some 1e-4 apart, and so is the foot.
    assert np.hypot(*(near - points[40]).T).min() < 2e-4
    assert np.hypot(*(near - points[120] - (0.0, 0.3)).T).min() < 2e-4
    assert fit.kept
    assert asked.settings(0).corners.tolist() == [200]
    # What is drawn is what was found: nodes are where pieces meet, held points among them.
    made = sketch(fit, document.origin)
    assert {40, 120} <= set(made.arrays["points"].tolist())
    assert made.arrays["counts"].sum() == len(made.arrays["cubics"])


def test_a_draft_is_verified_and_soon_there():
    document = opened("gear.png", example_bytes("gear"), {})
    asked = Asked.of({"settings": {"tolerance": 0.5}}, document)
    began = time.monotonic()
    fit = fitted(asked, 0, Ticket(1), draft=True)
    assert time.monotonic() - began < 2.0
    assert fit.kept == (fit.hausdorff_distance <= 0.5)


def test_splprep_keeps_the_tolerance_at_the_points(outline):
    contour = outline("hand620_closed")
    fit = splprep_fit(contour, 0.01 * contour.box_diagonal, 3, Ticket(1))
    assert fit.max_distance <= 0.01 * contour.box_diagonal
    assert fit.method == "splprep"


def test_text_makes_the_same_fit_again(tmp_path, monkeypatch, shapespline):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scan.csv").write_bytes(example_bytes("scan"))
    document = opened("scan.csv", example_bytes("scan"), {})
    asked = Asked.of({"settings": {"tolerance": 0.6, "corners": "free", "degree": 4}}, document)
    expected = encoded(ss.fit_shape(document.shape, **asked.common), ".svg")
    exec(compile(python_text(asked), "copied", "exec"), {})
    assert (tmp_path / "scan_fit.svg").read_bytes() == expected
    (tmp_path / "scan_fit.svg").unlink()
    assert shapespline(*command_line(asked).split()[1:])[0] == 0
    assert (tmp_path / "scan_fit.svg").read_bytes() == expected
    (tmp_path / "settings.toml").write_text(settings_text(asked))
    words = ("fit", "scan.csv", "--settings", "settings.toml", "-o", "again.svg")
    assert shapespline(*words)[0] == 0
    assert (tmp_path / "again.svg").read_bytes() == expected
    own = Asked.of({"settings": {"tolerance": 0.6}, "own": {"0": {"corners": [3]}}}, document)
    exec(compile(python_text(own), "copied", "exec"), {})
    assert (tmp_path / "scan_fit.svg").read_bytes() != expected
    with pytest.raises(ss.InvalidInputError, match="copy the Python"):
        command_line(own)


def test_regularities_are_listed_by_kind_and_switched_off_by_kind(page):
    # A slot, which is found at once.
    t = np.linspace(-0.5, 0.5, 30, endpoint=False)
    side, end = 40 * t, 8 * np.exp(1j * np.pi * t)
    points = np.concatenate([side - 8j, 20 + end, -side + 8j, -20 - end])
    content = "".join(f"{z.real},{z.imag}\n" for z in points)
    page.session._document = opened("slot.csv", content.encode(), {"closed": True})
    page.session.greet()
    settings = {"tolerance": 0.1, "character": "drawn"}
    page.say(type="fit", generation=2, settings=settings)
    fit = page.next("fit")
    names = {one["name"] for one in fit["regularities"]}
    assert {"axis-parallel", "tangent", "mirror"} <= names
    assert all(max(one["pieces"]) < len(fit["kinds"]) for one in fit["regularities"])
    page.next("done")
    kept = sorted(names - {"axis-parallel"})
    page.say(type="fit", generation=3, settings={**settings, "regularities": kept})
    names = {one["name"] for one in page.next("fit")["regularities"]}
    assert names
    assert names <= set(kept)


def test_what_outlines_repeat_is_listed_of_the_drawing(page):
    angles = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    rings = [4 * ring + (x, 0.0) for x in (-30, 0, 30)]
    features = [
        {"type": "Polygon", "coordinates": [[*one.tolist(), one[0].tolist()]]} for one in rings
    ]
    document = {"type": "GeometryCollection", "geometries": features}
    page.session._document = opened("rings.geojson", json.dumps(document).encode(), {})
    page.session.greet()
    page.say(type="fit", generation=2, settings={"tolerance": 0.1, "character": "drawn"})
    listed = page.next("done")["regularities"]
    found = {one["name"]: one for one in listed}
    assert found["equal-radius"]["pieces"] == [0, 1, 2]
    assert {one["noun"] for one in listed} == {"outline"}
    # Drafts look for nothing.
    page.say(type="fit", generation=3, draft=True, settings={"tolerance": 0.1})
    assert page.next("done")["regularities"] == []


@pytest.mark.slow
def test_areas_of_colours_share_their_borders():
    document = opened("gear.png", example_bytes("gear"), {"colors": 2})
    asked = Asked.of({"settings": {"tolerance": 1.0}}, document)
    assert "shared_boundaries=True" in python_text(asked)
    fits = whole(asked, Ticket(1)).fits
    ends = [{tuple(end) for piece in fit.pieces for end in piece.control_points} for fit in fits]
    # A hole of the ink is an area of the ground: the same curve, to the bit.
    assert any(a == b for k, a in enumerate(ends) for b in ends[:k])


def test_a_map_keeps_its_coordinate_reference():
    field = ss.Contour([(0, 0), (9, 0), (9, 5), (0, 5)], closed=True)
    drawing = ss.fit_shape(ss.Shape([field], reference="EPSG:25832"), tolerance=0.1)
    document = opened("field.geojson", encoded(drawing, ".geojson"), {})
    for own in ({}, {"0": {"corners": [2]}}):
        asked = Asked.of({"settings": {"tolerance": 0.1}, "own": own}, document)
        assert whole(asked, Ticket(1)).reference == "EPSG:25832"


def test_the_paper_is_told_step_by_step(page):
    page.say(type="example", id="wing", generation=1)
    page.next("shape")
    page.say(type="paper", outline=0, length=6, methods=["levenberg-marquardt"], generation=2)
    start = page.next("paper")
    assert len(start["h"]) == len(start["places"]) >= 200
    film = page.next("film")
    frames, size = len(film["iterations"]), start["n_control_points"]
    assert film["control"].shape == (frames, size, 2)
    assert film["history"][-1, 1] < start["error"]


@pytest.mark.slow
def test_every_example_opens_and_is_fitted_at_once():
    for name, example in EXAMPLES.items():
        document = opened(example.file, example_bytes(name), {})
        drawing = ss.fit_shape(document.shape, tolerance=example.tolerance, effort="fast")
        assert all(fit.kept for fit in drawing), name
        assert document.sentences == (), name


def test_a_lane_does_the_newest_and_ends():
    done, lane = queue.Queue(), Lane("test")

    def long(ticket):
        while ticket.wanted:
            time.sleep(0.005)
        done.put("ended")

    lane.submit(1, long)
    lane.submit(2, long)
    lane.submit(3, lambda ticket: done.put(ticket.generation))
    assert done.get(timeout=5) in ("ended", 3)
    lane.close(5)
    assert not lane._thread.is_alive()
