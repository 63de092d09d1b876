"""What the tests of formats share."""

from __future__ import annotations

import pytest
from tests.support.svg_pages import HEAD, PAGE

from shapespline.formats import svg_reader


@pytest.fixture
def drawn(tmp_path):
    """The outlines of the elements of a page of 40 by 30, y up."""

    def read(body, attributes=PAGE):
        path = tmp_path / "drawing.svg"
        path.write_text(f"{HEAD} {attributes}>{body}</svg>", encoding="utf-8")
        return svg_reader.read(path)

    return read
