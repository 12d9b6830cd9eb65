"""A function of one's own as a law: what it gives, how it is called, and what is said at once of one that is none."""

import numpy as np
import pytest

from camkit import Cycloidal, MotionProgram, Poly345, Return, Rise, TranslatingRollerCam, deg, mm
from camkit.motion import Dwell, EighthOrder, Kinematics, UserLaw
from camkit.quantities import choices_of, value_of, with_quantities

U = np.linspace(0, 1, 31)


def half_sine_ramp(u):
    """The cycloidal law, by hand."""
    x = 2 * np.pi * u
    return u - np.sin(x) / (2 * np.pi), 1 - np.cos(x), 2 * np.pi * np.sin(x), 4 * np.pi**2 * np.cos(x)


def steps(u):
    """Constant acceleration, by hand."""
    early, x = u < 0.5, 1 - u
    return np.where(early, 2 * u**2, 1 - 2 * x**2), np.where(early, 4 * u, 4 * x), np.where(early, 4.0, -4.0), 0.0


steps.kinks = (0.5,)


def test_a_function_is_a_law_with_its_name():
    law = UserLaw(half_sine_ramp)
    assert law.name == "half sine ramp"
    assert UserLaw(half_sine_ramp, " my law ").name == "my law"
    assert UserLaw(lambda u: Poly345()(u)).name == "a function of one's own"
    assert law.continuity == 2
    assert law.peaks() == pytest.approx(Cycloidal().peaks(), rel=1e-9)
    for given, right in zip(law(U), Cycloidal()(U), strict=True):
        np.testing.assert_allclose(given, right, atol=1e-12)
    assert law == UserLaw(half_sine_ramp) != UserLaw(half_sine_ramp, "another")


def test_a_constant_is_as_long_as_the_rest_and_kinks_are_known():
    law = UserLaw(steps)
    assert all(part.shape == U.shape for part in law(U))
    assert (law.kinks, law.continuity) == ((0.5,), 1)
    program = MotionProgram((Rise(1.0, 2.0, steps),))
    assert program.peaks().jerk.value == np.inf
    assert program.peaks().acceleration.value == pytest.approx(8.0)


def test_a_rise_makes_a_law_of_a_function():
    rise = Rise(1.0, 0.02, half_sine_ramp)
    assert rise.law == UserLaw(half_sine_ramp)
    assert rise == Rise(1.0, 0.02, half_sine_ramp)
    cam = with_quantities(TranslatingRollerCam(), {"motion.rise.law": half_sine_ramp})
    assert choices_of(cam)["motion.rise.law"].text(value_of(cam, "motion.rise.law")) == "half sine ramp"
    right = with_quantities(TranslatingRollerCam(), {"motion.rise.law": Cycloidal()})
    np.testing.assert_allclose(cam.analyse(61).pressure_angle, right.analyse(61).pressure_angle, atol=1e-12)


def test_a_program_of_it_is_its_own_to_the_last_digit():
    rise, back = Rise(90 * deg, 20 * mm, half_sine_ramp), Return(90 * deg, 20 * mm, UserLaw(half_sine_ramp, "x"))
    mine = MotionProgram((rise, Dwell(90 * deg), back, Dwell(90 * deg)))
    assert all(joint.lawful for joint in mine.transitions())
    with np.errstate(all="raise"):
        assert np.isfinite(mine(np.linspace(0, 7, 99)).j).all()


def wrong(change):
    """A law of which something is not right."""

    def my_law(u):
        return change(u, *Cycloidal()(u))

    return my_law


@pytest.mark.parametrize(
    ("function", "sentence"),
    [
        (lambda u, s, v, a, j: s, "the law my law gives one array; it must give four: s, v, a, j"),
        (lambda u, s, v, a, j: (s, v), "the law my law gives 2 arrays; it must give four: s, v, a, j"),
        (lambda u, s, v, a, j: (s, v[:3]), "the law my law gives 2 arrays; it must give four: s, v, a, j"),
        (lambda u, s, v, a, j: (s, v, a, j, j), "the law my law gives 5 arrays; it must give four: s, v, a, j"),
        (
            lambda u, s, v, a, j: 1.0,
            "the law my law gives 1; it must give four: s, v, a, j",
        ),
        (lambda u, s, v, a, j: (s[:5], v, a, j), "the law my law gives 5 values of s for 97 shares; it must give one"),
        (lambda u, s, v, a, j: (s, v, a, np.ones(4)), "the law my law gives 4 values of j for 97 shares; it must give"),
        (lambda u, s, v, a, j: (s, v, a, "none"), "the j of the law my law must be numbers; given is 'none'"),
        (lambda u, s, v, a, j: (s, v, a, u[200]), "the law my law cannot be computed: IndexError: index 200 is out of"),
        (lambda u, s, v, a, j: (20 * s, v, a, j), "the law my law runs from 0 to 20; it must run from 0 to 1"),
        (lambda u, s, v, a, j: (1 - s, v, a, j), "the law my law runs from 1 to 0; it must run from 0 to 1"),
        (lambda u, s, v, a, j: (s, np.pi * v, a, j), "the v of the law my law is not the derivative of its s: at u = "),
        (lambda u, s, v, a, j: (s, v, -a, j), "the a of the law my law is not the derivative of its v: at u = "),
        (lambda u, s, v, a, j: (s, v, a, a), "the j of the law my law is not the derivative of its a: at u = "),
        (lambda u, s, v, a, j: (s, v, a, np.nan * j), "the j of the law my law is not the derivative of its a: at u"),
        (lambda u, s, v, a, j: (s, 0 * v, a, j), "the v of the law my law is not the derivative of its s: at u = "),
    ],
)
def test_what_is_no_law_is_said_at_once(function, sentence):
    for make in (UserLaw, lambda law: Rise(1.0, 0.02, law)):
        with pytest.raises(ValueError) as refusal:  # noqa: PT011  its beginning is compared
            make(wrong(function))
        assert str(refusal.value).startswith(sentence)


def test_the_slope_is_told_beside_a_wrong_derivative():
    with pytest.raises(ValueError, match=r"at u = 0\.03 it is 0\.05001, and the slope of s is 0\.01771$"):
        UserLaw(wrong(lambda u, s, v, a, j: (s, v + 0.0323, a, j)))


@pytest.mark.parametrize("law", [Poly345(), EighthOrder(), UserLaw(steps)], ids=lambda law: law.name)
def test_a_law_of_camkit_is_a_law_as_a_function_too(law):
    assert UserLaw(lambda u: Kinematics(*law(u)))(0.3) == pytest.approx(law(0.3))


def test_what_is_no_function_is_refused():
    for given in (3, "u", Cycloidal):
        with pytest.raises(ValueError, match=r"^the function of the law is .*; it must be a function of u$"):
            UserLaw(given)
    with pytest.raises(ValueError, match=r"^the name of the law is 3; it must be a text$"):
        UserLaw(steps, 3)
    with pytest.raises(
        ValueError, match=r"^the law of the return is 3; it must be a motion law such as Cycloidal\(\)$"
    ):
        Return(1.0, 0.1, 3)
