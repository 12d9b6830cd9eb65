"""How every search by pymoo is set up: a study as its problem, and what algorithms for one objective share."""

from __future__ import annotations

from typing import Any

import numpy as np
from pymoo.core.algorithm import Algorithm
from pymoo.core.population import Population
from pymoo.core.problem import Problem
from pymoo.core.repair import Repair
from pymoo.operators.crossover.sbx import SBX
from pymoo.operators.mutation.pm import PM
from pymoo.util.display.single import SingleObjectiveOutput
from pymoo.util.optimum import filter_optimum

from ..quantities.applied import applied
from ..study.free import Menu
from ..study.study import Study
from .checkpoint import WORST
from .protocol import looked_at, on_grid


class StudyProblem(Problem):
    """A `Study` as pymoo sees it: one call evaluates a whole generation."""

    def __init__(self, study: Study) -> None:
        with applied("a search", study):
            low, high = study.bounds
            self.menus = np.array([isinstance(free, Menu) for free in study.free.values()])
            low, high = low - self.menus / 2, high + self.menus / 2  # as much room for each option
            counts = {"n_obj": len(study.minimise), "n_ieq_constr": len(study.limits)}
        super().__init__(n_var=len(study.free), xl=low, xu=high, **counts)
        self.study = study

    def _evaluate(self, x: np.ndarray, out: dict[str, object], *args: object, **kwargs: object) -> None:
        evaluation = looked_at(self.study, x)
        out["F"] = np.minimum(evaluation.f, WORST)
        out["G"] = np.minimum(np.where(evaluation.missed > 0, evaluation.g, np.minimum(evaluation.g, 0)), WORST)


class OnGrid(Repair):
    """Moves free values onto the grid of `on_grid`."""

    def _do(self, problem: Problem, x: np.ndarray, **kwargs: object) -> np.ndarray:
        low, high = problem.xl, problem.xu
        x = np.clip(low + on_grid((x - low) / (high - low)) * (high - low), low, high)
        return problem.study.rows(x) if problem.study.menus else x


class _Exchange(SBX):
    """Crossover of numbers by `SBX`; an option is that of one parent or the other."""

    def _do(self, problem: Any, X: np.ndarray, *args: object, random_state: Any = None, **kwargs: object) -> np.ndarray:
        crossed = super()._do(problem, X, *args, random_state=random_state, **kwargs)
        other = random_state.random(X.shape[1:]) < 0.5
        return np.where(problem.menus, np.where(other, X[::-1], X), crossed)


class _Draw(PM):
    """Mutation of numbers by `PM`; in place of an option any other is drawn."""

    def _do(self, problem: Any, X: np.ndarray, *args: object, random_state: Any = None, **kwargs: object) -> np.ndarray:
        mutated = super()._do(problem, X, *args, random_state=random_state, **kwargs)
        drawn = random_state.uniform(problem.xl, problem.xu, X.shape)
        again = random_state.random(X.shape) < self.get_prob_var(problem, size=len(X))[:, None]
        return np.where(problem.menus, np.where(again, drawn, X), mutated)


def mixed(study: Study, **given: Any) -> dict[str, Any]:
    """What an algorithm of pymoo needs besides where menus are free among the numbers."""
    if not study.menus:
        return {}
    return {"crossover": _Exchange(**given), "mutation": _Draw(), "repair": OnGrid()}


class OneObjective(Algorithm):
    """An algorithm for one objective within bounds: ``size`` designs drawn evenly at first, the best never forgotten.

    Raises ``ValueError`` when it is set up for a problem with several objectives or without bounds.
    """

    title: str
    """How it is called in sentences."""

    def __init__(self, size: int, **kwargs: object) -> None:
        super().__init__(output=kwargs.pop("output", SingleObjectiveOutput()), **kwargs)
        self.size, self.opt = size, None

    def _setup(self, problem: Any, **kwargs: object) -> None:
        if problem.n_obj != 1:
            raise ValueError(f"there are {problem.n_obj} objectives; {self.title} takes one")
        if not problem.has_bounds():
            raise ValueError(f"a variable has no bounds; {self.title} needs them")

    def _initialize_infill(self) -> Population:
        return self._people(self.random_state.random((self.size, self.problem.n_var)))

    def _people(self, place: np.ndarray) -> Population:
        """Designs from shares of the bounds."""
        low, high = self.problem.bounds()
        return Population.new(X=low + place * (high - low))

    def _remember(self, people: Population) -> None:
        """A design that keeps every limit is not forgotten, whatever the algorithm prefers."""
        known = people if self.opt is None else Population.merge(self.opt, people)
        self._best = filter_optimum(known, least_infeasible=True)

    def _set_optimum(self) -> None:
        self.opt = self._best
