"""How fast searches find a front: measures camkit/data/live_front_searches.json anew.

    python benchmarks/live_front_searches.py

Hypervolume against time of pymoo's NSGA-II, of `quick_front`, and of pygmo's NSGA-II if pygmo is installed, on the
door handle's whole cam with the default study's three free quantities and with four.  What a search keeps is judged
on all angles of the study, with the clock stopped.  Times are those of the processor, which neighbours on the machine
change less than those of the clock; every search runs on one.  Every search keeps 100 designs; times of `quick_front`
are the median of several runs.  pygmo's NSGA-II knows no limits: a design that misses one gets objectives worse
than any, the more so the more it misses.
"""

from __future__ import annotations

import json
import platform
import time
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pymoo
import scipy

from camkit import __version__, door_handle_study
from camkit.machines.door_handle import DOOR_HANDLE_SPACE, EXPANDED_SPACE
from camkit.search.fast_front import fast_front_steps, quick_front
from camkit.search.front import front_of, reference_point
from camkit.search.nsga2 import nsga2_steps
from camkit.study.study import Evaluation, Study

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "live_front_searches.json"
POPULATION, GENERATIONS, SEED, RUNS = 100, 1000, 1, 5
MANY, POLISHED = 1000, 20
FOUR = DOOR_HANDLE_SPACE | {"lift_centre_distance": EXPANDED_SPACE["lift_centre_distance"]}

PROBLEMS: dict[str, Callable[[], Study]] = {
    "three free quantities": door_handle_study,
    "four free quantities": lambda: door_handle_study(space=FOUR),
}

Fronts = Iterator[Any]
"""Step by step something whose ``x`` are the free values kept so far, ``(p, n)``."""


def pymoo_nsga2(study: Study) -> Fronts:
    """NSGA-II of pymoo, a batched evaluation for each generation."""
    for generation in nsga2_steps(study, POPULATION, GENERATIONS, SEED):
        yield generation.evaluation


def archive(study: Study) -> Fronts:
    """`quick_front` round by round."""
    for step in fast_front_steps(study, POPULATION):
        if step.number == step.of:
            _ = step.front  # what is shown in the end is part of the search
        yield step.evaluation


class Penalised:
    """A study as pygmo sees it: a batch at a time, limits as a penalty."""

    def __init__(self, study: Study) -> None:
        self.study = study

    def get_bounds(self) -> tuple[list[float], list[float]]:
        low, high = self.study.bounds
        return low.tolist(), high.tolist()

    def get_nobj(self) -> int:
        return len(self.study.minimise)

    def _told(self, evaluation: Evaluation) -> np.ndarray:
        missed = np.minimum(np.maximum(evaluation.g, 0).sum(-1, keepdims=True), 1e6)
        return np.where(evaluation.feasible[:, None], evaluation.f, 1e3 + missed)

    def fitness(self, x: Any) -> np.ndarray:
        return self._told(self.study.evaluate(x))[0]

    def batch_fitness(self, x: Any) -> np.ndarray:
        return self._told(self.study.evaluate(np.reshape(x, (-1, len(self.study.free))))).ravel()


def pygmo_nsga2(study: Study) -> Fronts:
    """NSGA-II of pygmo with the same population, a batched evaluation for each generation."""
    pygmo = import_module("pygmo")
    batch = pygmo.bfe(pygmo.member_bfe())
    population = pygmo.population(pygmo.problem(Penalised(study)), size=POPULATION, b=batch, seed=SEED)
    generation = pygmo.nsga2(gen=1, seed=SEED)
    generation.set_bfe(batch)
    algorithm = pygmo.algorithm(generation)
    for _ in range(GENERATIONS):
        population = algorithm.evolve(population)
        yield SimpleNamespace(x=population.get_x())


def timed(study: Study, search: Callable[[Study], Fronts], reference: np.ndarray, runs: int = 1) -> list[list[float]]:
    """Pairs of seconds and hypervolume; the clock stands still while the front is judged."""
    times, volumes = [], []
    for _ in range(runs):
        kept, seconds, mark = [], [], time.process_time()
        for step in search(study):
            seconds.append(time.process_time() - mark)
            kept.append(step)
        times.append(seconds)
        volumes = [front_of(study.evaluate(step.x), study).hypervolume(reference) for step in _some(kept)]
    return [
        [float(f"{t:.4g}"), float(f"{v:.7g}")]
        for t, v in zip(_some(np.median(times, axis=0)), np.maximum.accumulate(volumes), strict=True)
    ]


def best(study: Study, reference: np.ndarray) -> float:
    """The hypervolume of a front of 1000 designs that was polished again and again."""
    front = quick_front(study, MANY)
    for _ in range(POLISHED):
        front = quick_front(study, MANY, start=front)
    return float(f"{front.hypervolume(reference):.7g}")


def _some(steps: Any) -> list[Any]:
    """Every step of a short search, of a long one as many as a logarithmic axis shows."""
    n = len(steps)
    rows = range(n) if n < 50 else np.unique(np.geomspace(1, n, 60).round().astype(int)) - 1
    return [steps[i] for i in rows]


def searches() -> dict[str, tuple[Callable[[Study], Fronts], int]]:
    """Every search there is, and how often it is run."""
    found: dict[str, tuple[Callable[[Study], Fronts], int]] = {
        "NSGA-II (pymoo)": (pymoo_nsga2, 1),
        "quick_front": (archive, RUNS),
    }
    if find_spec("pygmo"):
        found["NSGA-II (pygmo)"] = (pygmo_nsga2, 1)
    return found


def measured() -> dict[str, Any]:
    """Everything that is stored."""
    np.seterr(all="ignore")
    versions = {"camkit": __version__, "python": platform.python_version(), "numpy": np.__version__}
    versions |= {"scipy": scipy.__version__, "pymoo": pymoo.__version__, "machine": platform.machine()}
    if find_spec("pygmo"):
        versions["pygmo"] = import_module("pygmo").__version__
    problems = {}
    for name, make in PROBLEMS.items():
        study = make()
        reference = reference_point(study)
        found = {}
        for search, (run, runs) in searches().items():
            found[search] = timed(study, run, reference, runs)
            print(name, search, *found[search][-1], flush=True)
        problems[name] = {
            "free": list(study.free),
            "reference": reference.tolist(),
            "best": best(study, reference),
            "searches": found,
        }
    return {
        "about": "seconds and hypervolume up to the reference point, step by step; every search keeps 100 designs; "
        "best: that of a front of 1000, polished",
        "rebuild": "python benchmarks/live_front_searches.py",
        "made_with": versions,
        "population": POPULATION,
        "generations": GENERATIONS,
        "seed": SEED,
        "problems": problems,
    }


def main() -> None:
    text = json.dumps(measured(), indent=1)
    CACHE.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
