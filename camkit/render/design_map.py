"""The plane of two free quantities: what is allowed, what it costs, where the best design is."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from contourpy import FillType, contour_generator
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from ..quantities import words
from ..quantities.kinds import refuse_arguments
from ..study.design_map import DesignMap
from ..study.study import KEPT
from ..units import factor
from .artists import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY, WARNING, area, colours, frame, line, new, text

LIMIT_COLOURS = (ORANGE, BLUE, PURPLE, SKY)
LABEL: Any = {
    "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.85},
    "ha": "center",
    "va": "center",
}
NOTHING = np.full((2, 1), np.nan)


def level_curve(x: Any, y: Any, z: Any, level: float) -> np.ndarray:
    """Where ``z`` on a grid is ``level``, as one curve with ``nan`` between its pieces, ``(2, m)``."""
    pieces = contour_generator(x, y, np.ma.masked_invalid(z)).lines(level)
    return _joined([piece for piece in pieces if len(piece) > 1])


def region_below(x: Any, y: Any, z: Any, level: float) -> np.ndarray:
    """The outline of where ``z`` on a grid is below ``level``, ``nan`` between its pieces, ``(2, m)``."""
    generator: Any = contour_generator(x, y, np.ma.masked_invalid(z), fill_type=FillType.OuterOffset)
    points, offsets = generator.filled(-np.inf, level)
    rings = [p[a:b] for p, o in zip(points, offsets, strict=True) for a, b in pairwise(o)]
    return _joined(rings)


def _joined(pieces: Sequence[Any]) -> np.ndarray:
    if not pieces:
        return NOTHING
    return np.concatenate([row for piece in pieces for row in (piece, NOTHING.T)])[:-1].T


def design_plane(plane: DesignMap, ax: Axes, names: Sequence[str] | None = None) -> Axes:
    """A `DesignMap`: the objective's contours, a curve for each limit, the feasible region, bounds, the best design.

    ``names`` says what the limits' curves are called (default: their measures' names).
    """
    refuse_arguments(design_plane, locals())
    units = np.array([q.factor for q in plane.declared])[:, None]
    x, y = plane.axes / units
    if new(ax):
        first, second = (
            f"{words(n)} {q.symbol}  [{q.unit}]" for n, q in zip(plane.study.free, plane.declared, strict=True)
        )
        frame(ax, "What is allowed, and what it costs", first, second)
        ax.set(xlim=x[[0, -1]], ylim=y[[0, -1]])
        ax.grid(visible=False)
    _feasible_region(ax, x, y, plane, plane.study.bounds / units.T)
    _objective(ax, x, y, plane)
    _limits(ax, x, y, plane, names or [m.name for m in plane.measures])
    _nothing(ax, plane, plane.study.bounds / units.T)
    star: Any = {
        "marker": "*",
        "markersize": 19,
        "markerfacecolor": "white",
        "markeredgecolor": INK,
        "markeredgewidth": 1.6,
    }
    best = plane.best[:, None] / units
    line(ax, "best", *best, linestyle="none", zorder=6, label="optimum, searched", **star)
    return ax


def _feasible_region(ax: Axes, x: Any, y: Any, plane: Any, bounds: Any) -> None:
    """Pale wherever all limits are kept, stronger within the bounds."""
    outline = region_below(x, y, np.minimum(plane.worst, 1.0), 0.0)
    area(ax, "allowed", outline, facecolor=GREEN, alpha=0.13, edgecolor="none", zorder=0.5)
    inside = area(ax, "feasible", outline, facecolor=GREEN, alpha=0.22, edgecolor="none", zorder=0.6)
    (x0, y0), (x1, y1) = bounds
    inside.set_clip_path(Rectangle((x0, y0), x1 - x0, y1 - y0, transform=ax.transData))
    corners = [x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0]
    line(ax, "bounds", *corners, color=INK, linewidth=1.1, linestyle=(0, (6, 3)), zorder=3, label="bounds")


def _objective(ax: Axes, x: Any, y: Any, plane: Any) -> None:
    """Thin contours of the objective, each with its value."""
    measure = plane.study.minimise[0]
    z = plane.objective / factor(measure.unit)
    levels = MaxNLocator(9).tick_values(np.nanmin(z), np.nanmax(z))[1:-1]
    curves = [level_curve(x, y, z, level) for level in levels]
    line(ax, "objective", *_joined([c.T for c in curves]), color=GREY, linewidth=0.8, zorder=1, label=measure.label)
    for i in range(10):
        at = _upper_end(ax, curves[i]) if i < len(curves) else NOTHING[:, 0]
        value = f"{levels[i]:.5g}" if np.isfinite(at).all() else ""
        text(ax, f"objective {i}", at[0], at[1], value, color=GREY, fontsize=9, zorder=1.5, **LABEL)


def _upper_end(ax: Axes, curve: np.ndarray) -> np.ndarray:
    """Where a curve comes nearest to the upper right corner, the edges left free."""
    seen = ax.transAxes.inverted().transform(ax.transData.transform(curve.T))
    inside = ((seen > 0.05) & (seen < 0.94)).all(-1)
    return curve[:, np.argmax(np.where(inside, seen.sum(-1), -1))] if inside.any() else NOTHING[:, 0]


PLACES = (0.30, 0.72, 0.50, 0.20)
"""How far along its curve a limit's name stands if nothing is in its way there."""
CLEAR = np.array([0.27, 0.065])
"""Half of what two names need to stand beside each other, or one above the other, as shares of the axes."""


def _limits(ax: Axes, x: Any, y: Any, plane: Any, names: Sequence[str]) -> None:
    """A curve for each limit with its name; those that have no curve here are told above the axes."""
    kept: list[str] = []
    taken: list[np.ndarray] = []
    shades = colours(len(names), LIMIT_COLOURS)
    for i, (name, colour, limit) in enumerate(zip(names, shades, plane.limits, strict=True)):
        curve = level_curve(x, y, np.minimum(limit, 1.0), 0.0)
        line(ax, f"limit {i}", *curve, color=colour, linewidth=2.4, zorder=4)
        at = _place(ax, curve, PLACES[i % len(PLACES)], taken)
        style: Any = LABEL | {"bbox": LABEL["bbox"] | {"edgecolor": colour}}
        told = name if np.isfinite(at).all() else ""
        text(ax, f"limit {i} name", at[0], at[1], told, color=INK, fontsize=10.5, zorder=5, **style)
        kept += [name] if np.nanmax(limit) <= KEPT else []
    told = f"kept all over: {', '.join(kept)}" if kept else ""
    text(ax, "kept", 1.0, 1.015, told, transform=ax.transAxes, ha="right", va="bottom", color=GREY, fontsize=9.5)


def _place(ax: Axes, curve: np.ndarray, share: float, taken: list[np.ndarray]) -> np.ndarray:
    """A point at about ``share`` of a curve's length, clear of the edges and of the places that are ``taken``."""
    points = curve[:, np.isfinite(curve).all(axis=0)]
    if points.shape[1] < 2:
        return NOTHING[:, 0]
    way = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points)))]) / max(np.hypot(*np.diff(points)).sum(), 1e-300)
    shares = np.linspace(0.06, 0.94, 23)
    shares = shares[np.argsort(abs(shares - share))]
    candidates = points[:, np.searchsorted(way, shares)].T
    seen = ax.transAxes.inverted().transform(ax.transData.transform(candidates))
    edge = [0.13, 0.04]
    clear = ((seen > edge) & (seen < 1 - np.array(edge))).all(-1)
    for other in taken:
        clear &= (abs(seen - other) > CLEAR).any(-1)
    i = int(np.argmax(clear))
    taken.append(seen[i])
    return candidates[i]


def _nothing(ax: Axes, plane: Any, bounds: Any) -> None:
    """A sentence in the bounds where no design there keeps every limit."""
    told = "" if np.isfinite(plane.best).all() else "nothing within the bounds\nkeeps every limit"
    x, y = bounds.mean(axis=0)
    text(ax, "nothing", x, y, told, color=WARNING, fontsize=12, zorder=5, **LABEL)
