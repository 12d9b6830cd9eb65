"""Searches: what NSGA-II spends on evaluating designs and what on itself, and what evaluating in one call saves.

The parts are measured in seconds of the processor, which neighbours on the machine change less than those of the clock.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

from camkit import door_handle_study, nsga2
from camkit.machines import lift_curve_study
from camkit.search.evolution import StudyProblem
from camkit.study.study import Study

Report = Callable[[str, str], None]


def test_nsga2_100_designs_1000_generations_on_the_lift_curve(
    benchmark: Any, monkeypatch: pytest.MonkeyPatch, report: Report
) -> None:
    evaluating: list[float] = []
    evaluate = StudyProblem._evaluate

    def timed(self: StudyProblem, *args: Any, **kwargs: Any) -> None:
        start = time.process_time()
        evaluate(self, *args, **kwargs)
        evaluating.append(time.process_time() - start)

    monkeypatch.setattr(StudyProblem, "_evaluate", timed)
    study = lift_curve_study()
    clock, start = time.perf_counter(), time.process_time()
    front = benchmark.pedantic(nsga2, args=(study, 100, 1000, 1), rounds=1)
    took, total, own = time.perf_counter() - clock, time.process_time() - start, sum(evaluating)
    assert len(evaluating) == 1000  # one call for each generation
    report("NSGA-II, 100 designs x 1000 generations, lift curve: by the clock", f"{took:.1f} s")
    report("    by the processor", f"{total:.1f} s")
    report("    of which camkit evaluates designs", f"{own:.1f} s ({100 * own / total:.0f} %)")
    report("    of which pymoo's own", f"{total - own:.1f} s ({100 * (1 - own / total):.0f} %)")
    report("    a generation: evaluation, pymoo", f"{own:.2f} ms, {total - own:.2f} ms")
    report("    designs on the front", f"{len(front)}")
    benchmark.extra_info.update(clock_s=took, total_s=total, evaluation_s=own, pymoo_s=total - own)


@pytest.mark.parametrize("whole", [False, True], ids=["lift curve", "whole cam"])
def test_100_designs_in_one_call_against_one_by_one(benchmark: Any, whole: bool, report: Report) -> None:
    study: Study = door_handle_study() if whole else lift_curve_study()
    x = qmc.scale(qmc.Sobol(len(study.free), rng=1).random(128)[:100], *study.bounds)
    together: list[float] = []
    singly: list[float] = []

    def timed(times: list[float], evaluate: Callable[[], Any]) -> Any:
        start = time.process_time()
        result = evaluate()
        times.append(time.process_time() - start)
        return result

    def one_by_one() -> Any:
        return timed(singly, lambda: np.concatenate([study.evaluate(row).f for row in x]))

    def in_one_call() -> Any:
        return timed(together, lambda: study.evaluate(x).f)

    np.testing.assert_allclose(in_one_call(), one_by_one(), rtol=1e-12)
    benchmark.pedantic(in_one_call, setup=lambda: (one_by_one(), None)[1], rounds=20)
    batch, single = statistics.median(together), statistics.median(singly)
    name = "whole cam" if whole else "lift curve"
    report(f"100 designs, {name}: one call (median)", f"{1e3 * batch:.1f} ms")
    report(f"100 designs, {name}: one by one (median)", f"{1e3 * single:.1f} ms")
    report("    ratio", f"{single / batch:.1f}")
    benchmark.extra_info.update(batch_ms=1e3 * batch, single_ms=1e3 * single, ratio=single / batch)
