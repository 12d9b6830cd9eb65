"""`contour_panel`: the objective of a study over its two free quantities, and its optimum while weights move."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..quantities import Measure, Quantity, label, with_quantities, words
from ..quantities.kinds import a_number, refuse_arguments
from ..quantities.types import Array
from ..study.design_map import DesignMap
from ..study.study import Study, named_studies
from ..study.weighted import WeightedSum
from ..units import factor
from ..views.design_map import ShownPlane, objective_plane
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.inputs import Menu, Number
from .kit.latest_only import Debounced
from .kit.parts import Banner, Button, Group, Part, Words, bold, row
from .kit.sheet import IMPOSSIBLE, Panel

QUIET = 0.25
"""Seconds after the last move until the optimum is looked for."""


def optimum(plane: DesignMap) -> np.ndarray | None:
    """Free values of the best design that keeps every limit, or ``None``.

    The best of the plane and of its four quarters: the objective may have several valleys.
    """
    quarters = _quarters(plane.study) if plane.evaluation.feasible.any() else []
    ends = [plane.best, *(DesignMap(quarter).best for quarter in quarters)]
    kept = np.array([end for end in ends if np.isfinite(end).all()])
    return kept[np.argmin(plane.study.evaluate(kept).f[:, 0])] if len(kept) else None


def _quarters(study: Study) -> list[Study]:
    """The study in each quarter of its bounds."""
    low, high = study.bounds
    middle = (low + high) / 2
    corners = [(x, y) for x in (low, middle) for y in (low, middle)]
    boxes = [np.array([[x[0], y[1]], [x[0], y[1]] + (high - low) / 2]) for x, y in corners]
    return [study.replace(free=dict(zip(study.free, box.T, strict=True)), start=study.design(box[0])) for box in boxes]


class ContourPanel(Panel):
    """The objective over two quantities of the design of an `Instrument`, where limits are missed, and the optimum.

    ``studies`` is a `Study` with two free quantities, or maps names in a menu to several; ``weights`` names the parts
    of the weighted objective, a slider each (they are shared out so as to add to 1).  The best design of the grid is
    marked at once, the optimum itself a moment after the last move.  A click loads the design under it.
    """

    def __init__(
        self,
        explorer: Instrument,
        studies: Study | Mapping[str, Study],
        weights: Mapping[str, float],
        steps: int = 41,
    ) -> None:
        refuse_arguments(ContourPanel.__init__, locals())
        self.explorer, self.studies, self.steps = explorer, named_studies(studies, explorer.start), steps
        self.menu = Menu(list(self.studies), "problem", visible=len(self.studies) > 1)
        self.menu.observe(lambda _: self._changed(), "value")
        self.verdict, self.banner = Words(), Banner()
        self.knobs = [self._knob(i, *item) for i, item in enumerate(weights.items(), start=1)]
        self.plane = DesignMap(self.study, n=steps)
        self.optimum: np.ndarray | None = None
        self._key: Any = None
        self._searched = False
        self.later = Debounced(self._catch_up, QUIET)
        self.take = Button("Load the optimum", lambda: self.load(np.asarray(self.optimum)), disabled=True)
        self.picture = LivePicture((objective_plane,), "Objective over two quantities", width=7.4, height=6.6)
        self.picture.on_click(self.clicked)
        super().__init__(self._body())
        self._changed()
        self.settle()
        explorer.on_change(lambda _: self.later.ask())  # the sliders' own pictures come first
        explorer.add_tab("Map", self)

    def _knob(self, i: int, name: str, value: float) -> Number:
        a_number(value, f"the weight of the {words(name)}", "be a finite number of at least 0", lambda w: w >= 0)
        declared = Quantity(f"W_{i}", value, 0, max(1.0, value), "", f"weight of the {words(name)}", at_least=0)
        return Number(name, declared, value, self._changed, self.banner.show_message)

    def _body(self) -> Part:
        left = Group(self.menu, *self.knobs, row(self.take), self.banner, self.verdict)
        return Group(left, self.picture, look="beside")

    @property
    def weights(self) -> tuple[float, ...]:
        """The weights, as shares of their sum."""
        values = [knob.value for knob in self.knobs]
        if not sum(values) > 0:
            raise ValueError("all weights are 0; at least one must be above 0")
        return tuple(value / sum(values) for value in values)

    @property
    def study(self) -> Study:
        """The problem of the menu under these weights, around the design in the sliders but for what is free."""
        first = self.studies[self.menu.value]
        return first.around(self.explorer.design, first.x0).with_weights(self.weights)

    def _changed(self) -> None:
        """Another problem or other weights: shown at once, the optimum a moment later."""
        self._take_up()
        self.later.ask()

    def _take_up(self) -> None:
        """Another plane, unless only the free quantities of the design moved."""
        try:
            study = self.study
            key = self.menu.value, self.weights, study.start
            plane = self.plane if key == self._key else DesignMap(study, n=self.steps)
            _ = plane.evaluation  # now, and not while it is drawn
        except IMPOSSIBLE as refusal:
            self.banner.show_message(f"This cannot be surveyed: {refusal}.")
            return
        last = self._key, self.plane, self.optimum, self._searched
        if key != self._key:
            self._key, self.plane, self.optimum, self._searched = key, plane, None, False
        try:
            self._show()
        except IMPOSSIBLE as refusal:
            self._key, self.plane, self.optimum, self._searched = last
            self.banner.show_message(f"This cannot be surveyed: {refusal}.")
        else:
            self.banner.show_message("")

    def settle(self) -> None:
        """Catch up with the design in the sliders, and look for the optimum if that is still to be done."""
        self.later.settle()

    def _catch_up(self) -> None:
        self._take_up()
        self._search()

    def _search(self) -> None:
        plane = self.plane
        if not self._searched:
            try:
                best = optimum(plane)
            except IMPOSSIBLE as refusal:
                self.banner.show_message(f"The optimum cannot be found: {refusal}.")
                return
            if plane is self.plane:  # nobody has moved anything since
                self.optimum, self._searched = best, True
                self._show()

    def _show(self) -> None:
        here = self.plane.study.x_of(self.explorer.design)
        first, *rest = self._lines()
        with self.held():
            self.picture.show(ShownPlane(self.plane, here, self.optimum if self._searched else self.plane.best_on_grid))
            self.take.disabled = self.optimum is None
            self.verdict.say(bold(first), *rest)

    def _lines(self) -> list[str]:
        """The optimum in words: free quantities, parts of the objective, limits."""
        if not self._searched:
            return ["looking for the optimum"]
        best, plane = self.optimum, self.plane  # another thread may take up the next design meanwhile
        if best is None:
            return ["no design between the bounds keeps every limit"]
        study = plane.study
        analysis = study.design(best).analyse(study.angles)
        free = zip(study.free, plane.declared, best, strict=True)
        where = ", ".join(f"{label(n, q)} {v / q.factor:.4g} {q.unit}".rstrip() for n, q, v in free)
        objective = study.minimise[0]
        parts = objective.parts if isinstance(objective, WeightedSum) else (objective,)
        told = [f"{m.name}: {_text(m, analysis)}" for m in (*parts, *(m for m, _, _ in study.limits))]
        return [f"optimum: {where}", *told]

    def load(self, x: Array) -> None:
        """Put free values into the sliders."""
        free = dict(zip(self.plane.study.free, map(float, x), strict=True))
        self.explorer.load(with_quantities(self.plane.study.around(self.explorer.design).start, free))

    def clicked(self, view: int, at: Array, pixel: Array) -> None:
        """Load the design at a place of the picture, unless it lies beyond the bounds."""
        low, high = self.plane.study.bounds
        x = at * np.array([factor(q.unit) for q in self.plane.declared])
        if (low <= x).all() and (x <= high).all():
            self.load(x)

    def summary(self) -> str:
        """The problem, its weights and its optimum."""
        problem, taken, _ = self._key
        weights = ", ".join(f"W_{i} {weight:.4g}" for i, weight in enumerate(taken, start=1))
        return "\n".join([f"{problem}: {weights}", *self._lines()])


def _text(measure: Measure, analysis: object) -> str:
    return measure.text(float(measure.sign * measure(analysis)))


def contour_panel(
    explorer: Instrument, studies: Study | Mapping[str, Study], weights: Mapping[str, float], **options: Any
) -> ContourPanel:
    """A panel that shows an objective over two quantities of the design in ``explorer`` (see `ContourPanel`)."""
    return ContourPanel(explorer, studies, weights, **options)
