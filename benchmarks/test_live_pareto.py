"""The quick front on the door handle's cam: how long it takes, cold and after a slider, and what it reaches.

`benchmarks/live_front_searches.py` measures the chart of notebook 15, hypervolume against designs evaluated.
Times are those of the processor, which neighbours on the machine change less than those of the clock.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from camkit import DoorHandleCam, door_handle_study, mm
from camkit.data import load
from camkit.search.epsilon_constraint import trade_off
from camkit.search.fast_front import Archive, _thinned, quick_front
from camkit.search.front import Front, front_of, reference_point
from camkit.study.study import Study

Report = Callable[[str, str], None]
STORED = load("live_front_searches")
ROUNDS = 15


GRID, DESIGNS, POINTS = 13, 7000, 100
"""Designs along a side of the first grid; designs in all, as many as `quick_front` looks at; limits, one by one."""


def refined_sweep(study: Study) -> Front:
    """A grid over the box, then half its steps around every design that none beats, and half of those again."""
    low, high = study.bounds
    u = np.stack(np.meshgrid(*[np.linspace(0, 1, GRID)] * len(low)), axis=-1).reshape(-1, len(low))
    around = np.stack(np.meshgrid(*[[-1, 0, 1]] * len(low)), axis=-1).reshape(-1, len(low)) / (GRID - 1)
    front, looked, near = front_of(study.evaluate(low + u * (high - low)), study), len(u), around
    while looked < DESIGNS:
        near = near / 2
        shares = ((front.x - low) / (high - low))[:, None] + near
        u = np.unique(np.clip(shares.reshape(-1, len(low)), 0, 1), axis=0)[: DESIGNS - looked]
        front = front_of(study.evaluate(np.vstack([front.x, low + u * (high - low)])), study)
        looked += len(u)
    kept = _thinned(Archive(front.x, front.f, np.zeros(len(front))), 100)
    return Front(study, kept.u, kept.f)


def epsilon_constraint(study: Study) -> Front:
    """The less effort under ever tighter limits on the radius."""
    return front_of(study.evaluate(np.array([best.x for best in trade_off(study, POINTS)])), study)


@pytest.mark.parametrize("search", [refined_sweep, epsilon_constraint])
def test_a_sweep_reaches_less_and_limits_on_one_objective_take_longer(
    search: Callable[[Study], Front], report: Report
) -> None:
    study, times = door_handle_study(), []
    quick, front = (_timed(times, lambda find=find: find(study)) for find in (quick_front, search))
    share, reached = (one.hypervolume(STORED["reference"]) / STORED["best"] for one in (front, quick))
    told = f"{times[1]:.2f} s, {share:.5f}, {len(front)}"
    report(f"{search.__name__}: processor time, share of the hypervolume, designs on the front", told)
    report(f"    quick_front, which looks at {quick.record['designs']} designs", f"{times[0]:.2f} s, {reached:.5f}")
    assert times[1] > 2 * times[0]
    assert share < reached or times[1] > 10 * times[0]


def test_it_reaches_nsga2_with_100_designs_and_1000_generations(benchmark: Any, report: Report) -> None:
    study = door_handle_study()
    front = quick_front(study)
    volume = STORED["searches"]["NSGA-II (pymoo)"]["hypervolume"][-1]
    np.testing.assert_allclose(reference_point(study), STORED["reference"], rtol=1e-9)
    reached = front.hypervolume(STORED["reference"])
    assert len(front) <= 100
    assert study.evaluate(front.x).feasible.all()
    assert reached >= volume
    times: list[float] = []
    benchmark.pedantic(lambda: _timed(times, lambda: quick_front(study)), rounds=ROUNDS)
    report("quick front: median, least", f"{_ms(statistics.median(times))}, {_ms(min(times))}")
    report("    hypervolume, share of a front of 1000", f"{reached / STORED['best']:.5f}")
    report("    NSGA-II, 100 x 1000 (cached)", f"{volume / STORED['best']:.5f}")
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


def _timed(times: list[float], search: Callable[[], Any]) -> Any:
    start = time.process_time()
    found = search()
    times.append(time.process_time() - start)
    return found


def _ms(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms"
