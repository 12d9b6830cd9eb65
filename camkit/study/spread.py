"""By how much the workshop misses a number: tolerances, what moves several numbers at once, and tables of standards.

A deviation of quantity ``j`` is ``c_j + t_j z_j``: the middle of its tolerance, the half width, and a share ``z_j``
between -1 and 1 (normal: with a standard deviation of 1/3, and not cut).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quantities import words
from ..quantities.applied import applied
from ..quantities.kinds import finite, numbers, one_number, refuse_arguments, refuse_kinds, shown
from ..quantities.types import Array, Value
from ..units import mm, um

SPREADS = ("uniform", "normal")
WITHIN = 3
"""How many standard deviations of a normal spread the half width is: 99.7 % of parts keep it."""

ISO_2768 = {
    "f": ((6, 0.05), (30, 0.1), (120, 0.15), (400, 0.2), (1000, 0.3), (2000, 0.5)),
    "m": ((6, 0.1), (30, 0.2), (120, 0.3), (400, 0.5), (1000, 0.8), (2000, 1.2), (4000, 2.0)),
}
"""ISO 2768-1:1989, table 1, classes f (fine) and m (medium): up to which length, mm, which deviation, mm."""
ISO_286_STEPS = (1, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
"""ISO 286-1: between which diameters, mm, a tolerance is the same."""
ISO_286_GRADES = {6: 10, 7: 16, 8: 25, 9: 40, 10: 64, 11: 100}
"""How many units of tolerance a grade has."""


def iso_2768(lengths: Value, grade: str = "m") -> Array:
    """Permitted deviations of lengths without a tolerance of their own: half widths, m; beyond its table the last.

    ISO 2768-1:1989, table 1; ``grade`` is ``"f"`` (fine) or ``"m"`` (medium).

    >>> (1e3 * iso_2768([0.05, 0.2])).tolist(), (1e3 * iso_2768([0.05, 0.2], "f")).tolist()
    ([0.3, 0.5], [0.15, 0.2])
    """
    refuse_arguments(iso_2768, locals())
    if grade not in ISO_2768:
        raise ValueError(f"the grade of ISO 2768 is {shown(grade)}; there are {', '.join(ISO_2768)}")
    upto, deviations = np.transpose(ISO_2768[grade])
    size = abs(numbers(lengths, "the lengths"))
    return (deviations[np.minimum(np.searchsorted(upto * mm, size), len(upto) - 1)] * mm)[()]


def iso_286(diameters: Value, grade: int = 7) -> Array:
    """The width of a tolerance zone for diameters up to 500 mm, m: a bore H7 has the deviations ``(0, iso_286(d))``.

    ISO 286-1: so many times ``i = 0.45 D^(1/3) + 0.001 D`` um, ``D`` the geometric mean of the step's ends in mm;
    the standard's table is this, rounded.  ``nan`` above 500 mm.

    >>> (iso_286([0.025, 0.04]) / um).round(1).tolist()
    [20.9, 25.0]
    """
    refuse_arguments(iso_286, locals())
    if grade not in ISO_286_GRADES:
        raise ValueError(f"the grade of ISO 286 is {grade}; there are {', '.join(map(str, ISO_286_GRADES))}")
    size, ends = abs(numbers(diameters, "the diameters")), np.array(ISO_286_STEPS, dtype=float)
    step = np.clip(np.searchsorted(ends * mm, size), 1, len(ends) - 1)
    mean = np.sqrt(ends[step - 1] * ends[step])
    unit = (0.45 * np.cbrt(mean) + 0.001 * mean) * um
    return np.where(size <= ends[-1] * mm, ISO_286_GRADES[grade] * unit, np.nan)[()]


def _pair(path: str, given: object) -> tuple[float, float]:
    """Two finite numbers in order: a half width to either side, or a lowest and a highest deviation."""
    what, must = f"the tolerance of the {words(path)}", "be a finite half width, or a lowest and a highest deviation"
    both: Any = given
    if not isinstance(given, (tuple, list)):
        half = one_number(given, what, must)
        both = -half, half
    if len(both) != 2:
        raise ValueError(f"{what} is {shown(given)}; it must {must}")
    low, high = (one_number(side, what, must) for side in both)
    if not (np.isfinite([low, high]).all() and low <= high):
        raise ValueError(
            f"{what} goes from {low:g} to {high:g} (SI); both must be finite, the first not above the second"
        )
    return float(low), float(high)


@dataclass(frozen=True)
class Tolerance:
    """By how much a quantity may deviate, SI, and how parts spread in between.

    ``deviation`` is a half width, a lowest and a highest deviation, or a function of values ``(p,)`` that gives one or
    the other for each: the tables of a standard make steps.  ``spread``: ``"uniform"``, every deviation is equally
    likely, or ``"normal"``, the half width is three standard deviations.

    >>> Tolerance((-0.1 * mm, 0.3 * mm)), Tolerance(iso_2768, "normal").between("arm", np.array([0.05]))[1]
    (Tolerance(deviation=(-0.0001, 0.0003), spread='uniform'), array([0.0003]))

    Raises ``ValueError`` for deviations that are not finite or not in order, and an unknown spread.
    """

    deviation: Any
    spread: str = "uniform"

    def __post_init__(self) -> None:
        refuse_kinds(self, but=("deviation",))
        if self.spread not in SPREADS:
            raise ValueError(f"the spread is {shown(self.spread)}; there are {', '.join(SPREADS)}")
        if not callable(self.deviation):
            _pair("quantity", self.deviation)

    def between(self, path: str, values: Array) -> tuple[Array, Array]:
        """The lowest and the highest deviation of each of ``values``, which stand at ``path``."""
        if not callable(self.deviation):
            low, high = _pair(path, self.deviation)
            return np.full(values.shape, low), np.full(values.shape, high)
        what = f"what the tolerance of the {words(path)} gives"
        with applied(what, values):
            given = self.deviation(values)
        sides = given if isinstance(given, tuple) else (-numbers(given, what), given)
        both = [np.asarray(numbers(side, what)) for side in sides]
        if len(both) != 2 or any(side.shape not in ((), values.shape) for side in both):
            raise ValueError(f"{what} is {shown(given)}; it must be a number for each value, or a pair of them")
        return np.broadcast_to(both[0], values.shape), np.broadcast_to(both[1], values.shape)


@dataclass(frozen=True)
class Source:
    """What the workshop misses and several quantities depend on: by how much each of them moves with it.

    ``moves`` maps paths to how far they move for 1 of the source: a wall too thick by 1 makes the bore smaller by 2.
    ``of`` says what the source itself is, a sum of quantities times factors, for a tolerance that depends on it.

    >>> Source("wall", {"inner_diameter": -2}, {"outer_diameter": 0.5, "inner_diameter": -0.5})
    Source(name='wall', moves=(('inner_diameter', -2),), of=(('outer_diameter', 0.5), ('inner_diameter', -0.5)))

    Raises ``ValueError`` for factors that are no finite numbers, and a source that moves nothing.
    """

    name: str
    moves: Any
    of: Any = ()

    def __post_init__(self) -> None:
        refuse_kinds(self, but=("moves", "of"))
        for field in ("moves", "of"):
            object.__setattr__(self, field, self._pairs(getattr(self, field)))
        if not self.moves:
            raise ValueError(f"the {self.name} moves nothing; it must move one quantity or more")

    def _pairs(self, given: object) -> tuple[tuple[str, float], ...]:
        pairs: Any = tuple(
            given.items() if isinstance(given, Mapping) else given if isinstance(given, tuple) else (given,)
        )
        if not all(isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], str) for pair in pairs):
            raise ValueError(f"the {self.name} moves {shown(given)}; it must be a mapping from paths to numbers")
        for path, factor in pairs:
            one_number(factor, f"how far the {words(path)} moves with the {self.name}", holds=finite)
        return pairs


def en_10210(outer: str, inner: str) -> dict[Source, Tolerance]:
    """The tolerances of a hot finished round tube, its diameters at the paths ``outer`` and ``inner``.

    EN 10210-2: the diameter by 1 %, at least 0.5 and at most 10 mm, the wall by -10 %; above it is limited by the
    mass, which is taken as +8 %.  The bore is what is left between the walls.

    >>> [source.name for source in en_10210("outer_diameter", "inner_diameter")]
    ['diameter', 'wall']
    """
    refuse_arguments(en_10210, locals())
    diameter = Source("diameter", {outer: 1.0, inner: 1.0}, {outer: 1.0})
    wall = Source("wall", {inner: -2.0}, {outer: 0.5, inner: -0.5})
    return {diameter: Tolerance(_tube_diameter), wall: Tolerance(_tube_wall)}


def _tube_diameter(D: Array) -> Array:
    return np.clip(0.01 * D, 0.5 * mm, 10 * mm)


def _tube_wall(T: Array) -> tuple[Array, Array]:
    return -0.1 * T, 0.08 * T


STANDARDS: dict[str, Callable[..., Any]] = {
    "ISO 2768": iso_2768,
    "ISO 286": iso_286,
    "EN 10210 diameter": _tube_diameter,
    "EN 10210 wall": _tube_wall,
}
"""What a file may name as a tolerance that depends on the value."""


def spread_shares(unit: Array, spreads: Iterable[str], correlation: Array | None = None) -> Array:
    """Shares ``z`` of the half widths from points ``(n, k)`` of the unit box, by the spread of each.

    ``correlation`` ``(k, k)`` joins them by a Gaussian copula.
    """
    from scipy.special import ndtr, ndtri

    if correlation is not None:
        unit = ndtr(ndtri(unit) @ np.linalg.cholesky(correlation).T)
    return np.where([spread == "normal" for spread in spreads], ndtri(unit) / WITHIN, 2 * unit - 1)


def correlated(names: list[str], pairs: Mapping[Any, float]) -> Array | None:
    """The correlations between tolerances as a matrix, ``(k, k)``, from pairs of names; ``None``: there are none."""
    found = np.eye(len(names))
    for pair, value in pairs.items():
        if not isinstance(pair, tuple) or len(pair) != 2 or not set(pair) <= set(names) or pair[0] == pair[1]:
            raise ValueError(f"the correlation is between {shown(pair)}; it must be two of {', '.join(names)}")
        if not abs(one_number(value, "a correlation", "lie between -1 and 1")) < 1:
            raise ValueError(
                f"the correlation of {' and '.join(map(words, pair))} is {value:g}; it must lie between -1 and 1"
            )
        i, j = map(names.index, pair)
        found[i, j] = found[j, i] = value
    if np.linalg.eigvalsh(found).min() <= 0:
        raise ValueError("the correlations contradict each other; no parts can have them all")
    return found if pairs else None
