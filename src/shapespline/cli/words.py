"""Sentences of the library in the words of the command line: options as they are typed."""

from __future__ import annotations

import functools
import re

# What the library says -> what was typed. Options that the command line lacks are not spoken of.
WORDS = (
    (r"(--[\w-]+(?: \S+)?) \(\w+=[^)]*\)", r"\1"),
    (r"end_tangents, through and symmetric act\b", "--symmetric acts"),
    (r"end_tangents and through act\b", "directions and points act"),
    (r"\bend_tangents, through, symmetric and\b", "--symmetric and"),
    (r"\bweights, sigma and loss out\b", "--sigma and --loss out"),
    (r"\bn_control_points\b(?:=(\d+))?", r"--control-points \1"),
    (
        r"; go on from here with optimize\(contour, fit\)",
        "; take more points or a larger tolerance",
    ),
    (r"; raise max_(?:iterations|evaluations)", ""),
    (r"\b(corners|form|ends|effort|unit|character)='([^']*)'", r"--\1 \2"),
    (r"\bsmoothness=(\d)", r"--smoothness \1"),
    (r"\btolerance=([^\s,;)]+)", r"--tolerance \1"),
    (r"\bwith weights or form=\S+", "with --form spline"),
    (
        r"\b(time_limit|arc_tolerance|safe_height|min_area|y_down|shared_boundaries)\b(?:=([^\s,;)]+))?",
        r"--\1 \2",
    ),
    (r"^release\b", "--dxf-release"),
    (r"^simplify\b", "--simplify"),
    (r"sort them with order_points, or read them with unordered=True", "say --unordered"),
    (r"\bclosed=True or closed=False\b", "--closed or --open"),
    (r"\bdpi, pixels per inch, or scale\b", "--dpi, --width or --scale"),
)
PATTERNS = tuple((re.compile(pattern), said) for pattern, said in WORDS)


def own_words(sentence: str) -> str:
    """The sentence as the command line says it.

    Examples
    --------
    >>> own_words("n_control_points must be at least degree + 1 = 4, got 3")
    '--control-points must be at least degree + 1 = 4, got 3'
    >>> own_words("left out as noise: --min-area 0 (min_area=0) keeps them")
    'left out as noise: --min-area 0 keeps them'
    >>> own_words("the iterations ran out before convergence; raise max_iterations")
    'the iterations ran out before convergence'
    >>> own_words("corners and effort do not act with time_limit=3")
    'corners and effort do not act with --time-limit 3'
    >>> own_words("give more points or tolerance=0.0075 for a smooth curve")
    'give more points or --tolerance 0.0075 for a smooth curve'
    >>> own_words("beside character='drawn' leave n_control_points, weights, sigma and loss out")
    'beside --character drawn leave --control-points, --sigma and --loss out'
    """
    for pattern, said in PATTERNS:
        sentence = pattern.sub(functools.partial(_filled, said), sentence)
    return sentence


def _filled(said: str, found: re.Match[str]) -> str:
    """The template with what was found; names with dashes, no blank where nothing follows."""
    text = re.sub(r"\\(\d)", lambda group: found.group(int(group[1])) or "", said)
    head, blank, rest = text.partition(" ")
    if head.startswith("--"):
        head = head.replace("_", "-")
    return f"{head}{blank}{rest}".rstrip()
