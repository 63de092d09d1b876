"""Drawings whose truth is known, rendered, traced and fitted: what comes back of what was drawn.

python -m benchmarks.drawn            the tables
python -m benchmarks.drawn --page     the same, docs/drawn.md and its pictures

potrace, vtracer, CairoSVG and Playwright's browser take part where they are installed.
"""

from __future__ import annotations

import argparse

from benchmarks.drawn import random_plates
from benchmarks.drawn.equal_outlines import equal_table, twins_table
from benchmarks.drawn.few_points import exported_table, measured_table, organic_table
from benchmarks.drawn.fillets import fillets_table
from benchmarks.drawn.limits import limits_table
from benchmarks.drawn.measuring import measuring_table
from benchmarks.drawn.page import write_page
from benchmarks.drawn.pixel_chains import chains_table
from benchmarks.drawn.profiles import clean_table, profiles_table
from benchmarks.drawn.short_sides import short_sides_table
from benchmarks.drawn.stroke_ends import stroke_ends_table
from benchmarks.drawn.tables import pictures_tables, recovered_table, sampled_table

LIMITS = """Errors over those of least squares that are told which points are whose, what is a line
or an arc and which joints are tangent: of lines, of arcs, of corners, of the fits that are right.

"""

PROFILES = """
Profiles of straight edges and curves between corners (`python -m benchmarks.drawn.profiles`), half
of ten draws level: how many fits have the profile's own edges and curves, and the distance to the
truth over that of the fewest points, root mean squares.

"""

CLEAN = """
The same without noise, corners between the points: how many of ten have the profile's own edges
and curves and no bits beside, without a tolerance and within some, parts of the box diagonal.

"""

RANDOM = """
Plates of random forms, level or turned (`python -m benchmarks.drawn.random_plates`): right angles
and fillets of one or two radii, some corners sharp, or no two directions and no two radii alike.
How many fits of exact points have the lines and arcs that were drawn and nothing else, without a
tolerance and within some; then those of noisy points, and the distance from the plate to them in
deviations of a point, geometric mean. Within a tolerance sharp corners between the points are out
of reach where their chord is farther off.

"""

NOISY = """
Noisy points within a tolerance, and the stored points over the drawing's own: corners that no point
lies in are cut where their chord is within it.

"""

TRACED = """
The same plates traced from pictures, by renderers, without a tolerance and within 0.35 pixels, of
so many pixels.

"""

FILLETS = """
Small fillets in pictures of 256 pixels that are not exact (`python -m benchmarks.drawn.fillets`): a
box of 200 x 120 pixels, a hexagon and an octagon of 100 about the middle, level or turned by 17
degrees, radii in pixels. How many of eight places have the lines and arcs that were drawn and
nothing else.

"""

SHORT = """
Short sides between fillets (`python -m benchmarks.drawn.short_sides`): between arcs of 12 and 28
pixels, of a box 28 pixels wide with fillets of 8, a step with fillets of 8 inside and outside; the
same pictures, level and turned by 17 degrees. How many of sixteen places have the lines and arcs
that were drawn and nothing else.

"""

ENDS = """
Ends of strokes of 1.5 to 5 pixels (`python -m benchmarks.drawn.stroke_ends`): bars 40 pixels long,
feet of a T and an I, combs, slots with round ends, level and turned by 17 degrees. How many of
eight places have the lines and arcs that were drawn and nothing else, and how many pixels their
corners are off, the median and the largest.

"""

EQUAL = """
Six equal outlines of one drawing (`python -m benchmarks.drawn.equal_outlines`), moved, mirrored or
on a ring, about 40 pixels large in 256, and 400 points each: how many have the lines and arcs that
were drawn and nothing else, and in how many drawings all six are one to rounding; then outlines of
two kinds by turns that are nearly equal, which must stay what they are.

"""

MEASURING = """
The random plates as instruments measure them (`python -m benchmarks.drawn.measuring`): 400 points,
0.1 % noise without a tolerance, 0.05 % within 0.3 %; at uneven steps, with a stretch that is
missing or was measured twice, one point of a hundred ten deviations off, errors with long tails
(Student's t of 3), larger ones on half of the outline, along one axis alone, each 0.4 or 0.7 of
the one before and what is new, or means of three; at last coordinates of three digits without
noise. How many fits have the lines and arcs that were drawn and nothing else, and how far the plate
is from them in deviations of a point, geometric mean. Within a tolerance the curve follows strays
(`outliers=True` leaves out those that jump), and corners that no point lies in are cut where their
chord is within it.

"""

CHAINS = """
The regular ones as the borders of masks (`python -m benchmarks.drawn.pixel_chains`): the pixels
whose middles lie in a plate of 200 or 500 of them, their border as the middles of its pixels, as
corners of pixels, or as the level line of the mask; all points, or those alone where it turns. How
many fits without a tolerance have the lines and arcs that were drawn and nothing else; then a leaf,
a hand, a dove and a letter, their stored points and how many pixels they are off.

"""

FEW = """
Few measured points, 24 to 60 of shapes 60 wide (`python -m benchmarks.drawn.few_points`): how many
fits have the lines and arcs that were drawn and nothing else. Within a tolerance corners between
the points are out of reach where their chord is farther off; of 24 points an arc of a plate or a
tab has two.

"""

EXPORTED = """
Vertices of lines and arcs of all plates and icons as programs export them, ends of edges and of
chords, four and more for each arc.

"""

ORGANIC = """
Few points of shapes without lines and arcs: how many fits have arcs.

"""


def main() -> None:
    """Print the tables; with --page write the page and its pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write docs/drawn.md and its pictures")
    asked = parser.parse_args()
    pictures, points = pictures_tables(), f"{sampled_table()}\n{recovered_table()}\n{LIMITS}"
    points += f"{limits_table()}{PROFILES}{profiles_table()}{CLEAN}{clean_table()}"
    points += f"{RANDOM}{random_plates.clean_table()}\n{random_plates.noisy_table()}"
    points += f"{NOISY}{random_plates.within_table()}{TRACED}{random_plates.pictures_table()}"
    points += f"{FILLETS}{fillets_table()}{SHORT}{short_sides_table()}"
    points += f"{ENDS}{stroke_ends_table()}"
    points += f"{EQUAL}{equal_table()}\n{twins_table()}"
    points += f"{MEASURING}{measuring_table()}{CHAINS}{chains_table()}"
    points += f"{FEW}{measured_table()}{EXPORTED}{exported_table()}{ORGANIC}{organic_table()}"
    print("\n".join([*pictures.texts, points, *pictures.left_out]))
    if asked.page:
        write_page(pictures, points)


if __name__ == "__main__":
    main()
