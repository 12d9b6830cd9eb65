"""The followers against brute force: a roller or a face is put where the motion says, and cuts the cam.

``Brute`` knows the follower's place at every cam angle and nothing of the package's formulas: the cam is what is left
of the disk when every position of the follower has been cut away.  Where neighbouring positions meet is the profile.
"""

from dataclasses import dataclass, fields, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import DoorHandleCam, OscillatingRollerCam, Study, views
from camkit.cam.conjugate import opposite
from camkit.cam.flat_analysis import FlatAnalysis
from camkit.cam.loads import ArmLoad, Friction
from camkit.cam.measures import max_pressure_angle, mean_efficiency, work_efficiency
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.slide import SlideFriction, SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.files import from_json, to_json
from camkit.files.workshop import tables
from camkit.motion import LAWS, Cycloidal, Dwell, MotionProgram, Poly345, Return, Rise, SimpleHarmonic
from camkit.quantities import unremarked
from camkit.render import picture
from camkit.units import N, deg, kg, m, mm, rpm

SPAN = np.array([120, 60, 130, 50]) * deg
JOINTS = np.cumsum(SPAN)


def program(lift, spans=SPAN):
    rise, high, back, low = spans
    return MotionProgram((Rise(rise, lift, Cycloidal()), Dwell(high), Return(back, lift, Cycloidal()), Dwell(low)))


def travel(phi, lift, spans=SPAN):
    """Up and down again, after the textbook's cycloidal law."""
    rise, high, back, _ = spans

    def law(u):
        u = np.clip(u, 0, 1)
        return u - np.sin(2 * np.pi * u) / (2 * np.pi)

    return lift * (law(phi / rise) - law((phi - rise - high) / back))


def turned(points, angle):
    x, y = points
    return np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)])


def cross(p, q):
    return p[0] * q[1] - p[1] * q[0]


def richardson(at, h=2e-3):
    """``at(0)`` from steps of both signs: the errors of order 2 and 4 cancel."""
    coarse, middle, fine = at(h), at(h / 2), at(h / 4)
    return (64 * fine - 20 * middle + coarse) / 45


@dataclass(frozen=True)
class Brute:
    """A follower that is moved around a cam turning by ``sigma``."""

    cam: object
    lift: float
    spans: tuple = tuple(SPAN)

    @property
    def base(self):
        return self.cam.base_radius if hasattr(self.cam, "base_radius") else 20 * mm

    def s(self, phi):
        return travel(phi, self.lift, self.spans)

    def at(self, sigma):
        return replace(self, cam=replace(self.cam, rotation=sigma))

    def on_cam(self, points, phi):
        return turned(points, -self.cam.rotation * phi)


class Roller(Brute):
    """A circle at ``centre``."""

    def envelope(self, phi, side):
        """Where the roller's circles a little before and after ``phi`` meet."""
        r, away = self.cam.roller_radius, self.on_cam(self.outward(phi), phi)

        def meet(h):
            before, after = (self.on_cam(self.centre(x), x) for x in (phi - h, phi + h))
            half = np.hypot(*(after - before)) / 2
            across = np.array([before[1] - after[1], after[0] - before[0]]) / (2 * half)
            across = across * np.sign((across * away).sum(0)) * side
            return (before + after) / 2 + np.sqrt(r**2 - half**2) * across

        return richardson(meet)

    def room(self, points, phi):
        """Distance of each point from the nearest position of the roller, less its radius."""
        path = self.on_cam(self.centre(phi), phi)
        gap = np.hypot(*(points[:, :, None] - path[:, None, :]))
        return gap.min(-1) - self.cam.roller_radius


class Face(Brute):
    """A straight line through ``foot`` with the ``outward`` normal."""

    def line(self, phi):
        normal = self.on_cam(self.outward(phi), phi)
        return normal, (normal * self.on_cam(self.foot(phi), phi)).sum(0)

    def envelope(self, phi, side=-1):
        """Where the lines a little before and after ``phi`` meet."""

        def meet(h):
            (n, p), (k, q) = self.line(phi - h), self.line(phi + h)
            return np.array([p * k[1] - q * n[1], q * n[0] - p * k[0]]) / cross(n, k)

        return richardson(meet)

    def room(self, points, phi):
        """Distance of each point below the nearest position of the face."""
        normal, distance = self.line(phi)
        return (distance - np.tensordot(points, normal, (0, 0))).min(-1)


class SlidingRoller(Roller):
    def centre(self, phi):
        start = np.sqrt((self.cam.base_radius + self.cam.roller_radius) ** 2 - self.cam.offset**2)
        return np.array([self.cam.offset + 0 * phi, start + self.s(phi)])

    def outward(self, phi):
        return np.array([0 * phi, 1 + 0 * phi])

    def push(self, phi):
        """How the follower's point in ``point`` moves with the travel."""
        return lambda point: np.array([0 * phi, 1 + 0 * phi])


class SlidingFace(Face):
    def foot(self, phi):
        return np.array([self.cam.offset + 0 * phi, self.cam.base_radius + self.s(phi)])

    outward, push = SlidingRoller.outward, SlidingRoller.push


class Rocking:
    def psi(self, phi):
        return self.cam.start_angle + self.s(phi)

    def pivot(self, phi):
        return np.array([self.cam.centre_distance + 0 * phi, 0 * phi])

    def outward(self, phi):
        """Square to the arm, to the side of a growing angle."""
        return np.array([np.sin(self.psi(phi)), np.cos(self.psi(phi))])

    def push(self, phi):
        def moves(point):
            x, y = point - self.pivot(phi)
            return np.array([y, -x])

        return moves


class RockingRoller(Rocking, Roller):
    def centre(self, phi):
        l, psi = self.cam.arm_length, self.psi(phi)
        return self.pivot(phi) + l * np.array([-np.cos(psi), np.sin(psi)])


class RockingFace(Rocking, Face):
    def foot(self, phi):
        return self.pivot(phi) + self.cam.face_offset * self.outward(phi)


SLIDE = SlideLoad(mass=2 * kg, speed=400 * rpm, force=30 * N, spring_rate=6e3, preload=200 * N, gravity=9.81)
ARM = ArmLoad(mass=2 * kg, speed=300 * rpm, torque=3, spring_rate=8, preload=20, gravity=9.81, up_angle=70 * deg)
FOLLOWERS = {
    "sliding roller": SlidingRoller(
        TranslatingRollerCam(program(20 * mm), 30 * mm, 8 * mm, 0 * mm, load=SLIDE), 20 * mm
    ),
    "offset roller": SlidingRoller(
        TranslatingRollerCam(program(22 * mm), 32 * mm, 6 * mm, 9 * mm, load=SLIDE), 22 * mm
    ),
    "sliding face": SlidingFace(TranslatingFlatCam(program(20 * mm), 35 * mm, 4 * mm, load=SLIDE), 20 * mm),
    "rocking roller": RockingRoller(
        OscillatingRollerCam(program(25 * deg), 90 * mm, 70 * mm, 25 * deg, 6 * mm, load=ARM), 25 * deg
    ),
    "rocking face": RockingFace(
        OscillatingFlatCam(program(14 * deg), 90 * mm, 20 * deg, 6 * mm, 160 * mm, load=ARM), 14 * deg
    ),
    "rocking face below its pivot": RockingFace(
        OscillatingFlatCam(program(10 * deg), 80 * mm, 40 * deg, -8 * mm, 160 * mm, load=ARM), 10 * deg
    ),
}
every_follower = pytest.mark.parametrize("brute", FOLLOWERS.values(), ids=FOLLOWERS)
both_senses = pytest.mark.parametrize("sigma", [1, -1], ids=["counter-clockwise", "clockwise"])
INSIDE = np.concatenate([end - span * np.linspace(0.98, 0.02, 60) for end, span in zip(JOINTS, SPAN, strict=True)])
"""Cam angles away from the joints, so that differences can reach to both sides."""
STROKES = np.concatenate([INSIDE[:60], INSIDE[120:180]])
"""Those at which the follower moves."""


def analysed(cam, phi=INSIDE):
    """The package's analysis at given cam angles."""
    return replace(cam.analyse(31), cam_angle=phi)


# ---------------------------------------------------------------- geometry


@every_follower
@both_senses
def test_the_profile_is_the_envelope_of_the_moving_follower(brute, sigma):
    brute = brute.at(sigma)
    analysis = analysed(brute.cam)
    assert_allclose(analysis.profile, brute.envelope(INSIDE, -1), rtol=0, atol=1e-8 * brute.base)
    if isinstance(brute, Roller):
        assert_allclose(analysis.outer_profile, brute.envelope(INSIDE, 1), rtol=0, atol=1e-8 * brute.base)


@every_follower
@both_senses
def test_no_position_of_the_follower_enters_the_cam(brute, sigma):
    """And none stays away from it: the nearest position just touches."""
    brute = brute.at(sigma)
    analysis = brute.cam.analyse(721)
    assert not analysis.undercut.any()
    around = np.linspace(0, 2 * np.pi, 7201)
    assert_allclose(brute.room(analysis.profile[:, ::8], around), 0, atol=1e-6 * brute.base)


TOO_SMALL = {
    "sliding roller": {"base_radius": 20 * mm, "roller_radius": 22 * mm},
    "offset roller": {"base_radius": 20 * mm, "roller_radius": 22 * mm},
    "sliding face": {"base_radius": 50 * mm},
    "rocking roller": {"roller_radius": 22 * mm},
    "rocking face": {"face_offset": 20 * mm, "centre_distance": 60 * mm},
    "rocking face below its pivot": {"face_offset": -4 * mm},
}


@both_senses
@pytest.mark.parametrize("name", FOLLOWERS)
def test_an_undercut_profile_is_cut_by_another_position_of_the_follower(name, sigma):
    """The motion crowded into a part of the turn, on a cam that is too small for it."""
    brute = FOLLOWERS[name]
    spans = np.array([50, 10, 52, 248] if isinstance(brute, Roller) else [70, 10, 72, 208]) * deg
    cam = brute.cam.replace(**TOO_SMALL[name], motion=program(brute.lift, spans), rotation=sigma)
    brute = replace(brute, cam=cam, spans=spans)
    analysis = cam.analyse(2881)
    assert 0.005 < analysis.undercut.mean() < 0.3
    room = brute.room(analysis.profile, np.linspace(0, 2 * np.pi, 2881))
    assert (room[analysis.undercut] < 0).all()
    assert room.min() < -1e-4 * brute.base
    margin, place = analysis.profile_margin
    assert margin < 0
    at = np.searchsorted(analysis.cam_angle, place)
    assert analysis.undercut[at - 1 : at + 1].any()


@every_follower
@both_senses
def test_the_pressure_angle_lies_between_the_normal_and_the_way_the_follower_goes(brute, sigma):
    brute = brute.at(sigma)
    analysis = analysed(brute.cam)
    edge = brute.envelope(INSIDE, -1)
    h = 1e-4
    tangent = brute.envelope(INSIDE + h, -1) - brute.envelope(INSIDE - h, -1)
    normal = turned([-tangent[1], tangent[0]] / np.hypot(*tangent), sigma * INSIDE)
    normal = normal * np.sign((normal * brute.outward(INSIDE)).sum(0))
    assert_allclose(analysis.normal, normal, rtol=0, atol=1e-6)
    goes_at = brute.centre(INSIDE) if isinstance(brute, Roller) else turned(edge, sigma * INSIDE)
    goes = brute.push(INSIDE)(goes_at)
    goes = goes / np.hypot(*goes)
    assert_allclose(np.cos(analysis.pressure_angle), (goes * normal).sum(0), rtol=0, atol=1e-7)
    assert_allclose(abs(np.sin(analysis.pressure_angle)), abs(cross(goes, normal)), rtol=0, atol=2e-6)


STENCIL = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
SECOND = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])


def curvature_of_points(cam, name, phi, h=1e-3):
    """Curvature of a curve of the cam, convex > 0, from nine of its points: differences of order 8."""
    around = analysed(cam, (phi[:, None] + h * np.arange(-4, 5)).ravel())
    points = getattr(around, name).reshape(2, len(phi), 9)
    first, second = points @ STENCIL / h, points @ SECOND / h**2
    outward = around.on_cam(around.normal).reshape(2, len(phi), 9)[..., 4]
    return -(second * outward).sum(0) / (first**2).sum(0)


@every_follower
@both_senses
@pytest.mark.parametrize("name", ["pitch", "profile", "outer_profile"])
def test_curvature_is_that_of_the_points(brute, sigma, name):
    cam = brute.at(sigma).cam
    if isinstance(brute, Face) and name == "outer_profile":
        assert np.isnan(analysed(cam).outer_profile_curvature).all()
        return
    found = getattr(analysed(cam), {"pitch": "curvature"}.get(name, f"{name}_curvature"))
    assert_allclose(found, curvature_of_points(cam, name, INSIDE), rtol=1e-6, atol=1e-6 / m)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@both_senses
@pytest.mark.parametrize(
    "cam",
    [TranslatingRollerCam(offset=7 * mm), TranslatingFlatCam(base_radius=60 * mm), OscillatingFlatCam()],
    ids=lambda cam: type(cam).__name__,
)
def test_curvature_is_that_of_the_points_with_every_law(cam, law, sigma):
    lift = 10 * deg if isinstance(cam, OscillatingFlatCam) else 15 * mm
    u = np.linspace(0.03, 0.97, 48)
    smooth = np.min([abs(u - kink) for kink in (*law.kinks, 9)], axis=0) > 0.01
    phi = u[smooth] * 120 * deg
    cam = cam.replace(motion=MotionProgram((Rise(120 * deg, lift, law),)), rotation=sigma)
    expected = curvature_of_points(cam, "profile", phi)
    assert_allclose(analysed(cam, phi).profile_curvature, expected, rtol=1e-6, atol=1e-6 / m)


@every_follower
@both_senses
def test_margins_and_reach_are_those_of_a_very_fine_table(brute, sigma):
    cam = brute.at(sigma).cam
    coarse, fine = cam.analyse(181), cam.analyse(200_001)
    radius = 1 / fine.profile_curvature
    convex = np.where(radius > 0, radius, np.inf)
    assert_allclose(coarse.profile_margin.value, convex.min(), rtol=1e-7)
    there = analysed(cam, np.atleast_1d(coarse.profile_margin.cam_angle)).profile_curvature
    assert 1 / there == pytest.approx(convex.min(), rel=1e-7)
    if isinstance(brute, Face):
        along = fine.contact_offset if isinstance(brute, SlidingFace) else fine.contact_length
        assert_allclose(coarse.face_reach, [along.min(), along.max()], rtol=1e-7)
        assert_allclose(coarse.face_width, np.ptp(along), rtol=1e-7)
    else:
        outer = -1 / fine.outer_profile_curvature
        least = np.where(outer > 0, outer, np.inf).min()
        assert_allclose(coarse.outer_profile_margin.value, least, rtol=1e-7)


@both_senses
@pytest.mark.parametrize("name", ["sliding face", "rocking face", "rocking face below its pivot"])
def test_the_narrowest_face_is_touched_up_to_both_ends(name, sigma):
    """Its ends in the machine's frame lie on the face, and between them lies every contact."""
    brute = FOLLOWERS[name].at(sigma)
    analysis = brute.cam.analyse(20001)
    (x, y), contact = analysis.face, analysis.contact_point()
    start, end = np.array([x[0], y[0]]), np.array([x[1], y[1]])
    share = ((contact - start) * (end - start)).sum(0) / ((end - start) ** 2).sum(0)
    assert_allclose(cross(contact - start, end - start), 0, atol=1e-15)
    assert share.min() == pytest.approx(0, abs=1e-6)
    assert share.max() == pytest.approx(1, abs=1e-6)


def test_a_knife_edge_is_a_roller_of_radius_zero():
    cam = TranslatingRollerCam(roller_radius=0)
    analysis = cam.analyse()
    assert_array_equal(analysis.profile, analysis.pitch)
    assert_array_equal(analysis.profile, analysis.outer_profile)
    assert_array_equal(analysis.profile_curvature, analysis.curvature)
    assert analysis.profile_margin.value == pytest.approx(30 * mm, rel=1e-12)
    assert not analysis.undercut.any()


def test_a_huge_roller_is_a_flat_face():
    """In the limit, found from three large rollers, the profile is that of the flat follower."""
    flat = TranslatingFlatCam(base_radius=35 * mm).analyse(181)
    with unremarked():
        large = [TranslatingRollerCam(base_radius=35 * mm, roller_radius=r * m).analyse(181) for r in (40, 20, 10)]
    profile, margin = (
        (8 * one - 6 * two + four) / 3  # the errors of order 1/r and 1/r^2 cancel
        for one, two, four in (
            [roller.profile for roller in large],
            [roller.profile_margin.value for roller in large],
        )
    )
    assert_allclose(profile, flat.profile, atol=1e-9 * m)
    assert_allclose(margin, flat.profile_margin.value, rtol=1e-5)


def test_reversing_the_cam_mirrors_the_follower():
    """A clockwise cam under an offset follower is the mirror image of the other sense with the other offset."""
    one = TranslatingRollerCam(offset=9 * mm).analyse(181)
    other = TranslatingRollerCam(offset=-9 * mm, rotation=-1).analyse(181)
    assert_allclose(one.profile * [[-1], [1]], other.profile, atol=1e-16)
    assert_array_equal(one.pressure_angle, other.pressure_angle)


# ---------------------------------------------------------------- published cases


def test_pressure_angles_of_a_published_case():
    """Case V12: lift 20 mm in 120 deg, base circle 30 mm, roller 8 mm; other published tools print 26.11 for both."""
    rise = MotionProgram((Rise(120 * deg, 20 * mm, Cycloidal()),))
    for offset, printed in ((0, 22.0528), (5, 16.6857)):
        analysis = TranslatingRollerCam(rise, 30 * mm, 8 * mm, offset * mm).analyse(20001)
        assert analysis.pressure_angle.max() / deg == pytest.approx(printed, abs=1e-4)
    arm = OscillatingRollerCam(centre_distance=120 * mm, arm_length=80 * mm, start_angle=30 * deg)
    assert arm.analyse().pressure_angle[0] / deg == pytest.approx(-21.738033800290157, rel=1e-14)


def two_rises(law):
    """Case V3: rises of 3 and 2 over 90 and 60 deg, each with its return, dwells of 15 deg."""
    moves = [
        (Rise(angle * deg, lift * mm, law), Dwell(15 * deg), Return(angle * deg, lift * mm, law), Dwell(15 * deg))
        for lift, angle in ((3, 90), (2, 60))
    ]
    return MotionProgram(sum(moves, ()))


def test_base_circle_of_a_published_case():
    """Case V3 (PyPI mechanism 1.1.10, examples/cam1_example.py): roller of radius 1, pressure angle 30 deg."""
    cam = TranslatingRollerCam(two_rises(Cycloidal()), 10 * mm, 1 * mm)
    base = cam.base_radius_for(pressure_angle=30 * deg)
    sized = cam.replace(base_radius=base).analyse()
    assert base / mm == pytest.approx(4.67701748, abs=1e-8)
    assert base / mm == pytest.approx(4.676993, rel=1e-5)  # as printed, from a table of the pressure angle
    assert 1 / sized.highest(lambda at: at.curvature).value / mm == pytest.approx(3.09690681, abs=1e-8)
    assert pytest.approx(3.09690681, rel=1e-5) == 3.096937  # the printed least radius of the pitch curve


def test_flat_follower_of_a_published_case():
    """Case V3: flat face, harmonic motion, least radius 1."""
    cam = TranslatingFlatCam(two_rises(SimpleHarmonic()), 10 * mm)
    assert cam.base_radius_for(min_radius=1 * mm) / mm == pytest.approx(8, rel=1e-12)
    assert cam.analyse().face_width / mm == pytest.approx(6, rel=1e-12)


# ---------------------------------------------------------------- sizes


@both_senses
@pytest.mark.parametrize("offset", [-8, 0, 8])
@pytest.mark.parametrize("limit", [12, 25, 40])
def test_the_base_circle_for_a_pressure_angle(limit, offset, sigma):
    cam = TranslatingRollerCam(program(30 * mm), 40 * mm, 5 * mm, offset * mm, sigma)
    needed = cam.base_radius_for(pressure_angle=limit * deg)

    def steepest_at(base):
        analysis = cam.replace(base_radius=base).analyse()
        return analysis.highest(lambda at: abs(at.pressure_angle)).value

    assert steepest_at(needed) == pytest.approx(limit * deg, rel=1e-9)
    assert all(steepest_at(needed * more) < limit * deg for more in (1.0001, 1.1, 2, 10))
    assert steepest_at(needed * 0.999) > limit * deg


@both_senses
@pytest.mark.parametrize("offset", [-8, 0, 8])
@pytest.mark.parametrize(("roller", "least", "rise"), [(8, 6, 120), (0, 15, 120), (14, 2, 120), (4, 1, 40)])
def test_the_base_circle_for_a_least_radius(roller, least, rise, offset, sigma):
    motion = program(30 * mm, np.array([rise, 60, 100, 50]) * deg)
    cam = TranslatingRollerCam(motion, 60 * mm, roller * mm, offset * mm, sigma)
    needed = cam.base_radius_for(min_radius=least * mm)

    def least_at(base):
        return cam.replace(base_radius=base).analyse().profile_margin.value

    assert least_at(needed) == pytest.approx(least * mm, rel=1e-7, abs=1e-7 * mm)
    assert all(least_at(needed * more) > least * mm for more in (1.0001, 1.1, 2, 10))
    assert least_at(needed - 0.01 * mm) < least * mm


def test_the_larger_of_two_base_circles_keeps_both_limits():
    cam = TranslatingRollerCam(program(30 * mm), 40 * mm, 5 * mm)
    for alpha in (20 * deg, 60 * deg):
        both = cam.base_radius_for(pressure_angle=alpha, min_radius=20 * mm)
        each = cam.base_radius_for(pressure_angle=alpha), cam.base_radius_for(min_radius=20 * mm)
        assert both == pytest.approx(max(each), rel=1e-12)


@pytest.mark.parametrize("offset", [0, 9])
def test_the_least_base_circle_of_a_follower_that_goes_down_can_just_be_built(offset):
    """A wide limit leaves the roller's own size: it must not cover the cam axis."""
    down = MotionProgram((Return(120 * deg, 40 * mm, Cycloidal()), Dwell(60 * deg)))
    cam = TranslatingRollerCam(down, 60 * mm, 20 * mm, offset * mm)
    needed = cam.base_radius_for(pressure_angle=85 * deg)
    cam.replace(base_radius=needed + 1e-6 * mm).analyse()
    with pytest.raises(ValueError, match="it must stay outside it"):
        cam.replace(base_radius=needed - 1e-6 * mm).analyse()


@both_senses
def test_the_base_circle_of_a_flat_follower(sigma):
    cam = TranslatingFlatCam(program(30 * mm), 90 * mm, rotation=sigma)
    sized = cam.replace(base_radius=cam.base_radius_for(min_radius=5 * mm))
    assert sized.analyse().profile_margin.value == pytest.approx(5 * mm, rel=1e-9)
    assert sized.analyse(20001).profile_radius.min() == pytest.approx(5 * mm, rel=1e-6)


@both_senses
def test_the_offset_of_a_rocking_face(sigma):
    cam = OscillatingFlatCam(program(14 * deg), 90 * mm, 20 * deg, rotation=sigma, arm_length=200 * mm)
    sized = cam.replace(face_offset=cam.face_offset_for(min_radius=25 * mm))
    assert sized.analyse().profile_margin.value == pytest.approx(25 * mm, rel=1e-9)


def test_sizes_of_a_population():
    rollers = np.array([[2.0], [8.0], [12.0]]) * mm
    cam = TranslatingRollerCam(program(30 * mm), 40 * mm, rollers, 4 * mm)
    limits = {"pressure_angle": 20 * deg, "min_radius": 10 * mm}
    singles = [cam.replace(roller_radius=float(r)).base_radius_for(**limits) for r in rollers[:, 0]]
    assert_allclose(cam.base_radius_for(**limits), singles, rtol=1e-13)
    lifts = np.array([[10.0], [20.0]]) * mm
    flat = TranslatingFlatCam(MotionProgram((Rise(120 * deg, lifts, Cycloidal()),)))
    singles = [flat.replace(motion=MotionProgram((Rise(120 * deg, lift, Cycloidal()),))) for lift in lifts[:, 0]]
    assert_allclose(
        flat.base_radius_for(min_radius=1 * mm), [cam.base_radius_for(min_radius=1 * mm) for cam in singles]
    )


# ---------------------------------------------------------------- forces


@every_follower
@both_senses
def test_power_in_is_power_out_without_friction(brute, sigma):
    """The contact force as a vector on the brute-force profile: its moment on the cam, its work on the follower."""
    brute = brute.at(sigma)
    analysis = analysed(brute.cam)
    K = turned(brute.envelope(INSIDE, -1), sigma * INSIDE)
    tangent = brute.envelope(INSIDE + 1e-4, -1) - brute.envelope(INSIDE - 1e-4, -1)
    n = turned([-tangent[1], tangent[0]] / np.hypot(*tangent), sigma * INSIDE)
    n = n * np.sign((n * brute.outward(INSIDE)).sum(0))
    force = analysis.contact_force * n
    assert_allclose((force * brute.push(INSIDE)(K)).sum(0), analysis.resistance, rtol=1e-5)
    on_cam = sigma * cross(K, force)
    assert_allclose(on_cam, analysis.cam_torque, rtol=0, atol=2e-6 * abs(analysis.contact_force).max() * brute.base)
    h = 1e-5
    speed = (brute.s(INSIDE + h) - brute.s(INSIDE - h)) / (2 * h)
    assert_allclose(analysis.cam_torque, analysis.resistance * speed, rtol=1e-7, atol=1e-7)


def without_friction(cam):
    nothing = {f.name: 0.0 for f in fields(cam.friction) if f.name not in ("overhang", "guide_length")}
    return cam.replace(friction=cam.friction.replace(**nothing))


@every_follower
@both_senses
def test_without_friction_the_forces_with_friction_are_those_without(brute, sigma):
    analysis = without_friction(brute.at(sigma).cam).analyse()
    rubbed = analysis.rubbing
    assert_allclose(rubbed.contact_force, analysis.contact_force, rtol=1e-12)
    assert_allclose(rubbed.cam_torque, analysis.cam_torque, rtol=1e-11, atol=1e-12)
    moving = analysis.velocity != 0
    assert_allclose(analysis.efficiency[moving], 1, atol=1e-7)  # hardly moving: rounding over rounding
    assert_array_equal(analysis.efficiency[~moving], 0)


@every_follower
@both_senses
def test_more_friction_leaves_less(brute, sigma):
    cam = brute.at(sigma).cam
    falling = [
        cam.replace(friction=cam.friction.replace(coefficient=f)).analyse().efficiency for f in (0.0, 0.02, 0.1, 0.3)
    ]
    assert (np.diff(falling, axis=0) <= 1e-12).all()
    assert (np.array(falling) <= 1).all()
    assert np.max(falling) > 0.5


def by_hand(analysis):
    """The efficiency of a roller on an arm in a groove, derived by hand from its free-body diagram.

    The force at the roller leans by ``lam`` to where the cam's surface runs.  ``e`` = +1 where the arm's angle grows
    and ``k = e sigma``: arm ``T = F [l cos(alpha + k lam) + sigma r sin(lam) - rho_3]``, cam
    ``M = F [l |v| cos(alpha) cos(lam) + (B - e r) sin(lam) + rho_1]``, ``B`` from the cam axis along the normal.
    """
    cam, friction, v, alpha = analysis.cam, analysis.cam.friction, analysis.velocity, analysis.pressure_angle
    a, l, r, psi = cam.centre_distance, cam.arm_length, cam.roller_radius, analysis.arm_angle
    lam, e = min(np.arctan(friction.coefficient), np.arcsin(friction.roller_pin / r)), np.where(v < 0, -1, 1)
    B = a * np.sin(psi) * np.cos(alpha) + (l - a * np.cos(psi)) * np.sin(alpha)
    arm = l * np.cos(alpha + e * cam.rotation * lam) + cam.rotation * r * np.sin(lam) - friction.arm_pivot
    shaft = l * abs(v) * np.cos(alpha) * np.cos(lam) + (B - e * r) * np.sin(lam) + friction.cam_axis
    return np.where(v == 0, 0, np.maximum(abs(v) * arm, 0) / shaft)


@both_senses
@pytest.mark.parametrize(
    "friction", [Friction(), Friction(coefficient=0.2, roller_pin=0.3 * mm)], ids=["slides", "rolls"]
)
def test_the_shared_statics_agree_with_the_rocking_rollers_own_formula(friction, sigma):
    analysis = replace(FOLLOWERS["rocking roller"].cam, rotation=sigma, friction=friction).analyse()
    assert_allclose(analysis.efficiency, by_hand(analysis), atol=1e-14)


def test_the_mean_efficiency_of_a_plate_cam_on_an_arm():
    """On a plate the returning arm drives the cam by the inner flank; only in a groove by the outer one."""
    load = ArmLoad(mass=0.5, speed=300 * rpm, spring_rate=5, preload=2)
    plate = OscillatingRollerCam(groove=False, load=load)
    for cam, percent in ((plate, 58.05), (plate.replace(groove=True), 62.74)):
        fine = cam.analyse(200_001)
        moving = fine.velocity != 0
        assert mean_efficiency(cam.analyse(31)) == pytest.approx(fine.efficiency[moving].mean(), abs=2e-4)
        assert mean_efficiency(cam.analyse()) * 100 == pytest.approx(percent, abs=0.02)


@pytest.mark.parametrize("kind", [TranslatingRollerCam, OscillatingRollerCam])
@pytest.mark.parametrize("axis", [0.0, 1.5 * mm])
def test_work_out_over_work_in_is_that_of_fine_steps(kind, axis):
    """Against the friction of the cam's bearing a stroke takes work where it begins; one design and a column agree."""
    cam = kind(groove=True)
    cam = cam.replace(friction=cam.friction.replace(cam_axis=axis))
    fine = cam.analyse(200_001)
    moving = abs(fine.velocity) > 1e-9
    taken = np.sum(abs(fine.velocity[moving]) / fine.efficiency[moving])
    starts = np.array([[0.0], [0.01]])
    for angles in (91, 721, 20_001):
        assert work_efficiency(cam.analyse(angles)) == pytest.approx(abs(fine.velocity).sum() / taken, rel=1e-4)
    both = work_efficiency(cam.replace(motion=cam.motion.replace(start=starts)).analyse(91))
    alone = [work_efficiency(cam.replace(motion=cam.motion.replace(start=s)).analyse(91)) for s in starts[:, 0]]
    assert_allclose(both, alone, rtol=1e-12)


def test_the_mean_efficiency_is_over_the_strokes_alone():
    """However narrow they are and however long the follower rests."""
    for rest in (1, 178):
        rise = (Dwell(rest * deg), Rise(2 * deg, 0.3 * mm, Cycloidal()), Dwell((300 - rest) * deg))
        cam = TranslatingRollerCam(MotionProgram(rise))
        fine = replace(cam.analyse(), cam_angle=rest * deg + np.linspace(1e-9, 2 - 1e-9, 100_001) * deg)
        assert mean_efficiency(cam.analyse(31)) == pytest.approx(fine.efficiency.mean(), abs=2e-4)


def beam(brute, analysis, K, along):
    """Contact force and both side forces of a follower in a guide from its three equations of equilibrium.

    The friction of the side forces needs their signs, so all four pairs are tried and the one that bears itself out
    is taken, at each cam angle.
    """
    friction = brute.cam.friction
    held = (brute.centre if isinstance(brute, Roller) else brute.foot)(JOINTS[:1])[1, 0] + friction.overhang
    u, v = analysis.normal * np.cos(analysis.lean) + along * np.sin(analysis.lean), np.sign(analysis.velocity)
    arm = cross(K - [[brute.cam.offset], [0]], u)
    weight = brute.cam.load.mass * brute.cam.load.gravity * np.sin(brute.cam.load.up_angle)
    out = np.full((3, len(v)), np.nan)
    for one, two in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        rub, same = -v * friction.guide, np.ones_like(v)
        rows = [
            [u[0], same, same],
            [u[1], rub * one, rub * two],
            [arm, -held * same, -(held + friction.guide_length) * same],
        ]
        middle = held + friction.guide_length / 2  # of the guide, where the weight's part across acts
        loads = np.stack([0 * v - weight, analysis.resistance, 0 * v + middle * weight], axis=-1)
        found = np.linalg.solve(np.moveaxis(rows, -1, 0), loads[..., None])[..., 0].T
        out = np.where((found[1] * one >= 0) & (found[2] * two >= 0), found, out)
    return out


@both_senses
@pytest.mark.parametrize("up_angle", [0, 30, 90, -90, 180])
@pytest.mark.parametrize("name", ["sliding roller", "offset roller", "sliding face"])
def test_forces_with_friction_are_those_of_a_beam_in_its_guide(name, up_angle, sigma):
    """The follower's weight loads the guide, too, where it is not upright; here 20 kg."""
    brute = FOLLOWERS[name].at(sigma)
    friction = SlideFriction(coefficient=0.12, guide=0.15, overhang=25 * mm)
    load = brute.cam.load.replace(mass=20, speed=50 * rpm, preload=500, up_angle=up_angle * deg)
    brute = replace(brute, cam=brute.cam.replace(friction=friction, load=load))
    analysis = analysed(brute.cam)
    K = turned(analysis.profile, sigma * INSIDE)
    past = sigma * np.array([-K[1], K[0]]) - [[0], [1]] * analysis.velocity
    along = past / np.hypot(*past)
    force, one, two = beam(brute, analysis, K, along)
    assert (force > 0).all()
    assert_allclose(analysis.rubbing.contact_force, force * np.cos(analysis.lean), rtol=1e-9)
    # what goes in and not out is rubbed away: at the cam (or in the roller's pin), in the guide, in the shaft
    slides = np.hypot(*past) * np.sin(analysis.lean)
    guide = friction.guide * (abs(one) + abs(two)) * abs(analysis.velocity)
    lost = force * (slides + friction.cam_axis) + guide
    taken = analysis.resistance * analysis.velocity
    assert_allclose(analysis.rubbing.cam_torque, taken + lost, rtol=1e-9)


@both_senses
@pytest.mark.parametrize("up_angle", [90, -90])
@pytest.mark.parametrize("push", [5, 0, -5])
def test_a_heavy_follower_that_lies_in_its_guide_is_pushed_up_and_pulled_down(push, up_angle, sigma):
    """Its weight across rubs more than the load pushes: rising on the inner flank, returning on the outer one.

    Along the travel ``F cos(alpha) = Q + mu e |W + F n_x|``, ``e`` the sense of the motion: at the cam nothing rubs.
    """
    friction = SlideFriction(coefficient=0, cam_axis=0, roller_pin=0, guide=0.15)
    load = SlideLoad(mass=20, speed=0, force=push, spring_rate=0, preload=0, gravity=9.81, up_angle=up_angle * deg)
    brute = FOLLOWERS["offset roller"].at(sigma)
    analysis = analysed(brute.cam.replace(friction=friction, load=load), STROKES)
    moves, weight = np.sign(analysis.velocity), 20 * 9.81 * np.sin(up_angle * deg)
    rub = 0.15 * moves * np.sign(weight)
    force = (push + rub * weight) / (analysis.normal[1] - rub * analysis.normal[0])
    assert_array_equal(np.sign(force), moves)
    assert_allclose(analysis.rubbing.contact_force, force, rtol=1e-9)
    lost = 0.15 * abs(weight + force * analysis.normal[0]) * abs(analysis.velocity)
    assert_allclose(analysis.rubbing.cam_torque, push * analysis.velocity + lost, rtol=1e-9)


@both_senses
@pytest.mark.parametrize("name", ["sliding roller", "offset roller", "rocking roller"])
def test_what_comes_out_of_a_groove_over_what_goes_in_is_its_efficiency(name, sigma):
    """The inner flank pushes against a load that resists the rise, the outer one pulls against the opposite load."""
    cam = FOLLOWERS[name].at(sigma).cam
    constant = "force" if hasattr(cam.load, "force") else "torque"
    for push, moves in ((40.0, 1), (-40.0, -1)):
        load = cam.load.replace(mass=0.0, spring_rate=0.0, preload=0.0, **{constant: push})
        analysis = analysed(cam.replace(load=load), STROKES)
        there = (np.sign(analysis.velocity) == moves) & (analysis.efficiency > 0)
        assert there.sum() > 50
        power = push * analysis.velocity / analysis.rubbing.cam_torque
        assert_allclose(power[there], analysis.efficiency[there], rtol=1e-9)
        assert (np.sign(analysis.rubbing.contact_force[there]) == moves).all()


@every_follower
@both_senses
def test_a_thousandth_of_the_load_makes_a_thousandth_of_the_forces(brute, sigma):
    cam = brute.at(sigma).cam
    names = ("mass", "spring_rate", "preload", "force" if hasattr(cam.load, "force") else "torque")
    with unremarked():  # a spring of 6 N/m is no slip of the unit here
        light = cam.replace(load=cam.load.replace(**{name: getattr(cam.load, name) / 1000 for name in names}))
    assert_allclose(1000 * np.array(light.analyse().rubbing), cam.analyse().rubbing, rtol=1e-9, atol=1e-9)


@both_senses
def test_forces_with_friction_of_a_rocking_face(sigma):
    """Moments about the pivot and the power balance, with the sliding face's friction along the face."""
    brute = FOLLOWERS["rocking face"].at(sigma)
    friction = Friction(coefficient=0.12, cam_axis=2 * mm, arm_pivot=1.5 * mm)
    analysis = analysed(brute.cam.replace(friction=friction))
    K = turned(brute.envelope(INSIDE, -1), sigma * INSIDE)
    n, moves = brute.outward(INSIDE), brute.push(INSIDE)(K)
    past = sigma * np.array([-K[1], K[0]]) - moves * analysis.velocity
    t = past / np.hypot(*past)
    lam = np.arctan(0.12)
    u = n * np.cos(lam) + t * np.sin(lam)
    force = analysis.resistance / ((u * moves).sum(0) - np.sign(analysis.velocity) * friction.arm_pivot)
    assert_allclose(analysis.rubbing.contact_force, force * np.cos(lam), rtol=1e-7)
    lost = force * (np.hypot(*past) * np.sin(lam) + friction.cam_axis + friction.arm_pivot * abs(analysis.velocity))
    taken = analysis.resistance * analysis.velocity
    assert_allclose(analysis.rubbing.cam_torque, taken + lost, rtol=1e-7)


def test_a_steep_follower_jams_in_its_guide():
    """The handbook's limit: ``tan(alpha) = B / (mu (2 A + B))`` for a smooth roller of no size."""
    friction = SlideFriction(coefficient=0, cam_axis=0, roller_pin=0, guide=0.3, overhang=0, guide_length=30 * mm)
    rise = MotionProgram((Rise(120 * deg, 60 * mm, Poly345()),))
    cam = TranslatingRollerCam(rise, 10 * mm, 0, friction=friction)
    analysis = cam.analyse(7201)
    reach = 60 * mm - analysis.motion.s
    jams = np.tan(analysis.pressure_angle) >= 30 * mm / (0.3 * (2 * reach + 30 * mm))
    assert jams.any()
    assert_array_equal(np.isinf(analysis.rubbing.contact_force), jams)
    assert_array_equal(analysis.efficiency[jams], 0)
    assert (analysis.efficiency[1:-1][~jams[1:-1]] > 0).all()


@every_follower
def test_a_drawn_follower_hangs_together(brute):
    """A slide's guide begins the overhang above its highest place; an arm keeps its length from its pivot."""
    analysis = analysed(brute.cam)
    ((name, (root, end)),) = analysis.cranks.items()
    if name == "follower":
        highest = (brute.centre if isinstance(brute, Roller) else brute.foot)(JOINTS[:1])[1, 0]
        assert_allclose(root, [brute.cam.offset, highest + brute.cam.friction.overhang], rtol=1e-12)
    else:
        length = (
            brute.cam.arm_length
            if isinstance(brute, Roller)
            else np.hypot(analysis.contact_length, brute.cam.face_offset)
        )
        assert_allclose(np.hypot(*(end - root[:, None])), length, rtol=1e-12)


def test_a_steep_arm_works_up_to_a_right_angle():
    """From 65 to 77 deg; above it rests on the circle that its face touches."""
    analysis = OscillatingFlatCam(start_angle=65 * deg).analyse(361)
    high = np.isclose(analysis.motion.s, 12 * deg)
    assert_allclose(np.hypot(*analysis.profile[:, high]), 80 * mm * np.sin(77 * deg) + 5 * mm, rtol=1e-6)


# ---------------------------------------------------------------- a motion that does not begin at the level 0


def high_first(lift):
    """A return from ``lift``, a dwell at 0, a rise back, a dwell."""
    law = Cycloidal()
    moves = (Return(120 * deg, lift, law), Dwell(60 * deg), Rise(120 * deg, lift, law), Dwell(60 * deg))
    return MotionProgram(moves, start=lift)


@both_senses
@pytest.mark.parametrize("name", [*FOLLOWERS])
def test_sizes_and_preload_hold_at_the_level_0_wherever_the_motion_begins(name, sigma):
    """By geometry, in the low dwell: the profile is the base circle, the arm stands at its start angle."""
    brute = FOLLOWERS[name].at(sigma)
    constant = {"force": 0} if isinstance(brute.cam.load, SlideLoad) else {"torque": 0}
    load = brute.cam.load.replace(gravity=0, preload=7, **constant)
    cam = brute.cam.replace(motion=high_first(brute.lift), load=load)
    analysis = cam.analyse(721)
    low = (analysis.cam_angle > 121 * deg) & (analysis.cam_angle < 179 * deg)
    assert_allclose(analysis.static_resistance[low], 7, rtol=1e-12)
    radius = np.hypot(*analysis.profile[:, low])
    if isinstance(cam, TranslatingRollerCam | TranslatingFlatCam):
        assert_allclose(radius, cam.base_radius, rtol=1e-12)
    elif isinstance(cam, OscillatingFlatCam):
        face = cam.centre_distance * np.sin(cam.start_angle) + cam.face_offset
        assert_allclose(radius, face, rtol=1e-12)
        assert_allclose(radius, cam.base_radius, rtol=1e-12)
    else:
        arm = analysis.roller_centre[:, low] - [[cam.centre_distance], [0]]
        assert_allclose(np.arctan2(arm[1], -arm[0]), cam.start_angle, rtol=1e-12)


# ---------------------------------------------------------------- pairs of cams


def forces_balance(first, second):
    forces = [np.maximum(cam.contact_force, 0) for cam in (first, second)]  # each cam pushes only
    assert_allclose(first.lever * forces[0] - second.lever * forces[1], first.resistance, rtol=1e-9, atol=1e-9)
    assert_allclose(second.resistance, -first.resistance, rtol=1e-12, atol=1e-12)
    assert (np.minimum(*forces) == 0).all()


TABLES = {"cam_angle_table": ((0.0, 10.0), (2.0, 50.0), (6.0, -20.0))}


@both_senses
@pytest.mark.parametrize("name", ["sliding roller", "offset roller"])
def test_the_second_roller_of_a_sliding_pair(name, sigma):
    brute = FOLLOWERS[name].at(sigma)
    load = SLIDE.replace(**TABLES, force_table=((0.0, -300.0), (10 * mm, 200.0)), speed=2000 * rpm)
    first = brute.cam.replace(load=load)
    second = first.conjugate(110 * mm, 7 * mm)
    one, two = analysed(first), analysed(second)
    below = -two.roller_centre  # the second cam is given in a frame turned by half a turn
    assert_allclose(one.roller_centre - below, [[0], [110 * mm]] + 0 * below, atol=1e-15)
    path = brute.on_cam(brute.centre(INSIDE) - [[0], [110 * mm]], INSIDE)
    assert_allclose(-two.pitch, path, atol=1e-15)
    mate = SlidingRoller(second, -brute.lift)
    assert_allclose(two.profile, mate.envelope(INSIDE, -1), rtol=0, atol=1e-8 * brute.base)
    forces_balance(one, two)
    assert (one.contact_force < 0).any()


@both_senses
def test_the_second_face_of_a_sliding_pair(sigma):
    brute = FOLLOWERS["sliding face"].at(sigma)
    first = brute.cam.replace(load=SLIDE.replace(speed=2000 * rpm))
    second = first.conjugate(95 * mm)
    one, two = analysed(first), analysed(second)
    assert_allclose(one.height + two.height, 95 * mm)
    assert two.bearing.axis == -one.bearing.axis == -brute.cam.offset  # one follower, seen turned by half a turn
    normal, distance = brute.line(INSIDE)
    assert_allclose((-normal * -two.profile).sum(0), 95 * mm - distance, rtol=1e-12)  # touches the second face
    forces_balance(one, two)


@both_senses
def test_the_second_roller_of_a_rocking_pair(sigma):
    brute = FOLLOWERS["rocking roller"].at(sigma)
    load = ARM.replace(**TABLES, torque_table=((0.0, -30.0), (0.3, 20.0)), speed=600 * rpm)
    first = brute.cam.replace(load=load)
    second = first.conjugate(80 * deg, 60 * mm, 9 * mm)
    one, two = analysed(first), analysed(second)
    psi = brute.psi(INSIDE) - 80 * deg
    centre = brute.pivot(INSIDE) + 60 * mm * np.array([-np.cos(psi), np.sin(psi)])
    assert_allclose(two.roller_centre * [[1], [-1]], centre, atol=1e-15)
    assert_allclose(two.pitch * [[1], [-1]], brute.on_cam(centre, INSIDE), atol=1e-15)
    assert_allclose(np.hypot(*(two.profile - two.pitch)), 9 * mm, rtol=1e-12)
    alike = first.conjugate(80 * deg)
    assert (alike.arm_length, alike.roller_radius) == (first.arm_length, first.roller_radius)
    forces_balance(one, two)


@both_senses
def test_the_second_face_of_a_rocking_pair(sigma):
    brute = FOLLOWERS["rocking face"].at(sigma)
    first = brute.cam.replace(load=ARM.replace(speed=900 * rpm))
    second = first.conjugate(60 * deg, 4 * mm)
    one, two = analysed(first), analysed(second)
    assert_allclose(one.arm_angle + two.arm_angle, 60 * deg)
    psi = 60 * deg - brute.psi(INSIDE)  # the second face in the machine's frame, below the line of centres
    touched = turned(two.profile * [[1], [-1]], sigma * INSIDE)
    assert_allclose((touched * [np.sin(psi), -np.cos(psi)]).sum(0), 90 * mm * np.sin(psi) + 4 * mm, rtol=1e-12)
    assert first.conjugate(60 * deg).face_offset == first.face_offset
    forces_balance(one, two)


def test_the_opposite_of_the_opposite_motion_is_the_motion():
    there = program(20 * mm)
    assert opposite(opposite(there)) == there
    assert_allclose(opposite(there)(INSIDE), -np.array(there(INSIDE)), atol=1e-18)


# ---------------------------------------------------------------- the contract of every follower

ARRAYS = (
    "pressure_angle", "curvature", "profile_curvature", "pitch", "profile", "pitch_radius", "contact_force",
    "cam_torque", "efficiency", "resistance", "static_resistance", "lever", "fit", "normal",
)  # fmt: skip
ALSO_OF_A_GROOVE = ("outer_profile", "outer_profile_curvature")
SHARED = ("motion", "velocity", "acceleration", "jerk", "undercut", "outer_undercut", "turn", "cam_angle")
CAMS = [TranslatingRollerCam(offset=6 * mm), TranslatingFlatCam(), OscillatingFlatCam(), OscillatingRollerCam()]
every_cam = pytest.mark.parametrize("cam", CAMS, ids=lambda cam: type(cam).__name__)
IMPOSSIBLE = {
    "TranslatingRollerCam": {"offset": [6 * mm, -60 * mm, 12 * mm], "base_radius": [30 * mm, 30 * mm, -4 * mm]},
    "TranslatingFlatCam": {"base_radius": [30 * mm, -2 * mm, np.nan], "offset": [0.0, 0.0, 1 * mm]},
    "OscillatingFlatCam": {"start_angle": [20 * deg, 85 * deg, -30 * deg], "face_offset": [5 * mm, 3 * mm, 5 * mm]},
    "OscillatingRollerCam": {"start_angle": [25 * deg, 0.0, 160 * deg], "roller_radius": [5 * mm, 4 * mm, 3 * mm]},
}


@pytest.mark.parametrize("cam", [*CAMS, DoorHandleCam()], ids=lambda cam: type(cam).__name__)
def test_arms_and_stems_of_a_population_are_those_of_its_members(cam):
    """Also where the place of the pivot, or of the guide, is what differs."""
    names = [n for n in ("offset", "centre_distance", "relief_centre_distance") if hasattr(cam, n)]
    rows = {name: getattr(cam, name) + np.array([[0.0], [1 * mm]]) for name in names}
    many = cam.replace(**rows).analyse(13).cranks
    for k in range(2):
        one = cam.replace(**{name: column[k, 0] for name, column in rows.items()}).analyse(13).cranks
        for name, (pivot, end) in one.items():
            for member, of_all in zip((pivot[:, None], end), many[name], strict=True):
                rows_of_all = of_all.reshape(2, -1, member.shape[-1])  # one, where all share it
                assert_allclose(rows_of_all[:, k % rows_of_all.shape[1]], member, rtol=1e-12)


@every_cam
@both_senses
def test_a_population_is_its_members_and_what_cannot_be_built_is_nan(cam, sigma):
    cam = cam.replace(rotation=sigma, motion=cam.motion)
    rows = IMPOSSIBLE[type(cam).__name__]
    many = cam.replace(**{name: np.array(values)[:, None] for name, values in rows.items()}).analyse(91)
    single = cam.replace(**{name: values[0] for name, values in rows.items()}).analyse(91)
    names = ARRAYS if isinstance(single, FlatAnalysis) else ARRAYS + ALSO_OF_A_GROOVE
    for name in names:
        assert_array_equal(getattr(many, name)[..., 0, :], getattr(single, name), name)
        assert np.isnan(getattr(many, name)[..., 1:, :]).all(), name
    for k in range(2):
        assert_array_equal(many.rubbing[k][0], single.rubbing[k])
        assert np.isnan(many.rubbing[k][1:]).all()
    assert_allclose(many.profile_margin.value, [single.profile_margin.value, np.nan, np.nan], rtol=1e-12)
    for i in (1, 2):
        with pytest.raises(ValueError, match="must"):
            cam.replace(**{name: values[i] for name, values in rows.items()}).analyse(91)


@every_cam
def test_every_measure_of_a_population_is_that_of_its_members(cam):
    rows = IMPOSSIBLE[type(cam).__name__]
    many = cam.replace(**{name: np.array(values)[:, None] for name, values in rows.items()}).analyse(91)
    single = cam.replace(**{name: values[0] for name, values in rows.items()}).analyse(91)
    for measure in cam.measures:
        values = np.broadcast_to(measure(many), 3)
        assert_allclose(values[0], measure(single), rtol=1e-12, err_msg=measure.name)
        assert np.isnan(values[1:]).all(), measure.name


@every_cam
def test_every_analysis_offers_the_same(cam):
    analysis = cam.analyse(91)
    for name in (*ARRAYS, *ALSO_OF_A_GROOVE, *SHARED):
        assert np.shape(getattr(analysis, name))[-1] == 91, name
    assert analysis.curves == {"cam": analysis}
    assert set(analysis.stretch) == {"cam"}
    assert_array_equal(analysis.profile_angle, analysis.cam_angle)
    ((pivot, centre),) = analysis.cranks.values()
    assert pivot.shape == (2,)
    assert centre.shape == (2, 91)
    assert cam.roller_radius >= 0


@every_cam
@pytest.mark.parametrize(
    "view", views.default_views(OscillatingRollerCam().analyse(91)), ids=lambda view: view.__name__
)
def test_every_view_draws_every_cam(cam, view):
    assert len(picture(cam, view, turn=40 * deg, width=4, height=3)._repr_png_()) > 1000


@every_cam
def test_a_study_evaluates_designs_as_their_analyses_do(cam):
    name, low, high = {
        "TranslatingRollerCam": ("base_radius", 25 * mm, 60 * mm),
        "TranslatingFlatCam": ("base_radius", 25 * mm, 60 * mm),
        "OscillatingFlatCam": ("face_offset", 0 * mm, 30 * mm),
        "OscillatingRollerCam": ("start_angle", 20 * deg, 50 * deg),
    }[type(cam).__name__]
    study = Study(cam, {name: (low, high)}, cam.measures, at_most={max_pressure_angle: 40 * deg})
    x = np.linspace(low, high, 5)[:, None]
    many, each = study.evaluate(x), [study.evaluate(row[None]) for row in x]
    assert_allclose(many.f, np.concatenate([one.f for one in each]), rtol=1e-9)
    assert_allclose(many.g, np.concatenate([one.g for one in each]), rtol=1e-9)


@every_cam
def test_a_design_survives_a_file_and_its_profile_is_a_table(cam):
    assert from_json(to_json(cam), type(cam)) == cam
    assert len(tables.table(cam.analyse(91)).data.splitlines()) == 92


# ---------------------------------------------------------------- refusals

STEEP = MotionProgram((Rise(20 * deg, 30 * deg, Cycloidal()),))
DROP = MotionProgram((Return(120 * deg, 40 * mm, Cycloidal()), Dwell(60 * deg)))
REFUSALS = [
    (lambda: TranslatingRollerCam(offset=50 * mm),
     "the offset of the follower is 50 mm; base circle and roller make 38 mm, and it must stay below that"),
    (lambda: TranslatingRollerCam(offset=-50 * mm),
     "the offset of the follower is -50 mm; base circle and roller make 38 mm, and it must stay below that"),
    (lambda: TranslatingRollerCam(base_radius=-3 * mm),
     "the base radius (cam axis to profile at the motion's level 0) is -3 mm; "
     "it must be a finite number above 0 mm"),
    (lambda: TranslatingRollerCam(roller_radius=-1 * mm),
     "the roller radius (roller; 0 is a knife edge) is -1 mm; it must be a finite number of at least 0 mm"),
    (lambda: TranslatingRollerCam(rotation=0),
     "the rotation is 0; it must be one of 1 (counter-clockwise), -1 (clockwise)"),
    (lambda: TranslatingFlatCam(rotation=2),
     "the rotation is 2; it must be one of 1 (counter-clockwise), -1 (clockwise)"),
    (lambda: OscillatingFlatCam(rotation=True + 1),
     "the rotation is 2; it must be one of 1 (counter-clockwise), -1 (clockwise)"),
    (lambda: TranslatingRollerCam(DROP).analyse(),
     "the roller's centre comes down to -2 mm above the cam axis; it must stay above 0 mm"),
    (lambda: TranslatingRollerCam(DROP, 30 * mm, 25 * mm).analyse(),
     "the roller of radius 25 mm comes within 15 mm of the cam axis; it must stay outside it"),
    (lambda: TranslatingFlatCam(DROP).analyse(),
     "the face comes down to -10 mm above the cam axis; it must stay above 0 mm"),
    (lambda: OscillatingFlatCam(start_angle=85 * deg).analyse(),
     "the arm swings from 85 to 97 deg from the line of centres; it must stay between -90 and 90 deg"),
    (lambda: OscillatingFlatCam(STEEP, rotation=-1).analyse(),
     "the arm moves with the cam by 3 rad for each rad of cam angle; "
     "it must stay below 1, or the face is touched nowhere"),
    (lambda: OscillatingFlatCam(start_angle=-20 * deg).analyse(),
     "the face comes down to -22.36 mm from the cam axis; it must stay above 0 mm"),
    (lambda: OscillatingFlatCam(arm_length=60 * mm).analyse(),
     "the face is touched up to 90.24 mm from the arm's pivot; the arm is 60 mm long and must reach that far"),
    (lambda: TranslatingRollerCam().base_radius_for(pressure_angle=0),
     "the pressure angle wanted is 0 deg; it must lie between 0 and 90 deg"),
    (lambda: TranslatingRollerCam().base_radius_for(pressure_angle=np.nan),
     "the pressure angle wanted is nan deg; it must lie between 0 and 90 deg"),
    (lambda: TranslatingFlatCam().base_radius_for(min_radius=-1 * mm),
     "the least radius wanted is -1 mm; it must be a finite number of at least 0 mm"),
    (lambda: TranslatingRollerCam().conjugate(20 * mm),
     "the rollers' centres are 20 mm apart; the first stands 38 mm above the cam axis, "
     "and the second must stand below it"),
    (lambda: TranslatingFlatCam().conjugate(20 * mm),
     "the faces are 20 mm apart; the first stands 30 mm above the cam axis, and the second must stand below it"),
]  # fmt: skip


@pytest.mark.parametrize(("build", "sentence"), REFUSALS, ids=[sentence[:50] for _, sentence in REFUSALS])
def test_what_cannot_be_built_is_refused_in_a_sentence(build, sentence):
    with pytest.raises(ValueError, match="must") as refusal:
        build()
    assert str(refusal.value) == sentence


@both_senses
@pytest.mark.parametrize("name", ["rocking face", "rocking face below its pivot"])
def test_the_pressure_angle_of_a_rocking_face_has_the_sign_of_its_offset(name, sigma):
    """Of a face away from the cam (b > 0) the pivot lies behind the face."""
    brute = FOLLOWERS[name].at(sigma)
    analysis = analysed(brute.cam)
    contact = turned(brute.envelope(INSIDE, -1), sigma * INSIDE)
    to_pivot = brute.pivot(INSIDE) - contact
    towards = (brute.outward(INSIDE) * to_pivot).sum(0) / np.hypot(*to_pivot)
    assert_allclose(np.sin(analysis.pressure_angle), -towards, rtol=1e-6)
    assert (np.sign(analysis.pressure_angle) == np.sign(brute.cam.face_offset)).all()
