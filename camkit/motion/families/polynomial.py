"""Polynomial laws from dwell to dwell, by the powers that they hold: 2, 3-4-5, 4-5-6-7, 5-6-7-8-9.

With ``w = u (1 - u)`` every velocity is a multiple of a power of ``w``, which gives derivatives without
cancellation at the ends.

Source: Norton, Cam Design and Manufacturing Handbook (double-dwell cam curves); VDI 2143 part 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy import inf

from ...quantities.types import Array
from ..law import Kinematics, Law, Peaks


@dataclass(frozen=True)
class Parabolic(Law):
    """Constant acceleration: ``s = 2 u^2`` up to the middle, ``1 - 2 (1 - u)^2`` after it.

    The least peak acceleration of all laws, at the price of three jumps of it.

    >>> Parabolic()(0.25).s
    np.float64(0.125)
    """

    name = "parabolic"
    continuity = 1
    kinks = (0.5,)

    def at(self, u: Array) -> Kinematics:
        early, x = u < 0.5, 1 - u
        s, v = np.where(early, 2 * u**2, 1 - 2 * x**2), np.where(early, 4 * u, 4 * x)
        return Kinematics(s, v, np.where(early, 4.0, -4.0) + 0 * u, 0 * u)

    def peaks(self) -> Peaks:
        return Peaks(2.0, 4.0, inf)


@dataclass(frozen=True)
class Poly345(Law):
    """3-4-5 polynomial: ``s = 10 u^3 - 15 u^4 + 6 u^5``.

    >>> Poly345().peaks().Cv
    1.875
    """

    name = "3-4-5 polynomial"
    continuity = 2

    def at(self, u: Array) -> Kinematics:
        w = u * (1 - u)
        return Kinematics(u**3 * (10 - 15 * u + 6 * u**2), 30 * w**2, 60 * w * (1 - 2 * u), 60 * (1 - 6 * w))

    def peaks(self) -> Peaks:
        return Peaks(15 / 8, 10 / 3**0.5, 60.0)


@dataclass(frozen=True)
class Poly4567(Law):
    """4-5-6-7 polynomial: ``s = 35 u^4 - 84 u^5 + 70 u^6 - 20 u^7``.

    >>> Poly4567().peaks().Cj
    52.5
    """

    name = "4-5-6-7 polynomial"
    continuity = 3

    def at(self, u: Array) -> Kinematics:
        w = u * (1 - u)
        s = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)
        return Kinematics(s, 140 * w**3, 420 * w**2 * (1 - 2 * u), 840 * w * (1 - 5 * w))

    def peaks(self) -> Peaks:
        return Peaks(35 / 16, 84 / 5**1.5, 52.5)


@dataclass(frozen=True)
class Poly56789(Law):
    """5-6-7-8-9 polynomial: ``s = 126 u^5 - 420 u^6 + 540 u^7 - 315 u^8 + 70 u^9``.

    >>> Poly56789().peaks().Cj
    78.75
    """

    name = "5-6-7-8-9 polynomial"
    continuity = 4

    def at(self, u: Array) -> Kinematics:
        w = u * (1 - u)
        s = u**5 * (126 - 420 * u + 540 * u**2 - 315 * u**3 + 70 * u**4)
        return Kinematics(s, 630 * w**4, 2520 * w**3 * (1 - 2 * u), 2520 * w**2 * (3 - 14 * w))

    def peaks(self) -> Peaks:
        return Peaks(315 / 128, 2520 * (3 / 14) ** 3 / 7**0.5, 78.75)
