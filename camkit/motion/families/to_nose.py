"""Laws from rest to a nose, where the follower turns back at once: double harmonic, eighth-order polynomial.

At the nose the acceleration is not 0.  The return that follows begins there with the same acceleration if it has the
mirror image of the law, ``Mirrored(DoubleHarmonic())``:

>>> from camkit.motion import Dwell, Mirrored, MotionProgram, Return, Rise
>>> from camkit.units import deg
>>> rise, back = Rise(90 * deg, 0.02, DoubleHarmonic()), Return(90 * deg, 0.02, Mirrored(DoubleHarmonic()))
>>> [joint.order for joint in MotionProgram((Dwell(180 * deg), rise, back)).transitions()]
[None, None, None]

Peaks count [0, 1] only, as those of all laws that are to be joined to a moving neighbour.

Source: Rothbart, Cams (double harmonic); Kloomok and Muffley (eighth-order polynomial), as in Shigley and Uicker,
Theory of Machines and Mechanisms.
"""

from __future__ import annotations

from dataclasses import dataclass

from numpy import cos, pi, sin

from ...quantities.types import Array
from ..law import Kinematics, Law, Peaks, law_peaks, polynomial

EIGHTH = (0.0, 0.0, 0.0, 6.09755, 0.0, -20.78040, 26.73155, -13.60965, 2.56095)
"""What stands before each power of ``u``."""


@dataclass(frozen=True)
class DoubleHarmonic(Law):
    """Double harmonic: ``s = [1 - cos(pi u) - (1 - cos(2 pi u)) / 4] / 2``, from rest to a nose with ``a = -pi^2``.

    >>> DoubleHarmonic()([0.25, 0.5, 0.75]).s.round(6)
    array([0.021447, 0.25    , 0.728553])
    """

    name = "double harmonic"
    continuity = 1

    def at(self, u: Array) -> Kinematics:
        x, k = pi * u, pi / 2
        return Kinematics(
            (1 - cos(x) - (1 - cos(2 * x)) / 4) / 2,
            k * (sin(x) - sin(2 * x) / 2),
            k * pi * (cos(x) - cos(2 * x)),
            k * pi**2 * (2 * sin(2 * x) - sin(x)),
        )

    def peaks(self) -> Peaks:
        c = (1 - 129**0.5) / 16  # cos(pi u) where the derivative of the jerk, 4 cos(2 pi u) - cos(pi u), is 0
        return Peaks(3**1.5 * pi / 8, pi**2, pi**3 / 2 * (1 - c**2) ** 0.5 * (1 - 4 * c))


@dataclass(frozen=True)
class EighthOrder(Law):
    """Eighth-order polynomial of Kloomok and Muffley, from rest to a nose with ``a = -5.2683`` and no jerk::

        s = 6.09755 u^3 - 20.78040 u^5 + 26.73155 u^6 - 13.60965 u^7 + 2.56095 u^8

    >>> EighthOrder()([0.25, 0.5, 0.75]).s.round(6)
    array([0.080716, 0.434165, 0.838474])
    """

    name = "eighth-order polynomial"
    continuity = 1

    def at(self, u: Array) -> Kinematics:
        return polynomial(EIGHTH, u)

    def peaks(self) -> Peaks:
        return law_peaks(self)
