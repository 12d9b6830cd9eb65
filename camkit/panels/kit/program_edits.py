"""What a person does to a motion program: another angle, lift, kind, law; segments put in, copied, taken out.

A program that spans a turn stays a turn: what one segment takes its neighbours give, and the last of the other moves
takes the follower back to where the turn began.  Angles are in deg, with the digits that a box shows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...motion import Cycloidal, Dwell, Law, MotionProgram, Poly345, Return, Rise, Segment
from ...motion.segments import kind_of
from ...units import deg, in_unit

LEAST = 1.0
"""The least angle (deg) that a neighbour keeps."""
FRESH = 30.0
"""The angle (deg) of a segment that is put in, where there is room for it."""
KINDS = ("rise", "dwell", "return")
DIGITS = 9
"""Of an angle in deg, after the point: what is taken and given back leaves no trace."""


def angles_of(program: MotionProgram) -> list[float]:
    """The angles of the segments, deg."""
    return [round(in_unit(float(segment.angle), "deg"), DIGITS) for segment in program.segments]


def changes_of(program: MotionProgram) -> list[float]:
    """What each segment adds to the level, in the follower's unit."""
    return [float(segment.change) for segment in program.segments]


def with_angles(program: MotionProgram, angles: Sequence[float]) -> list[Segment]:
    """The same segments over other angles (deg); those that stay keep theirs to the last digit."""
    pairs = zip(program.segments, angles_of(program), angles, strict=True)
    return [segment if old == new else replace(segment, angle=new * deg) for segment, old, new in pairs]


def with_angle(program: MotionProgram, i: int, angle: float) -> MotionProgram:
    """Segment ``i`` over another angle (deg); what it takes or leaves is its neighbours' where the program is a turn.

    The next one gives first, then those after it, then those before.  ``ValueError`` for an angle that they have not.
    """
    angles = shared(angles_of(program), i, angle, bool(program.periodic))
    return program.replace(segments=tuple(with_angles(program, angles)))


def shared(angles: Sequence[float], i: int, angle: float, turns: bool, fixed: Sequence[int] = ()) -> list[float]:
    """Angles (deg) of which one is another; what it takes or leaves the others do that are not ``fixed``."""
    if not angle > 0:
        raise ValueError(f"the angle stays as before: {angle:g} deg was typed; it must be above 0 deg")
    found = list(angles)
    wanted, found[i] = angle - found[i], angle
    if not turns:
        wanted = max(sum(found) - 360, 0.0)
    for k in (*range(i + 1, len(found)), *range(i - 1, -1, -1)):
        if k not in fixed:
            given = min(wanted, max(found[k] - LEAST, 0.0))
            found[k], wanted = round(found[k] - given, DIGITS), round(wanted - given, DIGITS)
    if wanted > 0:
        most = f"with at least {LEAST:g} deg for each of the others it can be {angle - wanted:.6g} deg"
        raise ValueError(f"the angle stays as before: {angle:g} deg was typed; {most}")
    return found


def with_change(program: MotionProgram, i: int, change: float) -> MotionProgram:
    """Segment ``i`` adding another change to the level; in a turn the last of the other moves takes it back."""
    segments = list(program.segments)
    if isinstance(segments[i], Dwell):
        return program
    segments[i] = moved(segments[i], change)
    return closed(program, segments, i)


def closed(program: MotionProgram, segments: Sequence[Segment], i: int | None = None) -> MotionProgram:
    """The program with other segments; in a turn the last move, but not ``i``, comes back to where the turn began."""
    found = list(segments)
    moves = [k for k, segment in enumerate(found) if not isinstance(segment, Dwell)]
    takes = next((k for k in reversed(moves) if k != i), moves[0] if moves else None)
    if program.periodic and takes is not None:
        others = sum(float(segment.change) for k, segment in enumerate(found) if k != takes)
        found[takes] = moved(found[takes], _rounded(float(program.levels[-1] - program.start) - others))
    return program.replace(segments=tuple(found))


def _rounded(level: float) -> float:
    """Without the last digit's noise."""
    return float(f"{level:.12g}")


def moved(segment: Segment, change: float) -> Segment:
    """A move that adds ``change`` to the level: a rise or a return, with the law that it has."""
    kind = kind_of(segment) if change == 0 else "rise" if change > 0 else "return"
    return made(kind, float(segment.angle), abs(change), getattr(segment, "law", Cycloidal()), segment.name)


def made(kind: str, angle: float, lift: float, law: Law, name: str = "") -> Segment:
    """A segment of a kind over an ``angle`` (rad)."""
    if kind == "dwell":
        return Dwell(angle, name=name)
    return (Rise if kind == "rise" else Return)(angle, lift, law, name=name)


def with_kind(program: MotionProgram, i: int, kind: str, lift: float, law: Law) -> MotionProgram:
    """Segment ``i`` as another kind, with a lift and a law if it moves."""
    segments, old = list(program.segments), program.segments[i]
    segments[i] = made(kind, float(old.angle), lift, law, old.name)
    return closed(program, segments, i)


def with_law(program: MotionProgram, i: int, law: Law) -> MotionProgram:
    """Segment ``i`` with another law."""
    segments = list(program.segments)
    if isinstance(segments[i], Dwell):
        return program
    segments[i] = replace(segments[i], law=law)
    return program.replace(segments=tuple(segments))


def inserted(program: MotionProgram, i: int) -> MotionProgram:
    """With a dwell at place ``i``: over what is missing to the turn, else over a part of what a neighbour has."""
    angles = angles_of(program)
    room = round(360 - sum(angles), DIGITS)
    if room < LEAST:
        gives = max((k for k in (i - 1, i) if 0 <= k < len(angles)), key=lambda k: angles[k])
        room = min(FRESH, round(angles[gives] / 2, DIGITS))
        angles[gives] = round(angles[gives] - room, DIGITS)
    segments = with_angles(program, angles)
    return program.replace(segments=(*segments[:i], Dwell(room * deg), *segments[i:]))


def duplicated(program: MotionProgram, i: int) -> MotionProgram:
    """With segment ``i`` twice; in a turn that is full both have half its angle and half its lift."""
    segments, old = list(program.segments), program.segments[i]
    share = 1.0 if not program.periodic and sum(angles_of(program)) + angles_of(program)[i] <= 360 else 0.5
    half = made(kind_of(old), share * float(old.angle), 0.0, getattr(old, "law", Cycloidal()), old.name)
    half = moved(half, share * float(old.change)) if not isinstance(old, Dwell) else half
    segments[i : i + 1] = [half, replace(half, name="")]
    return program.replace(segments=tuple(segments))


def removed(program: MotionProgram, i: int) -> MotionProgram:
    """Without segment ``i``; in a turn its angle goes to the neighbour, a dwell rather than a move."""
    segments, angles = list(program.segments), angles_of(program)
    if len(segments) == 1:
        raise ValueError("a program has one segment at least")
    freed = angles.pop(i)
    del segments[i]
    if not program.periodic:
        return program.replace(segments=tuple(segments))
    beside = [k for k in (i - 1, i) if 0 <= k < len(angles)]
    takes = next((k for k in beside if isinstance(segments[k], Dwell)), beside[0])
    segments[takes] = replace(segments[takes], angle=round(angles[takes] + freed, DIGITS) * deg)
    return closed(program, segments)


def with_edge(program: MotionProgram, edge: int, angle: float, level: float) -> MotionProgram:
    """The edge between two segments at another cam angle (deg), as far as its neighbours let it, and at another level.

    Dwells beside it go with it; the level at which the turn begins stays.
    """
    edges, levels = np.asarray(program.edges) / deg, np.asarray(program.levels, dtype=float)
    edges[edge] = np.clip(angle, edges[edge - 1] + LEAST, edges[edge + 1] - LEAST)
    levels[_level_run(program.segments, edge)] = level
    shifted = with_angles(program, [round(float(beta), DIGITS) for beta in np.diff(edges)])
    segments = [
        segment if isinstance(segment, Dwell) else moved(segment, _rounded(float(change)))
        for segment, change in zip(shifted, np.diff(levels), strict=True)
    ]
    return program.replace(segments=tuple(segments))


def _level_run(segments: Sequence[Segment], edge: int) -> list[int]:
    """The edges that are at the same level as ``edge`` because only dwells lie between; none where that is fixed."""
    first = last = edge
    while first > 0 and isinstance(segments[first - 1], Dwell):
        first -= 1
    while last < len(segments) and isinstance(segments[last], Dwell):
        last += 1
    return [] if first == 0 or last == len(segments) else list(range(first, last + 1))


def smoothed(program: MotionProgram, i: int) -> MotionProgram:
    """The moves on both sides of the end of segment ``i`` from rest to rest by a law that no follower feels there."""
    segments = list(program.segments)
    for k in (i, (i + 1) % len(segments)):
        if not isinstance(segments[k], Dwell):
            segments[k] = replace(segments[k], law=Poly345())
    return program.replace(segments=tuple(segments))
