"""Residual vibration against closed forms of the Fourier transform and against the equation of motion integrated."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from camkit.motion import (
    LAWS,
    ConstantVelocity,
    Cycloidal,
    Dwell,
    FreePolynomial,
    ModifiedTrapezoid,
    MotionProgram,
    Parabolic,
    Poly345,
    Return,
    Rise,
    SimpleHarmonic,
    Skewed,
    TableLaw,
)
from camkit.motion.vibration import residual_vibration
from camkit.units import deg, mm, rpm

TAU = np.linspace(0.13, 20.13, 161)
X = np.pi * TAU


def transform_345(tau):
    """``|int_0^1 30 u^2 (1 - u)^2 e^{i W u} du|``, by parts."""
    W = 2 * np.pi * tau
    derivatives = [(0.0, 0.0), (0.0, 0.0), (60.0, 60.0), (-360.0, 360.0), (720.0, 720.0)]
    return abs(
        sum(
            (end * np.exp(1j * W) - start) * (-1) ** k / (1j * W) ** (k + 1)
            for k, (start, end) in enumerate(derivatives)
        )
    )


CLOSED = {
    "step of constant velocity": (FreePolynomial((0,), (1,)), abs(np.sin(X) / X)),
    "parabolic": (Parabolic(), (np.sin(X / 2) / (X / 2)) ** 2),
    "simple harmonic": (SimpleHarmonic(), abs(np.cos(X) / (1 - 4 * TAU**2))),
    "cycloidal": (Cycloidal(), abs(np.sin(X) / (X * (1 - TAU**2)))),
    "3-4-5": (Poly345(), transform_345(TAU)),
}


@pytest.mark.parametrize(("law", "expected"), CLOSED.values(), ids=CLOSED)
def test_residual_vibration_without_damping_is_the_transform_of_the_velocity(law, expected):
    assert_allclose(residual_vibration(law, TAU).residual, expected, rtol=0, atol=2e-13)


def integrated(law, tau, zeta):
    """Residual and largest deviation, largest acceleration of the mass, from the differential equation."""
    W = 2 * np.pi * tau

    def falls(u, y, low=0.0, high=1.0):
        s, v, _, _ = law(np.clip(u, low + 1e-13, high - 1e-13))
        return [y[1], -2 * zeta * W * (y[1] - v) - W**2 * (y[0] - s)]

    y, during, forced, options = [0.0, 0.0], 0.0, 0.0, {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13}
    for low, high in pairwise((0.0, *law.kinks, 1.0)):
        u = np.linspace(low, high, 2001)
        x = solve_ivp(falls, (low, high), y, t_eval=u, args=(low, high), **options).y
        s, v, _, _ = law(np.clip(u, low + 1e-13, high - 1e-13))
        during = max(during, abs(x[0] - s).max())
        forced = max(forced, abs(W**2 * (x[0] - s) + 2 * zeta * W * (x[1] - v)).max())
        y = x[:, -1]
    u = np.linspace(1, 1 + 1.2 / tau, 8001)
    x = solve_ivp(lambda u, y: [y[1], -2 * zeta * W * y[1] - W**2 * (y[0] - 1)], (1, u[-1]), y, t_eval=u, **options).y
    after = abs(W**2 * (x[0] - 1) + 2 * zeta * W * x[1]).max()
    return abs(x[0] - 1).max(), during, max(forced, after)


TABLE = TableLaw((0, 0.2, 0.5, 0.8, 1), (0, 0.06, 0.5, 0.94, 1), 0)


@pytest.mark.parametrize(
    "law", [*LAWS, ConstantVelocity(0.2), Skewed(Cycloidal(), 0.35), TABLE], ids=lambda law: law.name
)
@pytest.mark.parametrize(("tau", "zeta"), [(0.6, 0.0), (3.3, 0.03), (2.2, 0.4)])
def test_vibration_is_that_of_the_equation_of_motion(law, tau, zeta):
    residual, during, acceleration = integrated(law, tau, zeta)
    found = residual_vibration(law, tau, zeta)
    assert_allclose(found.residual, residual, rtol=2e-6, atol=1e-9)
    assert_allclose(found.during, during, rtol=3e-3)
    assert_allclose(found.acceleration, acceleration, rtol=3e-3)


PROGRAMS = {
    "a full turn": (Rise(80 * deg, 20 * mm, Cycloidal()), Dwell(30 * deg), Return(110 * deg, 20 * mm, Poly345()),
                    Dwell(140 * deg)),
    "a part of a turn": (Dwell(20 * deg), Rise(60 * deg, 5 * mm, ModifiedTrapezoid()),
                         Rise(50 * deg, 8 * mm, ConstantVelocity(0.2))),
    "from above": (Return(90 * deg, 12 * mm, SimpleHarmonic()), Rise(60 * deg, 4 * mm, Cycloidal())),
}  # fmt: skip


@pytest.mark.parametrize("segments", PROGRAMS.values(), ids=PROGRAMS)
@pytest.mark.parametrize(("speed", "zeta"), [(250 * rpm, 0.02), (900 * rpm, 0.0), (900 * rpm, 0.3)])
def test_vibration_of_a_program_is_that_of_the_equation_of_motion_in_time(segments, speed, zeta):
    """Segment by segment in seconds, the mass at rest with the follower at first."""
    frequency = 2 * np.pi * 60  # rad/s
    start = 30 * mm
    program = MotionProgram(segments, start)
    options = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-13}
    x, level, during, forced = np.array([start, 0.0]), start, 0.0, 0.0
    for segment in segments:
        time = segment.angle / speed
        for low, high in pairwise((0.0, *segment.kinks, 1.0)):

            def cam(t, segment=segment, time=time, level=level, low=low, high=high):
                move = segment.motion(np.clip(t / time, low + 1e-12, high - 1e-12))
                return level + move.s, move.v * speed

            def mass(t, y, cam=cam):
                s, v = cam(t)
                return [y[1], -2 * zeta * frequency * (y[1] - v) - frequency**2 * (y[0] - s)]

            t = np.linspace(low * time, high * time, 1501)
            y = solve_ivp(mass, (t[0], t[-1]), x, t_eval=t, **options).y
            s, v = cam(t)
            during = max(during, abs(y[0] - s).max())
            forced = max(forced, abs(2 * zeta * frequency * (y[1] - v) + frequency**2 * (y[0] - s)).max())
            x = y[:, -1]
        level = level + segment.change
    t = np.linspace(0, 1.2 * 2 * np.pi / frequency, 8001)
    y = solve_ivp(
        lambda t, y: [y[1], -2 * zeta * frequency * y[1] - frequency**2 * (y[0] - level)], (0, t[-1]), x, t_eval=t,
        **options,
    ).y  # fmt: skip
    after = abs(2 * zeta * frequency * y[1] + frequency**2 * (y[0] - level)).max()
    found = residual_vibration(program, program.span / speed * frequency / (2 * np.pi), zeta)
    assert_allclose(found.residual, abs(y[0] - level).max(), rtol=2e-6, atol=1e-11)
    assert_allclose(found.during, during, rtol=3e-3)
    assert_allclose(found.acceleration, max(forced, after) * (program.span / speed) ** 2, rtol=3e-3)


def test_the_vibration_of_one_rise_is_the_laws():
    rise = MotionProgram((Rise(100 * deg, 3.0, Skewed(Cycloidal(), 0.4)),))
    of_law = residual_vibration(Skewed(Cycloidal(), 0.4), TAU, 0.03)
    for whole, share in zip(residual_vibration(rise, TAU, 0.03), of_law, strict=True):
        assert_allclose(whole, 3 * share, rtol=1e-9, atol=1e-11)


def test_a_program_of_a_population_that_cannot_be_has_no_vibration():
    angle = np.array([[60.0], [-5.0], [90.0]]) * deg
    many = residual_vibration(MotionProgram((Rise(angle, 0.02, Cycloidal()), Dwell(30 * deg))), [1.5, 3.0])
    for i in (0, 2):
        one = residual_vibration(MotionProgram((Rise(angle[i, 0], 0.02, Cycloidal()), Dwell(30 * deg))), [1.5, 3.0])
        assert_allclose(many.residual[i], one.residual, rtol=1e-9, atol=1e-12)
    assert np.isnan(many.residual[1]).all()


def test_what_does_not_move_has_no_residual_vibration():
    with pytest.raises(ValueError, match=r"^residual vibration is that of a motion law or of a motion program, not "):
        residual_vibration("cycloidal", 1.0)


def test_a_fast_rise_is_a_step_and_a_slow_one_is_followed():
    """Much faster than the natural period the mass stays behind by the whole lift; much slower it moves as the law."""
    for law in LAWS:
        fast, slow = residual_vibration(law, 0.001), residual_vibration(law, 60.0)
        assert_allclose([fast.residual, fast.during], 1, rtol=1e-4)
        assert slow.residual < 1e-3
        if law.continuity >= 2:
            assert_allclose(slow.acceleration, law.peaks().Ca, rtol=0.05)
    harmonic = residual_vibration(SimpleHarmonic(), 60.0)
    assert_allclose(harmonic.acceleration, 2 * SimpleHarmonic().peaks().Ca, rtol=0.01)  # its jump, overshot twofold


@pytest.mark.parametrize("law", [law for law in LAWS if law.name != "parabolic"], ids=lambda law: law.name)
def test_smoother_laws_leave_less_when_slow(law):
    """The classical reason to choose a law: twice as slow leaves half as much for each smooth derivative."""
    slow, slower = (residual_vibration(law, tau * np.linspace(20, 22, 81)).residual.max() for tau in (1, 2))
    assert_allclose(slow / slower, 2 ** (law.continuity + 1), rtol=0.1)


def test_damping_leaves_less():
    falling = [residual_vibration(Cycloidal(), TAU, zeta).residual.max() for zeta in (0, 0.05, 0.2, 0.6)]
    assert (np.diff(falling) < 0).all()


def test_shapes_of_numbers_ratios_and_populations():
    single = residual_vibration(Cycloidal(), 1.5)
    assert [np.shape(part) for part in single] == [(), (), ()]
    row = residual_vibration(Cycloidal(), [0.5, 1.5])
    assert_allclose([part[1] for part in row], single, rtol=1e-3)
    inflections = np.array([[0.4], [0.5], [0.6]])
    many = residual_vibration(Skewed(Cycloidal(), inflections), [0.5, 1.5, 3.7])
    for i, x in enumerate(inflections[:, 0]):
        assert_allclose(
            [part[i] for part in many], residual_vibration(Skewed(Cycloidal(), x), [0.5, 1.5, 3.7]), rtol=1e-3
        )
    assert many.residual.shape == (3, 3)
    one = residual_vibration(Skewed(Cycloidal(), 0.4), [0.5, 1.5, 3.7]).residual
    assert_allclose(many.residual[0], one, rtol=1e-10)


@pytest.mark.parametrize("tau", [0.0, -1.0, np.nan, [1.0, np.inf]])
def test_a_ratio_that_cannot_be_is_refused(tau):
    sentence = "the period ratio tau holds a value that is not a finite number above 0; it must be that"
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        residual_vibration(Cycloidal(), tau)


@pytest.mark.parametrize("damping", [-0.1, 1.0, np.nan])
def test_a_damping_that_cannot_be_is_refused(damping):
    with pytest.raises(ValueError, match=f"^the damping ratio is {damping:g}; it must be at least 0 and below 1$"):
        residual_vibration(Cycloidal(), 1.0, damping)
