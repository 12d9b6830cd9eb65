"""The bodies of a cam with its follower, to scale: the cam as it is cut, arms, stems, rollers and faces."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..geometry import Body, Cylinder, Disc, Outline, Shape, Strip, polar_angle, vector
from ..quantities import refuse_population
from ..quantities.types import Array, Value

PIN = np.zeros((2, 1))
"""A body that is a pin: one point."""
PLACES = 181
"""A drum in space is drawn by so many places around it."""


def disk(analysis: Any, groove: bool) -> tuple[Body, ...]:
    """The cam: solid or groove, pitch curve where it is another, inner flank, a ``groove``'s outer flank, the axis."""
    refuse_population(analysis, "what is drawn")
    solid = _between_flanks(analysis) if groove else analysis.profile
    return *_lines(analysis, groove, solid, angle=analysis.turn), Outline("", "axis", PIN)


def unrolled(analysis: Any, groove: bool, low: Value, high: Value) -> tuple[Body, ...]:
    """A drum unrolled, at rest: its ends at ``low`` and, with a ``groove``, ``high``, its groove, or its end face."""
    refuse_population(analysis, "what is drawn")
    x = analysis.profile[0]
    below = np.stack([np.stack([x[-1], x[0]]), np.stack([low, low])])
    solid = _between_flanks(analysis) if groove else np.concatenate([analysis.profile, below], axis=1)
    start, end = 0.0 * low, analysis.period[0]
    corners = ((start, end, end, start, start), (low, low, high, high, low)) if groove else ((start, end), (low, low))
    return Outline("", "guide", np.stack([np.stack(places) for places in corners])), *_lines(analysis, groove, solid)


def drum(analysis: Any, groove: bool, low: Value, high: Value) -> tuple[Shape, ...]:
    """A drum in space from ``low`` to ``high``, with its ``groove`` or its end face."""
    refuse_population(analysis, "what is drawn")
    n, outer, inner = analysis.cam_angle.shape[-1], analysis.cam.surface_radius, analysis.cam.bottom_radius
    some = np.linspace(0, n - 1, min(n, PLACES)).round().astype(int)
    lip, bottom, far, under = (
        np.take(analysis.in_space(radius, side), some, axis=-1) for side in (1, -1) for radius in (outer, inner)
    )
    foot, floor, top = (vector(at[0], at[1], level) for at, level in ((lip, low), (bottom, low), (far, high)))

    def strip(part: str, first: Array, second: Array, hand: int = 1, cut: Value | None = None) -> Strip:
        edges, lost = np.stack([first, second], axis=1), None if cut is None else np.take(cut, some, axis=-1)
        return Strip("", part, edges, lost, angle=-analysis.turn, hand=hand * analysis.cam.rotation)

    if not groove:
        return strip("", bottom, floor), strip("face", lip, bottom, 1, analysis.undercut), strip("", lip, foot, -1)
    axis = vector(np.zeros(2), 0.0, np.stack([low, high]))
    walls = strip("floor", lip, far), strip("wall", lip, bottom), strip("wall", under, far)
    below = strip("profile", lip, foot, -1, analysis.undercut)
    above = strip("flank", far, top, 1, analysis.outer_undercut)
    return Cylinder("", "body", outer, axis), *walls, below, above


def _between_flanks(analysis: Any) -> Array:
    return np.concatenate([analysis.profile, analysis.outer_profile[:, ::-1]], axis=1)


def _lines(analysis: Any, groove: bool, solid: Array, angle: Value = 0.0) -> tuple[Body, ...]:
    """What is ``solid``, the pitch curve where it is another, and every flank with what is cut of it."""
    inner, turned = analysis.profile, {"angle": angle}
    return (
        Outline("", "body", solid, **turned),
        *(() if analysis.pitch is inner else (Outline("", "pitch", analysis.pitch, **turned),)),
        Outline("", "profile", inner, analysis.undercut, **turned),
        *([Outline("", "flank", analysis.outer_profile, analysis.outer_undercut, **turned)] if groove else ()),
    )


def rocker(name: str, pivot: Array, end: Value) -> tuple[Body, ...]:
    """An arm from its pivot, ``(2,)`` or ``(2, n)``, to its end ``(2, n)``, m."""
    away = end - np.reshape(pivot, (2, -1))
    length = np.hypot(*away)[..., :1]
    place = {"x": pivot[0], "y": pivot[1]}
    points = np.stack([np.append(0.0, length), np.zeros(2)])
    return Outline(name, "arm", points, angle=polar_angle(away), **place), Outline(name, "pivot", PIN, **place)


def stem(name: str, mouth: Array, foot: Array) -> tuple[Body, ...]:
    """The stem of a sliding follower on its foot ``(2, n)``: it reaches the mouth of its guide, ``(2,)`` or more, m."""
    reach = np.max(mouth[1]) - foot[1].min(axis=-1)
    points = np.stack([np.zeros(2), np.append(0.0, reach)])
    return Outline(name, "arm", points, x=foot[0], y=foot[1]), Outline(name, "pivot", PIN, x=mouth[0], y=mouth[1])


def roller(name: str, centre: Array, radius: Value) -> Disc:
    """A roller about its centre ``(2, n)``, m."""
    return Disc(name, "roller", radius, x=centre[0], y=centre[1])
