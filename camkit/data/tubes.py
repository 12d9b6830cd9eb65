"""Standard tubes: the outer and inner diameters that two standards print."""

from __future__ import annotations

import numpy as np

from ..quantities.kinds import refuse_arguments
from ..units import mm
from . import load

TUBE_FILES = {"EN 10210-2": "tubes_en10210", "GB/T 17395": "tubes_gbt17395"}
"""The series of standard tubes and their data files."""


def standard_tubes(series: str = "EN 10210-2") -> np.ndarray:
    """Outer and inner diameters of the standard tubes of a series, ``(n, 2)``, m.

    ``series``: ``"EN 10210-2"`` (hot finished, metric of inch sizes) or ``"GB/T 17395"`` (seamless); the data files
    beside this say where the sizes come from.

    >>> len(standard_tubes()), (standard_tubes()[0] / mm).round(1).tolist()
    (75, [88.9, 82.5])
    """
    refuse_arguments(standard_tubes, locals())
    if series not in TUBE_FILES:
        raise ValueError(f"the series {series!r} is not known; there are {', '.join(TUBE_FILES)}")
    walls = load(TUBE_FILES[series])["walls_by_outer_diameter"]
    return np.array([(float(D), round(float(D) - 2 * t, 6)) for D, row in walls.items() for t in row]) * mm
