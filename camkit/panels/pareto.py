"""`pareto_panel`: a search in the background, its front, and the choice of one design from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from threading import RLock
from typing import Any

import numpy as np

from ..decision import CHOOSERS, Judgements, Judges
from ..files import Session, designs, sessions
from ..files.decisions import record_text
from ..quantities import Analysable, Paths, Quantity, words
from ..quantities.kinds import refuse_arguments, whole
from ..search.front import Front
from ..search.protocol import Step
from ..search.robust_front import surviving
from ..study.free import Free, freed
from ..study.robust import RobustStudy
from ..study.study import Study, named_studies
from ..views.front import ShownFront, pareto
from ..views.robust_front import robust_pareto
from .ahp import AhpPanel
from .instrument import Instrument
from .kit.bounds import rows_of
from .kit.design_files import remarked
from .kit.drawn import LivePicture
from .kit.front_picker import FrontPanel, FrontPicker
from .kit.inputs import Download, Input, Menu, Upload, Whole
from .kit.parts import Button, Group, Part, Words, bold, row
from .kit.robust_fronts import Robustness
from .kit.runner import JobPanel, Runner
from .kit.running import Job
from .kit.search_job import SessionSearch, progress_text
from .kit.search_page import SearchPage, same_design
from .kit.sheet import IMPOSSIBLE, reason

COUNTS = {"population": range(4, 1001), "generations": range(1, 10_001), "seed": range(10**6 + 1)}
"""What can be typed for the size of a search."""


class ParetoPanel(JobPanel, FrontPanel):
    """NSGA-II on the design of an `Instrument`, and the choice from its front.

    ``studies`` is a `Study`, or maps names in a menu to several; it is searched around the design in the explorer.
    ``space`` are the quantities that can be freed, with their bounds in SI, ``free`` those of them that are free at
    first; without these, what the studies free.  ``criteria`` weigh the parts of objectives that are weighted sums,
    ``importance`` judges the objectives among each other.  The search runs in a thread of its own: the page stays
    alive, Stop takes effect after the running generation and keeps the front so far.  Judgements weigh the objectives
    anew without a new search.

    A panel that is made while a search of its kind runs, because its cell is run again, takes that search over; a
    search of another kind that the cell began is stopped.

    Each generation is kept in a file until the search has ended.  After Stop or a killed kernel, Resume goes on from
    the last generation, to the same front as without the break.  What the search needs goes back to what it was at
    Optimise, and a sentence says what; design and judgements go back only where they stand as the page began.
    """

    def __init__(
        self,
        explorer: Instrument,
        studies: Study | Mapping[str, Study],
        space: Free | None = None,
        free: Sequence[str] | Free | None = None,
        criteria: AhpPanel | None = None,
        importance: AhpPanel | None = None,
        population: int = 100,
        generations: int = 100,
    ) -> None:
        refuse_arguments(ParetoPanel.__init__, locals())
        self.explorer, self.criteria, self.importance = explorer, criteria, importance
        studies = named_studies(studies, explorer.start)
        first, *others = (study.free for study in studies.values())
        if space is None:
            space = {path: bounds for each in (first, *others) for path, bounds in each.items()} | dict(first)
        free = first if free is None else free
        space = freed(explorer.design, space)
        Paths(explorer.design, [name for name in free if name not in space], Quantity)  # refuses what there is not
        self.page = self._page(studies, space)
        self.runner = Runner("Optimise", self._asked, self._show_step, self.page.kind, ended=self._offer_resume)
        self._make_parts()
        self.bounds = rows_of(explorer.design, space, free, self._refuse)
        self.mode = Menu(list(studies), "problem")
        self.population, self.generations, self.seed = map(self._count, COUNTS, (population, generations, 1))
        self.study = self.asked_study()
        self.found = sessions.empty_front(self.study)
        self.robust.compare(self.found, self.study)
        self.search: SessionSearch | None = None
        self._went_back = ""
        self._showing = RLock()  # a search shows its steps from its own thread
        self.picture = LivePicture((pareto,), "Pareto front", width=7.6, height=5.6)
        self.picker = FrontPicker(explorer, self.found, importance, self.picture, self._show_again)
        for panel in self._judges.values():
            panel.on_change(self.picker.quiet.unless(self._judged))
        explorer.on_change(lambda _: self._show_again() if self.picker.moved else None)
        super().__init__(self._body())
        self._show_again()
        self._stand_in_tabs("Front", criteria, importance)

    def _page(self, studies: Mapping[str, Study], space: Mapping[str, object]) -> SearchPage:
        judged = {name: panel.names for name, panel in self._judges.items()}
        offered = {**COUNTS, "mode": tuple(studies), "rule": tuple(CHOOSERS)}
        return SearchPage(self.explorer.start, studies, tuple(space), judged, offered, self.explorer.measures)

    @property
    def _judges(self) -> dict[str, AhpPanel]:
        """The judgement panels that there are, by name."""
        panels = {"criteria": self.criteria, "importance": self.importance}
        return {name: panel for name, panel in panels.items() if panel}

    def _make_parts(self) -> None:
        """What stands beside Run and Stop, and what is said."""
        self.banner, self.status, self.progress = self.runner.banner, self.runner.status, self.runner.progress
        self.details = Words()
        last = "go on with the last search that was stopped or killed"
        self.resume_button = Button("Resume", self.resume, tooltip=last)
        self._offer_resume()
        self.record, self.verdict = Words(), Words()
        self.robust = Robustness(self.explorer, refused=self._refuse)

    def _count(self, name: str, value: int) -> Whole:
        low, high = COUNTS[name][0], COUNTS[name][-1]
        whole(value, f"the {name}", low, high)
        return Whole(value, low, high, name)

    def _body(self) -> Part:
        save = Download("Save study", "study.json", "application/json", self._json, self.banner.show_message)
        picker = self.picker
        left = Group(
            self.mode,
            Words(value=[bold("free quantities and their bounds")], look="hint"),
            Group(*(part for bounds in self.bounds.values() for part in bounds.parts), look="bounds"),
            self.robust.asked,
            row(self.population, self.generations, self.seed),
            self.runner.buttons(self.resume_button),
            self.status,
            self.record,
            Group(self.details, look="fold", description="Details"),
            self.banner,
            row(save, Upload("Load study", self.load_json)),
        )
        chosen = picker.pick, row(picker.rule, picker.take), picker.reference.box
        right = Group(self.picture, *chosen, self.verdict, self.robust.words)
        return Group(left, right, look="beside")

    # ------------------------------------------------------------ the search

    def asked_study(self) -> Study:
        """The study that the page asks to be searched, ``ValueError`` if there is none."""
        space = {name: bounds.value for name, bounds in self.bounds.items() if bounds.free.value}
        if not space:
            raise ValueError("no quantity is free; tick one or more")
        return self.robust.within(self.page.study(self.mode.value, self.explorer.design, space, self._judgements()))

    def _asked(self) -> SessionSearch:
        """The search that the page asks for."""
        study = self.asked_study()
        return self._follow(self.page.search(replace(self.session(), study=study, front=sessions.empty_front(study))))

    def resume(self) -> None:
        """Go on with the last search that did not end, under the settings that it had; returns at once."""
        self.runner.begin(self._resumed, "This cannot be resumed")

    def _resumed(self) -> SessionSearch:
        search = self.page.resume(self.session())
        return self._follow(search, self._put_back(search.session))

    def _follow(self, search: SessionSearch, went_back: str = "") -> SessionSearch:
        """Show that a search begins, or goes on, and what went back for it."""
        self.search, self.study, self._went_back = search, search.session.study, went_back
        if self.criteria and self.criteria.given != search.session.judgements["criteria"]:
            self.study = self.study.with_weights(self.criteria.weights)
        self.resume_button.disabled = True
        return search

    def _offer_resume(self) -> None:
        self.resume_button.disabled = not self.page.can_resume()

    def _take_over(self, job: Job) -> bool:
        """Show a search that another panel began, on its page; ``False`` if it is of another study."""
        search, old = job.steps, job.owner
        if not (
            isinstance(search, SessionSearch) and isinstance(old, Runner) and self.page.searches_as(search.session)
        ):
            return False
        with job.lock:
            if job.over:
                return False
            self._follow(search, self._put_back(search.session))
            self.runner.adopt(job)
            if job.step:
                self.runner.show(job.step, last=False)
            old.leave("the search goes on in a newer panel")
        return True

    def _show_step(self, step: Step, last: bool) -> None:
        assert self.search
        study = self.study if isinstance(step.study, RobustStudy) else self.study.nominal
        front = self.found = step.front if step.study.menus or not last else surviving(step.front)
        if study != step.study:
            front = front.judged_by(study)
        if self.search.nominal and self.robust.nominal is not self.search.nominal:
            self.robust.compare(self.search.nominal, study)
        if last or not (self.runner.job and self.runner.job.stopping):  # else it says "stopping"
            self.status.say(progress_text(step, len(front), last))
            self.details.say(f"hypervolume {front.hypervolume(self.search.reference):.6g}")
        self._say("" if len(front) or not last else front.message)
        self._show_front(front)
        self.robust.words.say(*self.robust.told(front) if last else ())

    def _refuse(self, sentence: str) -> None:
        """Why what was typed cannot be; empty where it can."""
        if sentence:
            self.banner.show_message(sentence)
        else:
            self._say("")

    def _say(self, message: str) -> None:
        """Say ``message``, what went back for the search, and that it is not kept if it is not."""
        why = self.search.unkept if self.search else ""
        unkept = f"This search is not kept in a file to resume it from: {why}." if why else ""
        told = " ".join(filter(None, (self._went_back, unkept)))
        self.banner.show_message(f"{message}. {told}" if message and told else message or told)

    # ------------------------------------------------------------ the front

    def _judged(self) -> None:
        """Weigh the same designs anew."""
        if self.criteria:
            self.study = self.study.with_weights(self.criteria.weights)
        if isinstance(self.found.study, RobustStudy):
            self.robust.compare(self.robust.nominal.judged_by(self.study.nominal), self.study)
        self._show_front(self.found.judged_by(self.study))

    def _show_front(self, front: Front) -> None:
        """Nothing is told of a front that cannot be drawn."""
        with self._showing, self.held():
            self.picker.show(front)
            start, here = map(self._objectives, (self.explorer.start, self.explorer.design))
            self.picture.offer(*self.picker.offered)
            reference = self.picker.reference.point
            if isinstance(front.study, RobustStudy):
                self.picture.show(self.robust.beside(front, here, self.winner, reference), (robust_pareto,))
            else:
                shown = ShownFront(front, self.picker.selected, self.winner, start, reference=reference)
                self.picture.show(shown, (pareto,))
            self.verdict.say(*self.picker.verdict())
            self.record.say(record_text(front.record))
        self._tell_followers()

    def _objectives(self, design: Analysable) -> np.ndarray:
        analysis = design.analyse(self.study.angles)
        return np.array([measure.one(analysis) for measure in self.study.minimise])

    def _show_again(self) -> None:
        """The front that is shown, under another rule or with another design in the sliders."""
        with self._showing:
            self._show_front(self.front)

    def summary(self) -> str:
        """The front's ends and the winner."""
        choice = self.picker.choice  # a running search may just find another
        if choice.winner is None:
            return f"no front yet; free: {', '.join(map(words, self.study.free))}"
        return choice.summary()

    # ------------------------------------------------------------ the session

    def session(self) -> Session:
        """Everything on the page, to be saved."""
        settings = {name: box.value for name, box in self._settings().items()}
        return Session(self.study, self.explorer.design, self._judgements(), settings, self.front, self.decision)

    def _settings(self) -> dict[str, Input]:
        """The boxes and menus of the settings, by name."""
        boxes: dict[str, Input] = {name: getattr(self, name) for name in (*COUNTS, "mode")}
        return {**boxes, "rule": self.picker.rule}

    def _judgements(self) -> dict[str, Judgements | Judges]:
        """The judgements on the page."""
        return {name: panel.given for name, panel in self._judges.items()}

    def _json(self) -> str:
        return designs.to_json(self.session())

    def _put_back(self, session: Session) -> str:
        """Bounds and settings of a search that goes on; design, judgements and rule where nobody has changed them.

        What is not as it was on the page, in a sentence.
        """
        before = self._search_in_words()
        self._judge({name: given for name, given in session.judgements.items() if self._untouched(name)})
        chosen = self.picker.rule.value
        rule = {} if chosen == self.picker.first_rule else {"rule": chosen}
        self._set_boxes(replace(session, search={**session.search, **rule}))
        if self.explorer.design == self.explorer.start:
            self.explorer.load(session.design)
        now = self._search_in_words()
        back = [f"{name} {now[name]}, not {was}" for name, was in before.items() if now[name] != was]
        if not same_design(self.explorer.design, session.design):
            back.append("its own design, while yours stays in the sliders")
        return f"The search goes on with what it began with: {'; '.join(back)}." if back else ""

    def _untouched(self, name: str) -> bool:
        """Whether there is a panel of judgements of that name, as it began."""
        panel = self._judges.get(name)
        return panel is not None and panel.given == panel.start

    def _search_in_words(self) -> dict[str, str]:
        """What a search needs of the page, by name."""
        bounds = {words(name): bounds.words for name, bounds in self.bounds.items()}
        return {"problem": self.mode.value, **{name: str(getattr(self, name).value) for name in COUNTS}, **bounds}

    def _judge(self, judgements: Mapping[str, Judgements | Judges]) -> None:
        for name, panel in self._judges.items():
            if name in judgements:
                panel.load(judgements[name])

    def _set_boxes(self, session: Session) -> None:
        """Bounds and settings of a session."""
        for name, bounds in self.bounds.items():
            bounds.set(session.study.free.get(name))
        self.robust.tick.value = isinstance(session.study, RobustStudy)
        boxes = self._settings()
        for name, value in session.search.items():
            boxes[name].value = value

    def load(self, session: Session) -> None:
        """Show a saved study: judgements, bounds, front, and the design in the sliders.

        What cannot be judged, computed or drawn here raises ``ValueError`` or ``ArithmeticError``, and all stays as it
        was.
        """
        self.page.check(session)
        session.design.analyse()
        self._show_loaded(session)
        self._set_boxes(session)
        self.decision = session.decision
        self.status.say(f"loaded: {len(self.front)} designs on the front")

    def _show_loaded(self, session: Session) -> None:
        """Front, judgements and design of a file: all of them or none."""
        before, found, pick = self.session(), self.found, self.picker.pick.value
        try:
            self._swap(session, session.front)
            if session.judgements.keys() & self._judges.keys():
                self._judged()
            else:
                self._show_front(session.front)
            self.explorer.load(session.design)
            if self.explorer.design is not session.design:
                raise ValueError("its design cannot be computed and drawn")
        except Exception:
            self._swap(before, found)
            self._show_front(before.front)
            with self.picker.quiet:
                self.picker.pick.value = pick
            raise

    def _swap(self, session: Session, found: Front) -> None:
        """Another study, front and judgements, not shown yet."""
        with self.picker.quiet:
            self.study, self.found = session.study, found
            if isinstance(session.study, RobustStudy):
                self.robust.compare(sessions.empty_front(session.study.nominal), session.study)
            self.picker.rule.value = session.search.get("rule", self.picker.rule.value)
            self._judge(session.judgements)

    def load_json(self, file: str | bytes) -> None:
        """Show the study that a saved file holds; a file that cannot be used is refused in a sentence."""
        try:
            found = designs.read_json(file, Session, self.page.known_measures(self.session()))
            self.load(found.thing)
        except IMPOSSIBLE as refusal:
            self.banner.show_message(f"This file cannot be used: {reason(refusal)}.")
        else:
            self.banner.show_message(remarked(found))


def pareto_panel(
    explorer: Instrument,
    studies: Study | Mapping[str, Study],
    space: Free | None = None,
    free: Sequence[str] | Free | None = None,
    **options: Any,
) -> ParetoPanel:
    """A panel that searches around the design in ``explorer`` and helps to choose from the front."""
    return ParetoPanel(explorer, studies, space, free, **options)
