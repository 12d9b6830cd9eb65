"""The last step of a search whose objective is a sum of absolute values, which no gradient method likes.

Each ``|r|`` is replaced by a number ``t`` of its own and a pair of inequalities, ``-t <= r <= t``: smooth again,
and small where the sum of all ``t`` is small.
"""

from __future__ import annotations

import numpy as np

from ..quantities import D
from ..quantities.kinds import numbers, refuse_arguments, shown
from ..study.options import refuse_menus
from ..study.residuals import SumOfResiduals
from ..study.study import KEPT, Evaluation, Study
from .minimax import Epigraph
from .minimum import Minimum


def polish(study: Study[D], x: object = None) -> Minimum[D]:
    """The best design next to ``x`` (default: the study's start) within all limits, by SLSQP.

    The study's objective is a `SumOfResiduals`; what else there is to be small is the business of `minimise`.

    >>> from camkit.machines import rssr_study
    >>> found = polish(rssr_study())
    >>> print(f"{np.degrees(found.f):.5f} deg, crank {1e3 * found.design.crank:.2f} mm")
    213.29848 deg, crank 80.00 mm

    Raises ``ValueError`` for another objective, or a start that lies outside its bounds or cannot be built.
    """
    refuse_arguments(polish, locals())
    if study.nominal is not study:
        raise ValueError("the study is one under tolerances; polish takes none: use minimise")
    refuse_menus(study, "polish")
    objective = _sum_of_residuals(study)
    start = study.x0 if x is None else numbers(x, "the design to polish")
    if start.shape != study.x0.shape:
        raise ValueError(f"the design to polish is {shown(x)}; it must be one number for each free quantity")
    low, high = study.bounds
    before = study.evaluate(start)
    if not ((low <= start) & (start <= high)).all():
        raise ValueError("the design to polish lies outside the bounds of the study")
    if not np.isfinite(before.f).all():
        raise ValueError("the design to polish cannot be built; start from one that a search has found")
    spelled = study.replace(minimise=(objective.spelled_out(study.analysis(start[None])),))
    problem = Epigraph(spelled, float(before.f[0, 0]) or 1.0, KEPT)
    found = problem.descend(problem.u(start))
    after = study.evaluate(problem.x(found.u))
    if _merit(before) <= _merit(after):
        return _polished(study, before, problem.evaluations, "no better design lies next to the start")
    words = f"best of its neighbours after {found.steps} steps" if found.finished else "stopped before it was the best"
    return _polished(study, after, problem.evaluations, words)


def _sum_of_residuals(study: Study) -> SumOfResiduals:
    """The one objective of a study that can be polished."""
    objective = study.minimise[0]
    if len(study.minimise) > 1 or not isinstance(objective, SumOfResiduals) or objective.sign < 0:
        names = " and ".join(measure.name for measure in study.minimise)
        raise ValueError(f"the study minimises the {names}; polish takes one sum of residuals: use minimise")
    return objective


def _merit(evaluation: Evaluation) -> tuple[float, float]:
    """Broken limits first, then the objective."""
    return float(evaluation.missed.sum()), float(evaluation.f[0, 0])


def _polished(study: Study, evaluation: Evaluation, evaluations: int, message: str) -> Minimum:
    feasible = bool(evaluation.feasible[0])
    broken = "" if feasible else "; it does not keep every limit"
    f = float(evaluation.f[0, 0])
    return Minimum(study, evaluation.x[0], f, feasible, evaluations, message=message + broken)
