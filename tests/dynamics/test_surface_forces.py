"""Film, wear and life under the force of an elastic train: the reference values, and what a search makes of them."""

from operator import attrgetter

import numpy as np
import pytest

from camkit import Study, TranslatingRollerCam, ValveCam, deg, mm, rpm
from camkit.cam import (
    Lubricant,
    LubricatedPair,
    RollerBearing,
    SurfaceStrength,
    bearing_life,
    bearing_load,
    cam_life,
    min_entrainment,
    min_film,
    min_film_ratio,
    min_life,
    min_profile_radius,
    peak_load_stress,
    peak_pressure,
    peak_rubbing,
    reversals,
    roller_life,
    thin_film,
)
from camkit.dynamics import ElasticFollower, ElasticTrain
from train_cases import VALUES, A, flat

STEEL = SurfaceStrength(surface="induction-hardened steel")
PAIR = LubricatedPair(width=12 * mm, lubricant=Lubricant(0.01, 2e-8), strength=STEEL, bearing=RollerBearing(9.15e3))
FACE = ElasticFollower(flat().replace(base_radius=36 * mm, contact=PAIR), A, samples=2880)
ROLLER = ElasticFollower(
    TranslatingRollerCam(
        flat().motion, 30 * mm, 8 * mm, load=flat().load, groove=False, contact=PAIR.replace(width=6 * mm)
    ),
    A,
    samples=2880,
)


@pytest.mark.parametrize(("design", "case"), [(FACE, "flat"), (ROLLER, "roller")], ids=["face", "roller"])
def test_curves_are_those_of_the_reference(design, case):
    expected, analysis = VALUES[case], design.analyse()
    names = {
        "U_at": "surfaces.entrainment_velocity",
        "u_at": "surfaces.entrainment_velocity",
        "h_at": "surfaces.film",
        "p0_at": "contact_pressure",
    }
    for key, name in names.items():
        if key in expected:
            angles = np.array([float(angle) for angle in expected[key]]) * deg
            values = np.array([*expected[key].values()])
            assert np.max(abs(attrgetter(name)(analysis.at(angles)) - values)) < 1e-6 * abs(values).max(), key
    if case == "flat":
        angles, values = zip(*expected["slide_at"].items(), strict=True)
        sliding = analysis.at(np.array([float(angle) for angle in angles]) * deg).surfaces.entrainment.sliding
        assert np.max(abs(sliding - np.array(values))) < 1e-9


def test_measures_of_the_face_are_those_of_the_reference():
    expected, analysis = VALUES["flat"], FACE.analyse(361)
    assert peak_pressure(analysis) == pytest.approx(expected["p0_most"], rel=1e-6)
    assert peak_rubbing(analysis) == pytest.approx(expected["pv_most"], rel=1e-6)
    assert min_entrainment(analysis) == pytest.approx(expected["U_least"], rel=1e-6)
    assert min_profile_radius(analysis) == pytest.approx(expected["rho_least"], rel=1e-6)
    assert thin_film(analysis) == pytest.approx(expected["share_lambda_below_1"], abs=2 / 46080)
    assert reversals(analysis) / deg == pytest.approx(expected["U_zero_deg"], abs=1e-5)  # straight between its angles
    assert min_film(analysis) == min_film_ratio(analysis) == 0


def test_measures_of_the_roller_are_those_of_the_reference():
    expected, analysis = VALUES["roller"], ROLLER.analyse(361)
    assert peak_pressure(analysis) == pytest.approx(expected["p0_most"], rel=1e-6)
    assert min_film_ratio(analysis) == pytest.approx(expected["lambda_least"], rel=1e-6)
    assert analysis.surfaces.roller_turns == pytest.approx(expected["turns_of_roller"], rel=1e-7)
    assert peak_load_stress(analysis) == pytest.approx(expected["K_most"], rel=1e-6)
    assert min_life(analysis) == pytest.approx(expected["cam_life_log10"], abs=1e-6)
    assert roller_life(analysis) == pytest.approx(expected["roller_life_cam_turns_log10"], abs=1e-6)
    assert np.log10(cam_life(analysis, STEEL)) == pytest.approx(
        [expected["cam_life_log10"], expected["roller_life_cam_turns_log10"]], abs=1e-6
    )
    life = RollerBearing(9.15e3).life(analysis)
    keys = "P", "L10_roller_turns", "L10_cam_turns", "L10_hours"
    assert [*life] == pytest.approx([expected[key] for key in keys], rel=1e-6)
    assert bearing_load(analysis) == pytest.approx(expected["P"], rel=1e-6)
    assert bearing_life(analysis) == pytest.approx(expected["L10_hours"], rel=1e-6)


def test_a_study_judges_the_life_of_the_elastic_train():
    rigid = Study(ROLLER.cam, ["roller_radius"], (min_life,))
    elastic = Study(ROLLER, ["cam.roller_radius"], (min_life,))
    x = np.array([[8 * mm], [10 * mm]])
    found = elastic.evaluate(x).f[:, 0]
    assert found[0] == pytest.approx(VALUES["roller"]["cam_life_log10"], abs=2e-5)
    assert (found < rigid.evaluate(x).f[:, 0] - 0.4).all()


def test_the_film_of_a_valve_cam_is_that_of_its_elastic_train():
    cam = ValveCam(contact=PAIR)
    cam = cam.replace(load=cam.load.replace(speed=800 * rpm))
    analysis, rigid = ElasticFollower(cam, ElasticTrain(5e6, 100.0, 10.0)).analyse(), cam.analyse()
    assert reversals(analysis) == pytest.approx(reversals(rigid), abs=1e-9)
    there = (rigid.contact_force > 1) & (analysis.contact_force > 1) & (abs(rigid.surfaces.entrainment_velocity) > 0.01)
    ratio = (analysis.surfaces.film / rigid.surfaces.film)[there]
    assert ratio == pytest.approx((analysis.contact_force / rigid.contact_force)[there] ** -0.13, rel=1e-9)
    assert abs(ratio - 1).max() > 1e-3
