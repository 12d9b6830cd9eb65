"""Programs of G-code: what they say, and that they are read back before they are given away."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam, deg, inch, mm, um
from camkit.cam import ConjugatePair
from camkit.files import Blank, Milling, TitleBlock, write_gcode
from camkit.files.workshop.gcode import comment, gcode
from camkit.files.workshop.nc import CLOCKWISE, COUNTER, LINE, RAPID, moves
from camkit.files.workshop.readback import Wanted, deviation, passes
from camkit.files.workshop.toolpath import tool_path

PLATE = TranslatingRollerCam(groove=False)
DONE = gcode(PLATE, tool_radius=6 * mm, step_down=5 * mm)
PROGRAM = DONE.data.decode()


def turns(program):
    """By what angle (rad) each pass goes around the axis, counter-clockwise > 0."""
    for each in passes(program):
        around = np.unwrap(np.arctan2(*each.way.points(8)[::-1]))
        yield around[-1] - around[0]


def code(program):
    """The lines that are no comments."""
    return [line for line in program.splitlines() if not line.startswith("(")]


# ---------------------------------------------------------------- the small interpreter


def test_moves_in_inches():
    line, arc = moves("G20 G17 G90 G91.1\nG0 X0 Y0 Z.5\nG1 X1. F10.\nG2 X2. Y-1. I0. J-1.\nM2\nG0 X9.")
    assert (line.kind, arc.kind) == (LINE, CLOCKWISE)
    assert np.allclose(line.end, [inch, 0, inch / 2])
    assert line.feed == pytest.approx(10 * inch / 60)
    assert arc.bulge == pytest.approx(-np.tan(np.pi / 8))
    assert arc.mismatch == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("sweep", [10, 90, 180, 270, 359, 360])
def test_the_sweep_of_an_arc(sweep):
    t = sweep * deg
    ends = f"X{10 * np.cos(t):.9f} Y{10 * np.sin(t):.9f} I-10. J0."
    (arc,) = moves(f"G21\nG0 X10. Y0. Z0.\nG3 {ends}")
    assert arc.kind == COUNTER
    assert 4 * np.arctan(arc.bulge) == pytest.approx(t, abs=1e-8)
    (arc,) = moves(f"G21\nG0 X10. Y0. Z0.\nG2 {ends}")
    assert -4 * np.arctan(arc.bulge) == pytest.approx(2 * np.pi - t if sweep < 360 else t, abs=1e-8)


def test_an_arc_that_misses_its_end_is_seen():
    (arc,) = moves("G21\nG0 X10. Y0. Z0.\nG3 X0. Y10.001 I-10. J0.")
    assert arc.mismatch == pytest.approx(1 * um)


@pytest.mark.parametrize("line", ["G41 X1.", "G0 X1. X2.", "G1 X=1", "G0 X#1", "G0 X1. (a", "O100 SUB", "G0 X1. ; no"])
def test_what_is_not_read(line):
    with pytest.raises(ValueError, match="the program"):
        list(moves(f"G21\n{line}\n"))


# ---------------------------------------------------------------- the program


def test_a_program_keeps_the_tolerance_and_says_so():
    assert 0 < DONE.deviation <= 1 * um
    assert DONE.what == f"LinuxCNC, 2 passes of {PROGRAM.count('G2 ') // 2 + PROGRAM.count('G3 ') // 2} arcs, " + (
        "tool of radius 6 mm"
    )
    assert DONE.remarks == ()


@pytest.mark.parametrize("tolerance", [0.5, 5, 50])
def test_a_wider_tolerance_takes_fewer_arcs(tolerance):
    made = gcode(PLATE, tool_radius=6 * mm, tolerance=tolerance * um, step_down=10 * mm)
    assert made.deviation <= tolerance * um
    arcs = made.data.decode().count("G2 ")
    assert arcs < PROGRAM.count("G2 ") / 2 if tolerance > 1 else arcs > PROGRAM.count("G2 ") / 2


def test_all_passes_in_order():
    made = list(passes(PROGRAM))
    assert [each.level for each in made] == pytest.approx([-5 * mm, -10 * mm])
    assert all(each.feeds == pytest.approx((300 * mm / 60,)) for each in made)
    (*_, blank) = passes(gcode(PLATE, blank=Blank(thickness=7 * mm)).data.decode())
    assert blank.level == pytest.approx(-7 * mm)
    (*_, groove) = passes(
        gcode(TranslatingRollerCam(), tool_radius=5 * mm, blank=Blank(groove_depth=4 * mm)).data.decode()
    )
    assert groove.level == pytest.approx(-4 * mm)
    (*_, deep) = passes(gcode(PLATE, depth=12 * mm).data.decode())
    assert deep.level == pytest.approx(-12 * mm)


def test_the_leads_are_tangent_and_touch_nothing():
    path = tool_path(PLATE, 6 * mm)
    wall = path.walls[0].points
    for each in passes(PROGRAM):
        first, second = each.way.corners[:, 0], each.way.corners[:, 1]
        assert abs(each.way.bulges[[0, -1]]) == pytest.approx(np.tan(np.pi / 8), abs=1e-5)
        for corner, away in ((first, 1), (each.way.corners[:, -1], 1)):
            near = np.hypot(*(wall - corner[:, None])).min()
            assert near > 6 * mm + away * mm  # the tool goes down beside the cam
        assert np.hypot(*(second - first)) == pytest.approx(3 * mm * np.sqrt(2), abs=0.1 * um)
        start = np.hypot(*(wall - second[:, None])).min()
        assert start == pytest.approx(6 * mm, abs=20 * um)  # on the path, as near as points of the wall tell


@pytest.mark.parametrize(("direction", "sense"), [("climb", -1), ("conventional", 1)])
def test_climb_milling_goes_around_clockwise(direction, sense):
    """With the cam on the right of the way the teeth of a tool that turns clockwise go with the feed."""
    for turn in turns(gcode(PLATE, direction=direction, step_down=10 * mm).data.decode()):
        assert turn == pytest.approx(sense * 2 * np.pi, abs=0.5)
    groove = gcode(TranslatingRollerCam(), tool_radius=5 * mm, step_down=6 * mm, direction=direction)
    inner, outer = turns(groove.data.decode())
    assert {np.sign(inner), np.sign(outer)} == {-1, 1}


def test_nothing_moves_fast_near_the_cam():
    for move in moves(PROGRAM):
        sideways = (move.start[:2] != move.end[:2]).any()
        assert move.end[2] == pytest.approx(5 * mm) if move.kind == RAPID else move.feed > 0
        assert not (sideways and move.start[2] != move.end[2])


def test_no_arc_is_too_short_to_tell_its_end_from_its_start():
    for move in moves(PROGRAM):
        if move.kind in (CLOCKWISE, COUNTER):
            assert np.hypot(*(move.end - move.start)[:2]) > 1 * um
            assert move.mismatch < 0.05 * um


def test_in_inches():
    made = gcode(PLATE, tool_radius=6 * mm, step_down=5 * mm, unit="inch")
    there, here = passes(made.data.decode()), passes(PROGRAM)
    for one, other in zip(there, here, strict=True):
        assert one.level == pytest.approx(other.level, abs=0.05 * um)
        assert np.allclose(one.way.corners, other.way.corners, rtol=0, atol=0.05 * um)
    assert "G20 " in made.data.decode()
    assert made.deviation <= 1 * um


def test_a_plain_control_is_spared_what_it_does_not_know():
    made = gcode(PLATE, tool_radius=6 * mm, dialect="Fanuc")
    text = made.data.decode()
    assert text.splitlines()[:2] == ["%", "O1000"]
    assert text.splitlines()[-2:] == ["M30", "%"]
    for line in code(text)[2:-1]:
        assert re.fullmatch(r"(N\d+ )?([GMSTH]\d+|[XYZIJF]-?\d+\.\d{0,4})( ([GMSTH]\d+|[XYZIJF]-?\d+\.\d{0,4}))*", line)
    assert "G64" not in text
    assert "G91.1" not in text
    assert "G0 G43 H1 Z5." in text
    assert made.deviation <= 1 * um
    assert "IS-B" in made.remarks[-1]


def test_a_spindle_that_is_turned_on_by_hand():
    lines = code(gcode(PLATE, spindle_speed=0, step_down=10 * mm).data.decode())
    assert "M0" in lines
    assert not any("M3" in line.split() for line in lines)
    assert "S3000 M3" in code(PROGRAM)


def test_a_cutter_of_the_rollers_size_makes_one_pass_a_level():
    made = gcode(TranslatingRollerCam(), tool_radius=8 * mm, step_down=3 * mm)
    assert len(list(passes(made.data.decode()))) == 2
    assert made.remarks == ("the tool goes down into the solid: it must cut at its centre",)


def test_an_open_groove():
    cam = DoorHandleCam()
    one = gcode(cam, tool_radius=cam.roller_radius, step_down=6 * mm)
    (way,) = passes(one.data.decode())
    assert np.hypot(*(way.way.corners[:, 0] - way.way.corners[:, -1])) > 10 * mm
    around = gcode(cam, tool_radius=0.6 * cam.roller_radius, step_down=6 * mm)
    (way,) = passes(around.data.decode())
    apart = np.hypot(*(way.way.corners[:, 0] - way.way.corners[:, -1]))
    assert apart < 2.1 * 3 * mm
    assert max(one.deviation, around.deviation) <= 1 * um


def test_both_cams_of_a_pair_follow_each_other():
    made = gcode(ConjugatePair(), tool_radius=5 * mm, step_down=10 * mm)
    text = made.data.decode()
    assert text.count("\nM0\n") == 1
    assert len(list(passes(text))) == 2
    assert "STOP  A NEW BLANK FOR THE SECOND CAM" in text


# ---------------------------------------------------------------- nothing wrong is given away


def _wanted():
    path = tool_path(PLATE, 6 * mm)
    return [Wanted(path, 0, True, level, 300 * mm / 60) for level in (-5 * mm, -10 * mm)]


WANTED = _wanted()
ARCS = [k for k, line in enumerate(PROGRAM.splitlines()) if re.match("G[23] ", line)]


def changed(k, line):
    lines = PROGRAM.splitlines()
    return "\n".join(lines[:k] + line(lines[k]) + lines[k + 1 :])


def test_the_program_as_it_is_is_read_back():
    assert deviation(PROGRAM, WANTED, 1 * um) == DONE.deviation


WITHIN = sorted({*ARCS[2 : len(ARCS) // 2 - 2], *ARCS[len(ARCS) // 2 + 2 : -2]})
"""Without leads."""


@settings(max_examples=12, deadline=None)
@given(line=st.sampled_from(WITHIN), by=st.floats(3, 50), outward=st.booleans())
def test_a_wrong_end_is_found(line, by, outward):
    x, y = (float(re.search(f"{axis}(\\S+)", PROGRAM.splitlines()[line])[1]) for axis in "XY")
    far = 1 + (by if outward else -by) / 1000 / np.hypot(x, y)
    moved = changed(line, lambda said: [re.sub(r"X\S+ Y\S+", f"X{x * far:.5f} Y{y * far:.5f}", said)])
    with pytest.raises(ValueError, match=r"strays by .* um and enters the cam by .* um; at most 1 um are allowed"):
        deviation(moved, WANTED, 1 * um)


@settings(max_examples=12, deadline=None)
@given(line=st.sampled_from(WITHIN), by=st.floats(20, 50), axis=st.sampled_from("IJ"))
def test_a_wrong_centre_is_found(line, by, axis):
    moved = changed(line, lambda said: [re.sub(f"{axis}(\\S+)", lambda m: f"{axis}{float(m[1]) + by:.5f}", said)])
    with pytest.raises(ValueError, match="strays"):
        deviation(moved, WANTED, 1 * um)


@pytest.mark.parametrize("line", [WITHIN[3], WITHIN[-9]])
def test_a_lost_or_turned_arc_is_found(line):
    with pytest.raises(ValueError, match="strays"):
        deviation(changed(line, lambda said: []), WANTED, 1 * um)
    other = str.maketrans({"2": "3", "3": "2"})
    with pytest.raises(ValueError, match="strays"):
        deviation(changed(line, lambda said: [said[:2].translate(other) + said[2:]]), WANTED, 1 * um)


@pytest.mark.parametrize(
    ("said", "instead", "why"),
    [
        ("G1 Z-5. ", "G1 Z-5.5 ", "makes a pass at -5500 um"),
        ("G1 Z-10. ", "G0 Z-10. ", "fast below the top"),
        ("F300.", "F3000.", "feeds"),
        ("G0 Z5.", "G0 Z-1.", "fast below the top"),
        ("G21", "G20", "makes a pass"),
        ("M30", "M30", None),
    ],
)
def test_a_wrong_height_or_feed_is_found(said, instead, why):
    assert said in PROGRAM
    if why is None:
        assert deviation(PROGRAM.replace(said, instead), WANTED, 1 * um) <= 1 * um
    else:
        with pytest.raises(ValueError, match=why):
            deviation(PROGRAM.replace(said, instead), WANTED, 1 * um)


# ---------------------------------------------------------------- what people type


@given(text=st.text(max_size=300))
def test_no_text_becomes_code(text):
    for line in comment(text):
        assert re.fullmatch(r"\(- ?[A-Z0-9 .,+\-=/*?]*\)", line)
        assert len(line) < 75
        assert list(moves(f"G21\n{line}\n")) == []


def test_names_that_would_be_code():
    wicked = TitleBlock(
        "Cam)\nG0 Z-50 (",
        number="%",
        author="MSG, Grüße, 凸轮",
        material="; M3 {#1=2} [1]",
        faults=("it is (bad)\r\nM30",),
    )
    made = gcode(PLATE, tool_radius=6 * mm, step_down=5 * mm, title=wicked)
    text = made.data.decode("ascii")
    assert code(text) == code(PROGRAM)
    assert "(- FAULTY  IT IS  BAD   M30)" in text
    assert "GRUSSE" in text


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"tool_radius": 0}, "tool radius"),
        ({"feed": -1}, "feed"),
        ({"feed": np.nan}, "feed"),
        ({"depth": -1 * mm}, "depth"),
        ({"direction": "up"}, "direction"),
        ({"dialect": "Heidenhain"}, "dialect"),
        ({"unit": "cm"}, "the unit is 'cm'; a workshop's files are in mm or in inches"),
        ({"tolerance": 0}, "the tolerance is 0; it must be a length from 0.5 to 100 um"),
        ({"tolerance": 1 * mm}, "the tolerance is 0.001; it must be a length from 0.5 to 100 um"),
        ({"fed": 1}, "Milling has no fed; it has tool_radius, feed"),
        ({"step_down": 0.01 * mm}, "the step down is 0.01 mm, 1000 passes for 10 mm; at most 500 are possible"),
    ],
)
def test_what_is_refused(asked, said):
    with pytest.raises(ValueError, match=said):
        gcode(PLATE, **asked)


def test_levels_are_even_steps_down_to_the_depth():
    assert Milling(step_down=4 * mm).levels(10 * mm) == pytest.approx([-10 / 3 * mm, -20 / 3 * mm, -10 * mm])
    assert Milling(step_down=5 * mm).levels(10 * mm) == pytest.approx([-5 * mm, -10 * mm])
    assert Milling(step_down=50 * mm).levels(10 * mm) == pytest.approx([-10 * mm])


def test_a_program_is_written(tmp_path):
    done = write_gcode(TranslatingFlatCam(), tmp_path / "cam.ngc", tool_radius=10 * mm)
    assert done.path.read_bytes().startswith(b"%\n")
    assert done.deviation <= 1 * um
    assert str(done).startswith("cam.ngc: LinuxCNC, 5 passes of ")
    assert "um off" in str(done)
