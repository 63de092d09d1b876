"""Two columns of a wider table of text, by name or by number."""

from __future__ import annotations

import re

from shapespline.errors import FormatError, InvalidInputError

COMMENT = "#"
# What may part columns, in order of preference; None: blanks and tabs, a run of them counts once.
SEPARATORS = (";", "\t", ",", None)
# What headers say behind a name: "x [mm]", "y (m)".
UNIT = re.compile(r"\s*[\[(][^\])]*[\])]$")


def picked(lines: list[str], columns: str) -> list[str]:
    """Lines that hold x and y alone, one for each line of the table, parted by semicolons.

    Parameters
    ----------
    lines : list of str
    columns : str
        Two names of the first line, or two numbers from 1, parted by a comma. A unit in brackets
        behind a name and capitals may be left out where one column alone can be meant.

    Raises
    ------
    InvalidInputError
        If ``columns`` are not two.
    FormatError
        If a name or number is no column of the table; naming the line, if one is too short.

    Examples
    --------
    >>> picked(["id,east,north", "a,1.5,2", "b,3,4"], "east,north")
    ['#', '1.5;2', '3;4']
    >>> picked(["7 1.5 2"], "3,2")
    ['2;1.5']
    >>> picked(["No,X [mm],Y [mm]", "1,1.5,2"], "x,y")
    ['#', '1.5;2']
    """
    wanted = [name.strip() for name in columns.split(",")]
    if len(wanted) != 2 or not all(wanted):
        raise InvalidInputError(
            f"columns must be two names or numbers such as 'x,y' or '2,3', got {columns!r}"
        )
    first = next((line for line in lines if line.split(COMMENT, 1)[0].strip()), "")
    separator = next((mark for mark in SEPARATORS if len(first.split(mark)) > 1), None)
    header = [field.strip() for field in first.split(separator)]
    numbered = all(name.isdigit() for name in wanted)
    at = [_index(name, header, numbered) for name in wanted]
    found, named = [], not numbered
    for number, line in enumerate(lines, start=1):
        content = line.split(COMMENT, 1)[0].strip()
        if not content:
            found.append(line)
            continue
        if named:  # the line of names itself
            named = False
            found.append(COMMENT)
            continue
        fields = content.split(separator)
        if len(fields) <= max(at):
            raise FormatError(f"line {number}: expected {max(at) + 1} columns, found {len(fields)}")
        found.append(";".join(fields[index].strip() for index in at))
    return found


def _index(name: str, header: list[str], numbered: bool) -> int:
    """Place of a column in a line."""
    if numbered and 1 <= int(name) <= len(header):
        return int(name) - 1
    if not numbered:
        short = [UNIT.sub("", field).casefold() for field in header]
        for names, wanted in ((header, name), (short, name.casefold())):
            if names.count(wanted) == 1:
                return names.index(wanted)
    raise FormatError(f"no column {name!r}; the table has {len(header)}: {', '.join(header)}")
