"""Fitting: from a request to a verified Fit."""

from shapespline.engines.drawn import NAMES as REGULARITIES
from shapespline.fitting.curve import fit_curve
from shapespline.fitting.goals import Within
from shapespline.fitting.large import fit_large
from shapespline.fitting.many import Batch, fit_many
from shapespline.fitting.offset import offset_drawing
from shapespline.fitting.optimization import optimize
from shapespline.fitting.request import Request
from shapespline.fitting.settings import SETTINGS_VERSION, Settings
from shapespline.fitting.shape import fit_shape
from shapespline.fitting.verify import verified_fit

__all__ = [
    "REGULARITIES",
    "SETTINGS_VERSION",
    "Batch",
    "Request",
    "Settings",
    "Within",
    "fit_curve",
    "fit_large",
    "fit_many",
    "fit_shape",
    "offset_drawing",
    "optimize",
    "verified_fit",
]
