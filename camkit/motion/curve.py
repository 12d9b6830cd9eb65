"""What the parts of a matched program become once it is solved: segments of polynomials, or of a law of any lift."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from math import perm

import numpy as np
from numpy.polynomial.legendre import poly2leg

from ..extrema import highest_between
from ..quantities.types import Array, Value
from .law import Kinematics, Law, polynomial
from .segments import Segment

Powers = Sequence[Value]
"""Of a piece of a polynomial: what stands before each power of the share of it, the lowest first, m or rad."""
Rows = tuple[tuple[float, ...], ...]
"""Constant factors."""


class Solved(Segment):
    """A segment whose motion followed from conditions."""

    @property
    def opposite(self) -> Segment:
        """The same downwards."""
        raise NotImplementedError

    @cached_property
    def reach(self) -> tuple[Value, Value]:
        ends = (0.0, *self.kinks, 1.0)
        return -_highest(lambda u: -self.motion(u).s, ends), _highest(lambda u: self.motion(u).s, ends)


def _highest(level: Callable[[Array], Value], ends: Sequence[Value]) -> Value:
    top = highest_between(level, ends).value
    return np.maximum(top[..., None] if np.ndim(top) else top, 0.0)


@dataclass(frozen=True)
class _Curve(Solved):
    """Polynomials over ``angle`` (rad), one between each two of ``knots``, shares of it; levels from the first one."""

    angle: Value
    knots: tuple[Value, ...]
    pieces: tuple[Powers, ...]
    change: Value = 0.0
    name: str = ""

    @property
    def still(self) -> bool:
        return False

    @property
    def kinks(self) -> tuple[Value, ...]:
        return self.knots[1:-1]

    def motion(self, u: Array) -> Kinematics:
        found = self._piece(0, u)
        for i, knot in enumerate(self.kinks, start=1):
            found = Kinematics(*(np.where(u >= knot, *pair) for pair in zip(self._piece(i, u), found, strict=True)))
        return found

    def _piece(self, i: int, u: Array) -> Kinematics:
        low, high = self.knots[i : i + 2]
        wide = (high - low) * self.angle
        s, v, a, j = polynomial(self.pieces[i], (u - low) / (high - low))
        return Kinematics(s, v / wide, a / wide**2, j / wide**3)

    @property
    def opposite(self) -> _Curve:
        """The same downwards."""
        pieces = tuple(tuple(-power for power in powers) for powers in self.pieces)
        return self.replace(pieces=pieces, change=-self.change)


@dataclass(frozen=True)
class _LiftedLaw(Solved):
    """A law of any lift, up or down, over ``angle`` (rad)."""

    angle: Value
    law: Law | Callable[[Array], Kinematics]
    lift: Value
    name: str = ""

    @property
    def change(self) -> Value:
        ends = [self.law(np.array(u)).s for u in (0.0, 1.0)]
        return self.lift * (ends[1] - ends[0])

    @property
    def still(self) -> bool:
        return False

    @property
    def kinks(self) -> tuple[Value, ...]:
        return getattr(self.law, "kinks", ())

    @property
    def kinks_move(self) -> bool:
        return getattr(self.law, "kinks_move", False) or any(map(np.ndim, self.kinks))

    def motion(self, u: Array) -> Kinematics:
        first = self.law(np.array(0.0)).s
        s, v, a, j = self.law(u)
        h, beta = self.lift, self.angle
        return Kinematics(h * (s - first), h * v / beta, h * a / beta**2, h * j / beta**3)

    @property
    def opposite(self) -> _LiftedLaw:
        """The same downwards."""
        return self.replace(lift=-self.lift)


@cache
def hermite(order: int) -> Rows:
    """From ``s, s', ..`` (``order`` of them by the share) at both ends of a piece to its powers: ``(2 q, 2 q)``."""
    degrees = range(2 * order)
    rows = [[perm(i, k) * (x if i > k else i == k) for i in degrees] for x in (0, 1) for k in range(order)]
    inverse = np.linalg.inv(np.array(rows, dtype=float))
    return tuple(map(tuple, (np.round(inverse * 6) / 6).tolist()))  # they are sixths of whole numbers


@cache
def bending(order: int, degree: int) -> Rows:
    """From powers of a piece to numbers whose squares add up to the integral of its derivative of that order squared.

    They are what stands before the Legendre polynomials of the derivative, by their sizes.
    """
    at = np.polynomial.Polynomial([0.5, 0.5])  # the share, from -1 to 1
    rows = np.zeros((degree - order + 1, degree + 1))
    for i in range(order, degree + 1):
        found = poly2leg((perm(i, order) * at ** (i - order)).coef)
        rows[: len(found), i] = found
    sizes = np.sqrt(2 * np.arange(degree - order + 1) + 1)[:, None]
    return tuple(map(tuple, (rows / sizes).tolist()))


def times(powers: Powers, others: Powers) -> list[Value]:
    """The powers of a product of two polynomials."""
    found: list[Value] = [0.0] * (len(powers) + len(others) - 1)
    for i, x in enumerate(powers):
        for k, y in enumerate(others):
            found[i + k] = found[i + k] + x * y
    return found


def newton(order: int, places: Sequence[Value]) -> list[list[Value]]:
    """Polynomials that vanish at both ends with so many derivatives, and at each place before theirs, as powers."""
    ends = np.polynomial.Polynomial([0.0, 1.0, -1.0]) ** order
    found: list[list[Value]] = [ends.coef.tolist()]
    for place in places[:-1]:
        found.append(times(found[-1], (-place, 1.0)))
    return found


def slopes(count: int, order: int, place: Value) -> list[Value]:
    """What stands before each of so many powers in the derivative of that order at a ``place`` above 0."""
    return [perm(i, order) * place ** (i - order) if i > order else float(perm(i, order)) for i in range(count)]


def slope_at(powers: Powers, order: int, place: Value) -> Value:
    """The derivative of that order at a ``place`` above 0, of a polynomial."""
    return sum(power * slope for power, slope in zip(powers, slopes(len(powers), order, place), strict=True))
