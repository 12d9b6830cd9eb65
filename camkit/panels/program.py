"""`edit_program`: a motion program segment by segment, by table or by dragging its joints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..motion import LAWS, Dwell, MotionProgram, Return, Rise, Segment
from ..motion.segments import kind_of
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..units import deg, factor, in_unit
from ..views.laws import PROGRAM_VIEWS, ShownProgram
from .kit.drawn import LivePicture, nearest
from .kit.inputs import Amount, Menu
from .kit.parts import Banner, Button, Group, Message, Table, Words, row
from .kit.quiet import Quiet
from .kit.sheet import IMPOSSIBLE, Panel

KINDS = ("rise", "dwell", "return")
LEAST = 1 * deg
"""The least angle to which a segment can be dragged."""
MOST = 10_000.0
"""More cannot be typed, in the unit shown."""
GRID = 0.5
"""Dragged angles (deg) and lifts snap to multiples of this, in the unit shown."""
HEIGHT = 250
"""Pixels of each curve in the page."""
REACH = 30
"""Pixels from which a handle is taken hold of."""


class Length(Amount):
    """A box for an angle or a lift of at most `MOST` units."""

    def take(self, message: Message) -> None:
        """Another number; ``ValueError`` for one that is too large."""
        value = float(message["value"])
        if not abs(value) <= MOST:
            told = f"{value:g} {self.unit} was typed; it must be at most {MOST:g} {self.unit}"
            raise ValueError(f"the {self.description} stays as before: {told}")
        self.value = value


class SegmentRow:
    """One segment: kind, angle, lift, law."""

    def __init__(
        self, segment: Segment, unit: str, changed: Callable[[], None], remove: Callable[[SegmentRow], None]
    ) -> None:
        self.unit = unit
        self.kind, self.law = Menu(KINDS, tooltip="kind"), Menu((), tooltip="law")
        self.angle, self.lift = Length(description="angle", unit="deg"), Length(description="lift", unit=unit)
        self.show(segment)
        drop = Button("Remove", lambda: remove(self), tooltip="remove this segment")
        self.row = row(self.kind, self.angle, self.lift, self.law, drop, look="segment")
        self._show_moving()
        self.kind.observe(lambda _: self._show_moving(), "value")
        for box in (self.kind, self.angle, self.lift, self.law):
            box.observe(lambda _: changed(), "value")

    def show(self, segment: Segment) -> None:
        """Be the row of another segment."""
        law, self.name = getattr(segment, "law", LAWS[2]), segment.name
        self.kind.value = type(segment).__name__.lower()
        self.angle.value = in_unit(float(segment.angle), "deg")
        self.lift.value = in_unit(float(getattr(segment, "lift", 0.0)), self.unit)
        self.law.offer([(option.name, option) for option in (*LAWS, *(() if law in LAWS else (law,)))], law)

    def _show_moving(self) -> None:
        """A dwell has neither lift nor law."""
        self.lift.visible = self.law.visible = self.kind.value != "dwell"

    def segment(self) -> Segment:
        """The segment as the row says it."""
        angle, lift = self.angle.value * deg, self.lift.value * factor(self.unit)
        if self.kind.value == "dwell":
            return Dwell(angle, name=self.name)
        return (Rise if self.kind.value == "rise" else Return)(angle, lift, self.law.value, name=self.name)


class ProgramEditor(Panel):
    """A motion program under the hand: rows for its segments, handles at its joints.

    ``program`` is the program that is shown, the last one that was possible; ``on_change(f)`` calls ``f(program)``
    after every change.  Dragging a handle sideways moves a joint between its neighbours, up and down changes
    the level there; what lies beyond stays.
    """

    def __init__(self, program: MotionProgram, unit: str = "mm") -> None:
        refuse_arguments(ProgramEditor.__init__, locals())
        factor(unit)
        self.start = self.program = program
        self.unit = unit
        self._quiet = Quiet()
        self._held: int | None = None
        self.rows: list[SegmentRow] = []
        self.numbers, self.verdicts, self.banner = Table(), Words(), Banner()
        self._list = Group()
        self.picture = LivePicture(PROGRAM_VIEWS, "Displacement, velocity, acceleration and jerk", height=5.6)
        self.picture.pixels = HEIGHT
        self.picture.on_pointer(self._pointer)
        add, reset = Button("Add a segment", self._add), Button("Reset", lambda: self.load(self.start))
        left = Group(self._list, row(add, reset), self.banner, self.numbers, self.verdicts)
        super().__init__(Group(left, self.picture, look="beside"))
        self.load(program)

    def load(self, program: MotionProgram) -> None:
        """Show another program; its rows stay where they are, so that a button under the pointer does what it says."""
        if other := [segment for segment in program.segments if kind_of(segment) not in KINDS]:
            raise ValueError(f"the program has a {kind_of(other[0])}; rises, returns and dwells can be edited here")
        kept = self.rows[: len(program.segments)]
        with self._quiet, self.held():
            for row_, segment in zip(kept, program.segments, strict=False):
                row_.show(segment)
            self._list_rows([*kept, *map(self._row, program.segments[len(kept) :])])
        self._try(lambda: program)

    def _row(self, segment: Segment) -> SegmentRow:
        return SegmentRow(segment, self.unit, self._quiet.unless(self._changed), self._remove)

    def _list_rows(self, rows: list[SegmentRow]) -> None:
        for k, each in enumerate(rows, 1):
            each.row.description = f"segment {k}"
        self.rows, self._list.children = rows, tuple(each.row for each in rows)

    def _changed(self) -> None:
        start, advance = self.program.start, self.program.advance
        self._try(lambda: MotionProgram(tuple(row.segment() for row in self.rows), start, advance=advance))

    def _try(self, make: Callable[[], MotionProgram]) -> None:
        last = self.program
        with self.held():
            try:
                self.program = make()
                peaks, verdicts = self._peaks(), self._verdicts()
                self.picture.show(ShownProgram(self.program, self.unit))
            except IMPOSSIBLE as refusal:
                self.program = last
                self.refuse_picture(f"This is no motion program: {refusal}.")
                return
            self.refuse_picture("")
            self.numbers.put(("peak", "value", "at"), peaks)
            self.verdicts.say(
                *(verdict if lawful else {"words": verdict, "look": "missed"} for verdict, lawful in verdicts)
            )
        self._tell_followers(self.program)

    def refuse_picture(self, sentence: str) -> None:
        """Show a sentence in place of the picture, its numbers and its verdicts; an empty one brings them back."""
        with self.held():
            super().refuse_picture(sentence)
            self.verdicts.visible = not sentence

    def _add(self) -> None:
        rest = max(2 * np.pi - float(self.program.span), 0.0)
        segment = Dwell(rest if rest > LEAST else 30 * deg)
        self._list_rows([*self.rows, self._row(segment)])
        self._changed()

    def _remove(self, row: SegmentRow) -> None:
        self._list_rows([r for r in self.rows if r is not row])
        self._changed()

    def _pointer(self, view: int, kind: str, at: Array, pixel: Array) -> None:
        """Take hold of the nearest handle of the displacement, and move it."""
        if kind == "press":
            levels = np.asarray(self.program.levels, dtype=float) / factor(self.unit)
            handles = np.column_stack([np.asarray(self.program.edges) / deg, levels])
            self._held = nearest(handles, at, pixel, within=REACH) if view == 0 else None
        elif kind == "drag" and self._held is not None:
            self._move(self._held, float(at[0]), float(at[1]))
        elif kind == "release":
            self._held = None

    def _move(self, joint: int, angle: float, level: float) -> None:
        """Bring a joint to a cam angle (deg) and a level (in the unit shown), as far as its neighbours let it."""
        edges, levels = np.asarray(self.program.edges) / deg, np.asarray(self.program.levels) / factor(self.unit)
        last = len(edges) - 1
        if 0 < joint < last:
            low, high = edges[joint - 1] + LEAST / deg, edges[joint + 1] - LEAST / deg
            edges[joint] = np.clip(round(angle / GRID) * GRID, low, high)
            before, after = self.rows[joint - 1].kind.value, self.rows[joint].kind.value
            level = round(level / GRID) * GRID
            run = self._level_run(joint)
            levels[run] = level if {before, after} != {"dwell"} else levels[run]
        with self._quiet:
            for i, row in enumerate(self.rows):
                row.angle.value = round(float(edges[i + 1] - edges[i]), 6)
                if row.kind.value != "dwell":
                    change = round(float(levels[i + 1] - levels[i]), 6)
                    row.kind.value = "rise" if change >= 0 else "return"
                    row.lift.value = abs(change)
        self._changed()

    def _level_run(self, joint: int) -> list[int]:
        """The joints at the same level as ``joint`` because only dwells lie between."""
        run = [joint]
        while run[0] > 0 and self.rows[run[0] - 1].kind.value == "dwell":
            run.insert(0, run[0] - 1)
        while run[-1] < len(self.rows) and self.rows[run[-1]].kind.value == "dwell":
            run.append(run[-1] + 1)
        return [] if {0, len(self.rows)} & set(run) else run

    def _verdicts(self) -> list[tuple[str, bool]]:
        """What happens at each transition, in the unit of the table, and whether it may."""
        return [(joint.text(self.unit), joint.lawful) for joint in self.program.transitions()]

    def _peaks(self) -> list[tuple[str, str, str]]:
        """The largest of each derivative, and where."""
        names = (("velocity", "/rad"), ("acceleration", "/rad^2"), ("jerk", "/rad^3"))
        return [
            (
                name,
                f"{in_unit(float(p.value), self.unit):.5g} {self.unit}{per}",
                f"{in_unit(float(p.cam_angle), 'deg'):.4g} deg",
            )
            for (name, per), p in zip(names, self.program.peaks(), strict=True)
        ]

    def summary(self) -> str:
        """Each joint's verdict."""
        return "\n".join(verdict for verdict, _ in self._verdicts())


def edit_program(program: MotionProgram, unit: str = "mm") -> ProgramEditor:
    """Rows and handles for a motion program whose lifts are shown in ``unit`` ("mm" or "deg").

    The result's ``.program`` goes into a cam: ``editor.on_change(lambda p: app.load(app.design.replace(motion=p)))``.
    """
    return ProgramEditor(program, unit)
