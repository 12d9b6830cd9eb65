"""Contours as arcs: within the tolerance, tangent to each other, few, and never across a corner."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial import cKDTree

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.cam import DrawnOutline, cam_from_outline
from camkit.files.workshop.arcs import ArcPath, arc_path, chord_path, dense_path, distances
from camkit.files.workshop.contours import contours
from camkit.files.workshop.curves import smooth
from camkit.files.workshop.splines import splines
from camkit.files.workshop.subject import subjects
from camkit.motion import MotionProgram, Return, Rise, SimpleHarmonic
from camkit.units import deg, mm, um

DOOR = contours(subjects(DoorHandleCam())[0])
GROOVE = contours(subjects(TranslatingRollerCam())[0])
UNDERCUT = contours(subjects(TranslatingFlatCam(base_radius=10 * mm))[0])


def most_off(path, line):
    """The largest distance between them either way, m, by many points on both alone."""
    exact = np.hstack([part.finer(60).points for part in line.stretches])
    drawn = path.points(400)
    return max(cKDTree(a.T).query(b.T)[0].max() for a, b in ((exact, drawn), (drawn, exact)))


@pytest.mark.parametrize("tolerance", [10 * um, 1 * um])
@pytest.mark.parametrize("fit", [arc_path, chord_path])
def test_points_of_both_lie_within_the_tolerance(fit, tolerance):
    for line in (*DOOR, *GROOVE, *UNDERCUT):
        path = fit(line, tolerance)
        near = np.hypot(*np.diff(path.points(400))).max() + np.hypot(*np.diff(line.points)).max() / 60
        assert most_off(path, line) < np.hypot(tolerance, near)
        fine = np.hstack([part.finer(7).points for part in line.stretches])
        assert distances(path, fine).max() < tolerance
        assert distances(dense_path(line), path.points(9)).max() < tolerance


def directions(path):
    """Of each arc at its start and its end, rad."""
    chord = path.ends - path.starts
    along, half = np.arctan2(chord[1], chord[0]), 2 * np.arctan(path.bulges)
    return along - half, along + half


def test_arcs_are_tangent_but_on_corners():
    for line in (*DOOR, *GROOVE, *UNDERCUT):
        path, parts = arc_path(line, 1 * um), line.stretches
        leaves, arrives = directions(path)
        turns = abs((leaves - np.roll(arrives, 1) + np.pi) % (2 * np.pi) - np.pi)[0 if line.closed else 1 :]
        pairs = zip(parts, [*parts[1:], parts[0]] if line.closed else parts[1:], strict=False)
        corners = [before.points[:, -1] for before, after in pairs if not smooth(before, after)]
        starts = path.starts[:, 0 if line.closed else 1 :]
        on = np.array([any(np.hypot(*(corner - start)) < 1e-12 for corner in corners) for start in starts.T])
        assert on.sum() == len(corners)
        assert turns[~on].max() < 2e-5
        assert (turns[on] > 1e-3).all()


def test_few_arcs_are_enough_for_the_door_cam():
    """A prototype took 96 for 0.7 um and 180 for 0.1 um along one line of the groove."""
    pitch = next(line for line in DOOR if line.layer == "PITCH")
    for tolerance, most in ((0.7 * um, 96), (0.1 * um, 180)):
        path = arc_path(pitch, tolerance)
        assert len(path.bulges) <= most
        assert distances(path, np.hstack([part.finer(7).points for part in pitch.stretches])).max() < tolerance


def test_four_times_the_tolerance_of_chords_takes_half_as_many():
    line = GROOVE[0]
    assert len(chord_path(line, 4 * um).bulges) == pytest.approx(len(chord_path(line, 1 * um).bulges) / 2, rel=0.03)


def test_an_eccentric_becomes_arcs_of_its_radius():
    cam = cam_from_outline(DrawnOutline.circle(40 * mm, 0, -15 * mm), TranslatingRollerCam(groove=False))
    path = arc_path(contours(subjects(cam)[0])[0], 1 * um)
    assert len(path.bulges) <= 6
    turn = 4 * np.arctan(path.bulges)
    assert_allclose(np.hypot(*(path.ends - path.starts)) / (2 * np.sin(turn / 2)), 40 * mm, rtol=0, atol=1e-6)
    assert turn.sum() == pytest.approx(2 * np.pi, abs=1e-6)
    assert distances(path, np.array([[0.0], [-15 * mm]])) == pytest.approx(40 * mm, abs=0.1 * um)


def test_a_dwell_is_one_arc_about_the_axis():
    path = arc_path(GROOVE[1], 1 * um)
    turn = 4 * np.arctan(path.bulges)
    radius = np.hypot(*(path.ends - path.starts)) / (2 * np.sin(turn / 2))
    for level in (22 * mm, 42 * mm, 38 * mm, 58 * mm):
        found = abs(radius - level) < 1e-8
        assert found.sum() in (0, 1)
        assert (turn[found] > 50 * deg).all()


def test_a_circle_cam_under_a_face_takes_four_arcs():
    harmonic = SimpleHarmonic()
    turn = MotionProgram((Rise(180 * deg, 20 * mm, harmonic), Return(180 * deg, 20 * mm, harmonic)))
    path = arc_path(contours(subjects(TranslatingFlatCam(turn, 30 * mm))[0])[0], 0.01 * um)
    assert len(path.bulges) <= 4
    assert distances(path, np.array([[0.0], [-10 * mm]])) == pytest.approx(40 * mm, abs=1e-9)


def test_one_spline_for_each_smooth_run():
    assert [spline.closed for line in GROOVE for spline in splines(line, 1 * um)] == [True] * 3
    left = next(line for line in UNDERCUT if line.layer == "CAM")
    assert [spline.closed for spline in splines(left, 1 * um)] == [False, False]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1, 1)] * 3), min_size=3, max_size=6), st.booleans(), st.integers(0, 9999))
def test_distances_are_those_of_the_nearest_of_many_points(rows, closed, seed):
    x, y, bulges = np.array(rows).T
    path = ArcPath("CAM", np.array([x, y]), bulges if closed else bulges[:-1], closed)
    points = np.random.default_rng(seed).uniform(-2, 2, (2, 20))
    many = path.points(3000)
    near = cKDTree(many.T).query(points.T)[0]
    found = distances(path, points)
    assert (found <= near + 1e-7).all()  # radii of up to 1e7 m around arcs of 1 m
    assert (found >= near - np.hypot(*np.diff(many)).max() - 1e-7).all()
    assert distances(path, path.points(300)).max() < 1e-6
