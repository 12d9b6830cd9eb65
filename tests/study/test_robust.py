"""Yields under tolerances against closed forms, and against many parts that no model has seen."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import brentq

from camkit import (
    DoorHandleCam,
    Poly345,
    Study,
    TranslatingRollerCam,
    ValveCam,
    deg,
    minimise,
    mm,
    polish,
    rssr_study,
    shaft_study,
)
from camkit.cam import max_pressure_angle, min_concave_radius, min_convex_radius
from camkit.linkage import swing
from camkit.machines import corrected_valve_study, door_handle, door_handle_study, ninety_degree_study
from camkit.machines.shaft import twist_utilisation
from camkit.quantities import Measure, quantities_of, value_of
from camkit.search import search
from camkit.study import RobustStudy, Source, Tolerance, en_10210, failures, iso_286, recheck
from camkit.study.recheck import clopper_pearson
from camkit.study.weighted import points_of

TUBE = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm}
TUBES = np.array([[129.3, 103], [129.5, 103], [129.7, 103], [129.8, 103]]) * mm
YIELDS = 0.6091703, 0.8091703, 0.9664345, 0.9969559
"""The share of the square of both deviations with ``D^4 - d^4`` large enough, by quadrature."""


def quadrature(outer, inner, widths=(0.5 * mm, 0.3 * mm), n=4001):
    """The share of tubes that are stiff enough: for each bore the share of outer diameters above the one needed."""
    d = inner + widths[1] * (2 * (np.arange(n) + 0.5) / n - 1)
    needed = shaft_study().start.stiff_diameter(d)
    return np.clip((outer + widths[0] - needed) / (2 * widths[0]), 0, 1).mean()


def brute(robust, x, parts=100_000, seed=7):
    """The yield of one design by plain random parts, each built and judged by the nominal study."""
    draw, x = np.random.default_rng(seed), np.asarray(x)
    kept = 0
    for _ in range(parts // 10_000):
        z = draw.uniform(-1, 1, (10_000, len(robust.tolerances)))
        kept += robust.judged(robust.made(x[None], z)[0]).feasible.sum()
    return kept / parts


# ---------------------------------------------------------------- the shaft, whose yield has a closed form


def test_the_printed_yields_are_those_of_the_quadrature():
    assert_allclose([quadrature(*tube) for tube in TUBES], YIELDS, atol=2e-6)


def test_yields_of_shafts():
    robust = shaft_study().under(TUBE)
    found = robust.recheck(TUBES, 2**14)
    assert_allclose(found.share, YIELDS, atol=4e-4)
    assert (found.interval[:, 0] < YIELDS).all()
    assert (found.interval[:, 1] > YIELDS).all()
    normal = shaft_study().under({path: Tolerance(half, "normal") for path, half in TUBE.items()})
    assert_allclose(normal.recheck(TUBES[:3], 2**14).share, [0.7347389, 0.9620716, 0.9982679], atol=4e-4)
    for r, share in ((0.8, 0.898), (-0.8, 0.752)):
        joined = shaft_study().under(TUBE, correlation={("outer_diameter", "inner_diameter"): r})
        assert joined.recheck(TUBES[1], 2**14).share == pytest.approx(share, abs=1.5e-3)


def test_modelled_yields():
    """The closed form to what 512 parts tell; 0 for what cannot be built or is no number; corners in the worst case."""
    robust = shaft_study().under(TUBE)
    assert_allclose(robust.modelled_yield(TUBES), YIELDS, atol=3e-3)
    assert_array_equal(robust.modelled_yield([[0.11, 0.12], [np.nan, 0.103], [0.14, 0.103]]), [0, 0, 1])
    corners = shaft_study().under(TUBE, worst_case=True)
    assert_array_equal(corners.modelled_yield(np.array([[129.82, 103], [129.85, 103]]) * mm), [0.75, 1])
    assert_array_equal(
        shaft_study().replace(at_most={}).under(TUBE).modelled_yield([[0.11, 0.12], [0.13, 0.1]]), [0, 1]
    )


def test_it_is_as_sure_as_it_says():
    robust = shaft_study().under(TUBE)
    found = robust.recheck(TUBES)
    assert_array_equal(found.kept, [False, False, False, True])
    assert found.decided.all()
    assert str(found).endswith("99.7 % (99.1 to 99.9)")
    few = robust.recheck(TUBES[3], 64)
    assert not few.decided.any()
    assert "not decided" in str(few)


def test_clopper_and_pearson():
    """99 % are sure with at most 4 of 1024, 30 of 4096 and 142 of 16384 missed."""
    for missed, parts in ((4, 1024), (30, 4096), (142, 16384)):
        low = clopper_pearson(np.array([missed, missed + 1]), np.array([parts, parts]))[:, 0]
        assert low[0] >= 0.99 > low[1]
    assert clopper_pearson(np.array([0]), np.array([100]))[0, 1] == 1
    assert clopper_pearson(np.array([0]), np.array([100]))[0, 0] == pytest.approx(0.05**0.01)


@pytest.mark.parametrize("true", [0.9899, 0.9901])
def test_it_errs_no_more_often_than_it_says(true, monkeypatch):
    """Up to three looks at 40000 designs of a yield just below or above what is wanted, by binomial numbers."""
    draw, count, looks = np.random.default_rng(5), 40_000, (1024, 4096, 16384)
    missed = np.cumsum([draw.binomial(n, 1 - true, count) for n in np.diff(looks, prepend=0)], axis=0)

    def told(study, x, models, number):
        return missed[looks.index(number)][x[:, 0].astype(int)], 0

    monkeypatch.setattr(recheck, "_missed", told)
    monkeypatch.setattr(recheck, "models_by_few_angles", lambda *_: [])
    monkeypatch.setattr(RobustStudy, "nominal", shaft_study().replace(free=["outer_diameter"]))
    found = recheck.rechecked(shaft_study().under(TUBE), np.arange(count)[:, None], None)
    wrong = found.kept if true < 0.99 else found.decided & ~found.kept
    assert 0.02 < wrong.mean() < 0.05
    assert (found.interval[:, 0] > true).mean() < 0.05
    assert (found.interval[:, 1] < true).mean() < 0.05
    assert set(found.parts) == set(looks)


def test_that_all_parts_keep_their_limits_is_not_sure_by_some():
    robust = shaft_study().under(TUBE, yield_at_least=1)
    found = robust.recheck([[0.1303, 0.103], [0.1298, 0.103]])
    assert_array_equal(found.decided, [False, True])
    assert not found.kept.any()
    good, bad = str(found).split("; ")
    assert good == "none of 16384 parts misses: at least 99.98 %, of all only a worst case is sure"
    assert bad.startswith("99.7 % (")
    assert "not decided" not in bad


def test_few_parts_are_judged_of_a_good_design():
    robust = shaft_study().under(TUBE)
    good = robust.recheck([[0.1302, 0.103]], 1024)
    assert good.share == 1
    assert good.evaluations <= 25


def test_the_screened_recheck_is_that_of_all_parts():
    robust = ninety_degree_study().under(dict.fromkeys(ninety_degree_study().free, 0.3 * mm))
    start = np.array([119.5, 120, 119.5, 98, 98.4]) * mm
    x = start + np.random.default_rng(1).uniform(-0.3, 0.3, (12, 5)) * mm
    every = robust.judged(robust.made(x, robust.shares(1024, 20768)).reshape(-1, 5)).feasible.reshape(12, -1)
    assert_array_equal(robust.recheck(x, 1024).share, every.mean(1))


def test_a_limit_that_is_kept_without_end_hides_none_that_is_missed():
    """A sliding roller with no hollow: its least radius there is infinite, while the pressure angle is missed."""
    limits = {max_pressure_angle: 25 * deg}, {min_convex_radius: 12 * mm, min_concave_radius: 12 * mm}
    paths = {"base_radius": 0.5 * mm, "roller_radius": 0.3 * mm, "offset": 0.5 * mm}
    study = Study(TranslatingRollerCam(), [*paths], [max_pressure_angle], *limits, angles=181)
    robust, x = study.under(paths), np.array([[32.06, 33.81, 14.51], [34.05, 31.59, -15.05], [34.8, 31.6, 15]]) * mm
    assert np.isneginf(study.evaluate(x).g[:, 2]).all()
    every = robust.judged(robust.made(x, robust.shares(1024, 20768)).reshape(-1, 3)).feasible.reshape(3, -1)
    assert every.mean(1)[1] < 0.5
    assert_array_equal(robust.recheck(x, 1024).share, every.mean(1))


@pytest.mark.parametrize(
    ("options", "spread", "outer"),
    [
        ({}, "uniform", 129.764976),
        ({}, "normal", 129.596011),
        ({"worst_case": True}, "uniform", 129.843127),
    ],
    ids=("yield", "normal", "worst case"),
)
def test_the_lightest_shaft(options, spread, outer):
    """Reference: the yield's closed form solved for the outer diameter, the bore at its bound."""
    robust = shaft_study().under({path: Tolerance(half, spread) for path, half in TUBE.items()}, **options)
    best = minimise(robust)
    assert best.feasible
    assert_allclose(best.x / mm, [outer, 103], atol=0.01)
    assert "At their limits within the tolerances: the utilisation of the twist 9" in best.message
    if not options:
        assert robust.recheck(best.x, 2**14).share == pytest.approx(0.99, abs=1e-3)
        sure = robust.recheck(minimise(robust.sought).x)
        assert sure.kept.all()
        assert sure.share == pytest.approx(0.993, abs=1e-3)


def test_the_reference_values_of_the_lightest_shaft():
    found = brentq(lambda D: quadrature(D, 103 * mm) - 0.99, 129.5 * mm, 130 * mm)
    assert found / mm == pytest.approx(129.764976, abs=1e-5)
    worst = shaft_study().start.stiff_diameter(103.3 * mm) + 0.5 * mm
    assert worst / mm == pytest.approx(129.843127, abs=1e-6)


@pytest.mark.parametrize(("objective", "area"), [("mean", 4893.032347), ("95 %", 4999.06)])
def test_objectives_of_the_lightest_shaft(objective, area):
    """By 512 parts, to 1.5 % of what the area spreads by."""
    robust = shaft_study().under(TUBE, objective=objective)
    found = robust.evaluate([129.764976 * mm, 103 * mm]).f[0, 0] / mm**2
    assert found == pytest.approx(area, abs=0.015 * (4999 - 4893))


def test_a_descent_takes_the_nominal_objective_alone():
    robust = shaft_study().under(TUBE, objective="mean")
    with pytest.raises(ValueError, match="this study has the objective 'mean': take 'de', 'ga' or 'competitive'"):
        minimise(robust)
    assert minimise(robust, "de", designs=500).descended is None


def test_the_worst_objective_is_that_of_the_largest_tube():
    robust = shaft_study().under(TUBE, objective="worst")
    largest = np.pi / 4 * (130.3**2 - 102.7**2)
    assert robust.evaluate([129.8 * mm, 103 * mm]).f[0, 0] / mm**2 == pytest.approx(largest, rel=1e-6)


def test_the_worst_of_an_objective_may_lie_between_the_ends():
    """A hill whose top is 0.1 mm from the middle, within a tolerance of 0.5 mm, and one out of reach of it."""
    study = shaft_study()
    for top, worst in ((129.7, 5.0), (129.0, 5.0 - 0.3**2)):
        hill = Measure("hill", "", lambda a, top=top: 5 - np.ravel(a.shaft.outer_diameter / mm - top) ** 2)
        robust = study.replace(minimise=(hill,)).under({"outer_diameter": 0.5 * mm}, objective="worst")
        assert robust.evaluate([129.8 * mm, 103 * mm]).f[0, 0] == pytest.approx(worst, abs=1e-9)


def test_the_worse_of_two_curves_is_modelled_curve_by_curve():
    """Of a door every limit but that of the groove's wall; where only a number of each curve is known, by these."""
    robust = whole_cam()
    analysis = robust.analysis(np.stack([robust.x0, 1.02 * robust.x0]))
    points = [points_of(m, analysis, sense, 2) for m, _, sense in robust.limits]
    assert [point.shape[1] > 1 for point in points] == [True, True, True, True, False]
    steepest = [abs(cam.pressure_angle).max(-1) for cam in (analysis.lift, analysis.relief)]
    assert_allclose(points[0].max(-1), np.maximum(*steepest), rtol=1e-3)
    assert points[1].shape == (2, 2)
    assert_allclose(robust.limits[1][0](analysis), -points[1].max(-1))
    assert robust.limits[3][0].angle(analysis).shape == points[3].shape
    models = robust.models(robust.x0[None])
    assert_allclose([m.centre.max() for m in models[:2]], robust.nominal.evaluate(robust.x0).g[0, :2], atol=1e-12)


def test_tolerance_factors():
    """1.0609626 by quadrature; 0.9339355 where the corner comes to the limit."""
    assert shaft_study().under(TUBE).tolerance_factor(TUBES[3])[0] == pytest.approx(1.0609626, rel=2e-3)
    factor = shaft_study().under(TUBE, worst_case=True).tolerance_factor(TUBES)
    assert factor[3] == pytest.approx(0.9339355, rel=1e-6)
    assert shaft_study().start.stiff_diameter(103 * mm + factor[0] * 0.3 * mm) == pytest.approx(
        129.3 * mm - factor[0] * 0.5 * mm, abs=1e-9
    )
    assert shaft_study().under(TUBE).tolerance_factor([[0.128, 0.103]]) == 0
    loose = shaft_study().replace(at_most={twist_utilisation: 100.0})
    assert np.isinf(loose.under({"length": 1 * mm}).tolerance_factor([[0.128, 0.1]]))


def test_all_corners_of_a_worst_case_are_judged():
    robust = shaft_study().under(TUBE, worst_case=True)
    found = robust.recheck(np.array([[129.84, 103], [129.85, 103]]) * mm)
    assert_array_equal(found.missed, [1, 0])
    assert_array_equal(found.parts, 4)
    assert_array_equal(robust.evaluate(np.array([[129.84, 103], [129.85, 103]]) * mm).feasible, [False, True])


@pytest.mark.parametrize("least", [0.0, 0.1, 1.0, 4.0, -2.0])
def test_three_tolerances_miss_together_what_none_misses_alone(least):
    """A force of at least 0 N, or a little more or less, that is 20 N, with three deviations of 15 N."""

    def force_of(a):
        shaft = a.shaft
        return np.ravel(20 + 3e4 * (shaft.outer_diameter + shaft.inner_diameter - 0.23) + 1500 * (shaft.length - 2.41))

    force = Measure("force", "N", force_of)
    paths = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.5 * mm, "length": 10 * mm}
    robust = shaft_study().replace(at_most={}, at_least={force: least}).under(paths)
    x, room = np.array([0.13, 0.1]), (20 - least) / 15
    missed = (3 - room) ** 3 / 48  # the corner of a cube of which the sum is below -4/3, for a limit of 0
    assert robust.recheck(x, 4096).share == pytest.approx(1 - missed, abs=5e-3)
    assert not robust.evaluate(x).feasible.any()
    assert robust.modelled_yield(x) == pytest.approx(1 - missed, abs=0.013)  # of 512 parts
    assert robust.tolerance_factor(x)[0] == pytest.approx(room / (3 - 0.48 ** (1 / 3)), rel=0.01)
    best = minimise(robust)
    assert best.feasible
    assert robust.recheck(best.x, 2**14).share == pytest.approx(0.99, abs=2e-3)


def test_a_radius_that_grows_without_end_is_seen_by_its_curvature():
    """A curvature of 0.2, of at most 1, that moves by 0.5 with each of two deviations, and is flat with others."""

    def radius_of(a):
        bend = np.ravel(0.2 + 1e3 * (a.shaft.outer_diameter + a.shaft.inner_diameter - 0.23))
        return np.where(bend > 0, 1 / np.maximum(bend, 1e-12), np.inf)

    study = shaft_study().replace(at_most={}, at_least={Measure("radius", "m", radius_of): 1.0})
    robust, x = study.under(dict.fromkeys(TUBE, 0.5 * mm)), np.array([[0.13, 0.1], [0.1296, 0.1], [0.1288, 0.1]])
    shares = 1 - 0.4**2 / 8, 1, 1  # the corner of the square where the sum of both is above 1.6; never otherwise
    assert_allclose(robust.modelled_yield(x), shares, atol=0.013)  # of 512 parts
    assert_allclose(robust.recheck(x, 4096).share, shares, atol=2e-3)


def test_without_limits_a_part_must_be_built():
    """A tube with a bore of its own size: half of the parts, all but a corner of the square, or all are tubes."""
    study = shaft_study().replace(
        at_most={}, at_least={}, free={"outer_diameter": (0.1, 0.14), "inner_diameter": (0.09, 0.1)}
    )
    robust, x = study.under(TUBE), np.array([[100.0, 100], [100.6, 100], [101, 100]]) * mm
    shares = 0.5, 1 - 0.2**2 / (2 * 1.0 * 0.6), 1
    assert_allclose(robust.recheck(x, 4096).share, shares, atol=5e-3)
    assert robust.recheck(x).kept.tolist() == [False, False, True]
    assert str(failures(robust, x[:1])).endswith("% of the parts cannot be built")
    assert_array_equal(robust.evaluate([[0.1002, 0.1], [0.101, 0.1]]).feasible, [False, True])


def test_many_tolerances_and_no_limit():
    study = shaft_study().replace(at_most={}, at_least={})
    paths = [path for path in quantities_of(study.start) if value_of(study.start, path) > 0][:11]
    robust = study.under({path: 1e-6 * value_of(study.start, path) for path in paths}, worst_case=True)
    assert len(paths) == 11
    assert robust.recheck(study.x0).kept.all()


def test_a_tube_by_its_standard():
    """EN 10210-2: 139.7 x 10 mm yields 0.8221; a source moves diameter and bore, another the bore alone."""
    robust = shaft_study().under(en_10210("outer_diameter", "inner_diameter"))
    found = robust.recheck(np.array([[139.7, 119.7], [139.7, 114.7]]) * mm, 2**14)
    assert found.share[0] == pytest.approx(0.8221, abs=1.5e-3)
    assert found.kept[1]
    made = robust.made(np.array([[0.1397, 0.1197]]), np.array([[0.0, -1.0], [1.0, 0.0]]))[0]
    middle = 0.1397, 0.1197 + 0.02 * 0.01
    assert_allclose(made[0], (middle[0], 0.1197 + 2 * 0.1 * 0.01))
    assert_allclose(made[1], np.add(middle, 0.01 * 0.1397))


def test_one_sided_tolerances_on_quantities_that_are_not_free():
    """A power that may only be larger, by up to a tenth: the twist grows with it, a known share of the parts fails."""
    study, stiff = shaft_study(), shaft_study().start.stiff_difference
    robust = study.under({"power": (0.0, 0.1 * study.start.power)})
    x = np.array([(stiff * 1.04 + 0.1**4) ** 0.25, 0.1])
    assert robust.recheck(x, 2**12).share == pytest.approx(0.4, abs=1e-3)
    assert robust.tolerance_factor(np.array([(stiff * 1.0995 + 0.1**4) ** 0.25, 0.1]))[0] == pytest.approx(
        1.0, abs=0.02
    )


def test_a_limit_that_is_kept_by_far_and_missed_within_the_tolerances():
    """A strength of at least 0 N that is 15 kN in the middle: a fifth of the parts has none."""
    strength = Measure("strength", "N", lambda a: 5e4 * (np.ravel(a.shaft.outer_diameter) / mm - 129.5))
    robust = shaft_study().replace(at_most={}, at_least={strength: 0.0}).under({"outer_diameter": 0.5 * mm})
    x = np.array([[129.8, 103], [130.1, 103]]) * mm
    assert_allclose(robust.recheck(x).share, [0.8, 1.0], atol=2e-3)
    assert_array_equal(robust.evaluate(x).feasible, [False, True])
    assert_array_equal(robust.tightened(robust.margins).evaluate(x).feasible, [False, True])


def test_a_deviation_to_one_side_may_make_up_for_what_a_design_lacks():
    robust = shaft_study().under({"outer_diameter": (0.5 * mm, 1.0 * mm)})
    x = np.array([[128.9, 103], [128.5, 103]]) * mm
    assert not robust.nominal.evaluate(x).feasible.any()
    assert_array_equal(robust.recheck(x).kept, [True, False])
    assert_array_equal(robust.evaluate(x).feasible, [True, False])


def test_tolerances_may_depend_on_the_value():
    robust = shaft_study().under({"outer_diameter": lambda D: np.where(129.6 * mm < D, 1.0, 0.1) * mm})
    made = robust.made(TUBES[1:3], np.ones((1, 1)))[:, 0, 0]
    assert_allclose(made / mm, [129.6, 130.7])


# ---------------------------------------------------------------- other machines


def test_yields_of_doors():
    """The housing's walls are modelled one by one; reference values by many parts, to 5e-4."""
    study = ninety_degree_study()
    robust = study.under(dict.fromkeys(study.free, 0.3 * mm))
    x = np.array([(120, 120, 120, 99, 99), (119.5, 120, 119.5, 98, 98.4)]) * mm
    assert_allclose(robust.recheck(x, 2**14).share, [0.2330, 0.9982], atol=1e-3)
    z = robust.shares(4096, 3)
    exact = robust.judged(robust.made(x[:1], z)[0])
    modelled = np.stack([model.at(z)[0] for model in robust.models(x[:1])], axis=-1)
    assert (exact.g <= 0).all(-1).mean() == pytest.approx((modelled <= 0).all(-1).mean(), abs=2e-3)
    place = [m for m, _, _ in study.limits].index(swing)
    assert (exact.g[:, place] > 0).mean() == pytest.approx(0.1594, abs=2e-3)
    assert (exact.g[:, place + 1] > 0).mean() == pytest.approx(0.7314, abs=2e-3)
    worst = study.under(dict.fromkeys(study.free, 0.3 * mm), worst_case=True)
    corners = worst.recheck(np.array([(119.4, 120, 119.4, 97.8, 98.5), (119.5, 120, 119.5, 98, 98.4)]) * mm)
    assert_array_equal(corners.parts, 32)
    assert_array_equal(corners.missed == 0, [True, False])


@pytest.mark.slow
def test_the_least_steep_door_that_can_be_made():
    study = ninety_degree_study()
    robust = study.under(dict.fromkeys(study.free, 0.3 * mm))
    best = minimise(robust)
    assert best.f / deg == pytest.approx(42.24, abs=0.005)
    assert robust.recheck(best.x, 2**14).share > 0.99
    assert brute(robust, best.x) > 0.989
    steep = minimise(study).x
    assert robust.recheck(steep, 2**14).share[0] == pytest.approx(brute(robust, steep), abs=5e-3)
    assert not robust.recheck(steep).kept.any()


def test_yields_of_valve_cams():
    study = corrected_valve_study(ValveCam(base_radius=24.5 * mm))
    load = study.start.load
    robust = study.under(
        {
            "max_lift": 0.05 * mm,
            "base_radius": 0.05 * mm,
            "half_angle": 0.5 * deg,
            "seating_velocity": 0.02,
            "load.spring_rate": 0.06 * load.spring_rate,
            "load.preload": 0.06 * load.preload,
        }
    )
    x = np.array([(20, 20), (20, 8)])
    assert_allclose(robust.recheck(x, 2**14).share, [0.7057, 0.3418], atol=2e-3)
    assert brute(robust, x[0], 20_000) == pytest.approx(0.7057, abs=0.01)


def whole_cam():
    study = door_handle_study(
        DoorHandleCam(motion_law=Poly345()), space=door_handle.EXPANDED_SPACE, reference=DoorHandleCam()
    )
    return study.under({path: 0.5 * deg if "angle" in path else 0.3 * mm for path in study.free})


def test_a_whole_cam():
    """The design of notebook 02 lies on its limit of 45 deg: half of its parts are beyond it."""
    robust = whole_cam()
    x = [45.2093 * mm, 26.3559 * deg, 82.4718 * mm, 99.9888 * mm, 85.2303 * mm, 56.0171 * deg, 3.19122 * mm]
    z = robust.shares(4096, 3)
    exact = robust.judged(robust.made(np.array([x]), z)[0])
    assert robust.recheck(x, 2**12).share == pytest.approx(exact.feasible.mean(), abs=5e-3)
    level = np.sort(exact.g.max(-1))[int(np.ceil(0.99 * 4096)) - 1]
    assert robust.evaluate(x).g.max() == pytest.approx(level, abs=1e-3)


# ---------------------------------------------------------------- a study like any other


def test_every_search_takes_it():
    robust = shaft_study().under(TUBE)
    for method in ("de", "ga", "competitive"):
        best = minimise(robust, method, designs=2000)
        assert best.feasible, method
        assert best.x[0] / mm == pytest.approx(129.765, abs=0.02), method
        assert robust.evaluate(best.descended).feasible.all(), method
    *_, last = search(robust, "slsqp")
    assert last.best.f == minimise(robust).f
    assert last.study.tolerances == robust.tolerances


def test_the_nominal_study_is_the_one_that_it_was_made_of():
    study = shaft_study()
    assert study.under(TUBE).nominal == study
    assert study.nominal is study
    margins = study.under(TUBE).margins(TUBES)
    robust = study.under(TUBE).evaluate(TUBES)
    assert_allclose(study.evaluate(TUBES).g + margins, robust.g, atol=1e-12)
    assert_array_equal(robust.feasible, [False, False, False, True])
    assert_array_equal(robust.f, study.evaluate(TUBES).f)


def test_what_misses_a_limit_itself_ranks_behind():
    found = shaft_study().under(TUBE).evaluate([[0.129, 0.103], [0.1292, 0.103]])
    assert found.missed.sum(-1)[0] > 1 > found.missed.sum(-1)[1] > 0


@pytest.mark.parametrize(
    ("tolerances", "options", "said"),
    [
        ({}, {}, "they must be a mapping with one or more"),
        ({"outer": 0.1}, {}, "'outer' is no quantity of UniversalJointShaft"),
        ({"outer_diameter": 0.0}, {}, "there is no tolerance above 0"),
        ({"length": iso_286}, {}, "the tolerance of the length is no number at the start of the study"),
        (TUBE, {"yield_at_least": 0.4}, "the yield is 0.4; it must lie above 0.5, up to 1"),
        (TUBE, {"objective": "median"}, "the objective is 'median'; there are nominal, mean, 95 %, worst"),
        (TUBE, {"correlation": {("length", "power"): 0.5}}, "it must be two of outer_diameter, inner_diameter"),
        ({Source("wall", {"bore": 1.0}): 0.1}, {}, "'bore' is no quantity of UniversalJointShaft"),
        ({Source("length", {"outer_diameter": 1.0}): 0.1, "length": 0.1}, {}, "two tolerances are called 'length'"),
        ({"length": lambda size: 1 / 0}, {}, "the length gives cannot be computed: ZeroDivisionError"),
    ],
)
def test_what_is_wrong_is_refused_in_a_sentence(tolerances, options, said):
    with pytest.raises(ValueError, match=said):
        shaft_study().under(tolerances, **options)


@pytest.mark.filterwarnings("error")
def test_a_design_without_finite_numbers_is_infeasible_beside_others():
    found = shaft_study().under(TUBE).evaluate([[np.inf, 0.103], [np.nan, 0.103], [0.14, 0.103], [0.14, -np.inf]])
    assert found.feasible.tolist() == [False, False, True, False]


def test_what_knows_no_tolerances_refuses_them():
    with pytest.raises(ValueError, match="polish takes none: use minimise"):
        polish(rssr_study().under({"crank": 0.1 * mm}))
