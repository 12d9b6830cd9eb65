"""Texts whose numbers are known when a program runs: what stands between them is known before."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from secrets import token_hex

from ..quantities.known import text_of
from ..quantities.types import Value

Part = tuple[int, "str | Template"]
"""The result of a call by its number: to be written by a format, or a text that is there if it holds."""
Template = tuple[str | Part, ...]
SPEC = re.compile(r"~?(measure|\+?,?(\.\d+)?[efg%])")
"""The formats that a page can write (see `camkit.quantities.text_of`)."""


class Texts:
    """What a recording is asked to write; in a text a token stands for it, which no name of a design can hold."""

    def __init__(self) -> None:
        self._parts: list[Part] = []
        self._token = token_hex(8)

    def placed(self, part: Part) -> str:
        """The token of a part."""
        self._parts.append(part)
        return f"<{self._token} {len(self._parts) - 1}>"

    def parted(self, words: str) -> Template:
        """A text in parts."""
        pieces = re.split(f"<{self._token} (\\d+)>", words)
        parts = (self._parts[int(piece)] if i % 2 else piece for i, piece in enumerate(pieces))
        return tuple(part for part in parts if part)


def filled(template: Template, results: Mapping[int, Value]) -> str:
    """The text, with the results of calls.

    >>> filled(("it is ", (3, ".2f"), " mm", (5, (" wide",))), {3: 1.234, 5: False})
    'it is 1.23 mm'
    """
    return "".join(part if isinstance(part, str) else _said(*part, results) for part in template)


def _said(number: int, how: str | Template, results: Mapping[int, Value]) -> str:
    if isinstance(how, str):
        return text_of(results[number], how)
    return filled(how, results) if results[number] else ""


def numbers(template: Template) -> Iterator[int]:
    """The calls whose results are in a text."""
    for part in template:
        if not isinstance(part, str):
            yield part[0]
            yield from () if isinstance(part[1], str) else numbers(part[1])
