"""The quick front on the door handle's lift cam: how long it takes, cold and after a slider, and what it reaches.

`benchmarks/live_front_searches.py` measures the chart of notebook 15, hypervolume against time, for three libraries.
Times are those of the processor, which neighbours on the machine change less than those of the clock.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from itertools import takewhile
from typing import Any

import numpy as np
import pytest
from live_front_searches import PROBLEMS, pygmo_nsga2

from camkit import DoorHandleCam, door_handle_study, mm
from camkit.archive import quick_front
from camkit.optimise import front_of, reference_point
from camkit.reference import load

Report = Callable[[str, str], None]
CACHED = load("live_front_searches")["problems"]
ROUNDS = 15


@pytest.mark.parametrize("name", PROBLEMS)
def test_it_reaches_nsga2_with_100_designs_and_1000_generations(benchmark: Any, name: str, report: Report) -> None:
    study, cached = PROBLEMS[name](), CACHED[name]
    front = quick_front(study)
    seconds, volume = cached["searches"]["NSGA-II (pymoo)"][-1]
    np.testing.assert_allclose(reference_point(study), cached["reference"], rtol=1e-9)
    reached = front.hypervolume(cached["reference"])
    assert len(front) <= 100
    assert study.evaluate(front.x).feasible.all()
    assert reached >= volume
    times: list[float] = []
    benchmark.pedantic(lambda: _timed(times, lambda: quick_front(study)), rounds=ROUNDS)
    report(f"quick front, {name}: median, least", f"{_ms(statistics.median(times))}, {_ms(min(times))}")
    report("    hypervolume, share of a front of 1000", f"{reached / cached['best']:.5f}")
    report(f"    NSGA-II, 100 x 1000 (cached, {seconds:.1f} s)", f"{volume / cached['best']:.5f}")
    benchmark.extra_info.update(median_s=statistics.median(times), hypervolume=reached, nsga2=volume)


def test_it_follows_a_slider(benchmark: Any, report: Report) -> None:
    """Twenty steps of the centre distance, each from the front before it, against the same from nothing."""
    paper, times = DoorHandleCam(), []
    front, shares = quick_front(door_handle_study(paper)), []
    for distance in np.linspace(74.5, 84, 20) * mm:
        study = door_handle_study(paper.replace(lift_centre_distance=distance), reference=paper)
        front = _timed(times, lambda study=study, front=front: quick_front(study, start=front))
        reference = reference_point(study)
        shares.append(front.hypervolume(reference) / quick_front(study).hypervolume(reference))
    assert min(shares) > 0.995
    benchmark.pedantic(lambda: quick_front(study, start=front), rounds=ROUNDS)
    report("quick front after a slider's step: median", _ms(statistics.median(times)))
    report("    hypervolume, share of the front from nothing: least, median",
           f"{min(shares):.4f}, {statistics.median(shares):.4f}")  # fmt: skip


def test_against_nsga2_of_pygmo(benchmark: Any, report: Report) -> None:
    """For as long as the quick front takes; the comparison needs pygmo, which camkit does not."""
    pytest.importorskip("pygmo")
    study = door_handle_study()
    reference, times = reference_point(study), []
    front = benchmark.pedantic(lambda: _timed(times, lambda: quick_front(study)), rounds=ROUNDS)
    end = time.process_time() + statistics.median(times)
    steps = list(takewhile(lambda _: time.process_time() < end, pygmo_nsga2(study)))
    other = front_of(study.evaluate(steps[-1].x), study).hypervolume(reference)
    best = CACHED["three free quantities"]["best"]
    report(f"pygmo's NSGA-II in the same time ({len(steps)} generations): share", f"{other / best:.5f}")
    report("    the quick front", f"{front.hypervolume(reference) / best:.5f}")


def _timed(times: list[float], search: Callable[[], Any]) -> Any:
    start = time.process_time()
    found = search()
    times.append(time.process_time() - start)
    return found


def _ms(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms"
