"""Pictures: decoded and traced in :mod:`shapespline.tracing`, whose options are those of a file."""

from __future__ import annotations

from shapespline.tracing import trace as read

__all__ = ["read"]
