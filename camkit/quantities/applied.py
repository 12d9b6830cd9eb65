"""Errors of Python in what a user gave to be asked, computed or opened, said in a sentence."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .kinds import shown


@contextmanager
def applied(what: str, thing: object) -> Iterator[None]:
    """A context in which ``what`` asks ``thing`` for its parts: ``ValueError`` in a sentence where it cannot."""
    try:
        yield
    except AttributeError as lacking:
        why = f", which has no {lacking.name.replace('_', ' ')}" if lacking.name else ""
        raise ValueError(f"{what} does not apply to {shown(thing)}{why}") from lacking
    except ValueError:
        raise
    except Exception as error:
        raise ValueError(f"{what} cannot be computed: {raised(error)}") from error


def raised(error: Exception) -> str:
    """The kind of an error of Python and what it says.

    >>> raised(KeyError("k")), raised(MemoryError())
    ("KeyError: 'k'", 'MemoryError')
    """
    return f"{type(error).__name__}: {error}".removesuffix(": ")


def a_new_file(path: str | os.PathLike[str]) -> Path:
    """The path of a file in a folder that is there."""
    file = a_path(path)
    if not file.parent.is_dir():
        raise ValueError(f"there is no folder {shown(str(file.parent))} to write {shown(file.name)} into")
    return file


def a_path(path: str | os.PathLike[str]) -> Path:
    """The path of a file that the system can name."""
    try:
        name = os.fspath(path)
        if Path(name).name and b"\0" not in os.fsencode(name):
            return Path(name)
    except (TypeError, UnicodeError):
        pass
    raise ValueError(f"the path of the file is {shown(path)}; it must be a text such as 'design.json', or a Path")
