"""What the tool leaves of a cam's flanks: the follower's envelope without the loops in which it crosses itself.

The roller, or the face, is the tool (see `tool`).  Where a flank is undercut, the points at which the follower should
touch it lie in the way of the tool at another cam angle: there is no cam.  What is left ends in a corner where two arcs
of the flank cross, and the follower, resting on the corner, does not reach its place.

So the whole envelope (see `envelope`) is cut into arcs wherever it crosses itself (see `arcs`).  Between two crossings
the tool covers an arc or it does not; those that it does not cover, joined at the crossings, are what is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..units import deg, mm
from .arcs import Arc, arcs, chains, is_ring, points_of, whole
from .envelope import Flank, face_envelope, roller_envelope
from .tool import Face, Roller

CLEAR, BETWEEN = 1e-9, 5e-7
"""A point that lies less deep in the tool (m) is clear of it; one that was worked out between the rows may err more."""


class Piece(NamedTuple):
    """A stretch of a flank, ``(2, n)``, m; ``closed`` if its last point joins its first."""

    flank: str
    points: np.ndarray
    closed: bool


class Cut(NamedTuple):
    """A stretch that the tool cuts away: its cam angles (rad), and how far the follower stays from its place, m.

    It may begin before the end of the turn and end after it: ``start`` is then the larger.
    """

    flank: str
    start: float
    end: float
    gap: float

    def __str__(self) -> str:
        lost, place = f"{self.gap / mm:.3g} mm", f"{self.start / deg:.4g} to {self.end / deg:.4g} deg"
        return f"the {self.flank} from {place}, where the follower stays {lost} from its place"


@dataclass(frozen=True)
class Flanks:
    """What the tool leaves of the ``theory``, the flanks of a cam by name, each ``(2, n)``, a point for a cam angle."""

    theory: dict[str, np.ndarray]
    cam_angle: np.ndarray
    tool: Roller | Face
    envelope: list[Flank]

    @cached_property
    def _clear(self) -> list[np.ndarray]:
        """Which points of each flank the tool does not cover."""
        return [self.tool.depth(f.points) <= np.where(f.rows >= 0, CLEAR, BETWEEN) for f in self.envelope]

    @cached_property
    def _arcs(self) -> list[Arc]:
        """The envelope from crossing to crossing; as a whole if the tool covers nothing of it."""
        return whole(self.envelope) if all(clear.all() for clear in self._clear) else arcs(self.envelope)

    def _is_left(self, arc: Arc) -> bool:
        return is_left(arc, self._clear[arc.curve], self.tool)

    @cached_property
    def left_arcs(self) -> list[Arc]:
        """The arcs that the tool leaves, without single points that it covers."""
        left = [arc for arc in self._arcs if self._is_left(arc)]
        return [arc._replace(inner=arc.inner[self._clear[arc.curve][arc.inner]]) for arc in left]

    @cached_property
    def lost_arcs(self) -> list[Arc]:
        """The arcs that it cuts away."""
        return [arc for arc in self._arcs if not self._is_left(arc)]

    @cached_property
    def left(self) -> tuple[Piece, ...]:
        """What is left of the flanks."""
        return tuple(self._pieces(self.left_arcs))

    @cached_property
    def lost(self) -> tuple[Piece, ...]:
        """The stretches of the theory that the tool cuts away."""
        return tuple(self._pieces(self.lost_arcs))

    def _pieces(self, given: list[Arc]) -> Iterator[Piece]:
        """Arcs of one flank that begin where another ends, joined."""
        for name in dict.fromkeys(flank.name for flank in self.envelope):
            for chain in chains([arc for arc in given if self.envelope[arc.curve].name == name]):
                first, *others = (points_of(arc, self.envelope) for arc in chain)
                points = np.hstack([first, *(more[:, 1:] for more in others)])
                yield Piece(name, points[:, :-1] if is_ring(chain) else points, is_ring(chain))

    @cached_property
    def _rows(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """For each flank which rows are cut away, and the points of all rows on what is left."""
        return {flank.name: self._rows_of(i) for i, flank in enumerate(self.envelope) if (flank.rows >= 0).any()}

    def _rows_of(self, i: int) -> tuple[np.ndarray, np.ndarray]:
        flank, own = self.envelope[i], np.flatnonzero(self.envelope[i].rows >= 0)
        kept = self._kept(i)
        points = flank.points.copy()
        points[:, ~kept] = self._resting_points(i, kept)
        return ~kept[own], points[:, own]

    def _kept(self, i: int) -> np.ndarray:
        """Which points of a flank lie on arcs that are left, and are clear."""
        flank = self.envelope[i]
        kept = np.zeros(len(flank.rows), dtype=bool)
        for arc in (arc for arc in self.left_arcs if arc.curve == i):
            inside = np.arange(int(np.ceil(arc.start.place)), int(np.floor(arc.end.place)) + 1)
            kept[inside % flank.segments if flank.closed else inside] = True
        if flank.closed:
            kept[-1] = kept[0]
        return kept & self._clear[i]

    def _resting_points(self, i: int, kept: np.ndarray) -> np.ndarray:
        """For each point of a flank that is not kept the nearest along the flank that is, or the corner before it."""
        flank, n = self.envelope[i], self.envelope[i].segments
        corners = [node for arc in self.left_arcs if arc.curve == i for node in (arc.start, arc.end)]
        places = np.append([node.place % n if flank.closed else node.place for node in corners], np.flatnonzero(kept))
        if not len(places):
            return np.full((2, int((~kept).sum())), np.nan)
        points = np.vstack([*(node.point for node in corners), flank.points[:, kept].T])
        away = abs(places - np.flatnonzero(~kept)[:, None])
        away = np.minimum(away, n - away) if flank.closed else away
        return np.asarray(points[away.argmin(-1)].T)

    @property
    def cut_away(self) -> dict[str, np.ndarray]:
        """Where each flank is cut away, ``(n,)``."""
        return {flank: rows for flank, (rows, _) in self._rows.items()}

    @property
    def points(self) -> dict[str, np.ndarray]:
        """Each flank ``(2, n)``, a point for each cam angle; a point that is cut away stands on the corner."""
        return {flank: points for flank, (_, points) in self._rows.items()}

    @cached_property
    def cuts(self) -> tuple[Cut, ...]:
        """What the tool cuts away, stretch by stretch."""
        closed, found = {flank.name: flank.closed for flank in self.envelope}, []
        for flank, rows in self.cut_away.items():
            left = [piece.points for piece in self.left if piece.flank == flank]
            for run in runs(rows, closed[flank]):
                gaps = self.tool.gaps(run, np.concatenate(left, axis=1)) if left else np.array([np.inf])
                first, last = self.cam_angle[run[[0, -1]]]
                found.append(Cut(flank, float(first), float(last), float(gaps.max())))
        return tuple(found)


def is_left(arc: Arc, clear: np.ndarray, tool: Roller | Face) -> bool:
    """Whether the tool leaves an arc: most points of its curve on it are ``clear``, or its middle if it has none."""
    inner = clear[arc.inner]
    if not len(inner):
        inner = tool.depth((arc.start.point + arc.end.point)[:, None] / 2) <= BETWEEN
    return bool(inner.mean() > 0.5)


def flanks(analysis: Any) -> Flanks:
    """What the follower, as a tool, leaves of the flanks of one cam's analysis.

    >>> from camkit import TranslatingFlatCam, TranslatingRollerCam, mm
    >>> flanks(TranslatingRollerCam().analyse()).cuts
    ()
    >>> for cut in flanks(TranslatingFlatCam(base_radius=10 * mm).analyse()).cuts:
    ...     print(cut)
    the profile from 80 to 95 deg, where the follower stays 0.00294 mm from its place
    the profile from 205 to 220 deg, where the follower stays 0.00294 mm from its place
    """
    profile, angle = analysis.profile, analysis.profile_angle
    normals = getattr(analysis, "face_normal", None)
    if normals is not None:
        return Flanks({"profile": profile}, angle, Face(normals, profile), face_envelope(profile, normals))
    pitch, radius = analysis.pitch, float(np.ravel(analysis.cam.roller_radius)[0])
    period = getattr(analysis, "period", np.zeros(2))  # of a cam that is drawn unrolled
    theory = {"profile": profile}
    if np.isfinite(analysis.outer_profile).all():
        theory["outer profile"] = analysis.outer_profile
    centres = np.hstack([pitch + turn * period[:, None] for turn in ((0, -1, 1) if period.any() else (0,))])
    return Flanks(theory, angle, Roller(centres, radius), roller_envelope(theory, pitch, radius, period))


def runs(where: np.ndarray, closed: bool) -> list[np.ndarray]:
    """Runs of numbers at which something is so; on a closed curve one may go on beyond the end."""
    numbers = np.flatnonzero(where)
    if not len(numbers):
        return []
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    if closed and len(runs) > 1 and where[0] and where[-1]:
        runs = [*runs[1:-1], np.concatenate([runs[-1], runs[0]])]
    return runs
