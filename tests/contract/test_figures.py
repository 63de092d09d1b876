"""The pictures of the documentation are drawn by their commands."""

from __future__ import annotations

import pytest


@pytest.mark.slow
def test_pictures_of_the_page_about_pictures_are_drawn(tmp_path, monkeypatch):
    from benchmarks import picture_options, picture_peers

    for module, name in ((picture_options, "pictures"), (picture_peers, "pictures_peers")):
        monkeypatch.setattr(module, "TARGET", tmp_path)
        module.main()
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
