"""Views of the shaft with two universal joints: the tube and its limits, the search, the joints over a turn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ..geometry import circle
from ..kinds import refuse_arguments
from ..machines.shaft import UniversalJointShaft
from ..quantities import Measure, quantities_of, value_of, words
from ..units import factor, mm, percent, rpm
from .artists import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    SKY,
    WARNING,
    area,
    beside_title,
    colours,
    frame,
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


def utilisation(analysis: Any, ax: Axes) -> Axes:
    """What each limit is used up by, as bars; the limit is at 100 %."""
    used = analysis.utilisation
    if new(ax):
        frame(ax, "Limits used up", "utilisation  [%]", "")
        ax.set_yticks([-i for i in range(len(used))], list(used))
        ax.set(xlim=(0, 162), ylim=(0.6 - len(used), 0.6))
        ax.axvline(100, color=WARNING, linewidth=1.6)
        ax.grid(axis="y", visible=False)
    for i, (name, use) in enumerate(used.items()):
        bar = line(ax, name, [0, min(use / percent, 125)], [-i, -i], linewidth=17, solid_capstyle="butt")
        bar.set_color(WARNING if use > 1 else BLUE)
        text(ax, f"{name} value", 161, -i, f"{use / percent:.1f} %", ha="right", va="center", color=INK)
    return ax


def section(analysis: Any, ax: Axes) -> Axes:
    """The tube's section to scale, with the nearest standard tube of each series that keeps every limit."""
    shaft = analysis.shaft
    D, d = shaft.outer_diameter / mm, shaft.inner_diameter / mm
    first = new(ax)
    if first:
        frame(ax, "Section, to scale", "[mm]", "[mm]")
        ax.set_aspect("equal")
    reach = max(82.0, 0.58 * D)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    outer, inner = circle((0, 0), D / 2), circle((0, 0), d / 2)
    area(ax, "wall", np.hstack([outer, inner[:, ::-1]]), facecolor=SKY, alpha=0.55, edgecolor="none", zorder=2)
    for key, edge in (("outside", outer), ("inside", inner)):
        line(ax, key, *edge, color=BLUE, linewidth=2, zorder=3)
    nearest = analysis.sizes.nearest(shaft)
    for (series, tube), colour, y in zip(nearest.items(), TUBE_COLOURS, (-0.24, -0.33), strict=True):
        _standard(ax, series, tube, colour, y)
    text(
        ax,
        "sizes",
        0,
        0,
        f"D = {D:.5g} mm\nd = {d:.5g} mm\nwall {(D - d) / 2:.4g} mm",
        ha="center",
        va="center",
        color=INK,
    )
    return ax


def _standard(ax: Axes, series: str, tube: Any, colour: str, y: float) -> None:
    """The outlines of a standard tube, its size told at the height ``y`` below the axes; ``None``: that none holds."""
    both, words = np.full((2, 1), np.nan), f"no {series} tube keeps every limit"
    if tube is not None:
        D, d = tube.outer_diameter / mm, tube.inner_diameter / mm
        both = np.hstack([circle((0, 0), D / 2), [[np.nan], [np.nan]], circle((0, 0), d / 2)])
        words = f"nearest {series}: {D:.5g} × {(D - d) / 2:.4g} mm"
    line(ax, series, *both, color=colour, linewidth=1.3, linestyle="--", zorder=4)
    below: Any = {"transform": ax.transAxes, "clip_on": False}
    line(ax, f"{series} sample", [0.0, 0.10], [y, y], color=colour, linewidth=1.6, linestyle="--", **below)
    text(ax, f"{series} size", 0.13, y, words, va="center", color=INK, fontsize=9.5, **below)


SHAFT_VIEWS = (diameters, utilisation, section)
"""What a designer of the tube wants to see at once."""


def candidates(name: str | None = None, optimum: float | None = None) -> Callable[[Any, Axes], Axes]:
    """A view of a finished competitive search: where its candidates stood in each cycle, the paper's Fig. 2.

    ``name`` is a free quantity, or the objective if none is said; ``optimum`` (SI) is drawn if it is known.
    """

    refuse_arguments(candidates, locals())

    def paths(search: Any, ax: Axes) -> Axes:
        study, (x, f) = search.problem.study, search.paths
        what = _free(study, name) if name else _objective(study)
        values = (x[..., list(study.free).index(name)] if name else f) / what.factor
        if new(ax):
            frame(ax, what.title, "cycle", what.label)
        for k in range(values.shape[1])[::-1]:
            style: Any = {"color": BLUE, "linewidth": 2.2, "zorder": 4} if k == 0 else {"color": GREY, "linewidth": 0.9}
            line(
                ax,
                f"candidate {k}",
                np.arange(len(values)),
                values[:, k],
                label=("best", "others", "_", "_")[min(k, 3)],
                **style,
            )
        if optimum is not None:
            known = [optimum / what.factor] * 2
            line(
                ax, "optimum", [0, len(values) - 1], known, color=GREEN, linestyle="--", zorder=5, label="true optimum"
            )
        if name is None and ax.get_legend() is None:
            beside_title(ax)
        return ax

    return paths


class _Shown(NamedTuple):
    """What an axis shows."""

    title: str
    label: str
    factor: float


def _free(study: Any, name: str) -> _Shown:
    declared = study.declared[name]
    return _Shown(words(name).capitalize(), f"{declared.symbol}  [{declared.unit}]", declared.factor)


def _objective(study: Any) -> _Shown:
    measure: Measure = study.minimise[0]
    return _Shown(measure.name.capitalize(), measure.label, factor(measure.unit))
