"""STEP files as another process reads them with Open CASCADE: one valid solid, its volume, its names and units."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest

from camkit import (
    RSSR,
    DoorHandleCam,
    MotionProgram,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Return,
    Rise,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    deg,
    inch,
    mm,
    um,
)
from camkit.cam import BarrelCam, ConjugatePair
from camkit.files import Blank, TitleBlock, write_step
from camkit.files.workshop.solid import Tube, step, tubes_step
from camkit.machines import CabinDoorLinkage
from camkit.motion import SimpleHarmonic

READER = """
import json, sys
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.Bnd import Bnd_Box
from OCP.GProp import GProp_GProps
from OCP.gp import gp_Pnt
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer

path, points = sys.argv[1], json.loads(sys.argv[2])
reader = STEPControl_Reader()
assert int(reader.ReadFile(path)) == 1
reader.TransferRoots()
shape, found = reader.OneShape(), []
explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
while explorer.More():
    solid, about, box = explorer.Current(), GProp_GProps(), Bnd_Box()
    BRepGProp.VolumeProperties_s(solid, about)
    BRepBndLib.AddOptimal_s(solid, box)
    at = about.CentreOfMass()
    found.append(dict(valid=BRepCheck_Analyzer(solid).IsValid(), volume=about.Mass(), centre=[at.X(), at.Y(), at.Z()],
                      low=box.CornerMin().Z(), high=box.CornerMax().Z()))
    explorer.Next()
faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SHELL).Current()
away = [BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(gp_Pnt(*p)).Vertex(), faces).Value() for p in points]
print("FOUND" + json.dumps([found, away]))
"""
KINDS = (TranslatingRollerCam, OscillatingRollerCam, TranslatingFlatCam, OscillatingFlatCam)
PLAIN = Blank(bore=0.0, thickness=10 * mm)
BASE, OFF = 25 * mm, 10 * mm


def read(path, points=()):
    """Its solids, and how far points are from the first of them, in mm."""
    run = [sys.executable, "-c", READER, str(path), json.dumps([list(point) for point in points])]
    done = subprocess.run(run, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.rpartition("FOUND")[2])


def eccentric(**sizes):
    """A flat follower that is moved by a circle of the radius ``BASE + OFF`` about a centre ``OFF`` off the axis."""
    law = SimpleHarmonic()
    program = MotionProgram((Rise(180 * deg, 2 * OFF, law), Return(180 * deg, 2 * OFF, law)))
    return TranslatingFlatCam(motion=program, base_radius=BASE, **sizes)


def area(points):
    x, y = points
    return abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2


def volume(tmp_path, cam, blank, **options):
    written = write_step(cam, tmp_path / "cam.step", blank=blank, **options)
    ((solid,), _) = read(written.path)
    assert solid["valid"]
    return solid["volume"] * mm**3


def test_an_eccentric_circle(tmp_path):
    written = write_step(eccentric(), tmp_path / "cam.step", blank=PLAIN)
    ((solid,), _) = read(written.path)
    radius = BASE + OFF
    assert solid["valid"]
    assert solid["volume"] * mm**3 == pytest.approx(np.pi * radius**2 * PLAIN.thickness, rel=1e-6)
    assert np.hypot(*solid["centre"][:2]) * mm == pytest.approx(OFF, rel=1e-6)
    assert solid["centre"][2] * mm == pytest.approx(PLAIN.thickness / 2)
    assert written.deviation < 1 * um
    assert written.what.startswith("1 solid of")


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_the_volume_between_its_flanks(tmp_path, kind):
    cam = kind()
    analysis = cam.analyse(20001)
    flank = area(analysis.profile[:, :-1])
    groove = np.isfinite(analysis.outer_profile).all()
    blank = Blank(bore=12 * mm, outer_diameter=0.25, groove_depth=6 * mm)
    exact = (flank - np.pi * (6 * mm) ** 2) * 10 * mm
    if groove:
        pocket = area(analysis.outer_profile[:, :-1]) - flank
        exact = np.pi * ((0.25 / 2) ** 2 - (6 * mm) ** 2) * 10 * mm - pocket * 6 * mm
    tolerance = 1 * um if groove else 0.05 * um  # along both walls the arcs of a groove err alike
    assert volume(tmp_path, cam, blank, tolerance=tolerance) == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize("tolerance", [10 * um, 0.2 * um])
@pytest.mark.parametrize("kind", KINDS)
def test_exact_points_lie_on_its_faces(tmp_path, kind, tolerance):
    cam = kind()
    written = write_step(cam, tmp_path / "cam.step", tolerance=tolerance, blank=PLAIN)
    points = cam.analyse(32).profile.T / mm
    _, away = read(written.path, [(*point, 9.0) for point in points])
    assert max(away) * mm <= tolerance + 1e-9
    assert written.deviation <= tolerance + 1e-9


def test_a_groove_that_does_not_go_around_is_its_length_by_its_width_and_a_circle(tmp_path):
    cam = DoorHandleCam(roller_radius=2 * mm)
    pitch = cam.analyse(20001).pitch
    length, r = np.hypot(*np.diff(pitch)).sum(), 2 * mm
    blank = Blank(bore=0.0, outer_diameter=0.3, groove_depth=6 * mm)
    whole = np.pi * 0.15**2 * 10 * mm
    pocket = whole - volume(tmp_path, cam, blank)
    assert pocket == pytest.approx((2 * r * length + np.pi * r**2) * 6 * mm, rel=1e-5)


def test_what_is_left_of_an_undercut_groove_is_one_valid_solid_that_says_it_is_faulty(tmp_path):
    title = TitleBlock(title="door", faults=("undercut",))
    written = write_step(DoorHandleCam(), tmp_path / "cam.step", title=title)
    ((solid,), _) = read(written.path)
    assert solid["valid"]
    text = written.path.read_text()
    assert "PRODUCT('FAULTY: door'" in text
    assert "'FAULTY: undercut'" in text


def test_bore_keyway_and_hub(tmp_path):
    cam, hub = eccentric(), 36 * mm
    bored = Blank(bore=20 * mm, hub_diameter=hub, hub_length=15 * mm)
    keyed = Blank(bore=20 * mm, hub_diameter=hub, hub_length=15 * mm, key="DIN 6885-1", key_angle=30 * deg)
    solid = volume(tmp_path, cam, PLAIN)
    ring = np.pi * (18**2 - 10**2) * mm**2
    with_bore = solid - np.pi * (10 * mm) ** 2 * 10 * mm + ring * 15 * mm
    assert volume(tmp_path, cam, bored) == pytest.approx(with_bore, rel=1e-6)
    x = np.linspace(-3, 3, 100001)  # 6 mm wide, 2.8 mm deep at its middle, by strips
    slot = np.trapezoid(12.8 - np.sqrt(10**2 - x**2), x) * mm**2
    assert volume(tmp_path, cam, keyed) == pytest.approx(with_bore - slot * 25 * mm, rel=1e-6)


def test_in_inches_the_numbers_are_inches(tmp_path):
    blank = Blank(bore=0.0, thickness=0.5 * inch)
    written = write_step(eccentric(), tmp_path / "cam.step", unit="inch", blank=blank)
    text = written.path.read_text()
    assert "CONVERSION_BASED_UNIT('INCH'" in text
    points = re.findall(r"CARTESIAN_POINT\('',\(([^)]*)\)\)", text)
    heights = {float(point.split(",")[2]) for point in points if point.count(",") == 2}
    assert sorted(heights) == pytest.approx([0.0, 0.5])
    ((solid,), _) = read(written.path)
    assert solid["volume"] * mm**3 == pytest.approx(np.pi * (BASE + OFF) ** 2 * 0.5 * inch, rel=1e-6)


@pytest.mark.parametrize("name", ["凸轮 Кулачок", "O'Neil \\ <script> =1+1", "two\nlines 😀"])
def test_names_come_back_as_they_were_typed(name):
    from camkit.files.workshop.step_file import read_step

    made = step(eccentric(), title=TitleBlock(title=name, author=name, date="2026-11-30"), blank=PLAIN)
    made.data.decode("ascii")
    assert read_step(made.data)[0] == name.replace("\n", " ")
    assert step(eccentric(), title=TitleBlock(title=name, author=name, date="2026-11-30"), blank=PLAIN) == made


def test_both_cams_of_a_pair_stand_on_one_shaft(tmp_path):
    from camkit.files.workshop.step_file import read_step

    blank = Blank(hub_diameter=30 * mm, hub_length=8 * mm)
    written = write_step(ConjugatePair(), tmp_path / "pair.step", blank=blank)
    (one, other), _ = read(written.path)
    assert one["valid"]
    assert other["valid"]
    assert [solid["low"] for solid in (one, other)] == pytest.approx([-8, 10], abs=1e-4)
    assert [solid["high"] for solid in (one, other)] == pytest.approx([10, 28], abs=1e-4)
    name, parts = read_step(written.path.read_bytes())
    assert (name, [part.name for part in parts]) == ("Conjugate pair", ["first cam", "second cam"])


def test_a_drum_says_what_there_is_of_it(tmp_path):
    with pytest.raises(ValueError, match="is a drum"):
        write_step(BarrelCam(), tmp_path / "cam.step")


def test_tubes_in_space(tmp_path):
    tubes = [
        Tube("tube 管", np.zeros(3), np.array([0.1, 0.2, 0.3]), 50 * mm, 44 * mm),
        Tube("pin", np.array([0.1, 0.2, 0.3]), np.array([0.1, 0.3, 0.3]), 20 * mm),
    ]
    made = tubes_step(tubes, "UniversalJointShaft", unit="in")
    path = tmp_path / "shaft.step"
    path.write_bytes(made.data)
    (tube, pin), _ = read(path)
    assert tube["volume"] == pytest.approx(np.pi * (25**2 - 22**2) * 100 * np.sqrt(14), rel=1e-9)
    assert pin["volume"] == pytest.approx(np.pi * 10**2 * 100, rel=1e-9)
    assert tube["centre"] == pytest.approx([50, 100, 150])
    assert made.deviation < 1e-9
    with pytest.raises(ValueError, match="pin is 0 mm long"):
        tubes_step([tubes[1]._replace(start=tubes[1].end)], "Shaft")


@pytest.mark.parametrize(("link", "section"), [(12 * mm, np.pi * 6**2), ((20 * mm, 16 * mm), np.pi * (10**2 - 8**2))])
@pytest.mark.parametrize("linkage", [CabinDoorLinkage(), RSSR(crank=20 * mm, axis_distance=30 * mm)])
def test_the_links_of_a_linkage_are_bars_between_its_joints(tmp_path, linkage, link, section):
    """Volumes are lengths by areas; the closure alone says where the rocker is, each link that it is as long."""
    written = write_step(linkage, tmp_path / "linkage.step", link=link)
    bars, _ = read(written.path)
    lengths = [linkage.crank / mm, linkage.coupler / mm, linkage.rocker / mm]
    assert all(bar["valid"] for bar in bars)
    assert [bar["volume"] for bar in bars] == pytest.approx([section * length for length in lengths], rel=1e-9)
    analysis, root = linkage.analyse(), np.array([0.0, 0.0, linkage.crank_offset])
    phi = analysis.crank_angle[0]
    pin = root + linkage.crank * np.array([np.cos(phi), np.sin(phi), 0.0])
    assert bars[0]["centre"] == pytest.approx((root + pin) / 2 / mm, abs=1e-9)
    other = 2 * np.array(bars[1]["centre"]) * mm - pin
    far = 2 * np.array(bars[2]["centre"]) * mm - other
    axis = np.array([0.0, np.sin(linkage.axis_angle), np.cos(linkage.axis_angle)])
    assert far == pytest.approx([linkage.axis_distance, 0, 0] + linkage.rocker_offset * axis, abs=1e-9)
    assert np.linalg.norm(other - pin) == pytest.approx(linkage.coupler)
    assert np.linalg.norm(other - far) == pytest.approx(linkage.rocker)
    assert (other - far) @ axis == pytest.approx(0, abs=1e-9)
    from camkit.files.workshop.step_file import read_step

    assert [bar.name for bar in read_step(written.path.read_bytes())[1]] == ["CRANK", "COUPLER", "ROCKER"]
    assert written.deviation < 1e-9


def test_a_shaft_is_its_tube_and_says_which_standard_one(tmp_path):
    shaft = UniversalJointShaft(outer_diameter=139.7 * mm, inner_diameter=114.7 * mm, length=1.5)
    written = write_step(shaft, tmp_path / "shaft.step")
    ((tube,), _) = read(written.path)
    assert tube["valid"]
    assert tube["volume"] == pytest.approx(np.pi / 4 * (139.7**2 - 114.7**2) * 1500, rel=1e-9)
    assert tube["centre"] == pytest.approx([750, 0, 0], abs=1e-9)
    assert written.remarks == ("tube EN 10210-2 139.7 x 12.5",)
    assert "tube EN 10210-2 139.7 x 12.5" in written.path.read_text()
    assert written.deviation < 1e-9


@pytest.mark.parametrize("link", [0.0, -1 * mm, (10 * mm, 12 * mm), (1 * mm,) * 3, float("nan"), "thick"])
def test_links_of_no_diameter_are_refused(link):
    with pytest.raises(ValueError, match="the diameter of the links"):
        step(CabinDoorLinkage(), link=link)
