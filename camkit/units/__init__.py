"""Units are plain numbers to multiply by: ``50 * mm``, ``22 * deg``, ``1800 * rpm``.

Inside camkit everything is SI and radians.  A unit appears in two places only: where a user types a
number, and where a number is shown.

>>> round(50 * mm, 3), round(180 * deg, 6)
(0.05, 3.141593)
>>> in_unit(0.05, "mm")
50.0
"""

from math import pi
from typing import Any

m = 1.0
cm = 1e-2
mm = 1e-3
um = 1e-6
rad = 1.0
deg = pi / 180
s = 1.0
rpm = 2 * pi / 60
kg = 1.0
N = 1.0
kN = 1e3
Pa = 1.0
MPa = 1e6
GPa = 1e9
W = 1.0
kW = 1e3
percent = 1e-2

FACTORS = {
    "": 1.0,
    "%": percent,
    "m": m,
    "cm": cm,
    "mm": mm,
    "um": um,
    "mm/rad": mm,
    "mm/rad^2": mm,
    "mm/rad^3": mm,
    "1/rad": 1 / rad,
    "1/rad^2": 1 / rad**2,
    "1/m": 1 / m,
    "1/mm": 1 / mm,
    "mm^2": mm**2,
    "rad": rad,
    "deg": deg,
    "deg/m": deg / m,
    "s": s,
    "rpm": rpm,
    "rad/s": rad / s,
    "deg/s": deg / s,
    "m/s": m / s,
    "m/s^2": m / s**2,
    "rad/s^2": rad / s**2,
    "kg": kg,
    "kg/m^3": kg / m**3,
    "kg m^2": kg * m**2,
    "N": N,
    "kN": kN,
    "N/m": N / m,
    "N/mm": N / mm,
    "N^0.5 mm^-0.5": (N / mm) ** 0.5,
    "N^1.5 mm^-0.5": N**1.5 / mm**0.5,
    "N^0.5 cm^-0.5": (N / cm) ** 0.5,
    "N^1.5 cm^-0.5": N**1.5 / cm**0.5,
    "N m": N * m,
    "N mm": N * mm,
    "N m/rad": N * m / rad,
    "Pa": Pa,
    "MPa": MPa,
    "GPa": GPa,
    "W": W,
    "kW": kW,
}
"""The factor from a unit's printed name to SI."""


def factor(unit: str) -> float:
    """The SI value of one ``unit``; a ``ValueError`` names the units there are."""
    if not isinstance(unit, str):
        raise ValueError(f"the unit must be a text; there are {', '.join(filter(None, FACTORS))}")
    if unit not in FACTORS:
        raise ValueError(f"the unit {unit!r} is not known; there are {', '.join(filter(None, FACTORS))}")
    return FACTORS[unit]


def in_unit(value: Any, unit: str) -> Any:
    """``value`` (SI, number or array) expressed in ``unit``, free of the last digit's noise for a number."""
    si = factor(unit)
    try:
        shown = value / si
    except (TypeError, OverflowError):
        raise ValueError(f"what is to be shown in {unit} is no number that a computer can hold") from None
    return float(f"{shown:.15g}") if isinstance(shown, float) else shown
