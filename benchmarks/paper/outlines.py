"""What the page is measured on: the three examples, sixteen closed outlines, data of every kind."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from shapespline import Contour, read

REPOSITORY = Path(__file__).resolve().parents[2]
DATA = REPOSITORY / "examples" / "data"


class Published(NamedTuple):
    """A row of the paper's Table 2."""

    n_control_points: int
    start_error: float
    final_error: float
    seconds: float


class Example(NamedTuple):
    """One of the three examples, and what the paper reports of its own outline of that name."""

    name: str
    figure: int
    length: int
    published: Published
    predecessor: Published

    @property
    def contour(self) -> Contour:
        """The closed outline, bounding box diagonal 10."""
        return read(next((DATA / "paper").glob(f"{self.name}*.csv")), closed=True).longest


EXAMPLES = (
    Example("leaf", 4, 2, Published(36, 0.7462, 0.0170, 0.21), Published(42, 0.7506, 0.0173, 0.29)),
    Example("palm", 5, 3, Published(49, 1.2755, 0.0451, 0.16), Published(53, 1.2862, 0.0510, 0.26)),
    Example(
        "airplane", 6, 4, Published(70, 0.4506, 0.0216, 0.36), Published(77, 0.4525, 0.0221, 0.45)
    ),
)
# Length -> number of control points and seconds, the paper's Table 1.
PUBLISHED_LENGTHS = {5: (25, 0.2604), 4: (27, 0.2586), 3: (28, 0.2570), 2: (35, 0.2535)}
CLOSED = (
    "paper/leaf840",
    "paper/palm620",
    "paper/airplane1100",
    "outlines/hand620_closed",
    "outlines/plane1100_closed",
    "outlines/fa_dove_c0",
    "outlines/fa_guitar_c0",
    "outlines/fa_hand-spock_c0",
    "outlines/fa_horse_c0",
    "outlines/gameicons_airplane-arrival_c0",
    "outlines/gameicons_jet-fighter_c0",
    "outlines/mdi_airplane_c0",
    "outlines/mdi_feather_c0",
    "outlines/mdi_fish_c0",
    "outlines/mdi_leaf-maple_c0",
    "outlines/EBGaramond12-Regular_U0066_c0",
)


def closed_outlines() -> dict[str, Contour]:
    """Sixteen outlines by name, scaled to a bounding box diagonal of 10."""
    found = {}
    for name in CLOSED:
        contour = read(DATA / f"{name}.csv", closed=True).longest
        scale = 10.0 / contour.box_diagonal
        found[name.split("/")[1]] = Contour(scale * contour.points, closed=True)
    return found


def kinds() -> dict[str, list[Contour]]:
    """Data of every kind that the paper names: each a list of outlines, all of a shape."""

    def file(name: str, closed: bool) -> Contour:
        return read(DATA / "outlines" / f"{name}.csv", closed=closed).longest

    t = np.linspace(0, 2 * np.pi, 601)
    eight = np.column_stack([5 * np.sin(t), 3 * np.sin(2 * t)])
    drop = np.column_stack([10 * np.sin(t / 2), 4 * np.sin(t) * np.sin(t / 2)])
    drop[-1] = drop[0]
    return {
        "open: a loop": [file("loop500_open", False)],
        "open: an aerofoil": [file("naca2412", False)],
        "semi-closed: a drop with a corner": [Contour(drop, closed=False)],
        "self-intersecting: an eight": [Contour(eight[:-1], closed=True)],
        "two outlines: the letter A": [file(f"NotoSans-Regular_U0065_c{i}", True) for i in (0, 1)],
        "three outlines: an ampersand": [
            file(f"EBGaramond12-Regular_U0026_c{i}", True) for i in (0, 1, 2)
        ],
        "genus one: a gear": [file(f"fa_gear_c{i}", True) for i in (0, 1)],
    }
