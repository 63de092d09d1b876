"""Drawings whose truth is known: what comes back of their lines, arcs and corners."""
