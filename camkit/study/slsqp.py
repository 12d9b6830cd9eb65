"""The one call of SLSQP (Kraft 1988), as scipy has it: an objective and what it has to keep, with all their slopes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..quantities.types import Array


def slsqp(
    start: Array,
    objective: tuple[Callable[[Array], float], Callable[[Array], Array]],
    room: tuple[Callable[[Array], Array], Callable[[Array], Array]],
    precision: float,
    steps: int = 100,
    unbounded: int = 0,
) -> Any:
    """Descend from ``start``, numbers from 0 to 1, the last ``unbounded`` of which may be any; what scipy returns.

    ``objective`` becomes small and every number of ``room`` stays at least 0; with each is the function of its slopes.

    >>> import numpy as np
    >>> circle = lambda z: 1 - z @ z, lambda z: -2 * z
    >>> slsqp(np.zeros(2), (lambda z: -z.sum(), lambda z: -np.ones(2)), circle, 1e-12).x.round(6).tolist()
    [0.707107, 0.707107]
    """
    from scipy.optimize import minimize

    return minimize(
        objective[0],
        start,
        jac=objective[1],
        bounds=[(0, 1)] * (len(start) - unbounded) + [(None, None)] * unbounded,
        constraints={"type": "ineq", "fun": room[0], "jac": room[1]},
        method="SLSQP",
        options={"maxiter": steps, "ftol": precision},
    )
