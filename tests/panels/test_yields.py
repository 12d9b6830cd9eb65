"""The yield that an instrument tells its page: while a hand moves it, when it rests, and where there is none."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from hand import ask, move

from camkit import ArmLoad, DoorHandleCam, Measure, deg, door_handle_study, explore, mm, shaft_study, tolerance_panel
from camkit.quantities import Design, quantity
from camkit.study import Tolerance, general_tolerances
from camkit.study.failures import failures, tolerance_texts
from camkit.views.picture import Axes, Line, Picture

CAM = DoorHandleCam(
    lift_arm=46.8 * mm, lift_start_angle=27 * deg, relief_cam_angle=45 * deg, lift_load=ArmLoad(torque=10)
)
STUDY = door_handle_study(CAM)
LIMITS = {"at_most": STUDY.at_most, "at_least": STUDY.at_least}


def told(app):
    """What the page is told when all is quiet."""
    app._worker.wait()
    app._later.settle()
    app._worker.wait()
    return app.made


def share(app):
    return float(told(app)["text"].removesuffix(" %")) / 100


def test_a_page_that_asks_is_told_the_yield_of_the_general_tolerances():
    app = explore(CAM, **LIMITS)
    assert app.made == {}  # nobody looks
    ask(app, made=True)
    robust = STUDY.under(general_tolerances(CAM))
    found = robust.recheck(robust.x0)
    assert share(app) == pytest.approx(found.share[0], abs=0.0006)
    assert 0.05 < found.share[0] < 0.95
    assert not app.made["good"]
    assert app.made["values"] == app.values
    assert app.made["make"] == app.structure["make"]
    low, high = 100 * found.interval[0]
    assert app.made["more"] == f"({low:.1f} to {high:.1f})"
    assert "ISO 2768-1 m" in app.made["lines"][0]
    assert f"{found.missed[0]} of 1024 parts" in app.made["lines"][1]


def test_while_a_hand_moves_a_slider_the_model_answers_for_the_newest_design():
    app, seen = explore(CAM, **LIMITS, tolerances={"lift_arm": 0.3 * mm}), []
    ask(app, made=True)
    told(app)
    app.observe(lambda change: seen.append(change.new), "made")
    app._later.ask = lambda: None  # it does not rest
    for arm in (44, 46.2, 46.4, 46.6, 46.8):
        move(app, "lift_arm", arm)
    app._worker.wait()
    assert seen[-1]["values"] == app.values
    robust = door_handle_study(app.design).under({"lift_arm": 0.3 * mm})
    assert seen[-1]["text"] == f"{100 * robust.modelled_yield(robust.x0)[0]:.1f} %"
    assert "more" not in seen[-1]  # no interval
    assert len(seen) <= 5


def test_tolerances_that_are_given_count_and_those_of_the_panel_replace_them():
    app = explore(CAM, **LIMITS, tolerances={"lift_arm": 0.05 * mm})
    ask(app, made=True)
    assert "Made within lift arm ±0.05 mm." in told(app)["lines"]
    panel = tolerance_panel(app, STUDY, {"lift_arm": 1 * mm, "relief_arm": 0.0})
    assert app.tolerances == {"lift_arm": Tolerance(1 * mm)}
    assert "Made within lift arm ±1 mm." in told(app)["lines"]
    panel.spread.value = "normal"
    assert app.within(app.design) == {"lift_arm": Tolerance(1 * mm, "normal")}


def test_without_limits_there_is_no_yield():
    app = explore(CAM)
    ask(app, made=True)
    assert told(app) == {}


@pytest.mark.parametrize(
    ("tolerances", "sentence"),
    [
        ({"arm": 0.1}, "'arm' is no quantity"),
        ({"lift_arm": -0.1}, "the first not above"),
        ({"lift_arm": 0.0}, "above 0"),
        ({}, "one or more"),
    ],
)
def test_tolerances_that_are_none_are_refused(tolerances, sentence):
    with pytest.raises(ValueError, match=sentence):
        explore(CAM, **LIMITS, tolerances=tolerances)
    app = explore(CAM, **LIMITS)
    with pytest.raises(ValueError, match=sentence):
        app.tolerances = tolerances
    assert app.tolerances is None


@dataclass(frozen=True)
class OneByOne(Design):
    """A rod whose analysis takes no population."""

    length: float = quantity("l", 40, 10, 100, "mm", "of the rod")

    def analyse(self, n=3):
        return SimpleNamespace(length=self.length if self.length > 0.02 else 0.02)


def rod(analysis):
    return Picture.of(Axes(), Line("rod", np.array([0.0, 1.0]), np.array([0.0, 1.0])))


def test_a_mechanism_that_takes_no_populations_has_a_sentence_in_its_place():
    length = Measure("length", "mm", lambda analysis: analysis.length)
    app = explore(OneByOne(), rod, measures=[length], at_most={length: 50 * mm})
    ask(app, made=True)
    assert told(app)["text"] == "cannot be computed"
    assert app.made["lines"][0].startswith("Why: ")


def test_a_whole_cam_is_made_within_seven_tolerances():
    assert general_tolerances(DoorHandleCam()) == {
        **dict.fromkeys(["lift_arm", "relief_arm", "lift_centre_distance", "relief_centre_distance"], 0.3 * mm),
        "lift_start_angle": 0.5 * deg,
        "relief_cam_angle": 0.5 * deg,
        "roller_radius": 0.1 * mm,
    }


def test_what_is_behind_the_parts_that_fail_is_what_they_would_be_without_it():
    half = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}
    study, x = shaft_study(), np.array([[0.1295, 0.103]])
    why = failures(study.under(half), x)
    assert why.share == pytest.approx(0.8091703, abs=0.01)  # exact: see tests/study/test_robust.py
    for j, name in enumerate(half):
        others = {path: t for path, t in half.items() if path != name}
        assert why.without[0, j] == pytest.approx(study.under(others).recheck(x, 4096).share[0], abs=0.01)
    assert why.missed[0].sum() == pytest.approx(1 - why.share[0])  # one limit alone
    assert str(why).endswith("without the tolerance of the outer diameter 100.0 % would keep every limit")
    assert "utilisation of the twist (at most 100 %)" in str(why)
    assert str(failures(study.under(half), np.array([[0.132, 0.103]]))) == "no part misses a limit"
    assert "no single tolerance" in str(failures(study.under(half), np.array([[0.120, 0.103]])))
    assert tolerance_texts(study.under({"outer_diameter": (-0.1 * mm, 0.3 * mm)})) == [
        "outer diameter -0.1 mm to 0.3 mm"
    ]
