"""Searches that have not ended: a checkpoint each, and beside it the page that it belongs to.

Whoever runs a search holds its lock, so that no other kernel and no other panel writes the same checkpoint; the lock of
a kernel that was killed is open.  Nothing is written or read through a link, and nothing is overwritten
that is not a search's own.
"""

from __future__ import annotations

import os
import stat
import sys
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from filelock import FileLock, Timeout

from ...search.checkpoint import remove_parts

FOLDER = Path(".camkit")
"""A folder beside the notebook that git does not see."""
LONGEST = 2**20
"""Characters of a page."""


class Kept:
    """The files of one search, held until `release` or `remove`; ``OSError`` if somebody else holds them."""

    def __init__(self, page: Path) -> None:
        self.page, self.checkpoint = page, page.with_suffix(".search")
        self._lock = FileLock(
            page.with_suffix(".lock"), timeout=0, thread_local=False
        )  # the search's thread lets it go
        try:
            self._lock.acquire()
        except Timeout:
            raise OSError("the very same search runs already") from None

    def text(self) -> str:
        """What the page says; ``ValueError`` if it is no text or too long."""
        with open(self.page, encoding="utf-8", opener=open_no_link) as file:
            text = file.read(LONGEST + 1)
        if len(text) > LONGEST:
            raise ValueError(f"the file {self.page.name} is longer than a page")
        return text

    def begin(self, text: str) -> None:
        """Keep another search from now on."""
        self.checkpoint.unlink(missing_ok=True)
        with open(self.page, "w", encoding="utf-8", opener=open_no_link) as file:
            file.write(text)

    def release(self) -> None:
        """Leave the search to whoever resumes it."""
        with suppress(OSError):
            Path(self._lock.lock_file).unlink(missing_ok=True)  # while it is held, so that it is nobody else's
        with suppress(OSError):
            self._lock.release()

    def remove(self) -> None:
        """The search has ended."""
        remove_parts(self.checkpoint)
        for path in filter(_is_file, (self.checkpoint, self.page)):  # a link is not the search's own
            with suppress(OSError):
                path.unlink(missing_ok=True)
        self.release()


def make_folder(folder: Path) -> Path:
    """Make the folder that git does not see, if it is not there; ``OSError`` for one that nothing can be kept in."""
    with suppress(FileExistsError):
        folder.mkdir()
    check_folder(folder)
    with suppress(FileExistsError), (folder / ".gitignore").open("x", encoding="utf-8") as ignored:
        ignored.write("*\n")
    return folder


def open_no_link(path: str, flags: int) -> int:
    """As ``open`` does it, but neither through a link nor waiting for somebody at the other end of a pipe."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0), 0o666)


def keep(name: str, text: str) -> Kept:
    """Files for a search that begins.

    Raises ``OSError``, with the reason, where nothing can be kept, or while the very same search runs.
    """
    kept = Kept(make_folder(_folder()) / f"{name}.json")
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
        check_folder(folder)
        _sweep(folder)
        for checkpoint in sorted(folder.glob(f"{kind}-*.search"), key=_written, reverse=True):
            kept = _held(checkpoint.with_suffix(".json"))
            if kept and _is_file(checkpoint) and _is_file(kept.page):  # else it has just ended
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


def check_folder(folder: Path) -> None:
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
    for part in folder.glob(".*.search.*.part"):
        checkpoint = folder / part.name[1:].rsplit(".", 2)[0]
        if kept := _held(checkpoint.with_suffix(".json")):
            remove_parts(checkpoint)
            kept.release()


def _held(page: Path) -> Kept | None:
    """The files of a search, unless somebody else holds them."""
    try:
        return Kept(page)
    except OSError:
        return None


def _is_file(path: Path) -> bool:
    return path.is_file() and not path.is_symlink()


def _written(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0
