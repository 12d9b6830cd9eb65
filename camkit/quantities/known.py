"""What physics may ask of a number, so that it can be recorded: whether it is known, and nothing of one that is not.

While a program is recorded (`camkit.program`), numbers stand for those of any other design.  They say so themselves, by
having ``recorded``; so physics needs to know nothing of programs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def known(value: object) -> bool:
    """Whether a value can be asked what it is; a recorded one only stands for others.

    >>> known(1.5), known(np.ones(3))
    (True, True)
    """
    return not hasattr(value, "recorded")


def floats(values: Any) -> Any:
    """``values`` as an array of floats; a recorded one stays as it is.

    >>> floats([1, 2])
    array([1., 2.])
    """
    return np.asarray(values, dtype=float) if known(values) else values


def certain(ok: ArrayLike) -> bool:
    """Whether ``ok`` holds everywhere for sure: of what is recorded nobody knows.

    >>> certain(np.array([True, True])), certain(np.array([True, False]))
    (True, False)
    """
    return known(ok) and bool(np.all(ok))


def unless(ok: Any) -> Callable[[str], None] | None:
    """What refuses a design in a sentence, unless ``ok`` holds: ``ValueError`` if it is one false answer.

    A population's answers are a mask and refuse nothing.  Of what is recorded both are noted: a design that is refused
    becomes ``nan``.

    >>> if refuse := unless(2.5 < 2):
    ...     refuse("it is too large")
    Traceback (most recent call last):
        ...
    ValueError: it is too large
    """
    if ok is True or ok is np.True_:
        return None
    if not known(ok):
        return ok.refusing()
    return _refuse if np.ndim(ok) == 0 and not ok else None


def _refuse(sentence: str) -> None:
    raise ValueError(sentence)


def text_if(ok: Any, words: str, otherwise: str = "") -> str:
    """``words`` if ``ok`` holds, of one design; what is recorded has both, of which one is there.

    >>> text_if(2 > 1, "and more"), text_if(2 < 1, "and more")
    ('and more', '')
    """
    if known(ok):
        return words if ok else otherwise
    return "".join(holds.text_if(said) for holds, said in ((ok, words), (np.logical_not(ok), otherwise)) if said)


def text_of(value: Any, spec: str) -> str:
    """A number by a format of Python's; with ``~`` before it, first without the noise after 15 digits.

    One more is ``measure``: four digits, and from 1e4 to 1e6 all those before the point.

    >>> text_of(2.675000000000001, "~.3g"), text_of(12345.67, "measure"), text_of(1.2345, "measure")
    ('2.67', '12346', '1.234')
    """
    if not known(value):
        return format(value, spec)
    if spec.startswith("~"):
        value, spec = float(f"{value:.15g}"), spec[1:]
    if spec == "measure":
        spec = ".0f" if 1e4 <= abs(value) < 1e6 else ".4g"
    return format(value, spec)
