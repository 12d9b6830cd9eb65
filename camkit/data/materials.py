"""Materials by name, with the source of each number."""

from __future__ import annotations

from dataclasses import dataclass

from ..units import GPa, MPa, kg, m
from . import load


@dataclass(frozen=True)
class Material:
    """What a part is made of, SI."""

    name: str
    elastic_modulus: float
    shear_modulus: float
    density: float
    yield_strength: float
    source: str

    @property
    def poisson(self) -> float:
        """Poisson's ratio of an isotropic body, ``E / 2 G - 1``."""
        return self.elastic_modulus / (2 * self.shear_modulus) - 1

    @property
    def allowable_shear(self) -> float:
        """Yield in shear (von Mises, ``sigma / sqrt(3)``) over the safety that a paper's 98 MPa give 20Cr, Pa."""
        return 98 * MPa * self.yield_strength / (540 * MPa)


MATERIALS = {
    row["name"]: Material(
        row["name"],
        row["elastic_modulus"] * GPa,
        row["shear_modulus"] * GPa,
        row["density"] * kg / m**3,
        row["yield_strength"] * MPa,
        row["source"],
    )
    for row in load("materials")["materials"]
}
"""Of `materials.json`, by name."""
