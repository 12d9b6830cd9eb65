"""Limits for inspection from tolerances: held against closed forms, and against parts that are cut one by one."""

import csv
import io

import numpy as np
import pytest
from every_machine import MACHINES
from numpy.testing import assert_allclose
from scipy.spatial import cKDTree

from camkit import DoorHandleCam, TranslatingFlatCam, TranslatingRollerCam, ValveCam, deg, mm, um
from camkit.cam import BarrelCam
from camkit.files import write_table
from camkit.files.workshop.exports import Order, exports_of
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.tables import LIMIT, table
from camkit.quantities import value_of
from camkit.study import Study, Tolerances
from camkit.study.tolerances import general_tolerances

T = 40 * um


def inspected(cam, **options):
    """Points, normals, lower and upper limit, in m."""
    data = table(cam, "inspection", **options).data.decode("utf-8-sig")
    rows = [*csv.DictReader(io.StringIO(data))]
    lengths = [[float(row[f"{name} [mm]"]) * mm for row in rows] for name in ("X", "Y", "lower limit", "upper limit")]
    normals = [[float(row[name]) for row in rows] for name in "IJ"]
    return np.array(lengths[:2]), np.array(normals), np.array(lengths[2]), np.array(lengths[3])


def test_the_base_radius_of_a_flat_cam_moves_its_profile_by_as_much():
    """The face is square to the normal and moves along it: ``n . (n t) = t`` at every point."""
    _, _, lower, upper = inspected(TranslatingFlatCam(), tolerances={"base_radius": T})
    assert_allclose(lower, -T, rtol=0, atol=2e-11)
    assert_allclose(upper, T, rtol=0, atol=2e-11)


def test_the_base_radius_of_a_roller_cam_moves_its_profile_by_the_cosine_of_the_pressure_angle():
    """The roller moves along its path by ``t``, of which ``t cos(alpha)`` is along the normal, to first order."""
    cam = TranslatingRollerCam(groove=False)
    points, _, lower, upper = inspected(cam, tolerances={"base_radius": T})
    analysis = cam.analyse(20_001)
    cosine = np.cos(analysis.pressure_angle)[cKDTree(analysis.profile.T).query(points.T)[1]]
    assert cosine.min() < 0.95
    assert_allclose(upper, T * cosine, rtol=0, atol=0.002 * T)
    assert_allclose(lower, -T * cosine, rtol=0, atol=0.002 * T)


def test_the_radius_of_a_roller_in_a_groove_widens_it_on_a_fixed_pitch_curve():
    """With the base radius less by as much the roller's centre stays: both walls go away from it by ``t``."""
    _, _, lower, upper = inspected(DoorHandleCam(roller_radius=2 * mm), tolerances={"roller_radius": T})
    assert_allclose(lower, -T, rtol=0, atol=1e-8)
    assert_allclose(upper, T, rtol=0, atol=1e-8)


def along_normals(points, normals, curve, reach=2 * mm):
    """Where lines along normals cross a polyline next to their points, m."""
    found = []
    for p, n in zip(points.T, normals.T, strict=True):
        across, up = np.stack([[-n[1], n[0]], n]) @ (curve - p[:, None])
        k = np.flatnonzero((across[:-1] * across[1:] <= 0) & (abs(up[:-1]) < reach))
        share = across[k] / (across[k] - across[k + 1])
        at = up[k] + share * (up[k + 1] - up[k])
        found.append(at[abs(at).argmin()] if len(at) else np.nan)
    return np.array(found)


@pytest.mark.parametrize("name", ["roller in a groove", "roller on an arm", "face on an arm", "valve", "high speed"])
def test_no_part_within_the_tolerances_lies_beyond_its_limits_and_some_lie_at_them(name):
    """Twenty parts at random corners of the box, analysed one by one and cut with the normals."""
    cam = MACHINES[name]
    halves = {p: half / 4 if half < 2 * mm else 0.02 * deg for p, half in general_tolerances(cam).items()}
    points, normals, lower, upper = inspected(cam, tolerances=halves)
    whole = subjects(cam)[0].analysis
    walls = [whole.profile, whole.outer_profile][: 1 + np.isfinite(whole.outer_profile).all()]
    which = np.argmin([cKDTree(wall.T).query(points.T)[0] for wall in walls], axis=0)
    rng, seen = np.random.default_rng(3), []
    corners = rng.choice([-1, 1], (20, len(halves)))
    for corner in [*corners, *-corners]:
        part = cam.replace(**{p: value_of(cam, p) + c * h for (p, h), c in zip(halves.items(), corner, strict=True)})
        analysis = part.analyse(6001)
        analysis = getattr(analysis, "whole", analysis)
        cut = [along_normals(points, normals, wall) for wall in (analysis.profile, analysis.outer_profile)]
        seen.append(np.where(which, cut[1], cut[0]))
    least, most = np.nanmin(seen, axis=0), np.nanmax(seen, axis=0)
    slack = 0.3 * um
    assert (least >= lower - slack).all()
    assert (most <= upper + slack).all()
    assert (most > 0.6 * upper).mean() > 0.5
    assert abs(most / upper - 1).min() < 0.01


def test_a_drums_groove_moves_as_its_follower_does():
    """Its mean radius leaves the roller where it is; a wider roller moves both flanks out of the groove's middle."""
    made = table(BarrelCam(), "inspection", tolerances={"roller_radius": T})
    rows = [*csv.DictReader(io.StringIO(made.data.decode("utf-8-sig")))]
    assert_allclose([float(row["upper limit [mm]"]) * mm for row in rows], T, rtol=0, atol=1e-8)


def test_tolerances_of_a_study_or_by_path_are_the_same_and_what_moves_nothing_leaves_plain_limits(tmp_path):
    cam = TranslatingFlatCam()
    halves = {"base_radius": T}
    parts = Tolerances(Study(cam, ["base_radius"], (cam.measures[0],)), halves, parts=4)
    one, other = (table(cam, "inspection", tolerances=given).data for given in (halves, parts))
    assert one == other
    assert inspected(cam, tolerances={"load.spring_rate": 1.0})[3] == pytest.approx(LIMIT)
    done = write_table(cam, tmp_path / "points.csv", "inspection", tolerances=halves, unit="in")
    assert done.deviation < 1e-9


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"bass_radius": T}, "'bass_radius' is no quantity of TranslatingFlatCam"),
        ({"base_radius": -T}, "the tolerance of the base radius is"),
        ({"base_radius": float("inf")}, "the tolerance of the base radius is"),
        ({"base_radius": 1.0}, "a part within them cannot be built"),
        (0.1, "tolerances"),
    ],
)
def test_tolerances_that_make_no_sense_are_refused(tmp_path, given, said):
    with pytest.raises(ValueError, match=said):
        write_table(TranslatingFlatCam(), tmp_path / "points.csv", "inspection", tolerances=given)


def test_the_zip_has_the_largest_deviation_in_drawing_and_inspection_file():
    """The same to both sides everywhere, as the drawing's zone is: what a base radius does where the path is radial."""
    order = Order(ValveCam(), tolerances={"base_radius": T})
    made = {export.key: export.make for export in exports_of(order) if export.key in ("inspection", "picture")}
    assert order.limits == pytest.approx((-T, T), rel=1e-5)
    assert made["inspection"](order).data == table(ValveCam(), "inspection", limits=order.limits).data
    assert b"0.08" in made["picture"](order).data
    wider = Order(ValveCam(), tolerances={"base_radius": T, "max_lift": 2 * T})
    _, _, *both = inspected(ValveCam(), tolerances=wider.tolerances)
    assert wider.limits[1] == pytest.approx(np.max(np.abs(both)), rel=1e-8)
    assert wider.limits[1] == pytest.approx(3 * T, rel=1e-3)
