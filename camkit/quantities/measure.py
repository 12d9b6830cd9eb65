"""A measure: one number of an analysis, by its name and in its unit."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, Self, cast

import numpy as np

from ..units import deg, factor, in_unit
from .applied import applied
from .kinds import one_number, plain, refuse_kinds, shown
from .known import known, text_of
from .types import Value


@dataclass(frozen=True)
class Measure:
    """A number per design: a name, a unit to show it in, and a function of an analysis that gives SI.

    Two measures are the same if they have the same name and unit, so names are unique within a mechanism.
    ``-measure`` is the same number with the other sign, for what is to be made as large as possible.

    >>> tall = Measure("height", "mm", lambda analysis: analysis["height"])
    >>> tall({"height": 0.05}), (-tall)({"height": 0.05})
    (0.05, -0.05)
    """

    name: str
    unit: str
    function: Callable[[Any], Value] = field(repr=False, compare=False)
    sign: int = 1
    made: tuple[object, ...] = field(default=(), repr=False, compare=False, kw_only=True)
    """How a file can have it made again: the name of one of the design's `makers`, and what that was given."""
    whole: Measure | None = field(default=None, repr=False, compare=False, kw_only=True)
    """The measure that is seen at some cam angles alone, of one that is (see `CurveMeasure`)."""
    in_trouble: bool = field(default=False, repr=False, compare=False, kw_only=True)
    """Whether the ``trouble`` of the analysis says it in words where it is below 0."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        factor(self.unit)
        if self.sign not in (1, -1):
            raise ValueError(f"the sign of the measure is {shown(self.sign)}; it must be +1 or -1")

    def given(self, analysis: object) -> Value:
        """What the function gives of an analysis, before the sign; ``ValueError`` for anything but real numbers."""
        with applied(f"the {self.name}", analysis):
            value = self.function(analysis)
        if type(value) is float:
            return value
        if not known(value):
            return value
        plainly = plain(value) if isinstance(value, np.ndarray) else isinstance(value, (int, float, np.generic))
        if not plainly or np.asarray(value).dtype.kind not in "fiub":
            raise ValueError(f"the {self.name} gives {shown(value)}; a measure gives real numbers, one or an array")
        return value

    def __call__(self, analysis: object) -> Value:
        return self.sign * self.given(analysis)

    def of(self, analysis: object, p: int) -> np.ndarray:
        """The numbers of ``p`` designs, ``(p,)``; ``ValueError`` for more or fewer."""
        value = self(analysis)
        try:
            return np.broadcast_to(value, p)
        except ValueError:
            shape = " x ".join(map(str, np.shape(value)))
            designs = "one design" if p == 1 else f"{p} designs"
            raise ValueError(
                f"the {self.name} gives {shape} numbers for {designs}; a measure gives one for each design"
            ) from None

    def one(self, analysis: object) -> float:
        """The number of one design; ``ValueError`` for several.

        >>> Measure("height", "mm", lambda analysis: analysis["height"]).one({"height": 0.05})
        0.05
        """
        return float(self.of(analysis, 1)[0])

    def __neg__(self) -> Measure:
        return dataclasses.replace(self, sign=-self.sign)

    @property
    def label(self) -> str:
        """Name and unit, for an axis or a heading."""
        return f"{self.name}  [{self.unit}]" if self.unit else self.name

    def text(self, value: Value) -> str:
        """``value`` (SI) as a person reads it."""
        read = in_unit(one_number(value, f"the {self.name}", "be one number"), self.unit)
        return f"{text_of(read, '~measure')} {self.unit}".rstrip()


@dataclass(frozen=True)
class CurveMeasure(Measure):
    """The largest or the least value of a curve, of which a search sees every point and not only that one.

    ``function`` gives the curve, its points last; where it gives the largest or least value itself, and more exactly,
    ``points`` give the curve.  ``angle`` says at which cam angle each point stands.
    """

    way: ClassVar[int]
    """+1 for the largest value, -1 for the least."""
    angle: Callable[[Any], np.ndarray] | None = field(default=None, repr=False, compare=False)
    points: Callable[[Any], Value] | None = field(default=None, repr=False, compare=False)

    def curve(self, analysis: object) -> np.ndarray:
        """The value at every point, before the sign."""
        with applied(f"the {self.name}", analysis):
            curve = self.points(analysis) if self.points else self.given(analysis)
        if not np.ndim(curve) or not np.shape(curve)[-1]:
            which = "largest" if self.way > 0 else "least"
            raise ValueError(
                f"the {self.name} gives {shown(curve)}; it is the {which} value of a curve, its points last"
            )
        return cast(np.ndarray, curve)

    def __call__(self, analysis: object) -> Value:
        if self.points:
            return super().__call__(analysis)
        curve = self.curve(analysis)
        return self.sign * (curve.max(-1) if self.way > 0 else curve.min(-1))

    def at(self, angle: float) -> Measure:
        """The curve's value at one cam angle (rad), a checkpoint: a measure that can be an objective or have a limit.

        >>> from camkit import TranslatingRollerCam, deg
        >>> from camkit.cam import max_pressure_angle
        >>> steep = max_pressure_angle.at(30 * deg)
        >>> print(f"{steep.name}: {steep.text(steep(TranslatingRollerCam().analyse()))}")
        maximum pressure angle at 30 deg: 13.49 deg

        Raises ``ValueError`` for what is no angle, and for an analysis that cannot be seen at one angle alone.
        """
        angle = self._cam_angle(angle)
        how: Any = {"made": ("at", self.name, angle), "whole": self}
        function, name = _seen(self, angle, angle), f"{self.name} at {_degrees(angle)}"
        return Measure(name, self.unit, lambda analysis: self.sign * function(analysis), self.sign, **how)

    def between(self, low: float, high: float) -> Self:
        """The largest or least value between two cam angles (rad), such as 340 and 20 deg: a measure as `at` makes one.

        >>> from camkit import TranslatingRollerCam, deg
        >>> from camkit.cam import max_pressure_angle
        >>> zone = max_pressure_angle.between(340 * deg, 20 * deg)
        >>> print(f"{zone.name}: {zone.text(zone(TranslatingRollerCam().analyse()))}")
        maximum pressure angle, 340 to 20 deg: 7.056 deg

        Raises ``ValueError`` for what are no two angles, and for an analysis that cannot be seen between two angles.
        """
        low, high = self._cam_angle(low), self._cam_angle(high)
        turns = (high - low) / (2 * np.pi)
        if turns in (0, -1):
            raise ValueError(f"the {self.name} is to be seen from {_degrees(low)} to the same angle; take at() for one")
        name = f"{self.name}, {low / deg:.6g} to {_degrees(high)}"
        made = "between", self.name, low, high
        parts = ("function", "points", "angle") if turns < 1 - 1e-9 else ()  # a whole turn is the measure itself
        seen: Any = {n: f and _seen(f, low, high) for n in parts for f in [getattr(self, n)]}
        return dataclasses.replace(self, name=name, made=made, whole=self, **seen)

    def _cam_angle(self, angle: object) -> float:
        if self.whole:
            raise ValueError(f"the {self.name} is seen at some cam angles alone already")
        if self.angle is None:
            raise ValueError(f"the {self.name} does not say at which cam angles its points stand; give it an angle=...")
        must = "be from -360 to 360 deg; for 30 degrees write 30 * deg"
        return one_number(angle, f"the cam angle (rad) of the {self.name}", must, lambda a: abs(a) <= 2 * np.pi)


def _degrees(angle: float) -> str:
    return f"{angle / deg:.6g} deg"


def _seen(function: Callable[[Any], Value], low: float, high: float) -> Callable[[Any], Value]:
    """``function`` of an analysis that is seen between two cam angles alone."""
    return lambda analysis: function(analysis.between(low, high))


@dataclass(frozen=True)
class PeakMeasure(CurveMeasure):
    """The largest value of a curve: ``function`` gives the curve, its points last; the measure is their maximum.

    A search then sees every point and not only the largest, which jumps from one to another.  ``-PeakMeasure`` of
    the negative curve is a least value.

    >>> import numpy as np
    >>> lowest = -PeakMeasure("least height", "mm", lambda analysis: -analysis["height"])
    >>> float(lowest({"height": np.array([0.05, 0.02, 0.04])}))
    0.02
    """

    way = 1


@dataclass(frozen=True)
class LeastMeasure(CurveMeasure):
    """The least value of a curve, or of several things such as the walls of a box: their points come last.

    A search, and a study under tolerances, then see every point, as they do of a `PeakMeasure`.

    >>> room = LeastMeasure("room", "mm", lambda analysis: analysis["room"])
    >>> float(room({"room": np.array([0.05, 0.02, 0.04])}))
    0.02
    """

    way = -1
