"""Tracing: from a picture to a Shape."""

from shapespline.tracing.any_picture import trace

__all__ = ["trace"]
