"""A motion that was read from a table: what its rows say by themselves, and the curve through them."""

from __future__ import annotations

import numpy as np

from ..motion import TableMotion
from ..units import deg, factor
from .cam import MOTION
from .picture import Axes, Line, Picture, Points, View

NAMES = ("Displacement", "Velocity", "Acceleration", "Jerk")
BEYOND = 1.0
"""How far (shares of the curve's range) beyond the curve differences of rows are still shown: their noise goes on."""
MOST = 2000
"""So many rows are drawn at most: of more every second one, or third."""
FROM_A_JOINT = 1e-9
"""How far (rad) before and after a joint the two sides of a jump are drawn."""


def smoothing_view(k: int) -> View:
    """A view of the ``k``-th derivative before and after smoothing."""

    def view(motion: TableMotion) -> Picture:
        unit = motion.unit + ("" if k == 0 else "/rad" if k == 1 else f"/rad^{k}")
        edges = np.asarray(motion.edges, dtype=float)
        inner = edges[1:-1]
        x = np.sort(np.concatenate([np.linspace(0, edges[-1], 1441), inner - FROM_A_JOINT, inner + FROM_A_JOINT]))
        after = motion(x)[k] / factor(motion.unit)
        at, before = motion.row_differences(k)
        before = before / factor(motion.unit)
        far = (BEYOND + 0.05) * np.ptp(after)
        near = np.flatnonzero((before > after.min() - far) & (before < after.max() + far))
        near = near[:: -(-len(near) // MOST) or 1]
        bad = [row - 1 for row, _, _ in motion.bad_rows] if k == 0 and len(before) else []
        return Picture.of(
            Axes(title=NAMES[k], xlabel="cam angle  [deg]", ylabel=f"{'svaj'[k]}  [{unit}]"),
            Points("rows", at[near] / deg, before[near], role="ghost", size=3, label="rows" if k == 0 else ""),
            Line("curve", x / deg, after, role=MOTION[k], stroke="solid", label="smoothed" if k == 0 else ""),
            Points("bad rows", at[bad] / deg, before[bad], role="trouble", mark="cross", size=9),
        )

    view.__doc__ = f"{NAMES[k]} of a motion from a table: of its rows, by differences, and smoothed."
    view.__name__ = f"{NAMES[k].lower()}_smoothed"
    return view


TABLE_VIEWS = tuple(smoothing_view(k) for k in range(4))
"""A motion from a table before and after smoothing."""
