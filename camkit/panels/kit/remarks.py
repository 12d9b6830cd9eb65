"""What a motion through given points does beyond them, and the other form beside it."""

from __future__ import annotations

from functools import partial

from ...motion import MatchedProgram, Overshoot
from .draft import Draft
from .draft_edits import with_form
from .parts import Button, Group, Words, row
from .segments import FORMS, Hand

BETTER = 0.95
"""The other form is offered where it overshoots by less than this share."""


class Remarks:
    """A sentence for each part that overshoots, with a button for its other form."""

    def __init__(self, hand: Hand) -> None:
        self.hand, self.group = hand, Group()

    def show(self, draft: Draft, unit: str) -> None:
        """Say what overshoots in a draft that is possible."""
        program = draft.program
        found = program.overshoots() if isinstance(program, MatchedProgram) else []
        names = draft.names()
        self.group.children = tuple(self._row(names.index(one.part), one, unit) for one in found)

    def _row(self, place: int, one: Overshoot, unit: str) -> Group:
        other = next(form for form in FORMS if form != one.form)
        edit = partial(self.hand.edit, lambda draft: with_form(draft, place, other))
        offer = Button(f"Use the {other}", edit, visible=abs(one.other_by) < BETTER * abs(one.by))
        return row(
            Words(value=[f"Segment {place + 1}{one.text(unit).removeprefix(one.part)}."]), offer, look="transition"
        )
