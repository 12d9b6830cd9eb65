"""The tolerances of a saved study: what deviates, by how much, how that spreads, and what is to be kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from ..quantities import Quantity, quantities_of, words
from ..quantities.kinds import kind_words, shown, whole
from ..study.free import brought_by
from ..study.robust import RobustStudy
from ..study.spread import STANDARDS, Source, Tolerance
from ..study.study import Study
from .checks import all_numbers, listed, mapping, plain
from .entries import Reading, exact_in_unit, is_number, key

FIELDS = {"deviations", "yield_at_least", "worst_case", "objective", "correlation"}
Today = Callable[[object], tuple[str, float]]
"""The path of today of a key, and what the file's numbers are multiplied by to be SI."""


def tolerances_entry(study: RobustStudy) -> dict[str, object]:
    """The tolerances of a study as JSON knows them; a `Source` stands in SI, a path in its unit."""
    place, known = study.names.index, _quantities(study)
    keys, units = {path: key(path, q) for path, q in known.items()}, {path: q.unit for path, q in known.items()}

    def one(of: str | Source, tolerance: Tolerance) -> dict[str, object]:
        unit, told = (units[of], keys[of]) if isinstance(of, str) else ("", _source_entry(of, keys))
        name = of if isinstance(of, str) else of.name
        return {"of": told, "deviation": _deviation_entry(tolerance, unit, name), "spread": tolerance.spread}

    return {
        "deviations": [one(of, tolerance) for of, tolerance in study.tolerances.items()],
        "yield_at_least": study.yield_at_least,
        "worst_case": study.worst_case,
        "objective": study.objective,
        "correlation": [[place(a), place(b), r] for (a, b), r in study.correlation.items()],
    }


def _quantities(study: Study) -> dict[str, Quantity]:
    """The quantities of a study's start, and those that options of its menus bring."""
    brought = brought_by(study.start, study.menus)
    return {path: q for path, q in brought.items() if isinstance(q, Quantity)} | quantities_of(study.start)


def _source_entry(source: Source, keys: Mapping[str, str]) -> dict[str, object]:
    pairs = {side: {keys[path]: factor for path, factor in getattr(source, side)} for side in ("moves", "of")}
    return {"name": source.name, **pairs}


def _deviation_entry(tolerance: Tolerance, unit: str, name: str) -> object:
    """A half width, two deviations, or the name of a standard with its grade."""
    given = tolerance.deviation
    if not callable(given):
        sides = [exact_in_unit(v, unit) for v in np.atleast_1d(given)]
        return sides if len(sides) > 1 else sides[0]
    function, graded = (given.func, given.keywords) if isinstance(given, partial) and not given.args else (given, {})
    standard = next((n for n, known in STANDARDS.items() if known is function), None)
    if standard is None or not graded.keys() <= {"grade"}:
        raise ValueError(f"the tolerance of the {words(name)} is a function of one's own, which no file can hold")
    return {"standard": standard, **graded}


def under_tolerances(study: Study, entry: object, reading: Reading) -> Study:
    """The study under the tolerances that `tolerances_entry` wrote."""
    given = mapping(entry, "tolerances")
    if given.keys() != FIELDS or not is_number(given["yield_at_least"]) or not isinstance(given["worst_case"], bool):
        raise ValueError("the file is damaged: its tolerances are not as camkit writes them")
    declared = {key(path, q): (path, q.factor) for path, q in _quantities(study).items()}

    def today(told: object) -> tuple[str, float]:
        named = {told: None} if isinstance(told, str) else {}
        found = reading.renaming.entries(type(study.start).__name__, named)
        for now, was in list(found.items())[:1]:
            if now in declared:
                path, factor = declared[now]
                return path, was.times * factor
        mechanism = kind_words(type(study.start), article=True)
        raise ValueError(f"the file has a tolerance of {shown(told)}, which {mechanism} does not have")

    tolerances = dict(_deviation(each, today) for each in listed(given["deviations"], "deviations"))
    names = [of if isinstance(of, str) else of.name for of in tolerances]
    return study.under(
        tolerances,
        given["yield_at_least"],
        given["worst_case"],
        plain(given["objective"]),
        dict(_pair(each, names) for each in listed(given["correlation"], "correlation")),
    )


def _deviation(entry: object, today: Today) -> tuple[str | Source, Tolerance]:
    told = mapping(entry, "deviations")
    if told.keys() != {"of", "deviation", "spread"}:
        raise ValueError(f"the file says {shown(entry)} for 'deviations', where tolerances belong")
    of, scale = (_source(told["of"], today), 1.0) if isinstance(told["of"], dict) else today(told["of"])
    return of, Tolerance(_how_far(told["deviation"], scale), plain(told["spread"]))


def _source(entry: object, today: Today) -> Source:
    told = mapping(entry, "of")
    if told.keys() != {"name", "moves", "of"}:
        raise ValueError(f"the file says {shown(entry)} for 'of', where what moves several quantities belongs")
    moves, of = ({today(k)[0]: v for k, v in mapping(told[side], side).items()} for side in ("moves", "of"))
    return Source(plain(told["name"]), moves, of)


def _how_far(entry: object, scale: float) -> Any:
    """A deviation, SI."""
    if isinstance(entry, dict):
        standard = STANDARDS.get(plain(entry.get("standard")))
        if standard is None or not entry.keys() <= {"standard", "grade"}:
            raise ValueError(f"the file says {shown(entry)} for 'deviation'; there are {', '.join(STANDARDS)}")
        return partial(standard, grade=entry["grade"]) if "grade" in entry else standard
    if is_number(entry):
        return abs(scale) * entry
    low, high = sorted(scale * v for v in all_numbers(entry, "deviation", 2))
    return low, high


def _pair(entry: object, names: list[str]) -> tuple[tuple[str, str], float]:
    """Two tolerances by their places, and how they are correlated."""
    told = listed(entry, "correlation")
    if len(told) != 3:
        raise ValueError(f"the file says {shown(entry)} for 'correlation', where two places and a number belong")
    a, b = (names[whole(place, "the place of a tolerance", 0, len(names) - 1)] for place in told[:2])
    return (a, b), told[2]
