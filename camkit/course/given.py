"""The numbers of an exercise: drawn for each learner, the same at every opening, on every machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from types import SimpleNamespace

from ..quantities.kinds import refuse_kinds, shown
from ..units import factor, in_unit
from .replies import raised

MOST = 1e9
"""So many numbers there may be in a range."""


@dataclass(frozen=True)
class Range:
    """From ``low`` to ``high`` in steps, all in ``unit``: what a person reads is what is computed with.

    >>> lift = Range(10, 30, 2, "mm")
    >>> lift.count, lift.text(lift.at(3))
    (11, '16 mm')
    """

    low: float
    high: float
    step: float
    unit: str = ""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        factor(self.unit)
        if not (self.step > 0 and self.high >= self.low):
            raise ValueError(f"a range from {self.low:g} to {self.high:g} by {self.step:g} has no numbers in it")
        if not (self.high - self.low) / self.step < MOST:
            raise ValueError(f"a range from {self.low:g} to {self.high:g} by {self.step:g} has too many numbers in it")

    @property
    def count(self) -> int:
        """How many numbers there are."""
        return int((self.high - self.low) / self.step + 1e-9) + 1

    def at(self, place: int) -> float:
        """One of them, SI."""
        return float(f"{self.low + place * self.step:.12g}") * factor(self.unit)

    def text(self, value: float) -> str:
        """A number with its unit, as a question says it."""
        return f"{in_unit(value, self.unit):.6g} {raised(self.unit)}".rstrip().replace(" deg", "°")


Given = Mapping[str, Range | Sequence[object]]
"""What is drawn, by its name: a number from a range, or one of several things, such as motion laws."""


def drawn(given: Given, learner: str, exercise: str) -> SimpleNamespace:
    """The numbers of a learner, SI, each by its name.

    Hashed rather than taken from a random generator: no version of Python draws others.

    >>> sorted({drawn({"lift": Range(10, 30, 10, "mm")}, f"learner {i}", "a rise").lift for i in range(20)})
    [0.01, 0.02, 0.03]
    """
    return SimpleNamespace(**{name: _one(options, f"{learner}|{exercise}|{name}") for name, options in given.items()})


def _one(options: Range | Sequence[object], key: str) -> object:
    if not isinstance(options, Range) and not (isinstance(options, (tuple, list)) and options):
        raise ValueError(f"what is drawn from is {shown(options)}; it must be a Range, or a list with something in it")
    count = options.count if isinstance(options, Range) else len(options)
    place = int.from_bytes(sha256(key.encode("utf-8", "replace")).digest()[:8], "big") % count
    return options.at(place) if isinstance(options, Range) else options[place]


def texts(given: Given, numbers: SimpleNamespace) -> dict[str, str]:
    """What was drawn as a question says it: with its unit; a law by its name."""
    return {name: _text(given[name], value) for name, value in vars(numbers).items()}


def _text(options: Range | Sequence[object], value: float) -> str:
    return options.text(value) if isinstance(options, Range) else str(getattr(value, "name", value))
