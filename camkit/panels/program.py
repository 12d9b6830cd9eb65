"""`edit_program`: a motion program segment by segment, by table or by dragging its joints."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from ..motion import MotionProgram
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..units import deg, factor, in_unit, rpm
from ..views.laws import PROGRAM_VIEWS, MotionUnits, ShownProgram
from .kit import draft_edits as edits
from .kit.draft import Draft
from .kit.drawn import LivePicture, nearest
from .kit.inputs import Amount, Menu
from .kit.parts import Banner, Button, Group, Message, Table, Words, row
from .kit.program_files import ProgramFiles
from .kit.quiet import Quiet
from .kit.remarks import Remarks
from .kit.segments import Edit, Hand, SegmentRow, heads
from .kit.sheet import IMPOSSIBLE, Panel, reason
from .kit.steps import Steps
from .kit.verdicts import PEAKS, TransitionRow, at_edges, headline, peaks

GRID = 0.5
"""Dragged angles (deg) and lifts snap to multiples of this, in the unit shown."""
HEIGHT = 222
"""Pixels of each curve in the page."""
REACH = 30
"""Pixels from which a handle is taken hold of."""
SLOWEST, FASTEST = 1e-3, 1e6
"""Speeds of a shaft that can be typed, rpm."""
PER_RAD, IN_TIME, OVER_TIME = "per radian", "in time", "in time, over time"


class Speed(Amount):
    """A box for the speed of the shaft."""

    def take(self, message: Message) -> None:
        """Another number; ``ValueError`` for one that no shaft has."""
        value = float(message["value"])
        if not SLOWEST <= value <= FASTEST:
            must = f"it must be from {SLOWEST:g} to {FASTEST:g} rpm"
            raise ValueError(f"the speed stays as before: {value:g} rpm was typed; {must}")
        self.value = value


class ProgramEditor(Panel):
    """A motion program under the hand: rows for its segments, handles at its joints.

    ``program`` is the program that is shown, the last one that was possible; ``on_change(f)`` calls ``f(program)``
    after every change.  What a segment takes its neighbours give, so that a turn stays a turn.  Dragging a handle
    sideways moves a joint between its neighbours, up and down changes the level there; what lies beyond stays.

    A segment that is made a polynomial or a constant velocity follows from what holds at its ends (`MatchedProgram`):
    each transition then has a menu for position, velocity, acceleration and jerk.
    """

    def __init__(self, program: MotionProgram, unit: str = "mm", speed: float | None = None) -> None:
        refuse_arguments(ProgramEditor.__init__, locals())
        MotionUnits(unit, speed)
        self.start, self.unit = program, unit
        self.draft = Draft.of(program)
        self._quiet, self._steps = Quiet(), Steps[Draft]()
        self._hand = Hand(self._edit, unit, self._quiet)
        self._held: tuple[int, Draft] | None = None
        self.rows: list[SegmentRow] = []
        self.transitions: list[TransitionRow] = []
        self.first = TransitionRow(0, self._hand)
        self._make_parts()
        if speed is not None:
            with self._quiet:
                self.values.value, self.speed.value = IN_TIME, in_unit(speed, "rpm")
        parts = (self.banner, self.verdict, self._list, self._rest, self.remarks.group, self.numbers, self.files.group)
        left = Group(self._head, *parts)
        super().__init__(Group(left, self.picture, look="beside halves"))
        self.load(program)

    def _make_parts(self) -> None:
        self.numbers, self.verdict, self.banner = Table(), Words(role="status"), Banner()
        self.followed = Words(look="hint", role="status")
        self.undo = Button("Undo", partial(self._go, self._steps.undo))
        self.redo = Button("Redo", partial(self._go, self._steps.redo))
        self.values = Menu((PER_RAD, IN_TIME, OVER_TIME), "values")
        self.speed = Speed(description="speed", unit="rpm", value=60.0, tooltip="speed of the shaft")
        for box in (self.values, self.speed):
            self._quiet.hear(box, lambda _: self._take(lambda draft: draft))
        reset = Button("Reset", lambda: self._edit(lambda _: Draft.of(self.start)))
        self._head = row(self.undo, self.redo, reset, self.values, self.speed, look="head")
        self._list, self._heads = Group(look="segments"), heads(self._edit)
        self.rest = Menu((), "closes the turn", tooltip="which segment takes what the others leave of the turn")
        self._quiet.hear(self.rest, lambda i: self._edit(lambda draft: edits.resting(draft, i)))
        self._rest = row(self.rest, self.followed)
        self.remarks = Remarks(self._hand)
        self.files = ProgramFiles(self, lambda said: self.followed.say(said), self.banner.show_message)
        self.picture = LivePicture(PROGRAM_VIEWS, "Displacement, velocity, acceleration and jerk", height=5.6)
        self.picture.pixels = HEIGHT
        self.picture.on_pointer(self._pointer)

    @property
    def program(self) -> MotionProgram:
        """The program that is shown, the last one that was possible."""
        return self.draft.program

    @property
    def units(self) -> MotionUnits:
        """What numbers are shown in: per rad of the cam, or in time at a speed."""
        return MotionUnits(self.unit, None if self.values.value == PER_RAD else self.speed.value * rpm)

    def load(self, program: MotionProgram) -> None:
        """Show another program; its rows stay where they are, so that a button under the pointer does what it says."""
        draft = Draft.of(program)
        if other := [kind for kind in map(edits.kind_of, draft.parts) if kind not in edits.KINDS]:
            raise ValueError(f"the program has a {other[0]}; rises, returns and dwells can be edited here")
        self._edit(lambda _: draft)

    def _edit(self, edit: Edit) -> None:
        """Another draft after a person's hand, a step that can be undone."""
        before = self.draft
        possible = self._take(edit)
        if self.draft != before:
            with self.held():
                if self._held is None:
                    self._steps.leave(before)
                self._say_what_followed(before)
                self._show_steps()
            if possible:
                self._tell_followers(self.program)

    def _take(self, edit: Edit) -> bool:
        """Show another draft; what cannot be typed is said, and the last one stays; one that is impossible waits."""
        before = self.draft
        with self._quiet, self.held():
            try:
                self.draft = edit(before)
                self._show(self.draft.made())
            except IMPOSSIBLE as refusal:
                waits = self.draft is not before and self.draft.matched
                self.draft = self.draft if waits else before
                self._show_rows(possible=not waits and self.picture.visible)
                said = f"{reason(refusal)[:1].upper()}{reason(refusal)[1:]}."
                (self.refuse_picture if waits else self.banner.show_message)(said)
                return False
        return True

    def _go(self, step: Callable[[Draft], Draft | None]) -> None:
        """Undo, or redo."""
        draft = step(self.draft)
        if draft is not None:
            with self.held():
                possible = self._take(lambda _: draft)
                self.followed.say()
                self._show_steps()
            if possible:
                self._tell_followers(self.program)

    def refuse_picture(self, sentence: str) -> None:
        """Show a sentence in place of the picture, its numbers and its verdicts; an empty one brings them back."""
        with self.held():
            super().refuse_picture(sentence)
            self.verdict.visible = self.remarks.group.visible = not sentence

    def _show(self, draft: Draft) -> None:
        """Rows, verdicts, peaks and curves of a draft that is possible."""
        over_time = self.values.value == OVER_TIME
        shown = ShownProgram(draft.program, self.unit, speed=self.units.speed, over_time=over_time)
        self.picture.show(shown)
        self._across, self.draft = shown.across, draft
        self.refuse_picture("")
        self._show_rows()
        self.verdict.say(headline(draft.program))
        self.remarks.show(draft, self.unit)
        self.numbers.put(PEAKS, [peaks(draft.program, self.units)])
        self._show_steps()

    def _show_rows(self, possible: bool = True) -> None:
        draft, units = self.draft, self.units
        self.speed.visible = self.values.value != PER_RAD
        while len(self.rows) < len(draft.parts):
            self.rows.append(SegmentRow(len(self.rows), self._hand))
            self.transitions.append(TransitionRow(len(self.transitions) + 1, self._hand))
        del self.rows[len(draft.parts) :], self.transitions[len(draft.parts) :]
        edges = np.concatenate([[0.0], np.cumsum(draft.angles())]) * deg
        found = at_edges(draft.program) if possible else [None] * len(edges)
        segments = draft.program.segments if possible else [None] * len(self.rows)
        for row_, segment in zip(self.rows, segments, strict=True):
            row_.show(draft, segment, units)
        for after, joint, edge in zip((self.first, *self.transitions), found, edges, strict=True):
            after.show(draft, joint, float(edge), units)
        self.first.row.visible = draft.matched and not draft.turns
        self._list_parts()
        self._show_rest()

    def _list_parts(self) -> None:
        both = zip(self.rows, self.transitions, strict=True)
        pairs = (part for row_, after in both for part in (*row_.parts, after.row))
        self._list.children = (self._heads, self.first.row, *pairs)

    def _show_rest(self) -> None:
        draft = self.draft
        names = [(f"{k + 1}: {edits.kind_of(part)}", k) for k, part in enumerate(draft.parts)]
        can = [names[k] for k in range(len(names)) if k == draft.rest or draft.own_angle(k)]
        self.rest.offer(can if draft.rest is not None else (), draft.rest)
        self.rest.visible = draft.rest is not None

    def _show_steps(self) -> None:
        self.undo.disabled, self.redo.disabled = not self._steps.before, not self._steps.after

    def _say_what_followed(self, before: Draft) -> None:
        """Which segments gave or took angle, where more did than the one beside."""
        old, new = before.angles(), self.draft.angles()
        changed = [(k, old[k], new[k]) for k in range(len(new)) if len(old) == len(new) and old[k] != new[k]]
        told = ", ".join(f"{k + 1}: {a:g} to {b:g} deg" for k, a, b in changed)
        self.followed.say(f"Segments {told}." if len(changed) > 2 else "")

    def _pointer(self, view: int, kind: str, at: Array, pixel: Array) -> None:
        """Take hold of the nearest handle of the displacement, and move it."""
        if kind == "press":
            handles = self.picture.shown[0]["handles"]
            joint = nearest(np.column_stack([handles.x, handles.y]), at, pixel, within=REACH) if view == 0 else None
            self._held = None if joint is None else (joint, self.draft)
        elif kind == "drag" and self._held is not None:
            self._move(self._held[0], float(at[0]) * self._across / deg, float(at[1]))
        elif kind == "release" and self._held is not None:
            before, self._held = self._held[1], None
            if self.draft != before:
                self._steps.leave(before)
                self._show_steps()

    def _move(self, edge: int, angle: float, level: float) -> None:
        """Bring an edge to a cam angle (deg) and a level (in the unit shown), as far as its neighbours let it."""
        if 0 < edge < len(self.rows):
            angle, level = (round(value / GRID) * GRID for value in (angle, level))
            self._edit(lambda draft: edits.with_edge(draft, edge, angle, level * factor(self.unit)))

    def summary(self) -> str:
        """Each transition's verdict."""
        return "\n".join(joint.text(self.unit) for joint in self.program.transitions())


def edit_program(program: MotionProgram, unit: str = "mm", speed: float | None = None) -> ProgramEditor:
    """Rows and handles for a motion program whose lifts are shown in ``unit`` ("mm" or "deg").

    At a ``speed`` of the shaft (rad/s) velocities, accelerations and jerks are those in time.

    The result's ``.program`` goes into a cam: ``editor.on_change(lambda p: app.load(app.design.replace(motion=p)))``.
    """
    return ProgramEditor(program, unit, speed)
