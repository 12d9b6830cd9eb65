"""Files: a design or a whole study as JSON with units in the names.

Every file says which schema it follows.  A file that is damaged, of another kind or of another schema is
refused by a ``ValueError`` in a sentence, and nothing of it is used.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import motion
from .decision import judgement_matrix
from .quantities import Choice, Design, Measure, Quantity, declarations
from .study import Study, WeightedSum, weighted
from .units import in_unit

SCHEMA = "camkit/1"
SETTINGS: dict[str, type] = {"population": int, "generations": int, "seed": int, "mode": str, "rule": str}
"""What a search is set to: counts, and the entries of its menus."""


@dataclass(frozen=True)
class Work:
    """All that a person did on one study: the study, the design in hand, judgements, search settings, front."""

    study: Study
    design: Any
    judgements: Mapping[str, Any] = field(default_factory=dict)
    """Upper triangles of judgement matrices by name; ``None`` for a judgement that was not made."""
    search: Mapping[str, Any] = field(default_factory=dict)
    """Population, generations, seed, mode and rule (entries of menus) of the search that found ``x``."""
    x: Any = ()
    """Free values of the front's designs, ``(p, n_free)``, SI."""
    record: Mapping[str, Any] = field(default_factory=dict)
    """How the front was found: population, generations, seed, seconds, versions; empty if nobody wrote it down."""


def save(thing: Any, path: str | Path) -> None:
    """Write a design or a `Work` to a JSON file."""
    Path(path).write_text(to_json(thing), encoding="utf-8")


def load(path: str | Path) -> Any:
    """Read a design or a `Work` from a JSON file."""
    return from_json(Path(path).read_text(encoding="utf-8", errors="replace"))


def to_json(thing: Any) -> str:
    """A design or a `Work` as JSON text.

    >>> from camkit import DoorHandleCam
    >>> from_json(to_json(DoorHandleCam(lift_arm=0.048))).lift_arm
    0.048
    """
    if not isinstance(thing, (Work, Design)):
        raise ValueError(f"this is a {type(thing).__name__}; a design or a Work can be saved")
    if not isinstance(thing, Work) and any(
        np.ndim(getattr(thing, n)) for n, d in declarations(thing).items() if isinstance(d, Quantity)
    ):
        raise ValueError("this is a population; one design can be saved")
    content = {"work": _work_out(thing)} if isinstance(thing, Work) else {"design": _out(thing)}
    try:
        return json.dumps({"schema": SCHEMA, **content}, indent=1, allow_nan=False)
    except TypeError:
        raise ValueError("a motion law that is a function of one's own cannot be saved") from None


def from_json(text: str, kind: type | None = None) -> Any:
    """The design or `Work` that `to_json` wrote; ``kind`` refuses anything else.

    Raises ``ValueError`` in a sentence for text that is no JSON, another schema, an unknown or missing name, or
    a number that cannot be built.
    """
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise ValueError(f"the file is damaged: it is no JSON at line {error.lineno} ({error.msg})") from None
    except RecursionError:
        raise ValueError("the file is damaged: it is nested too deeply") from None
    if not isinstance(content, dict) or not isinstance(content.get("schema"), str):
        raise ValueError("the file is damaged: it does not say which camkit schema it follows")
    if content["schema"] != SCHEMA:
        raise ValueError(f"the file follows the schema {content['schema']!r}; this camkit reads {SCHEMA!r}")
    try:
        thing = _work_in(content["work"]) if "work" in content else _in(content["design"])
    except KeyError as error:
        raise ValueError(f"the file is damaged: it lacks or garbles {error}") from None
    except (TypeError, AttributeError, IndexError, OverflowError):
        raise ValueError("the file is damaged: an entry is not of the kind that belongs there") from None
    if not isinstance(thing, Design if kind is None and "work" not in content else kind or Work):
        wanted = kind.__name__ if kind else "design"
        raise ValueError(f"the file holds a {type(thing).__name__}; a {wanted} is wanted here")
    return thing


def _kinds() -> dict[str, type]:
    """Every class that a file may name."""
    laws = {name: getattr(motion, name) for name in motion.__all__}
    found: list[type] = [k for k in laws.values() if isinstance(k, type) and is_dataclass(k)]
    waiting: list[type] = list(Design.__subclasses__())
    while waiting:
        found.append(waiting.pop())
        waiting += found[-1].__subclasses__()
    return {k.__name__: k for k in found}


def _key(name: str, declared: Any) -> str:
    """A field's name in a file: with its unit."""
    return f"{name} [{declared.unit}]" if isinstance(declared, Quantity) and declared.unit else name


def _out(value: Any) -> Any:
    """A value as JSON knows it."""
    if is_dataclass(value) and not isinstance(value, type):
        declared = declarations(value)
        entries = {
            _key(f.name, declared.get(f.name)): _entry_out(getattr(value, f.name), declared.get(f.name))
            for f in fields(value)
        }
        return {"kind": type(value).__name__, **entries}
    if isinstance(value, (tuple, list, np.ndarray)):
        return [_out(v) for v in value]
    return value.item() if isinstance(value, np.generic) else value


def _entry_out(value: Any, declared: Any) -> Any:
    if isinstance(declared, Quantity):
        return in_unit(float(value), declared.unit)
    if isinstance(declared, Choice) and value in declared.options:
        return value.name
    return _out(value)


def _in(value: Any) -> Any:
    """What `_out` wrote."""
    if isinstance(value, list):
        return tuple(_in(v) for v in value)
    if not isinstance(value, dict):
        return value
    kinds = _kinds()
    if value.get("kind") not in kinds:
        raise ValueError(f"the file names a {value.get('kind')!r}, which this camkit does not know")
    kind = kinds[value["kind"]]
    return kind(**_fields_in(kind, {k: v for k, v in value.items() if k != "kind"}))


def _fields_in(kind: type, entries: Mapping[str, Any]) -> dict[str, Any]:
    declared = declarations(kind)
    names = {_key(f.name, declared.get(f.name)): f.name for f in fields(kind)}
    for wrong in entries.keys() - names.keys():
        raise ValueError(f"the file has {wrong!r}, which a {kind.__name__} does not have")
    for missing in names.keys() - entries.keys():
        raise ValueError(f"the file lacks {missing!r} of the {kind.__name__}")
    return {names[k]: _entry_in(v, declared.get(names[k]), k) for k, v in entries.items()}


def _entry_in(value: Any, declared: Any, key: str) -> Any:
    if isinstance(declared, Quantity):
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise ValueError(f"the file says {value!r} for {key!r}; it must be {declared.possible}")
        return value * declared.factor
    if isinstance(declared, Choice) and isinstance(value, str):
        for option in declared.options:
            if option.name == value:
                return option
        raise ValueError(
            f"the file says {value!r} for {key!r}; there are {', '.join(o.name for o in declared.options)}"
        )
    return _in(value)


def _work_out(work: Work) -> dict[str, Any]:
    study = work.study
    declared: Any = declarations(study.start)
    in_units = [[in_unit(float(v), declared[n].unit) for n, v in zip(study.free, row, strict=True)] for row in work.x]
    return {
        "start": _out(study.start),
        "free": {
            _key(n, declared[n]): [in_unit(b, declared[n].unit) for b in bounds] for n, bounds in study.free.items()
        },
        "minimise": [_measure_out(measure) for measure in study.minimise],
        "at_most": {_measure_key(m): in_unit(v, m.unit) for m, v in (study.at_most or {}).items()},
        "at_least": {_measure_key(m): in_unit(v, m.unit) for m, v in (study.at_least or {}).items()},
        "angles": study.angles,
        "design": _out(work.design),
        "judgements": {name: _out(matrix) for name, matrix in work.judgements.items()},
        "search": dict(work.search),
        "front": in_units,
        "record": dict(work.record),
    }


def _work_in(entry: Mapping[str, Any]) -> Work:
    start = _in(entry["start"])
    declared: Any = declarations(start)
    keys = {_key(n, q): n for n, q in declared.items()}
    for k, bounds in entry["free"].items():
        if len(bounds) != 2:
            raise ValueError(f"the file is damaged: it does not give two bounds for {k!r}")
    free = {keys[k]: tuple(declared[keys[k]].factor * b for b in bounds) for k, bounds in entry["free"].items()}
    named = {_measure_key(m): m for m in type(start).measures}
    study = Study(
        start=start,
        free=free,
        minimise=tuple(_measure_in(m, named) for m in entry["minimise"]),
        at_most={named[k]: v * _si(named[k]) for k, v in entry["at_most"].items()},
        at_least={named[k]: v * _si(named[k]) for k, v in entry["at_least"].items()},
        angles=_whole(entry["angles"]),
    )
    rows = entry["front"]
    if not isinstance(rows, list) or not all(isinstance(r, list) and len(r) == len(free) for r in rows):
        raise ValueError(f"the file is damaged: its front does not have {len(free)} values for each design")
    if not isinstance(_in(entry["design"]), type(start)):
        raise ValueError("the file is damaged: its design is of another kind than its start")
    for name, v in dict(entry["search"]).items():
        if not isinstance(v, SETTINGS.get(name, ())) or isinstance(v, bool):
            raise ValueError(f"the file says {v!r} for {name!r}, which is no setting of a search")
    for matrix in entry["judgements"].values():
        judgement_matrix(_in(matrix))
    x = np.array(rows, dtype=float).reshape(-1, len(free)) * [declared[n].factor for n in free]
    if not np.isfinite(x).all():
        raise ValueError("the file is damaged: its front has a value that is not a finite number")
    record = _record_in(entry.get("record", {}))  # files of camkit 0.1 have none
    return Work(study, _in(entry["design"]), _matrices(entry["judgements"]), dict(entry["search"]), x, record)


def _record_in(entry: Any) -> dict[str, Any]:
    """The record of a search by NSGA-II, or of a quick front, which has no seed."""
    common: dict[str, Any] = {"seconds": (int, float), "versions": dict}
    wanted = ({"population": int, "generations": int, "seed": int} | common, {"designs": int} | common)
    kinds = next((kinds for kinds in wanted if isinstance(entry, dict) and entry.keys() == kinds.keys()), None)
    if entry and not (
        kinds
        and all(isinstance(entry[name], kind) and not isinstance(entry[name], bool) for name, kind in kinds.items())
        and all(isinstance(version, str) for version in entry["versions"].values())
    ):
        raise ValueError("the file is damaged: its record of the search is not as camkit writes it")
    return dict(entry)


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 2:
        raise ValueError(f"the file says {value!r} for 'angles'; it must be a whole number of at least 2")
    return value


def _matrices(entry: Mapping[str, Any]) -> dict[str, Any]:
    return {name: _in(matrix) for name, matrix in entry.items()}


def _si(measure: Measure) -> float:
    return 1 / in_unit(1.0, measure.unit)


def _measure_key(measure: Measure) -> str:
    return f"{measure.name} [{measure.unit}]" if measure.unit else measure.name


def _measure_out(measure: Measure) -> Any:
    if not isinstance(measure, WeightedSum):
        return _measure_key(measure) if measure.sign > 0 else f"-{_measure_key(measure)}"
    parts = {_measure_key(p): w for p, w in zip(measure.parts, measure.weights, strict=True)}
    reference = [in_unit(r, p.unit) for p, r in zip(measure.parts, measure.reference, strict=True)]
    return {"name": measure.name, "weights": parts, "reference": reference, "sign": measure.sign}


def _measure_in(entry: Any, named: Mapping[str, Measure]) -> Measure:
    if isinstance(entry, str):
        return -named[entry.removeprefix("-")] if entry.startswith("-") else named[entry]
    parts = {named[k]: w for k, w in entry["weights"].items()}
    if not parts or len(parts) != len(entry["reference"]):
        raise ValueError("the file is damaged: its weighted sum does not have a reference for each part")
    reference = [r * _si(m) for m, r in zip(parts, entry["reference"], strict=True)]
    total = weighted(entry["name"], parts, reference)
    return -total if entry.get("sign", 1) < 0 else total
