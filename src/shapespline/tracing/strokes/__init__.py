"""Centre lines of strokes."""

from shapespline.tracing.strokes.centerline import centerlines

__all__ = ["centerlines"]
