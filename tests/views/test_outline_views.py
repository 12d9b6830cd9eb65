"""A measured outline laid over a design: what is drawn and told is the distance between the two."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.cam import DrawnOutline, MeasuredOutline, cam_from_outline
from camkit.cam.compared import compared
from camkit.program import record
from camkit.quantities import quantities_of, value_of
from camkit.units import deg, mm, um
from camkit.views import Beside, default_views, deviation_over, laid_over, outline_deviation, outline_laid_over

FOLLOWERS = (
    TranslatingRollerCam(groove=False, offset=4 * mm),
    TranslatingFlatCam(),
    OscillatingRollerCam(groove=False, centre_distance=90 * mm, arm_length=70 * mm, rotation=-1),
    OscillatingFlatCam(centre_distance=90 * mm),
)
ECCENTRIC = DrawnOutline.circle(40 * mm, 0, -15 * mm)


def stands_out(x, y):
    """How far points (m) stand out of the circle."""
    return np.hypot(x, y + 15 * mm) - 40 * mm


@pytest.mark.parametrize("follower", FOLLOWERS, ids=lambda cam: type(cam).__name__)
def test_the_deviation_is_the_distance_from_the_profile(follower):
    design = cam_from_outline(ECCENTRIC, follower)
    turn = np.arange(0, 360, 3) * deg
    r = 40 * mm + 20 * um * np.sin(5 * turn) + 3 * um * np.cos(17 * turn)
    worn = np.array([r * np.cos(turn), r * np.sin(turn) - 15 * mm])
    found = MeasuredOutline(worn.T).compared(design.analyse(361))
    assert_allclose(found.deviation, stands_out(*found.points), rtol=0, atol=1e-9)
    assert_allclose(stands_out(*found.foot), 0, atol=5e-9)
    assert found.largest == pytest.approx(abs(r - 40 * mm).max(), rel=1e-3)
    picture = laid_over(MeasuredOutline(worn.T))(design.analyse(361))
    assert picture.axes.title == "Outline against the design, deviation x 200"
    x, y = (np.asarray(v)[:-1] * mm for v in (picture["measured"].x, picture["measured"].y))
    assert_allclose(stands_out(x, y), 200 * found.deviation, rtol=0, atol=1e-6)
    line = deviation_over(MeasuredOutline(worn.T))(design.analyse(361))["deviation"]
    assert_allclose(np.asarray(line.y) * mm, found.deviation)


def test_the_largest_deviations_are_told_with_their_angles():
    turn = np.arange(0, 360, 3) * deg
    r = 40 * mm + np.where(np.arange(120) == 11, 50 * um, 0) - np.where(np.arange(120) == 70, 30 * um, 0)
    worn = np.array([r * np.cos(turn), r * np.sin(turn)]) - np.array([[0], [15 * mm]])
    design = cam_from_outline(ECCENTRIC, FOLLOWERS[0])
    picture = laid_over(MeasuredOutline(worn.T))(design.analyse())
    polar = np.degrees(np.arctan2(worn[1], worn[0])) % 360
    told = [mark.words for mark in picture.marks if mark.key.endswith("told")]
    assert len(told) == 8
    assert f"+0.0500 mm at {polar[11]:.1f} deg" in " ".join(told)
    assert f"-0.0300 mm at {polar[70]:.1f} deg" in " ".join(told)


def test_many_points_keep_the_one_that_stands_out():
    turn = 2 * np.pi * np.arange(5000) / 5000
    r = np.where(np.arange(5000) == 1234, 40.05 * mm, 40 * mm)
    found = MeasuredOutline(np.array([r * np.cos(turn), r * np.sin(turn) - 15 * mm]).T).compared(
        cam_from_outline(ECCENTRIC, FOLLOWERS[0]).analyse()
    )
    assert found.points.shape[1] <= 720
    assert found.largest == pytest.approx(50 * um, rel=1e-6)


@pytest.mark.parametrize("rotation", [1, -1])
def test_what_the_follower_leaps_over_is_no_deviation(rotation):
    hollow = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm, -60 * mm)
    cam = TranslatingRollerCam(roller_radius=75 * mm, groove=False, rotation=rotation)
    found = cam_from_outline(hollow, cam).motion.compared(cam_from_outline(hollow, cam).analyse())
    untouched = np.isnan(found.deviation)
    x, y = found.points / mm
    on_circles = np.minimum(abs(np.hypot(x, y) - 25), abs(np.hypot(x, y - 40) - 8)) < 1e-9
    assert 0.1 < untouched.mean() < 0.5
    assert not (untouched & on_circles & (y < 10)).any()
    assert untouched[~on_circles].all()
    assert found.largest < 1e-9


def test_a_cam_with_an_outline_shows_it_by_itself():
    design = cam_from_outline(ECCENTRIC, FOLLOWERS[0])
    analysis = design.analyse()
    assert default_views(analysis)[-1] is outline_deviation
    assert outline_laid_over(analysis)["measured"].label == "outline"
    assert abs(np.asarray(outline_deviation(analysis)["deviation"].y)).max() < 1e-6


def test_it_follows_the_sliders_of_a_page():
    """Recorded, the pictures are those of another design to the last digits."""
    design = cam_from_outline(ECCENTRIC, FOLLOWERS[0])

    def shown(cam):
        analysis = cam.analyse(181)
        over, line = outline_laid_over(analysis), outline_deviation(analysis)["deviation"]
        return {"x": over["measured"].x, "y": over["measured"].y, "line": line.y, "title": over.axes.title}

    program = record(shown, design)
    larger = design.replace(base_radius=design.base_radius + 0.1 * mm)
    values = {path: value_of(larger, path) for path in quantities_of(larger)}
    expected, found = shown(larger), program(values)
    assert found["title"] == expected["title"] == "Outline against the design, deviation x 50"
    for name in ("x", "y", "line"):
        assert_allclose(found[name], expected[name], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rotation", [1, -1])
def test_a_leap_at_the_turns_end_is_seen_as_one(rotation):
    hollow = DrawnOutline.tangent(25 * mm, 8 * mm, 40 * mm, -60 * mm)
    cam = TranslatingRollerCam(roller_radius=75 * mm, groove=False, rotation=rotation)
    at = rotation * cam_from_outline(hollow, cam).motion.jumps[0][0]
    turn = np.array([[np.cos(at), np.sin(at)], [-np.sin(at), np.cos(at)]])
    turned = DrawnOutline(np.array(hollow.corners) @ turn, hollow.bulges)
    found = cam_from_outline(turned, cam)
    assert min(found.motion.jumps[0][0], 2 * np.pi - found.motion.jumps[-1][0]) < 1e-6
    assert found.motion.compared(found.analyse()).largest < 1e-9


def test_points_beside_a_corner_are_compared_with_its_flanks():
    square = DrawnOutline(tuple((0.02 * x, 0.02 * y) for x, y in ((1, -1), (1, 1), (-1, 1), (-1, -1))))
    analysis = cam_from_outline(square, TranslatingRollerCam(roller_radius=12 * mm, groove=False)).analyse()
    points = np.array([[0.02, 0.0199, -0.02, 0.02], [0.0199, 0.02, 0.0199, -0.0199]])
    assert_allclose(compared(points, analysis).deviation, 0, atol=0.5 * um)
    assert_allclose(compared(points * 1.0005, analysis).deviation, 0.0005 * 0.02, atol=0.5 * um)


def test_what_is_compared_is_one_design():
    several = TranslatingRollerCam(roller_radius=np.array([[8.0], [9.0]]) * mm).analyse(31)
    with pytest.raises(ValueError, match="the analysis is a population, a TranslatingRollerCam with columns"):
        ECCENTRIC.compared(several)
    with pytest.raises(ValueError, match="the analysis of two is a population"):
        Beside({"one": TranslatingRollerCam().analyse(31), "two": several})
