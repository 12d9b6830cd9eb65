"""A study of designs that are made within tolerances: which share of the parts keeps every limit.

It is a study like any other, so that every search takes it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import D, Paths, Quantity, words
from ..quantities.kinds import one_number, shown
from ..quantities.types import Array
from .free import declared_with
from .margins import TightenedStudy, tightened
from .native import Answers
from .options import ready
from .recheck import Recheck, corners, joined, largest, rechecked
from .spread import Source, Tolerance, correlated, spread_shares
from .study import KEPT, Evaluation, Study
from .three_point import FLOOR, ThreePoint, seen, star
from .weighted import Points, added, told_of

PARTS = 512
"""Parts of each design whose limits are modelled, the same for every design."""
EXACT_PARTS = 4096
"""Parts that are evaluated for the margins of one design."""
FACTOR_PARTS, FACTOR_ROUNDS = 4096, 6
"""Parts for a tolerance factor, and how often the model is made anew at the tolerances that it found."""
DECIDING, MOST_GROWTH, STEP = 8, 4.0, 0.01
"""So many parts besides those that may be missed are evaluated for it; its largest step; the step of a slope."""
BEHIND = 1.0
"""By how much a design ranks behind others whose middle misses a limit itself."""
OBJECTIVES = ("nominal", "mean", "95 %", "worst")
SHORT = 0.7
"""A search aims so much nearer to a yield of 1, as a share of what is missing, than it has to come."""


@dataclass(frozen=True)
class RobustStudy(Study[D]):
    """A `Study` under ``tolerances``, as `Study.under` makes it: a limit is kept if enough of the parts keep it.

    ``tolerances`` maps paths of quantities, free or fixed, or a `Source` to a half width (SI), to a lowest and a
    highest deviation, or to a `Tolerance`.  A design is feasible if a share of ``yield_at_least`` of its parts can be
    built and keeps every limit; in the ``worst_case``, if all parts do.  ``objective`` says what is to be small: the
    objectives of the ``"nominal"`` design, their ``"mean"`` over the parts, what ``"95 %"`` of the parts stay below, or
    the ``"worst"``.  ``correlation`` maps pairs of tolerances to numbers between -1 and 1 (a Gaussian copula).

    An evaluation costs ``2k + 2`` of them for ``k`` tolerances: limits are modelled between the ends of the tolerances
    (see `three_point`) for 512 parts, all designs in one call.  `recheck` says what the yield is.

    Raises ``ValueError`` for a path that is no quantity of the design, tolerances that are none, a yield that is not
    above 0.5, and an unknown objective.
    """

    tolerances: Any = None
    yield_at_least: float = 0.99
    worst_case: bool = False
    objective: str = "nominal"
    correlation: Any = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.tolerances, Mapping) or not self.tolerances:
            raise ValueError(f"the tolerances are {shown(self.tolerances)}; they must be a mapping with one or more")
        made = {key: t if isinstance(t, Tolerance) else Tolerance(t) for key, t in self.tolerances.items()}
        object.__setattr__(self, "tolerances", made)
        for name in (name for i, name in enumerate(self.names) if name in self.names[:i]):
            raise ValueError(f"two tolerances are called {shown(name)}; each must have a name of its own")
        if not isinstance(self.correlation, (Mapping, type(None))):
            raise ValueError(
                f"the correlation is {shown(self.correlation)}; it must be a mapping from pairs of tolerances"
            )
        object.__setattr__(self, "correlation", dict(self.correlation or {}))
        wanted = one_number(self.yield_at_least, "the yield", "lie above 0.5, up to 1", lambda y: 0.5 < y <= 1)
        object.__setattr__(self, "yield_at_least", wanted)
        if self.objective not in OBJECTIVES:
            raise ValueError(f"the objective is {shown(self.objective)}; there are {', '.join(OBJECTIVES)}")
        moved = [path for path, _ in self._moves if path not in self.free]
        object.__setattr__(self, "start", ready(self.start, [*self.free, *moved]))
        self._correlation  # noqa: B018  refuses pairs that are none
        if self.menus:
            declared_with(self.start, self.menus, [path for path, _ in self._moves])
            return
        half = self._half(self._base(self.x0[None]))[1][0]
        for name, unknown in zip(self.names, np.isnan(half), strict=True):
            if unknown:
                raise ValueError(f"the tolerance of the {words(name)} is no number at the start of the study")
        if not (half > 0).any():
            raise ValueError("there is no tolerance above 0; one must be")

    @cached_property
    def nominal(self) -> Study[D]:
        """The same study without tolerances."""
        return Study(**{f.name: getattr(self, f.name) for f in fields(Study)})

    @property
    def wanted(self) -> float:
        """The share of parts that has to keep every limit; all corners in the worst case."""
        return 1.0 if self.worst_case else self.yield_at_least

    @property
    def sought(self) -> RobustStudy[D]:
        """The same study as a search should see it, which aims for a little more than the yield (0.993 for 0.99)."""
        return self.replace(yield_at_least=1 - SHORT * (1 - self.yield_at_least))

    # ---------------------------------------------------------------- parts

    @property
    def names(self) -> list[str]:
        """The names of what deviates: paths and sources."""
        return [key.name if isinstance(key, Source) else key for key in self.tolerances]

    @property
    def _moves(self) -> list[tuple[str, float]]:
        """Every path that a tolerance moves or depends on."""
        sources = (key for key in self.tolerances if isinstance(key, Source))
        plain = [(key, 1.0) for key in self.tolerances if not isinstance(key, Source)]
        return plain + [pair for source in sources for pair in (*source.moves, *source.of)]

    @cached_property
    def _parts(self) -> Paths:
        """The free paths, then those that tolerances move besides."""
        return Paths(self.start, dict.fromkeys([*self.free, *(path for path, _ in self._moves)]), Quantity)

    @cached_property
    def _points(self) -> Answers:
        """What the objectives, and the points of all limits, are of parts."""
        limits = [Points(measure, sense) for measure, _, sense in self.limits]
        return Answers(self, tuple(self._parts.declared), (*told_of(self.minimise), *limits))

    @cached_property
    def _matrices(self) -> tuple[Array, Array]:
        """How far each path moves with 1 of each tolerance, and of what each depends, both ``(k, n_paths)``."""
        column = {path: i for i, path in enumerate(self._parts.declared)}
        moves, of = np.zeros((2, len(self.tolerances), len(column)))
        for row, key in enumerate(self.tolerances):
            pairs = (key.moves, key.of) if isinstance(key, Source) else (((key, 1.0),),) * 2
            for matrix, told in zip((moves, of), pairs, strict=True):
                for path, factor in told:
                    matrix[row, column[path]] += factor
        return moves, of

    @cached_property
    def _correlation(self) -> Array | None:
        return correlated(self.names, self.correlation)

    def _base(self, x: Array) -> Array:
        """What designs ``(p, n_free)`` have at every path, ``(p, n_paths)``."""
        rest = np.array(self._parts.values(self.start)[x.shape[1] :], dtype=float)
        x = np.where(np.isfinite(x), x, np.nan)  # infinite ones would be multiplied by 0
        return np.hstack([x, np.broadcast_to(rest, (len(x), len(rest)))])

    def _half(self, base: Array) -> tuple[Array, Array]:
        """The middles of all tolerances and their half widths, both ``(p, k)``."""
        values = base @ self._matrices[1].T
        between = [
            tolerance.between(name, values[:, j])
            for j, (name, tolerance) in enumerate(zip(self.names, self.tolerances.values(), strict=True))
        ]
        low, high = np.stack(between, axis=-1)
        return (high + low) / 2, (high - low) / 2

    def made(self, x: Array, z: Array, growth: Any = 1.0) -> Array:
        """Parts of designs ``(p, n_free)`` at shares ``z`` ``(m, k)`` of the half widths, ``(p, m, n_paths)``, SI.

        ``growth``: a factor on all half widths, one number or ``(p, 1)``.
        """
        base = self._base(x)
        middle, half = self._half(base)
        return base[:, None] + (middle[:, None] + (growth * half)[:, None] * z) @ self._matrices[0]

    def analysis_of_parts(self, parts: Array) -> Any:
        """The analysis of parts ``(q, n_paths)``."""
        return self.analysis_of(self._parts.put(self.start, [np.ascontiguousarray(c)[:, None] for c in parts.T]))

    def judged(self, parts: Array) -> Evaluation:
        """What the nominal study says of parts ``(q, n_paths)``."""
        return self.judged_by(parts, self.values(parts, tuple(self._parts.declared)))

    def shares(self, parts: int = PARTS, seed: int = 0) -> Array:
        """Scrambled Sobol points as shares of the half widths, ``(parts, k)``."""
        from scipy.stats import qmc

        unit = qmc.Sobol(len(self.tolerances), rng=seed).random(parts)
        return spread_shares(unit, [t.spread for t in self.tolerances.values()], self._correlation)

    @cached_property
    def _shares(self) -> Array:
        return self.shares()

    # ---------------------------------------------------------------- limits under tolerances

    def models(self, x: Array, growth: Any = 1.0) -> list[ThreePoint]:
        """A model of each limit of designs ``(p, n_free)``: all designs at all ends of their tolerances in one call.

        Without limits one of what can be built.
        """
        return self._modelled(x, growth)[0]

    def _modelled(self, x: Array, growth: Any = 1.0) -> tuple[list[ThreePoint], list[ThreePoint]]:
        """Models of the limits, and of the objectives where more than the nominal ones count."""
        z = star(len(self.tolerances))
        parts = self.made(x, z, growth).reshape(-1, len(self._parts.declared))
        told = iter(np.split(self._points(parts).T, self._points.ends))
        f = [added(m, told).T for m in self.minimise]
        limits = [
            seen(_scaled(one.T, abs(v) or 1.0) - sense * np.sign(v))
            for (_, v, sense), one in zip(self.limits, told, strict=True)
        ]
        built = np.isfinite(np.hstack(f)).all(-1, keepdims=True)
        limits = [np.where(built, g, np.inf) for g in limits or [np.full((len(parts), 1), FLOOR)]]
        f = [] if self.objective == "nominal" else f
        limits, f = ([g.reshape(len(x), len(z), g.shape[-1]) for g in one] for one in (limits, f))
        return [ThreePoint.of(g) for g in limits], [ThreePoint.of(g, limit=False) for g in f]

    def modelled_yield(self, x: ArrayLike) -> Array:
        """Which share of 512 modelled parts of designs ``(p, n_free)`` can be built and keeps every limit, ``(p,)``.

        In the worst case of the corners.  0 for what cannot be built.  It costs ``2k + 1`` evaluations for each design,
        so that it can follow a slider; `recheck` says what the yield is.

        >>> from camkit import mm, shaft_study
        >>> robust = shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
        >>> robust.modelled_yield([[0.1293, 0.103], [0.1302, 0.103]]).round(2).tolist()
        [0.61, 1.0]
        """
        rows = self.rows(x)
        if self.menus:
            return self.options.table(rows, 1, lambda study, x: study.modelled_yield(x)[:, None], 0.0)[:, 0]
        return self._kept(self.models(rows))

    def _kept(self, models: list[ThreePoint]) -> Array:
        z = corners(self, models) if self.worst_case else self._shares
        return np.asarray((np.max([model.at(z) for model in models], axis=0) <= KEPT).mean(-1))

    def held(self, x: Array, models: list[ThreePoint], together: bool = True) -> Array:
        """What a share ``yield_at_least`` of the parts keeps of each limit, the largest that of all ``together``.

        In the worst case what the corners have where a limit is largest by its model: evaluated, not modelled.
        """
        if not self.limits:
            return np.zeros((len(x), 0))
        if self.worst_case:
            parts = self.made(x, np.stack([model.corner for model in models], axis=1))
            found = self.judged(parts.reshape(-1, parts.shape[-1])).g.reshape(len(x), len(models), -1)
            return seen(found).max(1)
        each = np.stack([model.at(self._shares) for model in models], axis=-1)
        place = int(np.ceil(self.yield_at_least * each.shape[1])) - 1
        g = np.partition(each, place, axis=1)[:, place]
        if together:
            most = np.partition(each.max(-1), place, axis=1)[:, place]
            np.put_along_axis(g, g.argmax(-1)[:, None], most[:, None], -1)
        return g

    def margins(self, x: ArrayLike, together: bool = True) -> Array:
        """By how much each limit is to be tightened, as a share of it, for designs ``(p, n_free)``: ``(p, n_limits)``.

        ``nominal.evaluate(x).g + margins(x)`` is kept (<= 0) where enough of the parts keep every limit, all of them
        ``together``.
        """
        rows = self.rows(x)
        if self.menus:
            return self.options.table(rows, len(self.limits), lambda study, x: study.margins(x, together), np.inf)
        models = self.models(rows)
        return self.held(rows, models, together) - self._near(self.nominal.evaluate(rows).g, models)

    def _near(self, g: Array, models: list[ThreePoint]) -> Array:
        """Limits ``(p, n_limits)``, those that are kept without end not farther from the models than they reach."""
        return np.maximum(seen(g), np.stack([m.low for m in models], axis=-1)[:, : len(self.limits)])

    def exact_margins(self, x: Array) -> Array:
        """The same at one design ``(n_free,)`` by parts that are evaluated, ``(n_limits,)``.

        One level for all limits, raised until enough of the parts keep all of them together.
        """
        models = self.models(x[None])
        z = corners(self, models) if self.worst_case else self.shares(EXACT_PARTS)
        here = self._near(self.nominal.evaluate(x).g, models)[0]
        away = self._near(self.judged(self.made(x[None], z.reshape(-1, z.shape[-1]))[0]).g, models) - here
        ordered = np.sort(away, axis=0)
        least = len(away) if self.worst_case else int(np.ceil(self.yield_at_least * len(away)))
        for place in range(least - 1, len(away)):
            margins = ordered[place]
            kept = (away + np.minimum(here, -margins) <= KEPT).all(-1)
            if kept.sum() >= least:
                break
        return np.asarray(margins)

    def tightened(self, margins: Callable[[Array], Array]) -> TightenedStudy[D]:
        """The nominal study with limits tightened by ``margins`` of designs ``(p, n_free)``."""
        return tightened(self, margins)

    def evaluate(self, x: ArrayLike) -> Evaluation:
        """Objectives and limits of ``p`` designs ``(p, n_free)``: limits as a share ``yield_at_least`` keeps them."""
        rows = self.rows(x)
        if self.menus:
            return self.options.evaluate(rows)
        found = self.judged_by(rows, self.values(rows))
        middle = found
        if (self._half(self._base(rows))[0] != 0).any():
            middle = self.judged(self.made(rows, np.zeros((1, len(self.tolerances))))[:, 0])
        f, g = found.f.copy(), found.g + np.where(found.missed > 0, BEHIND, 0.0)
        good = np.flatnonzero(middle.feasible & np.isfinite(found.f).all(-1))
        behind = np.flatnonzero(~middle.feasible)
        g[behind] = np.maximum(g[behind], np.where(middle.missed[behind] > 0, middle.g[behind] + BEHIND, -np.inf))
        if len(good):
            limits, objectives = self._modelled(rows[good])
            g[good] = self.held(rows[good], limits)
            if not self.limits:
                f[good] = np.where(self._kept(limits)[:, None] >= self.wanted, f[good], np.inf)
            for column, model in enumerate(objectives):
                f[good, column] = self._objective(model)
        return Evaluation(rows, f, g)

    def _objective(self, model: ThreePoint) -> Array:
        """What is to be small of an objective, ``(p,)``."""
        if self.objective == "worst":
            return model.worst
        values = model.at(self._shares)
        if self.objective == "mean":
            return np.asarray(values.mean(-1))
        place = int(np.ceil(0.95 * values.shape[1])) - 1
        return np.asarray(np.partition(values, place, axis=1)[:, place])

    def tolerance_factor(self, x: ArrayLike) -> Array:
        """The largest factor on all tolerances that keeps the yield, or the worst case, of designs: ``(p,)``.

        0 for what misses a limit even without tolerances, ``inf`` for what no tolerances like these can harm.  It is
        found by the models of the limits; the parts that decide are then evaluated.
        """
        rows = self.rows(x)
        if self.menus:
            return self.options.table(rows, 1, lambda study, x: study.tolerance_factor(x)[:, None], 0.0)[:, 0]
        growth = np.ones(len(rows))
        for number in range(FACTOR_ROUNDS):
            models = self.models(rows, growth[:, None])
            z = corners(self, models) if self.worst_case else self.shares(FACTOR_PARTS)
            more = self._growth(rows, growth, models, z, exact=number >= FACTOR_ROUNDS // 2)
            growth = growth * np.clip(more, 1e-3, MOST_GROWTH)
        endless = MOST_GROWTH ** (FACTOR_ROUNDS - 1)
        return np.where(more == 0, 0.0, np.where(growth >= endless, np.inf, growth))

    def modelled_growth(self, x: ArrayLike) -> Array:
        """About the `tolerance_factor` of designs, by models of the limits at these tolerances alone, ``(p,)``."""
        rows = self.rows(x)
        models, one = self.models(rows), np.ones(len(rows))
        z = corners(self, models) if self.worst_case else self._shares
        return self._growth(rows, one, models, z, exact=False) if models else np.full(len(rows), np.inf)

    def _growth(self, x: Array, growth: Array, models: list[ThreePoint], z: Array, exact: bool) -> Array:
        """By which factor the tolerances, times ``growth``, can still grow, ``(p,)``; ``exact``: by Newton's step."""
        room = np.min([model.room(z) for model in models], axis=0)
        m = room.shape[1]
        missing = 0 if self.worst_case else m - int(np.ceil(self.yield_at_least * m))
        few = np.argsort(room, axis=1)[:, : 3 * missing + DECIDING]
        if exact:
            each = np.take_along_axis(np.broadcast_to(z, (len(x), *z.shape[-2:])), few[..., None], 1)
            found = largest(self, self.made(x, each, growth[:, None]))
            above, below = (np.max([model.at(s * each) for model in models], axis=0) for s in (1 + STEP, 1 - STEP))
            with np.errstate(divide="ignore", invalid="ignore"):
                newton = 1 - found * (2 * STEP) / (above - below)
            guess = np.max([model.at(each) for model in models], axis=0)
            sure = np.isfinite(newton) & (above > below) & (found > guess + FLOOR)
            np.put_along_axis(room, few, np.where(sure, np.maximum(newton, 0), np.take_along_axis(room, few, 1)), 1)
        return np.asarray(np.partition(room, missing, axis=1)[:, missing])

    def recheck(self, x: ArrayLike, parts: int | None = None) -> Recheck:
        """The yield of designs by exact parts that no search has seen, with what is sure of it; see `Recheck`.

        ``parts``: how many, a power of two; unless said otherwise as many as decide it, up to 16384.
        """
        rows = self.rows(x)
        if not self.menus:
            return rechecked(self, rows, parts)
        groups = list(self.options.groups(rows)) or [(np.arange(0), self.options.at(self.x0))]
        return joined([(at, made.study.recheck(made.x(rows[at]), parts)) for at, made in groups])


def _scaled(points: Array, size: float) -> Array:
    """What `Points` say of a limit, over its size: moved by as much as the measure knows their largest more exactly."""
    points = (1 / size) * points
    if points.shape[1] == 1:
        return points
    points, whole = points[:, :-1], points[:, -1]
    with np.errstate(invalid="ignore"):
        by = whole - points.max(-1)
    return points + np.where(np.isfinite(by), by, 0.0)[:, None]
