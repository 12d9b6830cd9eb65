"""Files: a design, a front or a whole study as JSON with units in the names.

Every file says which schema it follows and carries a digest of its content.  A file that is damaged, of another kind
or of another schema is refused by a ``ValueError`` in a sentence, and nothing of it is used; one that was edited, or
lacks what a later camkit has added, is read with a remark (`read`).
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from .. import kinds
from ..decision import Judgements
from ..quantities import Design, Measure, quantities_of, words
from ..search.front import Front, front_of
from ..study.study import Study, WeightedSum, weighted
from ..units import factor
from .entries import MOST_ROWS, Reading, entry_of, exact_in_unit, is_number, key
from .json_file import MOST_BYTES, content_of, digest_remarks, shown, signed, text_of

SCHEMA = "camkit/1"
SETTINGS: dict[str, type] = {"population": int, "generations": int, "seed": int, "mode": str, "rule": str}
"""What a search is set to: counts, and the entries of its menus."""
COUNTS = {"population": (1, 100_000), "generations": (1, 1_000_000), "designs": (0, 10**12), "seed": (0, 10**12)}
"""What a file may say of a search."""
MOST_ANGLES = 20_001
"""Cam angles of an analysis."""
SAME_BOUND = 1e-9
"""A design that misses a bound by no more than this share of it is on the bound: what rounding in a unit does."""
MOST_POINTS = 5_000_000
"""Designs of a front times angles of each: more do not fit into the memory of a small machine at once."""
PLAIN = re.compile(r"\w[\w +,.:;()/%^-]*")
"""Names in files: letters, digits, spaces and the signs of camkit's own names."""


@dataclass(frozen=True)
class Work:
    """All that a person did on one study: the study, the design in hand, judgements, search settings, front."""

    study: Study
    design: Any
    judgements: Mapping[str, Judgements] = field(default_factory=dict)
    """By what they judge, such as ``"importance"`` of the objectives."""
    search: Mapping[str, Any] = field(default_factory=dict)
    """Population, generations, seed, mode and rule (entries of menus) of the search that found ``x``."""
    x: Any = ()
    """Free values of the front's designs, ``(p, n_free)``, SI."""
    record: Mapping[str, Any] = field(default_factory=dict)
    """How the front was found: population, generations, seed, seconds, versions; empty if nobody wrote it down."""


@dataclass(frozen=True)
class Read:
    """What a file holds, and what is to be remarked about it, in sentences."""

    thing: Any
    remarks: tuple[str, ...] = ()


def save(thing: Any, path: str | Path) -> None:
    """Write a design, a front or a `Work` to a JSON file; a file that is there is kept until the new one is whole."""
    text, path = to_json(thing), _path(path)
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(path)
    except OSError as error:  # of the file that was asked for, not of the part that nobody knows
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _path(path: Any) -> Path:
    if not isinstance(path, (str, os.PathLike)) or not Path(path).name:
        raise ValueError(
            f"the path of the file is {kinds.shown(path)}; it must be a text such as 'design.json', or a Path"
        )
    return Path(path)


def load(
    path: str | Path,
    kind: type | None = None,
    measures: Iterable[Measure] = (),
    tell: Callable[[str], Any] = print,
) -> Any:
    """Read a design, a front or a `Work` from a JSON file; ``tell`` is called with each remark.

    ``kind`` and ``measures`` are those of `read`.
    """
    path = _path(path)
    if not (kind is None or isinstance(kind, type)) or not callable(tell):
        told = f"{kinds.shown(kind)} and {kinds.shown(tell)}"
        raise ValueError(f"the kind and who is told are {told}; they must be a class, or None, and a function")
    with path.open("rb") as file:
        found = read(file.read(MOST_BYTES + 1), kind, measures)
    for remark in found.remarks:
        tell(f"{path.name}: {remark}")
    return found.thing


def to_json(thing: Any) -> str:
    """A design, a front or a `Work` as JSON text.

    >>> from camkit import DoorHandleCam
    >>> from_json(to_json(DoorHandleCam(lift_arm=0.048))).lift_arm
    0.048

    Raises ``ValueError`` in a sentence for what could not be read again: a population, a motion law that is a
    function of one's own, a name with other signs than letters, digits, spaces and ``+,.:;()/%^-``.
    """
    text = signed({"schema": SCHEMA, **_content(thing)})
    try:
        read(text, *((Design,) if isinstance(thing, Design) else (Work, thing.study.measures)))
    except ValueError as refusal:
        raise ValueError(f"this cannot be saved, as it could not be read again: {refusal}") from None
    return text


def _content(thing: Any) -> dict[str, Any]:
    if isinstance(thing, Design):
        return {"design": entry_of(thing)}
    if isinstance(thing, Work):
        return {"work": _work_entry(thing)}
    if isinstance(thing, Front):
        return {"front": _front_entry(thing)}
    raise ValueError(f"this is {kinds.shown(thing)}; a design, a front or a Work can be saved")


def from_json(file: str | bytes, kind: type | None = None, measures: Iterable[Measure] = ()) -> Any:
    """The design, front or `Work` that `to_json` wrote; `read` says as well what is to be remarked about it."""
    return read(file, kind, measures).thing


def read(file: str | bytes, kind: type | None = None, measures: Iterable[Measure] = ()) -> Read:
    """What a file holds, and remarks: it was edited or damaged, or lacks a field, which then took its default.

    ``kind`` refuses anything else; where a `Work` is wanted, a front is one.  ``measures`` are those of one's own
    that a study has beside the measures of its mechanism.

    >>> from camkit import DoorHandleCam
    >>> text = to_json(DoorHandleCam())
    >>> read(text).remarks, read(text.replace("75.0", "76.0")).remarks
    ((), ('its content does not match its digest: it was edited or damaged after it was saved; check its numbers',))

    Raises ``ValueError`` in a sentence for text that is no JSON, another encoding, another schema, an unknown name,
    an entry that is not of the kind that belongs there, an absurd count, or a number that cannot be built.
    """
    text = text_of(file)
    content = content_of(text)
    told = content.pop("digest", None)
    if content["schema"] != SCHEMA:
        raise ValueError(f"the file follows the schema {shown(content['schema'])}; this camkit reads {SCHEMA!r}")
    held = [name for name in ("design", "work", "front") if name in content]
    if len(held) != 1 or len(content) != 2:
        raise ValueError("the file is damaged: beside its schema it must hold one design, one work or one front")
    reading = Reading()
    try:
        content = {
            k: (reading.renaming.design if k == "design" else reading.renaming.study)(v) for k, v in content.items()
        }
        thing = _thing(held[0], content[held[0]], reading, kind, measures)
    except (TypeError, AttributeError, LookupError, ArithmeticError):
        raise ValueError("the file is damaged: an entry is not of the kind that belongs there") from None
    _refuse_other(thing, held[0], kind)
    remarks = (*digest_remarks(text, told), *reading.renaming.remarks, *_lacking(reading.missing), *reading.remarks)
    return Read(thing, remarks)


def _thing(held: str, entry: Any, reading: Reading, kind: type | None, measures: Iterable[Measure]) -> Any:
    if held == "design":
        return reading.thing(_mapping(entry, held), kind or object)
    work = _work(_entries(entry, held, reading), reading, measures)
    return work if held == "work" or kind is Work else _front(work, _message(entry.get("message", "")), reading)


def _refuse_other(thing: Any, held: str, kind: type | None) -> None:
    if not isinstance(thing, kind or (Design if held == "design" else object)):
        wanted = kinds.kind_words(kind, article=True) if kind else "a design"
        raise ValueError(f"the file holds {kinds.kind_words(type(thing), article=True)}; {wanted} is wanted here")


def _lacking(missing: Sequence[str]) -> list[str]:
    if not missing:
        return []
    more = f" and {len(missing) - 4} more" if len(missing) > 4 else ""
    return [f"it lacks {', '.join(missing[:4])}{more}, as files of another camkit may: the default was taken"]


# ---------------------------------------------------------------- studies

STUDY = ("at_most", "at_least", "sums", "made", "angles")
DEFAULTS: dict[str, Any] = {
    "at_most": {},
    "at_least": {},
    "sums": [],
    "made": {},
    "angles": Study.angles,
    "front": [],
    "record": {},
    "judgements": {},
    "search": {},
}
"""What a study is read with where its file says nothing."""
QUIETLY = {"sums", "made", "record"}
"""Which of them are no matter for a remark: a file has them only where there is something to say."""
HELD = {
    "work": {"start", "free", "minimise", "design", "methods", *DEFAULTS},
    "front": {"start", "free", "minimise", "front", "record", "message", *STUDY},
}


def _work_entry(work: Work) -> dict[str, Any]:
    if not isinstance(work.study, Study):
        raise ValueError(f"the study of this work is a {type(work.study).__name__}; it must be a Study")
    return {
        **_study_entry(work.study),
        "design": entry_of(work.design),
        "judgements": {name: _judgements_entry(name, judged) for name, judged in work.judgements.items()},
        "search": {name: entry_of(value) for name, value in work.search.items()},
        "front": _rows(work.study, work.x),
        "record": _record_entry(work.record),
    }


def _front_entry(front: Any) -> dict[str, Any]:
    return {
        **_study_entry(front.study),
        "front": _rows(front.study, front.x),
        "record": _record_entry(front.record),
        "message": front.message,
    }


def _study_entry(study: Study) -> dict[str, Any]:
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


def _rows(study: Study, x: Any) -> list[list[float]]:
    units = [q.unit for q in study.declared.values()]
    return [[exact_in_unit(v, unit) for unit, v in zip(units, row, strict=True)] for row in x]


def _record_entry(record: Mapping[str, Any]) -> dict[str, Any]:
    return {k: dict(v) if isinstance(v, Mapping) else entry_of(v) for k, v in record.items()}


def _judgements_entry(name: str, judgements: Any) -> dict[str, Any]:
    if not isinstance(judgements, Judgements):
        raise ValueError(f"the {name} is {kinds.shown(judgements)}; it must be Judgements")
    return {"names": list(judgements.names), "above": list(judgements.above), "method": judgements.method}


def _entries(entry: Any, held: str, reading: Reading) -> dict[str, Any]:
    """All entries of a study, those that are lacking with their defaults."""
    given, known = _mapping(entry, held), HELD[held]
    for wrong in given.keys() - known:
        raise ValueError(f"the file has {shown(wrong)}, which a saved study does not have")
    for lacking in ("start", "free", "minimise"):
        if lacking not in given:
            raise ValueError(f"the file is damaged: it lacks {lacking!r} of the study")
    reading.missing.extend(f"{name!r} of the study" for name in DEFAULTS if name in known - given.keys() - QUIETLY)
    if held == "work" and "design" not in given:
        reading.missing.append("'design' of the study")
    return DEFAULTS | given


def _work(entry: Mapping[str, Any], reading: Reading, measures: Iterable[Measure]) -> Work:
    study = _study(entry, reading, measures)
    reading.held.clear()  # another design
    design = reading.thing(entry["design"], type(study.start)) if "design" in entry else study.start
    if not isinstance(design, type(study.start)):
        raise ValueError("the file is damaged: its design is of another kind than its start")
    methods = _mapping(entry.get("methods", {}), "methods")  # in files of 0.1.0, beside lists without names
    judgements = {
        _plain(n): _judged(n, m, methods.get(n)) for n, m in _mapping(entry["judgements"], "judgements").items()
    }
    search = {name: _setting(name, value) for name, value in _mapping(entry["search"], "search").items()}
    return Work(study, design, judgements, search, _x(entry["front"], study), _record(entry["record"]))


def _study(entry: Mapping[str, Any], reading: Reading, measures: Iterable[Measure]) -> Study:
    start = reading.thing(entry["start"])
    if not isinstance(start, Design):
        raise ValueError("the file is damaged: the start of its study is no design")
    declared = {key(path, q): (path, q) for path, q in quantities_of(start).items()}
    named = _declared_measures(start)
    signs = {k: m.sign for k, m in named.items()}
    made = [_made(k, how, start) for k, how in _mapping(entry["made"], "made").items()]
    named |= {_key(m): m if m.sign == signs.get(_key(m), 1) else -m for m in (*made, *measures)}
    named |= {m.name: m for m in (_sum(each, named) for each in _listed(entry["sums"], "sums"))}
    free = {}
    for k, bounds in _mapping(entry["free"], "free").items():
        if k not in declared:
            raise ValueError(
                f"the file frees {shown(k)}, which {kinds.kind_words(type(start), article=True)} does not have"
            )
        name, quantity = declared[k]
        free[name] = tuple(quantity.factor * b for b in _numbers(bounds, k, 2))
    limits: dict[str, Any] = {
        name: {_found(k, named): _numbers([v], k, 1)[0] * factor(_found(k, named).unit) for k, v in limited.items()}
        for name, limited in ((n, _mapping(entry[n], n)) for n in ("at_most", "at_least"))
    }
    minimise = tuple(_objective(each, named) for each in _listed(entry["minimise"], "minimise"))
    return Study(start, free, minimise, angles=_count("angles", entry["angles"], 2, MOST_ANGLES), **limits)


def _front(work: Work, message: str, reading: Reading) -> Front:
    """The front of a study that was saved alone, its objectives computed anew."""
    if not len(work.x):
        return Front(work.study, work.x, np.zeros((0, len(work.study.minimise))), message, work.record)
    front = front_of(work.study.evaluate(work.x), work.study)
    reading.remarks.extend(left_out(len(work.x), len(front)))
    return replace(front, record=work.record)


def left_out(told: int, kept: int) -> list[str]:
    """What is to be remarked where a file has ``told`` designs of a front, of which ``kept`` are one.

    >>> left_out(20, 20), left_out(20, 19)
    ([], ['1 of its 20 designs miss a limit or are dominated and were left out'])
    """
    if kept == told:
        return []
    return [f"{told - kept} of its {told} designs miss a limit or are dominated and were left out"]


def _x(rows: Any, study: Study) -> np.ndarray:
    """The free values of a front, SI."""
    n, rows = len(study.free), _listed(rows, "front")
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


# ---------------------------------------------------------------- measures


def _key(measure: Measure) -> str:
    return f"{measure.name} [{measure.unit}]" if measure.unit else measure.name


def _declared_measures(start: Any) -> dict[str, Measure]:
    return {_key(m): m for m in type(start).measures}


def _made(k: str, entry: Any, start: Any) -> Measure:
    """A measure that one of the mechanism's makers makes of numbers and words."""
    name, *given = _listed(entry, k) or [None]
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
        return tuple(_numbers(value, "made", len(value)))
    return value if is_number(value) else _plain(value)


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
            mechanism = kinds.kind_words(type(study.start), article=True)
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
        "load(path, measures=(...))"
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
    entry = {"sign": 1} | _mapping(entry, "weighted sum")
    if (
        entry.keys() != {"name", "weights", "reference", "sign"}
        or entry["sign"] not in (1, -1)
        or entry["sign"] is True
    ):
        raise ValueError("the file is damaged: its weighted sum is not as camkit writes it")
    parts = {_found(k, named): v for k, v in _mapping(entry["weights"], "weights").items()}
    weights = _numbers(list(parts.values()), "weights", len(parts))
    reference = _numbers(entry["reference"], "reference", len(parts))
    si = [r * factor(m.unit) for m, r in zip(parts, reference, strict=True)]
    total = weighted(_plain(entry["name"]), dict(zip(parts, weights, strict=True)), si)
    return replace(total, sign=int(entry["sign"]))


# ---------------------------------------------------------------- kinds of entries


def _mapping(entry: Any, name: str) -> dict[str, Any]:
    if not isinstance(entry, dict):
        raise ValueError(f"the file is damaged: it says {shown(entry)} for {name!r}, where names and values belong")
    return entry


def _listed(entry: Any, name: str) -> list[Any]:
    if not isinstance(entry, list):
        raise ValueError(f"the file is damaged: it says {shown(entry)} for {name!r}, where a list belongs")
    if len(entry) > MOST_ROWS:
        raise ValueError(f"the file has {len(entry)} entries in {name!r}; there can be at most {MOST_ROWS}")
    return entry


def _numbers(entry: Any, name: str, count: int) -> list[float]:
    if not isinstance(entry, list) or len(entry) != count or not all(map(is_number, entry)):
        said = "a number belongs" if count == 1 else f"{count} numbers belong"
        raise ValueError(f"the file is damaged: it says {shown(entry)} for {shown(name)}, where {said}")
    return [float(number) for number in entry]


def _count(name: str, value: Any, least: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise ValueError(
            f"the file says {shown(value)} for {name!r}; it must be a whole number of at least {least}, at most {most}"
        )
    return value


def _plain(name: Any, longest: int = 100) -> str:
    if not isinstance(name, str) or not PLAIN.fullmatch(name) or len(name) > longest:
        raise ValueError(
            f"the file has the name {shown(name)}; a name has up to {longest} letters, digits, spaces and "
            "+ , - . / : ; ( ) % ^"
        )
    return name


def _message(entry: Any) -> str:
    return _plain(entry, 1000) if entry != "" else ""


def _setting(name: str, value: Any) -> Any:
    if name in COUNTS and name in SETTINGS:
        return _count(name, value, *COUNTS[name])
    if name not in SETTINGS or not isinstance(value, SETTINGS[name]):
        raise ValueError(f"the file says {shown(value)} for {shown(name)}, which is no setting of a search")
    return _plain(value)


def _judged(name: str, entry: Any, method: Any = None) -> Judgements:
    """Judgements; in a file of 0.1.0 a matrix or what is above its diagonal, and its ``method`` if that is known."""
    if isinstance(entry, list):
        entry = {"names": [], "above": entry, "method": "eigenvector" if method is None else method}
    if not isinstance(entry, dict) or entry.keys() != {"names", "above", "method"}:
        raise ValueError(f"the file says {shown(entry)} for the judgements of {shown(name)}, where judgements belong")
    rows = _listed(entry["above"], name)
    flat = [value for row in rows for value in (_listed(row, name) if isinstance(row, list) else [row])]
    if len(flat) > MOST_ROWS or not all(value is None or is_number(value) for value in flat):
        raise ValueError(f"the file says {shown(rows)} for the judgements of {shown(name)}, where numbers belong")
    try:
        return Judgements(_listed(entry["names"], name), rows or [[1]], entry["method"])
    except ValueError as refusal:
        raise ValueError(f"the file has judgements of {shown(name)} that cannot be: {refusal}") from None


def _record(entry: Any) -> dict[str, Any]:
    """The record of a search by NSGA-II, or of a quick front, which has no seed."""
    if entry == {}:
        return {}
    common = {"seconds", "versions"}
    known = ({"population", "generations", "seed"} | common, {"designs"} | common)
    if not isinstance(entry, dict) or entry.keys() not in known or not is_number(entry["seconds"]):
        raise ValueError("the file is damaged: its record of the search is not as camkit writes it")
    for name in entry.keys() - common:
        _count(name, entry[name], *COUNTS[name])
    for name, version in _mapping(entry["versions"], "versions").items():
        _plain(name), _plain(version)
    return dict(entry)
