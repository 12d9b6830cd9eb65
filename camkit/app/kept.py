"""Searches that have not ended: a checkpoint each, and beside it the page that it belongs to.

Whoever runs a search locks its page, so that no other kernel and no other panel writes the same checkpoint.  The
system opens the lock when a kernel is killed.
"""

from __future__ import annotations

import sys
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

FOLDER = Path(".camkit")
"""A folder beside the notebook that git does not see."""
BEYOND = 2**30
"""Windows keeps others from reading what is locked; so a byte is locked that no page has."""


class Kept:
    """The files of one search, held until `let_go` or `remove`; ``OSError`` if somebody else holds them."""

    def __init__(self, page: Path, mode: str = "r+") -> None:
        self.page, self.checkpoint = page, page.with_suffix(".npz")
        self._file = page.open(mode, encoding="utf-8")
        try:
            self._lock()
        except OSError:
            self._file.close()
            raise

    def _lock(self) -> None:
        if sys.platform == "win32":
            self._file.seek(BEYOND)
            msvcrt.locking(self._file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def text(self) -> str:
        """What the page says."""
        self._file.seek(0)
        return self._file.read()

    def begin(self, text: str) -> None:
        """Keep another search from now on."""
        self.checkpoint.unlink(missing_ok=True)
        self._file.truncate(0)
        self._file.seek(0)
        self._file.write(text)
        self._file.flush()

    def let_go(self) -> None:
        """Leave the search to whoever resumes it."""
        self._file.close()

    def remove(self) -> None:
        """The search has ended."""
        self.checkpoint.unlink(missing_ok=True)
        self._file.close()  # Windows removes no file that is open
        self.page.unlink(missing_ok=True)


def keep(name: str, text: str) -> Kept | None:
    """Files for a search that begins; ``None`` where nothing can be written, or while the very same search runs."""
    try:
        FOLDER.mkdir(exist_ok=True)
        (FOLDER / ".gitignore").write_text("*\n", encoding="utf-8")
        kept = Kept(FOLDER / f"{name}.json", "a+")
    except OSError:
        return None
    kept.begin(text)
    return kept


def unfinished(kind: str) -> Kept | None:
    """The latest search whose name begins with ``kind``, that did not end and that nobody runs."""
    for checkpoint in sorted(FOLDER.glob(f"{kind}-*.npz"), key=_written, reverse=True):
        try:
            kept = Kept(checkpoint.with_suffix(".json"))
        except OSError:
            continue
        if checkpoint.exists():  # else it has just ended
            return kept
        kept.let_go()
    return None


def _written(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0
