"""Measures of a curve at one cam angle, or between two: against the curve at many angles, in searches, in files."""

import re

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import Study, minimise
from camkit.cam import (
    ConjugatePair,
    ContactPair,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    max_pressure_angle,
    min_force,
    peak_acceleration,
    peak_pressure,
    peak_torque,
    travel,
    undercut_margin,
)
from camkit.cam.measures import MOTION
from camkit.cam.pair import CAMS
from camkit.files import from_json, to_json
from camkit.machines import DoorHandleCam, HighSpeedCam
from camkit.machines import high_speed_measures as fast
from camkit.motion import Cycloidal, Dwell, FreePolynomial, MotionProgram, Return, Rise
from camkit.quantities import CurveMeasure, Measure, PeakMeasure, measures_of
from camkit.search.front import Front
from camkit.search.minimax import Epigraph
from camkit.units import deg, mm

FOLLOWERS = {
    "groove": TranslatingRollerCam(),
    "plate": TranslatingRollerCam(groove=False, offset=5 * mm, contact=ContactPair()),
    "knife edge": TranslatingRollerCam(roller_radius=0.0),
    "sliding flat": TranslatingFlatCam(contact=ContactPair()),
    "rocking roller": OscillatingRollerCam(),
    "rocking flat": OscillatingFlatCam(contact=ContactPair()),
    **{f"pair, {cam.name}": ConjugatePair(cam) for cam in CAMS},
}
ZONES = [(30, 60), (100, 200), (350, 10), (170, 20), (0, 360), (120, 180)]


def many(low, high, span):
    """Many cam angles of a zone, a hair beside its joints too."""
    ends = [(low, high)] if low < high else [(low, 360), (0, high)]
    return np.concatenate([np.linspace(a * deg, min(b * deg, span), 40_001) for a, b in ends])


@pytest.mark.parametrize("zone", ZONES, ids=str)
@pytest.mark.parametrize("cam", FOLLOWERS.values(), ids=FOLLOWERS.keys())
def test_a_zone_holds_the_extreme_of_many_angles(cam, zone):
    """The pressure angle, wherever that cam pushes, and the torque."""
    analysis, low, high = cam.analyse(), *zone
    angle = many(low, high, cam.motion.span if hasattr(cam, "motion") else cam.cam.motion.span)
    curves = [curve.at(angle) for curve in analysis.curves.values()]
    pushed = [len(curves) == 1 or curve.contact_force >= 0 for curve in curves]
    for measure, curve in ((max_pressure_angle, "pressure_angle"), (peak_torque, "cam_torque")):
        seen = measure.between(low * deg, high * deg)
        dense = max(np.where(on, abs(getattr(c, curve)), 0).max() for c, on in zip(curves, pushed, strict=True))
        found = seen.one(analysis)
        assert -1e-9 * dense <= found - dense <= 2e-5 * dense, "many angles pass a joint by half a step"
        near = 1e-2 if len(curves) > 1 else 1e-5  # where the other cam takes over between two points
        assert seen.curve(analysis).max() == pytest.approx(found, rel=near)


@pytest.mark.parametrize("cam", [FOLLOWERS[n] for n in ("plate", "sliding flat", "rocking flat")], ids=lambda c: c.name)
def test_every_curve_of_a_cam_has_zones_and_checkpoints(cam):
    """The whole turn is the measure itself, a small zone its value at a cam angle."""
    analysis = cam.analyse()
    curves = [measure for measure in measures_of(cam) if isinstance(measure, CurveMeasure)]
    assert {"maximum pressure angle", "peak contact pressure", "wear index", "travel"} <= {m.name for m in curves}
    for measure in curves:
        whole = measure.one(analysis)
        assert measure.between(0, 360 * deg).one(analysis) == pytest.approx(whole, rel=1e-9)
        here = measure.at(75 * deg).one(analysis)
        assert measure.between(74.9999 * deg, 75.0001 * deg).one(analysis) == pytest.approx(here, rel=1e-4, abs=1e-9)
        assert measure.way * whole >= measure.way * here - 1e-9 * abs(whole)


@pytest.mark.parametrize("turn", [(0, 360), (-180, 180), (-10, 350), (-360, 0), (-300, 100)], ids=str)
def test_a_whole_turn_is_the_measure_itself_wherever_it_begins(turn):
    """Also where the speed jumps at 120 deg, by which the roller's path has a corner."""
    jolt = Rise(120 * deg, 20 * mm, FreePolynomial(start=(0, 0, 0), end=(1, 1.5)))
    rest = Dwell(60 * deg), Return(120 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg)
    low, high = (end * deg for end in turn)
    for cam in (TranslatingRollerCam(), TranslatingRollerCam(MotionProgram((jolt, *rest)))):
        seen = np.array([m.between(low, high).one(cam.analyse()) for m in (max_pressure_angle, undercut_margin)])
        assert_array_equal(seen, [m.one(cam.analyse()) for m in (max_pressure_angle, undercut_margin)])
    assert np.isneginf(seen[1])
    assert np.isneginf(undercut_margin.between(100 * deg, 90 * deg).one(cam.analyse()))
    assert undercut_margin.between(130 * deg, 110 * deg).one(cam.analyse()) > 0


def test_a_checkpoint_is_the_curve_there():
    cam = FOLLOWERS["plate"]
    at, analysis = np.array([40.0, 120.0, 200.0]) * deg, cam.analyse()
    there = analysis.at(at)
    for i, angle in enumerate(at):
        assert travel.at(angle).one(analysis) == pytest.approx(there.motion.s[i], abs=1e-15)
        assert peak_acceleration.at(angle).one(analysis) == pytest.approx(abs(there.acceleration[i]), abs=1e-15)
        assert min_force.at(angle).one(analysis) == pytest.approx(there.contact_force[i], rel=1e-12)
    assert (-travel).at(at[0]).one(analysis) == -there.motion.s[0]
    assert travel.at(-320 * deg).one(analysis) == pytest.approx(travel.at(40 * deg).one(analysis))


def test_names_say_the_zone():
    assert max_pressure_angle.between(350 * deg, 10 * deg).label == "maximum pressure angle, 350 to 10 deg  [deg]"
    assert travel.at(40 * deg).label == "travel at 40 deg  [mm]"
    assert max_pressure_angle.between(0, 1) != max_pressure_angle.between(0, 2)


def test_a_population_has_the_zones_of_its_members():
    """Also where the joints of the motion, and so its pieces, lie elsewhere in each."""
    cam = TranslatingRollerCam()
    zone, spot = max_pressure_angle.between(100 * deg, 200 * deg), travel.at(110 * deg)
    study = Study(cam, {"motion.rise.angle": (1.5, 2.6), "base_radius": (0.03, 0.04)}, (zone,), at_least={spot: 1 * mm})
    x = np.array([[1.6, 0.03], [2.0, 0.035], [2.5, 0.04]])
    together = study.evaluate(x)
    for i, row in enumerate(x):
        analysis = study.design(row).analyse()
        assert together.f[i, 0] == pytest.approx(zone.one(analysis), rel=1e-9)
        assert together.g[i, 0] == pytest.approx(-(spot.one(analysis) / mm - 1), rel=1e-9)
    columns = Epigraph(study).columns((x - study.bounds[0]) / np.ptp(study.bounds, axis=0))
    assert columns[:, :-1].max(-1) == pytest.approx(together.f[:, 0], rel=1e-6)


@pytest.mark.parametrize("zone", [(20, 40), (0, 30), (45, 80), (300, 30)], ids=str)
def test_zones_of_both_curves_of_a_door_handle(zone):
    cam = DoorHandleCam()
    analysis, low, high = cam.analyse(), *(end * deg for end in zone)
    steep = {m.name: m for m in DoorHandleCam.measures}
    for name in ("lift", "relief"):
        inside = many(*zone, cam.lift.motion.span)
        dense = abs(getattr(analysis, name).at(inside).pressure_angle).max()
        seen = steep[f"maximum pressure angle, {name}"].between(low, high)
        if low < high:
            assert seen.one(analysis) == pytest.approx(dense, rel=1e-6)
        else:
            assert np.isnan(seen.one(analysis)), "the handle does not turn so far"


@pytest.mark.parametrize("zone", [(10, 40), (60, 100), (150, 220)], ids=str)
def test_zones_of_a_high_speed_cam(zone):
    """Rise and fall are seen together, to 0.1 %; a checkpoint exactly."""
    cam = HighSpeedCam()
    analysis, (low, high) = cam.analyse(), (end * deg for end in zone)
    dense = analysis.at(np.linspace(low, high, 20_001))
    assert fast.max_pressure_angle.between(low, high).one(analysis) == pytest.approx(
        abs(dense.pressure_angle).max(), rel=1e-3
    )
    here = fast.peak_stress.at(low)
    assert here.text(here.one(analysis)) == here.text(dense.stress_coefficient[0] * mm**-0.5)


def test_limits_of_zones_are_kept_and_named():
    """The law's own way is found by brute force over its two coefficients."""
    free = {f"motion.rise.law.c{i}": (-0.2, 0.2) for i in range(2)}
    start = TranslatingRollerCam().ready_for(free)
    early, late = travel.at(30 * deg), max_pressure_angle.between(80 * deg, 110 * deg)
    study = Study(
        start, free, (peak_acceleration.between(0, 120 * deg),), at_most={early: 1.5 * mm, late: 19 * deg}, angles=91
    )
    best = minimise(study)
    assert best.feasible
    assert "the travel at 30 deg 1.5 mm" in best.message
    assert {a.kind for a in best.active} == {"peak", "limit"}
    grid = np.stack(np.meshgrid(*[np.linspace(-0.2, 0.2, 61)] * 2), -1).reshape(-1, 2)
    tried = study.evaluate(grid)
    least = tried.f[tried.feasible].min()
    assert best.f <= least
    assert best.f == pytest.approx(least, rel=0.02)


def test_zones_are_read_from_files():
    zones = (max_pressure_angle.between(30 * deg, 60 * deg), -travel.at(40 * deg))
    own = PeakMeasure("own", "", lambda a: a.motion.s / a.motion.s.max(), angle=lambda a: a.cam_angle)
    limits = {peak_pressure.between(350 * deg, 10 * deg): 4e8, own.between(0, 1): 1.0}
    study = Study(TranslatingRollerCam(contact=ContactPair()), ["base_radius"], zones, at_most=limits)
    front = Front(study, np.array([[0.03]]), study.evaluate([[0.03]]).f)
    read = from_json(to_json(front), measures=(own,))
    assert read.study.minimise == study.minimise
    assert read.study.at_most == pytest.approx(study.at_most)
    assert read.f == pytest.approx(front.f)
    damaged = to_json(front).replace("350 to 10", "340 to 10")
    with pytest.raises(ValueError, match="does not make this measure"):
        from_json(damaged, measures=(own,))


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (
            lambda: max_pressure_angle.between(30, 60),
            "the cam angle (rad) of the maximum pressure angle is 30; it must",
        ),
        (lambda: max_pressure_angle.at("top"), "it must be from -360 to 360 deg; for 30 degrees write 30 * deg"),
        (lambda: max_pressure_angle.between(1.0, 1.0), "to the same angle; take at() for one"),
        (lambda: max_pressure_angle.between(360 * deg, 0), "from 360 deg to the same angle; take at() for one"),
        (lambda: max_pressure_angle.between(0, 1).between(0, 1), "is seen at some cam angles alone already"),
        (
            lambda: Study(TranslatingRollerCam(), ["base_radius"], (peak_pressure.between(0, 1),)),
            "the peak contact pressure does not apply to the start of the study: the contact is not",
        ),
        (
            lambda: PeakMeasure("height", "mm", np.asarray, angle=np.asarray).at(1.0).one(np.ones(3)),
            "the height at 57.2958 deg does not apply to",
        ),
        (lambda: PeakMeasure("height", "mm", np.asarray).at(1.0), "does not say at which cam angles its points stand"),
    ],
)
def test_what_is_no_zone_is_refused_in_a_sentence(ask, sentence):
    with pytest.raises(ValueError, match=re.escape(sentence)):
        ask()


def test_beyond_the_motion_there_is_no_number():
    assert np.isnan(max_pressure_angle.at(190 * deg).one(DoorHandleCam().lift.analyse()))


def test_margins_against_undercut_are_seen_on_both_flanks():
    cam = TranslatingRollerCam()
    analysis = cam.analyse()
    dense = analysis.at(np.linspace(0, 1, 20_001) * 150 * deg).curvature
    seen = undercut_margin.between(0, 150 * deg)
    assert seen.one(analysis) == pytest.approx(1 - cam.roller_radius * abs(dense).max(), rel=1e-6)
    assert len(seen.curve(analysis)) == 2 * len(max_pressure_angle.between(0, 150 * deg).curve(analysis))


def test_a_knife_edge_has_no_margin_to_lose():
    assert undercut_margin.curve(FOLLOWERS["knife edge"].analyse()).tolist() == pytest.approx([1.0] * 528)


def test_motion_measures_are_those_of_the_law():
    """Cycloidal: ``h 2 pi / beta^2``."""
    arm = OscillatingRollerCam()
    lift, angle = arm.motion.segments[0].lift, arm.motion.segments[0].angle
    assert MOTION[1].one(arm.analyse()) == pytest.approx(2 * np.pi * lift / angle**2, rel=1e-9)
    assert isinstance(MOTION[1].at(1.0), Measure)


@pytest.mark.parametrize("cam", [*FOLLOWERS.values(), DoorHandleCam()], ids=[*FOLLOWERS, "door handle"])
def test_every_point_of_a_curve_has_its_angle(cam):
    analysis, near = cam.analyse(), 1e-2 if isinstance(cam, ConjugatePair) else 1e-4
    for measure in measures_of(cam):
        if isinstance(measure, CurveMeasure) and measure.angle:
            curve = np.broadcast_to(measure.curve(analysis), np.shape(measure.angle(analysis)))
            value = measure.way * np.max(measure.way * curve)
            assert value == pytest.approx(measure.one(analysis), rel=near, nan_ok=True)
