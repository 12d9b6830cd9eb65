"""What a report is about: a design with its analysis, what was asked of it, how it was found and chosen."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ...quantities import Measure, label, measures_of, words
from ...study.failures import tolerance_texts
from ...study.limits import keeps
from ...study.recheck import Recheck
from ...study.robust import RobustStudy
from ...study.study import NOTHING, Study
from ...study.tolerances import CONFIDENCE, Tolerances
from ..decisions import Decision
from ..sessions import Session
from .deviations import Within
from .subject import analysis_of, design_of

"""Parts that are made, or half widths by path (SI)."""
Limit = tuple[Measure, float, int]
"""A measure without its sign, its limit (SI), and +1 for at most, -1 for at least."""


@dataclass(frozen=True)
class Reported:
    """One design, and all that is known of it."""

    design: Any
    analysis: Any
    study: Study | None = None
    limits: tuple[Limit, ...] = ()
    views: tuple[Any, ...] = ()
    """What its panel shows; nothing: what the analysis offers."""
    tolerances: Tolerances | None = None
    decision: Decision | None = None
    record: Mapping[str, object] = field(default_factory=dict)
    """How the search that found it went."""

    @property
    def objectives(self) -> tuple[Measure, ...]:
        """What is to be small or, with the sign -1, large."""
        return tuple(m for m in self.study.minimise if m is not NOTHING) if self.study else ()

    @property
    def asks(self) -> bool:
        """Whether something is asked of it."""
        return bool(self.objectives or self.limits)

    @property
    def values(self) -> dict[Measure, float]:
        """The objectives, what has a limit, and every other measure of the design, SI; infinite others are none."""
        asked = dict.fromkeys((*map(abs_of, self.objectives), *(measure for measure, _, _ in self.limits)))
        every = dict.fromkeys((*asked, *measures_of(self.design)))
        values = {measure: measure.one(self.analysis) for measure in every}
        return {measure: value for measure, value in values.items() if measure in asked or np.isfinite(value)}

    @property
    def missed(self) -> list[Limit]:
        """The limits that the design misses."""
        values = self.values
        return [(m, limit, sense) for m, limit, sense in self.limits if not keeps(values[m], limit, sense)]

    @cached_property
    def found(self) -> Recheck | None:
        """What exact parts say of its yield, where the study asks for one."""
        return self.study.recheck(self.study.x_of(self.design)[None]) if isinstance(self.study, RobustStudy) else None

    @property
    def wasteful(self) -> bool:
        """Whether it has not the yield that the study asks for."""
        return self.found is not None and bool(self.found.share[0] < self.found.wanted)

    def made(self) -> list[tuple[str, str]]:
        """What the workshop makes of it, as pairs of what and how: within which tolerances, and the yield."""
        by_parts = _made_by_parts(self.tolerances) if self.tolerances else []
        robust, found = self.study, self.found
        if not isinstance(robust, RobustStudy) or found is None:
            return by_parts
        wanted = "in the worst case" if robust.worst_case else f"at least {100 * robust.yield_at_least:g} % is wanted"
        within, told = ", ".join(tolerance_texts(robust.around(self.design))), f"{found}"
        missed = f"{found.missed[0]} of {found.parts[0]} parts miss a limit (95 % confidence of each end)"
        return [*by_parts, ("made within", within), ("yield", f"{told}; {missed}; {wanted}")]

    def asked(self) -> list[tuple[str, str]]:
        """What is free, and how it was searched."""
        if self.study is None or not self.objectives:
            return []
        free = self.study.free.items()
        told = (f"{_free_name(self.study, name)} {_free_words(self.study, name, given)}" for name, given in free)
        return [("free", "; ".join(told)), *_searched(self.record)]


def reported(thing: Any, study: Study | None = None, tolerances: Within | None = None) -> Reported:
    """All that is known of ``thing``: a panel, a design or its analysis, a `Session` or a `Decision`.

    ``ValueError`` in a sentence for what is none, and for a study or tolerances of another design.
    """
    thing = getattr(thing, "source", thing)  # the panel that the front of a decision is from
    if callable(getattr(thing, "session", None)):
        thing = thing.session()
    front, decision = getattr(thing, "front", None), thing if isinstance(thing, Decision) else None
    if isinstance(thing, Session):
        decision = thing.decision
    panel = getattr(thing, "explorer", thing)
    design = thing.design if isinstance(thing, (Session, Decision)) else design_of(panel)
    study = study or study_of(front if isinstance(thing, Decision) else thing) or getattr(panel, "judged", None)
    own = None if isinstance(study, RobustStudy) else getattr(thing, "tolerances", None)
    study, parts = _under(study, tolerances or own, design)
    views = tuple(getattr(panel, "views", ()) or ())
    record = getattr(front, "record", {})
    if study is None:
        return Reported(design, analysis_of(panel), views=views, tolerances=parts)
    study.x_of(design)  # refuses a design of another kind
    analysis = thing if hasattr(thing, "offers") else study.analysis_of(design)
    limits = tuple((m if m.sign > 0 else -m, m.sign * v, m.sign * sense) for m, v, sense in study.limits)
    return Reported(design, analysis, study, limits, views, parts, decision, record)


def abs_of(measure: Measure) -> Measure:
    """The measure without its sign."""
    return measure if measure.sign > 0 else -measure


def _under(study: Study | None, given: object, design: object) -> tuple[Study | None, Tolerances | None]:
    """The study under tolerances that are half widths, and tolerances that are parts of the design already."""
    if isinstance(given, Tolerances):
        if given.study.start != design:
            raise ValueError("the tolerances are of another design than the report")
        return study or given.study, given
    if isinstance(given, Mapping) and study is not None:
        study = study.around(design).under(given)
    return study, None


def study_of(thing: object) -> Study | None:
    """What a panel or a front asks of designs; ``None``: nothing yet."""
    with suppress(ValueError):  # a panel in which nothing is asked for yet
        if isinstance(study := getattr(thing, "study", None), Study):
            return study
    return None


def _free_name(study: Study, name: str) -> str:
    declared = study.declared[name]
    return label(name, declared) if hasattr(declared, "symbol") else words(name)


def _free_words(study: Study, name: str, given: Any) -> str:
    """Between which bounds something is free, or among which options."""
    if hasattr(given, "names"):
        return f"({len(given.names)} options: {', '.join(given.names[:4])}{' ...' if len(given.names) > 4 else ''})"
    low, high = (study.declared[name].text(bound) for bound in given)
    return f"{low} to {high}"


def _searched(record: Mapping[str, object]) -> list[tuple[str, str]]:
    """How a front was found."""
    if not record:
        return []
    words_of = {"population": "population {}", "generations": "{} generations", "designs": "{} designs evaluated"}
    words_of["seed"] = "seed {}"
    told = [text.format(record[name]) for name, text in words_of.items() if name in record]
    versions = record.get("versions")
    said = ", ".join(f"{name} {number}" for name, number in versions.items()) if isinstance(versions, Mapping) else ""
    return [("search", "; ".join([*told, *([f"with {said}"] if said else [])]))]


def _made_by_parts(made: Tolerances) -> list[tuple[str, str]]:
    """What `Tolerances` say."""
    low, high = made.interval
    halves = (f"{label(n, made.declared[n])} ±{made.declared[n].text(made.half_widths[n])}" for n in made.names)
    missed = (f"{measure.name} {100 * share:.1f} %" for measure, share in made.missed.items() if share > 0)
    return [
        ("made within", f"{', '.join(halves)}; {made.spread} spread"),
        (
            "yield",
            f"{100 * made.share:.1f} % of {made.parts} parts keep every limit ({100 * CONFIDENCE:.0f} % confidence: "
            f"{100 * low:.1f} to {100 * high:.1f} %); seed {made.seed}",
        ),
        *([("limits that parts miss", ", ".join(told))] if (told := [*missed]) else []),
    ]
