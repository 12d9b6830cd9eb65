"""A decision as a record: which design of a front was chosen, by which rule, on which judgements."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib.metadata import version
from typing import Any

import numpy as np

from ..decision import CHOOSERS, Judgements, Judges, achievement
from ..quantities import Measure, label, words
from ..quantities.kinds import refuse_kinds, shown
from ..quantities.markup import Html, table
from ..search.front import Front
from ..search.rates import told_on_front
from ..study.robust import RobustStudy

BY_HAND, REFERENCE = "by hand", "reference point"
RULES = (*CHOOSERS, REFERENCE, BY_HAND)
"""By what a design can be chosen."""


@dataclass(frozen=True)
class Decision:
    """Which design of a front was ``chosen``, by which of the `RULES`, and what was judged.

    ``judgements`` of the objectives, and the ``reference`` point of what was wished of them (SI, all to be small), if
    there are any.  ``yields`` says in words how many parts keep every limit; a front under tolerances knows it, and is
    recorded as one of its nominal study.  Everything else follows from the front: `lines` tell it.

    >>> from camkit import quick_front
    >>> from camkit.machines import door_handle_study
    >>> front = quick_front(door_handle_study(), 20)
    >>> Decision(front, 3).lines()[4:6]
    [('rule', 'by hand'), ('chosen', 'design 3 of 0 to 19')]

    Raises ``ValueError`` for a place that is not on the front, an unknown rule, and judgements or a reference of
    another number of objectives.
    """

    front: Front
    chosen: int
    rule: str = BY_HAND
    judgements: Judgements | Judges | None = None
    reference: Sequence[float] | None = None
    yields: str = ""
    date: str = field(default_factory=lambda: datetime.datetime.now().date().isoformat())
    version: str = field(default_factory=lambda: version("camkit"))

    def __post_init__(self) -> None:
        refuse_kinds(self)
        k = len(self.front.study.minimise)
        if not 0 <= self.chosen < len(self.front):
            raise ValueError(f"the chosen design is {shown(self.chosen)}; there are {len(self.front)}, counted from 0")
        if self.rule not in RULES:
            raise ValueError(f"the rule is {shown(self.rule)}; there are {', '.join(map(repr, RULES))}")
        if self.judgements is not None and len(self.judgements.names) != k:
            raise ValueError(f"the judgements are of {len(self.judgements.names)} criteria; the objectives are {k}")
        if self.reference is not None:
            achievement(self.front, self.reference)  # refuses what is none
            object.__setattr__(self, "reference", tuple(map(float, self.reference)))
        elif self.rule == REFERENCE:
            raise ValueError("the rule is the reference point; there must be one")
        try:
            datetime.date.fromisoformat(self.date)
        except ValueError:
            raise ValueError(f"the date is {shown(self.date)}; it must be as 2026-03-31") from None
        if self.front.study.nominal is not self.front.study:
            self._record_nominal()

    def _record_nominal(self) -> None:
        """Keep the front of the nominal study, and the yield, which is known under tolerances, in words."""
        under, study = self.front, self.front.study
        nominal = under.judged_by(study.nominal)
        places = np.flatnonzero((nominal.x == under.x[self.chosen]).all(-1))
        if not len(places):
            raise ValueError("the chosen design is not on the front without tolerances, which is what can be recorded")
        if isinstance(study, RobustStudy) and under.yields is not None and not self.yields:
            of = ", ".join(map(words, study.names))
            object.__setattr__(self, "yields", f"{under.yields.of(np.array([self.chosen]))}; tolerances on {of}")
        object.__setattr__(self, "front", nominal)
        object.__setattr__(self, "chosen", int(places[0]))

    @property
    def design(self) -> Any:
        """The chosen design."""
        return self.front[self.chosen]

    @property
    def ranges(self) -> np.ndarray:
        """The best and the worst of each objective on the front, by which the rules make them alike, ``(2, k)``, SI."""
        return np.array([self.front.f.min(0), self.front.f.max(0)])

    @property
    def rates(self) -> np.ndarray:
        """What each objective costs the others there (see `Front.rates`)."""
        return self.front.rates(self.chosen)

    @cached_property
    def values(self) -> dict[Measure, float]:
        """The objectives and what has a limit, by measure, SI."""
        study = self.front.study
        told = (*study.minimise, *(m for m, _, _ in study.limits))
        analysis = study.analysis_of(self.design)
        return {m: m.one(analysis) for m in dict.fromkeys(m if m.sign > 0 else -m for m in told)}

    @property
    def taken(self) -> int | None:
        """Which design the rule takes from this front; ``None`` where a person chose by hand."""
        if self.rule == BY_HAND:
            return None
        if self.rule == REFERENCE:
            return int(achievement(self.front, self.reference))
        return int(CHOOSERS[self.rule](self.front, None if self.judgements is None else self.judgements.weights))

    def lines(self) -> list[tuple[str, str]]:
        """The record as pairs of what and how."""
        study, objectives = self.front.study, self.front.study.minimise
        rate = told_on_front(objectives, self.rates)
        taken = "" if self.taken in (None, self.chosen) else f"; the rule takes design {self.taken}"
        free = zip(study.declared.items(), self.front.x[self.chosen], strict=True)
        ends = zip(objectives, *self.ranges, strict=True)
        return [
            ("decided", f"{self.date}, camkit {self.version}"),
            ("front", "; ".join(filter(None, (f"{len(self.front)} designs", record_text(self.front.record))))),
            *((f"range of the {m.name}", f"{m.text(m.sign * a)} (best) to {m.text(m.sign * b)}") for m, a, b in ends),
            *self._judged(),
            ("rule", self.rule),
            ("chosen", f"design {self.chosen} of 0 to {len(self.front) - 1}{taken}"),
            *((label(path, q), q.text(value)) for (path, q), value in free),
            *((m.name, m.text(value)) for m, value in self.values.items()),
            *([("parts that keep every limit", self.yields)] if self.yields else []),
            *([("rate", rate)] if rate else []),
        ]

    def _judged(self) -> list[tuple[str, str]]:
        """What was judged or wished, in words."""
        told, judged, objectives = [], self.judgements, self.front.study.minimise
        if isinstance(judged, Judges):
            shares = zip(judged.said.items(), judged.influence, strict=True)
            told = [(f"judged by {name} ({100 * share:.3g} %)", _in_words(said)) for (name, said), share in shares]
            told.append((f"joined {judged.method}", _in_words(judged.judgements)))
        elif judged is not None:
            told.append(("judged", _in_words(judged)))
        if self.reference is not None:
            wishes = (f"{m.name} {m.text(m.sign * wish)}" for m, wish in zip(objectives, self.reference, strict=True))
            told.append(("wished", ", ".join(wishes)))
        return told

    def text(self) -> str:
        """The record as lines of text."""
        return "\n".join(f"{name}: {said}" for name, said in self.lines())

    def _repr_html_(self) -> Html:
        return table((), self.lines())


def record_text(record: Mapping[str, object]) -> str:
    """How a front was found, in one line; all that is known of it is in the saved study."""
    words_of = {"generations": "{} generations", "designs": "{} designs evaluated", "seed": "seed {}"}
    known = (text.format(record[name]) for name, text in words_of.items() if name in record)
    return f"found in {record['seconds']:.3g} s: {', '.join(known)}" if record else ""


def _in_words(judged: Judgements) -> str:
    """Judgements with their weights and consistency."""
    named = [f"{judged.names[i]} against {judged.names[j]}" for i, j in judged.pairs]
    said = [f"{pair} {'not judged' if v is None else f'{v:.4g}'}" for pair, v in zip(named, judged.above, strict=True)]
    weights = ", ".join(f"{name} {weight:.4f}" for name, weight in zip(judged.names, judged.weights, strict=True))
    return f"{'; '.join([*said, f'weights: {weights}'])}; consistency ratio {judged.consistency_ratio:.4f}"
