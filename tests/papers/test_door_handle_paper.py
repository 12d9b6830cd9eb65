"""The door-handle paper's tables and its search: what is reproduced, why, and its stored fronts against the package."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import DoorHandleCam, Tolerances, deg, mm, quick_front
from camkit.data import load
from camkit.machines import door_handle_paper_study, lift_curve_study
from camkit.panels.tolerances import general_tolerances
from camkit.papers import door_handle as paper
from camkit.search.front import Front, reference_point

STORED = load("door_handle_fronts")
STUDIES = {"whole cam": door_handle_paper_study, "lift curve": lift_curve_study}


def row(comparison, name):
    return next(r for r in comparison.rows if r.name == name)


def test_the_printed_relief_base_radius_follows_from_a_start_angle_rounded_to_25_deg():
    """The law of cosines on Table 1's 100 and 75 mm; 24.88 deg follow from the lift curve's 33.59 mm."""
    exact = row(paper.table_1(), "relief base radius from the dimensions")
    whole = row(paper.table_1(), "relief base radius from psi_0' = 25 deg")
    assert exact.computed == pytest.approx(44.915, abs=0.001)
    assert whole.computed == pytest.approx(np.hypot(100 - 75 * np.cos(25 * deg), 75 * np.sin(25 * deg)), rel=1e-12)
    assert whole.verdict == "reproduced but for the last digit"
    assert "24.88 deg" in exact.remark
    assert round(float(DoorHandleCam().relief.start_angle) / deg) == 25


def test_the_printed_relief_angle_is_met_with_the_base_radius_of_the_start():
    kept, chosen = (row(paper.table_4("relief"), name)
                    for name in ("the same, base radius kept", "maximum pressure angle, after"))  # fmt: skip
    assert abs(kept.computed / 0.734 - 1) < 0.0025
    assert abs(chosen.computed / 0.734 - 1) > 0.02
    cam = DoorHandleCam(relief_arm=74.49 * mm)
    assert cam.base_radius == pytest.approx(33.59 * mm, abs=0.005 * mm)
    relief = cam.analyse(7201).relief
    assert kept.computed == pytest.approx(abs(relief.pressure_angle).max(), rel=1e-6)


@pytest.fixture(params=STUDIES)
def stored(request):
    front = STORED["fronts"][request.param]
    return Front(STUDIES[request.param](), np.array(front["x"]), np.array(front["f"]))


def test_a_stored_front_is_what_the_study_says_of_its_designs(stored):
    told = stored.study.evaluate(stored.x)
    assert told.feasible.all()
    assert_allclose(told.f, stored.f, rtol=1e-9)
    assert len(stored) == STORED["population"] == 100
    assert STORED["generations"] == 1000
    beaten = [((f <= g).all() and (f < g).any()) for f in stored.f for g in stored.f]
    assert not any(beaten)


def test_a_stored_front_is_no_worse_than_a_quick_one(stored):
    reference = reference_point(stored.study)
    assert stored.hypervolume(reference) > 0.999 * quick_front(stored.study).hypervolume(reference)


def test_the_stored_front_of_the_whole_cam_is_an_edge_of_the_papers_box():
    front = STORED["fronts"]["whole cam"]
    assert front["free"] == ["lift_arm", "lift_start_angle", "relief_arm"]
    arm, start, relief = np.transpose(front["x"])
    assert_allclose(arm, 45 * mm, rtol=1e-3)
    assert_allclose(start, 0.46, rtol=1e-3)
    assert_allclose([relief.min(), relief.max()], [79.0 * mm, 80.6 * mm], atol=0.05 * mm)
    assert_allclose(np.array(front["f"])[[0, -1], 0], [1.029, 1.069], atol=0.0005)


@pytest.mark.parametrize("end", [0, -1])
def test_half_of_the_cams_at_an_end_of_the_edge_miss_a_limit(end):
    study = door_handle_paper_study()
    arm, start, relief = STORED["fronts"]["whole cam"]["x"][end]
    drawn = study.replace(start=study.start.replace(lift_arm=arm, lift_start_angle=start, relief_arm=relief))
    assert Tolerances(drawn, general_tolerances(drawn), parts=4096).share == pytest.approx(0.5, abs=0.03)


def test_the_papers_choice_is_beaten_in_both_wishes():
    choice = lift_curve_study().evaluate([48.09 * mm, 0.34]).f[0]
    assert_allclose(choice, [0.945, -44.46 * mm], rtol=1e-3)
    assert (np.array(STORED["fronts"]["lift curve"]["f"]) < choice).all(axis=1).mean() > 0.3


def test_the_text_halves_what_the_table_prints():
    table, text = (np.asarray(row[1:], dtype=float) for row in paper.printed_torques().rows)
    assert abs(table / text - 2).max() < 1e-3
