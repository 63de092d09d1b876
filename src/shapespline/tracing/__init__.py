"""Tracing: from a picture to a Shape."""

from shapespline.tracing.any_picture import trace
from shapespline.tracing.centerline import centerlines
from shapespline.tracing.colors import trace_colors
from shapespline.tracing.outlines import Selection, trace_image
from shapespline.tracing.picture import load, pixels_of
from shapespline.tracing.pixels import Channel
from shapespline.tracing.seeing import Local, Polarity

__all__ = [
    "Channel",
    "Local",
    "Polarity",
    "Selection",
    "centerlines",
    "load",
    "pixels_of",
    "trace",
    "trace_colors",
    "trace_image",
]
