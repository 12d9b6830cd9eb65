"""What a cam card says of a motion: when it opens and closes at a lift, for how long, its lobe centre and its area.

The follower's lift counts from the base circle, its lowest level, ramps included.  A lash ``c`` is taken up first and
a rocker of ratio ``i`` multiplies what is left: the valve is lifted by ``i max(s - c, 0)``; all numbers are of that.

Source: Norton, Cam Design and Manufacturing Handbook (valve cams); the terms are those of printed cam cards.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..extrema import Extreme, highest
from ..quantities import known, unless
from ..quantities.kinds import a_number, refuse_arguments, refuse_unequal
from ..quantities.types import Array, Value
from .closing import TURN
from .law import Kinematics, polynomial
from .program import MotionProgram

ROUNDS = 14
"""Of Newton's method, with halvings where it leads astray, for the angle at which a level is passed."""
FLAT = 1e-13
"""Levels that differ by less than this share of the travel are both the highest."""


@dataclass(frozen=True)
class CamCard:
    """The numbers of a cam card at one lift: angles of the cam, rad, areas in the follower's unit times rad.

    Of a population each is ``(p,)``.  ``nan`` where the lift is never reached, whose ``duration`` and areas are 0.
    """

    opens: Value
    """Where the lift is first reached, from the nose or from the ``zero`` that was asked for; before it: below 0."""
    closes: Value
    """Where it is left for the last time."""
    duration: Value
    area: Value
    """Under the lift, from opening to closing."""
    area_over: Value
    """Of what is above the lift of the card."""
    whole_area: Value
    """Under all of the lift."""
    nose: Value
    """The cam angle of the motion at which the follower is highest; of an upper dwell its middle."""
    peak: Value
    """The largest lift."""

    @property
    def centre(self) -> Value:
        """The lobe centre: midway between opening and closing."""
        return (self.opens + self.closes) / 2

    @property
    def crank(self) -> CamCard:
        """The same in angles of a crank that turns twice as often, its areas with them."""
        names = ("opens", "closes", "duration", "area", "area_over", "whole_area", "nose")
        return replace(self, **{name: 2 * getattr(self, name) for name in names})


def cam_card(
    motion: MotionProgram, lift: Value, *, lash: Value = 0.0, ratio: Value = 1.0, zero: Value | None = None
) -> CamCard:
    """The numbers of a cam card at a ``lift`` (m or rad) above the base circle, ramps included, exact to rounding.

    With a ``lash`` and the ``ratio`` of a rocker ``lift`` is the valve's, ``i max(s - c, 0)``, and so are the areas.
    Angles count from the nose, or from the cam angle ``zero`` (rad), such as that of a dead centre.

    >>> from camkit.motion import Dwell, Poly345, Poly4567, Return, Rise
    >>> from camkit.units import deg, mm
    >>> up, down = Rise(60 * deg, 10 * mm, Poly345()), Return(75 * deg, 10 * mm, Poly4567())
    >>> card = cam_card(MotionProgram((up, down, Dwell(225 * deg))), 1 * mm)
    >>> print(*(f"{angle / deg:.6f}" for angle in (card.opens, card.closes, card.duration, card.centre)))
    -45.201813 54.104846 99.306659 4.451517
    >>> print(f"{card.area / mm / deg:.6f} of {card.whole_area / mm / deg:.6f} mm deg")
    666.146258 of 675.000000 mm deg

    A population may have columns ``(p, 1)`` of each.  Raises ``ValueError`` in a sentence for a lift that is not above
    0 or never reached, a lash below 0, a ratio that is not above 0, and a motion that goes on.
    """
    refuse_arguments(cam_card, locals())
    lift = a_number(lift, "the lift of the card", "be above 0", lambda value: value > 0)
    lash = a_number(lash, "the lash", "be 0 or more", lambda value: value >= 0)
    ratio = a_number(ratio, "the ratio of the rocker", "be above 0", lambda value: value > 0)
    held = {"motion": motion, "lift": lift, "lash": lash, "ratio": ratio, "cam angle": zero}
    refuse_unequal(held, "cam card")
    if refuse := unless(motion.comes_back):
        refuse("the motion goes on with each turn; a cam card is of one that comes back to its base circle")
    card = card_of(motion, lift, lash, ratio)
    if refuse := unless(card.duration > 0):
        refuse(
            f"the lift of {lift:.6g} (follower units) is never passed on the way up and down; the largest is "
            f"{card.peak:.6g}"
        )
    return card if zero is None else _from(card, a_number(zero, "the cam angle from which the card counts"))


def _from(card: CamCard, zero: Value) -> CamCard:
    """The card with its angles from a cam angle on: it opens within half a turn of that."""
    opens = np.mod(card.nose + card.opens - np.atleast_1d(zero)[..., 0] + np.pi, TURN) - np.pi
    return replace(card, opens=opens, closes=opens + card.duration)


def card_of(motion: MotionProgram, lift: Value, lash: Value = 0.0, ratio: Value = 1.0) -> CamCard:
    """As `cam_card`, of a lift that may never be reached."""
    with np.errstate(all="ignore"):
        return _card(motion, *(np.atleast_1d(value) for value in (lift, lash, ratio)))


def _card(motion: MotionProgram, lift: Array, lash: Array, ratio: Array) -> CamCard:
    angle, s, v, a = _turn(motion)
    base = -_highest(motion, -1).value[..., None]
    top = _highest(motion, 1)
    nose, peak = _nose(angle, s, top), np.maximum(ratio * (top.value[..., None] - base - lash), 0.0)
    levels = np.concatenate(np.broadcast_arrays(base + lash + lift / ratio, base + lash), axis=-1)
    angle, s, v, a = np.broadcast_arrays(angle, s, v, a, levels[..., :1])[:4]
    passed, reached = _passed(motion, angle, s, levels)
    moved = motion(passed)[:3]
    areas, spans = [], passed[..., 1::2] - passed[..., ::2]
    for k, level in ((0, base + lash), (0, levels[..., :1]), (2, base + lash)):
        ends = [values[..., k : k + 2] for values in (passed, *moved)]
        areas.append(ratio * _area((angle, s, v, a), ends, level))
    duration = np.where(reached, spans[..., :1], 0.0)
    area, over = (np.where(reached, found, 0.0) for found in areas[:2])
    whole = np.where(peak > 0, areas[2], 0.0)
    opens, closes = (np.where(reached, passed[..., k : k + 1] - nose, np.nan) for k in (0, 1))
    found = opens, closes, duration, area, over, whole, np.mod(nose, TURN), peak
    possible = np.atleast_1d(motion.possible) & np.isfinite(levels[..., :1])
    return CamCard(*(np.where(possible, value, np.nan)[..., 0][()] for value in found))


def _turn(motion: MotionProgram) -> tuple[Array, Array, Array, Array]:
    """Cam angles, ``s, v, a`` over a turn that begins where the follower is lowest; of a part of one all of it."""
    shown = motion.resolution
    angle, s, v, a = np.broadcast_arrays(shown.angle, *motion.over(shown)[:3])
    periodic, places = motion.periodic, np.arange(angle.shape[-1])
    lowest = np.where(periodic, np.argmin(s, axis=-1, keepdims=True), 0)
    ahead = places + lowest
    beyond = ahead >= len(places)
    at = np.where(beyond, ahead - len(places), ahead)
    angle, s, v, a = (np.take_along_axis(x, np.broadcast_to(at, x.shape), axis=-1) for x in (angle, s, v, a))
    angle = angle + np.where(beyond, TURN, 0.0)
    end = np.where(periodic, angle[..., :1] + TURN, angle[..., -1:])
    ends = (np.where(periodic, x[..., :1], x[..., -1:]) for x in (s, v, a))
    return np.concatenate([angle, end], axis=-1), *(
        np.concatenate([x, last], axis=-1) for x, last in zip((s, v, a), ends, strict=True)
    )  # type: ignore[return-value]


def _highest(motion: MotionProgram, way: int) -> Extreme:
    shown = motion.resolution
    return highest(lambda x: way * motion(x).s, shown.angle, shown.inner)


def _nose(angle: Array, s: Array, top: Extreme) -> Array:
    """The cam angle of the highest level, from the start of the turn on; between places that share it, midway."""
    size = s.max(-1, keepdims=True) - s.min(-1, keepdims=True)
    high = s >= s.max(-1, keepdims=True) - FLAT * size
    first = np.argmax(high, axis=-1, keepdims=True)
    over = np.logical_not(high) & (np.arange(high.shape[-1]) > first)
    last = np.where(over.any(-1, keepdims=True), np.argmax(over, axis=-1, keepdims=True) - 1, _last(high))
    begin, end = (np.take_along_axis(angle, at, axis=-1) for at in (first, last))
    alone = top.cam_angle[..., None]
    alone = np.where(alone < angle[..., :1], alone + TURN, alone)
    return np.where(last > first, (begin + end) / 2, alone)


def _last(truths: Array) -> Array:
    return truths.shape[-1] - 1 - np.argmax(np.flip(truths, axis=-1), axis=-1, keepdims=True)


def _passed(motion: MotionProgram, angle: Array, s: Array, levels: Array) -> tuple[Array, Array]:
    """The cam angles of the first way up and of the last way down through each level, ``(..., 2 k)``.

    And whether the first of the levels is passed so.
    """
    low, high, reached = [], [], []
    for k in range(levels.shape[-1]):
        above = s > levels[..., k : k + 1]
        first, last = np.argmax(above, axis=-1, keepdims=True), _last(above)
        reached.append((first > 0) & (last < above.shape[-1] - 1) & np.any(above, axis=-1, keepdims=True))
        low += [np.maximum(first - 1, 0), np.minimum(last + 1, above.shape[-1] - 1)]
        high += [first, last]
    begin, end = (np.take_along_axis(angle, np.concatenate(x, axis=-1), axis=-1) for x in (low, high))
    each = np.concatenate([levels[..., k : k + 1] for k in range(levels.shape[-1]) for _ in range(2)], axis=-1)
    return _through(motion, each, begin, end), reached[0]


def _through(motion: Callable[[Array], Kinematics], level: Value, below: Array, above: Array) -> Array:
    """Where a level is gone through between a place at which ``s`` is below and one at which it is above."""
    x = (below + above) / 2
    for _ in range(ROUNDS):
        s, v, *_ = motion(x)
        under = s <= level
        below, above = np.where(under, x, below), np.where(under, above, x)
        newton = x - (s - level) / v
        inside = (newton >= np.minimum(below, above)) & (newton <= np.maximum(below, above))
        x = np.where(inside, newton, np.where(s == level, x, (below + above) / 2))
    return x


def _area(turn: tuple[Array, Array, Array, Array], ends: list[Array], level: Array) -> Array:
    """The integral of what is above a level between two angles, ``(..., 1)``.

    Of the polynomials of degree 5 between the samples, from or to where they go through the level.
    """
    begin, end = (tuple(x[..., k : k + 1] for x in ends) for k in (0, 1))
    before, after = turn[0] < begin[0], turn[0] > end[0]
    x, s, v, a = (
        np.where(before, one, np.where(after, other, here)) for here, one, other in zip(turn, begin, end, strict=True)
    )
    values, step = (s - level, v, a), x[..., 1:] - x[..., :-1]
    low, high = ([y[..., part] for y in values] for part in (slice(None, -1), slice(1, None)))
    first, last = low[0] > 0, high[0] > 0
    found = step * (low[0] + high[0]) / 2 + step**2 * (low[1] - high[1]) / 10 + step**3 * (low[2] + high[2]) / 120
    found, through = np.where(first & last, found, 0.0), first != last
    if known(through):
        here = [y[through] for y in low], [y[through] for y in high], step[through]
        found[through] = _beside_zero(*here)
    else:  # a program does the same in every step, whether it goes through or not
        found = np.where(through, _beside_zero(low, high, step), found)
    return found.sum(-1, keepdims=True)


def _beside_zero(low: list[Array], high: list[Array], step: Array) -> Array:
    """The integral over a step, of ``s, v, a`` at its ends, of what is above 0 if just one of them is."""
    (s, v, a), (s1, v1, a1) = ((y[0], y[1] * step, y[2] * step**2) for y in (low, high))
    d, e, f = s1 - s - v - a / 2, v1 - v - a, a1 - a
    powers: list[Any] = [s, v, a / 2, 10 * d - 4 * e + f / 2, 7 * e - 15 * d - f, 6 * d - 3 * e + f / 2]
    below = np.where(s > 0, 1.0, 0.0)
    passed = _through(lambda u: polynomial(powers, u), 0.0, below, 1.0 - below)
    under: list[Any] = [0.0, *(power / (i + 1) for i, power in enumerate(powers))]
    before, whole = polynomial(under, passed).s, polynomial(under, 1.0 + 0.0 * passed).s
    found: Array = step * np.where(s > 0, before, whole - before)
    return found
