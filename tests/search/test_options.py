"""Searches through menus against all options gone through by hand."""

from itertools import product

import numpy as np
import pytest

from camkit import (
    Cycloidal,
    Measure,
    ModifiedSine,
    Poly345,
    Study,
    TranslatingRollerCam,
    deg,
    minimise,
    mm,
    nsga2,
    quick_front,
    rpm,
    shaft_study,
)
from camkit.cam import (
    ContactPair,
    base_radius,
    max_pressure_angle,
    min_force,
    peak_pressure,
    peak_torque,
    track_rollers,
)
from camkit.machines import standard_tubes
from camkit.machines.shaft import tubes_that_hold
from camkit.motion import Poly4567, ShapedLaw
from camkit.quantities import with_quantities
from camkit.search import dominated, search, trade_off

BOTH = ("motion.rise.law", "motion.return.law")
SPRING = {"load.spring_rate": (0.0, 50e3), "load.preload": (0.0, 1000.0)}
LIMITS = {"at_most": {max_pressure_angle: 25 * deg}, "at_least": {min_force: 10.0}}
FAST = with_quantities(TranslatingRollerCam(contact=ContactPair()), {"load.speed": 1200 * rpm})
"""Rise 20 mm in 120 deg, dwell 60 deg, return in 120 deg; base radius 30 mm, roller 8 mm and 15 mm wide, 0.5 kg."""


def test_the_reference_case_finds_each_law_and_the_winner():
    coefficients = {f"{law}.c{i}": (-0.6, 0.6) for law in BOTH for i in range(4)}
    laws = {law.name: law for law in (Poly4567(), Cycloidal(), ModifiedSine())} | {"degree 9": ShapedLaw(Poly345())}
    study = Study(FAST, {BOTH: laws, **SPRING, **coefficients}, (peak_pressure,), **LIMITS)
    best = minimise(study)
    assert {r.name: round(r.f[0] / 1e6) for r in best.options} == {
        "4-5-6-7 polynomial": 334,
        "cycloidal": 306,
        "modified sine": 276,
        "degree 9": 260,
    }
    assert best.feasible
    assert best.evaluations < 2000  # half a second; 420 when this was written
    assert best.f == best.options[3].f[0]
    assert study.menus[0].text(best.x[0]) == "degree 9"
    assert "Best of 4 options: degree 9; then modified sine 275.9 MPa; cycloidal 305.6 MPa; 4-5-6-7" in best.message
    for law, reached in zip(laws.values(), best.options, strict=True):  # each alone, as one would without menus
        alone = Study(with_quantities(FAST, dict.fromkeys(BOTH, law)), SPRING, (peak_pressure,), **LIMITS)
        if reached.name != "degree 9":
            assert minimise(alone).f == pytest.approx(reached.f[0], rel=1e-4)
    exact = study.design(best.x).analyse(7200)
    assert float(peak_pressure(exact)) == pytest.approx(best.f, rel=1e-3)


def _strain(analysis):
    """Differs with law, roller and direction."""
    return peak_pressure(analysis) / 4e8 + peak_torque(analysis) / 5 + max_pressure_angle(analysis)


STRAIN = Measure("strain", "", _strain)
FEW = {BOTH: (Cycloidal(), ModifiedSine()), "rotation": (1, -1), "base_radius": (20 * mm, 50 * mm)}


def cheap(**changes):
    """A quick study: two laws, three rollers, two directions, and the base radius."""
    free = {
        BOTH: (Cycloidal(), ModifiedSine()),
        "roller_radius": {6 * mm, 8 * mm, 11 * mm},
        "rotation": ("counter-clockwise", "clockwise"),
        "base_radius": (20 * mm, 50 * mm),
    }
    uneven = {"motion.return.angle": 150 * deg, "offset": 6 * mm, "load.spring_rate": 15e3, "load.preload": 60.0}
    cam = with_quantities(FAST, uneven)
    given = {"free": free, "minimise": (STRAIN,), "at_most": {max_pressure_angle: 26 * deg}, "angles": 181}
    return Study(cam, **{**given, **changes})


def all_by_hand(study, n=61):
    """What a study says of every option at ``n`` base radii."""
    places = [(*p, r) for p in product(range(2), range(3), range(2)) for r in np.linspace(0.02, 0.05, n)]
    return study.evaluate(places)


@pytest.mark.parametrize("method", ["slsqp", "ga", "de", "competitive"])
def test_every_method_finds_the_best_option_of_all(method):
    study = cheap()
    every = all_by_hand(study)
    f = np.where(every.feasible, every.f[:, 0], np.inf)
    best = minimise(study, method, designs=800)
    assert best.feasible
    assert best.x[:3].tolist() == every.x[f.argmin(), :3].tolist()
    assert best.f <= f.min() * 1.001
    assert len(best.options) == (12 if method == "slsqp" else 0)
    for reached, row in zip(best.options, np.split(f, 12), strict=False):
        assert reached.f[0] <= row.min() * 1.0001


def test_fronts_of_all_options_together_against_a_grid():
    study = cheap(free=FEW, minimise=(peak_pressure, peak_torque))
    every = study.evaluate([(*p, r) for p in product(range(2), range(2)) for r in np.linspace(0.02, 0.05, 121)])
    f = every.f[every.feasible]
    grid = f[~dominated(f)]
    for front in (quick_front(study, 60), nsga2(study, 60, 30)):
        assert not dominated(front.f).any()
        assert study.evaluate(front.x).feasible.all()
        both = np.vstack([front.f * 0.995, grid])
        assert dominated(both)[len(front) :].all()  # no design of the grid is better than the front by half a per cent
        assert [front[i] for i in (0, -1)] == [study.design(front.x[i]) for i in (0, -1)]
    again = quick_front(study, 60, quick_front(study, 60))
    assert again.hypervolume() > 0.999 * quick_front(study, 60).hypervolume()


def test_a_front_says_what_each_option_reached():
    front = quick_front(cheap(free=FEW, minimise=(peak_pressure, peak_torque)), 40)
    assert len(front.options) == 4
    assert front.f.min(0) == pytest.approx(np.nanmin([r.f for r in front.options], axis=0))
    assert str(front.options[0]).startswith("cycloidal, counter-clockwise: peak contact pressure ")
    empty = quick_front(
        cheap(free=FEW, minimise=(peak_pressure, peak_torque), at_most={max_pressure_angle: 1 * deg}), 40
    )
    assert "no design that was evaluated keeps every limit" in empty.options[0].text
    assert (len(empty), empty.options[0].feasible) == (0, False)
    assert empty.message


def test_the_lightest_standard_tube_is_found_by_every_way():
    tubes, shaft = standard_tubes(), shaft_study()
    study = shaft.freeing({("outer_diameter", "inner_diameter"): tubes})
    hold = tubes_that_hold(shaft.start, tubes)
    lightest = hold[np.argmin(shaft.evaluate(hold).f[:, 0])]
    for method in ("slsqp", "ga"):
        best = minimise(study, method, designs=2000)
        assert (best.design.outer_diameter, best.design.inner_diameter) == tuple(lightest)
    assert sum(r.feasible for r in minimise(study).options) == len(hold)


def test_a_track_roller_is_chosen_from_its_series():
    rollers = track_rollers()
    assert {name: round(2 * r / mm) for name, (r, _) in rollers.items()} == {n: int(n[3:]) for n in rollers}
    study = cheap(free={("roller_radius", "contact.width"): rollers}, minimise=(peak_pressure,))
    every = [study.start.replace(roller_radius=r).replace(contact=ContactPair(width=b)) for r, b in rollers.values()]
    f = [float(peak_pressure(cam.analyse(181))) for cam in every]
    best = minimise(study)
    assert [r.f[0] for r in best.options] == pytest.approx(f)
    assert (best.design.roller_radius, best.design.contact.width) == rollers[[*rollers][int(np.argmin(f))]]


def test_an_option_that_cannot_be_built_is_told_and_leaves_the_others():
    study = cheap(free={"motion.rise.angle": {120 * deg, 240 * deg}, "base_radius": (20 * mm, 50 * mm)})
    best = minimise(study)
    assert [r.feasible for r in best.options] == [True, False]
    assert "take 450 deg of the turn" in str(best.options[1])
    front = quick_front(study.replace(minimise=(peak_pressure, peak_torque)), 20)
    assert "take 450 deg of the turn" in front.options[1].text
    assert set(front.x[:, 0]) == {0.0}
    none = minimise(study.replace(free={"motion.rise.angle": {240 * deg, 250 * deg}, "base_radius": (0.02, 0.05)}))
    assert (none.feasible, [r.feasible for r in none.options]) == (False, [False, False])


def test_too_many_combinations_are_refused_with_what_to_do():
    free = {"motion.rise.law": None, "motion.return.law": None}
    study = cheap(free=(*free, "base_radius"))
    with pytest.raises(
        ValueError, match=r'there are 529 combinations of options; this method goes .* take method="ga"'
    ):
        minimise(study)
    with pytest.raises(ValueError, match=r"there are 529 combinations .* a quick front goes .* or take nsga2\(\)"):
        quick_front(study.replace(minimise=(peak_pressure, peak_torque)))


def test_steps_of_a_search_are_those_of_the_whole_study():
    study = cheap(free=FEW, minimise=(peak_torque,))
    *steps, last = search(study)
    assert {step.study is study and step.evaluation.x.shape[1] for step in steps} == {3}
    assert len({tuple(step.evaluation.x[0, :2]) for step in steps}) == 4
    assert last.best.f == minimise(study).f
    assert last.evaluated >= sum(1 for _ in steps)
    *fast, end = search(study.replace(minimise=(peak_pressure, peak_torque)), "fast_front", size=20)
    assert [step.number for step in (*fast, end)] == sorted({step.number for step in (*fast, end)})
    assert (end.number, len(end.front.options)) == (end.of, 4)
    assert fast[-1].front.f.shape[1] == 2


def test_nsga2_with_menus_goes_on_from_its_checkpoint(tmp_path):
    study, path = cheap(minimise=(peak_pressure, peak_torque)), tmp_path / "search"
    whole = nsga2(study, 20, 8, seed=2)
    nsga2(study, 20, 5, seed=2, checkpoint=path)
    again = nsga2(study, 20, 8, seed=2, checkpoint=path)
    np.testing.assert_array_equal(again.x, whole.x)
    other = cheap(
        minimise=(peak_pressure, peak_torque), free={**study.free, "rotation": ("clockwise", "counter-clockwise")}
    )
    with pytest.raises(ValueError, match="of another study"):
        nsga2(other, 20, 8, seed=2, checkpoint=path)


@pytest.mark.parametrize(("method", "goals"), [("slsqp", (STRAIN,)), ("fast_front", (peak_pressure, peak_torque))])
def test_a_search_through_options_goes_on_from_its_file(method, goals, tmp_path):
    study, size = cheap(free=FEW, minimise=goals), {"size": 12} if method == "fast_front" else {}
    *_, whole = search(study, method, **size)
    for step in search(study, method, checkpoint=tmp_path / "parts", **size):
        if step.evaluated > whole.evaluated / 2:
            break
    *_, again = search(study, method, checkpoint=tmp_path / "parts", **size)
    ends = (end.best.x if end.best else end.front.x for end in (whole, again))
    np.testing.assert_array_equal(*ends)
    renamed = study.replace(free={**FEW, BOTH: {"soft": Cycloidal(), "calm": ModifiedSine()}})
    with pytest.raises(ValueError, match="of another study"):
        next(search(renamed, method, checkpoint=tmp_path / "parts", **size))


def test_a_robust_search_over_options_is_that_of_each_option():
    tolerances = {"roller_radius": 0.05 * mm, "base_radius": 0.1 * mm}
    free = {"motion.rise.law": (Cycloidal(), ModifiedSine()), "base_radius": (20 * mm, 50 * mm)}
    robust = cheap(free=free, minimise=(base_radius,)).under(tolerances)
    best = minimise(robust)
    for place, reached in enumerate(best.options):
        one = robust.options.plain((place,)).study
        alone = minimise(Study(one.start, one.free, one.minimise, one.at_most, angles=181).under(tolerances))
        assert (alone.feasible, alone.f) == (True, reached.f[0])
    assert best.f == min(r.f[0] for r in best.options)
    assert robust.recheck(best.x).share[0] >= 0.99
    assert best.f > minimise(robust.nominal).f
    front = quick_front(robust.replace(minimise=(peak_pressure, peak_torque)), 12)
    assert front.yields.share.min() >= 0.99
    evolved = nsga2(robust.replace(minimise=(peak_pressure, peak_torque)), 16, 5)
    assert evolved.yields.share.min() >= 0.99


def test_a_trade_off_through_options():
    fronts = [
        best for best in trade_off(cheap(free={**FEW, "rotation": (1,)}, minimise=(peak_pressure, peak_torque)), 2)
    ]
    assert all(best.feasible and len(best.options) == 2 for best in fronts)


def test_rates_are_those_of_the_chosen_option():
    best = minimise(cheap(free=FEW, minimise=(base_radius,)))
    alone = minimise(best.study.options.at(best.x).study)
    assert list(best.rates) == [max_pressure_angle]
    assert best.rates[max_pressure_angle] == pytest.approx(alone.rates[max_pressure_angle], rel=1e-2)


def test_a_start_with_other_options_is_refused():
    study = cheap(minimise=(peak_pressure, peak_torque), free={"rotation": (1, -1), "base_radius": (0.02, 0.05)})
    with pytest.raises(ValueError, match="other menus"):
        quick_front(study, 10, quick_front(study.replace(free={**study.free, "rotation": (-1, 1)}), 10))
