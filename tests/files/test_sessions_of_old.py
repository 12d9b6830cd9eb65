"""Sessions that earlier versions wrote are read today, and what is computed of them is what they computed."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import DoorHandleCam, HighSpeedCam, TranslatingRollerCam
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
    return {f"{m.name} [{m.unit}]".removesuffix(" []"): float(m(analysis)) for m in type(design).measures}


def test_there_are_five_of_0_1_0_different_in_kind():
    found = [read_json(text(*file)).thing for file in EXPECTED if file[0] == "sessions_0.1.0"]
    assert {type(thing.study.start if isinstance(thing, Session) else thing).__name__ for thing in found} == {
        "DoorHandleCam", "HighSpeedCam", "ValveCam", "CabinDoorLinkage", "TranslatingRollerCam",
    }  # fmt: skip


@pytest.mark.parametrize("file", EXPECTED, ids="/".join)
def test_a_session_of_old_is_read_with_its_numbers(file):
    expected, found = EXPECTED[file], read_json(text(*file))
    assert (UNMARKED in found.remarks) is (file[0] == "sessions_0.1.0")
    thing, renaming = found.thing, Renaming()
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
        today = renaming.name("measure", name.removesuffix(" []"))
        if not name.startswith(OTHERWISE):
            near = 1e-4 if name.startswith("mean") else 5e-6  # a mean over jumps of friction, by trapezoids of 0.1.0
            assert_allclose(now[today], value, rtol=near, atol=1e-11, err_msg=name)


@pytest.mark.parametrize("file", EXPECTED, ids="/".join)
def test_a_session_of_old_is_written_and_read_again(file):
    thing = read_json(text(*file)).thing
    again = read_json(to_json(thing))
    assert again.remarks == ()
    assert to_json(again.thing) == to_json(thing)


def aged(monkeypatch, name, where, before, now):
    """A file as it was written when ``now`` was still called ``before``."""
    monkeypatch.setitem(RENAMED, (where, before), now)
    assert f'{now}"' in text("sessions_0.1.0", name)
    return text("sessions_0.1.0", name).replace(f'{now}"', f'{before}"')


@pytest.mark.parametrize(
    ("name", "where", "before", "now"),
    [
        ("high_speed_shaped_laws", "HighSpeedCam", "largest_radius [mm]", "max_radius [mm]"),
        ("high_speed_shaped_laws", "kind", "FastCam", "HighSpeedCam"),
        ("valve", "measure", "peak acceleration upwards [m/s^2]", "peak positive acceleration [m/s^2]"),
        ("valve", "measure", "roundness", "fullness"),
        ("valve", "rule", "elbow", "knee"),
        ("sliding_roller_program", "SlideLoad", "spring [N/mm]", "spring_rate [N/mm]"),
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
        f"{before.partition(' [')[0]} is now {now.partition(' [')[0]}".replace("_", " ")
    }


@pytest.mark.parametrize(
    ("name", "before", "now"),
    [
        ("high_speed_shaped_laws", "contact stress F sigma", "stress index F sigma"),
        ("cabin_door_linkage", "steepest pressure angle", "maximum pressure angle"),
        ("door_handle_front", "undercut margin of the groove, worse curve", "undercut margin, worse curve"),
    ],
)
def test_measures_of_old_are_judged_by_their_names_of_today(monkeypatch, name, before, now):
    monkeypatch.setattr(renamed, "MANY", 99)
    found = read_json(text("sessions_0.1.0", name))
    assert any(f"{before} is now {now}" in remark for remark in found.remarks)
    study = found.thing.study
    parts = [part for goal in study.minimise for part in getattr(goal, "parts", (goal,))]
    judged = [m.name for m in (*parts, *(m for m, _, _ in study.limits))]
    assert now.replace(" sigma", "_sigma") in judged


def test_every_measure_that_is_renamed_is_one_of_a_design():
    every = [m for kind in kinds().values() for m in getattr(kind, "measures", ())]
    today = {f"{m.name} [{m.unit}]".removesuffix(" []") for m in every}
    rows = {now for (where, _), now in RENAMED.items() if where == "measure"}
    assert {now for now in rows if not re.search(", (lift|relief|worse curve)", now)} <= today
    assert len(rows & today) > 30


def test_without_a_row_an_old_name_is_refused_by_name():
    old = text("sessions_0.1.0", "high_speed_shaped_laws").replace("max_radius", "largest_radius")
    with pytest.raises(ValueError, match=r"'largest_radius \[mm\]', which a high speed cam does not have"):
        read_json(old)


def test_what_was_a_field_of_its_own_is_put_where_it_stands_today(monkeypatch):
    content = json.loads(to_json(TranslatingRollerCam()))
    content["design"] |= {"closing_law": "cycloidal", "spring [N/mm]": 7.5}
    del content["design"]["load"], content["design"]["motion"]
    monkeypatch.setitem(RENAMED, ("TranslatingRollerCam", "spring [N/mm]"), "load.spring_rate [N/mm]")
    monkeypatch.setitem(RENAMED, ("TranslatingRollerCam", "closing_law"), "motion.return.law")
    found = read_json(json.dumps(content))
    assert found.thing.load.spring_rate == 7500.0
    assert value_of(found.thing, "motion.return.law").name == "cycloidal"
    assert "closing law is now motion.return.law, spring is now load.spring rate" in found.remarks
    assert not any("lacks" in remark for remark in found.remarks)
    content["design"]["load.spring_rates [N/mm]"] = 7.5
    with pytest.raises(ValueError, match=r"'load.spring_rates \[N/mm\]', which a translating roller cam does not"):
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


def door(spoil):
    """The old file of a door handle with something spoiled in its session."""
    content = json.loads(text("sessions_0.1.0", "door_handle_front"))
    spoil(content["work"])
    return json.dumps(content)


def put(*path, **entries):
    """Change entries, or rename one: ``before="now"`` with ``_`` before it."""

    def spoil(inner):
        for step in path:
            inner = inner[step]
        inner.update(entries.get("to", {}))
        for before, now in entries.get("renamed", {}).items():
            inner[now] = inner.pop(before)

    return spoil


def free_speed(value, bounds=(50.0, 120.0), key="handle_speed [deg/s]"):
    """The front with the speed of the handle as its last free quantity."""

    def spoil(work):
        work["free"][key] = list(bounds)
        for row in work["front"]:
            row.append(value)

    return spoil


SPEED, NOW = "handle_speed [deg/s]", "lift_load.speed [rpm]"
TWICE = "which are one and the same"
SPOILED = {
    "a length as a speed": (put("start", renamed={SPEED: "handle_speed [mm]"}), "has 'handle_speed [mm]', which a d"),
    "no unit": (put("start", renamed={SPEED: "handle_speed"}), "has 'handle_speed', which a door handle cam does not"),
    "another unit": (put("start", renamed={SPEED: "handle_speed [rpm]"}), "has 'handle_speed [rpm]', which a door"),
    "a unit where there was none": (put("start", renamed={"friction": "friction [mm]"}), "has 'friction [mm]', which"),
    "grams": (put("design", renamed={"lift_arm_mass [kg]": "lift_arm_mass [g]"}), "has 'lift_arm_mass [g]', which a"),
    "a free quantity in another unit": (free_speed(60, key="handle_speed [rpm]"), "frees 'handle_speed [rpm]', which"),
    "by both names": (put("start", to={NOW: 15.0}), f"has '{SPEED}' and '{NOW}', {TWICE}"),
    "deeper as well": (
        put("start", to={"lift_load": {"kind": "ArmLoad", "speed [rpm]": 15.0}}), f"has '{SPEED}' and '{NOW}', {TWICE}"
    ),
    "free by both names": (
        put("free", to={SPEED: [1.0, 2.0], NOW: [3.0, 4.0]}), f"has '{SPEED}' and '{NOW}', {TWICE}"
    ),
    "true": (put("start", to={SPEED: True}), f"says True for '{SPEED}'; it must be"),
    "a list": (put("start", to={SPEED: [1.0]}), f"says [1.0] for '{SPEED}'; it must be"),
    "below its bounds": (put("start", to={SPEED: -90.0}), f"says -90 for '{SPEED}': the speed"),
    "bounds of text": (put("free", to={SPEED: ["x", 1]}), f"is damaged: it says ['x', 1] for '{SPEED}', where 2 num"),
    "bounds that are reversed": (put("free", to={SPEED: [90.0, 45.0]}), f"says [90.0, 45.0] for '{SPEED}': the bounds"),
    "true in the front": (free_speed(True), "is damaged: its front does not have 8 values for each design"),
    "outside of its bounds": (free_speed(130.0), f"design 1 has 130.0 for '{SPEED}'; the bounds are 50.0 and 120.0"),
    "a table of text": (put("start", to={"door_torque_table": ["x"]}), "says ['x'] for 'door_torque_table'; a list"),
    "a limit of text": (
        put("at_most", to={"steepest pressure angle, worse curve [deg]": "x"}), "worse curve [deg]' is 'x'; it must be"
    ),
}  # fmt: skip


@pytest.mark.parametrize(("spoil", "sentence"), SPOILED.values(), ids=SPOILED)
def test_a_spoiled_file_of_old_is_refused_with_what_stands_in_it(spoil, sentence):
    with pytest.raises(ValueError, match=f"^the f.*?{re.escape(sentence)}"):
        read_json(door(spoil))


def test_a_free_quantity_of_old_comes_with_its_unit_and_sign():
    def spoil(work):
        free_speed(90.0)(work)
        work["free"]["flap_torque [N m]"] = [0.0, 2.0]
        for row in work["front"]:
            row.append(0.5)

    session = read_json(door(spoil)).thing
    assert_allclose(session.study.free["lift_load.speed"], [np.deg2rad(50), np.deg2rad(120)])
    assert session.study.free["relief_load.torque"] == (-2.0, 0.0)
    assert_allclose(session.front.x[:, -2:], [[np.pi / 2, -0.5]] * len(session.front.x))


@pytest.mark.parametrize(
    ("lacking", "default"),
    [(SPEED, "lift_load.speed"), ("friction", "friction.coefficient"), ("lift_arm [mm]", "lift_arm")],
)
def test_what_a_file_of_old_lacks_takes_the_default_of_today_with_a_remark(lacking, default):
    content = json.loads(text("sessions_0.1.0", "door_handle_front"))
    del content["work"]["design"][lacking]
    found = read_json(json.dumps(content))
    assert value_of(found.thing.design, default) == value_of(DoorHandleCam(), default)
    assert any(f"lacks {lacking!r} of the door handle cam" in remark for remark in found.remarks)


def test_a_limit_by_both_names_of_its_measure_is_refused(monkeypatch):
    monkeypatch.setitem(RENAMED, ("measure", "steepest angle [deg]"), "maximum pressure angle, worse curve [deg]")
    with pytest.raises(ValueError, match=r"^the file has the maximum .* twice in 'at_most', the second time as 'steep"):
        read_json(door(put("at_most", to={"steepest angle [deg]": 30.0})))
