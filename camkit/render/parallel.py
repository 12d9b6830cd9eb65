"""Parallel coordinates: every design is a line across one upright axis for each of its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .artists import BLUE, GREY, INK, PALE, SKY, area, line, new, text


@dataclass(frozen=True)
class Column:
    """One upright axis: its name, its unit, and +1 (-1) if small (large) values are better, 0 if neither."""

    name: str
    unit: str
    sense: int = 0

    def label(self, width: int) -> str:
        """Name in lines of ``width`` letters, unit and which way is better."""
        unit = f"\n[{self.unit}]" if self.unit else "\n"
        better = {1: "\n↓ better", -1: "\n↑ better", 0: "\n"}[self.sense]
        return fill(self.name, width, break_long_words=False) + unit + better


@dataclass(frozen=True)
class Designs:
    """Numbers of many designs, ``values`` ``(p, n)`` in the columns' units, and what is marked among them."""

    columns: tuple[Column, ...]
    values: np.ndarray
    bands: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    """Least and largest value to keep, by column."""
    marked: Mapping[int, str] = field(default_factory=dict)
    """Colours of some designs."""
    selected: int | None = None

    @property
    def kept(self) -> np.ndarray:
        """Which designs are inside every band, ``(p,)``."""
        inside = [(low <= self.values[:, j]) & (self.values[:, j] <= high) for j, (low, high) in self.bands.items()]
        return np.all([np.ones(len(self.values), bool), *inside], axis=0)

    @property
    def ends(self) -> np.ndarray:
        """Least and largest value of each column, ``(2, n)``."""
        return np.array([self.values.min(axis=0), self.values.max(axis=0)])

    def height(self, values: Any) -> np.ndarray:
        """Values of all columns as heights, 0 at the least and 1 at the largest; in the middle if all are alike."""
        low, high = self.ends
        span = np.where(high > low, high - low, 1.0)
        return np.asarray(np.where(high > low, (values - low) / span, 0.5))

    def value(self, column: int, height: float) -> float:
        """The value at a height on a column."""
        low, high = self.ends[:, column]
        return float(low + np.clip(height, 0, 1) * (high - low))

    def nearest(self, x: float, y: float) -> int | None:
        """The kept design whose line passes nearest above or below a point of the picture."""
        if not self.kept.any():
            return None
        heights = self.height(self.values)
        left = int(np.clip(np.floor(x), 0, max(len(self.columns) - 2, 0)))
        right = min(left + 1, len(self.columns) - 1)
        along = heights[:, left] + (heights[:, right] - heights[:, left]) * np.clip(x - left, 0, 1)
        return int(np.argmin(np.where(self.kept, abs(along - y), np.inf)))


MOST_MARKED = 4
LETTERS = 105
"""So many letters have room beside each other above the axes."""
BAND = 0.11
"""Half of a band's width, where the axes are 1 apart."""


def parallel_coordinates(shown: Designs, ax: Axes) -> Axes:
    """A line for each design; what is outside a band is pale, winners stand out, the design in the sliders is dark."""
    first, heights, kept = new(ax), shown.height(shown.values), shown.kept
    line(ax, "left out", *_lines(heights[~kept]), color=PALE, linewidth=0.9, zorder=1)
    line(ax, "kept", *_lines(heights[kept]), color=BLUE, linewidth=0.9, alpha=0.45, zorder=2)
    for j in range(len(shown.columns)):
        _axis(shown, ax, j)
    marked = [*shown.marked.items(), *[(-1, INK)] * MOST_MARKED][:MOST_MARKED]
    for i, (design, colour) in enumerate(marked):
        chosen = heights[design : design + 1] if design >= 0 else heights[:0]
        line(ax, f"marked {i}", *_lines(chosen), color=colour, linewidth=3, zorder=4).set_color(colour)
    chosen = heights[:0] if shown.selected is None else heights[shown.selected : shown.selected + 1]
    line(ax, "in the sliders", *_lines(chosen), color=INK, linewidth=1.6, linestyle=(0, (4, 2)), zorder=5)
    if first:
        ax.set(xlim=(-0.45, len(shown.columns) - 0.55), ylim=(-0.13, 1.44))
        ax.set_axis_off()
    return ax


def _lines(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Designs' heights ``(p, n)`` as one curve with ``nan`` between them."""
    p, n = heights.shape
    across = np.append(np.arange(float(n)), np.nan)
    return np.tile(across, p), np.column_stack([heights, np.full(p, np.nan)]).ravel()


def _axis(shown: Designs, ax: Axes, j: int) -> None:
    """An upright axis with its name, its ends and its band."""
    line(ax, f"axis {j}", [j, j], [0, 1], color=GREY, linewidth=1.2, zorder=3)
    label = shown.columns[j].label(LETTERS // len(shown.columns))
    text(ax, f"name {j}", j, 1.13, label, ha="center", va="bottom", color=INK, fontsize=9.5)
    low, high = shown.ends[:, j]
    ends: Any = {"ha": "center", "color": INK, "fontsize": 9.5, "zorder": 6}
    text(ax, f"low {j}", j, -0.03, f"{low:.4g}", va="top", **ends)
    text(ax, f"high {j}", j, 1.03, f"{high:.4g}" if high > low else "", va="bottom", **ends)
    x, y = [j - BAND, j + BAND, j + BAND, j - BAND], np.full(4, np.nan)
    if j in shown.bands:
        span = (high - low) or 1.0
        bottom, top = (np.clip((value - low) / span, 0, 1) for value in shown.bands[j])
        y = np.array([bottom, bottom, top, top])
    area(ax, f"band {j}", (x, y), facecolor=SKY, alpha=0.45, edgecolor=BLUE, linewidth=1.5, zorder=3)
