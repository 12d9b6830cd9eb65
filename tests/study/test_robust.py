"""Yields under tolerances against closed forms, and against many parts that no model has seen."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import brentq

from camkit import DoorHandleCam, Poly345, Session, ValveCam, deg, minimise, mm, polish, rssr_study, shaft_study, write
from camkit.linkage import swing
from camkit.machines import corrected_valve_study, door_handle, door_handle_study, ninety_degree_study
from camkit.machines.shaft import twist_utilisation
from camkit.quantities import Measure, quantities_of, value_of
from camkit.search import search
from camkit.study import Source, Tolerance, en_10210, iso_286
from camkit.study.recheck import clopper_pearson

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
    assert str(found).endswith("99.7 % (99.2 to 99.9)")
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
    if not options:
        assert robust.recheck(best.x, 2**14).share == pytest.approx(0.99, abs=1e-3)


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


def test_the_worst_objective_is_that_of_the_largest_tube():
    robust = shaft_study().under(TUBE, objective="worst")
    largest = np.pi / 4 * (130.3**2 - 102.7**2)
    assert robust.evaluate([129.8 * mm, 103 * mm]).f[0, 0] / mm**2 == pytest.approx(largest, rel=1e-6)


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


def test_three_tolerances_miss_together_what_none_misses_alone():
    """A force of at least 0 N that is 20 N, with three deviations of 15 N."""

    def force_of(a):
        shaft = a.shaft
        return np.ravel(20 + 3e4 * (shaft.outer_diameter + shaft.inner_diameter - 0.23) + 1500 * (shaft.length - 2.41))

    force = Measure("force", "N", force_of)
    paths = {"outer_diameter": 0.5 * mm, "inner_diameter": 0.5 * mm, "length": 10 * mm}
    robust = shaft_study().replace(at_most={}, at_least={force: 0.0}).under(paths)
    x = np.array([0.13, 0.1])
    missed = (3 - 4 / 3) ** 3 / 48  # the corner of a cube of which the sum is below -4/3
    assert robust.recheck(x, 4096).share == pytest.approx(1 - missed, abs=5e-3)
    assert not robust.evaluate(x).feasible.any()
    assert robust.tolerance_factor(x)[0] == pytest.approx(4 / 3 / (3 - 0.48 ** (1 / 3)), rel=0.01)
    best = minimise(robust)
    assert best.feasible
    assert robust.recheck(best.x, 2**14).share == pytest.approx(0.99, abs=2e-3)


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
    ],
)
def test_what_is_wrong_is_refused_in_a_sentence(tolerances, options, said):
    with pytest.raises(ValueError, match=said):
        shaft_study().under(tolerances, **options)


def test_what_knows_no_tolerances_refuses_them(tmp_path):
    with pytest.raises(ValueError, match="polish takes none: use minimise"):
        polish(rssr_study().under({"crank": 0.1 * mm}))
    with pytest.raises(ValueError, match="under tolerances, which no file can hold"):
        write(Session(shaft_study().under(TUBE), shaft_study().start), tmp_path / "tube.json")
