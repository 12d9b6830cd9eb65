"""The least contact stress of the high-speed cam by four methods: what each finds, in how many designs and seconds.

SLSQP sees the stress either at every angle (epigraph form) or as one number, the largest, which has an edge where
two angles share it.  Differential evolution and a genetic algorithm see the number too.  Ten seeds; both kinds of
SLSQP begin at the same random designs, and differ in nothing else.  Seconds are those of the processor.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize as scipy_minimize

from camkit.machines.high_speed_measures import high_speed_study
from camkit.search.minimax import BAD, STEP, Epigraph
from camkit.search.minimise import CROWD, EXACT, ROUGH, minimise
from camkit.study.study import Evaluation, Study
from camkit.units import mm

Report = Callable[[str, str], None]
SEEDS = range(1, 11)
DESIGNS = 10_000


@dataclass(frozen=True)
class Trial:
    """What one method came to from one seed, and the processor's seconds that it took."""

    f: float
    designs: int
    seconds: float


def start_of(study: Study, seed: int) -> np.ndarray:
    """A random design near the first one: the least stressed of a crowd."""
    low, high = study.bounds
    draw = np.random.default_rng(seed).random((CROWD, len(low)))
    x = study.x0 + (low + draw * (high - low) - study.x0) / 3
    evaluation = study.evaluate(x)
    return x[np.lexsort((evaluation.f[:, 0], np.maximum(evaluation.g, 0).sum(-1)))[0]]


def timed(search: Callable[[], tuple[float, int]]) -> Trial:
    begun = time.process_time()
    f, designs = search()
    return Trial(f, designs, time.process_time() - begun)


def epigraph(study: Study, seed: int) -> Trial:
    begun = study.replace(start=study.design(start_of(study, seed)))

    def search() -> tuple[float, int]:
        best = minimise(begun)
        return (best.f if best.feasible else np.inf), best.evaluations

    return timed(search)


def on_the_maximum(study: Study, seed: int) -> Trial:
    """SLSQP on the largest stress as one number, and each limit as another.

    All else is as in the epigraph form: start, scale, differences and precision; no design is evaluated twice, and
    all neighbours of one are evaluated in one call.  What counts is the best design looked at that keeps all limits.
    """
    (low, high), start = study.bounds, start_of(study, seed)
    size = float(study.evaluate(start).f[0, 0])
    looked: list[Evaluation] = []

    def numbers(u: np.ndarray) -> np.ndarray:
        looked.append(study.evaluate(low + u * (high - low)))
        return np.minimum(np.column_stack([looked[-1].f / size, looked[-1].g]), BAD)

    @lru_cache(1)
    def at(u: bytes) -> np.ndarray:
        return numbers(np.frombuffer(u)[None])[0]

    @lru_cache(1)
    def slopes(u: bytes) -> np.ndarray:
        steps, here = STEP * np.eye(len(low)), np.frombuffer(u)
        up, down = np.clip(here + steps, 0, 1), np.clip(here - steps, 0, 1)
        above, below = np.split(numbers(np.concatenate([up, down])), 2)
        return np.ascontiguousarray((above - below).T / (up - down).sum(-1))

    def search() -> tuple[float, int]:
        scipy_minimize(
            lambda u: at(u.tobytes())[0],
            (start - low) / (high - low),
            jac=lambda u: slopes(u.tobytes())[0],
            bounds=[(0, 1)] * len(low),
            constraints={
                "type": "ineq",
                "fun": lambda u: -at(u.tobytes())[1:],
                "jac": lambda u: -slopes(u.tobytes())[1:],
            },
            method="SLSQP",
            options={"maxiter": 300, "ftol": EXACT},
        )
        kept = [evaluation.f[evaluation.feasible, 0].min(initial=np.inf) for evaluation in looked]
        return float(min(kept)), sum(len(evaluation.x) for evaluation in looked)

    return timed(search)


def without_slopes(method: str) -> Callable[[Study, int], Trial]:
    def trial(study: Study, seed: int) -> Trial:
        def search() -> tuple[float, int]:
            best = minimise(study, method, seed, designs=DESIGNS)
            return (best.f if best.feasible else np.inf), best.evaluations

        return timed(search)

    return trial


METHODS = {
    "SLSQP, epigraph": epigraph,
    "SLSQP on max()": on_the_maximum,
    "scipy DE": without_slopes("de"),
    "pymoo GA": without_slopes("ga"),
}
PROBLEMS = {
    "3 sizes": (high_speed_study(), high_speed_study()),
    "3 sizes, 8 coefficients": (high_speed_study(free_laws=True), high_speed_study(free_laws=True, free_spring=False)),
}
"""Each with the closing spring free, for SLSQP, and as weak as may be, for methods without slopes."""
REACHED = {"3 sizes": 1.70, "3 sizes, 8 coefficients": 1.25}
"""What the best of ten seeds comes below with any method, N^0.5 mm^-0.5."""


def ten_trials(name: str, method: str) -> list[Trial]:
    with_spring, without = PROBLEMS[name]
    return [METHODS[method](with_spring if "SLSQP" in method else without, seed) for seed in SEEDS]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", PROBLEMS)
def test_least_contact_stress(name: str, method: str, benchmark: Any, report: Report) -> None:
    trials = benchmark.pedantic(ten_trials, args=(name, method), rounds=1)
    f = sorted(t.f * mm**0.5 for t in trials)
    designs, seconds = (statistics.median(getattr(t, k) for t in trials) for k in ("designs", "seconds"))
    if method == next(iter(METHODS)):
        report(f"least F_sigma, {name}: best / median / worst of 10 seeds", "designs  seconds (medians)")
    shown = f"{f[0]:.4f} / {statistics.median(f):.4f} / {f[-1]:.4f}"
    report(f"    {method:<18} {shown}", f"{designs:7.0f}  {seconds:6.2f}")
    assert f[0] < REACHED[name]


def test_ten_starts_of_the_eleven_variable_problem(benchmark: Any, report: Report) -> None:
    study = high_speed_study(free_laws=True)
    begun, worked = time.perf_counter(), time.process_time()
    best = benchmark.pedantic(lambda: minimise(study, starts=10), rounds=1)
    passed, worked = time.perf_counter() - begun, time.process_time() - worked
    same = sum(end <= best.f * 1.001 for end in best.ends)
    took = f"{worked:.1f} s of the processor, {passed:.1f} s passed"
    report("ten starts, 3 sizes, 8 coefficients", f"{took}, {best.evaluations} designs, {same} ends the same")
    assert same >= 8
    assert worked < 10


class InTwoCalls(Epigraph):
    """As it was once: a design by itself, then its neighbours."""

    one: tuple[bytes, np.ndarray] = b"", np.empty(0)

    def at(self, u: np.ndarray) -> np.ndarray:
        if self.one[0] != u.tobytes():
            self.one = u.tobytes(), self.columns(u[None])[0]
        return self.one[1]

    def slopes(self, u: np.ndarray) -> np.ndarray:
        self.at(u)
        super().at(u)
        return super().slopes(u)


STARTS = 6
WAYS = {
    "two calls, by numpy": (InTwoCalls, "0"),
    "one call, by numpy": (Epigraph, "0"),
    "one call, native": (Epigraph, "1"),
}


def test_a_start_of_the_twelve_variable_problem(report: Report, monkeypatch: pytest.MonkeyPatch) -> None:
    """By turns, a start each: all come to the same end, to the last bit."""
    study = high_speed_study(free_laws=True)
    answers = Epigraph(study).answers
    if answers.native:
        answers.native.make(answers, study.x0 + np.zeros((64, 1)))
        answers.native.wait()
    took: dict[str, list[float]] = {name: [] for name in WAYS}
    for seed in range(1, STARTS + 1):
        x = np.clip(start_of(study, seed), *study.bounds)
        size = float(study.evaluate(x).f[0, 0])
        ends = list[bytes]()
        for name, (kind, fast) in WAYS.items():
            monkeypatch.setenv("CAMKIT_FAST", fast)
            problem = kind(study, size, 2 * ROUGH)
            begun = time.process_time()
            ends.append(problem.descend(problem.u(x), ROUGH).u.tobytes())
            took[name].append(time.process_time() - begun)
        assert len(set(ends)) == 1
    for name in WAYS:
        report(f"a start, 12 free: {name}", f"{1e3 * statistics.mean(took[name]):5.0f} ms")
