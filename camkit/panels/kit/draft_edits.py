"""What a person does to a draft: edits of programs of laws, and of programs whose transitions are matched."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ...motion import (
    Boundary,
    Dwell,
    Law,
    MotionProgram,
    OpenMove,
    Polynomial,
    Return,
    Rise,
    Segment,
    Through,
    Uniform,
)
from ...motion.parts import FREE, MATCH, Part
from ...quantities.kinds import kind_words
from ...units import deg
from . import program_edits as plain
from .draft import Draft

POLYNOMIAL, UNIFORM, OPEN = "polynomial", "constant velocity", "open lift"
KINDS = ("rise", "dwell", "return", POLYNOMIAL, UNIFORM, OPEN)
"""What a segment can be; the last three follow from what holds at their ends."""
WORDS: dict[Any, str] = {
    Rise: "rise",
    Dwell: "dwell",
    Return: "return",
    Polynomial: POLYNOMIAL,
    Uniform: UNIFORM,
    OpenMove: OPEN,
}
FOLLOWS = ("angle", "travel", "velocity")
"""Of a stretch at constant velocity two are given, and one follows."""


def kind_of(part: Segment | Part) -> str:
    """What a part is in the menu, or another segment by its own name."""
    return WORDS.get(type(part), kind_words(type(part)))


def _plainly(draft: Draft, edit: Callable[[MotionProgram], MotionProgram]) -> Draft:
    return Draft.of(edit(draft.program))


def with_angle(draft: Draft, i: int, angle: float) -> Draft:
    """Part ``i`` over another angle (deg); see `program_edits.with_angle`."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.with_angle(program, i, angle))
    fixed = [k for k in range(len(draft.parts)) if k != draft.rest and not draft.own_angle(k)]
    return _with_angles(draft, plain.shared(draft.angles(), i, angle, draft.turns, fixed))


def _with_angles(draft: Draft, angles: list[float]) -> Draft:
    """With other angles (deg) of the parts that have some of their own."""
    parts = list(draft.parts)
    for k, (old, new) in enumerate(zip(draft.angles(), angles, strict=True)):
        if old != new and (draft.own_angle(k) or k == draft.rest):
            parts[k] = replace(parts[k], angle=new * deg)
    return replace(draft, parts=tuple(parts))


def with_edge(draft: Draft, edge: int, angle: float, level: float) -> Draft:
    """An edge at another cam angle (deg), and at another level (m or rad) where one is given; see `program_edits`."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.with_edge(program, edge, angle, level))
    given = draft.boundaries[edge % len(draft.boundaries)].s
    moved = draft.with_boundary(edge, s=level) if not isinstance(given, str) else draft
    return Draft.of(moved.made().program.with_edge(edge, angle * deg))


def with_change(draft: Draft, i: int, change: float) -> Draft:
    """Part ``i`` adding another change (m or rad) to the level."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.with_change(program, i, change))
    part = draft.parts[i]
    if isinstance(part, Uniform):
        return draft.with_part(i, replace(part, travel=change))
    return draft.with_part(i, plain.moved(part, change)) if isinstance(part, (Rise, Return)) else draft


def with_velocity(draft: Draft, i: int, velocity: float) -> Draft:
    """A stretch at another constant velocity (m or rad, per rad)."""
    part = draft.parts[i]
    return draft.with_part(i, replace(part, velocity=velocity)) if isinstance(part, Uniform) else draft


def following(draft: Draft, i: int, follows: str) -> Draft:
    """A stretch at constant velocity of which ``follows`` is what follows from the other two."""
    part, moves = draft.parts[i], draft.program.segments[i]
    if not isinstance(part, Uniform):
        return draft
    angle, travel = draft.angles()[i] * deg, float(moves.change)
    found: dict[str, Any] = {"angle": angle, "travel": travel, "velocity": float(travel / moves.angle)} | {
        follows: None
    }
    return draft.with_part(i, replace(part, **found))


def with_kind(draft: Draft, i: int, kind: str, lift: float, law: Law) -> Draft:
    """Part ``i`` as another kind, with a lift and a law where it has some."""
    if not draft.matched and kind in plain.KINDS:
        return _plainly(draft, lambda program: plain.with_kind(program, i, kind, lift, law))
    draft = draft.with_boundaries()
    name, angle = draft.parts[i].name, draft.angles()[i] * deg
    if kind in plain.KINDS:
        return draft.with_part(i, plain.made(kind, angle, lift, law, name))
    if kind == POLYNOMIAL:
        return draft.with_part(i, Polynomial(angle, name=name))
    if kind == OPEN:
        return draft.with_part(i, OpenMove(angle, law, name=name))
    velocity = float(draft.program.segments[i].change) / angle
    return _levels_open(draft, i).with_part(i, Uniform(velocity, angle=angle, name=name))


def _levels_open(draft: Draft, i: int) -> Draft:
    """Where part ``i`` begins and ends levels and velocities follow, but for the level at cam angle 0.

    Where it does not move, the level at its beginning stays: nothing else would say it.
    """
    stays = not float(draft.program.segments[i].change)
    for k in (i, i + 1):
        if k % len(draft.boundaries):
            level = draft.boundaries[k].s if stays and k == i else MATCH
            draft = draft.with_boundary(k, s=level, v=MATCH)
    return draft


def with_law(draft: Draft, i: int, law: Law) -> Draft:
    """Part ``i`` with another law."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.with_law(program, i, law))
    part = draft.parts[i]
    return draft.with_part(i, replace(part, law=law)) if isinstance(part, (Rise, Return, OpenMove)) else draft


def with_points(draft: Draft, i: int, points: tuple[Through, ...]) -> Draft:
    """A polynomial through other points."""
    part = draft.parts[i]
    return draft.with_part(i, replace(part, through=points)) if isinstance(part, Polynomial) else draft


def with_point(draft: Draft, i: int) -> Draft:
    """A polynomial through one point more: in the middle of its longest stretch without one, at its level there."""
    part, segment = draft.parts[i], draft.program.segments[i]
    if not isinstance(part, Polynomial):
        return draft
    whole = float(segment.angle)
    places = [0.0, *sorted(float(point.place(whole)) for point in part.through), 1.0]
    k = int(np.argmax(np.diff(places)))
    share = (places[k] + places[k + 1]) / 2
    level = float(draft.program.levels[i] + segment.motion(np.array(share)).s)
    point = Through(angle=float(f"{share * whole / deg:.4g}") * deg, s=float(f"{level:.4g}"))
    return with_points(draft, i, (*part.through, point))


def with_form(draft: Draft, i: int, form: str) -> Draft:
    """A polynomial with points as the other form."""
    part = draft.parts[i]
    return draft.with_part(i, replace(part, form=form)) if isinstance(part, Polynomial) else draft


def inserted(draft: Draft, i: int) -> Draft:
    """With a polynomial at place ``i``, or with a dwell in a program of laws."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.inserted(program, i))
    angles = draft.angles()
    can = [k for k in range(len(angles)) if draft.own_angle(k) or k == draft.rest]
    gives = max(can, key=lambda k: (k in (i - 1, i), angles[k]))
    room = min(plain.FRESH, round(angles[gives] / 2, plain.DIGITS))
    angles[gives] = round(angles[gives] - room, plain.DIGITS)
    parts, boundaries = list(_with_angles(draft, angles).parts), list(draft.boundaries)
    parts.insert(i, Polynomial(room * deg))
    boundaries.insert(max(i, 1), Boundary())
    return replace(draft, parts=tuple(parts), boundaries=tuple(boundaries), rest=_moved(draft.rest, i, 1))


def _moved(rest: int | None, i: int, by: int) -> int | None:
    """The place of the rest where parts from place ``i`` on move."""
    return rest if rest is None or rest < i else rest + by


def duplicated(draft: Draft, i: int) -> Draft:
    """With part ``i`` twice; see `program_edits.duplicated`."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.duplicated(program, i))
    half, part = draft.angles()[i] / 2 * deg, draft.parts[i]
    one = _halved(part, half)
    parts, boundaries = list(draft.parts), list(draft.boundaries)
    parts[i : i + 1] = [one, replace(one, name="")]
    boundaries.insert(i + 1, Boundary())
    return replace(draft, parts=tuple(parts), boundaries=tuple(boundaries), rest=_moved(draft.rest, i + 1, 1))


def _halved(part: Segment | Part, angle: float) -> Segment | Part:
    """Half of a part."""
    if isinstance(part, Uniform) and part.travel is not None:
        part = replace(part, travel=part.travel / 2)
        return part if part.angle is None else replace(part, angle=angle)
    if isinstance(part, (Rise, Return)):
        return replace(part, angle=angle, lift=part.lift / 2)
    return replace(part, angle=angle, through=()) if isinstance(part, Polynomial) else replace(part, angle=angle)


def removed(draft: Draft, i: int) -> Draft:
    """Without part ``i``; its angle goes to a neighbour."""
    if not draft.matched:
        return _plainly(draft, lambda program: plain.removed(program, i))
    angles, parts, boundaries = draft.angles(), list(draft.parts), list(draft.boundaries)
    freed = angles.pop(i)
    rest = None if draft.rest == i else _moved(draft.rest, i, -1)
    del parts[i], boundaries[max(i, 1)]
    left = replace(draft, parts=tuple(parts), boundaries=tuple(boundaries), rest=rest)
    near = [k for k in (i - 1, i, *range(len(parts))) if 0 <= k < len(parts) and (k == rest or left.own_angle(k))]
    if draft.turns and near and near[0] != rest:
        parts[near[0]] = replace(parts[near[0]], angle=round(angles[near[0]] + freed, plain.DIGITS) * deg)
        rest = near[0] if rest is None else rest
    return replace(left, parts=tuple(parts), rest=rest)


def smoothed(draft: Draft, k: int) -> Draft:
    """Nothing up to the acceleration jumps where part ``k`` begins, the moves beside it as smooth as they can be."""
    if not draft.matched and _rests(draft.program, k):
        return _plainly(draft, lambda program: plain.smoothed(program, k - 1))
    draft = draft.with_boundaries()
    for i in (k - 1, k % len(draft.parts)):
        if isinstance(draft.parts[i], (Rise, Return)):
            draft = draft.with_part(i, Polynomial(draft.parts[i].angle, name=draft.parts[i].name))
    boundary = draft.boundaries[k % len(draft.boundaries)]
    return draft.with_boundary(k, **{letter: MATCH for letter in "sva" if getattr(boundary, letter) == FREE})


def _rests(program: MotionProgram, k: int) -> bool:
    """Whether the follower rests for a moment where segment ``k`` begins."""
    n = len(program.segments)
    sides = program.segments[k - 1].motion(np.array(1.0)), program.segments[k % n].motion(np.array(0.0))
    size = max(abs(float(segment.change / segment.angle)) for segment in program.segments)
    return all(abs(float(side.v)) <= 1e-9 * size for side in sides)


def resting(draft: Draft, i: int) -> Draft:
    """With the rest of the turn taken by part ``i``."""
    return replace(draft, rest=i)
