"""How a search for a front leaves room for tolerances: by margins that are fitted to a few of its designs.

Margins change slowly over the bounds, so that few designs are looked at within their tolerances, and the search itself
is that of the nominal study with tighter limits.
"""

from __future__ import annotations

import numpy as np

from ..quantities import D
from ..study.margins import FittedMargins
from ..study.recheck import rechecked
from ..study.robust import RobustStudy
from ..study.study import Evaluation, Study
from ..study.three_point import ThreePoint, seen
from .front import Front

FITTED, RAISED = 32, 16
"""So many designs are looked at for a fit, and to raise it at the end."""
PARTS = 1024
"""Parts of each design of a front that judge it at the end."""


class Room:
    """The room that designs of ``study`` need; none if it has no tolerances.

    Where more than the nominal objective counts, or ``fits`` is false, every design is looked at within its tolerances.
    """

    def __init__(self, study: Study, fits: bool = True) -> None:
        robust = study if fits and isinstance(study, RobustStudy) and study.objective == "nominal" else None
        self.study = robust and robust.sought
        self._known: list[tuple[np.ndarray, ...]] = []
        self._fit: FittedMargins | None = None

    @property
    def needed(self) -> bool:
        """Whether there is a fit to be made."""
        return self.study is not None

    def within(self, study: Study) -> Study:
        """``study`` as the search sees it: tightened by the fit that there is."""
        if not isinstance(study, RobustStudy) or self.study is None:
            return study
        return study.nominal if self._fit is None else study.tightened(self._fit.at)

    def renew(self, x: np.ndarray) -> None:
        """Fit the margins to designs ``(p, n_free)`` and to those of before."""
        assert self.study is not None
        self._known.append(self._looked_at(x, together=False))
        known = [np.concatenate(columns) for columns in zip(*self._known, strict=True)]
        if len(known[0]):
            self._fit = FittedMargins.to(self.study.bounds, *known)

    def raise_to(self, x: np.ndarray) -> None:
        """Raise the fit to what designs ``(p, n_free)`` need."""
        if self._fit is not None:
            self._fit = self._fit.above(*self._looked_at(x, together=True))

    def _looked_at(self, x: np.ndarray, together: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Those of some designs that can be built, their limits, and their margins."""
        assert self.study is not None
        g = seen(self.study.nominal.evaluate(x).g, self.study.floors)
        x, g = (values[np.isfinite(g).all(-1)] for values in (x, g))
        margins = self.study.held(x, self.study.models(x), together) - g
        return x, g, np.minimum(margins, -self.study.floors)


def looked_at_closely(study: Study, rough: Study, x: np.ndarray) -> Evaluation:
    """What a study says of designs: of their tolerances on the ``rough`` one's angles, moved to what all angles say."""
    if study.menus or not isinstance(study, RobustStudy) or not isinstance(rough, RobustStudy):
        return study.evaluate(x)
    if study.objective != "nominal":
        return study.evaluate(x)
    found, models = _moved(study, rough, x)
    return Evaluation(x, found.f, study.held(x, models))


def _moved(study: RobustStudy, rough: RobustStudy, x: np.ndarray) -> tuple[Evaluation, list[ThreePoint]]:
    """The nominal evaluation of designs, and models of their limits that agree with it."""
    found = study.nominal.evaluate(x)
    with np.errstate(invalid="ignore"):
        by = seen(found.g, study.floors) - seen(rough.nominal.evaluate(x).g, study.floors)
    by = np.where(np.isfinite(by), by, 0.0)
    models = [m._replace(centre=m.centre + by[:, i : i + 1]) for i, m in enumerate(rough.models(x))]
    return found, models


def surviving(front: Front[D], rough: Study) -> Front[D]:
    """The designs of a front whose yield is enough by exact parts, with what these say of each: ``yields``."""
    study = front.study
    if not isinstance(study, RobustStudy) or not isinstance(rough, RobustStudy) or not len(front):
        return front
    moved = None if study.menus or not study.free else _moved(study, rough, front.x)[1]
    checked = study.recheck(front.x, PARTS) if moved is None else rechecked(study, front.x, PARTS, moved)
    good = checked.share >= checked.wanted
    best = (
        f"no design of the front yields {100 * checked.wanted:g} %; the best yields {100 * checked.share.max():.1f} %"
    )
    found = Front(study, front.x[good], front.f[good], front.message if good.any() else best, front.record)
    vars(found)["yields"] = checked.of(good)
    return found
