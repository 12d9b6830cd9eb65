"""A motion law with a say left to the designer: coefficients shape it between its fixed ends.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov (polynomials of degree 9, splines as the alternative).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...quantities import choice, numbered, row
from ...quantities.kinds import refuse_kinds, refuse_lengths
from ...quantities.known import certain
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks
from .free import COEFFICIENT, Degree9, coefficients
from .plain import LAWS
from .polynomial import Poly345
from .spline import SplineLaw

MOST_KNOTS = 40
"""So many coefficients a B-spline can have at most."""


@dataclass(frozen=True)
class Family:
    """What coefficients stand for: ``law(c)`` is linear in ``c``, and so is what it adds to another law.

    ``wide``: how far from 0 a search may take a coefficient; ``most``: how many there can be, at least ``least``.
    """

    name: str
    law: Callable[[tuple[Value, ...]], Law]
    wide: float
    least: int = 4
    most: int = 4


def _spline(c: tuple[Value, ...]) -> Law:
    """A quintic B-spline with even knots, one for each coefficient."""
    return SplineLaw(tuple(i / (len(c) + 1) for i in range(1, len(c) + 1)), c)


DEGREE9 = Family("degree 9", Degree9, 0.6)
SPLINE = Family("B-spline", _spline, 0.2, 1, MOST_KNOTS)  # wider, next to no random law stays between its ends
FAMILIES = (DEGREE9, SPLINE)


@dataclass(frozen=True)
class ShapedLaw(Law):
    """``base`` and what the coefficients ``c`` add to it: ``base(u) + family(c)(u) - family(0)(u)``.

    The family ``DEGREE9`` adds ``64 u^3 (1 - u)^3 [c0 P0 + c1 P1 + c2 P2 + c3 P3]`` with the Legendre polynomials
    of ``2 u - 1``; ``SPLINE`` adds the quintic B-spline with as many even knots as there are coefficients (0.2, 0.4,
    0.6, 0.8 for four) that is ``c_i`` there.  Both leave position, velocity and acceleration as they are at both ends.

    ``ValueError``: other than four coefficients of degree 9, none or more than 40 of a B-spline.

    >>> from camkit.motion import Poly345
    >>> c = (0.1, -0.2, 0.0, 0.05)
    >>> float(abs(ShapedLaw(Poly345(), c)(0.3).a - Degree9(c)(0.3).a)) < 1e-12
    True
    """

    base: Law = choice("a", Poly345(), LAWS, "law that the coefficients shape")
    c: tuple[Value, ...] = row(numbered("c", COEFFICIENT), default=(0.0,) * 4)
    family: Family = choice("B", DEGREE9, FAMILIES, "what the coefficients add to the law")

    name = "shaped"

    def __post_init__(self) -> None:
        refuse_kinds(self)
        object.__setattr__(self, "c", coefficients(self.c, self.name, self.family.least, self.family.most))
        refuse_lengths(self)

    def declares(self) -> dict[str, Any]:
        """Coefficients as far as the family lets them go."""
        wide = self.family.wide
        return {"c": numbered("c", replace(COEFFICIENT, low=-wide, high=wide))}

    def around(self, law: Law) -> ShapedLaw:
        """``law`` as coefficients can shape it, all of them 0."""
        return replace(self, base=law, c=(0.0,) * len(self.c))

    @property
    def _plain(self) -> bool:
        """Whether no coefficient adds anything to the law."""
        return all(np.ndim(c) == 0 and certain(c == 0) for c in self.c)

    @property
    def continuity(self) -> int:
        return self.base.continuity if self._plain else min(self.base.continuity, 2)

    @property
    def kinks(self) -> tuple[Value, ...]:
        return self.base.kinks if self._plain else tuple(sorted({*self.base.kinks, *self.family.law(self.c).kinks}))

    def at(self, u: Array) -> Kinematics:
        if self._plain:
            return self.base.at(u)
        parts = self.base.at(u), self.family.law(self.c).at(u), self.family.law((0.0,) * len(self.c)).at(u)
        return Kinematics(*(base + shaped - plain for base, shaped, plain in zip(*parts, strict=True)))

    def peaks(self) -> Peaks:
        return self.base.peaks() if self._plain else law_peaks(self)
