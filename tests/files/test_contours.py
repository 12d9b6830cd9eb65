"""Contours of cams as they are made: held against the follower itself, place by place, and against known shapes."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
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
from camkit.cam import BarrelCam, CamWithPins, ConjugatePair, DrawnOutline, OscillatingBarrelCam, cam_from_outline
from camkit.dynamics import ElasticFollower
from camkit.files.workshop.arcs import dense_path, distances
from camkit.files.workshop.contours import contours
from camkit.files.workshop.curves import smooth
from camkit.files.workshop.subject import subjects
from camkit.geometry import rotated
from camkit.machines.cam_lever import CamLever
from camkit.machines.valve_train import ROLLER
from camkit.motion import Cycloidal, Dwell, FreePolynomial, MotionProgram, Poly345, Return, Rise, SimpleHarmonic
from camkit.units import deg, mm

WHOLE_DOOR = DoorHandleCam(lift_arm=45 * mm, relief_arm=80 * mm, relief_cam_angle=75 * deg, roller_radius=3 * mm)
"""A groove that its roller can make."""
OPEN = MotionProgram((Rise(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg)))
CAMS = {
    "groove": TranslatingRollerCam(offset=6 * mm, rotation=-1),
    "plate": TranslatingRollerCam(groove=False),
    "knife edge": TranslatingRollerCam(groove=False, roller_radius=0.0),
    "open groove": TranslatingRollerCam(OPEN),
    "open plate": TranslatingRollerCam(OPEN, groove=False),
    "face": TranslatingFlatCam(),
    "arm": OscillatingRollerCam(rotation=-1),
    "face on an arm": OscillatingFlatCam(),
    "high speed": HighSpeedCam(),
    "press": CamLever(),
    "valve": ValveCam(),
    "valve under a roller": ValveCam(follower=ROLLER, base_radius=30 * mm),
    "door": WHOLE_DOOR,
    "elastic": ElasticFollower(TranslatingRollerCam(groove=False)),
    "pins": CamWithPins(OscillatingRollerCam(groove=False)),
    "drum": BarrelCam(),
    "drum with an arm": OscillatingBarrelCam(),
    "end of a drum": BarrelCam(groove=False),
    "open drum": BarrelCam(MotionProgram((Rise(120 * deg, 50 * mm, Cycloidal()),))),
}
every = pytest.mark.parametrize("name", CAMS)


@cache
def made(cam, *steps):
    """The only cam of a design, and its contours."""
    (subject,) = subjects(cam)
    return subject.analysis, contours(subject, *steps)


def cut(lines):
    return [line for line in lines if line.layer in ("CAM", "GROOVE")]


def away(lines, points):
    """Of points from the nearest of some contours, m."""
    return np.min([distances(dense_path(line), points) for line in lines], axis=0)


def corners(line):
    """How many a closed contour has."""
    return sum(not smooth(*pair) for pair in pairwise([*line.stretches, line.stretches[0]]))


def area(line):
    x, y = line.points
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


@every
def test_stretches_join_and_their_tangents_are_those_of_the_points(name):
    for line in made(CAMS[name])[1]:
        parts = line.stretches
        for before, after in pairwise([*parts, *parts[: line.closed]]):
            assert (before.points[:, -1] == after.points[:, 0]).all()
        for part in parts:
            assert_allclose(np.hypot(*part.tangents), 1, rtol=0, atol=1e-12)
            points, along = part.finer(32)
            chords = points[:, 2:] - points[:, :-2]  # of steps that are not even, hence the tolerance
            assert_allclose(chords / np.hypot(*chords), along[:, 1:-1], rtol=0, atol=1e-3)
        if line.closed:
            assert area(line) > 0
        assert line.layer != "FAULT"


@every
def test_every_place_of_the_follower_touches_what_is_cut(name):
    """The nearest place of a flank lies the roller's radius from its centre, and the face is a tangent."""
    analysis, lines = made(CAMS[name])
    fine = analysis if hasattr(analysis, "from_relief") else analysis.at(np.linspace(0, analysis.cam.motion.span, 997))
    if hasattr(fine, "face_normal"):
        points = np.hstack([part.finer(80).points for part in lines[0].stretches])
        reach = (fine.face_normal * fine.profile).sum(0)
        assert_allclose((fine.face_normal.T @ points).max(1), reach, rtol=0, atol=5e-9)
        return
    period = getattr(analysis, "period", np.zeros(2))[:, None]
    found = np.min([away(cut(lines), fine.pitch + k * period) for k in (-1, 0, 1)], axis=0)
    assert_allclose(found, float(np.ravel(fine.cam.roller_radius)[0]), rtol=0, atol=2e-9)
    pitch = [line for line in lines if line.layer == "PITCH"]
    if pitch:
        assert away(pitch, fine.pitch).max() < 2e-9


@every
def test_other_cam_angles_give_the_same_curves(name):
    _, lines = made(CAMS[name])
    for line, other in zip(lines, made(CAMS[name], 37)[1], strict=True):
        assert other.points.shape != line.points.shape
        assert away([line], other.points).max() < 1e-9


def test_contours_by_layer_and_whether_they_close():
    found = {name: [(line.layer, line.closed) for line in made(cam)[1]] for name, cam in CAMS.items()}
    both, open_groove = [("GROOVE", True)] * 2 + [("PITCH", True)], [("GROOVE", True), ("PITCH", False)]
    assert found["groove"] == found["arm"] == both
    assert found["open groove"] == found["door"] == found["open drum"] == open_groove
    assert found["plate"] == found["high speed"] == [("CAM", True), ("PITCH", True)]
    assert found["face"] == found["knife edge"] == found["valve"] == [("CAM", True)]
    assert found["open plate"] == found["end of a drum"] == [("CAM", False), ("PITCH", False)]
    assert found["drum"] == [("GROOVE", False)] * 2 + [("PITCH", False)]


# ---------------------------------------------------------------- known shapes


def length(line):
    return sum(part.finer(16).length for part in line.stretches)


def test_a_harmonic_face_cam_is_a_circle():
    """``s = e (1 - cos phi)``: the support function of a circle of the radius ``r_0 + e``, ``e`` below the axis."""
    harmonic = SimpleHarmonic()
    turn = MotionProgram((Rise(180 * deg, 20 * mm, harmonic), Return(180 * deg, 20 * mm, harmonic)))
    _, (line,) = made(TranslatingFlatCam(turn, 30 * mm))
    points = np.hstack([part.finer(8).points for part in line.stretches])
    assert_allclose(np.hypot(points[0], points[1] + 10 * mm), 40 * mm, rtol=0, atol=1e-10)


@pytest.mark.parametrize("follower", [TranslatingRollerCam(groove=False), OscillatingRollerCam(groove=False)])
def test_an_eccentric_comes_back_as_a_circle(follower):
    cam = cam_from_outline(DrawnOutline.circle(40 * mm, 0, -15 * mm), follower)
    line = made(cam)[1][0]
    assert_allclose(np.hypot(line.points[0], line.points[1] + 15 * mm), 40 * mm, rtol=0, atol=2e-9)


def test_flanks_beside_a_pitch_curve_have_steiner_s_lengths():
    outer, inner, pitch = made(TranslatingRollerCam())[1]
    outer, inner = sorted((outer, inner), key=length, reverse=True)
    assert length(outer) - length(pitch) == pytest.approx(2 * np.pi * 8 * mm, abs=1e-8)
    assert length(pitch) - length(inner) == pytest.approx(2 * np.pi * 8 * mm, abs=1e-8)


@pytest.mark.parametrize("name", ["door", "open groove", "open drum"])
def test_an_open_groove_is_as_large_as_its_roller_sweeps(name):
    """A strip of the width ``2 r`` along the pitch curve, and two half circles: ``2 r L + pi r^2``."""
    groove, pitch = made(CAMS[name])[1]
    r = float(np.ravel(made(CAMS[name])[0].cam.roller_radius)[0])
    x, y = np.hstack([part.finer(16).points for part in groove.stretches])
    size = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    assert size == pytest.approx(2 * r * length(pitch) + np.pi * r**2, rel=1e-6)


# ---------------------------------------------------------------- corners and undercut

JOLT = FreePolynomial(start=(0, 0, 0), end=(1, 1.5))
"""Ends with a velocity that drops to 0 at once."""
START = FreePolynomial(start=(0, 1.5), end=(1, 0, 0))


def program(lift, angle=60 * deg, law=Cycloidal()):  # noqa: B008
    return MotionProgram(
        (Rise(angle, lift, law), Dwell(20 * deg), Return(angle, lift, Cycloidal()), Dwell(340 * deg - 2 * angle))
    )


@pytest.mark.parametrize("first", [40 * deg, 0.0], ids=["in the turn", "where it begins"])
def test_a_roller_turns_about_a_corner_of_its_path(first):
    moves = (Rise(90 * deg, 15 * mm, START), Dwell(50 * deg), Return(90 * deg, 15 * mm, Poly345()))
    rest = Dwell(130 * deg - first)
    motion = MotionProgram((Dwell(first), *moves, rest) if first else (*moves, rest))
    plate = TranslatingRollerCam(motion, base_radius=30 * mm, roller_radius=10 * mm, groove=False)
    line, pitch = made(plate)[1]
    corner = rotated(np.array([0.0, 40 * mm]), -first)
    around = [p for p in line.stretches if np.allclose(np.hypot(*(p.points.T - corner).T), 10 * mm, rtol=0, atol=1e-9)]
    assert len(around) == 1
    assert (corners(line), corners(pitch)) == (0, 1)


UNDERCUT = {
    "face": TranslatingFlatCam(program(25 * mm), 20 * mm),
    "face, a little": TranslatingFlatCam(base_radius=10 * mm),
    "face on an arm": OscillatingFlatCam(program(8 * deg), face_offset=-4 * mm, arm_length=200 * mm),
    "roller": TranslatingRollerCam(program(25 * mm, 40 * deg), 15 * mm, 16 * mm, groove=False),
    "groove": TranslatingRollerCam(program(25 * mm), 15 * mm, 12 * mm),
    "drop of speed": TranslatingRollerCam(program(15 * mm, 90 * deg, JOLT), 30 * mm, 8 * mm),
    "door": DoorHandleCam(),
    "high speed": HighSpeedCam(roller_radius=118 * mm),
    "valve": ValveCam(base_radius=12 * mm),
}


def depth(analysis, points):
    """How deep points lie in the follower at any of many cam angles, m; by distances alone."""
    fine = analysis
    if not hasattr(analysis, "from_relief"):
        fine = analysis.at(np.linspace(0, analysis.cam.motion.span, 20_001))
    if hasattr(fine, "face_normal"):
        reach = (fine.face_normal * fine.profile).sum(0)
        return np.array([(fine.face_normal.T @ p - reach).max() for p in points.T])
    return float(np.ravel(fine.cam.roller_radius)[0]) - cKDTree(fine.pitch.T).query(points.T)[0]


@pytest.mark.parametrize("name", UNDERCUT)
def test_the_tool_covers_nothing_of_what_is_left_and_some_of_what_is_lost(name):
    cam = UNDERCUT[name]
    analysis, lines = made(cam)
    left, lost = cut(lines), [line for line in lines if line.layer == "FAULT"]
    assert left
    assert lost
    assert all(line.closed for line in left)
    for line in left:
        assert depth(analysis, line.points).max() < 2e-8
    assert any(corners(line) for line in left)
    assert max(depth(analysis, line.points).max() for line in lost) > 1e-6
    theory = np.hstack([analysis.profile, analysis.outer_profile])
    theory = theory[:, np.isfinite(theory).all(0)]
    clear = theory[:, depth(analysis, theory) < 1e-9]
    assert away(left, clear).max() < 2e-8


@pytest.mark.parametrize("name", UNDERCUT)
def test_what_is_left_crosses_nothing(name):
    for line in cut(made(UNDERCUT[name])[1]):
        fine = np.hstack([part.finer(2).points[:, :-1] for part in line.stretches])
        start, along = fine, np.roll(fine, -1, axis=1) - fine
        side = along[0, :, None] * (fine[1] - start[1, :, None]) - along[1, :, None] * (fine[0] - start[0, :, None])
        parted = side * np.roll(side, -1, axis=1) < 0
        assert not (parted & parted.T).any()


def test_a_square_cam_keeps_its_corners():
    square = DrawnOutline(((0.02, -0.02), (0.02, 0.02), (-0.02, 0.02), (-0.02, -0.02)))
    line = made(cam_from_outline(square, TranslatingRollerCam(groove=False)))[1][0]
    assert corners(line) == 4
    assert_allclose(abs(line.points).max(0), 0.02, rtol=0, atol=1e-8)


@pytest.mark.parametrize("pair", [ConjugatePair(), ConjugatePair(OscillatingRollerCam(groove=False))])
def test_both_cams_of_a_pair_lie_as_they_stand_on_their_shaft(pair):
    """Turned with the shaft, the second cam touches the second roller where the machine has it."""
    analysis = pair.analyse(37)
    for subject, name in zip(subjects(pair), ("first", "second"), strict=True):
        line = dense_path(contours(subject)[0])
        rollers = [body for body in analysis.bodies if body.name == name and body.part == "roller"]
        for k in range(0, 37, 5):
            centre = rotated(rollers[0].at(k)[:, None], -analysis.first.turn[k])
            assert distances(line, centre)[0] == pytest.approx(rollers[0].radius, abs=2e-9)


@settings(max_examples=12, deadline=None)
@given(
    st.floats(5, 30), st.floats(40, 170), st.floats(20, 60), st.floats(0.5, 15), st.floats(-10, 10), st.booleans(),
    st.sampled_from([-1, 1]), st.sampled_from([Cycloidal(), SimpleHarmonic(), Poly345()])
)  # fmt: skip
def test_any_cam_keeps_its_roller_s_distance_or_says_what_is_lost(lift, angle, base, roller, offset, groove, turn, law):
    motion = MotionProgram((Rise(angle * deg, lift * mm, law), Return((360 - angle) * deg, lift * mm, law)))
    cam = TranslatingRollerCam(motion, base * mm, roller * mm, offset * mm, turn, groove=groove)
    analysis, lines = made(cam)
    assert all(line.closed for line in cut(lines))
    assert depth(analysis, np.hstack([line.points for line in cut(lines)])).max() < 2e-8
    if not any(line.layer == "FAULT" for line in lines):
        assert_allclose(away(cut(lines), analysis.pitch), roller * mm, rtol=0, atol=4e-9)
