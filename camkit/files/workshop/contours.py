"""The contours of a cam as it is made: exact points and tangents, and what the tool leaves where it is undercut.

A roller's centre runs along the pitch curve; both flanks lie its radius away, along the contact normal, and their
tangents are square to that.  Where the pitch curve has a corner the roller turns about it, where a face's contact leaps
the flank is straight, where an open groove ends it is round.  The whole is cut wherever it crosses itself, and what a
roller or a face covers is lost (see `camkit.cam.flank`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...cam.arcs import Arc, chains, is_ring
from ...cam.envelope import Flank
from ...cam.flank import Flanks
from ...cam.tool import Face, Roller
from ...quantities.types import Array
from ...units import deg
from .arcs import ArcPath, dense_path, distances
from .curves import SAME, Contour, Stretch, arc, from_cubic, joined, line, smooth
from .subject import Subject, kept

__all__ = ["Contour", "Stretch", "contours"]

CAM, GROOVE, PITCH, FAULT = "CAM", "GROOVE", "PITCH", "FAULT"
STEPS = 16
"""Even steps of a smooth piece of the motion, before they are halved where that is needed."""
WIDEST = 3 * deg
"""No step is wider, or of more steps in proportion."""
EXACT, HALVINGS = 1e-10, 12
"""Between its points a stretch lies no farther (m) from the cam; no step is halved more often."""
BENT = 1e-3
"""A curvature that jumps by less, over that of a circle about the cam axis, is no joint."""
STANDS = 1e-6
"""A flank that runs slower than this share of its pitch curve stands still."""
SLACK = 2e-9
"""A point less deep in the tool (m) lies on it."""
LOOKS = 129
"""At so many cam angles of a piece it is looked whether a flank turns back."""
HAIR = 1e-6
"""Less of a step is none of it."""
FACES = 0.2 * deg
"""How far faces that cut a cam are apart."""


class Seen(NamedTuple):
    """What the cam sees of its follower at some cam angles."""

    centre: Array
    """Of the roller, or where the face touches, ``(2, n)``, m."""
    normal: Array
    """From cam to follower, ``(2, n)``."""
    bend: Array
    """Curvature of the centre's path, convex > 0, 1/m, ``(n,)``."""
    ahead: Array
    """Above 0 where that path runs as a convex one does; of a face its radius of curvature, m, of a roller 1."""

    def part(self, which: Array | slice) -> Seen:
        """Of some of the cam angles."""
        return Seen(*(x[..., which] for x in self))

    def runs(self, away: float) -> Array:
        """How fast a flank ``away`` from the centre, along the normal, runs, over the centre's speed; < 0: back."""
        return self.ahead + away * self.bend

    def flank(self, away: float, way: float) -> Stretch:
        """That flank; ``way`` is 1 where its convex parts are passed counter-clockwise."""
        (x, y), sign = self.normal, way * np.sign(np.median(self.runs(away)))
        return Stretch(self.centre + away * self.normal, sign * np.stack([-y, x]))


Looks = Callable[[Array], Seen]


class Leg(NamedTuple):
    """A smooth piece of the way of a follower around the cam."""

    look: Looks
    start: float
    end: float
    goes_on: bool
    """Whether it belongs to the same segment of the motion as the one before."""


@dataclass(frozen=True)
class Swept(Roller):
    """A roller that goes along whole paths, not from place to place."""

    paths: tuple[ArcPath, ...]

    def depth(self, points: Array) -> Array:
        """How deep points lie in it, m."""
        return self.radius - SLACK - np.min([distances(path, points) for path in self.paths], axis=0)


@kept
def contours(subject: Subject, steps: int = STEPS) -> tuple[Contour, ...]:
    """What is to be cut, the pitch curve of a roller, and what of the cam is lost to undercut (``FAULT``).

    A plate has one contour ``CAM``, closed if the motion goes around; a groove has its walls on ``GROOVE``: both, or
    one closed contour with round ends where the motion does not go around.  A drum's are unrolled, from cam angle 0 to
    the end of the turn.  Both cams of a pair lie as they stand on their shaft.  Other ``steps``: other points.

    >>> from .subject import subjects
    >>> from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam
    >>> [(c.layer, c.closed) for c in contours(subjects(TranslatingRollerCam())[0])]
    [('GROOVE', True), ('GROOVE', True), ('PITCH', True)]
    >>> [c.layer for c in contours(subjects(TranslatingFlatCam())[0])]
    ['CAM']
    """
    found, place = _Outline(subject.analysis, steps).contours, subject.on_the_shaft
    moved = [Contour(c.layer, tuple(Stretch(*map(place, s)) for s in c.stretches), c.closed) for c in found]
    return tuple(c if subject.drum and not c.closed else c.counter_clockwise for c in moved)


# ---------------------------------------------------------------- what the cam sees


def _legs(analysis: Any) -> list[Leg]:
    """The smooth pieces of the way of a cam's follower; of two followers in one groove, of one after the other."""
    if not hasattr(analysis, "from_relief"):
        return list(_pieces(analysis, _look(analysis)))
    lift, relief = analysis.lift, analysis.relief
    rest = analysis.cam.relief_cam_angle
    return [
        *_pieces(relief, _look(relief, analysis.from_relief)),
        *(leg for leg in _pieces(lift, _look(lift)) if leg.end > rest * (1 + 1e-6)),
    ]


def _pieces(analysis: Any, look: Looks) -> Iterator[Leg]:
    shown, before = analysis.cam.motion.resolution, -1
    ends = zip(shown.angle[shown.first].tolist(), shown.angle[shown.last].tolist(), shown.shares, strict=True)
    for start, end, (segment, _) in ends:
        yield Leg(look, start, end, segment == before)
        before = segment


def _look(analysis: Any, place: Callable[[Array], Array] = lambda points: points) -> Looks:
    """What a cam sees of its follower, in the frame to which ``place`` leads."""

    def look(angles: Array) -> Seen:
        at = analysis.at(angles)
        flat = 0.0 * angles
        if hasattr(at, "face_normal"):
            return Seen(at.profile, at.face_normal, flat, at.profile_radius)
        normal = at.on_cam(at.normal) - at.on_cam(0.0 * at.normal)
        return Seen(place(at.pitch), place(normal), at.curvature, 1.0 + flat)

    return look


def _between_cusps(leg: Leg, aways: Sequence[float]) -> Iterator[Leg]:
    """The piece cut wherever a flank comes to rest and turns back."""
    angles = np.linspace(leg.start, leg.end, LOOKS)
    seen, found = leg.look(angles), []
    for away in aways:
        runs = seen.runs(away)
        real = np.flatnonzero(abs(runs) > STANDS)
        turns = np.flatnonzero(np.sign(runs[real[1:]]) != np.sign(runs[real[:-1]]))
        low, high, before = angles[real[turns]], angles[real[turns + 1]], np.sign(runs[real[turns]])
        for _ in range(50 if len(low) else 0):
            middle = (low + high) / 2
            same = np.sign(leg.look(middle).runs(away)) == before
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found += low.tolist()
    for k, (start, end) in enumerate(pairwise([leg.start, *sorted(found), leg.end])):
        if end > start:
            yield leg._replace(start=start, end=end, goes_on=leg.goes_on if not k else True)


def _dense(leg: Leg, aways: Sequence[float], steps: int) -> Seen:
    """What is seen at cam angles between which cubics are exact, even steps halved where that is needed."""
    wide = (leg.end - leg.start) / (STEPS * WIDEST)
    angles = np.linspace(leg.start, leg.end, 1 + int(np.ceil(steps * max(1.0, wide))))
    seen, rough = leg.look(angles), np.ones(len(angles) - 1, dtype=bool)
    way = _way([seen])
    for _ in range(HALVINGS):
        k = np.flatnonzero(rough)
        middle = leg.look((angles[k] + angles[k + 1]) / 2)
        off = np.max([_off(seen.flank(away, way), k, middle.flank(away, way).points) for away in aways], axis=0)
        bad = off > EXACT
        if not bad.any():
            break
        at, added = k[bad] + 1, middle.part(bad)
        angles = np.insert(angles, at, ((angles[k] + angles[k + 1]) / 2)[bad])
        seen = Seen(*(np.insert(x, at, y, axis=-1) for x, y in zip(seen, added, strict=True)))
        new = np.zeros(len(angles), dtype=bool)
        places = at + np.arange(len(at))
        new[places] = new[places - 1] = True
        rough = new[:-1]
    return seen


def _off(given: Stretch, steps: Array, points: Array) -> Array:
    """How far points, one for each of some steps, are from the cubics of these, m."""
    ends = Stretch(given.points[:, steps], given.tangents[:, steps])
    return from_cubic(ends, Stretch(given.points[:, steps + 1], given.tangents[:, steps + 1]), points)


# ---------------------------------------------------------------- what the follower draws


@dataclass(frozen=True)
class _Outline:
    """One cam as its follower draws it, its stretches in the order of the cam angles."""

    analysis: Any
    steps: int

    @cached_property
    def faced(self) -> bool:
        """Whether the follower is a face."""
        return hasattr(self.analysis, "face_normal")

    @cached_property
    def radius(self) -> float:
        """Of the roller, m; 0 of a face or a knife edge."""
        return 0.0 if self.faced else float(np.ravel(self.analysis.cam.roller_radius)[0])

    @cached_property
    def aways(self) -> tuple[float, ...]:
        """How far the flanks lie beyond the path of the centre, the inner one first."""
        groove = bool(np.isfinite(self.analysis.outer_profile).all())
        return (0.0,) if not self.radius else (-self.radius, self.radius) if groove else (-self.radius,)

    @property
    def period(self) -> Array:
        """From a point to the same point a turn on, m: of a drum, which is unrolled."""
        return np.asarray(getattr(self.analysis, "period", np.zeros(2)))

    @property
    def goes_around(self) -> bool:
        """Whether the motion takes a turn."""
        program = getattr(self.analysis.cam, "motion", None)
        return program is not None and bool(program.periodic)

    @property
    def closed(self) -> bool:
        """Whether a flank ends where it begins."""
        return self.goes_around and not self.period.any()

    @cached_property
    def legs(self) -> list[Leg]:
        """The way of the follower, cut where a flank turns back, too."""
        return [part for leg in _legs(self.analysis) for part in _between_cusps(leg, self.aways)]

    @cached_property
    def seen(self) -> list[Seen]:
        """What is seen on each leg."""
        return [_dense(leg, (*self.aways, 0.0), self.steps) for leg in self.legs]

    @cached_property
    def way(self) -> float:
        """1 where growing cam angles go around counter-clockwise, or else -1."""
        return _way(self.seen)

    def flank(self, away: float) -> list[Stretch]:
        """A line beside the path of the centre, with what joins its pieces."""
        groups: list[list[Stretch]] = []
        for k, (leg, seen) in enumerate(zip(self.legs, self.seen, strict=True)):
            between = self._joint(self.seen[k - 1], seen, away) if k else []
            groups += [[part] for part in between]
            piece = seen.flank(away, self.way)
            goes_on = k and leg.goes_on and not between and _bends_on(self.seen[k - 1], seen)
            if goes_on and groups and smooth(groups[-1][-1], piece):
                groups[-1].append(piece)
            elif piece.length > SAME:
                groups.append([piece])
        if self.goes_around:
            groups += [[part] for part in self._joint(self.seen[-1], self.seen[0], away, self.period)]
        return _meeting([joined(parts) for parts in groups], self.closed)

    def _joint(self, before: Seen, after: Seen, away: float, shift: Array | float = 0.0) -> list[Stretch]:
        """What lies between the end of one piece and the beginning of the next, if anything."""
        (centre, normal, *_), (onto, turned, *_) = before, after
        one, other = centre[:, -1], onto[:, 0] + shift
        start, end = one + away * normal[:, -1], other + away * turned[:, 0]
        if np.hypot(*(start - end)) <= SAME:
            return []
        if np.hypot(*(one - other)) <= SAME:
            return [arc(one, start, _angle(normal[:, -1], turned[:, 0]))]
        return [line(start, end)]

    @cached_property
    def lines(self) -> list[list[Stretch]]:
        """All that the follower's flanks draw, undercut or not; the walls of an open groove with its round ends."""
        flanks = [self.flank(away) for away in self.aways]
        if len(flanks) < 2 or self.goes_around:
            return flanks
        inner, outer = flanks
        last, first = self.seen[-1].centre[:, -1], self.seen[0].centre[:, 0]
        back = [stretch.backwards for stretch in outer[::-1]]
        end = arc(last, inner[-1].points[:, -1], -self.way * np.pi)
        start = arc(first, back[-1].points[:, -1], -self.way * np.pi)
        return [_meeting([*inner, end, *back, start], True)]

    @cached_property
    def tool(self) -> Roller | Face:
        """What cuts the cam."""
        if self.faced:
            steps = [np.linspace(leg.start, leg.end, 2 + int((leg.end - leg.start) / FACES)) for leg in self.legs]
            seen = [leg.look(angles) for leg, angles in zip(self.legs, steps, strict=True)]
            return Face(np.hstack([s.normal for s in seen]), np.hstack([s.centre for s in seen]))
        pitch = dense_path(Contour(PITCH, tuple(self.flank(0.0)), False))
        turns = (0, -1, 1) if self.period.any() else (0,)
        paths = [pitch._replace(corners=pitch.corners + k * self.period[:, None]) for k in turns]
        return Swept(np.hstack([path.corners for path in paths]), self.radius, tuple(paths))

    @cached_property
    def contours(self) -> list[Contour]:
        """What is left, the pitch curve, and what is lost."""
        layer = GROOVE if len(self.aways) > 1 else CAM
        around = self.closed or (layer == GROOVE and not self.goes_around)
        fine = [[stretch.finer(4) for stretch in line] for line in self.lines]
        made = Flanks({}, np.empty(0), self.tool, [_as_flank(line) for line in fine])
        left, lost = made.left_arcs, made.lost_arcs
        pitch = [Contour(PITCH, tuple(self.flank(0.0)), self.closed)] if self.radius else []
        if not lost:
            return [*(Contour(layer, tuple(line), around) for line in self.lines), *pitch]
        if not (kept := [*_chained(layer, left, fine)]):
            raise ValueError("the tool leaves no piece of the profile whole: it is undercut")
        return [*kept, *pitch, *_chained(FAULT, lost, fine)]


def _way(seen: Sequence[Seen]) -> float:
    """1 where growing cam angles go around counter-clockwise, or else -1."""
    ahead = 0.0
    for part in seen:
        (x, y), steps = part.normal[:, :-1], np.diff(part.centre)
        ahead += float(((x * steps[1] - y * steps[0]) * np.sign(part.ahead[:-1])).sum())
    return float(np.sign(ahead))


def _bends_on(before: Seen, after: Seen) -> bool:
    """Whether the curvature does not jump."""
    size = np.hypot(*after.centre[:, 0])
    jump = abs(after.bend[0] - before.bend[-1]) * size + abs(after.ahead[0] - before.ahead[-1]) / size
    return bool(jump < BENT)


def _angle(one: Array, other: Array) -> float:
    """From one direction to another, the short way, rad."""
    return float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other))


def _meeting(stretches: Sequence[Stretch], closed: bool) -> list[Stretch]:
    """Stretches each of which begins at the very point where the one before ends."""
    found = [Stretch(stretch.points.copy(), stretch.tangents) for stretch in stretches]
    for before, after in pairwise([*found, *found[:closed]]):
        after.points[:, 0] = before.points[:, -1]
    return found


# ---------------------------------------------------------------- what the tool leaves


def _as_flank(line: Sequence[Stretch]) -> Flank:
    points = joined(line).points
    return Flank(points, "", np.zeros(points.shape[1], dtype=int))


def _chained(layer: str, given: Sequence[Arc], lines: Sequence[Sequence[Stretch]]) -> Iterator[Contour]:
    """Arcs of the lines as contours, one begun where another ends."""
    for chain in chains(given):
        parts = [part for arc in chain for part in _sections(lines[arc.curve], arc)]
        if sum(part.length for part in parts) > SAME:
            yield Contour(layer, tuple(_meeting(parts, is_ring(chain))), is_ring(chain))


def _sections(line: Sequence[Stretch], arc: Arc) -> list[Stretch]:
    """What of each stretch of a line lies between the nodes of an arc."""
    sizes = [stretch.points.shape[1] - 1 for stretch in line]
    begins, found = np.cumsum([0, *sizes, *sizes]), []
    for begin, stretch, size in zip(begins, [*line, *line], [*sizes, *sizes], strict=False):
        low, high = max(arc.start.place, begin), min(arc.end.place, begin + size)
        if high - low > HAIR:
            found.append(stretch.part(low - begin, high - begin))
    for part, k, node in zip(found[:1] + found[-1:], (0, -1), (arc.start, arc.end), strict=False):
        part.points[:, k] = node.point
    return [part for part in found if part.length > SAME]
