"""The film of lubricant between cam and follower: elastohydrodynamic, along a line.

    h = 2.65 R (eta U / (E' R))^0.7 (alpha E')^0.54 (F / (b E' R))^-0.13

``E' = 2 E*``, ``1/R`` the curvature of both surfaces together, ``h`` the least thickness of the film.

Source: Dowson, Higginson, Elasto-hydrodynamic Lubrication (1966); Stolarski, Tribology in Machine Design (6.7).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..data.lubricants import LUBRICANTS
from ..quantities import Design, choice, quantity
from ..quantities.kinds import numbers, refuse_arguments, refuse_shapes
from ..quantities.types import Array, Value

OWN = "own numbers"


@dataclass(frozen=True)
class Lubricant(Design):
    """An oil at the temperature at which it enters the contact: one of `LUBRICANTS` by its name, or its numbers.

    >>> thick = Lubricant(oil="ISO VG 68 at 40 degC")
    >>> print(f"{1e3 * thick.now[0]:.1f} mPa s, {1e9 * thick.now[1]:.1f} 1/GPa")
    59.2 mPa s, 23.1 1/GPa
    """

    viscosity: float = quantity("eta", 10, 1, 500, "mPa s", "dynamic viscosity at the pressure of the air")
    pressure_viscosity: float = quantity(
        "alpha", 20, 5, 40, "1/GPa", "by which the viscosity grows with the pressure", name="pressure-viscosity"
    )
    oil: str = choice("L", OWN, {OWN: OWN, **{name: name for name in LUBRICANTS}}, "oil and temperature")

    def following(self) -> dict[str, str]:
        """What an oil of the menu gives."""
        given = ("viscosity", "pressure_viscosity") if self.oil != OWN else ()
        return {name: "it is that of the oil" for name in given}

    @property
    def now(self) -> tuple[Value, Value]:
        """``eta`` (Pa s) and ``alpha`` (1/Pa)."""
        oil = LUBRICANTS.get(self.oil)
        return (oil.viscosity, oil.pressure_viscosity) if oil else (self.viscosity, self.pressure_viscosity)


def film_thickness(
    lubricant: Lubricant, velocity: Value, force_per_length: Value, curvature: Value, modulus: Value
) -> Array:
    """Least thickness of the film, element by element, m.

    ``velocity``: ``U``, of entrainment, m/s, of which the size counts; ``force_per_length``: ``F / b``, N/m;
    ``curvature``: ``1/R``, of both surfaces together, 1/m; ``modulus``: ``E*`` of `contact_modulus`, Pa.

    0 where ``U`` is 0, ``inf`` where nothing presses; ``nan`` where the surfaces do not fit or are pulled.

    >>> film = film_thickness(Lubricant(), velocity=2.5, force_per_length=5e4, curvature=1 / 0.025, modulus=115.4e9)
    >>> print(f"{film * 1e6:.3f} um")
    0.319 um
    """
    refuse_arguments(film_thickness, locals())
    U, w = abs(numbers(velocity, "the velocities")), numbers(force_per_length, "the forces per length")
    kappa, E = numbers(curvature, "the curvatures"), 2 * numbers(modulus, "the moduli")
    refuse_shapes({"velocities": U, "forces per length": w, "curvatures": kappa, "moduli": E})
    return _thickness(lubricant, U, w, kappa, E)


def _thickness(lubricant: Lubricant, U: Array, w: Array, kappa: Array, E: Array) -> Array:
    eta, alpha = lubricant.now
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        fits = np.where((w >= 0) & (kappa > 0) & (E > 0), kappa, np.nan)
        made = 2.65 * (eta / E) ** 0.7 * (alpha * E) ** 0.54 * (w / E) ** -0.13 * fits**-0.43
        return np.where(U > 0, made * U**0.7, np.where(U == 0, 0.0 * fits, np.nan))[()]
