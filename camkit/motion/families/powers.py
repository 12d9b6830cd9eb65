"""Polynomials of free exponents: a few powers of ``u``, whole or not, that come to rest at the end.

Source: Norton, Cam Design and Manufacturing Handbook (polynomial functions); Chen, Mechanics and Design of Cam
Mechanisms (polynomials of general exponents).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import pairwise
from math import comb, factorial, prod
from typing import Any

import numpy as np

from ...quantities import Quantity, certain, numbered, row, unless
from ...quantities.kinds import listed, refuse_lengths
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks
from .free import given_at, sized

EXPONENT = Quantity("p", 3, 2, 20, "", "exponent of the share of the angle", above=1, at_most=60, name="exponent")
EXPONENTS = numbered("exponent", EXPONENT)
MOST = 8
"""So many powers at most: with more their factors are so large that digits are lost."""


@dataclass(frozen=True)
class PowerPolynomial(Law):
    """``s = sum c_i u^p_i`` of the ``exponents`` ``p_1 < ... < p_k``, real numbers above 1 that need not be whole.

    The ``k`` factors make ``s(1) = 1`` and ``k - 1`` derivatives there what ``end`` says, in the order ``v, a, j``;
    what it does not say is 0::

        c_i = prod_{j != i} p_j / (p_j - p_i)                       where the law ends at rest

    At the start all derivatives below ``p_1`` are 0.  With ``p_1`` between 2 and 3 the acceleration is 0 there and the
    jerk infinite, with ``p_1 < 2`` the acceleration.  Each exponent may be an array ``(p, 1)``, a population.

    ``ValueError``: no exponent or more than eight, one that is not above 1, exponents that do not increase, more end
    values than the factors can meet.

    >>> from camkit.motion import Poly345
    >>> PowerPolynomial((3, 4, 5))(0.3).s.round(9) == Poly345()(0.3).s.round(9)
    np.True_
    >>> print(*(f"{c:.6g}" for c in PowerPolynomial((4, 5, 7, 9)).c))
    21 -31.5 15 -3.5
    >>> PowerPolynomial((2.5, 4, 5)).peaks().Cj
    np.float64(inf)
    """

    exponents: tuple[Value, ...] = row(EXPONENTS, default=(3.0, 4.0, 5.0))
    end: tuple[Value, ...] = row(given_at("end", 1), default=())

    name = "polynomial of free exponents"

    def __post_init__(self) -> None:
        object.__setattr__(self, "exponents", _exponents(self.exponents))
        object.__setattr__(self, "end", _end(self.end, len(self.exponents)))
        refuse_lengths(self)
        ok: Any = True
        for i, (low, high) in enumerate(pairwise(self.exponents), start=2):
            if refuse := unless(low < high):
                told = f"the exponent {i} of the polynomial is {high:.6g} after {low:.6g}"
                refuse(f"{told}; each must be above the one before")
            ok = ok & (low < high)
        if not certain(ok):
            object.__setattr__(self, "exponents", tuple(np.where(ok, p, np.nan) for p in self.exponents))

    @property
    def c(self) -> tuple[Value, ...]:
        """What stands before each power; ``nan`` in the rows of a population whose exponents do not increase."""
        p = self.exponents
        ends = (1.0, *self.end)
        weights = [
            sum(e * (-1) ** (m - r) * comb(m, r) / factorial(m) for m, e in enumerate(ends) if m >= r)
            for r in range(len(ends))
        ]
        return tuple(sum(w * _lagrange(p, i, r) for r, w in enumerate(weights)) for i in range(len(p)))

    @property
    def continuity(self) -> int:
        """As for every law; at the start all derivatives below the first exponent are 0."""
        met = [bool(np.all(np.equal(value, 0))) for value in self.end]
        at_end = met.index(False) if False in met else len(self.exponents) - 1
        return min(at_end, int(np.ceil(np.nanmin(self.exponents[0], initial=at_end + 1))) - 1)

    def at(self, u: Array) -> Kinematics:
        terms = list(zip(self.c, self.exponents, strict=True))[::-1]
        with np.errstate(divide="ignore", invalid="ignore"):
            return Kinematics(*(reduce(_and_lower, (_derivative(u, c, p, k) for c, p in terms)) for k in range(4)))

    def peaks(self) -> Peaks:
        found = enumerate(law_peaks(self), start=1)
        return Peaks(*(np.where(self._infinite(k), np.inf, peak)[()] for k, peak in found))

    def _infinite(self, k: int) -> Value:
        """Whether the ``k``-th derivative has no end at the start: an exponent below ``k`` is no whole number."""
        return reduce(np.logical_or, ((p < k) & (p != np.floor(p)) for p in self.exponents))


def _lagrange(p: Sequence[Value], i: int, x: int) -> Value:
    """The polynomial that is 1 at ``p_i`` and 0 at all other exponents, at ``x``."""
    return prod((x - other) / (p[i] - other) for j, other in enumerate(p) if j != i)


def _derivative(u: Array, c: Value, p: Value, k: int) -> Array:
    """The ``k``-th derivative of ``c u^p``; 0 where a whole exponent leaves nothing of it."""
    factor = c * prod(p - m for m in range(k))
    return np.where(factor == 0, 0.0, factor * u ** np.where(factor == 0, 1.0, p - k))


def _and_lower(higher: Array, term: Array) -> Array:
    """The sum with the term of a lower exponent, which alone counts where it has no end."""
    return np.where(abs(term) == np.inf, term, higher + term)


def _exponents(given: object) -> tuple[Value, ...]:
    values = listed(given, "the exponents of the polynomial", "exponent")
    if not 1 <= len(values) <= MOST:
        raise ValueError(f"the polynomial has {len(values)} exponents; it must have from 1 to {MOST}")
    return tuple(sized(p, f"the exponent {i} of the polynomial", EXPONENT) for i, p in enumerate(values, start=1))


def _end(given: object, powers: int) -> tuple[Value, ...]:
    values = listed(given, "the end of the polynomial", "value")
    most = min(powers - 1, 3)
    if len(values) > most:
        told = f"{len(values)} values v, a, j at its end and {powers} exponents"
        raise ValueError(f"the polynomial has {told}; it can have one value fewer than exponents, and three at most")
    return tuple(
        sized(value, f"{letter} at the end of the polynomial", given_at("end", 1)(i)[1])
        for i, (letter, value) in enumerate(zip("vaj", values, strict=False))
    )
