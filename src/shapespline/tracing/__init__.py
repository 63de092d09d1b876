"""Tracing: from a picture to a Shape."""

from shapespline.tracing.centerline import centerlines
from shapespline.tracing.outlines import Polarity, Selection, trace_image
from shapespline.tracing.pixels import Channel

__all__ = ["Channel", "Polarity", "Selection", "centerlines", "trace_image"]
