"""`cycle_time_panel`: the shortest interval in which the optimum still keeps a limit, in the background."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from ..quantities import Analysable, Measure, Quantity
from ..quantities.kinds import a_number, refuse_arguments
from ..search.cycle_time import INTERVALS, IntervalStep
from ..search.protocol import Step, search
from ..study.study import Study, named_studies
from ..units import deg, in_unit
from ..views.progress import ShownIntervals, intervals_tried
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.inputs import Input, Menu, Number
from .kit.parts import Button, Part, Words, bold
from .kit.resuming import Begun, Resuming
from .kit.runner import JobPanel, Runner

TOLERANCE = 0.1 * deg
"""To which the interval is found."""


class CycleTimePanel(JobPanel):
    """How short the intervals may be for the optimum of a study to keep a limit, and what that gains in output.

    ``studies`` is a `Study`, or maps names in a menu to several, searched around the design of an `Instrument`; the
    objective is limited to ``limit``.  ``intervals`` between ``shortest`` and ``longest`` (rad) are tried, each search
    starting where the last one ended; gains count from the longest.  ``step`` holds the best so far, also after Stop;
    *Resume* goes on with a search that was stopped or killed.
    """

    def __init__(
        self,
        explorer: Instrument,
        studies: Study | Mapping[str, Study],
        limit: float,
        shortest: float,
        longest: float,
        intervals: Sequence[str] = INTERVALS,
    ) -> None:
        refuse_arguments(CycleTimePanel.__init__, locals())
        a_number(limit, "the limit", "be a finite number above 0", lambda most: most > 0)
        self.explorer, self.studies = explorer, named_studies(studies, explorer.start)
        self.intervals = tuple(intervals)
        self.problem = Menu(list(self.studies), "problem")
        self.measure: Measure = self._study().minimise[0]
        self._search(self._study(), limit, shortest, longest)  # refuses at once what cannot be searched
        self._make_runner()
        self.limit = self._limit_knob(limit)
        self.shortest = self._interval("phi_min", "shortest", shortest)
        self.longest = self._interval("phi_max", "longest", longest)
        self._boxes |= {
            "problem": self.problem,
            "limit": self.limit,
            "shortest": self.shortest,
            "longest": self.longest,
        }
        self.steps: list[IntervalStep] = []
        self.take = Button("Load the design", self.load, disabled=True)
        self.verdict = Words()
        self.picture = LivePicture((intervals_tried,), "Intervals tried", width=6.6, height=3.9)
        self.picture.show(ShownIntervals(self.measure, limit, ()))
        super().__init__(self._beside_picture(*self._questions()))
        explorer.add_tab("Cycle time", self)

    def _make_runner(self) -> None:
        self._boxes: dict[str, Input] = {}
        self.resuming = resuming = Resuming("cycle", self.explorer, self.studies, self._boxes, self._begun)
        page = self.studies
        self.runner = Runner("Shorten the cycle", resuming.begin, self._show_step, page, ended=resuming.offer)
        resuming.runner = self.runner

    def _limit_knob(self, limit: float) -> Number:
        unit = self.measure.unit
        shown = in_unit(limit, unit)
        declared = Quantity("max", shown, 0, 2 * shown, unit, f"largest {self.measure.name} that is allowed")
        return Number("limit", declared, limit, refused=self.runner.banner.show_message)

    def _interval(self, symbol: str, name: str, value: float) -> Number:
        declared = Quantity(symbol, 90, 10, 170, "deg", f"{name} interval that is tried")
        return Number(f"{name}_interval", declared, value, refused=self.runner.banner.show_message)

    def _questions(self) -> list[Part]:
        runner = self.runner
        problem, knobs = [self.problem] if len(self.studies) > 1 else [], (self.limit, self.longest, self.shortest)
        return [
            *problem,
            *knobs,
            runner.buttons(self.resuming.button, self.take),
            runner.status,
            runner.banner,
            self.verdict,
        ]

    def _study(self) -> Study:
        return self.studies[self.problem.value].around(self.explorer.design)

    @property
    def step(self) -> IntervalStep | None:
        """Where the search stands."""
        return self.steps[-1] if self.steps else None

    def load(self) -> None:
        """Put the design with the shortest interval so far into the sliders."""
        if self.step and self.step.best:
            self.explorer.load(self.step.best.design)

    def _begun(self, design: Analysable) -> Begun:
        study = self.studies[self.problem.value].around(design)
        asked = self.limit.value, self.shortest.value, self.longest.value
        self._search(study, *asked)
        return partial(self._steps, study, *asked)

    def _search(self, study: Study, limit: float, *ends: float, path: Path | None = None) -> Iterator[Step]:
        """Refuses at once what cannot be searched."""
        names = ("limit", "shortest", "longest")
        asked: dict[str, Any] = dict(zip(names, (limit, *ends), strict=True))
        return search(study, "cycle_time", intervals=self.intervals, tolerance=TOLERANCE, checkpoint=path, **asked)

    def _steps(self, study: Study, limit: float, shortest: float, longest: float, path: Path | None) -> Iterator[Step]:
        self.measure, self._tried_limit, self.steps = study.minimise[0], limit, []
        self.take.disabled = True
        self.verdict.say()
        for step in self._search(study, limit, shortest, longest, path=path):
            if isinstance(step, IntervalStep):
                self._show(step)
            yield step

    def _show(self, step: IntervalStep) -> None:
        self.steps.append(step)
        with self.held():
            self.take.disabled = step.best is None
            self.verdict.say(bold(step.message), step.best.message if step.best else step.optimum.message)
            self.picture.show(ShownIntervals(self.measure, self._tried_limit, tuple(self.steps)))

    def _show_step(self, step: Step, last: bool) -> None:
        stopped = " (stopped)" if last and not (self.runner.job and self.runner.job.ended) else ""
        self.resuming.tell()
        self.runner.status.say(f"{step.number} intervals tried, {step.evaluated} designs evaluated{stopped}")

    def summary(self) -> str:
        """What was asked, and what was found."""
        return f"problem: {self.problem.value}\n{self.step.message if self.step else 'not run yet'}"


def cycle_time_panel(
    explorer: Instrument,
    studies: Study | Mapping[str, Study],
    limit: float,
    shortest: float,
    longest: float,
    intervals: Sequence[str] = INTERVALS,
) -> CycleTimePanel:
    """A panel that finds how short the intervals of the design in ``explorer`` may be (see `CycleTimePanel`)."""
    return CycleTimePanel(explorer, studies, limit, shortest, longest, intervals)
