"""How far a search has come: the best so far of a watched search, and the intervals that a bisection tried."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ..quantities import Measure
from ..search.protocol import Evaluated
from ..units import deg, factor
from .artists import BLUE, GREEN, GREY, INK, SKY, WARNING, Formula, area, beside_title, frame, line, new, plain

ROOM = 0.5
"""How far above the first design, as a share of it, designs that a search looked at are shown."""


def unit_text(unit: str) -> str:
    """A unit with its powers raised.

    >>> unit_text("N^0.5 mm^-0.5")
    'N$^{0.5}$ mm$^{-0.5}$'
    """
    return re.sub(r"\^(-?[\d.]+)", r"$^{\1}$", unit)


def axis_label(measure: Measure) -> Formula:
    """Name and unit of a measure in two lines, for a short axis."""
    unit = f"\n[{unit_text(measure.unit)}]" if measure.unit else ""
    return Formula(f"{plain(measure.name)}{unit}")


class ShownLooks(NamedTuple):
    """What a search looked at, and its objective."""

    measure: Measure
    looks: Sequence[Evaluated]


def best_so_far(shown: ShownLooks, ax: Axes) -> Axes:
    """The objective of what a search looked at, those that miss a limit pale; the line is the best so far."""
    first = new(ax)
    if first:
        frame(ax, "", "designs looked at", "")
        ax.set_xscale("log")
    ax.set_title("The search")
    ax.set_ylabel(axis_label(shown.measure))
    looked, f, kept = np.array(shown.looks, dtype=float).reshape(-1, 3).T
    value = shown.measure.sign * f / factor(shown.measure.unit)
    best = np.fmin.accumulate(np.where(kept > 0, f, np.nan)) if len(f) else f
    top = (1 + ROOM) * (best[np.isfinite(best)][0] if np.isfinite(best).any() else np.inf)
    for key, where, colour in (("misses a limit", kept == 0, SKY), ("keeps all limits", kept > 0, GREY)):
        seen = where & (f <= top)
        dots: Any = {"linestyle": "none", "marker": "o", "markersize": 4, "markeredgewidth": 0}
        line(ax, key, looked[seen], value[seen], color=colour, label=key, **dots)
    sense = shown.measure.sign / factor(shown.measure.unit)
    line(ax, "best", looked, sense * best, color=BLUE, linewidth=2.6, drawstyle="steps-post", label="best so far")
    if first:
        beside_title(ax)
    return ax


class ShownIntervals(NamedTuple):
    """The steps of a bisection of intervals so far, and the objective that is limited."""

    measure: Measure
    limit: float
    steps: Sequence[Any]


def intervals_tried(shown: ShownIntervals, ax: Axes) -> Axes:
    """The least objective at every interval that was tried; the answer lies in the band that is left."""
    first = new(ax)
    unit = factor(shown.measure.unit)
    if first:
        frame(ax, "", "interval  [deg]", "")
    ax.set_title("Best designs")
    ax.set_ylabel(axis_label(shown.measure))
    tried = np.array([(s.tried, s.optimum.f) for s in shown.steps if s.optimum.feasible]).reshape(-1, 2).T
    kept = tried[1] <= shown.limit
    marks: Any = {"linestyle": "none", "marker": "o", "markersize": 9, "zorder": 3}
    for key, where, colour in (("keeps the limit", kept, GREEN), ("does not", ~kept, WARNING)):
        line(ax, key, tried[0][where] / deg, tried[1][where] / unit, color=colour, label=key, **marks)
    ends = tried[0][[tried[0].argmin(), tried[0].argmax()]] / deg if tried.size else np.zeros(0)
    line(ax, "limit", ends, 0 * ends + shown.limit / unit, color=INK, linewidth=1.4, linestyle="--", label="limit")
    area(ax, "left", _band(shown), facecolor=GREEN, alpha=0.18, edgecolor="none", transform=ax.get_xaxis_transform())
    if first:
        beside_title(ax)
    return ax


def _band(shown: ShownIntervals) -> np.ndarray:
    """Between what is too short and what is long enough, over the height of the axes."""
    last = shown.steps[-1] if shown.steps else None
    low, high = (last.low / deg, last.high / deg) if last and last.low and last.best else (np.nan, np.nan)
    return np.array([[low, high, high, low], [0, 0, 1, 1]])
