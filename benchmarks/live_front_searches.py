"""How many designs searches evaluate to find a front: measures camkit/data/live_front_searches.json anew.

    python benchmarks/live_front_searches.py

Hypervolume of `quick_front` and of pymoo's NSGA-II against the designs evaluated so far, on the door handle's whole cam
with the default study's three free quantities and with four; both keep 100 designs.  What a search has found so far is
judged on all angles of the study, which counts for nothing.  A design of a rough round of `quick_front`, at few angles,
counts like any other.  Designs, not seconds, are stored: they are the same on every machine.  How much longer NSGA-II
takes is one ratio, of processor times taken in turn.
"""

from __future__ import annotations

import json
import platform
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pymoo
import scipy

from camkit import Study, __version__, door_handle_study
from camkit.machines.door_handle import DOOR_HANDLE_SPACE, EXPANDED_SPACE
from camkit.search.fast_front import fast_front_steps, quick_front
from camkit.search.front import front_of, reference_point
from camkit.search.nsga2 import nsga2_steps
from camkit.search.protocol import Step
from stored import in_rows

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "live_front_searches.json"
POPULATION, GENERATIONS, SEED, RUNS = 100, 1000, 1, 3
MANY, POLISHED = 1000, 20
FOUR = DOOR_HANDLE_SPACE | {"lift_centre_distance": EXPANDED_SPACE["lift_centre_distance"]}

PROBLEMS: dict[str, Callable[[], Study]] = {
    "three free quantities": door_handle_study,
    "four free quantities": lambda: door_handle_study(space=FOUR),
}
SEARCHES: dict[str, Callable[[Study], Iterator[Step]]] = {
    "NSGA-II (pymoo)": lambda study: nsga2_steps(study, POPULATION, GENERATIONS, SEED),
    "quick_front": lambda study: fast_front_steps(study, POPULATION),
}


def traced(study: Study, search: Callable[[Study], Iterator[Step]], reference: np.ndarray) -> dict[str, list[float]]:
    """Designs evaluated and the best hypervolume so far, step by step."""
    steps = [(step.evaluated, step.evaluation.x) for step in search(study)]
    some = [steps[i] for i in _shown(len(steps))]
    volumes = [front_of(study.evaluate(x), study).hypervolume(reference) for _, x in some]
    volumes = [float(f"{volume:.7g}") for volume in np.maximum.accumulate(volumes)]
    return {"designs": [designs for designs, _ in some], "hypervolume": volumes}


def _shown(n: int) -> np.ndarray:
    """Every step of a short search, of a long one as many as a logarithmic axis shows."""
    return np.arange(n) if n < 50 else np.unique(np.geomspace(1, n, 40).round().astype(int)) - 1


def best(study: Study, reference: np.ndarray) -> float:
    """The hypervolume of a front of 1000 designs that was polished again and again."""
    front = quick_front(study, MANY)
    for _ in range(POLISHED):
        front = quick_front(study, MANY, start=front)
    return float(f"{front.hypervolume(reference):.7g}")


def times_longer(study: Study) -> float:
    """The processor's time for NSGA-II over that for `quick_front`, each run once in turn: the median."""
    ratios = []
    for _ in range(RUNS):
        seconds = []
        for search in SEARCHES.values():
            began = time.process_time()
            *_, last = search(study)
            _ = last.front  # what is shown in the end is part of the search
            seconds.append(time.process_time() - began)
        ratios.append(seconds[0] / seconds[1])
    return float(f"{statistics.median(ratios):.2g}")


def of_problem(name: str) -> dict[str, Any]:
    """What is stored of one problem."""
    study = PROBLEMS[name]()
    reference = reference_point(study)
    found = {search: traced(study, run, reference) for search, run in SEARCHES.items()}
    print(name, {search: steps["hypervolume"][-1] for search, steps in found.items()}, flush=True)
    return {
        "free": list(study.free),
        "reference": reference.tolist(),
        "best": best(study, reference),
        "times_longer": times_longer(study),
        "searches": found,
    }


def measured() -> dict[str, Any]:
    """Everything that is stored."""
    np.seterr(all="ignore")
    versions = {"camkit": __version__, "python": platform.python_version(), "numpy": np.__version__}
    return {
        "about": "designs evaluated and hypervolume up to the reference point, step by step; every search keeps 100 "
        "designs; best: that of a front of 1000, polished; times_longer: the processor's time for NSGA-II over that "
        "for quick_front",
        "rebuild": "python benchmarks/live_front_searches.py",
        "made_with": versions | {"scipy": scipy.__version__, "pymoo": pymoo.__version__},
        "population": POPULATION,
        "generations": GENERATIONS,
        "seed": SEED,
        "problems": {name: of_problem(name) for name in PROBLEMS},
    }


if __name__ == "__main__":
    CACHE.write_text(in_rows(json.dumps(measured(), indent=1)) + "\n", encoding="utf-8")
