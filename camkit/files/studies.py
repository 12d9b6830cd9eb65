"""The study of a saved file: its start, free quantities, measures, limits, and the designs of its front."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..quantities import CurveMeasure, Design, Measure, Quantity, measures_of
from ..quantities.kinds import kind_words, one_number, shown, whole
from ..quantities.types import Array
from ..study.free import Menu, declared_with, freed, refuse_bounds
from ..study.robust import RobustStudy
from ..study.study import Study
from ..study.weighted import WeightedSum, weighted
from ..units import factor
from .checks import all_numbers, listed, mapping, plain
from .entries import MOST_THINGS, Reading, entry_of, exact_in_unit, field_entry, is_number, key
from .renamed import Given, Renaming
from .tolerances import tolerances_entry, under_tolerances

Find = Callable[[str], Measure]

MOST_ANGLES = 20_001
"""Cam angles of an analysis."""
SAME_BOUND = 1e-9
"""A design that misses a bound by no more than this share of it is on the bound: what rounding in a unit does."""
MOST_POINTS = 5_000_000
"""Designs of a front times angles of each: more do not fit into the memory of a small machine at once."""


def study_entry(study: Study) -> dict[str, object]:
    """A study as JSON knows it."""
    _refuse_namesakes(study)
    known, limits = _declared_measures(study.start), {"at_most": study.at_most, "at_least": study.at_least}
    made = {_key(m): m.made for m in study.measures if m.made and getattr(known.get(_key(m)), "made", ()) != m.made}
    sums = [m for of in limits.values() for m in of or {} if isinstance(m, WeightedSum)]
    free = dict(_free_entry(study, name, given) for name, given in study.free.items())
    return {
        "start": entry_of(study.start),
        "free": free,
        "columns": [*free],
        "minimise": [_objective_entry(measure, known) for measure in study.minimise],
        **{
            name: {_relative_key(m, known): exact_in_unit(v, m.unit) for m, v in (of or {}).items()}
            for name, of in limits.items()
        },
        **({"sums": [_objective_entry(m, known) for m in sums]} if sums else {}),
        **({"made": {k: entry_of(how) for k, how in made.items()}} if made else {}),
        "angles": int(study.angles),
        **({"tolerances": tolerances_entry(study)} if isinstance(study, RobustStudy) else {}),
    }


def _free_entry(study: Study, name: str, free: Any) -> tuple[str, object]:
    """What is free, by its name and as JSON knows it: two bounds, or options with their names."""
    if not isinstance(free, Menu):
        declared = study.declared[name]
        return key(name, declared), [exact_in_unit(bound, declared.unit) for bound in free]
    places = declared_with(study.start, study.menus, free.paths)
    options = [
        [told, *(field_entry(v, d, f"option {told}") for v, d in zip(values, places.values(), strict=True))]
        for told, values in free.options.items()
    ]
    return _menu_key(places), {"options": options}


def _menu_key(places: Mapping[str, object]) -> str:
    return ", ".join(key(path, declared) for path, declared in places.items())


def rows(study: Study, x: Array) -> list[list[float]]:
    """The designs of a front, each a row of free values in their units."""
    units = [q.unit for q in study.declared.values()]
    return [[exact_in_unit(v, unit) for unit, v in zip(units, row, strict=True)] for row in x]


def study_of(entry: Mapping[str, object], reading: Reading, measures: Sequence[Measure]) -> Study:
    """The study that `study_entry` wrote; ``measures`` are those of one's own that it may have."""
    start = reading.thing(entry["start"])
    if not isinstance(start, Design):
        raise ValueError("the file is damaged: the start of its study is no design")
    named = _declared_measures(start)
    signs = {k: m.sign for k, m in named.items()}
    own = {_key(m): m for each in measures for m in (each, each.whole) if m}
    made = [
        _made(k, given, start, named | own)
        for k, given in reading.renaming.entries("measure", mapping(entry["made"], "made")).items()
    ]
    named |= {_key(m): m if m.sign == signs.get(_key(m), 1) else -m for m in (*made, *measures)}
    find = partial(_found, named, reading.renaming)
    named |= {m.name: m for m in (_sum(each, find) for each in listed(entry["sums"], "sums"))}
    limits = {
        name: {m: limit * factor(m.unit) for m, limit in _by_measure(entry[name], name, find).items()}
        for name in ("at_most", "at_least")
    }
    minimise = tuple(_objective(each, find) for each in listed(entry["minimise"], "minimise"))
    menus = _menus(entry, start, reading)
    found = _free(entry, start, menus, reading)
    free = {n: menus[n] if n in menus else _bounds(start, menus, n, *given) for n, given in found.items()}
    angles = whole(entry["angles"], "the file's 'angles'", 2, MOST_ANGLES)
    study: Study = Study(start, free, minimise, at_most=limits["at_most"], at_least=limits["at_least"], angles=angles)
    return under_tolerances(study, entry["tolerances"], reading) if entry["tolerances"] else study


def _menus(entry: Mapping[str, object], start: object, reading: Reading) -> dict[str, Menu]:
    """The menus that a file frees, by their names."""
    menus: dict[str, Menu] = {}
    told = mapping(entry["free"], "free")
    for k in (k for k in _order(entry) if isinstance(told[k], dict)):
        places = _declared(start, menus, k, k)
        options: dict[str, object] = {}
        for option in _few(listed(mapping(told[k], k).get("options"), k)):
            name, *values = option if isinstance(option, list) and option else (None,)
            if not isinstance(name, str) or len(values) != len(places) or name in options:
                raise ValueError(f"the file says {shown(option)} for {shown(k)}, where an option belongs")
            found = tuple(reading.declared(Given(k, v), d) for v, d in zip(values, places.values(), strict=True))
            options[plain(name)] = found if len(found) > 1 else found[0]
        try:
            free = freed(start, {**menus, tuple(places): options})
        except ValueError as refusal:
            raise ValueError(f"the file frees {shown(k)}, which cannot be: {refusal}") from None
        menus |= {name: menu for name, menu in free.items() if isinstance(menu, Menu)}
    return menus


def _few(options: Sequence[object]) -> Sequence[object]:
    if len(options) > MOST_THINGS:
        raise ValueError(f"the file has a list of {len(options)} options; there can be at most {MOST_THINGS}")
    return options


def _declared(start: object, menus: Mapping[str, Menu], k: str, name: str) -> dict[str, Any]:
    """The declarations of what a file frees as ``name``, today ``k``, perhaps several paths, by path."""
    try:
        places = declared_with(start, menus.values(), [each.partition(" [")[0] for each in k.split(", ")])
    except ValueError:
        places = {}
    if not places or _menu_key(places) != k:
        raise ValueError(f"the file frees {shown(name)}, which {kind_words(type(start), article=True)} does not have")
    return places


def _free(
    entry: Mapping[str, object], start: object, menus: Mapping[str, Menu], reading: Reading
) -> dict[str, tuple[Given, float]]:
    """What a file frees, by its name of today, and what the file's numbers are multiplied by to be SI."""
    keys = {_menu_key(declared_with(start, menus.values(), menu.paths)): menu for menu in menus.values()}
    found = {menu.name: (Given(k, [0, len(menu.names) - 1]), 1.0) for k, menu in keys.items()}
    numbers = {k: value for k, value in mapping(entry["free"], "free").items() if k not in keys}
    for k, given in reading.renaming.entries(type(start).__name__, numbers).items():
        (path, quantity), *others = _declared(start, menus, k, given.name).items()
        if others or not isinstance(quantity, Quantity):
            raise ValueError(f"the file says {shown(given.value)} for {shown(k)}, where options belong")
        found[path] = given, given.times * quantity.factor
    order = _order(entry)
    return dict(sorted(found.items(), key=lambda item: order.index(item[1][0].name)))


def _order(entry: Mapping[str, object]) -> list[str]:
    """What a file frees in the order of its front's columns; of an earlier camkit: in that of the file."""
    free, columns = [*mapping(entry["free"], "free")], listed(entry["columns"], "columns")
    if columns and (not all(isinstance(k, str) for k in columns) or sorted(columns) != sorted(free)):
        raise ValueError(f"the file says {shown(columns)} for 'columns'; they must be what it frees, each once")
    return columns or free


def _bounds(start: object, menus: Mapping[str, Menu], path: str, given: Given, scale: float) -> tuple[float, float]:
    first, second = (b * scale + 0.0 for b in all_numbers(given.value, given.name, 2))
    bounds = (first, second) if scale > 0 else (second, first)
    try:
        refuse_bounds(declared_with(start, menus.values(), (path,)), {path: bounds})
    except ValueError as refusal:
        raise ValueError(f"the file says {shown(given.value)} for {given.name!r}: {refusal}") from None
    return bounds


def x_of(entry: Mapping[str, object], study: Study, reading: Reading) -> np.ndarray:
    """The free values of a front, SI."""
    n, rows = len(study.free), listed(entry["front"], "front")
    if not all(isinstance(row, list) and len(row) == n and all(map(is_number, row)) for row in rows):
        raise ValueError(f"the file is damaged: its front does not have {n} values for each design")
    if len(rows) * study.angles > MOST_POINTS:
        raise ValueError(
            f"the file has {len(rows)} designs at {study.angles} angles each; there can be {MOST_POINTS} points in all"
        )
    menus = {menu.name: menu for menu in study.menus}
    free = list(_free(entry, study.start, menus, reading).values())
    x = np.array(rows, dtype=float).reshape(-1, n) * [scale for _, scale in free] + 0.0
    for i, j in _outside(x, study)[:1]:
        given = free[j][0]
        raise ValueError(
            f"the front of the file has a design outside the bounds of its study: design {i + 1} has {rows[i][j]} for "
            f"{given.name!r}; the bounds are {given.value[0]} and {given.value[1]}"
        )
    return x


def _outside(x: np.ndarray, study: Study) -> np.ndarray:
    """Row and column of what is not between the bounds of its study, but for rounding."""
    low, high = study.bounds
    rounding = SAME_BOUND * np.maximum(abs(low), abs(high))
    return np.argwhere((x < low - rounding) | (x > high + rounding))


def _key(measure: Measure) -> str:
    return f"{measure.name} [{measure.unit}]" if measure.unit else measure.name


def _declared_measures(start: object) -> dict[str, Measure]:
    return {_key(m): m for m in measures_of(start)}


def _made(k: str, entry: Given, start: Design, named: Mapping[str, Measure]) -> Measure:
    """A measure that is made of numbers and words, by one of the mechanism's makers or from a measure of a curve."""
    name, *given = listed(entry.value, entry.name) or [None]
    how = {**type(start).makers, **_zones(k, named)}.get(name) if isinstance(name, str) else None
    try:
        measure = how(*(_given(value) for value in given)) if how else None
    except (TypeError, ValueError):
        measure = None
    if measure is None or _key(measure) != k:
        raise ValueError(f"the file is damaged: what it says of {shown(entry.name)} does not make this measure")
    return measure


def _zones(k: str, named: Mapping[str, Measure]) -> dict[str, Callable[..., Measure | None]]:
    """What makes the measure of key ``k``, of a curve at one cam angle or between two, from that of the whole curve."""

    def zone(way: str, name: str, *angles: float) -> Measure | None:
        whole = named.get(name + "".join(k.partition(" [")[1:]))
        return getattr(whole, way)(*angles) if isinstance(whole, CurveMeasure) else None

    return {way: partial(zone, way) for way in ("at", "between")}


def _given(value: object) -> object:
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


def _objective_entry(measure: Measure, known: Mapping[str, Measure]) -> object:
    if not isinstance(measure, WeightedSum):
        return _key(measure) if measure.sign > 0 else f"-{_key(measure)}"
    parts = [_relative_key(p, known) for p in measure.parts]
    weights = [[k, w] for k, w in zip(parts, measure.weights, strict=True)]
    si = zip(parts, measure.parts, measure.reference, strict=True)
    reference = {k: exact_in_unit(r, p.unit) for k, p, r in si}
    return {"name": measure.name, "weights": weights, "reference": reference, "sign": measure.sign}


def _found(named: Mapping[str, Measure], renaming: Renaming, k: str) -> Measure:
    """The measure of a key."""
    now = renaming.name("measure", k)
    if now in named:
        return named[now]
    if k[:1] == "-" and renaming.name("measure", k[1:]) in named:
        return -named[renaming.name("measure", k[1:])]
    raise ValueError(
        f"the study has the measure {shown(k)}, which its mechanism does not have; if it is your own, hand it over as "
        "read(path, measures=(...))"
    )


def _by_measure(entry: object, name: str, find: Find) -> dict[Measure, float]:
    """Numbers by the measure that their key names."""
    found: dict[Measure, float] = {}
    for k, value in mapping(entry, name).items():
        if find(k) in found:
            raise ValueError(f"the file has the {find(k).name} twice in {name!r}, the second time as {shown(k)}")
        found[find(k)] = one_number(value, f"the file's {shown(k)}")
    return found


def _objective(entry: object, find: Find) -> Measure:
    if isinstance(entry, dict):
        return _sum(entry, find)
    if not isinstance(entry, str):
        raise ValueError(f"the file says {shown(entry)} where the name of a measure belongs")
    found = find(entry.removeprefix("-"))
    return found if (found.sign < 0) == entry.startswith("-") else -found


def _sum(entry: object, find: Find) -> WeightedSum:
    """A weighted sum."""
    entry = {"sign": 1} | mapping(entry, "weighted sum")
    if (
        entry.keys() != {"name", "weights", "reference", "sign"}
        or entry["sign"] not in (1, -1)
        or entry["sign"] is True
    ):
        raise ValueError("the file is damaged: its weighted sum is not as camkit writes it")
    parts = _by_measure(_ordered(entry["weights"]), "weights", find)
    if isinstance(entry["reference"], dict):
        by_measure = _by_measure(entry["reference"], "reference", find)
        if by_measure.keys() != parts.keys():
            raise ValueError("the file is damaged: the reference of its weighted sum is of other measures")
        reference = [by_measure[m] for m in parts]
    else:
        reference = all_numbers(entry["reference"], "reference", len(parts))
    si = [r * factor(m.unit) for m, r in zip(parts, reference, strict=True)]
    return replace(weighted(plain(entry["name"]), parts, si), sign=int(entry["sign"]))


def _ordered(weights: object) -> object:
    """The weights of a sum by name, of pairs, whose order stays; in files of an earlier camkit they are by name."""
    if not isinstance(weights, list):
        return weights
    if not all(isinstance(pair, list) and len(pair) == 2 and isinstance(pair[0], str) for pair in weights):
        raise ValueError(f"the file says {shown(weights)} for 'weights', where pairs of a measure and a number belong")
    if len(by_name := dict(weights)) < len(weights):
        raise ValueError(f"the file says {shown(weights)} for 'weights'; each measure must be there once")
    return by_name
