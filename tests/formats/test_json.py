"""What is written comes back bit for bit, and anything else is refused in one sentence."""

from __future__ import annotations

import dataclasses
import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support.make_fit import blob, fit_of, nested, wave

from shapespline.errors import DroppedPointsWarning, FormatError
from shapespline.formats import json as subject
from shapespline.geometry import exact_fit
from shapespline.monitor import Iteration
from shapespline.values import Arc, Piece, Regularity
from shapespline.values.contour import Contour
from shapespline.values.drawing import Drawing
from shapespline.values.fit import Fit, Status
from shapespline.values.view_box import ViewBox


def same_bits(a, b):
    """Whether two arrays agree in type, shape and every bit (so -0.0 is not 0.0)."""
    a, b = np.asarray(a), np.asarray(b)
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def assert_same(a, b):
    """Compare two drawings, down to the last bit of every field."""
    assert (a.parents, len(a)) == (b.parents, len(b))
    assert (a.frame is None) == (b.frame is None)
    assert a.unit == b.unit
    assert a.frame is None or same_bits(a.frame, b.frame)
    for one, other in zip(a, b, strict=True):
        assert_same_fit(one, other)


def assert_same_fit(one, other):
    for field in dataclasses.fields(Fit):
        x, y = getattr(one, field.name), getattr(other, field.name)
        if field.name == "spline":
            assert (x.degree, x.periodic) == (y.degree, y.periodic)
            assert same_bits(x.knots, y.knots)
            assert same_bits(x.control_points, y.control_points)
        elif field.name == "contour":
            assert x.closed == y.closed
            assert same_bits(x.points, y.points)
            assert same_bits(x.source, y.source)
            assert x.accuracy == y.accuracy
        elif field.name == "history":
            assert len(x) == len(y)
            assert all(same_bits(p, q) for p, q in zip(x, y, strict=True))
        elif field.name == "status":
            assert (x.name, x.value) == (y.name, y.value)
        elif isinstance(x, np.ndarray):
            assert same_bits(x, y)
        else:
            assert (type(x), x) == (type(y), y)


@pytest.fixture
def round_trip(tmp_path):
    def through(drawing):
        path = tmp_path / "drawing.json"
        path.write_bytes(subject.encode(drawing))
        return subject.read(path)

    return through


@pytest.fixture
def read_text(tmp_path):
    def read(text):
        path = tmp_path / "drawing.json"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return subject.read(path)

    return read


@pytest.fixture
def document():
    return json.loads(
        subject.encode(Drawing([fit_of(wave(), n_points=6)], frame=ViewBox(0, 0, 9, 9)))
    )


def test_the_comparison_itself_sees_one_bit():
    a, b = (Drawing([fit_of(wave())]) for _ in range(2))
    assert_same(a, b)
    worse = dataclasses.replace(b.fits[0], rms_distance=math.nextafter(b.fits[0].rms_distance, 1))
    with pytest.raises(AssertionError):
        assert_same(a, Drawing([worse]))


@pytest.mark.parametrize("degree", range(1, 10))
@pytest.mark.parametrize("make", [blob, wave])
def test_round_trip_of_every_degree(round_trip, make, degree):
    drawing = Drawing([fit_of(make(13, degree))])
    assert_same(round_trip(drawing), drawing)


def test_round_trip_of_nesting_frame_and_texts(round_trip):
    fits = nested().fits
    fits = [
        dataclasses.replace(
            fits[0],
            status=Status.BUDGET.saying('stopped: 3 µm "too much"\n'),
            method="größer \u2264 \U0001f343",
            outliers=np.array([0, 3, 59]),
        ),
        *fits[1:],
    ]
    drawing = Drawing(fits, [-1, 0, 1, -1], ViewBox(-0.1, 1 / 3, 640.0, 480.5))
    assert_same(round_trip(drawing), drawing)


def test_round_trip_of_dropped_points(round_trip):
    given = np.array([(0, 0), (0, 0), (4, 0), (4, 3), (4, 3), (0, 3), (0, 0)], dtype=float)
    with pytest.warns(DroppedPointsWarning):
        contour = Contour(given, closed=True)
    assert contour.source.tolist() == [0, 0, 1, 2, 2, 3, 0]
    drawing = Drawing([fit_of(blob(), contour=contour, parameters=np.linspace(0, 1, 7))])
    assert_same(round_trip(drawing), drawing)


def test_round_trip_of_hard_numbers(round_trip):
    hard = [-0.0, 5e-324, 0.1 + 0.2, math.nextafter(1, 2), 1e59, -1e-100]
    contour = Contour(np.column_stack([hard, hard[::-1]]), closed=False)
    fit = fit_of(
        wave(), contour=contour, parameters=np.array(hard), tolerance=1.7976931348623157e308
    )
    assert_same(round_trip(Drawing([fit])), Drawing([fit]))


def test_round_trip_of_a_history_that_lacks_a_gradient(round_trip):
    record = Iteration(0, 1.5, 0.5, math.nan, 1, 0.0, 0.25)
    back = round_trip(Drawing([fit_of(wave(), history=(record,))])).fits[0].history[0]
    assert math.isnan(back.gradient_norm)
    assert back._replace(gradient_norm=0.0) == record._replace(gradient_norm=0.0)
    assert type(back.evaluations) is int


@pytest.mark.slow
@given(
    st.lists(
        st.tuples(*[st.floats(-1e60, 1e60)] * 2),
        min_size=3,
        max_size=20,
        unique=True,
    ),
    st.booleans(),
)
def test_round_trip_of_any_contour(tmp_path_factory, points, closed):
    path = tmp_path_factory.getbasetemp() / "any.json"
    contour = Contour(points, closed)
    drawing = Drawing([fit_of(wave(), contour=contour, parameters=np.zeros(contour.n_given))])
    path.write_bytes(subject.encode(drawing))
    assert_same(subject.read(path), drawing)


def test_every_field_of_fit_is_written(document):
    """A field that is added to Fit must be added to the format, and the version raised.

    Curves on the way to a fit are no part of it; regularities are not there if there are none.
    """
    fields = {field.name for field in dataclasses.fields(Fit)} - {"snapshots", "regularities"}
    assert set(document["fits"][0]) == fields
    assert set(document["fits"][0]["history"]) == set(Iteration._fields)


def test_same_drawing_same_bytes_and_readable_lines():
    text = subject.encode(nested())
    assert text == subject.encode(nested())
    lines = text.decode("ascii").splitlines()
    assert max(map(len, lines)) <= subject.LINE_LENGTH + 1  # the comma after a value
    assert ' "parents": [-1, 0, 1, -1],' in lines
    assert text.endswith(b"}\n")


@pytest.mark.parametrize("value", [math.nan, math.inf])
@pytest.mark.parametrize("field", ["max_distance", "tolerance"])
def test_what_json_cannot_hold_is_not_written(field, value):
    with pytest.raises(FormatError, match=rf"fit\.{field} must be finite.*got (nan|inf)"):
        subject.encode(Drawing([fit_of(wave(), **{field: value})]))
    with pytest.raises(FormatError, match="parameters must be finite"):
        subject.encode(Drawing([fit_of(wave(), parameters=np.array([0.0, value]))]))
    with pytest.raises(FormatError, match=r"frame\.width must be finite"):
        subject.encode(Drawing([fit_of(wave())], frame=ViewBox(0, 0, value, 1)))


def changed(document, path, value):
    """Set the value at a path of keys, or take it away if the value is ``KeyError``."""
    *folders, last = path
    for key in folders:
        document = document[key]
    if value is KeyError:
        del document[last]
    else:
        document[last] = value


FIT = ("fits", 0)
WRONG = [
    (("format",), "potrace", "no shapespline drawing"),
    (("version",), 3, "version 3 is unknown, this program reads versions 1 and 2"),
    (("version",), True, "version must be an integer, found true"),
    (("version",), KeyError, "version must be an integer, found null"),
    (("frame",), KeyError, "lacks the field 'frame'"),
    (("comment",), "hi", "the drawing has an unknown field 'comment'"),
    (("frame", "width"), "9", r'frame\.width must be a number, found "9"'),
    (("parents",), [0.0], r"parents\[0\] must be an integer, found 0\.0"),
    (("parents",), [1], r"parents\[0\] must be from -1 to 0, found 1"),
    (("parents",), [-1, -1], "equally many"),
    (("fits",), {}, "fits must be an array, found an object"),
    ((*FIT,), None, r"fits\[0\] must be an object, found null"),
    ((*FIT, "rms_distance"), KeyError, r"fits\[0\] lacks the field 'rms_distance'"),
    ((*FIT, "rms_distance"), True, "rms_distance must be a number, found true"),
    ((*FIT, "rms_distance"), 10**400, "rms_distance must be a number in the range of doubles"),
    ((*FIT, "speed"), 3, r"fits\[0\] has an unknown field 'speed'"),
    ((*FIT, "method"), 3, "method must be a string, found 3"),
    ((*FIT, "parameters"), [0.0], "one for each of 6 points, found 1"),
    ((*FIT, "parameters", 2), None, r"parameters\[2\] must be a number, found null"),
    ((*FIT, "outliers"), [7], "must be from 0 to 6, found 7"),
    ((*FIT, "outliers"), [1.0], "must be an integer"),
    ((*FIT, "status", "name"), "FINE", "one of KEPT, EXCEEDED, BUDGET, CANCELLED, found 'FINE'"),
    ((*FIT, "history", "cost"), [1.0], "columns of one length"),
    ((*FIT, "history", "iteration", 0), 0.5, r"iteration\[0\] must be an integer, found 0\.5"),
    ((*FIT, "history", "iteration", 0), None, "must be an integer, found null"),
    ((*FIT, "spline", "degree"), 12, "degree must be an integer from 1 to 9, got 12"),
    ((*FIT, "spline", "degree"), 2, "knots"),
    ((*FIT, "spline", "periodic"), 0, "periodic must be true or false, found 0"),
    ((*FIT, "spline", "knots", 0), 0.7, "knots must not decrease"),
    ((*FIT, "spline", "control_points", 1), [1.0], "must hold x and y, found 1 numbers"),
    ((*FIT, "spline", "control_points"), [], r"must have shape \(9, 2\)"),
    ((*FIT, "contour", "points", 1), "1 2", r"points\[1\] must be an array"),
    ((*FIT, "contour", "points", 1, 0), 1e200, "must not exceed"),
    ((*FIT, "contour", "source"), [0, 1, 2, 3, 4, 4, 5], None),
    ((*FIT, "contour", "source"), [0, 1, 2, 3, 5, 4], "source does not lead to the points"),
    ((*FIT, "contour", "source"), [0, 1, 2, 3, 4, 6], "must be from 0 to 5, found 6"),
]


@pytest.mark.parametrize(("path", "value", "message"), WRONG)
def test_strict(read_text, document, path, value, message):
    read_text(json.dumps(document))  # right before the change
    changed(document, path, value)
    with pytest.raises(FormatError, match=message) as caught:
        read_text(json.dumps(document))
    assert "\n" not in str(caught.value)


def test_equal_neighbours_are_refused(read_text, document):
    points = document["fits"][0]["contour"]["points"]
    points[2] = points[1]
    with pytest.raises(FormatError, match="two neighbours agree"):
        read_text(json.dumps(document))


@pytest.mark.parametrize("constant", ["NaN", "Infinity", "-Infinity"])
def test_numbers_that_json_does_not_know(read_text, document, constant):
    document["fits"][0]["tolerance"] = "HERE"
    with pytest.raises(FormatError, match=f"must be finite, found {constant}"):
        read_text(json.dumps(document).replace('"HERE"', constant))
    with pytest.raises(FormatError, match="in the range of doubles"):
        read_text(json.dumps(document).replace('"HERE"', "1e999"))


def test_a_field_given_twice(read_text, document):
    text = json.dumps(document)
    with pytest.raises(FormatError, match="'version' is given twice"):
        read_text(text.replace('"version": 1', '"version": 1, "version": 1'))


def test_whole_numbers_without_a_point_are_numbers(read_text, document):
    document["frame"]["width"] = 9
    frame = read_text(json.dumps(document)).frame
    assert frame.width == 9.0
    assert type(frame.width) is float


def test_a_file_cut_off_anywhere(read_text, document):
    text = json.dumps(document)
    for end in range(0, len(text), 7):
        with pytest.raises(FormatError, match="no JSON, or cut off"):
            read_text(text[:end])


@pytest.mark.parametrize(
    "text",
    ["", "[]", "3", "null", "{}", "[" * 100_000, b"\xff\xfe{", b"\x89PNG", '{"a": 1} {"b": 2}'],
)
def test_other_files(read_text, text):
    with pytest.raises(FormatError):
        read_text(text)


def test_the_unit_and_the_accuracy_of_the_data_come_along(round_trip, read_text):
    fit = fit_of(wave())
    contour = Contour(fit.contour.points, fit.contour.closed, accuracy=0.125)
    drawing = Drawing([dataclasses.replace(fit, contour=contour)], unit="in")
    again = round_trip(drawing)
    assert_same(drawing, again)
    assert (again.unit, again.fits[0].contour.accuracy) == ("in", 0.125)
    text = subject.encode(drawing).decode()
    with pytest.raises(FormatError, match="unit must be null or one of px, um, mm"):
        read_text(text.replace('"in"', '"furlong"'))
    with pytest.raises(FormatError, match="accuracy must be a length"):
        read_text(text.replace("0.125", "-1.0"))


def test_arcs_come_back_and_raise_the_version(round_trip, read_text):
    arc = Piece.of_arc(Arc((0.1, 0.2), 1.0, 0.3, 1.7), 0.01)
    circle = Piece.of_arc(Arc((5.0, 5.0), 2.0, 0.0, -2 * np.pi))
    drawing = Drawing([exact_fit([arc]), exact_fit([circle])])
    assert round_trip(drawing) == drawing
    text = subject.encode(drawing).decode()
    assert '"version": 2' in text
    for good, bad, message in (
        ('"radius": 2.0', '"radius": -2.0', "radius of an arc must be positive, got -2.0"),
        ('"radius": 2.0', '"radius": 2.5', "must be a cubic beside its arc"),
        ('"sweep": 1.7', '"sweep": 1.8', "must be a cubic beside its arc"),
        ('"kind": "arc"', '"kind": "spline"', "must have the field 'arc' if its kind is 'arc'"),
    ):
        assert good in text
        with pytest.raises(FormatError, match=message):
            read_text(text.replace(good, bad))


def test_regularities_come_back_and_name_pieces_that_are_there(round_trip, read_text):
    lines = [
        Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([a, b], dtype=float))
        for a, b in (((0, 0), (4, 0)), ((4, 0), (4, 3)))
    ]
    kept = (Regularity("axis-parallel", (0,), 0.25), Regularity("rotation", (0, 1), 0.5, 2))
    drawing = Drawing([dataclasses.replace(exact_fit(lines), regularities=kept)])
    assert round_trip(drawing) == drawing
    assert round_trip(drawing).fits[0].regularities == kept
    text = subject.encode(drawing).decode()
    assert '"version": 2' in text
    with pytest.raises(FormatError, match=r"regularities\[1\].pieces"):
        read_text(text.replace('"pieces": [0, 1]', '"pieces": [0, 2]'))
