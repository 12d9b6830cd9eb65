"""The polish on fits of a straight line, whose least absolute errors linear programming knows exactly."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import linprog

from camkit.quantities import Design, Measure, quantity
from camkit.search.polish import polish
from camkit.study.residuals import SumOfResiduals
from camkit.study.study import Study

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


total = SumOfResiduals("total error", "", errors)
above = SumOfResiduals("total error above", "", errors, above_only=True)
largest = Measure("largest error", "", lambda line: abs(errors(line)).max(-1))
end = Measure("height at the end", "", lambda line: line[..., -1])
middle = Measure("mean height", "", lambda line: line.mean(-1))


def study(objective, **limits):
    return Study(Line(), ("height", "slope"), (objective,), **limits)


def least_by_linear_programming(end_at_most=None):
    n = len(T)
    design = np.column_stack([np.ones(n), T])
    a = np.block([[design, -np.eye(n)], [-design, -np.eye(n)]])
    b = np.concatenate([Y, -Y])
    if end_at_most is not None:
        a, b = np.vstack([a, [1, 1, *np.zeros(n)]]), np.append(b, end_at_most)
    cost = np.concatenate([[0, 0], np.ones(n)])
    return linprog(cost, a, b, bounds=[(-5, 5)] * 2 + [(0, None)] * n).fun


def test_the_sums_by_hand():
    lines = np.stack([Line(1.0, 2.0).analyse(1), Line(-1.0, 0.5).analyse(1)])
    for objective, sums in ((total, abs(lines - Y)), (above, np.where(lines > Y, lines - Y, 0))):
        assert objective(lines) == pytest.approx(sums.sum(-1))
        assert (-objective)(lines) == pytest.approx(-sums.sum(-1))
        spelled = objective.spelled_out(lines)
        assert sum(w * part(lines) for w, part in zip(spelled.weights, spelled.parts, strict=True)) == pytest.approx(
            sums.sum(-1)
        )


def test_the_least_absolute_errors():
    found = polish(study(total), [0.0, 0.0])
    assert found.feasible
    assert found.f == pytest.approx(least_by_linear_programming(), rel=1e-7)
    assert found.message.startswith("best of its neighbours after")
    assert found.evaluations > 5
    assert found.design == Line(*map(float, found.x))


def test_limits_are_kept_to_the_last_digit():
    found = polish(study(total, at_most={end: 2.0}))
    assert found.feasible
    assert end(found.design.analyse(1)) == pytest.approx(2.0, abs=1e-7)
    assert found.f == pytest.approx(least_by_linear_programming(2.0), rel=1e-7)


def test_an_error_below_is_no_fault_of_the_excess():
    found = polish(study(above, at_least={middle: 2.5}), [0.0, 3.0])
    assert found.feasible
    assert _best_of_a_grid() * (1 - 2e-3) < found.f < _best_of_a_grid() * (1 + 1e-7)


def _best_of_a_grid():
    """With the mean height at its limit, one number is left."""
    slopes = np.linspace(-5, 4.89, 4001)[:, None]
    return np.maximum(2.5 + slopes * (T - 0.5) - Y, 0).sum(-1).min()


def test_a_start_that_is_best_stays():
    best = polish(study(total))
    again = polish(study(total), best.x)
    assert again.f <= best.f
    assert again.f == pytest.approx(best.f, rel=1e-9)


def test_a_start_that_breaks_a_limit_is_mended():
    found = polish(study(total, at_least={end: 4.0}), [0.0, 0.0])
    assert found.feasible
    assert end(found.design.analyse(1)) == pytest.approx(4.0, abs=1e-7)


def test_limits_that_cannot_be_kept_are_told():
    found = polish(study(total, at_least={end: 20.0}))
    assert not found.feasible
    assert found.message.endswith("it does not keep every limit")


@pytest.mark.parametrize(
    ("objectives", "x", "sentence"),
    [
        ((total,), [0, 6], "the design to polish lies outside the bounds of the study"),
        ((total,), [0, 4.95], "the design to polish cannot be built; start from one that a search has found"),
        (
            (largest,),
            None,
            "the study minimises the largest error; polish takes one sum of residuals: use minimise",
        ),
        (
            (total, above),
            None,
            "the study minimises the total error and total error above; "
            "polish takes one sum of residuals: use minimise",
        ),
    ],
)
def test_refusals(objectives, x, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011
        polish(study(objectives[0]).replace(minimise=objectives), x)
    assert str(refusal.value) == sentence


def test_the_negative_of_a_sum_is_refused():
    with pytest.raises(ValueError, match="polish takes one sum of residuals"):
        polish(study(-total))
