"""Readings set by words, as on the command line."""

from dataclasses import fields

import pytest

from shapespline import SENSIBLE
from shapespline.errors import InvalidInputError


def test_every_field_can_be_set_by_a_word():
    words = {
        "signed": ("no", False),
        "window": ("7", 7),
        "prominence": ("none", None),
        "spacing": ("3", 3),
        "start": ("every-nth", "every-nth"),
        "offset": ("none", "none"),
        "normals": ("neighbours", "neighbours"),
        "parametrization": ("chord", "chord"),
        "clamped": ("TRUE", True),
        "closing_point": ("0", False),
        "resampled": ("false", False),
        "method": ("oss", "oss"),
        "start_diagonal": ("identity", "identity"),
        "wolfe": ("weak", "weak"),
        "ends": ("fitted", "fitted"),
        "stray_weight": ("0.5", 0.5),
        "relative_decrease": ("1e-3", 1e-3),
        "max_evaluations": ("12", 12),
    }
    assert set(words) == {field.name for field in fields(SENSIBLE)}
    changed = SENSIBLE.changed(f"{name}={word}" for name, (word, _) in words.items())
    assert {name: getattr(changed, name) for name in words} == {
        name: value for name, (_, value) in words.items()
    }


@pytest.mark.parametrize(
    ("word", "sentence"),
    [
        ("windows=7", r"reading must be set by FIELD=VALUE with a field of signed, window, .*"),
        ("window", r"FIELD=VALUE"),
        ("window=seven", r"window must be int or None, got 'seven'"),
        ("clamped=perhaps", r"clamped must be true or false, got 'perhaps'"),
        ("window=4", r"window must be an odd number"),
        ("start=all", r"start must be one of balanced, .*uniform, got 'all'"),
        ("method=newton", r"method must be one of levenberg-marquardt, .*got 'newton'"),
        ("stray_weight=-1", r"stray_weight must be 0 or a positive number"),
        ("max_evaluations=0", r"max_evaluations|max_iterations"),
    ],
)
def test_words_that_are_no_reading(word, sentence):
    with pytest.raises(InvalidInputError, match=sentence) as raised:
        SENSIBLE.changed([word])
    assert "\n" not in str(raised.value)
