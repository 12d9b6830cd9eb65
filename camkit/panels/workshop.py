"""The tab *Workshop* of an instrument: what its files are to say, and one button that gives all of them in a zip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..files import Blank, TitleBlock, faults
from ..files.workshop.exports import Order, exports_of
from ..files.workshop.faults import YIELD, has_profile
from ..files.workshop.package import package
from ..files.workshop.reported import study_of
from ..quantities import Quantity, choices_of, quantities_of, value_of
from ..quantities.kinds import refuse_arguments
from ..study.robust import RobustStudy
from ..study.spread import Source
from ..study.study import Study
from ..units import mm
from .instrument import Instrument
from .kit.design_files import living_page
from .kit.inputs import Check, Input, Menu, Number, Typed
from .kit.latest_only import Debounced, LatestOnly
from .kit.parts import Banner, Button, Group, Table, Words, bold, row
from .kit.sheet import IMPOSSIBLE, Sheet, reason

TITLE = "Workshop"
QUIET = 0.3
"""Seconds after the last move until the design is judged."""
UNITS = (("mm", "mm"), ("inch", "in"))
TOOL = Quantity("r_c", 5, 0.1, 200, "mm", "of the cutter or the grinding wheel")
SAID = ("title", "number", "author", "material", "date")
"""What stands in the title block."""
BLANK = "What the cam is cut from, and the tool:"
SOUND = "Nothing is wrong with it."
INSIST = "Make it nevertheless: every sheet is marked FAULTY"
HEADS = ("file", "what it is for")


class Stopped(Exception):
    """Somebody has pressed Stop."""


class WorkshopPanel(Sheet):
    """A form around the design of an `Instrument`; ``order`` is what it asks for.

    What is wrong with the design stands above it.  A faulty design gives no file unless somebody insists, nor does
    what cannot be a blank.
    """

    def __init__(self, explorer: Instrument) -> None:
        refuse_arguments(WorkshopPanel.__init__, locals())
        self.explorer, self.blank = explorer, Blank()
        self.banner, self.verdict, self.status = Banner(), Words(role="status"), Words(look="status", role="status")
        self.unit = Menu(UNITS, "unit", tooltip="of all lengths in the files")
        self.sizes = {name: self._number(name, q) for name, q in quantities_of(self.blank).items()}
        (self._choice, key), *_ = choices_of(self.blank).items()
        self.key = Menu(list(key.named.items()), "keyway", value=self.blank.key, tooltip=key.meaning)
        self.key.observe(lambda _: self._moved(), "value")
        self.tool = Number("tool radius", TOOL, TOOL.default * mm, refused=self.banner.show_message)
        empty = {"title": explorer.structure["name"], "date": "today"}
        self.title: dict[str, Input] = {
            name: Typed(description=name, named=True, placeholder=empty.get(name, "")) for name in SAID
        }
        self.insist = Check(description=INSIST, visible=False)
        self.insist.observe(lambda _: self._show_button(), "value")
        self.button = Button("To the workshop", self.make, primary=True, tooltip="all files in one zip")
        self.stop = Button("Stop", self._stop, visible=False, tooltip="after the file that is being made")
        self.files, self.lacking = Table(), Words(look="hint")
        self.fold = Group(self.files, look="fold")
        self._judged = Debounced(self._judge, QUIET)
        self._wrong: tuple[str, ...] = ()
        self._possible, self._stopping = True, False
        self._worker = LatestOnly(lambda task: self._make(*task))
        super().__init__(*self._body(), heading="To the workshop")
        self._judge()
        explorer.on_change(lambda _: self._judged.ask())
        explorer.add_tab(TITLE, self)

    def _number(self, name: str, declared: Quantity) -> Number:
        return Number(name, declared, value_of(self.blank, name), self._moved, self.banner.show_message)

    def _body(self) -> tuple[Group, ...]:
        cam = has_profile(self.explorer.analysis)
        said = Group(self.banner, self.verdict, self.insist, row(self.button, self.stop, self.status), look="stays")
        sheets = row(*self.title.values(), self.unit, look="sheets")
        sizes = Group(*self.sizes.values(), self.tool, look="grid")
        blank = Group(row(Words(value=[BLANK], look="hint"), self.key), sizes, visible=cam)
        return said, sheets, blank, Group(self.lacking, self.fold)

    # ------------------------------------------------------------ what is asked for

    @property
    def order(self) -> Order:
        """What is to be made of the design in the sliders, as the form says."""
        title = TitleBlock(**{name: box.value for name, box in self.title.items()})
        app, unit = self.explorer, str(self.unit.value)
        page = (living_page(app.html),)
        return Order(app, unit, title, self.blank, self.tool.value, self.asked, self._halves, page)

    @property
    def asked(self) -> Study | None:
        """What is asked of the design: in a tab, such as *Study*, or else by the limits of the instrument."""
        app = self.explorer
        found = (study_of(sheet) for tab in app.tabs for sheet in tab["sheets"])
        study = next(filter(None, found), app.judged)
        if study is None or not study.limits or isinstance(study, RobustStudy) or not app.tolerances:
            return study
        return study.under(app.tolerances, YIELD)

    @property
    def _halves(self) -> dict[str | Source, object] | None:
        return dict(self.explorer.half_widths.items()) if self.explorer.tolerances else None

    def _moved(self) -> None:
        """Another blank, if there can be one; else the last one stays."""
        given = {name: box.value for name, box in self.sizes.items()} | {self._choice: self.key.value}
        why = ""
        try:
            self.blank = Blank().replace(**given)
        except IMPOSSIBLE as refusal:
            why = f"There is no such blank: {reason(refusal)}."
        self._possible = not why
        self.banner.show_message(why)
        self._judge()

    def _judge(self) -> None:
        """Say what is wrong with the design, but for its yield, which takes longer; and which files there can be."""
        self.status.say()
        order = self.order
        study = order.study and order.study.nominal
        self._put_faults(faults(order.design, study, blank=order.blank))
        rows = [(f"{order.kind}{each.ending}", each.use) for each in exports_of(order)]
        with self.held():
            self.files.put(HEADS, rows)
            self.fold.description = f"The files in the zip ({len(rows)})"

    def _put_faults(self, wrong: tuple[str, ...]) -> None:
        with self.held():
            self._wrong = wrong
            sound = SOUND if self._possible else ""
            self.verdict.say(*([bold("Faulty: "), f"{fault}."] for fault in wrong) if wrong else (sound,))
            self.insist.visible = bool(wrong)
            self._show_button()

    def _show_button(self) -> None:
        self.button.disabled = not self._possible or (bool(self._wrong) and not self.insist.value)

    # ------------------------------------------------------------ the files

    def make(self) -> None:
        """Give the page the zip as soon as it is made."""
        self._judged.settle()
        html, self._stopping = self.explorer.html(), False
        self._say("What is wrong is looked for ...", busy=True)
        self._worker.ask((replace(self.order, more=(living_page(lambda: html),)), self.insist.value))

    def _stop(self) -> None:
        self._stopping = True
        self.status.say("It stops after this file ...")

    def _say_file(self, file: str) -> None:
        """Which file is being made, unless somebody has pressed Stop."""
        if self._stopping:
            raise Stopped
        self.status.say(f"{file} ...")

    def settle(self) -> None:
        """Wait until the design is judged and the zip that was asked for is made."""
        self._judged.settle()
        self._worker.wait()

    def _make(self, order: Order, insist: bool) -> None:
        try:
            wrong = faults(order.design, order.study, blank=order.blank)
            if wrong and not insist:
                self._put_faults(wrong)
                self._say("")
                return
            made = package(order, wrong, insist, self._say_file)
        except Stopped:
            self._say("Stopped: there is no zip.")
        except Exception as error:  # of a mechanism of somebody's own: the page stays alive
            self._say("", f"Nothing is made: {reason(error)}.")
        else:
            self._say(f"{made}.", lacking=made.remarks[len(wrong) :])
            self.send({"name": f"{order.kind}.zip", "mime": "application/zip"}, [made.data])

    def _say(self, status: str, refusal: str = "", lacking: Sequence[str] = (), busy: bool = False) -> None:
        with self.held():
            self.status.say(status)
            self.stop.visible = busy
            self.banner.show_message(refusal)
            self.lacking.say(*(f"Not made: {sentence}" for sentence in lacking))
