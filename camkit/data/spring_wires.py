"""Standard spring wires: diameters, tensile strength and the shear stress that a spring of them may have."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..quantities.types import Array
from ..units import MPa, mm
from . import load

DIAMETERS = "EN 10270-1 SM"
"""The wire whose diameters are those of all."""


class SpringWires(NamedTuple):
    """The sizes of a kind of wire, the thinnest first, ``(n,)``."""

    diameter: Array
    """m."""
    strength: Array
    """Least tensile strength, Pa."""
    shear: Array
    """Allowable shear stress at the largest force, Pa."""


def spring_wires(kind: str = "EN 10270-1 SM") -> SpringWires:
    """Standard wires of a kind, ``"EN 10270-1 SM"`` or ``"ASTM A228"``; the data file says where the numbers come from.

    >>> wires = spring_wires()
    >>> print(len(wires.diameter), wires.strength[wires.diameter == 4e-3] / 1e6)
    48 [1530.]

    Raises ``ValueError`` for a kind that is not there.
    """
    kinds = load("spring_wires")
    if not isinstance(kind, str) or kind not in kinds:
        raise ValueError(f"the spring wire {kind!r} is not known; there are {', '.join(kinds)}")
    row, table = kinds[kind], kinds[DIAMETERS]["strength_by_diameter"]
    d = np.array([float(size) for size in table if float(size) <= row.get("largest", np.inf)])
    strength = row["A"] / d ** row["m"] if "A" in row else np.array(list(table.values()), dtype=float)
    return SpringWires(d * mm, strength * MPa, row["shear_share"] * strength * MPa)
