"""A motion program as the lines of Python that make it."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

from ... import motion
from ...motion import MotionProgram
from ...units import in_unit

IN_DEGREES = ("angle", "phase")
LEVELS = ("lift", "travel", "s", "start", "advance", "offset", "amplitude")
"""Fields whose numbers are in the follower's unit."""
DIGITS = 15


def code_of(program: MotionProgram, unit: str) -> str:
    """Lines that import what they need and make the program, angles in deg and levels in ``unit``.

    ``ValueError`` for a program that holds what has no name in `camkit.motion`, such as somebody's own law.

    >>> from camkit.motion import Dwell
    >>> from camkit.units import deg
    >>> print(code_of(MotionProgram((Dwell(120 * deg), Dwell(240 * deg))), "mm"))
    from camkit.motion import Dwell, MotionProgram
    from camkit.units import deg
    <BLANKLINE>
    program = MotionProgram(segments=(Dwell(angle=120 * deg), Dwell(angle=240 * deg)))
    """
    writer = _Writer(unit)
    made = writer.made(program)
    units = f"from camkit.units import {', '.join(sorted(writer.units))}\n" if writer.units else ""
    lines = textwrap.wrap(f"program = {made}", 112, subsequent_indent="    ", break_long_words=False)
    names = textwrap.wrap(", ".join(sorted(writer.names)), 90)
    imported = f"import {names[0]}" if len(names) == 1 else "import (\n    " + "\n    ".join(names) + ",\n)"
    return f"from camkit.motion {imported}\n{units}\n" + "\n".join(lines)


class _Writer:
    """Writes values, and notes the names that they need."""

    def __init__(self, unit: str) -> None:
        self.unit = unit
        self.names: set[str] = set()
        self.units: set[str] = set()

    def made(self, value: Any, field: str = "") -> str:
        """A value as code; a number of a ``field`` in its unit."""
        if isinstance(value, tuple):
            inner = ", ".join(self.made(one, field) for one in value)
            return f"({inner},)" if len(value) == 1 else f"({inner})"
        if isinstance(value, str) or value is None:
            return repr(value)
        if is_dataclass(value):
            return self._called(value)
        return self._number(float(value), field)

    def _number(self, value: float, field: str) -> str:
        unit = "deg" if field in IN_DEGREES else self.unit if field in LEVELS else ""
        if not unit or value == 0:
            return f"{value:.{DIGITS}g}" if value == float(f"{value:.{DIGITS}g}") else repr(value)
        self.units.add(unit)
        return f"{in_unit(value, unit):.{DIGITS}g} * {unit}"

    def _called(self, value: Any) -> str:
        """A constant of `camkit.motion`, or a class with what differs from its usual values."""
        known = [name for name in motion.__all__ if name.isupper() and getattr(motion, name) is value]
        name = known[0] if known else type(value).__name__
        if not known and getattr(motion, name, None) is not type(value):
            raise ValueError(f"{name} has no name in camkit.motion, so the program cannot be written as code")
        self.names.add(name)
        return name if known else f"{name}({', '.join(self._given(value))})"

    def _given(self, value: Any) -> Iterator[str]:
        for field in _written(fields(value)):
            given = getattr(value, field.name)
            if not _usual(field, given):
                yield f"{field.name}={self.made(given, field.name)}"


def _written(every: Sequence[Field[Any]]) -> list[Field[Any]]:
    return [field for field in every if field.init]


def _usual(field: Field[Any], given: object) -> bool:
    """Whether a field holds what it holds without being told."""
    usual = field.default if field.default is not MISSING else None
    if field.default_factory is not MISSING:
        usual = field.default_factory()
    return (field.default is not MISSING or field.default_factory is not MISSING) and bool(given == usual)
