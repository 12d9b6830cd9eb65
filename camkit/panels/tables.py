"""`table_panel`: the motion of a design from a table that somebody drops on its page or chooses there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ..files import TableQuestion, read_motion, read_outline
from ..files.motions import ANGLES, LIFTS
from ..files.outlines import is_outline, with_outline
from ..motion import TableMotion
from ..quantities.kinds import refuse_arguments
from ..units import convert, in_unit
from ..views import TABLE_VIEWS
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.files import DRAWINGS, TABLES
from .kit.inputs import Amount, Check, Menu, Upload
from .kit.motions_in import motions_in, unit_of, with_motion
from .kit.parts import Banner, Button, Group, Words, row
from .kit.quiet import Quiet
from .kit.sheet import IMPOSSIBLE, Panel, reason

HINT = (
    "Drop a table of a motion here (CSV, TXT or XLSX: cam angle and lift in each row), or choose one. "
    "A DXF drawing or a table of x and y is taken as the outline of the cam."
)
OPEN = "Its rows do not come back to where they begin, so a cam of it goes around this part of the turn alone."
TITLE = "Table"
TOLD = 4
"""So many bad rows are named in sight."""
REMEMBERED = 50
"""So many files, or answers, can be come back to by Undo and read in another way."""
QUESTIONS = {
    "angle_unit": "What are they in?",
    "columns": "Which columns are they?",
    "sheet": "Which of them is the motion?",
    "lift_unit": "What are they in?",
    "unit": "What are they in?",
    "loop": "Which of them is the outline?",
}
ENDS = (("as the rows say", None), ("at rest", True), ("free", False))
ANGULAR = ("deg", "rad")


@dataclass(frozen=True)
class Reading:
    """A file, how it was read, and the motion in it; of an outline, this too."""

    data: bytes
    answers: Mapping[str, Any]
    motion: TableMotion
    outline: Any = None

    def of(self, design: Any, path: str) -> Any:
        """The design with what was read."""
        return with_outline(design, self.outline) if self.outline else with_motion(design, path, self.motion)


class TablePanel(Panel):
    """What was understood of a table, its bad rows, its motion before and after smoothing; and how else to read it.

    `read` takes a file: its motion becomes that of the design in the ``explorer``, an `Instrument`.  Where the table
    leaves open what is meant, the page asks.  ``motion`` is what is shown, if the design has one from a table.
    """

    def __init__(self, explorer: Instrument) -> None:
        refuse_arguments(TablePanel.__init__, locals())
        self.explorer = explorer
        self.motion: TableMotion | None = None
        self._readings: list[Reading] = []
        self._waiting: TableMotion | None = None  # for a design that can be built with it
        self._quiet, self._what = Quiet(), "table"
        self.banner, self.told, self.bad, self.more = Banner(), Words(role="status"), Words(look="missed"), Words()
        self.fold = Group(self.more, look="fold", visible=False)
        self.question, self.options = Words(look="bold", role="status"), row(description="answers")
        self.stays = Words(value=["The motion stays as it was until then."], look="hint", visible=False)
        self.where = Menu((), "motion of", visible=False)
        self.use = Button("Use this motion", self._use_again, visible=False, tooltip="try it again in the design")
        self.ends = Menu(ENDS, "ends", tooltip="of a table that is no whole turn: whether it begins and ends at rest")
        self.angles = Menu((("as found", None), *ANGLES), "angles in")
        self.lifts = Menu((("as found", None), *LIFTS), "levels in")
        smoothest = "the smoothest curve so close to every good row, in place of cross-validation"
        self.near = Check(description="rows within", tooltip=smoothest)
        self.within = Amount(unit="mm", description="rows within")
        self.ways = Group(self.ends, self.angles, self.lifts, row(self.near, self.within), look="ways", visible=False)
        for part in (self.ends, self.angles, self.lifts, self.near):
            self._quiet.hear(part, lambda _: self._read_again())
        self._quiet.hear(self.within, lambda _: self._read_again() if self.near.value else None)
        self.picture = LivePicture(TABLE_VIEWS, "the motion of the table", width=12.6, height=7.0)
        self.picture.pixels = 150
        choose = row(Upload("Choose a table", self.read, accept=TABLES + DRAWINGS), self.use, self.where)
        ask = Group(self.question, self.options, self.stays)
        super().__init__(choose, self.banner, ask, self.told, self.bad, self.ways, self.fold, self.picture)
        self._follow(explorer.design)
        explorer.on_change(self._follow)
        explorer.add_tab(TITLE, self)

    def read(self, file: bytes, **answers: Any) -> None:
        """Take the motion in a file, as `read_motion` does with these answers; what it leaves open the page asks.

        What is the outline of a cam is read by `read_outline`: the design becomes the one that has it.
        """
        with self.held():
            self._ask("")
            self._wait_for(None)
            try:
                reading = self._reading(file, answers)
            except TableQuestion as asked:
                self._ask(f"{_sentence(asked.why)} {QUESTIONS[asked.argument]}", self._buttons(file, answers, asked))
            except (*IMPOSSIBLE, ModuleNotFoundError) as refusal:
                self.banner.show_message(f"This {self._what} cannot be used: {reason(refusal)}.")
                self._stand(self._of_a_file(self.motion))
            else:
                self._take(reading)

    def _reading(self, file: bytes, answers: Mapping[str, Any]) -> Reading:
        """What is in a file: a motion, or an outline and the motion that it gives."""
        self._what = "outline" if is_outline(file) else "table"
        if self._what == "table":
            return Reading(file, answers, self._suited(read_motion(file, **answers)))
        outline = read_outline(file, **answers)
        motion: Any = next(iter(motions_in(with_outline(self.explorer.design, outline)).values()))
        return Reading(file, answers, motion, outline)

    def _suited(self, motion: TableMotion) -> TableMotion:
        """A motion along a line or around a pivot, as that of the follower is."""
        if not self.where.options:
            raise ValueError("this design has no motion program that a table could give")
        unit = unit_of(self.explorer.design, str(self.where.value))
        if not unit or (unit in ANGULAR) == (motion.unit in ANGULAR):
            return motion
        swings = unit in ANGULAR
        why = f"the levels are read in {motion.unit}, and this follower {'swings' if swings else 'moves along a line'}"
        offered = {name: name for name in LIFTS if (name in ANGULAR) == swings}
        raise TableQuestion(why, "lift_unit=", "lift_unit", offered)

    def _ask(self, question: str, buttons: Iterable[Button] = ()) -> None:
        self.question.say(question)
        self.options.children, self.stays.visible = tuple(buttons), bool(question)

    def _buttons(self, file: bytes, answers: Mapping[str, Any], asked: TableQuestion) -> list[Button]:
        each = {name: {**answers, asked.argument: value} for name, value in asked.options.items()}
        return [Button(name, partial(self.read, file, **given)) for name, given in each.items()]

    def _take(self, reading: Reading) -> None:
        """Give the design the motion that was read; a design that cannot be built with it stays, and that is said."""
        others = [each for each in self._readings if each is not reading]
        self._readings = [reading, *others][:REMEMBERED]
        self._show(reading.motion)
        try:
            self.explorer.design = reading.of(self.explorer.design, str(self.where.value))
        except IMPOSSIBLE as error:
            why = f"The {self._what} is read, but the design cannot be built with it: {reason(error)}."
            self._wait_for(reading.motion, f"{why} Change what stands in its way and press 'Use this motion'.")

    def _wait_for(self, motion: TableMotion | None, why: str = "") -> None:
        self._waiting, self.use.visible = motion, motion is not None
        self.banner.show_message(why)

    def _use_again(self) -> None:
        with self.held():
            self._wait_for(None)
            self._take(self._readings[0])

    def _read_again(self) -> None:
        """The same file, in the way that is chosen now."""
        reading = self._of_a_file(self.motion)
        if reading:
            most = convert(self.within.value, self.within.unit, "rad" if self.within.unit in ANGULAR else "m")
            chosen = {"rest": self.ends.value, "angle_unit": self.angles.value, "lift_unit": self.lifts.value}
            chosen["tolerance"] = most if self.near.value else None
            self.read(reading.data, **{**reading.answers, **chosen})

    def _of_a_file(self, motion: TableMotion | None) -> Reading | None:
        """The file of a motion, if it was read here."""
        return next((each for each in self._readings if motion and each.motion.segments == motion.segments), None)

    # ------------------------------------------------------------ what is shown

    def _follow(self, design: object) -> None:
        """Show the motion of the design, if it is from a table, or one that waits for another design."""
        with self.held(), self._quiet:
            found = motions_in(design)
            chosen = self.where.value if self.where.value in found else next(iter(found), None)
            self.where.offer([(path or "design", path) for path in found], chosen)
            self.where.visible = len(found) > 1
            now = found.get(str(chosen))
            motion = self._waiting or (now if isinstance(now, TableMotion) else None)
            if motion != self.motion or motion is None:
                self._show(motion)

    def _show(self, motion: TableMotion | None) -> None:
        with self.held():
            self.motion, self.picture.visible = motion, motion is not None
            self._put_words(motion.remarks if motion else ())
            if motion:
                self.picture.show(motion)
            self._stand(self._of_a_file(motion))

    def _put_words(self, remarks: Sequence[str]) -> None:
        """What was understood first, then bad rows; all else is folded."""
        first, *others = map(_sentence, remarks or (HINT,))
        bad = [line for line in others if line.startswith("Row ")]
        more = [line for line in others if line not in bad] + bad[TOLD:]
        self.told.look = "" if remarks else "hint"
        self.told.say(first, {"words": OPEN, "look": "hint"} if self.motion and not self.motion.periodic else "")
        self.bad.say(*bad[:TOLD], f"{len(bad) - TOLD} more rows are left out." if len(bad) > TOLD else "")
        self.more.say(*more)
        self.fold.visible, self.fold.description = bool(more), f"What else was understood ({len(more)})"

    def _stand(self, reading: Reading | None) -> None:
        """Show how a motion was read, where its file is known."""
        self.ways.visible = reading is not None and not reading.outline
        if not reading or reading.outline:
            return
        unit, answers = reading.motion.unit, reading.answers
        near = answers.get("tolerance")
        with self._quiet:
            self.ends.value, self.angles.value = answers.get("rest"), answers.get("angle_unit")
            self.lifts.value, self.near.value, self.within.unit = answers.get("lift_unit"), near is not None, unit
            self.within.value = float(f"{in_unit(3 * reading.motion.noise if near is None else near, unit):.2g}")

    def summary(self) -> str:
        """What was understood."""
        return "\n".join(self.motion.remarks if self.motion else (HINT,))


def _sentence(words: str) -> str:
    """A remark of `read_motion`, as it stands on a page."""
    said = words.replace("rest=True lets", "'ends at rest' lets")
    return f"{said[:1].upper()}{said[1:].rstrip('.')}."


def table_panel(explorer: Instrument) -> TablePanel:
    """The tab of ``explorer`` for the table that its motion is from: the one that is there, or a new one."""
    refuse_arguments(table_panel, locals())
    sheets = (sheet for tab in explorer.tabs for sheet in tab["sheets"])
    return next((sheet for sheet in sheets if isinstance(sheet, TablePanel)), None) or TablePanel(explorer)
