"""Return springs: one without mass, and a helical one whose coils surge.

A uniform spring is a wave: held at its far end, it resists a motion of the frequency ``f`` of its near end with

    k X cot X,   X^2 = pi^2 (nu^2 - 2 i zeta nu),   nu = f / f_1

of which the first terms are the spring's rate ``k`` and a third of its mass.

The return spring that pushes is the load's, with its ``spring_rate`` and ``preload``; a `HelicalSpring` of a train adds
how it surges.  `camkit.dynamics.fitted` gives the load the rate of the spring; `spring_agreement` says how far they are
apart.

Source: Wahl, Mechanical Springs; Norton, Cam Design and Manufacturing Handbook (spring surge); Shigley, Mechanical
Engineering Design (helical springs).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..quantities import Design, Measure, quantity, unless
from ..quantities.kinds import numbers
from ..quantities.types import Array, Value
from ..units import mm


@dataclass(frozen=True)
class MasslessSpring(Design):
    """A spring whose coils all move at once: its mass, or a third of it, counts with the load's."""

    name: ClassVar[str] = "without mass"

    def share(self, frequency: Value) -> Value:
        """Dynamic stiffness over the rate at a ``frequency`` (Hz): 1."""
        return 1.0


@dataclass(frozen=True)
class HelicalSpring(Design):
    """A helical compression spring of round wire, with ground ends; its coils surge at their natural frequencies.

    >>> spring = HelicalSpring(wire=2 * mm, coil=16 * mm)
    >>> print(f"{spring.rate / 1e3:.2f} N/mm, {spring.surge_frequency:.1f} Hz, {1e3 * spring.active_mass / 3:.2f} g")
    6.45 N/mm, 465.7 Hz, 2.48 g

    Raises ``ValueError`` for a wire that is not thinner than the coil, and fewer coils in all than active ones.
    """

    wire: float = quantity("d", 4, 0.2, 20, "mm", "diameter of the wire", name="wire diameter")
    coil: float = quantity("D", 28, 2, 200, "mm", "mean diameter of the coil", name="coil diameter")
    active_coils: float = quantity("n_a", 6, 2, 20, "", "coils that bend")
    total_coils: float = quantity("n_t", 8, 2, 24, "", "coils in all")
    shear_modulus: float = quantity("G", 79.3, 20, 90, "GPa", "of the wire")
    density: float = quantity("rho", 7850, 1000, 9000, "kg/m^3", "of the wire")
    surge_damping: float = quantity(
        "zeta_s", 0.01, 0, 0.2, "", "of the surge, over critical", at_least=0, at_most=0.999
    )

    name: ClassVar[str] = "helical, with surge"

    def __post_init__(self) -> None:
        super().__post_init__()
        if refuse := unless(self.wire < self.coil):
            refuse(f"the wire is {self.wire / mm:.6g} mm thick; it must be below the coil's {self.coil / mm:.6g} mm")
        if refuse := unless(self.total_coils >= self.active_coils):
            refuse(f"the spring has {self.total_coils:.6g} coils; it must have its {self.active_coils:.6g} active ones")
        self._keep((self.wire < self.coil) & (self.total_coils >= self.active_coils))

    @property
    def rate(self) -> Value:
        """``k = G d^4 / (8 D^3 n_a)``, N/m."""
        return self.shear_modulus * self.wire**4 / (8 * self.coil**3 * self.active_coils)

    @property
    def active_mass(self) -> Value:
        """``rho pi^2 d^2 D n_a / 4``, kg; where its surge is not followed, a third of it moves with the load."""
        return self.density * np.pi**2 * self.wire**2 * self.coil * self.active_coils / 4

    @property
    def surge_frequency(self) -> Value:
        """``f_1 = sqrt(k / m) / 2``: first natural frequency of the spring between two ends at rest, Hz."""
        return np.sqrt(self.rate / self.active_mass) / 2

    @property
    def index(self) -> Value:
        """``C = D / d``."""
        return self.coil / self.wire

    @property
    def wahl_factor(self) -> Value:
        """``K_W = (4 C - 1) / (4 C - 4) + 0.615 / C``."""
        C = self.index
        return (4 * C - 1) / (4 * C - 4) + 0.615 / C

    @property
    def solid_length(self) -> Value:
        """``n_t d``: with all coils together, m."""
        return self.total_coils * self.wire

    def stress(self, force: Value) -> Value:
        """Shear stress on the inside of the coil, ``K_W 8 F D / (pi d^3)``, Pa, at a ``force`` (N)."""
        return self.wahl_factor * 8 * numbers(force, "the force of the spring") * self.coil / (np.pi * self.wire**3)

    def share(self, frequency: Value) -> Array:
        """Dynamic stiffness over the rate: ``X cot X``, complex, at a ``frequency`` (Hz)."""
        nu = frequency / self.surge_frequency
        X = np.pi * np.sqrt(nu**2 - 2j * self.surge_damping * nu)
        small = abs(X) < 1e-6
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(small, 1.0, X / np.tan(np.where(small, 1.0, X)))

    def dynamic_stiffness(self, frequency: Value) -> Array:
        """With what the near end resists a motion of a ``frequency`` (Hz), N/m: complex, its phase in front.

        >>> print(f"{HelicalSpring().dynamic_stiffness(0.25 * HelicalSpring().surge_frequency):.3f} N/m")
        15132.951+345.478j N/m
        """
        return self.rate * self.share(numbers(frequency, "the frequency"))


spring_agreement = Measure(
    "rate of the helical spring, of the load's",
    "%",
    lambda a: (a.response.train.spring.rate / a.response.driven.rate)[..., 0],
)
HelicalSpring.measures = (spring_agreement,)
