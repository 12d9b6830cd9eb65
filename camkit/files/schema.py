"""What a saved file may say, as JSON Schema (draft 2020-12), made from the declarations, so that it follows them.

The published one is ``camkit/data/schema.json``, which has the `text` of it.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, Field, fields
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin

import numpy as np

from ..motion import MotionProgram
from ..quantities import Choice, Design, Quantity
from ..quantities.kinds import kind_words
from . import entries, sessions, studies
from .designs import SCHEMA
from .entries import MOST_ROWS, MOST_THINGS
from .json_file import LARGEST

Schema = dict[str, object]
DRAFT = "https://json-schema.org/draft/2020-12/schema"
NUMBER: Schema = {"type": "number", "minimum": -LARGEST, "maximum": LARGEST}
NAME: Schema = {"type": "string", "minLength": 1, "maxLength": 100, "pattern": "^[^<>&\"'\\\\]*$"}
SAID: Schema = {"type": "string", "maxLength": 1000, "pattern": "^[^<>&\"'\\\\]*$"}
PLAIN: dict[object, Schema] = {
    Any: NUMBER,
    float: NUMBER,
    int: {"type": "integer"},
    bool: {"type": "boolean"},
    NoneType: {"type": "null"},
    str: SAID,
}
PLACE: Schema = {"type": "string", "pattern": r"^[\w.]+:\w+$", "description": "a function, as module:name"}


def json_schema() -> Schema:
    """The schema of designs, motion programs, sessions, fronts and decisions.

    >>> schema = json_schema()
    >>> schema["$defs"]["Friction"]["properties"]["roller_pin [mm]"]["description"]
    'rho_2: friction circle of the roller pin'
    """
    known = _kinds()
    held: Schema = {
        "design": _ref("AnyDesign"),
        "program": _ref("AnyMotionProgram"),
        "session": _ref("Session"),
        "front": _ref("Front"),
        "decision": _ref("Decision"),
    }
    defs = {name: _kind(kind, known) for name, kind in sorted(known.items())}
    groups = {_group(base): _any_of(base, known) for base in _bases(known)}
    about: Schema = {"schema": {"const": SCHEMA}, "digest": {"type": "string", "description": "SHA-256 of all else"}}
    return {
        "$schema": DRAFT,
        "title": f"files of camkit, {SCHEMA}",
        "description": "Numbers stand in the unit that their name says; in motion programs in SI units.",
        **_object({**about, **held}, ("schema",)),
        "oneOf": [{"required": [name]} for name in held],
        "$defs": {**defs, **dict(sorted(groups.items())), **_records()},
    }


def _kinds() -> dict[str, type]:
    """Every class of camkit that a file may name."""
    from .. import cam, dynamics, linkage, machines, motion  # noqa: F401  whose classes they are

    return {name: kind for name, kind in entries.kinds().items() if _is_ours(kind)}


def _is_ours(kind: type) -> bool:
    """Whether it stands in a module of camkit; a class of an example that was run there does not."""
    ours = kind.__module__.partition(".")[0] == "camkit"
    return ours and getattr(sys.modules[kind.__module__], kind.__qualname__, None) is kind


def _ref(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name}"}


def _group(base: type) -> str:
    return f"Any{base.__name__}"


def _bases(known: Mapping[str, type]) -> set[type]:
    """The classes that annotations of fields name, which have kinds of their own."""
    hinted = (h for kind in known.values() for hint in entries._hints(kind).values() for h in _every(hint))
    classes = {h for h in hinted if isinstance(h, type)}
    return {Design, MotionProgram} | {h for h in classes if _has_kinds(h, known)}


def _has_kinds(base: type, known: Mapping[str, type]) -> bool:
    """Whether there are classes of a kind; everything is an object."""
    return base is not object and any(issubclass(kind, base) for kind in known.values())


def _every(hint: object) -> Iterable[object]:
    """An annotation and all that it is made of."""
    yield hint
    for part in get_args(hint):
        yield from _every(part)


def _any_of(base: type, known: Mapping[str, type]) -> Schema:
    return {"anyOf": [_ref(name) for name, kind in sorted(known.items()) if issubclass(kind, base)]}


def _object(properties: Mapping[str, object], required: Iterable[str] = ()) -> Schema:
    return {"type": "object", "properties": properties, "required": [*required], "additionalProperties": False}


def _listed(items: Schema, least: int = 0, most: int = MOST_ROWS) -> Schema:
    return {"type": "array", "items": items, "minItems": least, "maxItems": most}


def _named(values: object) -> Schema:
    return {"type": "object", "propertyNames": NAME, "additionalProperties": values}


# ---------------------------------------------------------------- kinds


def _kind(kind: type, known: Mapping[str, type]) -> Schema:
    """A class as a file has it: its fields by their names with units; those without a default must be there."""
    declared, hints = entries._declarations(kind), entries._hints(kind)
    given = [f for f in fields(kind) if f.init]
    properties = {entries.key(f.name, declared.get(f.name)): _field(f, declared, hints, known) for f in given}
    needed = [
        entries.key(f.name, declared.get(f.name))
        for f in given
        if f.default is MISSING and f.default_factory is MISSING
    ]
    return {"title": kind_words(kind), **_object({"kind": {"const": kind.__name__}, **properties}, ("kind", *needed))}


def _field(
    of: Field[Any], declared: Mapping[str, object], hints: Mapping[str, object], known: Mapping[str, type]
) -> Schema:
    said = declared.get(of.name)
    if isinstance(said, Quantity):
        return _quantity(said)
    if isinstance(said, Choice):
        return {"description": f"{said.symbol}: {said.meaning}", **_choice(said, known)}
    hint = hints.get(of.name, object)
    if get_origin(hint) is Callable:
        return PLACE
    found = _hinted(hint, known)
    most = of.metadata.get("most", MOST_ROWS)
    return {**found, "maxItems": min(most, int(str(found["maxItems"])))} if "maxItems" in found else found


def _quantity(said: Quantity) -> Schema:
    """A number in its unit, between the ends of what can be built; see `Quantity.allows`."""
    low: Schema = {"minimum": -said.most}
    if said.at_least is not None:
        low = {"minimum": max(said.at_least, -said.most)}
    elif said.above is not None:
        low = {"exclusiveMinimum": said.above}
    offered = {"default": said.default, "examples": [said.low, said.high]}
    return {"description": f"{said.symbol}: {said.meaning}", "type": "number", **low, "maximum": said.most, **offered}


def _choice(said: Choice, known: Mapping[str, type]) -> Schema:
    """An option by its name or as it is, or something else that has what all options have in common."""
    plain = [option for option in said.options if isinstance(option, (str, int, float))]
    names = [*said.named, *(option for option in plain if option not in said.named)]
    alike = [name for name, kind in sorted(known.items()) if not plain and _is_like(kind, said)]
    return {"anyOf": [{"enum": names}, *map(_ref, alike)]} if alike else {"enum": names}


def _is_like(kind: type, said: Choice) -> bool:
    has = {*dir(kind), *(f.name for f in fields(kind))}
    return kind in said._types or said._common <= has


def _hinted(hint: Any, known: Mapping[str, type]) -> Schema:
    """What fits an annotation, as `entries.fits` has it: ``Any`` stands for a number."""
    if hint in PLAIN:
        return PLAIN[hint]
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        parts = [_hinted(each, known) for each in inner if each is not np.ndarray and get_origin(each) is not Callable]
        return parts[0] if len(parts) == 1 else {"anyOf": parts}
    if origin is tuple and inner[-1:] != (...,):
        exact = {"minItems": len(inner), "maxItems": len(inner), "items": False}
        return {"type": "array", "prefixItems": [_hinted(each, known) for each in inner], **exact}
    if origin in (tuple, list):
        return _listed(_hinted(inner[0], known))
    return _ref(_group(hint)) if isinstance(hint, type) and _has_kinds(hint, known) else {}


# ---------------------------------------------------------------- records


def _records() -> Schema:
    """Sessions, fronts, decisions, and what they are made of."""
    study, front = _study(), {**_study(), **_front()}
    decision: Schema = {
        "chosen": _listed(NUMBER, 1),
        "rule": NAME,
        "judgements": {"anyOf": [{"type": "null"}, _ref("Judged")]},
        "reference": {"anyOf": [{"type": "null"}, _listed(NUMBER, 1)]},
        "yields": SAID,
        "date": {"type": "string", "format": "date"},
        "version": SAID,
        "values": _named({"type": "number"}),
        "ranges": _named(_listed(NUMBER, 2, 2)),
    }
    own: Schema = {
        "design": _ref("AnyDesign"),
        "judgements": _named(_ref("Judged")),
        "search": _object({name: _setting(name) for name in sessions.SETTINGS}),
        "decision": _ref("Decision"),
    }
    assert decision.keys() == sessions.DECIDED
    assert {*study} | {*front} == {*sessions.NEEDED, *sessions.DEFAULTS, "message"} - sessions.SESSION
    return {
        "Session": _object({**front, **own}, sessions.NEEDED),
        "Front": _object(front, sessions.NEEDED),
        "Decision": _object({**front, **decision}, (*sessions.NEEDED, *decision)),
        "WeightedSum": _sum(),
        "Judgements": _judgements(),
        "Judged": {"anyOf": [_ref("Judgements"), _judges()]},
        "Tolerances": _tolerances(),
    }


def _study() -> Schema:
    bounds = _listed(NUMBER, 2, 2)
    objective: Schema = {"anyOf": [NAME, _ref("WeightedSum")]}
    option: Schema = {"type": "array", "prefixItems": [NAME], "minItems": 2}
    menu = _object({"options": _listed(option, 1, MOST_THINGS)}, ("options",))
    return {
        "start": _ref("AnyDesign"),
        "free": {**_named({"anyOf": [bounds, menu]}), "propertyNames": {"type": "string"}, "minProperties": 1},
        "columns": _listed({"type": "string"}),
        "minimise": _listed(objective, 1),
        "at_most": _named(NUMBER),
        "at_least": _named(NUMBER),
        "sums": _listed(_ref("WeightedSum")),
        "made": _named({"type": "array", "prefixItems": [NAME], "minItems": 1}),
        "angles": {"type": "integer", "minimum": 2, "maximum": studies.MOST_ANGLES, "default": 361},
        "tolerances": {"anyOf": [_ref("Tolerances"), {"const": {}}]},
    }


def _front() -> Schema:
    counts: Schema = {name: _setting(name) for name in sessions.COUNTS}
    record: Schema = {**counts, "seconds": NUMBER, "versions": _named(SAID)}
    return {"front": _listed(_listed(NUMBER, 1)), "record": _object(record), "message": SAID}


def _setting(name: str) -> Schema:
    if name not in sessions.COUNTS:
        return NAME
    least, most = sessions.COUNTS[name]
    return {"type": "integer", "minimum": least, "maximum": most}


def _sum() -> Schema:
    pair: Schema = {"type": "array", "prefixItems": [NAME, NUMBER], "minItems": 2, "maxItems": 2}
    weights = {"anyOf": [_listed(pair, 1), _named(NUMBER)]}
    reference = {"anyOf": [_named(NUMBER), _listed(NUMBER, 1)]}
    given = {"name": NAME, "weights": weights, "reference": reference, "sign": {"enum": [1, -1]}}
    return _object(given, ("name", "weights", "reference"))


def _judgements() -> Schema:
    above = _listed({"anyOf": [NUMBER, {"type": "null"}]})
    given = {"names": _listed(NAME), "above": above, "method": NAME}
    return _object(given, given)


def _judges() -> Schema:
    given = {"judges": _named(_ref("Judgements")), "shares": _listed(NUMBER), "joined": NAME}
    return _object(given, given)


def _tolerances() -> Schema:
    factors = _named(NUMBER)
    source = _object({"name": NAME, "moves": factors, "of": factors}, ("name", "moves", "of"))
    standard = _object({"standard": NAME, "grade": {"type": ["integer", "string"]}}, ("standard",))
    deviation = {"anyOf": [NUMBER, _listed(NUMBER, 2, 2), standard]}
    one = {"of": {"anyOf": [NAME, source]}, "deviation": deviation, "spread": NAME}
    place = {"type": "integer", "minimum": 0}
    pair: Schema = {"type": "array", "prefixItems": [place, place, NUMBER], "minItems": 3, "maxItems": 3}
    given = {
        "deviations": _listed(_object(one, one), 1),
        "yield_at_least": {"type": "number", "minimum": 0, "maximum": 1},
        "worst_case": {"type": "boolean"},
        "objective": NAME,
        "correlation": _listed(pair),
    }
    return _object(given, given)


def text() -> str:
    """The schema as the published file has it."""
    return json.dumps(json_schema(), indent=1, ensure_ascii=False) + "\n"
