"""What a person moves, chooses or types on a sheet: `value` is what it says, `observe(f, "value")` hears of it.

Numbers are read in the page, which refuses in place what is none; Python receives numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import traitlets

from ...files.json_file import MOST_BYTES
from ...quantities import Quantity, words
from ...units import in_unit
from .parts import Button, Message, Part


class Input(Part):
    """Something with a name and a ``value`` that a person changes."""

    description = traitlets.Unicode("").tag(page=True)
    disabled = traitlets.Bool(False).tag(page=True)
    value: Any = traitlets.Any().tag(page=True)

    def take(self, message: Message) -> None:
        """Another value."""
        self.value = message["value"]


class Number(Input):
    """A quantity with symbol, slider, box and unit; ``value`` is in SI, exact.

    A number typed into the box counts to its last digit, even outside the slider's range.  ``moved()`` is called
    for another number, ``refused(sentence)`` for one that is far too large; the last number then stays.
    """

    kind = "number"
    value = traitlets.Float().tag(page=True)

    def __init__(
        self,
        name: str,
        declared: Quantity,
        value: float,
        moved: Callable[[], None] = lambda: None,
        refused: Callable[[str], None] = lambda sentence: None,
        **given: object,
    ) -> None:
        self.name, self.declared, self._moved, self._refused = name, declared, moved, refused
        super().__init__(value=float(value), **given)

    def described(self) -> dict[str, object]:
        """With its declaration."""
        own = ("symbol", "unit", "low", "high", "meaning", "factor")
        declared = {name: getattr(self.declared, name) for name in own} | {"name": words(self.name)}
        return {**super().described(), "declared": declared}

    def set(self, value: float) -> None:
        """Show ``value`` (SI) without telling anyone but the page."""
        self.value = float(value)

    def take(self, message: Message) -> None:
        """Another number; one that is far too large is refused."""
        value = float(message["value"])
        if not math.isfinite(value):
            return
        if far_too_large(self.declared, value):
            typed = f"{in_unit(value, self.declared.unit):.6g} {self.declared.unit}".rstrip()
            why = f"{typed} was typed; it must be {self.declared.possible_for(value)}"
            self._refused(f"The {words(self.name)} stays as before: {why}.")
            return
        self.value = value
        self._moved()


def far_too_large(declared: Quantity, value: float) -> bool:
    """Whether a finite ``value`` (SI) cannot be and is also larger than all that its slider offers."""
    largest = max(abs(declared.low), abs(declared.high)) * declared.factor
    return math.isfinite(value) and abs(value) > largest and not declared.allows(value)


class Menu(Input):
    """One choice among ``options``, names or pairs of a name and a value; ``None``: nothing is chosen."""

    kind = "menu"
    value = traitlets.Any()
    options = traitlets.Any(())

    def __init__(self, options: Sequence[object], description: str = "", **given: object) -> None:
        options = tuple(options)
        first = {"value": _value(options[0])} if options and "value" not in given else {}
        super().__init__(options=options, description=description, **first, **given)

    def described(self) -> dict[str, object]:
        """With the names of its options, and which is chosen."""
        return {**super().described(), "names": [_name(option) for option in self.options], "chosen": self.index}

    def offer(self, options: Sequence[object], value: object) -> None:
        """Other options, and which of them is chosen."""
        with self.hold_trait_notifications():
            self.options, self.value = tuple(options), value

    @property
    def values(self) -> list[object]:
        """What can be chosen."""
        return [_value(option) for option in self.options]

    @property
    def index(self) -> int | None:
        """Which option is chosen."""
        return next((k for k, value in enumerate(self.values) if value is self.value or value == self.value), None)

    def take(self, message: Message) -> None:
        """Another option, by its place."""
        self.value = self.values[message["value"]]

    @traitlets.validate("value")
    def _offered(self, proposal: Mapping[str, object]) -> object:
        value = proposal["value"]
        if value is not None and value not in self.values:
            raise traitlets.TraitError(f"{value!r} is none of the options")
        return value


class Scale(Menu):
    """A slider over its options, in their order."""

    kind = "scale"
    pale = traitlets.Bool(False).tag(page=True)
    """Whether what it shows is not said by anybody."""


class Whole(Input):
    """A whole number from ``min`` to ``max``, in a box or under a slider; one that is set is moved between them."""

    kind = "whole"
    min = traitlets.Int(0).tag(page=True)
    max = traitlets.Int(2**31).tag(page=True)
    slider = traitlets.Bool(False).tag(page=True)
    value = traitlets.Int(0).tag(page=True)

    def __init__(self, value: int, low: int, high: int, description: str, **given: object) -> None:
        super().__init__(min=low, max=high, value=value, description=description, **given)

    def take(self, message: Message) -> None:
        """Another number in the range."""
        value = message["value"]
        if not self.min <= value <= self.max or value != int(value):
            must = f"it must be a whole number from {self.min} to {self.max}"
            raise ValueError(f"the {self.description} is {value:g}; {must}")
        self.value = int(value)

    @traitlets.validate("value")
    def _between(self, proposal: Mapping[str, int]) -> int:
        return min(max(proposal["value"], self.min), self.max)


class Check(Input):
    """Yes or no."""

    kind = "check"
    value = traitlets.Bool(False).tag(page=True)


class Amount(Input):
    """A box for a number in a ``unit``, or with one that goes into it."""

    kind = "amount"
    value = traitlets.Float(0.0).tag(page=True)
    unit = traitlets.Unicode("").tag(page=True)
    named = traitlets.Bool(False).tag(page=True)
    """Whether its description stands before it, to be seen."""


class Typed(Input):
    """A box for a text."""

    kind = "typed"
    value = traitlets.Unicode("").tag(page=True)
    placeholder = traitlets.Unicode("").tag(page=True)
    named = traitlets.Bool(False).tag(page=True)
    """Whether its description stands before it, to be seen."""


class Span(Input):
    """From a least to a greatest value between ``min`` and ``max``, in a ``unit``."""

    kind = "span"
    unit = traitlets.Unicode("").tag(page=True)
    min = traitlets.Float(0.0).tag(page=True)
    max = traitlets.Float(1.0).tag(page=True)
    value = traitlets.Tuple((0.0, 1.0)).tag(page=True)

    def take(self, message: Message) -> None:
        """Other ends."""
        low, high = map(float, message["value"])
        self.value = (min(low, high), max(low, high))


class Download(Button):
    """A button; pressing it downloads what ``content()`` returns at that moment as ``filename``.

    ``refused(sentence)`` is called where there is nothing to be had, with the reason.
    """

    def __init__(
        self,
        description: str,
        filename: str,
        mime: str,
        content: Callable[[], str],
        refused: Callable[[str], None] | None = None,
    ) -> None:
        self.filename, self.mime, self.content, self.refused = filename, mime, content, refused
        self.send: Callable[[dict[str, str]], None] = lambda file: None
        super().__init__(description, self._pressed)

    def _pressed(self) -> None:
        try:
            text = self.content()
        except ValueError as refusal:
            if self.refused is None:
                raise
            self.refused(f"Nothing is saved: {refusal}.")
        else:
            self.send(self.sent(text))

    def sent(self, text: str) -> dict[str, str]:
        """What the page is told."""
        return {"name": self.filename, "mime": self.mime, "text": text}


class Copy(Download):
    """A button; pressing it puts what ``content()`` returns at that moment where a person pastes from."""

    def __init__(self, description: str, content: Callable[[], str], refused: Callable[[str], None]) -> None:
        super().__init__(description, "", "text/plain", content, refused)

    def sent(self, text: str) -> dict[str, str]:
        """What the page is told."""
        return {"copy": text}


class Upload(Part):
    """A button; ``use(data)`` is called with the bytes of the file that a person chooses."""

    kind = "upload"
    description = traitlets.Unicode("").tag(page=True)
    accept = traitlets.Unicode(".json").tag(page=True)
    most = traitlets.Int(MOST_BYTES + 1).tag(page=True)

    def __init__(self, description: str, use: Callable[[bytes], None], **given: object) -> None:
        self.use = use
        super().__init__(description=description, **given)

    def take(self, message: Message) -> None:
        """A file."""
        self.use(bytes(message["buffers"][0]))


def _name(option: object) -> str:
    return str(option[0]) if isinstance(option, tuple) else str(option)


def _value(option: object) -> object:
    return option[1] if isinstance(option, tuple) else option
