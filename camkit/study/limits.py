"""Which objectives and limits a study can have, and when a limit is kept."""

from __future__ import annotations

from collections.abc import Mapping

from ..quantities import Measure
from ..quantities.kinds import finite, shown
from ..quantities.types import Value
from .free import is_number

KEPT = 1e-9
"""A limit is kept if it is missed by no more than this share of it (of 1, if it is 0): in all of the package."""


def keeps(value: Value, limit: float, sense: int) -> Value:
    """Whether ``value`` keeps a limit: at most (``sense`` +1) or at least (-1) ``limit``.

    >>> keeps(2.0, 2.0 * (1 - 1e-10), 1), keeps(2.0, 1.99, 1), keeps(float("nan"), 2.0, 1)
    (True, False, False)
    """
    return sense * (value - limit) <= KEPT * (abs(limit) or 1.0)


def refuse_objectives(minimise: object) -> None:
    """``ValueError`` in a sentence for what is no tuple of measures, each of them once."""
    if not isinstance(minimise, (tuple, list)) or not minimise:
        raise ValueError("a study needs a tuple of one or more measures to minimise")
    for i, measure in enumerate(minimise):
        if not isinstance(measure, Measure):
            raise ValueError(f"the study has {shown(measure)} where a Measure belongs")
        if measure in minimise[:i]:
            raise ValueError(f"the study minimises the {measure.name} twice; each measure can be an objective once")
        if -measure in minimise[:i]:
            raise ValueError(
                f"the study minimises the {measure.name} and its opposite; one of two designs is always better in "
                "one of them, so that no design would be better than another"
            )


def refuse_limits(at_most: Mapping[Measure, float], at_least: Mapping[Measure, float]) -> None:
    """``ValueError`` in a sentence for limits that are no finite number for a measure, or that nothing can keep."""
    for measure, limit in (*at_most.items(), *at_least.items()):
        if not isinstance(measure, Measure):
            raise ValueError(f"the limit {shown(limit)} is for {shown(measure)}; it must be for a Measure")
        if not is_number(limit) or not finite(limit):
            raise ValueError(f"the limit of the {measure.name} is {shown(limit)}; it must be a finite number")
    told = [*_sides(at_most, 1), *_sides(at_least, -1)]
    ranges = ((m, low, high) for m, low, side in told if side < 0 for n, high, other in told if other > 0 and m == n)
    for measure, low, high in ranges:
        if not keeps(low, high, 1):
            both = f"at least {measure.text(low)} and at most {measure.text(high)}"
            raise ValueError(f"the {measure.name} is to be {both}; no design can be both")


def _sides(limits: Mapping[Measure, float], sense: int) -> list[tuple[Measure, float, int]]:
    """Limits as measure without its sign, value, and +1 for at most, -1 for at least."""
    return [(m if m.sign > 0 else -m, m.sign * limit, m.sign * sense) for m, limit in limits.items()]
