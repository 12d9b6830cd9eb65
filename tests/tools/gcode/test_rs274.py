"""Programs of G-code as LinuxCNC understands them: its interpreter says where the tool's centre goes."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam, deg, inch, mm, um
from camkit.files import TitleBlock, write_gcode
from camkit.motion import Cycloidal, MotionProgram, Return, Rise, SimpleHarmonic

TOLERANCE = 1 * um
ECCENTRIC = TranslatingFlatCam(
    MotionProgram((Rise(180 * deg, 50 * mm, SimpleHarmonic()), Return(180 * deg, 50 * mm, SimpleHarmonic()))),
    base_radius=25 * mm,
)
HOLLOW = TranslatingRollerCam(
    MotionProgram((Rise(60 * deg, 20 * mm, Cycloidal()), Return(300 * deg, 20 * mm, Cycloidal()))), groove=False
)
"""Its flanks are hollow."""


@pytest.fixture(scope="module")
def rs274():
    found = shutil.which("rs274")
    if found is None and os.environ.get("CI") == "true":
        pytest.fail("there is no rs274; in Debian it is in the package linuxcnc-uspace")
    return found or pytest.skip("there is no rs274; in Debian it is in the package linuxcnc-uspace")


def canonical(rs274, program):
    """The moves by name, with their numbers in m: ends, and centre, turns and height of an arc."""
    tools = program.with_suffix(".tbl")
    tools.write_text("T1 P1 Z0 D0 ;\n")
    command = [rs274, "-t", tools, "-v", program.with_suffix(".var"), "-g", program]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=program.parent)
    assert "PROGRAM_END()" in done.stdout, done.stdout[-500:] + done.stderr[-500:]
    for name, given in re.findall(r"(STRAIGHT_FEED|ARC_FEED|STRAIGHT_TRAVERSE|SET_FEED_RATE)\(([^)]*)\)", done.stdout):
        yield name, [float(number) for number in given.split(",")]


def magnified(program):
    """The program with all lengths a thousand times as long: rs274 prints four decimals, in inches too few."""
    larger = program.with_suffix(".larger.ngc")
    lines = program.read_text().splitlines(keepends=True)
    scaled = (line if line.startswith("(") else re.sub(r"\b([XYZIJ])([-.\d]+)", r"\1[\2*1000]", line) for line in lines)
    larger.write_text("".join(scaled))
    return larger


def tracks(moves, unit=mm):
    """Where the tool's centre is from going down to going up, pass by pass: pieces of points ``(2, n)``, and height."""
    at, pieces = None, []
    for name, numbers in moves:
        numbers = [x if k == 4 and name == "ARC_FEED" else x * unit for k, x in enumerate(numbers)]
        if name == "STRAIGHT_TRAVERSE":
            if pieces:
                yield pieces
            at, pieces = np.array(numbers[:3]), []
        elif name == "STRAIGHT_FEED":
            end = np.array(numbers[:3])
            if np.hypot(*(end - at)[:2]) > 0:
                pieces.append((np.linspace(at[:2], end[:2], 20).T, end[2]))
            at = end
        elif name == "ARC_FEED":
            end, centre, z = np.array(numbers[:2]), np.array(numbers[2:4]), numbers[5]
            assert z == at[2]
            assert abs(numbers[4]) == 1
            pieces.append((arc(at[:2], end, centre, numbers[4]), z))
            at = np.array([*end, z])


def arc(start, end, centre, turns):
    """Points of an arc as LinuxCNC runs it: the radius goes from that of its start to that of its end."""
    (one, first), (other, last) = ((np.hypot(*(p - centre)), np.arctan2(*(p - centre)[::-1])) for p in (start, end))
    sweep = (last - first) % (2 * np.pi) if turns > 0 else -((first - last) % (2 * np.pi))
    share = np.linspace(0, 1, 2 + int(abs(sweep) * one / 40e-6))
    angle = first + sweep * share
    return centre[:, None] + (one + (other - one) * share) * np.stack([np.cos(angle), np.sin(angle)])


def walls(cam):
    """Points of the profile, of a groove both flanks, every 10 um or so."""
    analysis = cam.analyse()
    whole = getattr(analysis, "whole", analysis)
    fine = whole.at(np.linspace(whole.cam_angle[0], whole.cam_angle[-1], 40_001))
    flanks = np.hstack([fine.profile, fine.outer_profile])
    return flanks[:, np.isfinite(flanks).all(0)]


def held(passes, wall, radius, led=True):
    """Every pass keeps the tool's radius from the wall and comes to all of it; its leads stay farther away."""
    near = cKDTree(wall.T)
    for pieces in passes:
        apart = [near.query(points.T)[0] - radius for points, _ in pieces]
        assert min(map(np.min, apart)) > -TOLERANCE
        cut = slice(1, -1) if led else slice(None)
        assert max(map(np.max, apart[cut])) < TOLERANCE
        if led:
            assert np.max(apart[0]) > 1 * mm
            assert np.max(apart[-1]) > 1 * mm


@pytest.mark.parametrize("direction", ["climb", "conventional"])
@pytest.mark.parametrize("dialect", ["LinuxCNC", "Fanuc"])
def test_a_plate_in_mm(rs274, tmp_path, dialect, direction):
    done = write_gcode(HOLLOW, tmp_path / "a.ngc", tool_radius=6 * mm, dialect=dialect, direction=direction)
    moves = list(canonical(rs274, done.path))
    passes = list(tracks(moves))
    held(passes, walls(HOLLOW), 6 * mm)
    assert [pieces[0][1] for pieces in passes] == pytest.approx([-2 * mm, -4 * mm, -6 * mm, -8 * mm, -10 * mm])
    points = np.hstack([points for points, _ in passes[0]])
    around = np.unwrap(np.arctan2(points[1], points[0]))
    assert around[-1] - around[0] == pytest.approx(2 * np.pi * (-1 if direction == "climb" else 1), abs=0.3)
    assert {numbers[0] for name, numbers in moves if name == "SET_FEED_RATE"} == {0.0, 100.0, 300.0}
    rapids = [numbers for name, numbers in moves if name == "STRAIGHT_TRAVERSE"]
    assert all(numbers[2] == 5.0 for numbers in rapids)


@pytest.mark.parametrize("dialect", ["LinuxCNC", "Fanuc"])
def test_a_plate_in_inches(rs274, tmp_path, dialect):
    done = write_gcode(HOLLOW, tmp_path / "a.ngc", tool_radius=inch / 4, unit="in", dialect=dialect, step_down=10 * mm)
    rough = list(tracks(canonical(rs274, done.path), inch))
    (pieces,) = tracks(canonical(rs274, magnified(done.path)), inch / 1000)
    held([pieces], walls(HOLLOW), inch / 4)
    for (one, _), (other, _) in zip(pieces, rough[0], strict=True):
        assert np.allclose(one[:, [0, -1]], other[:, [0, -1]], rtol=0, atol=0.00006 * inch)


def test_a_wheel_around_an_eccentric_circle(rs274, tmp_path):
    done = write_gcode(ECCENTRIC, tmp_path / "wheel.ngc", tool_radius=60 * mm, step_down=10 * mm)
    (pieces,) = tracks(canonical(rs274, done.path))
    x, y = np.hstack([points for points, _ in pieces[1:-1]])
    assert np.allclose(np.hypot(x, y + 25 * mm), 110 * mm, rtol=0, atol=TOLERANCE)
    assert np.ptp(np.unwrap(np.arctan2(y + 25 * mm, x))) == pytest.approx(2 * np.pi, abs=1e-6)


def test_both_walls_of_a_groove(rs274, tmp_path):
    cam = TranslatingRollerCam()
    done = write_gcode(cam, tmp_path / "groove.ngc", tool_radius=5 * mm, step_down=6 * mm)
    passes = list(tracks(canonical(rs274, done.path)))
    assert len(passes) == 2
    held(passes, walls(cam), 5 * mm)


def test_a_groove_in_one_go(rs274, tmp_path):
    cam = TranslatingRollerCam()
    done = write_gcode(cam, tmp_path / "groove.ngc", tool_radius=cam.roller_radius, step_down=6 * mm)
    passes = list(tracks(canonical(rs274, done.path)))
    held(passes, walls(cam), cam.roller_radius, led=False)


@pytest.mark.parametrize("share", [1.0, 0.6])
def test_the_open_groove_of_a_door_handle(rs274, tmp_path, share):
    """Its outer wall is undercut.  The tool stays where the roller goes, and comes to all of the inner wall."""
    cam = DoorHandleCam()
    radius, analysis = share * cam.roller_radius, cam.analyse(40_001)
    done = write_gcode(cam, tmp_path / "door.ngc", tool_radius=radius, step_down=6 * mm, lead_in=1 * mm)
    (pieces,) = tracks(canonical(rs274, done.path))
    centre = np.hstack([points for points, _ in pieces])
    around = np.linspace(0, 2 * np.pi, 37)
    edge = centre[:, ::10, None] + radius * np.stack([np.cos(around), np.sin(around)])[:, None]
    assert cKDTree(analysis.pitch.T).query(edge.reshape(2, -1).T)[0].max() < cam.roller_radius + TOLERANCE
    assert cKDTree(centre.T).query(analysis.profile.T)[0].max() < radius + TOLERANCE


def test_a_hollow_that_is_narrower_than_the_wheel(rs274, tmp_path):
    done = write_gcode(HOLLOW, tmp_path / "wheel.ngc", tool_radius=150 * mm, step_down=10 * mm)
    assert any("hollow is narrower than the tool" in remark for remark in done.remarks)
    (pieces,) = tracks(canonical(rs274, done.path))
    centre, wall = np.hstack([points for points, _ in pieces]), walls(HOLLOW)
    assert cKDTree(wall.T).query(centre.T)[0].min() > 150 * mm - TOLERANCE
    stays = cKDTree(centre.T).query(wall.T)[0] - 150 * mm
    told = float(re.search(r"up to (\S+) mm of material", done.remarks[0])[1]) * mm
    assert stays.max() == pytest.approx(told, rel=0.01)


def test_what_people_type_is_no_code(rs274, tmp_path):
    title = TitleBlock(
        "MSG, (a)\n%\nG0 Z-50", number="#1=2 ; M3", author="LOGOPEN,log.txt", faults=("DEBUG, 凸轮\r\nM30 (",)
    )
    wicked = write_gcode(HOLLOW, tmp_path / "a.ngc", title=title, dialect="Fanuc")
    plain = write_gcode(HOLLOW, tmp_path / "b.ngc", dialect="Fanuc")
    assert list(canonical(rs274, wicked.path)) == list(canonical(rs274, plain.path))
    assert not Path(tmp_path / "log.txt").exists()
