"""A study whose menus are free comes back from its file, with its front; a file that was spoiled is refused."""

import json

import pytest

from camkit import Cycloidal, ModifiedSine, Study, TranslatingRollerCam, deg, high_speed_study, mm, quick_front
from camkit.cam import ContactPair, max_pressure_angle, peak_pressure, peak_torque
from camkit.files import Session, from_json, to_json
from camkit.motion import ShapedLaw


@pytest.fixture(scope="module")
def front():
    free = {
        "load.spring_rate": (2e3, 20e3),
        "motion.rise.law": (Cycloidal(), ModifiedSine(), ShapedLaw()),
        ("roller_radius", "contact.width"): {"narrow": (8 * mm, 11 * mm), "wide": (9.5 * mm, 13 * mm)},
        "motion.rise.law.c2": (-0.05, 0.05),
    }
    cam = TranslatingRollerCam(contact=ContactPair())
    study = Study(cam, free, (peak_pressure, peak_torque), at_most={max_pressure_angle: 30 * deg})
    return quick_front(study, 24)


def test_a_front_with_menus_comes_back(front):
    again = from_json(to_json(front))
    assert again.study == front.study
    assert (again.x.tolist(), again.f.tolist()) == (front.x.tolist(), front.f.tolist())
    assert [again[i] for i in range(len(again))] == [front[i] for i in range(len(front))]


def test_a_menu_of_a_path_that_had_another_meaning_comes_back():
    fast = high_speed_study()
    study = fast.replace(free={"rise_law": (Cycloidal(), ModifiedSine()), "contact.width": {8 * mm, 10 * mm}})
    assert from_json(to_json(Session(study, study.start))).study == study


def test_tolerances_of_what_an_option_brings_come_back(front):
    robust = front.study.under({"motion.rise.law.c2": 0.001, "roller_radius": 0.02 * mm}, yield_at_least=0.95)
    assert from_json(to_json(Session(robust, robust.start))).study == robust


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        ("motion.rise.law", {"options": []}, "there is no option of the motion rise law"),
        (
            "motion.rise.law",
            {"options": [["cycloidal", "cyclodial"]]},
            "the file says 'cyclodial' for 'motion.ris",
        ),
        ("motion.rise.law", {"options": [["cycloidal"]]}, "where an option belongs"),
        ("motion.rise.law", {"options": [["a", "cycloidal"], ["b", "cycloidal"]]}, "'b' is twice among the options"),
        ("motion.rise.law", {"options": [["a", "cycloidal"], ["a", "modified sine"]]}, "where an option belongs"),
        ("motion.rise.law", {"options": 3}, "it says 3 for 'motion.rise.law', where a list belongs"),
        ("motion.rise.law", {}, "it says None for 'motion.rise.law', where a list"),
        ("motion.rise.law", [0, 1], "the file says .*0, 1.* for 'motion.rise.law', where options belong"),
        ("motion.rise.law.c2", {"options": [["a", "b"]]}, "the file says 'b' for 'motion.rise.law.c2'"),
        (
            "roller_radius [mm], contact.width [mm]",
            [0, 1],
            "the file says .*0, 1.* for 'roller_r.*', where options belong",
        ),
        ("roller_radius [mm], contact.width [mm]", {"options": [["a", 1, 2, 3]]}, "where an option belongs"),
        (
            "roller_radius [mm], contact.width [mm]",
            {"options": [["a", -8, 2]]},
            "one option of the roller radius is",
        ),
    ],
)
def test_a_spoiled_menu_is_refused_in_a_sentence(front, path, value, sentence):
    content = json.loads(to_json(front))
    content["front"]["free"][path] = value
    with pytest.raises(ValueError, match=sentence):
        from_json(json.dumps(content))
