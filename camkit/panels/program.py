"""`edit_program`: a motion program segment by segment, by table or by dragging its joints."""

from __future__ import annotations

from collections.abc import Callable

import ipywidgets as w
import numpy as np

from ..motion import LAWS, Dwell, MotionProgram, Return, Rise, Segment
from ..quantities.kinds import refuse_arguments
from ..quantities.markup import Html, html, joined, table
from ..units import deg, factor, in_unit
from ..views.laws import PROGRAM_VIEWS, ShownProgram
from .kit.banner import Banner
from .kit.controls import tables_html
from .kit.layout import button, wrapped
from .kit.number import NumberBox, staying
from .kit.panel import IMPOSSIBLE, Panel
from .kit.picture import LivePicture
from .kit.quiet import Quiet

KINDS = ("rise", "dwell", "return")
LEAST = 1 * deg
"""The least angle to which a segment can be dragged."""
MOST = 10_000.0
"""More cannot be typed, in the unit shown."""
GRID = 0.5
"""Dragged angles (deg) and lifts snap to multiples of this, in the unit shown."""


class LengthBox(NumberBox):
    """A box for an angle or a lift of at most `MOST` units."""

    def _read(self, text: str) -> float:
        value = super()._read(text)
        if abs(value) > MOST:
            raise ValueError(f"{value:g} {self.unit} was typed; it must be at most {MOST:g} {self.unit}")
        return value


class SegmentRow:
    """One segment: kind, angle, lift, law."""

    def __init__(
        self,
        segment: Segment,
        unit: str,
        changed: Callable[[], None],
        remove: Callable[[SegmentRow], None],
        refused: Callable[[str], None],
    ) -> None:
        self.unit, self._refused = unit, refused
        kind = type(segment).__name__.lower()
        law = getattr(segment, "law", LAWS[2])
        laws = [(option.name, option) for option in (*LAWS, *(() if law in LAWS else (law,)))]
        self.kind = w.Dropdown(options=KINDS, value=kind, layout=w.Layout(width="92px"))
        self.angle = self._box("angle", "deg", in_unit(float(segment.angle), "deg"))
        self.lift = self._box("lift", unit, in_unit(float(getattr(segment, "lift", 0.0)), unit))
        self.law = w.Dropdown(options=laws, value=law, layout=w.Layout(width="210px"))
        drop = button("", lambda: remove(self), "times", "34px", tooltip="remove this segment")
        cells = [self.kind, self.angle, w.Label("deg"), self.lift, w.Label(unit), self.law, drop]
        self.row = w.HBox(cells, layout=w.Layout(align_items="center"))
        for box in (self.kind, self.angle, self.lift, self.law):
            box.observe(lambda _: changed(), "value")

    def _box(self, name: str, unit: str, value: float) -> NumberBox:
        refused = staying(name, self._refused)
        return LengthBox(value, refused, unit, meaning=f"{name}, {unit}", layout=w.Layout(width="84px"))

    def segment(self) -> Segment:
        """The segment as the row says it."""
        angle, lift = self.angle.value * deg, self.lift.value * factor(self.unit)
        if self.kind.value == "dwell":
            return Dwell(angle)
        return (Rise if self.kind.value == "rise" else Return)(angle, lift, self.law.value)


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
        self.numbers, self._list, self.banner = w.HTML(), w.VBox(), Banner()
        self.picture = LivePicture(PROGRAM_VIEWS, "Displacement, velocity, acceleration and jerk", height=5.6)
        self.picture.widget.on_pointer(self._pointer)
        add = button("Add a segment", self._add, "plus")
        reset = button("Reset", lambda: self.load(self.start), "undo")
        left = w.VBox([self._list, w.HBox([add, reset])], layout=w.Layout(flex="0 1 600px"))
        super().__init__([wrapped(left, self.numbers), self.banner, self.picture.widget])
        self.load(program)

    def load(self, program: MotionProgram) -> None:
        """Show another program."""
        self._list_rows([self._row(segment) for segment in program.segments])
        self._try(lambda: program)

    def _row(self, segment: Segment) -> SegmentRow:
        changed = self._quiet.unless(self._changed)
        return SegmentRow(segment, self.unit, changed, self._remove, self.banner.show_message)

    def _list_rows(self, rows: list[SegmentRow]) -> None:
        self.rows, self._list.children = rows, [row.row for row in rows]

    def _changed(self) -> None:
        self._try(lambda: MotionProgram(tuple(row.segment() for row in self.rows), self.start.start))

    def _try(self, make: Callable[[], MotionProgram]) -> None:
        last = self.program
        try:
            self.program = make()
            table = self._table_html()
            self.picture.show(ShownProgram(self.program, self.unit))
        except IMPOSSIBLE as refusal:
            self.program = last
            self.refuse_picture(f"This is no motion program: {refusal}.")
            return
        self.refuse_picture("")
        self.numbers.value = table
        self._tell_followers(self.program)

    def _add(self) -> None:
        rest = max(2 * np.pi - float(self.program.span), 0.0)
        segment = Dwell(rest if rest > LEAST else 30 * deg)
        self._list_rows([*self.rows, self._row(segment)])
        self._changed()

    def _remove(self, row: SegmentRow) -> None:
        self._list_rows([r for r in self.rows if r is not row])
        self._changed()

    def _pointer(self, kind: str, x: float, y: float) -> None:
        """Take hold of the nearest handle, and move it."""
        if kind == "press":
            levels = np.asarray(self.program.levels, dtype=float) / factor(self.unit)
            handles = np.column_stack([np.asarray(self.program.edges) / deg, levels])
            self._held = self.picture.nearest(handles, x, y, within=30)
        elif kind == "drag" and self._held is not None:
            self._move(self._held, *self.picture.in_data(x, y))
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

    def _table_html(self) -> Html:
        peaks = self.program.peaks()
        names = (("velocity", "/rad"), ("acceleration", "/rad^2"), ("jerk", "/rad^3"))
        rows = (
            (
                name,
                f"{in_unit(float(p.value), self.unit):.5g} {self.unit}{per}",
                f"{in_unit(float(p.cam_angle), 'deg'):.4g} deg",
            )
            for (name, per), p in zip(names, peaks, strict=True)
        )
        verdicts = joined(
            html("<div>{}</div>" if lawful else "<div class='camkit-missed'>{}</div>", verdict)
            for verdict, lawful in self._verdicts()
        )
        return tables_html(table(("peak", "value", "at"), rows), html("<div>{}</div>", verdicts))

    def summary(self) -> str:
        """Each joint's verdict."""
        return "\n".join(verdict for verdict, _ in self._verdicts())


def edit_program(program: MotionProgram, unit: str = "mm") -> ProgramEditor:
    """Rows and handles for a motion program whose lifts are shown in ``unit`` ("mm" or "deg").

    The result's ``.program`` goes into a cam: ``editor.on_change(lambda p: app.load(app.design.replace(motion=p)))``.
    """
    return ProgramEditor(program, unit)
