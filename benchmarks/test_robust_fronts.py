"""What it costs that designs survive being made: robust fronts against nominal ones, by turns.

In seconds of the processor; the recheck by exact parts is counted.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import pytest

from camkit import DoorHandleCam, Poly345, ValveCam, deg, door_handle_study, mm, nsga2, quick_front
from camkit.machines import corrected_valve_study, door_handle
from camkit.machines.valve_measures import fullness, peak_acceleration
from camkit.search.front import Front
from camkit.study import RobustStudy, Study

Report = Callable[[str, str], None]
MOST = 3.0
"""Times the nominal search."""


def _general(study: Study) -> RobustStudy:
    paths = door_handle.EXPANDED_SPACE
    return study.under({path: 0.5 * deg if "angle" in path else 0.3 * mm for path in paths})


def valve() -> RobustStudy:
    cam = ValveCam(base_radius=24.5 * mm)
    widths = {"max_lift": 0.05 * mm, "base_radius": 0.05 * mm, "half_angle": 0.5 * deg, "seating_velocity": 0.02}
    spring = {f"load.{name}": 0.06 * getattr(cam.load, name) for name in ("spring_rate", "preload")}
    return corrected_valve_study(cam).replace(minimise=(-fullness, peak_acceleration)).under({**widths, **spring})


def three_free() -> RobustStudy:
    return _general(door_handle_study())


def four_free() -> RobustStudy:
    study = door_handle_study()
    return _general(study.replace(free={**study.free, "relief_arm": (67.5 * mm, 90 * mm)}))


def seven_free() -> RobustStudy:
    start = DoorHandleCam(motion_law=Poly345())
    return _general(door_handle_study(start, space=door_handle.EXPANDED_SPACE, reference=DoorHandleCam()))


def _timed(times: list[float], find: Callable[[], Front]) -> Front:
    start = time.process_time()
    front = find()
    times.append(time.process_time() - start)
    return front


@pytest.mark.parametrize("machine", [valve, three_free, four_free, seven_free])
def test_a_robust_front_costs_at_most_three_nominal_ones(
    machine: Callable[[], RobustStudy], benchmark: Any, report: Report
) -> None:
    robust = machine()
    find = quick_front if len(robust.free) <= 4 else lambda study: nsga2(study, 60, 60)
    nominal: list[float] = []
    within: list[float] = []
    for _ in range(5):
        plain = _timed(nominal, lambda: find(robust.nominal))
        front = _timed(within, lambda: find(robust))
    benchmark.pedantic(find, args=(robust,), rounds=1)
    assert front.yields is not None
    ratio = statistics.median(b / a for a, b in zip(nominal, within, strict=True))
    report(f"robust front over nominal front, {machine.__name__.replace('_', ' ')}", f"{ratio:.2f}")
    report("    seconds of the processor", f"{min(within):.2f} and {min(nominal):.2f}")
    report("    designs, least yield", f"{len(front)}, {100 * front.yields.share.min():.1f} %")
    report("    price, share of the hypervolume", f"{100 * front.price(plain).share:.1f} %")
    assert (front.yields.share >= 0.99).all()
    assert ratio <= MOST
