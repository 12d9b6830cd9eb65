"""Barrel cams against brute force in space: a roller is put where the motion says, and the drum is what it leaves.

``axis_distance`` knows where the roller's axis is in the turning drum and nothing of the package's formulas.
"""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import (
    Measure,
    OscillatingRollerCam,
    Study,
    TranslatingRollerCam,
    deg,
    explore,
    minimise,
    mm,
    quick_front,
    tolerance_panel,
)
from camkit.cam import (
    ArmLoad,
    BarrelCam,
    ContactPair,
    Friction,
    OscillatingBarrelCam,
    SlideFriction,
    SlideLoad,
    base_radius,
    bottom_pressure_angle,
    groove_gap,
    max_pressure_angle,
    mean_torque,
    min_profile_radius,
    peak_force,
    peak_skid,
    peak_torque,
    rolling_cone,
    undercut_margin,
    vibration_at,
)
from camkit.files import Session, from_json, to_json
from camkit.files.workshop import tables
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic
from camkit.quantities import measures_of, unremarked
from camkit.study import Sweep
from camkit.units import rpm
from camkit.views import default_views

SLIDING, ROCKING = BarrelCam(), OscillatingBarrelCam()
BOTH = pytest.mark.parametrize("cam", [SLIDING, ROCKING], ids=["slide", "arm"])
SENSES = pytest.mark.parametrize("sigma", [1, -1])
SMOOTH = {"coefficient": 0.0, "cam_axis": 0.0, "roller_pin": 0.0}


def heavy(cam):
    """With a load that is felt, and no friction."""
    if isinstance(cam, BarrelCam):
        return cam.replace(
            load=SlideLoad(mass=2.0, speed=20.0, force=80.0), friction=SlideFriction(**SMOOTH, guide=0.0)
        )
    return cam.replace(load=ArmLoad(mass=2.0, speed=20.0, torque=5.0), friction=Friction(**SMOOTH, arm_pivot=0.0))


def roller_path(cam, phi):
    """Where the roller is in the plane that touches the drum: around it, and along it."""
    level = cam.motion(phi).s
    if isinstance(cam, BarrelCam):
        return 0 * level, level
    psi = cam.start_angle + level
    return cam.centre_distance - cam.arm_length * np.cos(psi), cam.arm_length * np.sin(psi)


def axis_distance(cam, points, phi):
    """Of points ``(3, m)`` on the drum from the roller's axis at cam angles ``(n,)``: ``(m, n)``."""
    across, along = roller_path(cam, phi)
    turn = cam.rotation * phi
    x, y, z = (p[:, None] for p in points)
    there = np.cos(turn) * x + np.sin(turn) * y > 0
    return np.where(there, np.hypot(-np.sin(turn) * x + np.cos(turn) * y - across, z - along), np.inf)


def test_the_published_case():
    """Mean radius 60 mm, 50 mm in 120 deg, cycloidal: ``tan alpha = 2 h / (beta R)`` in the middle of the rise."""
    analysis = BarrelCam().analyse()
    assert max_pressure_angle(analysis) / deg == pytest.approx(38.511887, abs=5e-7)
    assert max_pressure_angle(analysis) == pytest.approx(np.arctan(2 * 50 / (2 * np.pi / 3 * 60)), abs=1e-12)
    assert bottom_pressure_angle(analysis) == pytest.approx(np.arctan(2 * 50 / (2 * np.pi / 3 * 54)), abs=1e-12)
    phi, s = analysis.cam_angle, analysis.motion.s
    assert_allclose(analysis.pitch, [60 * mm * phi, s], rtol=0, atol=1e-15)
    groove = analysis.points_in_space["groove"]
    assert_allclose(groove, [60 * mm * np.cos(phi), 60 * mm * np.sin(phi), s], rtol=0, atol=1e-15)
    assert rolling_cone(analysis) == pytest.approx(np.arctan(8 / 60))
    assert peak_skid(analysis) == pytest.approx(12 / 60, abs=1e-12)  # in a dwell: (66 - 54) / 60


@SENSES
def test_a_drum_of_endless_radius_is_a_disk_of_one(sigma):
    sizes = {"rotation": sigma, "roller_radius": 8 * mm}
    slide, arm = {"load": SlideLoad(mass=2.0, speed=20.0)}, {"load": ArmLoad(mass=2.0, speed=20.0)}
    with unremarked():
        flat = BarrelCam(SLIDING.motion, 90.0, **sizes, **slide)
        disk = TranslatingRollerCam(SLIDING.motion, 90.0 - 8 * mm, **sizes, **slide)
        same(flat.analyse(181), disk.analyse(181), 1e-3)
        flat = OscillatingBarrelCam(ROCKING.motion, 90.0, **sizes, **arm)
        arm |= {"arm_length": 84 * mm, "start_angle": 75 * deg}
        disk = OscillatingRollerCam(ROCKING.motion, centre_distance=90.0, **sizes, **arm)
        same(flat.analyse(181), disk.analyse(181), 5e-3)


def same(one, other, within):
    """Geometry and forces within a share of their largest."""
    assert_allclose(abs(one.pressure_angle), abs(other.pressure_angle), rtol=0, atol=within)
    for name in ("contact_force", "cam_torque", "lever", "fit"):
        value, wanted = getattr(one, name), getattr(other, name)
        assert_allclose(value, wanted, rtol=0, atol=within * abs(wanted).max(), err_msg=name)
    moving = abs(one.velocity) > 1e-3 * abs(one.velocity).max()
    assert_allclose(one.efficiency[moving], other.efficiency[moving], rtol=0, atol=20 * within)
    assert_allclose(one.curvature - other.curvature, 0, atol=2 / 90)  # that of the disk itself


@BOTH
@SENSES
def test_every_point_of_a_flank_is_touched_and_never_cut(cam, sigma):
    """By the roller at its own cam angle, by none at any other: to the rounding, in space."""
    cam = replace(cam, rotation=sigma)
    analysis, phi = cam.analyse(181), np.linspace(0, 2 * np.pi, 4001)
    for radius in (cam.bottom_radius, cam.mean_radius, cam.surface_radius):
        for side in (1, -1):
            points = analysis.in_space(radius, side)
            own = np.diag(axis_distance(cam, points, analysis.cam_angle))
            assert_allclose(own, 8 * mm, rtol=0, atol=1e-15)
            assert axis_distance(cam, points, phi).min() > 8 * mm - 1e-10
            before, after = (np.diag(axis_distance(cam, points, analysis.cam_angle + h)) for h in (-1e-4, 1e-4))
            assert abs(after - before)[1:-1].max() < 1e-9  # it touches, and does not cross


def surface(cam, side, phi, radius):
    """A place of the flank's envelope."""
    shown = cam.analyse(5).at(np.atleast_1d(phi))
    return shown.in_space(radius, side)


def relative_curvatures(cam, side, phi, radius, h=1e-4):
    """Principal curvatures of the flank against the roller's, by differences of places of the flank alone."""

    def at(i, j):
        return surface(cam, side, phi + i * h, radius + j * h * cam.mean_radius)[:, 0]

    u, v = (at(1, 0) - at(-1, 0)) / (2 * h), (at(0, 1) - at(0, -1)) / (2 * h)
    uu, vv = ((at(*p) - 2 * at(0, 0) + at(*(-k for k in p))) / h**2 for p in ((1, 0), (0, 1)))
    uv = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h**2)
    across, along = (p[0] for p in roller_path(cam, np.array([phi])))
    turn = cam.rotation * phi
    axis = np.array([np.cos(turn), np.sin(turn), 0.0])
    centre = radius * axis + across * np.array([-np.sin(turn), np.cos(turn), 0.0]) + np.array([0.0, 0.0, along])
    out = (at(0, 0) - centre) / cam.roller_radius
    first = np.array([[u @ u, u @ v], [u @ v, v @ v]])
    second = np.array([[out @ uu, out @ uv], [out @ uv, out @ vv]])
    around = np.cross(out, axis)
    tool = -np.array([[(a @ around) * (b @ around) for a in (u, v)] for b in (u, v)]) / cam.roller_radius
    return np.sort(np.linalg.eigvals(np.linalg.solve(first, second - tool)).real)


@BOTH
@SENSES
@pytest.mark.parametrize("side", [1, -1])
def test_cam_and_roller_are_curved_together_as_their_surfaces_in_space(cam, sigma, side):
    cam = replace(cam, rotation=sigma)
    for phi in (0.4, 1.0, 1.6, 3.6, 4.4):
        at = cam.analyse(5).at(np.array([phi]))
        for radius in (cam.bottom_radius, cam.surface_radius):
            r = cam.roller_radius
            wanted = 1 / (r * (1 - r * at.bend_at(side, radius)[0]))
            along, across = sorted(relative_curvatures(cam, side, phi, radius), key=abs)
            assert across == pytest.approx(wanted, rel=2e-5)
            assert abs(along) < 1e-4 * wanted  # they meet along a line


TIGHT = MotionProgram((Rise(60 * deg, 40 * mm, SimpleHarmonic()), Dwell(30 * deg)))


@pytest.mark.parametrize("depth", [0.0, 20 * mm])
@pytest.mark.parametrize("size", [0.985, 1.015])
def test_undercut_is_where_the_envelope_turns_back(size, depth):
    """A radius that the margin calls just possible, and one just beyond: the flank at the bottom runs on, or back."""
    cam = BarrelCam(TIGHT, 40 * mm, depth, 1 * mm, groove=False)
    low, high = 1 * mm, 20 * mm
    for _ in range(50):
        r = (low + high) / 2
        low, high = (r, high) if undercut_margin(cam.replace(roller_radius=r).analyse()) > 0 else (low, r)
    cam = cam.replace(roller_radius=size * r)
    phi = np.linspace(2, 59.99, 4001) * deg
    steps = np.diff(surface(cam, 1, phi, cam.bottom_radius))
    ways = np.diff(
        np.array([np.cos(phi), np.sin(phi), 0 * phi]) * cam.bottom_radius + [[0], [0], [1]] * cam.motion(phi).s
    )
    assert ((steps * ways).sum(0) < 0).any() == (size > 1)
    analysis = cam.analyse()
    assert (min_profile_radius(analysis) < 0) == (size > 1) == ("undercut" in analysis.trouble)
    assert analysis.undercut.any() == (size > 1)
    points = surface(cam, 1, phi[::8], cam.bottom_radius)
    assert (axis_distance(cam, points, phi).min() < cam.roller_radius - 1e-9) == (size > 1)


def test_a_place_between_bottom_and_surface_can_be_the_sharpest():
    """Steeper than ``tan alpha = sqrt(2)`` the groove bends less towards the drum's axis."""
    cam = BarrelCam(MotionProgram((Rise(60 * deg, 100 * mm, SimpleHarmonic()),)), 60 * mm, 60 * mm, 3 * mm)
    shown = cam.analyse(181)
    every = np.array([shown.bend_at(1, radius) for radius in np.linspace(30, 90, 241) * mm])
    assert_allclose(shown.bend(1), every.max(0), rtol=0, atol=2e-3 * every.max())
    assert (shown.bend(1) >= every.max(0) - 1e-3 * abs(every).max()).all()
    inside = every.argmax(0)
    assert ((inside > 0) & (inside < 240)).any()


@BOTH
@SENSES
def test_forces_do_the_work(cam, sigma):
    """Power in is power out, from the force where it acts in space; the force turns the drum by its lever."""
    analysis = heavy(replace(cam, rotation=sigma)).analyse()
    torque = cam.mean_radius * (-sigma * analysis.normal[0]) * analysis.contact_force
    assert_allclose(analysis.cam_torque, torque, rtol=0, atol=1e-12 * abs(torque).max())
    assert_allclose(analysis.rubbing.cam_torque, torque, rtol=0, atol=1e-9 * abs(torque).max())
    assert_allclose(analysis.rubbing.contact_force, analysis.contact_force, rtol=1e-9)
    moving = abs(analysis.velocity) > 1e-6
    assert_allclose(analysis.efficiency[moving], 1, rtol=0, atol=1e-9)
    assert abs(mean_torque(analysis)) < 1e-6 * peak_torque(analysis)  # a constant load gives back what it takes
    assert peak_force(analysis) >= abs(analysis.contact_force).max()


@BOTH
def test_what_friction_takes_is_what_is_lost(cam):
    """Torque in less power out is what rubs at the flank and in the bearing, each force times its own slip."""
    cam = heavy(cam)
    bearing = {"guide": 0.08} if isinstance(cam, BarrelCam) else {"arm_pivot": 1 * mm}
    cam = cam.replace(friction=cam.friction.replace(coefficient=0.1, roller_pin=50 * mm, **bearing))  # it slides
    analysis = cam.analyse()
    rubbing, Q, v = analysis.rubbing, analysis.resistance, analysis.velocity
    flank = np.sign(rubbing.contact_force)
    (nx, ny), (x, y) = analysis.normal, analysis.contact_point(flank)
    cx, cy = analysis.bearing.velocity_at((x, y))
    past = np.array([-cam.rotation * cam.mean_radius - cx, -cy])
    assert_allclose(past[0] * nx + past[1] * ny, 0, atol=1e-12)  # the surfaces stay in touch
    slip = np.hypot(*past)
    rubbed = np.sin(np.arctan(0.1)) / np.cos(np.arctan(0.1)) * abs(rubbing.contact_force)
    lost = rubbed * slip + borne(cam, rubbing.contact_force, rubbed * past / slip, analysis) * abs(v)
    assert_allclose(rubbing.cam_torque - Q * v, lost, rtol=1e-9)


def borne(cam, pressed, rubbed, analysis):
    """What the bearing takes of the follower's motion: friction at both ends of a guide, or in the pivot of an arm."""
    force = pressed * analysis.normal + rubbed
    if isinstance(cam, OscillatingBarrelCam):
        return 1 * mm * np.hypot(*force)
    x, y = analysis.contact_point(np.sign(pressed))
    mouth = 50 * mm + cam.friction.overhang  # the moments about each end of the guide
    moment, length = x * force[1] - y * force[0], cam.friction.guide_length
    top, bottom = (moment + mouth * force[0]) / length, (moment + (mouth + length) * force[0]) / length
    return 0.08 * (abs(top) + abs(bottom))


def test_which_flank_works_follows_from_the_force():
    """In a groove without a spring the upper flank brakes a mass; the ends of the drum alone cannot."""
    fast = BarrelCam(load=SlideLoad(mass=2.0, speed=1000 * rpm, spring_rate=0.0, preload=0.0))
    analysis = fast.analyse()
    assert analysis.form_closed
    assert_array_equal(analysis.loaded_flank < 0, analysis.acceleration < 0)
    end = fast.replace(groove=False).analyse()
    assert not end.form_closed
    assert np.isnan(end.outer_profile).all()
    assert np.isnan(end.wear_index[analysis.acceleration < -1e-3]).all()


def test_hertz_pressure_is_that_of_the_surfaces_in_space():
    cam = heavy(BarrelCam(contact=ContactPair(width=12 * mm)))
    analysis = cam.analyse(5).at(np.array([1.0]))
    flank = float(np.sign(analysis.contact_force[0]))
    least = max(max(relative_curvatures(cam, flank, 1.0, cam.bottom_radius), key=abs), 0)
    modulus = 210e9 / (2 * (1 - 0.3**2))
    pressure = np.sqrt(abs(analysis.contact_force[0]) / (12 * mm) * least * modulus / np.pi)
    assert analysis.contact_pressure[0] == pytest.approx(pressure, rel=1e-4)


@pytest.mark.parametrize(
    ("cam", "sentence"),
    [
        (lambda: BarrelCam(mean_radius=20 * mm, groove_depth=50 * mm), "its bottom must stay above 0 mm"),
        (lambda: BarrelCam(MotionProgram((Rise(360 * deg, 60 * mm, Cycloidal()),), advance=60 * mm)), "back to where"),
        (lambda: BarrelCam(mean_radius=20 * mm, roller_radius=30 * mm).analyse(), "stay below the 14 mm of the groove"),
        (lambda: OscillatingBarrelCam(centre_distance=20 * mm).analyse(), "comes up to 64 mm beside the drum's axis"),
        (lambda: OscillatingBarrelCam(start_angle=40 * deg, centre_distance=50 * mm, mean_radius=40 * mm,
                                      motion=MotionProgram((Rise(20 * deg, 30 * deg, Cycloidal()),)), rotation=-1)
         .analyse(), "as fast as the drum turns"),
    ],
)  # fmt: skip
def test_what_cannot_be_built_is_refused_in_a_sentence(cam, sentence):
    with pytest.raises(ValueError, match=sentence):
        cam()


@BOTH
def test_a_population_is_its_members(cam):
    sizes = {"mean_radius": [50 * mm, 60 * mm, 6 * mm], "roller_radius": [6 * mm, 8 * mm, 8 * mm]}
    cam = cam.replace(contact=ContactPair())
    many = cam.replace(**{name: np.array(values)[:, None] for name, values in sizes.items()})
    measures = (*measures_of(cam), vibration_at(40))
    with np.errstate(all="ignore"):
        found = {measure.name: measure.of(many.analyse(91), 3) for measure in measures}
    for k in range(2):
        one = cam.replace(**{name: values[k] for name, values in sizes.items()}).analyse(91)
        for measure in measures:
            assert found[measure.name][k] == pytest.approx(measure(one), rel=1e-9, nan_ok=True), measure.name
    assert np.isnan(found["maximum pressure angle"][2])
    assert base_radius not in measures


@BOTH
def test_a_file_gives_it_back_and_every_view_shows_it(cam):
    assert from_json(to_json(cam)) == cam
    assert [view.__name__ for view in default_views(cam.analyse(91))][:3] == [
        "shapes_in_space",
        "unrolled_cam",
        "motion",
    ]
    for groove in (True, False):
        analysis = cam.replace(groove=groove, roller_radius=5 * mm).analyse(91)
        assert all(view(analysis).marks for view in default_views(analysis))


def narrow(cam):
    """A small drum with a thick roller that works."""
    sizes = {"mean_radius": (40 * mm, 90 * mm), "roller_radius": (5 * mm, 20 * mm)}
    wanted = (-rolling_cone, max_pressure_angle)
    return Study(cam, sizes, wanted, at_least={undercut_margin: 0.2}, at_most={bottom_pressure_angle: 45 * deg})


@BOTH
def test_searches_take_it_as_it_is(cam):
    study = narrow(cam)
    front = quick_front(study)
    assert len(front) > 50
    judged = study.evaluate(front.x)
    assert judged.feasible.all()
    assert_allclose(judged.f, front.f)
    radius = Measure("mean radius", "mm", lambda a: np.atleast_1d(a.cam.mean_radius)[..., 0])
    radius = study.replace(minimise=(radius,), free={"mean_radius": (40 * mm, 90 * mm)})
    found = minimise(radius)
    least = found.design.mean_radius - cam.groove_depth / 2
    assert bottom_pressure_angle(found.design.analyse()) == pytest.approx(45 * deg, abs=1e-6)
    if cam is SLIDING:  # tan 45 deg = 2 h / (beta rho)
        assert least == pytest.approx(100 * mm / (2 * np.pi / 3), rel=1e-6)
    swept = Sweep(radius, 31)
    assert not swept.feasible[0]
    assert swept.feasible[-1]
    again = from_json(to_json(Session(study, front[0], front=front)))
    assert_array_equal(again.front.x, front.x)
    assert again.design == front[0]


@BOTH
def test_an_instrument_and_its_tolerances_live(cam):
    study = narrow(cam)
    app = explore(cam, free=list(study.free), measures=[max_pressure_angle, undercut_margin])
    assert [view.__name__ for view in app.views][:2] == ["shapes_in_space", "unrolled_cam"]
    assert app.program is not None
    spread = tolerance_panel(app, study, {"mean_radius": 0.3 * mm, "roller_radius": 0.2 * mm})
    spread.settle()
    assert f"{100 * spread.tolerances.share:.1f} % of parts" in spread.summary()


def test_a_zone_and_a_checkpoint_are_measures():
    analysis = BarrelCam().analyse()
    there = max_pressure_angle.at(60 * deg)(analysis)
    assert there == pytest.approx(max_pressure_angle(analysis), rel=1e-12)
    assert max_pressure_angle.between(0, 30 * deg)(analysis) == pytest.approx(
        np.arctan(SLIDING.motion(30 * deg).v / SLIDING.mean_radius), rel=1e-9
    )


def columns(text):
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def test_the_workshop_gets_the_groove_unrolled_and_in_space():
    analysis = BarrelCam().analyse()
    found = columns(tables.table(analysis).data.decode())
    assert_allclose(found["pitch curve x [mm]"].astype(float)[[0, -1]], [0, 120 * np.pi], atol=1e-6)
    space = np.array([found[f"upper flank bottom {axis} [mm]"].astype(float) for axis in "xyz"]) * mm
    assert_allclose(space, analysis.in_space(54 * mm, -1), rtol=0, atol=1e-9)
    assert "upper flank bottom x [mm]" not in columns(tables.table(BarrelCam(groove=False)).data.decode())


def test_the_seam_of_the_unrolled_groove_is_no_end():
    """The sharpest place at cam angle 0: half of it lies on either side of the seam, and is cut from both."""
    law = SimpleHarmonic()
    segments = Return(40 * deg, 25 * mm, law), Dwell(280 * deg), Rise(40 * deg, 25 * mm, law)
    analysis = BarrelCam(MotionProgram(segments), roller_radius=15 * mm).analyse(1441)
    assert "undercut" in analysis.trouble
    assert "theory profile x [mm]" in columns(tables.table(analysis).data.decode())


def test_the_walls_of_an_open_groove_merge_across_the_seam():
    """340 deg with a rise of 5 mm: start and end are 20 deg apart, which the unrolled groove does not show."""
    cam = BarrelCam(MotionProgram((Rise(340 * deg, 5 * mm, Cycloidal()),)))
    apart = np.hypot(2 * cam.bottom_radius * np.sin(10 * deg), 5 * mm)
    assert groove_gap(cam.analyse()) == pytest.approx(apart - 16 * mm, abs=2e-3 * mm)
    assert groove_gap(cam.replace(roller_radius=10 * mm).analyse()) < 0
    assert "walls merge" in cam.replace(roller_radius=10 * mm).analyse().trouble
