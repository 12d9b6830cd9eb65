"""The program editor: rows and handles say the same, what is impossible is told, nothing is lost."""

import numpy as np
import pytest
from sheets import alert, do, parts, press
from try_everything import try_everything

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, edit_program, mm, rpm
from camkit.motion import LAW_MENU, ConstantVelocity, ShapedLaw
from camkit.panels.kit.parts import Button

PROGRAM = MotionProgram(
    (
        Dwell(45 * deg),
        Rise(90 * deg, 20 * mm, Cycloidal()),
        Dwell(45 * deg),
        Return(120 * deg, 20 * mm, SimpleHarmonic()),
        Dwell(60 * deg),
    )
)


@pytest.fixture
def editor():
    return edit_program(PROGRAM)


def rows(editor):
    return [(row.kind.value, row.angle.value, row.lift.value) for row in editor.rows]


def drag(editor, start, end, view=0):
    """From a cam angle (deg) and a lift (mm) to others, in a picture whose pixels are 1 deg and 0.1 mm."""
    for kind, at in (("press", start), ("drag", end), ("release", end)):
        do(editor, editor.picture, does=kind, view=view, at=at, pixel=[1.0, 0.1])


def test_rows_show_the_program(editor):
    assert rows(editor) == [("dwell", 45, 0), ("rise", 90, 20), ("dwell", 45, 0), ("return", 120, 20), ("dwell", 60, 0)]
    assert editor.program == PROGRAM


def test_a_typed_angle_changes_the_program(editor):
    editor.rows[1].angle.value, editor.rows[2].angle.value = 80, 55
    assert editor.program.edges == pytest.approx(np.array([0, 45, 125, 180, 300, 360]) * deg)


def test_segments_keep_their_names():
    named = [segment.replace(name=f"part_{k}") for k, segment in enumerate(PROGRAM.segments)]
    editor = edit_program(PROGRAM.replace(segments=tuple(named)))
    drag(editor, (135, 20), (150, 26))
    editor.rows[1].angle.value -= 5
    editor.rows[4].angle.value += 5
    editor.rows[1].kind.value = "dwell"
    editor.rows[3].kind.value = "dwell"
    assert editor.program.names == tuple(f"part_{k}" for k in range(5))
    assert editor.program != PROGRAM


def test_dragging_a_handle_sideways_moves_the_joint_and_nothing_else(editor):
    drag(editor, (135, 20), (150, 20))
    assert editor.program.edges == pytest.approx(np.array([0, 45, 150, 180, 300, 360]) * deg)
    assert editor.program.levels == pytest.approx(PROGRAM.levels)


def test_dragging_a_handle_up_lifts_the_whole_dwell(editor):
    drag(editor, (135, 20), (135, 26))
    assert editor.program.levels == pytest.approx(np.array([0, 0, 26, 26, 0, 0]) * mm)
    assert editor.program.edges == pytest.approx(PROGRAM.edges)


def test_the_level_at_the_start_of_the_turn_stays(editor):
    drag(editor, (45, 0), (50, 8))
    assert editor.program.levels == pytest.approx(PROGRAM.levels)
    assert editor.program.edges[1] == pytest.approx(50 * deg)


def test_a_joint_stops_at_its_neighbours(editor):
    drag(editor, (45, 0), (300, 0))
    assert editor.program.edges[1] == pytest.approx(134 * deg)


def test_a_drag_beside_the_handles_or_in_another_curve_moves_nothing(editor):
    drag(editor, (250, 10), (260, 15))
    drag(editor, (135, 20), (150, 20), view=1)
    assert editor.program == PROGRAM


def test_the_curves_and_handles_are_those_of_the_program(editor):
    drag(editor, (135, 20), (150, 26))
    displacement = editor.picture.shown[0]
    assert displacement["handles"].x == pytest.approx(editor.program.edges / deg)
    assert displacement["handles"].y == pytest.approx([0, 0, 26, 26, 0, 0])
    head, values = editor.numbers.text.splitlines()
    assert head == "peak velocity  peak acceleration  peak jerk"
    peak = editor.program.peaks().velocity
    assert values.startswith(f"{peak.value / mm:.5g} mm/rad at {peak.cam_angle / deg:.4g} deg  ")
    assert [row.verdict.text for row in editor.transitions] == editor.summary().splitlines()


def test_a_dwell_shows_neither_lift_nor_law(editor):
    row = editor.rows[0]
    assert [row.lift.visible, row.law.visible] == [False, False]
    do(editor, row.kind, value=row.kind.values.index("rise"))
    assert row.lift.visible
    assert row.law.visible


def test_a_number_that_is_far_too_large_is_refused_and_the_last_one_stays(editor):
    do(editor, editor.rows[1].angle, value=1e5)
    assert alert(editor) == "The angle stays as before: 100000 deg was typed; it must be at most 10000 deg."
    assert (editor.rows[1].angle.value, editor.program) == (90, PROGRAM)
    do(editor, editor.rows[1].angle, value=80.0)
    assert alert(editor) == ""


def test_an_angle_is_taken_from_the_neighbours(editor):
    do(editor, editor.rows[1].angle, value=120.0)
    assert [row.angle.value for row in editor.rows] == [45, 120, 15, 120, 60]
    assert editor.followed.text == ""  # the row below says it
    do(editor, editor.rows[1].angle, value=200.0)
    assert [row.angle.value for row in editor.rows] == [45, 200, 1, 54, 60]
    assert editor.followed.text == "Segments 2: 120 to 200 deg, 3: 15 to 1 deg, 4: 120 to 54 deg."
    assert editor.program.levels == pytest.approx(PROGRAM.levels)
    do(editor, editor.rows[4].angle, value=70.0)  # after the last comes nothing: the one before gives
    assert [row.angle.value for row in editor.rows] == [45, 200, 1, 44, 70]


def test_more_than_the_turn_has_is_refused_and_the_last_angle_stays(editor):
    do(editor, editor.rows[1].angle, value=390.0)
    most = "with at least 1 deg for each of the others it can be 356 deg"
    assert alert(editor) == f"The angle stays as before: 390 deg was typed; {most}."
    assert (editor.rows[1].angle.value, editor.program) == (90, PROGRAM)
    do(editor, editor.rows[1].angle, value=356.0)
    assert editor.program.span == pytest.approx(2 * np.pi)
    assert alert(editor) == ""
    do(editor, editor.rows[1].angle, value=-5.0)
    assert alert(editor) == "The angle stays as before: -5 deg was typed; it must be above 0 deg."


def test_a_motion_over_less_than_a_turn_uses_its_room_first():
    editor = edit_program(MotionProgram(PROGRAM.segments[1:4]))
    do(editor, editor.rows[0].angle, value=150.0)
    assert [row.angle.value for row in editor.rows] == [150, 45, 120]
    do(editor, editor.rows[0].angle, value=200.0)
    assert [row.angle.value for row in editor.rows] == [200, 40, 120]


def test_what_one_move_lifts_another_takes_back(editor):
    do(editor, editor.rows[1].lift, value=25.0)
    assert rows(editor)[3] == ("return", 120, 25)
    do(editor, editor.rows[3].lift, value=18.0)
    assert rows(editor)[1] == ("rise", 90, 18)
    do(editor, editor.rows[1].kind, value=editor.rows[1].kind.values.index("return"))
    assert [row[::2] for row in rows(editor)] == [
        ("dwell", 0),
        ("return", 18),
        ("dwell", 0),
        ("rise", 18),
        ("dwell", 0),
    ]
    assert editor.program.levels[-1] == pytest.approx(editor.program.start)


def test_followers_hear_of_every_possible_program(editor):
    heard = []
    editor.on_change(heard.append)
    editor.rows[3].law.value = Cycloidal()
    assert [p.segments[3].law for p in heard] == [Cycloidal()]


def test_the_verdict_names_a_broken_joint(editor):
    assert "180°: acceleration step -22.5 mm/rad², infinite jerk" in editor.summary()
    editor.rows[3].law.value = Cycloidal()
    assert "acceleration" not in editor.summary()


def tool(editor, k, meaning):
    """A button of a row."""
    return next(part for part in editor.rows[k].row.inside() if isinstance(part, Button) and meaning in part.tooltip)


def test_a_segment_is_put_in_copied_and_taken_out_and_the_turn_stays(editor):
    do(editor, tool(editor, 1, "insert"))
    assert [row[:2] for row in rows(editor)[1:4]] == [("rise", 60), ("dwell", 30), ("dwell", 45)]
    do(editor, tool(editor, 2, "remove"))
    assert [row[:2] for row in rows(editor)[1:4]] == [("rise", 60), ("dwell", 75), ("return", 120)]
    do(editor, tool(editor, 3, "duplicate"))
    assert rows(editor)[3:5] == [("return", 60, 10), ("return", 60, 10)]
    do(editor, tool(editor, 3, "remove"))
    assert rows(editor)[2:4] == [("dwell", 135, 0), ("return", 60, 20)]
    first = next(part for part in parts(editor, Button) if part.tooltip == "insert a segment at the start")
    do(editor, first)
    assert rows(editor)[:2] == [("dwell", 22.5, 0), ("dwell", 22.5, 0)]
    assert editor.program.span == pytest.approx(2 * np.pi)


def test_the_last_segment_cannot_be_taken_out():
    editor = edit_program(MotionProgram((Rise(90 * deg, 20 * mm, Cycloidal()), Dwell(30 * deg))))
    do(editor, tool(editor, 0, "remove"))
    assert rows(editor) == [("dwell", 30, 0)]
    assert not tool(editor, 0, "remove").visible
    do(editor, tool(editor, 0, "insert"))
    assert rows(editor) == [("dwell", 30, 0), ("dwell", 330, 0)]


def test_undo_goes_back_and_redo_forth(editor):
    assert (editor.undo.disabled, editor.redo.disabled) == (True, True)
    do(editor, editor.rows[1].angle, value=100.0)
    drag(editor, (145, 20), (150, 26))
    last = editor.program
    press(editor, "Undo")
    assert [row.angle.value for row in editor.rows] == [45, 100, 35, 120, 60]
    press(editor, "Undo")
    assert editor.program == PROGRAM
    assert editor.undo.disabled
    press(editor, "Redo")
    press(editor, "Redo")
    assert editor.program == last
    assert editor.redo.disabled
    press(editor, "Reset")
    assert editor.program == PROGRAM
    press(editor, "Undo")
    assert editor.program == last


def test_a_drag_is_one_step(editor):
    do(editor, editor.picture, does="press", view=0, at=(135, 20), pixel=[1.0, 0.1])
    for angle in range(136, 150):
        do(editor, editor.picture, does="drag", view=0, at=(angle, 20), pixel=[1.0, 0.1])
    do(editor, editor.picture, does="release", view=0, at=(150, 20), pixel=[1.0, 0.1])
    press(editor, "Undo")
    assert editor.program == PROGRAM


def test_a_law_has_its_numbers_below_it(editor):
    law = editor.rows[1].laws
    assert not law.group.visible
    names = [name for name, _ in law.menu.options]
    assert names == [law.name for law in LAW_MENU]
    do(editor, law.menu, value=names.index("constant velocity with blends"))
    assert list(law.boxes) == ["shape", "blend"]
    assert law.group.visible
    do(editor, law.boxes["blend"], value=0.4)
    do(editor, law.boxes["shape"], value=1)
    assert editor.program.segments[1].law == ConstantVelocity(0.4, "parabolic")
    do(editor, law.boxes["blend"], value=0.7)
    assert alert(editor) == ("The blend of the constant velocity law is 0.7; it must be above 0 and at most 0.5.")
    assert law.boxes["blend"].value == 0.4
    do(editor, law.menu, value=names.index("shaped"))
    do(editor, law.boxes["base"], value=2)
    do(editor, law.boxes["c1"], value=0.1)
    assert editor.program.segments[1].law == ShapedLaw(Cycloidal(), (0, 0.1, 0, 0))
    do(editor, law.menu, value=names.index("cycloidal"))
    assert not law.group.visible


def test_values_in_time_at_a_speed(editor):
    do(editor, editor.values, value=1)
    do(editor, editor.speed, value=120.0)
    omega = 120 * rpm
    velocity, jerk = editor.picture.shown[1], editor.picture.shown[3]
    assert (velocity.axes.ylabel, jerk.axes.ylabel) == ("v  [m/s]", "j  [m/s^3]")
    peak = editor.program.peaks().velocity.value
    assert max(velocity["Velocity"].y) == pytest.approx(peak * omega, rel=1e-4)
    assert f"{peak * omega:.5g} m/s at" in editor.numbers.text
    assert "180°: acceleration step -3.553 m/s², infinite jerk" in editor.transitions[2].verdict.text
    do(editor, editor.values, value=2)
    assert editor.picture.shown[0].axes.xlabel == "time  [s]"
    turn = 60 / 120
    drag(editor, (135 / 360 * turn, 20), (150 / 360 * turn, 20))
    assert editor.program.edges[2] == pytest.approx(150 * deg)
    do(editor, editor.speed, value=0.0)
    assert alert(editor) == "The speed stays as before: 0 rpm was typed; it must be from 0.001 to 1e+06 rpm."
    assert editor.speed.value == 120


def test_what_is_not_smooth_is_made_smooth(editor):
    assert editor.verdict.text == "✗ The motion is not smooth at 180°, 300°."
    assert [row.smooth.visible for row in editor.transitions] == [False, False, True, True, False]
    do(editor, editor.transitions[2].smooth)
    assert editor.verdict.text == "✓ Position, velocity and acceleration are continuous all around."
    assert editor.program.levels == pytest.approx(PROGRAM.levels)
    assert editor.program.edges == pytest.approx(PROGRAM.edges)


def test_every_control_can_be_moved(editor):
    assert try_everything(editor) > 3
    press(editor, "Reset")
    assert editor.program == PROGRAM


def test_a_row_of_a_program_that_was_replaced_is_still_removed(editor):
    """A button that is pressed while another program comes in stands for the same place."""
    remove = tool(editor, 0, "remove")
    editor.load(MotionProgram((Dwell(60 * deg), *PROGRAM.segments[1:4], Dwell(45 * deg))))
    assert rows(editor)[0] == ("dwell", 60, 0)
    do(editor, remove)
    assert rows(editor) == [("rise", 150, 20), ("dwell", 45, 0), ("return", 120, 20), ("dwell", 45, 0)]
    editor.load(PROGRAM)
    assert editor.program == PROGRAM
    assert len(editor.rows) == 5
