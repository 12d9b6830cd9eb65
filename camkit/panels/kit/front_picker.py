"""The choice of one design from a front: by a rule, by hand, or as it stands in an explorer's sliders.

`FrontChoice` is the choice, without a page; `FrontPicker` has the parts to choose with, without a layout;
`FrontPanel` is a panel around them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...decision import CHOOSERS
from ...files import Decision
from ...quantities import Analysable, label, quantities_of, value_of
from ...quantities.types import Array
from ...search.front import Front
from ...search.rates import told_on_front
from ...study.study import Study
from ...views.front import Judged, shown_objectives
from .drawn import LivePicture, nearest
from .inputs import Menu, Whole
from .parts import Button, Line, bold
from .quiet import Quiet
from .reference import ReferencePoint
from .sheet import Panel, Sheet

if TYPE_CHECKING:
    from ..ahp import AhpPanel
    from ..instrument import Instrument


def objective_texts(study: Study, f: Array, between: str = " ") -> list[str]:
    """A design's objectives ``f`` by name, with their units."""
    return [f"{m.name}{between}{m.text(m.sign * v)}" for m, v in zip(study.minimise, f, strict=True)]


def costs(front: Front, places: Iterable[int]) -> list[str]:
    """What one objective costs the other at some designs of a front, where that is known."""
    told = {i: told_on_front(front.study.minimise, front.rates(i)) for i in places}
    return [f"At design {i}: {sentence}" for i, sentence in told.items() if sentence]


def places_on(front: Judged, design: Analysable) -> np.ndarray:
    """Where a design stands on a front; nowhere if it is not of it."""
    now = front.study.x_of(design)
    return np.flatnonzero(np.isclose(front.x, now, rtol=1e-9, atol=0).all(-1))


def place_on(front: Judged, design: Analysable) -> int | None:
    """The first of the places where a design stands on a front."""
    return next(map(int, places_on(front, design)), None)


def designs_on(front: Front, design: Callable[[int], Any], now: Any) -> tuple[Array, Array]:
    """Points of a front as they are read ``(p, 2)``, and the values of all quantities there ``(p, q)``.

    The quantities are those of the design ``now`` in the sliders, in their order; ``design(0)`` has those that are not
    free.  Where menus are free there are none: designs with other options have other quantities.
    """
    paths = list(quantities_of(now))
    if front.study.menus:
        return np.zeros((0, 2)), np.zeros((0, len(paths)))
    picked = design(0) if len(front) else now
    of = {path: picked if path in quantities_of(picked) else now for path in paths}
    values = np.tile([float(value_of(there, path)) for path, there in of.items()], (len(front), 1))
    for path, x in zip(front.study.free, front.x.T, strict=True):
        if path in of:
            values[:, paths.index(path)] = x
    return shown_objectives(front).T, values


@dataclass(frozen=True)
class FrontChoice:
    """The winner of a front by one of `CHOOSERS`, under weights of the objectives (``None``: all count alike)."""

    front: Front
    rule: str = next(iter(CHOOSERS))
    weights: np.ndarray | None = None

    @cached_property
    def winner(self) -> int | None:
        """Which design; ``None`` if there is none."""
        return CHOOSERS[self.rule](self.front, self.weights) if len(self.front) else None

    def verdict(self) -> list[Line]:
        """The winner in words: its objectives, its free quantities; or why there is none."""
        if self.winner is None:
            return [self.front.message]
        study, x, f = self.front.study, self.front.x[self.winner], self.front.f[self.winner]
        goals = ", ".join(objective_texts(study, f))
        free = [f"{label(n, q)} {q.text(v)}" for (n, q), v in zip(study.declared.items(), x, strict=True)]
        return [
            [bold(f"winner: design {self.winner}"), f" of 0 to {len(self.front) - 1}: {goals}"],
            ", ".join(free),
        ]

    @property
    def count(self) -> str:
        """How many designs there are."""
        return "1 design" if len(self.front) == 1 else f"{len(self.front)} designs"

    def summary(self) -> str:
        """The front's size and its winner, a line each."""
        if self.winner is None:
            return f"no front: {self.front.message}"
        goals = objective_texts(self.front.study, self.front.f[self.winner], ": ")
        return "\n".join([f"{self.count} on the front; winner by {self.rule}:", *goals])


class FrontPicker:
    """A menu of rules, a slider over the designs of a front, and a button for the winner.

    ``choice`` is what they show.  What is picked goes into the sliders of an `Instrument`: ``design(i)``, by default
    the front's own.  ``importance`` judges the objectives, and the first rule is then the weighted sum; ``judged()`` is
    called when another rule is asked for, or a reference point.  A click in ``picture`` loads the nearest design.
    """

    def __init__(
        self,
        explorer: Instrument,
        front: Front,
        importance: AhpPanel | None,
        picture: LivePicture,
        judged: Callable[[], None],
        design: Callable[[int], Any] | None = None,
    ) -> None:
        self.explorer, self.importance = explorer, importance
        self._design = design or (lambda index: self.choice.front[index])
        self.quiet = Quiet()
        self.first_rule = "weighted sum" if importance else next(iter(CHOOSERS))
        self.rule = Menu(list(CHOOSERS), "choose by", value=self.first_rule)
        self.pick = Whole(0, 0, 0, "design", slider=True, tooltip="loads a design of the front")
        self.take = Button("Load the winner", lambda: self.select(self.choice.winner))
        self.reference = ReferencePoint(picture, self.select, judged)
        self.quiet.hear(self.rule, lambda _: judged())
        self.quiet.hear(self.pick, self.select)
        picture.on_click(self.select_nearest)
        self.show(front)

    def show(self, front: Front) -> None:
        """Choose from another front, or anew from the same one; the slider is at the design in the explorer's."""
        self.choice = FrontChoice(front, self.rule.value, self.importance.weights if self.importance else None)
        self.take.disabled = self.choice.winner is None
        self.reference.show(front)
        places = places_on(front, self.explorer.design)
        self.selected = next(map(int, places), None)
        with self.quiet:
            self.pick.max, self.pick.disabled = max(len(front) - 1, 0), not len(front)
            if self.selected is not None and self.pick.value not in places:
                self.pick.value = self.selected
            self.pick.value = min(self.pick.value, self.pick.max)

    def verdict(self) -> list[Line]:
        """The winner in words, and what the objectives cost each other there and at the design in the sliders."""
        front = self.choice.front
        places = dict.fromkeys(i for i in (self.choice.winner, self.selected) if i is not None)
        return [*self.choice.verdict(), *costs(front, places)]

    @property
    def moved(self) -> bool:
        """Whether another design of the front is in the explorer than is shown, or none."""
        return place_on(self.choice.front, self.explorer.design) != self.selected

    def select(self, index: int | None) -> None:
        """Load one design of the front into the explorer; nothing if there is no such."""
        if index is not None and index < len(self.choice.front):
            self.explorer.load(self._design(index))

    @property
    def offered(self) -> tuple[Array, Array]:
        """What the front's picture offers (see `designs_on`)."""
        return designs_on(self.choice.front, self._design, self.explorer.design)

    def select_nearest(self, view: int, at: Array, pixel: Array) -> None:
        """Load the design whose point is nearest to a click in the picture of the front."""
        self.select(nearest(shown_objectives(self.choice.front).T, at, pixel))


class FrontPanel(Panel):
    """A panel around its ``picker``."""

    picker: FrontPicker
    decision: Decision | None = None
    """What was decided last on its front."""

    def _stand_in_tabs(self, title: str, *judged: Sheet | None) -> None:
        """Be a tab of the explorer, and the judgements that there are another."""
        if judgements := [panel for panel in judged if panel]:
            self.picker.explorer.add_tab("Judgements", *judgements)
        self.picker.explorer.add_tab(title, self)

    @property
    def front(self) -> Front:
        """The front that is shown."""
        return self.picker.choice.front

    @property
    def winner(self) -> int | None:
        """Which design of it wins."""
        return self.picker.choice.winner

    def select(self, index: int | None) -> None:
        """Load one design of the front into the sliders."""
        self.picker.select(index)

    def on_front(self, act: Callable[[], None]) -> None:
        """Call ``act()`` after each new front is shown, from whichever thread shows it."""
        self.on_change(act)
