"""A law from its acceleration, drawn or tabulated: integrated twice, its zones scaled so that it ends where it has to.

Source: Norton, Cam Design and Manufacturing Handbook; Fritsch and Butland, A Method for Constructing Local Monotone
Piecewise Cubic Interpolants (the spline, which has no zero but those of the table).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple, cast

import numpy as np

from ...quantities import Quantity, certain, choice, declarations, numbered, quantity, row, unless
from ...quantities.kinds import listed, refuse_lengths, shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks, met_at_dwells, polynomial
from .free import sized
from .slopes import slopes, zero_of_cubic
from .spline import _row

SHAPES = ("lines", "steps", "spline")
HEIGHT = Quantity("a", 0, -2, 2, "", "acceleration at the place, to any scale", above=None, at_most=1e9)
HEIGHTS = numbered("a", HEIGHT)
MOST_ROWS, MOST_ZONES = 400, 12
DEPENDENT = 1e-12
"""Below this share of their size two conditions on the zones are one."""


class Pieces(NamedTuple):
    """An acceleration in pieces of one sign: arrays ``(k,)``, or ``(p, k)`` for a population.

    Each piece begins at a ``start``, has a ``width`` and is a cubic in the distance from its start, its factors in
    ``c``; over it the velocity grows by ``dv``, and the position by ``ds`` besides what the velocity brings.
    """

    start: Array
    width: Array
    c: tuple[Array, Array, Array, Array]

    @property
    def dv(self) -> Array:
        return sum(c * self.width ** (m + 1) / (m + 1) for m, c in enumerate(self.c))

    @property
    def ds(self) -> Array:
        return sum(c * self.width ** (m + 2) / ((m + 1) * (m + 2)) for m, c in enumerate(self.c))

    @property
    def zones(self) -> Array:
        """The zone of one sign that each piece is in, from 0: a stretch without acceleration is one too."""
        sign = np.sign(self.dv)
        new = np.where(sign[..., 1:] != sign[..., :-1], 1.0, 0.0)
        return np.concatenate([np.zeros_like(sign[..., :1]), np.cumsum(new, axis=-1)], axis=-1)


def pieces_of(u: Array, a: Array, shape: str) -> Pieces:
    """The pieces of a table of accelerations ``a``, ``(n,)`` or ``(p, n)``, at ``u``; zeros part them."""
    h, left, right = np.diff(u), a[..., :-1], a[..., 1:]
    rise, still = (right - left) / h, 0.0 * (left + right)
    crossing, at_zero = left * right < 0, h * left / np.where(left == right, 1.0, left - right)
    c = (left + still, still, still, still)
    if shape == "lines":
        c = (left + still, rise, still, still)
    if shape == "spline":
        d = slopes(h, rise)
        first, last = d[..., :-1], d[..., 1:]
        c = (left + still, first, (3 * rise - 2 * first - last) / h, (first + last - 2 * rise) / h**2)
        at_zero = zero_of_cubic(c, h, at_zero)
    w = np.where(crossing & (shape != "steps"), at_zero, h / 2) + still
    late = (
        np.where(crossing & (shape != "steps"), 0.0, c[0] + w * (c[1] + w * (c[2] + w * c[3]))),
        c[1] + w * (2 * c[2] + 3 * w * c[3]),
        c[2] + 3 * w * c[3],
        c[3],
    )
    start = u[:-1] + still
    return Pieces(
        _between(start, start + w),
        _between(w, h - w),
        tuple(map(_between, c, late)),  # type: ignore[arg-type]
    )


def _between(early: Array, late: Array) -> Array:
    """Two rows, each number of the second behind that of the first."""
    pairs = np.stack([early, late], axis=-1)
    return np.reshape(pairs, (*np.shape(early)[:-1], 2 * np.shape(early)[-1]))


class Zones(NamedTuple):
    """What each zone of an acceleration brings if it is not scaled: ``V`` and ``S`` at the end, ``(z,)`` or ``(p, z)``.

    ``there`` are the zones that are; ``of`` says of each piece which it is in, ``(k, z)`` or ``(p, k, z)``.
    """

    V: Array
    S: Array
    there: Array
    of: Array


def zones_of(pieces: Pieces) -> Zones:
    """The zones of an acceleration."""
    of = np.where(np.expand_dims(pieces.zones, -1) == np.arange(float(MOST_ZONES)), 1.0, 0.0)
    later = 1 - pieces.start - pieces.width
    V, S = ((np.expand_dims(x, -1) * of).sum(-2) for x in (pieces.dv, pieces.ds + pieces.dv * later))
    return Zones(V, S, np.where(V != 0, 1.0, 0.0), of)


class Spread(NamedTuple):
    """The zones beside their mean: ``g`` the sums of ``V`` and ``S``, ``V, S`` what is left without their means."""

    g: tuple[Array, Array]
    V: Array
    S: Array

    @property
    def G(self) -> tuple[Array, Array, Array]:
        """The sums of ``V V``, ``V S`` and ``S S``."""
        return _sum(self.V * self.V), _sum(self.V * self.S), _sum(self.S * self.S)


def spread(zones: Zones) -> Spread:
    """The zones beside their mean."""
    n = np.maximum(_sum(zones.there), 1.0)
    g = _sum(zones.V), _sum(zones.S)
    V, S = ((x - total / n) * zones.there for x, total in zip((zones.V, zones.S), g, strict=True))
    return Spread(g, V, S)


def _sum(values: Array) -> Array:
    return values.sum(-1, keepdims=True)


def scales_of(zones: Zones, dv: Value, ds: Value) -> tuple[Array, Array]:
    """The scale of each zone, ``sum x V = dv`` and ``sum x S = ds``, and whether these conditions fix any.

    Of all that meet both, those with the least sum of ``(x - mean)^2``: ``x = alpha + l V + m S`` with the means of
    ``V`` and ``S`` taken off, and ``(l, m)`` at right angles to the sums ``g``.
    """
    (g1, g2), V, S = beside = spread(zones)
    G11, G12, G22 = beside.G
    Q = G11 * g2**2 - 2 * G12 * g1 * g2 + G22 * g1**2
    size = _sum(zones.V**2) * g2**2 + _sum(zones.S**2) * g1**2
    fixed = DEPENDENT * size < Q
    t = (dv * g2 - ds * g1) / np.where(fixed, Q, 1.0)
    l, m = t * g2, -t * g1
    alpha = (g1 * (dv - G11 * l - G12 * m) + g2 * (ds - G12 * l - G22 * m)) / np.where(fixed, g1**2 + g2**2, 1.0)
    return alpha + l * V + m * S, fixed


@dataclass(frozen=True)
class AccelerationTable(Law):
    """Acceleration first: a table of ``a`` at ``u``, joined by ``lines``, ``steps`` or a ``spline``, integrated twice.

    ``u`` are places in any unit, the first the start of the law and the last its end.  ``a`` are accelerations to any
    scale; by ``steps`` each holds up to the next place, and the last says nothing.  Each zone of one sign is scaled by
    itself, so that the law rises by 1 from the velocity ``start`` to the velocity ``end`` (normalised; 0 is rest).  Of
    more than two zones, the scales that differ least from their mean are taken.  ``a``, ``start`` and ``end`` may be
    arrays ``(p, 1)``, a population.  `scales` are those of the zones.

    ``ValueError``: places that do not increase, not one acceleration for each, fewer than two zones, or a zone that
    would have to change its sign; in a population the row is ``nan``.

    >>> law = AccelerationTable((0, 8, 30, 38, 46, 72, 80), (0, 1, 1, 0, -1, -1, 0))
    >>> law.scales.round(4), law(0.75).s.round(6)
    (array([5.3333, 4.7059]), np.float64(0.903922))
    >>> AccelerationTable((0, 1), (1, 1))
    Traceback (most recent call last):
        ...
    ValueError: the acceleration table has too few zones of one sign; two at least are needed to rise by 1 between the \
velocities at its ends
    """

    u: tuple[float, ...] = field(metadata={"most": MOST_ROWS, "in_all": ("rows of accelerations", 4 * MOST_ROWS)})
    a: tuple[Value, ...] = row(HEIGHTS)
    shape: str = choice("", "lines", {shape: shape for shape in SHAPES}, "how the rows of the table are joined")
    start: Value = quantity("v_0", 0, -1, 3, "", "velocity at the start, for a lift of 1", above=None)
    end: Value = quantity("v_1", 0, -1, 3, "", "velocity at the end, for a lift of 1", above=None)

    name = "from acceleration"

    def __post_init__(self) -> None:
        object.__setattr__(self, "u", _places(self.u))
        object.__setattr__(self, "a", _heights(self.a, len(self.u)))
        if not isinstance(self.shape, str) or self.shape not in SHAPES:
            raise ValueError(f"the acceleration table is joined by {shown(self.shape)}; it can be {', '.join(SHAPES)}")
        for name in ("start", "end"):
            what, declared = f"the velocity at the {name} of the acceleration table", declarations(self)[name]
            object.__setattr__(self, name, sized(getattr(self, name), what, cast(Quantity, declared)))
        refuse_lengths(self)
        _refuse_zones(self)

    @cached_property
    def _table(self) -> Pieces:
        a = np.concatenate([np.atleast_1d(a) for a in np.broadcast_arrays(*self.a)], axis=-1)
        return pieces_of(np.array(self.u), a, self.shape)

    @cached_property
    def _zones(self) -> Zones:
        return zones_of(self._table)

    @cached_property
    def _scaled(self) -> tuple[Array, Array]:
        return scales_of(self._zones, self.end - self.start, 1 - self.start)

    @property
    def scales(self) -> Array:
        """By what the acceleration of each zone is multiplied, in order; in a population ``nan`` where none is."""
        x = np.where(self._zones.there > 0, self._scaled[0], np.nan)
        return x[np.isfinite(x)] if x.ndim == 1 else x

    @property
    def kinks(self) -> tuple[Value, ...]:
        starts = self._table.start
        return tuple(starts[..., i] if starts.ndim == 1 else starts[..., i : i + 1] for i in range(1, starts.shape[-1]))

    @property
    def kinks_move(self) -> bool:
        return True

    @property
    def continuity(self) -> int:
        return met_at_dwells(self)

    @cached_property
    def _powers(self) -> tuple[Array, list[Array]]:
        """The origin of each piece, and what stands before each power of the distance from it; the last is the end."""
        pieces, x = self._table, (self._zones.of * np.expand_dims(self._scaled[0], -2)).sum(-1)
        c, w = [x * factor for factor in pieces.c], pieces.width
        v = self.start + _before(x * pieces.dv)
        s = _before(v * w + x * pieces.ds)
        a_end, j_end = c[0] + w * (c[1] + w * (c[2] + w * c[3])), c[1] + w * (2 * c[2] + 3 * w * c[3])
        at_end = (1.0, self.end, a_end / 2, j_end / 6, (c[2] + 3 * w * c[3]) / 12, c[3] / 20)
        at_start = (s, v, c[0] / 2, c[1] / 6, c[2] / 12, c[3] / 20)
        last = np.arange(w.shape[-1]) == w.shape[-1] - 1
        powers = [np.where(last, late, early) for early, late in zip(at_start, at_end, strict=True)]
        return np.where(last, 1.0, pieces.start), powers

    def at(self, u: Array) -> Kinematics:
        (origins, powers), borders = self._powers, self._table.start[..., 1:]
        at = np.atleast_1d(u)
        place = (np.expand_dims(at, -1) >= (borders if borders.ndim == 1 else np.expand_dims(borders, -2))).sum(-1)

        def there(row: Array) -> Array:
            return np.take_along_axis(np.reshape(row, (1,) * (place.ndim - row.ndim) + row.shape), place, -1)

        found = polynomial([there(row) for row in powers], at - there(origins))
        return found if np.ndim(u) or place.ndim > 1 else Kinematics(*(values[..., 0] for values in found))

    def peaks(self) -> Peaks:
        Cv, Ca, Cj = law_peaks(self)
        return Peaks(Cv, Ca, np.inf + 0 * Cj if self.shape == "steps" else Cj)


def _before(values: Array) -> Array:
    """The sum of all before each."""
    return np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(values, axis=-1)[..., :-1]], axis=-1)


def _places(given: object) -> tuple[float, ...]:
    """Places from 0 to 1."""
    places = np.array(_row(given, "the places u of the acceleration table"))
    if not (2 <= len(places) <= MOST_ROWS and np.isfinite(places).all() and (np.diff(places) > 0).all()):
        told = f"{len(places)} rows" if len(places) < 2 or len(places) > MOST_ROWS else "places that do not increase"
        raise ValueError(f"the acceleration table has {told}; it must have from 2 to {MOST_ROWS}, each above the last")
    return tuple(((places - places[0]) / (places[-1] - places[0])).tolist())


def _heights(given: object, rows: int) -> tuple[Value, ...]:
    values = listed(given, "the a of the acceleration table", "acceleration")
    if len(values) != rows:
        raise ValueError(f"the acceleration table has {rows} u and {len(values)} a; it needs as many of each")
    return tuple(sized(a, f"the acceleration {i} of the table", HEIGHT) for i, a in enumerate(values, start=1))


def _refuse_zones(law: AccelerationTable) -> None:
    """``ValueError`` in a sentence for zones that cannot be scaled; in a population the row becomes ``nan``."""
    (x, fixed), there = law._scaled, law._zones.there
    least = np.min(np.where(there > 0, x, np.inf), axis=-1, keepdims=True)
    few = law._table.zones[..., -1:] < MOST_ZONES
    if x.ndim == 1:
        few, fixed, least = few[0], fixed[0], least[0]
    if refuse := unless(few):
        refuse(f"the acceleration table has more than {MOST_ZONES} zones of one sign; it can have {MOST_ZONES} at most")
    if refuse := unless(fixed):
        refuse(
            "the acceleration table has too few zones of one sign; two at least are needed to rise by 1 between the "
            "velocities at its ends"
        )
    if refuse := unless(least > 0):
        refuse(
            f"the least scale of a zone of the acceleration table is {least:.6g}; each must be above 0: a zone would "
            "have to change its sign"
        )
    ok = few & fixed & (least > 0)
    if not certain(ok):
        object.__setattr__(law, "a", tuple(np.where(ok, a, np.nan) for a in law.a))
        for name in ("_table", "_zones", "_scaled"):
            law.__dict__.pop(name, None)
