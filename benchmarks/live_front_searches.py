"""How many designs searches evaluate to find a front: measures camkit/data/live_front_searches.json anew.

    python benchmarks/live_front_searches.py

Hypervolume of `quick_front` and of pymoo's NSGA-II against the designs evaluated so far, on the door handle's whole cam
with the default study's three free quantities; both keep 100 designs.  What a search has found so far is
judged on all angles of the study, which counts for nothing.  A design of a rough round of `quick_front`, at few angles,
counts like any other.  Designs, not seconds, are stored: they are the same on every machine.  How much longer NSGA-II
takes is one ratio, of processor times taken in turn; all its generations take alike, so that a tenth of them is timed.
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
from camkit.search.fast_front import fast_front_steps, quick_front
from camkit.search.front import front_of, reference_point
from camkit.search.nsga2 import nsga2, nsga2_steps
from camkit.search.protocol import Step
from stored import in_rows

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "live_front_searches.json"
POPULATION, GENERATIONS, SEED = 100, 1000, 1
RUNS, TENTH = 3, 10
MANY, POLISHED = 1000, 20
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
    """The processor's time for NSGA-II over that for `quick_front`, in turn: the median."""
    ratios = []
    for _ in range(RUNS):
        genetic = _seconds(lambda: nsga2(study, POPULATION, GENERATIONS // TENTH, SEED))
        ratios.append(TENTH * genetic / _seconds(lambda: quick_front(study, POPULATION)))
    return float(f"{statistics.median(ratios):.2g}")


def _seconds(search: Callable[[], Any]) -> float:
    began = time.process_time()
    search()
    return time.process_time() - began


def measured() -> dict[str, Any]:
    """Everything that is stored."""
    np.seterr(all="ignore")
    study = door_handle_study()
    reference = reference_point(study)
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
        "free": list(study.free),
        "reference": reference.tolist(),
        "best": best(study, reference),
        "times_longer": times_longer(study),
        "searches": {name: traced(study, search, reference) for name, search in SEARCHES.items()},
    }


if __name__ == "__main__":
    CACHE.write_text(in_rows(json.dumps(measured(), indent=1)) + "\n", encoding="utf-8")
