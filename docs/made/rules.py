"""Rules to choose from a front beside each other: what each chooses, and what sways it, on many drawn fronts."""

from collections.abc import Callable
from functools import cache

import numpy as np

from camkit import DoorHandleCam, Front, door_handle_study, quick_front
from camkit.decision import CHOOSERS, achievement
from camkit.search.front import dominated

from .tables import best, table

RULES: dict[str, Callable] = {**CHOOSERS, "nearest to a wish": lambda front, weights=None: achievement(front)}
FRONTS, DESIGNS, SEED = 300, 24, 1


@cache
def door_front() -> Front:
    return quick_front(door_handle_study(DoorHandleCam()), 60)


def chosen() -> str:
    """What each rule chooses from the front of the door handle's cam, with equal weights."""
    front = door_front()
    at = {name: front.f[rule(front)] for name, rule in RULES.items()}
    goals = front.study.minimise
    rows = [(name, *(g.text(g.sign * value) for g, value in zip(goals, f, strict=True))) for name, f in at.items()]
    return table(("rule", *(goal.name for goal in front.study.minimise)), rows)


@cache
def drawn() -> list[np.ndarray]:
    """Fronts of two objectives and different bends, as tables of designs of which none is dominated."""
    random = np.random.default_rng(SEED)
    bends, at = random.uniform(0.4, 2.5, FRONTS), np.sort(random.uniform(0, 1, (FRONTS, DESIGNS)), axis=1)
    fronts = [np.stack([x, (1 - x**bend) ** (1 / bend)], axis=1) for x, bend in zip(at, bends, strict=True)]
    return [front[~dominated(front)] for front in fronts]


def swayed(rule: Callable, change: Callable[[np.ndarray, int, np.random.Generator], np.ndarray]) -> float:
    """The share of fronts, %, on which ``rule`` chooses another design after a change that says nothing of designs.

    ``change`` gives the front anew, the designs in their order; a design that it leaves out becomes a row of ``nan``.
    """
    random, count = np.random.default_rng(SEED), 0
    for front in drawn():
        k = rule(front)
        other = change(front, k, random)
        left = np.flatnonzero(np.isfinite(other[:, 0]))
        count += int(left[rule(other[left])] != k)
    return 100 * count / len(drawn())


def other_unit(front: np.ndarray, k: int, random: np.random.Generator) -> np.ndarray:
    return front * [25.4, 1]


def other_zero(front: np.ndarray, k: int, random: np.random.Generator) -> np.ndarray:
    return front + np.array([0, 2])


def one_gone(front: np.ndarray, k: int, random: np.random.Generator) -> np.ndarray:
    """One design less, which was not chosen."""
    gone = random.choice([i for i in range(len(front)) if i != k])
    return np.where(np.arange(len(front))[:, None] == gone, np.nan, front)


def best_gone(front: np.ndarray, k: int, random: np.random.Generator) -> np.ndarray:
    """Without the design at the end of the front that was not chosen."""
    end = int(np.argmin(front[:, 0]))
    end = end if end != k else int(np.argmin(front[:, 1]))
    return np.where(np.arange(len(front))[:, None] == end, np.nan, front)


def more_weight(name: str) -> float:
    """The share of fronts, %, on which a rule chooses another design with weights 0.6, 0.4 than with equal ones."""
    rule = RULES[name]
    return 100 * float(np.mean([rule(front, [0.6, 0.4]) != rule(front, [0.5, 0.5]) for front in drawn()]))


CHANGES = {
    "one objective in another unit": other_unit,
    "one objective from another zero": other_zero,
    "any other design taken away": one_gone,
    "an end of the front taken away": best_gone,
}


def sways() -> str:
    """How often each rule chooses another design after a change that should not matter, and after one that should."""
    columns = [best([swayed(rule, change) for rule in RULES.values()], 3) for change in CHANGES.values()]
    weights = [more_weight(name) for name in RULES]
    return table(("rule", *CHANGES, "weights 0.6, 0.4"), zip(RULES, *columns, weights, strict=True), 3)
