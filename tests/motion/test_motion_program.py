"""Motion programs: what they say at every angle, at joints, at peaks, for populations, and what they refuse."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit.motion import (
    LAWS,
    ConstantVelocity,
    Cycloidal,
    Degree9,
    Dwell,
    FreePolynomial,
    HalfCycloidalEnd,
    HalfCycloidalStart,
    HalfHarmonicEnd,
    HalfHarmonicStart,
    Kinematics,
    ModifiedTrapezoid,
    MotionProgram,
    Parabolic,
    Poly345,
    Poly4567,
    Return,
    Rise,
    SimpleHarmonic,
    Skewed,
)
from camkit.units import deg, mm, rpm


def full_turn(law, lift=0.02):
    """Rise 90, dwell 30, return 120, dwell 120 deg."""
    return MotionProgram((Rise(90 * deg, lift, law), Dwell(30 * deg), Return(120 * deg, lift, law), Dwell(120 * deg)))


# ---------------------------------------------------------------- values


def test_levels_and_edges():
    program = full_turn(Cycloidal())
    assert program.edges / deg == pytest.approx([0, 90, 120, 240, 360])
    assert program.span == pytest.approx(2 * np.pi)
    assert program(np.array([0, 45, 90, 100, 120, 180, 240, 300, 360]) * deg).s == pytest.approx(
        [0, 0.01, 0.02, 0.02, 0.02, 0.01, 0, 0, 0], abs=1e-15
    )


def test_derivatives_are_those_of_the_position():
    program = full_turn(Poly4567(), lift=1.0)
    phi, h = np.linspace(0.01, 6.27, 400), 1e-3
    for k in range(3):
        f = [program(phi + i * h)[k] for i in (-2, -1, 1, 2)]
        assert np.allclose(program(phi)[k + 1], (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h), atol=1e-4)


def test_a_program_may_begin_with_a_return():
    program = MotionProgram((Return(30 * deg, 10 * deg, Cycloidal()), Dwell(150 * deg)), start=0.1)
    assert program(15 * deg).s == pytest.approx(0.1 - 5 * deg)
    assert program([1.0, 3.0]).s == pytest.approx([0.1 - 10 * deg] * 2)
    assert program(15 * deg).v < 0


def test_at_a_joint_the_segment_that_begins_there_speaks():
    program = full_turn(SimpleHarmonic(), lift=1.0)
    first, rise_end, return_begin, last = program(np.array([0, 90, 120, 360]) * deg).a
    assert first == pytest.approx(np.pi**2 / 2 / (90 * deg) ** 2)
    assert rise_end == 0
    assert return_begin == pytest.approx(-(np.pi**2) / 2 / (120 * deg) ** 2)
    assert last == 0  # 360 deg belongs to the last dwell
    phi = np.linspace(0, 2 * np.pi, 361)
    assert np.count_nonzero(program(phi).a[90:120]) == 0


def test_a_full_turn_repeats():
    program = full_turn(Poly345())
    phi = np.linspace(0.01, 6.2, 50)
    for turns in (-2, -1, 1, 3):
        for here, there in zip(program(phi), program(phi + turns * 2 * np.pi), strict=True):
            assert np.allclose(here, there, atol=1e-12)


def test_a_part_of_a_turn_is_nan_outside():
    program = MotionProgram((Rise(90 * deg, 1.0, Poly345()),))
    assert np.isnan(program([-0.1, 91 * deg, 2 * np.pi, np.nan, np.inf]).s).all()
    assert program([0, 90 * deg, 90 * deg + 1e-12]).s == pytest.approx([0, 1, 1])


def test_shapes():
    program = full_turn(Cycloidal())
    assert np.ndim(program(1.0).s) == 0
    assert program(np.zeros((3, 5))).j.shape == (3, 5)
    assert program([]).s.shape == (0,)


def test_any_function_of_u_is_a_law():
    program = MotionProgram((Rise(1.0, 2.0, lambda u: Kinematics(u, 1 + 0 * u, 0 * u, 0 * u)),))
    assert program([0.25, 0.5]).s == pytest.approx([0.5, 1.0])
    assert program.peaks().velocity.value == pytest.approx(2.0)


def test_equal_programs_are_equal():
    assert full_turn(Cycloidal()) == full_turn(Cycloidal())
    assert hash(full_turn(Cycloidal())) == hash(full_turn(Cycloidal()))
    assert full_turn(Cycloidal()) != full_turn(Poly345())
    assert replace(full_turn(Cycloidal()), start=1.0)(0.0).s == 1.0


def test_in_time():
    program, speed = full_turn(Cycloidal()), 300 * rpm
    phi = np.linspace(0, 6, 13)
    s, v, a, j = program(phi)
    time = program.in_time(phi, speed)
    assert np.allclose(time.s, s)
    assert np.allclose(time.v, v * speed)
    assert np.allclose(time.a, a * speed**2)
    assert np.allclose(time.j, j * speed**3)
    assert program.in_time(phi, np.array([[1.0], [2.0]])).s.shape == (2, 13)


# ---------------------------------------------------------------- populations

angles = st.floats(0.3, 1.2)
lifts = st.just(0.0) | st.floats(1e-6, 2)
laws = st.sampled_from([*LAWS, ConstantVelocity(), Skewed(Poly345(), 0.4)])
members = st.lists(st.tuples(angles, lifts, angles, angles, lifts), min_size=1, max_size=4)


@given(members, laws, laws, st.booleans())
@settings(max_examples=60, deadline=None)
def test_a_population_equals_its_members(rows, up, down, own_angles):
    def build(a, h, b, c, g):
        return MotionProgram((Rise(a, h, up), Dwell(b), Return(c, g, down)), start=0.5)

    phi = np.linspace(0, 3.6, 37)
    phi = phi + 0.001 * np.arange(len(rows))[:, None] if own_angles else phi
    together = build(*(np.array(column)[:, None] for column in zip(*rows, strict=True)))
    for i, row in enumerate(rows):
        alone = build(*row)
        for many, one in zip(together(phi), alone(phi[i] if own_angles else phi), strict=True):
            assert many.shape == (len(rows), 37)
            assert np.allclose(many[i], one, rtol=1e-12, atol=1e-12, equal_nan=True)
        assert together.edges[i] == pytest.approx(alone.edges)


def test_a_population_of_laws_alone():
    c = np.array([[0.0], [0.2], [-0.1]])
    program = full_turn(Degree9((c, 0, 0, 0)))
    phi = np.linspace(0, 2 * np.pi, 73)
    for i in range(3):
        assert np.allclose(program(phi).a[i], full_turn(Degree9((c[i, 0], 0, 0, 0)))(phi).a, atol=1e-12)


def test_a_population_of_starts_and_one_angle():
    program = replace(full_turn(Cycloidal()), start=np.array([[0.0], [1.0]]))
    assert program([45 * deg]).s == pytest.approx(np.array([[0.01], [1.01]]))
    assert program(45 * deg).s == pytest.approx([0.01, 1.01])


def test_a_member_that_cannot_be_is_nan_and_disturbs_nobody():
    angle = np.array([[60 * deg], [-1.0], [np.nan], [60 * deg], [300 * deg], [60 * deg]])
    lift = np.array([[0.02], [0.02], [0.02], [np.inf], [0.02], [0.03]])
    rest = np.where(np.isfinite(angle), 200 * deg - angle, 1.0)  # the third spans no full turn, and is nan itself
    rest[4] = 1.0
    program = MotionProgram((Rise(angle, lift, Cycloidal()), Return(160 * deg, 0.02, Cycloidal()), Dwell(rest)))
    assert np.isfinite(program(np.linspace(0, 6, 7)).s).all(axis=-1).tolist() == [True, *[False] * 5]


def test_only_full_turns_must_close_in_a_population():
    program = MotionProgram((Rise(np.array([[90 * deg], [360 * deg]]), 0.02, Cycloidal()),))
    s = program([0, 45 * deg, 90 * deg]).s
    assert s[0] == pytest.approx([0, 0.01, 0.02])
    assert np.isnan(s[1]).all()


# ---------------------------------------------------------------- joints


def orders(program):
    return [joint.order for joint in program.transitions()]


@pytest.mark.parametrize(
    ("law", "order"),
    [
        (SimpleHarmonic(), 2),
        (Parabolic(), 2),
        (Cycloidal(), 3),
        (ModifiedTrapezoid(), 3),
        (Poly345(), 3),
        (Poly4567(), None),
    ],
    ids=str,
)
def test_the_order_that_breaks_at_dwells(law, order):
    assert orders(full_turn(law)) == [order] * 4


def test_joints_have_their_angles_with_the_turns_own_joint_last():
    joints = full_turn(Cycloidal()).transitions()
    assert [joint.angle / deg for joint in joints] == pytest.approx([90, 120, 240, 360])
    assert len(MotionProgram((Rise(1, 1, Cycloidal()), Dwell(1))).transitions()) == 1
    assert MotionProgram((Rise(1, 1, Cycloidal()),)).transitions() == []


def test_jumps_are_after_minus_before():
    joint = full_turn(SimpleHarmonic(), 1.0).transitions()[0]
    assert joint.s == pytest.approx(0, abs=1e-12)
    assert joint.v == pytest.approx(0, abs=1e-12)
    assert joint.a == pytest.approx(np.pi**2 / 2 / (90 * deg) ** 2)
    assert joint.j == pytest.approx(0, abs=1e-12)


def test_verdicts():
    straight = FreePolynomial((0,), (1,))
    leap = FreePolynomial((0.5, 0), (1, 0))
    rising = Rise(60 * deg, 12 * mm, Poly345())
    said = [
        MotionProgram((rising, Dwell(60 * deg))).transitions()[0],
        MotionProgram((rising, Rise(60 * deg, 12 * mm, Poly4567()))).transitions()[0],
        MotionProgram((Rise(60 * deg, 12 * mm, SimpleHarmonic()), Dwell(60 * deg))).transitions()[0],
        MotionProgram((Rise(60 * deg, 12 * mm, straight), Dwell(60 * deg))).transitions()[0],
        MotionProgram((Dwell(60 * deg), Rise(60 * deg, 12 * mm, leap))).transitions()[0],
        MotionProgram((Rise(60 * deg, 12 * mm, Poly4567()), Dwell(60 * deg))).transitions()[0],
    ]
    assert [joint.verdict for joint in said] == [
        "60°: jerk step -0.627 follower units/rad³, acceptable",
        "60°: jerk step -0.627 follower units/rad³, acceptable",
        "60°: acceleration step 0.054 follower units/rad², infinite jerk: vibration, not for a fast cam",
        "60°: velocity step -0.01146 follower units/rad, infinite acceleration: impact, forbidden",
        "60°: position step 0.006 follower units, the follower would have to leap: impact, forbidden",
        "60°: smooth",
    ]
    assert [joint.lawful for joint in said] == [True, True, False, False, False, True]


def test_half_laws_join_constant_velocity():
    straight = FreePolynomial((0,), (1,))

    def run(first, last, velocity):
        return MotionProgram((Rise(1, 1, first), Rise(1, velocity, straight), Rise(1, 1, last)))

    assert orders(run(HalfCycloidalStart(), HalfCycloidalEnd(), 2.0)) == [3, 3]
    assert orders(run(HalfHarmonicStart(), HalfHarmonicEnd(), np.pi / 2)) == [3, 3]
    assert orders(run(HalfHarmonicStart(), HalfHarmonicEnd(), 1.5)) == [1, 1]


def test_harmonic_up_and_down_without_dwells_is_smooth():
    program = MotionProgram((Rise(180 * deg, 1, SimpleHarmonic()), Return(180 * deg, 1, SimpleHarmonic())))
    assert orders(program) == [None, None]
    assert program.peaks().jerk.value == pytest.approx(0.5)


def test_a_program_of_dwells_is_smooth():
    assert orders(MotionProgram((Dwell(180 * deg), Dwell(180 * deg)))) == [None, None]


def test_joints_of_a_population_are_refused():
    with pytest.raises(ValueError, match=r"^the program is a population; joints are named for one program at a time$"):
        full_turn(Cycloidal(), np.array([[0.01], [0.02]])).transitions()


# ---------------------------------------------------------------- peaks


@pytest.mark.parametrize("law", [Cycloidal(), ModifiedTrapezoid(), Poly345(), Skewed(Cycloidal(), 0.4)], ids=str)
def test_peaks_are_those_of_the_steepest_segment(law):
    for k, (peak, stated) in enumerate(zip(full_turn(law).peaks(), law.peaks(), strict=True), start=1):
        assert peak.value == pytest.approx(0.02 * stated / (90 * deg) ** k, rel=1e-6)
        assert 0 <= peak.cam_angle <= 90 * deg


def test_peaks_lie_between_samples():
    program = full_turn(Cycloidal())
    assert program.peaks().velocity.cam_angle == pytest.approx(45 * deg, abs=1e-6)
    assert program.peaks().acceleration.value == pytest.approx(abs(program(22.5 * deg).a))


@pytest.mark.parametrize(
    ("law", "infinite"),
    [
        (SimpleHarmonic(), [False, False, True]),
        (Parabolic(), [False, False, True]),
        (FreePolynomial((0,), (1,)), [False, True, True]),
        (FreePolynomial((0.5,), (1,)), [True, True, True]),
    ],
)
def test_peaks_are_infinite_above_a_break(law, infinite):
    assert [bool(np.isinf(peak.value)) for peak in full_turn(law).peaks()] == infinite


def test_a_break_inside_a_law_is_found():
    program = MotionProgram((Rise(1.0, 1.0, Parabolic()),))
    assert program.peaks().jerk == (np.inf, pytest.approx(0.5))


def test_peaks_of_a_population():
    lift, angle = np.array([[0.01], [0.02]]), np.array([[60 * deg], [80 * deg]])
    program = MotionProgram((Rise(angle, lift, Cycloidal()), Dwell(1.0), Return(1.0, 0.001, SimpleHarmonic())))
    for i in range(2):
        alone = MotionProgram(
            (Rise(angle[i, 0], lift[i, 0], Cycloidal()), Dwell(1.0), Return(1.0, 0.001, SimpleHarmonic()))
        )
        for many, one in zip(program.peaks(), alone.peaks(), strict=True):
            assert many.value[i] == pytest.approx(one.value)
            assert many.cam_angle[i] == pytest.approx(one.cam_angle)


def test_peaks_of_a_member_that_cannot_be_are_nan():
    lift = np.array([[0.01], [np.inf], [0.02]])
    value = MotionProgram((Rise(1.0, lift, Cycloidal()), Dwell(1.0))).peaks().velocity.value
    assert value == pytest.approx([0.02, np.nan, 0.04], nan_ok=True)


# ---------------------------------------------------------------- refusals

law = Cycloidal()


@pytest.mark.parametrize(
    ("build", "sentence"),
    [
        (
            lambda: Rise(0.0, 1.0, law),
            "the angle of the rise is 0 deg; it must be a finite angle above 0 deg",
        ),
        (
            lambda: Return(-10 * deg, 1.0, law),
            "the angle of the return is -10 deg; it must be a finite angle above 0 deg",
        ),
        (
            lambda: Dwell(np.nan),
            "the angle of the dwell is nan; it must be a finite angle above 0 deg",
        ),
        (
            lambda: Dwell("wide"),
            "the angle of the dwell is 'wide'; it must be a finite angle above 0 deg",
        ),
        (
            lambda: Rise(1.0, np.inf, law),
            "the lift of the rise is inf; it must be 0 or a number of at least 1e-150 (less than 0 is a return)",
        ),
        (
            lambda: Return(1.0, 1.0, "cycloidal"),
            "the law of the return is 'cycloidal'; it must be a motion law such as Cycloidal()",
        ),
        (
            lambda: Rise(1.0, 1.0, Cycloidal),
            "the law of the rise is the class Cycloidal; it must be a motion law such as Cycloidal()",
        ),
        (
            lambda: MotionProgram(()),
            "the program is empty; it needs at least one rise, return or dwell",
        ),
        (
            lambda: MotionProgram((Dwell(1.0), law)),
            "segment 2 of the program is Cycloidal(); it must be a rise, a return or a dwell",
        ),
        (
            lambda: MotionProgram((Dwell(1.0),), start=np.nan),
            "the start of the program is nan; it must be a finite number",
        ),
        (
            lambda: MotionProgram((Dwell(200 * deg), Dwell(200 * deg))),
            "the program spans 400 deg; it can span at most 360 deg",
        ),
        (
            lambda: MotionProgram((Rise(120, 0.02, law),)),
            "the program spans 6875.49 deg; it can span at most 360 deg (the rise was given 120 rad; for degrees write "
            "120 * deg)",
        ),
        (
            lambda: MotionProgram((Rise(180 * deg, 0.02, law), Return(180 * deg, 0.015, law))),
            "the program ends 0.005 from its start after 360 deg; a full turn must come back to its start, or "
            "say by how much it is further: advance=0.005",
        ),
        (
            lambda: full_turn(law).in_time(0.0, np.nan),
            "the speed of the shaft is nan; it must be a finite number of at least 0",
        ),
        (
            lambda: full_turn(law).in_time(0.0, -1),
            "the speed of the shaft is -1; it must be a finite number of at least 0",
        ),
        (
            lambda: Return(1.0, -0.02, law),
            "the lift of the return is -0.02; it must be 0 or a number of at least 1e-150 (less than 0 is a rise)",
        ),
        (
            lambda: Rise(1.0, 0.02, lambda u: u),
            "the law a function of one's own gives one array; it must give four: s, v, a, j",
        ),
        (
            lambda: MotionProgram(5),
            "what the program is made of is 5; it must be a tuple, with a place for each segment",
        ),
        (
            lambda: MotionProgram((Dwell(np.ones((2, 1))), Dwell(np.ones((3, 1))))),
            "the MotionProgram has columns of 2 in its segments and 3 in its segments; they must be equally long",
        ),
    ],
)
def test_refusals(build, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011  the whole sentence is compared
        build()
    assert str(refusal.value) == sentence


def three(middle, law=Cycloidal()):  # noqa: B008  a frozen value
    """120 deg up, a dwell of ``middle`` and 120 deg down."""
    return MotionProgram((Rise(120 * deg, 10 * mm, law), Dwell(middle), Return(120 * deg, 10 * mm, law)))


@pytest.mark.parametrize(
    ("middle", "sentence"),
    [
        (
            119.99,
            "the program spans 359.99 deg; 0.01 deg are missing to a full turn: lengthen a segment or add a dwell",
        ),
        (
            119.9998,
            "the program spans 359.9998 deg; 0.0002 deg are missing to a full turn: lengthen a segment or add a dwell",
        ),
        (119.6, "the program spans 359.6 deg; 0.4 deg are missing to a full turn: lengthen a segment or add a dwell"),
        (120.01, "the program spans 0.01 deg more than a full turn; it can span at most 360 deg"),
        (121, "the program spans 361 deg; it can span at most 360 deg"),
    ],
)
def test_angles_that_miss_the_turn_are_named(middle, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        three(middle * deg)
    members = three(np.array([[120.0], [middle]]) * deg)(np.linspace(0, 6, 7)).s
    assert np.isfinite(members[0]).all()
    assert np.isnan(members[1]).all()


@pytest.mark.parametrize("off", [0, 1e-6, -1e-6, 5e-5, -5e-5])
def test_angles_that_were_rounded_close_the_turn(off):
    program = three((120 + off) * deg)
    assert program.periodic
    assert program.span == program.edges[-1] == 2 * np.pi
    phi = np.append(np.linspace(-20, 20, 4001), 360 * deg - 0.5 * abs(off) * deg)
    exact = three(120 * deg)(phi)
    for k, value in enumerate(program(phi)):
        scale = np.abs(exact[k]).max()
        np.testing.assert_allclose(value, exact[k], rtol=0, atol=1e-4 * scale)  # 5e-5 deg move a steep flank
    assert [joint.order for joint in program.transitions()] == [3, 3, 3]


def test_single_precision_closes_the_turn():
    program = MotionProgram(tuple(Dwell(np.float32(part * deg)) for part in (51.4, 102.8, 77.1, 128.7)))
    assert program.periodic


def test_a_part_of_a_turn_need_not_close():
    assert MotionProgram((Rise(359 * deg, 1.0, law),)).span == pytest.approx(359 * deg)
