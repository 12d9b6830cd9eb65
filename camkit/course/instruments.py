"""Exercises whose answer stands in an instrument: a design that keeps its limits, a choice from a front."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from types import SimpleNamespace
from typing import cast

import numpy as np

from ..files.workshop.faults import Verdict, judged
from ..quantities import Analysable, Measure, choices_of, quantities_of, value_of, words
from ..quantities.kinds import kind_words, refuse_arguments, shown
from ..search import Front
from .exercises import Answer, ChoiceExercise, Exercise, NumberExercise
from .replies import Reply, uncounted

Limits = Mapping[Measure, float]
Asked = Callable[[SimpleNamespace], Limits]
"""The limits that follow from the numbers that were drawn."""
SAME = 1e-9
"""Values that differ by less than this share are the same."""


def no_limits(numbers: SimpleNamespace) -> Limits:
    """None at all."""
    return {}


@dataclass(frozen=True, kw_only=True, repr=False)
class DesignExercise(Exercise):
    """One whose answer is a design that keeps its limits; of what it ``begins`` with only ``free`` may be changed."""

    begins: Answer
    free: Sequence[str]
    at_most: Asked = no_limits
    at_least: Asked = no_limits

    @property
    def start(self) -> Analysable:
        """The design that the instrument opens with, for who learns here."""
        return cast(Analysable, self.begins(self.numbers))

    @property
    def limits(self) -> dict[str, Limits]:
        """``at_most`` and ``at_least`` of the task, for the instrument of who learns here."""
        return {"at_most": self.at_most(self.numbers), "at_least": self.at_least(self.numbers)}

    def asks(self, numbers: SimpleNamespace) -> str:
        free = ", ".join(map(words, self.free))
        return f"Answer: a design in the instrument. {bounds(self, numbers)}. Free: {free}."

    def key(self, numbers: SimpleNamespace) -> str:
        begins, right = (cast(Analysable, made(numbers)) for made in (self.begins, self.answer))
        found = "; ".join(map(str, judged(right.analyse(), triples(self, numbers))))
        return f"For instance: {', '.join(told(right, path) for path in different(begins, right))}. Then {found}."

    def judge(self, attempt: object, numbers: SimpleNamespace, **how: object) -> Reply:
        start, design = cast(Analysable, self.begins(numbers)), design_in(attempt)
        if type(design) is not type(start):
            wanted = f"A design of {kind_words(type(start), article=True)} is wanted here, or the instrument with it"
            return uncounted(f"{wanted}; given is {shown(attempt)}.")
        if not different(start, design):
            return uncounted("This is still the design that the task begins with: change it, then run this cell again.")
        if changed := self._changed(start, design):
            return uncounted(f"Not free in this task, but changed: {', '.join(map(words, changed))}. Put it back.")
        found = [*judged(design.analyse(), triples(self, numbers))]
        if missed := [each for each in found if not each.kept]:
            known = self._mistake(numbers, lambda made: not different(cast(Analysable, made), design))
            said = f"Not yet: {'; '.join(map(by_how_much, missed))}."
            return Reply(False, f"{said} {known.sentence}") if known else Reply(False, said, known=False)
        return Reply(True, f"Right: {'; '.join(map(str, found))}.")

    def _changed(self, start: Analysable, design: Analysable) -> list[str]:
        """What is not as it was, though it is not free; what is part of a free choice is free."""
        kept = different(start, design)
        return [path for path in kept if not any(path == f or path.startswith(f"{f}.") for f in self.free)]


def design_in(attempt: object) -> object:
    """The design that an instrument, or a panel that follows one, holds; a design itself."""
    for panel in (attempt, getattr(attempt, "explorer", None)):
        if (design := getattr(panel, "design", None)) is not None and hasattr(design, "analyse"):
            return design
    return attempt


def different(one: Analysable, other: Analysable) -> list[str]:
    """The paths of quantities and choices in which two designs differ."""
    return [
        path
        for declared in (quantities_of, choices_of)
        for path in dict.fromkeys((*declared(one), *declared(other)))
        if not _same(one, other, path)
    ]


def told(design: Analysable, path: str) -> str:
    """A quantity or a choice of a design with its value."""
    value, declared = value_of(design, path), quantities_of(design).get(path)
    return f"{words(path)} {declared.text(value) if declared else getattr(value, 'name', value)}"


def _same(one: Analysable, other: Analysable, path: str) -> bool:
    try:
        a, b = value_of(one, path), value_of(other, path)
    except ValueError:  # only one of them has such a quantity
        return False
    if isinstance(a, float) and isinstance(b, float):
        return bool(np.isclose(a, b, rtol=SAME, atol=SAME * SAME))
    return bool(a == b)


def by_how_much(limit: Verdict) -> str:
    """A limit that is missed, and by how much."""
    if not np.isfinite(limit.value):
        return f"{limit}; it must be {limit.bound}"
    side = "too much" if "at most" in limit.bound else "too little"
    return f"{limit}; it must be {limit.bound}, so {limit.measure.text(limit.missed)} {side}"


def triples(task: DesignExercise | FrontExercise, numbers: SimpleNamespace) -> list[tuple[Measure, float, int]]:
    """The limits of a task: a measure, a value (SI), and +1 for at most or -1 for at least."""
    both = (task.at_most, 1), (task.at_least, -1)
    return [(measure, limit, sense) for asked, sense in both for measure, limit in asked(numbers).items()]


def bounds(task: DesignExercise | FrontExercise, numbers: SimpleNamespace) -> str:
    """The limits of a task in words."""
    limits = triples(task, numbers)
    return "; ".join(f"{m.name} at {'most' if sense > 0 else 'least'} {m.text(limit)}" for m, limit, sense in limits)


@dataclass(frozen=True, kw_only=True, repr=False)
class FrontExercise(Exercise):
    """One whose answer is a design of a front, and the reason for it: one of ``reasons``, each of which selects one.

    Its ``answer`` is the front, which the panel opens with; another one that was searched there will do.
    A reason is a function of the front and of what was drawn, that gives the place of a design.
    """

    reasons: Mapping[str, Callable[[Front, SimpleNamespace], int]] = field(default_factory=dict)
    at_most: Asked = no_limits
    at_least: Asked = no_limits

    def asks(self, numbers: SimpleNamespace) -> str:
        limits = bounds(self, numbers)
        reasons = " or ".join(map(repr, self.reasons))
        return f"Answer: a design of the front, and the reason for it: {reasons}.{f' {limits}.' if limits else ''}"

    def key(self, numbers: SimpleNamespace) -> str:
        front = cast(Front, self.answer(numbers))
        return "; ".join(f"{reason}: design {int(select(front, numbers))}" for reason, select in self.reasons.items())

    def judge(self, attempt: object, numbers: SimpleNamespace, **how: object) -> Reply:
        front, design, reason = getattr(attempt, "front", None), design_in(attempt), how.get("reason")
        if how.get("of") != "front" or not isinstance(front, Front) or not hasattr(design, "analyse"):
            return uncounted('The panel with the front is wanted here: check(panel, of="front", reason=...).')
        if not isinstance(reason, str) or reason not in self.reasons:
            given = "" if reason in (None, ...) else f" The reason given is {shown(reason)}."
            return uncounted(f"{self.asks(numbers)}{given}")
        places = np.isclose(front.x, front.study.x_of(cast(Analysable, design)), rtol=SAME, atol=0).all(-1)
        if not places.any():
            return uncounted("The design in the sliders is not one of the front: click on one of its points.")
        place, selected = int(places.argmax()), int(self.reasons[reason](front, numbers))
        found = judged(front.study.analysis_of(front[place]), triples(self, numbers))
        if missed := [each for each in found if not each.kept]:
            return Reply(False, f"Not yet: {'; '.join(map(by_how_much, missed))}.", known=False)
        if place != selected:
            other = f"the reason {reason!r} selects design {selected}, and design {place} is in the sliders"
            return Reply(False, f"Choice and reason do not agree: {other}.", known=False)
        return Reply(True, f"Right: design {place} of {len(front)} is the one that the reason {reason!r} selects.")


def exercise(name: str, question: str, answer: Answer, *, lesson: str = "exercises", **more: object) -> Exercise:
    """A question that checks itself; its kind follows from what is said of it.

    - a number: ``unit``, ``tolerance`` (a share of it, 0.01 unless said);
    - words: ``choices``;
    - a design: ``begins`` (what the instrument opens with), ``free`` (paths), ``at_most`` and ``at_least``;
    - a choice from a front, which is the ``answer``: ``reasons``, perhaps with ``at_most`` and ``at_least``.

    ``given`` are the numbers that are drawn for each learner, by name; they stand in braces in the texts, and every
    function takes them, SI.  ``mistakes`` are known ones: a sentence, and what it gives.  ``hints`` come one by one,
    ``because`` when it is right.

    >>> from camkit import mm
    >>> from camkit.course import Range, exercise
    >>> size = exercise(
    ...     "twice", "The base radius is {r}. How large is the base circle's diameter?", lambda p: 2 * p.r,
    ...     unit="mm", given={"r": Range(30, 30, 1, "mm")}, mistakes={"That is the radius.": lambda p: p.r},
    ... )
    >>> size.check(60 * mm)
    ✓ Right: 60 mm.
    >>> size.check(60)
    ✗ Right, but in another unit: it is 1000 times too large. Millimetres are written 47 * mm.
    >>> size.check(30 * mm)
    ✗ That is the radius.
    """
    refuse_arguments(exercise, locals())
    kinds = {"choices": ChoiceExercise, "begins": DesignExercise, "reasons": FrontExercise}
    kind = next((kind for key, kind in kinds.items() if key in more), NumberExercise)
    known = {each.name for each in fields(cast(type[NumberExercise], kind))}
    if unknown := sorted(more.keys() - known):
        raise ValueError(f"an exercise knows no {unknown[0]!r}; one of this kind has {', '.join(sorted(known))}")
    return kind(name=name, question=question, answer=answer, lesson=lesson, **more)
