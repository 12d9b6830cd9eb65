"""Where a motion through given points goes beyond them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..extrema import highest_between
from ..quantities.types import Array, Value
from ..units import factor, in_unit
from .parts import Polynomial
from .segments import Segment

if TYPE_CHECKING:
    from .matched import MatchedProgram

OVER = 1e-6
"""A level farther outside the given ones than this share of their range overshoots."""


@dataclass(frozen=True)
class Overshoot:
    """How far a part leaves the range of the levels given for it, and where; and what its other form does.

    ``by`` and ``other_by`` are in the follower's unit (m or rad), above 0 beyond the highest level and below it beyond
    the lowest; ``angle`` is the cam angle, rad.
    """

    part: str
    form: str
    angle: float
    by: float
    other_by: float

    def text(self, unit: str = "") -> str:
        """In words, with lengths or angles in ``unit``.

        >>> Overshoot("lobe", "polynomial", 1.0, 0.002, 0.0).text("mm")
        'lobe overshoots by 2 mm at 57.2958°; as a spline it does not'
        """
        one, other = (f"{abs(by) / factor(unit):.4g} {unit or 'follower units'}" for by in (self.by, self.other_by))
        now = f"{self.part} overshoots by {one} at {in_unit(self.angle, 'deg'):.6g}°"
        form = "spline" if self.form == "polynomial" else "polynomial"
        return f"{now}; as a {form} it {'does not' if self.other_by == 0 else f'does by {other}'}"


def overshoots(program: MatchedProgram) -> list[Overshoot]:
    """Of each part with points inside; see `MatchedProgram.overshoots`."""
    points = (i for i, part in enumerate(program.parts) if isinstance(part, Polynomial) and part.through)
    return [found for i in points for found in _overshoots(program, i)]


def _overshoots(program: MatchedProgram, i: int) -> list[Overshoot]:
    """Of one part."""
    part: Any = program.parts[i]
    other = part.replace(form="spline" if part.form == "polynomial" else "polynomial")
    found = _beyond(program, i)
    others = [by for by, _ in _beyond(program.with_part(i, other), i)] if any(by for by, _ in found) else [0.0, 0.0]
    name = program.part_names[i]
    return [
        Overshoot(name, part.form, at, by, other_by) for (by, at), other_by in zip(found, others, strict=True) if by
    ]


def _beyond(program: MatchedProgram, i: int) -> list[tuple[float, float]]:
    """By how much a part goes above the highest level given for it, and below the lowest; and where."""
    part: Any = program.parts[i]
    segment, first = program.segments[i], program.levels[i]
    given = [first, first + segment.change, *(point.s for point in part.through if point.s is not None)]
    ends, size = (0.0, *segment.kinks, 1.0), max(given) - min(given)
    found = []
    for sign, bound in ((1, max(given)), (-1, min(given))):
        top, u = highest_between(partial(_level, segment, sign), ends)
        over = float(top + sign * (first - bound))
        found.append((sign * over if over > OVER * size else 0.0, float(program.starts[i] + u * segment.angle)))
    return found


def _level(segment: Segment, sign: int, u: Array) -> Value:
    return sign * segment.motion(u).s
