"""Files for the workshop: a table holds the profile that was analysed, or what the tool leaves of it."""

import csv
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial import cKDTree

from camkit import (
    DoorHandleCam,
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    ValveCam,
)
from camkit.cam.flank import flanks
from camkit.cam.undercut import undercut_in_words
from camkit.files.profiles import table_csv
from camkit.files.workshop import tables
from camkit.machines.valve_train import ROLLER
from camkit.motion import Cycloidal, Dwell, FreePolynomial, MotionProgram, Poly345, Return, Rise
from camkit.units import deg, mm

WHOLE_DOOR = DoorHandleCam(lift_arm=45 * mm, relief_arm=80 * mm, relief_cam_angle=75 * deg, roller_radius=3 * mm)
"""A groove that its roller can make."""

# ---------------------------------------------------------------- CSV


@pytest.mark.parametrize("design", [WHOLE_DOOR, OscillatingRollerCam()], ids=lambda d: type(d).__name__)
def test_the_table_holds_the_analysis(design):
    analysis = design.analyse(181)
    rows = list(csv.DictReader(tables.table(analysis).data.decode().splitlines()))
    assert len(rows) == analysis.pitch.shape[-1]
    assert [row["stretch"] for row in rows] == analysis.stretch.tolist()
    column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name.endswith("]")}
    assert_allclose(column["cam angle [deg]"], analysis.profile_angle / deg, rtol=0, atol=0.5e-6 + 1e-12)
    for name, words in (("pitch", "pitch curve"), ("profile", "profile"), ("outer_profile", "outer profile")):
        for axis, values in zip("xy", getattr(analysis, name), strict=True):
            assert_allclose(column[f"{words} {axis} [mm]"], values / mm, rtol=0, atol=1e-9)


def test_a_number_that_is_zero_has_no_sign():
    assert table_csv({"x": [-0.0, np.float64(-1e-9), -1e-6, 0]}) == "x\n0.000000\n0.000000\n-0.000001\n0.000000\n"
    for column in ValveCam().analyse(361).lift_table.values():
        assert "-0.000000" not in table_csv({"x": column})


# ---------------------------------------------------------------- what the tool leaves


def program(lift, angle=60 * deg, law=Cycloidal()):  # noqa: B008
    return MotionProgram(
        (Rise(angle, lift, law), Dwell(20 * deg), Return(angle, lift, Cycloidal()), Dwell(340 * deg - 2 * angle))
    )


JOLT = FreePolynomial(start=(0, 0, 0), end=(1, 1.5))
"""Ends with a velocity that drops to 0 at once."""
UNDERCUT = {
    "flat face": TranslatingFlatCam(program(25 * mm), 20 * mm),
    "face on an arm": OscillatingFlatCam(program(8 * deg), face_offset=-4 * mm, arm_length=200 * mm),
    "roller": TranslatingRollerCam(
        program(25 * mm, 40 * deg), base_radius=15 * mm, roller_radius=16 * mm, groove=False
    ),
    "groove": TranslatingRollerCam(program(25 * mm), base_radius=15 * mm, roller_radius=12 * mm),
    "roller on an arm": OscillatingRollerCam(program(25 * deg, 45 * deg), roller_radius=16 * mm),
    "drop of speed": TranslatingRollerCam(program(15 * mm, 90 * deg, JOLT), base_radius=30 * mm, roller_radius=8 * mm),
    "door handle": DoorHandleCam(),
    "high speed": HighSpeedCam(roller_radius=118 * mm),
    "valve, flat face": ValveCam(base_radius=12 * mm),
    "valve, roller": ValveCam(follower=ROLLER, roller_radius=20 * mm, base_radius=12 * mm, half_angle=40 * deg),
    "open groove": OscillatingRollerCam(
        MotionProgram((Rise(45 * deg, 25 * deg, Cycloidal()), Return(45 * deg, 25 * deg, Cycloidal()))),
        roller_radius=16 * mm,
    ),
    "second cam of a pair": TranslatingRollerCam(program(25 * mm, 40 * deg), groove=False).conjugate(80 * mm, 16 * mm),
}
every_undercut = pytest.mark.parametrize("name", UNDERCUT)


@cache
def whole(cam, n):
    analysis = cam.analyse(n)
    return getattr(analysis, "whole", analysis)


@cache
def places(cam):
    """Where the roller's centre is at many cam angles."""
    return cKDTree(whole(cam, 20_001).pitch.T)


def depth_in_tool(cam, points):
    """How deep points lie in the roller or the face at any of many cam angles, m; by distances alone."""
    fine = whole(cam, 20_001)
    normals = getattr(fine, "face_normal", None)
    if normals is None:
        return cam.roller_radius - places(cam).query(points.T)[0]
    return np.array([(normals.T @ p - (normals * fine.profile).sum(0)).max() for p in points.T])


def distance_to(pieces, points):
    """From points to polylines, m."""
    least = np.full(points.shape[1], np.inf)
    for piece in pieces:
        line = np.column_stack([piece.points, piece.points[:, :1]]) if piece.closed else piece.points
        start, along = line[:, :-1], np.diff(line)
        along = np.where(abs(along).max(0) > 0, along, 1e-15)
        for k, p in enumerate(points.T):
            share = np.clip(((p[:, None] - start) * along).sum(0) / (along**2).sum(0), 0, 1)
            least[k] = min(least[k], np.hypot(*(p[:, None] - start - share * along)).min())
    return least


def crossings(pieces):
    """How often polylines cross themselves or each other, by the sides on which ends of segments lie."""
    lines = [np.column_stack([p.points, p.points[:, :1]]) if p.closed else p.points for p in pieces]
    a, b = (np.hstack([line[:, i : i - 1 or None] for line in lines]) for i in (0, 1))
    longest = np.hypot(*(b - a)).max()  # what crosses has its middles no farther apart
    i, j = cKDTree((a + b).T / 2).query_pairs(1.000001 * longest, output_type="ndarray").T

    def divides(i, j):
        start, along = a[:, i], (b - a)[:, i]
        first, second = (along[0] * (r[1, j] - start[1]) - along[1] * (r[0, j] - start[0]) for r in (a, b))
        return first * second < 0

    return int((divides(i, j) & divides(j, i)).sum())


@pytest.mark.slow
@every_undercut
def test_the_tool_covers_nothing_of_what_it_leaves_and_leaves_nothing_out(name):
    cam = UNDERCUT[name]
    made = flanks(whole(cam, 2001))
    assert made.cuts
    for piece in made.left:
        assert depth_in_tool(cam, piece.points).max() <= 1e-6, piece.flank
    assert crossings(made.left) == 0
    for flank, theory in flanks(whole(cam, 401)).theory.items():
        free = theory[:, depth_in_tool(cam, theory) < 1e-8]
        assert distance_to([p for p in made.left if p.flank == flank], free).max() < 5e-6, flank
    covered = [depth_in_tool(cam, piece.points[:, 1:-1]).max() for piece in made.lost if piece.points.shape[1] > 3]
    assert max(covered) > 1e-6


@every_undercut
def test_the_follower_stays_from_its_place_by_as_much_as_is_said(name):
    cam = UNDERCUT[name]
    analysis = whole(cam, 721)
    made = flanks(analysis)
    for cut in made.cuts:
        flank = [piece for piece in made.left if piece.flank == cut.flank]
        angle = analysis.profile_angle
        after, before = angle >= cut.start, angle <= cut.end
        inside = np.flatnonzero((after & before if cut.start <= cut.end else after | before) & made.cut_away[cut.flank])
        normals = getattr(analysis, "face_normal", None)
        if normals is None:
            gap = distance_to(flank, analysis.pitch[:, inside]).max() - cam.roller_radius
        else:
            left = np.hstack([piece.points for piece in flank])
            reach = (normals * analysis.profile).sum(0)[inside]
            gap = (reach - (normals[:, inside].T @ left).max(1)).max()
        assert cut.gap == pytest.approx(gap, rel=0.01, abs=3e-6)


@every_undercut
def test_an_undercut_cam_is_marked_in_its_table(name):
    analysis = whole(UNDERCUT[name], 721)
    made = flanks(analysis)
    rows = list(csv.DictReader(tables.table(analysis).data.decode().splitlines()))
    assert len(rows) == len(analysis.profile_angle)
    names = ("inner flank", "outer flank") if len(made.cut_away) > 1 else ("profile",)
    for said, (flank, away) in zip(names, made.cut_away.items(), strict=True):
        assert [said in row["undercut"].split(" and ") for row in rows] == away.tolist()
        table, theory = (
            np.array([[float(row[f"{k} {axis} [mm]"]) for row in rows] for axis in "xy"]) * mm
            for k in (flank, f"theory {flank}")
        )
        assert_allclose(theory, made.theory[flank], rtol=0, atol=1e-9)
        assert_allclose(table[:, ~away], theory[:, ~away], rtol=0, atol=1e-9)
        assert depth_in_tool(UNDERCUT[name], table).max() <= 1e-6
        assert distance_to([p for p in made.left if p.flank == flank], table).max() < 1e-8


@pytest.mark.parametrize(
    "cam",
    [
        TranslatingRollerCam(),
        TranslatingFlatCam(base_radius=40 * mm),
        OscillatingRollerCam(),
        OscillatingFlatCam(),
        HighSpeedCam(),
        ValveCam(follower=ROLLER),
        WHOLE_DOOR,
        TranslatingRollerCam(roller_radius=0.0),
    ],
    ids=lambda cam: type(cam).__name__,
)
def test_a_cam_that_its_tool_can_make_is_written_as_it_is(cam):
    analysis = whole(cam, 721)
    made = flanks(analysis)
    assert not made.cuts
    assert not made.lost
    assert undercut_in_words(analysis, made.cuts) == ""
    assert b"undercut" not in tables.table(analysis).data
    for flank, points in made.points.items():
        assert_array_equal(points, made.theory[flank])


@pytest.mark.parametrize("first", [40 * deg, 0.0], ids=["in the turn", "where it begins"])
def test_a_roller_turns_about_a_corner_of_its_path(first):
    """A rise of speed at once: the inner flank has an arc of the roller there, not its chord."""
    rise = Rise(90 * deg, 15 * mm, FreePolynomial(start=(0, 1.5), end=(1, 0, 0)))
    moves = (rise, Dwell(50 * deg), Return(90 * deg, 15 * mm, Poly345()), Dwell(130 * deg - first))
    motion = MotionProgram((Dwell(first), *moves) if first else moves)
    cam = TranslatingRollerCam(motion, base_radius=30 * mm, roller_radius=10 * mm, groove=False)
    made = flanks(cam.analyse())
    (piece,) = made.left
    assert piece.closed
    assert not made.cuts
    assert depth_in_tool(cam, piece.points).max() < 1e-6
    ends = np.column_stack([piece.points, piece.points[:, :1]])
    assert depth_in_tool(cam, (ends[:, :-1] + ends[:, 1:]) / 2).max() < 5e-6  # the chord would lie 0.17 mm deep
    assert (distance_to([piece], cam.analyse(20_001).profile) < 5e-6).all()


@pytest.mark.parametrize("kind", [TranslatingRollerCam, TranslatingFlatCam])
def test_a_drop_of_speed_where_the_turn_begins_is_cut(kind):
    moves = (Dwell(90 * deg), Return(90 * deg, 15 * mm, Poly345()), Dwell(90 * deg), Rise(90 * deg, 15 * mm, JOLT))
    motion = MotionProgram(moves, 15 * mm)
    cam = kind(motion=motion, base_radius=45 * mm)
    made = flanks(cam.analyse())
    (cut,) = [cut for cut in made.cuts if cut.flank == "profile"]
    assert cut.start > 340 * deg
    assert cut.end < 20 * deg
    for piece in made.left:
        assert piece.closed
        assert depth_in_tool(cam, piece.points).max() <= 1e-6
    assert crossings(made.left) == 0


def test_the_walls_of_a_groove_that_meets_itself_merge():
    """Rise over 350 deg by 5 mm, roller of 8 mm: its ends lie in each other's way."""
    cam = TranslatingRollerCam(MotionProgram((Rise(350 * deg, 5 * mm, Cycloidal()),)), roller_radius=8 * mm)
    made = flanks(cam.analyse())
    assert made.cuts
    assert {piece.flank for piece in made.lost} == {"profile", "groove end"}
    for piece in made.left:
        assert depth_in_tool(cam, piece.points).max() <= 1e-6
    assert crossings(made.left) == 0
