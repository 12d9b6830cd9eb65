"""Views of several designs laid over each other: their profiles, and their measures against the first one's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quantities import Measure
from ..units import mm
from .picture import Axes, Line, Mark, Picture, Points, in_lines

PLACES = "ABCDE"
"""A design keeps its letter and its place in the series as long as it is kept."""
FAR = 1000.0
"""A difference of more than so many per cent is not drawn; the table tells it."""
MANY = 8
"""Of more measures than so many each name has one line."""


@dataclass(frozen=True)
class Kept:
    """Designs by the letter of their place, and measures to compare."""

    analyses: dict[str, object]
    measures: tuple[Measure, ...] = ()


def profiles_overlaid(kept: Kept) -> Picture:
    """The profiles of all designs."""
    marks: list[Mark] = [Points("axis", 0.0, 0.0, mark="plus", size=12)]
    for place, analysis in kept.analyses.items():
        index = PLACES.index(place)
        stroke = "bold" if index == 0 else ""
        marks.append(Line(place, *_profile(analysis), role="series", index=index, label=place, stroke=stroke))
    return Picture.of(Axes(title="Profiles", xlabel="x  [mm]", ylabel="y  [mm]", equal=True), marks)


def _profile(analysis: Any) -> np.ndarray:
    """A cam's outline in mm, closed if it goes all round."""
    profile = np.asarray(getattr(analysis, "whole", analysis).profile) / mm
    gap = np.hypot(*(profile[:, -1] - profile[:, 0]))
    longest = np.nanmax(np.hypot(*np.diff(profile)))
    return np.column_stack([profile, profile[:, :1]]) if gap < 3 * longest else profile


def measures_overlaid(kept: Kept) -> Picture:
    """Every measure of every design, divided by that of the first: who is 10 % larger, who smaller?"""
    measures = kept.measures
    values = {place: np.array([m.one(a) for m in measures]) for place, a in kept.analyses.items()}
    base = next(iter(values.values()), np.ones(len(measures)))
    height = -np.arange(len(measures), dtype=float)
    marks: list[Mark] = [Line("first", [0, 0], [0.5, 0.5 - len(measures)], role="guide")]
    for place, value in values.items():
        with np.errstate(divide="ignore", invalid="ignore"):
            share = 100 * (value - base) / abs(base)
        told = np.where(np.isfinite(share) & (abs(share) <= FAR), share, np.nan)
        index = PLACES.index(place)
        marks.append(Points(place, told, height, role="series", index=index, size=11 - index, label=place))
    room = (24, 2) if len(measures) <= MANY else (36, 1)
    axes = Axes(
        title="Measures against the first design",
        xlabel="difference  [%]",
        ylim=(0.4 - len(measures), 0.6),
        yticks={float(y): in_lines(m.name, *room) for y, m in zip(height, measures, strict=True)},
    )
    return Picture.of(axes, marks)
