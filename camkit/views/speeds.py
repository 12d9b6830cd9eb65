"""Views over the speed of the cam: a cam made for its elastic train beside the plain one.

They show whatever analysis offers ``beside_plain``: what its train does behind both cams, over speeds of the cam.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from ..quantities.types import Array
from ..units import deg, rpm, um
from .picture import Axes, Band, Line, Mark, Picture, Text

SPEED = "cam speed  [rpm]"
LEAST = 1e-4
"""The vibration is shown down to such a share of the largest."""


class BesidePlain(Protocol):
    """The analysis of a polydyne cam with its train."""

    @property
    def beside_plain(self) -> Any: ...
    @property
    def acceleration_unit(self) -> str: ...


def vibration_beside_plain(analysis: BesidePlain) -> Picture:
    """The largest vibration in the dwells over the speed of the cam: none at the design speed, more at some others."""
    unit, name = (um, "µm") if analysis.acceleration_unit.startswith("mm") else (deg, "deg")
    cams = analysis.beside_plain
    made, plain = (_largest(sweep.dwell_vibration) / unit for sweep in (cams.polydyne, cams.plain))
    top = np.nanmax(np.append(plain, made), initial=LEAST)
    low, high = LEAST * top, 2 * top
    axes = Axes(title="Vibration in the dwells", xlabel=SPEED, ylabel=f"[{name}]", ylim=(low, high), log="y")
    speeds = cams.plain.speed / rpm
    lines = [
        Line("plain", speeds, np.maximum(plain, low), role="ghost", label="plain cam"),
        Line("polydyne", cams.polydyne.speed / rpm, np.maximum(made, low), role="profile", label="polydyne cam"),
    ]
    return Picture.of(axes, _at_design_speed(cams, low, high), lines)


def force_beside_plain(analysis: BesidePlain) -> Picture:
    """The largest and the least contact force over the speed of the cam; below 0 the follower leaves it."""
    cams = analysis.beside_plain
    lines: list[Mark] = []
    for name, sweep, role in (("plain", cams.plain, "ghost"), ("polydyne", cams.polydyne, "profile")):
        speeds = sweep.speed / rpm
        lines.append(Line(f"{name} peak", speeds, sweep.max_force, role=role, label=f"{name} cam"))
        lines.append(Line(f"{name} least", speeds, sweep.least_force, role=role, stroke="dashed"))
    every = np.concatenate([sweep[k] for sweep in cams[:2] for k in (1, 2)])
    low, high = np.nanmin(every, initial=0.0), np.nanmax(every, initial=1.0)
    axes = Axes(title="Largest and least contact force", xlabel=SPEED, ylabel="[N]")
    return Picture.of(axes, Band("zero", 0.0, 0.0, role="guide"), _at_design_speed(cams, low, high), lines)


def _largest(vibration: Array) -> Array:
    """Of all dwells; 0 without any."""
    return np.max(vibration, axis=-1, initial=0.0)


def _at_design_speed(cams: Any, low: float, high: float) -> list[Mark]:
    speed = cams.design_speed / rpm
    return [
        Line("design speed", [speed, speed], [low, high], role="guide", stroke="dashed"),
        Text("design speed name", speed, high, " design speed", anchor="left top"),
    ]
