"""Starts of a given size: where knots and parameters begin."""
