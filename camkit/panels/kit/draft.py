"""What a person has set of a motion program, whether it is possible or not."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

from ...motion import Boundary, MatchedProgram, MotionProgram, Segment, Uniform, matched
from ...motion.parts import Part
from ...quantities.kinds import kind_words
from ...units import in_unit
from .program_edits import DIGITS


@dataclass(frozen=True)
class Draft:
    """The parts of a motion program and what holds where they meet; ``program`` is the last one that was possible.

    A program of laws alone is always possible; it has no ``boundaries``.  ``rest`` is the place of the part that takes
    the rest of the turn.
    """

    program: MotionProgram
    parts: tuple[Segment | Part, ...]
    boundaries: tuple[Boundary, ...] = ()
    rest: int | None = None

    @classmethod
    def of(cls, program: MotionProgram) -> Draft:
        """What ``program`` is made of."""
        if not isinstance(program, MatchedProgram):
            return cls(program, program.segments)
        rest = program.part_names.index(program.rest) if program.rest else None
        return cls(program, program.parts, program.boundaries, rest)

    @property
    def matched(self) -> bool:
        """Whether conditions where the parts meet say how it moves, and not laws alone."""
        return bool(self.boundaries)

    @property
    def turns(self) -> bool:
        """Whether it goes around: the last part meets the first."""
        return len(self.boundaries) == len(self.parts) if self.matched else bool(self.program.periodic)

    def with_boundaries(self) -> Draft:
        """The same with conditions: moves by a law become polynomials with the same levels."""
        return self if self.matched else Draft.of(matched(self.program))

    def made(self) -> Draft:
        """As it is when it is possible; ``ValueError`` in a sentence where it is not."""
        if not self.matched:
            return self
        rest = "" if self.rest is None else self.names()[self.rest]
        try:
            return Draft.of(MatchedProgram(self.parts, self.boundaries, rest, advance=self.program.advance))
        except ValueError as refusal:
            raise ValueError(self._counted(str(refusal))) from None

    def _counted(self, sentence: str) -> str:
        """A sentence that calls the parts by their place, as the rows show them."""
        for k, name in enumerate(self.names(), 1):
            sentence = re.sub(rf"\b(where|inside|of) {name}\b", rf"\1 segment {k}", sentence)
        return sentence

    def names(self) -> list[str]:
        """What a program calls the parts."""
        kinds = [kind_words(type(part)).replace(" ", "_") for part in self.parts]
        counts = [kinds[: i + 1].count(kind) for i, kind in enumerate(kinds)]
        usual = (kind if count == 1 else f"{kind}{count}" for kind, count in zip(kinds, counts, strict=True))
        return [part.name or name for part, name in zip(self.parts, usual, strict=True)]

    def angles(self) -> list[float]:
        """The angles of the parts, deg; the one that takes the rest has what the others leave."""
        taken = [part.taken() if isinstance(part, Part) else part.angle for part in self.parts]
        angles = [0.0 if angle is None else round(in_unit(float(angle), "deg"), DIGITS) for angle in taken]
        if self.rest is not None:
            angles[self.rest] = round(360 - sum(angles) + angles[self.rest], DIGITS)
        return angles

    def own_angle(self, i: int) -> bool:
        """Whether a part has an angle that a person sets."""
        part = self.parts[i]
        return i != self.rest and not (isinstance(part, Uniform) and part.angle is None)

    def with_part(self, i: int, part: Segment | Part) -> Draft:
        """With another part at a place."""
        return replace(self, parts=(*self.parts[:i], part, *self.parts[i + 1 :]))

    def with_boundary(self, i: int, **wanted: Any) -> Draft:
        """With other conditions at a boundary, if there are any: numbers, ``match`` or ``free`` by their letter."""
        if not self.matched:
            return self
        i %= len(self.boundaries)
        return replace(
            self, boundaries=(*self.boundaries[:i], replace(self.boundaries[i], **wanted), *self.boundaries[i + 1 :])
        )
