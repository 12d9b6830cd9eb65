"""What no motion program can be, in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..quantities import text_if, unless
from ..quantities.kinds import refuse_lengths, shown
from ..units import deg
from .segments import Segment, degrees, kind_of

if TYPE_CHECKING:
    from .program import MotionProgram

ROUNDED = 1e-4 * deg
"""A span that misses the turn by no more than this (rad) is a turn whose angles were rounded."""
LIKELY_DEGREES = 10.0
"""A segment of so many radians, or more, was meant in degrees."""
NEARLY = 0.5 * deg
"""A span that misses the turn by less than this (rad), and by more than rounding, is a mistake."""


def _meant(program: MotionProgram) -> str:
    """What to write where a segment's angle, the first of them, was given in degrees."""
    said = ""
    for segment in reversed(program.segments):
        likely, given = (segment.angle >= LIKELY_DEGREES) & (segment.angle <= 360), f"{segment.angle:.6g}"
        words = f" (the {kind_of(segment)} was given {given} rad; for degrees write {given} * deg)"
        said = text_if(likely, words, said)
    return said


def refuse_program(program: MotionProgram) -> None:
    """``ValueError`` in a sentence for a program that cannot be."""
    if not program.segments:
        raise ValueError("the program is empty; it needs at least one rise, return or dwell")
    for i, segment in enumerate(program.segments, start=1):
        if not isinstance(segment, Segment):
            given = shown(segment)
            raise ValueError(f"segment {i} of the program is {given}; it must be a rise, a return or a dwell")
    refuse_lengths(program)
    for name in program.names:
        if program.names.count(name) > 1 or name in ("start", "segments", "advance", "form"):
            raise ValueError(f"a segment of the program is called {name}; it must have a name that nothing else has")
    if refuse := unless(program._beyond <= ROUNDED):
        little = f"{degrees(program._beyond)} more than a full turn"
        spans = text_if(program._beyond >= NEARLY, degrees(program.span), little)
        refuse(f"the program spans {spans}; it can span at most 360 deg{_meant(program)}")
    if refuse := unless(np.logical_not(program._misses)):
        refuse(
            f"the program spans {degrees(program.span, 10)}; {degrees(-program._beyond)} are missing to a full turn: "
            "lengthen a segment or add a dwell"
        )
    if refuse := unless(program.closes):
        refuse(_left_open(program))


def _left_open(program: MotionProgram) -> str:
    """Why a program does not close."""
    end, advance = program.levels[-1] - program.start, f"{program.advance:.6g}"
    must = text_if(
        program.comes_back,
        f"; a full turn must come back to its start, or say by how much it is further: advance={end:.12g}",
        f"; that must be its advance, {advance}, from which it is {end - program.advance:.3g} away",
    )
    short = f"the advance of the program is {advance}, but it spans {degrees(program.span)}; only a full turn can go on"
    return text_if(program.periodic, f"the program ends {end:.6g} from its start after 360 deg{must}", short)
