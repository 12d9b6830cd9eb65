"""Asymmetric forms: the inflection point of a symmetric law is moved.

Displaced inflection points are treated in VDI 2143 part 1, asymmetric segments in Norton, Cam Design and
Manufacturing Handbook; the form used here is derived in the docstring.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...quantities import Choice, quantity
from ...quantities.kinds import a_number, shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks
from .harmonic import Cycloidal
from .plain import LAWS


@dataclass(frozen=True)
class Skewed(Law):
    """A symmetric law ``S`` with its inflection moved from 1/2 to ``x`` = ``inflection``::

        u <= x   s = 2 x S(u / (2 x))
        u >= x   s = 1 - 2 (1 - x) S((1 - u) / (2 (1 - x)))

    Each half is scaled alike in time and in lift.  That keeps the velocity, so it is continuous at ``x``;
    the acceleration is divided by ``2 x`` and by ``2 (1 - x)``, and stays continuous because it is 0 at the
    middle of ``S``.  (To stretch the time of each half alone would break the velocity.)  The jerk has a
    finite jump at ``x``.  The inflection lies at ``s = x`` and the peak velocity is that of ``S``.

    ``inflection`` lies strictly between 0 and 1 (an array ``(p, 1)`` for a population: ``nan`` outside).
    ``ValueError`` for one that does not, and for a law that is not symmetric, ``S(u) + S(1 - u) = 1``.

    >>> from camkit.motion import Cycloidal
    >>> Skewed(Cycloidal(), 0.4).peaks().Ca.round(6)
    np.float64(7.853982)
    """

    law: Law = field(metadata={"declared": Choice("S", Cycloidal(), LAWS, "symmetric law that is skewed")})
    inflection: Value = quantity("x", 0.5, 0.2, 0.8, "", "share of the time before the inflection point")

    name = "skewed"

    def __post_init__(self) -> None:
        what = "the inflection of the skewed law"
        inflection = a_number(self.inflection, what, "lie between 0 and 1", lambda x: (x > 0) & (x < 1))
        object.__setattr__(self, "inflection", inflection)
        if not isinstance(self.law, Law):
            raise ValueError(f"the law to be skewed is {shown(self.law)}; it must be a motion law such as Cycloidal()")
        u = np.linspace(0.0, 0.5, 9)
        if not np.allclose(self.law(u).s + self.law(1 - u).s, 1.0, rtol=0, atol=1e-9, equal_nan=True):
            raise ValueError(f"the {self.law.name} law is not symmetric; only a symmetric law can be skewed")

    @property
    def continuity(self) -> int:
        return self.law.continuity

    @property
    def kinks_move(self) -> bool:
        return True

    @property
    def kinks(self) -> tuple[Value, ...]:
        x = self.inflection
        early = [2 * x * k for k in self.law.kinks if k < 0.5]
        late = [1 - 2 * (1 - x) * (1 - k) for k in self.law.kinks if k > 0.5]
        return (*early, x, *late)

    def at(self, u: Array) -> Kinematics:
        x = self.inflection
        early = u < x
        scale = np.where(early, 2 * x, 2 * (1 - x))
        s, v, a, j = self.law(np.where(early, u, 1 - u) / scale)
        s, a = scale * s, a / scale
        return Kinematics(np.where(early, s, 1 - s), v, np.where(early, a, -a), j / scale**2)

    def peaks(self) -> Peaks:
        least = 2 * np.minimum(self.inflection, 1 - self.inflection)
        Cv, Ca, Cj = self.law.peaks()
        return Peaks(Cv + 0 * least, Ca / least, Cj / least**2)
