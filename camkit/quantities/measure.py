"""A measure: one number of an analysis, by its name and in its unit."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np

from ..units import factor, in_unit
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
class PeakMeasure(Measure):
    """The largest value of a curve: ``function`` gives the curve, its points last; the measure is their maximum.

    A search then sees every point and not only the largest, which jumps from one to another.  ``-PeakMeasure`` of
    the negative curve is a least value.  ``angle`` says at which cam angle each point of the curve stands.

    >>> import numpy as np
    >>> lowest = -PeakMeasure("least height", "mm", lambda analysis: -analysis["height"])
    >>> float(lowest({"height": np.array([0.05, 0.02, 0.04])}))
    0.02
    """

    angle: Callable[[Any], np.ndarray] | None = field(default=None, repr=False, compare=False)

    def curve(self, analysis: object) -> np.ndarray:
        """The value at every point, before the sign."""
        return _curve(self, analysis, "largest")

    def __call__(self, analysis: object) -> Value:
        return self.sign * self.curve(analysis).max(-1)


@dataclass(frozen=True)
class LeastMeasure(Measure):
    """The least value of a curve, or of several things such as the walls of a box: their points come last.

    A search, and a study under tolerances, then see every point, as they do of a `PeakMeasure`.

    >>> room = LeastMeasure("room", "mm", lambda analysis: analysis["room"])
    >>> float(room({"room": np.array([0.05, 0.02, 0.04])}))
    0.02
    """

    def curve(self, analysis: object) -> np.ndarray:
        """The value at every point, before the sign."""
        return _curve(self, analysis, "least")

    def __call__(self, analysis: object) -> Value:
        return self.sign * self.curve(analysis).min(-1)


def _curve(measure: Measure, analysis: object, which: str) -> np.ndarray:
    """What a measure gives that is the largest or least value of a curve."""
    curve = measure.given(analysis)
    if not np.ndim(curve) or not np.shape(curve)[-1]:
        raise ValueError(
            f"the {measure.name} gives {shown(curve)}; it is the {which} value of a curve, its points last"
        )
    return cast(np.ndarray, curve)
