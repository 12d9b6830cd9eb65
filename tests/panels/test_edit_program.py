"""The program editor: rows and handles say the same, what is impossible is told, nothing is lost."""

import numpy as np
import pytest
from sheets import alert, do, parts, press
from try_everything import try_everything

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, edit_program, mm
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
    assert [line.split("  ")[0] for line in editor.numbers.text.splitlines()] == [
        "peak", "velocity", "acceleration", "jerk"
    ]  # fmt: skip
    assert editor.verdicts.text == editor.summary()


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


def test_an_impossible_program_is_told_and_the_last_one_kept(editor):
    editor.rows[1].angle.value = 200
    assert "the program spans 470 deg; it can span at most 360 deg" in alert(editor)
    assert editor.program == PROGRAM
    assert [part.visible for part in (editor.picture, editor.numbers, editor.verdicts)] == [False] * 3
    editor.rows[1].angle.value = 90
    assert alert(editor) == ""


def test_followers_hear_of_every_possible_program(editor):
    heard = []
    editor.on_change(heard.append)
    editor.rows[3].law.value = Cycloidal()
    assert [p.segments[3].law for p in heard] == [Cycloidal()]


def test_the_verdict_names_a_broken_joint(editor):
    assert "180°: acceleration step -22.5 mm/rad², infinite jerk" in editor.summary()
    editor.rows[3].law.value = Cycloidal()
    assert "acceleration" not in editor.summary()


def test_segments_are_added_and_removed(editor):
    remove = [button for button in parts(editor, Button) if button.description == "Remove"]
    remove[-1].click()
    assert editor.program.span == pytest.approx(300 * deg)
    press(editor, "Add a segment")
    assert rows(editor)[-1] == ("dwell", pytest.approx(60), 0)


def test_every_control_can_be_moved(editor):
    assert try_everything(editor) > 3
    assert editor.program == PROGRAM


def test_a_row_of_a_program_that_was_replaced_is_still_removed(editor):
    """A button that is pressed while another program comes in stands for the same place."""
    remove = next(p for p in editor.rows[0].row.inside() if isinstance(p, Button))
    editor.load(MotionProgram((Dwell(60 * deg), *PROGRAM.segments[1:4], Dwell(45 * deg))))
    assert rows(editor)[0] == ("dwell", 60, 0)
    do(editor, remove)
    assert rows(editor) == [("rise", 90, 20), ("dwell", 45, 0), ("return", 120, 20), ("dwell", 45, 0)]
    editor.load(PROGRAM)
    assert editor.program == PROGRAM
    assert len(editor.rows) == 5
