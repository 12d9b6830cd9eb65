"""The least change of a design that gives a measure a wanted value, against formulas and brute force."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import Measure, Study, deg, high_speed_study, mm, shaft_study
from camkit.machines import door_handle_study
from camkit.quantities import Design, quantity
from camkit.search import goal_seek


@dataclass(frozen=True)
class Bars(Design):
    """Two bars in a row."""

    first: float = quantity("a", 40, 10, 100, "mm", "first bar")
    second: float = quantity("b", 60, 50, 80, "mm", "second bar")

    def analyse(self, n: int = 361) -> "Bars":
        return self


length = Measure(
    "length", "mm", lambda bars: (bars.first + bars.second)[..., 0] if np.ndim(bars.first) else bars.first + bars.second
)
first = Measure("first bar", "mm", lambda bars: bars.first[..., 0] if np.ndim(bars.first) else bars.first)


def test_the_change_is_shared_as_the_widths_of_the_bounds_say():
    """Least squares on a line: the changes are as the squares of the widths, 90^2 to 30^2."""
    found = goal_seek(Study(Bars(), ["first", "second"], (length,)), 120 * mm)
    assert_allclose(found.x, [58 * mm, 62 * mm], rtol=1e-6)
    assert found.feasible
    assert found.message == "The length is 120 mm."


def test_limits_and_bounds_are_kept_and_named_where_they_stop_it():
    study = Study(Bars(), ["first", "second"], (length,), at_most={first: 50 * mm})
    assert_allclose(goal_seek(study, 125 * mm).x, [50 * mm, 75 * mm], rtol=1e-6)
    stopped = goal_seek(study, 150 * mm)
    assert_allclose(stopped.x, [50 * mm, 80 * mm], rtol=1e-4)
    assert stopped.message == (
        "The length cannot be 150 mm: the highest found is 130 mm; it is held by the first bar 50 mm "
        "and the second 80 mm (upper bound)."
    )


@pytest.mark.parametrize(("value", "ends"), [(1e9, (100, 80)), (-1e9, (10, 50))])
def test_a_value_far_beyond_all_designs_is_approached_as_far_as_they_go(value, ends):
    stopped = goal_seek(Study(Bars(), ["first", "second"], (length,)), value)
    assert_allclose(stopped.x, np.array(ends) * mm, rtol=1e-4)


def test_a_measure_to_be_made_large_counts_as_its_negative():
    found = goal_seek(Study(Bars(), ["first", "second"], (-length,)), -90 * mm)
    assert_allclose(found.x, [31 * mm, 59 * mm], rtol=1e-6)
    assert found.message == "The length is 90 mm."


def test_of_shafts_as_near_none_with_the_value_is_nearer():
    """Against a fine grid of all that are not farther from the start than it, and a little beyond."""
    study = shaft_study()
    start = study.design([0.131, 0.100])
    study = study.around(start)
    utilisation = next(m for m in study.measures if "twist" in m.name)
    study = study.replace(minimise=(utilisation,))
    now = study.evaluate(study.x0).f[0, 0]
    found = goal_seek(study, 0.9 * now)
    width = np.diff(study.bounds, axis=0)[0]
    changed = (((found.x - study.x0) / width) ** 2).sum()
    reach = 1.1 * np.sqrt(changed) * width
    low, high = np.clip([study.x0 - reach, study.x0 + reach], *study.bounds)
    grid = np.stack(np.meshgrid(*np.linspace(low, high, 300).T), -1).reshape(-1, 2)
    there = study.evaluate(grid)
    alike = there.feasible & (there.f[:, 0] <= 0.9 * now)
    near = (((grid - study.x0) / width) ** 2).sum(-1)
    assert_allclose(changed, near[alike].min(), rtol=2e-2)
    assert found.feasible
    assert found.f == pytest.approx(0.9 * now, rel=1e-6)


@pytest.mark.parametrize("share", [0.9, 1.02])
def test_a_peak_is_moved_and_no_neighbour_has_it_with_less_change(share):
    study = high_speed_study()
    value = share * study.evaluate(study.x0).f[0, 0]
    found = goal_seek(study, value)
    assert found.feasible
    assert found.f == pytest.approx(value, rel=1e-6)
    width = np.diff(study.bounds, axis=0)[0]
    change = (found.x - study.x0) / width
    steps = np.random.default_rng(3).normal(size=(4000, len(width))) * np.geomspace(1e-4, 1e-1, 4000)[:, None]
    others = np.clip(change + steps, *((study.bounds - study.x0) / width))
    less = (others**2).sum(-1) < (change**2).sum() * (1 - 1e-4)
    there = study.evaluate(study.x0 + others[less] * width)
    beyond = (there.f[:, 0] <= value) if share < 1 else (there.f[:, 0] >= value)
    assert less.sum() > 500
    assert not (there.feasible & beyond).any()


def test_a_start_that_misses_a_limit_is_brought_to_both():
    study = door_handle_study()
    radius = next(m for m in study.measures if m.name.startswith("base radius"))
    study = study.replace(minimise=(radius,))
    assert not study.evaluate(study.x0).feasible[0]
    found = goal_seek(study, 36 * mm)
    assert found.feasible
    assert found.f == pytest.approx(36 * mm, rel=1e-6)
    low = goal_seek(study, 10 * mm)
    assert low.feasible
    assert "the lowest found is 31.7" in low.message
    assert "45 deg" in low.message


def test_what_cannot_be_asked_is_refused_in_a_sentence():
    with pytest.raises(ValueError, match="the study has 2 objectives; a wanted value is that of one measure"):
        goal_seek(Study(Bars(), ["first"], (length, first)), 1.0)
    with pytest.raises(ValueError, match="the argument value is nan; it must be a finite number"):
        goal_seek(Study(Bars(), ["first"], (length,)), float("nan") * deg)
