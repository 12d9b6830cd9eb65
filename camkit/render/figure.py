"""`picture`: views of a design in a still figure; matplotlib is loaded with the first one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..quantities import Measure
from ..views.picture import View

if TYPE_CHECKING:
    from .still import Still


def picture(
    shown: object,
    *views: View,
    width: float = 12.6,
    height: float | None = None,
    turn: float | None = None,
    azimuth: float | None = None,
    elevation: float | None = None,
    limits: Mapping[Measure, float] | None = None,
) -> Still:
    """A still figure of ``shown`` through ``views``: of a design (its analysis), or of what the views take.

    Without ``views`` it shows the shapes and curves that the analysis offers, in its order.  ``width`` and ``height``
    are inches; the height follows from how many views there are, unless it is given.

    ``turn``, ``azimuth``, ``elevation`` (rad) and ``limits`` go to the views that ask for them (see `draw`).
    """
    from .still import figure_of

    given = {"turn": turn, "azimuth": azimuth, "elevation": elevation}
    return figure_of(shown, *views, width=width, height=height, limits=limits, **given)


def small_png(*figures: Still) -> bytes:
    """Figures of the same width, each below the one before, as a PNG file of 256 colours; a white dot of none."""
    from .still import below

    return below(*figures)
