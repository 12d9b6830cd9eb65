"""What an export is: bytes, what is in them, and how far they lie from the exact design when they are read back."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...quantities.applied import a_new_file
from ...search.checkpoint import remove_parts, write_whole
from ...units import inch, mm, um

LENGTHS = {"mm": mm, "in": inch}
"""The units in which a workshop works, and what each is worth, m."""
FINEST = 0.001
"""Less of a deviation, um, is rounding, and is not said."""
EARLIEST = (1980, 1, 1, 0, 0, 0)
"""The time of every file in a zip, so that a design gives the same zip again."""


@dataclass(frozen=True)
class Made:
    """A file that is not on a disk yet."""

    data: bytes = field(repr=False)
    what: str
    """What is in it, in a few words: ``"96 arcs on CAM"``."""
    deviation: float = np.nan
    """The largest distance (m) from the exact design, found on reading the file back; ``nan``: it has no geometry."""
    remarks: tuple[str, ...] = ()
    """What whoever uses it should know, in sentences."""

    def __str__(self) -> str:
        if np.isnan(self.deviation):
            return self.what
        away = max(self.deviation / um, FINEST) if self.deviation else 0
        return f"{self.what}; read back, at most {away:.2g} um off"


@dataclass(frozen=True)
class Written:
    """What was written: its path, what is in it, the largest deviation (m) found on reading it back, and remarks."""

    path: Path
    what: str
    deviation: float = np.nan
    remarks: tuple[str, ...] = ()

    def __str__(self) -> str:
        said = f"{self.path.name}: {Made(b'', self.what, self.deviation)}"
        return "\n".join((said, *self.remarks))


def written(made: Made, path: str | Path) -> Written:
    """Write what was made; a file that is there stays until the new one is whole."""
    path = a_new_file(path)
    remove_parts(path)
    write_whole(path, made.data)
    return Written(path, made.what, made.deviation, made.remarks)


def new_file(path: str | Path, what: str, endings: Sequence[str]) -> Path:
    """The path of a file that is to be made, before it is; ``ValueError`` without its folder, or for another ending.

    >>> new_file("cam.png", "an STL file", (".stl",))
    Traceback (most recent call last):
        ...
    ValueError: an STL file ends in .stl, not in '.png'
    """
    path = a_new_file(path)
    refuse_ending(path.suffix.lower(), what, endings)
    return path


def refuse_ending(ending: str, what: str, endings: Sequence[str]) -> None:
    """``ValueError`` in a sentence for an ending that is none of those of ``what``."""
    if ending not in endings:
        raise ValueError(f"{what} ends in {' or '.join(endings)}, not in {ending!r:.40}")


def length_unit(unit: object) -> str:
    """``"mm"`` or ``"in"``; ``ValueError`` in a sentence for any other.

    >>> length_unit("inch")
    'in'
    """
    name = "in" if unit == "inch" else unit
    if not isinstance(name, str) or name not in LENGTHS:
        raise ValueError(f"the unit is {unit!r:.40}; a workshop's files are in mm or in inches: 'mm', 'in'")
    return name


def zipped(files: Mapping[str, bytes | str]) -> bytes:
    """A zip that is the same for the same files, by their names."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name, data in files.items():
            about = zipfile.ZipInfo(name, EARLIEST)
            about.compress_type, about.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(about, data)
    return out.getvalue()
