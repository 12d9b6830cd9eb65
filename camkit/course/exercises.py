"""Exercises that check themselves: a number, a prediction, a design in the instrument, a choice from a front."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import cast

import numpy as np

from ..quantities.kinds import number as number_in
from ..quantities.kinds import refuse_arguments, shown
from ..quantities.markup import attribute, html
from ..units import factor, in_unit
from .given import Given, drawn, texts
from .records import Lessons, learning, unread
from .replies import NEXT, Reply, close, raised, uncounted, wrong_unit

Answer = Callable[[SimpleNamespace], object]
"""What follows from the numbers that were drawn, SI."""
OPENED: dict[str, dict[str, Exercise]] = {}
"""The exercises of this kernel, by the names of lesson and exercise."""
DOTS = "Put your answer in the place of the three dots."


@dataclass(frozen=True, kw_only=True, repr=False)
class Exercise(ABC):
    """A question with numbers of the learner's own, and what to say of an attempt; `exercise` makes them."""

    name: str
    question: str
    answer: Answer
    lesson: str
    given: Given = field(default_factory=dict)
    hints: Sequence[str] = ()
    mistakes: Mapping[str, Answer] = field(default_factory=dict)
    because: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.hints, (tuple, list)) or not all(isinstance(hint, str) for hint in self.hints):
            raise ValueError(f"the hints are {shown(self.hints)}; they must be a list of texts")
        OPENED.setdefault(self.lesson, {})[self.name] = self
        self.said(self.numbers)  # a question that names what is not given is refused here

    @property
    def numbers(self) -> SimpleNamespace:
        """What was drawn for who learns here, SI, each by its name."""
        return self.drawn(learning().name)

    @property
    def solution(self) -> object:
        """The answer for who learns here."""
        return self.answer(self.numbers)

    def drawn(self, learner: str) -> SimpleNamespace:
        """What is drawn for a learner."""
        return drawn(self.given, learner, f"{self.lesson}|{self.name}")

    def said(self, numbers: SimpleNamespace) -> str:
        """The question with its numbers."""
        return self._filled(self.question, numbers)

    def words(self, numbers: SimpleNamespace) -> dict[str, str]:
        """What was drawn as texts say it, each by its name."""
        return texts(self.given, numbers)

    def _filled(self, text: str, numbers: SimpleNamespace) -> str:
        try:
            return text.format(**self.words(numbers))
        except (KeyError, IndexError) as missing:
            raise ValueError(f"the exercise {self.name!r} asks for {missing}, which is not given") from None

    @abstractmethod
    def asks(self, numbers: SimpleNamespace) -> str:
        """What kind of answer is wanted."""

    @abstractmethod
    def key(self, numbers: SimpleNamespace) -> str:
        """The right answer in words, for a sheet of paper."""

    @abstractmethod
    def judge(self, attempt: object, numbers: SimpleNamespace, **how: object) -> Reply:
        """What to say of an attempt, hints apart."""

    def check(self, attempt: object, **how: object) -> Reply:
        """Answer an attempt in a sentence: right; what was wrong with it, if that is known; else the next hint."""
        now = learning()
        reply = uncounted(DOTS) if attempt is ... else self.judge(attempt, self.numbers, **how)
        told: list[str] = []

        def count(lessons: Lessons) -> None:
            record = lessons.setdefault(self.lesson, {}).setdefault(self.name, unread())
            for name in OPENED.get(self.lesson, ()):
                lessons[self.lesson].setdefault(name, unread())
            record["attempts"] += not record["right"]
            record["right"] = record["right"] or reply.right
            if not (reply.right or reply.known):
                told.append(self._hint(record["hints"]))
                record["hints"] = min(record["hints"] + 1, len(self.hints))

        if reply.counted:
            now.change(count)
        more = [self._filled(self.because, self.numbers)] if reply.right else told[:1]
        sentence = " ".join(filter(None, (reply.sentence, *more, now.message)))
        return Reply(reply.right, sentence, reply.counted, reply.known)

    def _hint(self, number: int) -> str:
        if number >= len(self.hints):
            return f"There are no more hints. {NEXT}"
        return f"Hint {number + 1} of {len(self.hints)}: {self._filled(self.hints[number], self.numbers)}"

    def _mistake(self, numbers: SimpleNamespace, same: Callable[[object], bool]) -> Reply | None:
        """What to say of an attempt that is what a known mistake gives."""
        found = next((words for words, made in self.mistakes.items() if same(made(numbers))), None)
        return Reply(False, self._filled(found, numbers)) if found else None

    def __repr__(self) -> str:
        return f"Exercise, {self.name}: {self.said(self.numbers)}\n{self.asks(self.numbers)}"

    def _repr_html_(self) -> str:
        said = html("<b>Exercise: {}</b><br>{}", self.name, self.said(self.numbers))
        style = attribute("style", "border:1px solid #8c959f;border-radius:6px;padding:8px 12px;margin:4px 0")
        return html("<div {}>{}<br><i>{}</i></div>", style, said, self.asks(self.numbers))


@dataclass(frozen=True, kw_only=True, repr=False)
class NumberExercise(Exercise):
    """One whose answer is a number, SI, right to a share ``tolerance`` of it."""

    unit: str = ""
    tolerance: float = 0.01

    def __post_init__(self) -> None:
        factor(self.unit)
        share = number_in(self.tolerance)
        if share is None or np.ndim(share) or not 0 <= share < 1:
            raise ValueError(
                f"the tolerance is {shown(self.tolerance)}; it must be a share: at least 0 and less than 1"
            )
        super().__post_init__()

    def asks(self, numbers: SimpleNamespace) -> str:
        inside = f" in {raised(self.unit)}" if self.unit else ""
        return f"Answer: a number{inside}, to {100 * self.tolerance:.3g} %, written as {self.example}."

    @property
    def example(self) -> str:
        """How an answer is written in code."""
        return "12.3" if factor(self.unit) == 1 else f"12.3 * {self.unit.replace('^', '**').replace(' ', '*')}"

    def judge(self, attempt: object, numbers: SimpleNamespace, **how: object) -> Reply:
        read = number_in(attempt)
        if read is None or np.ndim(read) or not np.isfinite(read):
            return uncounted(f"A number is wanted here, such as {self.example}; given is {shown(attempt)}.")
        value, answer = float(read), self.answered(numbers)
        if close(value, answer, self.tolerance):
            return Reply(True, f"Right: {self.text(answer)}.")
        if self.unit and (said := wrong_unit(value, answer, self.tolerance)):
            return Reply(False, said)
        known = self._mistake(numbers, lambda made: close(value, float(cast(float, made)), self.tolerance))
        return known or Reply(False, f"{self.text(value)} is not right.", known=False)

    def answered(self, numbers: SimpleNamespace) -> float:
        """The answer; ``ValueError`` in a sentence where it is no number, which no attempt can be."""
        read = number_in(said := self.answer(numbers))
        if read is None or np.ndim(read) or not np.isfinite(read):
            raise ValueError(f"the answer of the exercise {self.name!r} is {shown(said)}; it must be a finite number")
        return float(read)

    def key(self, numbers: SimpleNamespace) -> str:
        return self.text(self.answered(numbers))

    def text(self, value: float) -> str:
        """A number with its unit."""
        digits = 4 if self.tolerance >= 1e-3 else 6
        return f"{in_unit(value, self.unit):.{digits}g} {raised(self.unit)}".rstrip()


@dataclass(frozen=True, kw_only=True, repr=False)
class ChoiceExercise(Exercise):
    """One whose answer is one of several words, such as a prediction."""

    choices: Sequence[str]

    def __post_init__(self) -> None:
        fits = isinstance(self.choices, (tuple, list)) and all(isinstance(each, str) for each in self.choices)
        if not fits or len(self.choices) < 2:
            raise ValueError(f"the choices are {shown(self.choices)}; they must be two texts or more")
        super().__post_init__()

    def asks(self, numbers: SimpleNamespace) -> str:
        *most, last = map(repr, self.choices)
        return f"Answer: {', '.join(most)} or {last}."

    def key(self, numbers: SimpleNamespace) -> str:
        return str(self.answer(numbers))

    def judge(self, attempt: object, numbers: SimpleNamespace, **how: object) -> Reply:
        said = " ".join(attempt.lower().split()) if isinstance(attempt, str) else None
        chosen = next((choice for choice in self.choices if " ".join(choice.lower().split()) == said), None)
        if chosen is None:
            return uncounted(f"{self.asks(numbers)} Given is {shown(attempt)}.")
        if chosen == self.answer(numbers):
            return Reply(True, f"Right: {chosen}.")
        return self._mistake(numbers, lambda made: made == chosen) or Reply(False, "It is not so.", known=False)


def changes(before: float, after: float, share: float = 1e-3) -> str:
    """What became of a number: ``"rises"``, ``"falls"``, or ``"stays"`` where it differs by less than a share.

    >>> changes(1.0, 2.0), changes(2.0, 1.0), changes(1.0, 1.0000001)
    ('rises', 'falls', 'stays')
    """
    refuse_arguments(changes, locals())
    if abs(after - before) <= share * abs(before):
        return "stays"
    return "rises" if after > before else "falls"
