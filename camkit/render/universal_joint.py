"""Views of a drive with two universal joints: in space, and over a turn of its input shaft."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..units import deg, rpm
from .artists import BLUE, GREY, INK, ORANGE, beside_title, frame, line, new
from .turntable import NEAR, Turntable

COLOUR = {"input": GREY, "intermediate": ORANGE, "driven": BLUE}
ACROSS = np.array([0.0, 1.0, 0.0])
"""Normal of the plane in which the shafts of the drawing lie."""
REACH, GAP = 0.5, 0.85
"""Half the length of a pin and how far a fork reaches back from it, in lengths of which the middle shaft has 3."""


def _direction(slope: float) -> np.ndarray:
    """Of a shaft that falls by ``slope`` (rad) to the right."""
    return np.array([np.cos(slope), 0.0, -np.sin(slope)])


def _pin(axis: np.ndarray, angle: float) -> np.ndarray:
    """The direction of a pin that has turned by ``angle`` about ``axis`` from the plane of the shafts."""
    upright = np.cross(axis, ACROSS)
    return np.cos(angle) * upright + np.sin(angle) * ACROSS


def pins(analysis: Any, i: int) -> dict[str, np.ndarray]:
    """Directions of the four pins at the input angle ``i``: of each shaft at each joint, as they stand in space."""
    drive, quarter = analysis.drive, np.pi / 2
    middle = analysis.intermediate_angle[i] + quarter
    slopes = (drive.first_angle, 0.0, drive.second_angle)
    first, second, third = (_direction(float(slope)) for slope in slopes)
    return {
        "input": _pin(first, analysis.input_angle[i]),
        "intermediate, first": _pin(second, middle),
        "intermediate, second": _pin(second, middle + drive.phase),
        "driven": _pin(third, analysis.output_angle[i] + drive.phase + np.pi),
    }


def drive(analysis: Any, ax: Axes, turn: float = 0.0, azimuth: float = -75 * deg, elevation: float = 25 * deg) -> Axes:
    """The three shafts with their forks and crosses, the input shaft turned by ``turn`` (rad)."""
    i = int(np.argmin(abs(analysis.input_angle - turn)))
    pin = pins(analysis, i)
    joints = np.array([[-1.5, 0, 0], [1.5, 0, 0]])
    first, second, third = (_direction(s) for s in (analysis.drive.first_angle, 0.0, analysis.drive.second_angle))
    if new(ax):
        ax.set(xlim=(-3.5, 3.5), ylim=(-1.75, 1.75), title="Input (grey), intermediate (orange), driven shaft (blue)")
        ax.set_aspect("equal")
        ax.set_axis_off()
    table = Turntable(ax, np.eye(3), np.zeros(3), 3.5, 2.0, azimuth, elevation)
    forks = (
        ("input", joints[0], -first, pin["input"], joints[0] - 1.9 * first),
        ("intermediate", joints[0], second, pin["intermediate, first"], np.zeros(3)),
        ("intermediate", joints[1], -second, pin["intermediate, second"], np.zeros(3)),
        ("driven", joints[1], third, pin["driven"], joints[1] + 1.9 * third),
    )
    for k, (name, joint, away, direction, end) in enumerate(forks):
        _fork(table, f"{name} {k}", joint, away, REACH * direction, end, COLOUR[name])
    return ax


def _fork(table: Turntable, key: str, joint: Any, away: Any, pin: Any, end: Any, colour: str) -> None:
    """Half a shaft with its fork, and the pin that the fork carries: from ``-pin`` to ``pin`` at the joint."""
    root, back = joint + GAP * away, joint + 0.62 * GAP * away
    _bar(table, f"{key} shaft", [root, end], 10, color=colour)
    for side, half in (("left", pin), ("right", -pin)):
        _bar(table, f"{key} {side}", [joint + half, back + half, root], 8, color=colour)
        _bar(table, f"{key} {side} pin", [joint, joint + half], 4, color=INK)
        table.ball(f"{key} {side} end", joint + half, 8, color=INK)


def _bar(table: Turntable, key: str, points: Any, width: float, color: str) -> None:
    """A thick line through ``points``, in front of what lies behind it."""
    shape: Any = {"solid_capstyle": "round", "solid_joinstyle": "round"}
    drawn = table.path(key, np.transpose(points), linewidth=width, color=color, **shape)
    drawn.set_zorder(NEAR + 4 * table.seen(np.transpose(points))[2].mean() / table.radius)


def _over_a_turn(analysis: Any, ax: Axes, title: str, ylabel: str, curves: Mapping[str, Any]) -> Axes:
    """Values over the input angle, by the name of the shaft that they belong to."""
    first = new(ax)
    if first:
        frame(ax, title, "input angle  [deg]", ylabel)
        ax.set_xticks(range(0, 361, 90))
    for name, values in curves.items():
        shown = np.broadcast_to(values, analysis.input_angle.shape)
        # the even input needs no name where three would not find room
        label = "_" if name == "input" and len(curves) == 3 else name
        line(ax, name, analysis.input_angle / deg, shown, color=COLOUR[name], label=label)
    if first:
        beside_title(ax)
    return ax


def speeds(analysis: Any, ax: Axes) -> Axes:
    """Speeds of the three shafts over a turn of the input shaft, which turns evenly."""
    n = (analysis.drive.speed, analysis.intermediate_speed, analysis.output_speed)
    return _over_a_turn(analysis, ax, "Speed", "n  [rpm]", {k: v / rpm for k, v in zip(COLOUR, n, strict=True)})


def leads(analysis: Any, ax: Axes) -> Axes:
    """How far the intermediate and the driven shaft are ahead of the input shaft."""
    lead = {"intermediate": analysis.first.lead / deg, "driven": analysis.lead / deg}
    return _over_a_turn(analysis, ax, "Lead", "angle  [deg]", lead)


def torques(analysis: Any, ax: Axes) -> Axes:
    """Torque in the intermediate shaft at its driven end and in the driven shaft; that of the input shaft is even."""
    torque = (analysis.drive.torque, analysis.intermediate_torque, analysis.output_torque)
    return _over_a_turn(analysis, ax, "Torque", "T  [N m]", dict(zip(COLOUR, torque, strict=True)))


def couples(analysis: Any, ax: Axes) -> Axes:
    """Secondary couples: what the torque that goes round a corner puts on the bearings of the outer shafts."""
    couple = {"input": analysis.input_couple, "driven": analysis.output_couple}
    return _over_a_turn(analysis, ax, "Couple", "C  [N m]", couple)


JOINT_VIEWS = (drive, speeds, leads, torques, couples)
"""What a designer of the drive wants to see at once."""
