"""`live_pareto_panel`: everything that is possible, recomputed while a slider or a judgement moves."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..quantities import Analysable
from ..quantities.kinds import refuse_arguments
from ..search.fast_front import modelled_front, quick_front
from ..search.front import Front
from ..search.protocol import search
from ..search.robust_front import surviving
from ..study.robust import RobustStudy
from ..study.study import Study, named_studies
from ..views.front import LiveFront, live_pareto
from ..views.robust_front import robust_pareto
from .ahp import AhpPanel
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.front_picker import FrontPanel, FrontPicker, objective_texts
from .kit.inputs import Menu
from .kit.latest_only import LatestOnly
from .kit.parts import Banner, Group, Line, Part, Words, bold, row
from .kit.robust_fronts import Robustness, judged_how
from .kit.sheet import IMPOSSIBLE, reason


class LiveParetoPanel(FrontPanel):
    """The Pareto front around the design of an `Instrument`, which follows its sliders and the judgements.

    ``studies`` is a `Study`, or maps names in a menu to several.  ``space`` maps the free quantities, four at most, to
    bounds in SI; without it they are those that the first study frees.  ``criteria`` weigh the parts of objectives that
    are weighted sums, ``importance`` judges the objectives among each other.

    A change starts from the front that is shown and takes about a tenth of a second; when nothing newer has been
    asked for, the front is computed once more from nothing, so that what stays depends on the design alone.
    """

    def __init__(
        self,
        explorer: Instrument,
        studies: Study | Mapping[str, Study],
        space: Mapping[str, tuple[float, float]] | None = None,
        criteria: AhpPanel | None = None,
        importance: AhpPanel | None = None,
    ) -> None:
        refuse_arguments(LiveParetoPanel.__init__, locals())
        named = named_studies(studies, explorer.start)
        self.space = dict(next(iter(named.values())).free if space is None else space)
        self.studies = {name: study.freeing(self.space) for name, study in named.items()}
        self.explorer = explorer
        self.criteria, self.importance = criteria, importance
        self._showing = threading.RLock()
        self._worker = LatestOnly(self._compute)
        self.banner = Banner()
        self.robust = Robustness(explorer, self._changed, self.banner.show_message)
        self.menu = Menu(list(self.studies), "problem")
        self.menu.observe(lambda _: self._changed(), "value")
        self.status, self.numbers = Words(look="status"), Words()
        self._wanted = self.menu.value, self._asked()
        began = time.monotonic()
        self._mode, first = self.menu.value, quick_front(self._wanted[1])
        self._first = {self._mode: first}
        self.robust.compare(first, first.study)
        self.picture = LivePicture((live_pareto,), "Pareto front that follows the sliders", width=7.6, height=6.0)
        self.picker = FrontPicker(explorer, first, importance, self.picture, self._judged, self._with_free)
        super().__init__(self._body())
        self._tell_time(time.monotonic() - began)
        self._show(first)
        explorer.on_change(lambda _: self._changed())
        if criteria:
            criteria.on_change(self._changed)
        if importance:
            importance.on_change(self._judged)
        self._stand_in_tabs("Live front", criteria, importance)

    def _with_free(self, index: int) -> Analysable:
        """A design of the front; what is not free stays as it is in the sliders."""
        study = self.front.study.nominal.around(self.explorer.design)
        return study.design(self.front.x[index])

    def _body(self) -> Part:
        menus = [self.menu] if len(self.studies) > 1 else []
        picker = self.picker
        asked = self.robust.asked, picker.reference.box
        left = Group(*menus, picker.rule, picker.pick, row(picker.take), *asked, self.status, self.numbers)
        return Group(left, Group(self.banner, self.picture, self.robust.words), look="beside")

    # ------------------------------------------------------------ the front

    def _asked(self) -> Study:
        """The problem of the menu around the design in the sliders; its free quantities do not count."""
        first = self.studies[self.menu.value]
        study = first.around(self.explorer.design, first.x0)
        return self.robust.within(study.with_weights(self.criteria.weights) if self.criteria else study)

    def _changed(self) -> None:
        """Ask for another front, unless only free quantities have moved."""
        try:
            self._follow(self.menu.value, self._asked())
        except IMPOSSIBLE as refusal:
            self._refuse(str(refusal))

    def _follow(self, mode: str, study: Study) -> None:
        if (mode, study) == self._wanted:
            self._show(self.front)
            return
        if mode == self._mode and study.start == self.robust.nominal.study.start and not isinstance(study, RobustStudy):
            nominal = self.robust.nominal.judged_by(study)
            self._take(mode, nominal, nominal)  # the same designs weighed anew are there at once
        self._wanted = mode, study
        self._worker.ask(self._wanted)

    def _compute(self, wanted: tuple[str, Study]) -> None:
        try:
            self._compute_from_front(*wanted)
            self._compute_from_nothing(*wanted)
        except ValueError as refusal:
            self._refuse(str(refusal))
        except Exception as error:  # shown to the user: a thread has no other way to speak
            self._refuse(f"the search ended early: {reason(error)}")

    def _compute_from_front(self, mode: str, study: Study) -> None:
        if not len(self.robust.nominal):
            return
        began = time.monotonic()
        front = nominal = modelled_front(study.nominal, start=self.robust.nominal)
        if isinstance(study, RobustStudy):
            front = modelled_front(study, start=self.front if len(self.front) else nominal)
        if len(nominal):
            self._take(mode, front, nominal, time.monotonic() - began)

    def _compute_from_nothing(self, mode: str, study: Study) -> None:
        """Broken off for something newer, as long as there is a front to look at; exact parts judge what is robust."""
        began = time.monotonic()
        fronts = []
        for each in (study.nominal, study) if isinstance(study, RobustStudy) else (study,):
            for step in search(each, "fast_front"):
                if self._worker.stale and len(self.robust.nominal):
                    return
                if step.number == step.of:
                    fronts.append(step.front if each.menus else surviving(step.front))
        self._first.setdefault(mode, fronts[0])
        self._take(mode, fronts[-1], fronts[0], time.monotonic() - began)
        said = self.robust.told(fronts[-1])
        with self._showing:
            if fronts[-1] is self.front:
                self.robust.words.say(*said)

    def _take(self, mode: str, front: Front, nominal: Front, seconds: float | None = None) -> None:
        with self._showing, self.held():
            self.robust.compare(nominal, front.study)
            self._mode = mode
            self.robust.words.say()
            self._show(front)
            if seconds is not None:
                self._tell_time(seconds)
        self._tell_followers()

    def _tell_time(self, seconds: float) -> None:
        self.status.say(
            f"{self.picker.choice.count} on the front, found in {1000 * seconds:.0f} ms, {judged_how(self.front)}"
            f"each judged on {self.front.study.angles} angles"
        )

    def settle(self) -> None:
        """Wait until the front belongs to the design in the sliders."""
        self._worker.wait()

    # ------------------------------------------------------------ what is shown

    def _judged(self) -> None:
        """Another winner of the same front."""
        self._show(self.front)
        self._tell_followers()

    def _show(self, front: Front) -> None:
        with self._showing, self.held():
            self.picker.show(front)
            robust = isinstance(front.study, RobustStudy)
            if not len(self.robust.nominal if robust else front):
                self._refuse(front.message)
                return
            self.refuse_picture("")
            here = self._here()
            self.numbers.say(*self.picker.verdict(), self._in_sliders(here))
            self.picture.offer(*self.picker.offered)
            reference = self.picker.reference.point
            if robust:
                shown: object = self.robust.beside(front, here, self.winner, reference)
            else:
                shown = LiveFront(front, self._before(), here, self.winner, reference)
            self.picture.show(shown, (robust_pareto if robust else live_pareto,))

    def _refuse(self, sentence: str) -> None:
        """The sentence in place of the picture."""
        self.robust.words.say()
        self.refuse_picture(f"There is no front: {sentence}.")

    def _here(self) -> np.ndarray:
        """Objectives of the design in the sliders, ``(k,)``."""
        study = self.front.study
        analysis = self.explorer.design.analyse(study.angles)
        return np.array([measure.one(analysis) for measure in study.minimise])

    def _before(self) -> Front:
        """The front that the panel began with, weighed as the one that is shown."""
        first = self._first.get(self._mode, self.front)
        return first.judged_by(first.study.with_weights(self.criteria.weights)) if self.criteria else first

    def _in_sliders(self, here: np.ndarray) -> Line:
        """The design in the sliders, in words."""
        f = self.front.f
        better = int(((f <= here).all(-1) & (f < here).any(-1)).sum())
        count = f"{better or 'none'} of the front {'are' if better > 1 else 'is'}"
        goals = ", ".join(objective_texts(self.front.study, here))
        return [bold("in the sliders"), f": {goals}; {count} better in every wish"]

    def summary(self) -> str:
        """The front's size and its winner."""
        return self.picker.choice.summary()


def live_pareto_panel(
    explorer: Instrument,
    studies: Study | Mapping[str, Study],
    space: Mapping[str, tuple[float, float]] | None = None,
    **options: Any,
) -> LiveParetoPanel:
    """A panel whose Pareto front follows the sliders of ``explorer`` (see `LiveParetoPanel`)."""
    return LiveParetoPanel(explorer, studies, space, **options)
