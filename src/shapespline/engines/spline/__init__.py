"""The spline engine: one B-spline by knot removal with free knots."""

from shapespline.engines.spline.engine import SplineAttempt, attempts
from shapespline.engines.spline.fairness import Fairness, fairness_of

__all__ = ["Fairness", "SplineAttempt", "attempts", "fairness_of"]
