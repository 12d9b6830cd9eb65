"""Geometry shared by the mechanisms; points are ``(2, ..., n)``, in space ``(3, ..., n)``: components first."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, SupportsIndex

import numpy as np

from .quantities.known import known
from .quantities.types import Array, Value


@dataclass(frozen=True)
class Body(ABC):
    """A part of a plane mechanism to scale, with its path: its place (m) and angle (rad) at each position.

    ``x``, ``y`` and ``angle`` are numbers, or ``(n,)`` with one for each position.  Parts of one ``name`` belong
    together; ``part`` is what it is: "body", "profile", "flank", "pitch", "axis", "guide", "arm",
    "face", "block", "roller", "pivot", "spring", "mass".
    """

    name: str
    part: str
    x: Value = field(default=0.0, kw_only=True)
    y: Value = field(default=0.0, kw_only=True)
    angle: Value = field(default=0.0, kw_only=True)

    @abstractmethod
    def at(self, i: SupportsIndex) -> np.ndarray:
        """Where it is drawn at position ``i``, machine's frame, m."""


@dataclass(frozen=True)
class Outline(Body):
    """A body by points ``(2, k)`` of its own frame, joined in their order; one alone is a pin.

    >>> arm = Outline("arm", "arm", np.array([[0.0, 2.0], [0.0, 0.0]]), x=1.0, angle=np.array([0.0, np.pi / 2]))
    >>> arm.at(1).round(6).tolist()
    [[1.0, 1.0], [0.0, 2.0]]
    """

    points: Array
    cut: Value | None = None
    """At which points it is cut away, ``(k,)``; ``None``: nowhere."""

    def at(self, i: SupportsIndex) -> np.ndarray:
        """Its points in the machine's frame at position ``i``, ``(2, k)``, m."""
        x, y, angle = (_at(value, i) for value in (self.x, self.y, self.angle))
        return rotated(self.points, angle) + vector(x, y)[:, None]


@dataclass(frozen=True)
class Disc(Body):
    """A round body of a radius (m) about its place."""

    radius: Value

    def at(self, i: SupportsIndex) -> np.ndarray:
        """Its centre at position ``i``, ``(2,)``, m."""
        return np.stack([_at(value, i) for value in (self.x, self.y)])


@dataclass(frozen=True)
class Coil(Body):
    """A spring from its place to its ``end`` ``(2,)`` or ``(2, n)``, m, drawn flat: a zigzag of a ``width`` (m).

    >>> Coil("", "spring", end=np.array([0.0, 0.4]), width=0.1, turns=2).at(0)[0].round(6).tolist()
    [0.0, 0.0, 0.05, -0.05, 0.05, -0.05, 0.0, 0.0]
    """

    end: Array
    width: Value
    turns: int = 6

    def at(self, i: SupportsIndex) -> np.ndarray:
        """Its points at position ``i``, ``(2, k)``, m."""
        start, end = (vector(*(_at(part, i) for part in place)) for place in ((self.x, self.y), self.end))
        whole = end - start
        across = vector(-whole[1], whole[0]) / np.hypot(*whole)
        bends = np.linspace(LEAD, 1 - LEAD, 4 * self.turns + 1)[1::2]
        side = np.append(np.tile([-0.5, 0.5], self.turns), [0.0, 0.0])
        share = np.concatenate([[0.0, LEAD], bends, [1 - LEAD, 1.0]])
        return start[:, None] + whole[:, None] * share + self.width * across[:, None] * np.append([0.0, 0.0], side)


LEAD = 0.12
"""This share of a spring is straight, at each end."""


@dataclass(frozen=True)
class Shape(ABC):
    """A part of a mechanism in space, to scale, with its path; names and parts are those of a `Body`."""

    name: str
    part: str

    @abstractmethod
    def at(self, i: SupportsIndex) -> np.ndarray:
        """Its points at position ``i``, machine's frame, ``(3, ...)``, m."""

    @property
    @abstractmethod
    def extent(self) -> tuple[Value, Value, Value]:
        """How far it ever is from the z axis, and between which heights, m."""


@dataclass(frozen=True)
class Cylinder(Shape):
    """A round bar of a radius (m) between the middles of its ``ends``, ``(3, 2)`` or ``(3, 2, n)`` for n positions."""

    radius: Value
    ends: Array

    def at(self, i: SupportsIndex) -> np.ndarray:
        """The middles of its ends at position ``i``, ``(3, 2)``, m."""
        return self.ends if np.ndim(self.ends) < 3 else vector(*(_at(part, i) for part in self.ends))

    @property
    def extent(self) -> tuple[Value, Value, Value]:
        """As if its radius were at right angles to the z axis."""
        x, y, z = self.ends
        return np.max(np.hypot(x, y)) + self.radius, np.min(z), np.max(z)


@dataclass(frozen=True)
class Strip(Shape):
    """A strip of surface between two ``edges`` ``(3, 2, k)`` on a body that turns about the z axis by ``angle`` (rad).

    Its outer side alone is seen; its part is what its first edge is, "face" that of an end face, or it is the
    "floor" or a "wall" of a groove, which are seen on the near side of the body only.  Along the edges, from the first
    to the second, outwards: with ``hand`` +1 these directions are right-handed, with -1 left-handed.
    """

    edges: Array
    cut: Value | None = None
    """At which of the ``k`` places its first edge is cut away; ``None``: nowhere."""
    angle: Value = field(default=0.0, kw_only=True)
    hand: Value = field(default=1, kw_only=True)

    def at(self, i: SupportsIndex) -> np.ndarray:
        """Its edges at position ``i``, ``(3, 2, k)``, m."""
        x, y, z = self.edges
        return vector(*rotated(vector(x, y), _at(self.angle, i)), z)

    @property
    def extent(self) -> tuple[Value, Value, Value]:
        """Of both edges."""
        x, y, z = self.edges
        return np.max(np.hypot(x, y)), np.min(z), np.max(z)


def _at(value: Value, i: Any) -> Value:
    """A number, or that of several which stands for position ``i``."""
    if not np.ndim(value):
        return value
    if known(value) and not known(i):  # the place alone is recorded: what moves without quantities, as a table says
        return np.take_along_axis(np.asarray(value), np.reshape(i, (1,) * np.ndim(value)), -1)[..., 0]
    return np.take(value, i, axis=-1)


def vector(*components: Value) -> np.ndarray:
    """Vectors ``(d, ...)`` from their components, of which one may be a number and another a column or a curve."""
    return np.stack(np.broadcast_arrays(*components))


def end_to_end(*stretches: Array) -> Array:
    """Arrays one behind the other along their last axis, also where only some have a population axis.

    >>> end_to_end(np.array([1.0, 2.0]), np.array([[3.0], [4.0]]))
    array([[1., 2., 3.],
           [1., 2., 4.]])
    """
    lead = np.broadcast_shapes(*(values.shape[:-1] for values in stretches))
    full = (v if v.shape[:-1] == lead else np.broadcast_to(v, (*lead, v.shape[-1])) for v in stretches)
    return np.concatenate(list(full), axis=-1)


def rotated(points: Array, angle: Value) -> np.ndarray:
    """``points`` turned counter-clockwise by ``angle`` (rad; one angle or one per point).

    >>> rotated(np.array([1.0, 0.0]), np.pi / 2).round(6).tolist()
    [0.0, 1.0]
    """
    x, y = points
    c, s = np.cos(angle), np.sin(angle)
    return vector(c * x - s * y, s * x + c * y)


def polar_angle(point: Sequence[Value] | Array) -> Value:
    """Direction of ``point`` from the origin, rad, counter-clockwise from the x axis."""
    return np.arctan2(point[1], point[0])


def angle_opposite(side: Value, first: Value, second: Value) -> Value:
    """Angle of a triangle between sides ``first`` and ``second``, opposite ``side``; ``nan`` if none closes.

    >>> round(float(angle_opposite(5, 3, 4)), 6) == round(np.pi / 2, 6)
    True
    """
    cosine = (first**2 + second**2 - side**2) / (2 * first * second)
    with np.errstate(invalid="ignore"):
        return np.arccos(cosine)


def circle(centre: Sequence[Value], radius: Value, n: int = 73) -> np.ndarray:
    """A closed circle of ``n`` points, ``(2, n)``."""
    turn = np.linspace(0, 2 * np.pi, n)
    return np.stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def offset_curvature(curvature: Array, distance: Value) -> Array:
    """Curvature of the curve parallel to one of ``curvature``, ``distance`` along the outward normal.

    Convex is positive; the radius of curvature grows by ``distance``.  ``inf`` where it shrinks to nothing.
    """
    with np.errstate(divide="ignore"):
        return np.divide(curvature, 1 + distance * curvature)


def dot(a: np.ndarray, b: np.ndarray) -> Array:
    """Scalar product of vectors whose components come first."""
    return (a * b).sum(0)


def inclination(a: np.ndarray, b: np.ndarray) -> Array:
    """Angle between two lines, 0 .. pi/2 rad."""
    return np.arctan2(np.sqrt((np.cross(a, b, axis=0) ** 2).sum(0)), abs(dot(a, b)))
