"""The optima that notebook 06 reads: they keep their limits, and a search today finds none better."""

import pytest

from camkit.data import load
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.papers.high_speed_optima import GOALS, fast_press_study, fastest_press, solved_studies, stored_optima
from camkit.search.minimise import minimise
from camkit.units import cm, deg, mm

LIMIT = 7.85 / cm**0.5


def test_every_stored_optimum_keeps_its_limits_and_beats_the_first_design():
    optima, first = stored_optima(), HighSpeedCam().analyse()
    assert len(optima) == 9 + 5
    for name, best in optima.items():
        assert best.feasible, name
        if ":" in name:
            assert best.f < 0.85 * float(GOALS[name.partition(":")[0]](first)), name


@pytest.mark.parametrize("name", ["stress index: sizes", "wear: laws"])
def test_a_search_today_ends_at_the_stored_optimum(name):
    assert minimise(solved_studies()[name]).f == pytest.approx(stored_optima()[name].f, rel=1e-4)


def test_more_freedom_and_more_room_are_never_worse():
    optima = stored_optima()
    for goal in GOALS:
        sizes, laws, both = (optima[f"{goal}: {what}"].f for what in ("sizes", "laws", "sizes and laws"))
        assert both < sizes < laws
    first = HighSpeedCam().analyse()
    for goal in ("stress index", "wear"):  # "both together gain more than the two gains multiplied"
        start = float(GOALS[goal](first))
        sizes, laws, both = (optima[f"{goal}: {what}"].f / start for what in ("sizes", "laws", "sizes and laws"))
        assert both < sizes * laws
    sweep = [optima[f"r_k2 at most {radius} mm"].f for radius in (94, 100, 110, 120, 140)]
    assert sweep == sorted(sweep, reverse=True)
    assert sweep[2] * cm**0.5 == pytest.approx(7.57, abs=0.005)
    assert sweep[3] * cm**0.5 == pytest.approx(7.31, abs=0.005)


def test_the_shortest_interval_keeps_its_limit_and_the_next_does_not():
    stored, best = load("high_speed_optima")["shortest interval"], fastest_press()
    assert best.feasible
    assert best.f <= LIMIT
    assert best.design.rise_angle == best.design.return_angle == pytest.approx(46.6 * deg, abs=0.05 * deg)
    assert 1 - stored["keeps_deg"] / 61 == pytest.approx(0.24, abs=0.005)
    shorter = fast_press_study(stored["keeps_not_deg"] * deg)
    start = best.design.replace(rise_angle=shorter.start.rise_angle, return_angle=shorter.start.return_angle)
    assert minimise(shorter.replace(start=start)).f > LIMIT
    assert best.design.max_radius == pytest.approx(120 * mm)
