"""``camkit lab`` and ``camkit app``: the notebooks, copied into a folder of one's own and opened there."""

from __future__ import annotations

import json
import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from .quantities.applied import a_path
from .quantities.extras import extra

FIRST = "00_start_here.ipynb"
RECORD = ".copied.json"
"""In the folder: the digest of every file as it was copied.  One that still has it is not the user's work."""


def home() -> Path:
    """The folder with ``notebooks`` and ``.jupyter``: in an installed package, or of the clone that is worked in."""
    packed = Path(__file__).parent / "workbook_files"
    return packed if packed.is_dir() else Path(__file__).parents[1]


def files() -> Iterator[str]:
    """The notebooks and what they show and read, by their paths in the folder.

    >>> FIRST in files(), "images/cards/05_cam_size.png" in files()
    (True, True)
    """
    folder = home() / "notebooks"
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        if path.is_file() and not any(part.startswith((".", "_")) for part in inside.parts):
            yield inside.as_posix()


class Copied(NamedTuple):
    """What `copy` has done, by names of files."""

    new: list[str]
    renewed: list[str]
    """They came from an earlier camkit, and nobody has changed them since."""
    kept: list[str]
    """They differ from the package's, and stay as they are: somebody's work."""

    def __str__(self) -> str:
        told = f"{len(self.new)} copied", f"{len(self.renewed)} brought up to date"
        said = [text for text, names in zip(told, self, strict=False) if names]
        if self.kept:
            said.append(f"kept as you changed {'it' if len(self.kept) == 1 else 'them'}: {', '.join(self.kept)}")
        return ", ".join(said) or "all files are there"


def copy(folder: Path) -> Copied:
    """Put the notebooks into a folder; no file that the user has changed is overwritten.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = copy(Path(folder))
    ...     _ = Path(folder, FIRST).write_text("mine", encoding="utf-8")
    ...     print(copy(Path(folder)))
    kept as you changed it: 00_start_here.ipynb
    """
    done, record = Copied([], [], []), _record(folder)
    for name in files():
        ours, target = (home() / "notebooks" / name).read_bytes(), folder / name
        theirs = target.read_bytes() if target.exists() else None
        if theirs == ours:
            continue
        if theirs is not None and _digest(theirs) != record.get(name):
            done.kept.append(name)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(ours)
        record[name] = _digest(ours)
        (done.new if theirs is None else done.renewed).append(name)
    if done.new or done.renewed:
        (folder / RECORD).write_text(json.dumps(record, indent=1), encoding="utf-8")
    return done


def _record(folder: Path) -> dict[str, str]:
    """What was copied before; of a record that cannot be read nothing is known, and every file is the user's."""
    with suppress(OSError, ValueError, RecursionError):
        found = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        return found if isinstance(found, dict) else {}
    return {}


def _digest(data: bytes) -> str:
    return sha256(data).hexdigest()


# ---------------------------------------------------------------- the commands


def ask_where(one: ArgumentParser) -> None:
    """The arguments of `lab` and `app`; what else is given goes to what they open."""
    told = "where the notebooks are copied to, unless they are there; none that you have changed is overwritten"
    one.add_argument("folder", nargs="?", default="camkit-notebooks", help=f"{told} (default: camkit-notebooks)")
    one.add_argument("--port", type=int, help="the port to listen on")
    one.add_argument("--no-browser", action="store_true", help="open no browser")


def lab(asked: Namespace) -> int:
    """Open the notebooks in JupyterLab, in a folder of your own."""
    with extra("the workbook"):
        from jupyterlab.labapp import LabApp
    folder = _filled(asked.folder)
    print(f"Opening {folder / FIRST} in JupyterLab; Ctrl-C here, twice, ends it.", flush=True)
    _put_first("JUPYTER_CONFIG_PATH")
    LabApp.launch_instance([*_as_root(), *_options(asked), str(folder / FIRST)])
    return 0


def app(asked: Namespace) -> int:
    """Show the notebooks as pages without code (Voila), to this machine alone."""
    with extra("the pages", "app"):
        from voila.app import Voila
    folder = _filled(asked.folder)
    print("Opening the notebooks as cards; a page fills while its notebook runs. Ctrl-C here ends it.", flush=True)
    _put_first("JUPYTER_PATH")
    limits = f"--Voila.config_file_paths={folder}"
    Voila.launch_instance([str(folder), limits, "--Voila.ip=127.0.0.1", *_options(asked)])
    return 0


def _filled(folder: str) -> Path:
    """The folder, with the notebooks in it; what was done is said."""
    print(f"{folder}: {copy(a_path(folder))}")
    return Path(folder)


def _options(asked: Namespace) -> list[str]:
    """As JupyterLab and Voila know them."""
    port = [] if asked.port is None else [f"--port={asked.port}"]
    return [*port, *["--no-browser"] * asked.no_browser, *asked.options]


def _put_first(variable: str) -> None:
    """Our settings come before those of the system; on one thread kernels are faster with small matrices."""
    ours = str(home() / ".jupyter")
    os.environ[variable] = os.pathsep.join(filter(None, (ours, os.environ.get(variable))))
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def _as_root() -> list[str]:
    """JupyterLab refuses to run as root unless told so."""
    return ["--allow-root"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
