"""The extreme values of a cam's curves, whichever cam angles its analysis has and whether it can be built or not."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from .. import extrema
from ..extrema import Extreme
from ..quantities.types import Array, Value

if TYPE_CHECKING:
    from .analysis import CamAnalysis

Kind = TypeVar("Kind", bound="CamAnalysis")


def highest(analysis: Kind, f: Callable[[Kind], Value]) -> Extreme:
    """The largest value of ``f(analysis)`` over the cam, whether it can be built or not."""
    shown, resolution = analysis.resolved, analysis.resolution
    if analysis.rough:
        return extrema.roughly_highest(resolution.angle, f(shown), resolution.inner)

    def value(angle: Array) -> Value:
        return f(shown if angle is resolution.angle else analysis.at(angle))

    return extrema.highest(value, resolution.angle, resolution.inner)


def lowest(analysis: Kind, f: Callable[[Kind], Value]) -> Extreme:
    """As `highest`, for the least value."""
    value, angle = highest(analysis, lambda at: -f(at))
    return Extreme(-value, angle)
