"""The polish on fits of a straight line, whose least absolute errors linear programming knows exactly."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import linprog

from camkit.polish import polish
from camkit.quantities import Design, Measure, quantity
from camkit.study import Study

T = np.linspace(0, 1, 21)
Y = 1 + 2 * T + 0.3 * np.sin(17 * T) + np.where(T == 0.5, 4.0, 0.0)


@dataclass(frozen=True)
class Line(Design):
    height: float = quantity("a", 0, -5, 5, "", "at 0", above=None)
    slope: float = quantity("b", 0, -5, 5, "", "rise", above=None)

    def analyse(self, n):
        return np.where(self.slope < 4.9, self.height + self.slope * T, np.nan)


def errors(line):
    return line - Y


total = Measure("total error", "", lambda line: abs(errors(line)).sum(-1))
above = Measure("total error above", "", lambda line: np.maximum(errors(line), 0).sum(-1))
largest = Measure("largest error", "", lambda line: abs(errors(line)).max(-1))
end = Measure("height at the end", "", lambda line: line[..., -1])
middle = Measure("mean height", "", lambda line: line.mean(-1))


def study(objective, **limits):
    return Study(Line(), ("height", "slope"), (objective,), **limits)


def least_by_linear_programming(norm, end_at_most=None):
    n = len(T)
    design = np.column_stack([np.ones(n), T])
    slack = np.ones((n, 1)) if norm == "largest" else np.eye(n)
    a = np.block([[design, -slack], [-design, -slack]])
    b = np.concatenate([Y, -Y])
    if end_at_most is not None:
        a, b = np.vstack([a, [1, 1, *np.zeros(slack.shape[1])]]), np.append(b, end_at_most)
    cost = np.concatenate([[0, 0], np.ones(slack.shape[1])])
    return linprog(cost, a, b, bounds=[(-5, 5)] * 2 + [(0, None)] * slack.shape[1]).fun


@pytest.mark.parametrize(("objective", "norm"), [(total, "sum"), (largest, "largest")])
def test_the_least_absolute_errors(objective, norm):
    found = polish(study(objective), errors, norm=norm)
    assert found.feasible
    assert found.f[0] == pytest.approx(least_by_linear_programming(norm), rel=1e-7)
    assert found.message.startswith("best of its neighbours after")
    assert found.evaluations > 5
    assert found.design == Line(*map(float, found.x))


@pytest.mark.parametrize(("objective", "norm"), [(total, "sum"), (largest, "largest")])
def test_limits_are_kept_to_the_last_digit(objective, norm):
    found = polish(study(objective, at_most={end: 2.0}), errors, norm=norm)
    assert found.feasible
    assert end(found.design.analyse(1)) == pytest.approx(2.0, abs=1e-7)
    assert found.f[0] == pytest.approx(least_by_linear_programming(norm, 2.0), rel=1e-7)


def test_an_error_below_is_no_fault_of_the_excess():
    found = polish(study(above, at_least={middle: 2.5}), errors, [0.0, 3.0], "excess")
    assert found.feasible
    assert _best_of_a_grid() * (1 - 2e-3) < found.f[0] < _best_of_a_grid() * (1 + 1e-7)


def _best_of_a_grid():
    """With the mean height at its limit, one number is left."""
    slopes = np.linspace(-5, 4.89, 4001)[:, None]
    return np.maximum(2.5 + slopes * (T - 0.5) - Y, 0).sum(-1).min()


def test_the_largest_error_of_a_line_to_a_parabola_is_one_eighth():
    """Chebyshev: ``x - 1/8`` for ``x^2`` on 0 .. 1."""
    parabola = Measure("largest error", "", lambda line: abs(line - T**2).max(-1))
    found = polish(study(parabola), lambda line: line - T**2, norm="largest")
    assert found.x == pytest.approx([-0.125, 1], abs=1e-7)
    assert found.f[0] == pytest.approx(0.125, abs=1e-9)


def test_a_start_that_is_best_stays():
    best = polish(study(total), errors)
    again = polish(study(total), errors, best.x)
    assert again.f <= best.f
    assert again.f == pytest.approx(best.f, rel=1e-9)


def test_a_start_that_breaks_a_limit_is_mended():
    found = polish(study(total, at_least={end: 4.0}), errors, [0.0, 0.0])
    assert found.feasible
    assert end(found.design.analyse(1)) == pytest.approx(4.0, abs=1e-7)


def test_limits_that_cannot_be_kept_are_told():
    found = polish(study(largest, at_least={end: 20.0}), errors, norm="largest")
    assert not found.feasible
    assert found.message.endswith("it keeps not every limit")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"norm": "mean"}, "the norm is 'mean'; there are 'sum', 'excess', 'largest'"),
        ({"x": [0, 6]}, "the design to polish lies outside the bounds of the study"),
        ({"x": [0, 4.95]}, "the design to polish cannot be built; start from one that a search has found"),
    ],
)
def test_refusals(arguments, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011
        polish(study(total), errors, **arguments)
    assert str(refusal.value) == sentence
