"""Views of what turns a cam: its torque and work over the turn, and over speeds."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from ..quantities import text_of
from ..quantities.types import Array, Value
from ..units import deg, rpm
from .cam import ANGLE
from .picture import Area, Axes, Line, Picture, Text

SPEEDS = np.linspace(0.2, 2.0, 91)
"""Shares of its own speed at which a cam is shown."""


class Torques(Protocol):
    """How a torque is spread over the turn."""

    cam_angle: Array
    torque: Array
    mean: Value
    rms: Value
    surplus: Array
    swing: Value


class Turned(Protocol):
    """The analysis of a cam that a torque turns."""

    @property
    def turning(self) -> Torques: ...


def torque_and_work(analysis: Turned) -> Picture:
    """The torque on the cam over the turn, its mean and rms; the areas about the mean are the work for a flywheel."""
    shown = analysis.turning
    x, M, mean = shown.cam_angle / deg, shown.torque, shown.mean + 0.0 * shown.torque
    told = f"rms {text_of(shown.rms, '.4g')} N m, surplus work {text_of(shown.swing, '.4g')} J"
    return Picture.of(
        Axes(title="Torque and work", xlabel=ANGLE, ylabel="M  [N m]"),
        Area("surplus", x, mean, np.maximum(M, mean), role="limit", opacity=0.15),
        Area("given back", x, np.minimum(M, mean), mean, role="allowed", opacity=0.15),
        Line("mean", x[[0, -1]], mean[[0, -1]], stroke="dashed", label="mean"),
        Line("rms", x[[0, -1]], shown.rms + 0.0 * mean[[0, -1]], stroke="thin", label="rms"),
        Line("torque", x, M, role="position", label="cam torque"),
        Text("numbers", x[-1], np.max(M, axis=-1), told, anchor="right top", size=9.0, boxed=True),
    )


def surplus_over_turn(analysis: Turned) -> Picture:
    """The work that the torque took above its mean since the first cam angle; its swing a flywheel has to store."""
    shown = analysis.turning
    x, ends = shown.cam_angle / deg, np.stack([np.min(shown.surplus), np.max(shown.surplus)])
    return Picture.of(
        Axes(title="Surplus work", xlabel=ANGLE, ylabel="A  [J]"),
        [Line(f"end {i}", x[[0, -1]], ends[i] + 0.0 * x[[0, -1]], stroke="thin dashed") for i in (0, 1)],
        Line("surplus", x, shown.surplus, role="position"),
    )


def torque_over_speed(analysis: Any) -> Picture:
    """The largest and the rms torque on the cam at up to twice its speed; the dashed line is at that speed.

    ``ValueError`` for a cam at rest.
    """
    cam = next(iter(analysis.curves.values()))
    own, unit = float(np.ravel(cam.speed)[0]), "% of rated" if getattr(cam, "rated", False) else "rpm"
    if not own > 0:
        raise ValueError("the cam is at rest; its torque is shown at up to twice its speed")
    sweep = analysis.torque_sweep(SPEEDS * own)
    size, most = 0.01 if unit != "rpm" else rpm, np.max(sweep.peak)
    x = sweep.speed / size
    return Picture.of(
        Axes(title="Torque over speed", xlabel=f"speed of the cam  [{unit}]", ylabel="M  [N m]", ylim=(0.0, None)),
        Line("peak", x, sweep.peak, role="series", index=0, label="peak"),
        Line("rms", x, sweep.rms, role="series", index=1, label="rms"),
        Line("now", [own / size, own / size], [0.0, most], stroke="dashed"),
    )
