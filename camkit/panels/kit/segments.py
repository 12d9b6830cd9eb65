"""The rows of a motion program: each segment with its kind, angle, lift and law, and its numbers and points below."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...motion import Cycloidal, Dwell, Law, OpenMove, Part, Polynomial, Segment, Through, Uniform
from ...motion.segments import Move
from ...units import factor, in_unit
from ...views.laws import MotionUnits
from . import draft_edits as edits
from .conditions import PointRow
from .draft import Draft
from .inputs import Amount, Menu
from .law_boxes import LawBoxes
from .parts import Button, Group, Message, Words, icon, row
from .parts import Part as SheetPart
from .quiet import Quiet

MOST = 10_000.0
"""More cannot be typed, in the unit shown."""
HEADS = ("segment", "angle", "lift", "law")
"""Over the columns."""
DIGITS = 7
"""Of a velocity that is shown; it counts to its last digit as long as nobody types another."""
ZERO = 9
"""Digits after the point of a lift that follows; what is less is 0."""
FORMS = ("polynomial", "spline")

Edit = Callable[[Draft], Draft]
"""Another draft after one."""


class Length(Amount):
    """A box for an angle, a lift or a velocity of at most `MOST` units."""

    def take(self, message: Message) -> None:
        """Another number; ``ValueError`` for one that is too large."""
        value = float(message["value"])
        if not abs(value) <= MOST:
            told = f"{value:g} {self.unit} was typed; it must be at most {MOST:g} {self.unit}"
            raise ValueError(f"the {self.description} stays as before: {told}")
        self.value = value


@dataclass(frozen=True)
class Hand:
    """What the rows share: how a person's edit is told, in which unit lifts are, and who moves the controls."""

    edit: Callable[[Edit], None]
    unit: str
    quiet: Quiet


class Cell:
    """A box for what a person gives, or words for what follows."""

    def __init__(self, description: str, unit: str) -> None:
        self.box, self.words = Length(description=description, unit=unit), Words(look="solved")
        self.group = row(self.box, self.words, look="cell")

    def give(self, value: float, unit: str | None = None) -> None:
        """Show a number that can be typed."""
        self.box.visible, self.words.visible = True, False
        self.box.value, self.box.unit = value, unit or self.box.unit

    def tell(self, words: str = "", why: str = "") -> None:
        """Show what follows from something else, or nothing."""
        self.box.visible, self.words.visible, self.words.tooltip = False, bool(words), why
        self.words.say(words)


class SegmentRow:
    """One segment: kind, angle, lift, law, and what can be done with it.

    A row stays in its place; another draft shows another segment in it.
    """

    def __init__(self, place: int, hand: Hand) -> None:
        self.place, self.hand, self.points = place, hand, list[PointRow]()
        self.kind = Menu(edits.KINDS, tooltip="kind")
        self._angle, self._lift, self._velocity = Cell("angle", "deg"), Cell("lift", hand.unit), Cell("velocity", "")
        self.angle, self.lift, self.velocity = (cell.box for cell in (self._angle, self._lift, self._velocity))
        self.laws = LawBoxes(hand.quiet, lambda make: self._edit(lambda draft: edits.with_law(draft, place, make())))
        self.law = self.laws.menu
        self._last: tuple[float, Law] = 0.0, Cycloidal()
        self.row = row(self.kind, self._angle.group, self._lift.group, self._third(), self._tools(), look="segment")
        self.row.description = f"segment {place + 1}"
        self.below = Group(look="points")
        self._hear()

    def _third(self) -> Group:
        """What stands in the column of the law: a law, a velocity and what follows, points."""
        place = self.place
        follows = [(f"{name} follows", name) for name in edits.FOLLOWS]
        self.follows = Menu(follows, tooltip="what follows from the others")
        self.form = Menu(FORMS, tooltip="one polynomial, or a spline")
        self.add_point = Button("Add a point", lambda: self._edit(lambda draft: edits.with_point(draft, place)))
        self.note = Words(look="solved")
        return row(self.law, self._velocity.group, self.follows, self.form, self.add_point, self.note, look="cell")

    def _tools(self) -> Group:
        edit, place = self._edit, self.place
        self.remove = icon("−", lambda: edit(lambda draft: edits.removed(draft, place)), "remove this segment")
        after = "insert a segment after this one"
        more = icon("+", lambda: edit(lambda draft: edits.inserted(draft, place + 1)), after)
        twice = icon("×2", lambda: edit(lambda draft: edits.duplicated(draft, place)), "duplicate this segment")
        return row(more, twice, self.remove, look="tools")

    def _hear(self) -> None:
        place, hear, edit = self.place, self.hand.quiet.hear, self._edit
        hear(self.kind, self._kind)
        hear(self.angle, lambda angle: edit(lambda draft: edits.with_angle(draft, place, angle)))
        hear(self.lift, self._lifted)
        hear(self.velocity, lambda v: edit(lambda draft: edits.with_velocity(draft, place, v * self._per)))
        hear(self.follows, lambda name: edit(lambda draft: edits.following(draft, place, name)))
        hear(self.form, lambda form: edit(lambda draft: edits.with_form(draft, place, form)))

    def _edit(self, edit: Edit) -> None:
        self.hand.edit(edit)

    @property
    def parts(self) -> tuple[SheetPart, ...]:
        """What stands below each other."""
        return self.row, self.laws.group, self.below

    def show(self, draft: Draft, solved: Segment | None, units: MotionUnits) -> None:
        """Show the part of a draft that stands in this place; ``solved`` is how it moves, if it is possible."""
        part = draft.parts[self.place]
        self.kind.value = edits.kind_of(part)
        self.remove.visible = len(draft.parts) > 1
        self._show_angle(draft)
        self._show_lift(part, solved)
        self._show_third(draft, part, solved, units)
        self._show_points(part, solved, units)

    def _show_angle(self, draft: Draft) -> None:
        angle = draft.angles()[self.place]
        if draft.own_angle(self.place):
            self._angle.give(angle)
        else:
            why = "it takes the rest of the turn" if self.place == draft.rest else "it follows from travel and velocity"
            self._angle.tell(f"{angle:.6g} deg", why)

    def _show_lift(self, part: Segment | Part, solved: Segment | None) -> None:
        unit = self.hand.unit
        given = part.lift if isinstance(part, Move) else part.travel if isinstance(part, Uniform) else None
        self.lift.description = "travel" if isinstance(part, Uniform) else "lift"
        if given is not None:
            self._lift.give(in_unit(float(given), unit))
        else:
            self.lift.value = 0.0
            follows = solved is not None and not isinstance(part, Dwell)
            told = (
                f"{round(float(solved.change) / factor(unit), ZERO) + 0.0:.5g} {unit}"
                if solved is not None and follows
                else ""
            )
            self._lift.tell(told, "it follows from the conditions")

    def _show_third(self, draft: Draft, part: Segment | Part, solved: Segment | None, units: MotionUnits) -> None:
        law: Any = part.law if isinstance(part, (Move, OpenMove)) else None
        points = part if isinstance(part, Polynomial) else None
        self.law.visible, self.add_point.visible = law is not None, points is not None
        self.form.visible = points is not None and bool(points.through)
        if law is not None:
            self.laws.show(law)
            self._last = float(getattr(part, "lift", 0.0)) or self._last[0], law
        if points is not None:
            self.form.value = points.form
        self.laws.group.visible = law is not None and bool(self.laws.boxes)
        self._show_velocity(part if isinstance(part, Uniform) else None, solved, units)
        self.note.visible = draft.matched and self.place == draft.rest
        self.note.say("closes the turn" if self.note.visible else "")

    def _show_velocity(self, part: Uniform | None, solved: Segment | None, units: MotionUnits) -> None:
        self._per = units.factor(1)
        self.follows.visible = self._velocity.group.visible = part is not None
        if part is None:
            return
        if part.velocity is not None:
            self._velocity.give(float(f"{float(part.velocity) / self._per:.{DIGITS}g}"), units.name(1))
        elif solved is not None:
            told = float(solved.change / solved.angle) / self._per
            self._velocity.tell(f"{told:.5g} {units.name(1)}", "it follows from travel and angle")
        given = {name: getattr(part, name) for name in edits.FOLLOWS}
        self.follows.value = next((name for name, value in given.items() if value is None), None)

    def _show_points(self, part: Segment | Part, solved: Segment | None, units: MotionUnits) -> None:
        points = part.through if isinstance(part, Polynomial) else ()
        while len(self.points) < len(points):
            self.points.append(PointRow(self.hand.quiet, self._taker(len(self.points))))
        del self.points[len(points) :]
        for row_, point in zip(self.points, points, strict=True):
            whole = float((part.angle or 1.0) if solved is None else solved.angle)
            row_.show(point, whole, _there(solved, point, whole), units)
        self.below.children, self.below.visible = tuple(row_.group for row_ in self.points), bool(points)

    def _taker(self, k: int) -> Callable[[Callable[[], Through | None]], None]:
        """What hears of another point in place of the ``k``-th, or of none."""
        place = self.place

        def edit(draft: Draft, make: Callable[[], Through | None]) -> Draft:
            points = list(draft.parts[place].through)  # type: ignore[union-attr]
            points[k : k + 1] = [point for point in (make(),) if point is not None]
            return edits.with_points(draft, place, tuple(points))

        return lambda make: self._edit(lambda draft: edit(draft, make))

    def _kind(self, kind: str) -> None:
        lift, law = self._last
        self._edit(lambda draft: edits.with_kind(draft, self.place, kind, lift or usual_lift(draft), law))

    def _lifted(self, lift: float) -> None:
        change = (-1 if self.kind.value == "return" else 1) * lift * factor(self.hand.unit)
        self._edit(lambda draft: edits.with_change(draft, self.place, change))


def _there(solved: Segment | None, point: Through, whole: float) -> list[float]:
    """``s, v, a, j`` at a point of a segment, s from its first level; 0 where it is not known."""
    if solved is None:
        return [0.0] * 4
    return [float(value) for value in solved.motion(np.array(float(point.place(whole))))]


def usual_lift(draft: Draft) -> float:
    """For a move that had none: half of the largest lift in the program."""
    return max(abs(float(segment.change)) for segment in draft.program.segments) / 2


def heads(edit: Callable[[Edit], None]) -> Group:
    """The heads of the columns, and a button for a segment at the start."""
    first = icon("+", lambda: edit(lambda draft: edits.inserted(draft, 0)), "insert a segment at the start")
    return row(*(Words(value=[head], look="hint") for head in HEADS), row(first, look="tools"), look="segment")
