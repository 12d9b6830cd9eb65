"""Laws of one sine or cosine: simple harmonic and cycloidal (sine acceleration).

Source: Norton, Cam Design and Manufacturing Handbook (double-dwell cam curves); VDI 2143 part 1.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy import cos, inf, pi, sin

from ...quantities.types import Array
from ..law import Kinematics, Law, Peaks


@dataclass(frozen=True)
class SimpleHarmonic(Law):
    """Simple harmonic (cosine acceleration): ``s = (1 - cos(pi u)) / 2``.

    The acceleration jumps where the law meets a dwell, so the jerk is infinite there.

    >>> SimpleHarmonic()(0.5).s.round(6)
    np.float64(0.5)
    """

    name = "simple harmonic"
    continuity = 1

    def at(self, u: Array) -> Kinematics:
        x = pi * u
        return Kinematics((1 - cos(x)) / 2, pi / 2 * sin(x), pi**2 / 2 * cos(x), -(pi**3) / 2 * sin(x))

    def peaks(self) -> Peaks:
        return Peaks(pi / 2, pi**2 / 2, inf)


@dataclass(frozen=True)
class Cycloidal(Law):
    """Cycloidal (sine acceleration): ``s = u - sin(2 pi u) / (2 pi)``.

    >>> s, v, a, j = Cycloidal()([0.0, 0.5, 1.0])
    >>> s.round(6), v.round(6)
    (array([0. , 0.5, 1. ]), array([0., 2., 0.]))
    """

    name = "cycloidal"
    continuity = 2

    def at(self, u: Array) -> Kinematics:
        x = 2 * pi * u
        return Kinematics(u - sin(x) / (2 * pi), 1 - cos(x), 2 * pi * sin(x), 4 * pi**2 * cos(x))

    def peaks(self) -> Peaks:
        return Peaks(2.0, 2 * pi, 4 * pi**2)
