"""What a learner is answered: a sentence, and whether it was right."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ..quantities.markup import RAISED, attribute, html

UNITS = {
    10.0: "Centimetres are written 4.7 * cm.",
    25.4: "Inches are written 2 * inch.",
    math.pi / 180: "Degrees are written 60 * deg.",
    2 * math.pi: "Speeds are written 300 * rpm.",
    1000.0: "Millimetres are written 47 * mm.",
}
"""By which factor a number in another unit is too large or too small, and what is then to be said."""
NEXT = "The worked solution is in the folded cell below, or with your instructor."


@dataclass(frozen=True)
class Reply:
    """An answer to an attempt: whether it was ``right``, in a sentence; ``counted`` unless it was no attempt at all."""

    right: bool
    sentence: str
    counted: bool = True
    known: bool = True
    """Whether it says what was wrong; else a hint is added."""

    def __repr__(self) -> str:
        return f"{'✓' if self.right else '✗' if self.counted else '…'} {self.sentence}"

    def _repr_html_(self) -> str:
        colour = "#1a7f37" if self.right else "#b3541e" if self.counted else "inherit"
        style = attribute("style", f"border-left:4px solid {colour};padding:2px 0 2px 10px;margin:4px 0")
        return html("<p role='status' {}>{}</p>", style, repr(self))


def uncounted(sentence: str) -> Reply:
    """What was no attempt."""
    return Reply(False, sentence, counted=False)


def wrong_unit(value: float, answer: float, tolerance: float) -> str:
    """What to say of a number that is right in another unit, or but for its sign; nothing of any other.

    >>> print(wrong_unit(47.3, 0.0473, 0.01))
    Right, but in another unit: it is 1000 times too large. Millimetres are written 47 * mm.
    """
    for by, why in UNITS.items():
        for scale in (by, 1 / by):
            if close(value, answer * scale, tolerance):
                size = "large" if scale > 1 else "small"
                return f"Right, but in another unit: it is {max(scale, 1 / scale):.4g} times too {size}. {why}"
    return "Right, but for its sign." if close(value, -answer, tolerance) else ""


def close(value: float, answer: float, tolerance: float) -> bool:
    """Whether two numbers differ by no more than a share of the second."""
    return abs(value - answer) <= tolerance * abs(answer)


def raised(unit: str) -> str:
    """A unit with its powers as they are read.

    >>> raised("m/s^2")
    'm/s²'
    """
    return re.sub(r"\^([+-]?[\d.]+)", lambda power: "".join(RAISED[letter] for letter in power[1]), unit)
