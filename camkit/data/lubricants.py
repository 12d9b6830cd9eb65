"""Lubricants by name: mineral oils of the usual grades, each at one temperature, with the source of their numbers."""

from __future__ import annotations

from math import log10
from typing import NamedTuple

from ..units import kg, m, mm
from . import load


class Oil(NamedTuple):
    """An oil at the pressure of the air, SI."""

    viscosity: float
    """``eta``, Pa s."""
    pressure_viscosity: float
    """``alpha`` of ``eta exp(alpha p)``, 1/Pa."""


def pressure_viscosity(viscosity: float) -> float:
    """``(0.6 + 0.965 lg eta) 1e-8 /Pa`` of a mineral oil, ``eta`` in mPa s: Wooster's relation, a first estimate.

    >>> print(f"{pressure_viscosity(0.01):.3e} 1/Pa")
    1.565e-08 1/Pa
    """
    return (0.6 + 0.965 * log10(1e3 * viscosity)) * 1e-8


def _oil(kinematic: float, density: float) -> Oil:
    viscosity = kinematic * mm**2 * density * kg / m**3
    return Oil(viscosity, pressure_viscosity(viscosity))


LUBRICANTS = {row["name"]: _oil(row["kinematic"], row["density"]) for row in load("lubricants")["oils"]}
"""Of `lubricants.json`, by name."""
