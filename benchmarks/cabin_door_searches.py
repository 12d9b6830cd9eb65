"""Searches of the cabin-door linkage, measured: writes camkit/data/cabin_door_searches.json anew.

    python benchmarks/cabin_door_searches.py

The call of a genetic algorithm that the paper prints, equation (10), with two sizes of the crowd (the paper prints
none), beside NSGA-II with 50 designs: for as many generations, and for as many designs as the paper's call looks at.
Thirty seeds each; what counts is the least sum of all designs looked at.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pymoo
import scipy

from camkit import __version__
from camkit.data import load
from camkit.machines.cabin_door import rssr_study
from camkit.search.evolution import StudyProblem
from camkit.search.nsga2 import nsga2_steps
from camkit.search.toolbox_genetic import ToolboxGenetic
from camkit.units import deg
from stored import in_rows

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "cabin_door_searches.json"
SEEDS = 30
PRINTED = load("cabin_door")["search"]
STUDY = rssr_study()


def printed_call(population: int, seed: int) -> tuple[float, int]:
    """Least sum [rad] that the paper's call finds, and how many designs it looked at."""
    numbers = {name: PRINTED[name] for name in ("best", "crossovers", "mutations", "generations", "shape")}
    search = ToolboxGenetic(population, **numbers)
    search.setup(StudyProblem(STUDY), termination=("n_gen", PRINTED["generations"]), seed=seed)  # type: ignore[arg-type]
    search.run()
    return float(search.opt[0].F[0]), int(search.evaluator.n_eval)


def by_nsga2(generations: int, seed: int) -> tuple[float, int]:
    """The same of NSGA-II with 50 designs."""
    least = [float(g.evaluation.f.min()) for g in nsga2_steps(STUDY, 50, generations, seed)]
    return min(least), 50 * generations


METHODS: dict[str, Callable[[int], tuple[float, int]]] = {
    "the printed call, 50 designs": lambda seed: printed_call(50, seed),
    "the printed call, 80 designs": lambda seed: printed_call(80, seed),
    "NSGA-II, 50 designs, 36 generations": lambda seed: by_nsga2(36, seed),
    "NSGA-II, 50 designs, 300 generations": lambda seed: by_nsga2(300, seed),
}


def trials(name: str) -> dict[str, Any]:
    """Least sum [deg] and designs looked at of every seed."""
    found = [METHODS[name](seed) for seed in range(SEEDS)]
    print(name, "done", flush=True)
    return {"sum": [round(f / deg, 6) for f, _ in found], "designs": [count for _, count in found]}


def main() -> None:
    data = {
        "about": "least sum of |alpha - 30 deg| [deg] that each search of the cabin-door linkage found, seed by seed",
        "rebuild": "python benchmarks/cabin_door_searches.py",
        "made_with": {
            "camkit": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "pymoo": pymoo.__version__,
            "machine": platform.machine(),
        },
        "searches": {name: trials(name) for name in METHODS},
    }
    CACHE.write_text(in_rows(json.dumps(data, indent=1)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
