"""The parts of a search that have ended, in a file, so that it goes on after it was stopped or its process was killed.

A search is the same at every run: what it asks follows from what it was told.  So it begins again and is told at once
what the file has of its parts (a descent, a generation); where the file ends it goes on as if it had never stopped.

Each line of the file is JSON, in which arrays are the bytes of their numbers in base64, and a digest of it and of all
lines before.  A last line that was being written when the process was killed does not count.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
import time
from base64 import b64decode, b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..study.study import Study
from .checkpoint import FLOAT, LARGEST, fingerprint, versions, why

SCHEMA = "camkit-parts/1"
Arrays = Sequence[np.ndarray]


class Parts:
    """The ended parts of a search; without a file they are counted alone.

    Raises ``ValueError`` in a sentence for a file that is damaged, or of another search, study or version.
    """

    def __init__(self, path: str | Path | None = None, about: Mapping[str, object] | None = None) -> None:
        self.number, self.skipped, self.unkept = 0, 0, ""
        self.path, self._begun = None if path is None else Path(path), time.monotonic()
        self._lines: list[dict[str, Any]] = []
        self._digest = ""
        if self.path is None:
            return
        told = json.loads(json.dumps(about))
        if self.path.exists():
            self._read(told)
        if not self._digest:
            self._write({"schema": SCHEMA, **told}, "w")
        self._begun -= self._lines[-1]["seconds"] if self._lines else 0.0

    @property
    def seconds(self) -> float:
        """How long the search took, without its breaks."""
        return time.monotonic() - self._begun

    def part(self, asked: np.ndarray, work: Callable[[], Arrays], designs: Callable[[Arrays], int]) -> Arrays:
        """What ``work()`` gives, or what the file has of it, which is of so many ``designs``."""
        found = self._next(asked)
        if found is None:
            found = list(work())
            if self.path and not self.unkept:
                arrays = [_entry(array) for array in (asked, *found)]
                self._write({"seconds": self.seconds, "arrays": arrays}, "a")
        else:
            self.skipped += designs(found)
        self.number += 1
        return found

    def keep(self, asked: Sequence[int], arrays: Arrays, told: Mapping[str, object] | None = None) -> None:
        """Keep a part that ended out of turn: what was ``asked``, arrays, and what is ``told`` of them, as JSON."""
        if self.path and not self.unkept:
            entry = {"seconds": self.seconds, "arrays": [_entry(array) for array in (asked, *arrays)]}
            self._write({**entry, "told": dict(told or {})}, "a")

    def kept(self) -> Iterator[tuple[tuple[int, ...], Arrays, dict[str, Any]]]:
        """What the file has of parts that ended in any order: what was asked, arrays, and what is told of them."""
        for line in self._lines:
            try:
                asked, *arrays = map(_array, line["arrays"])
                yield tuple(map(int, asked)), arrays, dict(line["told"])
            except Exception:  # whatever a file that somebody made can lead to
                raise self.damaged from None

    @property
    def damaged(self) -> ValueError:
        """What is raised for a file that is."""
        return ValueError(f"the checkpoint {self._name} is damaged; delete it to begin anew")

    def _next(self, asked: np.ndarray) -> Arrays | None:
        """What the file has of the next part."""
        if self.number >= len(self._lines):
            return None
        first, *found = map(_array, self._lines[self.number]["arrays"])
        if not np.array_equal(first, asked, equal_nan=True):
            raise ValueError(f"the checkpoint {self._name} is of another search; delete it to begin anew")
        return found

    # ------------------------------------------------------------ the file

    @property
    def _name(self) -> str:
        return self.path.name if self.path else ""

    def _write(self, entry: Mapping[str, object], mode: str) -> None:
        """Put a line into the file; from the first that cannot be written on the search is not kept."""
        text = json.dumps(entry)
        digest = _chained(self._digest, text)
        try:
            with open(str(self.path), f"{mode}b", opener=_open_no_link) as file:
                if file.tell() + len(text) > LARGEST:
                    raise OSError("the file would be too long")
                file.write(f"{text}\t{digest}\n".encode())
        except OSError as error:
            self.unkept = why(error)
        else:
            self._digest = digest

    def _read(self, told: Mapping[str, object]) -> None:
        damaged = self.damaged
        try:
            with open(str(self.path), "rb", opener=_open_no_link) as file:
                about = os.fstat(file.fileno())
                if not stat.S_ISREG(about.st_mode) or about.st_size > LARGEST:
                    raise damaged
                *lines, torn = file.read().split(b"\n")
            entries = [self._checked(line) for line in lines]
            head, self._lines = (entries or [None])[0], entries[1:]
            sound = all(_sound(line) for line in self._lines)
        except Exception:  # whatever a file that somebody made can lead to
            raise damaged from None
        if head is not None and (head.pop("schema", None) != SCHEMA or not sound):
            raise damaged
        for what in told if head is not None else ():
            if head.get(what) != told[what]:
                raise ValueError(_other(self._name, what, head.get(what), told[what]))
        if torn and self.path:
            os.truncate(self.path, sum(len(line) + 1 for line in lines))

    def _checked(self, line: bytes) -> Any:
        text, _, digest = line.decode().rpartition("\t")
        self._digest = _chained(self._digest, text)
        if digest != self._digest:
            raise ValueError
        return json.loads(text)


def parts_of(path: str | Path, study: Study, method: str, options: Mapping[str, object]) -> Parts:
    """The parts of a search, to be kept in the file ``path``, or as they are there already."""
    settings = {name: repr(value) for name, value in sorted(options.items())}
    return Parts(path, {"method": method, "study": fingerprint(study), "options": settings, "versions": versions()})


def _other(name: str, what: str, theirs: object, here: object) -> str:
    """Why a checkpoint is not of this search."""
    if what == "study":
        return f"the checkpoint {name} is of another study; name another file, or delete it to begin anew"
    told = f"the {what} {theirs}" if isinstance(theirs, str) else f"other {what}"
    now = f"; here it is {here}" if isinstance(here, str) else ""
    return f"the checkpoint {name} has {told}{now}: the search would not go on as it began"


def _chained(before: str, text: str) -> str:
    return hashlib.sha256(f"{before}{text}".encode()).hexdigest()


def _sound(line: Any) -> bool:
    """Whether a line is a part of a search: how long it took so far, and arrays."""
    seconds = line["seconds"]
    arrays = [_array(entry) for entry in line["arrays"]]
    return type(seconds) is float and 0 <= seconds < np.inf and bool(arrays)


def _entry(array: Any) -> list[object]:
    array = np.asarray(array, FLOAT)
    return [list(array.shape), b64encode(array.tobytes()).decode()]


def _array(entry: Any) -> np.ndarray:
    shape, text = entry
    return np.frombuffer(b64decode(text, validate=True), FLOAT).astype(float).reshape(shape)


def _open_no_link(path: str, flags: int) -> int:
    """As ``open`` does it, but not through a link and without waiting for somebody at the other end of a pipe."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0), 0o666)
