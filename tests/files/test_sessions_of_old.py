"""Sessions that earlier versions wrote are read today, and what is computed of them is what they computed."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, TranslatingRollerCam
from camkit.files import Session, read_json, renamed, to_json
from camkit.files.entries import kinds
from camkit.files.json_file import UNMARKED
from camkit.files.renamed import RENAMED, Renaming
from camkit.quantities import Design, value_of

DATA = Path(__file__).parents[1] / "data"
EXPECTED = {
    (folder, name): expected
    for folder in ("sessions_0.1.0", "sessions_before")
    for name, expected in json.loads((DATA / folder / "expected.json").read_text()).items()
}
FINE = 20_001
"""Positions at which 0.1.0 computed its numbers: its maxima were those of the positions."""
OTHERWISE = ("mean efficiency", "work out / work in")
"""What is computed in another way since: friction acts at the contacts of all bodies at once."""


def text(folder, name):
    return (DATA / folder / f"{name}.json").read_text()


def measured(design):
    analysis = design.analyse(FINE)
    return {f"{m.name} [{m.unit}]": float(m(analysis)) for m in type(design).measures}


def test_there_are_five_of_0_1_0_different_in_kind():
    found = [read_json(text(*file)).thing for file in EXPECTED if file[0] == "sessions_0.1.0"]
    assert {type(thing.study.start if isinstance(thing, Session) else thing).__name__ for thing in found} == {
        "DoorHandleCam", "HighSpeedCam", "ValveCam", "CabinDoorLinkage", "TranslatingRollerCam",
    }  # fmt: skip


@pytest.mark.parametrize("file", EXPECTED, ids="/".join)
def test_a_session_of_old_is_read_with_its_numbers(file):
    expected, found = EXPECTED[file], read_json(text(*file))
    assert (UNMARKED in found.remarks) is (file[0] == "sessions_0.1.0")
    thing, renaming = found.thing, Renaming(kinds())
    if isinstance(thing, Session):
        assert_allclose(thing.study.bounds, expected["bounds"], rtol=1e-14)  # 0.1.0 wrote fifteen digits
        at = [int(np.argmin(abs(np.array(expected["x"]) - x).max(1))) for x in thing.front.x]
        assert_allclose(thing.front.x, np.array(expected["x"])[at], rtol=1e-13)
        study = replace(thing.study, angles=FINE) if file[0] == "sessions_0.1.0" else thing.study
        assert_allclose(study.evaluate(thing.front.x).f, np.array(expected["f"])[at], rtol=1e-6)
        for name, weights in expected["weights"].items():
            assert_allclose(thing.judgements[name].weights, weights, rtol=1e-9)
    design = thing if isinstance(thing, Design) else thing.design
    now = measured(design)
    for name, value in expected["measures"].items():
        if not name.startswith(OTHERWISE):
            near = 1e-4 if name.startswith("mean") else 5e-6  # a mean over jumps of friction, by trapezoids of 0.1.0
            assert_allclose(now[renaming.name("measure", name)], value, rtol=near, atol=1e-11, err_msg=name)


@pytest.mark.parametrize("file", EXPECTED, ids="/".join)
def test_a_session_of_old_is_written_and_read_again(file):
    thing = read_json(text(*file)).thing
    again = read_json(to_json(thing))
    assert again.remarks == ()
    assert to_json(again.thing) == to_json(thing)


def aged(monkeypatch, name, where, before, now):
    """A file as it was written when ``now`` was still called ``before``."""
    monkeypatch.setitem(RENAMED, (where, before), now)
    assert now in text("sessions_0.1.0", name)
    return text("sessions_0.1.0", name).replace(now, before)


@pytest.mark.parametrize(
    ("name", "where", "before", "now"),
    [
        ("high_speed_shaped_laws", "HighSpeedCam", "largest_radius", "max_radius"),
        ("high_speed_shaped_laws", "kind", "FastCam", "HighSpeedCam"),
        ("high_speed_shaped_laws", "measure", "stress of contact", "contact stress F_sigma"),
        ("cabin_door_linkage", "measure", "steepest angle", "steepest pressure angle"),
        ("valve", "measure", "peak acceleration upwards", "peak positive acceleration"),
        ("valve", "measure", "roundness", "fullness"),
        ("valve", "rule", "elbow", "knee"),
        ("sliding_roller_program", "SlideLoad", "spring", "spring_rate"),
        ("sliding_roller_program", "kind", "LawOfRows", "TableLaw"),
    ],
)
def test_what_is_renamed_is_found_by_the_table_with_a_remark(monkeypatch, name, where, before, now):
    monkeypatch.setattr(renamed, "MANY", 99)  # every name is remarked on
    plain = read_json(text("sessions_0.1.0", name))
    found = read_json(aged(monkeypatch, name, where, before, now))
    assert to_json(found.thing) == to_json(plain.thing)
    new = {each for remark in found.remarks for each in remark.split(", ")}
    assert new - {each for remark in plain.remarks for each in remark.split(", ")} == {
        f"{before} is now {now}".replace("_", " ")
    }


def test_without_a_row_an_old_name_is_refused_by_name():
    old = text("sessions_0.1.0", "high_speed_shaped_laws").replace("max_radius", "largest_radius")
    with pytest.raises(ValueError, match=r"'largest_radius \[mm\]', which a high speed cam does not have"):
        read_json(old)


def test_what_was_a_field_of_its_own_is_put_where_it_stands_today(monkeypatch):
    content = json.loads(to_json(TranslatingRollerCam()))
    content["design"] |= {"closing_law": "cycloidal", "spring [N/mm]": 7.5}
    del content["design"]["load"]
    monkeypatch.setitem(RENAMED, ("TranslatingRollerCam", "spring"), "load.spring_rate")
    monkeypatch.setitem(RENAMED, ("TranslatingRollerCam", "closing_law"), "motion.return.law")
    found = read_json(json.dumps(content))
    assert found.thing.load.spring_rate == 7500.0
    assert value_of(found.thing, "motion.return.law").name == "cycloidal"
    assert "closing law is now motion.return.law, spring is now load.spring rate" in found.remarks
    assert not any("lacks" in remark for remark in found.remarks)
    content["design"]["load.spring_rates [N/mm]"] = 7.5
    with pytest.raises(ValueError, match=r"'load.spring_rates \[N/mm\]', which a slide load does not have"):
        read_json(json.dumps(content))


def test_every_row_of_the_table_leads_to_what_there_is():
    for (where, before), now in RENAMED.items():
        assert (where, now) not in RENAMED
        assert where in kinds() or where in ("kind", "measure", "rule", "mode")
        assert before != now


def test_a_high_speed_cam_of_old_has_the_coefficients_that_it_was_saved_with():
    cam = read_json(text("sessions_0.1.0", "high_speed_shaped_laws")).thing.study.start
    assert isinstance(cam, HighSpeedCam)
    saved = json.loads(text("sessions_0.1.0", "high_speed_shaped_laws"))["work"]["start"]
    assert cam.rise_law.c == tuple(saved[f"rise_c{i}"] for i in range(4)) == (0.05, -0.1, 0.0, 0.0)
    assert cam.return_law.c == tuple(saved[f"return_c{i}"] for i in range(4)) == (0.0, 0.0, 0.08, 0.0)
    assert cam.contact.width == saved["contact_width [mm]"] * 1e-3
