"""Reconstruction: unordered points to outlines."""
