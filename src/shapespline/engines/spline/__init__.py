"""The spline engine: one B-spline by knot removal with free knots."""

from shapespline.engines.spline.engine import fit_spline
from shapespline.engines.spline.fairness import rule_report

__all__ = ["fit_spline", "rule_report"]
