"""Polynomials with a say left to the designer: free ends, or free coefficients between fixed ends.

Source: Norton, Cam Design and Manufacturing Handbook (polynomial functions and boundary conditions);
Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov (the degree-9 family of high-speed cams).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from math import factorial

import numpy as np
from numpy.polynomial.legendre import legder, legval

from ...quantities import Quantity, certain, floats, known, numbered, row
from ...quantities.kinds import a_number, listed, number, refuse_lengths
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks, met_at_dwells, polynomial
from .polynomial import Poly345

LETTERS, NAMES = ("s", "v", "a", "j"), ("position", "velocity", "acceleration", "jerk")
MANY, BEYOND = 32, 1e300
"""From so many borders on a recorded place is found by halving; a number that no place reaches."""
SIZES = (1, 4, 20, 120)
"""How far a slider goes to either side."""
Condition = tuple[float, int]
"""An end (0 or 1) and the order of a derivative given there."""


def given_at(end: str, first: int = 0) -> Callable[[int], tuple[str, Quantity]]:
    """Declarations of ``s, v, a, j`` (from the ``first`` of them on) that are given at one end of a law of lift 1."""

    def declared(i: int) -> tuple[str, Quantity]:
        letter, size = LETTERS[first + i], SIZES[first + i]
        return f"{end}_{letter}", Quantity(
            f"{letter}_{end}", 0, -size, size, "", f"{NAMES[first + i]} at the {end}, for a lift of 1", above=None
        )

    return cache(declared)


def sized(value: object, what: str, declared: Quantity) -> Value:
    """``value`` as a number or a column of the size that its declaration allows (see `a_number`)."""
    read = number(value)
    if read is not None and certain(declared.allows(read)):
        return read
    must = declared.possible if read is None or np.ndim(read) else declared.possible_for(read)
    return a_number(value, what, f"be {must}", declared.allows)


@dataclass(frozen=True)
class FreePolynomial(Law):
    """The polynomial of least degree with the given ``s, v, a, j`` at the two ends.

    ``start`` and ``end`` hold up to four values each, in the order ``s, v, a, j``, normalised (lift 1 over
    unit time); ``None`` leaves one free, a population gives arrays of shape ``(p, 1)``.  ``k`` values make
    degree ``k - 1``: a 3-4-5 polynomial is ``start=(0, 0, 0), end=(1, 0, 0)``.  The law is solved for in
    Legendre polynomials of ``2 u - 1``, which keeps the equations well conditioned.

    ``ValueError``: no value at all, more than four at an end, a value that is not finite, or values that
    do not determine a polynomial (such as velocities alone).

    >>> cubic = FreePolynomial(start=(0, 0), end=(1, 0))
    >>> cubic([0.1, 0.2, 0.3]).s.round(6)
    array([0.028, 0.104, 0.216])
    """

    start: tuple[Value | None, ...] = row(given_at("start"), default=(0.0, 0.0, 0.0))
    end: tuple[Value | None, ...] = row(given_at("end"), default=(1.0, 0.0, 0.0))

    name = "free polynomial"

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", _values("start", self.start))
        object.__setattr__(self, "end", _values("end", self.end))
        refuse_lengths(self)
        _powers(self._conditions)

    @property
    def _given(self) -> list[tuple[Condition, Value]]:
        ends = ((0.0, self.start), (1.0, self.end))
        return [((u, k), value) for u, values in ends for k, value in enumerate(values) if value is not None]

    @property
    def _conditions(self) -> tuple[Condition, ...]:
        return tuple(condition for condition, _ in self._given)

    @property
    def continuity(self) -> int:
        """As for every law; 0 where only the position is that of a dwell, -1 where not even that."""
        return met_at_dwells(self)

    def at(self, u: Array) -> Kinematics:
        powers = of_values(_powers(self._conditions), [value for _, value in self._given])
        return piecewise(powers, (0.0, 1.0), (0.5,), u)

    def peaks(self) -> Peaks:
        return law_peaks(self)


def of_values(powers: Array, given: Sequence[Value]) -> Array:
    """What stands before each power, ``(powers, pieces)`` or ``(.., p, 1)``, from what it is for each given value.

    It is added one by one, so that no last digit depends on how many designs there are.
    """
    values = np.stack(np.broadcast_arrays(*map(floats, given)))
    each = powers.reshape(powers.shape + (1,) * (values.ndim - 1))
    return np.stack([np.cumsum(factors * values, axis=1)[:, -1] for factors in each])


def piecewise(powers: Array, origins: Sequence[float], borders: Sequence[float], u: Array) -> Kinematics:
    """A motion of polynomials in the distance from an origin each, with borders between them.

    The first and the last are about the ends of the law: where it comes to rest its speed is no rounding.
    """
    if known(u):
        place = np.searchsorted(borders, u, side="right")
        rows = (np.arange(powers.shape[2])[:, None], 0) if powers.ndim > 2 else ()
        return polynomial([*powers[:, place, *rows]], u - np.asarray(origins)[place])
    at = np.atleast_1d(u)  # a program is as short for many pieces as for few
    place = _below(borders, at)
    if powers.ndim > 2:
        powers, place = np.moveaxis(powers[..., 0], 1, -1), np.atleast_2d(place)
    found = polynomial([_picked(row, place) for row in powers], at - _picked(np.asarray(origins), place))
    return found if np.ndim(u) or place.ndim > 1 else Kinematics(*(values[..., 0] for values in found))


def _below(borders: Sequence[float], at: Array) -> Array:
    """How many of the borders are at or below each place, which is recorded: where they are many, by halving."""
    if len(borders) < MANY:
        return (np.expand_dims(at, -1) >= np.asarray(borders)).sum(-1)
    steps = [2**k for k in range(len(borders).bit_length() - 1, -1, -1)]
    padded = np.append(borders, np.full(2 * steps[0] - 1 - len(borders), BEYOND))
    found = np.where(at >= padded[steps[0] - 1], steps[0], 0)
    for step in steps[1:]:
        found = np.where(at >= _picked(padded, found + (step - 1)), found + step, found)
    return found


def _picked(row: Array, place: Array) -> Array:
    return np.take_along_axis(np.reshape(row, (1,) * (place.ndim - row.ndim) + row.shape), place, -1)


def exact(powers: Array, conditions: Mapping[int, Condition]) -> Array:
    """``powers`` of given values, of which some are, by their place, conditions at an end: to the last digit."""
    for i, (u, k) in conditions.items():
        powers[k, -int(u)] = 0.0
        powers[k, -int(u), i] = 1 / factorial(k)
    return powers


@lru_cache(maxsize=256)
def _powers(conditions: tuple[Condition, ...]) -> Array:
    """From given values to the powers of the distance from each end, ``(powers, 2, values)``."""
    every = np.eye(len(conditions))
    rows = [2**k * legval(2 * u - 1, legder(every, k)) for u, k in conditions]
    if not rows or np.linalg.matrix_rank(np.array(rows)) < len(rows):
        given = ", ".join(f"{LETTERS[k]}({u:g})" for u, k in conditions) or "nothing"
        raise ValueError(f"the free polynomial is given {given}; that does not determine a polynomial: add an s")
    inverse, ends = np.linalg.inv(np.array(rows)), np.array([-1.0, 1.0])
    found = [2**k / factorial(k) * legval(ends, legder(inverse, k)).T for k in range(len(conditions))]
    return exact(np.stack(found), dict(enumerate(conditions)))


def _values(word: str, given: object) -> tuple[Value | None, ...]:
    """What is given at one end, each a number, a column or ``None``."""
    values = listed(given, f"the {word} of the free polynomial", "value")
    if len(values) > 4:
        raise ValueError(f"the {word} of the free polynomial has {len(values)} values; it can have s, v, a, j at most")
    return tuple(
        value if value is None else sized(value, f"{letter} at the {word} of the free polynomial", given_at(word)(i)[1])
        for i, (letter, value) in enumerate(zip(LETTERS, values, strict=False))
    )


COEFFICIENT = Quantity("c", 0, -0.6, 0.6, "", "shapes the law", above=None, name="shape")


def coefficients(given: object, law: str, least: int = 4, most: int = 4) -> tuple[Value, ...]:
    """The coefficients of a law, four unless said otherwise; ``ValueError`` for anything else."""
    c = listed(given, f"the c of the {law} law", "coefficient")
    if not least <= len(c) <= most:
        must = "four" if least == most else f"from {least} to {most}"
        raise ValueError(f"the {law} law has {len(c)} coefficients c; it must have {must}")
    return tuple(sized(value, f"the coefficient c{i} of the {law} law", COEFFICIENT) for i, value in enumerate(c))


@dataclass(frozen=True)
class Degree9(Law):
    """Degree 9 with dwell ends and four free coefficients ``c``, the family of high-speed cams::

        s = 10 u^3 - 15 u^4 + 6 u^5 + 64 u^3 (1 - u)^3 [c0 P0 + c1 P1 + c2 P2 + c3 P3]

    with ``P`` the Legendre polynomials of ``2 u - 1``.  Each coefficient is a number or an array of shape
    ``(p, 1)``.  ``ValueError``: not four coefficients, or one that is not finite.

    >>> Degree9((0, 0, 0, 0))(0.25).s == Poly345()(0.25).s
    np.True_
    """

    c: tuple[Value, ...] = row(numbered("c", COEFFICIENT), default=(0.0, 0.0, 0.0, 0.0))

    name = "degree 9"
    continuity = 2

    def __post_init__(self) -> None:
        object.__setattr__(self, "c", coefficients(self.c, self.name))
        refuse_lengths(self)

    def at(self, u: Array) -> Kinematics:
        c0, c1, c2, c3 = self.c
        s, v, a, j = Poly345().at(u)
        w, d, x = u * (1 - u), 1 - 2 * u, 2 * u - 1
        g, g1, g2, g3 = 64 * w**3, 192 * w**2 * d, 384 * w * (1 - 5 * w), 384 * d * (1 - 10 * w)
        q = c0 + c1 * x + c2 * (3 * x**2 - 1) / 2 + c3 * (5 * x**3 - 3 * x) / 2
        q1 = 2 * c1 + 6 * c2 * x + c3 * (15 * x**2 - 3)
        q2, q3 = 12 * c2 + 60 * c3 * x, 120 * c3
        return Kinematics(
            s + g * q,
            v + g1 * q + g * q1,
            a + g2 * q + 2 * g1 * q1 + g * q2,
            j + g3 * q + 3 * g2 * q1 + 3 * g1 * q2 + g * q3,
        )

    def peaks(self) -> Peaks:
        return law_peaks(self)
