"""`compare_fronts`: fronts of several searches laid over each other, and the choice of a design from any of them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from ..quantities import Analysable
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from ..search.epsilon_constraint import dominated_shares
from ..search.front import Front
from ..search.protocol import Step
from ..study.robust import RobustStudy
from ..study.study import Study
from ..views.front import ShownFronts, fronts_overlaid, shown_objectives
from .instrument import Instrument
from .kit.drawn import LivePicture, nearest
from .kit.front_picker import FrontChoice, designs_on, objective_texts
from .kit.inputs import Menu, Whole
from .kit.parts import Part, Table, Words
from .kit.quiet import Quiet
from .kit.robust_fronts import checked, price_text
from .kit.runner import JobPanel, Runner, time_left

Search = Callable[[Study], Iterator[Step]]
"""Looks for the front of a study step by step, as `search` does with one of its methods."""
Way = tuple[Study, Search]
"""A study, and how it is searched around a design."""

NOT_COMPARED = (
    "What the fronts dominate is not compared: in one of the objectives no design is better than the starting design."
)


class FrontsPanel(JobPanel):
    """Fronts of the same two objectives by several ways of search, around the design of an `Instrument`.

    ``ways`` maps names to searches (see `Way`); ``given`` are fronts that are there already.  The searches run one
    after the other in a thread: the page stays alive, Stop takes effect before the next design and keeps the fronts
    so far.  A click, or menu and slider, loads a design into the explorer; a cross shows where its design stands.
    Beside a front of designs that survive being made stand the yields of all, and what it lacks of the others.

    Raises ``ValueError`` if neither a way nor a front is there, or fronts have other objectives than two.
    """

    def __init__(
        self, explorer: Instrument, ways: Mapping[str, Way] | None = None, given: Mapping[str, Front] | None = None
    ) -> None:
        refuse_arguments(FrontsPanel.__init__, locals())
        self.explorer = explorer
        self.ways = {name: (study.around(explorer.start), search) for name, (study, search) in (ways or {}).items()}
        self.fronts = self._empty_fronts(dict(given or {}))
        self._refuse_other_objectives()
        self.start = self._objectives(explorer.start.analyse())
        self.seconds: dict[str, float] = {}
        self._known: dict[int, tuple[Front, str]] = {}
        self._quiet, self._drawing = Quiet(), threading.RLock()
        self._make_parts()
        self.picture = LivePicture((fronts_overlaid,), "Fronts laid over each other", width=8.6, height=5.4)
        self.picture.on_click(self.clicked)
        super().__init__(self._beside_picture(*self._questions()))
        self._show()
        explorer.on_change(lambda _: self._show_here())
        explorer.add_tab("Fronts", self)

    def _empty_fronts(self, given: dict[str, Front]) -> dict[str, Front]:
        """A front for each way, without a design where none is given."""
        fronts = dict(given)
        for name, (study, _) in self.ways.items():
            if name not in fronts:
                fronts[name] = Front(study, np.zeros((0, len(study.free))), np.zeros((0, len(study.minimise))))
        return fronts

    def _refuse_other_objectives(self) -> None:
        if not self.fronts:
            raise ValueError("there is nothing to compare; name one or more ways to search, or fronts")
        objectives = {front.study.minimise for front in self.fronts.values()}
        if len(objectives) > 1 or len(next(iter(objectives))) != 2:
            named = "; ".join(", ".join(m.name for m in measures) for measures in objectives)
            raise ValueError(f"the fronts are of {named}; they must be of the same two objectives")

    def _make_parts(self) -> None:
        page = self.explorer.start, list(self.ways)
        self.runner = Runner("Compute the fronts", lambda: self._steps(self.explorer.design), self._show_step, *page)
        self.runner.run_button.disabled = not self.ways
        self.menu = Menu(list(self.fronts), "front")
        self.pick = Whole(0, 0, 0, "design", slider=True, tooltip="loads a design of the front")
        self.table, self.note = Table(), Words(look="hint")
        self.menu.observe(lambda _: self._fit_slider(), "value")
        self._quiet.hear(self.pick, lambda index: self.select(self.menu.value, index))

    def _questions(self) -> list[Part]:
        runner = self.runner
        search = [runner.buttons(), runner.status] if self.ways else []
        return [*search, runner.banner, self.menu, self.pick, self.table, self.note]

    # ------------------------------------------------------------ the searches

    def _steps(self, design: Analysable) -> Iterator[Step]:
        try:
            for name, (study, search) in self.ways.items():
                self._name, began = name, time.monotonic()
                for step in search(study.around(design)):
                    self.seconds[name] = time.monotonic() - began
                    yield step
                self.fronts[name] = step.front
        finally:
            self._show()

    def _show_step(self, step: Step, last: bool) -> None:
        self.fronts[self._name] = step.front
        told = f"{self._name}: {step.number} of {step.of}"
        if last:
            ended = self.runner.job and self.runner.job.ended
            told = f"all fronts are there: {sum(self.seconds.values()):.1f} s elapsed" if ended else "stopped"
        self.runner.status.say(told)
        more = len(self.ways) - 1 - list(self.ways).index(self._name)
        if more and not last:
            self.runner.left.say(f"{time_left(step)} for this search; {more} more after it".removeprefix(" for "))
        self._show()

    # ------------------------------------------------------------ what is shown

    def _objectives(self, analysis: object) -> np.ndarray:
        return np.array([m.one(analysis) for m in next(iter(self.fronts.values())).study.minimise])

    def _show(self) -> None:
        with self.held():
            self._fit_slider()
            heads = ("front", "designs", "dominates", "time", *(["yields"] if self._robust else []))
            self.table.put(heads, self._rows())
            self.note.say(NOT_COMPARED if np.isnan(list(self.shares().values())).any() else "", *self._prices())
            self._show_here()

    def _show_here(self) -> None:
        with self._drawing:  # else the one thread could show an older design than the other
            design = self.explorer.design
            every = [designs_on(front, front.__getitem__, design) for front in self.fronts.values()]
            self.picture.offer(*map(np.concatenate, zip(*every, strict=True)))
            self.picture.show(ShownFronts(dict(self.fronts), self.start, self._objectives(self.explorer.analysis)))

    def _fit_slider(self) -> None:
        """As many designs as the front in the menu has."""
        count = len(self.fronts[self.menu.value])
        with self._quiet, self.held():
            self.pick.max, self.pick.disabled = max(count - 1, 0), not count
            self.pick.value = min(self.pick.value, self.pick.max)

    def shares(self) -> dict[str, float]:
        """What each front dominates (see `dominated_shares`), up to the design that the explorer began with."""
        return dominated_shares(self.fronts, self.start)

    def _rows(self) -> list[tuple[object, ...]]:
        """A row of the table for each front, its name behind the colour of its points."""
        rows: list[tuple[object, ...]] = []
        for k, (name, share) in enumerate(self.shares().items()):
            time_told = f"{self.seconds[name]:.1f} s" if name in self.seconds else ""
            dominates = "" if np.isnan(share) else f"{100 * share:.1f} %"
            yields = [self._yields(self.fronts[name])] if self._robust else []
            rows.append(({"words": name, "series": k}, len(self.fronts[name]), dominates, time_told, *yields))
        return rows

    @property
    def _robust(self) -> Front | None:
        """The first front of designs that survive being made, if there is one."""
        return next((front for front in self.fronts.values() if isinstance(front.study, RobustStudy)), None)

    def _yields(self, front: Front) -> str:
        """From the least to the largest yield of a front, within the tolerances that there are."""
        robust: Any = (self._robust or front).study
        if not len(front) or not isinstance(robust, RobustStudy) or list(front.study.free) != list(robust.free):
            return ""
        if (known := self._known.get(id(front))) is None or known[0] is not front:
            found = checked(front)
            shares = robust.modelled_yield(front.x) if found is None else found.share
            known = self._known[id(front)] = front, f"{100 * shares.min():.1f} to {100 * shares.max():.1f} %"
        return known[1]

    def _prices(self) -> list[str]:
        """What a robust front lacks of each nominal one."""
        robust, named = self._robust, self.fronts.items()
        if robust is None or not len(robust):
            return []
        nominal = [(name, front) for name, front in named if not isinstance(front.study, RobustStudy) and len(front)]
        return [f"beside {name}, {price_text(robust, front)}" for name, front in nominal]

    def select(self, name: str, index: int) -> None:
        """Load a design of one of the fronts into the sliders."""
        if index >= len(self.fronts[name]):
            return
        with self._quiet:
            self.menu.value = name
            self._fit_slider()
            self.pick.value = index
        self.explorer.load(self.fronts[name][index])

    def clicked(self, view: int, at: Array, pixel: Array) -> None:
        """Load the nearest point."""
        places = [(name, i) for name, front in self.fronts.items() for i in range(len(front))]
        points = np.concatenate([shown_objectives(front).T for front in self.fronts.values()])
        place = nearest(points, at, pixel)
        if place is not None:
            self.select(*places[place])

    def summary(self) -> str:
        """Each front with what it dominates, and the design in the sliders."""
        lines = []
        for name, share in self.shares().items():
            dominates = "" if np.isnan(share) else f", dominates {100 * share:.0f} %"
            lines.append(f"{name}: {FrontChoice(self.fronts[name]).count}{dominates}")
        study = next(iter(self.fronts.values())).study
        here = self._objectives(self.explorer.analysis)
        return "\n".join([*lines, *self.note.value, f"in the sliders: {', '.join(objective_texts(study, here))}"])


def compare_fronts(
    explorer: Instrument, ways: Mapping[str, Way] | None = None, given: Mapping[str, Front] | None = None
) -> FrontsPanel:
    """A panel of fronts by several searches; a design from them goes into the sliders of ``explorer``."""
    return FrontsPanel(explorer, ways, given)
