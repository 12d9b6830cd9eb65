"""Laws from points: a B-spline through control points, and a table of measured or printed values.

Source: Norton, Cam Design and Manufacturing Handbook (spline functions); de Boor, A Practical Guide to
Splines (interpolation, smoothing).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from math import factorial
from typing import TYPE_CHECKING

import numpy as np

from ...quantities import Quantity, numbered, row
from ...quantities.kinds import a_number, listed, numbers, refuse_lengths, shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks
from .free import exact, given_at, of_values, piecewise, sized

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

MOST_KNOTS = 300
"""Of a spline in a file: the law is worked out as one curve for each."""
KNOTS_IN_ALL = 1200
"""Of all splines of a design in a file."""
ROWS_IN_ALL = 4000
"""Of all tables of motion of a design in a file: a row for every 0.1 deg of a turn; analysis looks between any two."""


POSITION = Quantity("s", 0.5, -0.5, 1.5, "", "position at the knot", above=None)
POSITIONS = numbered("s", POSITION)
Declarations = Callable[[int], tuple[str, Quantity]]


@dataclass(frozen=True)
class SplineLaw(Law):
    """A B-spline from (0, 0) to (1, 1) through control points ``(u, s)`` with given ``v, a`` at the two ends.

    ``u`` are the inner knots, ``s`` the positions there (numbers, or arrays of shape ``(p, 1)``: a
    population shares its knots).  ``start`` and ``end`` hold ``(v,)``, ``(v, a)`` or ``(v, a, j)`` and set the
    degree: 3, 5 or 7.  The spline is linear in the positions, so a population costs one set of basis curves.

    ``ValueError``: knots not strictly increasing between 0 and 1, not one position per knot, a value that
    is not finite, or ends with a different number of values.

    >>> SplineLaw((), ())(0.25).s.round(6)                                  # nothing in between: 3-4-5
    np.float64(0.103516)
    >>> SplineLaw((0.6, 0.4), (0.7, 0.3))
    Traceback (most recent call last):
        ...
    ValueError: the knots of the spline are 0.6, 0.4; they must increase strictly between 0 and 1
    """

    u: tuple[float, ...] = field(metadata={"most": MOST_KNOTS, "in_all": ("knots of splines", KNOTS_IN_ALL)})
    s: tuple[Value, ...] = row(POSITIONS)
    start: tuple[Value, ...] = row(given_at("start", 1), default=(0.0, 0.0))
    end: tuple[Value, ...] = row(given_at("end", 1), default=(0.0, 0.0))

    name = "B-spline"

    def __post_init__(self) -> None:
        object.__setattr__(self, "u", _row(self.u, "the knots u of the spline"))
        for name, declared in (("s", POSITIONS), ("start", given_at("start", 1)), ("end", given_at("end", 1))):
            object.__setattr__(self, name, _values(getattr(self, name), name, declared))
        refuse_lengths(self)
        if not np.all(np.diff((0.0, *self.u, 1.0)) > 0):
            shown = ", ".join(f"{u:g}" for u in self.u)
            raise ValueError(f"the knots of the spline are {shown}; they must increase strictly between 0 and 1")
        if len(self.s) != len(self.u):
            shown = f"{len(self.u)} knots and {len(self.s)} positions"
            raise ValueError(f"the spline has {shown}; it needs one position for each knot")
        if len(self.start) != len(self.end) or len(self.start) not in (1, 2, 3):
            shown = f"{len(self.start)} values at its start and {len(self.end)} at its end"
            raise ValueError(f"the spline has {shown}; it can have v, or v, a, or v, a, j at both")

    @property
    def kinks(self) -> tuple[Value, ...]:
        return self.u

    @property
    def continuity(self) -> int:
        """As for every law, counted from the ends that are given: 0 with a velocity there."""
        rest = [np.all(np.equal(v, 0)) and np.all(np.equal(w, 0)) for v, w in zip(self.start, self.end, strict=True)]
        return [*rest, False].index(False)

    def at(self, u: Array) -> Kinematics:
        values = (0.0, *self.s, 1.0, *self.start, *self.end)
        return piecewise(of_values(_basis(self.u, len(self.start)), values), *_places((0.0, *self.u, 1.0)), u)

    def peaks(self) -> Peaks:
        return law_peaks(self)


def _values(given: object, name: str, declared: Declarations) -> tuple[Value, ...]:
    """Positions of a spline, or what is given at one of its ends; a fourth of these is refused by their number."""
    values = listed(given, f"the {name} of the spline", "value")
    return tuple(sized(value, "a value of the spline", declared(min(i, 2))[1]) for i, value in enumerate(values))


def _row(values: object, what: str) -> tuple[float, ...]:
    """One number for each place."""
    row = numbers(listed(values, what), what)
    if row.ndim != 1:
        raise ValueError(f"{what} must be numbers in a row; given is {shown(values)}")
    return tuple(row.tolist())


@lru_cache(maxsize=64)
def _basis(knots: tuple[float, ...], given: int) -> Array:
    """The powers of the splines that have one of the points or end values 1 and all others 0, in their order."""
    from scipy.interpolate import make_interp_spline

    points, orders = len(knots) + 2, range(1, given + 1)
    unit = np.eye(points + 2 * given)
    ends = [[(k, unit[points + i * given + k - 1]) for k in orders] for i in (0, 1)]
    basis = make_interp_spline((0.0, *knots, 1.0), unit[:points], k=2 * given + 1, bc_type=tuple(ends))
    given_at_ends = {points + i * given + k - 1: (float(i), k) for i in (0, 1) for k in orders}
    return exact(_powers(basis, (0.0, *knots, 1.0)), {0: (0.0, 0), points - 1: (1.0, 0)} | given_at_ends)


def _places(rows: tuple[float, ...]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The origins of the pieces between ``rows``, and the borders; the last piece is halved, its end an origin."""
    return rows, (*rows[1:-1], (rows[-2] + rows[-1]) / 2)


def _powers(spline: BSpline, origins: tuple[float, ...]) -> Array:
    """What stands before each power of the distance from each origin: ``(degree + 1, origins, ...)``."""
    return np.stack([spline(origins, k) / factorial(k) for k in range(spline.k + 1)])


@dataclass(frozen=True)
class TableLaw(Law):
    """A table of ``(u, s)`` from (0, 0) to (1, 1), smoothed as far as ``tolerance`` allows.

    The law is the quintic spline from dwell to dwell (v = a = 0 at both ends) with knots at the rows and the
    least integral of jerk squared among those weighed against the squared deviations; the weight is the
    largest that keeps every row within ``tolerance`` (a share of the lift).  ``tolerance = 0`` passes
    through every row; a wide one leads to the 3-4-5 polynomial.  ``error`` is the largest deviation reached.

    ``ValueError``: u that do not increase strictly, ends that are not (0, 0) and (1, 1), columns of
    different length, values that are not finite, a negative tolerance.

    >>> u = np.linspace(0, 1, 21)
    >>> law = TableLaw(u, np.round(u**3 * (10 - 15 * u + 6 * u**2), 3), tolerance=0.001)
    >>> law.error <= 0.001, law.peaks().Cv.round(2)
    (True, np.float64(1.87))
    """

    u: tuple[float, ...] = field(metadata={"in_all": ("rows of tables of motion", ROWS_IN_ALL)})
    s: tuple[float, ...]
    tolerance: float = 1e-4

    name = "table"
    continuity = 2

    def __post_init__(self) -> None:
        object.__setattr__(self, "u", _row(self.u, "the u of the table"))
        object.__setattr__(self, "s", _row(self.s, "the s of the table"))
        tolerance = a_number(self.tolerance, "the tolerance of the table", "be 0 or more", lambda x: x >= 0)
        if np.ndim(tolerance):
            raise ValueError("the tolerance of the table is a column; it must be one number, 0 or more")
        object.__setattr__(self, "tolerance", tolerance)
        _refuse_table(self)

    @property
    def kinks(self) -> tuple[Value, ...]:
        return self.u[1:-1]

    @cached_property
    def _spline(self) -> BSpline:
        return _smoothed(np.array(self.u), np.array(self.s), self.tolerance)

    @cached_property
    def _powers(self) -> Array:
        powers = _powers(self._spline, self.u)
        powers[:3, [0, -1]] = [[0, 1], [0, 0], [0, 0]]
        return powers

    @property
    def error(self) -> float:
        """The largest deviation of the law from a row of the table, a share of the lift."""
        return float(np.max(np.abs(self._spline(self.u) - self.s)))

    def at(self, u: Array) -> Kinematics:
        return piecewise(self._powers, *_places(self.u), u)

    def peaks(self) -> Peaks:
        return law_peaks(self)


def _refuse_table(table: TableLaw) -> None:
    u, s = np.array(table.u), np.array(table.s)
    if len(u) != len(s) or len(u) < 2:
        raise ValueError(f"the table has {len(u)} u and {len(s)} s; it needs as many of each, and two at least")
    if not (np.isfinite(u).all() and np.isfinite(s).all()):
        raise ValueError("the table holds a value that is not finite; every u and s must be a finite number")
    if not (possible := POSITION.allows(s[:, None])).all():
        raise ValueError(f"the table has the s {s[np.argmin(possible)]:g}; it must be {POSITION.possible_for(1e300)}")
    if not (np.diff(u) > 0).all():
        row = int(np.argmin(np.diff(u) > 0)) + 2
        shown = f"at row {row} ({u[row - 1]:g} after {u[row - 2]:g})"
        raise ValueError(f"the table does not increase in u {shown}; every u must be above the one before")
    if (u[0], s[0], u[-1], s[-1]) != (0, 0, 1, 1):
        shown = f"({u[0]:g}, {s[0]:g}) to ({u[-1]:g}, {s[-1]:g})"
        raise ValueError(f"the table runs from {shown}; it must run from (0, 0) to (1, 1)")


def _smoothed(u: Array, s: Array, tolerance: float) -> BSpline:
    """The smoothest spline within ``tolerance``: bisection on the weight of smoothness, most at first."""
    from scipy.interpolate import make_interp_spline

    solve = _smoother(u, s)
    heavy, light = 3.0, -18.0  # powers of ten
    best = make_interp_spline(u, s, k=5, bc_type=([(1, 0.0), (2, 0.0)], [(1, 0.0), (2, 0.0)]))
    for _ in range(40):
        weight = (heavy + light) / 2
        spline = solve(10**weight)
        within = np.max(np.abs(spline(u) - s)) <= tolerance
        best, light, heavy = (spline, weight, heavy) if within else (best, light, weight)
    return best


def _smoother(u: Array, s: Array) -> Callable[[float], BSpline]:
    """A function of the weight that solves the normal equations for the spline's inner coefficients.

    Dwell ends fix the first three coefficients of a clamped quintic at 0 and the last three at 1.
    """
    from scipy.interpolate import BSpline
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import spsolve

    t = np.concatenate([np.zeros(5), u, np.ones(5)])
    points = csc_array(BSpline.design_matrix(u, t, 5))
    jerks = _jerk_matrix(t)
    fixed = np.zeros(len(t) - 6)
    fixed[-3:] = 1.0
    inner = slice(3, -3)
    A, P = (points.T @ points)[inner], (jerks.T @ jerks)[inner]
    rhs = (points.T @ s)[inner]

    def solve(weight: float) -> BSpline:
        c = fixed.copy()
        if len(c) > 6:
            M = csc_array(A + weight * P)
            c[inner] = spsolve(M[:, inner], rhs - M @ fixed)
        return BSpline(t, c, 5)

    return solve


def _jerk_matrix(t: Array) -> Array:
    """From coefficients to jerk at Gauss points, weighed so that its square sums to the integral."""
    from scipy.interpolate import BSpline
    from scipy.sparse import diags_array

    derivative = diags_array(np.ones(len(t) - 6))
    for k in (5, 4, 3):
        n = derivative.shape[0]
        slope = k / (t[6 : n + 5] - t[6 - k : n + 5 - k])
        derivative = diags_array([-slope, slope], offsets=[0, 1], shape=(n - 1, n)) @ derivative
    knots = t[5:-5]
    x, w = np.polynomial.legendre.leggauss(3)
    gauss = ((knots[1:] + knots[:-1])[:, None] + np.diff(knots)[:, None] * x) / 2
    root = np.sqrt(np.diff(knots)[:, None] * w / 2)
    return diags_array(root.ravel()) @ BSpline.design_matrix(gauss.ravel(), t[3:-3], 2) @ derivative
