"""`minimise` on minimax problems whose optimum is known in closed form, on known problems, and how it ends."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import linprog

from camkit.machines.cam_lever import cam_lever_study
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_measures import (
    high_speed_study,
    peak_stress,
    peak_wear,
)
from camkit.papers.high_speed_cam import STRESS_CAP
from camkit.quantities import Design, Measure, PeakMeasure, quantity
from camkit.search import minimax
from camkit.search.minimax import FLAT, Epigraph
from camkit.search.minimise import METHODS, minimise
from camkit.search.protocol import search
from camkit.study.study import Study
from camkit.study.weighted import weighted
from camkit.units import mm
from known_problems import KNOWN_PROBLEMS

# ---------------------------------------------------------------- closed forms


@dataclass(frozen=True)
class Polynomial(Design):
    """``x^3 + a x^2 + b x + c`` at ``n`` points from -1 to 1, which stand for cam angles."""

    a: float = quantity("a", 0.6, -2, 2, "", "of x^2", above=None)
    b: float = quantity("b", 0.5, -2, 2, "", "of x", above=None)
    c: float = quantity("c", -0.4, -2, 2, "", "constant", above=None)

    def analyse(self, n):
        x = np.linspace(-1, 1, n)
        return x, x**3 + self.a * x**2 + self.b * x + self.c


def over_x(name, curve):
    return PeakMeasure(name, "", lambda analysis: curve(*analysis), angle=lambda analysis: analysis[0])


size = over_x("size", lambda x, y: abs(y))
top, bottom = over_x("top", lambda x, y: y), over_x("depth", lambda x, y: -y)
at_end = over_x("size at the end", lambda x, y: abs(y[..., -20:]))
FREE = ("a", "b", "c")


def chebyshev(**limits):
    return Study(Polynomial(), FREE, (size,), angles=401, **limits)


def test_what_only_rounding_keeps_from_a_bound_is_on_it():
    """A roller of 5e-25 mm cannot be made, and no roller can."""
    problem = Epigraph(chebyshev())
    low, high = problem.study.bounds
    assert (problem.x(np.full(len(low), 1e-20)) == low).all()
    assert (problem.x(np.full(len(low), 1 - 1e-15)) == high).all()
    assert (problem.x(np.full(len(low), 1e-9)) > low).all()


@pytest.mark.parametrize("moved", [0, 1e-3, -1e-2])
def test_a_design_is_flat_where_no_small_change_in_any_direction_lowers_it(moved):
    problem = Epigraph(chebyshev())
    u = problem.u(np.array([0, -3 / 4, 0])) + np.array([0, moved, 0])
    small = 1e-4 * np.random.default_rng(1).uniform(-1, 1, (5000, 3))
    sizes = problem.columns(np.vstack([u, u + small])).max(-1)
    falls = (sizes[0] - sizes[1:]).max() / 1e-4
    assert problem.is_flat(u) == (falls <= FLAT) == (moved == 0)


def test_a_line_search_that_ends_in_the_last_digits_has_converged(monkeypatch):
    descend = Epigraph._slsqp

    def unsure(*given):
        found = descend(*given)
        found.success = False
        return found

    monkeypatch.setattr(Epigraph, "_slsqp", unsure)
    for study in (chebyshev(), high_speed_study(objective=peak_wear)):
        assert minimise(study).message.startswith("Converged: ")
    monkeypatch.setattr(minimax, "STEPS", 1)
    assert minimise(high_speed_study()).message.startswith("Stopped: ")


def test_the_cubic_of_least_size_is_chebyshevs():
    """T_3 / 4 = x^3 - 3/4 x: size 1/4, reached at -1, -1/2, 1/2 and 1."""
    best = minimise(chebyshev())
    assert best.f == pytest.approx(1 / 4, abs=1e-10)
    assert best.x == pytest.approx([0, -3 / 4, 0], abs=1e-9)
    (peak,) = best.active
    assert peak.kind == "peak"
    assert peak.angles == pytest.approx([-1, -1 / 2, 1 / 2, 1], abs=1e-12)
    assert best.feasible
    assert best.design == Polynomial(*best.x)
    assert "Converged: no small change lowers it further. Smallest found: the size 0.25 at " in best.message
    assert "size 0.25 at -57.3, -28.6, 28.6 and 57.3 deg. No limit is reached." in best.message


def test_a_limit_on_a_peak_holds_at_every_point():
    """With y >= -1/8 everywhere the best size is that of the polynomial shifted: top 3/8, bottom -1/8."""
    for limit in ({"at_most": {bottom: 1 / 8}}, {"at_least": {-bottom: -1 / 8}}):
        best = minimise(chebyshev(**limit))
        assert best.f == pytest.approx(3 / 8, abs=1e-9)  # limits are kept with 1e-9 to spare
        _, y = best.design.analyse(401)
        assert y.min() == pytest.approx(-1 / 8, abs=1e-9)
        assert [a.kind for a in best.active] == ["peak", "limit"]
        assert "At their limits: the depth" in best.message


@pytest.mark.parametrize(("room", "said"), [(0.05, "No limit is reached."), (0.0, "At their limits: the room 0 mm.")])
def test_a_limit_of_0_is_reached_to_a_ten_thousandth_of_its_unit(room, said):
    left = Measure("room", "mm", lambda _: room * mm)
    assert said in minimise(chebyshev(at_least={left: 0.0})).message


def test_a_limit_that_asks_for_a_large_peak_is_taken_as_a_number():
    """`at_least` on a peak cannot hold at every point; the top of 1 is reached where the size is smallest."""
    best = minimise(chebyshev(at_least={top: 1.0}))
    assert best.f == pytest.approx(1.0, abs=1e-9)
    assert top(best.design.analyse(401)) == pytest.approx(1.0, abs=1e-9)


def test_a_weighted_sum_of_peaks_has_a_bound_for_each():
    """top + 3 depth: shifting the cubic trades one for the other, so depth - its bound - goes to the corner c = 2."""
    study = Study(
        Polynomial(), {"a": (-2, 2), "b": (-2, 2), "c": (0, 0.1)}, (weighted("sum", {top: 1, bottom: 3}, (1, 1)),)
    )
    best = minimise(study)
    assert best.x == pytest.approx([0, -3 / 4, 0.1], abs=1e-7)
    assert best.f == pytest.approx(0.35 + 3 * 0.15, abs=1e-9)
    assert [a.name for a in best.active] == ["top", "depth", "c"]
    assert str(best.active[-1]) == "c = 0.1 (upper bound)"


def test_a_sum_of_absolute_values_is_a_sum_of_peaks():
    """Least absolute deviations of a parabola from an exponential at 9 points: linear programming knows the answer."""
    x = np.linspace(-1, 1, 9)
    vander = np.column_stack([x**2, x, np.ones(9)])
    y = np.exp(x) - x**3
    slack = np.eye(9)
    rows = np.block([[vander, -slack], [-vander, -slack]])
    exact = linprog([0, 0, 0, *np.ones(9)], rows, np.concatenate([y, -y]), bounds=[(-2, 2)] * 3 + [(0, None)] * 9).fun

    def deviation(k):
        return PeakMeasure(f"point {k}", "", lambda a: np.stack([np.exp(x) - a[1], a[1] - np.exp(x)], -1)[..., k, :])

    total = weighted("total", {deviation(k): 1 for k in range(9)}, np.ones(9))
    assert minimise(Study(Polynomial(), FREE, (total,), angles=9)).f == pytest.approx(exact, abs=1e-10)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_comes_near_chebyshevs_cubic_and_repeats_itself(method):
    first, again = (minimise(chebyshev(), method, seed=3, designs=4000) for _ in range(2))
    assert first.f == pytest.approx(1 / 4, abs={"slsqp": 1e-9, "de": 1e-3}.get(method, 0.05))
    assert (first.x == again.x).all()
    assert first.message == again.message
    assert 0 < first.evaluations < 4500
    assert first.message.startswith(("Converged: ", "Stopped: "))


@pytest.mark.parametrize("problem", KNOWN_PROBLEMS, ids=lambda p: p.name)
def test_problems_without_curves_are_solved_as_well(problem):
    best = minimise(problem.study, starts=4)
    assert best.feasible
    assert best.f == pytest.approx(problem.f, rel=1e-6)
    assert len(best.active) > 1


# ---------------------------------------------------------------- how it ends


def test_random_starts_find_the_lower_of_two_valleys():
    @dataclass(frozen=True)
    class Valleys(Design):
        x: float = quantity("x", -1, -2, 2, "", "place", above=None)

        def analyse(self, n):
            return (self.x**2 - 1) ** 2 + 0.2 * self.x + 0 * np.arange(3)

    height = PeakMeasure("height", "", lambda a: a)
    study = Study(Valleys(x=1.0), ("x",), (height,))
    assert minimise(study).x > 0
    several = minimise(study, starts=5, seed=2)
    assert several.x < 0
    assert len(several.ends) == 5
    assert "of 5 restarts ended with this objective" in several.message


def test_a_start_that_has_no_objective_is_left_by_random_starts():
    undercut = HighSpeedCam(165 * mm, 130 * mm, 130 * mm)
    study = high_speed_study(undercut)
    assert not np.isfinite(study.evaluate(study.x0).f).all()
    best = minimise(study)
    assert best.feasible
    assert best.f * mm**0.5 == pytest.approx(1.6830, abs=1e-4)


def test_what_cannot_be_kept_is_said():
    impossible = minimise(high_speed_study(at_most={peak_stress: 1 / mm**0.5}), starts=2)
    assert not impossible.feasible
    assert "keeps every limit; this one misses the stress index F_sigma of at most 1 N^0.5 mm^-0.5 by " in (
        impossible.message
    )
    study = high_speed_study(HighSpeedCam(165 * mm, 130 * mm, 130 * mm), space={"max_radius": (128 * mm, 129 * mm)})
    nothing = minimise(study)
    assert not nothing.feasible
    assert nothing.f == np.inf
    assert nothing.active == ()
    assert "No design was found for which there is a stress index F_sigma" in nothing.message


def test_it_never_ends_worse_than_it_began():
    best = minimise(high_speed_study())
    for method in METHODS:
        again = minimise(high_speed_study(best.design), method, designs=200)
        assert again.f <= best.f
        assert again.feasible


WELDED_BEAM = next(problem for problem in KNOWN_PROBLEMS if problem.name == "welded beam")


@pytest.mark.parametrize("method", [method for method in METHODS if method != "slsqp"])
def test_a_search_without_slopes_says_how_far_it_came(method):
    early = minimise(WELDED_BEAM.study, method, designs=500)
    assert early.f > 1.02 * WELDED_BEAM.f
    assert WELDED_BEAM.study.evaluate(early.descended).f[0, 0] == pytest.approx(WELDED_BEAM.f, rel=1e-6)
    assert WELDED_BEAM.study.evaluate(early.descended).feasible.all()
    better = 100 * (1 - WELDED_BEAM.f / early.f)
    assert f"A descent from there ends at 1.725, {better:.2g} % better: this search had not" in early.message
    done = minimise(WELDED_BEAM.study.replace(start=WELDED_BEAM.study.design(WELDED_BEAM.x)), method, designs=200)
    assert "A descent from there ends no better" in done.message


WATCHED = {
    "sizes": high_speed_study(),
    "laws": high_speed_study(objective=peak_wear, at_most={peak_stress: STRESS_CAP}, free_laws=True, angles=101),
    "press": cam_lever_study(angles=101),
}


@pytest.mark.parametrize(
    ("name", "method"), [("sizes", "slsqp"), ("sizes", "de"), ("sizes", "ga"), ("laws", "slsqp"), ("press", "slsqp")]
)
def test_every_best_so_far_is_feasible_by_its_own_study(name, method):
    """Searches walk along limits: what a step calls the best so far is judged as the study judges it."""
    study, seen = WATCHED[name], []
    for step in search(study, method, designs=1500):
        if step.best and not step.message and not (seen and (seen[-1] == step.best.x).all()):
            seen.append(step.best.x)
            best = step.best
    found = step.best
    assert found.feasible
    assert len(seen) > 2  # 3 or 8, by the last bits of the processor's sums
    verdict = study.evaluate(np.array(seen))
    assert verdict.feasible.all()
    assert (np.diff(verdict.f[:, 0]) < 0).all()
    assert best.f == pytest.approx(verdict.f[-1, 0], rel=1e-12)
    assert study.evaluate(found.x).feasible.all()
    assert found.f <= best.f * (1 + 1e-6)


@pytest.mark.parametrize(
    ("study", "call", "sentence"),
    [
        (Study(Polynomial(), FREE, (top, bottom)), {}, r"has 2 objectives; minimise takes one"),
        (chebyshev(), {"method": "newton"}, r"the method is 'newton'; there are 'slsqp', 'de', 'ga', 'competitive'"),
        (chebyshev(), {"starts": 0}, r"the number of starts is 0; it must be a whole number of at least 1"),
        (chebyshev(), {"seed": -1}, r"the seed is -1; it must be a whole number of at least 0"),
        (chebyshev(), {"designs": 1.5}, r"the number of designs is 1.5; it must be a whole number"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(study, call, sentence):
    with pytest.raises(ValueError, match=sentence):
        minimise(study, **call)
