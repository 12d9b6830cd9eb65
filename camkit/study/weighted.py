"""Measures that are sums of others, and measures as the points of which they are the largest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..quantities import CurveMeasure, Measure
from ..quantities.kinds import finite, listed, one_number, shown
from ..quantities.known import floats
from ..quantities.types import Array, Value


@dataclass(frozen=True)
class WeightedSum(Measure):
    """Measures divided by their values at a reference design, weighted and added (see `weighted`)."""

    parts: tuple[Measure, ...] = ()
    weights: tuple[float, ...] = ()
    reference: tuple[float, ...] = ()

    def with_weights(self, weights: object) -> WeightedSum:
        """The same sum with other weights."""
        weights = listed(weights, "the tuple of weights", "measure")
        if len(weights) != len(self.parts):
            raise ValueError(f"there are {len(weights)} weights for the {self.name}; it has {len(self.parts)} measures")
        return replace(weighted(self.name, dict(zip(self.parts, weights, strict=True)), self.reference), sign=self.sign)


def weighted(name: str, weights: Mapping[Measure, float], reference: Sequence[float]) -> WeightedSum:
    """The measure ``sum(w_i * measure_i / reference_i)``; 1 at the reference if the weights add to 1.

    >>> a, b = Measure("a", "", lambda x: x[0]), Measure("b", "", lambda x: x[1])
    >>> weighted("both", {a: 0.75, b: 0.25}, (2.0, 4.0))((4.0, 4.0))
    1.75
    """
    if not isinstance(weights, Mapping):
        raise ValueError(f"the weights are {shown(weights)}; they must be a mapping from measures to numbers")
    reference = listed(reference, "the reference", "measure")
    if not weights or len(weights) != len(reference):
        raise ValueError(f"the weighted sum has {len(weights)} measures and {len(reference)} reference values")
    for measure in weights:
        if not isinstance(measure, Measure):
            raise ValueError(f"the weighted sum has {shown(measure)} where a Measure belongs")
    parts, shares = tuple(weights), tuple(checked_weight(w, f"the {m.name}") for m, w in weights.items())
    if not any(shares):
        raise ValueError(f"every weight of the {name} is 0; one or more must be above 0")
    divisors = tuple(
        one_number(
            value, f"the {m.name} at the reference design", "be finite and not 0", lambda v: v != 0 and finite(v)
        )
        for m, value in zip(parts, reference, strict=True)
    )

    def total(analysis: object) -> Value:
        return sum(w * part(analysis) / r for part, w, r in zip(parts, shares, divisors, strict=True))

    return WeightedSum(name, "", total, 1, parts, shares, divisors)


def told_of(measures: Iterable[Measure]) -> tuple[Measure, ...]:
    """What is to be known of measures: of weighted sums the parts, which `added` adds."""
    return tuple(part for m in measures for part in (m.parts if isinstance(m, WeightedSum) else (m,)))


def added(measure: Measure, values: Iterator[Array]) -> Array:
    """A measure by what its parts say, which come next among values; of one that is no sum its own."""
    if not isinstance(measure, WeightedSum):
        return next(values)
    told = zip(measure.weights, measure.reference, measure.parts, strict=True)
    return floats(measure.sign * sum(w * next(values) / r for w, r, _ in told))


def checked_weight(value: object, of: str) -> float:
    """A weight as a float; ``ValueError`` in a sentence for what is none."""
    return one_number(value, f"the weight of {of}", "be a finite number of at least 0", lambda w: w >= 0 and finite(w))


def parts_of(measure: Measure) -> list[tuple[float, Measure]]:
    """A measure as a sum of factor times part: the parts of a weighted sum, or the measure alone."""
    if isinstance(measure, WeightedSum) and measure.sign > 0:
        shares = zip(measure.weights, measure.reference, measure.parts, strict=True)
        return [(w / r, part) for w, r, part in shares if w > 0]
    return [(1.0, measure)]


def is_curve(measure: Measure, factor: float) -> bool:
    """Whether ``factor * measure`` is the largest of the points of its curve."""
    return isinstance(measure, CurveMeasure) and measure.way * factor * measure.sign > 0


@dataclass(frozen=True)
class Curve:
    """Every point of a measure that is a curve's largest or least value, without its sign."""

    measure: CurveMeasure

    def of(self, analysis: object, p: int) -> np.ndarray:
        """Of ``p`` designs, ``(p, n)``."""
        curve = self.measure.curve(analysis)
        return np.broadcast_to(curve, (p, curve.shape[-1]))


def points_of(measure: Measure, analysis: object, factor: float, p: int) -> np.ndarray:
    """``factor * measure`` as points ``(p, n)`` whose largest it is: those of a curve, or the number itself."""
    sided = factor * measure.sign
    if isinstance(measure, CurveMeasure) and measure.way * sided > 0:
        curve = floats(sided * measure.curve(analysis))
        return np.broadcast_to(curve, (p, curve.shape[-1]))
    return np.broadcast_to(factor * measure(analysis), p)[:, None]


@dataclass(frozen=True)
class Points:
    """A limited measure, times ``sense``, as the points of which it is the largest, and beside them the measure."""

    measure: Measure
    sense: int

    def of(self, analysis: object, p: int) -> np.ndarray:
        """Of ``p`` designs, ``(p, n + 1)``; a measure that is no curve alone, ``(p, 1)``."""
        points = points_of(self.measure, analysis, self.sense, p)
        whole = self.sense * self.measure.of(analysis, p)
        return points if points.shape[1] == 1 else np.concatenate([points, whole[:, None]], axis=-1)
