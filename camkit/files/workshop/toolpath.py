"""The path of the centre of a milling cutter, or of a grinding wheel, that leaves a contour standing.

The centre keeps the tool's radius from the contour: its path is the contour's parallel curve, with an arc about every
sharp edge.  In a hollow that is narrower than the tool the parallel curve crosses itself, and its loops would cut
into the cam.  So it is cut into arcs wherever it crosses itself (see `camkit.cam.arcs`); what keeps its distance from
the whole contour is the path, and where it does not the tool leaves material.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...cam.arcs import Arc, Curve, Node, arcs, chains, is_ring, whole
from ...cam.flank import is_left, runs
from ...motion.closing import TURN
from ...quantities.kinds import one_number
from ...quantities.types import Array
from ...units import deg, mm
from .arcs import dense_path
from .contours import Swept, contours
from .curves import Contour, Stretch, arc, joined
from .subject import Subject, subjects

OUTSIDE, INSIDE = "outside", "inside"
LARGEST = 10.0
"""No cutter and no grinding wheel has a larger radius, m."""
CLEAR = 1e-9
"""A point that lies less deep in the tool (m) is clear of it."""
SHARES = np.array([0.237, 0.741])
"""Where points are taken on each step of a wall: at odd places, for curves that cross at a point of both are missed."""
EDGE = 1e-7
"""A wall that turns by less (rad) between two stretches has no edge there."""
LEAST = 1e-8
"""Less than this (m) is no material that is left."""


class Uncut(NamedTuple):
    """Where the tool is too large: cam angles (rad), and how thick the material is that stays there at most, m.

    It may begin before the end of the turn and end after it: ``start`` is then the larger.
    """

    start: float
    end: float
    stays: float

    def __str__(self) -> str:
        place = f"{self.start / deg:.4g} to {self.end / deg:.4g} deg"
        return f"at {place} the hollow is narrower than the tool: up to {self.stays / mm:.3g} mm of material stays"


@dataclass(frozen=True)
class ToolPath:
    """The path of the centre of a tool of a ``radius`` (m) along ``walls``, and what the tool cannot cut."""

    contours: tuple[Contour, ...]
    """Of the centre, one behind the other, on the layer `TOOL`; closed ones counter-clockwise."""
    inside: tuple[bool, ...]
    """Whether the tool runs inside the wall, for each of them."""
    walls: tuple[Contour, ...]
    radius: float
    uncut: tuple[Uncut, ...] = ()
    one_pass: bool = False
    """Whether the tool cuts both walls of a groove at once."""
    remarks: tuple[str, ...] = ()

    @cached_property
    def keep_out(self) -> Swept:
        """What the tool's centre must not enter."""
        return _tool(self.walls, self.radius)


TOOL = "TOOL"


def tool_path(cam: object, tool_radius: float, side: str = OUTSIDE) -> ToolPath:
    """The path of the centre of a tool around a cam, given as a design, an analysis or a panel; in its groove.

    >>> from camkit import TranslatingFlatCam, mm
    >>> path = tool_path(TranslatingFlatCam(), 60 * mm)
    >>> print(f"{np.hypot(*path.contours[0].points).min() / mm:.3f} mm")
    90.000 mm

    Raises ``ValueError`` for a tool that does not fit into the groove, or nowhere onto the path.
    """
    found = subjects(cam)
    if len(found) > 1:
        raise ValueError(f"{found[0].kind} has {len(found)} cams; a tool runs around one, such as {found[0].name}")
    return path_of(found[0], tool_radius, side)


def path_of(subject: Subject, tool_radius: float, side: str = OUTSIDE) -> ToolPath:
    """`tool_path` of one cam."""
    r = one_number(tool_radius, "the tool radius", "be above 0 and at most 10 m", lambda r: 0 < r <= LARGEST)
    if side not in (OUTSIDE, INSIDE):
        raise ValueError(f"the side is {side!r:.40}; it must be {OUTSIDE!r} or {INSIDE!r}")
    if subject.drum:
        raise ValueError(f"{subject.kind} is a drum; a tool that moves in a plane cannot cut it")
    drawn = contours(subject)
    groove = tuple(each for each in drawn if each.layer == "GROOVE")
    if groove:
        return _in_groove(subject, groove, [each for each in drawn if each.layer == "PITCH"], r)
    walls = tuple(each for each in drawn if each.layer == "CAM")
    return around(walls, [side == INSIDE] * len(walls), r, _cam_angles(subject))


def _in_groove(subject: Subject, walls: tuple[Contour, ...], pitch: Sequence[Contour], radius: float) -> ToolPath:
    roller = float(np.ravel(subject.analysis.cam.roller_radius)[0])
    if radius > roller + CLEAR:
        raise ValueError(
            f"the tool radius is {radius / mm:.6g} mm; into the groove goes one of at most that of the roller, "
            f"{roller / mm:.6g} mm"
        )
    if radius > roller - CLEAR:
        centre = tuple(Contour(TOOL, _finer(each).stretches, each.closed) for each in pitch)
        walls = tuple(map(_finer, walls))
        return ToolPath(centre, (False,) * len(centre), walls, radius, one_pass=True)
    largest = max(range(len(walls)), key=lambda k: abs(area(walls[k].points)))
    path = around(walls, [k == largest for k in range(len(walls))], radius, _cam_angles(subject))
    ridge = 2 * roller - 4 * radius
    if ridge <= 0:
        return path
    said = f"a ridge of {ridge / mm:.4g} mm stays along the middle of the groove; a tool of {roller / 2 / mm:.4g} mm"
    return ToolPath(path.contours, path.inside, walls, radius, path.uncut, remarks=(f"{said} leaves none",))


def _cam_angles(subject: Subject) -> Callable[[Array], Array]:
    """The cam angle (rad) that belongs to points of a contour: that of the nearest point of the analysis."""
    from scipy.spatial import cKDTree

    analysis = subject.analysis
    points = subject.on_the_shaft(np.hstack([analysis.profile, analysis.outer_profile]))
    angles = np.tile(analysis.profile_angle, 2)
    there = np.isfinite(points).all(0)
    tree, known = cKDTree(points[:, there].T), angles[there]
    return lambda points: np.asarray(known[tree.query(points.T)[1]])


# ---------------------------------------------------------------- parallel curves


class _Parallel(NamedTuple):
    """The curve parallel to a wall, once along it, and what its points belong to."""

    line: Stretch
    rows: Array
    """The number of the wall's point; -1: a point about an edge."""
    joints: Array
    """Numbers of the points at which one smooth stretch ends and the next begins."""
    closed: bool

    @property
    def last(self) -> int:
        """The number of its last point, which on a closed one is the first again."""
        return self.line.points.shape[1] - 1

    def parts(self, start: float, end: float) -> Iterator[Stretch]:
        """Its smooth stretches from one place to another, on a closed one beyond its end too."""
        long = joined([self.line, self.line]) if end > self.last else self.line
        inner = np.unique(np.concatenate([self.joints, self.joints + self.last]))
        places = [start, *inner[(inner > start + LEAST) & (inner < end - LEAST)], end]
        return (long.part(one, other) for one, other in pairwise(places))


def around(
    walls: Sequence[Contour], inside: Sequence[bool], radius: float, cam_angles: Callable[[Array], Array]
) -> ToolPath:
    """The path of a tool along ``walls``, ``inside`` or outside each of them; ``cam_angles`` of points of the walls."""
    walls = [_finer(wall) for wall in walls]
    lines = [_parallel(wall, -radius if within else radius) for wall, within in zip(walls, inside, strict=True)]
    tool = _tool(walls, radius)
    clear = [tool.depth(each.line.points) <= CLEAR for each in lines]
    curves = [Curve(each.line.points) for each in lines]
    found = whole(curves) if all(each.all() for each in clear) else _exact(arcs(curves), lines)
    kept = list(chains([each for each in found if is_left(each, clear[each.curve], tool)]))
    rings = [ring for k in range(len(walls)) for ring in _reached(kept, k, inside[k], lines)]
    if not rings:
        raise ValueError(f"the tool radius is {radius / mm:.6g} mm; such a tool fits nowhere")
    centre = tuple(Contour(TOOL, tuple(_stretches(ring, lines)), is_ring(ring)) for ring in rings)
    left = np.hstack([each.points for each in centre])
    uncut = tuple(_uncut(_lost(rings, lines, clear), walls, tool, left, cam_angles))
    return ToolPath(centre, tuple(inside[ring[0].curve] for ring in rings), tuple(walls), radius, uncut)


def _finer(line: Contour) -> Contour:
    """The same line with more points."""

    def finer(stretch: Stretch) -> Stretch:
        last = stretch.points.shape[1] - 1
        return stretch.at(np.concatenate([[0.0], (np.arange(last)[:, None] + SHARES).ravel(), [last]]))

    return Contour(line.layer, tuple(map(finer, line.stretches)), line.closed)


def _tool(walls: Sequence[Contour], radius: float) -> Swept:
    """The tool with its centre everywhere on the walls: where its own centre must not be."""
    return Swept(np.hstack([wall.points for wall in walls]), radius, tuple(dense_path(wall, 1) for wall in walls))


def _parallel(wall: Contour, away: float) -> _Parallel:
    """The curve ``away`` from a wall, to the right of its direction of travel, with arcs about its edges."""
    following = [*wall.stretches[1:], *(wall.stretches[:1] if wall.closed else ())]
    parts, rows, done = [], [], 0
    for k, (points, tangents) in enumerate(wall.stretches):
        parts.append(Stretch(points + away * _right(tangents), tangents))
        rows.append(done + np.arange(points.shape[1]))
        done += points.shape[1]
        if k < len(following):
            turn = _turn(tangents[:, -1], following[k].tangents[:, 0])
            if abs(turn) > EDGE:
                about = arc(points[:, -1], parts[-1].points[:, -1], turn)
                forward = np.sign(turn) * np.sign(away)  # into a hollow edge the arc runs back
                parts.append(Stretch(about.points, forward * about.tangents))
                rows.append(np.full(about.points.shape[1], -1))
    lengths = [0, *np.cumsum([part.points.shape[1] - 1 for part in parts])]
    numbers = np.concatenate([rows[0], *(each[1:] for each in rows[1:])])
    return _Parallel(joined(parts), numbers, np.array(lengths), wall.closed)


def _right(tangents: Array) -> Array:
    return np.stack([tangents[1], -tangents[0]])


def _turn(one: Array, other: Array) -> float:
    """By which angle a direction turns into another, rad."""
    return float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other))


def _exact(given: list[Arc], lines: Sequence[_Parallel]) -> list[Arc]:
    """Arcs that begin and end where the curves themselves cross, not the cubics beside them."""

    def key(curve: int, place: float) -> tuple[int, float]:
        return curve, round(place % lines[curve].last if lines[curve].closed else place, 6)

    places: dict[object, dict[tuple[int, float], float]] = {}
    for each in given:
        for node in (each.start, each.end):
            places.setdefault(node.name, {}).setdefault(key(each.curve, node.place), node.place)
    for both in places.values():
        if len(both) == 2:
            both.update(zip(both, _crossing([(lines[k].line, place) for (k, _), place in both.items()]), strict=True))

    def placed(curve: int, node: Node) -> Node:
        place = places[node.name][key(curve, node.place)]
        return node._replace(place=place + lines[curve].last * round((node.place - place) / lines[curve].last))

    return [each._replace(start=placed(each.curve, each.start), end=placed(each.curve, each.end)) for each in given]


def _crossing(near: Sequence[tuple[Stretch, float]]) -> tuple[float, float]:
    """Where two curves cross: places along them, from places nearby."""
    (one, a), (other, b) = ((line, place % (line.points.shape[1] - 1)) for line, place in near)
    for _ in range(6):
        p, q = one.at(np.array([a])), other.at(np.array([b]))
        slopes = np.column_stack([p.tangents * _step(one, a), -q.tangents * _step(other, b)])
        da, db = np.clip(np.linalg.lstsq(slopes, (q.points - p.points)[:, 0], rcond=None)[0], -1, 1)
        a, b = a + float(da), b + float(db)
    return a, b


def _step(line: Stretch, place: float) -> float:
    """From the point before a place to the one behind it, m."""
    k = min(max(int(place), 0), line.points.shape[1] - 2)
    return float(np.hypot(*(line.points[:, k + 1] - line.points[:, k])))


def _stretches(ring: Sequence[Arc], lines: Sequence[_Parallel]) -> Iterator[Stretch]:
    """The smooth stretches of arcs one behind the other."""
    for each in ring:
        yield from lines[each.curve].parts(each.start.place, each.end.place)


def _reached(found: Sequence[list[Arc]], wall: int, inside: bool, lines: Sequence[_Parallel]) -> list[list[Arc]]:
    """The paths along a wall: from outside of a closed one the outermost alone, what it encloses cannot be reached."""
    own = [each for each in found if each[0].curve == wall]
    if inside or not lines[wall].closed or len(own) < 2:
        return own
    return [max(own, key=lambda ring: area(joined(list(_stretches(ring, lines))).points))]


def area(points: Array) -> float:
    """Inside a ring of points ``(2, n)``, m^2; counter-clockwise > 0."""
    x, y = points
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def _lost(rings: Sequence[Sequence[Arc]], lines: Sequence[_Parallel], clear: Sequence[Array]) -> list[Array]:
    """Which points of each wall the tool does not come to."""
    kept = [np.zeros(each.last + 1, dtype=bool) for each in lines]
    for part in (part for ring in rings for part in ring):
        inside = np.arange(int(np.ceil(part.start.place)), int(np.floor(part.end.place)) + 1)
        kept[part.curve][inside % lines[part.curve].last if lines[part.curve].closed else inside] = True
    found = []
    for each, reached, free in zip(lines, kept, clear, strict=True):
        reached[-1] |= each.closed and reached[0]
        lost = np.ones(each.rows.max() + 1, dtype=bool)
        lost[each.rows[reached & free & (each.rows >= 0)]] = False
        found.append(lost)
    return found


def _uncut(
    lost: Sequence[Array], walls: Sequence[Contour], tool: Swept, left: Array, cam_angles: Callable[[Array], Array]
) -> Iterator[Uncut]:
    """Where material stays, wall by wall, stretch by stretch."""
    first = 0
    for wall, away in zip(walls, lost, strict=True):
        for run in runs(away, wall.closed):
            stays = float(tool.gaps(first + run, left).max())
            if stays > LEAST:
                start, middle, end = map(float, cam_angles(wall.points[:, run[[0, len(run) // 2, -1]]]))
                backwards = (middle - start) % TURN > (end - start) % TURN
                yield Uncut(end, start, stays) if backwards else Uncut(start, end, stays)
        first += len(away)
