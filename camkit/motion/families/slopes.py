"""Slopes of a spline that turns nowhere but at its rows, and its zeros (Fritsch and Butland)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...quantities.types import Array

HALVINGS = 55


def slopes(h: Array, rise: Array) -> Array:
    """The slope at each row, of the widths ``h`` between rows and how steep the chord of each is, ``(.., n)``.

    Inside the harmonic mean of both chords, weighted, and 0 where they go different ways.
    """
    if len(h) == 1:
        return np.concatenate([rise, rise], axis=-1)
    before, after = rise[..., :-1], rise[..., 1:]
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    alike = before * after > 0
    mean = (w1 + w2) / (w1 / np.where(alike, before, 1.0) + w2 / np.where(alike, after, 1.0))
    first = _at_end(h[0], h[1], rise[..., :1], rise[..., 1:2])
    last = _at_end(h[-1], h[-2], rise[..., -1:], rise[..., -2:-1])
    return np.concatenate([first, np.where(alike, mean, 0.0), last], axis=-1)


def _at_end(h0: float, h1: float, near: Array, next_: Array) -> Array:
    """The slope at an end, of the two chords next to it: that of the parabola, unless it would turn."""
    d = ((2 * h0 + h1) * near - h0 * next_) / (h0 + h1)
    steep = (near * next_ <= 0) & (abs(d) > 3 * abs(near))
    return np.where(d * near <= 0, 0.0, np.where(steep, 3 * near, d))


def zero_of_cubic(c: Sequence[Array], h: Array, near: Array) -> Array:
    """Where cubics without a turn, whose ends between 0 and ``h`` have different signs, are 0, by halving."""
    low, high = 0.0 * near, h + 0.0 * near
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        early = (c[0] + middle * (c[1] + middle * (c[2] + middle * c[3]))) * c[0] > 0
        low, high = np.where(early, middle, low), np.where(early, high, middle)
    return (low + high) / 2
