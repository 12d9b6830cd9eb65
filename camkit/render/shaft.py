"""Views of the shaft with two universal joints: the tube and its limits, the search, the joints over a turn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from matplotlib.axes import Axes

from ..machines.shaft import UniversalJointShaft
from ..quantities import quantities_of, value_of
from ..quantities.kinds import refuse_arguments
from ..units import mm, rpm
from ..views.shaft import section, utilisation
from .artists import (
    INK,
    ORANGE,
    PURPLE,
    WARNING,
    colours,
    line,
    new,
    text,
)
from .design_map import LABEL, design_plane

TUBE_COLOURS = (ORANGE, PURPLE)
POINT: Any = {"linestyle": "none", "marker": "o", "zorder": 7}


def _limit_names(shaft: Any) -> tuple[str, ...]:
    """The limits with what they allow, in the order of the study."""
    tau, theta = (quantities_of(shaft)[n].text(value_of(shaft, n)) for n in ("allowable_shear", "allowable_twist"))
    speed = f"{shaft.speed_margin * shaft.max_speed / rpm:.4g} rpm"
    return f"shear stress {tau}", f"twist {theta}", f"critical speed {speed}", "buckling"


def _millimetres(shaft: Any) -> list[list[float]]:
    return [[shaft.outer_diameter / mm], [shaft.inner_diameter / mm]]


def diameters(analysis: Any, ax: Axes) -> Axes:
    """The plane of both diameters: limits, area, the paper's bounds, standard tubes, the lightest tube and this one."""
    first = new(ax)
    sizes = analysis.sizes
    design_plane(sizes.plane, ax, _limit_names(analysis.shaft))
    for (series, tubes), colour in zip(sizes.standard_tubes.items(), TUBE_COLOURS, strict=True):
        line(
            ax,
            series,
            *(tubes.T / mm),
            linestyle="none",
            marker="s",
            markersize=4.5,
            color=colour,
            zorder=2,
            label=series,
        )
    line(ax, "closed form", *(sizes.lightest[:, None] / mm), linestyle="none", marker="+", markersize=15, color=INK,
         markeredgewidth=1.6, zorder=6.5, label="in closed form")  # fmt: skip
    broken = max(analysis.utilisation.values()) > 1
    point = line(
        ax,
        "this tube",
        *_millimetres(analysis.shaft),
        markersize=11,
        label="this tube",
        markeredgecolor="white",
        **POINT,
    )
    point.set_markerfacecolor(WARNING if broken else INK)
    if first:
        ax.set_title("Both diameters: limits, and area in mm²")
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.11), ncols=4, columnspacing=1.2, handletextpad=0.5)
    return ax


def on_the_plane(tubes: Mapping[str, UniversalJointShaft], window: Any) -> Callable[[Any, Axes], Axes]:
    """A view of part of the plane of both diameters (``window``, ``(2, 2)`` m) with named tubes on it."""

    refuse_arguments(on_the_plane, locals())

    def marked(analysis: Any, ax: Axes) -> Axes:
        design_plane(replace(analysis.sizes.plane, window=window), ax, _limit_names(analysis.shaft))
        for (name, shaft), colour in zip(tubes.items(), colours(len(tubes)), strict=True):
            (x,), (y,) = _millimetres(shaft)
            line(ax, name, [x], [y], markersize=12, color=colour, markeredgecolor="white", **POINT)
            text(ax, f"{name} name", x + 0.25, y, name, color=INK, va="center", zorder=8, bbox=LABEL["bbox"])
        ax.set_title("Both diameters: limits, and area in mm²")
        return ax

    return marked


SHAFT_VIEWS = (diameters, utilisation, section)
"""What a designer of the tube wants to see at once."""
