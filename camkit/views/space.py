"""Views of a linkage in space, on a turntable, and of its curves over the crank angle.

The crank is the first of the series, the rocker the second; trouble is where the crank cannot go, and a box that a
link breaks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, Protocol, Unpack

import numpy as np

from ..geometry import dot
from ..quantities import Measure
from ..quantities.types import Array, Value
from ..units import deg, mm
from .picture import Axes, Band, Colour, Line, Mark, Picture, Points, Polygon, Text, gaps
from .turntable import Turntable

CIRCLE = np.linspace(0, 2 * np.pi, 181)
CRANK: Colour = {"role": "series", "index": 0}
ROCKER: Colour = {"role": "series", "index": 1}
NEITHER: Colour = {}
GRID = 50.0
"""Width of a square of the floor, mm."""


class Box(Protocol):
    """A space for the links, or without them, and how deep in it or how far from it a chain of points is, m."""

    @property
    def name(self) -> str: ...
    @property
    def low(self) -> tuple[float, float, float]: ...
    @property
    def high(self) -> tuple[float, float, float]: ...
    def depth(self, points: Array) -> Array: ...
    def clearance(self, start: Array, end: Array) -> Array: ...


class Ball(Protocol):
    """A ball joint: the axis of its socket as its link sees it, and the coupler's angle from there."""

    @property
    def axis(self) -> Array: ...
    @property
    def angle(self) -> Array: ...
    def in_space(self, axis: Array) -> Array: ...


class Linkage(Protocol):
    """A crank and a rocker about axes in space: where these are, and where the crank can go."""

    @property
    def crank(self) -> Value: ...
    @property
    def rocker(self) -> Value: ...
    @property
    def crank_root(self) -> Array: ...
    @property
    def crank_axis(self) -> Array: ...
    @property
    def rocker_root(self) -> Array: ...
    @property
    def rocker_axis(self) -> Array: ...
    @property
    def all_limit_angles(self) -> Array: ...
    def crank_direction(self, angle: Value) -> Array: ...
    def rocker_direction(self, angle: Value) -> Array: ...
    def assembles(self, crank_angle: Value) -> Array: ...


class Linked(Protocol):
    """A linkage at some crank angles, assembled in one of its two ways."""

    @property
    def linkage(self) -> Linkage: ...
    @property
    def load(self) -> Any: ...
    @property
    def branch(self) -> int: ...
    @property
    def crank_angle(self) -> Array: ...
    @property
    def rocker_angle(self) -> Array: ...
    @property
    def chain(self) -> Array: ...
    @property
    def crank_joint(self) -> Array: ...
    @property
    def rocker_joint(self) -> Array: ...
    @property
    def crank_motion(self) -> Array: ...
    @property
    def rocker_motion(self) -> Array: ...
    @property
    def coupler_direction(self) -> Array: ...
    @property
    def crank_pressure_angle(self) -> Array: ...
    @property
    def rocker_pressure_angle(self) -> Array: ...
    @property
    def ratio(self) -> Array: ...
    @property
    def acceleration_ratio(self) -> Array: ...
    @property
    def frictionless(self) -> Linked: ...
    @property
    def crank_ball(self) -> Ball: ...
    @property
    def rocker_ball(self) -> Ball: ...
    @property
    def crank_torque(self) -> Array: ...
    @property
    def resisting_torque(self) -> Array: ...
    @property
    def coupler_force(self) -> Array: ...
    @property
    def rocker_bearing_force(self) -> Array: ...
    def at(self, crank_angle: float, branch: int | None = None) -> Linked: ...
    def one_turn(self, branch: int | None = None) -> Linked: ...


def linkage_in_space(
    analysis: Linked,
    turn: float | None = None,
    azimuth: float = -60 * deg,
    elevation: float = 25 * deg,
    inside: Box | None = None,
    outside: Box | None = None,
    cones: bool = False,
) -> Picture:
    """The linkage at crank angle ``turn``, seen from ``azimuth`` and ``elevation`` (rad), the rocker's axis upright.

    Faint: the other way to assemble it.  Trouble: where the crank cannot go.  The edges of the boxes to stay
    ``inside`` and ``outside`` of are in trouble when a link breaks them.  ``cones``: those that the coupler needs in
    both ball joints over the sweep, instead of the pressure angles.
    """
    here = analysis.at(_middle(analysis.crank_angle) if turn is None else turn)
    boxes = [box for box in (inside, outside) if box]
    scene = scene_of(analysis.linkage, boxes, azimuth, elevation)
    _ground(scene, here)
    _sweeps(scene, analysis)
    if inside is not None:
        _box(scene, inside, kept=(inside.depth(analysis.chain) >= 0).all())
    if outside is not None:
        _box(scene, outside, kept=(outside.clearance(analysis.chain[:, :-1], analysis.chain[:, 1:]) >= 0).all())
    _leaf(scene, here)
    _links(scene, here)
    if cones:
        _cones(scene, analysis, here)
    else:
        _pressure_angles_at(scene, here)
    ends = (-scene.radius, scene.radius), (-1.2 * scene.radius, 0.96 * scene.radius)
    said = f"crank {here.crank_angle[0] / deg:.1f}°   rocker {here.rocker_angle[0] / deg:.1f}°"
    numbers = Text("numbers", ends[0][0], ends[1][1], said, anchor="left top", size=11)
    return scene.picture(Axes(title="Linkage in space", equal=True, bare=True, xlim=ends[0], ylim=ends[1]), numbers)


def _middle(crank_angle: Array) -> float:
    return float(crank_angle[[0, -1]].mean())


def crank_circle(linkage: Linkage, angle: Value) -> np.ndarray:
    """Places of the crank's ball joint, mm."""
    return (linkage.crank_root[:, None] + linkage.crank * linkage.crank_direction(angle)) / mm


def rocker_circle(linkage: Linkage, angle: Value) -> np.ndarray:
    """Places of the rocker's ball joint, mm."""
    return (linkage.rocker_root[:, None] + linkage.rocker * linkage.rocker_direction(angle)) / mm


def scene_of(linkage: Linkage, boxes: Sequence[Box], azimuth: float, elevation: float) -> Turntable:
    """A turntable that holds both circles whole, so that nothing jumps while the crank turns, and the boxes."""
    corners = (np.transpose(list(product(*zip(box.low, box.high, strict=True)))) / mm for box in boxes)
    points = np.hstack([crank_circle(linkage, CIRCLE), rocker_circle(linkage, CIRCLE), *corners])
    centre = (points.min(1) + points.max(1)) / 2
    radius = 1.02 * np.linalg.norm(points - centre[:, None], axis=0).max()
    x, up = np.array([1.0, 0.0, 0.0]), linkage.rocker_axis
    depth = dot(up[:, None], centre[:, None] - points).max() + 20
    return Turntable(np.stack([x, np.cross(up, x), up]), centre, radius, depth, azimuth, elevation)


def _ground(scene: Turntable, here: Linked) -> None:
    """Floor, shadows, plumb lines, and both axes."""
    chain, linkage = here.chain[..., 0] / mm, here.linkage
    scene.floor("floor", GRID)
    scene.shadow("shadow", chain)
    (b, c), (b0, c0) = chain[:, 1:3].T, scene.dropped(chain[:, 1:3]).T
    plumb = np.stack([b, b0, np.full(3, np.nan), c, c0], axis=1)
    scene.path("plumb lines", plumb, at=2.0, role="guide", stroke="dotted")
    for name, root, axis, style in (
        ("crank axis", linkage.crank_root, linkage.crank_axis, CRANK),
        ("rocker axis", linkage.rocker_root, linkage.rocker_axis, ROCKER),
    ):
        scene.axis(name, root / mm, 0.4 * scene.radius * axis, label=name, **style)


def _sweeps(scene: Turntable, analysis: Linked) -> None:
    """Both circles, what is swept of them, and where the crank cannot go."""
    linkage = analysis.linkage
    for name, circle, swept, root, style in (
        ("crank", crank_circle, analysis.crank_angle, linkage.crank_root, CRANK),
        ("rocker", rocker_circle, analysis.rocker_angle, linkage.rocker_root, ROCKER),
    ):
        sector = np.hstack([root[:, None] / mm, circle(linkage, swept)])
        scene.face(f"{name} sweep", sector, opacity=0.16, **style)
        scene.path(f"{name} swept", circle(linkage, swept), at=3.1, **style)
        scene.path(f"{name} circle", circle(linkage, CIRCLE), at=4.0, stroke="thin", **style)
    never = gaps(crank_circle(linkage, CIRCLE), ~linkage.assembles(CIRCLE))
    scene.path("never", never, at=5.0, role="trouble", label="never reached")
    x, y, _ = scene.seen(crank_circle(linkage, linkage.all_limit_angles))
    scene.put(5.0, Points("limits", x, y, role="trouble", size=6))


def _box(scene: Turntable, box: Box, kept: np.bool_) -> None:
    low, high = np.divide(box.low, mm), np.divide(box.high, mm)
    scene.box(box.name, low, high, kept, role="guide", stroke="thin", label=box.name)
    scene.box(f"{box.name}, broken", low, high, ~kept, role="trouble", stroke="thin")


def _leaf(scene: Turntable, here: Linked) -> None:
    """A leaf that turns with the rocker, where the load's centre of gravity is."""
    linkage, size = here.linkage, 0.9 * scene.radius
    along = linkage.rocker_direction(here.rocker_angle + here.load.mass_angle)[:, 0]
    foot = scene.dropped(linkage.rocker_root[:, None] / mm)[:, 0]
    up = linkage.rocker_axis * (scene.depth + 0.55 * scene.radius)
    corners = np.stack([foot, foot + size * along, foot + size * along + up, foot + up], axis=1)
    scene.face("leaf", corners, at=3.5, role="flank", opacity=0.18, edged=True)


def _links(scene: Turntable, here: Linked) -> None:
    """Crank, coupler and rocker, and faintly the coupler and the rocker of the other branch."""
    root, b, c, hinge = np.moveaxis(here.chain[..., 0] / mm, 1, 0)
    other = here.at(here.crank_angle[0], -here.branch).rocker_joint[:, 0] / mm
    faint = np.stack([b, other, hinge], axis=1)
    scene.path("other branch", faint, at=4.5, role="ghost", stroke="arm", label="other branch")
    for name, ends, style in (
        ("crank", (root, b), CRANK),
        ("coupler", (b, c), NEITHER),
        ("rocker", (hinge, c), ROCKER),
    ):
        scene.link(name, np.stack(ends, axis=1), label=name, **style)
    for name, point, style in (("crank root", root, CRANK), ("hinge", hinge, ROCKER)):
        scene.ball(name, point, 8, fill="paper", **style)
    for name, point in (("B", b), ("C", c)):
        scene.ball(name, point, 12, fill="paper")


def _pressure_angles_at(scene: Turntable, here: Linked) -> None:
    """At each ball joint the way it moves, and the angle between that and the coupler."""
    size = 0.34 * scene.radius
    for sign, joint, motion, angle, style, name in (
        (1, here.crank_joint, here.crank_motion, here.crank_pressure_angle, CRANK, "α₁"),
        (-1, here.rocker_joint, here.rocker_motion, here.rocker_pressure_angle, ROCKER, "α₂"),
    ):
        start, moves, along = joint[:, 0] / mm, motion[:, 0], sign * here.coupler_direction[:, 0]
        moves = moves * np.where(dot(moves, along) >= 0, 1, -1)
        label = "path of the joint" if sign > 0 else ""
        scene.arrow(f"{name} way", start, size * moves, role="velocity", label=label)
        share = np.linspace(0, 1, 13)
        fan = moves[:, None] * (1 - share) + along[:, None] * share
        arc = start[:, None] + 0.62 * size * fan / np.linalg.norm(fan, axis=0)
        scene.path(f"{name} arc", arc, at=18.0, **style)
        place = start - 0.45 * size * (arc[:, 6] - start) / np.linalg.norm(arc[:, 6] - start, axis=0)
        scene.words(name, place, f"{name} {angle[0] / deg:.0f}°", size=11, bold=True)


def _cones(scene: Turntable, analysis: Linked, here: Linked) -> None:
    """At each ball joint the smallest cone that holds the coupler all over the sweep, and half its angle."""
    for ball, now, joint, style, name in (
        (analysis.crank_ball, here.crank_ball, here.crank_joint, CRANK, "B"),
        (analysis.rocker_ball, here.rocker_ball, here.rocker_joint, ROCKER, "C"),
    ):
        tip, along, half = joint[:, 0] / mm, now.in_space(ball.axis)[:, 0], ball.angle.max()
        beside = np.where(abs(along[0]) < 0.8, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
        first = np.cross(along, beside)
        first = first / np.sqrt(dot(first, first))
        around = np.outer(first, np.cos(CIRCLE)) + np.outer(np.cross(along, first), np.sin(CIRCLE))
        size = 0.3 * scene.radius
        rim = (tip + size * np.cos(half) * along)[:, None] + size * np.sin(half) * around
        scene.face(f"{name} cone", rim, at=17.0, opacity=0.25, **style)
        sides = np.stack([np.stack([tip, rim[:, i], np.full(3, np.nan)], axis=1) for i in range(0, 180, 20)], axis=1)
        scene.path(f"{name} sides", sides.reshape(3, -1), at=17.0, stroke="thin", **style)
        scene.words(f"{name} half", tip + 1.15 * size * along, f"±{half / deg:.0f}°", size=11, bold=True)


def ball_joints(analysis: Linked, turn: float | None = None) -> Picture:
    """Angle between the coupler and the axis of each socket, the best for the sweep: its peak is half the cone."""
    return Picture.of(
        _swept("Ball joints", "angle from the socket's axis  [deg]"),
        _curve("crank", analysis.crank_angle, analysis.crank_ball.angle / deg, turn, **CRANK),
        _curve("rocker", analysis.crank_angle, analysis.rocker_ball.angle / deg, turn, **ROCKER),
    )


def _curve(key: str, x: Array, y: Array, turn: float | None, named: bool = True, **style: Unpack[Colour]) -> list[Mark]:
    """A curve over the crank angle (rad), ``named`` in the legend, with a dot where the crank stands."""
    at = np.nan if turn is None else gaps(turn, (x.min() <= turn) & (turn <= x.max()))
    return [
        Line(key, x / deg, y, label=key if named else "", **style),
        Points(f"{key} now", at / deg, _between(at, x, np.broadcast_to(y, x.shape)), size=7, **style),
    ]


def _between(at: Value, x: Array, y: Array) -> Array:
    """What stands at ``at`` on a curve, straight between its points, of which ``x`` grows or falls throughout."""
    falls = x[-1] < x[0]
    x, y = np.where(falls, x[::-1], x), np.where(falls, y[::-1], y)
    i = np.clip(np.sum(x <= at) - 1, 0, len(x) - 2)
    (x0, x1), (y0, y1) = ((np.take(values, i), np.take(values, i + 1)) for values in (x, y))
    return y0 + (at - x0) / (x1 - x0) * (y1 - y0)


def _swept(title: str, ylabel: str, ylim: tuple[float, float] | None = None) -> Axes:
    return Axes(title=title, xlabel="crank angle  [deg]", ylabel=ylabel, ylim=ylim)


def output_angle(analysis: Linked, turn: float | None = None) -> Picture:
    """Rocker angle over one turn of the crank, both branches; bold is the sweep, shaded where the crank cannot go."""
    own, other = analysis.one_turn(), analysis.one_turn(-analysis.branch)
    x = own.crank_angle[:, 0] / deg
    start, end = analysis.crank_angle[[0, -1]] / deg
    wall = np.where(own.linkage.assembles(own.crank_angle[:, 0]), 0, 360)
    now = analysis.at(_middle(analysis.crank_angle) if turn is None else turn)
    at, angle = now.crank_angle / deg, np.mod(now.rocker_angle, 2 * np.pi) / deg
    swept = _unbroken(analysis.rocker_angle)
    return Picture.of(
        _swept("Output angle", "rocker angle  [deg]", ylim=(0, 360)),
        Polygon("sweep", [start, end, end, start], [0, 0, 360, 360], role="body"),
        Polygon(
            "never", np.concatenate([x[:1], x, x[-1:]]), np.concatenate([[0], wall, [0]]), role="trouble", opacity=0.15
        ),
        Line("other", x, _unbroken(other.rocker_angle[:, 0]), role="guide", label="other branch"),
        Line("own", x, _unbroken(own.rocker_angle[:, 0]), stroke="line", **ROCKER),
        Line("swept", analysis.crank_angle / deg, swept, stroke="bold", **ROCKER),
        Points("now", at, angle, size=8, fill="paper", **ROCKER),
    )


def _unbroken(angle: Array) -> np.ndarray:
    """Angles in degrees within one turn, without a line across where they pass 360."""
    shown = np.mod(angle, 2 * np.pi) / deg
    return gaps(shown, np.append(abs(np.diff(shown)) < 180, True))


def pressure_angles(
    analysis: Linked, turn: float | None = None, limits: Mapping[Measure, float] | None = None
) -> Picture:
    """Both pressure angles over the sweep, with the ``limits`` of their measures; without any, none is shown."""
    allowed = {value / deg for measure, value in (limits or {}).items() if "pressure angle" in measure.name}
    x = analysis.crank_angle
    return Picture.of(
        _swept("Pressure angle", "α  [deg]", ylim=(0, 90)),
        [Band(f"limit {i}", limit, limit, role="limit") for i, limit in enumerate(sorted(allowed))],
        _curve("crank", x, analysis.crank_pressure_angle / deg, turn, **CRANK),
        _curve("rocker", x, analysis.rocker_pressure_angle / deg, turn, **ROCKER),
    )


def velocity_ratio(analysis: Linked, turn: float | None = None) -> Picture:
    """Rocker's speed over the crank's."""
    curve, dot = _curve("ratio", analysis.crank_angle, analysis.ratio, turn, named=False, role="velocity")
    return Picture.of(_swept("Velocity ratio", "dφ₃/dφ₁  [-]"), curve, dot)


def acceleration_ratio(analysis: Linked, turn: float | None = None) -> Picture:
    """Rocker's angular acceleration over the square of the crank's speed."""
    y = analysis.acceleration_ratio
    marks = _curve("acceleration", analysis.crank_angle, y, turn, named=False, role="acceleration")
    return Picture.of(_swept("Acceleration ratio", "d²φ₃/dφ₁²  [1/rad]"), marks)


def torques(analysis: Linked, turn: float | None = None) -> Picture:
    """Torque that turns the crank, with friction and without, and torque with which the rocker resists."""
    plain = analysis.frictionless.crank_torque
    return Picture.of(
        _swept("Torque", "M  [N m]"),
        Line("frictionless", analysis.crank_angle / deg, plain, role="guide"),
        _curve("on the crank", analysis.crank_angle, analysis.crank_torque, turn, **CRANK),
        _curve("resisting", analysis.crank_angle, analysis.resisting_torque, turn, **ROCKER),
    )


def forces(analysis: Linked, turn: float | None = None) -> Picture:
    """Force along the coupler, compression positive (the crank's bearing carries as much), and on the hinge."""
    hinge = np.linalg.norm(analysis.rocker_bearing_force, axis=0)
    return Picture.of(
        _swept("Force", "F  [N]"),
        _curve("coupler", analysis.crank_angle, analysis.coupler_force, turn),
        _curve("hinge", analysis.crank_angle, hinge, turn, **ROCKER),
    )
