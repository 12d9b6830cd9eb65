"""The lift of the polynomial valve cam as motion laws: its flank, its ramp, and either of them backwards.

Source: He Zhenjun, Li Xuefeng, Mech. Sci. Technol. Aerosp. Eng. 27(10) 2008, 1141-1144.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np

from ..motion import Kinematics, Law, Peaks, Poly345
from ..motion.law import law_peaks
from ..quantities import certain
from ..quantities.types import Array, Value

BLEND = 1 / 3
"""Share of a ramp over which the follower gains the seating velocity; the rest of it is straight."""


@dataclass(frozen=True)
class Flank(Law):
    """The polynomial ``s = 1 + sum c_i b^e_i`` of the opening flank, ``b = 1 - u``, for a lift of 1.

    ``exponents`` and ``coefficients`` in the order p, q, r, s, of which p is 2.
    """

    exponents: tuple[Value, ...]
    coefficients: tuple[Value, ...]

    name = "flank of a valve cam"
    continuity = 0

    @classmethod
    def of(cls, exponents: tuple[Value, ...], slope: Value) -> Flank:
        """Coefficients from ``s = 0, s' = slope, s'' = s''' = 0`` at the start, in closed form.

        The moments ``sum c_i = -1`` and ``sum c_i e_i^k = -slope``, k = 1, 2, 3, solved by Lagrange:
        ``c_i = [-E3 + slope (E2 - E1 + 1)] / prod (e_j - e_i)``, ``E`` the symmetric sums of the other three.
        """
        e, c = [x[()] for x in np.broadcast_arrays(*exponents, slope)[:4]], []
        with np.errstate(divide="ignore", invalid="ignore"):
            for i in range(4):
                x, y, z = (e[j] for j in range(4) if j != i)
                E1, E2, E3 = x + y + z, x * y + y * z + z * x, x * y * z
                c.append((-E3 + slope * (E2 - E1 + 1)) / ((x - e[i]) * (y - e[i]) * (z - e[i])))
        return cls(tuple(e), tuple(c))

    def at(self, u: Array) -> Kinematics:
        """Where an exponent lies below 3 the jerk at the end is infinite."""
        b = 1 - u
        with np.errstate(divide="ignore", invalid="ignore"):
            terms = [(c, e, c * b ** (e - 2)) for c, e in zip(self.coefficients, self.exponents, strict=True)]
            s = 1 + sum(t for _, _, t in terms) * b**2
            v = -sum(e * t for _, e, t in terms) * b
            a = sum(e * (e - 1) * t for _, e, t in terms)
            # the square term has no third derivative, not even at the nose, where b is 0
            j = -sum(e * (e - 1) * (e - 2) * c * b ** (e - 3) for c, e, _ in terms[1:])
        return Kinematics(s, v, cast(Array, a), cast(Array, j))

    def peaks(self) -> Peaks:
        return law_peaks(self)


@dataclass(frozen=True)
class Ramp(Law):
    """From rest to a steady velocity within the last ``share`` of the time.

    The velocity grows after the 3-4-5 polynomial and then stays, so that position, velocity, acceleration and jerk
    have no jump.
    """

    share: Value

    name = "ramp of a valve cam"
    continuity = 0

    @property
    def kinks(self) -> tuple[Value, ...]:
        """Where the ramp begins, unless it takes all the time, and where its velocity is steady."""
        begins = () if certain(self.share >= 1) else (1 - self.share,)
        return (*begins, 1 - self.share * (1 - BLEND))

    @property
    def kinks_move(self) -> bool:
        return True

    def at(self, u: Array) -> Kinematics:
        t = 1 + (u - 1) / self.share
        growing, straight = np.clip(t / BLEND, 0, 1), np.maximum(t - BLEND, 0)
        growth, steady = Poly345().at(growing), 1 / (1 - BLEND / 2)
        s = steady * (BLEND * growing**4 * (2.5 - 3 * growing + growing**2) + straight)
        v, a, j = (steady * x / BLEND**k / self.share ** (k + 1) for k, x in enumerate(growth[:3]))
        return Kinematics(s, v, cast(Array, a), cast(Array, j))

    def peaks(self) -> Peaks:
        return law_peaks(self)
