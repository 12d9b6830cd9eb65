"""A sweep says of each value what the study says of it; its picture shades where all limits are kept."""

import numpy as np
import pytest
from matplotlib.path import Path
from numpy.testing import assert_array_equal

from camkit import DoorHandleCam, Study, deg, mm
from camkit.machines import CamLever, lift_curve_study
from camkit.machines.cam_lever import reach
from camkit.study.sweep import Sweep
from camkit.views.sweep import limit_sweep, sweep_view

STUDY = lift_curve_study(space={"lift_arm": (40 * mm, 60 * mm)})


def test_every_value_is_evaluated_as_it_would_be_alone():
    sweep = Sweep(STUDY, n=9)
    for x, g, kept in zip(sweep.x, sweep.limits.T, sweep.feasible, strict=True):
        alone = STUDY.evaluate([[x]])
        assert g == pytest.approx(alone.g[0], rel=1e-12)
        assert kept == alone.feasible[0]


def test_the_shaded_band_is_where_all_limits_are_kept():
    sweep = Sweep(STUDY)
    band = limit_sweep(sweep)["feasible"]
    inside = Path(np.transpose([band.x, band.y])).contains_points(np.column_stack([sweep.x / mm, np.zeros(sweep.n)]))
    assert 0 < sweep.feasible.sum() < sweep.n
    assert (inside == sweep.feasible)[1:-1].mean() > 0.97  # the band ends between two values


def test_the_design_in_hand_stands_where_it_is():
    shown = limit_sweep(Sweep(STUDY.replace(start=DoorHandleCam(lift_arm=52 * mm))))
    assert shown["now"].x == pytest.approx([52, 52])


def test_two_free_quantities_are_refused():
    study = lift_curve_study(space={"lift_arm": (40 * mm, 60 * mm), "lift_start_angle": (17 * deg, 26 * deg)})
    with pytest.raises(ValueError, match=r"^a sweep shows one free quantity; this study has 2$"):
        Sweep(study)


def test_a_live_view_sweeps_around_the_design_that_is_shown():
    view, moved = sweep_view(STUDY), DoorHandleCam(lift_arm=52 * mm, roller_radius=9 * mm)
    shown = view(moved.analyse())
    known = limit_sweep(Sweep(STUDY.replace(start=moved)))
    for key in ("limit 1", "feasible", "now"):
        assert_array_equal([shown[key].x, shown[key].y], [known[key].x, known[key].y])
    with pytest.raises(ValueError, match="the sweep is of a DoorHandleCam; the analysis is of another design"):
        view(CamLever().analyse())
    lever = Study(CamLever(), ["lever"], (reach,), at_most={reach: 0.4})  # its analysis holds a cam as well
    assert sweep_view(lever)(CamLever(lever=0.22).analyse())["now"].x == [220, 220]
