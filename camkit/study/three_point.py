"""How limits answer to tolerances: a model of each, from one evaluation at the middle and two for each tolerance.

``g(z) = g_0 + sum a_j z_j + b_j z_j^2`` with ``a = (g+ - g-) / 2`` and ``b = (g+ + g-) / 2 - g_0``, where ``g+`` and
``g-`` stand at the ends of the tolerance ``j``: a full step and no derivative.  What is the largest of several things
is modelled point by point, and then the largest is taken.
"""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np

from ..quantities.types import Array

DEEP = -1e9
"""A limit that is kept without end counts as kept by this: a radius is infinite where a curve is straight."""
ENDLESS = -1e3
"""What is kept by more than so many times its size is seen by its reciprocal in any case."""
FLOOR, REACH = -1.0, 8.0
"""A limit below -1 is kept by more than its own size; so many times what tolerances move it, no design is away."""
POINTS = 64
"""Of each curve so many points are modelled at most: those that come nearest to the limit, or farthest beyond it."""


def star(k: int) -> Array:
    """Where a design is evaluated: the middle, all upper ends, all lower ends, ``(2k + 1, k)`` shares."""
    return np.concatenate([np.zeros((1, k)), np.eye(k), -np.eye(k)])


def seen(g: Array) -> Array:
    """Limits ``g`` that can be told from each other; ``nan``, which cannot be built, is missed without end."""
    return np.maximum(np.where(np.isnan(g), np.inf, g), DEEP)


def bounded(g: Array) -> Array:
    """Limits ``g`` that are kept, seen by the reciprocal of what is limited: ``1 / (1 - g) - 1``, from -1 to 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(g < 0, g / (1 - g), g)


def straightened(g: Array) -> Array:
    """Limits at the `star`, ``(p, 2k + 1, n)``, by the reciprocal where that bends less and one is kept by far.

    A radius grows without end where a curve is straight; its curvature does not.  A force is best left as it is.
    """
    least = g.min(1)
    far = least < FLOOR
    if not far.any():
        return g
    found = g.copy()
    some = found.swapaxes(0, 1)[:, far][None]
    inverse = bounded(some)
    bent = (_bent(some) >= _bent(inverse)) | (least[far] < ENDLESS)
    found.swapaxes(0, 1)[:, far] = np.where(bent, inverse, some)[0]
    return found


def _bent(g: Array) -> Array:
    """Which share of what the tolerances move is no straight line, ``(p, 1, n)``."""
    slope, bend = _parabolas(g)
    bends = abs(bend).sum(1, keepdims=True)
    return np.asarray(bends / np.maximum(abs(slope).sum(1, keepdims=True) + bends, 1e-300))


def _parabolas(g: Array) -> tuple[Array, Array]:
    """``a`` and ``b`` of what was found at the `star`, both ``(p, k, n)``."""
    k = g.shape[1] // 2
    centre, upper, lower = g[:, :1], g[:, 1 : k + 1], g[:, k + 1 :]
    return (upper - lower) / 2, (upper + lower) / 2 - centre


class ThreePoint(NamedTuple):
    """One limit, or one objective, of ``p`` designs at ``n`` points, of which the largest counts."""

    centre: Array
    """``g_0``, ``(p, n)``."""
    slope: Array
    """``a``, ``(p, k, n)``."""
    bend: Array
    """``b``, ``(p, k, n)``."""

    @classmethod
    def of(cls, g: Array, limit: bool = True) -> Self:
        """From what was found at the `star`, ``(p, 2k + 1, n)``, of a ``limit`` or an objective."""
        built = np.isfinite(g)
        if not built.all():
            least = np.where(built, g, -np.inf).max((1, 2), keepdims=True, initial=0.0)
            g = np.where(built, g, 1.0 + least)
        g = straightened(g) if limit else g
        found = cls(g[:, 0], *_parabolas(g))
        return found._nearest() if g.shape[2] > 1 else found

    def _nearest(self) -> Self:
        """Only the points that can come to the limit, for each design as many."""
        top = self.centre + (abs(self.slope) + abs(self.bend)).sum(1)
        n = int(np.clip((top >= 0).sum(-1).max(initial=0), min(8, top.shape[1]), min(POINTS, top.shape[1])))
        at = np.argpartition(-top, n - 1, axis=-1)[:, :n]
        return type(self)(
            np.take_along_axis(self.centre, at, -1),
            *(np.take_along_axis(part, at[:, None], -1) for part in (self.slope, self.bend)),
        )

    def at(self, z: Array) -> Array:
        """The largest of the points at shares ``z``, ``(m, k)`` or ``(p, m, k)``: ``(p, m)``."""
        both = np.swapaxes(np.concatenate([np.ones_like(z[..., :1]), z, z * z], axis=-1), -1, -2)
        bends = np.swapaxes(np.concatenate([self.centre[:, None], self.slope, self.bend], axis=1), -1, -2)
        return np.asarray((bends @ both).max(1))  # point by point: numpy is slow at rows of few numbers

    @property
    def worst(self) -> Array:
        """The largest value within the tolerances, ``(p,)``: at their ends, or where a parabola has its top between."""
        a, b = abs(self.slope), self.bend
        with np.errstate(divide="ignore", invalid="ignore"):
            most = np.where(a < -2 * b, a * a / (-4 * b), np.maximum(a + b, 0))
        return np.asarray((self.centre + most.sum(1)).max(-1))

    def room(self, z: Array) -> Array:
        """By which factor shares ``z`` can grow until a point comes to 0, ``(p, m)``; 0 if one is above."""
        return np.asarray(_growth(self.centre[:, None], z @ self.slope, z * z @ self.bend).min(-1))

    @property
    def low(self) -> Array:
        """So low that no design comes there that is as near as the tolerances are wide, ``(p,)``."""
        return np.asarray((self.centre - REACH * (abs(self.slope) + abs(self.bend)).sum(1)).max(-1))

    @property
    def corner(self) -> Array:
        """The corner of the tolerances where it is largest, ``(p, k)`` shares of -1 or 1."""
        highest = (self.centre + (self.bend + abs(self.slope)).sum(1)).argmax(-1)
        slope = np.take_along_axis(self.slope, highest[:, None, None], -1)[..., 0]
        return np.where(slope < 0, -1.0, 1.0)


def _growth(c: Array, a: Array, b: Array) -> Array:
    """The least ``x >= 0`` with ``c + a x + b x^2 >= 0``: 0 if ``c`` is above 0, ``inf`` if there is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        below = a + np.sqrt(a * a - 4 * b * c)
        found = np.where(below > 0, -2 * c / below, np.inf)
    return np.where(c > 0, 0.0, found)
