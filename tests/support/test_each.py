"""`each` runs every value, names the one that fails, and is no test of nothing."""

from __future__ import annotations

import pytest
from tests.support.each import each


def test_every_value_is_run_and_a_failure_names_it():
    seen = []
    each([1, (2, 3)])(lambda *values: seen.append(values))()
    assert seen == [(1,), (2, 3)]

    def body(value):
        assert value < 2

    with pytest.raises(AssertionError) as caught:
        each([1, 2])(body)()
    assert caught.value.__notes__ == ["of 2"]
    with pytest.raises(AssertionError, match="nothing to test"):
        each([])(body)()
