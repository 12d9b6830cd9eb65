"""Native code that was made before, in the user's cache: one file for a program, its processor and this package."""

from __future__ import annotations

import json
import os
import re
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np

from ...quantities.types import Array
from ..program import Program
from ..record import Recorded, key_of, name_of

MOST = 200
"""So many files are kept, those that were last made."""
DIGEST = 32
PART = ".camkit-part"
"""Ends the name of a file that is being written; other files of the folder are somebody's."""


@dataclass(frozen=True)
class Code:
    """Native code, and what it has to know."""

    machine_code: bytes
    constants: Array
    given: tuple[int, ...]
    """The calls whose results stand behind the constants; those of the inputs that move come last."""
    steady: tuple[int, ...]
    """The calls that lead to them."""
    outputs: tuple[int, ...]
    """Where each number of the outputs stands, of those that do not move; of others it is -1."""
    size: int
    """How many numbers of each design the heap holds."""
    lanes: int
    """How many designs are side by side."""

    def packed(self) -> bytes:
        """As the bytes of a file."""
        told = {name: value for name, value in asdict(self).items() if not isinstance(value, (bytes, np.ndarray))}
        head = json.dumps(told | {"constants": self.constants.size}).encode()
        rest = len(head).to_bytes(8, "little") + head + self.constants.tobytes() + self.machine_code
        return sha256(rest).digest() + rest

    @classmethod
    def unpacked(cls, file: bytes) -> Code:
        """What `packed` has made; ``ValueError`` for anything else."""
        digest, rest = file[:DIGEST], file[DIGEST:]
        if sha256(rest).digest() != digest:
            raise ValueError("the file is damaged")
        begin = 8 + int.from_bytes(rest[:8], "little")
        told = json.loads(rest[8:begin])
        end = begin + 8 * told.pop("constants")
        given, steady, outputs = (tuple(told[name]) for name in ("given", "steady", "outputs"))
        numbers = np.frombuffer(rest[begin:end])
        return cls(rest[end:], numbers, given, steady, outputs, told["size"], told["lanes"])


def folder() -> Path:
    """Where files are kept: ``CAMKIT_CACHE``, or where the system keeps what can be made again."""
    if given := os.environ.get("CAMKIT_CACHE"):
        return Path(given)
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", home / "AppData" / "Local")) / "camkit" / "Cache"
    if sys.platform == "darwin":
        return home / "Library" / "Caches" / "camkit"
    return Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache") / "camkit"


def name(program: Program, inputs: Sequence[str], processor: str) -> str:
    """What the file of a program is called: a hash of its calls, of which inputs move, of the processor, of this code.

    >>> from camkit.program import recorded
    >>> double = recorded(lambda given: {"double": 2 * given["x"]}, {"x": 1.5})
    >>> name(double, ["x"], "some") == name(double, ["x"], "some") != name(double, ["x"], "other")
    True
    """
    calls = [program.calls[k] for k in program.needed]
    told = [(k.number, name_of(k.function), *map(key_of, k.arguments), k.named) for k in calls]
    outputs = [out.number if isinstance(out, Recorded) else key_of(out) for out in program.outputs.values()]
    shapes = [call.shape for call in program.calls[: len(program.inputs)]]
    moving = [program.inputs.index(given) for given in inputs]
    return sha256(repr((_of_this_code(), processor, told, outputs, shapes, moving)).encode()).hexdigest()


@cache
def _of_this_code() -> str:
    """A hash of the files that make native code."""
    files = (*sorted(Path(__file__).parent.glob("*.py")), *sorted(Path(__file__).parents[1].glob("*.py")))
    return sha256(b"".join(file.read_bytes() for file in files)).hexdigest()


def read(file: str) -> Code | None:
    """What stands in a file of the cache; none if there is no such file, or if it is damaged."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        return Code.unpacked((folder() / file).read_bytes())
    return None


def write(file: str, code: Code) -> None:
    """Put a file into the cache, whole or not at all; a cache that cannot be written to is none."""
    with suppress(OSError):
        folder().mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, made = tempfile.mkstemp(PART, dir=folder())
        with os.fdopen(handle, "wb") as out:
            out.write(code.packed())
        Path(made).replace(folder() / file)
        ours = [each for each in folder().iterdir() if re.fullmatch(rf"[0-9a-f]{{64}}|.*{PART}", each.name)]
        for each in sorted(ours, key=lambda each: each.stat().st_mtime)[:-MOST]:
            each.unlink()
