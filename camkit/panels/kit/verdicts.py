"""What happens at each transition of a motion program, between the rows of its segments, and what its peaks are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...extrema import Extreme
from ...motion import MotionProgram, Transition
from ...units import deg, in_unit
from ...views.laws import MotionUnits
from .conditions import LETTERS, BoundaryRow, Wanted
from .draft import Draft
from .draft_edits import smoothed
from .parts import Button, Line, Piece, Words, row
from .segments import Hand

ROUNDING = 1e-9
"""What is less than this share of the highest level, per rad^k, is 0."""
PEAKS = ("peak velocity", "peak acceleration", "peak jerk")


class TransitionRow:
    """One transition: its verdict, what makes it smooth where it is not lawful, and the conditions that hold there."""

    def __init__(self, place: int, hand: Hand) -> None:
        self.place, self.hand = place, hand
        self.verdict = Words()
        self.smooth = Button("Make it smooth", self._smooth, tooltip="the moves beside it as smooth as they can be")
        self.boundary = BoundaryRow(hand.quiet, self._given)
        self.row = row(self.verdict, self.boundary.group, self.smooth, look="transition")

    def show(self, draft: Draft, transition: Transition | None, edge: float, units: MotionUnits) -> None:
        """Say what happens there: at an ``edge`` (rad) that is none where the draft is not possible."""
        self.row.visible = transition is not None or draft.matched
        told = transition is not None and not (draft.matched and transition.lawful)
        self.verdict.look = "" if told else "place"
        self.verdict.say(_said(transition, units) if transition and told else f"{in_unit(edge, 'deg'):.6g}°")
        self.smooth.visible = transition is not None and not transition.lawful
        self.boundary.group.visible = draft.matched
        if draft.matched:
            boundary = draft.boundaries[self.place % len(draft.boundaries)]
            self.boundary.show(boundary, _motion_at(draft.program, self.place), units)

    def _smooth(self) -> None:
        self.hand.edit(lambda draft: smoothed(draft, self.place))

    def _given(self, k: int, wanted: Wanted) -> None:
        self.hand.edit(lambda draft: draft.with_boundary(self.place, **{LETTERS[k]: wanted}))


def _motion_at(program: MotionProgram, edge: int) -> Sequence[float]:
    """``s, v, a, j`` where a segment ends, or where the first one begins; what is rounding is 0."""
    before = min(max(edge - 1, 0), len(program.segments) - 1)
    s, *others = program.segments[before].motion(np.array(1.0 if edge else 0.0))
    size = max(abs(float(level)) for level in program.levels)
    found = [float(value) for value in (s + program.levels[before], *others)]
    return [value if abs(value) > ROUNDING * size else 0.0 for value in found]


def _said(transition: Transition, units: MotionUnits) -> Piece:
    words = transition.text(units.of(transition.order or 0), units.speed)
    return words if transition.lawful else {"words": words, "look": "missed"}


def at_edges(program: MotionProgram) -> list[Transition | None]:
    """The transition at each edge, where there is one; that of the turn's end is at the last."""
    found = {round(boundary.angle / deg, 6): boundary for boundary in program.transitions()}
    edges = np.asarray(program.edges)[1:]
    return [None, *(found.get(round(float(edge) / deg, 6)) for edge in edges)]


def headline(program: MotionProgram) -> Line:
    """Whether the fundamental law of cam design holds, in one line."""
    broken = [transition for transition in program.transitions() if not transition.lawful]
    if not broken:
        return [{"words": "✓ ", "look": "kept"}, "Position, velocity and acceleration are continuous all around."]
    places = ", ".join(f"{in_unit(transition.angle, 'deg'):.6g}°" for transition in broken)
    return {"words": f"✗ The motion is not smooth at {places}.", "look": "missed"}


def peaks(program: MotionProgram, units: MotionUnits) -> list[str]:
    """The largest of each derivative, and where."""
    return [_size(peak, k, units) for k, peak in enumerate(program.peaks(), 1)]


def _size(peak: Extreme, k: int, units: MotionUnits) -> str:
    place = f"at {round(in_unit(float(peak.cam_angle), 'deg'), 6):.4g} deg"
    if not np.isfinite(peak.value):
        return f"infinite {place}"
    return f"{float(peak.value) / units.factor(k):.5g} {units.name(k)} {place}"
