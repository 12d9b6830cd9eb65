"""Views of motion by their marks."""

import numpy as np
from numpy.testing import assert_allclose

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, deg, mm
from camkit.motion import Parabolic, residual_vibration
from camkit.views.laws import LAW_VIEWS, PROGRAM_VIEWS, ShownProgram, ShownVibration, vibration_left

PARABOLIC = Parabolic()
PROGRAM = MotionProgram((Rise(90 * deg, 20 * mm, PARABOLIC), Dwell(60 * deg), Return(210 * deg, 20 * mm, Cycloidal())))


def test_laws_of_one_name_are_all_drawn():
    u = np.linspace(0, 1, 1001)
    for k, view in enumerate(LAW_VIEWS):
        first, second, third = view((PARABOLIC, Cycloidal(), PARABOLIC)).marks
        assert_allclose(first.y, PARABOLIC(u)[k])
        assert_allclose(second.y, Cycloidal()(u)[k])
        assert_allclose(third.y, first.y)
        assert [first.index, second.index, third.index] == [0, 1, 2]


def test_a_program_is_drawn_in_its_unit_with_a_handle_at_every_joint():
    shown = ShownProgram(PROGRAM)
    for view, name, values in zip(
        PROGRAM_VIEWS, ("Displacement", "Velocity", "Acceleration", "Jerk"), shown.motion, strict=True
    ):
        curve = view(shown)[name]
        assert_allclose(curve.x * deg, shown.cam_angle)
        assert_allclose(curve.y * mm, values)
    handles = PROGRAM_VIEWS[0](shown)["handles"]
    assert_allclose(handles.x, [0, 90, 150, 360])
    assert_allclose(handles.y, [0, 20, 20, 0], atol=1e-12)


def test_vibration_is_drawn_in_per_cent_over_the_period_ratio():
    shown = ShownVibration((PARABOLIC, Cycloidal()))
    picture = vibration_left(shown)
    assert picture.axes.log == "xy"
    for mark, law in zip(picture.marks, shown.laws, strict=True):
        assert mark.label == law.name
        left = 100 * residual_vibration(law, shown.tau).residual
        assert_allclose(mark.y, np.maximum(left, 1e-4))
