"""A cam with an elastic train as it is shown: animated, its force beside a rigid one's, over speed, and in flight."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import HighSpeedCam, OscillatingFlatCam, OscillatingRollerCam, TranslatingRollerCam, deg, explore, mm, rpm
from camkit.cam import ArmLoad, BarrelCam, SlideLoad, TranslatingFlatCam, jump_speed, leaving_speed
from camkit.dynamics import ElasticArm, ElasticFollower, ElasticTrain, HelicalSpring, simulate
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.views import (
    acceleration_beside_cam,
    cam_and_train,
    default_views,
    force_beside_rigid,
    force_over_speed,
    gap_and_strikes,
    spectrum_of_lift,
)
from redrawing import redrawn_in_place

VIEWS = (
    cam_and_train,
    force_beside_rigid,
    force_over_speed,
    gap_and_strikes,
    acceleration_beside_cam,
    spectrum_of_lift,
)
A = ElasticTrain(8e5, 100.0, 20.0)
MOTION = MotionProgram(
    (Rise(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg), Return(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg))
)
ARM = ArmLoad(mass=1.0, torque=5.0, speed=100 * rpm)


def held(speed):
    return SlideLoad(mass=2.0, speed=speed * rpm, spring_rate=5e3, preload=300.0)


def flat(speed=600.0, train=A):
    return ElasticFollower(TranslatingFlatCam(MOTION, 0.04, load=held(speed)), train)


DESIGNS = {
    "stays": flat(),
    "leaves": flat(800.0),
    "strikes": flat(900.0, replace(A, cam_side_mass=0.3)),
    "surges": flat(800.0, replace(A, spring=HelicalSpring())),
    "undamped": flat(train=ElasticTrain(8e5, 0.0, 0.0)),
    "roller": ElasticFollower(TranslatingRollerCam(MOTION, groove=False, load=held(500)), A),
    "groove": ElasticFollower(
        TranslatingRollerCam(
            MOTION, groove=True, load=SlideLoad(mass=2.0, speed=900 * rpm, spring_rate=0.0, preload=0.0)
        ),
        A,
    ),
    "arm": ElasticFollower(OscillatingRollerCam(groove=False, load=ARM), ElasticArm(400.0, 0.2)),
    "rated": ElasticFollower(HighSpeedCam(), ElasticArm(5e4, 50.0)),
    "flat arm": ElasticFollower(OscillatingFlatCam(load=ARM), ElasticArm(400.0, 0.2)),
}


@cache
def of(name):
    return DESIGNS[name].analyse()


@pytest.mark.parametrize("name", DESIGNS)
def test_every_view_of_every_follower(name):
    analysis = of(name)
    assert default_views(analysis)[: len(VIEWS)] == VIEWS
    for view in VIEWS:
        assert view(analysis).marks, view.__name__


def test_force_beside_rigid():
    shown, response = force_beside_rigid(of("stays")), of("stays").response
    assert shown.axes.title == "Dynamic factor 1.14"
    assert shown["most"].names == ("largest 609.9 N",)
    assert shown["least"].names == ("least 89.49 N",)
    assert shown.axes.xlabel.endswith("(89.49 to 609.9 N)")
    assert np.max(shown["elastic"].y) / np.max(shown["rigid"].y) == pytest.approx(response.dynamic_factor, rel=1e-4)
    lost = force_beside_rigid(of("leaves"))
    assert lost["least"].names[0].endswith("N, formal: the follower leaves the cam, see gap")
    assert np.nanmax(lost["formal"].y) < 0
    assert force_beside_rigid(of("groove"))["least"].names[0].endswith("the other flank of the groove leads")


def test_speeds_at_which_contact_is_lost_and_harmonics_hit():
    """The reference: the elastic train leaves at 687.632718 rpm, the rigid one at 788.430873 rpm."""
    analysis = of("stays")
    shown = force_over_speed(analysis)
    assert shown.axes.title == "Leaves at 687.6 rpm"
    x, rigid, least = (np.array(values) for values in (shown["most"].x, shown["rigid least"].y, shown["least"].y))
    assert x[np.argmax(rigid < 0)] == pytest.approx(788.43, abs=x[1] - x[0])
    assert x[np.argmax(np.isnan(least))] == pytest.approx(687.63, abs=x[1] - x[0])
    assert leaving_speed(analysis) == pytest.approx(jump_speed(DESIGNS["stays"].cam.analyse()), rel=1e-6)
    natural = 634.428877 / (2 * np.pi) * 60
    for hit in analysis.over_speed.hits:
        assert shown[f"hit {hit.number}"].x == pytest.approx([natural / hit.number] * 2)
    assert [hit.number for hit in analysis.over_speed.hits][:2] == [7, 11]
    assert not [hit for hit in analysis.over_speed.hits if hit.number % 2 == 0]  # two alike halves have no even ones


@pytest.mark.parametrize("rate", [5e3, 4e5])
def test_what_a_harmonic_adds_at_its_resonance(rate):
    """Against the amplitude of the force there, also where the return spring is half as stiff as the train."""
    load = SlideLoad(mass=2.0, speed=600 * rpm, spring_rate=rate, preload=300.0)
    analysis = ElasticFollower(TranslatingFlatCam(MOTION, 0.08, load=load), ElasticTrain(8e5, 5.0)).analyse()
    for hit in analysis.over_speed.hits[:3]:
        force = A.replace(damping=5.0, ground_damping=0.0).follow(analysis, hit.speed).train_force
        amplitude = 2 * abs(np.fft.rfft(force)[hit.number]) / len(force)
        assert hit.force == pytest.approx(amplitude, rel=1e-3)


def test_a_rated_speed_is_100_per_cent():
    assert force_over_speed(of("rated")).axes.xlabel.startswith("cam speed  [% of rated] ")
    assert force_over_speed(of("rated"))["now"].x == pytest.approx([100, 100])


def test_spectrum_of_the_lift():
    """By sums over the lift itself, and the surge of a spring of 304.158234 Hz."""
    analysis = flat(train=replace(A, spring=HelicalSpring())).analyse()
    shown, phi = spectrum_of_lift(analysis), np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    s = MOTION(phi).s
    for n in (1, 5, 7):
        amplitude = 2 * abs(np.mean(s * np.exp(-1j * n * phi)))
        assert shown["tops"].y[n - 1] == pytest.approx(1e6 * amplitude, rel=1e-3)
    assert shown["natural frequency"].low == pytest.approx(634.428877 / (600 * rpm), rel=1e-6)
    assert shown["surge of the spring"].low == pytest.approx(304.158234 / 10, rel=1e-6)
    assert np.isnan(shown["tops"].y[1])


def test_gap_and_strikes():
    analysis = of("leaves")
    flight, shown = simulate(analysis, A, turns=2), gap_and_strikes(analysis)
    ends = [event.cam_angle / deg for event in flight.events if event.kind == "on"]
    assert_allclose(shown["strikes"].x, ends)
    assert np.max(shown["gap"].y) == pytest.approx(flight.max_gap / mm)
    assert "strikes up to" in gap_and_strikes(of("strikes")).axes.title
    for name, why in (("stays", "its least force is 89.49 N"), ("groove", "a groove holds it from both sides")):
        assert why in gap_and_strikes(of(name))["stays"].words.replace("\n", " ")


def test_deflection_is_drawn_larger_by_the_factor_that_is_said():
    """Between follower and load: the length at rest less the deflection times the factor."""
    analysis = of("stays")
    factor, train = analysis.exaggeration, next(body for body in analysis.train_bodies if body.name == "train")
    assert cam_and_train(analysis).axes.title == f"Cam and train  (deflection × {factor:g})"
    length = train.end[1] - train.y
    lag = np.interp(
        analysis.cam_angle, analysis.response.cam_angle, analysis.response.driven.travel - analysis.response.position
    )
    assert_allclose((length[0] - length)[:-2], factor * (lag - lag[0])[:-2], atol=factor * 1e-7)
    assert np.ptp(length) > 0.2 * length[0]


def test_follower_leaves_the_cam_where_it_flies():
    analysis = of("leaves")
    face = next(body for body in analysis.train_bodies if body.part == "face")
    off = face.y - DESIGNS["leaves"].cam.analyse().height
    gap = analysis.lag_and_gap[1]
    assert_allclose(off, analysis.exaggeration * gap, atol=1e-12)
    assert gap.max() > 1 * mm
    assert (gap == 0).any()


def test_arm_and_load_turn_about_the_pivot():
    analysis = of("arm")
    train = next(body for body in analysis.train_bodies if body.name == "train")
    pivot = np.array([analysis.cam.centre_distance, 0.0])[:, None]
    for ends in (np.stack([train.x, train.y]), train.end):
        radius = np.hypot(*(ends - pivot))
        assert np.ptp(radius) < 1e-12
    assert np.all(np.hypot(*train.end) > np.hypot(train.x, train.y))  # the load is on the far side


def test_a_drum_keeps_its_own_drawing():
    analysis = ElasticFollower(BarrelCam(load=held(100)), A).analyse(181)
    assert [view.__name__ for view in default_views(analysis)][:3] == [
        "shapes_in_space",
        "unrolled_cam",
        "force_beside_rigid",
    ]


def test_drawing_again_moves_what_is_there():
    one, other = (of(name) for name in ("stays", "leaves"))
    redrawn_in_place(one, [other], VIEWS[1:3])


def test_an_instrument_opens_with_them_and_turns_without_computing_anew(monkeypatch):
    app = explore(DESIGNS["roller"], free=["train.stiffness", "cam.load.preload"], measures=[])
    assert app.views[: len(VIEWS)] == VIEWS
    first = app.living.show(app.design, turn=0.0)
    monkeypatch.delattr(ElasticFollower, "analyse")
    second = app.living.show(app.design, turn=1.0)
    assert first["pictures"] == second["pictures"]
    moved = [not np.array_equal(a, b, equal_nan=True) for a, b in zip(first["arrays"], second["arrays"], strict=True)]
    assert 0 < sum(moved) < 0.3 * len(moved)
