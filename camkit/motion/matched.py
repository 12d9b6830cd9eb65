"""A motion program whose transitions are matched: what is left open becomes as smooth as it can.

>>> from camkit.motion import Dwell, Polynomial, Uniform
>>> from camkit.units import deg, inch, rpm
>>> belt = Uniform(22 * inch / (58 * rpm), 1.1 * inch, name="with_the_belt")
>>> conveyor = MatchedProgram((Polynomial(60 * deg), belt, Polynomial(name="back"), Dwell(60 * deg)))
>>> [round(float(level), 6) for level in conveyor.levels]
[0.0, 0.04781, 0.07575, 0.0, 0.0]
>>> [transition.lawful for transition in conveyor.transitions()]
[True, True, True, True]
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, zip_longest
from typing import Any, Self

import numpy as np

from ..quantities import Declared, certain, unless
from ..quantities.kinds import a_number, kind_words, listed, refuse_kinds, refuse_lengths, shown, whole
from ..quantities.types import Value
from .closing import TURN
from .matching import Asked, solved
from .overshoot import Overshoot, overshoots
from .parts import FREE, Boundary, Part, Uniform, refuse_names
from .program import MotionProgram
from .refused import ROUNDED
from .segments import Dwell, Segment, degrees

RESERVED = ("start", "segments", "advance", "form", "parts", "boundaries", "rest")
MOST_PARTS = 100
"""Of a program: what they leave open is found at once."""


@dataclass(frozen=True)
class MatchedProgram(MotionProgram):
    """Parts in a row from cam angle 0, and what holds where they meet; a motion program in all else.

    ``parts`` are segments that know their motion (`Dwell`, `Rise`, ...) and others that follow from what holds at their
    ends: `Polynomial`, `Uniform`, `OpenMove`.  ``boundaries`` are where each part begins; that of the first is where
    the turn ends, too.  A program of less than a turn has one more, where it ends.  Without ``boundaries`` position,
    velocity and acceleration match everywhere, and the level at cam angle 0 is 0.

    In a turn one part, by name the ``rest``, takes the angle that the others leave: the one without an angle, else the
    last dwell, else the last part.  What the conditions leave open makes the integral of jerk squared over the
    polynomials least, and that of its derivative once a jerk is given or matched (``order`` 3 or 4).

    Paths call the parts by their own names or by kind and count, such as ``polynomial`` and ``dwell2``, and
    the boundaries by theirs or by the part that begins there, such as ``dwell2_start``.  Numbers may be columns
    ``(p, 1)``, a population.  ``ValueError`` in a sentence for conditions that contradict each other, or leave
    something open; in a population those rows are ``nan``.
    """

    segments: tuple[Segment, ...] = field(default=(), init=False, repr=False, compare=False)
    start: Value = field(default=0.0, init=False, repr=False, compare=False)
    parts: tuple[Segment | Part, ...] = ()
    boundaries: tuple[Boundary, ...] = ()
    rest: str = ""
    solved_levels: tuple[Value, ...] = field(default=(), init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", listed(self.parts, "what the program is made of", "part"))
        object.__setattr__(self, "boundaries", listed(self.boundaries, "the transitions of the program", "part"))
        object.__setattr__(self, "advance", a_number(self.advance, "the advance of the program"))
        _refuse_parts(self)
        refuse_lengths(self)
        if self._is_turn():
            self._take_the_rest()
        self._join_all()
        refuse_names((*self.part_names, *self.boundary_names), "a part or a boundary of the program", RESERVED)
        self._solve()
        super().__post_init__()

    @cached_property
    def part_names(self) -> tuple[str, ...]:
        """What paths call the parts."""
        kinds = [kind_words(type(part)).replace(" ", "_") for part in self.parts]
        counts = [kinds[: i + 1].count(kind) for i, kind in enumerate(kinds)]
        by_kind = [kind if count == 1 else f"{kind}{count}" for kind, count in zip(kinds, counts, strict=True)]
        return tuple(part.name or name for part, name in zip(self.parts, by_kind, strict=True))

    @property
    def boundary_names(self) -> tuple[str, ...]:
        """What paths call the boundaries."""
        usual = (*(f"{name}_start" for name in self.part_names), "end")
        return tuple(boundary.name or name for boundary, name in zip(self.boundaries, usual, strict=False))

    @property
    def turns(self) -> bool:
        """Whether the last part goes on with the first: it is a program of a turn."""
        return len(self.boundaries) == len(self.parts)

    @property
    def order(self) -> int:
        """The order of the derivative whose square is least: 3, or 4 where a jerk is given or matched."""
        return 3 if all(isinstance(boundary.j, str) and boundary.j == FREE for boundary in self.boundaries) else 4

    def branches(self) -> dict[str, Any]:
        """The boundaries and the parts by name, in the order of the cam angle."""
        boundaries = zip(self.boundary_names, self.boundaries, strict=True)
        parts = zip(self.part_names, self.parts, strict=True)
        pairs = chain.from_iterable(zip_longest(boundaries, parts))
        return {name: part for name, part in filter(None, pairs) if isinstance(part, Declared)}

    def following(self) -> dict[str, str]:
        """The angle that the other parts leave."""
        return {f"{self.rest}.angle": "it takes up what the other parts leave of the turn"} if self.rest else {}

    def changed(self, changes: Mapping[str, Any]) -> MatchedProgram:
        """With other parts and boundaries by name."""
        parts = tuple(changes.get(name, part) for name, part in zip(self.part_names, self.parts, strict=True))
        boundaries = tuple(
            changes.get(name, boundary) for name, boundary in zip(self.boundary_names, self.boundaries, strict=True)
        )
        return self.replace(parts=parts, boundaries=boundaries)

    def with_part(self, i: int, part: Segment | Part) -> Self:
        """With another part in place of the one at ``i``."""
        i = whole(i, "the place of the part", 0, len(self.parts) - 1)
        return self.replace(parts=(*self.parts[:i], part, *self.parts[i + 1 :]))

    def with_boundary(self, i: int, boundary: Boundary) -> Self:
        """With another boundary in place of the one at ``i``."""
        i = whole(i, "the place of the boundary", 0, len(self.boundaries) - 1)
        return self.replace(boundaries=(*self.boundaries[:i], boundary, *self.boundaries[i + 1 :]))

    def _levels(self) -> list[Any]:
        return list(self.solved_levels)

    def _size(self) -> Value:
        return sum(map(np.abs, self.solved_levels))

    def overshoots(self) -> list[Overshoot]:
        """Where parts with points inside leave the range of the levels given for them.

        ``ValueError`` for a population, whose members have ranges of their own.
        """
        if np.ndim(self.possible):
            raise ValueError("the program is a population; overshoots are named for one program at a time")
        return overshoots(self)

    def _giving(self, numbers: range) -> int:
        found = [i for i in numbers if i in self._own_angles]
        if not found:
            raise ValueError("the boundary cannot be moved: on one side of it all angles follow from other numbers")
        return found[0]

    def _with_angles(self, angles: Mapping[int, Value]) -> Self:
        parts = enumerate(self.parts)
        return self.replace(parts=tuple(replace(p, angle=angles[i]) if i in angles else p for i, p in parts))

    @property
    def _own_angles(self) -> list[int]:
        """The parts whose angle does not follow from a velocity and a travel."""
        return [i for i, part in enumerate(self.parts) if not (isinstance(part, Uniform) and part.angle is None)]

    def _is_turn(self) -> bool:
        """Whether it is a program of a turn, as far as the boundaries, the rest and the angles say."""
        if self.boundaries or self.rest:
            return self.turns or not self.boundaries
        angles = list(map(_taken, self.parts))
        return any(angle is None for angle in angles) or certain(np.abs(sum(angles) - TURN) <= ROUNDED)

    def _take_the_rest(self) -> None:
        """Give the rest of the turn to the part that takes it."""
        i = _rest_of(self, self._own_angles)
        others = sum(_taken(part) for part in (*self.parts[:i], *self.parts[i + 1 :]))
        if refuse := unless(others < TURN):
            refuse(
                f"the other parts take {degrees(others)} of the turn; they must leave some for "
                f"{self.part_names[i]}, which takes the rest"
            )
        part = replace(self.parts[i], angle=TURN - others)
        object.__setattr__(self, "rest", self.part_names[i])
        object.__setattr__(self, "parts", (*self.parts[:i], part, *self.parts[i + 1 :]))

    def _join_all(self) -> None:
        """The boundaries, each that is not given matched."""
        if not self.boundaries:
            more = len(self.parts) - bool(self.rest)
            object.__setattr__(self, "boundaries", (Boundary(s=0.0), *(Boundary() for _ in range(more))))

    def _solve(self) -> None:
        """Find the motion of each part."""
        asked = [
            Asked(part, name, _taken(part), self.order) for part, name in zip(self.parts, self.part_names, strict=True)
        ]
        found = solved(asked, self.boundaries, self.advance if self.turns else None)
        levels = found.levels
        if not certain(found.possible):
            levels = [np.where(found.possible, level, np.nan) for level in levels]
        object.__setattr__(self, "segments", found.segments)
        object.__setattr__(self, "start", levels[0])
        object.__setattr__(self, "solved_levels", tuple(levels))


def _taken(part: Any) -> Any:
    """The cam angle of a part."""
    return part.taken() if isinstance(part, Part) else part.angle


def _rest_of(program: MatchedProgram, own: list[int]) -> int:
    """Which part takes the rest of the turn."""
    names, open_ones = program.part_names, [i for i, part in enumerate(program.parts) if _taken(part) is None]
    if program.rest and program.rest not in names:
        raise ValueError(f"the rest of the turn is given to {program.rest}; the parts are {', '.join(names)}")
    taking = [names.index(program.rest)] if program.rest else open_ones
    if len({*taking, *open_ones}) > 1:
        told = " and ".join(names[i] for i in sorted({*taking, *open_ones}))
        raise ValueError(f"{told} have no angle; one part can take the rest of the turn")
    if taking:
        return taking[0]
    total = sum(map(_taken, program.parts))
    if refuse := unless(np.abs(total - TURN) <= ROUNDED):
        refuse(
            f"the parts take {degrees(total, 10)}; name the part that takes the rest of the turn, such as rest='dwell'"
        )
    dwells = [i for i in own if isinstance(program.parts[i], Dwell)]
    return (dwells or own or [len(names) - 1])[-1]


def _refuse_parts(program: MatchedProgram) -> None:
    if not program.parts:
        raise ValueError("the program is empty; it needs at least one part")
    for i, part in enumerate(program.parts, start=1):
        if not isinstance(part, (Segment, Part)):
            raise ValueError(
                f"part {i} of the program is {shown(part)}; it must be a segment, or a part such as Polynomial"
            )
    refuse_kinds(program, ("segments", "start", "parts", "solved_levels", "advance"))
    n, given = len(program.parts), len(program.boundaries)
    if n > MOST_PARTS:
        raise ValueError(f"the program has {n} parts; there can be at most {MOST_PARTS} whose transitions are matched")
    if given not in (0, n, n + 1):
        raise ValueError(
            f"the program has {given} transitions and {n} parts; a turn has one where each part begins, a shorter "
            "program one more at its end"
        )
