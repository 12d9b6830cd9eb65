"""`minimise`: the best design of a study with one objective, and why the search stopped there.

It knows studies, not mechanisms.  An objective or a limit that is a `PeakMeasure` is seen angle by angle by the
method ``"slsqp"`` (see `Epigraph`), and as one number by the others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import count, islice
from typing import Any

import numpy as np

from ..quantities import D, counted
from ..quantities.kinds import refuse_arguments, whole
from ..study.robust import RobustStudy
from ..study.study import KEPT, Evaluation, Study
from .minimax import Epigraph
from .minimum import SAME, Found, Minimum, described
from .options import best_of_options
from .parts import Arrays
from .protocol import Step, ended, looked_at, plain, stepwise
from .threads import in_one_thread

ROUGH, EXACT = 1e-6, 1e-10
"""Precision of SLSQP from each start, and from the best of their ends."""
SPARE = 3
"""How many more starts there may be if no descent ended at a design that keeps every limit."""
CROWD = 32
"""How many random designs compete to be a further start."""
PASSES, SETTLED = 6, 1e-5
"""How often margins for tolerances are renewed at most, and by how much less than this they then change."""
LACKING = 1e-4
"""By how much limits may be missed by exact parts, as a share of them."""
TRIES = 4
"""How often limits are tightened until the result keeps them; it is aimed at half of ``KEPT`` inside them."""


def minimise(
    study: Study[D],
    method: str = "slsqp",
    seed: int = 1,
    *,
    starts: int = 1,
    designs: int = 20_000,
    recheck: int | None = None,
) -> Minimum[D]:
    """The design with the least objective that keeps all limits of ``study``.

    - ``"slsqp"`` descends from the study's start and from ``starts - 1`` random designs; seconds.  Where the
      objective or a limit is a `PeakMeasure` it sees every angle, so that it does not stall on a ridge.  If no
      descent ends at a design that keeps every limit, a few more begin at random.
    - ``"de"`` (differential evolution, scipy), ``"ga"`` (pymoo) and ``"competitive"`` (`CompetitiveAlgorithm`, with a
      ``narrowing`` of 0.9 that is not its paper's) need no slopes and no start: they look at about ``designs`` designs.
      How far they came is then checked by a descent from their result; the message says it, ``descended`` has its end.

    Where menus are free ``"slsqp"`` goes through all combinations of options, up to 200, each a search of its own, and
    ``options`` of the result says what each reached; the other methods search options and numbers together.

    Of a study under tolerances (`Study.under`) ``"slsqp"`` tightens the limits until enough of the parts keep them.

    ``recheck``: how many angles the result is judged on, if not those of the study; ``"slsqp"`` tightens limits until
    they hold there.  The result is never worse than the study's start, and repeatable for a seed.

    >>> from camkit.machines import high_speed_study
    >>> best = minimise(high_speed_study())
    >>> best.evaluations < 200, *(f"{held.name} {held.value}" for held in best.active)
    (True, 'stress index F_sigma 1.683 N^0.5 mm^-0.5', 'radius at the far dwell 140 mm (upper bound)')

    Raises ``ValueError`` for a study with several objectives, an unknown method, or numbers that are no whole ones.
    """
    whole(seed, "the seed", 0, 2**32 - 1)
    starts, designs = counted(starts, "starts", 1), counted(designs, "designs", 1)
    refuse_arguments(minimise, locals())
    if len(study.minimise) != 1:
        raise ValueError(
            f"the study has {len(study.minimise)} objectives; minimise takes one: weigh them with weighted(), "
            "or search their front with nsga2()"
        )
    if method not in METHODS:
        raise ValueError(f"the method is {method!r}; there are {', '.join(map(repr, METHODS))}")
    judge = study if recheck is None else study.replace(angles=recheck)
    if study.menus and method == "slsqp":
        each = partial(minimise, method=method, seed=seed, starts=starts, designs=designs, recheck=recheck)
        return best_of_options(study, plain(judge), each)
    with in_one_thread():
        found = METHODS[method](study, judge, seed, starts, designs)
        if method != "slsqp":
            found = _checked(plain(study), plain(judge), found)
        return described(plain(judge), found)


def minimise_steps(
    study: Study,
    method: str = "slsqp",
    seed: int = 1,
    *,
    starts: int = 1,
    designs: int = 20_000,
    recheck: int | None = None,
) -> Iterator[Step]:
    """`minimise` one evaluation at a time."""
    work = partial(minimise, method=method, seed=seed, starts=starts, designs=designs, recheck=recheck)
    descents = (counted(starts, "starts", 1) + 1) * (study.options.count if study.menus else 1)
    return stepwise(study, work, 0 if method == "slsqp" else designs, descents)


def _broken(evaluation: Evaluation) -> np.ndarray:
    """By how much each design misses its limits, all together, ``(p,)``."""
    return np.asarray(evaluation.missed.sum(-1))


def _merit(evaluation: Evaluation) -> tuple[float, float]:
    """Of one design: broken limits first, then the objective."""
    return float(_broken(evaluation)[0]), float(evaluation.f[0, 0])


def _better(study: Study, *candidates: np.ndarray) -> np.ndarray:
    """The best of some designs and the study's start."""
    return min((_start(study), *candidates), key=lambda x: _merit(study.evaluate(x)))


def _start(study: Study) -> np.ndarray:
    """The free values of the study's start, moved into their bounds."""
    return np.clip(study.x0, *study.bounds)


# ---------------------------------------------------------------- SLSQP


def _slsqp(study: Study, judge: Study, seed: int, starts: int, designs: int) -> Found:
    if isinstance(study, RobustStudy) and isinstance(judge, RobustStudy):
        return _within_tolerances(study, judge, seed, starts, designs)
    ends, merits, evaluations = [], [], 0
    for x in islice(_starts(study, seed), starts + SPARE):
        end, used, _ = _descent(study, x, ROUGH, 2 * ROUGH)
        ends.append(end)
        merits.append(_merit(study.evaluate(end)))
        evaluations += used
        if len(ends) >= starts and min(merits)[0] < SAME:
            break
    nearly = [(broken if broken >= SAME else 0.0, f) for broken, f in merits]
    best, used, finished = _tightened(study, judge, ends[nearly.index(min(nearly))])
    stopped = "Converged: no small change lowers it further" if finished else "Stopped: no step made the design better"
    f = tuple(f if broken < SAME else np.inf for broken, f in merits)
    return Found(best, evaluations + used, f, stopped)


def _within_tolerances(study: RobustStudy, judge: RobustStudy, seed: int, starts: int, designs: int) -> Found:
    """Descents with margins in place of tolerances, which are renewed from exact parts at each end."""
    if study.objective != "nominal":
        raise ValueError(
            f"the method 'slsqp' makes the nominal objective small; this study has the objective {study.objective!r}: "
            "take 'de', 'ga' or 'competitive'"
        )
    margins = np.maximum(np.nan_to_num(study.margins(_start(study))[0], posinf=0.0, neginf=0.0), 0)
    used, ends, finished = 0, [_start(study)], ""
    lacking = [_lacking(judge, ends[0], judge.exact_margins(ends[0]))]
    for number in range(PASSES):
        tight, judging = (which.tightened(partial(_constant, margins)) for which in (study, judge))
        found = _slsqp(tight.replace(start=study.design(ends[-1])), judging, seed, 1 if number else starts, designs)
        ends.append(found.x)
        used, finished = used + found.evaluations, found.why
        (needed,) = ended(judge, found.x, partial(_exact_margins, judge, found.x), lambda known: 0)
        lacking.append(_lacking(judge, found.x, needed))
        before, margins = margins, np.maximum(needed, 0)
        missed = plain(judge).evaluate(found.x).missed[0]
        if (abs(margins - before) < SETTLED).all() and not missed.any():
            break
        margins = np.maximum(margins, np.where(missed > 0, before + 1.1 * np.where(np.isfinite(missed), missed, 1), 0))
    best = min(zip(lacking, ends, strict=True), key=lambda end: (end[0], *_merit(plain(judge).evaluate(end[1]))))
    return Found(best[1], used, (), finished)


def _lacking(study: RobustStudy, x: np.ndarray, margins: np.ndarray) -> float:
    """By how much a design misses its limits by exact parts; 0 where that is within what margins settle to."""
    missed = float(np.maximum(study.nominal.evaluate(x).g[0] + margins, 0).sum())
    return missed if missed > LACKING else 0.0


def _exact_margins(judge: RobustStudy, x: np.ndarray) -> Arrays:
    return (judge.exact_margins(x),)


def _constant(margins: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The same margins for all designs ``(p, n_free)``."""
    return np.broadcast_to(margins, (len(x), len(margins)))


def _descent(
    study: Study, x: np.ndarray, precision: float, margins: float | np.ndarray = 0.0
) -> tuple[np.ndarray, int, bool]:
    """The end of a descent from ``x``, the designs it took and whether it came to an end."""

    def work() -> Arrays:
        size = float(abs(study.evaluate(x).f[0, 0]))
        if not np.isfinite(size):
            return x, np.array([1, 0])
        problem = Epigraph(study, size or 1.0, margins)
        descent = problem.descend(problem.u(x), precision)
        return problem.x(descent.u), np.array([problem.evaluations + 1, descent.finished])

    asked = np.concatenate([x, [precision], np.ravel(margins)])
    end, (used, finished) = ended(study, asked, work, lambda found: int(found[1][0]))
    return end, int(used), bool(finished)


def _tightened(study: Study, judge: Study, x: np.ndarray) -> tuple[np.ndarray, int, bool]:
    """The exact end of a descent, its limits tightened until the result keeps them on the judge's angles."""
    margins, used, finished, ends = np.full(len(study.limits), KEPT / 2), 0, False, [x]
    for _ in range(TRIES):
        end, more, finished = _descent(study, ends[-1], EXACT, margins)
        used += more
        ends.append(end)
        broken = judge.evaluate(end).missed[0]
        if not broken.any() or not np.isfinite(broken).all():
            break
        margins = margins + 1.1 * broken
    return _better(judge, *ends), used, finished


def _starts(study: Study, seed: int) -> Iterator[np.ndarray]:
    """The study's start, if it has an objective, and random designs without end: the best of a crowd each.

    Every second crowd is drawn from the whole box, the others from a third of it around the start.
    """
    from scipy.stats import qmc

    start, (low, high) = _start(study), study.bounds
    built = bool(np.isfinite(study.evaluate(start).f).all())
    if built:
        yield start
    draw = qmc.Sobol(len(study.free), rng=seed)
    for k in count():
        wide = low + draw.random(CROWD) * (high - low)
        near = start + (wide - start) / 3
        yield _best_of(study, wide, near) if k % 2 or not (built or k) else _best_of(study, near, wide)


def _best_of(study: Study, crowd: np.ndarray, instead: np.ndarray) -> np.ndarray:
    """The best design of a crowd, or of another if none in it has an objective."""
    evaluation = study.evaluate(crowd)
    f = evaluation.f[:, 0]
    best = np.lexsort((f, _broken(evaluation), np.isinf(f)))[0]
    return crowd[best] if np.isfinite(f[best]) or crowd is instead else _best_of(study, instead, instead)


# ---------------------------------------------------------------- methods without slopes

WORST = 1e12
"""What a method is told of a design that does not keep every limit, and more the less it keeps them."""


def _de(study: Study, judge: Study, seed: int, starts: int, designs: int) -> Found:
    from scipy.optimize import differential_evolution
    from scipy.stats import qmc

    looked = 0

    def told(x: np.ndarray) -> np.ndarray:
        nonlocal looked
        evaluation = looked_at(study, x.T)
        looked += len(evaluation.x)
        f, missed = evaluation.f[:, 0], 1 - 1 / (1 + _broken(evaluation))
        return np.where(evaluation.feasible, f, WORST * (1 + np.where(np.isfinite(f), missed, 1)))

    crowd = 2 ** int(np.ceil(np.log2(10 * len(study.free))))
    try:
        found = differential_evolution(
            told,
            study.bounds.T,
            init=qmc.scale(qmc.Sobol(len(study.free), rng=seed).random(crowd), *study.bounds),
            x0=_start(study),
            maxiter=max(designs // crowd - 1, 1),
            tol=1e-9,
            seed=seed,
            polish=False,
            updating="deferred",
            vectorized=True,
        )
    except RuntimeError as wrapped:  # scipy takes what the study refuses for a fault of its own
        raise (wrapped.__cause__ if isinstance(wrapped.__cause__, ValueError) else wrapped) from None
    why = "Converged: its designs have drawn together" if found.success else f"Stopped: {designs} designs evaluated"
    return Found(_better(judge, found.x), looked, (), why)


def _evolution(algorithm: Any, each: int, study: Study, judge: Study, seed: int, designs: int) -> Found:
    """A search by an algorithm of pymoo that looks at ``each`` designs in a generation."""
    from .evolution import StudyProblem

    generations = max(designs // each, 2)
    algorithm.setup(StudyProblem(study), termination=("n_gen", generations), seed=seed, verbose=False)
    algorithm.run()
    best = _better(judge, *algorithm.opt.get("X"))
    return Found(best, int(algorithm.evaluator.n_eval), (), f"Stopped: {generations} generations evaluated")


def _ga(study: Study, judge: Study, seed: int, starts: int, designs: int) -> Found:
    from pymoo.algorithms.soo.nonconvex.ga import GA

    from .evolution import mixed

    return _evolution(GA(pop_size=100, eliminate_duplicates=False, **mixed(study)), 100, study, judge, seed, designs)


def _competitive(study: Study, judge: Study, seed: int, starts: int, designs: int) -> Found:
    from .competitive import CompetitiveAlgorithm

    return _evolution(CompetitiveAlgorithm(narrowing=0.9), 22, study, judge, seed, designs)


def _checked(study: Study, judge: Study, found: Found) -> Found:
    """With where a descent from what was found ends; its designs are not counted."""
    if not np.isfinite(study.evaluate(found.x).f).all():
        return found
    if isinstance(study, RobustStudy) and study.objective != "nominal":
        return found
    if not study.menus:
        return found._replace(descended=_descended(study, judge, found.x))
    here, at = (which.options.at(found.x) for which in (study, judge))
    if not here.study.free:
        return found
    end = _descended(here.study, at.study, here.x(study.rows(found.x))[0])
    return found._replace(descended=here.rows(end[None])[0])


def _descended(study: Study, judge: Study, x: np.ndarray) -> np.ndarray:
    """Where a descent from a design ends."""
    if isinstance(study, RobustStudy) and isinstance(judge, RobustStudy):
        return _within_tolerances(study.replace(start=study.design(x)), judge, 0, 1, 0).x
    return _tightened(study, judge, x)[0]


METHODS: dict[str, Callable[[Study, Study, int, int, int], Found]] = {
    "slsqp": _slsqp,
    "de": _de,
    "ga": _ga,
    "competitive": _competitive,
}
