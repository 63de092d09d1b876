"""STEP (ISO 10303-21): plane faces bounded by B-splines, circles and lines.

A closed outline is a face with its holes: programs that read STEP look for bodies, and many of them
pass over loose curves. Its bound is one closed wire, ready to be extruded. Open curves are loose.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from shapespline.errors import FormatError
from shapespline.formats import occ
from shapespline.units import MILLIMETRES

if TYPE_CHECKING:
    from pathlib import Path

    from shapespline.geometry import Outlines
    from shapespline.values import Drawing

# OpenCASCADE's names of the units that a STEP file may be in; others are written as millimetres.
UNITS = {"um": "UM", "mm": "MM", "cm": "CM", "m": "M", "km": "KM", "in": "INCH", "ft": "FT"}
# Written instead of the time: the same drawing gives the same bytes.
TIME = b"1970-01-01T00:00:00"


def encode(drawing: Drawing) -> bytes:
    """Bytes of a STEP file, schema AP214.

    Parameters
    ----------
    drawing : Drawing
        In its unit; millimetres where it has none or one that STEP does not know.

    Returns
    -------
    bytes
        The same for the same drawing.

    Raises
    ------
    FormatError
        If a piece is too small for it: CAD takes points nearer than 1e-7 mm for one.
    """
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    unit = drawing.unit if drawing.unit in UNITS else "mm"
    # OpenCASCADE thinks in millimetres and converts on writing.
    scale = MILLIMETRES[unit or "mm"]
    out = occ.stream()
    with occ.silent():
        writer = STEPControl_Writer()
        Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
        Interface_Static.SetCVal_s("write.step.unit", UNITS[unit or "mm"])
        Interface_Static.SetCVal_s("write.step.product.name", "shapespline")
        writer.Transfer(occ.faces(drawing, scale), STEPControl_StepModelType.STEPControl_AsIs)
        status = writer.WriteStream(out)
    text = out.getvalue()
    if not text.rstrip().endswith(b"END-ISO-10303-21;"):
        raise FormatError(f"OpenCASCADE could not write the drawing as STEP: {status}")
    text = re.sub(rb"(FILE_NAME\([^,]*,')[^']*'", rb"\g<1>" + TIME + b"'", text, count=1)
    return re.sub(rb"'shapespline \d+'", b"'shapespline'", text)


def read(path: Path) -> Outlines:
    """Curves of a STEP file in a plane z = constant; its unit becomes millimetres.

    Lines, circles and B-splines are exact; ellipses and rational curves come within 1e-10 of their
    size.

    Raises
    ------
    FormatError
        If the file is no STEP file, holds no curve, or one that is not plane.

    Warns
    -----
    SkippedContentWarning
        If curves that repeat others were left out.
    OpenOutlinesWarning
        If ends of open outlines almost meet.
    """
    data = path.read_bytes()
    if b"ISO-10303-21" not in data[:1000]:
        raise FormatError("this is no STEP file: it does not begin with ISO-10303-21")
    if b"END-ISO-10303-21" not in data[-1000:]:
        raise FormatError("the STEP file is cut off: it does not end with END-ISO-10303-21")
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader

    with occ.silent():
        reader = STEPControl_Reader()
        status = reader.ReadStream(path.name, occ.stream(data))
        if status != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise FormatError("OpenCASCADE cannot read the STEP file: it is damaged")
        reader.TransferRoots()
        shape = reader.OneShape()
    return occ.outlines(shape, "mm", path.name)
