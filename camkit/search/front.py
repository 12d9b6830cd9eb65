"""What a search finds where there are several objectives: designs of which no other is better in everything."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Generic, NamedTuple, SupportsIndex

import numpy as np

from ..quantities import D, counted
from ..quantities.kinds import numbers, refuse_arguments, refuse_kinds, shown
from ..study.recheck import Recheck
from ..study.robust import RobustStudy
from ..study.study import Evaluation, Study
from .minimum import Reached
from .rates import slope_on_front


class Price(NamedTuple):
    """What one front lacks of another."""

    share: float
    """Of the volume of objectives that the other dominates, up to the worst of either in each objective.

    ``nan`` where that has no volume, as of one or two designs.
    """
    ends: np.ndarray
    """By how much the least of each objective is larger, ``(n_objectives,)``, SI."""


@dataclass(frozen=True)
class Front(Generic[D]):
    """Designs of which none is better than another in every objective, in order of the first objective.

    ``len(front)``, ``front[i]`` is a design again, ``front.x`` and ``front.f`` are ``(p, n)`` arrays in SI.
    An empty front says in ``message`` what stood in the way.  ``record`` says how a search found it: population,
    generations and seed or how many designs were looked at, seconds, versions.
    """

    study: Study[D]
    x: np.ndarray
    f: np.ndarray
    message: str = ""
    record: Mapping[str, object] = field(default_factory=dict)
    options: tuple[Reached, ...] = ()
    """What was reached with each combination of options, where menus are free and were gone through."""

    def __post_init__(self) -> None:
        refuse_kinds(self)
        for name, table, columns in (("x", self.x, self.study.free), ("f", self.f, self.study.minimise)):
            if table.shape != (len(self.x), len(columns)):
                raise ValueError(
                    f"the front's {name} has the shape {table.shape}; it must have a row for each design "
                    f"and a column for each of {len(columns)}"
                )

    def __len__(self) -> int:
        return len(self.x)

    def __getitem__(self, i: SupportsIndex | slice | np.ndarray) -> D:
        return self.study.design(self.x[i if isinstance(i, slice) else self._place(i)])

    def _place(self, i: object) -> np.ndarray:
        """One or more places on the front; past its end `IndexError`, by which a loop over it ends."""
        numbers(i, "the place on the front")
        place = np.asarray(i)
        if place.dtype.kind not in "iu" or place.ndim > 1:
            raise ValueError(f"the place on the front is {shown(i)}; it must be a whole number, or several")
        if not ((-len(self) <= place) & (place < len(self))).all():
            raise IndexError(f"there is no design {shown(i)} on the front; it has {len(self)}, counted from 0")
        return place

    def hypervolume(self, reference: object = None) -> float:
        """The volume of objectives that the front dominates up to ``reference`` (default: `reference_point`).

        Raises ``ValueError`` for a reference that is not one finite number for each objective.
        """
        point = reference_point(self.study) if reference is None else _point(reference, len(self.study.minimise))
        if not np.isfinite(self.f).all():
            raise ValueError("the front has an objective that is not a finite number")
        from moocore import hypervolume

        return float(hypervolume(self.f, ref=point)) if len(self) else 0.0

    @cached_property
    def yields(self) -> Recheck | None:
        """The yield of each design by exact parts, with what is sure of it; ``None`` without tolerances."""
        return self.study.recheck(self.x) if isinstance(self.study, RobustStudy) else None

    def price(self, nominal: Front[D]) -> Price:
        """What it costs that this front's designs survive being made: what it lacks of the ``nominal`` front.

        >>> from camkit.machines import door_handle_study
        >>> study, f = door_handle_study(), np.array([[1.0, 5.0], [2.0, 3.0], [4.0, 2.0]])
        >>> nominal, robust = (Front(study, np.tile(study.x0, (3, 1)), values) for values in (f, f + 0.5))
        >>> price = robust.price(nominal)
        >>> round(price.share, 3), price.ends.tolist()
        (0.448, [0.5, 0.5])

        Raises ``ValueError`` for a front of other objectives, and one without a design.
        """
        if not isinstance(nominal, Front) or nominal.study.minimise != self.study.minimise:
            raise ValueError("the other front has other objectives; the price is that of the same objectives")
        if not len(self) or not len(nominal):
            raise ValueError("there is no design on one of the fronts; a price needs some on both")
        point = np.maximum(nominal.f.max(0), self.f.max(0))
        whole = nominal.hypervolume(point)
        share = 1 - self.hypervolume(point) / whole if whole else float("nan")
        return Price(share, self.f.min(0) - nominal.f.min(0))

    def rates(self, i: SupportsIndex) -> np.ndarray:
        """What each objective costs the others at a design: ``(k, k)``, SI.

        ``[a, b]`` is by how much objective ``b`` is worse where ``a`` is better by one.  From the designs next to it
        (see `slope_on_front`); ``nan`` at the ends of a front, and where there are other than two objectives, among
        which no single rate is known.

        >>> from camkit.machines import door_handle_study
        >>> study, f = door_handle_study(), np.array([[1.0, 5.0], [2.0, 3.0], [3.0, 2.0]])
        >>> float(Front(study, np.tile(study.x0, (3, 1)), f).rates(1)[0, 1])
        1.5
        """
        place, k = self._place(i), len(self.study.minimise)
        if place.ndim:
            raise ValueError(f"the place on the front is {shown(i)}; it must be one whole number")
        rates = np.full((k, k), np.nan)
        if k == 2:
            rates[0, 1] = -slope_on_front(self.f, int(place))
            rates[1, 0] = 1 / rates[0, 1] if rates[0, 1] else np.inf
        return rates

    def judged_by(self, study: Study[D]) -> Front[D]:
        """The same designs under a study with other objectives (for instance new AHP weights), dominated ones out."""
        refuse_arguments(Front.judged_by, locals())
        if not len(self):
            return Front(study, self.x, np.zeros((0, len(study.minimise))), self.message, self.record)
        return replace(front_of(study.evaluate(self.x), study), record=self.record)


def _point(reference: object, k: int) -> np.ndarray:
    """A point in the space of ``k`` objectives."""
    try:
        point = numbers(reference, "the reference point")
    except ValueError:
        point = np.zeros(())
    if point.shape != (k,) or not np.isfinite(point).all():
        raise ValueError(f"the reference point is {shown(reference)}; it must be {k} finite numbers")
    return point


def front_of(evaluation: Evaluation, study: Study[D]) -> Front[D]:
    """The feasible designs of an evaluation that no other dominates."""
    refuse_arguments(front_of, locals())
    kept = np.flatnonzero(evaluation.feasible)
    f = evaluation.f[kept]
    kept = kept[~dominated(f)]
    kept = kept[np.argsort(evaluation.f[kept, 0], kind="stable")]
    return Front(study, evaluation.x[kept], evaluation.f[kept], "" if len(kept) else _why_empty(evaluation, study))


def dominated(f: np.ndarray) -> np.ndarray:
    """Which rows another row beats: nowhere worse, somewhere better; ``(p,)``."""
    f = numbers(f, "the objectives")
    if f.ndim != 2:
        raise ValueError(f"the objectives have the shape {f.shape}; they must be a table, a row for each design")
    beaten, known = np.zeros(len(f), dtype=bool), ~np.isnan(f).any(-1)  # what is no number cannot be compared
    if f[known].size:
        from moocore import is_nondominated

        rows = f[known]
        if not np.isfinite(rows).all():  # which moocore does not take: places of the numbers in their column
            places = [np.unique(column, return_inverse=True)[1] for column in rows.T]
            rows = np.stack(places, axis=-1).astype(float)
        beaten[known] = ~is_nondominated(rows, keep_weakly=True)
    return beaten


def _why_empty(evaluation: Evaluation, study: Study) -> str:
    built = np.isfinite(evaluation.f).all(-1)
    if not built.any():
        return "no design that was evaluated can be built; widen or move the bounds"
    nearest = np.argmin(np.where(built, evaluation.missed.sum(-1), np.inf))
    missed = study.worst_miss(evaluation.g[nearest])
    return f"no design that was evaluated keeps every limit; the nearest misses {missed}"


def reference_point(study: Study, n: int = 256) -> np.ndarray:
    """A fixed point for hypervolumes: the worst objectives among the feasible of ``n`` Sobol points of the box.

    It depends on the study without its tolerances alone, so hypervolumes of different searches can be compared.
    """
    from scipy.stats import qmc

    refuse_arguments(reference_point, locals())
    unit = qmc.Sobol(len(study.free), rng=0).random(counted(n, "Sobol points", 1))
    evaluation = study.nominal.evaluate(qmc.scale(unit, *study.bounds))
    usable = evaluation.feasible if evaluation.feasible.any() else np.isfinite(evaluation.f).all(-1)
    if not usable.any():
        return study.nominal.evaluate(study.x0).f[0]
    return evaluation.f[usable].max(axis=0)
