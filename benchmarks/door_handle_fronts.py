"""The door-handle paper's search, 100 designs x 1000 generations: makes camkit/data/door_handle_fronts.json anew.

    python benchmarks/door_handle_fronts.py

NSGA-II for the whole cam in the paper's box and for the lift curve alone (two minutes).  Notebook 02 shows both fronts.
"""

from __future__ import annotations

import json
import platform
import time
from pathlib import Path
from typing import Any

import numpy as np
import pymoo
import scipy

from camkit import __version__, nsga2
from camkit.machines import door_handle_paper_study, lift_curve_study
from camkit.study.study import Study

STORED = Path(__file__).parents[1] / "camkit" / "data" / "door_handle_fronts.json"
POPULATION, GENERATIONS, SEED = 100, 1000, 1
STUDIES = {"whole cam": door_handle_paper_study, "lift curve": lift_curve_study}


def found(study: Study) -> dict[str, Any]:
    """The front of a study: free values and objectives in SI, radii negative as they are to be large."""
    began = time.process_time()
    front = nsga2(study, POPULATION, GENERATIONS, SEED)
    print(f"{len(front)} designs, {time.process_time() - began:.1f} s of the processor", flush=True)
    objectives = [measure.name for measure in study.minimise]
    return {"free": list(study.free), "objectives": objectives, "x": front.x.tolist(), "f": front.f.tolist()}


def main() -> None:
    np.seterr(all="ignore")
    versions = {"camkit": __version__, "python": platform.python_version(), "numpy": np.__version__}
    versions |= {"scipy": scipy.__version__, "pymoo": pymoo.__version__, "machine": platform.machine()}
    stored = {
        "about": "fronts of the door-handle paper's problem by NSGA-II, in SI; objectives are to be small",
        "rebuild": "python benchmarks/door_handle_fronts.py",
        "made_with": versions,
        "population": POPULATION,
        "generations": GENERATIONS,
        "seed": SEED,
        "fronts": {name: found(make()) for name, make in STUDIES.items()},
    }
    STORED.write_text(json.dumps(stored) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
