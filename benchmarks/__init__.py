"""Benchmarks and the scripts that write what they measure."""
