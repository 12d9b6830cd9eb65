"""The synthesis of Liu, Geng 2019: the specification's optima, its alternatives, and a door that opens 90 deg."""

import numpy as np
import pytest
from pymoo.algorithms.soo.nonconvex.de import DE
from pymoo.algorithms.soo.nonconvex.ga import GA
from pymoo.core.problem import Problem

from camkit.linkage.cabin_door import HOUSING, CabinDoorLinkage, ninety_degree_study, rssr_study
from camkit.linkage.load import RockerLoad
from camkit.linkage.measures import (
    SWEEP,
    assembly_margin,
    clearance_from,
    departure,
    departures,
    excess,
    largest_departure,
    peak_crank_torque,
    room_in,
    steepest,
    swing,
)
from camkit.linkage.rssr import RSSR
from camkit.linkage.space import Box
from camkit.polish import polish
from camkit.units import deg, mm

# From the specification: sweep [deg], least f [deg], X [mm].
OPTIMA = [
    ((15, 105), 213.298476, (80, 141.914, 130, 136.787, 100.344)),
    ((30, 90), 107.653973, (80, 159.003, 130, 146.997, 110.006)),
    ((0, 120), 355.805128, (80, 128.202, 130, 127.679, 90.597)),
]


def swept(start, end, **fields):
    return CabinDoorLinkage(start_angle=start * deg, end_angle=end * deg, **fields)


class AsPymooSeesIt(Problem):
    """A study, infeasible designs far away."""

    def __init__(self, study):
        low, high = study.bounds
        super().__init__(n_var=len(low), n_obj=1, n_ieq_constr=len(study.limits), xl=low, xu=high)
        self.study = study

    def _evaluate(self, x, out, *args, **kwargs):
        evaluation = self.study.evaluate(x)
        out["F"], out["G"] = np.minimum(evaluation.f, 1e9), np.minimum(evaluation.g, 1e9)


def searched(study, algorithm, generations, seed=1):
    """The best of a population after some generations."""
    algorithm.setup(AsPymooSeesIt(study), termination=("n_gen", generations), seed=seed, verbose=False)
    while algorithm.has_next():
        algorithm.next()
    return algorithm.opt[0].X


def ga(study, generations=300, seed=1):
    return searched(study, GA(pop_size=50, eliminate_duplicates=False), generations, seed)


def de(study, generations, seed=1):
    return searched(study, DE(pop_size=30, CR=0.9, F=0.6), generations, seed)


@pytest.mark.parametrize(("sweep", "least", "x"), OPTIMA)
def test_the_specifications_optima_have_the_values_given(sweep, least, x):
    """X is given to 1e-3 mm; f changes by some 0.3 deg per mm."""
    study = rssr_study(swept(*sweep))
    assert study.evaluate(np.array([x]) * mm).f[0] / deg == pytest.approx(least, abs=1e-3)


@pytest.mark.parametrize(("search", "optimum"), [(ga, 0), (de, 0), (de, 1), (ga, 2)])
def test_a_search_and_a_polish_reach_the_optima(search, optimum):
    sweep, least, x = OPTIMA[optimum]
    study = rssr_study(swept(*sweep))
    found = polish(study, departures(), search(study, generations=12))
    assert found.feasible
    assert found.f[0] / deg == pytest.approx(least, abs=1e-5)
    assert found.x / mm == pytest.approx(x, abs=1e-3)


@pytest.mark.slow
def test_a_genetic_search_ends_within_one_percent():
    study = rssr_study()
    assert study.evaluate(ga(study)).f[0, 0] / deg < 1.01 * 213.298476


@pytest.mark.slow
def test_differential_evolution_reaches_the_optimum():
    study = rssr_study()
    assert study.evaluate(de(study, 150)).f[0, 0] / deg == pytest.approx(213.298476, abs=1e-3)


def test_no_corner_or_random_design_beats_the_optima():
    rng = np.random.default_rng(0)
    for sweep, least, _ in OPTIMA:
        study = rssr_study(swept(*sweep))
        assert study.evaluate(rng.uniform(*study.bounds, (2000, 5))).f.min() / deg > least


def test_the_default_optimum_in_words():
    a = swept(15, 105).replace(**dict(zip(rssr_study().free, np.array(OPTIMA[0][2]) * mm, strict=True))).analyse(30)
    assert np.degrees(a.crank_angle[[0, -1]]) == pytest.approx([15, 105])
    assert np.degrees(a.crank_pressure_angle.max()) == pytest.approx(49.02, abs=0.01)
    assert np.degrees(a.rocker_pressure_angle.max()) == pytest.approx(35.76, abs=0.01)
    assert swing(a) / deg == pytest.approx(53.7, abs=0.05)


def test_the_objective_of_the_example():
    example = swept(0, 90)
    assert departure()(example.analyse(30)) / deg == pytest.approx(919.430279, abs=1e-6)


def test_measures_by_hand():
    a = swept(15, 105).analyse(30)
    both = np.degrees([a.crank_pressure_angle, a.rocker_pressure_angle])
    w = np.linspace(1, 2, 30)
    assert departure(40 * deg)(a) / deg == pytest.approx(np.abs(both - 40).sum())
    assert departure(weights=w)(a) / deg == pytest.approx((w * np.abs(both - 30)).sum())
    assert excess(weights=w)(a) / deg == pytest.approx((w * np.maximum(both - 30, 0)).sum())
    assert largest_departure()(a) / deg == pytest.approx(np.abs(both - 30).max())
    assert steepest(a) / deg == pytest.approx(both.max())
    assert departure(40 * deg).name == "pressure angles off 40 deg"
    assert excess(weights=w).name == "pressure angles above 30 deg, weighted"
    assert all(np.isfinite(measure(a)) for measure in SWEEP)
    with pytest.raises(ValueError, match=r"^the weights of the positions must be finite, none negative$"):
        departure(weights=[1, -1])


def test_alternatives_to_the_papers_objective():
    """Each objective is best at its own optimum."""
    kinds = ((departure(), "sum"), (excess(), "excess"), (largest_departure(), "largest"))
    studies = [rssr_study(objective=objective) for objective, _ in kinds]
    x = [polish(s, departures(), de(s, 12), norm).x for s, (_, norm) in zip(studies, kinds, strict=True)]
    f = np.array([study.evaluate(np.array(x)).f[:, 0] for study in studies]) / deg
    assert f.argmin(1).tolist() == [0, 1, 2]
    assert np.diagonal(f) == pytest.approx([213.298476, 76.589593, 9.192398], abs=1e-5)


def test_both_branches_are_continuous_over_the_sweep():
    """A sweep over the gap at 270 deg is seen, though no position falls into it."""
    study = rssr_study(swept(200, 320), positions=3)
    start = np.array([[100, 180, 110, 120, 80.0]]) * mm
    assert RSSR().discriminant(np.array([200, 260, 320]) * deg).min() > 0
    evaluation = study.evaluate(start)
    assert np.isfinite(evaluation.f).all()
    assert not evaluation.feasible.any()
    best = rssr_study().design(np.array(OPTIMA[0][2]) * mm)
    assert assembly_margin(best.analyse(30)) > 0.5
    up, down = (best.replace(branch=branch).analyse(1000).rocker_angle for branch in (1, -1))
    assert abs(np.diff([up, down])).max() < 0.01
    assert (abs(np.mod(up - down + np.pi, 2 * np.pi) - np.pi) > 0.5).all()


def test_a_door_that_has_to_open_further_costs_pressure_angle():
    study = rssr_study(least_swing=90 * deg)
    found = polish(study, departures(), de(study, 40))
    assert found.feasible
    assert swing(study.analyse(found.x)) / deg == pytest.approx(90, abs=1e-5)
    assert found.f[0] / deg == pytest.approx(271.891492, abs=1e-4)
    assert not study.evaluate(np.array(OPTIMA[0][2]) * mm).feasible


def test_a_forbidden_box_moves_the_optimum():
    free = rssr_study()
    best = polish(free, departures(), de(free, 12))
    pipe = Box((-60 * mm, 90 * mm, 60 * mm), (-40 * mm, 110 * mm, 110 * mm), "the pipe")
    assert clearance_from(pipe)(free.analyse(best.x)) < 0
    study = rssr_study(outside=pipe)
    found = polish(study, departures(), de(study, 40))
    assert found.feasible
    assert clearance_from(pipe)(study.analyse(found.x)) >= 0
    assert best.f[0] < found.f[0] < 1.5 * best.f[0]


def test_a_ninety_degree_door_that_can_be_made():
    study = ninety_degree_study()
    found = polish(study, departures(0.0), de(study, 40), "largest")
    assert found.feasible
    assert found.f[0] / deg == pytest.approx(42.08876, abs=1e-4)
    whole_mm = study.design(np.array([120, 120, 120, 99, 99]) * mm)
    a = whole_mm.analyse(2000)
    assert swing(a) >= 90 * deg
    assert steepest(a) <= 42.25 * deg
    assert room_in(HOUSING)(a) >= 0
    assert assembly_margin(a) > 0.5
    assert (np.diff(a.rocker_angle) < 0).all()
    assert 30 < peak_crank_torque(a) < 40


def test_the_whole_machine_carries_its_branch_and_load():
    load = RockerLoad(mass=10, lean=5 * deg)
    door = swept(20, 80, branch=-1, load=load)
    a = door.analyse(7)
    assert (a.branch, a.load, a.linkage) == (-1, load, RSSR())
    np.testing.assert_allclose(a.crank_angle, np.linspace(20, 80, 7) * deg)
    back = swept(80, 20).analyse(7)
    np.testing.assert_allclose(back.crank_angle, np.linspace(80, 20, 7) * deg)


def test_a_population_may_sweep_differently():
    ends = np.array([[90.0], [105.0], [400.0]]) * deg
    a = CabinDoorLinkage(end_angle=ends).analyse(30)
    assert a.crank_angle.shape == a.rocker_angle.shape == (3, 30)
    one = swept(15, 105).analyse(30)
    assert a.rocker_angle[1] == pytest.approx(one.rocker_angle)
    assert assembly_margin(a)[1] == pytest.approx(float(assembly_margin(one)))
    assert np.isnan(a.rocker_angle[2]).all()
    assert assembly_margin(a)[2] < 0


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"end_angle": 15 * deg}, "the crank sweeps from 15 to 15 deg; it must move"),
        (
            {"end_angle": 300 * deg},
            "at a crank angle of 270 deg the linkage cannot be assembled; possible are -85.623 to 265.62 deg",
        ),
        ({"branch": 0}, "the branch is 0; it must be +1 or -1"),
    ],
)
def test_refusals(fields, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011
        CabinDoorLinkage(**fields).analyse(20)
    assert str(refusal.value) == sentence
