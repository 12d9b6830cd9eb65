"""Meshes for printing as lib3mf, the reference implementation of 3MF, reads them: closed, outwards, exact, named."""

import struct
from collections import Counter

import lib3mf
import numpy as np
import pytest

from camkit import (
    DoorHandleCam,
    MotionProgram,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Return,
    Rise,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    inch,
    mm,
    um,
)
from camkit.cam import BarrelCam, ConjugatePair, OscillatingBarrelCam
from camkit.files import Blank, TitleBlock, write_3mf, write_stl
from camkit.files.workshop.printing import read_stl, stl
from camkit.motion import SimpleHarmonic

KINDS = (TranslatingRollerCam, OscillatingRollerCam, TranslatingFlatCam, OscillatingFlatCam, DoorHandleCam)
DRUMS = [
    kind(groove=groove, rotation=rotation)
    for kind in (BarrelCam, OscillatingBarrelCam)
    for groove, rotation in ((True, 1), (True, -1), (False, 1), (False, -1))
]
BASE, OFF = 25 * mm, 10 * mm
INCHES, MILLIMETRES = 3, 1


def eccentric(half=180 * deg, lift=2 * OFF):
    """A flat follower that is moved by a circle of the radius ``BASE + OFF`` about a centre ``OFF`` off the axis."""
    return MotionProgram((Rise(half, lift, SimpleHarmonic()), Return(half, lift, SimpleHarmonic())))


def plate():
    return TranslatingFlatCam(motion=eccentric(), base_radius=BASE)


def model_of(path):
    """The file as lib3mf reads it, without a warning."""
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader(path.suffix[1:])
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    return model


def bodies_of(model):
    """Name, points and triangles of every object, each closed and turned outwards."""
    found, objects = [], model.GetMeshObjects()
    while objects.MoveNext():
        body = objects.GetCurrentMeshObject()
        assert body.IsManifoldAndOriented()
        points = np.array([[*vertex.Coordinates] for vertex in body.GetVertices()], float)
        found.append((body.GetName(), points, np.array([[*each.Indices] for each in body.GetTriangleIndices()])))
    return found


def volume(points, triangles):
    return float(np.linalg.det(points[triangles]).sum() / 6)


def triangles_of(path):
    """The corners of a binary STL file, number by number."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    return [struct.unpack_from("<12f", data, 84 + 50 * k) for k in range(count)]


def test_an_eccentric_circle(tmp_path):
    blank = Blank(bore=0.0, thickness=8 * mm)
    written = write_stl(plate(), tmp_path / "cam.stl", tolerance=2 * um, blank=blank)
    ((_, points, triangles),) = bodies_of(model_of(written.path))
    exact = np.pi * 35**2 * 8
    assert volume(points, triangles) == pytest.approx(exact, rel=2 * 2e-3 / 35)
    flank = points[:, :2] - points[:, :2].mean(0)
    centre = (points.min(0) + points.max(0)) / 2
    assert np.hypot(*centre[:2]) == pytest.approx(10, abs=2e-3)
    assert np.hypot(*(points[:, :2] - centre[:2]).T) == pytest.approx(np.full(len(flank), 35.0), abs=4e-3)
    assert 0 < written.deviation <= 2 * um
    assert "lengths in mm" in written.what


def test_every_edge_of_an_stl_is_the_edge_of_two_triangles_and_normals_lead_outwards(tmp_path):
    blank = Blank(bore=20 * mm, key="DIN 6885-1", hub_diameter=36 * mm)
    path = write_stl(TranslatingRollerCam(), tmp_path / "cam.stl", blank=blank).path
    edges, whole = Counter(), 0.0
    for numbers in triangles_of(path):
        normal, a, b, c = (np.array(numbers[3 * k : 3 * k + 3]) for k in range(4))
        ways = [(tuple(p), tuple(q)) for p, q in ((a, b), (b, c), (c, a))]
        edges.update(ways)
        whole += a @ np.cross(b, c) / 6
        across = np.cross(b - a, c - a)
        if np.linalg.norm(across) > 1e-3:
            assert normal @ across / np.linalg.norm(across) == pytest.approx(1, abs=1e-3)
    assert whole > 0
    assert all(count == 1 and edges[q, p] == 1 for (p, q), count in edges.items())


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_closed_and_within_the_tolerance(tmp_path, kind):
    written = write_3mf(kind(), tmp_path / "cam.3mf", tolerance=5 * um)
    ((_, points, triangles),) = bodies_of(model_of(written.path))
    assert volume(points, triangles) > 0
    assert written.deviation <= 5 * um


def test_exact_points_of_a_groove_lie_on_both_walls(tmp_path):
    """The walls cut at half of the groove's depth: no point of the profiles is farther from that than the tolerance."""
    cam = OscillatingRollerCam()
    written = write_3mf(cam, tmp_path / "cam.3mf", tolerance=5 * um, blank=Blank(bore=0.0, groove_depth=6 * mm))
    ((_, points, triangles),) = bodies_of(model_of(written.path))
    corners, level = points[triangles], 7.0
    cut = []
    for k, m in ((0, 1), (1, 2), (2, 0)):
        p, q = corners[:, k], corners[:, m]
        across = (p[:, 2] < level) != (q[:, 2] < level)
        share = (level - p[:, 2]) / np.where(across, q[:, 2] - p[:, 2], 1.0)
        cut.append(np.where(across[:, None], p + share[:, None] * (q - p), np.nan)[:, :2])
    ends = np.stack(cut, axis=1)
    ends = ends[np.isfinite(ends[..., 0]).sum(1) == 2]
    start, end = np.moveaxis(ends[np.isfinite(ends[..., 0])].reshape(-1, 2, 2), 1, 0)
    analysis = cam.analyse(101)
    for flank in (analysis.profile, analysis.outer_profile):
        at = flank.T[:, None] / mm
        share = np.clip(((at - start) * (end - start)).sum(-1) / ((end - start) ** 2).sum(-1), 0, 1)
        away = np.linalg.norm(at - start - share[..., None] * (end - start), axis=-1).min(1)
        assert away.max() <= 5e-3


def test_bore_keyway_and_hub_by_hand(tmp_path):
    def found(**sizes):
        path = write_3mf(plate(), tmp_path / "cam.3mf", tolerance=0.2 * um, blank=Blank(**sizes)).path
        return volume(*bodies_of(model_of(path))[0][1:])

    solid, hub = found(bore=0.0), {"hub_diameter": 36 * mm, "hub_length": 15 * mm}
    bored = solid - np.pi * 10**2 * 10 + np.pi * (18**2 - 10**2) * 15
    x = np.linspace(-3, 3, 100001)
    slot = np.trapezoid(12.8 - np.sqrt(10**2 - x**2), x)
    assert found(bore=20 * mm, **hub) == pytest.approx(bored, rel=2e-5)
    assert found(bore=20 * mm, key="DIN 6885-1", **hub) == pytest.approx(bored - 25 * slot, rel=2e-5)


@pytest.mark.parametrize("cam", DRUMS, ids=lambda cam: f"{type(cam).__name__} {cam.groove} {cam.rotation}")
def test_drums_are_closed_and_their_flanks_where_they_touch_the_roller(tmp_path, cam):
    blank = Blank(bore=30 * mm, key="DIN 6885-1", hub_diameter=50 * mm)
    written = write_3mf(cam, tmp_path / "drum.3mf", tolerance=20 * um, blank=blank)
    ((_, points, triangles),) = bodies_of(model_of(written.path))
    assert volume(points, triangles) > 0
    assert written.deviation <= 20 * um
    assert np.hypot(*points[:, :2].T).max() == pytest.approx(cam.surface_radius / mm)


def test_a_groove_around_a_drum_that_moves_nothing_is_a_ring(tmp_path):
    """As wide as the roller, from the bottom to the surface."""
    cam = BarrelCam(motion=eccentric(180 * deg, 1e-9))
    drum, groove = BarrelCam(), write_stl(cam, tmp_path / "drum.stl", tolerance=2 * um, blank=Blank(bore=0.0))
    low, high = cam.analyse().ends
    whole = np.pi * drum.surface_radius**2 * (high - low) / mm**3
    ring = np.pi * (drum.surface_radius**2 - drum.bottom_radius**2) * 2 * drum.roller_radius / mm**3
    ((_, points, triangles),) = bodies_of(model_of(groove.path))
    assert whole - volume(points, triangles) == pytest.approx(ring, rel=2e-3)


def test_a_3mf_in_inches_says_so_and_names_come_back(tmp_path):
    name = "凸轮 <b>'\"&\n Кулачок"
    title = TitleBlock(title=name, author='O\'Neil & "居里"', faults=("undercut < 1",), date="2026-11-30")
    blank = Blank(bore=0.0, thickness=0.5 * inch)
    path = write_3mf(plate(), tmp_path / "cam.3mf", unit="in", title=title, blank=blank).path
    model, data = model_of(path), path.read_bytes()
    assert model.GetUnit() == INCHES
    ((_, points, _),) = bodies_of(model)
    assert np.ptp(points[:, 2]) == pytest.approx(0.5)
    group = model.GetMetaDataGroup()
    facts = {each.GetName(): each.GetValue() for each in map(group.GetMetaData, range(group.GetMetaDataCount()))}
    assert facts["Title"] == "FAULTY: " + " ".join(name.split())
    assert facts["Designer"] == title.author
    assert "FAULTY: undercut < 1" in facts["Description"]
    assert write_3mf(plate(), path, unit="in", title=title, blank=blank).path.read_bytes() == data
    assert model_of(write_3mf(plate(), path, blank=blank).path).GetUnit() == MILLIMETRES


def test_both_cams_of_a_pair_lie_beside_each_other(tmp_path):
    written = write_3mf(ConjugatePair(), tmp_path / "pair.3mf")
    (one, first, _), (other, second, _) = bodies_of(model_of(written.path))
    assert (one, other) == ("first cam", "second cam")
    assert second[:, 0].min() - first[:, 0].max() == pytest.approx(10, abs=1e-3)
    assert "2 bodies beside each other" in written.what


def test_a_drum_with_a_bore_as_large_as_its_bottom_is_refused(tmp_path):
    with pytest.raises(ValueError, match="the bottom of the groove is at 54 mm"):
        write_stl(BarrelCam(), tmp_path / "drum.stl", blank=Blank(bore=100 * mm, key="DIN 6885-1"))


def test_corners_that_single_precision_makes_one_leave_no_hole():
    made = stl(BarrelCam(groove=False))
    assert read_stl(made.data).watertight
