"""Studies by native code beside numpy, in turns: populations, the first use, a million designs, fronts, yields."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest

from camkit import door_handle_study, mm, quick_front
from camkit.machines import high_speed_study, lift_curve_study
from camkit.study import native
from camkit.study.study import Study

Report = Callable[[str, str], None]
STUDIES = {"lift curve": lift_curve_study, "whole cam": door_handle_study, "high speed": high_speed_study}
ROUNDS = 7


def rows(study: Study, p: int) -> np.ndarray:
    return np.random.default_rng(1).uniform(*study.bounds, (p, len(study.free)))


def ready(study: Study, paths: tuple[str, ...], x: np.ndarray) -> None:
    """Have the code of a study made, and wait for it."""
    answers = native.Answers(study, paths)
    found = answers.native
    assert found
    found.make(answers, x)
    found.wait()
    assert not found.refused


def spent(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def by_numpy(work: Callable[[], object]) -> None:
    with patch.object(native.Answers, "__call__", native.Answers.by_numpy):
        work()


def in_turns(work: Callable[[], object]) -> tuple[float, float, float]:
    """Seconds of the processor by numpy and by native code, and the median of their ratio in turns."""
    work()
    pairs = np.array([(spent(lambda: by_numpy(work)), spent(work)) for _ in range(ROUNDS)])
    return (*pairs.min(0), float(np.median(pairs[:, 0] / pairs[:, 1])))


@pytest.mark.parametrize("name", STUDIES)
def test_a_design_of_a_population(name: str, benchmark: Any, report: Report) -> None:
    study = STUDIES[name]()
    x = rows(study, 256)
    ready(study, tuple(study.free), x)
    numpy, code, ratio = in_turns(lambda: study.evaluate(x))
    benchmark.pedantic(study.evaluate, args=(x,), rounds=5)
    report(f"{name}, {study.angles} angles, a design of 256: numpy, native code, ratio",
           f"{numpy / 256e-6:.1f} us, {code / 256e-6:.1f} us, {ratio:.1f}")  # fmt: skip


@pytest.mark.parametrize("name", STUDIES)
def test_the_first_use(
    name: str, tmp_path: Any, monkeypatch: pytest.MonkeyPatch, benchmark: Any, report: Report
) -> None:
    monkeypatch.setenv("CAMKIT_CACHE", str(tmp_path))
    study = STUDIES[name]()
    first = spent(lambda: native.made(study, tuple(study.free)))
    again = min(spent(lambda: native.made(study, tuple(study.free))) for _ in range(3))
    benchmark.pedantic(native.made, args=(study, tuple(study.free)), rounds=2)
    report(f"{name}: recorded and made, recorded and read from the cache", f"{first:.2f} s, {again:.2f} s")


def test_a_million_designs(benchmark: Any, report: Report) -> None:
    study = lift_curve_study()
    x = rows(study, 1_000_000)
    ready(study, tuple(study.free), x)
    clock, start = time.perf_counter(), time.process_time()
    benchmark.pedantic(study.evaluate, args=(x,), rounds=1)
    took, worked = time.perf_counter() - clock, time.process_time() - start
    report(
        "a million lift curves x 361 angles, all processors: by the clock, by the processor",
        f"{took:.1f}, {worked:.1f} s",
    )


def test_a_front(benchmark: Any, report: Report) -> None:
    study = lift_curve_study()
    for each in (study, study.roughly):
        ready(each, tuple(study.free), rows(study, 64))
    numpy, code, ratio = in_turns(lambda: quick_front(study))
    front = benchmark.pedantic(quick_front, args=(study,), rounds=3)
    near = in_turns(lambda: quick_front(study, start=front))
    report("front of the lift curve: numpy, native code, ratio", f"{1e3 * numpy:.0f}, {1e3 * code:.0f} ms, {ratio:.1f}")
    report("    from a near front", f"{1e3 * near[0]:.0f}, {1e3 * near[1]:.0f} ms, {near[2]:.1f}")


def test_a_yield(benchmark: Any, report: Report) -> None:
    study = lift_curve_study().under({"lift_arm": 0.05 * mm, "roller_radius": 0.02 * mm})
    parts = study.made(study.x0[None], study.shares(1024))[0]
    ready(study, tuple(study._parts.declared), parts)
    numpy, code, ratio = in_turns(lambda: study.judged(parts))
    benchmark.pedantic(study.judged, args=(parts,), rounds=5)
    report(
        "1024 parts of a lift curve: numpy, native code, ratio", f"{1e3 * numpy:.0f}, {1e3 * code:.1f} ms, {ratio:.1f}"
    )
