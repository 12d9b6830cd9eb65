"""What needs more than numpy and scipy says so in a sentence where that is not installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

SIZES = {"step": " (about 380 MB)"}
"""What an extra takes on the disk, where that is worth a word."""


@contextmanager
def extra(what: str, name: str = "lab") -> Iterator[None]:
    """A context that imports libraries of the extra ``name`` for ``what``.

    >>> with extra("the map of cams"):
    ...     import cartography
    Traceback (most recent call last):
        ...
    ModuleNotFoundError: the map of cams needs cartography, which is not installed: pip install 'camkit[lab]'
    >>> with extra("the globe", "step"):
    ...     import cartography
    Traceback (most recent call last):
        ...
    ModuleNotFoundError: the globe needs cartography, which is not installed: pip install 'camkit[step]' (about 380 MB)
    """
    try:
        yield
    except ModuleNotFoundError as missing:
        library = (missing.name or "").partition(".")[0]
        if library in ("", "camkit") or "pip install 'camkit[" in str(missing):
            raise
        said = f"{what} needs {library}, which is not installed: pip install 'camkit[{name}]'{SIZES.get(name, '')}"
        raise ModuleNotFoundError(said, name=library) from None
