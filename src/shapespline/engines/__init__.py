"""Engines: each turns a problem into a curve; none knows another."""
