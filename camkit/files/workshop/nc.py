"""What a control makes of a program of G-code: the moves, read from the text alone."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...quantities.types import Array
from ...units import inch, mm

RAPID, LINE, CLOCKWISE, COUNTER = 0, 1, 2, 3
_MODES = {17, 40, 43, 49, 54, 64, 80, 90, 91.1, 94}
"""What is said once and changes no move of such a program."""
_WORD = re.compile(r"([A-Z])([+-]?(?:\d+\.?\d*|\.\d+))")
_COMMENT = re.compile(r"\([^()]*\)")


class Move(NamedTuple):
    """One move of the tool: along which curve it goes, from where to where, m."""

    kind: int
    """`RAPID`, `LINE`, or an arc `CLOCKWISE` or `COUNTER` clockwise."""
    start: Array
    """``(3,)``."""
    end: Array
    centre: Array
    """Of an arc, ``(2,)``; ``nan`` of a line."""
    feed: float
    """m/s."""

    @property
    def bulge(self) -> float:
        """``tan(sweep / 4)``, > 0 counter-clockwise; 0 of a line; of a whole turn ``inf``."""
        if self.kind in (RAPID, LINE):
            return 0.0
        one, other = (point[:2] - self.centre for point in (self.start, self.end))
        sense = 1 if self.kind == COUNTER else -1
        sweep = sense * np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other) % (2 * np.pi)
        return float(sense * np.tan((sweep or 2 * np.pi) / 4))

    @property
    def mismatch(self) -> float:
        """By how much the radii at both ends of an arc differ, m; 0 of a line."""
        if self.kind in (RAPID, LINE):
            return 0.0
        one, other = (float(np.hypot(*(point[:2] - self.centre))) for point in (self.start, self.end))
        return abs(one - other)


def moves(program: str) -> Iterator[Move]:
    """The moves of a program, one after the other, from the first place that it names.

    >>> for move in moves("G21 G90 G0 X1. Y0. Z5.\\nG1 X2. F60.\\nG3 X1. Y1. I-1. J0.\\nM30"):
    ...     print(move.kind, (move.end / mm).round(6).tolist(), round(move.bulge, 6))
    1 [2.0, 0.0, 5.0] 0.0
    3 [1.0, 1.0, 5.0] 0.414214

    Raises ``ValueError`` for a word that such a program does not have: it would be read wrongly.
    """
    worth, kind, feed, place = mm, RAPID, 0.0, np.full(3, np.nan)
    for line in program.splitlines():
        words = _words(line)
        for letter, number in words:
            if letter == "G" and number in (20, 21):
                worth = inch if number == 20 else mm
            elif letter == "G" and number in (RAPID, LINE, CLOCKWISE, COUNTER):
                kind = int(number)
            elif letter == "G" and number not in _MODES:
                raise ValueError(f"the program has G{number:g}, which is not known here")
        values = {letter: worth * number for letter, number in words}
        feed = values.get("F", 60 * feed) / 60
        end = np.array([values.get(axis, at) for axis, at in zip("XYZ", place, strict=True)])
        if {"X", "Y", "Z"} & values.keys():
            if not np.isnan(place).any():
                aside = np.array([values["I"], values["J"]]) if kind >= CLOCKWISE else np.nan
                centre = place[:2] + aside
                yield Move(kind, place, end, centre, feed)
            place = end
        if any(letter == "M" and number in (2, 30) for letter, number in words):
            return


def _words(line: str) -> list[tuple[str, float]]:
    """The words of a line without its comments."""
    said = _COMMENT.sub("", line).replace(" ", "").strip("%")
    found = [(letter, float(number)) for letter, number in _WORD.findall(said)]
    if _WORD.sub("", said) or len({letter for letter, _ in found} & {*"XYZIJF"}) < sum(w[0] in "XYZIJF" for w in found):
        raise ValueError(f"the line {line!r:.60} of the program cannot be read")
    return found
