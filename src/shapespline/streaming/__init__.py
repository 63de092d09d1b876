"""Streaming: points too many for the memory, seen chunk by chunk."""

from shapespline.streaming.large_fit import FootParameters, LargeFit
from shapespline.streaming.passes import SAMPLE, Measured, Passes, Seen
from shapespline.streaming.proxy import ProxyPolyline
from shapespline.streaming.stream import PointStream, TurnedRows

__all__ = [
    "SAMPLE",
    "FootParameters",
    "LargeFit",
    "Measured",
    "Passes",
    "PointStream",
    "ProxyPolyline",
    "Seen",
    "TurnedRows",
]
