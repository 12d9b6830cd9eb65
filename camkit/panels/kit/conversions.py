"""What a design can be made into at one stroke, by a button of its page."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...quantities import Conversion, words
from ...quantities.kinds import shown

if TYPE_CHECKING:
    from ..instrument import Instrument


def offered(design: object) -> list[dict[str, str]]:
    """The buttons of a page: what is on them, by which quantities they stand, what they do."""
    return [{"name": one.name, "part": words(one.part), "meaning": one.meaning} for one in _conversions_of(design)]


def _conversions_of(design: object) -> Iterable[Conversion]:
    return getattr(design, "conversions", ())


def convert(app: Instrument, name: object) -> None:
    """Show what the design becomes, and say what is to be said of it; ``ValueError`` in a sentence where it cannot."""
    named = {one.name: one for one in _conversions_of(app.design)}
    if name not in named:
        raise ValueError(f"there is no button {shown(name)} here")
    design, remark = named[name].make()
    app.load(design)
    if remark and app.design == design:  # else it cannot be computed, which the page says
        app.message = remark
