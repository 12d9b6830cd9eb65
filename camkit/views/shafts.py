"""Views of a drive of three shafts: in space, and over a turn of its input shaft."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol, Unpack

import numpy as np

from ..quantities.types import Array, Value
from ..units import deg, rpm
from .picture import Axes, Line, LineStyle, Picture
from .turntable import Turntable

ROLE = {"input": "guide", "intermediate": "follower", "driven": "position"}
ACROSS = np.array([0.0, 1.0, 0.0])
"""Normal of the plane in which the shafts of the drawing lie."""
REACH, GAP = 0.5, 0.85
"""Half the length of a pin and how far a fork reaches back from it, in lengths of which the middle shaft has 3."""


class Joints(Protocol):
    """The shape of a drive: its first and second joint angle and the phase of its forks, rad; what drives it."""

    @property
    def first_angle(self) -> Value: ...
    @property
    def second_angle(self) -> Value: ...
    @property
    def phase(self) -> Value: ...
    @property
    def speed(self) -> Value: ...
    @property
    def torque(self) -> Value: ...


class Lead(Protocol):
    """How far a shaft is ahead of the one that drives it, rad."""

    @property
    def lead(self) -> Value: ...


class Drive(Protocol):
    """Three shafts over a turn of the first."""

    @property
    def drive(self) -> Joints: ...
    @property
    def first(self) -> Lead: ...
    @property
    def lead(self) -> Value: ...
    @property
    def input_angle(self) -> Array: ...
    @property
    def intermediate_angle(self) -> Value: ...
    @property
    def output_angle(self) -> Value: ...
    @property
    def intermediate_speed(self) -> Value: ...
    @property
    def output_speed(self) -> Value: ...
    @property
    def intermediate_torque(self) -> Value: ...
    @property
    def output_torque(self) -> Value: ...
    @property
    def input_couple(self) -> Value: ...
    @property
    def output_couple(self) -> Value: ...


def _direction(slope: Value) -> np.ndarray:
    """Of a shaft that falls by ``slope`` (rad) to the right."""
    return np.stack([np.cos(slope), 0 * slope, -np.sin(slope)])


def _pin(axis: np.ndarray, angle: Value) -> np.ndarray:
    """The direction of a pin that has turned by ``angle`` about ``axis`` from the plane of the shafts."""
    upright = np.cross(axis, ACROSS)
    return np.cos(angle) * upright + np.sin(angle) * ACROSS


def pins(analysis: Drive, i: np.intp) -> dict[str, np.ndarray]:
    """Directions of the four pins at the input angle ``i``: of each shaft at each joint, as they stand in space."""
    drive, quarter = analysis.drive, np.pi / 2
    angles = analysis.input_angle, analysis.intermediate_angle, analysis.output_angle
    begin, middle, end = (np.take_along_axis(angle, np.expand_dims(i, 0), -1)[0] for angle in angles)
    middle = middle + quarter
    first, second, third = (_direction(slope) for slope in (drive.first_angle, 0.0, drive.second_angle))
    return {
        "input": _pin(first, begin),
        "intermediate, first": _pin(second, middle),
        "intermediate, second": _pin(second, middle + drive.phase),
        "driven": _pin(third, end + drive.phase + np.pi),
    }


def drive(analysis: Drive, turn: float = 0.0, azimuth: float = -75 * deg, elevation: float = 25 * deg) -> Picture:
    """The three shafts with their forks and crosses, the input shaft turned by ``turn`` (rad)."""
    pin = pins(analysis, np.argmin(abs(analysis.input_angle - turn)))
    joints = np.array([[-1.5, 0, 0], [1.5, 0, 0]])
    first, second, third = (_direction(s) for s in (analysis.drive.first_angle, 0.0, analysis.drive.second_angle))
    table = Turntable(np.eye(3), np.zeros(3), 3.5, 2.0, azimuth, elevation)
    forks = (
        ("input", joints[0], -first, pin["input"], joints[0] - 1.9 * first),
        ("intermediate", joints[0], second, pin["intermediate, first"], np.zeros(3)),
        ("intermediate", joints[1], -second, pin["intermediate, second"], np.zeros(3)),
        ("driven", joints[1], third, pin["driven"], joints[1] + 1.9 * third),
    )
    for k, (name, joint, away, direction, end) in enumerate(forks):
        fork(table, name, k, joint, away, REACH * direction, end)
    return table.picture(Axes(title="Drive", equal=True, bare=True, xlim=(-3.5, 3.5), ylim=(-1.75, 1.75)))


def fork(table: Turntable, name: str, k: int, joint: Array, away: Array, pin: Array, end: Array) -> None:
    """Half a shaft with its fork, and the pin that the fork carries: from ``-pin`` to ``pin`` at the joint."""
    root, back, key = joint + GAP * away, joint + 0.62 * GAP * away, f"{name} {k}"
    _bar(table, f"{key} shaft", [root, end], role=ROLE[name], stroke="shaft", label=f"{name} shaft")
    for side, half in (("left", pin), ("right", -pin)):
        _bar(table, f"{key} {side}", [joint + half, back + half, root], role=ROLE[name], stroke="shaft")
        _bar(table, f"{key} {side} pin", [joint, joint + half], stroke="arm")
        table.ball(f"{key} {side} end", joint + half, 8)


def _bar(table: Turntable, key: str, points: Sequence[Array], **style: Unpack[LineStyle]) -> None:
    table.bar(key, np.stack(points, axis=-1), **style)


def _over_a_turn(angle: Array, title: str, ylabel: str, curves: Mapping[str, Value]) -> Picture:
    """Values over the input angle, by the name of the shaft that they belong to."""
    marks = []
    for name, values in curves.items():
        shown = np.broadcast_to(values, angle.shape)
        # the even input needs no name where three would not find room
        label = "" if name == "input" and len(curves) == 3 else name
        marks.append(Line(name, angle / deg, shown, role=ROLE[name], stroke="line", label=label))
    return Picture.of(Axes(title=title, xlabel="input angle  [deg]", ylabel=ylabel), marks)


def speeds(analysis: Drive) -> Picture:
    """Speeds of the three shafts over a turn of the input shaft, which turns evenly."""
    n = (analysis.drive.speed, analysis.intermediate_speed, analysis.output_speed)
    return _over_a_turn(analysis.input_angle, "Speed", "n  [rpm]", {k: v / rpm for k, v in zip(ROLE, n, strict=True)})


def leads(analysis: Drive) -> Picture:
    """How far the intermediate and the driven shaft are ahead of the input shaft."""
    lead = {"intermediate": analysis.first.lead / deg, "driven": analysis.lead / deg}
    return _over_a_turn(analysis.input_angle, "Lead", "angle  [deg]", lead)


def torques(analysis: Drive) -> Picture:
    """Torque in the intermediate shaft at its driven end and in the driven shaft; that of the input shaft is even."""
    torque = (analysis.drive.torque, analysis.intermediate_torque, analysis.output_torque)
    return _over_a_turn(analysis.input_angle, "Torque", "T  [N m]", dict(zip(ROLE, torque, strict=True)))


def couples(analysis: Drive) -> Picture:
    """Secondary couples: what the torque that goes round a corner puts on the bearings of the outer shafts."""
    couple = {"input": analysis.input_couple, "driven": analysis.output_couple}
    return _over_a_turn(analysis.input_angle, "Couple", "C  [N m]", couple)
