"""What keeps a follower on its cam: springs against brute force over fine tables, torque as work, Hertz's formulas."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from camkit import OscillatingRollerCam, Session, Study
from camkit.cam.follower_measures import jump_margin, mean_torque, min_force, peak_pressure
from camkit.cam.force_closure import ContactPair, contact_along, jump_speed, preload_needed, torque_balance
from camkit.cam.loads import ArmLoad
from camkit.cam.measures import base_radius, min_concave_radius, min_convex_radius, undercut_margin
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.slide import SlideFriction, SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.contact import contact_modulus, line_contact
from camkit.files import from_json, to_json
from camkit.machines.cam_lever import CamLever
from camkit.machines.high_speed_load import SliderLoad
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_train import ValveLoad
from camkit.motion import (
    Cycloidal,
    Dwell,
    FreePolynomial,
    HalfHarmonicStart,
    ModifiedTrapezoid,
    MotionProgram,
    Return,
    Rise,
)
from camkit.quantities import measures_of, quantities_of, unremarked, with_quantities
from camkit.study.weighted import weighted
from camkit.units import GPa, MPa, N, deg, kg, m, mm, rpm
from camkit.views.cam import contact_pressure
from camkit.views.defaults import default_views


def program(lift, law=ModifiedTrapezoid()):  # noqa: B008
    return MotionProgram((Rise(100 * deg, lift, law), Dwell(40 * deg), Return(120 * deg, lift, law), Dwell(100 * deg)))


SLIDE = SlideLoad(
    mass=1.5 * kg, speed=500 * rpm, force=20 * N, spring_rate=9e3, preload=80 * N, gravity=9.81, up_angle=30 * deg
)
ARM = ArmLoad(mass=1.5 * kg, speed=500 * rpm, torque=1, spring_rate=20, preload=6, gravity=9.81, up_angle=20 * deg)
CAMS = [
    TranslatingRollerCam(program(20 * mm), offset=6 * mm, load=SLIDE),
    TranslatingFlatCam(program(20 * mm), 40 * mm, load=SLIDE),
    OscillatingFlatCam(program(12 * deg), load=ARM),
    OscillatingRollerCam(program(30 * deg), load=ARM),
]
every_cam = pytest.mark.parametrize("cam", CAMS, ids=lambda cam: type(cam).__name__)


def rise_in(angle):
    law = Cycloidal()
    return MotionProgram((Rise(angle, 20 * mm, law), Dwell(40 * deg), Return(120 * deg, 20 * mm, law), Dwell(90 * deg)))


def at_speed(cam, speed, **load):
    return cam.replace(load=cam.load.replace(speed=speed, **load)).analyse(20001)


# ---------------------------------------------------------------- loads


def test_the_load_of_a_slide_is_inertia_spring_weight_and_force():
    """Inertia: rate of change of the kinetic energy; spring and weight: of the potential energy."""
    motion, phi, h = program(20 * mm, Cycloidal()), np.linspace(0.01, 4.5, 200), 1e-5

    def energy(x):
        s, v = motion(x).s, motion(x).v * SLIDE.speed
        kinetic, spring = SLIDE.mass * v**2 / 2, SLIDE.preload * s + SLIDE.spring_rate * s**2 / 2
        return kinetic + spring + SLIDE.mass * 9.81 * s * np.cos(30 * deg) + SLIDE.force * s

    s, v, a, _ = motion(phi)
    power = (energy(phi + h) - energy(phi - h)) / (2 * h)
    assert_allclose(SLIDE.resisting_force(s, a) * v, power, atol=1e-6 * abs(power).max())


def test_tables_over_travel_and_cam_angle_add_to_a_load():
    tables = {"cam_angle_table": ((1.0, 10.0), (2.0, 30.0))}
    slide = SlideLoad(force_table=((0.0, 5.0), (10 * mm, 25.0)), preload=0, spring_rate=0, **tables)
    at = np.array([0.0, 1.0, 1.5, 2.0, 6.0])
    assert_allclose(slide.static_force(5 * mm, at), 15 + np.array([10, 10, 20, 30, 30]))
    arm = ArmLoad(torque_table=((0.0, 5.0), (0.2, 25.0)), preload=2, **tables)
    assert_allclose(arm.static_torque(0.1 * m, 0.5, 0.1, at), 17 + np.array([10, 10, 20, 30, 30]))


@pytest.mark.parametrize("kind", [SlideLoad, ArmLoad])
def test_a_table_out_of_order_is_refused(kind):
    with pytest.raises(
        ValueError, match=r"^the cam angle table's cam angle must grow from entry to entry; it does not$"
    ):
        kind(cam_angle_table=((1.0, 5.0), (1.0, 6.0)))
    with pytest.raises(ValueError, match=r"^the cam angle table has an entry that is not a finite number; it holds"):
        kind(cam_angle_table=((1.0, np.nan),))
    with pytest.raises(ValueError, match=r"^the force table's travel must grow from entry to entry; it does not$"):
        SlideLoad(force_table=((2.0, 5.0), (1.0, 6.0)))


@pytest.mark.parametrize(
    ("kind", "name"),
    [(ArmLoad, "torque_table"), (ArmLoad, "cam_angle_table"), (SlideLoad, "force_table"),
     (SlideLoad, "cam_angle_table"), (SliderLoad, "force"), (CamLever, "force_curve")],
)  # fmt: skip
def test_a_table_is_a_tuple_of_pairs_of_floats_however_it_is_given(kind, name):
    """An array, as a text file is read to, is no population, and a list cannot be changed within a frozen design."""
    pairs = ((0.0, 1.0), (0.01, 2.0), (0.02, 3.0))
    made = kind(**{name: pairs})
    for given in (np.array(pairs), [list(pair) for pair in pairs], [(0, 1), (0.01, 2), (0.02, 3)]):
        again = kind(**{name: given})
        assert getattr(again, name) == pairs
        assert again == made
        assert hash(again) == hash(made)
    assert getattr(kind(**{name: np.zeros((0, 2))}), name) == getattr(kind(**{name: []}), name) == ()
    for empty in (((),), ((), ()), np.zeros((0, 3))):
        with pytest.raises(ValueError, match=r"^the .* is .*; it must hold pairs of numbers \("):
            kind(**{name: empty})
    for large in ((0.0, 1e308), (1e308, 0.0)):
        with pytest.raises(ValueError, match=r"has the entry 1e\+308; an entry must be at most 1e\+09 in size$"):
            kind(**{name: (large,)})


def test_a_cam_with_an_array_for_its_table_is_one_design():
    cam = OscillatingRollerCam(load=ArmLoad(torque_table=np.array([[0, 1.0], [0.2, 2], [0.4, 3]])))
    assert Study(cam, ["arm_length"], (cam.measures[0],), angles=61).start == cam
    assert from_json(to_json(cam)) == cam


# ---------------------------------------------------------------- jump and preload


@pytest.mark.parametrize("cam", [TranslatingRollerCam(), TranslatingFlatCam(), OscillatingFlatCam()])
def test_a_cam_at_rest_throws_no_follower_off_whatever_the_sign_of_its_0(cam):
    for rest in (0.0, -0.0):
        assert jump_margin(with_quantities(cam, {"load.speed": rest}).analyse()) == np.inf


@every_cam
def test_a_follower_jumps_just_above_its_jump_speed(cam):
    """Contact force over a fine table: positive everywhere below that speed, negative somewhere above it."""
    fastest = jump_speed(cam.analyse())
    assert min_force(at_speed(cam, fastest * 0.999)) > 0
    assert min_force(at_speed(cam, fastest * 1.001)) < 0
    assert jump_margin(cam.analyse()) == pytest.approx(fastest / cam.load.speed - 1)


@every_cam
@pytest.mark.parametrize("speed", [1000 * rpm, 2000 * rpm])
def test_the_least_preload_just_keeps_contact(cam, speed):
    least = preload_needed(cam.analyse(), speed)
    closed = at_speed(cam, speed, preload=least)
    size = closed.contact_force.max()
    assert least > 0
    assert_allclose(min_force(closed), 0, atol=1e-5 * size)
    assert min_force(at_speed(cam, speed, preload=1.01 * least)) > 0
    assert jump_speed(closed) == pytest.approx(speed, rel=1e-5)


@every_cam
def test_a_slow_follower_needs_no_preload_and_a_loose_one_jumps_at_once(cam):
    heavy = {"torque": 50} if isinstance(cam.load, ArmLoad) else {"force": 1e3}
    assert preload_needed(at_speed(cam, 0, **heavy), 1 * rpm) == 0
    pulled = {name: -2 * size for name, size in heavy.items()}
    assert jump_speed(at_speed(cam, 0, **pulled)) == 0


@every_cam
def test_a_thousandth_of_the_load_jumps_at_the_same_speed(cam):
    names = ("mass", "spring_rate", "preload", "torque" if isinstance(cam.load, ArmLoad) else "force")
    with unremarked():  # a spring of 9 N/m is no slip of the unit here
        light = cam.replace(load=cam.load.replace(**{name: getattr(cam.load, name) / 1000 for name in names}))
    assert jump_speed(light.analyse()) == pytest.approx(jump_speed(cam.analyse()), rel=1e-9)
    assert 1000 * preload_needed(light.analyse(), 2000 * rpm) == pytest.approx(
        preload_needed(cam.analyse(), 2000 * rpm), rel=1e-9
    )


def test_a_follower_that_never_slows_down_never_jumps():
    """Only the first half of a rise: the cam speeds the follower up all the time."""
    rise = MotionProgram((Rise(90 * deg, 10 * mm, HalfHarmonicStart()),))
    assert jump_speed(TranslatingRollerCam(rise).analyse()) == np.inf


def test_jump_and_preload_of_a_mass_on_a_spring_over_a_fine_table():
    """``m omega^2 s'' + c s + F_0 = 0`` where it jumps; the load is a slide's without force and weight."""
    cam = CAMS[1].replace(load=SLIDE.replace(force=0, gravity=0))
    s, _, a, _ = cam.motion(np.linspace(0, 2 * np.pi, 400_001))
    spring, slowing = SLIDE.preload + SLIDE.spring_rate * s, a < 0
    jumps = np.sqrt((spring[slowing] / (-SLIDE.mass * a[slowing])).min())
    assert jump_speed(cam.analyse()) == pytest.approx(jumps, rel=1e-8)
    lacking = -SLIDE.mass * (1200 * rpm) ** 2 * a - SLIDE.spring_rate * s
    assert preload_needed(cam.analyse(), 1200 * rpm) == pytest.approx(lacking.max(), rel=1e-8)


@every_cam
def test_jump_and_preload_of_a_population(cam):
    rates = np.array([[0.5], [1.0], [3.0]]) * cam.load.spring_rate
    singles = [cam.replace(load=cam.load.replace(spring_rate=float(rate))).analyse() for rate in rates[:, 0]]
    many = cam.replace(load=cam.load.replace(spring_rate=rates)).analyse()
    assert_allclose(jump_speed(many), [jump_speed(one) for one in singles], rtol=1e-13)
    needed = [preload_needed(one, 900 * rpm) for one in singles]
    assert_allclose(preload_needed(many, 900 * rpm), needed, rtol=1e-13)
    assert_allclose(jump_margin(many), [jump_margin(one) for one in singles], rtol=1e-13)


@pytest.mark.parametrize("angles", ["analyse", "whole"])
def test_a_valve_train_jumps_where_a_scan_of_speeds_says(angles):
    cam = ValveCam(load=ValveLoad(preload=60 * N))
    analysis = cam.analyse() if angles == "analyse" else cam.analyse().whole
    jumps = float(jump_speed(analysis))
    speeds, fine = jumps * np.linspace(0.95, 1.05, 21), cam.analyse(20001)
    lowest = [fine.force_at(s).min() for s in speeds]
    assert jumps == pytest.approx(np.interp(0, lowest[::-1], speeds[::-1]), rel=1e-4)
    fast = 1.2 * jumps
    least = float(preload_needed(analysis, fast))
    assert cam.replace(load=ValveLoad(preload=least)).analyse(20001).force_at(fast).min() == pytest.approx(0, abs=1e-2)
    pressure = contact_along(analysis, cam.contact).pressure
    assert_allclose(pressure[analysis.is_open], analysis.contact_stress[analysis.is_open], rtol=1e-12)


@pytest.mark.parametrize(("speed", "said"), [(-1.5, "-1.5"), (np.nan, "nan"), (np.inf, "inf"), (1e160, "1e.160")])
def test_a_speed_that_cannot_be_is_refused(speed, said):
    sentence = f"the speed of the cam is {said}; it must be a finite number of at least 0 and at most 1e.09"
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        preload_needed(CAMS[0].analyse(), speed)


# ---------------------------------------------------------------- torque


def test_balance_of_a_torque():
    phi = np.linspace(0, 2 * np.pi, 3601)
    balance = torque_balance(phi, 3 + 5 * np.cos(2 * phi))
    assert balance.mean == pytest.approx(3, rel=1e-12)
    assert_allclose(balance.surplus, 2.5 * np.sin(2 * phi), atol=1e-5)
    assert balance.swing == pytest.approx(5, rel=1e-5)


@pytest.mark.parametrize("given", [(-1, -1), ([1], [2]), (np.ones((2, 5)), np.ones((3, 5)))])
def test_a_torque_without_a_way_is_refused_in_a_sentence(given):
    with pytest.raises(ValueError, match=r"(; they must be arrays of two or more|fit the others, or be one number)$"):
        torque_balance(*given)


@every_cam
def test_mass_spring_and_weight_give_back_what_they_take(cam):
    analysis = cam.analyse(7201)
    balance = torque_balance(analysis.cam_angle, analysis.cam_torque)
    assert abs(balance.mean) < 1e-6 * abs(analysis.cam_torque).max()
    assert abs(balance.surplus[-1]) < 1e-12


@every_cam
def test_the_mean_torque_is_the_work_of_the_machine(cam):
    """A force that resists the rise only: its work over the lift, divided by a turn."""
    work = {"cam_angle_table": ((0.0, 80.0), (100 * deg, 80.0), (120 * deg, 0.0))}
    analysis = cam.replace(load=cam.load.replace(**work)).analyse(7201)
    lift = analysis.motion.s.max()
    mean = torque_balance(analysis.cam_angle, analysis.cam_torque).mean
    assert mean == pytest.approx(80 * lift / (2 * np.pi), rel=1e-5)
    assert mean_torque(analysis) > mean


def test_friction_alone_takes_the_mean_torque_of_an_idle_cam():
    """A resting follower under a constant force: the cam's own pin and the face that it slides under."""
    friction = SlideFriction(coefficient=0.1, cam_axis=2 * mm, guide=0.2)
    load = SlideLoad(mass=0, force=100 * N, preload=0, spring_rate=0)
    cam = TranslatingFlatCam(MotionProgram((Dwell(360 * deg),)), 30 * mm, load=load, friction=friction)
    slides = np.arctan(0.1)
    expected = 100 / np.cos(slides) * (30 * mm * np.sin(slides) + 2 * mm)
    assert mean_torque(cam.analyse()) == pytest.approx(expected, rel=1e-12)


def test_the_mean_torque_of_a_follower_that_jams_is_infinite():
    """Without a warning, which the tests take for an error; beside one that runs freely the free one has its own."""
    jammed, free = (TranslatingRollerCam(rise_in(a)) for a in (10 * deg, 100 * deg))
    assert np.isinf(mean_torque(jammed.analyse()))
    both = free.replace(motion=rise_in(np.array([[10.0], [100.0]]) * deg))
    assert_array_equal(mean_torque(both.analyse(91)), [np.inf, mean_torque(free.analyse(91))])


# ---------------------------------------------------------------- Hertz


PAIR = ContactPair(12 * mm, 210 * GPa, 70 * GPa, 0.3, 0.33)


@every_cam
def test_pressure_along_the_cam(cam):
    """Hertz's formula with the radii of both bodies at the contact, of points of the profile."""
    pressed = cam.load.replace(preload=40.0 if isinstance(cam.load, ArmLoad) else 400.0)
    analysis = cam.replace(load=pressed, contact=PAIR).analyse()
    E = 1 / ((1 - 0.3**2) / (210 * GPa) + (1 - 0.33**2) / (70 * GPa))
    assert PAIR.modulus == pytest.approx(E)
    roller = 1 / cam.roller_radius if cam.roller_radius else 0.0
    together = analysis.profile_curvature + roller
    p = np.sqrt(analysis.contact_force / (12 * mm) * E * together / np.pi)
    found = contact_along(analysis, PAIR)
    assert_allclose(found.pressure, p, rtol=1e-12)
    half = np.sqrt(4 * analysis.contact_force / (12 * mm) / (np.pi * E * together))
    assert_allclose(found.half_width, half, rtol=1e-12)
    assert_allclose(found.shear / found.pressure, 0.3003, rtol=1e-4)
    assert_allclose(found.shear_depth / found.half_width, 0.7862, rtol=1e-4)
    assert_array_equal(analysis.contact_pressure, found.pressure)
    assert peak_pressure(analysis) == pytest.approx(found.pressure.max(), rel=1e-4)
    assert peak_pressure(analysis) >= found.pressure.max() * (1 - 1e-12)


def test_a_published_contact():
    """Case V11 (slippy 0.5.2, solve_hertz_line): steel on steel, radii 5 and 20 mm, 4 N/mm."""
    rest = MotionProgram((Dwell(360 * deg),))
    load = SlideLoad(mass=0, force=0, spring_rate=0, preload=60 * N)
    cam = TranslatingRollerCam(rest, 20 * mm, 5 * mm, load=load)
    found = contact_along(cam.analyse(), ContactPair(15 * mm))
    assert_allclose(found.pressure / MPa, 191.645673, rtol=1e-8)
    assert_allclose(found.half_width / mm, 0.013287433, rtol=1e-7)


def test_the_flank_that_gives_the_force_bears_it():
    """Without a spring a fast groove cam pushes by its outer flank, hollow to the roller, and the pressure is lower."""
    cam = CAMS[0].replace(load=SlideLoad(speed=900 * rpm, preload=0, spring_rate=0))
    analysis = cam.analyse()
    pulls = analysis.contact_force < 0
    assert 50 < pulls.sum() < 400
    p = contact_along(analysis, PAIR).pressure
    hollow = 1 / cam.roller_radius - analysis.outer_profile_curvature
    outer = line_contact(-analysis.contact_force / PAIR.width, hollow, contact_modulus(210e9, 70e9, 0.3, 0.33)).pressure
    assert_allclose(p[pulls], outer[pulls], rtol=1e-12)


def test_no_pressure_where_a_face_lifts_off_or_a_roller_undercuts():
    loose = CAMS[1].replace(load=SlideLoad(speed=900 * rpm, preload=0, spring_rate=0)).analyse()
    assert_array_equal(np.isnan(contact_along(loose, PAIR).pressure), loose.contact_force < 0)
    steep = MotionProgram((Rise(50 * deg, 20 * mm, Cycloidal()), Dwell(60 * deg)))
    tight = TranslatingRollerCam(steep, 20 * mm, 25 * mm, load=SLIDE.replace(preload=1e4)).analyse()
    assert tight.undercut.any()
    assert np.isnan(contact_along(tight, PAIR).pressure[tight.undercut]).all()


def test_pressures_of_a_population():
    bases = np.array([[30.0], [-4.0], [60.0]]) * mm
    cam = CAMS[0].replace(contact=PAIR)
    found = peak_pressure(cam.replace(base_radius=bases).analyse(91))
    assert np.isnan(found[1])
    for i in (0, 2):
        single = cam.replace(base_radius=float(bases[i, 0])).analyse(91)
        assert found[i] == pytest.approx(peak_pressure(single), rel=1e-12)


def resting(cam, force):
    """A cam on which the follower rests under a force."""
    return cam.replace(motion=MotionProgram((Dwell(360 * deg),)), load=SlideLoad(0, preload=force, spring_rate=0))


def test_a_face_on_a_circle_worked_by_hand():
    """300 N on 15 mm, steel on steel: w = 20 N/mm, E* = 210/1.82 GPa, R = 30 mm: p_0^2 = w E* / (pi R)."""
    cam = resting(TranslatingFlatCam(base_radius=30 * mm, contact=ContactPair()), 300 * N)
    assert peak_pressure(cam.analyse()) / MPa == pytest.approx(156.478, rel=1e-5)
    flatter = cam.replace(base_radius=3e3 * mm)  # towards two flat faces
    assert peak_pressure(flatter.analyse()) / MPa == pytest.approx(156.478 / 10, rel=1e-5)
    for change, times in (({"contact.width": 60 * mm}, 0.5), ({"load.preload": 1200 * N}, 2.0)):
        assert peak_pressure(with_quantities(cam, change).analyse()) / MPa == pytest.approx(times * 156.478, rel=1e-5)


@pytest.mark.parametrize("body", ["cam", "follower"])
def test_a_poissons_ratio_is_at_most_a_half(body):
    assert getattr(ContactPair(**{f"{body}_poisson": 0.5}), f"{body}_poisson") == 0.5
    with pytest.raises(
        ValueError, match=r"^the .* is 0\.6; it must be a finite number of at least 0 and at most 0\.5$"
    ):
        ContactPair(**{f"{body}_poisson": 0.6})


def test_a_knife_edge_bears_no_force():
    cam = resting(TranslatingRollerCam(roller_radius=0.0, contact=ContactPair()), 300 * N)
    assert peak_pressure(cam.analyse()) == np.inf
    assert np.isfinite(peak_pressure(cam.replace(roller_radius=1e-6).analyse()))


def test_materials_of_the_menu():
    """20Cr: nu = 206 / (2 79.4) - 1 = 0.29723; EN AW-6082 T6: 70 / (2 27) - 1 = 0.29630."""
    pair = ContactPair(cam_material="20Cr", follower_material="EN AW-6082 T6")
    by_hand = 1 / ((1 - 0.297229**2) / 206 + (1 - 0.296296**2) / 70)
    assert pair.modulus / GPa == pytest.approx(by_hand, rel=1e-5)
    assert [path for path in quantities_of(pair)] == ["width"]
    half = ContactPair(cam_material="20Cr", follower_modulus=100 * GPa, follower_poisson=0.25)
    assert half.modulus / GPa == pytest.approx(1 / ((1 - 0.297229**2) / 206 + (1 - 0.25**2) / 100), rel=1e-5)
    with pytest.raises(ValueError, match=r"^'cam_modulus' is no path of ContactPair: it is that of the cam_material$"):
        with_quantities(half, {"cam_modulus": 1.0})
    with pytest.raises(ValueError, match=r"^the cam material is 'cheese'; it must be one of own numbers, 20Cr,"):
        ContactPair(cam_material="cheese")


@every_cam
def test_a_contact_adds_its_measure_and_its_curve(cam):
    given = with_quantities(cam, {"contact": "along a line"})
    assert set(measures_of(given)) - set(measures_of(cam)) == {peak_pressure}
    assert given.analyse(31).offers == (*cam.analyse(31).offers, "contact_pressure")
    assert default_views(given.analyse(31))[-1] is contact_pressure
    shown = contact_pressure(given.analyse(91))
    assert_allclose(shown["cam"].y * MPa, contact_along(given.analyse(91), ContactPair()).pressure)
    assert np.isnan(peak_pressure(cam.analyse(31)))
    study = Study(given, ["contact.width"], [peak_pressure])
    assert from_json(to_json(Session(study, given))).study.minimise == (peak_pressure,)
    none = r"^the peak contact pressure does not apply to the start of the study: the contact is not given; it must be "
    total = weighted("both", {peak_pressure: 1.0, base_radius: 1.0}, (1.0, 1.0))
    for refused in (
        lambda: Study(given, ["load.speed"], (peak_pressure,)).around(cam),
        lambda: Study(cam, ["load.speed"], (total,)),
        lambda: Study(cam, ["load.speed"], (base_radius,), at_least={-peak_pressure: -1e9}),
    ):
        with pytest.raises(ValueError, match=none + "along a line$"):
            refused()


# ---------------------------------------------------------------- a groove, and jumps of the speed


def test_a_groove_without_a_spring_cannot_be_left():
    """It is form closed: no speed makes the follower jump; a plate without a spring does not hold it at all."""
    free = SlideLoad(spring_rate=0, preload=0)
    groove = TranslatingRollerCam(load=free)
    assert np.isinf(jump_speed(groove.analyse()))
    assert np.isinf(jump_margin(groove.analyse()))
    assert jump_speed(groove.replace(groove=False).analyse()) == 0
    arm = OscillatingRollerCam(load=ArmLoad(torque=5))
    assert np.isinf(jump_margin(arm.analyse()))
    some = TranslatingRollerCam(load=SlideLoad(spring_rate=0, preload=np.array([[0.0], [100.0]])))
    speeds = jump_speed(some.analyse())
    assert np.isinf(speeds[0])
    assert speeds[1] == pytest.approx(jump_speed(TranslatingRollerCam(load=free.replace(preload=100.0)).analyse()))


def leaves_moving(end, lift):
    """A rise that ends (or a later one that begins) with a speed of its own, between dwells."""
    moving = FreePolynomial(start=(0, 0, 0), end=(1, end)) if end else Cycloidal()
    begins = Cycloidal() if end else FreePolynomial(start=(0, 1.5), end=(1, 0, 0))
    rest = (Dwell(60 * deg), Return(120 * deg, lift, begins), Dwell(60 * deg))
    return MotionProgram((Rise(120 * deg, lift, moving), *rest))


def cut_by(points, centres, radius):
    """By how much a roller in any of its positions cuts into some of the points."""
    gap = np.hypot(*(points[:, ::20, None] - centres[:, None, :])).min(-1)
    return radius - gap.min()


@pytest.mark.parametrize("sigma", [1, -1])
@pytest.mark.parametrize("kind", ["slides", "rocks"])
def test_a_jump_of_the_speed_cuts_the_corner_off_a_flank(kind, sigma):
    """Where it drops that of the inner flank, where it rises a groove's outer one: by geometry."""
    lift = 20 * mm if kind == "slides" else 20 * deg
    of = TranslatingRollerCam if kind == "slides" else OscillatingRollerCam
    drop = of(motion=leaves_moving(1.5, lift), rotation=sigma)
    rise = drop.replace(motion=opposite(drop.motion, lift))
    for cam, cut, kept in ((drop, "inner", "outer"), (rise, "outer", "inner")):
        fine, r = cam.analyse(20001), cam.roller_radius
        flank = {"inner": fine.profile, "outer": fine.outer_profile}
        margin = {"inner": fine.profile_margin, "outer": fine.outer_profile_margin}
        assert margin[cut].value == pytest.approx(-r)
        assert margin[cut].cam_angle == pytest.approx(120 * deg, abs=1e-6)
        assert cut_by(flank[cut], fine.pitch, r) > 0.02 * r
        assert margin[kept].value > 0
        assert cut_by(flank[kept], fine.pitch, r) < 1e-4 * r
        assert undercut_margin(fine) == -np.inf
        assert (min_convex_radius(fine) == 0) == (cut == "inner")
        assert (min_concave_radius(fine) == 0) == (cut == "outer")
    plate = rise.replace(groove=False)
    assert undercut_margin(plate.analyse()) > 0
    edge = drop.replace(roller_radius=0)
    assert undercut_margin(edge.analyse()) == 1
    assert edge.analyse().profile_margin.value == 0


def opposite(program, lift):
    """The same motion from ``lift`` downwards, so that what dropped rises."""
    moves = [s if isinstance(s, Dwell) else (Return if isinstance(s, Rise) else Rise)(s.angle, s.lift, s.law)
             for s in program.segments]  # fmt: skip
    return MotionProgram(tuple(moves), start=lift)


@pytest.mark.parametrize("sigma", [1, -1])
@pytest.mark.parametrize("cam", [TranslatingFlatCam(), OscillatingFlatCam()], ids=["slides", "rocks"])
def test_a_drop_of_the_speed_cuts_the_corner_off_a_flat_face_cam(cam, sigma):
    lift = 20 * mm if isinstance(cam, TranslatingFlatCam) else 12 * deg
    cam = cam.replace(motion=leaves_moving(1.5, lift), rotation=sigma)
    fine = cam.analyse(7201)
    assert fine.profile_margin.value == -np.inf
    assert fine.profile_margin.cam_angle == pytest.approx(120 * deg, abs=1e-6)
    normal = fine.on_cam(fine.normal)
    distance = (normal * fine.profile).sum(0)
    room = (distance[:, None] - normal.T @ fine.profile[:, ::10]).min()
    assert room < -0.1 * mm  # another position of the face cuts the profile
    risen = cam.replace(motion=opposite(cam.motion, lift)).analyse(7201)
    assert risen.profile_margin.value > 0


def test_the_last_joint_counts_only_where_the_cam_closes():
    jolt = FreePolynomial(start=(0, 0, 0), end=(1, 1.5))
    closed = MotionProgram((Return(180 * deg, 10 * mm, Cycloidal()), Rise(180 * deg, 10 * mm, jolt)), start=10 * mm)
    assert TranslatingRollerCam(closed).analyse().profile_margin.value == pytest.approx(-8 * mm)
    assert TranslatingRollerCam(closed).analyse().profile_margin.cam_angle == pytest.approx(0, abs=1e-6)
    opened = MotionProgram((Return(180 * deg, 10 * mm, Cycloidal()), Rise(170 * deg, 10 * mm, jolt)), start=10 * mm)
    assert TranslatingRollerCam(opened).analyse().profile_margin.value > 0
