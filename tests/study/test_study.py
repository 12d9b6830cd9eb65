"""A study against a design simple enough to work out by hand: a tin can, its area, volume and slenderness."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import camkit
from camkit import Friction, Measure, Study, TranslatingRollerCam, minimise
from camkit.cam.measures import worst
from camkit.linkage import DoubleUniversalJoint
from camkit.linkage.load import RockerLoad
from camkit.linkage.measures import swing
from camkit.linkage.rssr import RSSR
from camkit.linkage.universal_joint import fluctuation
from camkit.motion import LAWS, Cycloidal, ShapedLaw
from camkit.quantities import Design, Quantity, declared_in, quantity, value_of, with_quantities
from camkit.study import weighted
from camkit.study.weighted import WeightedSum
from camkit.units import mm


@dataclass(frozen=True)
class TinCan(Design):
    """A closed cylinder; one that is taller than 1 m cannot be built."""

    radius: float = quantity("r", 50, 10, 100, "mm", "of the lid")
    height: float = quantity("h", 100, 20, 400, "mm", "between the lids")
    sheet: float = quantity("t", 0.2, 0.1, 1, "mm", "thickness of the sheet")

    def analyse(self, n=361):
        possible = np.asarray(self.height <= 1.0)
        if possible.ndim == 0 and not possible:
            raise ValueError("the can is too tall")
        h = np.where(possible, self.height, np.nan)
        along = np.linspace(0, 1, n) * h
        return {"r": self.radius + 0 * along, "h": h + 0 * along, "along": along}


area = Measure("area", "mm^2", lambda a: (2 * np.pi * a["r"] * (a["r"] + a["h"]))[..., 0])
volume = Measure("volume", "", lambda a: (np.pi * a["r"] ** 2 * a["h"])[..., 0])
slenderness = Measure("slenderness", "", lambda a: (a["h"] / a["r"])[..., 0])
reach = Measure("reach", "mm", lambda a: a["along"].max(-1))


def can_study(**changes):
    free = {"radius": (20 * mm, 80 * mm), "height": (30 * mm, 1.2)}
    return Study(TinCan(), free, (area, -volume), {slenderness: 4}, {reach: 40 * mm}).replace(**changes)


def test_a_bare_name_takes_the_range_that_its_declaration_gives():
    study = Study(TinCan(), ("radius", "sheet"), (area,))
    assert dict(study.free) == {"radius": (10 * mm, 100 * mm), "sheet": (0.1 * mm, 1 * mm)}
    assert_allclose(study.bounds, [[10 * mm, 0.1 * mm], [100 * mm, 1 * mm]])
    assert_allclose(study.x0, [50 * mm, 0.2 * mm])
    assert study.limits == ()


def test_bounds_and_limits_are_kept_as_they_are_given():
    study = can_study()
    assert_array_equal(study.bounds, [[20 * mm, 30 * mm], [80 * mm, 1.2]])
    assert study.limits == ((slenderness, 4, 1), (reach, 40 * mm, -1))


def test_a_design_comes_back_from_its_free_values():
    study = can_study()
    one = study.design([0.03, 0.2])
    assert one == TinCan(radius=0.03, height=0.2)
    assert type(one.radius) is float
    many = study.design(np.array([[0.03, 0.2], [0.04, 0.3]]))
    assert_array_equal(many.radius, [[0.03], [0.04]])
    assert many.sheet == TinCan().sheet
    assert study.design(study.x0) == study.start


def test_objectives_and_limits_are_the_measures():
    r, h = np.array([0.03, 0.04, 0.05]), np.array([0.2, 0.03, 0.1])
    evaluation = can_study().evaluate(np.stack([r, h], axis=1))
    assert_allclose(evaluation.f, np.transpose([2 * np.pi * r * (r + h), -np.pi * r**2 * h]), rtol=1e-12)
    assert_allclose(evaluation.g, np.transpose([(h / r - 4) / 4, (0.04 - h) / 0.04]), rtol=1e-12)
    assert evaluation.feasible.tolist() == [False, False, True]


def test_a_limit_of_zero_and_a_negative_limit_have_a_side_too():
    study = can_study(at_most={slenderness: 0}, at_least={-slenderness: -4})
    evaluation = study.evaluate([[0.05, 0.1], [0.02, 0.1]])
    assert_allclose(evaluation.g, [[2, -0.5], [5, 0.25]])


def test_a_limit_that_is_met_exactly_is_kept():
    assert can_study(at_most={slenderness: 2}).evaluate([50 * mm, 100 * mm]).feasible.all()


def test_what_cannot_be_built_is_infeasible_and_disturbs_nobody():
    study = can_study()
    rows = np.array([[0.05, 0.1], [0.05, 1.1], [np.nan, 0.1], [0.03, 0.1]])
    evaluation = study.evaluate(rows)
    assert evaluation.feasible.tolist() == [True, False, False, True]
    assert np.isinf(evaluation.f[1:3]).all()
    assert not np.isnan(evaluation.f).any()
    assert not np.isnan(evaluation.g).any()
    for i in (0, 3):
        assert_array_equal(evaluation.f[i], study.evaluate(rows[i]).f[0])
        assert_array_equal(evaluation.g[i], study.evaluate(rows[i]).g[0])


def test_a_study_without_limits_evaluates_to_no_limits():
    evaluation = Study(TinCan(), ("radius",), (area,)).evaluate([[0.05], [0.06]])
    assert evaluation.g.shape == (2, 0)
    assert evaluation.feasible.all()


def test_a_measure_that_does_not_depend_on_what_is_free_is_the_same_for_all():
    evaluation = Study(TinCan(), ("sheet",), (area,), {slenderness: 4}).evaluate([[1e-4], [2e-4], [3e-4]])
    assert evaluation.f.shape == evaluation.g.shape == (3, 1)
    assert len(set(evaluation.f[:, 0])) == 1


def test_angles_is_how_many_an_analysis_takes():
    assert can_study(angles=7).analysis(can_study().x0)["along"].shape == (7,)


positive = st.floats(0.01, 100)


@given(st.lists(st.tuples(positive, positive, positive), min_size=1, max_size=4))
@settings(deadline=None)
def test_a_weighted_sum_is_the_sum_of_shares(rows):
    weights, values, reference = zip(*rows, strict=True)
    parts = [Measure(f"part {i}", "", lambda a, i=i: a[i]) for i in range(len(rows))]
    both = weighted("sum", dict(zip(parts, weights, strict=True)), reference)
    expected = sum(w * v / r for w, v, r in rows)
    assert both(values) == pytest.approx(expected)
    assert both(reference) == pytest.approx(sum(weights))
    again = both.with_weights([2 * w for w in weights])
    assert again(values) == pytest.approx(2 * expected)
    assert (again.name, again.parts, again.reference) == (both.name, both.parts, both.reference)


def test_new_weights_change_weighted_sums_only():
    effort = weighted("effort", {area: 0.5, slenderness: 0.5}, (0.05, 2.0))
    study = can_study(minimise=(effort, -volume))
    other = study.with_weights((0.9, 0.1))
    assert isinstance(other.minimise[0], WeightedSum)
    assert other.minimise[0].weights == (0.9, 0.1)
    assert other.minimise[1] == study.minimise[1]
    assert study.minimise[0].weights == (0.5, 0.5)
    x = [[0.03, 0.2]]
    r, h = x[0]
    expected = 0.9 * 2 * np.pi * r * (r + h) / 0.05 + 0.1 * h / r / 2
    assert_allclose(other.evaluate(x).f[0, 0], expected)
    assert_array_equal(other.evaluate(x).f[0, 1], study.evaluate(x).f[0, 1])


def test_the_sign_of_a_weighted_sum_survives_new_weights():
    """``-effort`` is to be made large; so it must be after a judgement has changed."""
    effort = weighted("effort", {area: 1.0}, (1.0,))
    study = can_study(minimise=(-effort,))
    assert study.with_weights((1.0,)).evaluate(study.x0).f[0, 0] == study.evaluate(study.x0).f[0, 0]


@pytest.mark.parametrize(
    ("start", "given"),
    [
        (TinCan, "the class TinCan"),
        (RockerLoad(), "a RockerLoad"),
        (Friction(), "a Friction"),
        (None, "None"),
        ("a cam", "'a cam'"),
    ],
)
def test_what_cannot_be_analysed_is_refused(start, given) -> None:
    with pytest.raises(ValueError, match=r".") as said:
        Study(start, ("radius",), (area,))
    sentence = f"the start of the study is {given}; it must be a design that can be analysed, such as a cam"
    assert str(said.value) == sentence


def test_measures_of_another_mechanism_are_refused() -> None:
    joint, free = DoubleUniversalJoint(), ("second_angle",)
    with pytest.raises(
        ValueError,
        match=r"^the output swing does not apply to a DoubleUniversalJointAnalysis, which has no rocker angle$",
    ):
        Study(joint, free, (swing,)).evaluate([[0.1]])
    with pytest.raises(ValueError, match=r"^the output swing does not apply"):
        Study(joint, free, (fluctuation,), at_most={swing: 1.0}).evaluate([[0.1]])
    for method in ("slsqp", "de", "ga"):
        with pytest.raises(ValueError, match=r"^the output swing does not apply"):
            minimise(Study(joint, free, (swing,)), method)
    curve = Measure("speed", "rpm", lambda a: a.output_speed)
    for designs, told in (
        ([[0.1]], "1 x 361 numbers for one design"),
        ([[0.1], [0.2]], "2 x 361 numbers for 2 designs"),
    ):
        with pytest.raises(ValueError, match=rf"^the speed gives {told}; a measure"):
            Study(joint, free, (curve,)).evaluate(designs)


WINGS = (camkit.cam, camkit.linkage, camkit.machines)
DESIGNS = [
    thing for wing in WINGS for thing in vars(wing).values() if isinstance(thing, type) and issubclass(thing, Design)
]


@pytest.mark.parametrize("kind", [kind for kind in DESIGNS if hasattr(kind, "analyse") and kind is not RSSR])
def test_every_design_is_analysed_at_a_number_of_positions(kind) -> None:
    """What a study asks of a design: its measures are one number each, those of two designs two."""
    design = kind()
    path = next(path for path, q in declared_in(design).items() if isinstance(q, Quantity))
    many = with_quantities(design, {path: np.array([[value_of(design, path)]] * 2)})
    one, two = design.analyse(61), many.analyse(61)
    for measure in kind.measures:
        assert np.size(measure(one)) == 1, measure.name
        both = np.broadcast_to(measure(two), 2)
        assert both == pytest.approx([measure(one)] * 2, rel=1e-9, nan_ok=True), measure.name


# ---------------------------------------------------------------- what is taken for another thing


def height(analysis):
    return analysis.pitch_radius.max(-1)


def a_study(**changes):
    return Study(TranslatingRollerCam(), ["base_radius"], [Measure("height", "mm", height)], angles=31).replace(
        **changes
    )


@pytest.mark.parametrize("rotation", [np.uint8(1), np.int64(-1), np.float64(-1.0), np.True_])
def test_an_option_of_another_type_is_the_option_that_it_equals(rotation):
    """An unsigned number would turn the sign of an offset round; what is kept is the option itself."""
    meant = TranslatingRollerCam(rotation=int(rotation), offset=0.005)
    cam = TranslatingRollerCam(rotation=rotation, offset=0.005)
    assert type(cam.rotation) is int
    assert cam == meant
    assert_allclose(cam.analyse(31).profile, meant.analyse(31).profile, rtol=0, atol=0)


def test_a_quantity_is_free_once():
    with pytest.raises(ValueError, match="the study frees 'base_radius' twice"):
        a_study(free=["base_radius", "base_radius"])


@pytest.mark.parametrize("value", [np.ma.masked, 0.5 + 9j, "x"], ids=str)
def test_a_measure_gives_real_numbers(value):
    """Neither as an objective nor as a limit, which it would have kept."""
    odd = Measure("odd", "", lambda analysis: value)
    for study in (a_study(minimise=(odd,)), a_study(at_most={odd: 1.0})):
        with pytest.raises(ValueError, match=r"^the odd gives .*; a measure gives real numbers, one or an array$"):
            study.evaluate([[0.03]])


@pytest.mark.parametrize(
    ("cam", "path", "stress"),
    [
        (TranslatingRollerCam(), "motion.rise.law", camkit.cam.peak_torque),
        (camkit.OscillatingFlatCam(), "motion.return.law", camkit.cam.peak_torque),
        (camkit.DoorHandleCam(), "motion_law", worst(camkit.cam.peak_torque, ("lift", "relief"))),
    ],
)
def test_a_law_that_lacks_what_is_free_is_shaped(cam, path, stress):
    """Whatever law a menu chooses: it stays what it is, and coefficients can move it from there."""
    study = Study(with_quantities(cam, {path: "shaped"}), [f"{path}.c0"], [stress])
    for law in LAWS[2:]:
        chosen = with_quantities(cam, {path: law})
        ready = study.around(chosen)
        assert value_of(ready.start, path) == ShapedLaw(law)
        assert ready.x0 == [0.0]
        assert stress(ready.start.analyse(31)) == stress(chosen.analyse(31))
    assert study.around(study.start) == study
    assert study.around(cam).freeing({f"{path}.c1": (-0.1, 0.1)}).x0 == [0.0]


def test_a_law_that_is_a_function_is_shaped_as_any_other():
    cam = with_quantities(TranslatingRollerCam(), {"motion.rise.law": "shaped"})
    study = Study(cam, ["motion.rise.law.c0"], [camkit.cam.max_pressure_angle])
    other = with_quantities(cam, {"motion.rise.law": Cycloidal().at})
    around = study.around(other)
    assert around.start.motion.segments[0].law.base == other.motion.segments[0].law
    assert around.evaluate(around.x0).f == pytest.approx(study.evaluate(study.x0).f, rel=1e-12)


def test_a_study_goes_around_another_design():
    """Objectives, limits and bounds stay; what is not free is the other design's."""
    study, other = can_study(), TinCan(radius=30 * mm, height=90 * mm, sheet=0.4 * mm)
    moved = study.around(other)
    assert_allclose(moved.x0, [30 * mm, 90 * mm])
    assert moved.design([40 * mm, 50 * mm]).sheet == 0.4 * mm
    assert (moved.minimise, moved.limits, moved.free) == (study.minimise, study.limits, study.free)
    assert study.around(other, study.x0).start == TinCan(sheet=0.4 * mm)
    assert study.start == TinCan()
    with pytest.raises(ValueError, match=r"^the design is a TranslatingRollerCam; it must be a TinCan$"):
        study.around(TranslatingRollerCam())


def test_an_objective_stands_once_and_not_against_its_opposite():
    """Else every design were on the front; a measure of the same name is the same to files, reports and judgements."""
    with pytest.raises(ValueError, match=r"^the study minimises the .* twice; each measure can be an objective once$"):
        can_study().replace(minimise=(area, volume, replace(area, function=volume.function)))
    with pytest.raises(ValueError, match=r"^the study minimises the volume and its opposite; .* no design would be "):
        can_study().replace(minimise=(volume, area, -volume))
    assert can_study().replace(minimise=(-area, volume), at_most={area: 1.0}).minimise == (-area, volume)


def test_a_study_frees_other_quantities():
    freed = can_study().freeing({"height": (50 * mm, 60 * mm)})
    assert dict(freed.free) == {"height": (50 * mm, 60 * mm)}
    assert list(can_study().freeing(["height", "radius"]).free) == ["height", "radius"]


def test_what_changes_nothing_that_is_judged_may_not_be_free():
    sentence = r"^the sheet has no effect on what the study judges; it must not be free$"
    for free in (["sheet"], ["radius", "sheet"], ["sheet", "height"]):
        with pytest.raises(ValueError, match=sentence):
            can_study().freeing(free)
    thick = Measure("thick", "mm", lambda a: np.maximum(a["r"], 95 * mm)[..., 0])
    assert can_study(minimise=(thick,), at_most={}, at_least={}).freeing(["radius"])  # where it is large
    assert can_study().freeing({"height": (1.1, 1.2)})  # of what cannot be built nothing is known


def test_bounds_are_kept_as_numbers_however_they_are_given() -> None:
    cam, goal = TranslatingRollerCam(), (Measure("radius", "mm", lambda a: a.cam.base_radius),)
    pair = (30 * mm, 40 * mm)
    given = [Study(cam, {"base_radius": bounds}, goal) for bounds in (pair, list(pair), np.array(pair))]
    assert given[0] == given[1] == given[2]
