"""Measures of a cam's timing: when and for how long its follower is above a lift, as cam cards print it."""

from __future__ import annotations

from typing import Any

from ..motion.card import card_of
from ..quantities import Measure
from ..quantities.kinds import one_number, refuse_arguments, shown
from ..quantities.types import Value
from ..units import follower_unit, in_unit

NUMBERS = {
    "opening": "opens",
    "closing": "closes",
    "duration": "duration",
    "lobe centre": "centre",
    "lobe area": "area",
    "lobe area over it": "area_over",
}
"""What can be measured at a lift, and what a `camkit.motion.card.CamCard` calls it; angles count from the nose."""


def at_lift(what: str, lift: float, lash: float = 0.0, ratio: float = 1.0, unit: str = "mm") -> Measure:
    """A number of the cam card at a ``lift`` (m, or rad of an arm), for tables, limits and objectives.

    ``what`` is ``opening``, ``closing`` or ``lobe centre`` (cam angles from the nose), ``duration``, ``lobe area`` or
    ``lobe area over it``.  The lift counts from the base circle, ramps included; with a ``lash`` and the ``ratio`` of a
    rocker it is the valve's, ``i max(s - c, 0)`` (see `camkit.motion.cam_card`).  ``unit`` is the follower's.  Of a
    machine with several cam curves it is that of the first.  Where the lift is never reached, the duration and the
    areas are 0, the angles ``nan``.

    >>> from camkit import TranslatingRollerCam, mm
    >>> open_for = at_lift("duration", 1 * mm)
    >>> print(f"{open_for.name}: {open_for.text(open_for(TranslatingRollerCam().analyse()))}")
    duration at 1 mm lift: 251.5 deg

    Raises ``ValueError`` in a sentence for what no card has, a lift that is not above 0, a lash below 0 and a ratio
    that is not above 0.
    """
    refuse_arguments(at_lift, locals())
    if what not in NUMBERS:
        raise ValueError(f"{shown(what)} is not on a cam card; there are {', '.join(NUMBERS)}")
    follower_unit(unit)
    lift = one_number(lift, "the lift of the card", "be a finite number above 0", lambda value: 0 < value < 1e6)
    lash = one_number(lash, "the lash", "be a finite number of at least 0", lambda value: 0 <= value < 1e6)
    ratio = one_number(ratio, "the ratio of the rocker", "be a finite number above 0", lambda value: 0 < value < 1e6)

    def number(analysis: Any) -> Value:
        curve = next(iter(analysis.curves.values()))
        found: Value = getattr(card_of(curve.cam.motion, lift, lash, ratio), NUMBERS[what])
        return found

    name = f"{what} at {in_unit(lift, unit):.6g} {unit} lift"
    name += f", lash {in_unit(lash, unit):.6g} {unit}" if lash else ""
    name += f", rocker {ratio:.6g}" if ratio != 1 else ""
    per = "deg" if "area" not in what else "deg^2" if unit == "deg" else f"{unit} deg"
    return Measure(name, per, number, made=("at lift", what, lift, lash, ratio, unit))
