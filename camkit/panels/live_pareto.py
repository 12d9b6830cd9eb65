"""`live_pareto_panel`: everything that is possible, recomputed while a slider or a judgement moves."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

import ipywidgets as w
import numpy as np

from ..decision import CHOOSERS
from ..quantities import Paths, Quantity, value_of, with_quantities, words
from ..quantities.kinds import refuse_arguments, refuse_empty
from ..quantities.markup import html, joined
from ..search.fast_front import quick_front
from ..search.front import Front
from ..search.protocol import search
from ..study.study import Study, made_study, refuse_bounds
from ..views.front import LiveFront, live_pareto, shown_objectives
from .ahp import AhpPanel
from .explore import Explorer
from .kit.controls import banner, show_message
from .kit.latest_only import LatestOnly
from .kit.panel import IMPOSSIBLE, Panel
from .kit.picture import LivePicture

MakeStudy = Callable[..., Study]


class LiveParetoPanel(Panel):
    """The Pareto front around the design of an `Explorer`, which follows its sliders and the judgements.

    ``studies`` maps a name in the menu to a function ``make(start, reference=, space=)`` that gives a `Study`; it
    takes ``weights=`` as well if there are ``criteria`` to judge.  ``space`` maps the free quantities, four at most, to
    bounds in SI.  ``importance`` judges the objectives among each other.

    A change starts from the front that is shown and takes about a tenth of a second; when nothing newer has been
    asked for, the front is computed once more from nothing, so that what stays depends on the design alone.
    """

    def __init__(
        self,
        explorer: Explorer,
        studies: Mapping[str, MakeStudy],
        space: Mapping[str, tuple[float, float]],
        criteria: AhpPanel | None = None,
        importance: AhpPanel | None = None,
    ) -> None:
        refuse_arguments(LiveParetoPanel.__init__, locals())
        refuse_empty(studies, "studies")
        refuse_bounds(Paths(explorer.start, space, Quantity).declared, space)
        self.explorer, self.studies, self.space = explorer, dict(studies), dict(space)
        self.criteria, self.importance = criteria, importance
        self.winner: int | None = None
        self._followers: list[Callable[[], None]] = []
        self._lock = threading.RLock()
        self._silent = False
        self._worker = LatestOnly(self._compute)
        self._make_widgets()
        self._wanted = self.menu.value, self._asked()
        began = time.monotonic()
        self._mode, self.front = self.menu.value, quick_front(self._wanted[1])
        self._first = {self._mode: self.front}
        self.picture = LivePicture((live_pareto,), "Pareto front that follows the sliders", width=7.6, height=4.8)
        self.picture.figure.set_layout_engine("constrained", w_pad=0.15)  # numbers on the axes may get longer
        self.picture.widget.on_click(self._clicked)
        super().__init__([self._body()])
        self._tell_time(time.monotonic() - began)
        self._show()
        explorer.on_change(lambda _: self._changed())
        if criteria:
            criteria.on_change(self._changed)
        if importance:
            importance.on_change(self._judged)

    def _make_widgets(self) -> None:
        wide, style = w.Layout(width="100%", max_width="430px"), {"description_width": "78px"}
        self.menu = w.Dropdown(options=list(self.studies), description="problem", layout=wide, style=style)
        self.rule = w.Dropdown(options=list(CHOOSERS), description="choose by", layout=wide, style=style)
        self.pick = w.IntSlider(
            0, 0, 0, description="design", layout=wide, style=style, tooltip="loads a design of the front"
        )
        fits = w.Layout(width="auto")
        self.take = w.Button(description="Load the winner", icon="star", layout=fits)
        self.status, self.verdict, self._banner = w.HTML(), w.HTML(), banner()
        self.status.add_class("camkit-status")
        self.menu.observe(lambda _: self._changed(), "value")
        self.rule.observe(lambda _: self._judged(), "value")
        self.pick.observe(lambda change: None if self._silent else self.select(change.new), "value")
        self.take.on_click(lambda _: self.select(self.winner))

    def _body(self) -> w.Widget:
        menus = [self.menu] if len(self.studies) > 1 else []
        left = [*menus, self.rule, self.pick, w.HBox([self.take]), self.status, self.verdict]
        return w.HBox(
            [
                w.VBox(left, layout=w.Layout(flex="1 1 340px", max_width="560px")),
                w.VBox([self._banner, self.picture.widget], layout=w.Layout(flex="1 1 480px", max_width="760px")),
            ],
            layout=w.Layout(flex_flow="row wrap"),
        )

    # ------------------------------------------------------------ the front

    def _asked(self) -> Study:
        """The problem of the menu around the design in the sliders; its free quantities do not count."""
        first = self.explorer.start
        start = with_quantities(self.explorer.design, {name: value_of(first, name) for name in self.space})
        weights = {"weights": self.criteria.weights} if self.criteria else {}
        return made_study(self.studies[self.menu.value], start, reference=first, space=self.space, **weights)

    def _changed(self) -> None:
        """Ask for another front, unless only free quantities have moved."""
        try:
            self._follow(self.menu.value, self._asked())
        except IMPOSSIBLE as refusal:
            self._refuse(str(refusal))

    def _follow(self, mode: str, study: Study) -> None:
        if (mode, study) == self._wanted:
            self._show()
            return
        if mode == self._mode and study.start == self.front.study.start:
            self._take(mode, self.front.judged_by(study))  # the same designs weighed anew are there at once
        self._wanted = mode, study
        self._worker.ask(self._wanted)

    def _compute(self, wanted: tuple[str, Study]) -> None:
        try:
            self._compute_from_front(*wanted)
            self._compute_from_nothing(*wanted)
        except ValueError as refusal:
            self._refuse(str(refusal))
        except Exception as error:  # shown to the user: a thread has no other way to speak
            self._refuse(f"the search ended early: {error}")

    def _compute_from_front(self, mode: str, study: Study) -> None:
        began = time.monotonic()
        front = quick_front(study, start=self.front) if len(self.front) else self.front
        if len(front):
            self._take(mode, front, time.monotonic() - began)

    def _compute_from_nothing(self, mode: str, study: Study) -> None:
        """Broken off for something newer, as long as there is a front to look at."""
        began = time.monotonic()
        for step in search(study, "fast_front"):
            if self._worker.stale and len(self.front):
                return
            if step.number == step.of:
                self._first.setdefault(mode, step.front)
                self._take(mode, step.front, time.monotonic() - began)

    def _take(self, mode: str, front: Front, seconds: float | None = None) -> None:
        with self._lock:
            self._mode, self.front = mode, front
            if seconds is not None:
                self._tell_time(seconds)
            self._show()
        self._tell_followers()

    def _tell_time(self, seconds: float) -> None:
        self.status.value = (
            f"{self._count()} on the front, found in {1000 * seconds:.0f} ms, "
            f"each judged on {self.front.study.angles} angles"
        )

    def settle(self) -> None:
        """Wait until the front belongs to the design in the sliders."""
        self._worker.wait()

    def on_front(self, act: Callable[[], None]) -> None:
        """Call ``act()`` after each new front is shown, from whichever thread shows it."""
        self._followers.append(act)

    def _tell_followers(self) -> None:
        for act in self._followers:
            act()

    # ------------------------------------------------------------ what is shown

    def _judged(self) -> None:
        """Another winner of the same front."""
        self._show()
        self._tell_followers()

    def _show(self) -> None:
        with self._lock:
            front, weights = self.front, self.importance.weights if self.importance else None
            self.winner = CHOOSERS[self.rule.value](front, weights) if len(front) else None
            self.take.disabled = self.pick.disabled = self.winner is None
            if not len(front):
                self._refuse(front.message)
                return
            show_message(self._banner, "")
            self.picture.widget.layout.display = ""
            self._fit_slider()
            here = self._here()
            self.verdict.value = joined(self._lines(here), "<br>")
            self.picture.show(LiveFront(front, self._before(), here, self.winner))

    def _refuse(self, sentence: str) -> None:
        """The sentence in place of the picture."""
        show_message(self._banner, f"There is no front: {sentence}.")
        self.picture.widget.layout.display = "none"
        self.verdict.value = ""

    def _here(self) -> np.ndarray:
        """Objectives of the design in the sliders, ``(k,)``."""
        study = self.front.study
        analysis = self.explorer.design.analyse(study.angles)
        return np.array([float(measure(analysis)) for measure in study.minimise])

    def _before(self) -> Front:
        """The front that the panel began with, weighed as the one that is shown."""
        first = self._first.get(self._mode, self.front)
        return first.judged_by(first.study.weighing(self.criteria.weights)) if self.criteria else first

    def _fit_slider(self) -> None:
        """The slider at the design that is in the explorer's, if it is one of the front."""
        now = self.front.study.x_of(self.explorer.design)
        same = np.flatnonzero(np.isclose(self.front.x, now, rtol=1e-9, atol=0).all(-1))
        self._silent = True
        try:
            self.pick.max = len(self.front) - 1
            if len(same):
                self.pick.value = int(same[0])
        finally:
            self._silent = False

    def _lines(self, here: np.ndarray) -> list[str]:
        """The winner and the design in the sliders, in words."""
        front, winner = self.front, self.winner
        free = zip(front.study.free, front.x[winner], strict=True)
        better = int(((front.f <= here).all(-1) & (front.f < here).any(-1)).sum())
        return [
            html("<b>winner: design {}</b> of 0..{}: {}", winner, len(front) - 1, self._goals(front.f[winner])),
            ", ".join(f"{words(name)} {front.study.declared[name].text(value)}" for name, value in free),
            html(
                "<b>in the sliders</b>: {}; {} better in every wish",
                self._goals(here),
                f"{better or 'none'} of the front {'are' if better > 1 else 'is'}",
            ),
        ]

    def _goals(self, f: np.ndarray) -> str:
        return ", ".join(f"{m.name} {m.text(m.sign * v)}" for m, v in zip(self.front.study.minimise, f, strict=True))

    def select(self, index: int | None) -> None:
        """Load one design of the front into the sliders; what is not free stays as it is there."""
        front = self.front
        if index is None or index >= len(front):
            return
        free = dict(zip(front.study.free, map(float, front.x[index]), strict=True))
        self.explorer.load(with_quantities(self.explorer.design, free))

    def _clicked(self, x: float, y: float) -> None:
        width, height = self.picture.figure.canvas.get_width_height()
        points = self.picture.axes[0].transData.transform(shown_objectives(self.front).T)
        if len(points):
            self.select(int(np.argmin(np.hypot(*(points - (x * width, (1 - y) * height)).T))))

    def summary(self) -> str:
        """The front's size and its winner."""
        if self.winner is None:
            return f"no front: {self.front.message}"
        f, study = self.front.f[self.winner], self.front.study
        goals = (f"{m.name}: {m.text(m.sign * v)}" for m, v in zip(study.minimise, f, strict=True))
        return "\n".join([f"{self._count()} on the front; winner by {self.rule.value}:", *goals])

    def _count(self) -> str:
        return "1 design" if len(self.front) == 1 else f"{len(self.front)} designs"

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        self.settle()
        return super()._repr_mimebundle_(**kwargs)


def live_pareto_panel(
    explorer: Explorer, studies: Mapping[str, MakeStudy], space: Mapping[str, tuple[float, float]], **options: Any
) -> LiveParetoPanel:
    """A panel whose Pareto front follows the sliders of ``explorer`` (see `LiveParetoPanel`)."""
    return LiveParetoPanel(explorer, studies, space, **options)
