"""The session of a saved file: a study and all that a person did on it, or its front alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..decision import Judgements, Judges
from ..quantities import Analysable, Measure
from ..quantities.kinds import refuse_kinds, shown, whole
from ..search.front import Front, front_of
from ..search.robust_front import surviving
from ..study.study import Study
from ..units import factor
from .checks import all_numbers, listed, mapping, message, plain
from .decisions import Decision
from .entries import MOST_ROWS, Reading, entry_of, exact_in_unit, is_number
from .renamed import Renaming
from .studies import _key, rows, study_entry, study_of, x_of

SETTINGS: dict[str, type] = {"population": int, "generations": int, "seed": int, "mode": str, "rule": str}
"""What a search is set to: counts, and the entries of its menus."""
COUNTS = {"population": (1, 100_000), "generations": (1, 1_000_000), "designs": (0, 10**12), "seed": (0, 10**12)}
"""What a file may say of a search."""

NEEDED = ("start", "free", "minimise")
DEFAULTS: dict[str, object] = {
    "columns": [],
    "at_most": {},
    "at_least": {},
    "sums": [],
    "made": {},
    "angles": Study.angles,
    "front": [],
    "record": {},
    "judgements": {},
    "search": {},
    "tolerances": {},
}
"""What a study is read with where its file says nothing."""
QUIETLY = {"columns", "sums", "made", "record", "tolerances"}
"""Which of them are no matter for a remark: an earlier camkit wrote none, or there is nothing to say."""
SESSION = {"design", "judgements", "methods", "search", "decision"}
"""What a front alone does not have."""


@dataclass(frozen=True)
class Session:
    """All that a person did on one study: the study, the design in hand, judgements, search settings, front.

    It is what a page shows, what is downloaded from it, and what a file brings back.  ``judgements`` are by what they
    judge, such as ``"importance"`` of the objectives; ``search`` is set to a population, generations, a seed, a mode
    and a rule (entries of menus).  Without a ``front`` there is none yet, nor without a ``decision``, which has a front
    of its own: that on which it was made.
    """

    study: Study
    design: Analysable
    judgements: Mapping[str, Judgements | Judges] = field(default_factory=dict)
    search: Mapping[str, Any] = field(default_factory=dict)
    front: Front = None  # type: ignore[assignment]
    decision: Decision | None = None

    def __post_init__(self) -> None:
        refuse_kinds(self, ("front",) if self.front is None else ())
        self.study.x_of(self.design)  # refuses what is no design of the study
        if self.front is None:
            object.__setattr__(self, "front", empty_front(self.study))


def empty_front(study: Study, message: str = "", record: Mapping[str, object] | None = None) -> Front:
    """The front of a study for which nobody has searched."""
    none = np.zeros((0, len(study.minimise)))
    return Front(study, np.zeros((0, len(study.free))), none, message, record or {})


def session_entry(session: Session) -> dict[str, object]:
    """A session as JSON knows it."""
    return {
        **front_entry(session.front, session.study),
        "design": entry_of(session.design),
        "judgements": {name: judged_entry(judged) for name, judged in session.judgements.items()},
        "search": {name: entry_of(value) for name, value in session.search.items()},
        **({"decision": decision_entry(session.decision)} if session.decision else {}),
    }


def judged_entry(judged: Judgements | Judges) -> dict[str, object]:
    """Judgements of one or several judges as JSON knows them."""
    if isinstance(judged, Judgements):
        return {"names": [*judged.names], "above": [*judged.above], "method": judged.method}
    said = {name: judged_entry(each) for name, each in judged.said.items()}
    return {"judges": said, "shares": [*judged.shares], "joined": judged.method}


def front_entry(front: Front, study: Study) -> dict[str, object]:
    """A front of a study as JSON knows it."""
    return {
        **study_entry(study),
        "front": rows(study, front.x),
        "record": {k: dict(v) if isinstance(v, Mapping) else entry_of(v) for k, v in front.record.items()},
        "message": front.message,
    }


def entries(entry: object, held: str, reading: Reading) -> dict[str, object]:
    """All entries of a study, those that are lacking with their defaults."""
    given, known = mapping(entry, held), {*NEEDED, *DEFAULTS, *SESSION, "message"}
    known -= SESSION if held == "front" else set()
    for wrong in given.keys() - known:
        raise ValueError(f"the file has {shown(wrong)}, which a saved study does not have")
    for lacking in [name for name in NEEDED if name not in given]:
        raise ValueError(f"the file is damaged: it lacks {lacking!r} of the study")
    reading.missing.extend(f"{name!r} of the study" for name in DEFAULTS if name in known - given.keys() - QUIETLY)
    if held == "session" and "design" not in given:
        reading.missing.append("'design' of the study")
    return DEFAULTS | given


def session_of(entry: Mapping[str, object], reading: Reading, measures: Sequence[Measure]) -> Session:
    """The session that `session_entry` wrote, or a front alone; the objectives of its front are computed anew."""
    study = study_of(entry, reading, measures)
    reading.held.clear()  # another design
    design = reading.thing(entry["design"], type(study.start)) if "design" in entry else study.start
    if not isinstance(design, type(study.start)):
        raise ValueError("the file is damaged: its design is of another kind than its start")
    methods = mapping(entry.get("methods", {}), "methods")  # in files of 0.1.0, beside lists without names
    judgements = {
        plain(n): _judged(n, m, methods.get(n)) for n, m in mapping(entry["judgements"], "judgements").items()
    }
    search = {
        name: _setting(name, value, reading.renaming) for name, value in mapping(entry["search"], "search").items()
    }
    front = _front(study, entry, reading)
    decided = decision_of(entry["decision"], reading, measures) if "decision" in entry else None
    return Session(study, design, judgements, search, front, decided)


def _front(study: Study, entry: Mapping[str, object], reading: Reading) -> Front:
    x, record, said = x_of(entry, study, reading), _record(entry["record"]), message(entry.get("message", ""))
    if not len(x):
        return empty_front(study, said, record)
    found = study.evaluate(x)
    if study.nominal is not study:  # whether they survive being made is said by exact parts
        found = replace(found, g=study.nominal.evaluate(x).g)
    front = surviving(front_of(found, study))
    reading.remarks.extend(left_out(len(x), len(front)))
    return replace(front, record=record)


def left_out(told: int, kept: int) -> list[str]:
    """What is to be remarked where a file has ``told`` designs of a front, of which ``kept`` are one.

    >>> left_out(20, 20), left_out(20, 19)
    ([], ['1 of its 20 designs miss a limit or are dominated and were left out'])
    """
    if kept == told:
        return []
    return [f"{told - kept} of its {told} designs miss a limit or are dominated and were left out"]


def _setting(name: str, value: object, renaming: Renaming) -> object:
    if name in COUNTS and name in SETTINGS:
        return whole(value, f"the file's {name!r}", *COUNTS[name])
    if name not in SETTINGS or not isinstance(value, SETTINGS[name]):
        raise ValueError(f"the file says {shown(value)} for {shown(name)}, which is no setting of a search")
    return renaming.name(name, plain(value))


def _judged(name: str, entry: object, method: object = None) -> Judgements | Judges:
    """What was judged by one judge or by several."""
    if not isinstance(entry, dict) or entry.keys() != {"judges", "shares", "joined"}:
        return _said(name, entry, method)
    said = {who: _said(who, each) for who, each in mapping(entry["judges"], name).items()}
    shares = all_numbers(entry["shares"], "shares", len(said))
    try:
        return Judges(said, tuple(shares), entry["joined"])
    except ValueError as refusal:
        raise ValueError(f"the file has judgements of {shown(name)} that cannot be: {refusal}") from None


def _said(name: str, entry: object, method: object = None) -> Judgements:
    """Judgements; in a file of 0.1.0 a matrix or what is above its diagonal, and its ``method`` if that is known."""
    if isinstance(entry, list):
        entry = {"names": [], "above": entry, "method": "eigenvector" if method is None else method}
    if not isinstance(entry, dict) or entry.keys() != {"names", "above", "method"}:
        raise ValueError(f"the file says {shown(entry)} for the judgements of {shown(name)}, where judgements belong")
    rows = listed(entry["above"], name)
    flat = [value for row in rows for value in (listed(row, name) if isinstance(row, list) else [row])]
    if len(flat) > MOST_ROWS or not all(value is None or is_number(value) for value in flat):
        raise ValueError(f"the file says {shown(rows)} for the judgements of {shown(name)}, where numbers belong")
    try:
        return Judgements(listed(entry["names"], name), rows or [[1]], entry["method"])
    except ValueError as refusal:
        raise ValueError(f"the file has judgements of {shown(name)} that cannot be: {refusal}") from None


DECIDED = {"chosen", "rule", "judgements", "reference", "yields", "date", "version", "values", "ranges"}


def decision_entry(decision: Decision) -> dict[str, object]:
    """A decision as JSON knows it: its front, what was chosen and how; numbers as they were, in their units."""
    study, objectives = decision.front.study, decision.front.study.minimise
    judged, wish = decision.judgements, decision.reference
    ranges = zip(objectives, decision.ranges.T, strict=True)
    return {
        **front_entry(decision.front, study),
        "chosen": rows(study, decision.front.x[[decision.chosen]])[0],
        "rule": decision.rule,
        "judgements": None if judged is None else judged_entry(judged),
        "reference": None if wish is None else _in_units(objectives, wish),
        "yields": decision.yields,
        "date": decision.date,
        "version": decision.version,
        "values": {_key(m): exact_in_unit(value, m.unit) for m, value in decision.values.items()},
        "ranges": {_key(m): _in_units((m, m), ends) for m, ends in ranges},
    }


def _in_units(objectives: Sequence[Measure], f: Sequence[float]) -> list[float]:
    """Objectives, which are all to be small, as they are read, in their units."""
    return [exact_in_unit(m.sign * value, m.unit) for m, value in zip(objectives, f, strict=True)]


def decision_of(entry: object, reading: Reading, measures: Sequence[Measure]) -> Decision:
    """The decision that `decision_entry` wrote; numbers that follow otherwise today are remarked."""
    given = mapping(entry, "decision")
    if lacking := sorted(DECIDED - given.keys()):
        raise ValueError(f"the file is damaged: it lacks {lacking[0]!r} of the decision")
    told = entries({k: v for k, v in given.items() if k not in DECIDED}, "front", reading)
    study = study_of(told, reading, measures)
    front, objectives = _front(study, told, reading), study.minimise
    chosen = x_of({**told, "front": [given["chosen"]]}, study, reading)
    places = np.flatnonzero(np.isclose(front.x, chosen, rtol=1e-9, atol=0).all(-1))
    if not len(places):
        raise ValueError("the file is damaged: its chosen design is none of its front")
    wish = given["reference"]
    if wish is not None:
        numbers = all_numbers(wish, "reference", len(objectives))
        wish = tuple(m.sign * v * factor(m.unit) for m, v in zip(objectives, numbers, strict=True))
    judged = None if given["judgements"] is None else _judged("objectives", given["judgements"])
    said = [plain(given[name]) if given[name] != "" else "" for name in ("rule", "yields", "date", "version")]
    rule, yields, date, version = said
    decision = Decision(front, int(places[0]), rule, judged, wish, yields, date, version)
    reading.remarks.extend(_otherwise(decision, mapping(given["values"], "values")))
    return decision


def _otherwise(decision: Decision, recorded: Mapping[str, object]) -> list[str]:
    """What is computed today otherwise than it was when it was decided."""
    told = []
    for measure, value in decision.values.items():
        before = recorded.get(_key(measure))
        now, then = measure.text(value), measure.text(before * factor(measure.unit)) if is_number(before) else "unknown"
        if now != then:
            told.append(f"the {measure.name} of its chosen design is {now}; it was {then} when it was decided")
    return told


def _record(entry: object) -> dict[str, object]:
    """The record of a search by NSGA-II, or of a quick front, which has no seed."""
    if entry == {}:
        return {}
    common = {"seconds", "versions"}
    known = ({"population", "generations", "seed"} | common, {"designs"} | common)
    if not isinstance(entry, dict) or entry.keys() not in known or not is_number(entry["seconds"]):
        raise ValueError("the file is damaged: its record of the search is not as camkit writes it")
    for name in entry.keys() - common:
        whole(entry[name], f"the file's {name!r}", *COUNTS[name])
    for name, version in mapping(entry["versions"], "versions").items():
        plain(name), plain(version)
    return dict(entry)
