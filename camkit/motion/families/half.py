"""Half laws: from rest to a velocity, and from a velocity to rest, to be joined to constant velocity.

A half law of lift ``h`` over ``beta`` ends (or begins) with the velocity ``V h / beta``, where ``V`` is 2
for the half cycloidal and ``pi/2`` for the half harmonic laws; a straight piece joins smoothly if its own
lift per angle is the same.

>>> from camkit.motion import Dwell, FreePolynomial, MotionProgram, Rise
>>> straight = FreePolynomial(start=(0,), end=(1,))
>>> start, end = Rise(1, 1, HalfCycloidalStart()), Rise(1, 1, HalfCycloidalEnd())
>>> program = MotionProgram((Dwell(1), start, Rise(1, 2, straight), end))
>>> [joint.order for joint in program.transitions()]
[3, 3, 3]

Both ends count for ``continuity``, so it is 0: joined to a dwell, the moving end breaks the velocity.

Source: Norton, Cam Design and Manufacturing Handbook; VDI 2143 part 1; half curves of Kloomok and Muffley.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy import cos, pi, sin

from ...quantities.types import Array
from ..law import Kinematics, Law, Peaks


@dataclass(frozen=True)
class HalfCycloidalStart(Law):
    """From rest to the velocity 2: ``s = u - sin(pi u) / pi``; the acceleration is 0 at both ends.

    >>> HalfCycloidalStart()(1.0).v
    np.float64(2.0)
    """

    name = "half cycloidal from rest"
    continuity = 0

    def at(self, u: Array) -> Kinematics:
        x = pi * u
        return Kinematics(u - sin(x) / pi, 1 - cos(x), pi * sin(x), pi**2 * cos(x))

    def peaks(self) -> Peaks:
        return Peaks(2.0, pi, pi**2)


@dataclass(frozen=True)
class HalfCycloidalEnd(Law):
    """From the velocity 2 to rest: ``s = u + sin(pi u) / pi``; the acceleration is 0 at both ends.

    >>> HalfCycloidalEnd()(0.0).v
    np.float64(2.0)
    """

    name = "half cycloidal to rest"
    continuity = 0

    def at(self, u: Array) -> Kinematics:
        x = pi * u
        return Kinematics(u + sin(x) / pi, 1 + cos(x), -pi * sin(x), -(pi**2) * cos(x))

    def peaks(self) -> Peaks:
        return Peaks(2.0, pi, pi**2)


@dataclass(frozen=True)
class HalfHarmonicStart(Law):
    """From rest to the velocity pi/2: ``s = 1 - cos(pi u / 2)``; the acceleration begins at pi^2/4 and ends at 0.

    >>> HalfHarmonicStart()(1.0).v.round(6)
    np.float64(1.570796)
    """

    name = "half harmonic from rest"
    continuity = 0

    def at(self, u: Array) -> Kinematics:
        k = pi / 2
        return Kinematics(1 - cos(k * u), k * sin(k * u), k**2 * cos(k * u), -(k**3) * sin(k * u))

    def peaks(self) -> Peaks:
        return Peaks(pi / 2, pi**2 / 4, pi**3 / 8)


@dataclass(frozen=True)
class HalfHarmonicEnd(Law):
    """From the velocity pi/2 to rest: ``s = sin(pi u / 2)``; the acceleration begins at 0 and ends at -pi^2/4.

    >>> HalfHarmonicEnd()(0.0).v.round(6)
    np.float64(1.570796)
    """

    name = "half harmonic to rest"
    continuity = 0

    def at(self, u: Array) -> Kinematics:
        k = pi / 2
        return Kinematics(sin(k * u), k * cos(k * u), -(k**2) * sin(k * u), -(k**3) * cos(k * u))

    def peaks(self) -> Peaks:
        return Peaks(pi / 2, pi**2 / 4, pi**3 / 8)
