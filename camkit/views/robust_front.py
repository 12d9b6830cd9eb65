"""A view of two fronts: of designs as they are drawn, by their yields, and of designs that survive being made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..quantities.kinds import numbers, refuse_kinds
from ..quantities.types import Array
from ..study.recheck import Recheck
from .front import Judged, axes_of, one_design, shown_objectives, wished
from .picture import Mark, Picture, Points

CLASSES = 0.9, 0.5
"""Where one class of yields ends and the next begins, beside the yield that is wanted."""
FORMS = "triangle", "square", "cross"
"""Of the classes below the yield that is wanted, the last of them of the lowest."""


@dataclass(frozen=True)
class RobustFront:
    """A front whose designs survive being made, beside the ``nominal`` one and the ``yields`` of its designs, ``(p,)``.

    ``checked`` is what exact parts say of the front's designs; without it they are known by a model.
    """

    front: Judged
    nominal: Judged
    yields: Array
    wanted: float = 0.99
    checked: Recheck | None = None
    here: Array | Sequence[float] | None = None
    """Objectives of the design in the sliders, ``(k,)``."""
    winner: int | None = None
    reference: Array | Sequence[float] | None = None
    """What a person wishes of the objectives, ``(k,)``."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if numbers(self.yields, "the yields").shape != (len(self.nominal),):
            raise ValueError(f"there are {np.size(self.yields)} yields for {len(self.nominal)} designs; each has one")
        if self.checked is not None and len(self.checked.share) != len(self.front):
            raise ValueError(f"{len(self.checked.share)} designs are checked; the front has {len(self.front)}")


def robust_pareto(shown: RobustFront) -> Picture:
    """Nominal designs coloured by their yield, robust ones by whether theirs is decided, and the design in hand."""
    objectives = shown.front.study.minimise
    x, y = shown_objectives(shown.front)
    winner = slice(0, 0) if shown.winner is None else slice(shown.winner, shown.winner + 1)
    return Picture.of(
        axes_of("Nominal and robust front", objectives),
        _nominal(shown),
        _robust(shown, x, y),
        Points("in the sliders", *one_design(objectives, shown.here), size=14, fill="none", label="in the sliders"),
        Points("winner", x[winner], y[winner], role="limit", mark="star", size=19, fill="none", label="winner"),
        wished(shown.front, shown.reference),
    )


def _nominal(shown: RobustFront) -> list[Mark]:
    """A mark for each class of yields."""
    (x, y), wanted = shown_objectives(shown.nominal), shown.wanted
    ends = [np.inf, wanted, *(end for end in CLASSES if end < wanted), -np.inf]
    marks: list[Mark] = []
    for k, (high, low) in enumerate(pairwise(ends)):
        where = (shown.yields >= low) & (shown.yields < high)
        above, below = f"{100 * low:g} % or more", f"below {100 * high:g} %"
        told = above if k == 0 else f"{100 * low:g} to {100 * high:g} %" if np.isfinite(low) else below
        names = tuple(f"yield {100 * share:.1f} % by the model" for share in shown.yields[where])
        role, form = ("allowed", "dot") if k == 0 else ("trouble", FORMS[k - len(ends) + 1])
        label = f"nominal, yield {told}"
        marks.append(Points(f"yield {k}", x[where], y[where], role=role, mark=form, size=8, label=label, names=names))
    return marks


def _robust(shown: RobustFront, x: Array, y: Array) -> list[Mark]:
    """Filled where the yield is decided, open where it is not or not yet."""
    checked = shown.checked
    sure = np.zeros(len(x), dtype=bool) if checked is None else checked.decided
    open_ = "robust by the model" if checked is None else "robust, yield not decided"
    told = [""] * len(x) if checked is None else str(checked).split("; ")
    names = [f"yield {words or 'not checked yet'}" for words in told]
    marks: list[Mark] = []
    for key, where, fill, label in (("open", ~sure, "paper", open_), ("robust", sure, "full", "robust")):
        of = tuple(name for name, one in zip(names, where, strict=False) if one)
        marks.append(
            Points(key, x[where], y[where], role="position", mark="diamond", size=5, fill=fill, label=label, names=of)
        )
    return marks
