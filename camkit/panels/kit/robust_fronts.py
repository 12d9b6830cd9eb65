"""A tick for fronts whose designs survive being made, and what is then said of them beside the nominal one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...quantities import Quantity, words
from ...quantities.types import Array
from ...search.front import Front
from ...search.robust_front import most_tolerant
from ...study.failures import failures, tolerance_texts
from ...study.recheck import Recheck
from ...study.robust import RobustStudy
from ...study.study import Study
from ...views.robust_front import RobustFront
from .inputs import Check, Number
from .parts import Line, Words, row
from .yields import NO_TOLERANCES, YIELD

if TYPE_CHECKING:
    from ..instrument import Instrument

WANTED = Quantity("", 100 * YIELD, 90, 99.9, "%", "share of parts that is to keep all limits", above=50, at_most=100)
EQUAL = 1e-3
"""Of what an objective spans on a front, a difference that nobody calls one."""
SOME = 16
"""Of so many nominal designs is asked why their parts fail."""
HELP = "Also search for designs whose parts keep every limit within the tolerances of the verdict"


class Robustness:
    """The tick and the yield wanted, within the tolerances of an `Instrument`, and the ``nominal`` front beside.

    ``changed()`` hears of another tick, yield or tolerance.
    """

    def __init__(
        self,
        explorer: Instrument,
        changed: Callable[[], None] = lambda: None,
        refused: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self.explorer = explorer
        self.tick = Check(description="made within tolerances", tooltip=HELP)
        self.wanted = Number("yield wanted", WANTED, YIELD, changed, refused, visible=False)
        self.words = Words()
        self.asked = row(self.tick, self.wanted)
        self.nominal: Front
        self.yields: Array
        self.tick.observe(lambda change: setattr(self.wanted, "visible", change.new), "value")
        self.tick.observe(lambda _: changed(), "value")
        explorer.observe(lambda _: changed() if self.tick.value else None, "tolerances")

    def within(self, study: Study) -> Study:
        """The study, within tolerances if that is ticked; ``ValueError`` where there are none."""
        if not self.tick.value:
            return study
        if not (tolerances := self.explorer.within(self.explorer.design)):
            raise ValueError(NO_TOLERANCES)
        return study.under(tolerances, self.wanted.value)

    def compare(self, nominal: Front, study: Study) -> None:
        """Another nominal front, and its yields by the model of a study within tolerances."""
        some = isinstance(study, RobustStudy) and len(nominal) > 0
        self.yields = study.modelled_yield(nominal.x) if some else np.zeros(len(nominal))  # type: ignore[attr-defined]
        self.nominal = nominal

    def beside(self, front: Front, here: Array, winner: int | None, reference: Sequence[float] | None) -> RobustFront:
        """Both fronts, to be drawn."""
        assert isinstance(front.study, RobustStudy)
        wanted = front.study.yield_at_least
        return RobustFront(front, self.nominal, self.yields, wanted, checked(front), here, winner, reference)

    def told(self, front: Front) -> list[Line]:
        """What survival costs, why nominal designs fail, and where none is robust, with which tolerances one were."""
        study, nominal = front.study, self.nominal
        if not isinstance(study, RobustStudy) or not len(nominal):
            return []
        wanted, short = f"{100 * study.yield_at_least:g} %", self.yields < study.yield_at_least
        lines: list[Line] = [
            f"made within {', '.join(tolerance_texts(study))}",
            f"{len(short) - short.sum()} of {len(short)} nominal designs yield {wanted} or more",
        ]
        if short.any():
            some = np.flatnonzero(short)[np.linspace(0, short.sum() - 1, SOME).astype(int)]
            lines.append(f"of the others {failures(study, nominal.x[np.unique(some)])}")
        if len(front):
            return [*lines, price_text(front, nominal), front.message]
        if study.menus:
            return lines
        x, factor = most_tolerant(study)
        free = ", ".join(f"{words(path)} {q.text(v)}" for (path, q), v in zip(study.declared.items(), x, strict=True))
        return [*lines, f"no design is robust within these tolerances; within {factor:.2f} times these one is: {free}"]


def checked(front: Front) -> Recheck | None:
    """What exact parts have said of the designs of a front, if they were asked."""
    found: Recheck | None = vars(front).get("yields")
    return found


def judged_how(front: Front) -> str:
    """How it is known that the designs of a front survive, in words; empty where nobody asks."""
    if not isinstance(front.study, RobustStudy):
        return ""
    return "by the model of each limit, " if checked(front) is None else "by exact parts, "


def price_text(front: Front, nominal: Front) -> str:
    """What a front lacks of another, in words."""
    share, ends = front.price(nominal)
    least = EQUAL * np.ptp(nominal.f, axis=0)
    lost = [
        f"{m.name} {m.text(abs(v))} {'worse' if v > 0 else 'better'}" if abs(v) > e else f"{m.name} as good"
        for m, v, e in zip(front.study.minimise, ends, least, strict=True)
    ]
    volume = "" if np.isnan(share) else f"{100 * share:.1f} % of the hypervolume; "
    return f"the price: {volume}at its ends {', '.join(lost)}"
