"""Motions that go on with each turn, such as those of an indexing table and of a rotary knife."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit.cam import (
    BarrelCam,
    OscillatingBarrelCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
)
from camkit.motion import (
    LAWS,
    ConstantVelocity,
    Cycloidal,
    Dwell,
    FormError,
    ModifiedSine,
    MotionProgram,
    Poly345,
    Return,
    Rise,
    residual_vibration,
)
from camkit.program import recorded
from camkit.quantities import quantities_of, with_quantities
from camkit.units import deg, mm
from camkit.views.laws import PROGRAM_VIEWS, ShownProgram

TURN = 2 * np.pi


def indexer(law=None, angle=120 * deg, stroke=60 * deg, **more):
    """Six stations: on by 60 deg over 120 deg of the cam, then a dwell."""
    segments = Rise(angle, stroke, law or ModifiedSine()), Dwell(TURN - angle)
    return MotionProgram(segments, **{"advance": stroke} | more)


def test_six_stations():
    """Modified sine: Cv = 1.759603, so 1.759603 / 2 rad/rad; Norton, Cam Design and Manufacturing Handbook."""
    program = indexer()
    assert program.peaks().velocity.value == pytest.approx(0.879802, abs=5e-7)
    assert program.peaks().velocity.cam_angle == pytest.approx(60 * deg)
    assert program(np.arange(0, 2161, 360) * deg).s / deg == pytest.approx(60 * np.arange(7), abs=1e-12)
    assert bool(program.periodic)
    assert not program.comes_back
    assert program.levels[-1] == 60 * deg


@pytest.mark.parametrize("turns", [-7, -1, 1, 2, 100])
def test_after_a_turn_the_follower_is_one_advance_further(turns):
    program, phi = indexer(start=0.3), np.linspace(0.01, 6.28, 97)
    here, there = program(phi), program(phi + turns * TURN)
    assert np.allclose(there.s, here.s + turns * 60 * deg, rtol=0, atol=1e-12)
    for k in (1, 2, 3):
        assert np.allclose(there[k], here[k], rtol=0, atol=1e-9)


def test_around_the_ends_of_turns_nothing_jumps():
    """A rounded cam angle may fall into the turn before or after; the level is the same."""
    program = indexer()
    ends = np.arange(-40, 41)[:, None] * TURN
    around = ends + np.array([-2e-9, -1e-9, -1e-12, -1e-15, 0.0, 1e-15, 1e-12, 1e-9, 2e-9])
    assert np.allclose(program(around).s, np.arange(-40, 41)[:, None] * 60 * deg, rtol=0, atol=1e-12)


def test_the_level_is_the_speed_added_up():
    """By the trapezoidal rule over five turns, good to h^2 |v| / 12 = 2e-9; nothing of the levels is used."""
    program = indexer(Poly345())
    phi = np.linspace(-2 * TURN, 3 * TURN, 200_001)
    s, v, *_ = program(phi)
    added = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * np.diff(phi))])
    assert np.allclose(s - s[0], added, rtol=0, atol=1e-8)
    assert s[-1] - s[0] == pytest.approx(5 * 60 * deg)


def test_backwards():
    program = MotionProgram((Return(90 * deg, 45 * deg, Cycloidal()), Dwell(270 * deg)), advance=-45 * deg)
    assert program(np.array([-180, 45, 405, 800]) * deg).s / deg == pytest.approx([0, -22.5, -67.5, -135], abs=1)
    assert program(405 * deg).s == pytest.approx(program(45 * deg).s - 45 * deg)


def test_the_stroke_may_go_around_the_end_of_the_turn():
    """A knife that never stops: no joint jumps, and the speed has its peak where the turn ends."""
    law = ConstantVelocity(0.3)
    segments = (Rise(TURN, np.pi, law),)
    program = MotionProgram(segments, advance=np.pi)
    assert [joint.order for joint in program.transitions()] == [None]
    parts = MotionProgram(
        (Rise(100 * deg, 1.0, law), Return(60 * deg, 0.25, law), Rise(200 * deg, 1.0, law)), advance=1.75
    )
    assert all(abs(joint.s) < 1e-12 and joint.lawful for joint in parts.transitions())
    assert np.isfinite(parts.peaks().jerk.value)


def test_a_jump_over_the_end_of_the_turn_shows():
    """Two halves at unlike speeds: the velocity jumps at both joints, and the acceleration has no end."""
    steady = MotionProgram((Rise(1.0, 1.0, lambda u: (u, 1 + 0 * u, 0 * u, 0 * u)), Dwell(TURN - 1.0)), advance=1.0)
    assert [joint.order for joint in steady.transitions()] == [1, 1]
    assert steady.transitions()[1].v == pytest.approx(1.0)
    assert steady.transitions()[1].s == pytest.approx(0.0, abs=1e-12)
    assert steady.peaks().acceleration.value == np.inf
    assert steady.peaks().velocity.value == pytest.approx(1.0)


def test_other_values_by_path_keep_the_advance():
    program = indexer()
    assert list(quantities_of(program)) == ["rise.angle", "start"]
    assert program.following()["rise.lift"] == "it takes the follower on by the advance of a turn"
    other = with_quantities(program, {"rise.angle": 150 * deg, "start": 0.2})
    assert other.advance == 60 * deg
    assert [segment.angle / deg for segment in other.segments] == pytest.approx([150, 210])
    assert other(TURN + 0.1).s - other(0.1).s == pytest.approx(60 * deg)


def test_the_last_move_takes_up_the_lift():
    law = Cycloidal()
    two = MotionProgram(
        (Rise(90 * deg, 0.7, law), Dwell(90 * deg), Rise(60 * deg, 0.5, law), Dwell(120 * deg)), advance=1.2
    )
    assert with_quantities(two, {"rise.lift": 0.4}).segments[2].lift == pytest.approx(0.8)
    back = MotionProgram((Rise(90 * deg, 0.7, law), Return(90 * deg, 0.2, law), Dwell(180 * deg)), advance=0.5)
    assert with_quantities(back, {"rise.lift": 1.0}).segments[1].lift == pytest.approx(0.5)
    with pytest.raises(ValueError, match="the lifts before it are too large"):
        with_quantities(two, {"rise.lift": 1.3})


lifts = st.lists(st.floats(0.01, 3), min_size=1, max_size=4)


@given(lifts, st.floats(0.2, 2.0), st.sampled_from(LAWS), st.floats(-40, 40))
@settings(max_examples=50, deadline=None)
def test_a_population_equals_its_members(rows, angle, law, first):
    phi = first + np.linspace(0, 15, 41)
    h = np.array(rows)[:, None]
    together = MotionProgram((Rise(angle, h, law), Dwell(TURN - angle)), advance=h)
    for i, row in enumerate(rows):
        alone = indexer(law, angle, row)
        for many, one in zip(together(phi), alone(phi), strict=True):
            assert np.allclose(many[i], one, rtol=1e-12, atol=1e-10)
        assert together.peaks().velocity.value[i] == pytest.approx(alone.peaks().velocity.value, rel=1e-12)


def test_in_a_population_what_does_not_close_is_nan():
    h, advance = np.array([[1.0], [1.0], [0.0], [np.nan]]), np.array([[1.0], [0.5], [0.0], [1.0]])
    program = MotionProgram((Rise(1.0, h, Cycloidal()), Dwell(TURN - 1.0)), advance=advance)
    assert np.isnan(program(TURN + 0.5).s).tolist() == [False, True, False, True]
    span = np.array([[TURN - 1.0], [3.0]])
    part = MotionProgram((Rise(1.0, 1.0, Cycloidal()), Dwell(span)), advance=1.0)
    assert np.isnan(part(0.5).s).tolist() == [False, True]


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ({"advance": 0.0}, "the program ends 1.0472 from its start after 360 deg; a full turn must come back to its "
         "start, or say by how much it is further: advance=1.0471975512"),
        ({"advance": 1.0}, "the program ends 1.0472 from its start after 360 deg; that must be its advance, 1, from "
         "which it is 0.0472 away"),
        ({"advance": np.inf}, "the advance of the program is inf; it must be a finite number"),
        ({"advance": "60"}, "the advance of the program is '60'; it must be a finite number"),
    ],
)  # fmt: skip
def test_what_does_not_close_is_refused(more, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011  the whole sentence is compared
        indexer(**more)
    assert str(refusal.value) == sentence


def test_what_the_sentence_says_closes_the_turn():
    with pytest.raises(ValueError, match="advance=") as refusal:
        indexer(advance=0.0)
    said = float(str(refusal.value).rpartition("=")[2])
    assert indexer(advance=said)(TURN + 1.0).s == pytest.approx(indexer()(TURN + 1.0).s)


def test_a_part_of_a_turn_does_not_go_on():
    sentence = "the advance of the program is 1, but it spans 120 deg; only a full turn can go on"
    with pytest.raises(ValueError, match=sentence):
        MotionProgram((Rise(120 * deg, 1.0, Cycloidal()),), advance=1.0)


def test_a_segment_is_not_called_advance():
    with pytest.raises(ValueError, match="called advance"):
        MotionProgram((Dwell(1.0, name="advance"),))


CAMS = (
    TranslatingRollerCam,
    TranslatingFlatCam,
    OscillatingRollerCam,
    OscillatingFlatCam,
    BarrelCam,
    OscillatingBarrelCam,
)


@pytest.mark.parametrize("kind", CAMS)
def test_a_disk_cam_comes_back(kind):
    with pytest.raises(ValueError, match="cam takes its follower back to where it was: the advance of its motion"):
        kind(indexer())
    lift = np.array([[0.0], [5 * mm]])
    cam = kind(MotionProgram((Rise(1.0, lift, Cycloidal()), Dwell(TURN - 1.0)), advance=lift))
    assert np.isnan(cam.analyse(73).pressure_angle).any(-1).tolist() == [False, True]


def test_an_error_of_form_rides_on_it():
    made = FormError(amplitude=1e-3, waves=12).on(indexer())
    phi = np.linspace(0.1, 6.2, 31)
    assert made.advance == 60 * deg
    assert made(phi + TURN).s == pytest.approx(made(phi).s + 60 * deg)
    assert made(phi).s - indexer()(phi).s == pytest.approx(1e-3 * np.cos(12 * phi))


def test_it_shakes_as_its_stroke_does():
    tau = np.array([2.0, 3.7, 8.0])
    stroke = MotionProgram((Rise(120 * deg, 60 * deg, ModifiedSine()),))
    whole, alone = residual_vibration(indexer(), 3 * tau), residual_vibration(stroke, tau)
    assert whole.residual == pytest.approx(alone.residual, rel=1e-6)


def test_it_is_drawn():
    shown = ShownProgram(indexer(), "deg")
    curves = [{mark.key: mark for mark in view(shown).marks} for view in PROGRAM_VIEWS]
    assert np.max(curves[0]["Displacement"].y) == pytest.approx(60)
    assert curves[0]["handles"].y == pytest.approx([0, 60, 60])


def test_it_can_be_recorded():
    """The same numbers as a program runs in the web page, where its angles and lifts are those of any design."""
    phi = np.linspace(-9, 20, 57)

    def motion(given):
        h = given["h"]
        program = MotionProgram((Rise(given["beta"], h, Poly345()), Dwell(TURN - given["beta"])), advance=h)
        return dict(zip("svaj", program(phi), strict=True))

    program = recorded(motion, {"h": 1.0, "beta": 2.0})
    for h, beta in ((0.5, 1.0), (-0.2, 2.0), (2.0, 3.0)):
        found, alone = program({"h": h, "beta": beta}), indexer(Poly345(), beta, abs(h))(phi)
        for name, values in zip("svaj", alone, strict=True):
            expected = values if h > 0 else np.full(57, np.nan)
            assert np.allclose(found[name], expected, rtol=0, atol=1e-12, equal_nan=True)
