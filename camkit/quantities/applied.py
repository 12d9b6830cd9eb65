"""Errors of Python in what a user gave to be asked or computed, said in a sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

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
