"""Views of what turns about an axis in space: unrolled, and as it is, on a turntable.

They show whatever analysis offers a ``development`` (bodies, see `camkit.geometry.Body`) or ``shapes`` (see
`camkit.geometry.Shape`).
"""

from __future__ import annotations

from functools import reduce
from typing import Protocol

import numpy as np

from ..geometry import Body, Cylinder, Shape, Strip, dot, rotated
from ..quantities.types import Array
from ..units import deg, mm
from .cam import PARTS, bodies, position
from .picture import Axes, Line, Mark, Picture, Polygon, Text, gaps
from .turntable import NEAR, Turntable

FRONT = np.linspace(-np.pi / 2, np.pi / 2, 37)
"""The half of a cylinder that is seen, from edge to edge."""
SHADES = tuple(np.linspace(edge, np.pi / 2, 13) for edge in (0.55, 0.9, 1.2))
FILLS = {"floor": ("guide", 0.55), "wall": ("profile", 0.4), "face": ("profile", 0.4)}
"""How the inside of a groove, and what the roller runs on, is filled."""
EDGES = {"profile": "profile", "flank": "flank", "face": "profile"}
"""What the first edge of a strip is."""
LEAST = 1e-9
"""A cylinder that is seen along its axis within this has edges all the same."""


class Unrolled(Protocol):
    """A cam that is shown unrolled, with the follower where it is on it."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def development(self) -> tuple[Body, ...]: ...
    @property
    def pitch(self) -> Array: ...
    @property
    def normal(self) -> Array: ...
    @property
    def way(self) -> Array: ...
    @property
    def pressure_angle(self) -> Array: ...


class Solid(Protocol):
    """A mechanism in space."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def shapes(self) -> tuple[Shape, ...]: ...


def unrolled_cam(analysis: Unrolled, turn: float = 0.0) -> Picture:
    """The cam unrolled, to scale, with the follower at cam angle ``turn`` (rad), and its pressure angle there.

    Of a groove the band between its two flanks is filled; trouble: stretches that the follower undercuts.
    """
    i = position(analysis.cam_angle, turn)
    axes = Axes(title="Groove, unrolled", xlabel="around the drum  [mm]", ylabel="along it  [mm]", equal=True)
    return Picture.of(axes, bodies(analysis.development, i), _pressure_angle_at(analysis, i))


def _pressure_angle_at(analysis: Unrolled, i: np.intp) -> list[Mark]:
    """From the roller's centre the way that it goes, the contact normal, and the angle between them."""
    place, normal = (np.take(vectors, i, axis=-1) for vectors in (analysis.pitch, analysis.normal))
    way = np.stack([np.take(part + 0.0 * analysis.cam_angle, i, axis=-1) for part in analysis.way])
    (x, y), size = place / mm, 0.16 * np.ptp(analysis.pitch[0]) / mm
    angle = abs(np.take(analysis.pressure_angle, i, axis=-1))
    lean = np.where(way[0] * normal[1] - way[1] * normal[0] >= 0, angle, -angle)
    arc = 0.75 * size * rotated(way[:, None], lean * np.linspace(0, 1, 13))
    u, v = 1.3 * size * rotated(way, lean / 2)
    lines = [("way", way, "velocity", "direction of motion"), ("normal", normal, "ink", "contact normal")]
    return [
        *(
            Line(key, np.stack([x, x + size * dx]), np.stack([y, y + size * dy]), role=role, label=label)
            for key, (dx, dy), role, label in lines
        ),
        Line("pressure angle", x + arc[0], y + arc[1], stroke="thin"),
        Text("alpha", x + u, y + v, f"α {angle / deg:.1f}°", size=11, bold=True),
    ]


def shapes_in_space(
    analysis: Solid, turn: float = 0.0, azimuth: float = -60 * deg, elevation: float = 25 * deg
) -> Picture:
    """The mechanism in space at cam angle ``turn``, seen from ``azimuth`` and ``elevation`` (rad), to scale.

    Trouble: stretches that the follower undercuts.
    """
    i, shapes = position(analysis.cam_angle, turn), analysis.shapes
    scene = _scene(shapes, azimuth, elevation)
    for k, shape in enumerate(shapes):
        if isinstance(shape, Cylinder):
            _cylinder(scene, shape, shape.at(i) / mm, f"{shape.part} {k}", 0.01 * k)
        if isinstance(shape, Strip):
            _strip(scene, shape, shape.at(i) / mm, f"{shape.part} {k}", NEAR + 0.01 * k)
    ends = (-1.05 * scene.radius, 1.05 * scene.radius)
    return scene.picture(Axes(title="In space", equal=True, bare=True, xlim=ends, ylim=ends))


def _scene(shapes: tuple[Shape, ...], azimuth: float, elevation: float) -> Turntable:
    """A turntable that holds every shape wherever it goes, z upright."""
    across, low, high = zip(*(shape.extent for shape in shapes), strict=True)
    top, bottom, wide = (
        reduce(of, each) / mm for of, each in ((np.maximum, high), (np.minimum, low), (np.maximum, across))
    )
    half = (top - bottom) / 2
    centre = np.stack([0.0 * half, 0.0 * half, bottom + half])
    return Turntable(np.eye(3), centre, np.hypot(wide, half), half, azimuth, elevation)


def _cylinder(scene: Turntable, shape: Cylinder, ends: Array, key: str, over: float) -> None:
    """A round bar: its outline, the end that is seen, and shades towards the edges of a solid."""
    along = ends[:, 1] - ends[:, 0]
    edge = np.cross(along, scene.eye[2] + LEAST * scene.eye[1])
    front = np.cross(edge, along)
    edge, front = (shape.radius / mm * vector / np.sqrt(dot(vector, vector)) for vector in (edge, front))
    nearer = dot(along, scene.eye[2]) >= 0
    near, far = np.where(nearer, ends[:, 1], ends[:, 0]), np.where(nearer, ends[:, 0], ends[:, 1])

    def around(middle: Array, angle: Array) -> Array:
        return middle[:, None] + edge[:, None] * np.sin(angle) + front[:, None] * np.cos(angle)

    before = np.mean(scene.seen(ends)[2])
    at, role = scene.height_of(before) + over, "follower" if shape.part == "roller" else shape.part
    at = at + (
        2 * (before > 0) if shape.part == "roller" else 0.0
    )  # before the edges of all strips, or behind the solid
    over = at + (0.05 if shape.part == "roller" else 0.5)
    outline = np.concatenate([around(far, FRONT), around(near, FRONT + np.pi)], axis=1)
    scene.face(key, outline, at=at, role=role)
    for k, shade in enumerate(SHADES):
        for side in (-1, 1):
            sides = np.concatenate([around(far, side * shade), around(near, side * shade[::-1])], axis=1)
            scene.face(f"{key} shade {k} {side}", sides, at=over, role="guide", opacity=0.09)
    cap = around(near, np.linspace(0, 2 * np.pi, 73))
    scene.face(f"{key} end", cap, at=over + 0.01, role="paper", opacity=0.35)
    scene.path(f"{key} end edge", cap, at=over + 0.02, role="guide", stroke="thin")
    scene.path(f"{key} outline", np.concatenate([outline, outline[:, :1]], axis=1), at=over + 0.02, role="guide")


def _strip(scene: Turntable, shape: Strip, edges: Array, key: str, at: float) -> None:
    """What is seen of a strip's outer side, place by place, its first edge and what is cut away of that."""
    (x, y, _), eye = scene.seen(edges), scene.eye[2].reshape(3, 1)
    along, across = edges[:, 0, 1:] - edges[:, 0, :-1], edges[:, 1, :-1] - edges[:, 0, :-1]
    seen = shape.hand * dot(np.cross(along, across, axis=0), eye) > 0
    if shape.part == "wall":
        seen = seen & (dot(edges[:2, 0, :-1], eye[:2]) > 0)
    corners = [
        gaps(np.stack([p[0, :-1], p[0, 1:], p[1, 1:], p[1, :-1], np.nan * p[0, 1:]], axis=-1), seen[:, None])
        for p in (x, y)
    ]
    role, opacity = FILLS.get(shape.part, ("body", 1.0))
    scene.put(at, Polygon(key, *(p.reshape(-1) for p in corners), role=role, opacity=opacity))
    shown = np.concatenate([seen, seen[-1:]])
    if shape.part in EDGES:
        role = EDGES[shape.part]
        edge = gaps(x[0], shown), gaps(y[0], shown)
        scene.put(at + 1, Line(f"{key} edge", *edge, role=role, label=PARTS[role]))
    if shape.cut is not None:
        cut = [gaps(p[0], shown & shape.cut) for p in (x, y)]
        scene.put(at + 1, Line(f"{key} undercut", *cut, role="trouble"))
