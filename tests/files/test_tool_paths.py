"""Paths of cutters and grinding wheels, against circles and against walls looked at point by point."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam, UniversalJointShaft, deg, mm, um
from camkit.cam import BarrelCam, ConjugatePair
from camkit.files import tool_path
from camkit.files.workshop.curves import Contour, Stretch
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.toolpath import around, path_of
from camkit.motion import MotionProgram, Return, Rise, SimpleHarmonic

ECCENTRIC = TranslatingFlatCam(
    MotionProgram((Rise(180 * deg, 50 * mm, SimpleHarmonic()), Return(180 * deg, 50 * mm, SimpleHarmonic()))),
    base_radius=25 * mm,
)
"""A circle of R 50 mm about a point 25 mm below the axis."""


def points_of(path):
    """Many points of a path, between those that it was made of too."""
    return np.hstack([stretch.finer(3).points for line in path.contours for stretch in line.stretches])


def test_a_wheel_runs_in_a_circle_around_a_circle():
    path = tool_path(ECCENTRIC, 60 * mm)
    x, y = points_of(path)
    assert np.allclose(np.hypot(x, y + 25 * mm), 110 * mm, rtol=0, atol=1e-9)
    (line,) = path.contours
    assert line.closed
    assert path.uncut == ()
    turned = np.unwrap(np.arctan2(y + 25 * mm, x))
    assert turned[-1] - turned[0] == pytest.approx(2 * np.pi)


@pytest.mark.parametrize(("side", "radius"), [("outside", 62), ("inside", 38)])
def test_both_sides_of_a_circle(side, radius):
    x, y = points_of(tool_path(ECCENTRIC, 12 * mm, side))
    assert np.allclose(np.hypot(x, y + 25 * mm), radius * mm, rtol=0, atol=1e-9)


class Hollow:
    """A wall ``r = R + a cos(k t) + b sin((k + 1) t)``."""

    def __init__(self, lobes, depth, second):
        self.lobes, self.depth, self.second = lobes, depth, second

    def at(self, t):
        k, a, b = self.lobes, self.depth, self.second
        r = 40 * mm + a * np.cos(k * t) + b * np.sin((k + 1) * t)
        slope = -a * k * np.sin(k * t) + b * (k + 1) * np.cos((k + 1) * t)
        out, along = np.stack([np.cos(t), np.sin(t)]), np.stack([-np.sin(t), np.cos(t)])
        return r * out, slope * out + r * along

    @property
    def contour(self):
        points, ways = self.at(np.linspace(0, 2 * np.pi, 721))
        points[:, -1], ways[:, -1] = points[:, 0], ways[:, 0]
        return Contour("CAM", (Stretch(points, ways / np.hypot(*ways)),), True)


def direction(points):
    return np.arctan2(points[1], points[0]) % (2 * np.pi)


def within(t, start, end):
    return (t - start) % (2 * np.pi) <= (end - start) % (2 * np.pi)


walls = st.builds(
    Hollow, st.integers(2, 6), st.floats(0, 7).map(lambda a: a * mm), st.floats(0, 2).map(lambda b: b * mm)
)


@settings(max_examples=20, deadline=None)
@given(wall=walls, radius=st.floats(0.5, 80).map(lambda r: r * mm), inside=st.booleans())
def test_a_tool_never_cuts_the_wall_and_leaves_material_only_where_it_is_said(wall, radius, inside):
    radius = min(radius, 15 * mm) if inside else radius
    path = around([wall.contour], [inside], radius, direction)
    t = np.linspace(0, 2 * np.pi, 100_001)[:-1]
    points = wall.at(t)[0]
    centre = points_of(path)
    apart = cKDTree(points.T).query(centre.T)[0]
    assert abs(apart - radius).max() < 0.02 * um  # everywhere: it touches, and cuts nothing
    some = slice(None, None, 20)
    gap = cKDTree(centre.T).query(points[:, some].T)[0] - radius
    near = 0.2 * um + 2 * np.hypot(*np.diff(centre)).max() ** 2 / radius  # the centres are points, not a line
    named = np.zeros(t[some].shape, dtype=bool)
    for uncut in path.uncut:
        here = within(t[some], uncut.start, uncut.end)
        assert gap[here].max() == pytest.approx(uncut.stays, abs=max(near, 0.02 * uncut.stays))
        named |= here
    assert gap[~named].max(initial=0) < near


def test_a_cam_and_its_tool_in_a_corner():
    """A square of 40 mm with sharp edges: arcs about them outside, mitres inside."""
    corners = np.array([[-20, -20], [20, -20], [20, 20], [-20, 20]]) * mm
    ways = np.roll(corners, -1, axis=0) - corners
    sides = (
        Stretch(np.linspace(a, a + w, 5).T, np.tile(w / 40 / mm, (5, 1)).T) for a, w in zip(corners, ways, strict=True)
    )
    square = Contour("CAM", tuple(sides), True)
    outside = points_of(around([square], [False], 5 * mm, direction))
    beyond = np.maximum(abs(outside) - 20 * mm, 0)
    assert np.allclose(np.hypot(*beyond), 5 * mm, rtol=0, atol=1e-9)
    inside = around([square], [True], 5 * mm, direction)
    assert np.allclose(abs(points_of(inside)).max(0), 15 * mm, rtol=0, atol=1e-9)
    assert len(inside.uncut) == 4
    assert inside.uncut[0].stays == pytest.approx((np.sqrt(2) - 1) * 5 * mm)


def test_a_wheel_cannot_reach_the_bottom_of_a_hollow():
    wall = Hollow(6, 3 * mm, 0)
    path = around([wall.contour], [False], 60 * mm, direction)
    assert len(path.uncut) == 6
    at, stays = path.uncut[0].start, path.uncut[0].stays
    assert 0 * deg < at < 30 * deg  # a hollow is at 30 deg
    assert str(path.uncut[0]).endswith(f"up to {stays / mm:.3g} mm of material stays")
    assert around([wall.contour], [False], 3 * mm, direction).uncut == ()


def groove_errors(cam, radius):
    """How near a tool comes to each flank of a groove, over its radius."""
    analysis = cam.analyse(20_001)
    flanks = np.hstack([analysis.profile, analysis.outer_profile])
    path = tool_path(cam, radius)
    return path, cKDTree(flanks.T).query(points_of(path).T)[0] - radius


def test_a_cutter_of_the_rollers_size_runs_along_the_pitch_curve():
    cam = TranslatingRollerCam()
    path, off = groove_errors(cam, cam.roller_radius)
    pitch = cam.analyse(20_001).pitch
    assert cKDTree(pitch.T).query(points_of(path).T)[0].max() < 20 * um  # as dense as the points are
    assert path.one_pass
    assert len(path.contours) == 1
    assert abs(off).max() < 0.1 * um


def test_a_smaller_cutter_runs_along_both_walls():
    path, off = groove_errors(TranslatingRollerCam(), 5 * mm)
    assert sorted(path.inside) == [False, True]
    assert abs(off).max() < 0.1 * um
    assert path.remarks == ()
    (said,) = tool_path(TranslatingRollerCam(), 3 * mm).remarks
    assert said == ("a ridge of 4 mm stays along the middle of the groove; a tool of 4 mm leaves none")


def test_the_groove_of_a_door_handle_is_one_closed_path():
    cam = DoorHandleCam()
    path = tool_path(cam, 0.6 * cam.roller_radius)
    (line,) = path.contours
    assert line.closed
    assert path.inside == (True,)


@pytest.mark.parametrize(
    ("cam", "radius", "side", "said"),
    [
        (
            TranslatingRollerCam(),
            9 * mm,
            "outside",
            "is 9 mm; into the groove goes one of at most that of",
        ),
        (TranslatingRollerCam(), 0, "outside", "the tool radius is 0; it must be above 0 and at most 10 m"),
        (TranslatingRollerCam(), "big", "outside", "the tool radius is 'big'"),
        (TranslatingRollerCam(), np.inf, "outside", "the tool radius is inf"),
        (ECCENTRIC, 5 * mm, "left", "the side is 'left'; it must be 'outside' or 'inside'"),
        (ECCENTRIC, 51 * mm, "inside", "the tool radius is 51 mm; such a tool fits nowhere"),
        (BarrelCam(), 5 * mm, "outside", "BarrelCam is a drum; a tool that moves in a plane cannot cut it"),
        (UniversalJointShaft(), 5 * mm, "outside", "UniversalJointShaft has no cam profile"),
    ],
)
def test_a_tool_that_cannot_be(cam, radius, side, said):
    with pytest.raises(ValueError, match=said):
        tool_path(cam, radius, side)


def test_both_cams_of_a_pair_name_their_hollows_at_their_cam_angles():
    motion = MotionProgram((Rise(60 * deg, 20 * mm, SimpleHarmonic()), Return(300 * deg, 20 * mm, SimpleHarmonic())))
    pair = ConjugatePair(TranslatingRollerCam(motion, groove=False))
    for cam, turned in zip(subjects(pair), (1, -1), strict=True):
        path = path_of(cam, 150 * mm)
        (uncut,) = path.uncut
        end = uncut.end + 2 * np.pi * (uncut.end < uncut.start)
        assert end - uncut.start < 60 * deg
        around = cam.analysis.at(np.linspace(uncut.start, end, 2001) % (2 * np.pi))
        away = cKDTree(points_of(path).T).query(turned * around.profile.T)[0] - 150 * mm  # the second is turned over
        assert away.max() == pytest.approx(uncut.stays, rel=0.01)
        assert away[[0, -1]].max() < 0.05 * uncut.stays
