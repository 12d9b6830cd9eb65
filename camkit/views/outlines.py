"""A cam that was measured laid over the one that was designed, its deviation drawn much larger, and over the angle."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from ..quantities.types import Array, Value
from ..units import deg, mm
from .picture import Axes, Line, Mark, Picture, Points, Text, View

SHARE = 0.1
"""The largest deviation is drawn about so long, as a share of the cam's size."""
MOST_LARGER = 1e5
SECTORS = 8
"""The largest deviation of so many sectors is told."""
LETTERS = "ABCDEFGH"


class Compared(Protocol):
    """Points of an outline, and how far each stands out of a profile, m (see `camkit.cam.Compared`)."""

    points: Array
    angle: Array
    deviation: Array
    foot: Array
    normal: Array
    largest: Value


def outline_laid_over(analysis: Any) -> Picture:
    """The outline from which a design's motion was read, laid over the profile of the design."""
    return _laid_over(analysis.cam.motion.compared(analysis))


def outline_deviation(analysis: Any) -> Picture:
    """By how much that outline stands out of the profile of the design, over the polar angle."""
    return _over_angle(analysis.cam.motion.compared(analysis))


def laid_over(outline: Any) -> View:
    """A view of any design's profile with an outline, or the motion read from one, laid over it."""
    return _against(outline, _laid_over, outline_laid_over)


def deviation_over(outline: Any) -> View:
    """A view of how much an outline stands out of any design's profile, over the polar angle."""
    return _against(outline, _over_angle, outline_deviation)


def _against(outline: Any, drawn: Callable[[Compared], Picture], like: View) -> View:
    """A view that is called ``like`` another one, of an outline of its own."""

    def view(analysis: Any) -> Picture:
        return drawn(outline.compared(analysis))

    view.__name__, view.__doc__ = like.__name__, like.__doc__
    return view


def _laid_over(shown: Compared) -> Picture:
    size = np.max(np.hypot(*shown.points)) / mm
    larger = _times(SHARE * size * mm, shown.largest)
    x, y = (shown.foot + larger * shown.deviation * shown.normal) / mm
    at, out, where = _largest(shown)
    marks: list[Mark] = [
        Points("axis", 0.0, 0.0, mark="plus", size=12),
        Line("designed", *_closed(shown.foot / mm), role="profile", label="design"),
        Line("measured", *_closed(np.stack([x, y])), role="trouble", label="outline", stroke="thin"),
    ]
    for i, letter in enumerate(LETTERS):
        here = np.take_along_axis(x, at[i : i + 1], -1)[0], np.take_along_axis(y, at[i : i + 1], -1)[0]
        marks += [
            Points(f"{letter} point", here[0], here[1], size=5),
            Text(f"{letter} name", 1.07 * here[0], 1.07 * here[1], letter, bold=True),
            Text(
                f"{letter} told",
                0.0,
                (3.5 - i) * 0.1 * size,
                f"{letter}  {out[i] / mm:+.4f} mm at {where[i] / deg:.1f} deg",
            ),
        ]
    title = f"Outline against the design, deviation x {larger:.0f}"
    return Picture.of(Axes(title=title, xlabel="x  [mm]", ylabel="y  [mm]", equal=True), marks)


def _times(wanted: Value, largest: Value) -> Value:
    """How many times larger deviations are drawn: 1, 2 or 5 times a power of ten."""
    times = np.minimum(np.maximum(wanted / np.maximum(largest, 1e-12), 1.0), MOST_LARGER)
    power = 10 ** np.floor(np.log10(times))
    share = times / power
    return power * np.where(share >= 5, 5.0, np.where(share >= 2, 2.0, 1.0))


def _closed(points: Array) -> Array:
    return np.concatenate([points, points[:, :1]], axis=-1)


def _largest(shown: Compared) -> tuple[Array, Array, Array]:
    """Of each sector the number of the point that deviates most, by how much, and its polar angle."""
    sizes = np.where(np.isnan(shown.deviation), -1.0, abs(shown.deviation))
    sector = np.minimum(shown.angle * SECTORS // (2 * np.pi), SECTORS - 1)
    inside = np.where(sector == np.arange(SECTORS)[:, None], sizes, -2.0)
    at = np.argmax(inside, axis=-1)
    return at, *(np.take_along_axis(row, at, -1) for row in (shown.deviation, shown.angle + 0.0 * sizes))


def _over_angle(shown: Compared) -> Picture:
    angle = shown.angle / deg
    return Picture.of(
        Axes(title="Outline against the design", xlabel="polar angle  [deg]", ylabel="stands out  [mm]"),
        Line("design", angle[[0, -1]], np.zeros(2), role="guide"),
        Line("deviation", angle, shown.deviation / mm, role="profile"),
    )
