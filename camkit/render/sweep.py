"""A sweep: how each limit is used along one quantity, with the range in which all are kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..kinds import refuse_arguments
from ..quantities import words
from ..study.study import Study, made_study
from ..study.sweep import Sweep
from .artists import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, area, colours, frame, line, new, text

LIMIT_COLOURS = (BLUE, ORANGE, PURPLE, SKY)
LOWEST, HIGHEST = -100.0, 100.0
"""The window of spare and excess, percent of the limit."""


def limit_sweep(sweep: Sweep, ax: Axes) -> Axes:
    """Excess over each limit (below 0: kept) along the free quantity; green: every limit kept."""
    x = sweep.x / sweep.declared.factor
    first = new(ax)
    if first:
        frame(
            ax,
            f"How large must the {words(sweep.name)} be?",
            f"{words(sweep.name)}  [{sweep.declared.unit}]",
            "excess over the limit  [%]",
        )
        ax.axhline(0, color=INK, linewidth=1)
        ax.set(xlim=x[[0, -1]], ylim=(LOWEST, HIGHEST))
    area(ax, "feasible", _bands(x, sweep.feasible), facecolor=GREEN, alpha=0.2, edgecolor="none", zorder=0.5)
    told = colours(len(sweep.measures), LIMIT_COLOURS)
    for colour, measure, excess in zip(told, sweep.measures, sweep.limits, strict=True):
        line(ax, measure.name, x, np.clip(100 * excess, LOWEST, HIGHEST), color=colour, label=measure.name)
    now = sweep.now / sweep.declared.factor
    line(ax, "now", [now, now], [LOWEST, HIGHEST], color=INK, linewidth=1.5, linestyle=(0, (4, 3)))
    text(ax, "now name", now, 0.97 * HIGHEST, " now", va="top", color=INK)
    if first:
        ax.legend(loc="upper right")
    return ax


def _bands(x: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Outline of the bands in which ``kept`` holds, over the window's whole height, ``(2, m)``."""
    high = np.where(kept, HIGHEST, LOWEST)
    across = np.repeat(x, 2)[1:-1]
    top = np.repeat(np.minimum(high[1:], high[:-1]), 2)
    return np.array([[x[0], *across, x[-1]], [LOWEST, *top, LOWEST]])


def sweep_view(make: Callable[[Any], Study]) -> Callable[..., Axes]:
    """A view for a live panel: the sweep of ``make(cam)``, a study with one free quantity around the design shown."""

    refuse_arguments(sweep_view, locals())

    def view(analysis: Any, ax: Axes) -> Axes:
        return limit_sweep(Sweep(made_study(make, analysis.cam)), ax)

    return view
