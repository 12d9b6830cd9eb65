"""Trade-off rates against fronts and minima in closed form, and against minima that are searched again."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import Measure, Study, deg, minimise, mm
from camkit.machines import cam_lever_study, door_handle_study, high_speed_study, shaft_study
from camkit.quantities import Design, quantity
from camkit.search import Front
from camkit.search.rates import told_of_limits, told_on_front


@dataclass(frozen=True)
class Plane(Design):
    """Two lengths."""

    x: float = quantity("x", 10, 0, 100, "mm", "one length", above=None)
    y: float = quantity("y", 10, 0, 100, "mm", "another length", above=None)

    def analyse(self, n=1):
        return np.concatenate(np.atleast_1d(self.x, self.y), axis=-1)


angle = Measure("angle", "deg", lambda plane: plane[..., 0])
force = Measure("force", "N", lambda plane: plane[..., 1])
third = Measure("third", "", lambda plane: plane.sum(-1))
square = Measure("square", "mm^2", lambda plane: (plane**2).sum(-1))
total = Measure("sum", "mm", lambda plane: plane.sum(-1))


def front_on(f, objectives=(angle, force)):
    f = np.asarray(f, dtype=float)
    return Front(Study(Plane(), ["x"], objectives), np.zeros((len(f), 1)), f)


def test_rates_of_a_parabola_are_exact():
    x = np.cumsum(np.random.default_rng(3).uniform(0.05, 0.1, 9))
    front = front_on(np.stack([x, (1 - x) ** 2], axis=-1))
    for i in range(1, 8):
        rates = front.rates(i)
        assert rates[0, 1] == pytest.approx(2 * (1 - x[i]), rel=1e-9)
        assert rates[1, 0] == pytest.approx(1 / (2 * (1 - x[i])), rel=1e-9)
        assert np.isnan(np.diag(rates)).all()


def test_rates_of_a_hyperbola_come_nearer_with_the_square_of_the_step():
    off = []
    for n in (21, 41):
        x = np.linspace(0.5, 2, n)
        middle = front_on(np.stack([x, 1 / x], axis=-1)).rates((n - 1) // 2)
        off.append(middle[0, 1] * x[(n - 1) // 2] ** 2 - 1)
    assert abs(off[1]) < 2e-3
    assert off[0] / off[1] == pytest.approx(4, rel=0.05)


def test_rates_where_nobody_knows_are_none():
    two = front_on([(0, 3), (0, 3), (1, 1), (1, 1), (3, 0)])
    for end in (0, 1, -1):
        assert np.isnan(two.rates(end)).all()
    assert two.rates(2)[0, 1] == two.rates(3)[0, 1] == pytest.approx((2 * 2 + 1 * 0.5) / 3)
    close = front_on([(0, 3), (0.99, 1.2), (1, 1), (1.01, 0.99), (3, 0)])  # 0.5 % of the range apart
    assert close.rates(2)[0, 1] == pytest.approx((2 * 2 + 1 * 0.5) / 3)
    three = front_on([(0, 1, 2), (1, 2, 0), (2, 0, 1)], (angle, force, third))
    assert np.isnan(three.rates(1)).all()
    assert three.rates(1).shape == (3, 3)
    with pytest.raises(IndexError, match="there is no design 5 on the front"):
        two.rates(5)
    with pytest.raises(ValueError, match=r"the place on the front is .*; it must be one whole number"):
        two.rates(np.array([0, 1]))


def test_a_rate_in_words_has_units_and_directions():
    front = front_on([(1 * deg, 9.0), (2 * deg, 6.0), (3 * deg, 3.0)])
    assert told_on_front((angle, force), front.rates(1)) == "1 deg less angle costs 3 N more force."
    larger = told_on_front((-angle, -force), front.rates(1))
    assert larger == "1 deg more angle costs 3 N less force."
    assert (
        told_on_front((third, force), front.rates(1)) == f"0.01 less third costs {force.text(0.03 / deg)} more force."
    )
    assert told_on_front((angle, force), front.rates(0)) == ""


def test_multipliers_of_a_square_under_a_sum():
    """``x^2 + y^2`` where ``x + y >= v`` is least at ``v^2 / 2``, which grows by ``v``; with ``x <= u < v / 2`` at
    ``u^2 + (v - u)^2``."""
    study = Study(Plane(), {"x": (0, 0.1), "y": (0, 0.1)}, (square,), at_least={total: 30 * mm})
    best = minimise(study)
    assert best.rates == {total: pytest.approx(0.03, rel=1e-5)}
    assert told_of_limits(study, best.rates) == ["1 mm more room for the sum: 30 mm^2 less square."]
    narrow = minimise(study.replace(free={"x": (0, 0.01), "y": (0, 0.1)}))
    assert narrow.rates == {total: pytest.approx(0.04, rel=1e-5), "x": pytest.approx(2 * 0.01 - 2 * 0.02, rel=1e-5)}
    free = minimise(study.replace(at_least={}, free={"x": (-0.1, 0.1), "y": (-0.1, 0.1)}))
    assert free.rates == {}


def test_a_limit_of_zero_and_one_that_another_holds_too():
    """Where two limits are the same, more room for one of them alone brings nothing."""
    study = Study(Plane(), {"x": (0.02, 0.1), "y": (0.01, 0.1)}, (square,), at_least={total: 30 * mm})
    best = minimise(study)
    assert_allclose(best.x, [0.02, 0.01], atol=1e-7)
    assert best.rates == {
        "x": pytest.approx(0.02, rel=1e-3), "y": pytest.approx(0, abs=1e-6), total: pytest.approx(0, abs=1e-6)
    }  # fmt: skip
    zero = Measure("difference", "mm", lambda plane: plane[..., 0] - plane[..., 1])
    held = minimise(Study(Plane(), {"x": (0, 0.1), "y": (0.02, 0.1)}, (square,), at_least={zero: 0.0}))
    assert held.rates[zero] == pytest.approx(0.04, rel=1e-4)


def again(best, limit):
    """The slope of the least objective where a limit is moved outwards by a thousandth."""
    study = best.study
    if isinstance(limit, str):
        low, high = study.free[limit]
        at_upper = best.x[list(study.free).index(limit)] > (low + high) / 2
        moved = 1e-3 * (high - low) * (1 if at_upper else -1)
        wider = (low, high + moved) if at_upper else (low + moved, high)
        other = study.replace(free={**study.free, limit: wider})
    else:
        side = "at_most" if limit in study.at_most else "at_least"
        limits = dict(getattr(study, side))
        moved = 1e-3 * abs(limits[limit]) * (1 if side == "at_most" else -1)
        other = study.replace(**{side: {**limits, limit: limits[limit] + moved}})
    return (minimise(other.around(best.design)).f - best.f) / moved


PRESSED = door_handle_study()


@pytest.mark.parametrize(
    ("study", "held"),
    [
        (shaft_study(), 2),
        (high_speed_study(), 1),
        (cam_lever_study(free_laws=False), 3),
        (PRESSED.replace(minimise=(PRESSED.minimise[1],)), 3),
    ],
    ids=["shaft", "high-speed cam", "cam and lever", "largest radius of the door handle"],
)
def test_multipliers_are_what_other_limits_bring(study, held):
    best = minimise(study)
    assert len(best.rates) == held
    for limit, rate in best.rates.items():
        assert rate == pytest.approx(again(best, limit), rel=0.01)


def test_what_is_no_minimum_has_no_rates():
    study = Study(Plane(), {"x": (0, 0.1), "y": (0, 0.1)}, (square,), at_least={total: 30 * mm})
    best = minimise(study)
    elsewhere = type(best)(study, np.array([0.01, 0.02]), 5e-4, True, 1)
    assert np.isnan(elsewhere.rates[total])
    assert told_of_limits(study, elsewhere.rates) == []


def test_multipliers_under_tolerances_keep_the_margins():
    """A tolerance of 1 mm on x and the sum of parts that keep it: the margin does not depend on the design."""
    study = Study(Plane(), {"x": (0, 0.1), "y": (0, 0.1)}, (square,), at_least={total: 30 * mm})
    best = minimise(study.under({"x": 1 * mm}))
    assert best.rates == {total: pytest.approx(sum(best.x), rel=1e-3)}
    assert sum(best.x) > 30.9 * mm
