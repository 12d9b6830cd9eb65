"""Numbers, texts and pictures in inches and pounds, for a workshop that works in these."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np

from ...units import convert, factor
from ...views.picture import Area, Band, Contour, Mark, Picture, Text

INSTEAD = {
    **dict.fromkeys(("mm", "cm", "um"), "in"),
    **dict.fromkeys(("N", "kN"), "lbf"),
    **dict.fromkeys(("kg", "g"), "lb"),
    **dict.fromkeys(("Pa", "MPa", "GPa"), "psi"),
    **dict.fromkeys(("W", "kW"), "hp"),
    "m": "ft",
    "J": "lbf ft",
}
"""Which units stand in the place of metric ones, as on a page that shows inches."""
_NAME = re.compile(r"[A-Za-zµ%°]+")
_NAMES = "|".join(sorted({*INSTEAD, "s", "deg", "rad", "min"}, key=len, reverse=True))
_PART = rf"(?:{_NAMES})(?:\^[-+]?[\d.]+)?(?![A-Za-z])"
_MEASURED = re.compile(rf"(?<![\w.^])(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?) ({_PART}(?:[ */]{_PART})*)(?![\w/^])")
"""A number with its unit in a text."""
_LABEL = re.compile(r"\[(10\^[-+]?\d+ )?([^\]]*)\]")
"""The unit of an axis."""
_POWERS = str.maketrans({"²": "^2", "³": "^3"})


def unit_in(unit: str, lengths: str) -> str:
    """The unit in which a number of ``unit`` is shown where lengths are in ``lengths``, ``"mm"`` or ``"in"``.

    >>> unit_in("N/mm", "in"), unit_in("m/s^2", "in"), unit_in("deg", "in"), unit_in("N/mm", "mm")
    ('lbf/in', 'ft/s^2', 'deg', 'N/mm')
    """
    return _NAME.sub(lambda name: INSTEAD.get(name[0], name[0]), unit) if lengths == "in" else unit


def words_in(text: str, lengths: str) -> str:
    """A text, each number with a unit in it as `unit_in` has it, to as many digits as it was written with.

    >>> words_in("the lift of 25.4 mm, at most 12.7 mm, at 30 deg", "in")
    'the lift of 1 in, at most 0.5 in, at 30 deg'
    """
    return _MEASURED.sub(lambda found: _rewritten(found[1], found[2], lengths), text)


def _rewritten(number: str, unit: str, lengths: str) -> str:
    other = unit_in(unit, lengths)
    digits = max(3, len(re.sub(r"e.*|\D", "", number).lstrip("0")))
    return f"{number if other == unit else f'{convert(float(number), unit, other):.{digits}g}'} {other}"


def picture_in(picture: Picture, lengths: str) -> Picture:
    """A picture, its axes and all on them as `unit_in` has their units."""
    (xlabel, across), (ylabel, up) = (_label_in(name, lengths) for name in (picture.axes.xlabel, picture.axes.ylabel))
    if xlabel == picture.axes.xlabel and ylabel == picture.axes.ylabel:
        return picture
    window: dict[str, Any] = {
        name: tuple(None if end is None else end * by for end in ends)
        for name, ends, by in (("xlim", picture.axes.xlim, across), ("ylim", picture.axes.ylim, up))
        if ends is not None
    }
    axes = replace(picture.axes, xlabel=xlabel, ylabel=ylabel, **window)
    return Picture(axes, tuple(_moved(mark, across, up, lengths) for mark in picture.marks))


def _label_in(label: str, lengths: str) -> tuple[str, float]:
    """What an axis shows, and by what its numbers are multiplied; a word that stands where units stand stays."""
    found = _LABEL.search(label)
    unit = found[2].translate(_POWERS) if found else ""
    other = _drawn(unit_in(unit, lengths))
    if not found or other == unit:
        return label, 1.0
    try:
        ratio = factor(unit) / factor(other)
    except ValueError:
        return label, 1.0
    return label.replace(found[0], f"[{found[1] or ''}{other}]"), ratio


def _drawn(words: str) -> str:
    """Words of a picture, in which psi would be read as the letter."""
    return re.sub(r"\bpsi\b", "lbf/in^2", words)


def _moved(mark: Mark, across: float, up: float, lengths: str) -> Mark:
    """A mark on axes whose numbers are so many times as large."""
    by = {"x": across, "y": up, "radius": across}
    if isinstance(mark, Area):
        by |= {"low": up, "high": up}
    if isinstance(mark, Band):
        by |= dict.fromkeys(("low", "high"), up if mark.along == "x" else across)
    new: dict[str, Any] = {name: np.asarray(getattr(mark, name)) * n for name, n in by.items() if hasattr(mark, name)}
    new["label"] = _drawn(words_in(mark.label, lengths))
    if isinstance(mark, Text):
        new["words"] = type(mark.words)(_drawn(words_in(mark.words, lengths)))
    if isinstance(mark, Contour):
        new["names"] = tuple(_drawn(words_in(name, lengths)) for name in mark.names)
    return replace(mark, **new)
