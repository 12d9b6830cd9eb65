"""`optimise_panel`: from the design in the sliders to a better one, in the background, and what limits it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..quantities import Analysable, Measure, words
from ..quantities.kinds import refuse_arguments, shown
from ..quantities.types import Array
from ..search.minimise import METHODS
from ..search.minimum import Minimum
from ..search.protocol import Evaluated, Step, search
from ..search.rates import told_of_limits
from ..study.study import Study, named_studies
from ..views.progress import ShownLooks, best_so_far
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.inputs import Menu, Whole
from .kit.parts import Button, Part, Table, Words, bold
from .kit.resuming import Begun, Resuming
from .kit.runner import JobPanel, Runner


class OptimisePanel(JobPanel):
    """*Optimise from here*: `minimise` from the design of an `Instrument`, whose sliders then show what was found.

    ``studies`` is a `Study`, or maps names in a menu to several; there is a menu for the ``methods``, too, if there
    are several.  ``minimum`` is the last result, ``None`` if the search was stopped: the best so far is then in the
    sliders.  *Undo* loads the design from which the search began, *Resume* goes on with one that was stopped or killed:
    what had ended of it is kept in a file.
    """

    def __init__(
        self, explorer: Instrument, studies: Study | Mapping[str, Study], methods: Sequence[str] = ("slsqp",)
    ) -> None:
        refuse_arguments(OptimisePanel.__init__, locals())
        if not len(methods) or any(method not in METHODS for method in methods):
            raise ValueError(f"the methods are {shown(methods)}; there are {', '.join(map(repr, METHODS))}")
        self.explorer, self.studies = explorer, named_studies(studies, explorer.start)
        self.problem, self.method = Menu(list(self.studies), "problem"), Menu(list(methods), "method")
        self.starts = Whole(1, 1, 100, "restarts")
        boxes = {"problem": self.problem, "method": self.method, "starts": self.starts}
        self.resuming = resuming = Resuming("optimise", explorer, self.studies, boxes, self._begun)
        page = self.studies
        self.runner = Runner("Optimise from here", resuming.begin, self._show, page, ended=resuming.offer)
        resuming.runner = self.runner
        self.method.observe(lambda _: self._fit_starts(), "value")
        self._fit_starts()
        self.study = self._study()
        self.minimum: Minimum | None = None
        self.before: Any = None
        self.back = Button("Undo", lambda: self.explorer.load(self.before), disabled=True)
        self.verdict, self.options = Words(), Table()
        self._lines: tuple[str, ...] = ()
        self._seen: list[Evaluated] = []
        self.picture = LivePicture((best_so_far,), "The search", width=6.6, height=3.9)
        self.picture.show(ShownLooks(self._measure, ()))
        super().__init__(self._beside_picture(*self._questions()))
        explorer.add_tab("Optimise", self)

    def _questions(self) -> list[Part]:
        runner = self.runner
        asked = [menu for menu in (self.problem, self.method) if len(menu.options) > 1]
        return [
            *asked,
            self.starts,
            runner.buttons(self.resuming.button, self.back),
            runner.status,
            runner.banner,
            self.verdict,
            self.options,
        ]

    def _fit_starts(self) -> None:
        """Other methods than SLSQP have no use for several starts."""
        self.starts.disabled = self.method.value != "slsqp"

    def _study(self) -> Study:
        return self.studies[self.problem.value].around(self.explorer.design)

    def _begun(self, design: Analysable) -> Begun:
        study = self.studies[self.problem.value].around(design)
        return partial(self._steps, study, self.explorer.design, self.method.value, self.starts.value)

    def _steps(self, study: Study, before: object, method: str, starts: int, path: Path | None) -> Iterator[Step]:
        self.study, self.before, self.back.disabled = study, before, False
        self.minimum, self._seen = None, []
        for step in search(study, method, starts=starts, checkpoint=path):
            if not step.message:
                self._seen.append(step.summary)
            yield step
        self.minimum = step.best

    def _show(self, step: Step, last: bool) -> None:
        best = f", best so far {self._text(step.best.f)}" if step.best else ""
        self.runner.status.say(f"{step.evaluated} designs evaluated{best}")
        self.resuming.tell()
        self.picture.show(ShownLooks(self._measure, tuple(self._seen)))
        if last:
            stopped = f"The search was stopped after {step.evaluated} designs."
            self._finish(step.best.x if step.best else None, self.minimum.message if self.minimum else stopped)

    def _finish(self, x: Array | None, why: str) -> None:
        """Say what was found, and show it."""
        if x is None:
            self._lines = (why, "None of them keeps every limit; the design in the sliders stays.")
        else:
            first, last = self.study.evaluate([self.study.x0, x]).f[:, 0]
            self._lines = (f"{self._measure.name}: {self._text(first)} → {self._text(last)}", why)
            self.explorer.load(self.study.design(x))
        result, reached = self._lines
        rates = self.minimum.rates if self.minimum and self.minimum.feasible else {}
        self.verdict.say(bold(result), reached, *told_of_limits(self.study, rates))
        options = sorted(self.minimum.options, key=lambda each: (not each.feasible, each.f)) if self.minimum else []
        head = (words(", ".join(options[0].options)), self._measure.name) if options else ()
        self.options.put(head, [(each.name, each.text) for each in options])

    @property
    def _measure(self) -> Measure:
        return self.study.minimise[0]

    def _text(self, f: float) -> str:
        return self._measure.text(self._measure.sign * f) if np.isfinite(f) else "none"

    def summary(self) -> str:
        """What was asked, and what was found."""
        lines = self._lines or ("not run yet",)
        return "\n".join([f"problem: {self.problem.value}, method: {self.method.value}", *lines])


def optimise_panel(
    explorer: Instrument, studies: Study | Mapping[str, Study], methods: Sequence[str] = ("slsqp",)
) -> OptimisePanel:
    """A panel that optimises from the design in ``explorer`` (see `OptimisePanel`)."""
    return OptimisePanel(explorer, studies, methods)
