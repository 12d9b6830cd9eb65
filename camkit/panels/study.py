"""`study_panel`: what is wanted of a design and what may change for it, by menus and ticks, and the search for it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from ..decision import Judgements
from ..files import Session, designs
from ..quantities import Measure, measures_of, value_of
from ..quantities.kinds import refuse_arguments
from ..search.fast_front import MOST_FREE
from ..study.robust import RobustStudy
from ..study.study import Study
from ..units import convert, in_unit
from .ahp import ahp_panel
from .choose import choose_panel
from .instrument import Instrument
from .kit.design_files import remarked
from .kit.inputs import Amount, Check, Download, Upload
from .kit.parts import Banner, Button, Group, Message, Words, row
from .kit.runner import JobPanel
from .kit.sheet import IMPOSSIBLE, Panel, reason
from .kit.space import Space
from .kit.wishes import Wishes
from .kit.yields import NO_TOLERANCES, YIELD
from .live_pareto import LiveParetoPanel, live_pareto_panel
from .optimise import optimise_panel
from .pareto import ParetoPanel, pareto_panel
from .tolerances import tolerance_panel

TOLD = 3
"""So many free quantities are named in the line that says what is asked for."""
P = TypeVar("P", bound=Panel)
F = TypeVar("F", ParetoPanel, LiveParetoPanel)
ROBUST = (
    "the limits are then kept by so many of the parts: within the tolerances given, or the general ones (ISO 2768-1 m)"
)
HINT = "Say what is to be small or large and what it is to keep, tick what may change, and press Find."


class StudyPanel(Panel):
    """A study of the design of an `Instrument`, made by menus and ticks, and what looks for what it asks for.

    Every measure stands there with its value now, what it is to become and the limits that it is to keep, every
    quantity with the bounds between which it may change.  At first that is what ``study`` asks for, without one the
    limits of the instrument; ``measures`` stand beside those of the design.  ``study`` is what is asked for now, around
    the design in the sliders.  ``find()`` optimises from there; with several objectives it opens their front, their
    judgements and the decision.
    """

    def __init__(self, explorer: Instrument, study: Study | None = None, measures: Sequence[Measure] = ()) -> None:
        refuse_arguments(StudyPanel.__init__, locals())
        self.explorer, self._given = explorer, study
        self._tabs: dict[str, tuple[Panel, list[Callable[..., object]]]] = {}
        self.banner, self.space = Banner(), Space(self._refuse)
        self.wishes = Wishes((*explorer.measures, *measures_of(explorer.design), *measures))
        find = Button("Find", self.find, primary=True, tooltip="look for the design, or the front, that this asks for")
        parts = Button("Tolerances", self.open_tolerances, tooltip="what the workshop makes of the design")
        save = Download("Save study", "study.json", "application/json", self._json, self.banner.show_message)
        buttons = row(find, parts, save, Upload("Load study", self.load_json))
        free = Group(Words(value=["what may change, and its bounds"], look="hint"), self.space.part)
        self.told, self._kept = Words(look="hint"), ""
        self.robust = Check(description="made within tolerances, yield at least", tooltip=ROBUST)
        self.share = Amount(unit="%", description="yield at least")
        made = row(self.robust, self.share)
        super().__init__(Group(buttons, self.banner, self.told, look="stays"), self.wishes.part, made, free)
        self._ask(study)
        self._continue()
        explorer.observe(lambda _: self._continue(), "page")
        explorer.on_change(lambda _: self._follow())
        explorer.add_tab("Study", self)

    def _ask(self, study: Study | None) -> None:
        """Show what a study asks for, or the limits of the instrument alone."""
        limits = self.explorer.limits
        sides = [(m, v, s) for side, s in (("at_most", 1), ("at_least", -1)) for m, v in (limits[side] or {}).items()]
        with self.held():
            self._given = study
            self.wishes.ask(study.minimise if study else (), study.limits if study else sides)
            self._follow()
            self.space.ask(study.free if study else {})
            self.robust.value = isinstance(study, RobustStudy)
            self.share.value = in_unit(study.yield_at_least if isinstance(study, RobustStudy) else YIELD, "%")
            self._tell_asked()

    def _tell_asked(self) -> None:
        """In a line what is asked for."""
        free = [bounds.free.description for bounds in self.space.ticked]
        more = f" and {len(free) - TOLD} more" if len(free) > TOLD else ""
        told = [*self._wanted(), f"free: {', '.join(free[:TOLD])}{more}" if free else ""]
        self.told.say("; ".join(filter(None, told)) or HINT)

    def _hear(self, message: Message, buffers: Sequence[memoryview]) -> None:
        """A person has done something: what is asked for now is said, and kept with the page."""
        with self.held():
            self._refuse("")
            super()._hear(message, buffers)
            self._tell_asked()
            with suppress(*IMPOSSIBLE):  # what is no study yet, or none that a file can hold
                self._kept = self._json()
                self.explorer.page = {**self.explorer.page, "study": self._kept}

    def _continue(self) -> None:
        """Ask for what somebody left, as long as nobody has asked for anything else here."""
        kept = self.explorer.page.get("study")
        if kept and not self._kept:
            self._kept = str(kept)
            with suppress(*IMPOSSIBLE):
                self._ask(designs.read_json(self._kept, Session, tuple(self.wishes.rows)).thing.study)

    def _follow(self) -> None:
        """Show the values of the design in the sliders, and the quantities that it has."""
        with self.held():
            self.wishes.follow(self.explorer.analysis)
            self.space.offer(self._design)

    @property
    def _design(self) -> Any:
        """The design in the sliders, ready for what the given study frees, if it can be."""
        with suppress(ValueError):
            return self._given.around(self.explorer.design).start if self._given else self.explorer.design
        return self.explorer.design

    def _refuse(self, sentence: str) -> None:
        self.banner.show_message(sentence)

    @property
    def study(self) -> Study:
        """What is asked for, around the design in the sliders; ``ValueError`` in a sentence where that is no study."""
        free, minimise = self.space.free, self.wishes.minimise
        if not minimise:
            raise ValueError("nothing is to be small or large; choose it for one measure or more")
        if not free:
            raise ValueError("nothing may change; tick one quantity or more")
        asked = self._asked(free, minimise)
        if not self.robust.value:
            return asked.nominal
        share = convert(self.share.value, "%", "")
        if isinstance(asked, RobustStudy):
            return asked.replace(yield_at_least=share)
        return asked.under(self.explorer.within(asked.start), share)

    def _asked(self, free: Mapping[Any, Any], minimise: tuple[Measure, ...]) -> Study:
        """A study of the design in the sliders with the limits that are asked for."""
        start, at_most, at_least = self._design, self.wishes.limits(1), self.wishes.limits(-1)
        if self._given:
            return self._given.replace(start=start, free=free, minimise=minimise, at_most=at_most, at_least=at_least)
        return Study(start, free, minimise, at_most, at_least)

    def find(self) -> None:
        """Look for what is asked for, in tabs of their own; the banner says what cannot be searched."""
        self._open(self._search, "searched")

    def _search(self) -> Panel:
        study = self.study
        study = study.freeing(study.free)  # refuses what has no effect
        return self._optimise(study) if len(study.minimise) == 1 else self._front(study)

    def open_tolerances(self) -> None:
        """Show what the workshop makes of the design in the sliders, in a tab of its own."""
        self._open(self._tolerances, "shown")

    def _tolerances(self) -> Panel:
        """Within the tolerances of the verdict; where nothing is to be small or large, what is limited is drawn."""
        limited = dict.fromkeys((*self.wishes.limits(1), *self.wishes.limits(-1)))
        if not (drawn := self.wishes.minimise or tuple(limited)):
            raise ValueError("nothing is to be kept; choose a limit for one measure or more")
        if not (half := self.explorer.half_widths):
            raise ValueError(NO_TOLERANCES)
        values = {path: value_of(self._design, path) for path in half}
        made = self._asked({path: (v - half[path], v + half[path]) for path, v in values.items()}, drawn).nominal
        return self._tab("Tolerances", lambda: tolerance_panel(self.explorer, made, half))

    def _open(self, show: Callable[[], Panel], what: str) -> None:
        """Show panels of what is asked for, and their last one's tab."""
        try:
            panel = show()
        except IMPOSSIBLE as refusal:
            self._refuse(f"This cannot be {what}: {reason(refusal)}.")
            return
        self._refuse("")
        title = next(title for title, (shown, _) in self._tabs.items() if shown is panel)
        self.explorer.opened = ""  # it may have been left since
        self.explorer.opened = title

    def _optimise(self, study: Study) -> Panel:
        panel = self._tab("Optimise", lambda: optimise_panel(self.explorer, study))
        panel.run()
        return panel

    def _front(self, study: Study) -> Panel:
        """The front, live where it takes few free quantities, with judgements that begin alike, and the decision."""
        app, names = self.explorer, [measure.name for measure in study.minimise]
        judged = ahp_panel(Judgements(names, [1] * (len(names) * (len(names) - 1) // 2)), "What matters more?")
        nominal = study.nominal
        front = self._tab("Front", lambda: self._made(study, pareto_panel(app, nominal, importance=judged)))
        if len(study.free) <= MOST_FREE:
            front = self._tab(
                "Live front", lambda: self._made(study, live_pareto_panel(app, nominal, importance=judged))
            )
        else:
            front.run()
        self._tab("Decision", lambda: choose_panel(front))
        return front

    def _made(self, study: Study, panel: F) -> F:
        """The panel of a front, which asks for the yield that a study asks for."""
        if isinstance(study, RobustStudy):
            if isinstance(self._given, RobustStudy):  # with tolerances of its own
                self.explorer.tolerances = study.tolerances
            panel.robust.wanted.set(study.yield_at_least)
            panel.robust.tick.value = True
        return panel

    def _tab(self, title: str, make: Callable[[], P]) -> P:
        """A panel in the tab of that title; the one that stood there for an earlier study follows no more."""
        if title in self._tabs:
            old, acts = self._tabs.pop(title)
            if isinstance(old, JobPanel):
                old.stop()
            self.explorer.followers = [act for act in self.explorer.followers if act not in acts]
        before = len(self.explorer.followers)
        panel = make()
        self._tabs[title] = panel, self.explorer.followers[before:]
        return panel

    # ------------------------------------------------------------ files and words

    def _json(self) -> str:
        return designs.to_json(Session(self.study.nominal, self.explorer.design))

    def load_json(self, file: str | bytes) -> None:
        """Ask for what a saved study asks for; a file that cannot be used is refused in a sentence."""
        try:
            found = designs.read_json(file, Session, tuple(self.wishes.rows))
            self.explorer.load(found.thing.design)
            self._ask(found.thing.study)
        except IMPOSSIBLE as refusal:
            self._refuse(f"This file cannot be used: {reason(refusal)}.")
        else:
            self._refuse(remarked(found))

    def drawing(self) -> Callable[[], bytes]:
        """What draws the design."""
        return self.explorer.drawing()

    def stored(self) -> dict[str, object]:
        """In words what is asked for: nobody hears of a menu in a file."""
        return {"body": Words(value=self.summary().split("\n")).described(), "heading": ""}

    def summary(self) -> str:
        """What is asked for, in words."""
        free = (f"free: {bounds.free.description}, {bounds.words}" for bounds in self.space.ticked)
        return "\n".join([*self._wanted(), *free]) or "nothing is asked for yet"

    def _wanted(self) -> list[str]:
        """Objectives and limits in words."""
        wanted = [f"{'small' if m.sign > 0 else 'large'}: {m.name}" for m in self.wishes.minimise]
        for sense, said in ((1, "at most"), (-1, "at least")):
            wanted += [f"{said} {m.text(limit)}: {m.name}" for m, limit in self.wishes.limits(sense).items()]
        return [*wanted, f"yield at least {self.share.value:g} %"] if self.robust.value else wanted


def study_panel(explorer: Instrument, study: Study | None = None, measures: Sequence[Measure] = ()) -> StudyPanel:
    """A tab of ``explorer`` in which wishes, limits and free quantities are chosen and searched (see `StudyPanel`).

    It begins with what ``study`` asks for; ``measures`` are one's own, beside those of the design.
    """
    return StudyPanel(explorer, study, measures)
