"""Who learns here, and what is done: kept in one small file of this machine, and nowhere else."""

from __future__ import annotations

import json
import os
import secrets
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypedDict

from ..quantities.extras import extra
from ..quantities.kinds import refuse_arguments, shown
from ..quantities.markup import html, plain, table
from ..search.checkpoint import why, write_whole

LONGEST, LARGEST, WAIT = 80, 2**22, 5.0
"""Letters of a name; bytes of the file; seconds until a lock that is not opened is given up."""


class Record(TypedDict):
    """What is known of one exercise."""

    attempts: int
    hints: int
    right: bool


Lessons = dict[str, dict[str, Record]]
"""Of one learner, by the names of lesson and exercise."""


class Everybody(TypedDict):
    """What the file holds: who learned last, and the lessons of each."""

    now: str
    learners: dict[str, Lessons]


def unread() -> Record:
    """Of an exercise that nobody has tried."""
    return {"attempts": 0, "hints": 0, "right": False}


def file() -> Path | None:
    """Where progress is kept: ``CAMKIT_COURSE``, or in the user's data folder.

    Nowhere while ``CAMKIT_LEARNER`` names who learns, as tests do, and in a published page, whose visitors are many.
    """
    if "CAMKIT_LEARNER" in os.environ or "VOILA_BASE_URL" in os.environ:
        return None
    if given := os.environ.get("CAMKIT_COURSE"):
        return Path(given)
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", home / "AppData" / "Local")) / "camkit" / "course.json"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "camkit" / "course.json"
    return Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share") / "camkit" / "course.json"


@dataclass
class Learner:
    """A learner by name, with all that is done; ``message`` says what stood in the way of the file, if anything."""

    name: str = ""
    lessons: Lessons = field(default_factory=dict)
    message: str = ""

    def open(self, name: str = "") -> None:
        """Go on as ``name``; without one as who learned here last, or else under a name that is drawn."""

        def act(everybody: Everybody) -> None:
            self.name = everybody["now"] = name or everybody["now"] or secrets.token_hex(4)
            self.lessons = everybody["learners"].setdefault(self.name, {})

        if not self._update(act):
            self.name = name or self.name or os.environ.get("CAMKIT_LEARNER") or secrets.token_hex(4)
            self.lessons = {}

    def change(self, act: Callable[[Lessons], None]) -> None:
        """Change what is done, in the file too: what other kernels wrote there meanwhile stays."""

        def inside(everybody: Everybody) -> None:
            self.lessons = everybody["learners"].setdefault(self.name, self.lessons)
            act(self.lessons)

        if not self._update(inside):
            act(self.lessons)

    def _update(self, act: Callable[[Everybody], None]) -> bool:
        """Read the file, act on what it holds and write it again; false where nothing can be kept."""
        path, self.message = file(), ""
        if path is None:
            return False
        try:
            with _locked(path):
                everybody, self.message = _read(path)
                before = json.dumps(everybody)
                act(everybody)
                if json.dumps(everybody) != before:
                    write_whole(path, json.dumps(everybody, indent=1).encode())
        except (OSError, ModuleNotFoundError) as error:
            reason = why(error) if isinstance(error, OSError) else str(error)
            self.message = f"Progress is not kept: {reason}."
            return False
        return True


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Alone with a file, whatever other kernels do."""
    with extra("a record of progress"):
        from filelock import FileLock
    path.parent.mkdir(parents=True, exist_ok=True)
    with FileLock(path.with_name(f"{path.name}.lock"), timeout=WAIT):
        yield


def _read(path: Path) -> tuple[Everybody, str]:
    """What the file holds; one that is damaged is set aside, and a sentence says so."""
    nobody: Everybody = {"now": "", "learners": {}}
    if not path.exists():
        return nobody, ""
    if path.stat().st_size <= LARGEST:
        try:
            found = json.loads(path.read_bytes())
        except (ValueError, RecursionError):
            found = None
        if _sound(found):
            return found, ""
    aside = path.with_name(f"{path.stem}.damaged-{secrets.token_hex(2)}.json")
    path.replace(aside)
    return nobody, f"The record of progress was damaged: it is set aside as {aside.name}, and a new one begins."


def _sound(found: object) -> bool:
    """Whether what was read is what this module writes."""
    if not isinstance(found, dict) or not isinstance(found.get("now"), str):
        return False
    learners = found.get("learners")
    if not isinstance(learners, dict) or not all(isinstance(lessons, dict) for lessons in learners.values()):
        return False
    exercises = [each for lessons in learners.values() for each in lessons.values()]
    if not all(isinstance(each, dict) for each in exercises):
        return False
    return all(_is_record(record) for each in exercises for record in each.values())


def _is_record(record: object) -> bool:
    kinds = {name: type(value) for name, value in unread().items()}
    if not isinstance(record, dict) or {name: type(value) for name, value in record.items()} != kinds:
        return False
    return all(value >= 0 for value in record.values())


NOW = Learner()
"""Who learns in this kernel."""


def learning() -> Learner:
    """Who learns in this kernel, opened when it is first asked for."""
    if not NOW.name:
        NOW.open()
    return NOW


@dataclass(frozen=True)
class Progress:
    """What a learner has done, by lesson and exercise."""

    learner: str
    lessons: Lessons
    message: str = ""

    @property
    def rows(self) -> list[tuple[str, str, str]]:
        """Lesson, exercise, and what became of it."""
        return [(lesson, name, _told(r)) for lesson, done in self.lessons.items() for name, r in done.items()]

    @property
    def title(self) -> str:
        """How many of the exercises are done, of all that were opened."""
        done = [record["right"] for each in self.lessons.values() for record in each.values()]
        count = f"{sum(done)} of {len(done)} exercises done" if done else "no exercise was tried yet"
        return f"{self.learner}: {count}. {self.message}".rstrip()

    def __repr__(self) -> str:
        return "\n".join([self.title, *(f"  {lesson}, {name}: {told}" for lesson, name, told in self.rows)])

    def _repr_html_(self) -> str:
        rows = table(("lesson", "exercise", ""), self.rows, self.title, "text-align:left")
        return rows if self.rows else html("<p>{}</p>", self.title)


def _told(record: Record) -> str:
    attempts = record["attempts"]
    tried = f"{attempts} attempt{'s' * (attempts != 1)}"
    return f"✓ right, {tried}" if record["right"] else tried if attempts else "open"


def learner(name: str | int = "") -> Progress:
    """Learn as ``name``, or number: the exercises' numbers are drawn from it, and progress is kept under it.

    Without a name: as who learned here last; the first time a name is drawn.  Nothing leaves this machine.
    """
    refuse_arguments(learner, locals())
    said = plain(name) if isinstance(name, str) else str(name)
    if len(said) > LONGEST:
        raise ValueError(f"the name of the learner is {shown(name)}; it must have at most {LONGEST} letters")
    NOW.open(said)
    return _shown(NOW)


def progress() -> Progress:
    """Lessons and exercises, and which of them are done."""
    now = learning()
    now.change(lambda _: None)
    return _shown(now)


def _shown(now: Learner) -> Progress:
    return Progress(now.name, {name: dict(each) for name, each in now.lessons.items()}, now.message)
