"""A study: which numbers of a design are free, what is to be small, what must be kept.

It knows measures, not mechanisms: it carries a design from numbers to measures and back.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, Self

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import (
    Analysable,
    D,
    Measure,
    Paths,
    Quantity,
    counted,
    refuse_design,
    refuse_unmeasured,
    unremarked,
    words,
)
from ..quantities.kinds import (
    listed,
    numbers,
    refuse_empty,
    refuse_fields,
    refuse_kinds,
    shown,
)
from ..quantities.types import Array
from .free import Free, Menu, declared_with, freed
from .limits import KEPT, refuse_limits, refuse_objectives
from .native import Answers
from .options import Options, Plain, copied, ready
from .weighted import WeightedSum, added, checked_weight, told_of

if TYPE_CHECKING:
    from .robust import RobustStudy

TRIED = 32
"""So many pairs of designs, at random, say whether a free quantity has any effect."""
COARSE, LEAST_ANGLES = 4, 61
"""A rough study looks at one of so many angles, but not at fewer than these."""
Space = Mapping[str, tuple[float, float]]
"""Free quantities by path, with their lower and upper bounds in SI."""


def named_studies(studies: Study | Mapping[str, Study], start: Analysable) -> dict[str, Study]:
    """Studies around ``start`` by their names in a menu; one that is given alone is named by its objectives."""
    if isinstance(studies, Study):
        studies = {", ".join(measure.name for measure in studies.minimise): studies}
    refuse_empty(studies, "studies")
    return {name: study.around(start) for name, study in studies.items()}


@dataclass(frozen=True)
class Evaluation:
    """What a study says of ``p`` designs; what cannot be built has ``inf`` objectives and is infeasible."""

    x: np.ndarray
    """Free values, ``(p, n_free)``, SI."""
    f: np.ndarray
    """Objectives, all to be small, ``(p, n_objectives)``."""
    g: np.ndarray
    """Limits as ``(value - limit) / |limit|`` with a sign so that <= 0 is kept, ``(p, n_limits)``."""

    @property
    def missed(self) -> np.ndarray:
        """By how much each limit is missed, as a share of it; 0 where it is kept (see `KEPT`), ``(p, n_limits)``."""
        return np.where(self.g > KEPT, self.g, 0.0)

    @property
    def feasible(self) -> np.ndarray:
        """Which designs keep every limit, ``(p,)``."""
        return np.isfinite(self.f).all(-1) & (self.missed == 0).all(-1)


NOTHING = Measure("nothing", "", lambda analysis: 0.0)
"""To minimise where limits alone count."""


@dataclass(frozen=True)
class Study(Generic[D]):
    """Search space, objectives and limits around a starting design.

    ``free`` are paths of quantities of the design, with bounds in SI or, as a bare path, with the range that its
    declaration gives; and menus.  A bare path of a choice frees all of its options, a tuple some of them.  A quantity
    has a set of sizes in place of bounds.  A tuple of paths has options that move them together, each a value for every
    path or one for all; options can have names: ``{name: option}``.  A free quantity that an option does not have, such
    as a coefficient of another law, is no variable with it.  Among free values an option is its place on the menu.

    >>> from camkit import Cycloidal, ModifiedSine, TranslatingRollerCam, mm
    >>> from camkit.cam import max_pressure_angle
    >>> laws, sizes = (Cycloidal(), ModifiedSine()), {8 * mm, 9.5 * mm, 11 * mm}
    >>> free = {"motion.rise.law": laws, "roller_radius": sizes, "base_radius": (20 * mm, 40 * mm)}
    >>> study = Study(TranslatingRollerCam(), free, (max_pressure_angle,))
    >>> cam = study.design([1, 2, 0.03])
    >>> cam.motion.segments[0].law.name, cam.roller_radius, study.x_of(cam).tolist()
    ('modified sine', 0.011, [1.0, 2.0, 0.03])

    ``minimise`` are measures (``-measure`` to make one large); ``at_most`` and
    ``at_least`` map measures to limits.  ``angles`` is how many cam angles an analysis takes.  A ``rough`` study
    is for the first rounds of a search: where an analysis can find its peaks more quickly and less exactly, it does.

    Raises ``ValueError`` for what is no design that can be analysed, for a name that is not a number of the design,
    for bounds that are reversed, not finite or impossible, for a limit that is not finite, and for no free quantity or
    no objective at all, for a menu without options, with one twice or with one that it does not have, for a measure
    of a part that the design does not have, such as a contact that is not given.  `evaluate` does for one that does not
    apply to the design in another way; designs with an option that cannot be built or judged are infeasible.
    """

    start: D
    free: Any
    minimise: tuple[Measure, ...]
    at_most: Mapping[Measure, float] | None = None
    at_least: Mapping[Measure, float] | None = None
    angles: int = 361
    rough: bool = False

    def __post_init__(self) -> None:
        refuse_design(self.start, "the start of the study")
        given: object = self.free
        if not isinstance(given, (tuple, list, Mapping)) or not given:
            raise ValueError("a study needs the names of one or more free quantities")
        try:
            hash((*given,))
        except TypeError:  # lists in it
            raise ValueError(f"the study frees {shown(given)}; it must be paths, or tuples of paths") from None
        if twice := [name for i, name in enumerate(given) if name in list(given)[:i]]:
            raise ValueError(f"the study frees {shown(twice[0])} twice; each quantity can be free once")
        object.__setattr__(self, "free", freed(self.start, self.free))
        refuse_objectives(self.minimise)
        object.__setattr__(self, "minimise", tuple(self.minimise))
        counted(self.angles, "cam angles of a study")
        refuse_kinds(self, but=("minimise", "angles"))
        object.__setattr__(self, "at_most", dict(self.at_most or {}))
        object.__setattr__(self, "at_least", dict(self.at_least or {}))
        refuse_limits(self.at_most, self.at_least)  # type: ignore[arg-type]
        if not self.menus:
            refuse_unmeasured(self.start, self.measures, "the start of the study")

    @cached_property
    def _paths(self) -> Paths:
        """The free quantities, looked up once."""
        return Paths(self.start, self.free, Quantity)

    @property
    def menus(self) -> tuple[Menu, ...]:
        """The menus that are free."""
        return tuple(free for free in self.free.values() if isinstance(free, Menu))

    @cached_property
    def options(self) -> Options[Self]:
        """The plain studies of the options of its menus."""
        return Options(self)

    def as_plain(self, start: Any, free: Any, of: Plain[Self]) -> Self:
        """The same study of a ``start`` with some options, without menus."""
        return copied(self, start, free)

    @cached_property
    def declared(self) -> dict[str, Any]:
        """The declarations of the free quantities, and the free menus, in order."""
        if not self.menus:
            return self._paths.declared
        found = declared_with(self.start, self.menus, [n for n, b in self.free.items() if not isinstance(b, Menu)])
        return {name: free if isinstance(free, Menu) else found[name] for name, free in self.free.items()}

    @property
    def bounds(self) -> np.ndarray:
        """Lower and upper bounds, ``(2, n_free)``, SI; of a menu its first and its last place."""
        bounds = [(0, len(b.names) - 1) if isinstance(b, Menu) else b for b in self.free.values()]
        return np.array(bounds, dtype=float).reshape(-1, 2).T

    @property
    def x0(self) -> np.ndarray:
        """The starting design's free values, ``(n_free,)``, SI."""
        return self.x_of(self.start)

    def x_of(self, design: Analysable) -> np.ndarray:
        """The free values of a design of the same kind as the start, made ready for them, ``(n_free,)``, SI."""
        refuse_design(design, "the design")
        Paths(self.start, ()).values(design)  # refuses another kind
        design = ready(design, self.free)
        return self.options.x_of(design) if self.menus else np.array(self._paths.values(design), dtype=float)

    @property
    def nominal(self) -> Study[D]:
        """The same study without tolerances: this one, unless it is `under` some."""
        return self

    def under(
        self,
        tolerances: Mapping[Any, object],
        yield_at_least: float = 0.99,
        worst_case: bool = False,
        objective: str = "nominal",
        correlation: Mapping[Any, float] | None = None,
    ) -> RobustStudy[D]:
        """The same study of designs that are made within ``tolerances``, as every search takes it: see `RobustStudy`.

        >>> from camkit import mm, shaft_study
        >>> robust = shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
        >>> robust.evaluate([[0.1292, 0.103], [0.1298, 0.103]]).feasible.tolist()
        [False, True]
        """
        from .robust import RobustStudy

        known = {f.name: getattr(self, f.name) for f in fields(Study)}
        return RobustStudy(**known, tolerances=tolerances, yield_at_least=yield_at_least, worst_case=worst_case,
            objective=objective, correlation=correlation)  # fmt: skip

    @cached_property
    def limits(self) -> tuple[tuple[Measure, float, int], ...]:
        """Every limit as measure, value, sense: +1 for at most, -1 for at least."""
        assert self.at_most is not None and self.at_least is not None
        return (
            *((m, v, 1) for m, v in self.at_most.items()),
            *((m, v, -1) for m, v in self.at_least.items()),
        )

    @property
    def measures(self) -> tuple[Measure, ...]:
        """Every measure of the objectives and limits, of a weighted sum its parts."""
        return told_of((*self.minimise, *(measure for measure, _, _ in self.limits)))

    def design(self, x: ArrayLike) -> D:
        """The design with free values ``x``: ``(n_free,)`` for one, ``(p, n_free)`` for a population."""
        x = numbers(x, "the free values")
        if np.shape(x)[-1:] != (len(self.free),):
            raise ValueError(f"the design has {np.size(x)} values; this study has {len(self.free)} free quantities")
        if self.menus:
            plain, rows = self.options.one(self.rows(x))
            return plain.study.design(rows[0] if np.ndim(x) == 1 else rows)
        columns = (
            [float(v) for v in x] if np.ndim(x) == 1 else [np.ascontiguousarray(c)[:, None] for c in np.transpose(x)]
        )
        with unremarked():
            return self._paths.put(self.start, columns)

    def analysis(self, x: ArrayLike) -> Any:
        """The analysis of the design or population ``x``."""
        return self.analysis_of(self.design(x))

    def analysis_of(self, design: Any) -> Any:
        """The analysis of a design, or of a population of them."""
        analysis = design.analyse(self.angles)
        return replace(analysis, rough=True) if self.rough and hasattr(analysis, "rough") else analysis

    def evaluate(self, x: ArrayLike) -> Evaluation:
        """Objectives and limits of ``p`` designs ``(p, n_free)`` in one call."""
        rows = self.rows(x)
        return self.options.evaluate(rows) if self.menus else self.judged_by(rows, self.values(rows))

    @cached_property
    def roughly(self) -> Self:
        """The same study by few angles, as the first rounds of a search see it."""
        return self.replace(angles=min(self.angles, max(self.angles // COARSE, LEAST_ANGLES)), rough=True)

    @cached_property
    def _answers(self) -> dict[tuple[str, ...], Answers]:
        return {}

    def values(self, x: Array, paths: tuple[str, ...] | None = None) -> Array:
        """What `measures` say of ``p`` designs, ``(p, n_measures)``, SI, with values ``x`` at paths, or free ones.

        By native code as soon as it is there, else by numpy (see `camkit.study.native`).
        """
        at = tuple(self.free) if paths is None else paths
        if at not in self._answers:
            self._answers[at] = Answers(self, at)
        return self._answers[at](x)

    def rows(self, x: ArrayLike) -> np.ndarray:
        """``x`` as a table with a row for each design; ``ValueError`` in a sentence for what is none."""
        try:
            x = np.atleast_2d(numbers(x, "the free values"))
        except (TypeError, ValueError, OverflowError):
            raise ValueError("x must be a table of numbers, a row for each design") from None
        if x.ndim > 2:
            raise ValueError(f"x has the shape {x.shape}; it must be a table, a row for each design")
        if x.shape[1] != len(self.free):
            raise ValueError(f"x has {x.shape[1]} columns; this study has {len(self.free)} free quantities")
        return self.options.settled(x) if self.menus else x

    def judge(self, x: np.ndarray, analysis: object) -> Evaluation:
        """Objectives and limits of designs ``(p, n_free)`` whose ``analysis`` is at hand."""
        values = [measure.of(analysis, len(x)) for measure in self.measures]
        return self.judged_by(x, self._columns(values, len(x)))

    def judged_by(self, x: np.ndarray, values: Array) -> Evaluation:
        """Objectives and limits of designs ``(p, n_free)`` of which `values` are at hand."""
        told = iter(values.T)
        f = self._columns([added(m, told) for m in self.minimise], len(x))
        limits = [(added(m, told), v, sense) for m, v, sense in self.limits]
        g = self._columns([sense * (value - v) / (abs(v) or 1.0) for value, v, sense in limits], len(x))
        return Evaluation(x, np.where(np.isfinite(f), f, np.inf), np.where(np.isnan(g), np.inf, g))

    @staticmethod
    def _columns(values: list[Array], p: int) -> np.ndarray:
        return np.stack(values, axis=-1) if values else np.zeros((p, 0))

    def tightening(self, x: Array) -> Array:
        """By how much its limits are tighter than they say, as shares of them: not at all."""
        return np.zeros(())

    def worst_miss(self, g: np.ndarray) -> str:
        """Which limit one design, with ``g`` of an `Evaluation`, misses by most and by how much, in words."""
        i = int(np.argmax(g))
        measure, limit, sense = self.limits[i]
        missed = g[i] * (abs(limit) or 1.0)
        bound = "at most" if sense > 0 else "at least"
        return f"the {measure.name} of {bound} {measure.text(limit)} by {measure.text(missed)}"

    def around(self, design: D, free: ArrayLike | None = None) -> Self:
        """The same study of another design of the same kind, where a search then begins; with other ``free`` values.

        The design is made so that what is free can vary (see `Design.ready_for`): a plain motion law whose
        coefficients are free becomes one that they shape, a spring as strong as needed gets the rate that is needed.

        >>> from camkit import door_handle_study
        >>> study = door_handle_study()
        >>> study.around(study.start.replace(lift_arm=0.05)).x0[0]
        np.float64(0.05)
        """
        refuse_design(design, "the design")
        Paths(self.start, ()).values(design)  # refuses another kind
        study = replace(self, start=ready(design, self.free))
        return study if free is None else study.around(study.design(free))

    def freeing(self, free: Sequence[Any] | Free) -> Self:
        """The same study with other free quantities, as ``free`` of a study names them.

        Raises ``ValueError`` for one on which nothing depends that the study judges.
        """
        study = replace(self, free=free, start=ready(self.start, free if isinstance(free, Iterable) else ()))
        for path, idle in zip(study.free, study._idle(), strict=True):
            if idle:
                raise ValueError(f"the {words(path)} has no effect on what the study judges; it must not be free")
        return study

    def _idle(self) -> np.ndarray:
        """Which free quantities change no objective and no limit, wherever two designs differ in one alone."""
        (low, high), n = self.bounds, len(self.free)
        first, second = np.random.default_rng(1).uniform(low, high, (2, TRIED, n))
        x = np.repeat(first[:, None], n + 1, axis=1)
        x[:, range(n), range(n)] = second  # the last of each row stays as it was
        found = self.evaluate(x.reshape(-1, n))
        x = found.x.reshape(TRIED, n + 1, n)  # the same where it is no variable with the options of its menus
        judged = np.hstack([found.f, found.g]).reshape(TRIED, n + 1, -1)
        known = np.isfinite(judged).all(-1)
        known = known[:, :n] & known[:, n:] & (x[:, range(n), range(n)] != x[:, n])
        same = (judged[:, :n] == judged[:, n:]).all(-1) & known
        return np.asarray(same.any(0) & (same | ~known).all(0))

    def with_weights(self, weights: ArrayLike) -> Self:
        """The same study with other weights in the objectives that are weighted sums."""
        given = listed(weights, "the tuple of weights", "measure")
        changed = tuple(m.with_weights(given) if isinstance(m, WeightedSum) else m for m in self.minimise)
        for i, weight in enumerate(given, 1):
            checked_weight(weight, f"measure {i}")
        return replace(self, minimise=changed)

    def replace(self, **changes: Any) -> Self:
        """The same study with some fields changed."""
        refuse_fields(self, changes)
        return replace(self, **changes)
