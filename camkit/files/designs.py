"""Files: a design, a motion program, a front or a whole session as JSON with units in the names.

Every file says which schema it follows and carries a digest of its content.  A file that is damaged, of another kind
or of another schema is refused by a ``ValueError`` in a sentence, and nothing of it is used; one that was edited, or
lacks what a later camkit has added, is read with a remark (`read_json`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..motion import MotionProgram
from ..quantities import Design, Measure
from ..quantities.applied import a_path
from ..quantities.kinds import kind_words, refuse_arguments, shown
from ..search.checkpoint import remove_parts, write_whole
from ..search.front import Front
from ..study.study import Study
from .checks import mapping
from .decisions import Decision
from .entries import Reading, entry_of
from .json_file import MOST_BYTES, content_of, digest_remarks, signed, text_of
from .sessions import Session, decision_entry, decision_of, entries, front_entry, session_entry, session_of

SCHEMA = "camkit/1"
HELD: dict[str, type] = {"design": Design, "program": MotionProgram}
"""What stands alone in a file, by the entry that holds it."""


@dataclass(frozen=True)
class Read:
    """What a file holds, and what is to be remarked about it, in sentences."""

    thing: Any
    remarks: tuple[str, ...] = ()


def write(thing: object, path: str | Path) -> None:
    """Write a design, a motion program, a front or a `Session` to a JSON file.

    One that is there stays until the new one is whole.
    """
    text, path = to_json(thing), a_path(path)
    remove_parts(path)
    write_whole(path, text.encode())


def read(
    path: str | Path,
    kind: type | None = None,
    measures: Sequence[Measure] = (),
    tell: Callable[[str], object] = print,
) -> Any:
    """Read a design, a motion program, a front or a `Session` from a JSON file; ``tell`` is called with each remark.

    ``kind`` and ``measures`` are those of `read_json`.
    """
    path = a_path(path)
    if not callable(tell):
        raise ValueError(f"the argument tell is {shown(tell)}; it must be a function")
    with path.open("rb") as file:
        found = read_json(file.read(MOST_BYTES + 1), kind, measures)
    for remark in found.remarks:
        tell(f"{path.name}: {remark}")
    return found.thing


def to_json(thing: Any) -> str:
    """A design, a motion program, a study, a front or a `Session` as JSON text; a study as the session at its start.

    >>> from camkit import DoorHandleCam
    >>> from_json(to_json(DoorHandleCam(lift_arm=0.048))).lift_arm
    0.048

    Raises ``ValueError`` in a sentence for what could not be read again: a population, a motion law that is a
    function of one's own, a name with other signs than letters, digits, spaces and ``+,.:;()/%^-``.
    """
    thing = Session(thing, thing.start) if isinstance(thing, Study) else thing
    text = signed({"schema": SCHEMA, **_content(thing)})
    try:
        read_json(text, *_kind_and_measures(thing))
    except ValueError as refusal:
        raise ValueError(f"this cannot be saved, as it could not be read again: {refusal}") from None
    return text


def _kind_and_measures(thing: Any) -> tuple[type, tuple[Measure, ...]]:
    """What a thing is to be read as, and with which measures."""
    for kind in (Design, MotionProgram):
        if isinstance(thing, kind):
            return kind, ()
    study = thing.front.study if isinstance(thing, Decision) else thing.study
    return Decision if isinstance(thing, Decision) else Session, study.measures


def _content(thing: object) -> dict[str, object]:
    if isinstance(thing, Design):
        return {"design": entry_of(thing)}
    if isinstance(thing, MotionProgram):
        return {"program": _program_entry(thing)}
    if isinstance(thing, Session):
        return {"session": session_entry(thing)}
    if isinstance(thing, Front):
        return {"front": front_entry(thing, thing.study)}
    if isinstance(thing, Decision):
        return {"decision": decision_entry(thing)}
    raise ValueError(
        f"this is {shown(thing)}; a design, a motion program, a study, a front, a Session or a Decision can be saved"
    )


def _program_entry(program: MotionProgram) -> object:
    if np.ndim(program.possible):
        raise ValueError("this is a population; one motion program can be saved")
    return entry_of(program, "motion program")


def from_json(file: str | bytes, kind: type | None = None, measures: Sequence[Measure] = ()) -> Any:
    """The design, motion program, front or `Session` that `to_json` wrote; `read_json` says its remarks as well."""
    return read_json(file, kind, measures).thing


def read_json(file: str | bytes, kind: type | None = None, measures: Sequence[Measure] = ()) -> Read:
    """What a file holds, and remarks: it was edited or damaged, or lacks a field, which then took its default.

    ``kind`` refuses anything else; where a `Session` is wanted, a front is one.  ``measures`` are those of one's own
    that a study has beside the measures of its mechanism.

    >>> from camkit import DoorHandleCam
    >>> text = to_json(DoorHandleCam())
    >>> read_json(text).remarks, read_json(text.replace("75.0", "76.0")).remarks
    ((), ('its content does not match its digest: it was edited or damaged after it was saved; check its numbers',))

    Raises ``ValueError`` in a sentence for text that is no JSON, another encoding, another schema, an unknown name,
    an entry that is not of the kind that belongs there, an absurd count, or a number that cannot be built.
    """
    text = text_of(file)
    refuse_arguments(read_json, locals() | {"file": text})
    content = content_of(text)
    digest = content.pop("digest", None)
    if content["schema"] != SCHEMA:
        raise ValueError(f"the file follows the schema {shown(content['schema'])}; this camkit reads {SCHEMA!r}")
    if "work" in content:  # a session of 0.1.0
        content = {"session" if name == "work" else name: value for name, value in content.items()}
    held = [name for name in ("design", "program", "session", "front", "decision") if name in content]
    if len(held) != 1 or len(content) != 2:
        raise ValueError(
            "the file is damaged: beside its schema it must hold one design, program, study, front or decision"
        )
    reading = Reading()
    try:
        thing = _thing(held[0], content[held[0]], reading, kind, measures)
    except (TypeError, AttributeError, LookupError, ArithmeticError):
        raise ValueError("the file is damaged: an entry is not of the kind that belongs there") from None
    _refuse_other(thing, held[0], kind)
    remarks = (*digest_remarks(text, digest), *reading.renaming.remarks, *_lacking(reading.missing), *reading.remarks)
    return Read(thing, remarks)


def _thing(held: str, entry: object, reading: Reading, kind: type | None, measures: Sequence[Measure]) -> object:
    if held in HELD:
        return reading.thing(mapping(entry, held), kind or object)
    if held == "decision":
        return decision_of(entry, reading, measures)
    session = session_of(entries(entry, held, reading), reading, measures)
    return session if held == "session" or kind is Session else session.front


def _refuse_other(thing: object, held: str, kind: type | None) -> None:
    wanted = kind or HELD.get(held, object)
    if not isinstance(thing, wanted):
        raise ValueError(f"the file holds {_said(type(thing))}; {_said(wanted)} is wanted here")


def _said(kind: type) -> str:
    """A kind of file as the buttons of the panels say it."""
    return "a study" if kind is Session else kind_words(kind, article=True)


def _lacking(missing: Sequence[str]) -> list[str]:
    if not missing:
        return []
    more = f" and {len(missing) - 4} more" if len(missing) > 4 else ""
    return [f"it lacks {', '.join(missing[:4])}{more}, as files of another camkit may: the default was taken"]
