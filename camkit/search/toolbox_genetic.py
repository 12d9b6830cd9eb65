"""The genetic algorithm of a toolbox that many papers call, as an ordinary pymoo algorithm.

Source: Houck, Joines, Kay, A Genetic Algorithm for Function Optimization: A Matlab Implementation (GAOT), North
Carolina State University, TR 95-09, 1995.  The cabin-door paper's equation (10) is such a call:
``normGeomSelect 0.08, arithXover 2, nonUniMutation [2 300 3]``, 300 generations.
"""

from __future__ import annotations

import numpy as np
from pymoo.core.population import Population

from ..quantities import counted
from ..quantities.kinds import numbers, one_number, refuse_arguments
from ..quantities.types import Array
from .evolution import OneObjective


def selection_chances(count: int, best: float) -> np.ndarray:
    """Chances to be selected, the best rank first, ``(count,)``: ``q' (1 - q)^(r - 1)``, ``q' = q / (1 - (1 - q)^n)``.

    Normalised geometric ranking: ``best`` is ``q``, nearly the chance of the best of many.

    >>> selection_chances(3, 0.5).round(4).tolist()
    [0.5714, 0.2857, 0.1429]
    """
    refuse_arguments(selection_chances, locals())
    counted(count, "places", 1)
    _refuse_best(best)
    falling = (1 - best) ** np.arange(count)
    return np.asarray(best / (1 - (1 - best) ** count) * falling)


def crossed(first: object, second: object, share: object) -> tuple[Array, Array]:
    """Arithmetic crossover: two points of the straight line between the parents, as far from either end.

    >>> print(*crossed(0.0, 10.0, 0.2))
    8.0 2.0
    """
    first, second, share = map(numbers, (first, second, share), ("the first", "the second", "the share"))
    return share * first + (1 - share) * second, (1 - share) * first + share * second


def shrinking_step(room: object, draw: object, done: float, shape: float) -> Array:
    """Step of a non-uniform mutation: the way to a bound, ``room``, times ``(draw (1 - done))^shape``.

    ``done`` is the share of the generations that are over; at the end nothing moves any more.

    >>> print(shrinking_step(8.0, 0.5, 0.0, 3), shrinking_step(8.0, 0.5, 1.0, 3))
    1.0 0.0
    """
    refuse_arguments(shrinking_step, locals())
    room, draw = numbers(room, "the room"), numbers(draw, "the draw")
    if not (0 <= done <= 1 and ((draw >= 0) & (draw <= 1)).all()):
        raise ValueError("the draw and the share of the generations that are over must be from 0 to 1")
    return room * (draw * (1 - done)) ** shape


def _refuse_best(best: float) -> None:
    one_number(best, "the chance of the best", "be above 0 and below 1", lambda q: 0 < q < 1)


class ToolboxGenetic(OneObjective):
    """Ranking selection, a few crossovers and mutations in each generation, the best kept (Houck, Joines, Kay 1995).

    A generation:

    - As many as there are, are drawn with replacement by their rank (see `selection_chances`).
    - ``crossovers`` times two of them, drawn by chance, are replaced by their children (see `crossed`).
    - ``mutations`` times one of them moves in one value, up or down, towards its bound (see `shrinking_step`).
    - The worst makes room for the best of the generation before.

    So only a handful of designs is new in each: at most ``2 crossovers + mutations``.  As the toolbox rounds what it
    draws, the first and the last place and value are drawn half as often as the others.  Generations are counted as
    in the toolbox, the first being the random designs; after ``generations`` of them the mutations have shrunk to
    nothing, and a termination ``("n_gen", generations)`` ends the search there.

    Only ranks count.  The toolbox knows no limits: here designs that break fewer come first, then those with the
    smaller objective.

    >>> from pymoo.problems import get_problem
    >>> search = ToolboxGenetic(30, generations=200)
    >>> result = search.setup(get_problem("sphere", n_var=2), termination=("n_gen", 200), seed=1).run()
    >>> bool(result.F < 1e-3), search.evaluator.n_eval <= 30 + 199 * 6
    (True, True)

    Raises ``ValueError`` for a number that makes no sense, and when it is set up for a problem with several
    objectives or without bounds.
    """

    title = "this genetic algorithm"

    def __init__(
        self,
        population: int = 80,
        best: float = 0.08,
        crossovers: int = 2,
        mutations: int = 2,
        generations: int = 300,
        shape: float = 3.0,
        **kwargs: object,
    ) -> None:
        super().__init__(population, **kwargs)
        self.population, self.generations = counted(population, "designs"), counted(generations, "generations")
        self.crossovers = counted(crossovers, "crossovers", 0)
        self.mutations = counted(mutations, "mutations", 1)
        _refuse_best(best)
        one_number(shape, "the shape of the mutation", "be a finite number above 0", lambda v: 0 < v < np.inf)
        self.best, self.shape = best, shape

    def _setup(self, problem: object, **kwargs: object) -> None:
        super()._setup(problem, **kwargs)
        self._number = 1

    def _initialize_advance(self, infills: Population, **kwargs: object) -> None:
        self.pop = infills
        self._remember(infills)

    def _infill(self) -> Population:
        """The designs that are new in this generation."""
        draw = self.random_state
        chances = selection_chances(self.population, self.best)
        chosen = self._ranked(self.pop)[draw.choice(self.population, self.population, p=chances / chances.sum())]
        x = self.pop.get("X")[chosen]
        new = np.zeros(self.population, dtype=bool)
        for a, b in self._places(self.population, (self.crossovers, 2)):
            x[a], x[b] = crossed(x[a], x[b], draw.random())
            new[[a, b]] = True
        done, bounds = self._number / self.generations, self.problem.bounds()
        for a in self._places(self.population, self.mutations):
            value, up = self._places(self.problem.n_var, 1)[0], draw.random() < 0.5
            room = bounds[int(up)][value] - x[a, value]
            x[a, value] += shrinking_step(room, draw.random(), min(done, 1.0), self.shape)
            new[a] = True
        self._kept = self.pop[chosen[~new]]
        return Population.new(X=np.clip(x[new], *bounds))

    def _places(self, count: int, size: object) -> np.ndarray:
        """Places 0 .. count - 1 by rounding, so that both ends come half as often as the others."""
        return np.floor(self.random_state.random(size) * (count - 1) + 0.5).astype(int).reshape(size)

    def _advance(self, infills: Population, **kwargs: object) -> None:
        self._number += 1
        known = self.pop[self._ranked(self.pop)[:1]]
        people = Population.merge(self._kept, infills)
        self.pop = Population.merge(people[self._ranked(people)[:-1]], known)
        self._remember(infills)

    @staticmethod
    def _ranked(people: Population) -> np.ndarray:
        return np.lexsort((people.get("F")[:, 0], people.get("CV")[:, 0]))
