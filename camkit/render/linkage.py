"""Views of an RSSR linkage: the linkage in space on a turntable, and its curves over the crank angle.

The crank is blue, the rocker orange; vermilion is where the crank cannot go, and a box that a link breaks.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..linkage.measures import TARGET, clearance_from, room_in
from ..units import deg, mm
from .artists import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    SKY,
    WARNING,
    area,
    beside_title,
    frame,
    gaps,
    line,
    new,
    text,
)
from .turntable import Turntable

LIMIT = 50 * deg
"""The usual limit of a linkage's pressure angle: a transmission angle of 40 deg."""

CIRCLE = np.linspace(0, 2 * np.pi, 181)
LEGEND = ("crank", "rocker", "coupler", "crank axis", "rocker axis", "other branch", "joint's way", "never reached")
FAINT = "#cbd2d9"
GRID = 50.0
"""Width of a square of the floor, mm."""


def linkage_in_space(
    analysis: Any,
    ax: Axes,
    turn: float | None = None,
    azimuth: float = -60 * deg,
    elevation: float = 25 * deg,
    inside: Any = None,
    outside: Any = None,
) -> Axes:
    """The linkage at crank angle ``turn``, seen from ``azimuth`` and ``elevation`` (rad), the rocker's axis upright.

    Faint: the other way to assemble it.  Vermilion: where the crank cannot go.  The edges of the boxes to stay
    ``inside`` and ``outside`` of turn vermilion when a link breaks them.
    """
    here = analysis.at(_middle(analysis) if turn is None else turn)
    boxes = [box for box in (inside, outside) if box]
    scene = scene_of(analysis.linkage, boxes, ax, azimuth, elevation)
    if new(ax):
        ax.set_title("Linkage in space")
        ax.set_axis_off()
        ax.set_aspect("equal", adjustable="box")
    scene.look()
    _ground(scene, here)
    _sweeps(scene, analysis)
    edges = []
    if inside is not None:
        edges.append(_box(scene, inside, broken=room_in(inside)(analysis) < 0))
    if outside is not None:
        edges.append(_box(scene, outside, broken=clearance_from(outside)(analysis) < 0))
    _door(scene, here)
    _links(scene, here)
    _pressure_angles_at(scene, here)
    text(ax, "numbers", 0.0, 0.99, _numbers(here), transform=ax.transAxes, va="top", color=INK, zorder=20)
    _legend(ax, edges)
    return ax


def _legend(ax: Axes, edges: list[Line2D]) -> None:
    """What the lines are, below the picture; the edges of the boxes in the colour that they have now."""
    by_name = {str(artist.get_label()): artist for artist in ax.lines}
    handles = [by_name[name] for name in LEGEND] + edges
    place: Any = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "ncols": 3, "columnspacing": 1.6}
    shown = (ax.get_legend() or ax.legend(handles=handles, **place)).get_lines()
    for one, edge in zip(shown[len(shown) - len(edges) :], edges, strict=True):
        one.set_color(edge.get_color())


def _middle(analysis: Any) -> float:
    return float(analysis.crank_angle[[0, -1]].mean())


def crank_circle(linkage: Any, angle: Any) -> np.ndarray:
    """Places of the crank's ball joint, mm."""
    return (linkage.crank_root[:, None] + linkage.crank * linkage.crank_direction(angle)) / mm


def rocker_circle(linkage: Any, angle: Any) -> np.ndarray:
    """Places of the rocker's ball joint, mm."""
    return (linkage.rocker_root[:, None] + linkage.rocker * linkage.rocker_direction(angle)) / mm


def scene_of(linkage: Any, boxes: Any, ax: Axes, azimuth: float, elevation: float) -> Turntable:
    """A turntable that holds both circles whole, so that nothing jumps while the crank turns, and the boxes."""
    corners = (np.transpose(list(product(*zip(box.low, box.high, strict=True)))) / mm for box in boxes)
    points = np.hstack([crank_circle(linkage, CIRCLE), rocker_circle(linkage, CIRCLE), *corners])
    centre = (points.min(1) + points.max(1)) / 2
    radius = 1.02 * float(np.linalg.norm(points - centre[:, None], axis=0).max())
    x, up = np.array([1.0, 0.0, 0.0]), linkage.rocker_axis
    depth = float((up @ (centre[:, None] - points)).max()) + 20
    return Turntable(ax, np.stack([x, np.cross(up, x), up]), centre, radius, depth, azimuth, elevation)


def _ground(scene: Turntable, here: Any) -> None:
    """Floor, shadows, plumb lines, and both axes."""
    chain, linkage = here.chain[..., 0] / mm, here.linkage
    scene.floor("floor", GRID)
    scene.shadow("shadow", chain, linewidth=5)
    (b, c), (b0, c0) = chain[:, 1:3].T, scene.dropped(chain[:, 1:3]).T
    plumb = np.stack([b, b0, np.full(3, np.nan), c, c0], axis=1)
    scene.path("plumb lines", plumb, color=GREY, linewidth=0.9, linestyle=":", zorder=2, label="_")
    for name, root, axis, colour in (
        ("crank axis", linkage.crank_root, linkage.crank_axis, BLUE),
        ("rocker axis", linkage.rocker_root, linkage.rocker_axis, ORANGE),
    ):
        scene.axis(name, root / mm, 0.4 * scene.radius * axis, color=colour, zorder=4, label=name)


def _sweeps(scene: Turntable, analysis: Any) -> None:
    """Both circles, what is swept of them, and where the crank cannot go."""
    linkage = analysis.linkage
    for name, circle, swept, root, colour in (
        ("crank", crank_circle, analysis.crank_angle, linkage.crank_root, BLUE),
        ("rocker", rocker_circle, analysis.rocker_angle, linkage.rocker_root, ORANGE),
    ):
        sector = np.hstack([root[:, None] / mm, circle(linkage, swept)])
        scene.face(f"{name} sweep", sector, facecolor=(colour, 0.16), edgecolor=colour, linewidth=1.6, zorder=3)
        scene.path(f"{name} circle", circle(linkage, CIRCLE), color=colour, linewidth=0.9, zorder=4, label="_")
    never = gaps(crank_circle(linkage, CIRCLE), ~linkage.assembles(CIRCLE))
    scene.path("never", never, color=WARNING, linewidth=3, zorder=5, label="never reached")
    limits = crank_circle(linkage, linkage.limit_angles())
    scene.path("limits", limits, color=WARNING, linestyle="none", marker="o", markersize=6, zorder=5, label="_")


def _box(scene: Turntable, box: Any, broken: bool) -> Line2D:
    edges = scene.box(
        box.name, np.divide(box.low, mm), np.divide(box.high, mm), linewidth=1.2, zorder=3, label=box.name
    )
    edges.set_color(WARNING if broken else GREY)
    return edges


def _door(scene: Turntable, here: Any) -> None:
    """A leaf that turns with the rocker, where the load's centre of gravity is."""
    linkage, size = here.linkage, 0.9 * scene.radius
    along = linkage.rocker_direction(here.rocker_angle + here.load.mass_angle)[:, 0]
    foot = scene.dropped(linkage.rocker_root[:, None] / mm)[:, 0]
    up = linkage.rocker_axis * (scene.depth + 0.55 * scene.radius)
    corners = np.transpose([foot, foot + size * along, foot + size * along + up, foot + up])
    scene.face("door", corners, facecolor=SKY, edgecolor=SKY, alpha=0.18, zorder=3.5)


def _links(scene: Turntable, here: Any) -> None:
    """Crank, coupler and rocker, and faintly the coupler and the rocker of the other branch."""
    root, b, c, hinge = np.moveaxis(here.chain[..., 0] / mm, 1, 0)
    other = here.at(float(here.crank_angle[0]), -here.branch).rocker_joint[:, 0] / mm
    faint = {"linewidth": 4, "color": FAINT, "solid_capstyle": "round", "zorder": 4.5}
    scene.path("other branch", np.stack([b, other, hinge], axis=1), label="other branch", **faint)
    for name, ends, colour in (("crank", (root, b), BLUE), ("coupler", (b, c), INK), ("rocker", (hinge, c), ORANGE)):
        scene.link(name, np.stack(ends, axis=1), 6, color=colour, label=name)
    for name, point, colour in (("crank root", root, BLUE), ("hinge", hinge, ORANGE)):
        scene.ball(name, point, 8, color=colour, markerfacecolor="white", markeredgewidth=2.5, label="_")
    for name, point in (("B", b), ("C", c)):
        scene.ball(name, point, 12, color=INK, markerfacecolor=SKY, markeredgewidth=1.5, label="_")


def _pressure_angles_at(scene: Turntable, here: Any) -> None:
    """At each ball joint the way it moves, and the angle between that and the coupler."""
    size = 0.34 * scene.radius
    for sign, joint, motion, angle, colour, name in (
        (1, here.crank_joint, here.crank_motion, here.crank_pressure_angle, BLUE, "α₁"),
        (-1, here.rocker_joint, here.rocker_motion, here.rocker_pressure_angle, ORANGE, "α₂"),
    ):
        start, moves, along = joint[:, 0] / mm, motion[:, 0], sign * here.coupler_direction[:, 0]
        moves = moves * (1 if moves @ along >= 0 else -1)
        label = "joint's way" if sign > 0 else "_"
        scene.arrow(f"{name} way", start, size * moves, color=GREEN, linewidth=2.2, zorder=18, label=label)
        share = np.linspace(0, 1, 13)
        fan = np.outer(moves, 1 - share) + np.outer(along, share)
        arc = start[:, None] + 0.62 * size * fan / np.linalg.norm(fan, axis=0)
        scene.path(f"{name} arc", arc, color=colour, linewidth=2, zorder=18, label="_")
        said = f"{name} {angle[0] / deg:.0f}°"
        place = start - 0.45 * size * (arc[:, 6] - start) / np.linalg.norm(arc[:, 6] - start)
        scene.words(name, place, said, color=INK, fontsize=11, weight="bold", ha="center", va="center", zorder=19)


def _numbers(here: Any) -> str:
    """Where it stands, in words."""
    turn, rocker = float(here.crank_angle[0]) / deg, float(here.rocker_angle[0]) / deg
    return f"crank {turn:.1f}°   rocker {rocker:.1f}°"


def _curve(ax: Axes, key: str, x: Any, y: Any, turn: float | None, **style: Any) -> None:
    """A curve over the crank angle (rad) with a dot where the crank stands."""
    line(ax, key, x / deg, y, label=key, **style)
    at = np.nan if turn is None or not x.min() <= turn <= x.max() else turn
    order = np.argsort(x)
    dot = np.interp(at, x[order], np.broadcast_to(y, x.shape)[order])
    line(ax, f"{key} now", [at / deg], [dot], marker="o", markersize=7, color=style["color"], zorder=9, label="_")


def _swept(ax: Axes, title: str, ylabel: str) -> bool:
    """Title and labels of a curve over the sweep; whether they were new."""
    first = new(ax)
    if first:
        frame(ax, title, "crank angle  [deg]", ylabel)
    return first


def output_angle(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Rocker angle over one turn of the crank, both branches; bold is the sweep, shaded where the crank cannot go."""
    first = _swept(ax, "Output angle", "rocker angle  [deg]")
    if first:
        ax.set(ylim=(0, 360), yticks=range(0, 361, 90))
    own, other = analysis.one_turn(), analysis.one_turn(-analysis.branch)
    x = own.crank_angle[:, 0] / deg
    start, end = analysis.crank_angle[[0, -1]] / deg
    area(ax, "sweep", [[start, end, end, start], [0, 0, 360, 360]], color=PALE, zorder=0.5)
    wall = np.where(own.linkage.assembles(own.crank_angle[:, 0]), 0, 360)
    hatched = {"facecolor": "none", "edgecolor": WARNING, "hatch": "////", "linewidth": 0}
    area(ax, "never", [[x[0], *x, x[-1]], [0, *wall, 0]], zorder=0.6, **hatched)
    line(ax, "other", x, _unbroken(other.rocker_angle[:, 0]), color=GREY, linewidth=1.4, label="other branch")
    line(ax, "own", x, _unbroken(own.rocker_angle[:, 0]), color=ORANGE, linewidth=1.4, label="_")
    swept = _unbroken(analysis.rocker_angle)
    line(ax, "swept", analysis.crank_angle / deg, swept, color=ORANGE, linewidth=3.4, label="_")
    now = analysis.at(_middle(analysis) if turn is None else turn)
    at, angle = now.crank_angle / deg, np.mod(now.rocker_angle, 2 * np.pi) / deg
    line(ax, "now", at, angle, marker="o", markersize=7, color=ORANGE, markeredgecolor=INK, zorder=9, label="_")
    if first:
        beside_title(ax)
    return ax


def _unbroken(angle: Any) -> np.ndarray:
    """Angles in degrees within one turn, without a line across where they pass 360."""
    shown = np.mod(angle, 2 * np.pi) / deg
    return gaps(shown, np.append(abs(np.diff(shown)) < 180, True))


def pressure_angles(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Both pressure angles over the sweep, with the target of 30 deg and the usual limit of 50 deg."""
    first = _swept(ax, "Pressure angle", "alpha  [deg]")
    if first:
        ax.axhline(TARGET / deg, color=GREEN, linewidth=1.4)
        ax.axhline(LIMIT / deg, color=WARNING, linewidth=1.4, linestyle="--")
        ax.set(ylim=(0, 90), yticks=(0, 30, 50, 90))
    _curve(ax, "crank", analysis.crank_angle, analysis.crank_pressure_angle / deg, turn, color=BLUE)
    _curve(ax, "rocker", analysis.crank_angle, analysis.rocker_pressure_angle / deg, turn, color=ORANGE)
    if first:
        beside_title(ax)
    return ax


def velocity_ratio(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Rocker's speed over the crank's."""
    _swept(ax, "Velocity ratio", "dφ₃/dφ₁  [-]")
    _curve(ax, "ratio", analysis.crank_angle, analysis.ratio, turn, color=PURPLE)
    return ax


def acceleration_ratio(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Rocker's angular acceleration over the square of the crank's speed."""
    _swept(ax, "Acceleration ratio", "d²φ₃/dφ₁²  [1/rad]")
    _curve(ax, "acceleration", analysis.crank_angle, analysis.acceleration_ratio, turn, color=PURPLE)
    return ax


def torques(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Torque that turns the crank, and torque with which the rocker resists."""
    first = _swept(ax, "Torque", "M  [N m]")
    _curve(ax, "on the crank", analysis.crank_angle, analysis.crank_torque, turn, color=BLUE)
    _curve(ax, "resisting", analysis.crank_angle, analysis.resisting_torque, turn, color=ORANGE)
    if first:
        beside_title(ax)
    return ax


def forces(analysis: Any, ax: Axes, turn: float | None = None) -> Axes:
    """Force along the coupler, compression positive (the crank's bearing carries as much), and on the hinge."""
    first = _swept(ax, "Force", "F  [N]")
    hinge = np.linalg.norm(analysis.rocker_bearing_force, axis=0)
    _curve(ax, "coupler", analysis.crank_angle, analysis.coupler_force, turn, color=INK)
    _curve(ax, "hinge", analysis.crank_angle, hinge, turn, color=ORANGE)
    if first:
        beside_title(ax)
    return ax


CURVES = (output_angle, pressure_angles, velocity_ratio, acceleration_ratio, torques, forces)
"""The curves of a linkage over the crank angle."""

LINKAGE_VIEWS = (linkage_in_space, *CURVES)
"""What a designer of a spatial linkage wants to see at once."""
