"""Boxes: space that the centre lines of a linkage may use, or that they must leave free."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..quantities.kinds import numbers, refuse_kinds, shown
from ..quantities.types import Array, Value
from ..units import mm


@dataclass(frozen=True)
class Box:
    """A box along the axes x, y, z, from corner ``low`` to corner ``high``, m.

    >>> box = Box((0, 0, 0), (1, 1, 1))
    >>> float(box.depth(np.array([0.5, 0.5, 0.9])).round(9)), float(box.depth(np.array([0.5, 0.5, 1.2])).round(9))
    (0.1, -0.2)

    Raises ``ValueError`` for corners that are not finite or that are in the wrong order.
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    name: str = "the box"
    """What it is, for the names of its measures: "the wall"."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for name in ("low", "high"):
            corner = numbers(getattr(self, name), f"the {name} corner of the box")
            if corner.shape != (3,):
                raise ValueError(f"the {name} corner of the box is {shown(getattr(self, name))}; it must be x, y, z")
            object.__setattr__(self, name, tuple(corner.tolist()))
        for axis, low, high in zip("xyz", self.low, self.high, strict=True):
            if not (np.isfinite([low, high]).all() and low < high):
                raise ValueError(
                    f"{self.name} goes from {low / mm:.5g} to {high / mm:.5g} mm along {axis}; "
                    "both must be finite, the first below the second"
                )

    def _walls(self, points: Value) -> np.ndarray:
        """How far ``points`` ``(3, ...)`` lie beyond each of the six walls, ``(6, ...)``."""
        points = numbers(points, "the points")
        points = np.where(np.isfinite(points), points, np.nan)
        if not points.ndim or len(points) != 3:
            raise ValueError(f"the points have the shape {points.shape}; they must be x, y, z, each of any shape")
        low, high = (np.reshape(corner, (3,) + (1,) * (np.ndim(points) - 1)) for corner in (self.low, self.high))
        return np.concatenate([low - points, points - high])

    def depth(self, points: Value) -> Array:
        """How far each of ``points`` ``(3, ...)`` lies within the box, from the nearest wall, m; < 0 outside."""
        return 0.0 - self._walls(points).max(0)

    def depths(self, points: Value) -> np.ndarray:
        """How far ``points`` ``(3, ...)`` lie within each of the six walls, ``(6, ...)``, m; < 0 beyond one."""
        return 0.0 - self._walls(points)

    def clearance(self, start: Value, end: Value) -> Array:
        """How far the box could grow on all sides before it touches the link ``start``-``end``, m; < 0 inside.

        Along the link the distance from the box is the largest of six straight lines, one for each wall; it is
        least at an end or where two of them cross.
        """
        try:
            ends = np.stack(np.broadcast_arrays(numbers(start, "the start"), numbers(end, "the end")))
        except ValueError as refusal:
            raise ValueError(f"the link has no two ends: {refusal}") from None
        first, last = self._walls(ends[0]), self._walls(ends[1])
        i, j = np.transpose(list(combinations(range(6), 2)))
        gap, growth = first[i] - first[j], (last - first)[j] - (last - first)[i]
        crossing = np.divide(gap, growth, out=np.zeros_like(gap), where=growth != 0)
        share = np.concatenate([np.clip(crossing, 0, 1), np.ones_like(gap[:1])])[:, None]
        return (first + share * (last - first)).max(1).min(0)
