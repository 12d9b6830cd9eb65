"""What an entry of a saved file may be: names, lists, numbers; anything else is refused in a sentence."""

from __future__ import annotations

import re
from typing import Any

from ..quantities.kinds import shown
from .entries import MOST_ROWS, is_number

PLAIN = re.compile(r"\w[\w +,.:;()/%^-]*")
"""Names in files: letters, digits, spaces and the signs of camkit's own names."""


def mapping(entry: object, name: str) -> dict[str, object]:
    """``entry`` if it is an object of JSON: names and values."""
    if not isinstance(entry, dict):
        raise ValueError(f"the file is damaged: it says {shown(entry)} for {name!r}, where names and values belong")
    return entry


def listed(entry: object, name: str) -> list[Any]:
    """``entry`` if it is a list that is not too long."""
    if not isinstance(entry, list):
        raise ValueError(f"the file is damaged: it says {shown(entry)} for {name!r}, where a list belongs")
    if len(entry) > MOST_ROWS:
        raise ValueError(f"the file has {len(entry)} entries in {name!r}; there can be at most {MOST_ROWS}")
    return entry


def all_numbers(entry: object, name: str, count: int) -> list[float]:
    """``entry`` if it is a list of so many numbers."""
    if not isinstance(entry, list) or len(entry) != count or not all(map(is_number, entry)):
        said = f"{shown(entry)} for {shown(name)}, where {count} numbers belong"
        raise ValueError(f"the file is damaged: it says {said}")
    return [float(number) for number in entry]


def plain(name: object, longest: int = 100) -> str:
    """``name`` if a file may have it."""
    if not isinstance(name, str) or not PLAIN.fullmatch(name) or len(name) > longest:
        raise ValueError(
            f"the file has the name {shown(name)}; a name has up to {longest} letters, digits, spaces and "
            "+ , - . / : ; ( ) % ^"
        )
    return name


def message(entry: object) -> str:
    """What a front says, which may be nothing."""
    return plain(entry, 1000) if entry != "" else ""
