"""The plane of two free quantities: its grid against single designs, its optimum against brute force."""

import numpy as np
import pytest

from camkit import DoorHandleCam, Study, deg, door_handle_study, kW, mm
from camkit.cam.measures import max_pressure_angle
from camkit.machines.shaft import PLANE_WINDOW, UniversalJointShaft, lightest_shaft, shaft_study
from camkit.study.design_map import DesignMap
from known_problems import speed_reducer


def plane(n: int = 41, **data: float) -> DesignMap:
    return DesignMap(shaft_study(UniversalJointShaft(**data)), PLANE_WINDOW, n)


def test_the_grid_is_that_of_single_designs() -> None:
    whole, rng = plane(), np.random.default_rng(1)
    for i, j in rng.integers(0, 41, (40, 2)):
        D, d = whole.axes[0, i], whole.axes[1, j]
        if d >= D:
            assert np.isnan(whole.objective[j, i])
            continue
        alone = whole.study.evaluate([[D, d]])
        assert whole.objective[j, i] == pytest.approx(alone.f[0, 0], rel=1e-13)
        assert whole.limits[:, j, i] == pytest.approx(alone.g[0], rel=1e-12)


def test_what_cannot_be_built_is_nan() -> None:
    whole = plane()
    D, d = np.meshgrid(*whole.axes)
    assert (np.isnan(whole.objective) == (d >= D)).all()
    assert np.isnan(whole.limits[:, d >= D]).any()


def test_the_worst_limit_says_what_is_feasible() -> None:
    for data in ({}, {"length": 3.4}, {"power": 20 * kW}):
        whole = plane(**data)
        assert ((whole.worst <= 0).ravel() == whole.evaluation.feasible).all()


def test_the_best_design_is_the_closed_form() -> None:
    best = lightest_shaft()
    assert plane().best == pytest.approx((best.outer_diameter, best.inner_diameter), rel=1e-8)
    assert plane().best_design.analyse().area == pytest.approx(best.analyse().area, rel=1e-8)


@pytest.mark.parametrize(
    "data",
    [
        {"allowable_twist": 2 * deg},  # the shear stress governs
        {"length": 3.3, "power": 150 * kW},  # the critical speed cuts a corner off
        {"power": 20 * kW},  # both bounds
        {"length": 3.4, "power": 30 * kW},  # the critical speed governs
        {"power": 420 * kW},  # a narrow rest
    ],
)
def test_the_best_design_by_brute_force(data) -> None:
    study = shaft_study(UniversalJointShaft(**data))
    best = DesignMap(study).best
    found = study.evaluate(best)
    assert (found.g <= 1e-9).all()
    D, d = np.meshgrid(*np.linspace(*study.bounds, 301, axis=1))
    fine = study.evaluate(np.stack([D, d], axis=-1).reshape(-1, 2))
    lightest = fine.f[fine.feasible, 0].min()
    assert lightest * (1 - 1e-2) < found.f[0, 0] <= lightest * (1 + 1e-9)


def test_nothing_that_keeps_every_limit() -> None:
    hopeless = plane(power=600 * kW)
    assert np.isnan(hopeless.best).all()
    assert hopeless.best_on_grid is None
    with pytest.raises(ValueError, match=r"^no design within the bounds keeps every limit$"):
        _ = hopeless.best_design


def test_the_window_may_reach_beyond_the_bounds_but_the_best_design_does_not() -> None:
    beyond = plane()
    low, high = beyond.study.bounds
    assert (beyond.axes[:, 0] < low).all()
    assert (beyond.axes[:, -1] > high).all()
    assert ((low <= beyond.best) & (beyond.best <= high)).all()
    assert (DesignMap(beyond.study).axes[:, [0, -1]] == np.transpose(beyond.study.bounds)).all()


def test_it_knows_no_mechanism() -> None:
    """The lift arm and start angle of the door-handle cam with the least of its maximum pressure angles."""
    free = {"lift_arm": (40 * mm, 55 * mm), "lift_start_angle": (15 * deg, 30 * deg)}
    least = Study(
        DoorHandleCam().lift,
        {"arm_length": free["lift_arm"], "start_angle": free["lift_start_angle"]},
        (max_pressure_angle,),
    )
    view = DesignMap(least.replace(angles=91), n=21)
    assert [q.symbol for q in view.declared] == ["l", "psi_0"]
    assert least.evaluate(view.best).f[0, 0] <= np.nanmin(view.objective) * (1 + 1e-6)
    assert view.limits.shape == (0, 21, 21)


def test_refuses_what_is_no_plane() -> None:
    with pytest.raises(ValueError, match=r"^a plane shows two free quantities; this study has 7$"):
        DesignMap(speed_reducer.study)
    with pytest.raises(ValueError, match=r"^a plane shows one objective; this study has 2$"):
        DesignMap(door_handle_study(space={"lift_arm": (40 * mm, 50 * mm), "lift_start_angle": (15 * deg, 30 * deg)}))
