"""The front view of a disk cam: its curves, bore and hub, the follower at cam angle 0, and words that point at them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...geometry import Disc, Outline, rotated
from ...quantities.types import Array
from ...units import deg, mm
from .blank import Blank
from .contours import Contour
from .dimensions import Words
from .prisms import outer_diameter
from .radii import EDGES
from .section import draw_bore
from .subject import Subject
from .svg import Box, arcs_data
from .view import Note, View

ROUND, SIDE = 7.0, 14.0
"""Above and below the cam, and left and right of it for the marks of its section and of its angle 0, mm."""
CLEAR = (24.0, 14.0)
"""So far above and below its axis these marks reach, mm."""
ALIKE, DWELL = 1e-9, 2 * deg
"""Radii that differ by less (m) are the same; over a wider direction (rad) they are a dwell."""


@dataclass(frozen=True)
class Extreme:
    """The point of a cam at its least or largest radius: how far from the axis (m), and in which direction (rad)."""

    radius: float
    direction: float
    dwells: bool = False
    """Whether it stands in the middle of a dwell."""

    @property
    def point(self) -> Array:
        return self.radius * np.array([np.cos(self.direction), np.sin(self.direction)])


@dataclass(frozen=True)
class Front:
    """What is seen of one cam along its axis."""

    subject: Subject
    curves: tuple[Contour, ...]
    blank: Blank
    words: Words
    zone: float = 0.0
    """Width of the zone in which the profile must lie, m; 0: none is asked."""

    @property
    def grooved(self) -> bool:
        return any(curve.layer == "GROOVE" for curve in self.curves)

    @cached_property
    def rim(self) -> float:
        """Radius of the disk that holds a groove, m; 0 for a plate."""
        edges = tuple(curve for curve in self.curves if curve.layer in EDGES)
        return outer_diameter(edges, self.blank) / 2 if self.grooved else 0.0

    @cached_property
    def rollers(self) -> list[tuple[Array, float]]:
        """Where rollers stand at cam angle 0, on the cam, and their radii, m."""
        return [(self._on_cam(body)[:, 0], float(body.radius)) for body in self._bodies if isinstance(body, Disc)]

    @cached_property
    def faces(self) -> list[Array]:
        """The faces of flat followers at cam angle 0, on the cam, ``(2, k)``, m."""
        faces = [body for body in self._bodies if isinstance(body, Outline) and body.part == "face"]
        return [self._on_cam(body) for body in faces]

    @property
    def _bodies(self) -> tuple[object, ...]:
        return tuple(body for body in self.subject.analysis.bodies if getattr(body, "name", ""))

    @property
    def _start(self) -> int:
        return int(abs(np.ravel(self.subject.analysis.cam_angle)).argmin())

    def _on_cam(self, body: Disc | Outline) -> Array:
        turn = float(np.ravel(self.subject.analysis.turn)[self._start])
        return self.subject.on_the_shaft(rotated(body.at(self._start), -turn).reshape(2, -1))

    @cached_property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, lowest and highest place of all that is seen, m."""
        points = np.hstack([curve.points for curve in self.curves])
        discs = [((0.0, 0.0), max(self.rim, self.blank.hub_diameter / 2)), *self.rollers]
        low = np.min([points.min(1), *(np.asarray(c) - r for c, r in discs)], axis=0)
        high = np.max([points.max(1), *(np.asarray(c) + r for c, r in discs)], axis=0)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    @property
    def reach(self) -> float:
        """To the right and upwards, m: so far to each side a face is drawn."""
        return max(self.extent[1], self.extent[3])

    @cached_property
    def least(self) -> Extreme:
        """Of the profile, or of a groove's inner wall: on the base circle."""
        return self._extreme(-1)

    @cached_property
    def largest(self) -> Extreme:
        return self._extreme(1)

    def _extreme(self, sign: int) -> Extreme:
        """The point of the edges farthest from the axis, or with ``sign`` -1 nearest to it."""
        found = [_farthest(s.points, sign) for c in self.curves if c.layer in EDGES for s in c.stretches]
        return max(found, key=lambda extreme: (round(sign * extreme.radius / ALIKE), extreme.dwells))

    def draw(self, view: View) -> Box:
        """All lines; the box on the paper that they take."""
        blank = self.blank
        left, right, low, high = self.extent
        (x0, y1), (x1, y0) = view.at(np.array([left, low])), view.at(np.array([right, high]))
        box = Box(float(x0), float(y0), float(x1), float(y1))
        _axes(view, box)
        view.circle((0.0, 0.0), self.least.radius, "centre")
        if self.rim:
            view.circle((0.0, 0.0), self.rim, "visible")
        if blank.hub_diameter:
            view.circle((0.0, 0.0), blank.hub_diameter / 2, "hidden")
        draw_bore(view, blank, blank.key_angle)
        for centre, radius in self.rollers:
            view.circle(centre, radius, "neighbour")
            for arm in np.eye(2) * (radius + 1.5 * mm / view.scale):
                view.line(centre - arm, centre + arm, "centre")
        for face in self.faces:
            view.line(*_clipped(face, self.reach), "neighbour")
        for curve in self.curves:
            view.curve(curve)
        _turning(view, box, self.subject.sense)
        return box

    def notes(self, view: View) -> list[Note]:
        """What the words beside the view say, and where they point."""
        said = [Note(view.at(point), lines) for point, lines in self._said]
        if self.zone:
            cells = (self.words.length(self.zone), *(("B",) if self.blank.bore else ()))
            said.append(Note(view.at(_at_share(self._layer(*EDGES), 0.62)), (), cells=cells))
        return said

    @cached_property
    def _said(self) -> list[tuple[Array, tuple[str, ...]]]:
        """Places on the cam, m, and lines of words."""
        said = [self._radius_said(self.largest, "largest", "max_radius")]
        said.append(self._radius_said(self.least, "base circle", "base_radius"))
        said += self._follower_said()
        if self.grooved:
            depth = self.words.length(self.blank.groove_depth)
            wide = " and ".join(dict.fromkeys(self.words.length(2 * radius) for _, radius in self.rollers))
            said.append((_at_share(self._layer("GROOVE"), 0.4), ("groove", f"{wide} wide", f"{depth} deep")))
            said.append((self.rim * np.array([np.cos(2.2), np.sin(2.2)]), (f"Ø{self.words.length(2 * self.rim)}",)))
        return said

    def _layer(self, *layers: str) -> Contour:
        return next(curve for curve in self.curves if curve.layer in layers)

    def _radius_said(self, extreme: Extreme, name: str, quantity: str) -> tuple[Array, tuple[str, ...]]:
        half = self.words.tolerance(self.subject.design, quantity, extreme.radius)
        place = () if extreme.dwells else (f"at {round(extreme.direction / deg, 2) % 360:g}°",)
        return extreme.point, (f"R{self.words.length(extreme.radius)}{self.words.plus_minus(half)}", name, *place)

    def _follower_said(self) -> Iterator[tuple[Array, tuple[str, ...]]]:
        for centre, radius in self.rollers:
            half = self.words.tolerance(self.subject.design, "roller_radius", radius)
            outwards = centre / np.hypot(*centre) * radius
            size = f"R{self.words.length(radius)}{self.words.plus_minus(half)}"
            yield centre + outwards, (size, "roller", "at cam angle 0°")
        for face in self.faces:
            yield _clipped(face, self.reach)[0], ("follower", "at cam angle 0°")
        for curve in (curve for curve in self.curves if curve.layer == "PITCH"):
            yield _at_share(curve, 0.85), ("pitch curve",)


def _farthest(points: Array, sign: int) -> Extreme:
    """In the middle of a dwell, or on the parabola over the direction through the farthest point and its neighbours."""
    radius, direction = sign * np.hypot(*points), np.unwrap(np.arctan2(points[1], points[0]))
    top = np.flatnonzero(radius > radius.max() - ALIKE)
    longest = max(np.split(top, np.flatnonzero(np.diff(top) > 1) + 1), key=len)
    first, last = direction[longest[[0, -1]]]
    if abs(last - first) > DWELL:
        return Extreme(abs(float(radius.max())), float(first + last) / 2, True)
    k = int(radius.argmax())
    if not 0 < k < len(radius) - 1 or np.ptp(radius[k - 1 : k + 2]) < ALIKE:
        return Extreme(abs(float(radius[k])), float(direction[k]))
    a, b, c = np.polyfit(direction[k - 1 : k + 2] - direction[k], radius[k - 1 : k + 2], 2)
    away = float(-b / (2 * a)) if a < 0 else 0.0
    return Extreme(abs(float(np.polyval((a, b, c), away))), float(direction[k]) + away)


def _at_share(curve: Contour, share: float) -> Array:
    """The point of a curve at a share of its length."""
    points = curve.points
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(points))))
    return np.array([np.interp(share * length[-1], length, x) for x in points])


def _clipped(face: Array, reach: float) -> tuple[Array, Array]:
    """Both ends of a face, no farther from its middle than a length."""
    start, end = face[:, 0], face[:, -1]
    middle, half = (start + end) / 2, (end - start) / 2
    half = half * min(1.0, reach / (float(np.hypot(*half)) or reach))
    return middle - half, middle + half


def _axes(view: View, box: Box) -> None:
    """Centre lines, the marks of the section A-A at the ends of the horizontal one, and the angle 0 of the cam."""
    paper, (x, y) = view.paper, view.centre
    paper.line((x, box.top - 4), (x, box.bottom + 4), "centre")
    paper.line((box.left - 4, y), (box.right + 4, y), "centre")
    paper.text((box.right + 3.5, y - 1.2), "0°", 3.5)


def section_marks(view: View, box: Box, down: bool) -> None:
    """Where the section A-A runs, and from which side it is seen."""
    paper, y, way = view.paper, view.centre[1], 1 if down else -1
    for x, side in ((box.left - 6, -1), (box.right + 6, 1)):
        paper.line((x, y), (x + side * 5, y), "visible")
        foot = (x + side * 3, y + way * 7)
        paper.line((x + side * 3, y), foot)
        paper.arrow(foot, (0.0, way))
        paper.text((x + side * 3, y + way * 7 + (4.6 if down else -1.4)), "A", 4.5, "middle", bold=True)


def _turning(view: View, box: Box, turns: int) -> None:
    """An arrow around the axis, beside the angle 0."""
    x, y = view.centre
    radius = box.right - x + 5
    start, end = 8 / radius, min(22 / radius, 1.2)
    tip, tail = (end, start) if turns > 0 else (start, end)
    places = np.array([[x + radius * np.cos(a), y - radius * np.sin(a)] for a in (start, end)]).T
    view.paper.path(arcs_data(places, np.array([np.tan((end - start) / 4)]), False), "thin", name="TURNS")
    head = np.array([x + radius * np.cos(tip), y - radius * np.sin(tip)])
    along = np.array([-np.sin(tip), -np.cos(tip)]) * (1 if tip > tail else -1)
    view.paper.arrow(head, along)
