"""A sweep: how each limit is used along one quantity, with the range in which all are kept."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..quantities import label
from ..quantities.kinds import refuse_arguments
from ..study.study import Study
from ..study.sweep import Sweep
from .picture import Axes, Band, Line, Picture, Polygon, Text, View

LOWEST, HIGHEST = -100.0, 100.0
"""The window of spare and excess, percent of the limit."""


def limit_sweep(sweep: Sweep) -> Picture:
    """Distance to each limit (below 0: kept) along the free quantity; filled: every limit kept."""
    x, now = sweep.x / sweep.declared.factor, sweep.now / sweep.declared.factor
    told = label(sweep.name, sweep.declared)
    limits = [
        Line(f"limit {i}", x, np.clip(100 * excess, LOWEST, HIGHEST), role="series", index=i, label=measure.name)
        for i, (measure, excess) in enumerate(zip(sweep.measures, sweep.limits, strict=True))
    ]
    axes = Axes(
        title=f"How large must the {told} be?",
        xlabel=f"{told}  [{sweep.declared.unit}]",
        ylabel="distance to the limit  [%]",
        xlim=(x[0], x[-1]),
        ylim=(LOWEST, HIGHEST),
    )
    return Picture.of(
        axes,
        Polygon("feasible", *_bands(x, sweep.feasible), role="allowed", opacity=0.2),
        Band("zero", 0.0, 0.0),
        limits,
        Line("now", [now, now], [LOWEST, HIGHEST], stroke="dashed"),
        Text("now name", now, 0.97 * HIGHEST, " now", anchor="left top"),
    )


def _bands(x: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Outline of the bands in which ``kept`` holds, over the window's whole height, ``(2, m)``."""
    high = np.where(kept, HIGHEST, LOWEST)
    across = np.repeat(x, 2)[1:-1]
    top = np.repeat(np.minimum(high[1:], high[:-1]), 2)
    return np.array([[x[0], *across, x[-1]], [LOWEST, *top, LOWEST]])


def sweep_view(study: Study) -> View:
    """A view for a live panel: the sweep of ``study``, which has one free quantity, around the design shown.

    ``ValueError`` for an analysis of another kind of design.
    """
    refuse_arguments(sweep_view, locals())
    kind = type(study.start)

    def view(analysis: Any) -> Picture:
        design = next((held for held in vars(analysis).values() if isinstance(held, kind)), None)
        if design is None:
            raise ValueError(f"the sweep is of a {kind.__name__}; the analysis is of another design")
        return limit_sweep(Sweep(study.around(design)))

    return view
