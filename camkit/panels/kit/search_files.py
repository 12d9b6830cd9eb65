"""Searches that have not ended: a checkpoint each, and beside it the page that it belongs to.

Whoever runs a search locks its page, so that no other kernel and no other panel writes the same checkpoint.  The
system opens the lock when a kernel is killed.  Nothing is written or read through a link, and nothing is overwritten
that is not a search's own.
"""

from __future__ import annotations

import errno
import os
import stat
import sys
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from ...search.checkpoint import remove_parts

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

FOLDER = Path(".camkit")
"""A folder beside the notebook that git does not see."""
LONGEST = 2**20
"""Characters of a page."""
TAKEN = (errno.EWOULDBLOCK, errno.EACCES, errno.EDEADLK)
"""What the system says of a file that somebody else holds."""
BEYOND = 2**30
"""Windows keeps others from reading what is locked; so a byte is locked that no page has."""


class Kept:
    """The files of one search, held until `release` or `remove`; ``OSError`` if somebody else holds them."""

    def __init__(self, page: Path, mode: str = "r+") -> None:
        self.page, self.checkpoint = page, page.with_suffix(".npz")
        self._file = open(page, mode, encoding="utf-8", opener=_open_no_link)  # noqa: SIM115
        try:
            self._lock()
        except OSError as error:
            self._file.close()
            if error.errno in TAKEN:
                raise OSError("the very same search runs already") from None
            raise

    def _lock(self) -> None:
        if sys.platform == "win32":
            self._file.seek(BEYOND)
            msvcrt.locking(self._file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def text(self) -> str:
        """What the page says; ``ValueError`` if it is no text or too long."""
        self._file.seek(0)
        text = self._file.read(LONGEST + 1)
        if len(text) > LONGEST:
            raise ValueError(f"the file {self.page.name} is longer than a page")
        return text

    def begin(self, text: str) -> None:
        """Keep another search from now on."""
        self.checkpoint.unlink(missing_ok=True)
        self._file.truncate(0)
        self._file.seek(0)
        self._file.write(text)
        self._file.flush()

    def release(self) -> None:
        """Leave the search to whoever resumes it."""
        with suppress(OSError):
            self._file.close()

    def remove(self) -> None:
        """The search has ended."""
        remove_parts(self.checkpoint)
        with suppress(OSError):
            self.checkpoint.unlink(missing_ok=True)
        self.release()  # Windows removes no file that is open
        with suppress(OSError):
            self.page.unlink(missing_ok=True)


def _open_no_link(path: str, flags: int) -> int:
    """As ``open`` does it, but neither through a link nor waiting for somebody at the other end of a pipe."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0), 0o666)


def keep(name: str, text: str) -> Kept:
    """Files for a search that begins.

    Raises ``OSError``, with the reason, where nothing can be kept, or while the very same search runs.
    """
    folder = _folder()
    with suppress(FileExistsError):
        folder.mkdir()
    _check(folder)
    with suppress(FileExistsError), (folder / ".gitignore").open("x", encoding="utf-8") as ignored:
        ignored.write("*\n")
    kept = Kept(folder / f"{name}.json", "a+")
    try:
        kept.begin(text)
    except OSError:
        kept.remove()
        raise
    return kept


def pending(kind: str) -> Kept | None:
    """The latest search whose name begins with ``kind``, that did not end and that nobody runs."""
    with suppress(OSError):
        folder = _folder()
        _check(folder)
        _sweep(folder)
        for checkpoint in sorted(folder.glob(f"{kind}-*.npz"), key=_written, reverse=True):
            kept = _held(checkpoint.with_suffix(".json"))
            if kept and checkpoint.exists():  # else it has just ended
                return kept
            if kept:
                kept.release()
    return None


def _folder() -> Path:
    """Beside the notebook; for a published page, whose visitors are strangers to each other, its kernel's own."""
    return Path(_own_folder().name) if "VOILA_BASE_URL" in os.environ else Path.cwd() / FOLDER


@cache
def _own_folder() -> tempfile.TemporaryDirectory[str]:
    """It goes with the kernel, and so does what was stopped."""
    return tempfile.TemporaryDirectory(prefix="camkit-", ignore_cleanup_errors=True)


def _check(folder: Path) -> None:
    """``OSError`` for a folder that is none, leads elsewhere, or is somebody else's."""
    about = folder.lstat()
    if folder.resolve() != folder.parent.resolve() / folder.name:
        raise OSError(f"{folder.name} is a link, which is not followed")
    if not stat.S_ISDIR(about.st_mode):
        raise OSError(f"{folder.name} is not a folder")
    if sys.platform != "win32" and about.st_uid != os.geteuid():
        raise OSError(f"the folder {folder.name} belongs to somebody else")


def _sweep(folder: Path) -> None:
    """Remove what kernels that were killed have left half written: nobody holds its page."""
    for part in folder.glob(".*.npz.*.part"):
        checkpoint = folder / part.name[1:].rsplit(".", 2)[0]
        page = checkpoint.with_suffix(".json")
        kept = _held(page)
        if kept or not page.exists():
            remove_parts(checkpoint)
        if kept:
            kept.release()


def _held(page: Path) -> Kept | None:
    """The files of a search, unless somebody else holds them."""
    try:
        return Kept(page)
    except OSError:
        return None


def _written(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0
