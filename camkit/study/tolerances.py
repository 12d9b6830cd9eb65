"""What the workshop does to a design: its dimensions spread within tolerances, and with them curves and measures.

It knows studies, not mechanisms.  The parts are drawn as scrambled Sobol points and analysed in one call.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Analysable, Measure, Paths, Quantity, counted, floats, quantities_of, value_of, words
from ..quantities.kinds import numbers, one_number, refuse_arguments, refuse_kinds, shown
from ..units import deg, factor
from .free import Menu
from .native import Answers
from .spread import SPREADS, iso_2768, spread_shares
from .study import Evaluation, Study

ANGLES = ("cam_angle", "crank_angle")
"""Over what a curve may be drawn."""
CONFIDENCE = 0.95

LENGTHS, ANGLE_UNITS = ("mm", "cm", "m"), ("deg", "rad")
ISO_ANGLE = 0.5 * deg
"""ISO 2768-1:1989, table 3, class m, for an angle whose shorter leg is between 10 and 50 mm."""
OTHERWISE = 0.01
"""Share of its value, for what is neither a length nor an angle."""


def general_tolerance(declared: Quantity, value: float) -> float:
    """The half width of the tolerance that a drawing without one has, SI: ISO 2768-1, class m.

    >>> from camkit import DoorHandleCam
    >>> from camkit.quantities import quantities_of
    >>> declared = quantities_of(DoorHandleCam())
    >>> 1e3 * general_tolerance(declared["lift_arm"], 0.05), 1e3 * general_tolerance(declared["lift_arm"], 0.2)
    (0.3, 0.5)
    """
    refuse_arguments(general_tolerance, locals())
    if declared.unit in ANGLE_UNITS:
        return ISO_ANGLE
    if declared.unit in LENGTHS:
        return float(iso_2768(value))
    return OTHERWISE * abs(value)


def general_tolerances(of: Study | Analysable) -> dict[str, float]:
    """The general tolerances (ISO 2768-1, class m) of what a study frees, or of the sizes of a design, SI.

    Sizes are the lengths and angles of the design itself and of mechanisms that it holds: no load, speed, material,
    law or motion, nothing that is ``asked`` of the mechanism, and nothing that could not be built at its least.

    >>> from camkit import TranslatingRollerCam
    >>> {path: 1e3 * half for path, half in general_tolerances(TranslatingRollerCam()).items()}
    {'base_radius': 0.2, 'roller_radius': 0.2, 'offset': 0.1}
    """
    refuse_arguments(general_tolerances, locals())
    if isinstance(of, Study):
        start = of.around(of.start).start
        freed = [p for name, b in of.free.items() for p in (b.paths if isinstance(b, Menu) else (name,))]
        known = {path: q for path, q in quantities_of(start).items() if path in freed}
        return {path: general_tolerance(known[path], value_of(start, path)) for path in freed if path in known}
    sizes = {path: q for path, q in quantities_of(of).items() if _is_size(of, path, q)}
    values = zip(sizes.items(), Paths(of, sizes).values(of), strict=True)
    halves = ((path, q, x, general_tolerance(q, x)) for (path, q), x in values)
    return {path: half for path, q, x, half in halves if q.allows(x - half)}


def _is_size(design: object, path: str, declared: Quantity) -> bool:
    """Whether a quantity is a length or an angle that a mechanism is made with."""
    for name in path.split(".")[:-1]:
        design = getattr(design, name, None)
    return declared.unit in (*LENGTHS, *ANGLE_UNITS) and not declared.asked and hasattr(design, "analyse")


@dataclass(frozen=True)
class AnalysisCurve:
    """A curve of an analysis, by the name of its attribute: ``Curve("lift.pressure_angle", "deg", "pressure angle")``.

    ``limits`` are values (SI) that it should not cross.
    """

    name: str
    unit: str
    label: str
    limits: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        refuse_kinds(self)
        factor(self.unit)
        for limit in self.limits:
            one_number(limit, f"a limit of the {self.label}")

    def values(self, analysis: object) -> np.ndarray:
        """The curve, ``(m,)`` or for a population ``(p, m)``, SI."""
        try:
            return floats(attrgetter(self.name)(analysis))
        except AttributeError:
            raise ValueError(f"the analysis has no curve {self.name!r}") from None

    def of(self, analysis: object, p: int) -> np.ndarray:
        """The curves of ``p`` designs, ``(p, m)``, SI."""
        values = self.values(analysis)
        return np.broadcast_to(values, (p, values.shape[-1]))

    def angle(self, analysis: object) -> tuple[str, np.ndarray]:
        """The angle over which it is drawn: what it is called, and its values at the curve's points, rad."""
        head = self.name.rpartition(".")[0]
        owner = attrgetter(head)(analysis) if head else analysis
        for name in ANGLES:
            if hasattr(owner, name):
                return words(name), floats(getattr(owner, name))
        raise ValueError(f"the curve {self.name!r} has no {' or '.join(map(words, ANGLES))} over which it can be drawn")


class Indices(NamedTuple):
    """Sobol indices: a row for each measure, a column for each tolerance, ``nan`` for a measure that does not vary."""

    first: np.ndarray
    """Share of a measure's variance that a tolerance causes on its own."""
    total: np.ndarray
    """The same with its share in what tolerances cause together."""


@dataclass(frozen=True)
class Tolerances:
    """``parts`` parts made after the starting design of ``study``, whose dimensions spread by ``half_widths`` (SI).

    ``uniform``: every value within plus and minus the half width is equally likely.  ``normal``: the half width is
    three standard deviations.  ``parts`` is a power of two; a seed gives the same parts again.

    >>> from camkit.machines import lift_curve_study
    >>> from camkit.units import mm
    >>> lift = Tolerances(lift_curve_study(), {"lift_arm": 0.3 * mm, "lift_start_angle": 0.5 * deg}, parts=256)
    >>> lift.share, lift.x.shape, lift.measures[0].name
    (1.0, (256, 2), 'effort')

    Raises ``ValueError`` for a name that is no quantity of the design, a half width below 0 or not finite or with which
    a part could not be built, no half width above 0 at all, an unknown spread, or a number of parts that is no power
    of two.
    """

    study: Study
    half_widths: Mapping[str, float]
    spread: str = "uniform"
    parts: int = 1024
    seed: int = 1

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if not 0 <= self.seed < 2**63:
            raise ValueError(f"the seed is {shown(self.seed)}; it must be a whole number of at least 0")
        start = self.study.start
        for name, half in self.half_widths.items():
            _check(name, self.declared[name], value_of(start, name), half)
        if not any(self.half_widths.values()):
            raise ValueError("there is no tolerance above 0; one must be")
        if self.spread not in SPREADS:
            raise ValueError(f"the spread is {shown(self.spread)}; there are {', '.join(SPREADS)}")
        if counted(self.parts, "parts", 4, 2**20) & (self.parts - 1):
            raise ValueError(f"the number of parts is {self.parts}; it must be a power of 2")

    @property
    def names(self) -> tuple[str, ...]:
        """The quantities that spread: those with a half width above 0."""
        return tuple(name for name, half in self.half_widths.items() if half > 0)

    @cached_property
    def declared(self) -> dict[str, Quantity]:
        """Declarations of all quantities that were given a tolerance, also of 0."""
        return Paths(self.study.start, self.half_widths, Quantity).declared

    @cached_property
    def _box(self) -> Study:
        """The measures as a study over the tolerances' box."""
        centre = {name: value_of(self.study.start, name) for name in self.names}
        free = {n: (c - self.half_widths[n], c + self.half_widths[n]) for n, c in centre.items()}
        return self.study.nominal.replace(free=free, minimise=self.measures, at_most={}, at_least={})

    @cached_property
    def _halves(self) -> np.ndarray:
        """Two independent halves of the parts, ``(2, parts / 2, n)``: Saltelli's matrices A and B."""
        from scipy.stats import qmc

        n = len(self.names)
        unit = qmc.Sobol(2 * n, rng=self.seed).random(self.parts // 2)
        low, high = self._box.bounds
        middle, half = (low + high) / 2, (high - low) / 2
        shares = spread_shares(unit, [self.spread] * 2 * n)
        return middle + half * np.stack([shares[:, :n], shares[:, n:]])

    @property
    def x(self) -> np.ndarray:
        """What the workshop made of the ``names``, ``(parts, n)``, SI."""
        return self._halves.reshape(self.parts, -1)

    @cached_property
    def analysis(self) -> Any:
        """The analysis of all parts."""
        return self._box.analysis(self.x)

    @cached_property
    def nominal(self) -> Any:
        """The analysis of the design as it was drawn."""
        return self.study.start.analyse(self.study.angles)

    @cached_property
    def measures(self) -> tuple[Measure, ...]:
        """The study's objectives and what it limits, each once and as it is named."""
        every = (*self.study.minimise, *(measure for measure, _, _ in self.study.limits))
        return tuple(dict.fromkeys(_named(measure) for measure in every))

    def _measured(self, x: np.ndarray) -> np.ndarray:
        """Every measure of parts ``(p, n)``, ``(s, p)``; ``nan`` where a part cannot be built."""
        values = self._box.evaluate(x).f.T
        return np.where(np.isfinite(values), values, np.nan)

    @cached_property
    def values(self) -> np.ndarray:
        """Every measure of every part, ``(s, parts)``, SI; ``nan`` where a part cannot be built."""
        return self._measured(self.x)

    def of(self, measure: Measure) -> np.ndarray:
        """One of the ``measures`` of every part, ``(parts,)``, with its sign."""
        refuse_arguments(Tolerances.of, locals())
        if _named(measure) not in self.measures:
            known = ", ".join(m.name for m in self.measures)
            raise ValueError(f"the study has no measure {shown(measure.name)}; it has {known}")
        return measure.sign * self.values[self.measures.index(_named(measure))]

    @cached_property
    def evaluation(self) -> Evaluation:
        """What the study says of all parts."""
        f = np.stack([self.of(measure) for measure in self.study.minimise], axis=-1)
        limits = [sense * (self.of(m) - v) / (abs(v) or 1.0) for m, v, sense in self.study.limits]
        g = np.stack(limits, axis=-1) if limits else np.zeros((self.parts, 0))
        return Evaluation(self.x, np.where(np.isnan(f), np.inf, f), np.where(np.isnan(g), np.inf, g))

    @property
    def share(self) -> float:
        """The yield: which share of the parts can be built and keeps every limit."""
        return float(self.evaluation.feasible.mean())

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % confidence interval of the ``share``, as for random parts; Sobol points come closer."""
        from scipy.stats import binomtest

        kept = binomtest(int(self.evaluation.feasible.sum()), self.parts)
        found = kept.proportion_ci(CONFIDENCE, method="wilson")
        return float(found.low), float(found.high)

    @property
    def missed(self) -> dict[Measure, float]:
        """For each limited measure the share of parts that miss its limit."""
        missed = self.evaluation.missed > 0
        return {m: float(missed[:, i].mean()) for i, (m, _, _) in enumerate(self.study.limits)}

    def percentiles(self, measure: Measure, levels: Sequence[float] = (2.5, 50, 97.5)) -> np.ndarray:
        """Percentiles of one of the ``measures`` among the parts that can be built, SI."""
        return np.nanpercentile(self.of(measure), _levels(levels))

    def band(self, curve: AnalysisCurve, levels: Sequence[float] = (2.5, 25, 75, 97.5)) -> np.ndarray:
        """Percentiles of a curve at each of its points among the parts that can be built, ``(k, m)``, SI."""
        refuse_arguments(Tolerances.band, locals())
        at = curve.values(self.nominal)
        parts = Answers(self._box, self.names, (curve,)).by_code(self.x)
        parts = curve.of(self.analysis, self.parts) if parts is None else parts
        return np.percentile(parts[~np.isnan(self.values).any(axis=0)], _levels(levels), axis=0)

    @cached_property
    def indices(self) -> Indices:
        """Sobol indices of the ``measures`` by ``names`` (Saltelli et al. 2010), through scipy.

        ``nan`` for a measure that does not vary, or that some part does not have.
        """
        from scipy.stats import sobol_indices

        a, b = self._halves
        n, d = a.shape
        mixed = np.tile(a, (d, 1, 1))
        mixed[np.arange(d), :, np.arange(d)] = b.T
        f_a, f_b = self.values.reshape(-1, 2, n).transpose(1, 0, 2)
        f_ab = self._measured(mixed.reshape(-1, d)).reshape(-1, d, n).transpose(1, 0, 2)
        finite = np.isfinite(self.values).all(1) & np.isfinite(f_ab).all((0, 2))
        varies = finite & (np.ptp(self.values, axis=1) > 0)
        indices = Indices(*np.where(varies[:, None], np.ones(d), np.full((2, 1, d), np.nan)))
        if d > 1 and varies.any():  # a single tolerance causes everything
            found = sobol_indices(func={"f_A": f_a[varies], "f_B": f_b[varies], "f_AB": f_ab[:, varies]}, n=n)
            indices.first[varies], indices.total[varies] = found.first_order, found.total_order
        return indices


def _levels(levels: object) -> np.ndarray:
    """Percentages."""
    found = numbers(levels, "the levels")
    if not found.size or not ((found >= 0) & (found <= 100)).all():
        raise ValueError(f"the levels are {shown(levels)}; they must be numbers from 0 to 100, in per cent")
    return found


def _named(measure: Measure) -> Measure:
    return measure if measure.sign > 0 else -measure


def _check(name: str, declared: Quantity, value: float, half: object) -> None:
    """Refuse a half width that makes no sense."""
    half = one_number(half, f"the tolerance of the {words(name)}", "be a number of at least 0")
    if not (np.isfinite(half) and half >= 0):
        raise ValueError(
            f"the tolerance of the {words(name)} is {declared.text(half)}; it must be a finite number of at least 0"
        )
    if not declared.allows(value - half):
        raise ValueError(
            f"the {words(name)} of {declared.text(value)} less its tolerance of {declared.text(half)} is "
            f"{declared.text(value - half)}; it must be {declared.possible}"
        )
