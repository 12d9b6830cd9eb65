"""What a search knows after a generation, in one file, so that it can go on after its process was killed.

The file is a line of JSON, in which arrays are the bytes of their numbers in base64, and a line with its digest.
With the state of the random generator and pymoo's crowding distances in it (they cannot be computed anew: a front that
was cut keeps those from before the cut) NSGA-II goes on bit by bit as if it had never stopped.
"""

from __future__ import annotations

import errno
import glob
import hashlib
import json
import os
import platform
import stat
import threading
from base64 import b64decode, b64encode
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from ..study.study import Study

SCHEMA = "camkit-checkpoint/3"
ALGORITHM = "NSGA-II"
"""The one search whose state is kept whole."""
TABLES = ("x", "f", "g")
ARRAYS = (*TABLES, "rank", "crowding")
FLOAT = np.dtype("<f8")
"""Of the numbers in a file, on every machine."""
WORST = 1e12
"""What a search is told, and a checkpoint holds, of an objective or a limit that is not a number."""
SAME = 1e-9
"""Objectives and limits that differ by less, as a share, are the same: processors differ in the last bits."""
LARGEST = 2**28
"""Bytes of a checkpoint; a longer one is neither written nor read."""
LONGEST_NAME, LARGEST_COUNT = 100, 2**128
"""Of the texts and whole numbers that describe a search."""
PROBES = 16
"""At how many Sobol points a study is recognised."""


@cache
def versions() -> Mapping[str, str]:
    """Of everything that a search's numbers depend on."""
    return {
        "python": platform.python_version(),
        **{name: version(name) for name in ("camkit", "numpy", "scipy", "pymoo")},
    }


def fingerprint(study: Study) -> str:
    """What recognises a study: its names, bounds and limits, and what it says of some points of its box.

    A study that says the same to the last bit gives the same search, however it is written down.

    >>> from camkit import door_handle_study
    >>> fingerprint(door_handle_study()) == fingerprint(door_handle_study())
    True
    """
    from scipy.stats import qmc

    points = qmc.scale(qmc.Sobol(len(study.free), rng=0).random(PROBES), *study.bounds)
    evaluation = study.evaluate(points)
    names = [
        *study.free,
        *(option for menu in study.menus for option in menu.names),
        *(m.label for m in study.minimise),
        *(f"{m.label} {float(v)!r} {s}" for m, v, s in study.limits),
    ]
    numbers = (study.bounds, evaluation.f, evaluation.g)
    return hashlib.sha256(json.dumps(names).encode() + b"".join(n.tobytes() for n in numbers)).hexdigest()


@dataclass(frozen=True)
class Checkpoint:
    """A search after ``number`` generations: how it began, its population ``x, f, g``, its random generator."""

    study: str
    """The study's `fingerprint`."""
    algorithm: str
    population: int
    seed: int
    number: int
    seconds: float
    """How long all generations took."""
    versions: Mapping[str, str]
    random: Mapping[str, Any]
    """State of the random generator."""
    x: np.ndarray
    f: np.ndarray
    g: np.ndarray
    rank: np.ndarray
    """Of each design's front, ``(p,)``; ``nan`` for what keeps not every limit."""
    crowding: np.ndarray

    def write(self, path: str | Path) -> None:
        """Write it as `write_whole` does, or raise ``OSError`` if that cannot be done or it would be too long."""
        arrays = {name: np.asarray(getattr(self, name), FLOAT).tobytes() for name in ARRAYS}
        if sum(map(len, arrays.values())) > LARGEST // 2:
            raise OSError(errno.EFBIG, os.strerror(errno.EFBIG))
        numbers = {name: b64encode(content).decode() for name, content in arrays.items()}
        text = json.dumps({"schema": SCHEMA, **vars(self), **numbers})
        write_whole(Path(path), f"{text}\n{_digest(text)}".encode())


def write_whole(path: Path, content: bytes) -> None:
    """Put it in the place of the file that is there; whoever reads sees the old one or the new one, whole.

    Raises ``OSError``, which names ``path``, if that cannot be done; the old one is then still there, and nothing else.
    """
    part = path.with_name(f".{path.name}.{threading.get_native_id()}.part")
    try:
        part.write_bytes(content)
        part.replace(path)
    except OSError as error:  # of the file that was asked for, not of the part that nobody knows
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def why(error: OSError) -> str:
    """What stood in the way of a file, to be put into a sentence.

    >>> why(OSError(28, "No space left on device", "search"))
    'no space left on device'
    >>> why(OSError("File or stream is not seekable."))
    'file or stream is not seekable'
    """
    said = (error.strerror or str(error)).rstrip(".") or "it cannot be written"
    return said[0].lower() + said[1:]


def remove_parts(path: str | Path) -> None:
    """Remove what a process that was killed in the midst of `write_whole` has left beside ``path``.

    Not what other threads of this one are about to write.
    """
    path, writing = Path(path), {f".{thread.native_id}" for thread in threading.enumerate()}
    with suppress(OSError):
        for part in path.parent.glob(f".{glob.escape(path.name)}.*.part"):
            if Path(part.stem).suffix not in writing:
                part.unlink(missing_ok=True)


class OtherSchema(Exception):
    """A file does not say that it follows `SCHEMA`."""


def read(path: str | Path) -> Checkpoint:
    """The checkpoint that was written; a damaged file or another schema is refused in a sentence (``ValueError``).

    A file that was changed by hand is damaged: its digest is another.
    """
    path = Path(path)
    damaged = ValueError(f"the checkpoint {path.name} is damaged; delete it to begin anew")
    try:
        text, _, digest = _text(path).partition("\n")
        entries = json.loads(text)
        if not isinstance(entries, dict) or entries.pop("schema", None) != SCHEMA:
            raise OtherSchema
        p = entries["population"]
        arrays: Any = {name: _array(entries.pop(name), (p, -1) if name in TABLES else (p,)) for name in ARRAYS}
        found = Checkpoint(**entries, **arrays)
    except FileNotFoundError:
        raise ValueError(f"there is no checkpoint {path.name}") from None
    except OtherSchema:
        raise ValueError(f"the file {path.name} is no checkpoint of the schema {SCHEMA!r}") from None
    except Exception:  # whatever else a file that somebody made can lead to
        raise damaged from None
    if digest != _digest(text) or not _sound(found):
        raise damaged
    return found


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _text(path: Path) -> str:
    """The text of a regular file that is not too long."""
    about = path.stat()
    if not stat.S_ISREG(about.st_mode) or about.st_size > LARGEST:
        raise ValueError
    return path.read_bytes().decode()


def _array(text: str, shape: tuple[int, ...]) -> np.ndarray:
    return np.frombuffer(b64decode(text, validate=True), FLOAT).astype(float).reshape(shape)


def _sound(found: Checkpoint) -> bool:
    """Whether the entries are of the kind, size and range that belong there."""
    state: Any = found.random
    kinds = {f.name: {"int": int, "str": str, "float": float}.get(str(f.type), dict) for f in fields(found)}
    if not all(type(getattr(found, name)) is kind for name, kind in kinds.items() if name not in ARRAYS):
        return False
    names = [found.study, found.algorithm, *found.versions.values()]
    counts = [found.population, found.seed, found.number - 1]
    if not all(type(name) is str and len(name) <= LONGEST_NAME for name in names):
        return False
    if not all(0 <= count < LARGEST_COUNT for count in counts) or not 0 <= found.seconds < np.inf:
        return False
    try:
        generator = np.random.PCG64()
        generator.state = state
    except (TypeError, ValueError, KeyError, OverflowError):
        return False
    return generator.state == state


def _belongs(found: Checkpoint, study: Study) -> bool:
    """Whether every design lies between the study's bounds and is as good as the study says."""
    sizes = (len(study.free), len(study.minimise), len(study.limits))
    if (found.x.shape[1], found.f.shape[1], found.g.shape[1]) != sizes:
        return False
    low, high = study.bounds
    if not ((low <= found.x) & (found.x <= high)).all():
        return False
    now = study.evaluate(found.x)
    pairs = ((found.f, now.f), (found.g, now.g))
    return all(np.allclose(kept, np.minimum(said, WORST), rtol=SAME, atol=SAME**2) for kept, said in pairs)


def resume(path: str | Path, study: Study, population: int, generations: int, seed: int) -> Checkpoint:
    """The checkpoint from which this search can go on faithfully.

    Raises ``ValueError`` in a sentence if the file is damaged or of another search, study or version.
    """
    found, name = read(path), Path(path).name
    if found.algorithm != ALGORITHM:
        raise ValueError(
            f"the checkpoint {name} is of the algorithm {found.algorithm!r}, which cannot go on faithfully; "
            f"{ALGORITHM} alone can"
        )
    for what, theirs, wanted in (("population", found.population, population), ("seed", found.seed, seed)):
        if theirs != wanted:
            raise ValueError(f"the checkpoint {name} has the {what} {theirs}; here it is {wanted}")
    if found.number > generations:
        raise ValueError(f"the checkpoint {name} has {found.number} generations; here are {generations} to be run")
    for what, here in versions().items():
        if found.versions.get(what) != here:
            raise ValueError(
                f"the checkpoint {name} was written with {what} {found.versions.get(what)}; with {what} {here} "
                "the search would not go on as it began"
            )
    if found.study != fingerprint(study):
        raise ValueError(f"the checkpoint {name} is of another study; name another file, or delete it to begin anew")
    if not _belongs(found, study):
        raise ValueError(f"the checkpoint {name} is damaged; delete it to begin anew")
    return found
