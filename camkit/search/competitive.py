"""The competitive (election) algorithm of the universal-joint shaft's paper, as an ordinary pymoo algorithm."""

from __future__ import annotations

import numpy as np
from pymoo.core.population import Population

from ..quantities import counted
from ..quantities.kinds import one_number
from .evolution import OneObjective


class CompetitiveAlgorithm(OneObjective):
    """Candidates move to where their supporters are; the best of everybody stand in the next cycle.

    Source: Lyu, Du, Li, Yuan, Luo, Guangdong University of Technology, 2007.  The paper tells the idea and prints
    no formulas.  Distances are taken in coordinates that run from 0 to 1 between the bounds.  A cycle:

    - Each of ``candidates`` draws ``local_voters`` around it (normal with ``variance`` in each coordinate, cut
      off at the bounds); ``global_voters`` are drawn evenly over the whole box.
    - The effect of a candidate on a voter falls with their distance, ``e = exp(-dist^2 / (2 reach^2))``.
    - A voter's standing is ``F_max - F``, so the worst voter has none.  It is shared out in proportion to the
      effects, and a candidate gets its share as far as it reaches: ``support = standing * e * e / sum(e)``.
    - Each candidate moves to the centroid of the voters weighted by their support.
    - The best of old candidates, voters and moved candidates are the next candidates.

    Limits count as a penalty: ``F = f + penalty * violation * |f|`` with pymoo's summed violation.

    What is assumed beyond the paper's words: the two formulas of effect and support, ``reach``, the cut at the
    bounds, the even first draw, and that an old candidate may stand again.  ``narrowing`` is not the paper's: a
    candidate that stands again multiplies the deviation of its local voters by it, one that has just moved
    divides it by its square (never above ``sqrt(variance)``).  1, the default, keeps the paper's fixed variance,
    with which the search comes to 1 % of an optimum and seldom to 0.1 %; 0.9 helps.

    One generation of pymoo is one cycle of ``candidates * (local_voters + 1) + global_voters`` evaluations in two
    calls; the first generation is the first candidates.  ``paths`` keeps where they stood.

    >>> from pymoo.problems import get_problem
    >>> search = CompetitiveAlgorithm().setup(get_problem("sphere", n_var=2), termination=("n_gen", 41), seed=1)
    >>> result = search.run()
    >>> bool(result.F < 1e-3), search.paths[0].shape, search.evaluator.n_eval
    (True, (41, 4, 2), 884)

    Raises ``ValueError`` for a number that makes no sense, and when it is set up for a problem with several
    objectives or without bounds.
    """

    title = "the competitive algorithm"

    def __init__(
        self,
        candidates: int = 4,
        local_voters: int = 3,
        global_voters: int = 6,
        variance: float = 0.02,
        reach: float = 0.3,
        penalty: float = 10.0,
        narrowing: float = 1.0,
        **kwargs: object,
    ) -> None:
        super().__init__(candidates, **kwargs)
        counted(candidates, "candidates", 1)
        counted(local_voters, "local voters", 1)
        counted(global_voters, "global voters", 0)
        for name, value in (("variance", variance), ("reach", reach), ("penalty", penalty)):
            one_number(value, f"the {name}", "be a finite number above 0", lambda v: 0 < v < np.inf)
        one_number(narrowing, "the narrowing", "be above 0 and at most 1", lambda v: 0 < v <= 1)
        self.candidates, self.local_voters, self.global_voters = candidates, local_voters, global_voters
        self.variance, self.reach, self.penalty, self.narrowing = variance, reach, penalty, narrowing
        self._path: list[tuple[np.ndarray, np.ndarray]] = []

    @property
    def paths(self) -> tuple[np.ndarray, np.ndarray]:
        """Each cycle's candidates, best first: ``x``, ``(cycles + 1, candidates, n)``, and ``f``, an axis less."""
        x, f = zip(*self._path, strict=True)
        return np.array(x), np.array(f)

    def _setup(self, problem: object, **kwargs: object) -> None:
        super()._setup(problem, **kwargs)
        self._path = []

    def _place(self, people: Population) -> np.ndarray:
        low, high = self.problem.bounds()
        return (people.get("X") - low) / (high - low)

    def _initialize_advance(self, infills: Population, **kwargs: object) -> None:
        self._elect(infills, np.full(self.candidates, np.sqrt(self.variance)))

    def _infill(self) -> Population:
        drawn = self.random_state.standard_normal((self.candidates, self.local_voters, self.problem.n_var))
        local = self._place(self.pop)[:, None] + self._deviation[:, None, None] * drawn
        everywhere = self.random_state.random((self.global_voters, self.problem.n_var))
        return self._people(np.clip(np.concatenate([local.reshape(-1, self.problem.n_var), everywhere]), 0, 1))

    def _advance(self, infills: Population, **kwargs: object) -> None:
        moved = self._people(self._centroids(infills))
        self.evaluator.eval(self.problem, moved, algorithm=self)
        stays, full = self._deviation * self.narrowing, np.sqrt(self.variance)
        moves = np.minimum(self._deviation / self.narrowing**2, full)
        local = np.repeat(moves, self.local_voters)
        deviation = np.concatenate([stays, local, np.full(self.global_voters, full), moves])
        self._elect(Population.merge(self.pop, infills, moved), deviation)

    def _centroids(self, voters: Population) -> np.ndarray:
        """Where each candidate's support is; a candidate whom nobody supports stays."""
        old, place = self._place(self.pop), self._place(voters)
        distance = ((old[:, None] - place[None]) ** 2).sum(-1)
        effect = np.exp(-distance / (2 * self.reach**2))
        cost = self._cost(voters)
        standing = cost.max() - cost
        total = effect.sum(0)
        support = standing * effect * np.divide(effect, total, out=np.zeros_like(effect), where=total > 0)
        weight = support.sum(1, keepdims=True)
        return np.where(weight > 0, support @ place / np.where(weight > 0, weight, 1), old)

    def _cost(self, people: Population) -> np.ndarray:
        f, violation = people.get("F")[:, 0], people.get("CV")[:, 0]
        return f + self.penalty * violation * abs(f)

    def _elect(self, people: Population, deviation: np.ndarray) -> None:
        best = np.argsort(self._cost(people), kind="stable")[: self.candidates]
        self.pop, self._deviation = people[best], deviation[best]
        self._path.append((self.pop.get("X"), self.pop.get("F")[:, 0]))
        self._remember(people)  # the penalty may prefer a design that does not keep every limit
