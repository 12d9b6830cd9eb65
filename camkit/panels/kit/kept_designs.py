"""The designs that a person left in a panel, in a file beside the notebook: the last ones, and those with names.

A file belongs to a panel of one cell.  It is replaced whole, under a lock, and never written through a link; one that
is damaged stays as it is.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from filelock import FileLock, Timeout

from ...search.checkpoint import write_whole
from .search_files import FOLDER, check_folder, make_folder, open_no_link

MOST, MOST_NAMED = 3, 50
"""Last designs, and designs with a name, in one file."""
LONGEST = 2**23
"""Characters of a file."""
PATIENCE = 2.0
"""Seconds for another kernel that writes the same file."""


@dataclass(frozen=True)
class Last:
    """What somebody left: the panel that it was left in, the design as its file, and how the page stood."""

    panel: str
    design: str
    page: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class KeptDesigns:
    """What a file holds: the last designs, the newest first, and designs by name, each as its file."""

    last: tuple[Last, ...] = ()
    named: Mapping[str, str] = field(default_factory=dict)

    def text(self) -> str:
        """As JSON."""
        return json.dumps({"last": [asdict(last) for last in self.last], "named": dict(self.named)})


def file_of(kind: str, *place: str) -> Path:
    """The file for designs of one ``kind`` at a place: the notebook, its cell, which panel of the cell."""
    digest = hashlib.sha256("\0".join((kind, *place)).encode()).hexdigest()[:12]
    return Path(f"{kind}-{digest}.designs")


def read(file: Path) -> KeptDesigns:
    """What is kept in ``file`` of the folder beside the notebook; nothing, if there is none.

    Raises ``OSError`` where nothing can be read, ``ValueError`` in a sentence for a file that is damaged.
    """
    folder = Path.cwd() / FOLDER
    try:
        check_folder(folder)
        return _read(folder / file)
    except FileNotFoundError:
        return KeptDesigns()


def update(file: Path, change: Callable[[KeptDesigns], KeptDesigns]) -> KeptDesigns:
    """Change what is kept, whatever another kernel does meanwhile; raises as `read` does."""
    path = make_folder(Path.cwd() / FOLDER) / file
    try:
        with FileLock(path.with_suffix(".lock"), timeout=PATIENCE):
            now = _read(path) if path.exists() or path.is_symlink() else KeptDesigns()
            kept = change(now)
            text = kept.text()
            if len(text) > LONGEST or len(kept.named) > MOST_NAMED:
                raise ValueError(f"the file {file.name} would be too large; remove designs that have a name")
            write_whole(path, text.encode())
    except Timeout:
        raise OSError(f"another kernel holds the file {file.name}") from None
    return kept


def _read(path: Path) -> KeptDesigns:
    with open(path, encoding="utf-8", opener=open_no_link) as opened:
        try:
            text = opened.read(LONGEST + 1)
            return _checked(json.loads(text)) if len(text) <= LONGEST else _checked(None)
        except (ValueError, RecursionError):
            raise ValueError(
                f"the file {path.name} beside the notebook is damaged; delete it to keep designs again"
            ) from None


def _checked(content: object) -> KeptDesigns:
    """``ValueError`` for anything that `KeptDesigns.text` did not write; designs are checked when they are shown."""
    if not isinstance(content, dict) or content.keys() != {"last", "named"}:
        raise ValueError
    last, named = content["last"], content["named"]
    if not isinstance(last, list) or not isinstance(named, dict) or len(last) > MOST or len(named) > MOST_NAMED:
        raise ValueError
    if not all(isinstance(text, str) for text in named.values()):
        raise ValueError
    return KeptDesigns(tuple(map(_last, last)), named)


def _last(entry: object) -> Last:
    if not isinstance(entry, dict) or entry.keys() != {"panel", "design", "page"}:
        raise ValueError
    panel, design, page = entry["panel"], entry["design"], entry["page"]
    if not (isinstance(panel, str) and isinstance(design, str) and isinstance(page, dict)):
        raise ValueError
    return Last(panel, design, page)


def published() -> bool:
    """Whether this kernel's page is shown to visitors, who are strangers to each other: nothing of theirs is kept."""
    return "VOILA_BASE_URL" in os.environ


def notebook() -> str:
    """The notebook of this kernel as its server names it, or nothing."""
    return Path(os.environ.get("JPY_SESSION_NAME", "")).name
