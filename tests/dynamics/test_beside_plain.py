"""A cam with a train becomes a polydyne cam at one stroke, and is seen beside the plain one over the speed."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import OscillatingRollerCam, ValveCam, explore, rpm, with_quantities
from camkit.dynamics import (
    ElasticArm,
    ElasticFollower,
    PolydyneProgram,
    TrainChain,
    beside_plain,
    dwell_vibration,
    polydyne,
)
from camkit.motion import Cycloidal, Poly345, Poly4567, Poly56789, SimpleHarmonic
from camkit.views import default_views, force_beside_plain, motion, vibration_beside_plain
from train_cases import VALUES, A, flat, program

TRAIN = replace(A, damping=0.0)
BEGIN = ElasticFollower(flat(Poly56789()).replace(base_radius=0.08), TRAIN)
MAKE, FIT, BACK = "Make it a polydyne cam", "Fit it to this train", "Back to the cam as wanted"


def made(design, name=MAKE):
    return next(one for one in design.conversions if one.name == name).make()


MADE, SAID = made(BEGIN)


def test_at_one_stroke_and_back():
    load = BEGIN.cam.load
    assert polydyne(BEGIN.cam.motion, TRAIN, load, 600 * rpm) == MADE.cam.motion
    assert (SAID, [one.name for one in MADE.conversions]) == ("", [FIT, BACK])
    assert made(MADE, BACK)[0] == BEGIN
    assert dwell_vibration(MADE.analyse()) < 1e-9 < dwell_vibration(BEGIN.analyse())


def test_a_cam_that_is_made_stays_as_it_is_until_it_is_fitted_anew():
    other = with_quantities(MADE, {"train.stiffness": 7e5, "cam.load.speed": 500 * rpm, "cam.motion.rise.lift": 0.021})
    assert other.cam.motion.stiffness == 8e5
    fitted, _ = made(other, FIT)
    assert (fitted.cam.motion.stiffness, fitted.cam.motion.design_speed) == (7e5, 600 * rpm)
    at_design_speed = with_quantities(fitted, {"cam.load.speed": 600 * rpm})
    assert dwell_vibration(at_design_speed.analyse()) < 1e-9 < dwell_vibration(other.analyse())


@pytest.mark.parametrize(
    ("law", "what", "order"),
    [(SimpleHarmonic(), "position", "second"), (Cycloidal(), "velocity", "third"), (Poly345(), "velocity", "third")],
)
def test_a_law_that_is_not_smooth_enough_is_refused_with_what_would_jump(law, what, order):
    with pytest.raises(ValueError, match=f"the {order} derivative .* jumps at 120 deg, and with it the {what}"):
        made(BEGIN.replace(cam=BEGIN.cam.replace(motion=program(law))))


def test_a_jump_of_the_acceleration_is_said():
    design, said = made(BEGIN.replace(cam=BEGIN.cam.replace(motion=program(Poly4567()))))
    assert said.startswith("The fourth derivative of the wanted motion jumps at 120 deg, and with it the acceleration")
    assert isinstance(design.cam.motion, PolydyneProgram)


def test_an_arm_and_what_has_no_polydyne_cam():
    arm, _ = made(ElasticFollower(OscillatingRollerCam(groove=False), ElasticArm()))
    assert isinstance(arm.cam.motion, PolydyneProgram)
    assert vibration_beside_plain(arm.analyse()).axes.ylabel == "[deg]"
    assert ElasticFollower(ValveCam()).conversions == ()  # its motion has no law to choose
    with pytest.raises(ValueError, match="a train of one mass"):
        made(ElasticFollower(BEGIN.cam, TrainChain()))


def test_beside_the_plain_cam_over_the_speed():
    expected = VALUES["polydyne"]["off"]
    speeds = np.array([float(turns) for turns in expected]) * rpm
    cams = beside_plain(MADE.analyse(), TRAIN, speeds, 5760)
    for name, sweep in (("polydyne", cams.polydyne), ("plain", cams.plain)):
        values = [each[name] for each in expected.values()]
        assert_allclose(sweep.dwell_vibration, values, rtol=1e-6, atol=1e-12)
    with pytest.raises(ValueError, match="the cam is no polydyne cam"):
        beside_plain(BEGIN.analyse(), TRAIN)
    with pytest.raises(ValueError, match="does not apply to 3"):
        beside_plain(3, TRAIN)


def test_pictures():
    views = default_views(MADE.analyse())
    assert views[1:3] == (vibration_beside_plain, force_beside_plain)
    assert not {vibration_beside_plain, force_beside_plain} & {*default_views(BEGIN.analyse())}
    analysis = MADE.analyse()
    still, force = (view(analysis) for view in views[1:3])
    at = np.argmin(abs(still["polydyne"].x - 600))
    assert still["polydyne"].y[at] == still.axes.ylim[0] < still["plain"].y[at] / 100
    assert still["plain"].y[at] == pytest.approx(66.7016, rel=1e-4)  # um
    assert force["polydyne peak"].y[at] == pytest.approx(TRAIN.follow(analysis, 600 * rpm).max_force, rel=1e-4)
    assert force["plain least"].y[at] < force["polydyne least"].y[at] > 0
    assert analysis.beside_plain is analysis.forces_beside_plain


def test_trains_within_tolerances_meet_the_cam_as_it_is_made():
    """And what cannot be in a population is ``nan``."""
    values = {"train.stiffness": [7.6e5, 8e5, 8e5], "cam.motion.design_speed": [62.0, 600 * rpm, -1.0]}
    columns = {path: np.array(column)[:, None] for path, column in values.items()}
    many = with_quantities(MADE, columns)
    assert many.cam.motion.possible[:, 0].tolist() == [True, True, False]
    found = dwell_vibration(many.analyse())
    alone = with_quantities(MADE, {path: column[0] for path, column in values.items()})
    assert found[0] == pytest.approx(dwell_vibration(alone.analyse()), rel=1e-6)
    assert found[1] < 1e-9 < found[0]
    assert np.isnan(found[2])


def test_the_instrument_has_the_buttons():
    app = explore(BEGIN, motion, free=["cam.motion.rise.lift"], measures=[dwell_vibration])
    assert [(one["name"], one["part"]) for one in app.structure["conversions"]] == [(MAKE, "cam motion")]
    make, values = app.structure["make"], list(app.values)
    app._asked({"convert": MAKE}, [])
    assert (app.design, app.message) == (MADE, "")
    assert [one["name"] for one in app.structure["conversions"]] == [FIT, BACK]
    app._asked({"choose": ["cam.motion.rise.law", "4-5-6-7 polynomial"]}, [])
    app._asked({"convert": FIT}, [])
    assert app.message.startswith("The fourth derivative of the wanted motion jumps")
    app._asked({"choose": ["cam.motion.rise.law", "cycloidal"]}, [])
    assert app.message.startswith("The velocity of the follower jumps at 0 deg of the cam; an elastic train")
    app._asked({"file": "html"}, [])
    assert app.message.startswith("This design is computed by its kernel; no page can do that")
    app._asked({"convert": MAKE}, [])
    assert app.message == f"There is no button '{MAKE}' here."
    app._asked({"back": [make, values]}, [])  # Undo
    assert app.design == BEGIN
