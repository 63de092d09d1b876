"""Formats: one file and one line of the registry for each."""

from shapespline.formats.atomic import check_target, write_atomically
from shapespline.formats.csv import columns_of
from shapespline.formats.pieces import bezier
from shapespline.formats.preview import html_preview, svg_preview
from shapespline.formats.registry import (
    FORMATS,
    Format,
    check_output,
    read,
    readable,
    writable,
    write,
)

__all__ = [
    "FORMATS",
    "Format",
    "bezier",
    "check_output",
    "check_target",
    "columns_of",
    "html_preview",
    "read",
    "readable",
    "svg_preview",
    "writable",
    "write",
    "write_atomically",
]
