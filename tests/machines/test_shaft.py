"""The double universal-joint shaft of Lyu, Du, Li, Yuan, Luo (Guangdong University of Technology, 2007)."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize

from camkit.data import load
from camkit.linkage.universal_joint import UniversalJoint, peak_torque
from camkit.machines.shaft import (
    MARGINS,
    MATERIALS,
    SHAFT_MEASURES,
    TUBE_FILES,
    UTILISATIONS,
    UniversalJointShaft,
    lightest_shaft,
    lightest_tube,
    nearest_tube,
    shaft_study,
    standard_tubes,
    tube_area,
    tubes_that_hold,
    twist_utilisation,
)
from camkit.quantities import declarations, words
from camkit.study.design_map import DesignMap
from camkit.study.study import Study
from camkit.units import GPa, MPa, deg, kW, m, mm, rpm

PRINTED = load("double_universal_joint_shaft")


def tube(D: float, d: float, **data: float) -> UniversalJointShaft:
    return UniversalJointShaft(outer_diameter=D * mm, inner_diameter=d * mm, **data)


# D, d, then area mm^2, shear stress MPa, twist deg/m, critical speed rpm, buckling stress GPa: Table 1 put right
TABLE_1 = (
    (128, 98, 5325.000, 83.564, 0.94219, 2974.7, 6.825),
    (129, 101, 5057.964, 85.842, 0.96038, 3023.2, 6.083),
    (128.64, 101.78, 4860.893, 88.856, 0.99688, 3026.9, 5.739),
)


@pytest.mark.parametrize(("D", "d", "area", "stress", "twist", "speed", "buckling"), TABLE_1)
def test_table_1(D, d, area, stress, twist, speed, buckling) -> None:
    a = tube(D, d).analyse()
    assert a.area / mm**2 == pytest.approx(area, abs=5e-4)
    assert a.shear_stress / MPa == pytest.approx(stress, abs=5e-4)
    assert a.twist / (deg / m) == pytest.approx(twist, abs=5e-6)
    assert a.critical_speed / rpm == pytest.approx(speed, abs=0.05)
    assert a.buckling_stress / GPa == pytest.approx(buckling, abs=5e-4)
    assert all(use <= 1 for use in a.utilisation.values())


def test_what_the_paper_misprints() -> None:
    rows = {row["method"]: row for row in PRINTED["table_1"]}
    computed = {
        method: tube(row["outer_diameter"], row["inner_diameter"]).analyse().area / mm**2
        for method, row in rows.items()
    }
    assert computed["penalty method"] == pytest.approx(rows["penalty method"]["area"], abs=1e-3)
    for method, digit in (("genetic algorithm", 1), ("competitive algorithm", 0.01)):
        assert computed[method] * 3.14 / np.pi == pytest.approx(rows[method]["area"], abs=digit / 2)
    for slip in PRINTED["misprints"][:2]:
        assert slip["correct"] == pytest.approx(computed[slip["where"].removeprefix("Table 1, ")], abs=0.005)


def test_torque_in_both_unit_systems() -> None:
    shaft = UniversalJointShaft()
    assert shaft.torque == pytest.approx(22586.0429, abs=5e-5)
    assert shaft.torque == pytest.approx(9550 * 1.5 * 257 / 163, rel=1e-14)
    exact = 1.5 * 257e3 / (163 * 2 * np.pi / 60)
    assert shaft.torque / exact == pytest.approx(9550 * np.pi / 30000, rel=1e-14)
    assert shaft.torque / exact - 1 == pytest.approx(7.4e-5, abs=5e-7)


def test_polar_moment_is_the_integral_of_r_squared() -> None:
    a = tube(128, 98).analyse()
    polar, _ = quad(lambda r: 2 * np.pi * r * r**2, 0.049, 0.064)
    area, _ = quad(lambda r: 2 * np.pi * r, 0.049, 0.064)
    assert (a.polar_moment, a.area) == pytest.approx((polar, area), rel=1e-12)
    assert a.mass == pytest.approx(7850 * 2.41 * area, rel=1e-12)
    assert a.inertia == pytest.approx(7850 * 2.41 * polar, rel=1e-12)


def test_shear_stress_balances_the_torque() -> None:
    """Stress grows with the radius; its moment over the section is the torque."""
    a = tube(128.64, 101.78).analyse()
    moment, _ = quad(lambda r: a.shear_stress * r / 0.06432 * r * 2 * np.pi * r, 0.05089, 0.06432)
    assert moment == pytest.approx(a.shaft.torque, rel=1e-12)


@pytest.mark.parametrize("size", [(128, 98), (108, 103), (140, 87)])
def test_stress_is_twist_times_shear_modulus_times_radius(size) -> None:
    """The paper's ``tau = theta pi G D / 360`` with the twist in deg/m."""
    a = tube(*size).analyse()
    D, G = a.shaft.outer_diameter, a.shaft.shear_modulus
    assert a.shear_stress == pytest.approx(a.twist / (deg / m) * np.pi * G * D / 360, rel=1e-12)


def sag(a, n: int = 20001) -> float:
    """Of a beam on two supports under its own weight, by integrating ``E I y'' = -M`` twice."""
    s = a.shaft
    x = np.linspace(0, s.length, n)
    weight = s.density * a.area * 9.81
    bend = weight * x * (s.length - x) / 2 / (s.elastic_modulus * a.polar_moment / 2)
    step = x[1]
    slope = np.concatenate([[0], np.cumsum((bend[1:] + bend[:-1]) / 2) * step])
    y = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2) * step])
    return float((x / s.length * y[-1] - y)[n // 2])


def test_critical_speed_follows_from_the_sag_with_384_not_348() -> None:
    a = tube(128, 98).analyse()
    assert a.critical_speed == pytest.approx(np.sqrt(9.81 / sag(a)), rel=1e-7)
    assert a.critical_speed * np.sqrt(348 / 384) / rpm == pytest.approx(2831.9, abs=0.1)


def test_critical_speed_is_below_the_exact_one_of_a_beam_on_two_supports() -> None:
    a = tube(128, 98).analyse()
    s = a.shaft
    exact = np.pi**2 * np.sqrt(s.elastic_modulus * a.polar_moment / 2 / (s.density * a.area * s.length**4))
    assert a.critical_speed / exact == pytest.approx(np.sqrt(76.8) / np.pi**2, rel=1e-12)
    assert a.critical_speed / exact == pytest.approx(0.888, abs=5e-4)


def test_buckling_stress_is_that_of_a_long_tube_in_torsion() -> None:
    """Timoshenko, Gere, Theory of Elastic Stability: 0.272 E (t/r)^1.5 / (1 - nu^2)^0.75, nu = 0.3."""
    a = tube(128, 98).analyse()
    assert a.buckling_stress == pytest.approx(0.272 * 206e9 * (15 / 64) ** 1.5 / (1 - 0.3**2) ** 0.75, rel=1e-3)


def test_the_optimum_in_closed_form() -> None:
    best = lightest_shaft()
    D = (32 * 180 * best.torque / (np.pi**2 * best.shear_modulus * 1) + best.inner_diameter**4) ** 0.25
    assert best.outer_diameter == pytest.approx(D, rel=1e-14)
    assert best.outer_diameter / mm == pytest.approx(129.190698, abs=5e-7)
    assert best.inner_diameter / mm == 103
    a = best.analyse()
    assert a.area / mm**2 == pytest.approx(4776.191895, abs=5e-7)
    assert a.utilisation["twist"] == pytest.approx(1, abs=1e-14)
    assert 1 - a.area / tube(128.64, 101.78).analyse().area == pytest.approx(0.0174, abs=5e-5)


@pytest.mark.parametrize(("angle", "used"), [(0, 1), (15, 1.035), (20, 1.064), (40, 1.305)])
def test_the_tube_behind_a_joint_carries_more(angle, used) -> None:
    """The lightest tube of the paper takes 103.5 and 106.4 % of its twist behind 15 and 20 deg; another holds."""
    blind = lightest_shaft().replace(joint_angle=angle * deg).analyse()
    assert blind.utilisation["twist"] == pytest.approx(used, abs=5e-4)
    joint = UniversalJoint(angle=angle * deg, torque=blind.shaft.torque).analyse(721)
    assert blind.tube_torque == pytest.approx(peak_torque(joint), rel=1e-12)
    if angle < 40:
        best = lightest_shaft(UniversalJointShaft(joint_angle=angle * deg))
        a = best.analyse()
        twist = peak_torque(joint) * best.length / (best.shear_modulus * a.polar_moment)
        assert twist / best.length == pytest.approx(best.allowable_twist, rel=1e-12)
        searched = DesignMap(shaft_study(best)).best
        assert (best.outer_diameter, best.inner_diameter) == pytest.approx(tuple(searched), rel=1e-7)


@pytest.mark.parametrize("angle", [61, 75, 89])
def test_a_steep_joint_turns_as_long_as_it_is_below_a_right_angle(angle) -> None:
    """One and a member of a population; `test_refuses_a_joint_that_cannot_turn` has 90 deg."""
    one = UniversalJointShaft(joint_angle=angle * deg).analyse()
    assert one.tube_torque * np.cos(angle * deg) == pytest.approx(one.shaft.torque)
    two = UniversalJointShaft(joint_angle=np.array([[angle], [angle + 90]]) * deg).analyse()
    assert two.tube_torque[:, 0] == pytest.approx([one.tube_torque, np.nan], nan_ok=True)


def test_standard_tubes_hold_the_torque_behind_the_joint() -> None:
    straight = UniversalJointShaft()
    bent = straight.replace(joint_angle=40 * deg)
    assert len(tubes_that_hold(bent, standard_tubes())) < len(tubes_that_hold(straight, standard_tubes()))
    thicker = nearest_tube(bent, standard_tubes("GB/T 17395"))
    assert thicker.analyse().area > nearest_tube(straight, standard_tubes("GB/T 17395")).analyse().area
    power = bent.replace(joint_angle=0.0, power=bent.power / np.cos(40 * deg))
    assert tubes_that_hold(bent, standard_tubes()).tolist() == tubes_that_hold(power, standard_tubes()).tolist()


def test_the_optimum_by_brute_force() -> None:
    """Along the twist limit the area falls all the way to the widest bore, and a fine grid finds nothing lighter."""
    shaft, best = UniversalJointShaft(), lightest_shaft().analyse().area
    d = np.linspace(87, 103, 1601)[:, None] * mm
    border = shaft.replace(outer_diameter=shaft.stiff_diameter(d), inner_diameter=d).analyse()
    assert np.allclose(border.utilisation["twist"], 1)
    assert (np.diff(border.area[:, 0]) < 0).all()
    D, d = (v.ravel() for v in np.meshgrid(np.linspace(108, 140, 641), np.linspace(87, 103, 321)))
    evaluation = shaft_study().evaluate(np.stack([D, d], -1) * mm)
    lightest = evaluation.f[evaluation.feasible].min()
    assert best <= lightest < best * 1.005


def test_the_optimum_by_slsqp() -> None:
    study = shaft_study()
    found = minimize(
        lambda x: study.evaluate(x / 1e3).f[0, 0] * 1e3,
        (120, 90),
        method="SLSQP",
        bounds=[(108, 140), (87, 103)],
        constraints={"type": "ineq", "fun": lambda x: -study.evaluate(x / 1e3).g[0]},
        options={"ftol": 1e-12},
    )
    assert found.x == pytest.approx((129.190698, 103), abs=1e-4)


def test_the_best_whole_millimetres_by_enumeration() -> None:
    D, d = (v.ravel() for v in np.meshgrid(np.arange(108, 141), np.arange(87, 104)))
    study = shaft_study()
    evaluation = study.evaluate(np.stack([D, d], -1) * mm)
    best = np.argmin(np.where(evaluation.feasible, evaluation.f[:, 0], np.inf))
    assert (D[best], d[best]) == (129, 102)
    assert evaluation.f[best, 0] / mm**2 == pytest.approx(4898.53, abs=5e-3)


def test_only_the_twist_matters_in_the_papers_box() -> None:
    """Stress, critical speed and buckling are redundant: a stiff tube keeps them everywhere."""
    shaft = UniversalJointShaft()
    assert shaft.twist_governs_below / mm == pytest.approx(141.435, abs=5e-4)
    D, d = np.meshgrid(np.linspace(108, 140, 65), np.linspace(87, 103, 33))
    a = shaft.replace(outer_diameter=D.reshape(-1, 1) * mm, inner_diameter=d.reshape(-1, 1) * mm).analyse()
    stiff = a.utilisation["twist"] <= 1
    assert stiff.any()
    assert not stiff.all()
    assert (a.utilisation["shear stress"][stiff] < 1).all()
    assert a.utilisation["critical speed"].max() < 0.59
    assert a.utilisation["buckling"][stiff].max() < 0.016


def test_stress_and_twist_limits_meet_where_the_twist_stops_governing() -> None:
    shaft = UniversalJointShaft()
    D = shaft.twist_governs_below
    d = brentq(lambda d: shaft.stiff_diameter(d) - D, 0.08, 0.14, xtol=1e-16)
    a = shaft.replace(outer_diameter=D, inner_diameter=d).analyse()
    assert (a.utilisation["twist"], a.utilisation["shear stress"]) == pytest.approx((1, 1), abs=1e-12)


@pytest.mark.parametrize("power", [20, 30, 60, 257, 420, 430, 490])
def test_the_closed_form_keeps_the_bounds(power) -> None:
    """Where the bounds cut the twist's curve, and where not: it is what a search within the same bounds finds."""
    shaft = UniversalJointShaft(power=power * kW)
    best = lightest_shaft(shaft)
    searched = DesignMap(shaft_study(shaft)).best
    assert (best.outer_diameter, best.inner_diameter) == pytest.approx(tuple(searched), rel=1e-7)
    ends = {20: (108, 103), 30: (108, 103), 430: (140, None), 490: (140, None)}.get(power, (None, 103))
    for value, end in zip((best.outer_diameter, best.inner_diameter), ends, strict=True):
        assert end is None or value / mm == pytest.approx(end, rel=1e-12)


def test_the_closed_form_refuses_where_another_limit_governs() -> None:
    wider = {"outer_diameter": (108 * mm, 150 * mm), "inner_diameter": (87 * mm, 130 * mm)}
    with pytest.raises(
        ValueError, match=r"^the lightest tube that keeps the twist takes 103\.1 % of its limit on shear stress"
    ):
        lightest_shaft(space=wider)
    with pytest.raises(
        ValueError, match=r"of its limit on critical speed; the closed form holds where the twist governs$"
    ):
        lightest_shaft(UniversalJointShaft(max_speed=2500 * rpm))


@pytest.mark.parametrize("power", [520, 560, 600])
def test_the_closed_form_refuses_where_no_tube_within_the_bounds_is_stiff_enough(power) -> None:
    shaft = UniversalJointShaft(power=power * kW)
    use = shaft.replace(outer_diameter=140 * mm, inner_diameter=87 * mm).analyse().utilisation["twist"]
    with pytest.raises(ValueError, match=r".") as said:
        lightest_shaft(shaft)
    assert str(said.value) == (
        "even the stiffest tube within the bounds, 140 mm outside and 87 mm inside, "
        f"takes {100 * use:.4g} % of its limit on twist"
    )
    np.testing.assert_array_equal(shaft.analyse().sizes.closed_form, [np.nan, np.nan])
    assert np.isnan(shaft.analyse().sizes.plane.best).all()


def test_the_sizes_are_found_once_for_all_tubes_of_a_shaft() -> None:
    sizes = tube(128, 98).analyse().sizes
    assert tube(260, 200).analyse().sizes is sizes
    other = tube(128, 98, length=3.0).analyse().sizes
    assert (other.shaft.length, sizes.shaft.length) == (3.0, 2.41)


def test_a_population_equals_its_members() -> None:
    sizes = np.random.default_rng(1).uniform((108, 87), (140, 103), (20, 2)) * mm
    study = shaft_study(UniversalJointShaft(power=300 * kW))
    together = study.analysis(sizes)
    for measure in SHAFT_MEASURES:
        alone = [measure(study.analysis(size)) for size in sizes]
        assert measure(together) == pytest.approx(alone, rel=1e-13), measure.name


def test_what_a_population_cannot_build_is_nan_alone() -> None:
    shaft = UniversalJointShaft(
        outer_diameter=np.array([[128.0], [100.0], [-128.0], [np.nan]]) * mm, inner_diameter=np.full((4, 1), 101 * mm)
    )
    area = tube_area(shaft.analyse())
    assert area[0] == tube_area(tube(128, 101).analyse())
    assert np.isnan(area[1:]).all()
    lengths = UniversalJointShaft(length=np.array([[2.0], [-1.0], [0.0]]))
    assert np.isfinite(tube_area(lengths.analyse())).tolist() == [True, False, False]
    assert np.isfinite(tube_area(UniversalJointShaft(max_speed=np.array([[100.0], [1.0]])).analyse())).tolist() == [
        True,
        False,
    ]


def test_margins_are_what_utilisations_leave() -> None:
    a = tube(128, 98).analyse()
    assert [margin(a) for margin in MARGINS] == pytest.approx([1 - use(a) for use in UTILISATIONS], abs=1e-15)
    assert [margin.name for margin in MARGINS] == [
        "margin of the shear stress",
        "margin of the twist",
        "margin of the critical speed",
        "margin of the buckling stress",
    ]
    assert [use(a) for use in UTILISATIONS] == list(a.utilisation.values())
    assert a.utilisation["critical speed"] == pytest.approx(1.5 * 1000 / 2974.7, abs=1e-5)


def refusal(**change: float) -> str:
    with pytest.raises(ValueError, match=r".") as said:
        UniversalJointShaft(**change)
    return str(said.value)


@pytest.mark.parametrize("inner", [130 * mm, 128.64 * mm])
def test_refuses_a_bore_as_wide_as_the_tube(inner) -> None:
    said = refusal(inner_diameter=inner)
    assert said == (f"the inner diameter is {inner / mm:.6g} mm; it must be below the outer diameter of 128.64 mm")


@pytest.mark.parametrize("name", [n for n in declarations(UniversalJointShaft) if n != "joint_angle"])
@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_refuses_what_is_not_positive(name, value) -> None:
    declared = declarations(UniversalJointShaft)[name]
    unit = f" {declared.unit}".rstrip()
    assert refusal(**{name: value}) == (
        f"the {words(name)} ({declared.meaning}) is {declared.text(value)}; it must be a finite number above 0{unit}"
    )


def test_refuses_speeds_in_the_wrong_order() -> None:
    assert refusal(max_speed=100 * rpm) == (
        "the lowest speed is 163 rpm; it must not be above the highest speed of 100 rpm"
    )


def test_refuses_a_joint_that_cannot_turn() -> None:
    assert refusal(joint_angle=90 * deg) == "the joint angle is 90 deg; a universal joint turns below 90 deg only"
    assert refusal(joint_angle=-1 * deg) == (
        "the joint angle (of the joint before the tube; the paper: none) is -1 deg; "
        "it must be a finite number of at least 0 deg"
    )
    angles = UniversalJointShaft(joint_angle=np.array([[0.0], [95.0], [-5.0]]) * deg)
    assert np.isfinite(tube_area(angles.analyse())).tolist() == [True, False, False]


def test_refuses_reversed_bounds() -> None:
    with pytest.raises(ValueError, match=r".") as said:
        shaft_study(space={"outer_diameter": (140 * mm, 108 * mm), "inner_diameter": (87 * mm, 103 * mm)})
    assert str(said.value) == (
        "the bounds of the outer diameter are 140 mm and 108 mm; they must be finite, the first below the second"
    )


def test_the_study_is_the_papers() -> None:
    study = shaft_study()
    assert isinstance(study, Study)
    assert (study.bounds / mm).round(9).tolist() == [[108, 87], [140, 103]]
    ranges = [(q.low, q.high) for q in list(declarations(study.start).values())[:2]]
    assert ranges == [(108, 140), (87, 103)]
    assert study.evaluate(study.x0).feasible.tolist() == [True]
    assert twist_utilisation(study.analysis(study.x0)) == pytest.approx(0.99688, abs=5e-6)


def test_materials_have_sources_and_change_the_shaft() -> None:
    assert MATERIALS["20Cr"].allowable_shear == pytest.approx(98 * MPa)
    for material in MATERIALS.values():
        assert "yield" in material.source
        poisson = material.elastic_modulus / (2 * material.shear_modulus) - 1
        assert 0.28 < poisson < 0.34, material.name
    same = UniversalJointShaft().made_of("20Cr")
    assert same.analyse().utilisation == pytest.approx(UniversalJointShaft().analyse().utilisation)
    light = UniversalJointShaft().made_of("EN AW-6082 T6")
    assert light.analyse().mass / same.analyse().mass == pytest.approx(2700 / 7850)
    assert light.analyse().twist / same.analyse().twist == pytest.approx(79.4 / 27)
    with pytest.raises(ValueError, match=r"^the material 'tin' is not known; there are 20Cr, 45, 40Cr,"):
        UniversalJointShaft().made_of("tin")


@pytest.mark.parametrize("series", TUBE_FILES)
def test_standard_tubes_name_their_source_and_can_be_made(series) -> None:
    data = load(TUBE_FILES[series])
    assert data["name"] == series
    assert series.removesuffix("-2") in data["source"]
    if series == "EN 10210-2":
        assert data["checked_against"].startswith("two public tables")
    else:
        assert (data["checked_against"], data["source"][:15]) == (None, "no public table")
    sizes = standard_tubes(series)
    assert (sizes[:, 1] > 0).all()
    assert (sizes[:, 1] < sizes[:, 0]).all()
    assert len(np.unique(sizes, axis=0)) == len(sizes)


def test_sizes_that_en_10210_prints() -> None:
    """Mass per metre of two sizes as EN 10210-2:2006, Table B.1 prints it: 139.7 x 10 and 114.3 x 6.3."""
    sizes = (standard_tubes() / mm).round(6).tolist()
    for D, t, mass in ((139.7, 10, 32.0), (114.3, 6.3, 16.8)):
        assert [D, round(D - 2 * t, 6)] in sizes
        assert tube(D, D - 2 * t, length=1.0).analyse().mass == pytest.approx(mass, abs=0.05)


@pytest.mark.parametrize("series", TUBE_FILES)
def test_nearest_tube_by_brute_force(series) -> None:
    near = tube(130, 102, power=100 * kW)
    found = nearest_tube(near, standard_tubes(series))
    sizes = [near.replace(outer_diameter=D, inner_diameter=d) for D, d in standard_tubes(series).tolist()]
    holding = [size for size in sizes if max(size.analyse().utilisation.values()) <= 1]
    assert 0 < len(holding) < len(sizes)
    gaps = [np.hypot(s.outer_diameter - 0.130, s.inner_diameter - 0.102) for s in holding]
    assert np.hypot(found.outer_diameter - 0.130, found.inner_diameter - 0.102) == pytest.approx(min(gaps), rel=1e-9)
    assert found in holding


def test_the_nearest_tube_breaks_no_limit() -> None:
    """127 x 101 mm lies nearer to the paper's tube, and twists by 6 % too much."""
    assert tube(127, 101).analyse().utilisation["twist"] == pytest.approx(1.064, abs=5e-4)
    seamless, hot = (nearest_tube(UniversalJointShaft(), standard_tubes(s)) for s in ("GB/T 17395", "EN 10210-2"))
    assert (seamless.outer_diameter / mm, seamless.inner_diameter / mm) == pytest.approx((133, 101))
    assert (hot.outer_diameter / mm, hot.inner_diameter / mm) == pytest.approx((139.7, 114.7))
    weak = UniversalJointShaft(max_speed=5000 * rpm, length=5.0)
    with pytest.raises(ValueError, match=r"^none of the 75 standard tubes keeps every limit$"):
        nearest_tube(weak, standard_tubes())
    assert np.isnan(list(weak.analyse().rings.values())[1:]).all()
    rings = weak.replace(length=2.41, max_speed=1000 * rpm).analyse().rings
    for found in (hot, seamless):
        assert any((ring == found.analyse().here).all() for ring in rings.values())
    np.testing.assert_array_equal(rings["this tube"], weak.analyse().here)


def test_lightest_standard_tube() -> None:
    seamless = lightest_tube(shaft_study(), standard_tubes("GB/T 17395"))
    assert (seamless.outer_diameter / mm, seamless.inner_diameter / mm) == pytest.approx((127, 97))
    space = {"outer_diameter": (108 * mm, 140 * mm), "inner_diameter": (87 * mm, 130 * mm)}
    hot_finished = lightest_tube(shaft_study(space=space), standard_tubes())
    assert (hot_finished.outer_diameter / mm, hot_finished.inner_diameter / mm) == pytest.approx((139.7, 119.7))
    with pytest.raises(ValueError, match=r".") as said:
        lightest_tube(shaft_study(), standard_tubes())
    assert str(said.value) == (
        "none of the 3 standard tubes within 108 to 140 mm outside and 87 to 103 mm inside keeps every limit"
    )
    with pytest.raises(ValueError, match=r"^the series 'DIN' is not known; there are EN 10210-2, GB/T 17395$"):
        standard_tubes("DIN")


def test_the_wide_space_holds_bores_wider_than_tubes_as_infeasible() -> None:
    wide = {"outer_diameter": (60 * mm, 300 * mm), "inner_diameter": (20 * mm, 290 * mm)}
    evaluation = shaft_study(space=wide).evaluate([[100 * mm, 200 * mm], [200 * mm, 100 * mm]])
    assert evaluation.feasible.tolist() == [False, True]
    assert np.isinf(evaluation.f[0]).all()
