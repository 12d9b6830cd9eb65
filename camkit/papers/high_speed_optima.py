"""Optima of the high-speed cam and of the cam with a lever, found beforehand: designs to read, not to search for.

`benchmarks/high_speed_optima.py` searches and stores free values; all that is told of them is evaluated here.
"""

from __future__ import annotations

import numpy as np

from ..data import load
from ..machines.cam_lever import CamLever, cam_lever_study
from ..machines.high_speed_measures import (
    GEOMETRY,
    high_speed_study,
    max_pressure_angle,
    peak_stress,
    peak_wear,
)
from ..quantities import Measure
from ..search.minimum import Minimum
from ..study.study import Study
from ..units import deg, mm
from .high_speed_cam import lever_problems

GOALS: dict[str, Measure] = {"stress index": peak_stress, "wear": peak_wear, "pressure angle": max_pressure_angle}
FREE = ("sizes", "laws", "sizes and laws")
ANGLES = 101


def solved_studies() -> dict[str, Study]:
    """Every problem whose optimum is stored: nine of one cam, named like ``"wear: sizes"``, and the sweep of the lever.

    >>> len([name for name in solved_studies() if ":" in name])
    9
    """
    studies = {f"{name}: {what}": _freed(goal, what) for name, goal in GOALS.items() for what in FREE}
    return studies | {problem.name: problem.study.replace(angles=ANGLES) for problem in lever_problems()}


def _freed(goal: Measure, what: str) -> Study:
    study = high_speed_study(objective=goal, free_laws="laws" in what, angles=ANGLES)
    return study.replace(free={n: b for n, b in study.free.items() if "sizes" in what or n not in GEOMETRY})


def stored_optima() -> dict[str, Minimum]:
    """The optimum of each of `solved_studies`, as it was found beforehand, evaluated now.

    >>> best = stored_optima()["stress index: sizes"]
    >>> best.feasible, best.study.minimise[0].text(best.f)
    (True, '1.683 N^0.5 mm^-0.5')
    """
    return {name: _evaluated(study, load("high_speed_optima")[name]) for name, study in solved_studies().items()}


def fast_press_study(interval: float) -> Study:
    """The cam and lever with ``r_k2`` of at most 120 mm and both intervals ``interval`` [rad]: the least stress."""
    start = CamLever(rise_angle=interval, return_angle=interval)
    return cam_lever_study(start, max_radius=120 * mm)


def fastest_press() -> Minimum[CamLever]:
    """The cam and lever with the shortest interval whose stress index is at most 7.85 N^0.5 cm^-0.5, stored likewise.

    >>> print(f"{fastest_press().design.rise_angle / deg:.1f} deg")
    46.6 deg
    """
    stored = load("high_speed_optima")["shortest interval"]
    return _evaluated(fast_press_study(stored["keeps_deg"] * deg), stored["optimum"])


def _evaluated(study: Study, x: list[float]) -> Minimum:
    values = np.array(x)
    found = study.evaluate(values)
    return Minimum(study, values, float(found.f[0, 0]), bool(found.feasible[0]), 1)
