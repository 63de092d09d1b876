"""IGES: B-splines as entities 126, arcs as 100, lines as 110, joined by composite curves 102."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from shapespline.errors import FormatError
from shapespline.formats import occ
from shapespline.units import MILLIMETRES

if TYPE_CHECKING:
    from shapespline.geometry import Outlines
    from shapespline.values import Drawing

UNITS = {"mm": "MM", "cm": "CM", "m": "M", "in": "INCH", "ft": "FT", "um": "UM", "km": "KM"}
# Written instead of the time: the same drawing gives the same bytes.
TIME = b"15H19700101.000000"


def encode(drawing: Drawing) -> bytes:
    """Bytes of an IGES file (version 5.3).

    Parameters
    ----------
    drawing : Drawing
        In its unit; millimetres where it has none or one that IGES does not know.

    Raises
    ------
    FormatError
        If a piece is too small for it.
    """
    from OCP.IGESControl import IGESControl_Controller, IGESControl_Writer

    unit = drawing.unit if drawing.unit in UNITS else "mm"
    with tempfile.TemporaryDirectory() as folder, occ.silent():
        IGESControl_Controller.Init_s()
        writer = IGESControl_Writer(UNITS[unit or "mm"], 0)
        writer.AddShape(occ.wires(drawing, MILLIMETRES[unit or "mm"]))
        writer.ComputeModel()
        target = Path(folder) / "drawing.igs"
        written = writer.Write(str(target), False)
        text = target.read_bytes() if target.exists() else b""
    if not written or not text:
        raise FormatError("OpenCASCADE could not write the drawing as IGES")
    return re.sub(rb"15H\d{8}\.\d{6}", TIME, text)


def read(path: Path) -> Outlines:
    """Curves of an IGES file in a plane z = constant; its unit becomes millimetres.

    Raises
    ------
    FormatError
        If the file is no IGES file, holds no curve, or one that is not plane.

    Warns
    -----
    SkippedContentWarning
        If curves that repeat others were left out.
    OpenOutlinesWarning
        If ends of open outlines almost meet.
    """
    lines = path.read_bytes().splitlines()
    # Fixed columns: the letter of the section is the 73rd character of every line.
    if len(lines) < 4 or any(line[72:73] not in b"SGDPT" or not line[72:73] for line in lines):
        raise FormatError("this is no whole IGES file: a line without its section letter")
    if lines[-1][72:73] != b"T":
        raise FormatError("the IGES file is cut off: its last section is missing")
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.IGESControl import IGESControl_Reader

    with occ.silent():
        reader = IGESControl_Reader()
        status = reader.ReadFile(str(path))
        if status != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise FormatError("OpenCASCADE cannot read the IGES file: it is damaged")
        reader.TransferRoots()
        shape = reader.OneShape()
    return occ.outlines(shape, "mm", path.name)
