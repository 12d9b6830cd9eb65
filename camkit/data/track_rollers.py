"""Track rollers that can be bought: the sizes of a metric series."""

from __future__ import annotations

from ..units import mm
from . import load


def track_rollers() -> dict[str, tuple[float, float]]:
    """Radius and width (m) of the outer ring of stud-type track rollers of the series KR, by name.

    The data file beside this says where the sizes come from.  The width is that of the whole ring, whose face is
    crowned unless a maker says otherwise: a line contact is as long as that at most.

    >>> from camkit import Study, TranslatingRollerCam
    >>> from camkit.cam import ContactPair, peak_pressure
    >>> cam = TranslatingRollerCam(contact=ContactPair())
    >>> study = Study(cam, {("roller_radius", "contact.width"): track_rollers()}, (peak_pressure,))
    >>> study.menus[0].names[:3], study.design([2]).roller_radius, study.design([2]).contact.width
    (('KR 16', 'KR 19', 'KR 22'), 0.011, 0.012)
    """
    sizes = load("track_rollers_kr")["diameter_and_width"]
    return {name: (diameter / 2 * mm, width * mm) for name, (diameter, width) in sizes.items()}
