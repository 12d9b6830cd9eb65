"""Fronts where one design in two hundred keeps its limits: a pusher that must not jump off its cam."""

import pytest

from camkit import (
    Cycloidal,
    Dwell,
    MotionProgram,
    MPa,
    N,
    Return,
    Rise,
    Study,
    TranslatingRollerCam,
    deg,
    minimise,
    mm,
    quick_front,
    rpm,
    with_quantities,
)
from camkit.cam import base_radius, jump_margin, max_pressure_angle, mean_torque, min_force, peak_pressure


def pusher():
    motion = MotionProgram(
        (
            Rise(110 * deg, 40 * mm, Cycloidal()),
            Dwell(20 * deg),
            Return(100 * deg, 40 * mm, Cycloidal()),
            Dwell(130 * deg),
        )
    )
    cam = TranslatingRollerCam(motion, 45 * mm, 12 * mm, groove=False)
    given = {"load.mass": 2.0, "load.speed": 150 * rpm, "load.preload": 60 * N, "contact": "along a line"}
    return with_quantities(cam, given)


FREE = {
    "base_radius": (20 * mm, 70 * mm),
    "offset": (-15 * mm, 15 * mm),
    "load.spring_rate": (0.2 * N / mm, 6 * N / mm),
    "load.preload": (10 * N, 200 * N),
}


@pytest.mark.parametrize("margin", [0.2, 0.3])
def test_the_whole_front_is_found_and_not_one_design(margin):
    """Against the least torque by descent, the size held: at the small end, and in the middle."""
    limits = {max_pressure_angle: 35 * deg, peak_pressure: 150 * MPa}
    kept = {min_force: 15 * N, jump_margin: margin}
    study = Study(pusher(), FREE, (base_radius, mean_torque), limits, kept)
    front = quick_front(study)
    assert len(front) == 100
    assert front.f[:, 0].min() < 45.2 * mm
    for size in (47 * mm, 52 * mm):
        held = study.replace(minimise=(mean_torque,), at_most={**limits, base_radius: size})
        least = minimise(held, starts=3).f
        assert front.f[front.f[:, 0] <= size, 1].min() < 1.01 * least
