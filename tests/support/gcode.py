"""A small interpreter of G-code: what a machine does with a program, however it was made.

After the standard RS-274/NGC of NIST (Kramer, Proctor, Messina 2000), sections 3.5.1 to 3.5.3.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from math import atan2, ceil, cos, hypot, pi, sin

import numpy as np

# The standard refuses an arc whose ends are farther from its centre than this from each other, mm.
RADIUS_MISMATCH = 0.002


@dataclass
class Machine:
    """Where the tool is, and every way that it cut."""

    step: float
    unit: str | None = None
    place: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 0.0]))
    feed: float | None = None
    cuts: list = field(default_factory=list)
    depths: set = field(default_factory=set)
    moves: dict = field(default_factory=lambda: {"G0": 0, "G1": 0, "G2": 0, "G3": 0})
    ended: bool = False

    def run(self, text):
        """Do every block of a program."""
        for line in text.splitlines():
            words = re.sub(r"\([^)]*\)", "", line).split()
            assert not (words and self.ended), "blocks after the end"
            self.block(words)
        assert self.ended
        return self

    def block(self, words):
        motion, values = None, {}
        for word in words:
            letter, number = word[0], word[1:]
            assert re.fullmatch(r"-?\d+(\.\d+)?", number), word
            if letter == "G" and word in self.moves:
                motion = word
            elif word in ("G20", "G21"):
                self.unit = {"G20": "in", "G21": "mm"}[word]
            elif word == "M2":
                self.ended = True
            elif letter in "XYZIJF":
                values[letter] = float(number)
            else:
                assert word in ("G17", "G90", "G91.1", "G94"), word
        self.feed = values.get("F", self.feed)
        if motion is not None:
            self.move(motion, values)

    def move(self, motion, values):
        self.moves[motion] += 1
        target = np.array(
            [values.get(axis, at) for axis, at in zip("XYZ", self.place, strict=True)]
        )
        if motion != "G0":
            assert self.feed, "a cut without a feed"
        if motion in ("G2", "G3"):
            way = self.arc(motion, target, values["I"], values["J"])
        else:
            assert "I" not in values
            way = [target[:2]]
        sideways = (target[:2] != self.place[:2]).any() or motion in ("G2", "G3")
        if motion == "G0" and "X" in values:
            assert self.place[2] > 0, "a rapid move through the material"
            self.cuts.append([target[:2]])
        elif sideways:
            self.depths.add(float(self.place[2]))
            self.cuts[-1] += way
        self.place = target

    def arc(self, motion, target, i, j):
        x, y = self.place[:2]
        cx, cy = x + i, y + j
        radius, other = hypot(i, j), hypot(target[0] - cx, target[1] - cy)
        assert abs(radius - other) <= RADIUS_MISMATCH, (radius, other)
        begin, end = atan2(y - cy, x - cx), atan2(target[1] - cy, target[0] - cx)
        sweep = (end - begin) % (2 * pi) or 2 * pi
        sweep = sweep if motion == "G3" else sweep - 2 * pi or -2 * pi
        n = max(2, ceil(abs(sweep) * radius / self.step))
        angles = begin + sweep * np.arange(1, n) / n
        inner = [np.array([cx + radius * cos(a), cy + radius * sin(a)]) for a in angles]
        return [*inner, target[:2]]
