"""Sums of sines: a straight rise less some harmonics, from dwell to dwell.

Source: Gutman (1-3), Freudenstein (1-3-5); Norton, Cam Design and Manufacturing Handbook; Chen, Mechanics and Design
of Cam Mechanisms.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from numpy import cos, pi, sin

from ...quantities import quantity
from ...quantities.kinds import refuse_lengths
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks

GUTMAN = {1: 15 / 16, 3: 1 / 16}
FREUDENSTEIN = {1: 1125 / 1192, 3: 1125 / 1192 / 18, 5: 1125 / 1192 / 250}


def sines(u: Array, b: Mapping[int, Value]) -> Kinematics:
    """``s = u - sum b_k sin(2 pi k u) / (2 pi k)`` with the share ``b_k`` of each harmonic ``k``, and derivatives."""
    s, v, a, j = u, 1.0 + 0.0 * u, 0.0 * u, 0.0 * u
    for k, b_k in b.items():
        w = 2 * pi * k
        s, v = s - b_k * sin(w * u) / w, v - b_k * cos(w * u)
        a, j = a + b_k * w * sin(w * u), j + b_k * w**2 * cos(w * u)
    return Kinematics(s, v, a, j)


@dataclass(frozen=True)
class Gutman(Law):
    """Gutman's law of the harmonics 1 and 3: ``s = u - 15/16 sin(2 pi u)/(2 pi) - 1/16 sin(6 pi u)/(6 pi)``.

    >>> Gutman()(0.25).a.round(6)
    np.float64(4.712389)
    """

    name = "Gutman 1-3"
    continuity = 2

    def at(self, u: Array) -> Kinematics:
        return sines(u, GUTMAN)

    def peaks(self) -> Peaks:
        return law_peaks(self)


@dataclass(frozen=True)
class Freudenstein(Law):
    """Freudenstein's law of the harmonics 1, 3 and 5, their shares as ``1 : 1/18 : 1/250``.

    >>> Freudenstein()([0.25, 0.5]).s.round(6)
    array([0.102452, 0.5     ])
    """

    name = "Freudenstein 1-3-5"
    continuity = 2

    def at(self, u: Array) -> Kinematics:
        return sines(u, FREUDENSTEIN)

    def peaks(self) -> Peaks:
        return law_peaks(self)


@dataclass(frozen=True)
class SumOfSines(Law):
    """Harmonics 1, 3 and 5 with any shares: ``s = u - sum b_k sin(2 pi k u) / (2 pi k)``, ``b_1 = 1 - b_3 - b_5``.

    With neither third nor fifth it is the cycloidal law.  ``third`` and ``fifth`` may be arrays ``(p, 1)``, a
    population.  ``ValueError`` for what is no finite number.

    >>> SumOfSines(1 / 16)(0.3).s == Gutman()(0.3).s
    np.True_
    """

    third: Value = quantity("b_3", 1 / 28, -0.1, 0.2, "", "share of the third harmonic", above=None)
    fifth: Value = quantity("b_5", 0, -0.05, 0.05, "", "share of the fifth harmonic", above=None)

    name = "sum of sines"
    continuity = 2

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_lengths(self)

    def at(self, u: Array) -> Kinematics:
        return sines(u, {1: 1 - self.third - self.fifth, 3: self.third, 5: self.fifth})

    def peaks(self) -> Peaks:
        return law_peaks(self)
