"""The program editor where transitions are matched: conditions, constant velocity, the rest of the turn, points."""

import numpy as np
import pytest
from sheets import alert, do, downloaded, parts, press, upload
from try_everything import try_everything

from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, edit_program, mm, rpm
from camkit.files import from_json
from camkit.motion import Boundary, MatchedProgram, OpenMove, Polynomial, ShapedLaw, Through, Uniform
from camkit.panels.kit.inputs import Copy
from camkit.panels.kit.parts import Button
from camkit.panels.kit.program_code import code_of
from camkit.units import inch

VELOCITY = 22 * inch / (58 * rpm)
CONVEYOR = MatchedProgram(
    (Polynomial(60 * deg), Uniform(VELOCITY, 1.1 * inch), Polynomial(), Dwell(60 * deg)),
)
SMOOTH = "✓ Position, velocity and acceleration are continuous all around."


@pytest.fixture
def editor():
    return edit_program(CONVEYOR)


def condition(editor, transition, letter):
    """A condition of the transition behind a segment."""
    return editor.transitions[transition].boundary.conditions["svaj".index(letter)]


def want(editor, transition, letter, wanted):
    """Choose what holds at a transition."""
    menu = condition(editor, transition, letter).menu
    do(editor, menu, value=menu.values.index(wanted))


def kind(editor, k, name):
    """Make a segment another kind."""
    do(editor, editor.rows[k].kind, value=editor.rows[k].kind.values.index(name))


def seen(editor, k):
    """What stands in the columns of a row: boxes as numbers, what follows as words."""
    row = editor.rows[k]
    cells = [[part for part in cell.inside() if part.visible] for cell in row.row.children[1:3]]
    return [
        getattr(cell[-1], "text", None) or getattr(cell[-1], "value", None) if len(cell) > 1 else None for cell in cells
    ]


def test_the_conveyor_says_what_is_given_and_what_follows(editor):
    assert [row.kind.value for row in editor.rows] == ["polynomial", "constant velocity", "polynomial", "dwell"]
    assert [seen(editor, k) for k in range(4)] == [
        [60, "47.81 mm"],
        ["17.4 deg", 27.94],
        ["222.6 deg", "-75.75 mm"],
        [60, None],
    ]
    assert editor.rows[1].velocity.value == pytest.approx(VELOCITY / mm)
    assert [row.note.text for row in editor.rows] == ["", "", "closes the turn", ""]
    assert editor.rest.value == 2
    assert editor.verdict.text == SMOOTH
    assert [row.boundary.group.visible for row in editor.transitions] == [True] * 4
    assert [[c.menu.value for c in row.boundary.conditions] for row in editor.transitions] == [
        *[["match", "match", "match", "free"]] * 3,
        ["value", "match", "match", "free"],
    ]


def test_a_segment_5_deg_longer_leaves_every_transition_smooth(editor):
    do(editor, editor.rows[0].angle, value=65.0)
    assert [row.angle.value if row.angle.visible else seen(editor, k)[0] for k, row in enumerate(editor.rows)] == [
        65, "17.4 deg", "217.6 deg", 60
    ]  # fmt: skip
    assert editor.verdict.text == SMOOTH
    assert all(transition.lawful for transition in editor.program.transitions())
    assert editor.program.levels[1] / mm == pytest.approx(51.582145, abs=1e-5)  # spec, computed by two other methods
    press(editor, "Undo")
    assert editor.program == CONVEYOR


def test_the_velocity_is_typed_as_it_is_at_the_speed(editor):
    do(editor, editor.values, value=1)
    do(editor, editor.speed, value=58.0)
    assert (editor.rows[1].velocity.value, editor.rows[1].velocity.unit) == (pytest.approx(0.5588), "m/s")
    do(editor, editor.rows[1].velocity, value=0.6)
    assert editor.program.parts[1].velocity == pytest.approx(0.6 / (58 * rpm))
    assert editor.verdict.text == SMOOTH


def test_an_editor_begins_in_time_at_a_speed():
    editor = edit_program(CONVEYOR, speed=58 * rpm)
    assert editor.rows[1].velocity.value == pytest.approx(0.5588)
    with pytest.raises(ValueError, match="the speed of the shaft is 0; it must be a number from"):
        edit_program(CONVEYOR, speed=0.0)


def test_of_a_constant_velocity_one_number_follows(editor):
    row = editor.rows[1]
    do(editor, row.follows, value=row.follows.values.index("travel"))
    part = editor.program.parts[1]
    assert (part.velocity, part.travel) == (pytest.approx(VELOCITY), None)
    assert part.angle == pytest.approx(17.4 * deg)
    do(editor, row.angle, value=20.0)
    assert seen(editor, 1) == [20, f"{VELOCITY * 20 * deg / mm:.5g} mm"]
    do(editor, row.follows, value=row.follows.values.index("velocity"))
    do(editor, row.lift, value=40.0)
    assert float(editor.program(70 * deg).v) == pytest.approx(40 * mm / (20 * deg))


def test_what_holds_at_a_transition_is_matched_free_or_a_value(editor):
    assert editor.program.order == 3
    want(editor, 0, "j", "match")
    assert editor.program.order == 4
    press(editor, "Undo")
    want(editor, 0, "a", "free")
    assert "60°: acceleration step" in editor.transitions[0].verdict.text
    assert editor.verdict.text == "✗ The motion is not smooth at 60°."
    do(editor, editor.transitions[0].smooth)
    assert editor.verdict.text == SMOOTH
    want(editor, 3, "s", "value")
    do(editor, condition(editor, 3, "s").box, value=12.5)
    assert editor.program.start == pytest.approx(12.5 * mm)
    assert editor.program.boundaries[0] == Boundary(s=12.5 * mm)


def test_values_at_a_transition_are_in_time_at_the_speed(editor):
    want(editor, 0, "v", "value")
    box = condition(editor, 0, "v").box
    assert (box.value, box.unit) == (pytest.approx(VELOCITY / mm, rel=1e-5), "mm/rad")
    do(editor, editor.values, value=1)
    do(editor, editor.speed, value=58.0)
    assert (box.value, box.unit) == (pytest.approx(0.5588, rel=1e-5), "m/s")


def test_conditions_that_contradict_each_other_wait_for_the_next(editor):
    told = []
    editor.on_change(told.append)
    want(editor, 0, "v", "value")
    told.clear()
    do(editor, condition(editor, 0, "v").box, value=100.0)
    assert alert(editor).startswith("The conditions contradict each other: the velocity where segment 2 begins follows")
    assert not editor.picture.visible
    assert condition(editor, 0, "v").box.value == pytest.approx(100)
    assert (told, editor.program.levels) == ([], CONVEYOR.levels)
    do(editor, editor.rows[1].velocity, value=100.0)
    assert alert(editor) == ""
    assert editor.picture.visible
    assert float(editor.program(65 * deg).v) == pytest.approx(100 * mm)
    press(editor, "Undo")
    press(editor, "Undo")
    assert editor.verdict.text == SMOOTH


def test_a_program_of_laws_becomes_one_that_matches():
    segments = (
        Dwell(60 * deg),
        Rise(90 * deg, 20 * mm, Cycloidal()),
        Dwell(60 * deg),
        Return(90 * deg, 20 * mm, Cycloidal()),
    )
    editor = edit_program(MotionProgram((*segments, Dwell(60 * deg))))
    assert not any(row.boundary.group.visible for row in editor.transitions)
    kind(editor, 2, "constant velocity")
    assert isinstance(editor.draft.parts[2], Uniform)
    assert editor.program(150 * deg).s == pytest.approx(20 * mm)  # what does not move yet stays where it was
    do(editor, editor.rows[2].velocity, value=15.0)
    assert editor.verdict.text == SMOOTH
    assert float(editor.program(180 * deg).v) == pytest.approx(15 * mm)
    assert editor.program.levels[1] == editor.program.levels[-1] == pytest.approx(0)
    for _ in range(2):
        press(editor, "Undo")
    assert editor.program == editor.start
    kind(editor, 1, "open lift")
    assert isinstance(editor.program.parts[1], OpenMove)
    assert editor.program.levels[2] == pytest.approx(20 * mm)
    kind(editor, 1, "rise")
    assert isinstance(editor.program.parts[1], Rise)


def test_a_lift_that_follows_and_a_place_are_0_where_they_are_rounding():
    editor = edit_program(
        MotionProgram((Rise(180 * deg, 20 * mm, Cycloidal()), Return(180 * deg, 20 * mm, Cycloidal())))
    )
    assert [cell.partition(" at ")[2] for cell in editor.numbers.rows[0]] == ["90 deg", "45 deg", "0 deg"]
    kind(editor, 0, "polynomial")
    want(editor, 0, "s", "match")
    assert [seen(editor, k)[1] for k in range(2)] == ["0 mm", "0 mm"]


def test_two_rises_are_made_to_pass_through_their_transition():
    law = SimpleHarmonic()
    moves = Rise(90 * deg, 10 * mm, law), Rise(60 * deg, 15 * mm, Cycloidal()), Return(90 * deg, 25 * mm, Cycloidal())
    editor = edit_program(MotionProgram((*moves, Dwell(120 * deg))))
    do(editor, editor.transitions[0].smooth)
    assert editor.transitions[0].smooth.visible is False


def test_points_inside_a_polynomial(editor):
    row = editor.rows[2]
    do(editor, row.add_point)
    (point,) = editor.program.parts[2].through
    assert point.angle == pytest.approx(111.3 * deg)
    there = float(editor.program(77.4 * deg + point.angle).s)
    assert there == pytest.approx(float(CONVEYOR(188.7 * deg).s), abs=0.01 * mm)  # where it went before, rounded
    do(editor, row.points[0].place, value=100.0)
    do(editor, row.points[0].conditions[0].box, value=110.0)
    do(editor, row.points[0].conditions[1].menu, value=1)
    assert alert(editor) == ""
    (point,) = editor.program.parts[2].through
    assert (point.angle, point.s) == (pytest.approx(100 * deg), pytest.approx(110 * mm))
    assert point.v is not None
    do(editor, row.form, value=1)
    assert editor.program.parts[2].form == "spline"
    do(editor, row.points[0].conditions[1].menu, value=0)
    do(editor, row.points[0].conditions[0].menu, value=0)
    assert alert(editor) == "A condition inside a part gives nothing; it must give s, v or a."
    assert row.points[0].conditions[0].menu.value == "value"
    drop = next(part for part in row.points[0].group.inside() if isinstance(part, Button))
    do(editor, drop)
    assert editor.program.parts[2].through == ()
    assert not row.below.visible


def test_a_point_shown_beyond_an_overshoot_offers_the_other_form():
    lobe = Polynomial(150 * deg, (Through(0.4, s=20 * mm),))
    editor = edit_program(MatchedProgram((lobe, Dwell(210 * deg))))
    assert "overshoots by" in "".join(part.text for part in editor.remarks.group.inside() if hasattr(part, "text"))
    press(editor, "Use the spline")
    assert editor.program.parts[0].form == "spline"


def test_the_rest_of_the_turn_is_another_segments(editor):
    do(editor, editor.rest, value=editor.rest.values.index(3))
    assert [row.note.text for row in editor.rows] == ["", "", "", "closes the turn"]
    do(editor, editor.rows[2].angle, value=230.0)
    assert seen(editor, 3)[0] == "52.6 deg"
    assert editor.program.starts[3] == pytest.approx(307.4 * deg)


def test_a_handle_is_dragged_and_the_constant_velocity_stays(editor):
    for does, at in (("press", (77.4, 75.75)), ("drag", (90, 75)), ("release", (90, 75))):
        do(editor, editor.picture, does=does, view=0, at=at, pixel=[1.0, 0.5])
    assert editor.program.starts[2] == pytest.approx(90 * deg)
    assert editor.program.segments[1].angle == pytest.approx(17.4 * deg)
    assert editor.verdict.text == SMOOTH
    press(editor, "Undo")
    assert editor.program == CONVEYOR


def test_segments_of_a_matched_program_come_and_go(editor):
    tools = {part.tooltip: part for part in editor.rows[2].row.inside() if isinstance(part, Button)}
    do(editor, tools["duplicate this segment"])
    assert [row.kind.value for row in editor.rows] == ["polynomial", "constant velocity", *["polynomial"] * 2, "dwell"]
    assert editor.program.starts[3] == pytest.approx((77.4 + 111.3) * deg)
    assert editor.verdict.text == SMOOTH
    do(editor, editor.rows[3].remove)
    assert editor.program.starts == pytest.approx(CONVEYOR.starts)
    do(editor, tools["insert a segment after this one"])
    assert editor.program.span == pytest.approx(2 * np.pi)
    assert len(editor.rows) == 5
    do(editor, editor.rows[1].remove)
    assert [row.kind.value for row in editor.rows] == [*["polynomial"] * 3, "dwell"]
    assert editor.program.span == pytest.approx(2 * np.pi)


def test_a_motion_of_less_than_a_turn_has_conditions_at_both_ends():
    editor = edit_program(
        MatchedProgram((Polynomial(90 * deg),), (Boundary(0.0, 0.0, 0.0), Boundary(20 * mm, 0.0, 0.0)))
    )
    assert editor.first.row.visible
    want(editor, 0, "v", "free")
    assert isinstance(editor.program.boundaries[1].v, str)


def test_every_control_of_a_matched_program_can_be_moved(editor):
    assert try_everything(editor) > 10
    press(editor, "Reset")
    assert editor.program == CONVEYOR


def test_a_program_is_saved_and_opened(editor):
    do(editor, editor.rows[0].angle, value=65.0)
    text = downloaded(editor, "Save")["text"]
    assert from_json(text) == editor.program
    press(editor, "Reset")
    upload(editor, "Open", text)
    assert editor.program.starts[1] == pytest.approx(65 * deg)
    upload(editor, "Open", "{")
    assert alert(editor)
    assert editor.program.starts[1] == pytest.approx(65 * deg)
    press(editor, "Undo")  # what was opened is a step, too
    assert editor.program == CONVEYOR


def test_a_table_at_whole_degrees_and_the_rows_of_a_controller():
    up, back = Rise(120 * deg, 20 * mm, Cycloidal()), Return(120 * deg, 20 * mm, Cycloidal())
    editor = edit_program(MotionProgram((up, Dwell(60 * deg), back, Dwell(60 * deg))))
    lines = downloaded(editor, "Table")["text"].splitlines()
    assert lines[0].startswith("cam angle [deg],s [mm],v [mm/rad]")
    row = [float(cell) for cell in lines[61].split(",")]
    assert (len(lines), row[:4]) == (362, pytest.approx([60, 10, 19.0986, 0], abs=1e-4))
    do(editor, editor.files.comma, value=1)
    names = [name for name, _ in editor.files.kind.options]
    do(editor, editor.files.kind, value=names.index("controller, poly5"))
    lines = downloaded(editor, "Table")["text"].splitlines()
    assert lines[0] == "X [deg];Y [mm];V [mm/deg];A [mm/deg^2];way"
    assert lines[61].startswith("60;10;0,3333")
    assert "a controller with poly5 is within" in editor.followed.text


@pytest.mark.parametrize(
    "program",
    [
        CONVEYOR,
        MotionProgram(
            (Rise(120 * deg, 20 * mm, ShapedLaw(Cycloidal(), (0.1, 0, 0, 0))), Dwell(60 * deg)), start=3 * mm
        ),
        MatchedProgram((Polynomial(150 * deg, (Through(0.4, s=20 * mm, v=0.0),), "spline"), Dwell(210 * deg))),
    ],
)
def test_code_makes_the_same_program(program):
    made = {}
    exec(code_of(program, "mm"), made)
    angle = np.linspace(0, float(program.span), 50)
    assert np.allclose(made["program"](angle), program(angle), rtol=1e-9, atol=1e-12)


def test_code_is_copied(editor):
    button = next(part for part in parts(editor, Copy))
    sent = []
    button.send = sent.append
    do(editor, button)
    assert sent[0]["copy"].startswith("from camkit.motion import")
    assert editor.followed.text == "The program is copied as lines of Python."


def test_what_has_no_name_is_not_copied_as_code():
    class HomeMadeLaw(Cycloidal):
        """One that nobody exports."""

    editor = edit_program(MotionProgram((Rise(120 * deg, 20 * mm, HomeMadeLaw()), Dwell(60 * deg))))
    do(editor, next(part for part in parts(editor, Copy)))
    assert "HomeMadeLaw has no name in camkit.motion" in alert(editor)
