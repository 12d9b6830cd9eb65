"""Designs beside each other: cams to one scale, and the curve behind a peak for each of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..geometry import Body, Disc, Outline
from ..quantities import PeakMeasure
from ..quantities.design import refuse_population
from ..quantities.kinds import refuse_empty, refuse_kinds
from ..quantities.types import Array
from ..units import deg, factor, mm
from .cam import bodies, position
from .picture import Axes, Colour, Line, Mark, Picture, Text

GAP = 40.0
"""Between two cams with their followers, mm."""


@dataclass(frozen=True)
class Beside:
    """Analyses of cams by name, and the peak whose curves are compared."""

    analyses: Mapping[str, Any]
    peak: PeakMeasure | None = None
    """Without one, only the cams can be drawn."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        refuse_empty(self.analyses, "analyses")
        for name, analysis in self.analyses.items():
            refuse_population(analysis, f"the analysis of {name}")


def cams_beside(shown: Beside, turn: float = 0.0) -> Picture:
    """Each cam with its followers, all to the same scale, turned by ``turn`` (rad)."""
    marks: list[Mark] = []
    x = 0.0
    for number, (name, analysis) in enumerate(shown.analyses.items()):
        left, right, bottom = _reach(analysis)
        x -= left * min(number, 1)
        drawn = bodies(analysis.bodies, position(analysis.cam_angle, turn), x, name, number)
        marks += [mark for mark in drawn if not mark.key.endswith(("pitch", "flank", "undercut"))]
        marks.append(Text(f"{name} name", x, 1.06 * bottom, name, anchor="top", bold=True))
        x += right + GAP
    return Picture.of(Axes(title="To the same scale", xlabel="x  [mm]", ylabel="y  [mm]", equal=True), marks)


def _reach(analysis: Any) -> tuple[float, float, float]:
    """How far a cam with its followers reaches to the left, to the right and, the cam, down over the turn, mm."""
    size = np.max(np.hypot(*analysis.profile), axis=-1)
    ends = [_sides(body) for body in analysis.bodies if body.name]
    left, right = np.min([-size, *(low for low, _ in ends)]), np.max([size, *(high for _, high in ends)])
    return left / mm, right / mm, -size / mm


def _sides(body: Body) -> tuple[Array, Array]:
    """Least and largest x of a body over its path, m."""
    if isinstance(body, Outline):
        c, s = np.cos(body.angle), np.sin(body.angle)
        x = [body.x + c * px - s * py for px, py in np.transpose(body.points)]
        return np.min(x), np.max(x)
    radius = body.radius if isinstance(body, Disc) else 0.0
    return np.min(body.x) - radius, np.max(body.x) + radius


def curves_beside(shown: Beside) -> Picture:
    """The curve whose largest value is the peak, for each cam over its turn; the largest value as a line."""
    peak = shown.peak
    if peak is None or peak.angle is None:
        raise ValueError("there is no peak, with an angle for its curve, whose curves could be compared")
    marks = []
    for index, (name, analysis) in enumerate(shown.analyses.items()):
        x, y = np.ravel(peak.angle(analysis)) / deg, np.ravel(peak.curve(analysis)) / factor(peak.unit)
        style: Colour = {"role": "series", "index": index}
        jump = np.diff(x, append=x[-1:]) > 3 * np.median(np.diff(x))
        across, along = _parted(x, jump), _parted(y, jump)
        marks.append(Line(f"{name} curve", across, along, label=name, **style))
        marks.append(Line(f"{name} peak", x[[0, -1]], np.max(y) + np.zeros(2), stroke="thin dashed", **style))
    title = peak.name[:1].upper() + peak.name[1:]
    return Picture.of(Axes(title=title, xlabel="cam angle  [deg]", ylabel=peak.label, ylim=(0, None)), marks)


def _parted(values: Array, jump: Array) -> Array:
    """``values``, each followed by a gap where a ``jump`` comes behind it and else by itself again."""
    return np.stack([values, np.where(jump, np.nan, values)], axis=-1).ravel()
