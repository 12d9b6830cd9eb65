"""Surfaces by name, and the pressure that each bears.  Their file says where the numbers are from."""

from __future__ import annotations

from math import log
from typing import NamedTuple

from ..units import MPa, psi
from . import load

_FILE = load("surface_strengths")
_STEEL = _FILE["by_hardness"]


class Surface(NamedTuple):
    """The pressure that a surface bears for so many loadings, and the exponent of ``N = N_ref (S / p_0)^e``, SI."""

    pressure: float
    cycles: float
    exponent: float


def _between(points: list[list[float]]) -> Surface:
    """Through two points of a straight line in logarithms; the pressure is that of the first."""
    (S, N), (less, more) = points
    return Surface(S * 1e3 * psi, N, log(more / N) / log(S / less))


def steel_of(hardness: float) -> Surface:
    """Of steel of a Brinell hardness, HB.

    >>> steel = steel_of(300)
    >>> print(f"{steel.pressure / 1e6:.0f} MPa for {steel.cycles:.0e} loadings, exponent {steel.exponent:.2f}")
    758 MPa for 1e+08 loadings, exponent 17.86
    """
    slope, less = _STEEL["MPa"]
    up, down = _STEEL["exponent"]
    return Surface((slope * hardness + less) * MPa, _STEEL["cycles"], up / down)


SURFACES = {row["name"]: _between(row["points_ksi"]) for row in _FILE["surfaces"]} | {
    f"steel, {hardness} HB": steel_of(hardness) for hardness in _STEEL["hardness_HB"]
}
"""Of `surface_strengths.json`, by name."""
