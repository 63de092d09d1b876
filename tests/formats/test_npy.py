"""NumPy files: any real (n, 2) array, nothing else, and never a pickle."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.registry import read

POINTS = np.array([(0, 0), (4, 0), (4, 1), (0, 1)])


def saved(tmp_path, array, **options):
    path = tmp_path / "points.npy"
    np.save(path, array, **options)
    return path


@pytest.mark.parametrize("dtype", ["f8", "f4", "f2", "i8", "u1", ">i2", ">f4"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_any_real_type_becomes_float64(tmp_path, dtype, order):
    shape = read(saved(tmp_path, np.asarray(POINTS, dtype=dtype, order=order)), closed=True)
    assert shape.longest.points.dtype == np.float64
    assert np.array_equal(shape.longest.points, POINTS)
    assert shape.frame is None


def test_options(tmp_path):
    path = saved(tmp_path, POINTS)
    assert not read(path, closed=False).longest.closed
    assert read(path, closed=True, y_down=True).longest.points.tolist() == [
        [0, 1], [4, 1], [4, 0], [0, 0]
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("array", "complaint"),
    [
        (POINTS.T, r"shape \(n, 2\), got \(2, 4\); transpose it\?"),
        (np.zeros((5, 3)), r"got \(5, 3\)"),
        (np.zeros(8), r"got \(8,\)"),
        (np.zeros((3, 2, 1)), r"got \(3, 2, 1\)"),
        (POINTS * 1j, "real numbers, got dtype complex128"),
        (POINTS.astype("U4"), "real numbers, got dtype <U4"),
        (POINTS > 2, "real numbers, got dtype bool"),
    ],
)
def test_other_arrays_are_refused(tmp_path, array, complaint):
    with pytest.raises(FormatError, match=complaint):
        read(saved(tmp_path, array))


def test_objects_are_not_unpickled(tmp_path):
    with pytest.raises(FormatError, match="no array in NumPy's format"):
        read(saved(tmp_path, np.array([[1, None]], dtype=object), allow_pickle=True))


def test_nan_is_refused(tmp_path):
    with pytest.raises(InvalidInputError, match=r"points\.npy: points must be finite"):
        read(saved(tmp_path, np.where(POINTS == 4, np.nan, POINTS)))


@pytest.mark.parametrize("damage", [b"no array at all", b"\x93NUMPY\x01\x00"])
def test_damaged_files(tmp_path, damage):
    path = tmp_path / "damaged.npy"
    path.write_bytes(damage)
    with pytest.raises(FormatError, match=r"damaged\.npy: no array in NumPy's format"):
        read(path)


@given(data=st.data())
@settings(deadline=None)  # a damaged shape can ask for much memory
def test_no_damage_escapes_as_another_error(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("npy") / "points.npy"
    np.save(path, POINTS.astype(float))
    content = bytearray(path.read_bytes())
    if data.draw(st.booleans()):
        del content[data.draw(st.integers(1, len(content) - 1)) :]
    else:
        content[data.draw(st.integers(0, 127))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(FormatError, InvalidInputError):
        read(path, closed=False)
