"""A sweep says of each value what the study says of it; its picture shades where all limits are kept."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from camkit import DoorHandleCam, deg, lift_curve_study, mm
from camkit.render.sweep import limit_sweep
from camkit.study.sweep import Sweep

STUDY = lift_curve_study(space={"lift_arm": (40 * mm, 60 * mm)})


def test_every_value_is_evaluated_as_it_would_be_alone():
    sweep = Sweep(STUDY, n=9)
    for x, g, kept in zip(sweep.x, sweep.limits.T, sweep.feasible, strict=True):
        alone = STUDY.evaluate([[x]])
        assert g == pytest.approx(alone.g[0], rel=1e-12)
        assert kept == alone.feasible[0]


def test_the_shaded_band_is_where_all_limits_are_kept():
    sweep = Sweep(STUDY)
    ax = Figure().subplots()
    limit_sweep(sweep, ax)
    (band,) = (p for p in ax.patches if p.get_gid() == "feasible")
    inside = band.get_path().contains_points(np.column_stack([sweep.x / mm, np.zeros(sweep.n)]))
    assert 0 < sweep.feasible.sum() < sweep.n
    assert (inside == sweep.feasible)[1:-1].mean() > 0.97  # the band ends between two values


def test_a_view_moves_what_it_drew():
    ax = Figure().subplots()
    limit_sweep(Sweep(STUDY), ax)
    count = len(ax.lines)
    limit_sweep(Sweep(STUDY.replace(start=DoorHandleCam(lift_arm=52 * mm))), ax)
    assert len(ax.lines) == count
    (now,) = (line for line in ax.lines if line.get_gid() == "now")
    assert now.get_xdata()[0] == pytest.approx(52)


def test_two_free_quantities_are_refused():
    study = lift_curve_study(space={"lift_arm": (40 * mm, 60 * mm), "lift_start_angle": (17 * deg, 26 * deg)})
    with pytest.raises(ValueError, match=r"^a sweep shows one free quantity; this study has 2$"):
        Sweep(study)
