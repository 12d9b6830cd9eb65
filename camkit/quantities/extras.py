"""What needs more than numpy and scipy says so in a sentence where that is not installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def extra(what: str) -> Iterator[None]:
    """A context that imports libraries of the extra ``lab`` for ``what``.

    >>> with extra("the map of cams"):
    ...     import cartography
    Traceback (most recent call last):
        ...
    ModuleNotFoundError: the map of cams needs cartography, which is not installed: pip install 'camkit[lab]'
    """
    try:
        yield
    except ModuleNotFoundError as missing:
        library = (missing.name or "").partition(".")[0]
        if library in ("", "camkit") or "camkit[lab]" in str(missing):
            raise
        said = f"{what} needs {library}, which is not installed: pip install 'camkit[lab]'"
        raise ModuleNotFoundError(said, name=library) from None
