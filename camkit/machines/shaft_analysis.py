"""What follows from the tube between two universal joints: stresses, twist, critical speed, and what they use up.

Source: Lyu, Du, Li, Yuan, Luo, Guangdong University of Technology, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..quantities import declarations, refuse_population
from ..quantities.types import Array

if TYPE_CHECKING:
    from .shaft import UniversalJointShaft


def nearest_of(here: np.ndarray, tubes: np.ndarray) -> np.ndarray:
    """That of some tubes ``(n, 2)`` whose diameters lie nearest to those ``here``."""
    return np.asarray(tubes[np.argmin(np.hypot(*(tubes - here).T))])


@dataclass(frozen=True)
class ShaftAnalysis:
    """What follows from a `UniversalJointShaft`: numbers for one design, ``(p, 1)`` for ``p`` designs.

    ``nan`` where a member of a population cannot be built.
    """

    offers: ClassVar[tuple[str, ...]] = ("sizes", "utilisation", "rings")
    """The shapes and curves that are shown of it where nobody chooses, in this order."""

    shaft: UniversalJointShaft

    @cached_property
    def _outer(self) -> Array:
        """``D``; ``nan`` where any quantity of the shaft is."""
        numbers = sum(getattr(self.shaft, name) for name in declarations(self.shaft))
        return np.where(np.isfinite(numbers), self.shaft.outer_diameter, np.nan)[()]

    @cached_property
    def area(self) -> Array:
        """``A = pi (D^2 - d^2) / 4``, m^2."""
        return np.pi * (self._outer**2 - self.shaft.inner_diameter**2) / 4

    @cached_property
    def polar_moment(self) -> Array:
        """``I_p = pi (D^4 - d^4) / 32``, m^4; the second moment of area ``I`` is half of it."""
        return np.pi * (self._outer**4 - self.shaft.inner_diameter**4) / 32

    @cached_property
    def mass(self) -> Array:
        """Of the tube between the joints, kg."""
        return self.shaft.density * self.area * self.shaft.length

    @cached_property
    def inertia(self) -> Array:
        """About the tube's own axis, ``rho L I_p``, kg m^2."""
        return self.shaft.density * self.shaft.length * self.polar_moment

    @cached_property
    def tube_torque(self) -> Array:
        """The largest in the tube, ``M / cos(beta)``, N m (see `UniversalJointShaft.tube_torque`)."""
        return self.shaft.tube_torque + 0.0 * self._outer

    @cached_property
    def shear_stress(self) -> Array:
        """At the tube's surface, ``tau = M_t / W_n``, ``W_n = pi D^3 [1 - (d / D)^4] / 16 = 2 I_p / D``, Pa.

        ``M_t`` is the `tube_torque`; no bending couple makes more of it.
        """
        return self.tube_torque * self._outer / (2 * self.polar_moment)

    @cached_property
    def twist(self) -> Array:
        """Over the length at the largest torque, ``theta = M_t / (G I_p)``, rad/m."""
        return self.tube_torque / (self.shaft.shear_modulus * self.polar_moment)

    @cached_property
    def critical_speed(self) -> Array:
        """``sqrt(g / y)``, ``y = 5 Q L^3 / (384 E I)`` the sag of the tube under its weight ``Q``, rad/s.

        The paper prints 348.  Gravity cancels: ``sqrt(76.8 E I / (rho A L^4))``, 11 % below the exact
        ``pi^2 sqrt(E I / (rho A L^4))`` of a tube on two supports, so the paper's limit is a cautious one.
        """
        s = self.shaft
        return np.sqrt(76.8 * s.elastic_modulus * self.polar_moment / 2 / (s.density * self.area * s.length**4))

    @cached_property
    def buckling_stress(self) -> Array:
        """Shear stress at which a long tube's wall buckles, ``tau_c = 0.292 E ((D - d) / D)^1.5``, Pa.

        ``0.272 E (t / r)^1.5 / (1 - nu^2)^0.75`` with ``nu = 0.3``, wall ``t`` and outer radius ``r``.
        """
        return 0.292 * self.shaft.elastic_modulus * ((self._outer - self.shaft.inner_diameter) / self._outer) ** 1.5

    @cached_property
    def utilisation(self) -> dict[str, Array]:
        """Every limit's load over what is allowed, by name; above 1 the limit is broken."""
        s = self.shaft
        return {
            "shear stress": self.shear_stress / s.allowable_shear,
            "twist": self.twist / s.allowable_twist,
            "critical speed": s.speed_margin * s.max_speed / self.critical_speed,
            "buckling": self.shear_stress / self.buckling_stress,
        }

    @property
    def sizes(self) -> Any:
        """The plane of sizes that is shown of it, which all shafts share that differ in their diameters alone."""
        return self.shaft.sizes

    @property
    def here(self) -> np.ndarray:
        """Where the tube is on the plane of its sizes, ``(2,)`` m."""
        refuse_population(self.shaft, "the shaft whose place is wanted")
        return np.array([self.shaft.outer_diameter, self.shaft.inner_diameter])

    @property
    def rings(self) -> dict[str, np.ndarray]:
        """Both diameters by name, m: of the tube, of the nearest of each series that keeps every limit, or ``nan``."""
        nearest = {
            f"nearest {series}": nearest_of(self.here, tubes) if len(tubes) else np.full(2, np.nan)
            for series, tubes in self.sizes.holding.items()
        }
        return {"this tube": self.here, **nearest}
