"""What one objective costs the other along a front, and what a limit costs the objective of a minimum; in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..quantities import Measure, Quantity, label
from ..study.robust import RobustStudy
from ..study.study import Study
from ..units import factor
from .minimax import Epigraph

REACHED = 1e-6
"""A point of a curve that comes this near to its bound, a share, is at it: its neighbours pull another way."""
CLOSE = 1e-4
"""A peak, a limit or a bound holds a design that comes as near to it, as a share of it."""
APART = 0.02
"""Designs are next to each other from this share of the range on; between nearer ones there is little but noise."""
STATIONARY = 1e-2
"""So much of the objective's slope may be left where the limits are to hold it."""


def slope_on_front(f: np.ndarray, place: int) -> float:
    """How fast the second objective falls with the first at a design of a front ``(p, 2)``.

    That of the parabola through the nearest designs on both sides (three-point formula), `APART` or more of the first
    objective's range away; ``nan`` at the front's ends.
    """
    x, y = f[place]
    away = (f[:, 0] - x) / (np.ptp(f[:, 0]) or 1.0)
    before, after = f[away <= -APART], f[away >= APART]
    if not (len(before) and len(after)):
        return float("nan")
    left, right = before[before[:, 0].argmax()] - (x, y), after[after[:, 0].argmin()] - (x, y)
    slopes = left[1] / left[0], right[1] / right[0]
    return float(np.average(slopes, weights=(right[0], -left[0])))


def multipliers(study: Study, x: np.ndarray) -> dict[Measure | str, float]:
    """How the least objective changes with each limit, by its measure, and bound, by its path, that holds it at ``x``.

    SI over SI, where the limit is moved outwards: Lagrange's multipliers in the epigraph form (Karush, Kuhn, Tucker);
    of several sets of them those by which the objective falls least.  Margins for tolerances stay as they are.  ``nan``
    where limits and bounds do not hold the design, which is then no minimum.
    """
    from scipy.optimize import linprog, nnls

    if study.menus:
        made = study.options.at(x)
        return multipliers(made.study, made.x(study.rows(x))[0]) if made.study.free else {}
    nominal, (low, high) = study.nominal, study.bounds
    size = float(abs(nominal.evaluate(x).f[0, 0])) or 1.0
    if not np.isfinite(size):
        return {}
    problem = Epigraph(nominal, size, study.exact_margins(x) if isinstance(study, RobustStudy) else 0.0)
    u = problem.u(x)
    t = problem.tops(problem.at(u))
    near = problem.excess(problem.at(u), t) >= -REACHED
    upper, lower = np.flatnonzero(u >= 1 - CLOSE), np.flatnonzero(u <= CLOSE)
    ends = np.concatenate([np.eye(len(u))[upper], -np.eye(len(u))[lower]])
    by_t = problem.owner[near, None] == np.arange(len(t))
    pulls = np.block([[problem.slopes(u)[near], -by_t.astype(float)], [ends, np.zeros((len(ends), len(t)))]]).T
    pulled, left = nnls(pulls, np.append(np.zeros_like(u), -np.ones_like(t)))
    m, n, wide = len(nominal.limits), len(u), 1 / (high - low)
    whose = np.concatenate([problem.limit[near], m + upper, m + n + lower])
    outwards = [-sense / (abs(v) or 1.0) for _, v, sense in nominal.limits] + [*-wide, *wide]
    names: list[Measure | str] = [*(measure for measure, _, _ in nominal.limits), *[*study.free] * 2]
    found = {}
    for k in np.unique(whose[whose >= 0]):
        least = linprog(whose == k, A_eq=pulls, b_eq=pulls @ pulled)
        multiplier = max(least.fun, 0) if least.status == 0 else pulled[whose == k].sum()
        found[names[k]] = float(size * outwards[k] * multiplier) if left <= STATIONARY else float("nan")
    return found


def told_on_front(objectives: Sequence[Measure], rates: np.ndarray) -> str:
    """What the first objective costs the second, in words; nothing where nobody knows."""
    if len(objectives) != 2 or not np.isfinite(rates[0, 1]):
        return ""
    first, second = objectives
    step, size = _step(first)
    return f"{step} {_better(first)} {first.name} costs {_amount(second, size * rates[0, 1], _better(-second))}."


def told_of_limits(study: Study, rates: Mapping[Measure | str, float]) -> list[str]:
    """What more room for each limit and bound would bring, in words; nothing of those that bring nothing."""
    objective, told = study.minimise[0], []
    for limit, rate in rates.items():
        step, size = _step(study.declared[limit] if isinstance(limit, str) else limit)
        name = label(limit, study.declared[limit]) if isinstance(limit, str) else limit.name
        if size * abs(rate) > 0:
            the = "" if len(name) == 1 else "the "  # a quantity that is known by its letter alone
            gain = _amount(objective, size * abs(rate), _better(objective))
            told.append(f"{step} more room for {the}{name}: {gain}.")
    return told


def _step(known: Measure | Quantity) -> tuple[str, float]:
    """One unit, or a hundredth of what has none: in words, and in SI."""
    return (f"1 {known.unit}", factor(known.unit)) if known.unit else ("0.01", 0.01)


def _better(measure: Measure) -> str:
    return "less" if measure.sign > 0 else "more"


def _amount(measure: Measure, value: float, direction: str) -> str:
    return f"{measure.text(value)} {direction} {measure.name}"
