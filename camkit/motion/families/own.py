"""A function of one's own as a motion law: it has a name, and is checked when it is given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...quantities import words
from ...quantities.applied import raised
from ...quantities.kinds import numbers, shown
from ...quantities.types import Array, Value
from ..law import Kinematics, Law, Peaks, law_peaks, met_at_dwells

LETTERS = ("s", "v", "a", "j")
PLACES, STEP = np.linspace(0.03, 0.97, 19), 0.01
"""Where derivatives are compared with differences, and over which steps."""
CLOSE = 0.01
"""By so much of their size they may be apart, and one that is farther apart at half of the places is wrong."""
ENDS = 1e-3
"""How far from 0 and 1 a law may begin and end; a program tells of a jump that is smaller."""


@dataclass(frozen=True)
class UserLaw(Law):
    """A ``function`` of the shares ``u`` in [0, 1] that gives ``s, v, a, j`` there: four arrays as long as ``u``.

    ``name`` is what menus call it, without one the function's own.  A file holds the function by its module and name:
    ``def my_law(u)`` at the top of a module or notebook, or one that is declared there with ``@UserLaw``.  It is looked
    up where the file is read, and nothing is imported: import its module, or run its cell, before.

    A rise makes one of any function that it is given.  ``ValueError`` in a sentence: it cannot be computed, does not
    give four arrays, does not run from 0 to 1, or gives a derivative that is none.  ``function.kinks`` may say where
    inside (0, 1) a derivative up to the jerk jumps.

    >>> @UserLaw
    ... def straight(u):
    ...     return u, 1 + 0 * u, 0 * u, 0 * u
    >>> straight.name, straight(0.3).v
    ('straight', np.float64(1.0))
    >>> UserLaw(lambda u: u**2, "square")
    Traceback (most recent call last):
        ...
    ValueError: the law square gives one array; it must give four: s, v, a, j
    """

    function: Callable[[Array], Any]
    name: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.function, type) or not callable(self.function):
            raise ValueError(f"the function of the law is {shown(self.function)}; it must be a function of u")
        if not isinstance(self.name, str):
            raise ValueError(f"the name of the law is {shown(self.name)}; it must be a text")
        object.__setattr__(self, "name", self.name.strip() or _called(self.function))
        _refuse_wrong(self)

    @property
    def continuity(self) -> int:
        return met_at_dwells(self)

    @property
    def kinks(self) -> tuple[Value, ...]:
        return tuple(getattr(self.function, "kinks", ()))

    def at(self, u: Array) -> Kinematics:
        return Kinematics(*(0 * u + part for part in self.function(u)))

    def peaks(self) -> Peaks:
        return law_peaks(self)


def _called(function: object) -> str:
    """What people call a function, by its name in Python."""
    name = str(getattr(function, "__name__", "<>"))
    return "a function of one's own" if name.startswith("<") else words(name)


def _refuse_wrong(law: UserLaw) -> None:
    """``ValueError`` in a sentence for a function that is no law."""
    around = PLACES + STEP * np.arange(-2, 3)[:, None]
    u = np.array([0.0, *around.ravel(), 1.0])
    given = _parts(law, u)
    for letter, part in zip(LETTERS, given, strict=True):
        if part.shape[-1:] not in ((), u.shape):
            told = f"gives {part.shape[-1]} values of {letter} for {u.size} shares"
            raise ValueError(f"the law {law.name} {told}; it must give one for each")
    parts = [np.broadcast_to(part, np.broadcast_shapes(part.shape, u.shape)) for part in given]
    first, last = parts[0][..., 0], parts[0][..., -1]
    if not np.all((abs(first) <= ENDS) & (abs(last - 1) <= ENDS)):
        told = f"{np.ravel(first)[0]:.6g} to {np.ravel(last)[0]:.6g}"
        raise ValueError(f"the law {law.name} runs from {told}; it must run from 0 to 1")
    inner = [part[..., 1:-1].reshape(*part.shape[:-1], *around.shape) for part in parts]
    for k in (1, 2, 3):
        _refuse_derivative(law.name, k, *np.broadcast_arrays(inner[k - 1], inner[k]))


def _parts(law: UserLaw, u: Array) -> list[Array]:
    """What the function gives: four arrays of numbers."""
    try:
        with np.errstate(all="ignore"):
            given = law.function(u)
    except Exception as error:  # whatever goes wrong in a user's function is told in a sentence
        raise ValueError(f"the law {law.name} cannot be computed: {raised(error)}") from error
    one = not isinstance(given, (tuple, list)) and np.ndim(given) < 2
    if one or len(given) != 4:
        told = f"{len(given)} arrays" if not one else "one array" if np.ndim(given) else shown(given)
        raise ValueError(f"the law {law.name} gives {told}; it must give four: s, v, a, j")
    return [numbers(part, f"the {letter} of the law {law.name}") for letter, part in zip(LETTERS, given, strict=True)]


def _refuse_derivative(name: str, k: int, below: Array, values: Array) -> None:
    """A derivative of order ``k`` that is at half of the places not the slope of what it is to be the derivative of."""
    slope = (below[..., 0, :] - 8 * below[..., 1, :] + 8 * below[..., 3, :] - below[..., 4, :]) / (12 * STEP)
    stated = values[..., 2, :]
    size = np.maximum(np.max(abs(slope), axis=-1), np.max(abs(stated), axis=-1))[..., None]
    wrong = ~(abs(slope - stated) <= CLOSE * size + 1e-6)
    if np.mean(wrong) > 0.5:
        at = np.unravel_index(np.argmax(wrong), wrong.shape)
        what, of = LETTERS[k], LETTERS[k - 1]
        told = f"at u = {PLACES[at[-1]]:.3g} it is {stated[at]:.4g}, and the slope of {of} is {slope[at]:.4g}"
        raise ValueError(f"the {what} of the law {name} is not the derivative of its {of}: {told}")
