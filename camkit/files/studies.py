"""The study of a saved file: its start, free quantities, measures, limits, and the designs of its front."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..quantities import Design, Measure, quantities_of, words
from ..quantities.kinds import kind_words
from ..study.study import Study, WeightedSum, weighted
from ..units import factor
from .checks import all_numbers, count, listed, mapping, plain
from .entries import Reading, entry_of, exact_in_unit, is_number, key
from .json_file import shown

MOST_ANGLES = 20_001
"""Cam angles of an analysis."""
SAME_BOUND = 1e-9
"""A design that misses a bound by no more than this share of it is on the bound: what rounding in a unit does."""
MOST_POINTS = 5_000_000
"""Designs of a front times angles of each: more do not fit into the memory of a small machine at once."""


def study_entry(study: Study) -> dict[str, Any]:
    """A study as JSON knows it."""
    _refuse_namesakes(study)
    known, limits = _declared_measures(study.start), {"at_most": study.at_most, "at_least": study.at_least}
    made = {_key(m): m.made for m in study.measures if m.made and getattr(known.get(_key(m)), "made", ()) != m.made}
    sums = [m for of in limits.values() for m in of or {} if isinstance(m, WeightedSum)]
    return {
        "start": entry_of(study.start),
        "free": {
            key(path, q): [exact_in_unit(b, q.unit) for b in study.free[path]] for path, q in study.declared.items()
        },
        "minimise": [_objective_entry(measure, known) for measure in study.minimise],
        **{
            name: {_relative_key(m, known): exact_in_unit(v, m.unit) for m, v in (of or {}).items()}
            for name, of in limits.items()
        },
        **({"sums": [_objective_entry(m, known) for m in sums]} if sums else {}),
        **({"made": {k: entry_of(how) for k, how in made.items()}} if made else {}),
        "angles": int(study.angles),
    }


def rows(study: Study, x: Any) -> list[list[float]]:
    """The designs of a front, each a row of free values in their units."""
    units = [q.unit for q in study.declared.values()]
    return [[exact_in_unit(v, unit) for unit, v in zip(units, row, strict=True)] for row in x]


def study_of(entry: Mapping[str, Any], reading: Reading, measures: Iterable[Measure]) -> Study:
    """The study that `study_entry` wrote; ``measures`` are those of one's own that it may have."""
    start = reading.thing(entry["start"])
    if not isinstance(start, Design):
        raise ValueError("the file is damaged: the start of its study is no design")
    declared = {key(path, q): (path, q) for path, q in quantities_of(start).items()}
    named = _declared_measures(start)
    signs = {k: m.sign for k, m in named.items()}
    made = [_made(k, how, start) for k, how in mapping(entry["made"], "made").items()]
    named |= {_key(m): m if m.sign == signs.get(_key(m), 1) else -m for m in (*made, *measures)}
    named |= {m.name: m for m in (_sum(each, named) for each in listed(entry["sums"], "sums"))}
    free = {}
    for k, bounds in mapping(entry["free"], "free").items():
        if k not in declared:
            raise ValueError(f"the file frees {shown(k)}, which {kind_words(type(start), article=True)} does not have")
        name, quantity = declared[k]
        free[name] = tuple(quantity.factor * b for b in all_numbers(bounds, k, 2))
    limits: dict[str, Any] = {
        name: {_found(k, named): all_numbers([v], k, 1)[0] * factor(_found(k, named).unit) for k, v in limited.items()}
        for name, limited in ((n, mapping(entry[n], n)) for n in ("at_most", "at_least"))
    }
    minimise = tuple(_objective(each, named) for each in listed(entry["minimise"], "minimise"))
    return Study(start, free, minimise, angles=count("angles", entry["angles"], 2, MOST_ANGLES), **limits)


def x_of(rows: Any, study: Study) -> np.ndarray:
    """The free values of a front, SI."""
    n, rows = len(study.free), listed(rows, "front")
    if not all(isinstance(row, list) and len(row) == n and all(map(is_number, row)) for row in rows):
        raise ValueError(f"the file is damaged: its front does not have {n} values for each design")
    if len(rows) * study.angles > MOST_POINTS:
        raise ValueError(
            f"the file has {len(rows)} designs at {study.angles} angles each; there can be {MOST_POINTS} points in all"
        )
    x = np.array(rows, dtype=float).reshape(-1, n) * [q.factor for q in study.declared.values()]
    _refuse_outside(x, study)
    return x


def _refuse_outside(x: np.ndarray, study: Study) -> None:
    """Every design of a front lies between the bounds of its study, but for rounding."""
    low, high = study.bounds
    rounding = SAME_BOUND * np.maximum(abs(low), abs(high))
    for i, j in np.argwhere((x < low - rounding) | (x > high + rounding))[:1]:
        name = list(study.free)[j]
        say = study.declared[name].text
        raise ValueError(
            f"the front of the file has a design outside the bounds of its study: the {words(name)} of design {i + 1} "
            f"is {say(x[i, j])}; the bounds are {say(low[j])} and {say(high[j])}"
        )


def _key(measure: Measure) -> str:
    return f"{measure.name} [{measure.unit}]" if measure.unit else measure.name


def _declared_measures(start: Any) -> dict[str, Measure]:
    return {_key(m): m for m in type(start).measures}


def _made(k: str, entry: Any, start: Any) -> Measure:
    """A measure that one of the mechanism's makers makes of numbers and words."""
    name, *given = listed(entry, k) or [None]
    how = type(start).makers.get(name) if isinstance(name, str) else None
    try:
        measure = how(*(_given(value) for value in given)) if how else None
    except (TypeError, ValueError):
        measure = None
    if measure is None or _key(measure) != k:
        raise ValueError(f"the file is damaged: what it says of {shown(k)} does not make this measure")
    return measure


def _given(value: Any) -> Any:
    if isinstance(value, list):
        return tuple(all_numbers(value, "made", len(value)))
    return value if is_number(value) else plain(value)


def _refuse_namesakes(study: Study) -> None:
    """A measure of one's own under a name of the mechanism's would be read as another."""
    known = _declared_measures(study.start)
    plain = [m for m in study.measures if _key(m) in known and not m.made]
    own = [m for m in plain if m.function is not known[_key(m)].function]
    try:
        analysis = study.start.analyse(study.angles) if own else None
    except ValueError:  # a start that cannot be built; nothing can be compared
        return
    for measure in own:
        mine, theirs = (abs(np.asarray(m(analysis), dtype=float)) for m in (measure, known[_key(measure)]))
        if not np.allclose(mine, theirs, rtol=1e-9, atol=0, equal_nan=True):
            mechanism = kind_words(type(study.start), article=True)
            raise ValueError(
                f"the {measure.name} of this study is not what {mechanism} has under this name; give it another name"
            )


def _relative_key(measure: Measure, known: Mapping[str, Measure]) -> str:
    """A measure as its mechanism declares it (one's own: positive), or ``-`` and its negative."""
    declared = known[_key(measure)].sign if _key(measure) in known else 1
    return _key(measure) if measure.sign == declared else f"-{_key(measure)}"


def _objective_entry(measure: Measure, known: Mapping[str, Measure]) -> Any:
    if not isinstance(measure, WeightedSum):
        return _key(measure) if measure.sign > 0 else f"-{_key(measure)}"
    parts = {_relative_key(p, known): w for p, w in zip(measure.parts, measure.weights, strict=True)}
    reference = [exact_in_unit(r, p.unit) for p, r in zip(measure.parts, measure.reference, strict=True)]
    return {"name": measure.name, "weights": parts, "reference": reference, "sign": measure.sign}


def _found(k: str, named: Mapping[str, Measure]) -> Measure:
    """The measure of a key."""
    if k in named:
        return named[k]
    if k[:1] == "-" and k[1:] in named:
        return -named[k[1:]]
    raise ValueError(
        f"the study has the measure {shown(k)}, which its mechanism does not have; if it is your own, hand it over as "
        "read(path, measures=(...))"
    )


def _objective(entry: Any, named: Mapping[str, Measure]) -> Measure:
    if isinstance(entry, dict):
        return _sum(entry, named)
    if not isinstance(entry, str):
        raise ValueError(f"the file says {shown(entry)} where the name of a measure belongs")
    found = _found(entry.removeprefix("-"), named)
    return found if (found.sign < 0) == entry.startswith("-") else -found


def _sum(entry: Any, named: Mapping[str, Measure]) -> WeightedSum:
    """A weighted sum."""
    entry = {"sign": 1} | mapping(entry, "weighted sum")
    if (
        entry.keys() != {"name", "weights", "reference", "sign"}
        or entry["sign"] not in (1, -1)
        or entry["sign"] is True
    ):
        raise ValueError("the file is damaged: its weighted sum is not as camkit writes it")
    parts = {_found(k, named): v for k, v in mapping(entry["weights"], "weights").items()}
    weights = all_numbers(list(parts.values()), "weights", len(parts))
    reference = all_numbers(entry["reference"], "reference", len(parts))
    si = [r * factor(m.unit) for m, r in zip(parts, reference, strict=True)]
    total = weighted(plain(entry["name"]), dict(zip(parts, weights, strict=True)), si)
    return replace(total, sign=int(entry["sign"]))
