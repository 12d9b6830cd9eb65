"""Views of several designs laid over each other: their profiles, and their measures against the first one's."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..units import mm
from .artists import COLOURS, GREY, INK, frame, line, new, plain, text

PLACES = "ABCDE"
"""A design keeps its letter and its colour as long as it is kept."""


@dataclass(frozen=True)
class Kept:
    """Designs by the letter of their place, and measures to compare."""

    analyses: dict[str, Any]
    measures: tuple[Any, ...] = ()


def colour_of(place: str) -> str:
    """The colour of a place."""
    return COLOURS[PLACES.index(place)]


def profiles_overlaid(kept: Kept, ax: Axes) -> Axes:
    """The profiles of all designs, each in its own colour."""
    if new(ax):
        frame(ax, "Profiles", "x  [mm]", "y  [mm]")
        ax.set_aspect("equal", adjustable="datalim")
        line(ax, "axis", [0], [0], marker="+", markersize=12, color=INK, linestyle="none")
    for i, place in enumerate(PLACES):
        x, y = _profile(kept.analyses[place]) if place in kept.analyses else np.full((2, 1), np.nan)
        line(ax, place, x, y, color=colour_of(place), linewidth=2.4 - 0.25 * i)
    return _letters(kept, ax)


def _letters(kept: Kept, ax: Axes) -> Axes:
    """Which designs are shown, each letter in its colour, above the axes on the right."""
    for place in PLACES:
        number = list(kept.analyses).index(place) if place in kept.analyses else 0
        across = 1 - 0.07 * (len(kept.analyses) - 1 - number)
        told: Any = {"transform": ax.transAxes, "ha": "right", "va": "bottom", "fontsize": 13, "fontweight": "bold"}
        words = place if place in kept.analyses else ""
        text(ax, f"letter {place}", across, 1.005, words, color=colour_of(place), **told)
    return ax


def _profile(analysis: Any) -> np.ndarray:
    """A cam's outline in mm, closed if it goes all round."""
    profile = np.asarray(getattr(analysis, "whole", analysis).profile) / mm
    gap = np.hypot(*(profile[:, -1] - profile[:, 0]))
    longest = np.nanmax(np.hypot(*np.diff(profile)))
    return np.column_stack([profile, profile[:, :1]]) if gap < 3 * longest else profile


def measures_overlaid(kept: Kept, ax: Axes) -> Axes:
    """Every measure of every design, divided by that of the first: who is 10 % larger, who smaller?"""
    first = new(ax)
    measures = kept.measures
    values = {place: np.array([float(m(a)) for m in measures]) for place, a in kept.analyses.items()}
    base = next(iter(values.values()), np.ones(len(measures)))
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = {place: 100 * (v - base) / abs(base) for place, v in values.items()}
    height = -np.arange(len(measures), dtype=float)
    for i, place in enumerate(PLACES):
        share = shares.get(place, np.full(len(measures), np.nan))
        told = np.where(np.isfinite(share) & (abs(share) <= FAR), share, np.nan)
        line(ax, place, told, height, color=colour_of(place), marker="o", markersize=11 - i, linestyle="none", zorder=3)
    line(ax, "first", [0, 0], [0.5, 0.5 - len(measures)], color=GREY, linewidth=1.3)
    if first:
        ax.set_title("Measures against the first design", pad=24)
        ax.set_yticks(height, [plain(fill(m.name, 34)) for m in measures])
        ax.set(ylim=(0.4 - len(measures), 0.6))
        ax.set_xlabel("difference  [%]")
        ax.locator_params(axis="x", nbins=6)
        ax.margins(x=0.1)
    return _letters(kept, ax)


FAR = 1000.0
"""A difference of more than so many per cent is not drawn; the table tells it."""
