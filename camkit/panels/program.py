"""`edit_program`: a motion program segment by segment, by table or by dragging its joints."""

from __future__ import annotations

import numpy as np

from ..motion import MotionProgram
from ..motion.segments import kind_of
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..units import deg, factor, rpm
from ..views.laws import PROGRAM_VIEWS, MotionUnits, ShownProgram
from .kit.drawn import LivePicture, nearest
from .kit.inputs import Amount, Menu
from .kit.parts import Banner, Button, Group, Message, Table, Words, row
from .kit.program_edits import KINDS, angles_of, with_edge
from .kit.quiet import Quiet
from .kit.segments import Edit, Hand, SegmentRow, heads
from .kit.sheet import IMPOSSIBLE, Panel, reason
from .kit.steps import Steps
from .kit.verdicts import TransitionRow, headline, peaks

GRID = 0.5
"""Dragged angles (deg) and lifts snap to multiples of this, in the unit shown."""
HEIGHT = 222
"""Pixels of each curve in the page."""
REACH = 30
"""Pixels from which a handle is taken hold of."""
FASTEST = 1e6
"""No shaft turns at more (rpm)."""
PER_RAD, IN_TIME, OVER_TIME = "per radian", "in time", "in time, over time"


class Speed(Amount):
    """A box for the speed of the shaft."""

    def take(self, message: Message) -> None:
        """Another number; ``ValueError`` for one that is not above 0."""
        value = float(message["value"])
        if not 0 < value <= FASTEST:
            must = f"it must be above 0 and at most {FASTEST:g} rpm"
            raise ValueError(f"the speed stays as before: {value:g} rpm was typed; {must}")
        self.value = value


class ProgramEditor(Panel):
    """A motion program under the hand: rows for its segments, handles at its joints.

    ``program`` is the program that is shown, the last one that was possible; ``on_change(f)`` calls ``f(program)``
    after every change.  What a segment takes its neighbours give, so that a turn stays a turn.  Dragging a handle
    sideways moves a joint between its neighbours, up and down changes the level there; what lies beyond stays.
    """

    def __init__(self, program: MotionProgram, unit: str = "mm") -> None:
        refuse_arguments(ProgramEditor.__init__, locals())
        factor(unit)
        self.start = self.program = program
        self.unit = unit
        self._quiet, self._steps = Quiet(), Steps[MotionProgram]()
        self._hand = Hand(self._edit, unit, self._quiet)
        self._held: tuple[int, MotionProgram] | None = None
        self.rows: list[SegmentRow] = []
        self.transitions: list[TransitionRow] = []
        self._make_parts()
        left = Group(self._head, self.banner, self.verdict, self._list, self.followed, self.numbers)
        super().__init__(Group(left, self.picture, look="beside halves"))
        self.load(program)

    def _make_parts(self) -> None:
        self.numbers, self.verdict, self.banner = Table(), Words(role="status"), Banner()
        self.followed = Words(look="hint", role="status")
        self.undo, self.redo = Button("Undo", self._undo), Button("Redo", self._redo)
        self.values = Menu((PER_RAD, IN_TIME, OVER_TIME), "values")
        self.speed = Speed(description="speed", unit="rpm", value=60.0, tooltip="speed of the shaft")
        for box in (self.values, self.speed):
            self._quiet.hear(box, lambda _: self._take(lambda program: program))
        reset = Button("Reset", lambda: self._edit(lambda _: self.start))
        self._head = row(self.undo, self.redo, reset, self.values, self.speed, look="head")
        self._list, self._heads = Group(look="segments"), heads(self._edit)
        self.picture = LivePicture(PROGRAM_VIEWS, "Displacement, velocity, acceleration and jerk", height=5.6)
        self.picture.pixels = HEIGHT
        self.picture.on_pointer(self._pointer)

    @property
    def units(self) -> MotionUnits:
        """What numbers are shown in: per rad of the cam, or in time at a speed."""
        return MotionUnits(self.unit, None if self.values.value == PER_RAD else self.speed.value * rpm)

    def load(self, program: MotionProgram) -> None:
        """Show another program; its rows stay where they are, so that a button under the pointer does what it says."""
        if other := [segment for segment in program.segments if kind_of(segment) not in KINDS]:
            raise ValueError(f"the program has a {kind_of(other[0])}; rises, returns and dwells can be edited here")
        if self._take(lambda _: program):
            self._tell_followers(program)

    def _edit(self, edit: Edit) -> None:
        """Another program after a person's hand, a step that can be undone."""
        before = self.program
        if self._take(edit) and self.program != before:
            with self.held():
                if self._held is None:
                    self._steps.leave(before)
                self._say_what_followed(before)
                self._show_steps()
            self._tell_followers(self.program)

    def _take(self, edit: Edit) -> bool:
        """Show another program; what cannot be is said, and the last one stays."""
        before = self.program
        with self._quiet, self.held():
            try:
                self.program = edit(before)
                self._show()
            except IMPOSSIBLE as refusal:
                self.program = before
                self._show_rows(self.units)
                self.banner.show_message(f"{reason(refusal)[:1].upper()}{reason(refusal)[1:]}.")
                return False
        return True

    def _undo(self) -> None:
        self._go(self._steps.undo(self.program))

    def _redo(self) -> None:
        self._go(self._steps.redo(self.program))

    def _go(self, program: MotionProgram | None) -> None:
        if program is not None:
            with self.held():
                self.load(program)
                self.followed.say()

    def _show(self) -> None:
        """Rows, verdicts, peaks and curves of the program."""
        with self._quiet, self.held():
            units = self.units
            self.picture.show(self._shown())
            self._show_rows(units)
            self.speed.visible = self.values.value != PER_RAD
            self.verdict.say(headline(self.program))
            self.numbers.put(("peak", "value", "at"), peaks(self.program, units))
            self.banner.show_message("")
            self._show_steps()

    def _shown(self) -> ShownProgram:
        over_time = self.values.value == OVER_TIME
        return ShownProgram(self.program, self.unit, speed=self.units.speed, over_time=over_time)

    def _show_rows(self, units: MotionUnits) -> None:
        count = len(self.program.segments)
        while len(self.rows) < count:
            self.rows.append(SegmentRow(len(self.rows), self._hand))
            self.transitions.append(TransitionRow(len(self.transitions), self._hand))
        del self.rows[count:], self.transitions[count:]
        joints = {round(joint.angle / deg, 6): joint for joint in self.program.transitions()}
        edges = np.asarray(self.program.edges) / deg
        for row_, transition, edge in zip(self.rows, self.transitions, edges[1:], strict=True):
            row_.show(self.program)
            joint = joints.get(round(float(edge), 6))
            transition.row.visible = joint is not None
            if joint is not None:
                transition.show(joint, units)
        both = zip(self.rows, self.transitions, strict=True)
        self._list.children = (self._heads, *(part for row_, after in both for part in (*row_.parts, after.row)))

    def _show_steps(self) -> None:
        self.undo.disabled, self.redo.disabled = not self._steps.before, not self._steps.after

    def _say_what_followed(self, before: MotionProgram) -> None:
        """Which segments gave or took angle, where those are not the ones that a person set."""
        old, new = angles_of(before), angles_of(self.program)
        changed = [(k, old[k], new[k]) for k in range(len(new)) if len(old) == len(new) and old[k] != new[k]]
        told = ", ".join(f"{k + 1}: {a:g} to {b:g} deg" for k, a, b in changed)
        self.followed.say(f"Segments {told}." if len(changed) > 2 else "")

    def _pointer(self, view: int, kind: str, at: Array, pixel: Array) -> None:
        """Take hold of the nearest handle of the displacement, and move it."""
        if kind == "press":
            handles = self.picture.shown[0]["handles"]
            joint = nearest(np.column_stack([handles.x, handles.y]), at, pixel, within=REACH) if view == 0 else None
            self._held = None if joint is None else (joint, self.program)
        elif kind == "drag" and self._held is not None:
            self._move(self._held[0], float(at[0]) * self._shown().across / deg, float(at[1]))
        elif kind == "release" and self._held is not None:
            before, self._held = self._held[1], None
            if self.program != before:
                self._steps.leave(before)
                self._show_steps()

    def _move(self, joint: int, angle: float, level: float) -> None:
        """Bring a joint to a cam angle (deg) and a level (in the unit shown), as far as its neighbours let it."""
        if 0 < joint < len(self.rows):
            angle, level = (round(value / GRID) * GRID for value in (angle, level))
            self._edit(lambda program: with_edge(program, joint, angle, level * factor(self.unit)))

    def summary(self) -> str:
        """Each transition's verdict."""
        return "\n".join(joint.text(self.unit) for joint in self.program.transitions())


def edit_program(program: MotionProgram, unit: str = "mm") -> ProgramEditor:
    """Rows and handles for a motion program whose lifts are shown in ``unit`` ("mm" or "deg").

    The result's ``.program`` goes into a cam: ``editor.on_change(lambda p: app.load(app.design.replace(motion=p)))``.
    """
    return ProgramEditor(program, unit)
