"""How far the ball joints of a linkage turn: the cone about the axis of a socket in which the coupler stays.

A ball joint lets its coupler turn by so much from the axis of its socket and no farther, 15 to 30 deg with those that
can be bought.  The axis is fixed to the crank, or to the rocker; best is that of the smallest cone that holds all
directions in which the coupler leaves the joint.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from ..geometry import dot, vector
from ..quantities.types import Array

if TYPE_CHECKING:
    from .rssr_analysis import RSSRAnalysis

PAIRS = tuple((i, j, j) for i, j in combinations(range(4), 2))
TRIPLES = tuple(combinations(range(4), 3))
ROUNDING = 1e-13
"""A direction that misses a cone by less is on it."""
ROUNDS = 16
"""How many directions are taken in, the farthest from the cone first; a curve's smallest cone has 2 or 3 on it."""


def _unit(vectors: Array) -> Array:
    length = np.sqrt(dot(vectors, vectors))
    return vectors / np.where(length > 0, length, 1.0)


def _cap(points: Array) -> tuple[Array, Array]:
    """Axis ``(3, ..., 1)`` of the smallest cone that holds four directions ``(3, ..., 4)``, and the three on it.

    It is the smallest about two of them or through three, seen as the one from whose axis the farthest is nearest.
    """
    p = [points[..., i] for i in range(4)]
    axes = [_unit(p[i] + p[j]) for i, j, _ in PAIRS]
    for i, j, k in TRIPLES:
        normal = _unit(np.cross(p[j] - p[i], p[k] - p[i], axis=0))
        axes.append(normal * np.where(dot(normal, p[i]) < 0, -1.0, 1.0))
    candidates = np.stack(axes, axis=-1)
    best = np.argmax(dot(candidates[..., None], points[..., None, :]).min(-1), axis=-1)
    on = [_taken(np.stack([p[members[m]] for members in PAIRS + TRIPLES], axis=-1), best) for m in range(3)]
    return _taken(candidates, best), np.concatenate(on, axis=-1)


def _taken(vectors: Array, at: Array) -> Array:
    """That of ``vectors`` ``(3, ..., n)`` which stands at ``at`` ``(...)``, ``(3, ..., 1)``."""
    return np.take_along_axis(vectors, np.stack([at] * 3)[..., None], axis=-1)


def smallest_cone(directions: Array) -> Array:
    """Axis of the smallest cone that holds all unit vectors ``(3, ..., n)``, ``(3, ..., 1)``; ``nan`` of what is none.

    From a pair on, the direction farthest outside comes in, and the smallest cone about it and those on the last one
    is made: it grows each time, and stops when it holds all.  Without a cone of at most 90 deg it is one of those.

    >>> x, y, z = smallest_cone(np.array([[0.6, 0.0, -0.6], [0.0, 0.6, 0.0], [0.8, 0.8, 0.8]]))[:, 0].round(6) + 0
    >>> float(x), float(y), float(z)
    (0.0, 0.0, 1.0)
    """
    axis = directions[..., :1]
    held = np.concatenate([axis, axis, axis], axis=-1)
    for _ in range(ROUNDS):
        far = _taken(directions, np.argmin(dot(axis, directions), axis=-1))
        grown, on = _cap(np.concatenate([held, far], axis=-1))
        outside = dot(axis, far) < dot(axis, held).min(-1, keepdims=True) - ROUNDING
        axis, held = np.where(outside, grown, axis), np.where(outside, on, held)
    return axis


@dataclass(frozen=True)
class BallJoint:
    """The ball joint of the coupler and one of the links, in the link's frame: along it, its way, along its axis."""

    frame: tuple[Array, Array, Array]
    """Unit vectors ``(3, ..., n)`` of the link's frame."""
    along: Array
    """Unit vector in which the coupler leaves the joint."""

    @cached_property
    def directions(self) -> Array:
        """In which the coupler leaves the joint, as seen from the link, ``(3, ..., n)``."""
        return np.stack([dot(self.along, unit) for unit in self.frame])

    @cached_property
    def axis(self) -> Array:
        """Of the socket with the smallest cone, as seen from the link, ``(3, ..., 1)``."""
        return smallest_cone(self.directions)

    @cached_property
    def angle(self) -> Array:
        """Between the coupler and the axis of that socket, rad."""
        return self.angle_from(self.axis)

    def angle_from(self, axis: Array) -> Array:
        """Between the coupler and an ``axis`` of the link's frame, ``(3, ..., 1)``, rad."""
        missing = self.directions.ndim - axis.ndim
        axis = axis.reshape(3, *(1 for _ in range(missing)), *axis.shape[1:]) + 0.0 * self.directions
        across = np.cross(axis, self.directions, axis=0)
        return np.arctan2(np.sqrt(dot(across, across)), dot(axis, self.directions))

    def in_space(self, axis: Array) -> Array:
        """An ``axis`` of the link's frame in the machine's, ``(3, ..., n)``."""
        (x, y, z), (along, way, up) = axis, self.frame
        return x * along + y * way + z * up


def crank_ball(at: RSSRAnalysis) -> BallJoint:
    """The ball joint of the crank."""
    frame = at.crank_arm / at.linkage.crank, at.crank_motion, at.everywhere(at.linkage.crank_axis)
    return BallJoint(frame, at.coupler_direction)


def rocker_ball(at: RSSRAnalysis) -> BallJoint:
    """The ball joint of the rocker."""
    frame = at.rocker_arm / at.linkage.rocker, at.rocker_motion, at.everywhere(at.linkage.rocker_axis)
    return BallJoint(frame, -at.coupler_direction)


def as_axis(along: float, way: float, up: float) -> Array:
    """A direction in a link's frame as an axis, ``(3, 1)``.

    >>> as_axis(0, 3, 4).T.tolist()
    [[0.0, 0.6, 0.8]]
    """
    return _unit(vector(along, way, up)[:, None])
