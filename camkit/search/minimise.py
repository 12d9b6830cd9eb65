"""`minimise`: the best design of a study with one objective, and why the search stopped there.

It knows studies, not mechanisms.  An objective or a limit that is a `PeakMeasure` is seen angle by angle by the
method ``"slsqp"`` (see `Epigraph`), and as one number by the others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count, islice
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import differential_evolution
from scipy.stats import qmc

from ..kinds import refuse_arguments, whole
from ..quantities import Measure, PeakMeasure, counted, words
from ..study.study import KEPT, Evaluation, Study
from ..units import deg
from .minimax import Epigraph, parts_of
from .protocol import unmonitored

CLOSE = 1e-4
"""A peak or a limit is active if it is reached to within this share of it."""
SAME = 1e-3
"""Starts whose ends differ by less than this share found the same."""
ROUGH, EXACT = 1e-6, 1e-10
"""Precision of SLSQP from each start, and from the best of their ends."""
SPARE = 3
"""How many more starts there may be if no descent ended at a design that keeps every limit."""
CROWD = 32
"""How many random designs compete to be a further start."""
TRIES = 4
"""How often limits are tightened until the result keeps them; it is aimed at half of ``KEPT`` inside them."""


class Active(NamedTuple):
    """What holds a design where it is: a peak of the objective, a limit or a bound; angles in rad."""

    kind: str
    name: str
    value: str
    angles: tuple[float, ...] = ()

    def __str__(self) -> str:
        where = " at " + _listed([f"{angle / deg:.1f}" for angle in self.angles]) + " deg" if self.angles else ""
        symbol = len(self.name) == 1  # a quantity that is known by its letter alone
        return f"{self.name} = {self.value}" if symbol else f"the {self.name} {self.value}{where}"


@dataclass(frozen=True)
class Minimum:
    """The best design that a search found; ``message`` says in words why it stopped and what holds the design there.

    ``x`` are its free values in SI, ``f`` the objective, ``ends`` the objectives at which each start ended (``inf``
    where a limit is broken), ``evaluations`` how many designs were looked at.
    """

    study: Study
    x: np.ndarray
    f: float
    feasible: bool
    evaluations: int
    ends: tuple[float, ...]
    active: tuple[Active, ...]
    message: str
    descended: np.ndarray | None = None
    """Free values where a descent from ``x`` ends; ``None`` after a search that is a descent itself."""

    @property
    def design(self) -> Any:
        """The design itself."""
        return self.study.design(self.x)


def minimise(
    study: Study,
    method: str = "slsqp",
    seed: int = 1,
    *,
    starts: int = 1,
    designs: int = 20_000,
    recheck: int | None = None,
) -> Minimum:
    """The design with the least objective that keeps all limits of ``study``.

    - ``"slsqp"`` descends from the study's start and from ``starts - 1`` random designs; seconds.  Where the
      objective or a limit is a `PeakMeasure` it sees every angle, so that it does not stall on a ridge.  If no
      descent ends at a design that keeps every limit, a few more begin at random.
    - ``"de"`` (differential evolution, scipy), ``"ga"`` (pymoo) and ``"competitive"`` (`CompetitiveAlgorithm`, with a
      ``narrowing`` of 0.9 that is not its paper's) need no slopes and no start: they look at about ``designs`` designs.
      How far they came is then checked by a descent from their result; the message says it, ``descended`` has its end.

    ``recheck``: how many angles the result is judged on, if not those of the study; ``"slsqp"`` tightens limits until
    they hold there.  The result is never worse than the study's start, and repeatable for a seed.

    >>> from camkit.machines.high_speed_study import high_speed_study
    >>> best = minimise(high_speed_study())
    >>> best.evaluations < 200, *(f"{held.name} {held.value}" for held in best.active)
    (True, 'contact stress F_sigma 1.683 N^0.5 mm^-0.5', 'maximum radius 140 mm (upper bound)')

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
    found = METHODS[method](study, judge, seed, starts, designs)
    if method != "slsqp":
        found = _checked(unmonitored(study), unmonitored(judge), found)
    return _told(judge, found)


class _Found(NamedTuple):
    """What a method found, before it is told in words."""

    x: np.ndarray
    evaluations: int
    ends: tuple[float, ...]
    why: str
    descended: np.ndarray | None = None


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


def _slsqp(study: Study, judge: Study, seed: int, starts: int, designs: int) -> _Found:
    ends, merits, evaluations = [], [], 0
    for x in islice(_starts(study, seed), starts + SPARE):
        end, used, _ = _descent(study, x, ROUGH, 2 * ROUGH)
        ends.append(end)
        merits.append(_merit(study.evaluate(end)))
        evaluations += used
        if len(ends) >= starts and min(merits)[0] == 0:
            break
    best, used, finished = _tightened(study, judge, _better(judge, *ends))
    stopped = "the slopes show no way down" if finished else "no step made the design better"
    f = tuple(f if broken == 0 else np.inf for broken, f in merits)
    return _Found(best, evaluations + used, f, stopped)


def _descent(study: Study, x: np.ndarray, precision: float, margins: Any = 0.0) -> tuple[np.ndarray, int, bool]:
    """The end of a descent from ``x``, the designs it took and whether it came to an end."""
    size = float(abs(study.evaluate(x).f[0, 0]))
    if not np.isfinite(size):
        return x, 1, False
    problem = Epigraph(study, size or 1.0, margins)
    descent = problem.descend(problem.u(x), precision)
    return problem.x(descent.u), problem.evaluations + 1, descent.finished


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


def _de(study: Study, judge: Study, seed: int, starts: int, designs: int) -> _Found:
    looked = 0

    def told(x: np.ndarray) -> np.ndarray:
        nonlocal looked
        evaluation = study.evaluate(x.T)
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
    why = "its designs had drawn together" if found.success else "it had looked at as many designs as it may"
    return _Found(_better(judge, found.x), looked, (), why)


def _evolution(algorithm: Any, each: int, study: Study, judge: Study, seed: int, designs: int) -> _Found:
    """A search by an algorithm of pymoo that looks at ``each`` designs in a generation."""
    from .nsga2 import StudyProblem

    generations = max(designs // each, 2)
    algorithm.setup(StudyProblem(study), termination=("n_gen", generations), seed=seed, verbose=False)
    algorithm.run()
    best = _better(judge, *algorithm.opt.get("X"))
    return _Found(best, int(algorithm.evaluator.n_eval), (), f"its {generations} generations were over")


def _ga(study: Study, judge: Study, seed: int, starts: int, designs: int) -> _Found:
    from pymoo.algorithms.soo.nonconvex.ga import GA

    return _evolution(GA(pop_size=100, eliminate_duplicates=False), 100, study, judge, seed, designs)


def _competitive(study: Study, judge: Study, seed: int, starts: int, designs: int) -> _Found:
    from .competitive import CompetitiveAlgorithm

    return _evolution(CompetitiveAlgorithm(narrowing=0.9), 22, study, judge, seed, designs)


def _checked(study: Study, judge: Study, found: _Found) -> _Found:
    """With where a descent from what was found ends; its designs are not counted."""
    if not np.isfinite(study.evaluate(found.x).f).all():
        return found
    return found._replace(descended=_tightened(study, judge, found.x)[0])


METHODS: dict[str, Callable[[Study, Study, int, int, int], _Found]] = {
    "slsqp": _slsqp,
    "de": _de,
    "ga": _ga,
    "competitive": _competitive,
}

# ---------------------------------------------------------------- words


def _told(study: Study, found: _Found) -> Minimum:
    evaluation = study.evaluate(found.x)
    built, feasible = bool(np.isfinite(evaluation.f).all()), bool(evaluation.feasible[0])
    active = _active(study, evaluation) if built else ()
    words = [f"The search stopped because {found.why}.", _held(active) if feasible else _missed(study, evaluation)]
    if feasible and len(found.ends) > 1:
        same = sum(abs(end - min(found.ends)) <= SAME * abs(min(found.ends)) for end in found.ends)
        words.append(f"{same} of {len(found.ends)} starts ended with this objective, to {SAME:.1%} of it.")
    if found.descended is not None:
        words.append(_sureness(unmonitored(study), evaluation, found.descended))
    f, message = float(evaluation.f[0, 0]), " ".join(words)
    x = evaluation.x[0]
    return Minimum(study, x, f, feasible, found.evaluations, found.ends, active, message, found.descended)


def _sureness(study: Study, found: Evaluation, descended: np.ndarray) -> str:
    """How a design compares with the end of a descent from it."""
    end = study.evaluate(descended)
    before, after = float(found.f[0, 0]), float(end.f[0, 0])
    gain = (before - after) / abs(before) if before else before - after
    text = study.minimise[0].text(study.minimise[0].sign * after)
    if end.feasible[0] and not found.feasible[0]:
        return f"A descent from there ends at one that keeps every limit, with {text}."
    if not end.feasible[0] or not gain > SAME:
        return "A descent from there ends no better: it is the best of its neighbours, if perhaps not of all designs."
    return f"A descent from there ends at {text}, {100 * gain:.2g} % better: this search had not come to the end."


def _held(active: tuple[Active, ...]) -> str:
    """What holds a design that keeps all limits where it is."""
    peaks = [str(a) for a in active if a.kind == "peak"]
    held = [str(a) for a in active if a.kind != "peak"]
    smallest = [f"Smallest found: {_listed(peaks)}."] if peaks else []
    return " ".join([*smallest, f"At their limits: {_listed(held)}." if held else "No limit is reached."])


def _missed(study: Study, evaluation: Evaluation) -> str:
    """Which limit a design misses by most."""
    known, missed = np.isfinite(evaluation.g).all(), evaluation.missed.any()
    nearest = f"this one misses {study.worst_miss(evaluation.g[0])}." if known and missed else ""
    if np.isfinite(evaluation.f).all():
        return f"No design was found that keeps every limit; {nearest}"
    none = f"No design was found for which there is a {study.minimise[0].name}"
    return f"{none}; {nearest}" if nearest else f"{none}: none can be built or used."


def _listed(items: list[str]) -> str:
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def _active(study: Study, evaluation: Evaluation) -> tuple[Active, ...]:
    """Every peak of the objective, every limit and bound that is reached."""
    analysis = study.analyse(evaluation.x)
    objective = [part for _, part in parts_of(study.minimise[0])]
    peaks = [_reached("peak", m, analysis, 1) for m in objective if isinstance(m, PeakMeasure)]
    limits = [
        _reached("limit", m, analysis, sense)
        for (m, _, sense), g in zip(study.limits, evaluation.g[0], strict=True)
        if abs(g) <= CLOSE
    ]
    return (*peaks, *limits, *_bounds_reached(study, evaluation.x[0]))


def _reached(kind: str, measure: Measure, analysis: Any, sense: int) -> Active:
    value = measure.text(float(np.ravel(measure(analysis))[0]))
    return Active(kind, measure.name, value, _peak_angles(measure, analysis, sense))


def _peak_angles(measure: Measure, analysis: Any, sense: int) -> tuple[float, ...]:
    """The angles at which a curve comes to its peak, one for each hill."""
    if not isinstance(measure, PeakMeasure) or measure.angle is None or sense * measure.sign < 0:
        return ()
    curve, angle = np.ravel(measure.curve(analysis)), np.ravel(measure.angle(analysis))
    padded = np.concatenate([[-np.inf], curve, [-np.inf]])
    hills = (curve >= padded[:-2]) & (curve > padded[2:]) & (curve >= curve.max() - CLOSE * abs(curve.max()))
    return tuple(float(a) for a in angle[hills])


def _bounds_reached(study: Study, x: np.ndarray) -> list[Active]:
    found = []
    for name, value, low, high in zip(study.free, x, *study.bounds, strict=True):
        for end, word in ((low, "lower"), (high, "upper")):
            if abs(value - end) <= CLOSE * (high - low):
                found.append(Active("bound", words(name), f"{study.declared[name].text(value)} ({word} bound)"))
    return found
