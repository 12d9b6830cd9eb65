"""The cones of the ball joints, against search over all axes, and the frames of the links against turned vectors."""

from itertools import combinations, combinations_with_replacement

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls
from scipy.spatial.transform import Rotation

from camkit.files import Session, from_json, to_json
from camkit.linkage import RSSR, max_ball_angle, max_crank_ball_angle, max_rocker_ball_angle, max_stud_tilt
from camkit.linkage.ball_joints import smallest_cone
from camkit.machines import CabinDoorLinkage, rssr_study
from camkit.units import deg, mm
from camkit.views import ball_joints, linkage_in_space

SKEW = RSSR(60 * mm, 140 * mm, 110 * mm, 40 * mm, -30 * mm, 90 * mm, 55 * deg)
DOOR = CabinDoorLinkage()


def smallest(directions):
    """Half the smallest cone, in degrees, by trying every cone about two directions and through three."""
    p, best = directions.T, np.pi
    axes = [p[i] + p[j] for i, j in combinations_with_replacement(range(len(p)), 2)]
    for i, j, k in combinations(range(len(p)), 3):
        normal = np.cross(p[j] - p[i], p[k] - p[i])
        axes += [normal, -normal]
    axes = np.array([axis / np.linalg.norm(axis) for axis in axes if np.linalg.norm(axis) > 1e-9])
    best = np.arccos(np.clip(axes @ directions, -1, 1)).max(-1).min()
    return np.degrees(best)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.02, 0.7), st.integers(1, 12))
def test_the_cone_is_the_smallest_that_holds_all(seed, spread, n):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=3)[:, None] + spread * rng.normal(size=(3, n))
    points /= np.linalg.norm(points, axis=0)
    axis, best = smallest_cone(points)[:, 0], smallest(points)
    assert np.linalg.norm(axis) == pytest.approx(1)
    if best < 89:
        assert np.degrees(np.arccos(np.clip(axis @ points, -1, 1)).max()) == pytest.approx(best, abs=1e-5)


def test_the_cone_of_a_winding_curve():
    """No smaller cone holds it: its axis is a sum, none negative, of the directions that lie on the cone."""
    rng, turn = np.random.default_rng(4), np.linspace(0, 2 * np.pi, 361)
    waves = np.array([wave(n * turn) for n in (1, 2, 3) for wave in (np.cos, np.sin)])
    curves = rng.normal(size=(3, 1000, 1)) + 0.6 * rng.normal(size=(3, 1000, 6)) @ waves
    curves /= np.linalg.norm(curves, axis=0)
    axes, seen = smallest_cone(curves)[..., 0], 0
    for axis, curve in zip(axes.T, np.moveaxis(curves, 1, 0), strict=True):
        inward = axis @ curve
        if inward.min() > 0.05:
            _, missed = nnls(curve[:, inward < inward.min() + 1e-9], axis)
            assert missed < 1e-6
            seen += 1
    assert seen > 200


@pytest.mark.parametrize("sweep", [(15, 105), (-60, 60), (0, 350)])
def test_along_the_motion(sweep):
    a = SKEW.replace(crank=20 * mm).analyse(np.linspace(*sweep, 25) * deg)
    for ball in (a.crank_ball, a.rocker_ball):
        half = np.degrees(ball.angle.max())
        assert half == pytest.approx(smallest(ball.directions), abs=1e-5)
        space = ball.in_space(ball.axis)
        angle = np.arccos(np.clip((space * ball.along).sum(0), -1, 1))
        np.testing.assert_allclose(ball.angle, angle, atol=1e-7)


def test_the_frames_turn_with_the_links():
    """Turned back by the link's angle about its axis, a direction is what the link sees: up to one turn for all."""
    a = SKEW.analyse(np.linspace(15, 105, 7) * deg)
    crank = a.crank_ball, SKEW.crank_axis, a.crank_angle, a.coupler_direction
    rocker = a.rocker_ball, SKEW.rocker_axis, a.rocker_angle, -a.coupler_direction
    for ball, axis, angle, along in (crank, rocker):
        back = np.array([Rotation.from_rotvec(-x * axis).apply(u) for x, u in zip(angle, along.T, strict=True)])
        np.testing.assert_allclose(ball.directions.T @ ball.directions, back @ back.T, atol=1e-12)


def test_a_given_axis_and_a_stud():
    a = DOOR.analyse(31)
    axis = a.crank_ball.axis[:, 0]
    assert max_ball_angle("crank", tuple(axis))(a) == pytest.approx(max_crank_ball_angle(a))
    assert max_ball_angle("crank", (0, 0, 1))(a) > max_crank_ball_angle(a)
    rise = np.arcsin(abs(a.coupler_direction[2])).max()  # the crank turns about z
    assert max_stud_tilt("crank")(a) == pytest.approx(rise)
    planar = RSSR(50 * mm, 130 * mm, 90 * mm, 0.0, 0.0, 120 * mm, 0.0).analyse(np.linspace(15, 105, 31) * deg)
    assert max_stud_tilt("rocker")(planar) == pytest.approx(0, abs=1e-9)


def test_a_population_is_each_of_its_members():
    crank = np.array([[80.0], [90.0], [100.0], [120.0]]) * mm
    together = DOOR.replace(crank=crank).analyse(31)
    for measure in (max_crank_ball_angle, max_rocker_ball_angle, max_stud_tilt("rocker")):
        each = [measure(DOOR.replace(crank=float(x)).analyse(31)) for x in crank[:, 0]]
        np.testing.assert_allclose(measure(together), each, atol=1e-12)


def test_a_study_limits_it_and_a_file_knows_it():
    study = rssr_study(ball_angle=25 * deg)
    given = study.replace(at_most={**study.at_most, max_ball_angle("rocker", (1, 0, 2)): 40 * deg})
    read = from_json(to_json(Session(given, given.start))).study
    assert [m.name for m in read.at_most] == [m.name for m in given.at_most]
    x = study.x0[None]
    np.testing.assert_allclose(read.evaluate(x).g, given.evaluate(x).g)


def test_the_cones_are_drawn_where_the_coupler_stays():
    """At every angle of the sweep the coupler lies within both cones that are drawn, seen along their axes."""
    a = DOOR.analyse(31)
    for turn in a.crank_angle[::10]:
        here = a.at(turn)
        for ball, now in ((a.crank_ball, here.crank_ball), (a.rocker_ball, here.rocker_ball)):
            axis = now.in_space(ball.axis)[:, 0]
            assert np.linalg.norm(axis) == pytest.approx(1)
            assert np.arccos(axis @ now.along[:, 0]) <= ball.angle.max() + 1e-9
    marks = {mark.key for mark in linkage_in_space(a, turn=a.crank_angle[3], cones=True).marks}
    assert {"B cone", "C cone", "B half", "C sides"} <= marks
    assert {mark.key for mark in ball_joints(a).marks} >= {"crank", "rocker"}


def test_refusals():
    with pytest.raises(ValueError, match=r"^the joint is 'coupler'; it must be 'crank' or 'rocker'$"):
        max_ball_angle("coupler")
    with pytest.raises(
        ValueError, match=r"^the axis of the joint is \(0, 0, 0\); it must be three finite numbers, not"
    ):
        max_stud_tilt("crank", (0, 0, 0))
