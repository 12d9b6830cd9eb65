"""Tables for the workshop, read back by csv and openpyxl and held against geometry, differences and closed forms."""

import csv
import io
import re

import numpy as np
import openpyxl
import pytest
from every_machine import MACHINES
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial import cKDTree

from camkit import (
    RSSR,
    Cycloidal,
    Dwell,
    MotionProgram,
    OscillatingRollerCam,
    Poly345,
    Return,
    Rise,
    SimpleHarmonic,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    deg,
    inch,
    lbf,
    mm,
    um,
)
from camkit.cam import BarrelCam, OscillatingBarrelCam
from camkit.cam.pair import ConjugatePair
from camkit.files import TitleBlock, write_dxf, write_table
from camkit.files.workshop.cad_curves import CAD, read_cad_curve
from camkit.files.workshop.controllers import FORMS, controller_table
from camkit.files.workshop.exports import Order, exports_of
from camkit.files.workshop.inspection import evenly
from camkit.files.workshop.named import curves_of, named_contours
from camkit.files.workshop.polar import polar
from camkit.files.workshop.sheets import Sheet
from camkit.files.workshop.skeleton import skeleton, tube_callout
from camkit.files.workshop.subject import subjects
from camkit.files.workshop.tables import KINDS, table
from camkit.files.workshop.written import Made
from camkit.linkage import DoubleUniversalJoint, Driveline, UniversalJoint
from camkit.machines import CabinDoorLinkage, DoorHandleCam, ValveCam
from camkit.motion import ModifiedSine

HALVES = Rise(180 * deg, 50 * mm, SimpleHarmonic()), Return(180 * deg, 50 * mm, SimpleHarmonic())
CIRCLE = TranslatingFlatCam(MotionProgram(HALVES), base_radius=25 * mm)
"""A circle of R 50 with its centre 25 mm below the axis: ``s = 25 (1 - cos phi)`` under a face."""
DRUMS = BarrelCam, OscillatingBarrelCam


def text_table(data):
    return [*csv.reader(io.StringIO(data.decode("utf-8-sig"), newline=""))]


def columns(made):
    head, *rows = text_table(made.data)
    return {name: np.array([np.nan if x == "" else float(x) for x in column])
            for name, column in zip(head, zip(*rows, strict=True), strict=True)
            if all(re.fullmatch(r"[-+0-9.e]*", x) for x in column)}  # fmt: skip


# ---------------------------------------------------------------- polar


def test_a_circle_below_the_axis_has_its_radii():
    (cam,) = subjects(CIRCLE)
    direction = np.arange(360) * deg
    r = polar(cam, direction)["profile"]
    assert r[0] == pytest.approx(43.30127018922193 * mm, abs=1e-10)
    assert r[90] == pytest.approx(25 * mm, abs=1e-10)
    s, c = np.sin(direction), np.cos(direction)
    assert_allclose(r, (-25 * s + np.sqrt(50**2 - 25**2 * c**2)) * mm, rtol=0, atol=1e-9)
    found = columns(table(CIRCLE, "polar"))
    assert found["direction [deg]"].tolist() == list(range(360))
    assert_allclose(found["profile radius [mm]"] * mm, r, rtol=0, atol=1e-12)
    assert columns(table(CIRCLE, "polar", unit="in"))["profile radius [in]"][90] == pytest.approx(25 * mm / inch)


@pytest.mark.parametrize(
    "name", ["face", "face on an arm", "valve", pytest.param("door handle", marks=pytest.mark.slow)]
)
def test_radii_are_where_the_dense_profile_crosses_the_ray(name):
    """Brute force: a polyline through 20 001 points of the analysis, its segments crossed with every ray."""
    (cam,) = subjects(MACHINES[name])
    analysis = getattr(MACHINES[name].analyse(20_001), "whole", MACHINES[name].analyse(20_001))
    found = polar(cam, np.arange(0, 360, 7) * deg)
    pitch = [radius for name, radius in found.items() if name == "pitch curve"]
    curves = {"pitch curve": analysis.pitch} if pitch else {"profile": analysis.profile}
    for curve, points in curves.items():
        for angle, radius in zip(np.arange(0, 360, 7) * deg, found[curve], strict=True):
            assert radius == pytest.approx(outermost(points, angle), abs=0.2 * um, nan_ok=True)


def outermost(points, angle):
    along, across = (np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)]))
    beside, away = across @ points, along @ points
    k = np.flatnonzero((beside[:-1] * beside[1:] <= 0) & (away[:-1] > 0) & (abs(np.diff(beside)) > 0))
    share = beside[k] / (beside[k] - beside[k + 1])
    return max(away[k] + share * (away[k + 1] - away[k]), default=np.nan)


def test_a_groove_has_both_walls_a_roller_apart():
    """Where the follower rests both are circles, and the tool goes between them."""
    (cam,) = subjects(TranslatingRollerCam())
    found = polar(cam, np.arange(360) * deg)
    assert list(found) == ["inner wall", "outer wall", "pitch curve"]
    assert (found["inner wall"] < found["pitch curve"]).all()
    assert (found["pitch curve"] < found["outer wall"]).all()
    for most in (np.min, np.max):
        assert most(found["outer wall"]) - most(found["inner wall"]) == pytest.approx(16 * mm, abs=1e-9)


def test_the_centre_of_a_wheel_goes_around_a_circle_below_the_axis():
    """Case 40: a wheel of 60 mm around a circle of R 50 with its centre 25 below: a circle of R 110 about it."""
    found = columns(table(CIRCLE, "wheel", tool_radius=60 * mm))
    x, y = (found[f"centre {axis} [mm]"] for axis in "xy")
    assert_allclose(np.hypot(x, y + 25), 110, rtol=0, atol=1e-6)
    assert_allclose(np.hypot(x, y), found["distance of the centre [mm]"], rtol=1e-10)
    head = text_table(table(CIRCLE, "wheel", tool_radius=60 * mm).data)[0]
    assert "tool radius 60 mm" in head[-1]
    hollow = table(hollow_cam(), "wheel", tool_radius=80 * mm)
    assert re.match("at .* the hollow is narrower than the tool", hollow.remarks[0])


def test_a_wheel_keeps_its_radius_from_the_cam_in_every_direction():
    cam = TranslatingRollerCam(groove=False)
    found = columns(table(cam, "wheel", tool_radius=80 * mm))
    centre = np.stack([found[f"centre {axis} [mm]"] for axis in "xy"], axis=-1) * mm
    assert_allclose(cKDTree(cam.analyse(40_001).profile.T).query(centre)[0], 80 * mm, rtol=0, atol=0.01 * um)


def test_a_grinder_goes_around_the_axis_once():
    rise = MotionProgram((Rise(120 * deg, 20 * mm, Cycloidal()),))
    with pytest.raises(ValueError, match=r"the tool's centre does not come past \d+ deg"):
        table(TranslatingRollerCam(rise, groove=False), "wheel", tool_radius=60 * mm)
    with pytest.raises(ValueError, match=r"the tool's centre comes more than once past 0 deg"):
        table(TranslatingRollerCam(), "wheel", tool_radius=5 * mm)  # along both walls of the groove


def hollow_cam():
    """With a hollow flank under a small roller."""
    up, down = (move(60 * deg, 20 * mm, Cycloidal()) for move in (Rise, Return))
    motion = MotionProgram((up, Dwell(100 * deg), down, Dwell(140 * deg)))
    return TranslatingRollerCam(motion, base_radius=30 * mm, roller_radius=5 * mm, groove=False)


def test_beside_an_open_groove_there_is_nothing():
    rise = MotionProgram((Rise(45 * deg, 25 * deg, Cycloidal()),))
    (cam,) = subjects(OscillatingRollerCam(rise))
    found = polar(cam, np.arange(360) * deg)
    there = np.isfinite(found["inner wall"])
    assert 20 < there.sum() < 180
    assert (np.isfinite(found["outer wall"]) == there).all()
    assert (found["inner wall"][there] < found["outer wall"][there]).all()


def test_a_drum_has_no_radii():
    with pytest.raises(ValueError, match="BarrelCam is a drum, which has no radii by direction"):
        table(BarrelCam(), "polar")


# ---------------------------------------------------------------- motion


def test_the_table_of_a_motion_has_what_is_right_of_case_37():
    """20 mm cycloidal in 120 deg: at 60 deg s = 10, v = 19.0986 mm/rad, a = 0."""
    up, down = (move(120 * deg, 20 * mm, Cycloidal()) for move in (Rise, Return))
    cam = TranslatingRollerCam(MotionProgram((up, Dwell(60 * deg), down, Dwell(60 * deg))))
    found = columns(table(cam, "motion"))
    row = {name: values[60] for name, values in found.items()}
    assert row["cam angle [deg]"] == 60
    assert [row["s [mm]"], row["v [mm/rad]"], row["a [mm/rad^2]"]] == pytest.approx([10, 19.0986, 0], abs=1e-4)


@pytest.mark.parametrize(
    "name", [name for name, design in MACHINES.items() if hasattr(design.analyse(91), "curvature")]
)
def test_every_column_of_the_motion_follows_from_others_by_differences(name):
    """v, a, j are differences of s, v, a; the radius of the pitch curve is that of its points in the other table."""
    found = columns(table(MACHINES[name], "motion", step=0.25 * deg))
    angle = found["cam angle [deg]"] * deg
    curve = np.cumsum(np.diff(angle, prepend=angle[0]) < 0)  # a door handle has two below each other
    for which in range(curve[-1] + 1):
        here = {heading: values[curve == which] for heading, values in found.items()}
        phi = here["cam angle [deg]"] * deg
        unit = "mm" if "s [mm]" in here else "deg"
        for low, high in (("s", "v [{}/rad]"), ("v", "a [{}/rad^2]")):
            below = here[f"{low} [{unit}]" if low == "s" else f"v [{unit}/rad]"]
            slopes = np.diff(below) / np.diff(phi)
            middle = (here[high.format(unit)][1:] + here[high.format(unit)][:-1]) / 2
            near = abs(slopes - middle) <= 1e-3 * abs(middle).max()
            assert near.mean() > 0.97, (low, which)  # but where a kink lies between two rows


def test_curvature_force_and_torque_of_an_eccentric_circle():
    """A face on a circle: radius of curvature 50 everywhere; torque is force times velocity."""
    found = columns(table(CIRCLE, "motion"))
    assert_allclose(found["radius of curvature, profile [mm]"], 50, rtol=1e-9)
    assert_allclose(found["pressure angle [deg]"], 0, atol=1e-12)
    torque = found["contact force [N]"] * found["v [mm/rad]"] * 1e-3
    assert_allclose(found["cam torque [N m]"], torque, rtol=1e-9, atol=1e-12)
    inches = columns(table(CIRCLE, "motion", unit="in"))
    assert_allclose(inches["contact force [lbf]"] * lbf, found["contact force [N]"], rtol=1e-10)
    assert_allclose(inches["cam torque [lbf in]"] * lbf * inch, found["cam torque [N m]"], rtol=1e-9, atol=1e-12)
    assert_allclose(inches["s [in]"] * inch, found["s [mm]"] * mm, rtol=0, atol=1e-12)


# ---------------------------------------------------------------- inspection


@pytest.mark.parametrize("cam", [CIRCLE, TranslatingRollerCam(), ValveCam()])
def test_points_to_probe_lie_on_the_cam_with_normals_out_of_it(cam):
    """A step along the normal leads out of the material: away from a plate, into the groove."""
    made = table(cam, "inspection", limits=(-10 * um, 30 * um))
    found = columns(made)
    points, normals = (np.array([found[k] for k in names]) for names in (("X [mm]", "Y [mm]"), "IJ"))
    assert_allclose(np.hypot(*normals), 1, rtol=0, atol=1e-11)
    assert set(found["upper limit [mm]"]) == {0.03}
    assert set(found["lower limit [mm]"]) == {-0.01}
    assert made.deviation < 1e-9
    analysis = getattr(cam.analyse(20_001), "whole", cam.analyse(20_001))
    step = 0.01
    if getattr(cam, "groove", False):
        centre = analysis.pitch / mm
        before, after = (
            np.array([np.hypot(*(centre - p[:, None])).min() for p in (points + s * normals).T]) for s in (0, step)
        )
        assert_allclose(before, 8, rtol=0, atol=1e-4)
        assert_allclose(after, 8 - step, rtol=0, atol=1e-4)
    else:
        assert (np.hypot(*(points + step * normals)) > np.hypot(*points)).all()


def test_normals_of_a_drum_are_square_to_its_flanks_and_to_the_rollers_axis():
    found = columns(table(BarrelCam(), "inspection"))
    points, normals = (np.array([found[k] for k in names]) for names in (("X [mm]", "Y [mm]", "Z [mm]"), "IJK"))
    assert_allclose((normals**2).sum(0), 1, atol=1e-10)
    lower, upper = slice(0, 360), slice(360, 720)
    for side in (lower, upper):
        along = points[:, side][:, 2:] - points[:, side][:, :-2]
        along = along / np.sqrt((along**2).sum(0))
        assert abs((along * normals[:, side][:, 1:-1]).sum(0)).max() < 2e-3
    assert (normals[2, lower] > 0).all()
    assert (normals[2, upper] < 0).all()
    axis = points[:2, lower] + 8 * normals[:2, lower]  # the roller's axis goes through the drum's
    height = points[2, lower] + 8 * normals[2, lower]
    cam = BarrelCam().analyse(20_001)
    turn = np.unwrap(np.arctan2(axis[1], axis[0]))
    assert_allclose(np.interp(turn, cam.turn, cam.roller_centre[1] / mm), height, atol=1e-4)


def test_points_stand_at_even_distances():
    contour = named_contours(subjects(CIRCLE)[0])["profile"]
    points = evenly(contour, 100).points
    assert_allclose(np.hypot(*np.diff(points)), 2 * 50 * mm * np.sin(np.pi / 100), rtol=1e-4)


def test_limits_that_are_none_are_refused():
    with pytest.raises(ValueError, match="the lower must be below the upper"):
        table(CIRCLE, "inspection", limits=(1e-5, -1e-5))


# ---------------------------------------------------------------- CAD


@pytest.mark.parametrize("program", CAD)
@pytest.mark.parametrize("unit", ["mm", "in"])
def test_points_for_cad_are_those_of_the_cam(program, unit):
    made = table(CIRCLE, program, "", unit=unit)
    assert made.deviation < 1 * um
    (points,) = read_cad_curve(made.data, program)
    x, y, z = points * {"mm": mm, "in": inch}[unit]
    assert_allclose(np.hypot(x, y + 25 * mm), 50 * mm, rtol=0, atol=1e-9)
    assert not z.any()
    assert (points[:, 0] == points[:, -1]).all()
    assert len(x) > 20


def test_the_forms_of_files_for_cad():
    text = {
        program: table(CIRCLE, program, "csv" if program == "inventor" else "").data.decode().splitlines()
        for program in CAD
    }
    assert text["creo"][:3] == ["Closed Index Arclength", "Begin section ! 1", "Begin curve ! 1"]
    assert all(re.fullmatch(r"-?[\d.]+mm -?[\d.]+mm 0mm", line) for line in text["solidworks"])
    assert text["inventor"][0] == "mm"
    assert [line[0] for line in text["nx"][:3]] == ["#", "#", "#"]
    assert all(len(line) < 132 for line in text["nx"])
    assert len(text["nx"][5].split()) == 3
    book = openpyxl.load_workbook(io.BytesIO(table(CIRCLE, "inventor", "xlsx").data)).active
    assert book["A1"].value == "mm"
    assert book["B2"].data_type == "n"


def test_an_undercut_cam_has_corners_and_goes_to_creo_in_parts():
    up, down = (move(60 * deg, 25 * mm, Cycloidal()) for move in (Rise, Return))
    cam = TranslatingFlatCam(MotionProgram((up, Dwell(20 * deg), down, Dwell(220 * deg))), 20 * mm)
    with pytest.raises(ValueError, match="the curve has corners between 2 smooth parts"):
        table(cam, "solidworks", "")
    made = table(cam, "creo", "")
    first, second = read_cad_curve(made.data, "creo")
    assert (first[:, -1] == second[:, 0]).all()
    assert (second[:, -1] == first[:, 0]).all()
    assert made.deviation < 1 * um


@pytest.mark.parametrize("cam", [BarrelCam(), OscillatingBarrelCam()])
def test_curves_of_a_drum_lie_in_space(cam):
    made = table(cam, "nx", "", curve="groove")
    (points,) = read_cad_curve(made.data, "nx")
    assert made.deviation < 1 * um
    exact = cam.analyse(20_001).points_in_space["groove"] / mm
    away = cKDTree(exact.T).query(points.T)[0]
    assert away.max() < 0.03  # they stand between those
    with pytest.raises(ValueError, match=r"there are several curves; curve= must be one of .*'groove'"):
        table(cam, "nx", "")


# ---------------------------------------------------------------- controllers


def turn(rise, back):
    """Up and down by 20 mm, with a rest at both ends."""
    up, down = Rise(120 * deg, 20 * mm, rise), Return(120 * deg, 20 * mm, back)
    return MotionProgram((up, Dwell(60 * deg), down, Dwell(60 * deg)))


PROGRAMS = {
    "cycloidal": turn(Cycloidal(), Cycloidal()),
    "jumps of acceleration": turn(SimpleHarmonic(), Poly345()),
    "part of a turn": MotionProgram((Rise(90 * deg, 20 * mm, ModifiedSine()),)),
    "index": MotionProgram((Rise(120 * deg, 20 * mm, ModifiedSine()), Dwell(240 * deg)), advance=20 * mm),
}
NEAR = {"codesys": 1e-3 * um, "twincat": 1e-3 * um, "kollmorgen": 0.3 * um, "rockwell": 0.3 * um}


def followed(data, form, slopes=(0.0, 0.0)):
    """An interpreter of its own: the slave by the master as the maker says, by solving for each polynomial."""
    text = [line.split(";" if form == "kollmorgen" else ",") for line in data.decode().splitlines()]
    if form == "kollmorgen":
        assert text[0][0] == "CYCLIC"
        assert text[1] == ["TABLE_BEGIN", "", ""]
        assert text[-1] == ["TABLE_END", "", ""]
        assert {row[2] for row in text[2:-1]} == {"SPLINE"}
        rows = np.array([row[:2] for row in text[2:-1]], dtype=float)
    else:
        start = 4 if form == "twincat" else 0
        rows = np.array([row[start : start + (2 if form == "rockwell" else 4)] for row in text[1:]], dtype=float)
    if form == "rockwell":
        assert {row[2] for row in text[1:]} == {"1"}
    if form == "twincat":
        assert [row[0] for row in text[1:]] == [str(k) for k in range(1, len(text))]
        assert {tuple(row[1:4]) for row in text[1:]} == {("15", "8", "1")}
    assert (np.diff(rows[:, 0]) > 0).all()
    return rows


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", PROGRAMS)
def test_a_controller_that_follows_the_rows_makes_the_motion(form, name):
    program = PROGRAMS[name]
    made = controller_table(program, form, "mm", 1 * deg)
    rows = followed(made.data, form)
    assert made.deviation < NEAR[form]
    assert_allclose(rows[:, 1] * mm, program(rows[:, 0] * deg).s, rtol=0, atol=1e-6 * mm)
    if form not in ("codesys", "twincat"):
        return
    for low, high in zip(rows[:-1:7], rows[1::7], strict=False):
        if high[0] - low[0] < 0.1:
            continue
        h = high[0] - low[0]
        powers = np.arange(6)
        conditions = []
        for x in (0.0, h):
            conditions += [
                x**powers,
                powers * x ** np.maximum(powers - 1, 0),
                powers * (powers - 1) * x ** np.maximum(powers - 2, 0),
            ]
        c = np.linalg.solve(np.array(conditions), np.array([*low[1:4], *high[1:4]]))
        x = np.linspace(0, h, 9)
        exact = program((low[0] + x) * deg).s
        assert_allclose(np.polynomial.polynomial.polyval(x, c) * mm, exact, rtol=0, atol=NEAR[form])


def test_what_the_makers_ask_for():
    turn, part = (controller_table(PROGRAMS[name], "kollmorgen", "mm").data for name in ("cycloidal", "part of a turn"))
    assert turn.startswith(b"CYCLIC;YES;\r\nTABLE_BEGIN;;\r\n0;0;SPLINE\r\n")
    assert part.startswith(b"CYCLIC;NO;")
    assert controller_table(PROGRAMS["index"], "rockwell", "mm").remarks == (
        "MCCP needs start slope 0 and end slope 0",
    )
    with pytest.raises(ValueError, match="the controller is 'siemens'"):
        controller_table(PROGRAMS["index"], "siemens", "mm")
    with pytest.raises(ValueError, match="there are several motions; curve= must be one of 'lift', 'relief'"):
        table(DoorHandleCam(), "codesys")
    assert table(DoorHandleCam(), "codesys", curve="lift").data.startswith(b"X,Y,V,A")


# ---------------------------------------------------------------- joints


@pytest.mark.parametrize("mechanism", [RSSR(crank=20 * mm), CabinDoorLinkage()])
def test_links_keep_their_lengths_over_the_turn(mechanism):
    found = columns(table(mechanism, "joints"))
    joints = [
        np.array([found[f"{name} {axis} [mm]"] for axis in "xyz"])
        for name in ("crank root", "crank joint", "rocker joint", "rocker root")
    ]
    for one, other, link in zip(joints, joints[1:], ("crank", "coupler", "rocker"), strict=False):
        assert_allclose(np.sqrt(((one - other) ** 2).sum(0)), getattr(mechanism, link) / mm, rtol=1e-10)
    inches = columns(table(mechanism, "joints", unit="in"))
    assert_allclose(inches["rocker joint y [in]"] * inch, joints[2][1] * mm, rtol=0, atol=1e-12)


@pytest.mark.parametrize("line", [Driveline(), Driveline((20 * deg, 30 * deg), (10 * deg,), (40 * deg,))])
def test_pins_of_every_joint_are_square_to_each_other_and_to_their_shafts(line):
    found = columns(table(line, "joints"))
    analysis = line.analyse()
    for k, (before, behind) in enumerate(zip(analysis.shafts, analysis.shafts[1:], strict=False), 1):
        pin, other = (np.array([found[f"joint {k} {name} {axis}"] for axis in "xyz"]) for name in ("pin", "driven pin"))
        assert_allclose((pin * other).sum(0), 0, atol=1e-11)
        assert_allclose(before @ pin, 0, atol=1e-11)
        assert_allclose(behind @ other, 0, atol=1e-11)
        for i in (0, 17, 200):
            one, two = analysis.pins(analysis.input_angle[i])[k - 1]
            assert_allclose(pin[:, i], one, atol=1e-11)
            assert_allclose(other[:, i], two, atol=1e-11)
    assert_allclose(found["output angle [deg]"], analysis.output_angle / deg, rtol=0, atol=1e-8)


def test_a_tube_turns_as_its_joint_makes_it():
    found = columns(table(UniversalJointShaft(joint_angle=20 * deg), "joints"))
    phi, psi = (found[f"{name} angle [deg]"] * deg for name in ("input", "output"))
    assert_allclose(np.tan(psi[1:80]), np.tan(phi[1:80]) / np.cos(20 * deg), rtol=1e-9)
    assert set(found["second joint x [mm]"]) == {2410.0}
    for joint in (UniversalJoint(), DoubleUniversalJoint()):
        assert columns(table(joint, "joints"))["input angle [deg]"][-1] == pytest.approx(360)


def test_a_cam_has_no_joints_and_a_linkage_no_profile():
    with pytest.raises(ValueError, match="ValveCam has no joints in space"):
        table(ValveCam(), "joints")
    for mechanism, there in (
        (RSSR(crank=20 * mm), "joints.*, its skeleton.*, its solid"),
        (Driveline(), "joints [^,]*, [^,]*, a report"),
    ):
        with pytest.raises(ValueError, match=f"{type(mechanism).__name__} has no cam profile; there are its {there}"):
            table(mechanism, "profile")


# ---------------------------------------------------------------- skeletons


def drawn(made):
    import ezdxf

    drawing = ezdxf.read(io.StringIO(made.data.decode()))
    assert not drawing.audit().errors
    return drawing


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_the_skeleton_of_a_linkage_has_its_links_and_axes(unit):
    linkage = CabinDoorLinkage()
    made = skeleton(linkage, unit=unit)
    assert made.deviation < 1e-12
    space, worth = drawn(made).modelspace(), {"mm": mm, "in": inch}[unit]
    for layer in ("CRANK", "COUPLER", "ROCKER"):
        (line,) = space.query(f'LINE[layer=="{layer}"]')
        assert (line.dxf.end - line.dxf.start).magnitude * worth == pytest.approx(getattr(linkage, layer.lower()))
    crank, rocker = [*space.query('LINE[layer=="FRAME"]')][:2]
    ways = [(line.dxf.end - line.dxf.start).normalize() for line in (crank, rocker)]
    assert ways[0].angle_between(ways[1]) == pytest.approx(linkage.axis_angle)
    assert len(space.query('POLYLINE[layer=="PATHS"]')) == 2
    notes = [text.dxf.text for text in space.query("TEXT")]
    assert f"coupler {linkage.coupler / worth:.6g} {unit}" in notes


@pytest.mark.parametrize("branch", [1, -1])
@pytest.mark.parametrize("angle", [-130 * deg, -20 * deg, 0.0, 75 * deg, 160 * deg])
def test_a_skeleton_at_any_position_keeps_the_lengths_of_its_links(angle, branch):
    """The crank where its angle says, the rocker square to its axis; the branches are different ones."""
    linkage = RSSR(crank=20 * mm, axis_distance=30 * mm, axis_angle=70 * deg)
    space = drawn(skeleton(linkage.analyse([angle, angle + 1 * deg], branch))).modelspace()
    links = [space.query(f'LINE[layer=="{layer}"]')[0] for layer in ("CRANK", "COUPLER", "ROCKER")]
    joints = np.array([*(link.dxf.start for link in links), links[-1].dxf.end]) * mm
    assert_allclose(joints[1:3], [link.dxf.end * mm for link in links[:2]], atol=1e-15)
    sizes = [linkage.crank, linkage.coupler, linkage.rocker]
    assert_allclose(np.linalg.norm(np.diff(joints, axis=0), axis=1), sizes, rtol=1e-12)
    way, axis = np.array([np.cos(angle), np.sin(angle), 0]), np.array([0, np.sin(70 * deg), np.cos(70 * deg)])
    assert_allclose(joints[1] - joints[0], linkage.crank * way, atol=1e-15)
    assert_allclose(joints[3], [30 * mm, 0, 0] + linkage.rocker_offset * axis, atol=1e-15)
    assert (joints[2] - joints[3]) @ axis == pytest.approx(0, abs=1e-12)
    crank, rocker = (np.array([*(line.dxf.end - line.dxf.start)]) for line in space.query('LINE[layer=="FRAME"]')[:2])
    assert_allclose([*np.cross(crank, [0, 0, 1]), *np.cross(rocker, axis)], 0, atol=1e-9)
    other = linkage.analyse([angle, angle + 1 * deg], -branch)
    assert np.linalg.norm(other.rocker_joint[:, 0] - joints[2]) > 1 * mm


@pytest.mark.parametrize("mechanism", [CabinDoorLinkage(), UniversalJointShaft()])
def test_a_drawing_of_what_has_no_profile_is_its_skeleton(tmp_path, mechanism):
    done = write_dxf(mechanism, tmp_path / "it.dxf", unit="in", title=TitleBlock(date="2026-11-30"))
    assert (done.what, done.remarks) == ((made := skeleton(mechanism)).what, made.remarks)
    assert done.deviation < 1e-12
    assert drawn(Made(done.path.read_bytes(), "")).units == 1
    made = {export.key: export.make(Order(mechanism)) for export in exports_of(Order(mechanism)) if export.key == "dxf"}
    assert made["dxf"].what == done.what
    with pytest.raises(ValueError, match="the entity is"):
        write_dxf(mechanism, tmp_path / "it.dxf", entity="dots")


def test_a_tube_is_called_by_its_standard():
    paper = UniversalJointShaft()
    assert tube_callout(paper.analyse())[0] == "tube 128.64 x 13.43 mm is no standard size"
    standard = paper.replace(outer_diameter=139.7 * mm, inner_diameter=114.7 * mm)
    assert tube_callout(standard.analyse()) == ["tube EN 10210-2 139.7 x 12.5"]
    space = drawn(skeleton(standard)).modelspace()
    assert "tube EN 10210-2 139.7 x 12.5" in [text.dxf.text for text in space.query("TEXT")]
    edges = [line.dxf.start.y for line in space.query('LINE[layer=="BORE"]')]
    assert sorted(edges) == pytest.approx([-57.35, 57.35])


# ---------------------------------------------------------------- files


QUICK = ("face", "face on an arm", "valve", "pair of cams", "cabin door", "shaft")
"""Machines whose contours are found at once."""
WITHOUT_CONTOURS = ("profile", "motion", "joints", *FORMS)


@pytest.mark.parametrize("name", MACHINES)
def test_every_machine_has_its_tables(name):
    """Every kind is a file that was read back, or is refused in a sentence."""
    made, refused = [], []
    analysis = MACHINES[name].analyse()  # of one all curves are found once
    for kind in KINDS if name in QUICK else WITHOUT_CONTOURS:
        try:
            made.append(table(analysis, kind, "" if kind in CAD else "csv", tool_radius=2 * mm))
        except ValueError as refusal:
            refused.append(str(refusal))
    assert all(re.match(r"\w+ (is a drum|has no|has 2 cams)|there are several|the curve has", said) for said in refused)
    assert not any(each.deviation > 1 * um for each in made)
    assert len(made) >= (1 if name in ("cabin door", "shaft") else 2)


HOSTILE = st.text(min_size=1, max_size=30) | st.sampled_from(
    [
        "=1+1",
        "+cmd|' /C calc'!A0",
        "@SUM(A1)",
        "-2+3",
        "\t=1",
        "a;=1+1",
        'x"\n=1',
        "凸轮 №1",
        "<script>",
        "\ud800",
        "\uffff",
        "ＨＹＰ",
        "＝1",
    ]
)


@settings(deadline=None, max_examples=25)
@given(title=HOSTILE, author=HOSTILE, fault=HOSTILE)
def test_no_title_becomes_a_formula_or_breaks_a_file(title, author, fault):
    block = TitleBlock(title=title, author=author, faults=(fault,))
    sheet = Sheet({"x [mm]": np.array([1.0, -2.5])}, block.lines("Cam", "mm"))
    rows = text_table(sheet.written("csv"))
    book = openpyxl.load_workbook(io.BytesIO(sheet.written("xlsx")))
    page = [[cell for cell in row] for row in book.active.iter_rows()]
    for found in (rows, [[cell.value for cell in row] for row in page]):
        assert len(found) == 3
        assert {len(row) for row in found} == {len(found[0])}
        for words in (found[0][-1], found[1][-1]):
            assert not re.match(r"\s*[=+\-@＝＋－＠]", words)
            assert not re.search(r";[\s\"]*[=+\-@＝＋－＠]", words)
        assert found[1][-1].startswith("FAULTY")
    assert {cell.data_type for row in page[1:] for cell in row[:-1]} == {"n"}
    assert {cell.data_type for row in page for cell in row} == {"n", "s"}


def test_a_workbook_has_numbers_a_frozen_heading_and_columns_wide_enough():
    page = openpyxl.load_workbook(io.BytesIO(table(CIRCLE, "motion", "xlsx").data)).active
    assert page.freeze_panes == "A2"
    assert page["B2"].data_type == "n"
    assert page["A1"].value == "cam angle [deg]"
    assert all(page.column_dimensions[letter].width >= 12 for letter in "ABC")
    assert table(CIRCLE, "motion", "xlsx").data == table(CIRCLE, "motion", "xlsx").data


def test_a_table_with_decimal_commas():
    point, comma = (table(CIRCLE, "polar", decimal=sign) for sign in ".,")
    rows = [*csv.reader(io.StringIO(comma.data.decode()), delimiter=";")]
    assert float(rows[1][1].replace(",", ".")) == pytest.approx(columns(point)["profile radius [mm]"][0])
    assert comma.deviation == point.deviation


def test_a_table_is_written_by_the_ending_of_its_name(tmp_path):
    for ending in ("csv", "xlsx"):
        done = write_table(
            CIRCLE, tmp_path / f"cam.{ending}", "polar", title=TitleBlock(title="凸轮", date="2026-11-30")
        )
        assert done.path.exists()
        assert done.deviation < 1e-9
    assert (tmp_path / "cam.csv").read_bytes().startswith(b"\xef\xbb\xbf")
    head = (tmp_path / "cam.csv").read_text("utf-8-sig").splitlines()[0]
    assert head.startswith('direction [deg],profile radius [mm],"凸轮; lengths in mm; camkit')
    assert "drawn at cam angle 0; the cam turns counter-clockwise; directions run counter-clockwise from x" in head
    with pytest.raises(ValueError, match="a table of polar ends in csv or xlsx, not in 'ods'"):
        write_table(CIRCLE, tmp_path / "cam.ods", "polar")
    with pytest.raises(ValueError, match="the kind of the table is 'radii'; it must be one of profile, polar"):
        write_table(CIRCLE, tmp_path / "cam.csv", "radii")
    with pytest.raises(ValueError, match="in mm or in inches"):
        write_table(CIRCLE, tmp_path / "cam.csv", "polar", unit="cm")
    with pytest.raises(ValueError, match="a table of nx ends in dat or txt, not in 'csv'"):
        write_table(CIRCLE, tmp_path / "cam.csv", "nx")


def test_both_cams_of_a_pair_stand_below_each_other():
    rows = text_table(table(ConjugatePair(), "polar").data)
    names = [row[0] for row in rows[1:]]
    assert names == ["first cam"] * 360 + ["second cam"] * 360
    made = table(ConjugatePair(OscillatingRollerCam(groove=False)), "profile")
    assert made.deviation < 1e-9


def test_names_of_curves():
    assert list(named_contours(subjects(CIRCLE)[0])) == ["profile"]
    assert list(curves_of(subjects(BarrelCam(groove=False))[0])) == [
        *BarrelCam(groove=False).analyse(31).points_in_space
    ]


def test_words_of_a_skeleton_are_no_codes_of_cad():
    data = skeleton(RSSR(crank=0.02), title=TitleBlock(title="100%%d\n^I \\U+00B0")).data.decode()
    assert "100% %d ^ I \\ U+00B0" in data
    assert "%%" not in data
