"""Parallel coordinates: every design is a line across one upright axis for each of its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from .picture import Axes, Line, Mark, Picture, Polygon, Text, in_lines


@dataclass(frozen=True)
class Column:
    """One upright axis: its name, its unit, and +1 (-1) if small (large) values are better, 0 if neither."""

    name: str
    unit: str
    sense: int = 0

    def label(self, width: int) -> str:
        """Name in lines of ``width`` letters, and which way is better."""
        better = {1: "\n↓ better", -1: "\n↑ better", 0: "\n"}[self.sense]
        return in_lines(self.name, width, 4) + better

    def text(self, value: float) -> str:
        """A value with its unit."""
        return f"{value:.4g} {self.unit}".rstrip()


@dataclass(frozen=True)
class Designs:
    """Numbers of many designs, ``values`` ``(p, n)`` in the columns' units, and what is marked among them."""

    columns: tuple[Column, ...]
    values: np.ndarray
    bands: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    """Least and largest value to keep, by column."""
    marked: Mapping[int, int] = field(default_factory=dict)
    """Some designs that stand out, with their places in the series."""
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

    def height(self, values: object) -> np.ndarray:
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


LETTERS = 84
"""So many letters have room beside each other above the axes."""
BAND = 0.11
"""Half of a band's width, where the axes are 1 apart."""


def parallel_coordinates(shown: Designs) -> Picture:
    """A line for each design; what is outside a band is pale, winners stand out, the design in the sliders is dark."""
    heights, kept = shown.height(shown.values), shown.kept
    chosen = [] if shown.selected is None else [shown.selected]
    room = max(column.label(_letters(shown)).count("\n") for column in shown.columns)
    return Picture.of(
        Axes(bare=True, xlim=(-0.45, len(shown.columns) - 0.55), ylim=(-0.13, 1.24 + 0.1 * room)),
        Line("left out", *_lines(heights[~kept]), role="ghost", stroke="thin", opacity=0.5),
        Line("kept", *_lines(heights[kept]), role="position", stroke="thin", opacity=0.45),
        [mark for j in range(len(shown.columns)) for mark in _axis(shown, j)],
        [
            Line(f"marked {design}", *_lines(heights[[design]]), role="series", index=index, stroke="bold")
            for design, index in shown.marked.items()
        ],
        Line("in the sliders", *_lines(heights[chosen]), stroke="dashed"),
    )


def _lines(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Designs' heights ``(p, n)`` as one curve with ``nan`` between them."""
    p, n = heights.shape
    across = np.append(np.arange(float(n)), np.nan)
    return np.tile(across, p), np.column_stack([heights, np.full(p, np.nan)]).ravel()


def _letters(shown: Designs) -> int:
    """So many stand in a line above an axis."""
    return LETTERS // len(shown.columns)


def _axis(shown: Designs, j: int) -> list[Mark]:
    """An upright axis with its name, its ends and its band."""
    low, high = shown.ends[:, j]
    label = shown.columns[j].label(_letters(shown))
    marks: list[Mark] = [
        Line(f"axis {j}", [j, j], [0, 1], role="guide"),
        Text(f"name {j}", j, 1.13, label, anchor="bottom", size=9.5),
        Text(f"low {j}", j, -0.03, shown.columns[j].text(low), anchor="top", size=9.5),
        Text(f"high {j}", j, 1.03, shown.columns[j].text(high) if high > low else "", anchor="bottom", size=9.5),
    ]
    if j in shown.bands:
        span = (high - low) or 1.0
        bottom, top = (np.clip((value - low) / span, 0, 1) for value in shown.bands[j])
        x, y = [j - BAND, j + BAND, j + BAND, j - BAND], [bottom, bottom, top, top]
        marks.append(Polygon(f"band {j}", x, y, role="flank", opacity=0.45, edged=True))
    return marks
