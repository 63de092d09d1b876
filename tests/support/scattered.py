"""Outlines of any number of points, with noise on request."""

import numpy as np

from shapespline.streaming.stream import CHUNK

# Two chunks and a part of one.
N = 2 * CHUNK + 12_345


def wave(n, noise=0.0, seed=0):
    """An open curve, 20 wide."""
    x = np.linspace(0, 20, n)
    points = np.column_stack([x, np.sin(x) + 0.3 * np.sin(3.1 * x)])
    return points + np.random.default_rng(seed).normal(0, noise, points.shape) if noise else points


def ring(n, noise=0.0, seed=0):
    t = 2 * np.pi * np.arange(n) / n
    r = 10 + 1.5 * np.sin(5 * t) + 0.5 * np.sin(11 * t)
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    return points + np.random.default_rng(seed).normal(0, noise, points.shape) if noise else points


def noisy_walk(n, sigma, seed=3):
    """A line that jitters both ways, along and across."""
    rng = np.random.default_rng(seed)
    return np.column_stack([np.linspace(0, 30, n), np.zeros(n)]) + rng.normal(0, sigma, (n, 2))


def rose(n, noise=0.0, seed=0):
    """A smooth closed outline of box diagonal about 130."""
    t = 2 * np.pi * np.arange(n) / n
    r = 50 * (1 + 0.25 * np.cos(5 * t) + 0.08 * np.sin(13 * t + 1))
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    return points + np.random.default_rng(seed).normal(0, noise, points.shape) if noise else points
