"""Optima of the high-speed cam and of the cam with a lever: writes camkit/data/high_speed_optima.json anew.

    python benchmarks/high_speed_optima.py

Free values of the optimum of each problem of `camkit.papers.high_speed_optima`, and the shortest interval.
"""

from __future__ import annotations

import json
from pathlib import Path

from camkit.papers.high_speed_optima import fast_press_study, solved_studies
from camkit.search.cycle_time import shortest_interval
from camkit.search.minimise import minimise
from camkit.units import cm, deg
from stored import in_rows

CACHE = Path(__file__).parents[1] / "camkit" / "data" / "high_speed_optima.json"


def main() -> None:
    data: dict[str, object] = {
        "about": "free values (SI) of optima of the high-speed cam and of the cam with a lever",
        "rebuild": "python benchmarks/high_speed_optima.py",
    }
    for name, study in solved_studies().items():
        data[name] = minimise(study).x.tolist()
        print(name, flush=True)
    *_, last = shortest_interval(fast_press_study(61 * deg), 7.85 / cm**0.5, 40 * deg, 61 * deg)
    assert last.best is not None
    data["shortest interval"] = {
        "keeps_deg": last.high / deg,
        "keeps_not_deg": last.low / deg,
        "optimum": last.best.x.tolist(),
    }
    CACHE.write_text(in_rows(json.dumps(data, indent=1)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
