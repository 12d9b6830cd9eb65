"""What a view asks for beside the analysis: where the mechanism stands, and from where it is seen."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..quantities import Quantity, words
from ..quantities.kinds import shown as said
from ..study.tolerances import ANGLES
from ..views.picture import Picture, View

POSITIONS = ("turn", "azimuth", "elevation")
"""What a view may ask for beside the analysis: where the mechanism stands, from where it is seen (rad)."""


def positions_of(view: View) -> tuple[str, ...]:
    """Which of `POSITIONS` a view takes."""
    takes = inspect.signature(view).parameters
    return tuple(name for name in POSITIONS if name in takes)


VIEWPOINT = {
    "azimuth": Quantity("az", -60, -180, 180, "deg", "turns the view about the vertical", above=None),
    "elevation": Quantity("el", 25, -90, 90, "deg", "tilts the view", above=None),
}
"""From where a mechanism in space is seen."""


def turn_range(analysis: object) -> tuple[str, Any, Any]:
    """The angle that turns the mechanism, by name, and from where to where: as the analysis says, or over its own."""
    angle = next((name for name in ANGLES if hasattr(analysis, name)), None)
    if angle is None:
        raise ValueError(f"what is shown has no {' or '.join(map(words, ANGLES))} to turn it by")
    if hasattr(analysis, "turn_range"):
        return angle, *analysis.turn_range
    values = getattr(analysis, angle)
    return angle, np.min(values), np.max(values)


def given_to(view: View, asked: Mapping[str, Any]) -> dict[str, Any]:
    """What of ``asked`` a view takes."""
    takes = inspect.signature(view).parameters
    return {name: value for name, value in asked.items() if name in takes}


def made_by(view: View, analysis: object, given: Mapping[str, Any]) -> Picture:
    """The picture that a view makes; ``ValueError`` for anything else that it gives."""
    made = view(analysis, **given)
    if not isinstance(made, Picture):
        raise ValueError(f"the view {view_name(view)} gives {said(made)}; a view gives a Picture")
    return made


def view_name(view: View) -> str:
    """How a view is called in a sentence."""
    return getattr(view, "__name__", "that is given").replace("_", " ")


def name_of(view: View) -> str:
    """How a view is called in Python."""
    return str(getattr(view, "__name__", "") or getattr(getattr(view, "func", None), "__name__", "view"))
