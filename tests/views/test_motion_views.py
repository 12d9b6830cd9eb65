"""Views of motion by their marks."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, mm
from camkit.motion import Parabolic, motion_from_table, residual_vibration
from camkit.panels.program import ProgramEditor
from camkit.views import TABLE_VIEWS
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


def test_an_infinite_jerk_is_a_line_the_way_the_acceleration_jumps():
    harmonic = [Return(120 * deg, 20 * mm, SimpleHarmonic()), Dwell(60 * deg)]
    shown = ShownProgram(MotionProgram([Rise(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg), *harmonic]))
    drawn = PROGRAM_VIEWS[3](shown)
    arrows = drawn["infinite"]
    assert_allclose(arrows.x, np.repeat([180, 300], 3))
    assert [np.sign(y) for y in arrows.y[1::3]] == [-1, -1]
    assert [mark.words for mark in drawn.marks if mark.key.startswith("infinite ")] == [" ∞", " ∞"]
    smooth = MotionProgram([Rise(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg)])
    assert not [mark for mark in PROGRAM_VIEWS[3](ShownProgram(smooth)).marks if mark.role == "trouble"]


def test_vibration_is_drawn_in_per_cent_over_the_period_ratio():
    shown = ShownVibration((PARABOLIC, Cycloidal()))
    picture = vibration_left(shown)
    assert picture.axes.log == "xy"
    for mark, law in zip(picture.marks, shown.laws, strict=True):
        assert mark.label == law.name
        left = 100 * residual_vibration(law, shown.tau).residual
        assert_allclose(mark.y, np.maximum(left, 1e-4))


def test_a_table_is_drawn_before_and_after_smoothing():
    x = np.arange(360) * deg
    level = 10 * (1 - np.cos(x)) + 0.01 * np.sin(1000 * np.arange(360) ** 2)
    level[99] += 1
    motion = motion_from_table(x, level * mm, digit=1e-6 * mm)
    true = (level, 10 * np.sin(x), 10 * np.cos(x), -10 * np.sin(x))
    for k, view in enumerate(TABLE_VIEWS):
        rows, curve, bad = view(motion).marks
        assert_allclose(curve.y * mm, motion(curve.x * deg)[k], rtol=0, atol=1e-12)
        assert abs(curve.y - np.interp(curve.x, x / deg, true[k], period=360)).max() < (1.1, 0.1, 0.5, 3)[k]
        assert list(bad.x) == ([99] if k == 0 else [])
        assert np.ptp(rows.y) <= 3.2 * np.ptp(curve.y)
    assert_allclose(TABLE_VIEWS[0](motion)["rows"].y, level)
    assert len(TABLE_VIEWS[2](motion)["rows"].y) < 360  # what is far beyond the curve is not drawn


def test_differences_of_rows_are_derivatives():
    x = np.sort(np.random.default_rng(1).uniform(0, 2, 50))
    motion = motion_from_table(x, x**3 * mm)
    at = motion.row_differences(2)[0] + x[0]
    expected = {1: x[1:] ** 2 + x[1:] * x[:-1] + x[:-1] ** 2, 2: 6 * at, 3: np.full(47, 6.0)}
    for k, derivative in expected.items():
        assert_allclose(motion.row_differences(k)[1] / mm, derivative, rtol=1e-4)


def test_a_table_is_not_edited_as_a_program():
    x = np.arange(360) * deg
    with pytest.raises(ValueError, match="the program has a table; rises, returns and dwells can be edited here"):
        ProgramEditor(motion_from_table(x, (1 - np.cos(x)) * mm))
