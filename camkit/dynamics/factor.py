"""The dynamic factor beside the elastic train: what either says of stress, wear or any other peak of a cam.

At high speed the force between cam and follower has to be found with the elastic vibration of the driven chain: by a
dynamic factor, with which the forces of a rigid follower are multiplied, which is simple and unreliable, or by the
equations of motion.  The factor is the largest force of the train over that of a rigid follower, wherever either
stands; stress and wear are not largest there, and grow with other powers of the force.

Source: Zinchenko, Prokopenko, Krasnokutskiy, Krakhmalyov.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, make_dataclass
from functools import cache
from typing import NamedTuple, Protocol, Self, cast

import numpy as np

from ..extrema import Extreme
from ..quantities import Analysable, Measure, PeakMeasure, measures_of
from ..quantities.design import with_more
from ..quantities.kinds import refuse_arguments
from ..quantities.markup import table
from ..quantities.types import Array, Value
from .follower import ElasticFollower


class Forces(Protocol):
    """The analysis of a cam with one follower."""

    @property
    def resistance(self) -> Array: ...

    @property
    def contact_force(self) -> Array: ...

    @property
    def groove(self) -> bool: ...

    @property
    def form_closed(self) -> Value: ...

    def highest(self, f: Callable[[Self], Value]) -> Extreme: ...

    def lowest(self, f: Callable[[Self], Value]) -> Extreme: ...


class FactorRow(NamedTuple):
    """What is said of one measure, SI: numbers, or ``(p,)`` of a population."""

    measure: Measure
    rigid: Value
    """Of a rigid follower."""
    elastic: Value
    """Of the elastic train; where it leaves the cam that of the formal motion, as far as the cam pushes."""
    by_load: Value
    """By the factor of the load's force or torque along the travel, as the driven chain alone gives it."""
    by_contact: Value
    """By the factor of the contact force."""

    @property
    def cells(self) -> tuple[str, ...]:
        """Name, values and errors of one design, as a person reads them."""
        rigid, elastic, load, contact = map(self.measure.text, self[1:])
        return self.measure.name, rigid, elastic, load, _off(self.load_error), contact, _off(self.contact_error)

    @property
    def load_error(self) -> Value:
        """By how much the factor of the load is off, as a share of the elastic value."""
        return self.by_load / self.elastic - 1

    @property
    def contact_error(self) -> Value:
        """By how much the factor of the contact force is off."""
        return self.by_contact / self.elastic - 1


@dataclass(frozen=True)
class FactorCheck:
    """What a dynamic factor and the elastic train say of one design, or of a population (see `factor_check`)."""

    load_factor: Value
    """Largest force (torque) along the travel over that of a rigid follower."""
    contact_factor: Value
    """Largest contact force over that of a rigid follower."""
    loses_contact: Value
    """Whether the train leaves the cam: its motion is then formal, and every factor silent about it."""
    rows: tuple[FactorRow, ...]

    def _repr_html_(self) -> str:
        head = ("", "rigid", "elastic train", "by the load's factor", "off", "by the contact force's", "off")
        one = np.ndim(self.load_factor) == 0
        rows = [row.cells for row in self.rows] if one else []
        lost = "; the train leaves the cam" if np.any(self.loses_contact) else ""
        factors = f"{_text(self.load_factor)} of the load, {_text(self.contact_factor)} of the contact force"
        return table(head, rows, f"Dynamic factor: {factors}{lost}")


def _text(factor: Value) -> str:
    return " to ".join(f"{x:.4g}" for x in sorted({float(np.min(factor)), float(np.max(factor))}))


def _off(error: Value) -> str:
    return f"{100 * float(error):+.1f} %"


def factor_check(machine: ElasticFollower, measures: Sequence[Measure] = (), angles: int = 721) -> FactorCheck:
    """What a dynamic factor would say of ``measures``, beside what the elastic train does.

    By the factor the forces of the rigid follower are multiplied, at every cam angle, and each measure follows from
    them: the Hertz pressure with the root of the factor, ``F_wear`` with the power 1.5.  Without ``measures`` they are
    all peaks of the cam that depend on its forces.  ``angles`` are those of an analysis.

    >>> from camkit import HighSpeedCam
    >>> from camkit.dynamics import ElasticArm, tuned
    >>> from camkit.machines import high_speed_measures
    >>> cam = HighSpeedCam()
    >>> machine = ElasticFollower(cam, tuned(ElasticArm(), cam.analyse(), 3))
    >>> found = factor_check(machine, [high_speed_measures.peak_wear])
    >>> row = found.rows[0]
    >>> print(f"{found.load_factor:.4f}: {row.by_load * 0.001**0.5:.0f} for {row.elastic * 0.001**0.5:.0f}")
    1.3408: 637 for 535

    Raises ``ValueError`` as the analysis of the ``machine`` does.
    """
    refuse_arguments(factor_check, locals())
    elastic: Forces = machine.analyse(angles)
    rigid: Forces = cast(Analysable, machine.cam).analyse(angles)
    factors = [_most(elastic, name) / _most(rigid, name) for name in ("resistance", "contact_force")]
    scaled = [with_more(rigid, _factored, factor=np.expand_dims(factor, -1)) for factor in factors]
    pressing = elastic if elastic.groove else with_more(elastic, _pressing)
    asked = tuple(measures) or tuple(m for m in measures_of(machine.cam) if _depends(m, rigid, scaled[0]))
    rows = (FactorRow(m, *(m(a) for a in (rigid, pressing, *scaled))) for m in asked)
    lost = np.logical_not(elastic.form_closed) & (elastic.lowest(_contact).value < 0)
    return FactorCheck(factors[0], factors[1], lost, tuple(rows))


def _most(analysis: Forces, name: str) -> Value:
    """The largest force, of a groove by its size."""
    value: Value = analysis.highest(lambda at: abs(getattr(at, name)) if at.groove else getattr(at, name)).value
    return value


def _contact(analysis: Forces) -> Array:
    return analysis.contact_force


def _depends(measure: Measure, rigid: object, scaled: object) -> bool:
    """Whether a measure is a peak that depends on the forces."""
    if not isinstance(measure, PeakMeasure) or measure.sign < 0:
        return False
    return not np.all(np.isclose(measure(scaled), measure(rigid), 1e-9, 0))


@cache
def _factored(kind: type[Forces]) -> type:
    """The analysis of a cam of a ``kind`` whose forces are multiplied by a factor."""
    own = {"resistance": property(lambda a: a.factor * kind.resistance.__get__(a, kind))}
    more = [("factor", np.ndarray, field(kw_only=True, repr=False))]
    return make_dataclass(f"Factored{kind.__name__}", more, bases=(kind,), frozen=True, namespace=own)


@cache
def _pressing(kind: type[Forces]) -> type:
    """The analysis of an elastic train as far as the cam pushes: no force where it would have to pull."""
    own = {"resistance": property(lambda a: np.maximum(kind.resistance.__get__(a, kind), 0.0))}
    return make_dataclass(f"Pressing{kind.__name__}", [], bases=(kind,), frozen=True, namespace=own)
