"""The studio: a local page that fits while one looks, and shows the verified error both ways."""

from shapespline.studio.server import open_studio

__all__ = ["open_studio"]
