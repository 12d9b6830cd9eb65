"""The outline of a cam as it was measured: points, smoothed as the rows of a table are.

Points around the cam axis give the radius ``r(theta)``; where the outline is too steep for that, or turns back, ``x``
and ``y`` over the length of the chords from point to point.  Both are periodic quintic splines of which as much is left
as the points know (see `camkit.motion.smoothing`), so that the outline has a curvature everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..motion.smoothing import BadRow, Rows, Smoothed
from ..quantities.kinds import listed, numbers, one_number, refuse_arguments
from ..quantities.types import Array
from ..units import deg, in_unit, mm
from .outlines import MOST, SAME, TURN, CamOutline, Piece, Place, points_of_outline, reach_in_words, refuse_not_around

LEAST = 12
"""Points that an outline needs."""
HOLE = 15.0
"""Points that are more than so many usual steps, and degrees, apart leave a hole."""
STEEP = 3.0
"""Where the radius changes by more than so much of itself per radian, x and y are smoothed in its place."""
ZIGZAG = 1.5
"""Radii that vary so many times more in the order of their angles than as measured belong to an outline that turns."""


@dataclass(frozen=True)
class Smooth(Piece):
    """The whole outline as splines over shares ``u`` of it: of ``r``, or of ``x`` and ``y``; a share ``first`` on."""

    splines: tuple[Any, ...]
    first: float = 0.0
    looks = 2881

    @property
    def closed(self) -> bool:
        return True

    def at(self, u: Array) -> Place:
        u = np.mod(u + self.first, 1.0)
        if len(self.splines) == 1:
            return self._polar(TURN * u, *(self.splines[0](u, k) / TURN**k for k in range(3)))
        (x, dx, ddx), (y, dy, ddy) = ([spline(u, k) for k in range(3)] for spline in self.splines)
        with np.errstate(divide="ignore"):
            radius = np.hypot(dx, dy) ** 3 / (dx * ddy - dy * ddx)
        return Place(np.array([x, y]), np.arctan2(-dx, dy), radius)

    @staticmethod
    def _polar(theta: Array, r: Array, dr: Array, ddr: Array) -> Place:
        """``rho = (r^2 + r'^2)^1.5 / (r^2 + 2 r'^2 - r r'')``."""
        with np.errstate(divide="ignore"):
            radius = np.hypot(r, dr) ** 3 / (r**2 + 2 * dr**2 - r * ddr)
        return Place(r * np.array([np.cos(theta), np.sin(theta)]), theta - np.arctan2(dr, r), radius)

    def beginning(self, u: float) -> Smooth:
        return replace(self, first=(self.first + u) % 1.0)


class _Fit(NamedTuple):
    piece: Smooth
    noise: float
    bad: tuple[BadRow, ...]
    by: str


@dataclass(frozen=True)
class MeasuredOutline(CamOutline):
    """An outline through ``measured`` points (x, y), m, in their order: pairs, or two rows.

    They may begin anywhere, go around either way, stand at any distances and close with the first point again.
    ``digit`` is what they are rounded to: less is not smoothed away.  ``tolerance`` takes the smoothest outline that
    passes every good point so closely, in place of cross-validation.

    >>> turn = np.arange(0, 360, 2) * deg
    >>> outline = MeasuredOutline.polar(turn, 40 * mm + 5 * mm * np.cos(turn))
    >>> outline.remarks[0]
    'an outline of 180 points, 35 to 45 mm from the cam axis: its radius smoothed over the polar angle'

    Raises ``ValueError`` for points that are too few, leave a hole, or do not go around the cam axis once.
    """

    measured: tuple[tuple[float, float], ...] = field(metadata={"most": MOST}, repr=False)
    digit: float = 0.0
    tolerance: float | None = None
    said: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        points = points_of_outline(self.measured, LEAST)
        object.__setattr__(self, "measured", tuple(map(tuple, points.T.tolist())))
        object.__setattr__(self, "said", tuple(map(str, listed(self.said, "what was understood", "sentence"))))
        digit = one_number(self.digit, "the digit", "be 0 m or more", lambda value: 0 <= value < np.inf)
        object.__setattr__(self, "digit", digit)
        if self.tolerance is not None:
            near = one_number(self.tolerance, "the tolerance", "be above 0 m", lambda value: 0 < value < np.inf)
            object.__setattr__(self, "tolerance", near)
        if len(self._once) < LEAST:
            raise ValueError(f"the outline has {len(self._once)} different points; it needs {LEAST} at least")
        refuse_not_around(self._points)
        self._refuse_hole()

    @classmethod
    def polar(cls, theta: ArrayLike, r: ArrayLike, digit: float = 0.0, tolerance: float | None = None) -> Any:
        """An outline by polar angles ``theta`` (rad, counter-clockwise from the x axis) and radii ``r`` (m)."""
        refuse_arguments(MeasuredOutline.polar, locals() | {"theta": (), "r": ()})
        angle, radius = numbers(theta, "the polar angles of the outline"), numbers(r, "the radii of the outline")
        if angle.ndim != 1 or angle.shape != radius.shape:
            raise ValueError(
                f"the outline has {angle.size} polar angles and {radius.size} radii; it needs as many of each, in a row"
            )
        if not (radius > 0).all():
            row = int(np.argmin(radius > 0))
            raise ValueError(f"point {row + 1} of the outline has the radius {radius[row]:.6g} m; it must be above 0 m")
        return cls(np.array([radius * np.cos(angle), radius * np.sin(angle)]), digit, tolerance)  # type: ignore[arg-type]

    @property
    def points(self) -> Array:
        return np.array(self.measured).T

    @cached_property
    def _once(self) -> Array:
        """The numbers of the points without those that repeat the one before."""
        steps = np.hypot(*(self.points - np.roll(self.points, 1, axis=1)))
        return np.flatnonzero(steps > SAME)

    @property
    def _points(self) -> Array:
        return self.points[:, self._once]

    def _refuse_hole(self) -> None:
        x, y = self._points
        angle = np.arctan2(y, x)
        turned = abs((np.diff(angle, append=angle[0]) + np.pi) % TURN - np.pi)
        steps = np.hypot(np.diff(x, append=x[0]), np.diff(y, append=y[0])) / np.hypot(x, y)
        step = np.maximum(turned, steps)
        if step.max() > max(HOLE * float(np.median(step)), HOLE * deg):
            k = int(np.argmax(step))
            one, other = self._once[k] + 1, self._once[(k + 1) % len(x)] + 1
            at = [f"{in_unit(float(angle[i % len(x)]), 'deg'):.6g} deg" for i in (k, k + 1)]
            raise ValueError(
                f"between points {one} and {other} of the outline (polar angles {at[0]} and {at[1]}) points are "
                "missing; add some"
            )

    @cached_property
    def _fit(self) -> _Fit:
        found = self._over_angle() if self._in_order_of_angle() else None
        return found if found and not _steep(found.piece) else self._over_length()

    def _in_order_of_angle(self) -> bool:
        """Whether radii vary in the order of the polar angles as they do in that of the points."""
        x, y = self._points
        r, order = np.hypot(x, y), np.argsort(np.arctan2(y, x))
        varies, sorted_ = (abs(np.diff(radii, append=radii[0])).sum() for radii in (r, r[order]))
        return bool(sorted_ <= ZIGZAG * varies + 1e-12)

    def _over_angle(self) -> _Fit:
        x, y = self._points
        u, r = np.arctan2(y, x) % TURN / TURN, np.hypot(x, y)
        order = np.argsort(u, kind="stable")
        order = order[np.append(True, np.diff(u[order]) > 1e-12)]
        found, size = self._smoothed(u[order], r[order])
        bad = self._named(order[list(found.bad)], np.array(found.off) * size)
        return _Fit(Smooth((_spline(found, size),)), found.noise * size, bad, found.by)

    def _over_length(self) -> _Fit:
        points = self._points
        way = "counter-clockwise" if _turns(points) > 0 else "clockwise"
        order = np.arange(points.shape[1])[:: 1 if way == "counter-clockwise" else -1]
        points = points[:, order]
        chords = np.hypot(*(np.roll(points, -1, axis=1) - points))
        u = np.append(0.0, np.cumsum(chords)[:-1]) / chords.sum()
        (x, size), (y, size_y) = (self._smoothed(u, row) for row in points)
        off = np.zeros(len(u))
        off[list(x.bad)] = np.array(x.off) * size
        off[list(y.bad)] = np.hypot(off[list(y.bad)], np.array(y.off) * size_y)
        k = np.flatnonzero(off)
        piece = Smooth((_spline(x, size), _spline(y, size_y)))
        noise = float(np.hypot(x.noise * size, y.noise * size_y) / np.sqrt(2))
        return _Fit(piece, noise, self._named(order[k], off[k]), x.by)

    def _smoothed(self, u: Array, y: Array) -> tuple[Smoothed, float]:
        """Rows around the turn, smoothed, and the size that they are shares of."""
        size = max(float(np.ptp(y)), 1e-3 * float(abs(y).max()))
        near = self.tolerance and self.tolerance / size
        return Rows(u, y / size, min(max(self.digit / size, 1e-9), 1.0), "turn", 0, near).smoothed, size

    def _named(self, places: Array, off: Array) -> tuple[BadRow, ...]:
        """Bad points by their number and polar angle."""
        numbered = self._once[places]
        x, y = self.points[:, numbered]
        angle = np.arctan2(y, x) % TURN
        return tuple(
            sorted(BadRow(int(i) + 1, float(t), float(d)) for i, t, d in zip(numbered, angle, off, strict=True))
        )

    @property
    def pieces(self) -> tuple[Piece, ...]:
        return (self._fit.piece,)

    @property
    def noise(self) -> float:
        return self._fit.noise

    @property
    def bad_points(self) -> tuple[BadRow, ...]:
        return self._fit.bad

    @property
    def criterion(self) -> str:
        said = {
            "tolerance": f"the smoothest outline within {(self.tolerance or 0) / mm:.4g} mm of every good point",
            "rounding": f"the smoothest outline that leaves what rounding to {self.digit / mm:.4g} mm does",
        }
        return said.get(self._fit.by, "least generalised cross-validation")

    @property
    def remarks(self) -> tuple[str, ...]:
        over = (
            "its radius smoothed over the polar angle"
            if len(self._fit.piece.splines) == 1
            else "x and y smoothed over its length, as it is steep"
        )
        return (
            f"an outline of {len(self.measured)} points, {reach_in_words(self.points)}: {over}",
            *self.said,
            f"smoothed by {self.criterion}; the points scatter by {self.noise / mm:.3g} mm (rms)",
            *(
                f"point {row} at polar angle {in_unit(angle, 'deg'):.6g} deg is {off / mm:.3g} mm off the outline "
                "through the others: left out"
                for row, angle, off in self.bad_points
            ),
        )


def _turns(points: Array) -> float:
    """The angle by which points go around the cam axis, rad."""
    angle = np.arctan2(points[1], points[0])
    return float(((np.diff(angle, append=angle[0]) + np.pi) % TURN - np.pi).sum())


def _spline(found: Smoothed, size: float) -> Any:
    """A smoothed row as a function of the share of the turn and of the order of its derivative."""
    from scipy.interpolate import BSpline

    n = len(found.coefficients) - 5
    return BSpline(np.arange(-5, n + 6) / n, found.coefficients * size, 5)


def _steep(piece: Smooth) -> bool:
    u = np.linspace(0, 1, piece.looks)
    r, dr = (piece.splines[0](u, k) / TURN**k for k in range(2))
    return bool((abs(dr) > STEEP * r).any() or (r <= 0).any())
