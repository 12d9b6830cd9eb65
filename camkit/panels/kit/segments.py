"""The rows of a motion program: each segment with its kind, angle, lift and law, and the law's own numbers below it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ...motion import LAW_MENU, Cycloidal, Dwell, Law, MotionProgram, Segment
from ...motion.segments import kind_of
from ...quantities import choices_of, quantities_of, unremarked, value_of, with_quantities, words
from ...units import factor, in_unit
from .inputs import Amount, Menu
from .parts import Button, Group, Message, Part, Words, row
from .program_edits import (
    KINDS,
    angles_of,
    duplicated,
    inserted,
    removed,
    with_angle,
    with_change,
    with_kind,
    with_law,
)
from .quiet import Quiet

MOST = 10_000.0
"""More cannot be typed, in the unit shown."""
HEADS = ("segment", "angle", "lift", "law")
"""Over the columns."""

Edit = Callable[[MotionProgram], MotionProgram]
"""Another program after one."""


class Length(Amount):
    """A box for an angle or a lift of at most `MOST` units."""

    def take(self, message: Message) -> None:
        """Another number; ``ValueError`` for one that is too large."""
        value = float(message["value"])
        if not abs(value) <= MOST:
            told = f"{value:g} {self.unit} was typed; it must be at most {MOST:g} {self.unit}"
            raise ValueError(f"the {self.description} stays as before: {told}")
        self.value = value


@dataclass(frozen=True)
class Hand:
    """What the rows share: how a person's edit of the program is told, in which unit lifts are, who moves controls."""

    edit: Callable[[Edit], None]
    unit: str
    quiet: Quiet


def icon(sign: str, act: Callable[[], object], meaning: str) -> Button:
    """A button of one sign."""
    return Button(sign, act, tooltip=meaning, look="icon")


def named_as(law: object) -> str:
    """What a law is called in a menu, also one that is somebody's own function."""
    return str(getattr(law, "name", "own law"))


def _with_own(menu: Sequence[Law], law: Law) -> list[Law]:
    """The options of a menu, with ``law`` in place of the one that it is another of; else behind them."""
    alike = [k for k, option in enumerate(menu) if option == law]
    alike += [k for k, option in enumerate(menu) if type(option) is type(law) and named_as(option) == named_as(law)]
    place = alike[0] if alike else len(menu)
    return [*menu[:place], law, *menu[place + 1 :]]


class LawBoxes:
    """A menu of laws, and boxes for the numbers and choices of the chosen one; ``take(make)`` gets another law."""

    def __init__(self, quiet: Quiet, take: Callable[[Callable[[], Law]], None]) -> None:
        self._quiet, self._take = quiet, take
        self.menu = Menu((), tooltip="law")
        self.group = row(look="law", description="numbers of the law", visible=False)
        self.boxes: dict[str, Amount | Menu] = {}
        quiet.hear(self.menu, lambda law: take(lambda: law))

    @property
    def law(self) -> Law:
        """What the menu and the boxes say."""
        law: Law = self.menu.value
        return law

    def show(self, law: Law) -> None:
        """Stand at ``law``."""
        options = _with_own(LAW_MENU, law)
        self.menu.offer([(named_as(option), option) for option in options], law)
        wanted = [*choices_of(law), *quantities_of(law)] if isinstance(law, Law) else []
        if list(self.boxes) != wanted:
            self.boxes = {path: self._box(law, path) for path in wanted}
            self.group.children = tuple(self.boxes.values())
        for path, box in self.boxes.items():
            self._put(law, path, box)
        self.group.visible = bool(self.boxes)

    def _box(self, law: Law, path: str) -> Amount | Menu:
        box: Amount | Menu
        if path in choices_of(law):
            box = Menu((), words(path), tooltip=choices_of(law)[path].meaning)
        else:
            declared = quantities_of(law)[path]
            box = Amount(description=words(path), unit=declared.unit, tooltip=declared.meaning, named=True)
        self._quiet.hear(box, lambda value: self._typed(path, value))
        return box

    def _put(self, law: Law, path: str, box: Amount | Menu) -> None:
        if isinstance(box, Menu):
            value = value_of(law, path)
            named = choices_of(law)[path].named
            box.offer([*named.items(), *([] if value in named.values() else [(named_as(value), value)])], value)
        else:
            box.value = in_unit(float(value_of(law, path)), box.unit)

    def _typed(self, path: str, value: object) -> None:
        box, law = self.boxes[path], self.law
        si = value if isinstance(box, Menu) else box.value * factor(box.unit)
        self._take(lambda: _with(law, path, si))


def _with(law: Law, path: str, value: object) -> Law:
    """A law with another number or choice in it."""
    with unremarked():  # a panel's numbers have their units
        return with_quantities(law, {path: value})


class SegmentRow:
    """One segment: kind, angle, lift, law, and what can be done with it.

    A row stays in its place; another program shows another segment in it.
    """

    def __init__(self, place: int, hand: Hand) -> None:
        self.place, self.hand = place, hand
        self.kind = Menu(KINDS, tooltip="kind")
        self.angle, self.lift = Length(description="angle", unit="deg"), Length(description="lift", unit=hand.unit)
        self.laws = LawBoxes(hand.quiet, lambda make: hand.edit(lambda program: with_law(program, place, make())))
        self.law = self.laws.menu
        self._last: tuple[float, Law] = 0.0, Cycloidal()
        self.row = row(self.kind, self.angle, self.lift, self.law, self._tools(), look="segment")
        self.row.description = f"segment {place + 1}"
        hand.quiet.hear(self.kind, self._kind)
        hand.quiet.hear(self.angle, lambda angle: hand.edit(lambda program: with_angle(program, place, angle)))
        hand.quiet.hear(self.lift, self._lift)

    @property
    def parts(self) -> tuple[Part, ...]:
        """What stands below each other."""
        return self.row, self.laws.group

    def _tools(self) -> Group:
        edit, place = self.hand.edit, self.place
        self.remove = icon("−", lambda: edit(lambda program: removed(program, place)), "remove this segment")
        return row(
            icon("+", lambda: edit(lambda program: inserted(program, place + 1)), "insert a segment after this one"),
            icon("×2", lambda: edit(lambda program: duplicated(program, place)), "duplicate this segment"),
            self.remove,
            look="tools",
        )

    def show(self, program: MotionProgram) -> None:
        """Show the segment of a program that stands in this place."""
        segment = program.segments[self.place]
        self.angle.value = angles_of(program)[self.place]
        self.kind.value = kind_of(segment)
        self.lift.visible = self.law.visible = moves = not isinstance(segment, Dwell)
        self.remove.visible = len(program.segments) > 1
        self.lift.value = 0.0
        if moves:
            self._show_move(segment)
        self.laws.group.visible = moves and bool(self.laws.boxes)

    def _show_move(self, segment: Segment) -> None:
        lift, law = float(segment.lift), segment.law  # type: ignore[attr-defined]
        self.lift.value = in_unit(lift, self.hand.unit)
        self.laws.show(law)
        self._last = lift or self._last[0], law

    def _kind(self, kind: str) -> None:
        lift, law = self._last
        place = self.place
        self.hand.edit(lambda program: with_kind(program, place, kind, lift or usual_lift(program), law))

    def _lift(self, lift: float) -> None:
        sign = -1 if self.kind.value == "return" else 1
        self.hand.edit(lambda program: with_change(program, self.place, sign * lift * factor(self.hand.unit)))


def usual_lift(program: MotionProgram) -> float:
    """For a move that had none: half of the largest lift in the program."""
    return max(abs(float(segment.change)) for segment in program.segments) / 2


def heads(edit: Callable[[Edit], None]) -> Group:
    """The heads of the columns, and a button for a segment at the start."""
    first = icon("+", lambda: edit(lambda program: inserted(program, 0)), "insert a segment at the start")
    return row(*(Words(value=[head], look="hint") for head in HEADS), row(first, look="tools"), look="segment")
