"""How a search for a front leaves room for tolerances: by margins that are fitted to a few of its designs.

Margins change slowly over the bounds, so that few designs are looked at within their tolerances, and the search itself
is that of the nominal study with tighter limits.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..quantities import D
from ..study.margins import FittedMargins
from ..study.recheck import models_by_few_angles
from ..study.robust import RobustStudy
from ..study.study import Evaluation, Study
from ..study.three_point import seen
from .front import Front

FITTED, RAISED = 32, 16
"""So many designs are looked at for a fit, and to raise it at the end."""
TRIED, FEW, ROUNDS, NEAR, LAST = 1024, 32, 5, 0.1, 2
"""Of so many designs all over the bounds a few are modelled, then as many near the best, at first so far; the last."""


class Room:
    """The room that designs of ``study`` need; none if it has no tolerances.

    Where more than the nominal objective counts, or ``fits`` is false, every design is looked at within its tolerances.
    """

    def __init__(self, study: Study, fits: bool = True) -> None:
        robust = study if fits and isinstance(study, RobustStudy) and study.objective == "nominal" else None
        self.study = robust and robust.sought
        self._known: list[tuple[np.ndarray, ...]] = []
        self._fit: FittedMargins | None = None
        self._within: tuple[Study | None, Study | None] = None, None
        """The last study that was tightened by the fit, and what it became."""

    @property
    def needed(self) -> bool:
        """Whether there is a fit to be made."""
        return self.study is not None

    def within(self, study: Study) -> Study:
        """``study`` as the search sees it: tightened by the fit that there is."""
        if not isinstance(study, RobustStudy) or self.study is None:
            return study
        if self._fit is None:
            return study.nominal
        last, tightened = self._within
        if tightened is None or study is not last:
            tightened = study.tightened(self._fit.at)
            self._within = study, tightened
        return tightened

    def renew(self, x: np.ndarray) -> None:
        """Fit the margins to designs ``(p, n_free)`` and to those of before."""
        assert self.study is not None
        self._known.append(self._looked_at(x, together=False))
        known = [np.concatenate(columns) for columns in zip(*self._known, strict=True)]
        if len(known[0]):
            self._fit, self._within = FittedMargins.to(self.study.bounds, *known), (None, None)

    def raise_to(self, x: np.ndarray) -> None:
        """Raise the fit to what designs ``(p, n_free)`` need."""
        if self._fit is not None:
            self._fit, self._within = self._fit.above(*self._looked_at(x, together=True)), (None, None)

    def _looked_at(self, x: np.ndarray, together: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Those of some designs that can be built, their limits, and their margins."""
        assert self.study is not None
        g = seen(self.study.nominal.evaluate(x).g)
        x, g = (values[np.isfinite(g).all(-1)] for values in (x, g))
        return x, g, self.study.margins(x, together)


def looked_at_closely(study: Study, rough: Study, x: np.ndarray) -> Evaluation:
    """What a study says of designs: of their tolerances on the ``rough`` one's angles, moved to what all angles say."""
    if study.menus or not isinstance(study, RobustStudy) or not isinstance(rough, RobustStudy):
        return study.evaluate(x)
    if study.objective != "nominal":
        return study.evaluate(x)
    found = study.nominal.evaluate(x)
    models = models_by_few_angles(study, rough, x, found)
    return Evaluation(x, found.f, study.held(x, models))


def most_tolerant(study: RobustStudy) -> tuple[np.ndarray, float]:
    """The design ``(n_free,)`` found that allows the largest factor on all tolerances, and that factor.

    Of designs all over the bounds those that keep their limits by most, then others near the best of them.
    """
    from scipy.stats import qmc

    low, high = study.bounds
    draw, step = np.random.default_rng(0), NEAR
    tried = low + (high - low) * qmc.Sobol(len(low), rng=0).random(TRIED)
    found = study.nominal.evaluate(tried)
    worst = np.where(np.isfinite(found.f).all(-1), found.g.max(-1, initial=-1.0), np.inf)
    x = tried[np.argsort(worst, kind="stable")[:FEW]]
    growth = study.modelled_growth(x)
    for _ in range(ROUNDS):
        near = x[growth.argmax()] + step * (high - low) * draw.standard_normal((FEW, len(low)))
        x = np.concatenate([x, np.clip(near, low, high)])
        growth, step = np.concatenate([growth, study.modelled_growth(x[-FEW:])]), step / 2
    best = x[np.argsort(-growth, kind="stable")[:LAST]]
    factors = study.tolerance_factor(best)
    return best[factors.argmax()], float(factors.max())


def surviving(front: Front[D]) -> Front[D]:
    """The designs of a front whose yield is enough for sure, by exact parts, with what these say of each: ``yields``.

    That all parts keep their limits, no number of parts makes sure; then none of them may miss one.
    """
    study = front.study
    if not isinstance(study, RobustStudy) or not len(front):
        return front
    checked = study.recheck(front.x)
    good = checked.kept if checked.wanted < 1 else checked.missed == 0
    wanted, best = f"{100 * checked.wanted:g} %", str(checked.of(np.array([checked.share.argmax()])))
    message = front.message if good.all() else f"{(~good).sum()} of {len(good)} left out: not sure to yield {wanted}"
    if not good.any():
        message = f"no design of the front yields {wanted} for sure; the best yields {best}"
    found = replace(front, x=front.x[good], f=front.f[good], message=message)
    vars(found)["yields"] = checked.of(good)
    return found
