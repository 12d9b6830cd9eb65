"""Menus that a study frees: their options by hand, what is no variable with some of them, and what is refused."""

from itertools import product

import numpy as np
import pytest

from camkit import (
    Cycloidal,
    DoorHandleCam,
    HighSpeedCam,
    ModifiedSine,
    Poly345,
    Study,
    TranslatingRollerCam,
    deg,
    mm,
    shaft_study,
)
from camkit.cam import (
    ContactPair,
    max_pressure_angle,
    min_force,
    min_profile_radius,
    peak_pressure,
    peak_torque,
)
from camkit.machines import standard_tubes
from camkit.motion import HALF_LAWS, LAW_MENU, Dwell, FreePolynomial, MotionProgram, Return, Rise, ShapedLaw
from camkit.quantities import value_of, with_quantities
from camkit.study import DesignMap, Sweep, general_tolerances
from camkit.study.free import Menu, freed

LAWS = (Cycloidal(), ModifiedSine(), ShapedLaw(Poly345()))
BOTH = ("motion.rise.law", "motion.return.law")
CAM = TranslatingRollerCam(offset=5 * mm, contact=ContactPair())
SIZES = {6 * mm, 8 * mm, 12 * mm}


def study(**changes: object) -> Study:
    """A cam with a law, a roller and a direction to choose, the spring's rate and two coefficients of one law."""
    given = {
        "free": {
            "motion.rise.law": LAWS,
            "motion.rise.law.c0": (-0.2, 0.2),
            "roller_radius": SIZES,
            "load.spring_rate": (4e3, 20e3),
            "rotation": ("counter-clockwise", "clockwise"),
            "motion.rise.law.c1": (-0.1, 0.1),
        },
        "minimise": (peak_pressure, peak_torque),
        "at_most": {max_pressure_angle: 30 * deg},
        "at_least": {min_force: 10.0},
    }
    return Study(**{"start": CAM, **given, **changes})


def by_hand(x: np.ndarray) -> TranslatingRollerCam:
    """The design of one row, put together without a study."""
    law, c0, roller, rate, way, c1 = x
    chosen = LAWS[int(law)]
    cam = with_quantities(CAM, {"motion.rise.law": chosen, "rotation": [1, -1][int(way)]})
    if int(law) == 2:
        cam = with_quantities(cam, {"motion.rise.law.c0": c0, "motion.rise.law.c1": c1})
    return cam.replace(roller_radius=sorted(SIZES)[int(roller)], load=cam.load.replace(spring_rate=rate))


def test_a_population_is_judged_as_its_designs_are_one_by_one():
    freed = study()
    x = np.random.default_rng(3).uniform(*freed.bounds, (40, 6))
    x[:, [0, 2, 4]] = [places for places in product(range(3), range(3), range(2))] * 2 + [[0, 0, 0]] * 4
    found = freed.evaluate(x)
    designs = [by_hand(row) for row in x]
    analyses = [cam.analyse(361) for cam in designs]
    expected = [[float(peak_pressure(a)), float(peak_torque(a))] for a in analyses]
    limits = [[float(max_pressure_angle(a)) / (30 * deg) - 1, 1 - float(min_force(a)) / 10] for a in analyses]
    np.testing.assert_allclose(found.f, expected, rtol=1e-9)
    np.testing.assert_allclose(found.g, limits, rtol=1e-9, atol=1e-12)
    assert [freed.design(row) for row in x] == designs
    np.testing.assert_array_equal(freed.x_of(designs[5]), found.x[5])


def test_what_an_option_does_not_have_is_no_variable_with_it():
    freed = study()
    settled = freed.rows([[0, 0.15, 0, 5e3, 1, 0.1], [2.4, 0.15, 1.7, 5e3, -3, 0.1]])
    assert settled.tolist() == [[0, 0.0, 0, 5e3, 1, 0.0], [2, 0.15, 2, 5e3, 0, 0.1]]
    assert [list(made.study.free) for made in freed.options.each()][::6] == [
        ["load.spring_rate"],
        ["load.spring_rate"],
        ["motion.rise.law.c0", "load.spring_rate", "motion.rise.law.c1"],
    ]
    assert [made.name for made in freed.options.each()][:2] == [
        "cycloidal, 6 mm, counter-clockwise",
        "cycloidal, 6 mm, clockwise",
    ]


def test_designs_with_the_same_options_are_judged_in_one_call(monkeypatch):
    calls = []
    analyse = TranslatingRollerCam.analyse
    monkeypatch.setattr(TranslatingRollerCam, "analyse", lambda cam, n: calls.append(1) or analyse(cam, n))
    freed = study()
    freed.evaluate(np.random.default_rng(1).uniform(*freed.bounds, (200, 6)))
    assert len(calls) == 6  # 3 laws, 2 directions; sizes are a column


def test_a_bare_path_frees_all_options_and_paths_can_move_together():
    bare = Study(CAM, ("rotation", "motion.rise.law", "load.preload"), (peak_torque,))
    assert [*bare.menus[1].options] == [law.name for law in LAW_MENU if law not in HALF_LAWS]
    assert bare.declared["load.preload"].unit == "N"
    assert bare.declared["rotation"].text(bare.x0[0]) == "counter-clockwise"
    both = Study(CAM, {BOTH: {"soft": ModifiedSine(), "mixed": (Cycloidal(), "3-4-5 polynomial")}}, (peak_torque,))
    mixed = both.design([1])
    assert [value_of(mixed, path).name for path in BOTH] == ["cycloidal", "3-4-5 polynomial"]
    assert (both.x_of(mixed).tolist(), both.declared[", ".join(BOTH)].text(1)) == ([1.0], "mixed")
    assert both.replace(free=both.free).free == both.free == both.around(mixed).free


def tried(design, *paths):
    """The options of a menu that is free as a whole."""
    return {*freed(design, [paths])[", ".join(paths)].names}


def test_of_a_menu_that_is_free_as_a_whole_the_options_that_go_with_the_rest_are_tried():
    half, every = {law.name for law in HALF_LAWS}, {law.name for law in LAW_MENU}
    assert tried(DoorHandleCam(), "motion_law") == tried(HighSpeedCam(), "return_law") == every - half
    assert tried(CAM, "motion.rise.law", "motion.return.law") == every - half


def test_a_half_law_is_tried_where_its_neighbour_moves_as_it_does():
    straight = FreePolynomial((0,), (1,))
    lead = (Rise(30 * deg, 5 * mm, HALF_LAWS[0]), Rise(30 * deg, 10 * mm, straight, name="straight"))
    down = (Return(90 * deg, 15 * mm, Cycloidal()), Dwell(200 * deg))
    cam = CAM.replace(motion=MotionProgram((*lead, Rise(10 * deg, 0.0, Cycloidal(), name="rest"), *down)))
    assert tried(cam, "motion.rise.law") == {law.name for law in LAW_MENU}  # the straight piece strikes anyhow
    smooth = (*lead, Rise(30 * deg, 5 * mm, HALF_LAWS[1], name="out"), Return(90 * deg, 20 * mm, Cycloidal()))
    cam = CAM.replace(motion=MotionProgram((*smooth, Dwell(180 * deg))))
    assert tried(cam, "motion.rise.law") == {"half cycloidal from rest"}
    assert tried(cam, "motion.out.law") == {"half cycloidal to rest"}


def test_sizes_of_a_catalogue_move_together():
    tubes = standard_tubes()
    shaft = shaft_study()
    freed = shaft.freeing({("outer_diameter", "inner_diameter"): tubes})
    plain = shaft.evaluate(tubes)
    found = freed.evaluate(np.arange(len(tubes))[:, None])
    np.testing.assert_array_equal(found.f, plain.f)
    np.testing.assert_array_equal(found.g, plain.g)
    assert freed.menus[0].text(0) == "88.9 mm x 82.5 mm"
    assert freed.x_of(shaft.start.replace(outer_diameter=tubes[7, 0], inner_diameter=tubes[7, 1])).tolist() == [7]


def test_a_menu_of_a_part_that_an_option_brings():
    free = {
        "contact": ("not given", "along a line"),
        "contact.cam_material": ("45", "20Cr"),
        "contact.width": {0.01, 0.02},
    }
    freed = Study(TranslatingRollerCam(), free, (peak_torque,))
    assert [made.name for made in freed.options.each()] == [
        "not given",
        "along a line, 45, 10 mm",
        "along a line, 45, 20 mm",
        "along a line, 20Cr, 10 mm",
        "along a line, 20Cr, 20 mm",
    ]
    assert freed.rows([0, 1, 1]).tolist() == [[0, 0, 0]]
    pressed = freed.replace(minimise=(peak_pressure,)).evaluate([[0, 0, 0], [1, 1, 1]])
    assert pressed.feasible.tolist() == [False, True]  # without a contact there is no pressure
    assert pressed.x[1].tolist() == [1, 1, 1]
    assert (freed.design([0, 0, 0]).contact.name, freed.design([1, 1, 1]).contact.width) == ("not given", 0.02)


def test_an_option_that_cannot_be_built_is_infeasible_and_says_why():
    free = {"motion.rise.angle": {120 * deg, 240 * deg}, "base_radius": (20 * mm, 40 * mm), "rotation": (1, -1)}
    freed = Study(CAM, free, (max_pressure_angle,))
    found = freed.evaluate([[0, 30 * mm, 0], [1, 30 * mm, 0]])
    assert found.feasible.tolist() == [True, False]  # with what else there is more than a turn
    why = [made.why for made in freed.options.each()]
    assert (why[0], "take 420 deg of the turn" in why[2]) == ("", True), why
    with pytest.raises(ValueError, match="take 420 deg of the turn"):
        freed.design([1, 30 * mm, 0])


def test_freeing_refuses_what_has_no_effect():
    freed = study().freeing({"motion.rise.law": LAWS, "motion.rise.law.c0": (-0.2, 0.2), "rotation": (1, -1)})
    assert list(freed.free) == ["motion.rise.law", "motion.rise.law.c0", "rotation"]
    angle = study(minimise=(min_profile_radius,), at_most={}, at_least={})
    with pytest.raises(ValueError, match="the load spring rate has no effect"):
        angle.freeing({"motion.rise.law": LAWS, "load.spring_rate": {4e3, 8e3}})


@pytest.mark.parametrize(
    ("free", "sentence"),
    [
        ({"motion.rise.law": ("cyclodial",)}, "'cyclodial' is no option of the motion rise law; there are simple harm"),
        ({"motion.rise.law": ()}, "there is no option of the motion rise law; there must be one or more"),
        ({"motion.rise.law": (Cycloidal(), Cycloidal())}, "'cycloidal' is twice among the options of the motion rise"),
        (
            {"motion.rise.law": (ShapedLaw(), ShapedLaw(Cycloidal()))},
            "two options .* are called 'shaped'; give",
        ),
        ({"motion.rise.law": "cycloidal"}, "the options of the motion rise law are 'cycloidal'; they must be a tuple"),
        ({"rotation": (1, 3)}, "3 is no option of the rotation; there are counter-clockwise, clockwise"),
        ({"roller_radius": {8 * mm, -1 * mm}}, "one option of the roller radius is -1 mm; it must be"),
        ({"roller_radius": {"KR": "wide"}}, "one option of the roller radius is 'wide'; it must be"),
        (
            {("roller_radius", "contact.width"): ((0.01, 0.02, 0.03),)},
            "has 3 values for the roller radius, conta",
        ),
        ({"motion.rise.lawn": (Cycloidal(),)}, "'motion.rise.lawn' is no quantity of TranslatingRollerCam; near it"),
        ({"motion.rise.law": LAWS, "motion.rise.law.c7": (0, 1)}, "'motion.rise.law.c7' is no quantity"),
        ({"roller_radius": SIZES, ("roller_radius", "contact.width"): ((0.01, 0.02),)}, "frees 'roller_radius' twice"),
        (("rotation", "rotation"), "the study frees 'rotation' twice"),
        ({("contact.width", "contact.width"): ((0.01, 0.02),)}, "it must be paths, each of them once"),
        ({(): LAWS}, "it must be paths, each of them once"),
        ({"roller_radius": (0.006, 0.008, 0.01)}, "they must be two numbers; sizes to choose from stand in braces"),
        ((BOTH, ("roller_radius", "contact.width")), "the options of the roller radius, contact width are None; they"),
    ],
)
def test_what_is_no_menu_is_refused_in_a_sentence(free, sentence):
    with pytest.raises(ValueError, match=sentence):
        Study(CAM, free, (peak_pressure,))


def test_what_shows_numbers_refuses_menus():
    with pytest.raises(ValueError, match="the rotation is free as a menu; a sweep takes"):
        Sweep(study(free=("rotation",)))
    with pytest.raises(ValueError, match="the rotation is free as a menu; a plane takes"):
        DesignMap(study(free=("rotation", "base_radius"), minimise=(peak_torque,)))


def test_designs_with_different_options_are_no_population():
    freed = study()
    rows = np.tile(freed.x0, (2, 1))
    assert freed.design(rows).load.spring_rate.shape == (2, 1)
    rows[1, 0] = 1
    with pytest.raises(ValueError, match="different options"):
        freed.design(rows)


def test_a_start_beside_the_menu_stands_for_its_first_option():
    freed = study(start=with_quantities(CAM, {"motion.rise.law": Poly345()}))
    assert freed.x0[0] == 0
    menu = freed.menus[1]
    assert isinstance(menu, Menu)
    assert menu.nearest(np.array([[9 * mm], [11 * mm]])).tolist() == [1, 2]


def test_under_tolerances_an_option_is_judged_as_its_own_robust_study():
    tolerances = {"roller_radius": 0.05 * mm, "load.spring_rate": 300.0}
    freed = study(minimise=(peak_pressure,)).under(tolerances, yield_at_least=0.95)
    x = np.array([[0, 0, 1, 9e3, 0, 0], [1, 0, 2, 1.2e4, 1, 0], [2, 0.05, 0, 1.5e4, 0, 0.05], [1, 0, 2, 1e4, 1, 0]])
    found, margins, factors, checked = (
        freed.evaluate(x),
        freed.margins(x),
        freed.tolerance_factor(x),
        freed.recheck(x, 256),
    )
    for i, row in enumerate(x):
        alone = Study(by_hand(row), {"load.spring_rate": (4e3, 20e3)}, (peak_pressure,), freed.at_most, freed.at_least)
        one = alone.under(tolerances, yield_at_least=0.95)
        rate = [[row[3]]]
        np.testing.assert_allclose(found.f[i], one.evaluate(rate).f[0], rtol=1e-9)
        np.testing.assert_allclose(found.g[i], one.evaluate(rate).g[0], rtol=1e-7, atol=1e-9)
        np.testing.assert_allclose(margins[i], one.margins(rate)[0], rtol=1e-7, atol=1e-9)
        np.testing.assert_allclose(factors[i], one.tolerance_factor(rate)[0], rtol=1e-6)
        assert checked.share[i] == one.recheck(rate, 256).share[0]


def test_general_tolerances_are_those_of_numbers_and_sizes():
    halves = general_tolerances(study())
    assert list(halves) == ["roller_radius", "load.spring_rate"]  # no law, no direction, no coefficient of another law
    assert halves["roller_radius"] == general_tolerances(CAM)["roller_radius"]


def test_the_yield_of_no_designs_with_menus():
    none = study().under({"roller_radius": 0.05 * mm}).recheck(np.zeros((0, 6)))
    assert (none.share.shape, none.interval.shape, none.wanted) == ((0,), (0, 2), 0.99)


def test_a_tolerance_on_what_nothing_has_is_refused():
    with pytest.raises(ValueError, match=r"law\.c9"):
        study().under({"motion.rise.law.c9": 0.01})
