"""Numbers as people type them: read as they are meant, or refused, and never as another number.

>>> typed_number("48,09"), typed_number(" -1e3 "), typed_number("2 in", "mm")
(48.09, -1000.0, 50.8)
>>> typed_number("1,234")
Traceback (most recent call last):
    ...
ValueError: '1,234' may be 1.234 or 1234; write 1.234 or 1234
"""

from __future__ import annotations

import re
from sys import float_info

from . import convert

LONGEST = 40
"""So many characters at most are read as a number."""
_NUMBER = re.compile(r"[+-]?([0-9]+[.,]?[0-9]*|[.,][0-9]+)([eE][+-]?[0-9]+)?")
_WITH_UNIT = re.compile(rf"({_NUMBER.pattern})\s*(?P<unit>[A-Za-zµμ%°].*)")
"""A number, and from a letter on its unit."""
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}")
_MINUS = str.maketrans("−–－", "---")


def typed_number(text: str, unit: str | None = None) -> float:
    """The number that ``text`` says, with a decimal point or a decimal comma; in ``unit`` where it may have a unit.

    Raises ``ValueError`` in a sentence for everything else: fractions, separated thousands, nothing at all, units that
    are not known or measure something else.
    """
    plain = _plain(text)
    if not plain:
        raise ValueError("an empty box is no number")
    if unit is not None and len(plain) <= LONGEST and not _NUMBER.fullmatch(plain):
        with_unit = _WITH_UNIT.fullmatch(plain)
        if with_unit:
            return convert(_plain_number(with_unit[1], text), with_unit["unit"], unit)
    return _plain_number(plain, text)


def _plain_number(plain: str, text: str) -> float:
    """The number ``plain``, which was typed as ``text`` or a part of it."""
    if len(plain) > LONGEST or not _NUMBER.fullmatch(plain):
        raise ValueError(f"{_short(text)} is no number; 48.09, 48,09 and 1e3 are")
    if _THOUSANDS.fullmatch(plain):
        raise ValueError(
            f"{_short(text)} may be {plain.replace(',', '.')} or {plain.replace(',', '')}; "
            f"write {plain.replace(',', '.')} or {plain.replace(',', '')}"
        )
    value = float(plain.replace(",", "."))
    if abs(value) < float_info.min and re.search("[1-9]", plain.lower().partition("e")[0]):
        raise ValueError(f"{_short(text)} is too small for a computer")
    if abs(value) == float("inf"):
        raise ValueError(f"{_short(text)} is too large for a computer")
    return value


def _plain(text: str) -> str:
    """What was typed, without spaces around it and with a minus that a computer knows."""
    if not isinstance(text, str):
        raise ValueError(f"what is typed is {repr(text)[:LONGEST]}; it must be a text")
    return text.strip().translate(_MINUS)


def _short(text: str) -> str:
    return repr(text if len(text) <= LONGEST else f"{text[:LONGEST]}...")
