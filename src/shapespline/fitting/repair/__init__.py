"""Repairs: what is asked of some pieces only is asked for by sub-requests."""

from shapespline.fitting.repair.crossings import told, uncross, uncrossed
from shapespline.fitting.repair.hooks import unhook
from shapespline.fitting.repair.weights import respect_weights

__all__ = ["respect_weights", "told", "uncross", "uncrossed", "unhook"]
