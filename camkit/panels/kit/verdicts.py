"""What happens at each transition of a motion program, between the rows of its segments, and what its peaks are."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...motion import MotionProgram, Transition
from ...quantities.types import Value
from ...units import in_unit
from ...views.laws import MotionUnits
from .parts import Button, Line, Piece, Words, row
from .program_edits import smoothed
from .segments import Hand

PEAKS = ("velocity", "acceleration", "jerk")


class TransitionRow:
    """One transition: its verdict, and beside one that is not lawful what makes it smooth."""

    def __init__(self, place: int, hand: Hand) -> None:
        self.verdict = Words()
        smooth = partial(hand.edit, lambda program: smoothed(program, place))
        self.smooth = Button("Make it smooth", smooth, tooltip="from rest to rest by 3-4-5 polynomials here")
        self.row = row(self.verdict, self.smooth, look="transition")

    def show(self, transition: Transition, units: MotionUnits) -> None:
        """Say what happens there."""
        self.verdict.say(_said(transition, units))
        self.smooth.visible = not transition.lawful


def _said(transition: Transition, units: MotionUnits) -> Piece:
    words = transition.text(units.of(transition.order or 0), units.speed)
    return words if transition.lawful else {"words": words, "look": "missed"}


def headline(program: MotionProgram) -> Line:
    """Whether the fundamental law of cam design holds, in one line."""
    broken = [transition for transition in program.transitions() if not transition.lawful]
    if not broken:
        return [{"words": "✓ ", "look": "kept"}, "Position, velocity and acceleration are continuous all around."]
    places = ", ".join(f"{in_unit(transition.angle, 'deg'):.6g}°" for transition in broken)
    return {"words": f"✗ The motion is not smooth at {places}.", "look": "missed"}


def peaks(program: MotionProgram, units: MotionUnits) -> list[tuple[str, str, str]]:
    """The largest of each derivative, and where."""
    return [
        (name, _size(peak.value, k, units), f"{in_unit(float(peak.cam_angle), 'deg'):.4g} deg")
        for k, (name, peak) in enumerate(zip(PEAKS, program.peaks(), strict=True), 1)
    ]


def _size(value: Value, k: int, units: MotionUnits) -> str:
    return f"{float(value) / units.factor(k):.5g} {units.name(k)}" if np.isfinite(value) else "infinite"
