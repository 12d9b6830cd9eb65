"""How far a dynamic factor is off, beside the elastic train (see `camkit.dynamics.factor_check`)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import Measure
from ..quantities.types import Array, Value
from .picture import Axes, Band, Line, Mark, Picture, Points


class Said(Protocol):
    """What is said of one measure."""

    @property
    def measure(self) -> Measure: ...
    @property
    def load_error(self) -> Value: ...
    @property
    def contact_error(self) -> Value: ...


class Checked(Protocol):
    """What a dynamic factor and the elastic train say of each of a population."""

    @property
    def loses_contact(self) -> Value: ...
    @property
    def rows(self) -> Sequence[Said]: ...


def factor_errors(check: Checked, over: ArrayLike, label: str = "natural periods in the first stroke") -> Picture:
    """By how much a dynamic factor is off, of each measure, ``over`` what the population differs in.

    By the factor of the load (full) and by that of the contact force (dashed); trouble: where the train leaves the cam.
    """
    x = np.asarray(over, dtype=float)
    order = np.argsort(x)
    marks: list[Mark] = [Band("zero", 0.0, 0.0, role="guide")]
    for i, row in enumerate(check.rows):
        name = row.measure.name
        load, contact = (100 * _each(error, x)[order] for error in (row.load_error, row.contact_error))
        marks.append(Line(name, x[order], load, role="series", index=i, label=name))
        marks.append(Line(f"{name}, contact", x[order], contact, role="series", index=i, stroke="dashed"))
    lost = _each(check.loses_contact, x)[order].astype(bool)
    away = x[order][lost]
    marks.append(Points("lost", away, 0 * away, role="trouble", mark="cross", label="leaves the cam"))
    return Picture.of(Axes(title="Dynamic factor less elastic train", xlabel=label, ylabel="off by  [%]"), marks)


def _each(values: Value, x: Array) -> Array:
    return np.broadcast_to(values, x.shape)
