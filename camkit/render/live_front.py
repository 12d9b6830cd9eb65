"""Views of a front that follows the sliders, and of how fast searches find one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..kinds import numbers, refuse_arguments, shown
from ..units import factor
from .artists import COLOURS, GREY, beside_title, frame, line, new
from .front import ShownFront, _name_axes, pareto, shown_objectives


@dataclass(frozen=True)
class LiveFront:
    """A front as it is now and as it was ``before``, its winner, and the objectives of the design in the sliders."""

    front: Any
    before: Any
    here: Any
    winner: int | None = None


def live_pareto(shown: LiveFront, ax: Axes) -> Axes:
    """The front as it is now, pale as it was before, its winner and where the design in the sliders stands."""
    first, objectives = new(ax), shown.front.study.minimise[:2]
    pareto(ShownFront(shown.front, winner=shown.winner), ax)
    here = [[m.sign * v / factor(m.unit)] for m, v in zip(objectives, shown.here, strict=False)]
    line(ax, "in the sliders", *here)
    pale: Any = {"color": GREY, "alpha": 0.35, "markersize": 6, "markeredgewidth": 0, "zorder": 1.5}
    line(ax, "before", *shown_objectives(shown.before), linestyle="none", marker="o", label="before", **pale)
    _name_axes(ax, objectives)
    if first:
        ax.set_title("What is possible")
        drawn = {str(artist.get_label()): artist for artist in ax.lines}
        beside_title(ax, [drawn[name] for name in ("before", "front", "in the sliders", "winner")])
        for handle in ax.get_legend().legend_handles:  # type: ignore[union-attr]
            handle.set_markersize(9)  # type: ignore[union-attr]
    return ax


def searches_compared(searches: Mapping[str, Any], ax: Axes) -> Axes:
    """What each search still lacks of the best hypervolume known, against the processor's time; both axes logarithmic.

    ``searches``: pairs of processor seconds and missing share of the hypervolume, ``(k, 2)``, by name.
    """
    refuse_arguments(searches_compared, locals())
    for name, points in searches.items():
        if np.shape(numbers(points, f"the points of {name}"))[1:] != (2,):
            raise ValueError(f"the points of {name} are {shown(points)}; they must be pairs of seconds and shares")
    first = new(ax)
    if first:
        frame(ax, "How fast a front is found", "processor time  [s]", "hypervolume still missing  [%]")
        ax.set(xscale="log", yscale="log")
    for i, (name, points) in enumerate(searches.items()):
        seconds, missing = zip(*points, strict=True)
        style: Any = {"color": COLOURS[i % len(COLOURS)], "label": name, "linewidth": 2.4}
        line(ax, name, seconds, [100 * share for share in missing], **style)
    if first:
        beside_title(ax)
    return ax
