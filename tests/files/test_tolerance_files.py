"""Studies under tolerances as files: what is read again is what was written, to the last yield."""

import json
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import Session, Study, TranslatingRollerCam, ValveCam, mm, quick_front, read, shaft_study, write
from camkit.cam.measures import max_pressure_angle
from camkit.files import read_json
from camkit.machines.shaft import twist_utilisation
from camkit.motion import FormError
from camkit.study import Source, Tolerance, en_10210, iso_2768

TUBE = {"outer_diameter": 0.5 * mm, "inner_diameter": Tolerance((-0.1 * mm, 0.3 * mm), "normal")}
UNDER = {
    "half widths": {"tolerances": TUBE, "correlation": {("inner_diameter", "outer_diameter"): 0.3}},
    "worst case": {"tolerances": TUBE, "worst_case": True, "objective": "95 %"},
    "standards": {"tolerances": {"outer_diameter": iso_2768, "length": partial(iso_2768, grade="f")}},
    "sources": {"tolerances": en_10210("outer_diameter", "inner_diameter") | {"power": 100.0}, "yield_at_least": 0.95},
    "a source of one's own": {"tolerances": {Source("wall", {"inner_diameter": -2, "length": 0.1}): (-1e-4, 2e-4)}},
}


@pytest.mark.parametrize("options", UNDER.values(), ids=UNDER)
def test_what_is_read_again_is_what_was_written(options, tmp_path):
    study = shaft_study().under(**options)
    write(Session(study, study.start), tmp_path / "tube.json")
    again = read(tmp_path / "tube.json").study
    x = np.array([[129.3, 103], [130.5, 103]]) * mm
    assert again == study.replace(tolerances=again.tolerances)
    assert again.names == study.names
    assert_array_equal(again.evaluate(x).g, study.evaluate(x).g)
    assert_array_equal(again.recheck(x).missed, study.recheck(x).missed)


def test_a_robust_front_is_read_with_its_yields(tmp_path):
    study = shaft_study().replace(minimise=(*shaft_study().minimise, twist_utilisation)).under(TUBE)
    front = quick_front(study, 20)
    write(front, tmp_path / "front.json")
    again = read(tmp_path / "front.json")
    assert_allclose(again.f, front.f, rtol=1e-12)
    assert_array_equal(again.yields.missed, front.yields.missed)


def test_a_form_error_and_its_tolerances(tmp_path):
    cam = TranslatingRollerCam()
    cam = cam.replace(motion=FormError(0.0, 0.01 * mm, 0.3, 12).on(cam.motion))
    write(cam, tmp_path / "cam.json")
    assert read(tmp_path / "cam.json") == cam
    study = Study(cam, ["base_radius"], (max_pressure_angle,)).under({"motion.form.amplitude": (0, 0.01 * mm)})
    write(Session(study, cam), tmp_path / "study.json")
    again = read(tmp_path / "study.json").study
    assert again.start == cam
    assert_array_equal(again.recheck(again.x0).share, 1)


def test_a_machine_whose_motion_is_its_own_takes_no_form_error():
    with pytest.raises(ValueError, match=r"rides on a motion program; a valve cam is none, and a machine whose motion"):
        FormError(amplitude=0.01 * mm).on(ValveCam())


def test_a_function_of_ones_own_is_in_no_file(tmp_path):
    study = shaft_study().under({"outer_diameter": lambda D: 0.01 * D})
    with pytest.raises(ValueError, match="the tolerance of the outer diameter is a function of one's own"):
        write(Session(study, study.start), tmp_path / "tube.json")


def damaged(change, tmp_path):
    study = shaft_study().under(TUBE, correlation={("inner_diameter", "outer_diameter"): 0.3})
    write(Session(study, study.start), tmp_path / "tube.json")
    entry = json.loads((tmp_path / "tube.json").read_text())
    change(
        next(part for part in (entry, *entry.values()) if isinstance(part, dict) and "tolerances" in part)["tolerances"]
    )
    return json.dumps(entry)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.pop("objective"), "its tolerances are not as camkit writes them"),
        (lambda t: t.update(yield_at_least="most"), "its tolerances are not as camkit writes them"),
        (lambda t: t.update(yield_at_least=0.3), "the yield is 0.3; it must lie above 0.5"),
        (lambda t: t.update(objective="median"), "the objective is 'median'"),
        (lambda t: t["deviations"][0].update(of="bore [mm]"), "a tolerance of 'bore .mm.', which a universal joint"),
        (lambda t: t["deviations"][0].update(deviation="wide"), "'wide' for 'deviation', where 2 numbers belong"),
        (lambda t: t["deviations"][0].update(deviation={"standard": "DIN 1"}), "there are ISO 2768, ISO 286"),
        (lambda t: t["deviations"][0].update(spread="wide"), "the spread is 'wide'"),
        (lambda t: t["deviations"].append(7), "where names and values belong"),
        (lambda t: t["deviations"][0].update(of={"name": "wall"}), "where what moves several quantities belongs"),
        (lambda t: t.update(correlation=[[0, 2, 0.5]]), "the place of a tolerance is 2"),
        (lambda t: t.update(correlation=[[0, 1]]), "where two places and a number belong"),
    ],
)
def test_what_is_damaged_is_refused_in_a_sentence(change, said, tmp_path):
    with pytest.raises(ValueError, match=said):
        read_json(damaged(change, tmp_path))
