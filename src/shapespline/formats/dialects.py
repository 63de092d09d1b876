"""How a table of text is written: separators, decimal marks, quotes, lines before its numbers."""

from __future__ import annotations

import re
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

from shapespline.errors import FormatError
from shapespline.formats.columns import COMMENT

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# A field in quotes, between separators; two quotes stand for one.
QUOTED = re.compile(r'(?<![^,;\t ])"((?:[^"]|"")*)"(?![^,;\t ])')
# A number with a decimal comma, which is no separator within quotes.
DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+(?:[eE][+-]?\d+)?\s*")
# The line by which Excel says what separates the columns.
SAID_SEPARATOR = re.compile(r"\s*sep=.\s*", re.IGNORECASE)
# What headers say behind names: "x [mm]", "y (m)".
UNITS = re.compile(r"\s*[\[(][^\])]*[\])]")
# Lines of words and units before the first line of numbers, at most.
MOST_HEADER_LINES = 20
# Names of columns that hold x and y.
NAMES = (
    ("x", "y"),
    ("lon", "lat"),
    ("lng", "lat"),
    ("long", "lat"),
    ("longitude", "latitude"),
    ("e", "n"),
    ("east", "north"),
    ("easting", "northing"),
    ("rechtswert", "hochwert"),
)


class Dialect(NamedTuple):
    """How a line is written: what separates its columns (None: blanks), the decimal mark."""

    separator: str | None
    decimal: str

    def fields(self, line: str) -> list[str]:
        """Columns of a line, with decimal points."""
        fields = [field.strip() for field in line.split(self.separator)]
        return [field.replace(self.decimal, ".") for field in fields]


# In order of preference. With semicolons or blanks between the columns a comma is a decimal comma.
DIALECTS = (
    Dialect(";", "."),
    Dialect(";", ","),
    Dialect(",", "."),
    Dialect(None, "."),
    Dialect(None, ","),
)


class Head(NamedTuple):
    """What the first lines say: the dialect, how many lines to skip, whether y stands before x."""

    dialect: Dialect
    n_lines: int
    y_first: bool = False


def lines_of(text: str) -> list[str]:
    r"""Lines of a table without quotes; a decimal comma in quotes becomes a point.

    Examples
    --------
    >>> lines_of('sep=,\n"x, east","y"\n"0,5","-1,5"\n')
    ['#', 'x  east,y', '0.5,-1.5', '']
    """
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if SAID_SEPARATOR.fullmatch(lines[0]):
        lines[0] = COMMENT
    if '"' not in text:
        return lines
    return [QUOTED.sub(_unquoted, line).replace('"', "") for line in lines]


def _unquoted(field: re.Match[str]) -> str:
    """Content of a field, with nothing in it that could be taken for a separator."""
    inside = field[1].replace('""', "")
    if DECIMAL_COMMA.fullmatch(inside):
        return inside.replace(",", ".")
    return re.sub(r"[,;\t]", " ", inside)


def content_of(lines: list[str], start: int = 0) -> Iterator[tuple[int, str]]:
    """Index and content of the lines that hold more than blanks and comments."""
    for index in range(start, len(lines)):
        content = lines[index].split(COMMENT, 1)[0].strip()
        if content:
            yield index, content


def head_of(lines: list[str]) -> Head:
    """The dialect of the first line of two numbers; lines of words may stand before it.

    Raises
    ------
    FormatError
        If there is nothing but words.
    """
    first = [*islice(content_of(lines), MOST_HEADER_LINES + 1)]
    if not first:
        raise FormatError("no points: only blank lines and comments")
    for place, (index, line) in enumerate(first):
        for dialect in DIALECTS:
            fields = dialect.fields(line)
            if len(fields) == 2 and None not in map(number, fields):
                header = [said for _, said in first[:place]]
                if not all(_is_header(said, dialect) for said in header):
                    return Head(dialect, 0)
                return Head(dialect, index, _is_y_first(header, dialect))
    if len(first) == 1 and not any(letter.isdigit() for letter in first[0][1]):
        raise FormatError(f"no points: only a line of words, {shown(first[0][1])}")
    # No line of two numbers to learn from: the likeliest dialect, for the diagnosis.
    sample = first[min(1, len(first) - 1)][1]
    separator = next((mark for mark in (";", ",") if mark in sample), None)
    return Head(Dialect(separator, "."), 0)


def _is_header(line: str, dialect: Dialect) -> bool:
    """Whether a line holds no numbers; a title in words may end with one (NACA 2412)."""
    fields = dialect.fields(line)
    if dialect.separator is None:
        fields = fields[:1]
    begins_a_number = fields[0].lstrip("+-.,")[:1].isdigit()
    return not begins_a_number and all(number(field) is None for field in fields)


def _is_y_first(header: Sequence[str], dialect: Dialect) -> bool:
    """Whether a line of names says that the columns are y and x, such as latitude and longitude."""
    for line in header:
        fields = [field.casefold() for field in dialect.fields(UNITS.sub("", line))]
        if tuple(reversed(fields)) in NAMES:
            return True
    return False


def number(field: str) -> float | None:
    """Value of a field, None if it is no number."""
    if "_" in field or not field.isascii():  # Python would take them, data files do not
        return None
    try:
        return float(field)
    except ValueError:
        return None


def shown(text: str) -> str:
    """Text quoted for a message, cut if long."""
    return repr(text if len(text) <= 40 else f"{text[:37]}...")
