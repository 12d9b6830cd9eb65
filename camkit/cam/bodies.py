"""The bodies of a cam with its follower, to scale: the cam as it is cut, arms, stems, rollers and faces."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..geometry import Body, Disc, Outline, polar_angle
from ..quantities import refuse_population
from ..quantities.types import Array, Value

PIN = np.zeros((2, 1))
"""A body that is a pin: one point."""


def disk(analysis: Any, groove: bool) -> tuple[Body, ...]:
    """The cam: solid or groove, pitch curve where it is another, inner flank, a ``groove``'s outer flank, the axis."""
    refuse_population(analysis, "what is drawn")
    inner, outer = analysis.profile, analysis.outer_profile
    solid = np.concatenate([inner, outer[:, ::-1]], axis=1) if groove else inner
    turned = {"angle": analysis.turn}
    return (
        Outline("", "body", solid, **turned),
        *(() if analysis.pitch is inner else (Outline("", "pitch", analysis.pitch, **turned),)),
        Outline("", "profile", inner, analysis.undercut, **turned),
        *([Outline("", "flank", outer, analysis.outer_undercut, **turned)] if groove else ()),
        Outline("", "axis", PIN),
    )


def rocker(name: str, pivot: Array, end: Value) -> tuple[Body, ...]:
    """An arm from its pivot ``(2,)`` to its end ``(2, n)``, m."""
    away = end - np.reshape(pivot, (2, 1))
    length = np.hypot(*away)[..., :1]
    place = {"x": pivot[0], "y": pivot[1]}
    points = np.stack([np.append(0.0, length), np.zeros(2)])
    return Outline(name, "arm", points, angle=polar_angle(away), **place), Outline(name, "pivot", PIN, **place)


def stem(name: str, mouth: Array, foot: Array) -> tuple[Body, ...]:
    """The stem of a sliding follower on its foot ``(2, n)``: it reaches the mouth ``(2,)`` of its guide, m."""
    reach = mouth[1] - foot[1].min(axis=-1)
    points = np.stack([np.zeros(2), np.append(0.0, reach)])
    return Outline(name, "arm", points, x=foot[0], y=foot[1]), Outline(name, "pivot", PIN, x=mouth[0], y=mouth[1])


def roller(name: str, centre: Array, radius: Value) -> Disc:
    """A roller about its centre ``(2, n)``, m."""
    return Disc(name, "roller", radius, x=centre[0], y=centre[1])
