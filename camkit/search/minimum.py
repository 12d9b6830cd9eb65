"""What a search finds where there is one objective: the best design, and in words what holds it there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, NamedTuple

import numpy as np

from ..quantities import CurveMeasure, D, Measure, label
from ..study.free import Menu
from ..study.study import Evaluation, Study
from ..study.weighted import parts_of
from ..units import deg, factor
from .rates import CLOSE, multipliers

CLOSE_WITHIN = 3e-3
"""The same under tolerances, where few parts say what is reached."""
SAME = 1e-3
"""Starts whose ends differ by less than this share found the same."""


class Active(NamedTuple):
    """What holds a design where it is: a peak of the objective, a limit or a bound; angles in rad."""

    kind: str
    name: str
    value: str
    angles: tuple[float, ...] = ()

    def __str__(self) -> str:
        where = " at " + listed([f"{angle / deg:.1f}" for angle in self.angles]) + " deg" if self.angles else ""
        symbol = len(self.name) == 1  # a quantity that is known by its letter alone
        return f"{self.name} = {self.value}" if symbol else f"the {self.name} {self.value}{where}"


class Reached(NamedTuple):
    """What a search reached with some options of the menus that are free."""

    options: Mapping[str, str]
    """Their names, by menu."""
    f: tuple[float, ...]
    """The least of each objective, SI, of designs that keep every limit; else ``nan``, or what came nearest to it."""
    feasible: bool
    text: str
    """The least of each objective, or why there is no design that keeps every limit."""

    @property
    def name(self) -> str:
        """The names of the options."""
        return ", ".join(self.options.values())

    def __str__(self) -> str:
        return f"{self.name}: {self.text}"


@dataclass(frozen=True)
class Minimum(Generic[D]):
    """The best design that a search found; ``message`` says in words why it stopped and what holds the design there.

    ``x`` are its free values in SI, ``f`` the objective, ``ends`` the objectives at which each start ended (``inf``
    where limits are missed by `SAME` or more), ``evaluations`` how many designs were evaluated; under tolerances the
    parts of each are not counted.  While the search goes on, ``message``, ``ends`` and ``active`` are empty.
    """

    study: Study[D]
    x: np.ndarray
    f: float
    feasible: bool
    evaluations: int
    ends: tuple[float, ...] = ()
    active: tuple[Active, ...] = ()
    message: str = ""
    descended: np.ndarray | None = None
    """Free values where a descent from ``x`` ends; ``None`` after a search that is a descent itself."""
    options: tuple[Reached, ...] = ()
    """What was reached with each combination of options, where menus are free and were gone through."""

    @cached_property
    def rates(self) -> dict[Measure | str, float]:
        """How the objective changes with each limit (by its measure) and bound (by its path) that holds the design.

        SI over SI, to first order, where the limit moves outwards and the design follows (see `multipliers`).  ``nan``
        where the search has not come to a minimum.

        >>> from camkit import minimise, shaft_study
        >>> {getattr(k, "name", k): f"{rate:.4g}" for k, rate in minimise(shaft_study()).rates.items()}
        {'utilisation of the twist': '-0.003906', 'inner_diameter': '-0.05895'}
        """
        return multipliers(self.study, self.x)

    @property
    def design(self) -> D:
        """The design itself."""
        return self.study.design(self.x)


class Found(NamedTuple):
    """What a method found, before it is told in words."""

    x: np.ndarray
    evaluations: int
    ends: tuple[float, ...]
    why: str
    descended: np.ndarray | None = None


def described(study: Study[D], found: Found) -> Minimum[D]:
    """What was found, with the words for it."""
    evaluation = study.evaluate(found.x)
    built, feasible = bool(np.isfinite(evaluation.f).all()), bool(evaluation.feasible[0])
    active = _active(study, evaluation) if built else ()
    words = [f"{found.why}.", _held(active, study.nominal is not study) if feasible else _missed(study, evaluation)]
    if feasible and len(found.ends) > 1:
        same = sum(abs(end - min(found.ends)) <= SAME * abs(min(found.ends)) for end in found.ends)
        words.append(f"{same} of {len(found.ends)} restarts ended with this objective, to {SAME:.1%} of it.")
    if found.descended is not None:
        words.append(_sureness(study, evaluation, found.descended))
    f, message = float(evaluation.f[0, 0]), " ".join(words)
    x = evaluation.x[0]
    return Minimum(study, x, f, feasible, found.evaluations, found.ends, active, message, found.descended)


def _sureness(study: Study, found: Evaluation, descended: np.ndarray) -> str:
    """How a design compares with the end of a descent from it."""
    end = study.evaluate(descended)
    before, after = float(found.f[0, 0]), float(end.f[0, 0])
    gain = (before - after) / abs(before) if before else before - after
    text = study.minimise[0].text(study.minimise[0].sign * after)
    if end.feasible[0] and not found.feasible[0]:
        return f"A descent from there ends at one that keeps every limit, with {text}."
    if not end.feasible[0] or not gain > SAME:
        return "A descent from there ends no better: it is the best of its neighbours, if perhaps not of all designs."
    return f"A descent from there ends at {text}, {100 * gain:.2g} % better: this search had not come to the end."


def _held(active: tuple[Active, ...], within: bool) -> str:
    """What holds a design that keeps all limits where it is, perhaps ``within`` tolerances."""
    peaks = [str(a) for a in active if a.kind == "peak"]
    held = [str(a) for a in active if a.kind != "peak"]
    smallest = [f"Smallest found: {listed(peaks)}."] if peaks else []
    at = "At their limits within the tolerances" if within else "At their limits"
    return " ".join([*smallest, f"{at}: {listed(held)}." if held else "No limit is reached."])


def _missed(study: Study, evaluation: Evaluation) -> str:
    """Which limit a design misses by most, or for which it has no number."""
    lacking = np.flatnonzero(evaluation.g[0] == np.inf)
    known = evaluation.missed.any() and not len(lacking)
    nearest = f"this one misses {study.worst_miss(evaluation.g[0])}." if known else ""
    if np.isfinite(evaluation.f).all():
        nearest = nearest or f"this one has no {study.limits[lacking[0]][0].name}."
        return f"No design was found that keeps every limit; {nearest}"
    none = f"No design was found for which there is a {study.minimise[0].name}"
    return f"{none}; {nearest}" if nearest else f"{none}: none can be built or used."


def listed(items: list[str]) -> str:
    """Items as a person lists them."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def _active(study: Study, evaluation: Evaluation) -> tuple[Active, ...]:
    """Every peak of the objective, every limit and bound that is reached."""
    analysis = study.analysis(evaluation.x)
    objective = [part for _, part in parts_of(study.minimise[0])]
    peaks = [_reached("peak", m, analysis, 1) for m in objective if isinstance(m, CurveMeasure) and m.way * m.sign > 0]
    close = CLOSE if study.nominal is study else CLOSE_WITHIN
    limits = [
        _reached("limit", m, analysis, sense)
        for (m, v, sense), g in zip(study.limits, evaluation.g[0], strict=True)
        if abs(g) <= close * (1 if v else factor(m.unit))
    ]
    return (*peaks, *limits, *_bounds_reached(study, evaluation.x[0]))


def _reached(kind: str, measure: Measure, analysis: object, sense: int) -> Active:
    value = measure.text(float(np.ravel(measure(analysis))[0]))
    return Active(kind, measure.name, value, _peak_angles(measure, analysis, sense))


def _peak_angles(measure: Measure, analysis: object, sense: int) -> tuple[float, ...]:
    """The angles at which a curve comes to its peak, or to its least value, one for each hill."""
    if not isinstance(measure, CurveMeasure) or measure.angle is None or sense * measure.sign * measure.way < 0:
        return ()
    curve, angle = measure.way * np.ravel(measure.curve(analysis)), np.ravel(measure.angle(analysis))
    padded = np.concatenate([[-np.inf], curve, [-np.inf]])
    hills = (curve >= padded[:-2]) & (curve > padded[2:]) & (curve >= curve.max() - CLOSE * abs(curve.max()))
    return tuple(float(a) for a in angle[hills])


def _bounds_reached(study: Study, x: np.ndarray) -> list[Active]:
    found = []
    for name, value, low, high in zip(study.free, x, *study.bounds, strict=True):
        if isinstance(study.free[name], Menu):
            continue
        for end, word in ((low, "lower"), (high, "upper")):
            if abs(value - end) <= CLOSE * (high - low):
                found.append(
                    Active(
                        "bound", label(name, study.declared[name]), f"{study.declared[name].text(value)} ({word} bound)"
                    )
                )
    return found
