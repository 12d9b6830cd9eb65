"""Laws put together from sine quarters and straight pieces of acceleration.

Source: Norton, Cam Design and Manufacturing Handbook (double-dwell cam curves); VDI 2143 part 1.  The decimal
constants printed there are the closed forms used here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy import cos, pi, sin

from ...quantities import quantity
from ...quantities.kinds import a_number
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, mirrored


@dataclass(frozen=True)
class ModifiedTrapezoid(Law):
    """Modified trapezoid: acceleration of flat tops joined by quarter sines; ``A = 8 pi / (pi + 2)``.

    On the first half, with ``k = 4 pi``, ``x = u - 1/8``, ``y = u - 3/8``::

        0   <= u <= 1/8    a = A sin(k u)    s = A/k [u - sin(k u)/k]
        1/8 <= u <= 3/8    a = A             s = A/k (1/8 - 1/k) + A x/k + A x^2/2
        3/8 <= u <= 1/2    a = A cos(k y)    s = A/k (3/8 - 1/k) + A/32 + A (1/k + 1/4) y + A/k^2 [1 - cos(k y)]

    and on the second ``s(u) = 1 - s(1 - u)``.

    >>> ModifiedTrapezoid()(0.5).s.round(12)
    np.float64(0.5)
    """

    name = "modified trapezoid"
    continuity = 2
    kinks = (1 / 8, 3 / 8, 5 / 8, 7 / 8)

    def at(self, u: Array) -> Kinematics:
        return mirrored(u, _first_half_of_trapezoid)

    def peaks(self) -> Peaks:
        top = 8 * pi / (pi + 2)
        return Peaks(2.0, top, 4 * pi * top)


def _first_half_of_trapezoid(u: Value) -> Kinematics:
    top, k = 8 * pi / (pi + 2), 4 * pi
    x, y = u - 1 / 8, u - 3 / 8
    zone = [u < 1 / 8, u < 3 / 8]
    s1 = top / k * (u - sin(k * u) / k)
    s2 = top / k * (1 / 8 - 1 / k) + top / k * x + top / 2 * x**2
    s3 = top / k * (3 / 8 - 1 / k) + top / 32 + top * (1 / k + 1 / 4) * y + top / k**2 * (1 - cos(k * y))
    v1, v2, v3 = top / k * (1 - cos(k * u)), top / k + top * x, top / k + top / 4 + top / k * sin(k * y)
    a1, a2, a3 = top * sin(k * u), top + 0 * u, top * cos(k * y)
    j1, j2, j3 = top * k * cos(k * u), 0 * u, -top * k * sin(k * y)
    return Kinematics(
        *(np.select(zone, [f, g], h) for f, g, h in ((s1, s2, s3), (v1, v2, v3), (a1, a2, a3), (j1, j2, j3)))
    )


@dataclass(frozen=True)
class ModifiedSine(Law):
    """Modified sine: acceleration of quarter sines of two periods; ``c = pi / (4 + pi)``.

    On the first half, and on the second by ``s(u) = 1 - s(1 - u)``::

        0   <= u <= 1/8    s = c [u - sin(4 pi u) / (4 pi)]
        1/8 <= u <= 1/2    s = c [2/pi + u - 9/(4 pi) sin(4 pi u/3 + pi/3)]

    >>> ModifiedSine().peaks().Cv.__round__(6)
    1.759603
    """

    name = "modified sine"
    continuity = 2
    kinks = (1 / 8, 7 / 8)

    def at(self, u: Array) -> Kinematics:
        return mirrored(u, _first_half_of_sine)

    def peaks(self) -> Peaks:
        c = pi / (4 + pi)
        return Peaks(4 * c, 4 * pi * c, 16 * pi**2 * c)


def _first_half_of_sine(u: Value) -> Kinematics:
    c, x, y = pi / (4 + pi), 4 * pi * u, 4 * pi * u / 3 + pi / 3
    early = u < 1 / 8
    return Kinematics(
        np.where(early, c * (u - sin(x) / (4 * pi)), c * (2 / pi + u - 9 / (4 * pi) * sin(y))),
        np.where(early, c * (1 - cos(x)), c * (1 - 3 * cos(y))),
        np.where(early, 4 * pi * c * sin(x), 4 * pi * c * sin(y)),
        np.where(early, 16 * pi**2 * c * cos(x), 16 * pi**2 / 3 * c * cos(y)),
    )


@dataclass(frozen=True)
class ModifiedConstantVelocity(Law):
    """Modified constant velocity: the modified sine with a straight piece over the middle ``share`` of the time.

    With ``b = (1 - share)/2``, ``V = 1/(1 - b (3/2 - 2/pi))``, ``A = pi V/(2 b)``, ``y = 2 pi (u - b/4)/(3 b)``, on the
    first half, and on the second by ``s(u) = 1 - s(1 - u)``::

        0   <= u <= b/4    a = A sin(2 pi u/b)    v = V/4 [1 - cos(2 pi u/b)]
        b/4 <= u <= b      a = A cos(y)           v = V/4 [1 + 3 sin(y)]
        b   <= u <= 1/2    a = 0                  v = V

    A ``share`` of 1/2 is the law known as MCV50, 0 the modified sine.  It is at least 0 and below 1 (an array
    ``(p, 1)`` for a population: ``nan`` outside); ``ValueError`` else.

    >>> ModifiedConstantVelocity(0.6)(0.5).v.round(6)
    np.float64(1.208716)
    >>> ModifiedConstantVelocity(1)
    Traceback (most recent call last):
        ...
    ValueError: the share of constant velocity is 1; it must be at least 0 and below 1
    """

    share: Value = quantity("c", 0.5, 0, 0.9, "", "share of the time at constant velocity", at_least=0)

    name = "modified constant velocity"
    continuity = 2

    def __post_init__(self) -> None:
        what, must = "the share of constant velocity", "be at least 0 and below 1"
        object.__setattr__(self, "share", a_number(self.share, what, must, lambda c: (c >= 0) & (c < 1)))

    @property
    def _blend(self) -> tuple[Value, Value]:
        """The time ``b`` of each blend, and the velocity ``V`` between them."""
        b = (1 - self.share) / 2
        return b, 1 / (1 - b * (3 / 2 - 2 / pi))

    @property
    def kinks_move(self) -> bool:
        return True

    @property
    def kinks(self) -> tuple[Value, ...]:
        b, _ = self._blend
        return (b / 4, b, 1 - b, 1 - b / 4)

    def at(self, u: Array) -> Kinematics:
        return mirrored(u, self._first_half)

    def _first_half(self, u: Array) -> Kinematics:
        b, V = self._blend
        k = 2 * pi / b
        x, y, w = k * u, k / 3 * (u - b / 4), u - b / 4
        early = (u - sin(x) / k, 1 - cos(x), k * sin(x), k**2 * cos(x))
        late = (b / 4 - 1 / k + w + 9 / k * (1 - cos(y)), 1 + 3 * sin(y), k * cos(y), -(k**2) / 3 * sin(y))
        straight = (2 / V + 4 * (u - 1 / 2), 4 + 0 * y, 0 * y, 0 * y)
        zones = zip(early, late, straight, strict=True)
        return Kinematics(*(V / 4 * np.where(u < b / 4, f, np.where(u < b, g, h)) for f, g, h in zones))

    def peaks(self) -> Peaks:
        b, V = self._blend
        return Peaks(V, pi * V / (2 * b), pi**2 * V / b**2)
