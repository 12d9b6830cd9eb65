"""How near the parts of an open groove come to each other: whether its walls merge.

A tool of the roller's radius ``r`` that runs along the pitch curve cuts the groove.  Where the curve bends too sharply
the tool cuts the flank beside it, which its curvature tells (``r kappa >= 1``, the local test).  Two places that are
far from each other *along* the curve may still lie side by side: if they are nearer than ``2 r`` their walls merge.
A curve that keeps the local test has, between places less than ``pi r`` apart along it, chords as long as those of a
circle of the radius ``r`` (Schur's theorem), so only places farther apart are looked at.

For closed cams the local test is enough for practical purposes: the curve goes around once, its parts cannot lie side
by side, and what is left are needles.  Of 5000 random closed cams one had a gouge that the local test did not see, at a
pressure angle of 88 deg.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce

import numpy as np

from ..quantities import certain
from ..quantities.types import Array, Value

COARSE, FINE, ROUNDS, CLOSER, ROUGH = 49, 5, 3, 3, 25
"""Places along the groove; then how many around each of the nearest two, how often, each time so much closer.

A rough look takes the last number of places and one round."""


def gap(path: Callable[[Array], Array], span: Value, radius: Value, rough: bool = False) -> Value:
    """The least distance between two parts of a groove's pitch curve, less ``2 radius``, m; below 0 the walls merge.

    Only a gap below a quarter of the radius is looked at more closely; a larger one is an estimate from above.
    A ``rough`` look is at fewer places and once around the nearest.

    ``path`` gives its points ``(2, ..., n)``, or ``(3, ..., n)`` in space, at ``(..., n)`` places from 0 to ``span``.
    Where nothing lies side by side the neighbours along the curve are the nearest, and the gap is about
    ``(pi - 2) radius``.

    >>> def hairpin(t):  # down one side and up the other, 30 mm apart, around a half circle
    ...     bend = np.clip(t - 100, 0, 15 * np.pi) / 15
    ...     leg = np.minimum(t, 100) - np.maximum(t - 100 - 15 * np.pi, 0)
    ...     return np.stack([-15 * np.cos(bend), -leg - 15 * np.sin(bend)])
    >>> print(f"{gap(hairpin, 200 + 15 * np.pi, 14.0):.3f}, {gap(hairpin, 200 + 15 * np.pi, 15.0):.3f}")
    2.000, 0.000
    """
    places, rounds = (ROUGH, 1) if rough else (COARSE, ROUNDS)
    points = path(span * np.linspace(0, 1, places))
    steps = np.cumsum(reduce(np.hypot, np.diff(points)), axis=-1)
    along = np.concatenate([0 * steps[..., :1], steps], axis=-1)
    pair, least = _nearest(points, along, radius)
    close = least < 2.25 * radius + np.diff(along).max(-1, keepdims=True) / 4
    if not certain(np.logical_not(close)):
        least = np.where(close, _closer(path, span, radius, along, pair, least, rounds), least)
    return np.where(np.isnan(along[..., -1:]), np.nan, least - 2 * radius)[..., 0][()]


def _nearest(points: Array, along: Array, radius: Value) -> tuple[Array, Array]:
    """The nearest two places ``(2, ..., 1)``, in coarse steps, that are not neighbours along the curve; how near, m."""
    nearest, firsts = [], []
    for k in range(1, along.shape[-1]):  # in parts that fit into the processor's own memory
        i, j = (..., slice(None, -k)), (..., slice(k, None))
        near = ((points[j] - points[i]) ** 2).sum(0)
        near = np.where(along[j] - along[i] >= np.pi * radius, near, np.inf)
        firsts.append(np.argmin(near, axis=-1))
        nearest.append(near.min(-1))
    least, first = np.stack(nearest, axis=-1), np.stack(firsts, axis=-1)
    tied = least == least.min(-1, keepdims=True)  # of pairs as near as each other, as of two parallel legs, the first
    best = np.argmin(np.where(tied, first, along.shape[-1]), axis=-1)[..., None]
    start = np.take_along_axis(first, best, -1)
    return np.stack([start, start + best + 1]).astype(float), np.sqrt(np.take_along_axis(least, best, -1))


def _closer(
    path: Callable[[Array], Array], span: object, radius: Value, along: Array, pair: Array, least: Array, rounds: int
) -> np.ndarray:
    """How near two places around each of ``pair`` are, at finer and finer steps."""
    last, around, reach = along.shape[-1] - 1, np.linspace(-1, 1, FINE), 1.0
    for _ in range(rounds):
        t, u = np.clip(pair + reach * around, 0, last)
        points = path(np.concatenate([t, u], axis=-1) * span / last)
        apart = _between(along, u)[..., None, :] - _between(along, t)[..., :, None]
        near = reduce(np.hypot, points[..., :FINE, None] - points[..., None, FINE:])
        near = np.where(apart >= np.pi * np.expand_dims(radius, -1), near, np.inf)
        near = near.reshape(*near.shape[:-2], FINE * FINE)
        best = np.argmin(near, axis=-1)[..., None]
        found = np.take_along_axis(near, best, -1)
        here = [np.take_along_axis(place, k, -1) for place, k in ((t, best // FINE), (u, best % FINE))]
        pair = np.where(found < least, np.stack(here), pair)
        least, reach = np.where(found < least, found, least), reach / CLOSER
    return least


def _between(along: Array, step: Array) -> Array:
    """How far along the curve a place lies, which is counted in coarse steps."""
    whole = np.minimum(step.astype(int), along.shape[-1] - 2)
    low, high = (np.take_along_axis(along, whole + k, -1) for k in (0, 1))
    return low + (step - whole) * (high - low)
