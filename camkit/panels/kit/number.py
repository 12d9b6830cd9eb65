"""Boxes to type a number in: what is no number is refused in a sentence, and the last number stays."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from ...units.typed import typed_number, typed_whole


def staying(what: str, tell: Callable[[str], None], verb: str = "stays") -> Callable[[str], None]:
    """For a box's ``refused``: ``tell`` that ``what`` stays, and why; nothing where there is no reason.

    >>> staying("bounds", print, "stay")("'x' is no number")
    The bounds stay as before: 'x' is no number.
    """
    return lambda why: tell(f"The {what} {verb} as before: {why}." if why else "")


class NumberBox(anywidget.AnyWidget):
    """A box for a number; ``value`` is the last one that could be read, and ``text`` what the page shows.

    ``refused(sentence)`` is called for a text that is none, with an empty sentence before each number that is taken.
    The arrow keys go up and down by ``step``.  A number may be typed with a unit that goes into ``unit``.
    """

    _esm = Path(__file__).with_name("number.js").read_text(encoding="utf-8")
    text = traitlets.Unicode("").tag(sync=True)
    description = traitlets.Unicode("").tag(sync=True)
    description_width = traitlets.Unicode("").tag(sync=True)
    meaning = traitlets.Unicode("").tag(sync=True)
    step = traitlets.Float(1.0).tag(sync=True)
    whole = traitlets.Bool(False).tag(sync=True)
    disabled = traitlets.Bool(False).tag(sync=True)
    value: Any = traitlets.Float(0.0)

    def __init__(
        self, value: float, refused: Callable[[str], None], unit: str | None = None, **options: object
    ) -> None:
        super().__init__(**options)
        self.refused, self.unit, self._told = refused, unit, ""
        self.value = value
        self._show()
        self.observe(lambda _: self._show(), "value")
        self.observe(lambda change: self._typed(change.new), "text")

    def _show(self) -> None:
        self._told = f"{self.value:.12g}"
        self.text = self._told

    def _typed(self, text: str) -> None:
        """What the page says, unless it is what was told to it."""
        if text == self._told:
            return
        try:
            value = self._read(text)
        except ValueError as refusal:
            self._show()
            self.refused(str(refusal))
        else:
            self.refused("")
            self.value = value
            self._show()

    def _read(self, text: str) -> float:
        return typed_number(text, self.unit)


class WholeBox(NumberBox):
    """A box for a whole number from ``min`` to ``max``; a number set by a program is moved between them."""

    value: Any = traitlets.Int(0)
    min = traitlets.Int(0)
    max = traitlets.Int(2**31)

    def __init__(self, value: int, low: int, high: int, refused: Callable[[str], None], **options: Any) -> None:
        super().__init__(value, refused, min=low, max=high, whole=True, **options)

    @traitlets.validate("value")
    def _between(self, proposal: Mapping[str, int]) -> int:
        return min(max(proposal["value"], self.min), self.max)

    def _read(self, text: str) -> int:
        return typed_whole(text, self.min, self.max)
