"""Searches of the high-speed cam, measured: writes camkit/data/high_speed_searches.json anew.

    python benchmarks/high_speed_searches.py

Least contact stress by four methods from ten seeds each (those of `test_minimax`), and contact stress against wear,
for the sizes alone and with both laws free, by limits on the wear (epsilon-constraint) and by NSGA-II.  Times are
the processor's and depend on the machine; all else is the same for the same libraries.
"""

from __future__ import annotations

import json
import platform
import resource
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pymoo
import scipy

from camkit import __version__
from camkit.papers.high_speed_cam import trade_off_studies
from camkit.search.epsilon_constraint import epsilon_constraint_steps
from camkit.search.nsga2 import nsga2_steps
from camkit.search.protocol import Step
from camkit.units import mm
from stored import in_rows
from test_minimax import METHODS, PROBLEMS, ten_trials

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "high_speed_searches.json"
POINTS, POPULATION, RECHECK = 33, 100, 4001
GENERATIONS = {"sizes alone": 100, "laws free": 1000}


def min_stress() -> dict[str, Any]:
    """Stress reached [N^0.5 mm^-0.5; null: no design kept all limits], designs and seconds of every trial."""
    found: dict[str, Any] = {}
    for name in PROBLEMS:
        found[name] = {}
        for method in METHODS:
            trials = ten_trials(name, method)
            found[name][method] = {
                "stress": [float(t.f * mm**0.5) if np.isfinite(t.f) else None for t in trials],
                "designs": [t.designs for t in trials],
                "seconds": [round(t.seconds, 3) for t in trials],
            }
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            print(f"{name}, {method}: at most {peak:.0f} MB so far", flush=True)
    return found


def front(steps: Iterator[Step]) -> dict[str, Any]:
    """Free values of the front that a search comes to, how many steps and seconds it took."""
    begun = time.process_time()
    *_, last = steps
    seconds = time.process_time() - begun
    print(f"front of {len(last.front)} designs in {seconds:.1f} s", flush=True)
    return {"seconds": round(seconds, 2), "steps": last.of, "x": last.front.x.tolist()}


def fronts() -> dict[str, Any]:
    """Contact stress against wear."""
    found = {}
    for name, generations in GENERATIONS.items():
        smooth, plain = trade_off_studies(free_laws=name == "laws free")
        found[name] = {
            "epsilon-constraint": front(epsilon_constraint_steps(smooth, POINTS, recheck=RECHECK)),
            "NSGA-II": front(nsga2_steps(plain, POPULATION, generations, 1)),
        }
    return found


def main() -> None:
    data = {
        "about": "least contact stress of the high-speed cam by four methods, and its trade-off against wear",
        "rebuild": "python benchmarks/high_speed_searches.py",
        "made_with": {
            "camkit": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "pymoo": pymoo.__version__,
            "machine": platform.machine(),
        },
        "min_stress": min_stress(),
        "fronts": fronts(),
    }
    CACHE.write_text(in_rows(json.dumps(data, indent=1)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
