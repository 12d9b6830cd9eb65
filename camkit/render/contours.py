"""View of a study over its two free quantities: the objective in shades, where a limit is missed, the optimum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

from ..quantities import words
from ..quantities.kinds import numbers, refuse_kinds, shown
from ..study.design_map import DesignMap
from ..units import factor
from .artists import BLUE, INK, WARNING, area, frame, line, new, plain, text
from .design_map import NOTHING, level_curve, region_below

BANDS = 8
"""How many shades show the objective; each covers about the same area, whatever the objective is."""
VALUE: Any = {
    "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.75},
    "ha": "center",
    "va": "center",
    "fontsize": 9,
    "color": INK,
    "zorder": 3,
}


@dataclass(frozen=True)
class ShownPlane:
    """A `DesignMap` with what is marked on it: free values of the design in the sliders and of the optimum, SI."""

    plane: DesignMap
    here: Any = None
    best: Any = None

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for name, at in (("design in the sliders", self.here), ("optimum", self.best)):
            if at is not None and numbers(at, f"the {name}").shape != (2,):
                raise ValueError(f"the {name} is {shown(at)}; it must be two numbers, or None")


def objective_plane(shown: ShownPlane, ax: Axes) -> Axes:
    """The objective over two quantities, the darker the better; faded where a limit is missed; the optimum."""
    plane = shown.plane
    units = np.array([q.factor for q in plane.declared])[:, None]
    x, y = plane.axes / units
    if new(ax):
        frame(ax, "", *(_label(n, q) for n, q in zip(plane.study.free, plane.declared, strict=True)))
        ax.set(xlim=_ends(x), ylim=_ends(y))
        ax.grid(visible=False)
    measure = plane.study.minimise[0]
    ax.set_title(plain(measure.label[:1].upper() + measure.label[1:]), pad=13)
    _shades(ax, x, y, plane.objective / factor(measure.unit), measure.sign)
    _missed(ax, x, y, plane)
    _mark(ax, "in the sliders", shown.here, units, marker="o", markersize=13, markeredgecolor=INK)
    _mark(ax, "optimum", shown.best, units, marker="*", markersize=20, markeredgecolor=WARNING)
    _legend(ax, shown)
    return ax


def _ends(values: np.ndarray) -> np.ndarray:
    """First and last value, and room for a mark on the edge."""
    return values[[0, -1]] + 0.025 * np.ptp(values) * np.array([-1, 1])


def _label(name: str, declared: Any) -> str:
    symbol = "" if name == declared.symbol else f"  {declared.symbol}"
    return f"{words(name)}{symbol}" + (f"  [{declared.unit}]" if declared.unit else "")


def _shades(ax: Axes, x: Any, y: Any, z: np.ndarray, sign: int) -> None:
    """Bands between levels that part the plane into equal areas, every second level with its value as it is read."""
    levels = np.nanquantile(z, np.arange(1, BANDS + 1) / BANDS)
    levels[-1] = np.inf
    for i, level in enumerate(levels):
        shade = 1 - (0.7 - 0.62 * i / (BANDS - 1)) * (1 - np.array(to_rgb(BLUE)))
        below = region_below(x, y, z, level)
        area(ax, f"band {i}", below, facecolor=shade, edgecolor="none", zorder=1 - i / 10)
    for i, level in enumerate(levels[:-1]):
        curve = level_curve(x, y, z, level)
        line(ax, f"level {i}", *curve, color="white", linewidth=0.8, zorder=1.5)
        if i % 2 == 0:
            at_x, at_y = _middle(curve)
            text(ax, f"value {i}", at_x, at_y, f"{sign * level:.4g}", **VALUE)


def _middle(curve: np.ndarray) -> Any:
    """The middle point of the longest piece of a curve."""
    pieces = np.split(curve, np.flatnonzero(np.isnan(curve[0])), axis=1)
    longest = max(pieces, key=lambda piece: piece.shape[1])
    return longest[:, longest.shape[1] // 2]


def _missed(ax: Axes, x: Any, y: Any, plane: Any) -> None:
    """A veil over what misses a limit or cannot be built, and its edge."""
    worst = np.clip(plane.worst, -1, 1)
    area(ax, "missed", region_below(x, y, -worst, 0), facecolor="white", alpha=0.72, edgecolor="none", zorder=2)
    line(ax, "limit", *level_curve(x, y, worst, 0), color=WARNING, linewidth=2.2, zorder=2.5)


def _mark(ax: Axes, name: str, at: Any, units: Any, **style: Any) -> None:
    x, y = NOTHING if at is None else np.reshape(at, (2, 1)) / units
    plain: Any = {"linestyle": "none", "markerfacecolor": "white", "markeredgewidth": 2, "clip_on": False}
    line(ax, name, x, y, zorder=5, label=name, **plain, **style)


def _legend(ax: Axes, shown: ShownPlane) -> None:
    """What is marked, below the axes; made anew when the study has other limits."""
    limits = [f"{m.name} {'at most' if k > 0 else 'at least'} {m.text(v)}" for m, v, k in shown.plane.study.limits]
    shows = {"limit": bool(limits), "in the sliders": shown.here is not None, "optimum": True}
    marks = [mark for mark in ax.lines if shows.get(str(mark.get_gid()))]
    if limits:
        marks[0].set_label(plain(limits[0]) if len(limits) == 1 else "a limit")
    told, legend = [str(mark.get_label()) for mark in marks], ax.get_legend()
    if legend is None or [text.get_text() for text in legend.get_texts()] != told:
        place: Any = {"loc": "upper center", "bbox_to_anchor": (0.46, 0), "borderaxespad": 4.4, "ncols": 3}
        ax.legend(handles=marks, columnspacing=1.2, **place)
