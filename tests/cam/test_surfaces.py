"""Film, wear and life of cams: each formula against brute-force geometry, physics of its own, a limit or a table."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from camkit import (
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Study,
    TranslatingFlatCam,
    TranslatingRollerCam,
    ValveCam,
    deg,
    minimise,
    mm,
    rpm,
)
from camkit.cam import (
    BarrelCam,
    ConjugatePair,
    ContactPair,
    Lubricant,
    LubricatedPair,
    OscillatingBarrelCam,
    RollerBearing,
    SlideLoad,
    SurfaceStrength,
    bearing_life,
    cam_life,
    entrainment,
    film_thickness,
    load_stress_factor,
    max_pressure_angle,
    min_entrainment,
    min_film_ratio,
    min_life,
    peak_pressure,
    pressure_share,
    reversals,
    roller_life,
    thin_film,
)
from camkit.data.lubricants import LUBRICANTS
from camkit.data.surface_strengths import steel_of
from camkit.machines import CamLever, DoorHandleCam
from camkit.machines.valve_measures import keeping_min_radius
from camkit.motion import Cycloidal, Dwell, ModifiedSine, MotionProgram, Poly345, Return, Rise
from camkit.quantities import measures_of, quantities_of, with_quantities
from camkit.study import Tolerances
from camkit.units import kN, psi, um
from camkit.views.defaults import default_views

OIL = Lubricant(0.01, 2e-8)
PAIR = LubricatedPair(width=12 * mm, lubricant=OIL, bearing=RollerBearing())
STEP = 1e-4


def motion(law, lift, *angles):
    rise, far, back, near = (angle * deg for angle in angles)
    return MotionProgram((Rise(rise, lift, law), Dwell(far), Return(back, lift, law), Dwell(near)))


CAMS = {
    "roller": TranslatingRollerCam(motion(Poly345(), 17 * mm, 110, 40, 130, 80), offset=6 * mm, groove=False),
    "groove": TranslatingRollerCam(motion(Cycloidal(), 20 * mm, 100, 60, 140, 60), offset=-5 * mm),
    "roller on an arm": OscillatingRollerCam(motion(ModifiedSine(), 24 * deg, 120, 50, 100, 90)),
    "face": TranslatingFlatCam(motion(Poly345(), 12 * mm, 110, 40, 130, 80), base_radius=32 * mm, offset=4 * mm),
    "face on an arm": OscillatingFlatCam(),
    "drum": BarrelCam(),
    "drum with an arm": OscillatingBarrelCam(),
}
BOTH = {f"{name}, {sigma}": cam.replace(rotation=sigma) for name, cam in CAMS.items() for sigma in (1, -1)}
MACHINES = {
    "door handle, lift": DoorHandleCam().analyse().lift,
    "door handle, relief": DoorHandleCam().analyse().relief,
    "high speed": HighSpeedCam(rated_speed=300 * rpm).analyse(),
    "lever": CamLever(contact=LubricatedPair()).analyse(),
    "valve": ValveCam().analyse(),
    "valve with a roller": ValveCam().analyse().roller,
}
ANALYSES = {name: cam.analyse(2) for name, cam in BOTH.items()} | MACHINES


# ---------------------------------------------------------------- kinematics against geometry


def per_rad(analysis, angle, point):
    """The derivative of a point by the cam angle, of the fourth order."""
    one, two = (point(analysis.at(angle + k * STEP)) - point(analysis.at(angle - k * STEP)) for k in (1, 2))
    return (8 * one - two) / (12 * STEP)


def follower_velocity(analysis, angle, K):
    """Of the follower's point at ``K``, by differences of its travel or of its arm's angle."""
    travels = hasattr(analysis, "travel")
    moved = per_rad(analysis, angle, lambda at: at.motion.s)
    if travels:
        return np.stack([0 * moved, moved])
    return moved * np.stack([K[1], -(K[0] - analysis.cam.centre_distance)])


@pytest.mark.parametrize("name", ANALYSES)
def test_surfaces_run_as_differences_of_the_contact_point_say(name):
    """The profile that a cam has at an angle, the follower's place and the point of contact: nothing else."""
    whole = ANALYSES[name]
    low, high = whole.program.starts[:2]
    angle = low + (high - low) * np.array([0.13, 0.29, 0.47, 0.62, 0.81, 0.93])
    shown, flank = whole.at(angle), whole.at(angle).loaded_flank
    K = shown.contact_point(flank)
    along_profile = per_rad(whole, angle, lambda at: at.on_cam(at.contact_point(flank)))
    sigma, (nx, ny) = whole.cam.rotation, shown.normal
    t = sigma * np.stack([-ny, nx])  # the way the cam's surface runs
    unrolled = hasattr(whole, "period")
    found = entrainment(shown, 50.0)
    assert_allclose(abs(found.cam), 50 * np.hypot(*along_profile), rtol=1e-8)
    ran = np.stack([x + 0 * angle for x in shown.surface_velocity(K)])
    passed = per_rad(whole, angle, lambda at: at.contact_point(flank))
    assert_allclose(found.cam, 50 * ((ran - passed) * t).sum(0), rtol=1e-8, atol=1e-8)
    if hasattr(whole, "face_normal"):
        moved = follower_velocity(whole, angle, K)
        assert_allclose(found.follower, 50 * ((moved - passed) * t).sum(0), rtol=1e-7, atol=1e-8)
        assert_allclose(((ran - moved) * shown.normal).sum(0), 0, atol=1e-10)  # they stay in touch
    else:
        assert_allclose(found.sliding, 0)
        assert unrolled or (found.cam > 0).all()


@settings(max_examples=12, deadline=None)
@given(st.floats(0.02, 0.06), st.floats(0.004, 0.02), st.floats(60, 150), st.sampled_from([1, -1]))
def test_a_sliding_face_is_drawn_in_as_its_closed_form_says(r0, lift, rise, sigma):
    cam = TranslatingFlatCam(motion(Cycloidal(), lift, rise, 30, 150, 180 - rise), base_radius=r0, rotation=sigma)
    analysis, omega = cam.analyse(721), cam.load.speed
    s, w = analysis.motion.s, analysis.acceleration
    assert_allclose(analysis.surfaces.entrainment_velocity, omega * (r0 + s + 2 * w) / 2, rtol=1e-12, atol=1e-12)
    assert_allclose(analysis.surfaces.entrainment.sliding, omega * (r0 + s), rtol=1e-12)
    places = reversals(analysis)
    assert min_entrainment(analysis) < 0 if len(places) else min_entrainment(analysis) > 0
    again = analysis.at(places)
    assert_allclose(r0 + again.motion.s + 2 * again.acceleration, 0, atol=1e-12)


@pytest.mark.parametrize("name", ["roller, 1", "groove, -1", "roller on an arm, 1"])
def test_a_roller_turns_as_often_as_the_length_of_the_profile_says(name):
    cam = BOTH[name].replace(load=BOTH[name].load.replace(preload=200.0))  # the inner flank alone
    x, y = cam.analyse(200_001).profile
    length = np.hypot(np.diff(x), np.diff(y)).sum()
    analysis = cam.analyse(91)
    assert (analysis.resolved.contact_force > 0).all()
    assert analysis.surfaces.roller_turns == pytest.approx(length / (2 * np.pi * cam.roller_radius), rel=1e-8)


def test_the_angles_at_which_nothing_is_drawn_in_are_named_and_shown():
    cam = keeping_min_radius(ValveCam(n=5.8, m=20).replace(contact=LubricatedPair(width=14 * mm))).with_spring()
    places = 62 - reversals(cam.analyse()) / deg
    assert len(places) == 1
    assert 43 < places[0] < 44  # from the nose: the valve cam that a notebook recommends
    assert min_film_ratio(cam.analyse()) == 0
    views = {view.__name__: view(cam.analyse()) for view in default_views(cam.analyse())}
    marked = views["entrainment"]["cam none"].x
    assert_allclose(np.sort(marked[np.isfinite(marked)]) - 62, [-places[0], places[0]], atol=1e-3)
    shown = views["film_ratio"]
    assert np.nanmin(shown["cam"].y) < 0.2 < np.nanmax(shown["cam"].y)
    roller = cam.replace(follower=cam.follower.__class__("roller", type(cam.analyse().roller)))
    assert not len(reversals(roller.analyse()))
    with pytest.raises(ValueError, match="where the entrainment changes sign is a population"):
        reversals(cam.replace(base_radius=np.array([[0.03], [0.031]])).analyse(91))


# ---------------------------------------------------------------- the film


def inlet_film(eta, alpha, U, w, R, E):
    """The film that the inlet of a line contact pumps, by Ertel and Grubin: an integral of Reynolds' equation.

    Outside the dry contact of half width ``a`` the gap is ``h_0`` and Hertz's ``a^2 / 2R (x sqrt(x^2 - 1) - ln(...))``;
    where the contact begins, the pressure that would be there in a liquid of even viscosity is ``1 / alpha``.
    """
    a = np.sqrt(8 * w * R / (np.pi * E))
    x = np.cosh(np.linspace(0, 8, 20001))
    gap = a**2 / (2 * R) * (x * np.sqrt(x**2 - 1) - np.log(x + np.sqrt(x**2 - 1)))
    low, high = 1e-9, 1e-3
    for _ in range(80):
        h0 = np.sqrt(low * high)
        pumped = 12 * eta * U * a * np.trapezoid(gap / (gap + h0) ** 3, x)
        low, high = (h0, high) if pumped > 1 / alpha else (low, h0)
    return low


@pytest.mark.parametrize("U", [0.3, 1.0, 3.0])
@pytest.mark.parametrize("w", [1e5, 4e5])
def test_film_of_an_inlet(U, w):
    """The independent check of the film's constants: physics, not a regression.

    Ertel and Grubin's film is that in the middle of the contact; the least one, where it ends, is somewhat thinner.
    Pan and Hamrock's later regression of the least film (J. Tribol. 111, 1989, from memory) is of other numbers.
    """
    R, E = 0.02, 230.77e9
    least = film_thickness(OIL, U, w, 1 / R, E / 2)
    assert 0.75 < least / inlet_film(0.01, 2e-8, U, w, R, E) < 0.95
    speed, material, load = 0.01 * U / (E * R), 2e-8 * E, w / (E * R)
    assert least == pytest.approx(1.714 * R * speed**0.694 * material**0.568 * load**-0.128, rel=0.12)
    assert least == pytest.approx(2.65 * R * speed**0.7 * material**0.54 * load**-0.13, rel=1e-12)


def test_the_film_where_nothing_moves_or_presses_or_fits():
    film = film_thickness(
        OIL, [1, 0, -1, 1, 1, 1, 0], [1e4, 1e4, 1e4, 0, -1, 1e4, -1], [50, 50, 50, 50, 50, -1, 50], 1e11
    )
    assert film[0] == film[2] > 0
    assert_allclose(film[[1, 3]], [0, np.inf])
    assert np.isnan(film[4:]).all()
    for wrong, said in (({"velocity": "fast"}, "velocities"), ({"lubricant": 3}, "must be a Lubricant")):
        with pytest.raises(ValueError, match=said):
            film_thickness(
                **{"lubricant": OIL, "velocity": 1, "force_per_length": 1, "curvature": 1, "modulus": 1} | wrong
            )


def test_oils_and_surfaces_of_the_menus_are_what_their_files_say():
    named = Lubricant(oil="SAE 40 at 100 degC")
    assert named.now == pytest.approx((14.4e-6 * 840, (0.6 + 0.965 * np.log10(14.4 * 0.84)) * 1e-8))
    viscosities = [oil.viscosity for oil in LUBRICANTS.values()]
    assert 5e-3 < min(viscosities) < max(viscosities) < 0.2
    hard = SurfaceStrength(surface="induction-hardened steel")
    assert hard.life(271e3 * psi) == pytest.approx(1e7)
    assert hard.life(239e3 * psi) == pytest.approx(1e8)
    assert hard.line[2] == pytest.approx(18.3246, abs=5e-5)
    assert SurfaceStrength(surface="steel, 300 HB").line == steel_of(300)
    assert steel_of(300)[:2] == pytest.approx((758e6, 1e8))
    assert steel_of(250)[2] == pytest.approx(1 / 0.056)
    with pytest.raises(ValueError, match="'viscosity' is no path of Lubricant: it is that of the oil"):
        with_quantities(named, {"viscosity": 0.02})


# ---------------------------------------------------------------- wear and life


@given(st.floats(3e8, 3e9), st.floats(1e6, 1e10), st.floats(5, 30), st.floats(1e8, 3e9))
def test_life_is_a_line_of_the_load_stress_factor(S, cycles, e, p0):
    """``lg K = (B - lg N) / A``, as Talbourdet and Cram print their data."""
    strength, modulus = SurfaceStrength(S, cycles, e), 115e9
    A, K, reference = e / 2, load_stress_factor(p0, modulus), load_stress_factor(S, modulus)
    B = A * np.log10(reference) + np.log10(cycles)
    assert strength.log_life(p0) == pytest.approx(B - A * np.log10(K), rel=1e-9, abs=1e-9)
    assert strength.allowable(strength.life(p0)) == pytest.approx(p0, rel=1e-9)


def test_allowable_pressure_is_a_limit_of_a_search():
    load = SlideLoad(preload=2000.0, spring_rate=2e4)
    cam = TranslatingFlatCam(load=load, contact=PAIR.replace(strength=SurfaceStrength(surface="steel, 200 HB")))
    study = Study(cam, {"base_radius": (25 * mm, 80 * mm)}, (max_pressure_angle,), at_most={pressure_share: 0.8})
    small = minimise(study.replace(minimise=(-peak_pressure,)), "slsqp", seed=1).design
    analysis, pair = small.analyse(), small.contact
    assert pressure_share(analysis) == pytest.approx(0.8, rel=1e-6)
    assert peak_pressure(analysis) == pytest.approx(0.8 * pair.strength.allowable(1e8), rel=1e-6)
    assert min_life(analysis) == pytest.approx(8 - np.log10(0.8) / 0.056, rel=1e-6)


def test_what_presses_nowhere_lives_for_ever_and_what_is_undercut_or_pulled_has_no_film():
    cam = TranslatingRollerCam(contact=PAIR, groove=False)
    rests = cam.replace(load=SlideLoad(0.0, preload=0.0, spring_rate=0.0)).analyse()
    assert cam_life(rests) == (np.inf, np.inf)
    assert np.isinf(rests.surfaces.film).all()
    assert bearing_life(rests) == np.inf
    assert thin_film(rests) == 0
    pulled = cam.replace(load=SlideLoad(2.0, 900 * rpm, preload=1.0)).analyse()
    undercut = cam.replace(motion=motion(Cycloidal(), 20 * mm, 50, 100, 50, 160), roller_radius=25 * mm).analyse()
    assert undercut.profile_margin.value < 0
    for analysis in (pulled, undercut):
        assert np.isnan(analysis.surfaces.film).any()
        for measure in (min_film_ratio, thin_film, min_life, roller_life, pressure_share):
            assert np.isnan(measure(analysis)), measure.name
    assert np.isnan(bearing_life(pulled))


def test_a_bearing_lives_as_the_sum_of_what_each_load_takes():
    """Palmgren and Miner: an even force takes ``1 / L10`` of the life with each turn of the roller."""
    cam = TranslatingRollerCam(contact=PAIR, groove=False)
    analysis, bearing = cam.analyse(20_001), RollerBearing(4 * kN)
    taken = (abs(analysis.contact_force) / 4e3) ** (10 / 3) / 1e6
    turned = np.gradient(analysis.cam_angle) * analysis.surface_rates[0] / (2 * np.pi * cam.roller_radius)
    life = bearing.life(analysis)
    assert 1 / life.cam_turns == pytest.approx((taken * turned).sum(), rel=1e-4)
    assert life.turns == pytest.approx(life.cam_turns * analysis.surfaces.roller_turns)
    assert life.hours == pytest.approx(life.cam_turns / 300 / 60)
    face = TranslatingFlatCam(contact=PAIR).analyse()
    assert np.isnan(bearing.life(face).hours)
    assert np.isnan(cam_life(face).roller)


# ---------------------------------------------------------------- populations, pairs, refusals


LUBRICATED = {name: cam.replace(contact=PAIR) for name, cam in CAMS.items()} | {
    "high speed": HighSpeedCam(contact=PAIR),
    "valve": ValveCam(contact=PAIR),
    "pair": ConjugatePair(TranslatingFlatCam(load=SlideLoad(spring_rate=0, preload=0), contact=PAIR)),
}


@pytest.mark.parametrize("name", LUBRICATED)
def test_a_population_is_its_members(name):
    design = LUBRICATED[name]
    path = "cam.contact." if name == "pair" else "contact."
    free = [path + p for p in ("cam_roughness", "lubricant.viscosity", "strength.exponent", "width")]
    x = np.array([[0.2 * um, 0.004, 9.0, 8 * mm], [0.9 * um, 0.05, 22.0, 30 * mm]])
    many = with_quantities(design, {p: x[:, i : i + 1] for i, p in enumerate(free)}).analyse(61)
    ones = [with_quantities(design, dict(zip(free, row, strict=True))).analyse(61) for row in x]
    for measure in measures_of(design)[-14:]:
        found = np.broadcast_to(measure(many), 2)
        assert_allclose(found, [measure(one) for one in ones], rtol=1e-9, err_msg=measure.name)


def test_a_member_that_cannot_be_built_is_nan_and_disturbs_nobody():
    many = TranslatingRollerCam(contact=PAIR, base_radius=np.array([[30 * mm], [5 * mm], [-1 * mm]])).analyse(91)
    alone = TranslatingRollerCam(contact=PAIR).analyse(91)
    for measure in measures_of(TranslatingRollerCam(contact=PAIR))[-12:]:
        found = np.broadcast_to(measure(many), 3)
        assert found[0] == pytest.approx(measure(alone), rel=1e-9), measure.name
        assert np.isnan(found[2]), measure.name


def test_each_cam_of_a_pair_counts_where_it_pushes():
    pair = LUBRICATED["pair"].analyse(2001)
    y = [
        np.where(curve.contact_force > 0, curve.surfaces.film_ratio, np.inf).min()
        for curve in (pair.first, pair.second)
    ]
    assert min_film_ratio(pair) == pytest.approx(min(y), rel=1e-3)
    assert np.isfinite([measure(pair) for measure in (min_life, thin_film)]).all()
    rollers = ConjugatePair(TranslatingRollerCam(groove=False, load=SlideLoad(spring_rate=0, preload=0), contact=PAIR))
    assert np.isfinite([measure(rollers.analyse()) for measure in (roller_life, bearing_life)]).all()


def test_what_is_no_speed_and_no_strength_is_refused_in_a_sentence():
    for cam, speed, said in (
        (TranslatingFlatCam(), -1.0, "the speed of the cam is -1; it must be a finite number of at least 0"),
        (TranslatingFlatCam(), "fast", "the speed of the cam is 'fast'"),
    ):
        with pytest.raises(ValueError, match=said):
            entrainment(cam.analyse(), speed)
    with pytest.raises(ValueError, match="the entrainment"):
        entrainment(3, 1.0)
    with pytest.raises(ValueError, match="the strength of the surfaces is None; it must be a SurfaceStrength"):
        cam_life(TranslatingFlatCam(contact=ContactPair()).analyse())
    for kind, name in ((SurfaceStrength, "pressure"), (SurfaceStrength, "exponent"), (RollerBearing, "rating")):
        with pytest.raises(ValueError, match="it must be a finite number above 0"):
            kind(**{name: 0.0})
    fast = HighSpeedCam(speed=1.5, rated_speed=200 * rpm)
    assert_allclose(entrainment(fast.analyse()).cam, entrainment(HighSpeedCam().analyse(), 300 * rpm).cam)
    assert "rated_speed" not in quantities_of(fast)
    assert "rated_speed" in quantities_of(LUBRICATED["high speed"])


def test_nothing_is_said_of_film_and_life_without_lubricant_and_strength():
    plain = TranslatingFlatCam(contact=ContactPair()).analyse()
    assert np.isnan(plain.surfaces.film_ratio).all()
    assert "surfaces" not in plain.offers
    assert not {min_film_ratio, min_life} & set(measures_of(plain.cam))


def test_roughness_can_have_tolerances():
    study = Study(LUBRICATED["roller"], ["contact.cam_roughness"], (min_film_ratio,))
    made = Tolerances(study, {"contact.cam_roughness": 0.1 * um}, parts=16)
    assert np.isfinite(made.evaluation.f).all()
