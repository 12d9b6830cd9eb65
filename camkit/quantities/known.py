"""What physics may ask of a number, so that it can be recorded: whether it is known, and nothing of one that is not.

While a program is recorded (`camkit.program`), numbers stand for those of any other design.  They say so themselves, by
having ``recorded``; so physics needs to know nothing of programs.
"""

from __future__ import annotations

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


def fails(ok: ArrayLike) -> bool:
    """True if ``ok`` is one false answer; a population's answers are a mask and never fail as a whole.

    Nor does an answer that is recorded: the design that is refused for it becomes ``nan``.
    """
    if type(ok) is bool:
        return not ok
    return np.ndim(ok) == 0 and known(ok) and not ok
