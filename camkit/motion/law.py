"""What a motion law is: position, velocity, acceleration and jerk of a rise of 1 over a time of 1."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..extrema import highest_between
from ..quantities import Declared, floats
from ..quantities.kinds import numbers
from ..quantities.types import Array, Value

ROUNDING = 1e-9
"""How far outside [0, 1] a ``u`` may lie and still be taken for the end that was meant."""


class Kinematics(NamedTuple):
    """Position and its first three derivatives, unpackable as ``s, v, a, j``."""

    s: Array
    v: Array
    a: Array
    j: Array


class Peaks(NamedTuple):
    """The largest |v|, |a| and |j| of a law, unpackable as ``Cv, Ca, Cj``."""

    Cv: Value
    Ca: Value
    Cj: Value


class Kinked:
    """A motion over ``u`` from 0 to 1, smooth throughout where it does not say otherwise."""

    @property
    def kinks(self) -> tuple[Value, ...]:
        """The ``u`` inside (0, 1), in order, at which a derivative up to the jerk may jump or have a corner."""
        return ()

    @property
    def kinks_move(self) -> bool:
        """Whether the kinks stand elsewhere for other parameters."""
        return False


class Law(Kinked, Declared, ABC):
    """A rise of 1 over ``u`` from 0 to 1; every law is a small frozen dataclass with its formula in ``at``.

    Laws are equal and hashed by value.  A parameter that is declared (`quantity`) has a path in every design that holds
    the law: it is a slider, a free quantity of a study, a tolerance.  Parameters may be arrays of shape ``(p, 1)``, a
    population of ``p`` laws; the four results then have the shape ``(p, n)``.
    """

    @property
    @abstractmethod
    def name(self) -> str:
        """What the law is called in menus and files."""

    @property
    @abstractmethod
    def continuity(self) -> int:
        """Highest derivative without a jump where the law meets a dwell: 1 velocity, 2 acceleration, 3 jerk."""

    def __call__(self, u: ArrayLike) -> Kinematics:
        """``s, v, a, j`` at ``u`` (any shape), derivatives with respect to ``u``; ``nan`` outside [0, 1]."""
        return Kinematics(*(floats(x)[()] for x in self.at(_inside(u))))

    @abstractmethod
    def at(self, u: Array) -> Kinematics:
        """The formula itself, for an array ``u`` that is known to lie in [0, 1]."""

    @abstractmethod
    def peaks(self) -> Peaks:
        """``Cv, Ca, Cj``: the largest |v|, |a|, |j|.

        ``inf`` where a lower derivative jumps, at the ends as well for the laws that run from dwell to
        dwell.  Laws made to be joined to a moving neighbour (half laws, free ends) count [0, 1] only.
        """


def law_peaks(law: Law) -> Peaks:
    """``Cv, Ca, Cj`` of a law that has no closed form for them: numbers, or ``(p, 1)`` for a population."""
    found = (highest_between(derivative_size(law, k), (0.0, *law.kinks, 1.0)).value for k in (1, 2, 3))
    return Peaks(*(value[..., None] if np.ndim(value) else value for value in found))


def met_at_dwells(law: Law) -> int:
    """The `continuity` of a law that may have any ends: 0 with the position of a dwell alone, -1 without that."""
    ends = [law(u) for u in (0.0, 1.0)]
    rest = [np.allclose(ends[0][k], 0) and np.allclose(ends[1][k], k == 0) for k in range(4)]
    return [*rest, False].index(False) - 1


def derivative_size(motion: Callable[[Array], Kinematics], k: int) -> Callable[[Array], Value]:
    """The size of the derivative of order ``k``, as a function."""
    return lambda u: abs(motion(u)[k])


def _inside(u: ArrayLike) -> Array:
    """``u`` as an array of floats, ``nan`` where it lies outside [0, 1]."""
    u = numbers(u, "the shares of the time")
    nearest = np.minimum(np.maximum(u, 0.0), 1.0)
    return np.where(np.abs(u - nearest) <= ROUNDING, nearest, np.nan)


def polynomial(factors: Sequence[Value], x: Value) -> Kinematics:
    """A polynomial by its factors, that of the lowest power first, and its derivatives at ``x`` (Horner's scheme).

    >>> polynomial([1.0, 0.0, 0.0, 2.0], 2.0)
    Kinematics(s=17.0, v=24.0, a=24.0, j=12.0)
    """
    s, v, a, j = (0.0 * x,) * 4
    for factor in factors[::-1]:
        s, v, a, j = s * x + factor, v * x + s, a * x + v, j * x + a
    return Kinematics(s, v, 2 * a, 6 * j)  # type: ignore[arg-type]


def mirrored(u: Value, first_half: Callable[[Array], Kinematics]) -> Kinematics:
    """A symmetric law from its first half: ``s(u) = 1 - s(1 - u)``."""
    late = u > 0.5
    s, v, a, j = first_half(np.where(late, 1 - u, u))
    return Kinematics(np.where(late, 1 - s, s), v, np.where(late, -a, a), j)
