"""Views of cams by their marks: what is drawn is what the analysis says, in the units of the axes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import (
    DoorHandleCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    mm,
)
from camkit.cam.measures import max_pressure_angle
from camkit.quantities import quantities_of
from camkit.views import (
    cam_torque,
    contact_force,
    curvature,
    default_views,
    efficiency,
    mechanism,
    motion,
    pressure_angle,
)

DOOR = DoorHandleCam().analyse()
CAMS = (TranslatingRollerCam(groove=False), TranslatingFlatCam(), OscillatingRollerCam(), OscillatingFlatCam())
every_cam = pytest.mark.parametrize("cam", CAMS, ids=lambda cam: type(cam).__name__)


def points(mark):
    return np.stack([mark.x, mark.y])


@pytest.mark.parametrize("turn", [0, 41.3, 180])
def test_the_rollers_run_in_the_groove_that_is_drawn(turn):
    shown = mechanism(DOOR, turn=turn * deg)
    gap = np.inf
    for name in ("lift", "relief"):
        roller = shown[f"{name} roller"]
        assert roller.radius == 5
        for key in ("profile", "flank"):
            away = np.hypot(*(points(shown[key]) - np.reshape([roller.x, roller.y], (2, 1))))
            assert away.min() >= 5 - 0.05  # it is undercut a little
            gap = min(gap, abs(away.min() - 5))
        arm, pivot = points(shown[f"{name} arm"]), shown[f"{name} pivot"]
        assert_allclose(arm[:, 0], [pivot.x[0], pivot.y[0]])
        assert_allclose(arm[:, 1], [roller.x, roller.y])
        assert_allclose(np.hypot(*np.diff(arm)), getattr(DOOR.cam, f"{name}_arm") / mm)
    assert gap < 0.05


def test_the_solid_of_a_groove_lies_between_its_flanks_and_trouble_is_where_it_is_cut():
    shown = mechanism(DOOR)
    solid, n = points(shown["body"]), len(shown["profile"].x)
    assert_allclose(solid[:, :n], points(shown["profile"]))
    assert_allclose(solid[:, n:], points(shown["flank"])[:, ::-1])
    for key, cut in (("profile", DOOR.undercut), ("flank", DOOR.outer_undercut)):
        trouble = shown[f"{key} undercut"]
        assert trouble.role == "trouble"
        assert_array_equal(np.isfinite(trouble.x), cut)
        assert_allclose(points(trouble)[:, cut], points(shown[key])[:, cut])
    assert DOOR.outer_undercut.any()


@every_cam
@pytest.mark.parametrize("turn", [0, 77, 200, 345])
def test_the_follower_that_is_drawn_touches_the_cam_that_is_drawn(cam, turn):
    """No point of the profile inside roller or face, and one on it."""
    shown = mechanism(cam.analyse(1441), turn=turn * deg)
    profile = points(shown["profile"])
    (face,) = [mark for mark in shown.marks if mark.key.endswith(("roller", "face"))]
    if hasattr(face, "radius"):
        away = np.hypot(profile[0] - face.x, profile[1] - face.y) - face.radius
    else:
        (x0, x1), (y0, y1) = face.x, face.y
        normal = np.array([y0 - y1, x1 - x0]) / np.hypot(x1 - x0, y1 - y0)
        normal = normal * np.sign(normal @ [x0, y0])
        away = normal @ [x0, y0] - normal @ profile
    assert abs(away.min()) < 5e-3


@every_cam
def test_arms_and_stems_keep_their_length(cam):
    analysis = cam.analyse(91)
    lengths = [np.hypot(*np.diff(points(arm))) for turn in (0, 1, 2, 4) for arm in _arms(mechanism(analysis, turn))]
    assert_allclose(lengths, np.broadcast_to(lengths[0], np.shape(lengths)))


def _arms(shown):
    return [mark for mark in shown.marks if mark.key.endswith(" arm")]


@pytest.mark.parametrize(
    ("view", "name", "unit"),
    [
        (pressure_angle, "pressure_angle", deg),
        (contact_force, "contact_force", 1),
        (cam_torque, "cam_torque", mm),
        (curvature, "curvature", 1 / mm),
    ],
)
def test_a_curve_shows_every_cam_curve_in_its_unit(view, name, unit):
    shown = view(DOOR)
    for index, (key, curve) in enumerate(DOOR.curves.items()):
        mark = shown[key]
        assert (mark.role, mark.index) == ("series", index)
        assert_allclose(mark.x * deg, curve.cam_angle)
        assert_allclose(mark.y * unit, getattr(curve, name))


def test_names_are_in_the_legend_where_there_are_several():
    assert [mark.label for mark in contact_force(DOOR).marks] == ["lift", "relief"]
    assert [mark.label for mark in contact_force(CAMS[0].analyse(91)).marks] == [""]


def test_motion_is_drawn_where_the_follower_moves_over_its_own_peak():
    shown = motion(DOOR)
    for name, curve in DOOR.curves.items():
        for key, values in zip("svaj", curve.motion, strict=True):
            mark = shown[f"{name} {key}"]
            there = np.isfinite(mark.y)
            assert there[curve.velocity != 0].all()
            assert there.sum() <= (curve.velocity != 0).sum() + 4
            assert_allclose(mark.y[there] * abs(values).max(), values[there])


def test_the_band_of_the_pressure_angle_is_that_of_the_limits():
    band = pressure_angle(DOOR, limits={max_pressure_angle: 40 * deg})["allowed 0"]
    assert (band.low, band.high, band.role) == (pytest.approx(-40), pytest.approx(40), "allowed")
    assert all(mark.role == "series" for mark in pressure_angle(DOOR).marks)


def test_the_limit_of_the_curvature_is_the_rollers():
    shown = curvature(DOOR)
    assert_allclose(shown["limit 1"].y, 1 / 5)
    assert_allclose(shown["limit -1"].y, -1 / 5)
    profile = shown["relief profile"].y
    there = np.isfinite(profile)
    assert_allclose(profile[there], DOOR.relief.profile_curvature[there] * mm)
    assert abs(profile[there]).max() < 2 / 5
    assert np.isinf(curvature(TranslatingFlatCam().analyse(91))["limit 1"].y).all()


def test_the_efficiency_of_a_rocking_roller_has_the_published_one_beside_it():
    shown = efficiency(DOOR)
    moves = np.isfinite(shown["lift"].y)
    assert_allclose(shown["lift"].y[moves] / 100, DOOR.lift.efficiency[moves])
    assert_allclose(shown["lift published"].y[moves] / 100, DOOR.lift.published_efficiency[moves])
    assert "cam published" not in efficiency(CAMS[0].analyse(91))


@every_cam
@pytest.mark.parametrize("view", default_views(DoorHandleCam().analyse(91)), ids=lambda view: view.__name__)
def test_every_view_takes_every_cam(cam, view):
    shown = view(cam.analyse(91))
    assert shown.axes.title
    assert len(shown.marks) > 0


@pytest.mark.parametrize("cam", [TranslatingFlatCam(), OscillatingFlatCam()], ids=lambda cam: type(cam).__name__)
def test_a_flat_face_shows_no_roller(cam):
    """Neither in a legend nor as a slider; its pitch curve is the profile and is drawn once."""
    analysis = cam.analyse()
    labels = {mark.label for view in (mechanism, curvature) for mark in view(analysis).marks}
    assert not any("roller" in label or "pitch" in label for label in labels)
    assert "friction.roller_pin" not in quantities_of(cam)
    rolling = TranslatingRollerCam(groove=False)
    shown = [view(rolling.analyse()) for view in (mechanism, curvature)]
    assert {"pitch curve", "1 / roller radius"} <= {mark.label for picture in shown for mark in picture.marks}
    assert "friction.roller_pin" in quantities_of(rolling)
