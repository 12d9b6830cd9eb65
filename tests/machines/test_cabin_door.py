"""The synthesis of Liu, Geng 2019: the specification's optima, its alternatives, and a door that opens 90 deg."""

import numpy as np
import pytest

from camkit.linkage.load import RockerLoad
from camkit.linkage.measures import (
    SWEEP,
    assembly_margin,
    clearance_from,
    departure,
    excess,
    max_crank_pressure_angle,
    max_departure,
    max_pressure_angle,
    max_rocker_pressure_angle,
    min_crank_transmission,
    min_rocker_transmission,
    peak_coupler_force,
    peak_crank_bearing_force,
    peak_crank_bearing_moment,
    peak_crank_torque,
    peak_hinge_moment,
    possible_turn,
    room_in,
    swing,
)
from camkit.linkage.rssr import RSSR
from camkit.linkage.space import Box
from camkit.machines.cabin_door import HOUSING, PAPER_SPACE, CabinDoorLinkage, ninety_degree_study, rssr_study
from camkit.search.minimise import minimise
from camkit.search.polish import polish
from camkit.units import deg, mm

# From the specification: sweep [deg], least f [deg], X [mm].
OPTIMA = [
    ((15, 105), 213.298476, (80, 141.914, 130, 136.787, 100.344)),
    ((30, 90), 107.653973, (80, 159.003, 130, 146.997, 110.006)),
    ((0, 120), 355.805128, (80, 128.202, 130, 127.679, 90.597)),
]


def swept(start, end, **fields):
    return CabinDoorLinkage(start_angle=start * deg, end_angle=end * deg, **fields)


@pytest.mark.parametrize(("sweep", "least", "x"), OPTIMA)
def test_the_specifications_optima_have_the_values_given(sweep, least, x):
    """X is given to 1e-3 mm; f changes by some 0.3 deg per mm."""
    study = rssr_study(swept(*sweep))
    assert study.evaluate(np.array([x]) * mm).f[0] / deg == pytest.approx(least, abs=1e-3)


@pytest.mark.parametrize(("method", "optimum"), [("ga", 0), ("de", 0), ("de", 1), ("ga", 2)])
def test_a_short_search_and_a_polish_reach_the_optima(method, optimum):
    sweep, least, x = OPTIMA[optimum]
    study = rssr_study(swept(*sweep))
    found = polish(study, minimise(study, method, designs=600).x)
    assert found.feasible
    assert found.f / deg == pytest.approx(least, abs=1e-5)
    assert found.x / mm == pytest.approx(x, abs=1e-3)


@pytest.mark.slow
def test_a_genetic_search_ends_within_one_percent():
    """As many designs as 50 x 300."""
    assert minimise(rssr_study(), "ga", designs=15_000).f / deg < 1.01 * 213.298476


@pytest.mark.slow
def test_differential_evolution_reaches_the_optimum():
    assert minimise(rssr_study(), "de").f / deg == pytest.approx(213.298476, abs=1e-3)


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
    assert max_departure()(a) / deg == pytest.approx(np.abs(both - 30).max())
    assert max_pressure_angle(a) / deg == pytest.approx(both.max())
    assert departure(40 * deg).name == "pressure angles off 40 deg"
    assert excess(weights=w).name == "pressure angles above 30 deg, weighted"
    assert all(np.isfinite(measure(a)) for measure in SWEEP)
    with pytest.raises(ValueError, match=r"^the weights of the positions must be finite, none negative$"):
        departure(weights=[1, -1])


def test_alternatives_to_the_papers_objective():
    """Each objective is best at its own optimum."""
    studies = [rssr_study(objective=objective) for objective in (departure(), excess(), max_departure())]
    x = [polish(studies[0]).x, polish(studies[1]).x, minimise(studies[2]).x]
    f = np.array([study.evaluate(np.array(x)).f[:, 0] for study in studies]) / deg
    assert f.argmin(1).tolist() == [0, 1, 2]
    assert np.diagonal(f) == pytest.approx([213.298476, 76.589593, 9.192398], abs=1e-5)


def test_both_branches_are_continuous_over_the_sweep():
    """A sweep over the gap at 270 deg is seen, though no position falls into it."""
    study = rssr_study(swept(200, 320), positions=3)
    start = np.array([[100, 180, 110, 120, 80.0]]) * mm
    assert RSSR().discriminant(np.array([200, 260, 320]) * deg).min() > 0
    evaluation = study.evaluate(start)
    assert np.isinf(evaluation.f).all()
    assert np.isfinite(evaluation.g).all()
    assert not evaluation.feasible.any()
    best = rssr_study().design(np.array(OPTIMA[0][2]) * mm)
    assert assembly_margin(best.analyse(30)) > 0.5
    up, down = (best.replace(branch=branch).analyse(1000).rocker_angle for branch in (1, -1))
    assert abs(np.diff([up, down])).max() < 0.01
    assert (abs(np.mod(up - down + np.pi, 2 * np.pi) - np.pi) > 0.5).all()


def test_a_door_that_has_to_open_further_costs_pressure_angle():
    study = rssr_study(min_swing=90 * deg)
    found = polish(study, minimise(study, "de", designs=5000).x)
    assert found.feasible
    assert swing(study.analysis(found.x)) / deg == pytest.approx(90, abs=1e-5)
    assert found.f / deg == pytest.approx(271.891492, abs=1e-4)
    assert not study.evaluate(np.array(OPTIMA[0][2]) * mm).feasible


PIPE = Box((-60 * mm, 90 * mm, 60 * mm), (-40 * mm, 110 * mm, 110 * mm), "the pipe")


def test_a_forbidden_box_moves_the_optimum():
    """The rocker then turns just in front of the pipe, at y = 90 mm: the optimum with that bound and no pipe."""
    free = polish(rssr_study())
    study = rssr_study(outside=PIPE)
    assert clearance_from(PIPE)(study.analysis(free.x)) < -9 * mm
    in_front = rssr_study(space=PAPER_SPACE | {"rocker_offset": (20 * mm, 90 * mm)})
    for start in (study.x0, 0.9 * free.x):
        found = polish(study, np.clip(start, *study.bounds))
        assert found.feasible
        assert clearance_from(PIPE)(study.analysis(found.x)) == pytest.approx(0, abs=1e-5 * mm)
        assert found.f / deg == pytest.approx(223.137517, abs=1e-4)
        assert found.f == pytest.approx(polish(in_front).f, abs=1e-4 * deg)
        assert found.x / mm == pytest.approx([80, 130.770, 123.863, 126.350, 90], abs=1e-3)


def test_a_ninety_degree_door_that_can_be_made():
    study = ninety_degree_study()
    found = minimise(study, starts=8)
    assert found.feasible
    assert found.f / deg == pytest.approx(42.08876, abs=1e-4)
    whole_mm = study.design(np.array([120, 120, 120, 99, 99]) * mm)
    a = whole_mm.analyse(2000)
    assert swing(a) >= 90 * deg
    assert max_pressure_angle(a) <= 42.25 * deg
    assert room_in(HOUSING)(a) == pytest.approx(0, abs=1e-8)  # at 90 deg the crank points at the wall
    assert assembly_margin(a) > 0.5
    assert (np.diff(a.rocker_angle) < 0).all()
    assert peak_crank_torque(a) == pytest.approx(36.04, abs=0.005)


def test_closer_and_heel_resist_the_opening_door():
    """The rocker angle falls, so what resists is negative: the closer's 10 N m and the door's climb."""
    study = ninety_degree_study()
    a = study.design(np.array([120, 120, 120, 99, 99]) * mm).analyse()
    height = -a.weight[:, 0] @ a.centre_of_gravity / (30 * 9.81)
    assert height[-1] - height[0] > 50 * mm
    assert (a.resisting_torque <= -10).all()
    work = np.trapezoid(a.crank_torque, a.crank_angle)
    assert work == pytest.approx(30 * 9.81 * (height[-1] - height[0]) + 10 * np.ptp(a.rocker_angle), rel=1e-4)


def test_bearings_and_transmission_angles_by_hand():
    a = CabinDoorLinkage(load=RockerLoad(mass=20, lean=30 * deg)).analyse(30)
    assert min_crank_transmission(a) == pytest.approx(90 * deg - max_crank_pressure_angle(a))
    assert min_rocker_transmission(a) == pytest.approx(90 * deg - max_rocker_pressure_angle(a))
    assert peak_crank_bearing_force(a) == pytest.approx(peak_coupler_force(a))
    for measure, moments in (
        (peak_crank_bearing_moment, a.crank_bearing_moment),
        (peak_hinge_moment, a.rocker_bearing_moment),
    ):
        assert measure(a) == pytest.approx(max(np.sqrt(x**2 + y**2 + z**2) for x, y, z in moments.T))


def test_the_possible_turn_of_the_crank():
    """The example lacks the 8.753896 deg about 270 deg; a short crank goes all the way round."""
    a = CabinDoorLinkage(crank=np.array([[100], [60], [400], [-1]]) * mm).analyse(5)
    assert a.linkage.full_turn.tolist() == [False, True, False, False]
    expected = [360 - (274.376948 - 265.623052), 360, np.nan, np.nan]
    assert possible_turn(a) / deg == pytest.approx(expected, abs=1e-5, nan_ok=True)
    assert possible_turn(CabinDoorLinkage().analyse()) / deg == pytest.approx(expected[0], abs=1e-5)


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
            "the crank cannot sweep from 15 to 300 deg: the linkage can be assembled from -85.623 to 265.62 deg only",
        ),
        (  # a gap of a sixth of a degree
            {"start_angle": 320.5 * deg, "end_angle": 200 * deg, "coupler": 180.27746 * mm},
            "the crank cannot sweep from 320.5 to 200 deg: "
            "the linkage can be assembled from -89.915 to 269.92 deg only",
        ),
        (
            {"coupler": 600 * mm},
            "the coupler of 600 mm cannot be assembled at any crank angle; "
            "from crank to rocker it is 20.19 to 292.22 mm",
        ),
        ({"branch": 0}, "the branch is 0; it must be +1 or -1"),
    ],
)
@pytest.mark.parametrize("n", [2, 5, 181])
def test_refusals(fields, sentence, n):
    """However few angles are looked at."""
    with pytest.raises(ValueError) as refusal:  # noqa: PT011
        CabinDoorLinkage(**fields).analyse(n)
    assert str(refusal.value) == sentence


def test_a_member_that_cannot_pass_its_sweep_is_nan():
    couplers = np.array([[180.27746], [180.4]]) * mm
    a = swept(200, 320.5, coupler=couplers).analyse(5)
    assert a.discriminant.min() > 0
    assert np.isnan(a.rocker_angle).all(-1).tolist() == [True, False]
    turn = np.linspace(200, 320.5, 1_000_001) * deg
    margin = a.linkage.discriminant(turn).min(-1)
    assert assembly_margin(a) == pytest.approx(margin, abs=1e-9)
    assert (margin < 0).tolist() == [True, False]


def test_a_sweep_has_two_ends():
    with pytest.raises(ValueError, match=r"^the number of crank angles is 1; it must be a whole number of at least 2$"):
        CabinDoorLinkage().analyse(1)
