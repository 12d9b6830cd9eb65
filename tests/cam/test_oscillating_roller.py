"""The oscillating roller cam against brute force: paths differentiated, circles intersected, forces as vectors.

``Brute`` knows where the roller's centre stands and how far the cam has turned, nothing else.  Its derivatives
are complex steps, exact to rounding; it shares no formula with the package.
"""

from dataclasses import astuple, dataclass, replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from camkit import ArmLoad, Friction, OscillatingRollerCam
from camkit.cam.oscillating_roller import OscillatingRollerAnalysis
from camkit.motion import LAWS, Cycloidal, Dwell, ModifiedTrapezoid, MotionProgram, Return, Rise
from camkit.units import N, deg, kg, m, mm, rpm


def cross(p, q):
    return p[0] * q[1] - p[1] * q[0]


def quarter_turn(p):
    return np.array([-p[1], p[0]])


def slope(f, x):
    """The derivative of ``f`` by a complex step."""
    return f(x + 1e-30j).imag / 1e-30


@dataclass(frozen=True)
class Brute:
    """A roller on an arm that makes one cycloidal move; ``sign`` +1: its angle grows, -1: it shrinks."""

    a: float
    l: float
    psi_0: float
    r: float
    swing: float
    span: float
    sigma: int
    sign: int

    @property
    def cam(self):
        move = Rise if self.sign > 0 else Return
        return OscillatingRollerCam(
            motion=MotionProgram((move(self.span, self.swing, Cycloidal()),)),
            centre_distance=self.a,
            arm_length=self.l,
            start_angle=self.psi_0,
            roller_radius=self.r,
            rotation=self.sigma,
        )

    def psi(self, phi):
        u = phi / self.span
        return self.psi_0 + self.sign * self.swing * (u - np.sin(2 * np.pi * u) / (2 * np.pi))

    def centre_at(self, psi):
        """The roller's centre: the arm stands above the line from the cam axis to its pivot at (a, 0)."""
        return np.array([self.a - self.l * np.cos(psi), self.l * np.sin(psi)])

    def centre(self, phi):
        return self.centre_at(self.psi(phi))

    def pitch(self, phi):
        """The roller's centre as the cam sees it, which turns counter-clockwise if sigma = 1."""
        x, y = self.centre(phi)
        turn = -self.sigma * phi
        return np.array([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)])

    def normal(self, phi):
        """Unit normal of the roller's path on the cam, in the machine's frame, to the side of a growing angle."""
        tangent = slope(self.pitch, phi)
        x, y = quarter_turn(tangent / np.hypot(*tangent))
        turn = self.sigma * phi
        n = np.array([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)])
        return n * np.sign((n * slope(self.centre_at, self.psi(phi))).sum(0))


LIFT = Brute(74.24 * mm, 50 * mm, 22 * deg, 5 * mm, 69 * deg, 150 * deg, 1, 1)
HANDBOOK = Brute(120 * mm, 80 * mm, 30 * deg, 8 * mm, 40 * deg, 130 * deg, 1, 1)
CASES = {
    "against, growing": LIFT,
    "with, growing": replace(HANDBOOK, sigma=-1),
    "against, shrinking": replace(HANDBOOK, psi_0=70 * deg, sign=-1),
    "with, shrinking": Brute(100 * mm, 75 * mm, 24.88 * deg, 5 * mm, 10 * deg, 60 * deg, -1, -1),
}
every_sense = pytest.mark.parametrize("brute", CASES.values(), ids=CASES.keys())
UNDERCUT = Brute(100 * mm, 75 * mm, 24.88 * deg, 5 * mm, 10 * deg, 30 * deg, -1, -1)  # the paper's relief curve


def at(brute, n=181):
    """The package's analysis strictly inside the move, so that differences can reach to both sides."""
    phi = np.linspace(0.01, 0.99, n) * brute.span
    return phi, OscillatingRollerAnalysis(brute.cam, phi)


# ---------------------------------------------------------------- geometry


@every_sense
def test_the_pitch_curve_is_the_rollers_path_on_the_cam(brute):
    phi, analysis = at(brute)
    assert_allclose(analysis.pitch, brute.pitch(phi), rtol=0, atol=1e-15 * m)
    assert_allclose(analysis.roller_centre, brute.centre(phi), rtol=0, atol=1e-15 * m)
    assert_allclose(analysis.pitch_radius, np.hypot(*brute.pitch(phi)), rtol=1e-14)
    assert_allclose(analysis.arm_angle, brute.psi(phi), rtol=1e-14)


@every_sense
def test_the_pressure_angle_lies_between_the_normal_and_the_way_the_roller_goes(brute):
    """Signed: positive where the normal leans away from the arm's pivot."""
    phi, analysis = at(brute)
    normal, moves = brute.normal(phi), slope(brute.centre_at, brute.psi(phi)) / brute.l
    arm = (brute.centre(phi) - [[brute.a], [0]]) / brute.l
    assert_allclose(analysis.normal, normal, rtol=0, atol=1e-13)
    expected = np.arctan2((normal * arm).sum(0), (normal * moves).sum(0))
    assert_allclose(analysis.pressure_angle, expected, rtol=0, atol=1e-8)
    assert_allclose(np.cos(analysis.pressure_angle), (normal * moves).sum(0), rtol=0, atol=1e-8)


def test_the_pressure_angle_of_a_published_case():
    """Case V12: arm 80, centre distance 120, 30 deg, at rest; other published tools print 0 here."""
    cam = OscillatingRollerCam(centre_distance=120 * mm, arm_length=80 * mm, start_angle=30 * deg)
    assert np.degrees(cam.analyse().pressure_angle[0]) == pytest.approx(-21.738033800290157, rel=1e-14)


STENCIL = np.array([-1 / 280, 4 / 105, -1 / 5, 4 / 5, 0, -4 / 5, 1 / 5, -4 / 105, 1 / 280])[::-1]
SECOND = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])


def curvature_of_points(cam, name, phi, h=1e-3):
    """Curvature of a curve of the cam, convex > 0, from nine of its points: differences of order 8."""
    around = OscillatingRollerAnalysis(cam, (phi[:, None] + h * np.arange(-4, 5)).ravel())
    points = getattr(around, name).reshape(2, len(phi), 9)
    first, second = points @ -STENCIL / h, points @ SECOND / h**2
    outward = around.on_cam(around.normal).reshape(2, len(phi), 9)[..., 4]
    return -(second * outward).sum(0) / (first**2).sum(0)


@every_sense
@pytest.mark.parametrize("name", ["curvature", "profile_curvature", "outer_profile_curvature"])
def test_curvature_is_that_of_the_points(brute, name):
    phi, analysis = at(brute)
    points = {"curvature": "pitch", "profile_curvature": "profile", "outer_profile_curvature": "outer_profile"}
    assert_allclose(getattr(analysis, name), curvature_of_points(brute.cam, points[name], phi), rtol=1e-6)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("sigma", [1, -1])
def test_curvature_is_that_of_the_points_with_every_law(law, sigma):
    cam = OscillatingRollerCam(motion=MotionProgram((Rise(120 * deg, 30 * deg, law),)), rotation=sigma)
    phi = np.setdiff1d(np.linspace(0.03, 0.97, 95), law.kinks) * 120 * deg
    smooth = np.min([abs(phi - kink * 120 * deg) for kink in (*law.kinks, 9)], axis=0) > 5e-3
    phi = phi[smooth]
    assert_allclose(
        OscillatingRollerAnalysis(cam, phi).curvature, curvature_of_points(cam, "pitch", phi), rtol=1e-6, atol=1e-6 / m
    )


def envelope(brute, phi, side, h=1e-3):
    """Where the roller's circles a little before and after ``phi`` meet, both brought together (Richardson)."""

    def meet(step):
        before, after = brute.pitch(phi - step), brute.pitch(phi + step)
        chord = after - before
        half = np.hypot(*chord) / 2
        across = quarter_turn(chord) / (2 * half)
        turn = -brute.sigma * phi
        n = brute.normal(phi)
        n = np.array([n[0] * np.cos(turn) - n[1] * np.sin(turn), n[0] * np.sin(turn) + n[1] * np.cos(turn)])
        across = across * np.sign((across * n).sum(0)) * side
        return (before + after) / 2 + np.sqrt(brute.r**2 - half**2) * across

    coarse, middle, fine = meet(h), meet(h / 2), meet(h / 4)
    return (64 * fine - 20 * middle + coarse) / 45


@every_sense
def test_both_flanks_are_the_envelope_of_the_moving_roller(brute):
    phi, analysis = at(brute)
    assert_allclose(analysis.profile, envelope(brute, phi, -1), rtol=0, atol=1e-9 * m)
    assert_allclose(analysis.outer_profile, envelope(brute, phi, 1), rtol=0, atol=1e-9 * m)


def nearest(analysis, name, every=10):
    """Distance from every tenth point of a flank to the nearest point of the pitch curve."""
    gap = getattr(analysis, name)[:, ::every, None] - analysis.pitch[:, None, :]
    return np.sqrt((gap**2).sum(0).min(-1))


@every_sense
def test_a_flank_that_is_not_undercut_keeps_the_rollers_radius(brute):
    analysis = brute.cam.analyse(3001)
    assert not (analysis.undercut | analysis.outer_undercut).any()
    assert_allclose(nearest(analysis, "profile"), brute.r, rtol=1e-9)
    assert_allclose(nearest(analysis, "outer_profile"), brute.r, rtol=1e-9)


@pytest.mark.parametrize(("name", "flag"), [("profile", "undercut"), ("outer_profile", "outer_undercut")])
def test_an_undercut_flank_is_cut_away_by_the_roller(name, flag):
    """Where a flank is undercut the roller, elsewhere on its way, comes nearer than its radius."""
    brute = replace(UNDERCUT, r=6 * mm)
    analysis = brute.cam.analyse(3001)
    cut, distance = getattr(analysis, flag)[::10], nearest(analysis, name)
    assert 10 < cut.sum() < 200
    assert (distance[cut] < brute.r * (1 - 1e-9)).all()
    assert_allclose(distance[~cut].max(), brute.r, rtol=1e-9)


# ---------------------------------------------------------------- forces


LOAD = ArmLoad(mass=2 * kg, speed=60 * rpm, torque=7, spring_rate=3, gravity=9.81, up_angle=70 * deg)


@every_sense
def test_the_cam_gives_the_power_that_the_arm_takes(brute):
    """Moments of the contact force, a vector along the normal through the roller's centre, about both axes."""
    phi, omega = at(brute)[0], LOAD.speed
    analysis = OscillatingRollerAnalysis(replace(brute.cam, load=LOAD), phi)
    force = analysis.contact_force * brute.normal(phi)
    centre = brute.centre(phi)
    on_arm = cross(centre - [[brute.a], [0]], force)  # counter-clockwise, against which the arm's angle counts
    on_cam = cross(centre, -force)
    assert_allclose(-on_arm, analysis.resisting_torque, rtol=1e-11)
    assert_allclose(brute.sigma * on_cam, -analysis.cam_torque, rtol=0, atol=1e-11)
    arm_speed = omega * slope(brute.psi, phi)
    assert_allclose(analysis.cam_torque * omega, analysis.resisting_torque * arm_speed, rtol=1e-12)


@every_sense
def test_the_resisting_torque_is_inertia_spring_weight_and_torque(brute):
    """Inertia: rate of change of the kinetic energy; spring and weight: of the potential energy."""
    phi = at(brute)[0]
    analysis = OscillatingRollerAnalysis(replace(brute.cam, load=LOAD), phi)
    up = np.array([np.cos(LOAD.up_angle), np.sin(LOAD.up_angle)])

    def potential(x):
        x_arm, y_arm = brute.centre(x)
        height = (up[0] * (x_arm + brute.a) + up[1] * y_arm) / 2
        return LOAD.mass * LOAD.gravity * height + LOAD.spring_rate * (brute.psi(x) - brute.psi_0) ** 2 / 2

    h = 1e-4
    moment_of_inertia = LOAD.mass * brute.l**2 / 3
    speeding_up = (slope(brute.psi, phi + h) - slope(brute.psi, phi - h)) / (2 * h) * LOAD.speed**2
    power = slope(potential, phi) + (LOAD.torque + moment_of_inertia * speeding_up) * slope(brute.psi, phi)
    assert_allclose(analysis.cam_torque, power, rtol=1e-7)


def test_a_torque_table_is_straight_between_its_entries():
    table = ((0.0, 1.0), (10 * deg, 5.0), (40 * deg, -3.0))
    cam = replace(HANDBOOK.cam, load=ArmLoad(mass=0 * kg, torque_table=table))
    travel = cam.analyse(181).arm_angle - HANDBOOK.psi_0
    rising = 1 + 4 * travel / (10 * deg)
    falling = 5 - 8 * (travel - 10 * deg) / (30 * deg)
    assert_allclose(cam.analyse(181).resisting_torque, np.where(travel < 10 * deg, rising, falling) * N * m, atol=1e-12)


# ---------------------------------------------------------------- efficiency


def statics(brute, phi, f, rho_1, rho_2, rho_3):
    """Power in, power out and power lost per unit of contact force and cam speed, forces as vectors.

    The roller touches the cam at K, on the inner flank where the arm's angle grows, on the outer one where it
    shrinks.  Friction drags the roller along with the cam's surface.  If the force in K would then pass the pin
    outside its friction circle, the roller turns, and the force touches that circle.
    """
    C, n, A = brute.centre(phi), brute.normal(phi), np.array([[brute.a], [0.0]])
    cam_speed, arm_speed = brute.sigma, -slope(brute.psi, phi)  # counter-clockwise, per cam speed
    K = C - brute.sign * brute.r * n
    past = cam_speed * quarter_turn(K) - arm_speed * quarter_turn(K - A)  # of the cam's surface at a roller held fast
    assert_allclose((past * n).sum(0), 0, atol=1e-12)  # the cam neither leaves the roller nor enters it
    along = past / np.hypot(*past)

    def force(lean):
        return brute.sign * n * np.cos(lean) + along * np.sin(lean)

    slides = abs(cross(K - C, force(np.arctan(f)))) <= rho_2
    low, high = np.zeros_like(phi), np.full_like(phi, np.arctan(f))
    for _ in range(60):  # the lean at which the force touches the pin's circle
        middle = (low + high) / 2
        inside = abs(cross(K - C, force(middle))) <= rho_2
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    F = force(np.where(slides, np.arctan(f), low))
    arm = np.sign(arm_speed) * cross(K - A, F) - rho_3  # the pivot's answer -F touches its circle, against the motion
    cam = cam_speed * -cross(K, -F) + rho_1
    in_contact = np.where(slides, (F * past).sum(0), 0)
    spin = np.where(slides, 0, np.hypot(*past)) / max(brute.r, 1e-300)  # of a roller that turns, on its arm
    lost = in_contact + rho_2 * spin + rho_3 * abs(arm_speed) + rho_1
    return cam, arm * abs(arm_speed), lost


FRICTION = {"slides": (0.05, 1.5 * mm, 0.5 * mm, 1 * mm), "rolls": (0.2, 1.5 * mm, 0.3 * mm, 1 * mm)}
rubbing = pytest.mark.parametrize("rub", FRICTION.values(), ids=FRICTION.keys())


@every_sense
@rubbing
def test_free_body_efficiency_is_the_statics_of_forces_as_vectors(brute, rub):
    phi = at(brute)[0]
    power_in, power_out, lost = statics(brute, phi, *rub)
    assert_allclose(power_in - power_out, lost, rtol=1e-9)  # what goes in and not out is rubbed away
    analysis = OscillatingRollerAnalysis(replace(brute.cam, friction=Friction(*rub)), phi)
    assert_allclose(analysis.efficiency, np.maximum(power_out, 0) / power_in, rtol=1e-9, atol=1e-13)
    assert analysis.efficiency.max() > 0.5


@every_sense
@rubbing
def test_published_efficiency_is_the_papers_formula_put_right(brute, rub):
    """Spec 01, equation (21); for a motion with the cam's rotation both angles count from the other side."""
    f, rho_1, rho_2, rho_3 = rub
    phi = at(brute)[0]
    analysis = OscillatingRollerAnalysis(replace(brute.cam, friction=Friction(*rub)), phi)
    a, l, r_T, psi = brute.a, brute.l, brute.r, brute.psi(phi)
    side, lam = brute.sigma * brute.sign, np.arctan(f)
    R = np.sqrt(a**2 + l**2 - 2 * a * l * np.cos(psi))
    alpha = side * analysis.pressure_angle
    beta = side * np.arctan2(l - a * np.cos(psi), a * np.sin(psi))
    assert_allclose(R * np.sin(alpha - beta), l * abs(slope(brute.psi, phi)) * np.cos(alpha), rtol=0, atol=1e-14)
    eta = (
        R * np.sin(alpha - beta) / (l * np.cos(alpha))
        * (l * np.cos(alpha + lam) - r_T * np.sin(lam) - rho_2 - rho_3)
        / (R * np.sin(alpha - beta + lam) - r_T * np.sin(lam) + rho_1)
    )  # fmt: skip
    assert_allclose(analysis.published_efficiency, np.maximum(eta, 0), rtol=1e-9, atol=1e-13)


def efficiencies(brute, *rub):
    analysis = OscillatingRollerAnalysis(replace(brute.cam, friction=Friction(*rub)), at(brute)[0])
    return np.array([analysis.published_efficiency, analysis.efficiency])


@every_sense
def test_without_friction_nothing_is_lost(brute):
    assert_allclose(efficiencies(brute, 0, 0, 0, 0), 1, rtol=0, atol=1e-12)
    assert_allclose(efficiencies(brute, 1e-9, 0, 1e-9 * mm, 0), 1, rtol=0, atol=1e-4)  # and smoothly so


@every_sense
def test_more_friction_leaves_less(brute):
    for rest in ((1.5 * mm, 0.5 * mm, 1 * mm), (0, 4 * mm, 0)):
        falling = [efficiencies(brute, f, *rest) for f in (0, 0.01, 0.05, 0.1, 0.2, 0.3)]
        assert (np.diff(falling, axis=0) <= 1e-15).all()
        assert (falling[0] > falling[-1]).all()
        assert (np.array(falling) <= 1 + 1e-12).all()
    circles = [efficiencies(brute, 0.05, x * mm, 0.5 * mm, x * mm) for x in (0, 1, 2, 4)]
    assert (np.diff(circles, axis=0) < 0).all()


def test_friction_takes_all_where_the_arm_hardly_moves():
    program = MotionProgram((Dwell(30 * deg), Rise(150 * deg, 69 * deg, Cycloidal())))
    analysis = replace(LIFT.cam, motion=program).analyse(1801)
    both = np.array([analysis.published_efficiency, analysis.efficiency])
    assert_array_equal(both[:, analysis.velocity == 0], 0)
    slow = (analysis.velocity > 0) & (analysis.velocity < 1e-3)
    assert slow.any()
    assert (both[:, slow] < 0.02).all()


def test_a_knife_edge_slides_whatever_its_pin():
    """Radius 0 cannot roll, so the friction circle of a pin does not matter to it."""
    edge = replace(LIFT, r=0.0)
    for pin in (0, 0.5 * mm):
        power_in, power_out, _ = statics(edge, at(edge)[0], 0.05, 1.5 * mm, pin, 1 * mm)
        assert_allclose(efficiencies(edge, 0.05, 1.5 * mm, pin, 1 * mm)[1], power_out / power_in, rtol=1e-9)


def test_an_arm_that_jams_has_no_efficiency():
    steep = replace(LIFT.cam, arm_length=70 * mm, start_angle=10 * deg, friction=Friction(arm_pivot=80 * mm))
    assert_array_equal(steep.analyse().efficiency, 0)
    assert_array_equal(steep.analyse().published_efficiency, 0)


# ---------------------------------------------------------------- populations

ROWS = [
    astuple(LIFT)[:4],
    (74.24 * mm, 48.09 * mm, 0.34, 5 * mm),
    (74.24 * mm, 50 * mm, -2 * deg, 5 * mm),  # the arm would pass the line of centres
    (60 * mm, 50 * mm, 9 * deg, 16 * mm),  # the roller would cover the cam axis
    (120 * mm, 80 * mm, 30 * deg, 0.0),
    (120 * mm, 80 * mm, 120 * deg, 3 * mm),  # past 180 deg
    (90 * mm, 70 * mm, 25 * deg, 4 * mm),
]
CURVES = (
    "arm_angle", "pitch_radius", "pressure_angle", "curvature", "profile_curvature", "outer_profile_curvature",
    "roller_centre", "normal", "pitch", "profile", "outer_profile", "resisting_torque", "contact_force", "cam_torque",
    "published_efficiency", "efficiency",
)  # fmt: skip


def of(rows, **other):
    """A cam from sizes: numbers, or columns of a population."""
    names = ("centre_distance", "arm_length", "start_angle", "roller_radius")
    return OscillatingRollerCam(**dict(zip(names, rows, strict=True)), load=LOAD, **other)


@pytest.mark.parametrize("sigma", [1, -1])
def test_a_population_is_its_members_bit_for_bit_and_what_cannot_be_built_is_nan(sigma):
    motion = MotionProgram((Rise(150 * deg, 69 * deg, ModifiedTrapezoid()), Dwell(30 * deg)))
    columns = [np.array(column)[:, None] for column in zip(*ROWS, strict=True)]
    many = of(columns, motion=motion, rotation=sigma).analyse(91)
    for i, row in enumerate(ROWS):
        if i in (2, 3, 5):
            with pytest.raises(ValueError, match="it must"):
                of(row, motion=motion, rotation=sigma).analyse(91)
            assert all(np.isnan(getattr(many, name)[..., i, :]).all() for name in CURVES)
        else:
            single = of(row, motion=motion, rotation=sigma).analyse(91)
            for name in CURVES:
                assert_array_equal(getattr(many, name)[..., i, :], getattr(single, name), name)


@pytest.mark.parametrize("measure", OscillatingRollerCam.measures, ids=lambda measure: measure.name)
def test_a_measure_of_a_population_is_that_of_its_members(measure):
    columns = [np.array(column)[:, None] for column in zip(*ROWS, strict=True)]
    many = measure(of(columns).analyse(91))
    assert many.shape == (len(ROWS),)
    for i, row in enumerate(ROWS):
        expected = np.nan if i in (2, 3) else measure(of(row).analyse(91))
        assert_array_equal(many[i], expected)


@pytest.mark.parametrize("name", ["centre_distance", "arm_length", "roller_radius"])
@pytest.mark.parametrize("bad", [-5 * mm, np.nan, np.inf])
def test_a_member_of_an_impossible_size_is_nan(name, bad):
    """What is refused of one design is nan in a population."""
    with pytest.raises(ValueError, match="it must be a finite number"):
        OscillatingRollerCam(**{name: bad})
    good = getattr(OscillatingRollerCam(), name)
    many = OscillatingRollerCam(**{name: np.array([[good], [bad]])}).analyse(31)
    assert np.isnan(many.pressure_angle[1]).all()
    assert_array_equal(many.pitch[:, 0], OscillatingRollerCam().analyse(31).pitch)


@pytest.mark.parametrize(("name", "bad"), [("mass", -1.0), ("speed", np.nan), ("spring_rate", -3.0)])
def test_a_member_with_an_impossible_load_has_no_force(name, bad):
    load = ArmLoad(**{name: np.array([[1.0], [bad]])})
    force = OscillatingRollerCam(load=load).analyse(31).contact_force
    assert np.isnan(force).all(-1).tolist() == [False, True]


def test_a_member_with_impossible_friction_has_no_efficiency():
    cam = OscillatingRollerCam(friction=Friction(coefficient=np.array([[0.05], [-0.3]])))
    assert np.isnan(cam.analyse(31).efficiency).all(-1).tolist() == [False, True]


# ---------------------------------------------------------------- any design


def none_or(most):
    """0, or a number that is no absurdly small one."""
    return st.just(0.0) | st.floats(1e-6, most)


@st.composite
def designs(draw):
    """Designs that can be built, of every sense, whose roller is smaller than what it runs on."""
    a = draw(st.floats(40, 160)) * mm
    brute = Brute(
        a,
        draw(st.floats(0.3, 1.5)) * a,
        draw(st.floats(15, 120)) * deg,
        draw(none_or(12)) * mm,
        draw(st.floats(2, 60)) * deg,
        draw(st.floats(40, 180)) * deg,
        draw(st.sampled_from([1, -1])),
        draw(st.sampled_from([1, -1])),
    )
    ends = brute.psi(np.array([0, brute.span]))
    assume(ends.min() > 5 * deg and ends.max() < 170 * deg)
    assume(np.hypot(*brute.centre(np.linspace(0, brute.span, 91))).min() > brute.r + 5 * mm)
    return brute


@given(designs())
@settings(max_examples=150, deadline=None)
def test_identities_of_any_design(brute):
    phi, analysis = at(brute, 61)
    psi, alpha, turned = brute.psi(phi), analysis.pressure_angle, -brute.sigma * phi
    D = brute.a * np.sin(psi)
    G = D * np.tan(alpha)
    assert_allclose(G**2 + D**2, (slope(brute.pitch, phi) ** 2).sum(0), rtol=1e-9)
    assert_allclose(analysis.pitch_radius, np.hypot(*analysis.pitch), rtol=1e-12)
    x, y = brute.normal(phi)
    on_cam = np.array([x * np.cos(turned) - y * np.sin(turned), x * np.sin(turned) + y * np.cos(turned)])
    assert_allclose(analysis.profile, brute.pitch(phi) - brute.r * on_cam, rtol=0, atol=1e-12 * m)
    assert_allclose(analysis.outer_profile, brute.pitch(phi) + brute.r * on_cam, rtol=0, atol=1e-12 * m)
    kappa = analysis.curvature
    assert_allclose(analysis.profile_curvature * (1 - brute.r * kappa), kappa, rtol=1e-9)
    assert_allclose(analysis.outer_profile_curvature * (1 + brute.r * kappa), kappa, rtol=1e-9)
    assert_array_equal(analysis.undercut, brute.r * kappa >= 1)
    scale = abs(kappa).max()
    assert_allclose(kappa, curvature_of_points(brute.cam, "pitch", phi), rtol=1e-6, atol=1e-6 * scale)


@given(designs(), none_or(0.3), st.tuples(*[none_or(4)] * 3))
@settings(max_examples=60, deadline=None)
def test_statics_of_any_design(brute, f, circles):
    """As long as the cam's surface runs past a roller held fast in the sense of the cam's rotation."""
    assume(brute.r > 0.1 * mm)
    phi = at(brute, 31)[0]
    past = np.hypot(*slope(brute.pitch, phi)) - brute.sign * brute.r * (1 + brute.sigma * slope(brute.psi, phi))
    assume(past.min() > 0.1 * mm)
    rub = (f, *(x * mm for x in circles))
    power_in, power_out, lost = statics(brute, phi, *rub)
    assert_allclose(power_in - power_out, lost, rtol=1e-8, atol=1e-15)
    eta = OscillatingRollerAnalysis(replace(brute.cam, friction=Friction(*rub)), phi).efficiency
    assert_allclose(eta, np.maximum(power_out, 0) / power_in, rtol=1e-8, atol=1e-12)
    # Of the force's moment on the cam, a difference of moments of the size of a + l, over itself: eight roundings.
    rounding = 8 * np.finfo(float).eps * (brute.a + brute.l) / (brute.l * abs(slope(brute.psi, phi)))
    assert (eta <= 1 + rounding).all()
