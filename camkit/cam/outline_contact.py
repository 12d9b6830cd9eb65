"""Where a follower stands that touches a given place of a cam's outline, and how an outline so moves it.

A place of an outline, with its normal and its radius of curvature ``rho``, is touched at one cam angle; to second order
the outline is its circle of curvature there, so that the place gives ``s, v, a``: the formulas are those of the
analyses of cams, solved for the motion.  ``q = rho + r`` is the radius of the roller centre's path, ``K = 1/q``.

A follower rests on the highest place that it can touch: over all smooth runs of contact the motion is the upper
envelope of their graphs ``s(phi)``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..quantities.types import Array
from ..units import deg
from .oscillating_flat import OscillatingFlatCam
from .oscillating_roller import OscillatingRollerCam
from .outlines import TURN, Piece, Place
from .translating_flat import TranslatingFlatCam
from .translating_roller import TranslatingRollerCam

SHORT = 1e-8
"""A run of contact over less (rad) is none."""
GAP = 0.2 * deg
"""So much of the turn (rad) may lie between two runs where pieces are nearly tangent."""
HALVINGS = 60
LOOK = 0.25 * deg
"""Steps (rad) at which runs are compared; between two of them one may pass another once."""


class Met(NamedTuple):
    """At which cam angle places are touched, modulo a turn, and the follower there: ``s`` is absolute.

    ``s`` is the height of the roller's centre or of the face above the cam axis, m, or the arm's angle, rad.  ``nan``
    where a place cannot be touched.
    """

    cam_angle: Array
    s: Array
    v: Array
    a: Array


Meet = Callable[[Place], Met]


def _stable(radius: Array, r: float) -> Array:
    """Where a roller lies on the outline and not across a hollow that is narrower than itself."""
    return (radius >= 0) & (radius + r > 0) | (radius < -r)


def _if(ok: Array, angle: Array, *motion: Array) -> Met:
    return Met(*(np.where(ok, values, np.nan) for values in (angle, *motion)))


def _on_roller(cam: Any, place: Place) -> tuple[Array, Array, Array, Array]:
    """The roller's centre as the cam sees it, by its distance and direction; the normal's; the path's curvature."""
    centre = place.point + cam.roller_radius * np.array([np.cos(place.normal), np.sin(place.normal)])
    return np.hypot(*centre), np.arctan2(centre[1], centre[0]), place.normal, 1 / (place.radius + cam.roller_radius)


def sliding_roller(cam: TranslatingRollerCam, place: Place) -> Met:
    """``h = sqrt(D^2 - e^2)``; as seen from the cam the follower turns by ``-sigma phi``."""
    D, direction, normal, K = _on_roller(cam, place)
    e, sigma = cam.offset, cam.rotation
    turned = np.arccos(e / D) - direction
    h = np.sqrt(D**2 - e**2)
    across, up = np.cos(normal + turned), np.sin(normal + turned)
    g = -sigma * h * across / up
    v = g + sigma * e
    a = (h**2 + g * (g + v) - K * np.hypot(h, g) ** 3) / h
    return _if((up > 0) & _stable(place.radius, cam.roller_radius), sigma * turned, h, v, a)


def sliding_face(cam: TranslatingFlatCam, place: Place) -> Met:
    """The height is that of the outline's tangent; the face is touched at ``x = sigma v``, and ``rho = s + a``."""
    height, along = _from_axis(place)
    ok = (place.radius >= 0) & np.isfinite(place.radius)
    return _if(ok, cam.rotation * (np.pi / 2 - place.normal), height, cam.rotation * along, place.radius - height)


def _from_axis(place: Place) -> tuple[Array, Array]:
    """Of the tangents to an outline: the distance from the cam axis, and of the place from there, clockwise."""
    (x, y), cos, sin = place.point, np.cos(place.normal), np.sin(place.normal)
    return x * cos + y * sin, x * sin - y * cos


def rocking_roller(cam: OscillatingRollerCam, place: Place) -> Met:
    """The arm's angle closes the triangle of cam axis, pivot and roller."""
    D, direction, normal, K = _on_roller(cam, place)
    a, l, sigma = cam.centre_distance, cam.arm_length, cam.rotation
    psi = np.arccos((a**2 + l**2 - D**2) / (2 * a * l))
    cos, sin = np.cos(psi), np.sin(psi)
    x, y = a - l * cos, l * sin
    turned = np.arctan2(y, x) - direction
    nx, ny = np.cos(normal + turned), np.sin(normal + turned)
    across = nx * sin + ny * cos
    v = sigma * (ny * x - nx * y) / (l * across)
    gain = 1 + sigma * v
    cube = np.hypot(l * gain - a * cos, a * sin) ** 3
    acceleration = (a**2 + l**2 * gain**3 - a * l * gain * (1 + gain) * cos - K * cube) / (a * l * sin)
    return _if((across > 0) & _stable(place.radius, cam.roller_radius), sigma * turned, psi, v, acceleration)


def rocking_face(cam: OscillatingFlatCam, place: Place) -> Met:
    """``p = a sin psi + b`` is the distance of the outline's tangent, and ``q`` along the arm gives the velocity."""
    p, along = _from_axis(place)
    a, b, sigma = cam.centre_distance, cam.face_offset, cam.rotation
    psi = np.arcsin((p - b) / a)
    q = a * np.cos(psi) - along
    v, rho = along / q, place.radius
    gain = 1 + v
    acceleration = ((rho - b) * gain**3 / a - gain * (1 + 2 * v) * np.sin(psi)) / np.cos(psi)
    ok = (rho >= 0) & np.isfinite(rho) & (q > 0)
    return _if(ok, sigma * (np.pi / 2 - psi - place.normal), psi, sigma * v, acceleration)


MEETS: dict[type, Callable[[Any, Place], Met]] = {
    TranslatingRollerCam: sliding_roller,
    TranslatingFlatCam: sliding_face,
    OscillatingRollerCam: rocking_roller,
    OscillatingFlatCam: rocking_face,
}
"""How each follower meets an outline."""


@dataclass(frozen=True)
class Run:
    """Contact that goes on smoothly along a piece of an outline: shares ``u`` of it, and rising cam angles there."""

    piece: Piece
    meet: Meet
    u: Array
    angle: Array

    def beside(self, turns: int) -> Run:
        """The same, some turns later."""
        return Run(self.piece, self.meet, self.u, self.angle + turns * TURN)

    @property
    def low(self) -> float:
        return float(self.angle[0])

    @property
    def high(self) -> float:
        return float(self.angle[-1])

    def at(self, angle: Array) -> Met:
        """The follower at cam angles; a little beyond the ends as it would go on."""
        x = np.clip(angle, self.low, self.high)
        s, v, a = self.met(self.share(x), x)[1:]
        beyond = angle - x
        return Met(angle, s + v * beyond + a * beyond**2 / 2, v + a * beyond, a)

    def met(self, u: Array, near: Array) -> Met:
        """The follower on shares of the piece, its cam angles those next to given ones."""
        with np.errstate(all="ignore"):
            found = self.meet(self.piece.at(u))
        return found._replace(cam_angle=found.cam_angle + TURN * np.round((near - found.cam_angle) / TURN))

    def share(self, x: Array) -> Array:
        """The share of the piece that is touched at cam angles within the run: the secant's, kept between two looks."""
        i = np.clip(np.searchsorted(self.angle, x), 1, len(self.angle) - 1)
        low, high, below, above = self.u[i - 1], self.u[i], self.angle[i - 1] - x, self.angle[i] - x
        for step in range(HALVINGS):
            flat = (step % 3 == 2) | (above - below <= 0)
            u = np.where(flat, (low + high) / 2, low - below * (high - low) / np.where(flat, 1.0, above - below))
            off = self.met(u, x).cam_angle - x
            up = np.isnan(off) | (off > 0)
            low, below = np.where(up, low, u), np.where(up, below, off)
            high, above = np.where(up, u, high), np.where(up, off, above)
            if (np.minimum(abs(below), abs(above)) < 1e-15).all():
                break
        return np.where(abs(below) < abs(above), low, high)


class Stretch(NamedTuple):
    """From one cam angle to another the follower rests on one run."""

    start: float
    end: float
    run: Run


def runs(pieces: Sequence[Piece], meet: Meet, rotation: int) -> list[Run]:
    """All smooth runs of contact in the turn from cam angle 0; a piece that is closed begins where that is touched."""
    found = [run for piece in pieces for run in _runs(piece, meet, rotation)]
    if len(pieces) == 1 and pieces[0].closed and found:
        at_0 = [run for run in _around(found) if run.low <= 0 <= run.high]
        top = max(at_0, key=lambda run: float(run.at(np.zeros(1)).s[0]), default=found[0])
        found = [*_runs(pieces[0].beginning(float(top.share(np.zeros(1))[0])), meet, rotation)]
    return _around(found)


def _around(found: Sequence[Run]) -> list[Run]:
    return [run.beside(k) for run in found for k in range(-int(run.high // TURN) - 1, 1 - int(run.low // TURN))]


def _runs(piece: Piece, meet: Meet, rotation: int) -> Iterator[Run]:
    """The runs on one piece: where it can be touched, and the cam angle goes against its direction."""
    u = np.linspace(0, 1, piece.looks)
    with np.errstate(all="ignore"):
        met = meet(piece.at(u))
    ok = np.isfinite(met.cam_angle + met.s + met.v)
    for first, last in _stretches(ok):
        before = [_edge(piece, meet, u[first], u[first - 1])] if first else []
        after = [_edge(piece, meet, u[last], u[last + 1])] if last + 1 < len(u) else []
        share = np.array([*before, *u[first : last + 1], *after])
        with np.errstate(all="ignore"):
            angle = np.unwrap(meet(piece.at(share)).cam_angle)
        share, angle = (share[::-1], angle[::-1]) if rotation > 0 else (share, angle)
        rising = np.append(True, angle[1:] > np.maximum.accumulate(angle)[:-1])
        share, angle = share[rising], angle[rising]
        if angle[-1] - angle[0] > SHORT:
            yield Run(piece, meet, share, angle)


def _stretches(ok: Array) -> list[tuple[int, int]]:
    """The first and the last of each row of places where something holds."""
    change = np.flatnonzero(np.diff(np.concatenate([[False], ok, [False]]).astype(int)))
    return [(int(a), int(b) - 1) for a, b in zip(change[::2], change[1::2], strict=True)]


def _edge(piece: Piece, meet: Meet, inside: float, outside: float) -> float:
    """The last share of a piece that can be touched, between one that can and one that cannot."""
    for _ in range(HALVINGS):
        middle = (inside + outside) / 2
        with np.errstate(all="ignore"):
            met = meet(piece.at(np.array([middle])))
        inside, outside = (middle, outside) if np.isfinite(met.cam_angle + met.s + met.v)[0] else (inside, middle)
    return float(inside)


def upper_envelope(given: Sequence[Run]) -> list[Stretch]:
    """On which run the follower rests around the turn from cam angle 0."""
    ends = np.array([0.0, TURN, *(x for run in given for x in (run.low, run.high) if 0 < x < TURN)])
    ends = np.unique(ends)
    ends = ends[np.append(np.diff(ends) > SHORT, True)]
    ends[0] = 0.0
    found: list[Stretch] = []
    for start, end in pairwise(ends.tolist()):
        here = [run for run in given if run.low < start + SHORT and run.high > end - SHORT]
        for stretch in _highest(here, start, end):
            if found and found[-1].run is stretch.run:
                stretch = Stretch(found.pop().start, stretch.end, stretch.run)
            found.append(stretch)
    return _without_gaps(found)


def _highest(here: Sequence[Run], start: float, end: float) -> Iterator[Stretch]:
    """The highest of runs that all go from one cam angle to another, wherever one passes another."""
    if not here:
        return
    x = np.linspace(start, end, 2 + int((end - start) / LOOK)) if len(here) > 1 else np.array([start, end])
    top = np.argmax([run.at((x[1:] + x[:-1]) / 2).s for run in here], axis=0)
    for k in np.flatnonzero(np.diff(top)):
        middle = (x[k : k + 2] + x[k + 1 : k + 3]) / 2
        passed = _crossing(here[top[k]], here[top[k + 1]], *middle.tolist())
        yield Stretch(start, passed, here[top[k]])
        start = passed
    yield Stretch(start, end, here[top[-1]])


def _crossing(one: Run, other: Run, low: float, high: float) -> float:
    """The cam angle from which on another run is the higher one."""
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        x = np.array([middle])
        low, high = (middle, high) if one.at(x).s[0] > other.at(x).s[0] else (low, middle)
    return high


def _without_gaps(found: Sequence[Stretch]) -> list[Stretch]:
    """Stretches that follow one another, short gaps between them closed from both sides."""
    ends = [0.0, *(stretch.end for stretch in found)]
    for end, start in zip(ends, [*(stretch.start for stretch in found), TURN], strict=True):
        if start - end > GAP:
            raise ValueError(
                f"the follower touches the outline nowhere at cam angle {(start + end) / 2 / deg:.4g} deg: it passes "
                "beside the cam, or its arm does not reach it; another offset, arm or place may do"
            )
    starts = [0.0, *((before.end + after.start) / 2 for before, after in pairwise(found)), TURN]
    whole = [Stretch(*ends, stretch.run) for ends, stretch in zip(pairwise(starts), found, strict=True)]
    return [stretch for stretch in whole if stretch.end - stretch.start > SHORT]
