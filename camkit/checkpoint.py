"""What a search knows after a generation, in one file, so that it can go on after its process was killed.

The file is numpy's ``npz``: plain numbers and one line of JSON, of which nothing is ever run.  With the state of the
random generator and pymoo's crowding distances in it (they cannot be computed anew: a front that was cut keeps those
from before the cut) NSGA-II goes on bit by bit as if it had never stopped.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from scipy.stats import qmc

from .study import Study

SCHEMA = "camkit-checkpoint/1"
ALGORITHM = "NSGA-II"
"""The one search whose state is kept whole."""
ARRAYS = ("x", "f", "g", "rank", "crowding")
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
    points = qmc.scale(qmc.Sobol(len(study.free), rng=0).random(PROBES), *study.bounds)
    evaluation = study.evaluate(points)
    names = [
        *study.free,
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
        """Put it in the place of the file that is there; whoever reads sees the old one or the new one, whole."""
        path = Path(path)
        about = {k: v for k, v in asdict(self).items() if k not in ARRAYS}
        part = path.with_name(f".{path.name}.{os.getpid()}.part")
        with part.open("wb") as file:
            arrays = {name: getattr(self, name) for name in ARRAYS}
            np.savez(file, about=np.array(json.dumps({"schema": SCHEMA, **about})), **arrays)
        part.replace(path)


def read(path: str | Path) -> Checkpoint:
    """The checkpoint that was written; a damaged file or another schema is refused in a sentence (``ValueError``)."""
    damaged = ValueError(f"the checkpoint {Path(path).name} is damaged; delete it to begin anew")
    try:
        with np.load(path, allow_pickle=False) as file:
            about = json.loads(str(file["about"]))
            arrays: Any = {name: np.array(file[name], dtype=float) for name in ARRAYS}
    except FileNotFoundError:
        raise ValueError(f"there is no checkpoint {Path(path).name}") from None
    except (OSError, ValueError, KeyError, EOFError, TypeError, AttributeError, zipfile.BadZipFile, zlib.error):
        raise damaged from None
    if not isinstance(about, dict) or about.pop("schema", None) != SCHEMA:
        raise ValueError(f"the file {Path(path).name} is no checkpoint of the schema {SCHEMA!r}")
    if about.keys() | arrays.keys() != {f.name for f in fields(Checkpoint)} or not _sound(about, arrays):
        raise damaged
    return Checkpoint(**about, **arrays)


def _sound(about: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> bool:
    """Whether the entries are of the kind, size and range that belong there."""
    kinds = {f.name: {"int": int, "str": str, "float": float}.get(str(f.type), dict) for f in fields(Checkpoint)}
    if not all(type(value) is kinds[name] for name, value in about.items()):
        return False
    try:
        np.random.PCG64().state = about["random"]
    except (TypeError, ValueError, KeyError, OverflowError):
        return False
    p = about["population"]
    shapes = [arrays[name].ndim == 2 and len(arrays[name]) == p for name in "xfg"]
    shapes += [arrays[name].shape == (p,) for name in ("rank", "crowding")]
    return all(shapes) and about["number"] >= 1 and bool(np.isfinite(arrays["x"]).all())


def taken_up(path: str | Path, study: Study, population: int, generations: int, seed: int) -> Checkpoint:
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
    return found
