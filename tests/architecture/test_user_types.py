"""The types that a user's mypy sees, through py.typed: right use passes, wrong use is told."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

import pytest
from tests.support.places import ROOT

pytest.importorskip("mypy")

WRONG = {
    "fit.points(step='a')": "str",
    "ss.fit_curve([(0, 0), (1, 1)], effort='most')": "most",
    "number: int = fit.bounds": "Box",
    "fit.tolerence": "tolerence",
    "ss.Contour([(0, 0), (1, 1)], closed='yes')": "str",
    "ss.trace('a.png', polarity='up')": "up",
}


def checked(path, cache):
    """What mypy --strict says, seen as a user sees it: the package installed, not its sources."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment["MYPYPATH"] = str(ROOT / "src")
    # Of the package itself, which follows its own settings, no errors are reported here.
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--follow-imports=silent",
         f"--cache-dir={cache}", str(path)],
        capture_output=True, text=True, check=False, env=environment, cwd=path.parent,
    )  # fmt: skip


@pytest.mark.slow
def test_right_use_passes_and_wrong_use_is_told(tmp_path):
    assert (ROOT / "src" / "shapespline" / "py.typed").exists()
    right = tmp_path / "right.py"
    shutil.copy(ROOT / "tests" / "architecture" / "user_file.txt", right)
    done = checked(right, tmp_path / "cache")
    assert done.returncode == 0, done.stdout
    wrong = tmp_path / "wrong.py"
    head = right.read_text("utf-8")
    wrong.write_text(head + "\n".join(WRONG) + "\n", encoding="utf-8")
    said = checked(wrong, tmp_path / "cache").stdout
    first = len(head.splitlines()) + 1
    for line, (use, word) in enumerate(WRONG.items(), start=first):
        found = [text for text in said.splitlines() if f"wrong.py:{line}: error" in text]
        assert found, f"{use}: {said}"
        assert word in found[0]
