"""Linear conditions on a few unknowns, and the least squares among all that meet them.

Which unknown stands in which condition is known; the numbers may be those of one design, of a population, or not known
before a recorded program runs.  So no number decides in which order unknowns are eliminated.  Whole numbers belong to
the structure: a term with the whole number 0 before it is none, one with another is sure to be there.

Source: Björck, Numerical Methods for Least Squares Problems (modified Gram-Schmidt, null space method).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ..quantities import floats
from ..quantities.types import Array, Value

AGREE = 1e-9
"""What is determined twice agrees if it differs by no more than this share of what it is made of."""
THERE = 1e-11
"""What stands before an unknown that a condition determines is at least this share of its largest."""
OPEN = 1e-10
"""An unknown of which less than this share is left, once the others may follow it, is not determined."""


@dataclass(frozen=True)
class Linear:
    """A constant and unknowns by number, each with what stands before it; ``size`` is what the constant is made of."""

    terms: Mapping[int, Any] = field(default_factory=dict)
    constant: Any = 0
    size: Any = 0

    @classmethod
    def known(cls, value: Value, size: Value | None = None) -> Linear:
        """A number."""
        return cls({}, value, np.abs(value) if size is None else size)

    def __add__(self, other: Linear) -> Linear:
        return weighed((self, other), (1, 1))

    def __sub__(self, other: Linear) -> Linear:
        return weighed((self, other), (1, -1))

    def __mul__(self, factor: Any) -> Linear:
        return weighed((self,), (factor,))

    def put(self, found: Mapping[int, Linear]) -> Linear:
        """With what is ``found`` in place of unknowns."""
        if not self.terms.keys() & found.keys():
            return self
        kept = Linear({x: factor for x, factor in self.terms.items() if x not in found}, self.constant, self.size)
        put = {x: factor for x, factor in self.terms.items() if x in found}
        return weighed((kept, *(found[x] for x in put)), (1, *put.values()))


class Conditions:
    """Linear conditions, met one after the other; ``sound`` are whether each could be, with what to say if not."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.found: dict[int, Linear] = {}
        self.sound: list[tuple[Any, Callable[[], str]]] = []

    def unknown(self, name: str) -> Linear:
        """A new unknown."""
        self.names.append(name)
        return Linear({len(self.names) - 1: 1})

    def meet(self, zero: Linear, name: str) -> None:
        """``zero`` is to be 0: the last unknown in it that surely is there follows from the others."""
        left = zero.put(self.found)
        if not left.terms:
            agree = np.abs(left.constant) <= AGREE * left.size
            self.sound.append((agree, lambda: _twice(name, np.abs(left.constant))))
            return
        sure = [x for x, factor in left.terms.items() if isinstance(factor, int)]
        last = max(sure or left.terms)
        if not sure:
            most = _largest([np.abs(factor) for factor in left.terms.values()])
            self.needs(left.terms[last], most, name)
        others = Linear({x: factor for x, factor in left.terms.items() if x != last}, left.constant, left.size)
        follows = {last: others * _inverse(left.terms[last])}
        self.found = {x: form.put(follows) for x, form in self.found.items()} | follows

    def needs(self, factor: Value, size: Value, name: str) -> None:
        """What stands before an unknown that a condition determines is to be there, beside others of a ``size``."""
        self.sound.append((np.abs(factor) > THERE * size, partial(_no_hold, name)))

    def least(self, sizes: Iterable[Linear]) -> dict[int, Linear]:
        """All unknowns as numbers: those that the conditions leave open make the sum of squares of ``sizes`` least."""
        wanted = [size.put(self.found) for size in sizes]
        free = sorted(set(range(len(self.names))) - self.found.keys())
        at_all = {x for size in wanted for x in size.terms}
        self.sound += ((False, partial(_open, self.names[x])) for x in free if x not in at_all)
        free = [x for x in free if x in at_all]
        rows = [[size.terms.get(x, 0.0) for x in free] + [size.constant] for size in wanted]
        values, left = least_squares(_columns(rows)) if free else ([], [])
        self.sound += ((share > OPEN, partial(_open, self.names[x])) for x, share in zip(free, left, strict=True))
        numbers = {x: Linear.known(value) for x, value in zip(free, values, strict=True)}
        return numbers | {x: form.put(numbers) for x, form in self.found.items()}


def least_squares(columns: Sequence[Array]) -> tuple[list[Value], list[Value]]:
    """The ``x`` that make the sum of squares of ``sum x_i column_i + column_last`` least; and what is left of each.

    What is left of a column, as a share of it, is what no earlier ones follow: 0 where ``x`` is not determined.

    >>> x, _ = least_squares([np.array([1.0, 1.0]), np.array([0.0, 1.0]), np.array([-3.0, -5.0])])
    >>> [float(each.round(9)) for each in x]
    [3.0, 2.0]
    """
    rest, triangle, left = list(columns), [], []
    for whole in columns[:-1]:
        column, *rest = rest
        norm = np.sqrt((column * column).sum(0))
        along = column / norm
        shares = [(along * other).sum(0) for other in rest]
        rest = [other - along * share for other, share in zip(rest, shares, strict=True)]
        triangle.append((norm, shares))
        left.append(norm / np.sqrt((whole * whole).sum(0)))
    found: list[Value] = []
    for norm, (*others, constant) in reversed(triangle):
        found.insert(0, -sum((share * x for share, x in zip(others, found, strict=True)), constant) / norm)
    return found, left


def weighed(forms: Iterable[Linear], factors: Iterable[Any]) -> Linear:
    """The sum of ``forms``, each times its factor; a factor 0 takes its form out."""
    terms, constant, size = dict[int, Any](), 0, 0
    for form, factor in zip(forms, factors, strict=True):
        if isinstance(factor, (int, float)) and factor == 0:
            continue
        for x, before in form.terms.items():
            terms[x] = _sum(terms.get(x, 0), _product(before, factor))
        constant = _sum(constant, _product(form.constant, factor))
        size = _sum(size, _product(form.size, abs(factor)))
    return Linear({x: factor for x, factor in terms.items() if not _nothing(factor)}, constant, size)


def _columns(rows: Sequence[Sequence[Any]]) -> list[Array]:
    """The columns of a matrix, ``(n,)`` each; where one holds numbers of a population all are ``(n, p or 1, 1)``."""
    columns = [np.stack(np.broadcast_arrays(*map(floats, column))) for column in zip(*rows, strict=True)]
    deepest = max(column.ndim for column in columns)
    return [column[(..., *[None] * (deepest - column.ndim))] for column in columns]


def _nothing(factor: Any) -> bool:
    return type(factor) is int and factor == 0


def _sum(a: Any, b: Any) -> Any:
    return b if _nothing(a) else a if _nothing(b) else a + b


def _product(a: Any, b: Any) -> Any:
    return 0 if _nothing(a) or _nothing(b) else a * b


def _inverse(factor: Any) -> Any:
    return -factor if isinstance(factor, int) and abs(factor) == 1 else -1.0 / factor


def _largest(values: Sequence[Value]) -> Value:
    most = values[0]
    for value in values[1:]:
        most = np.maximum(most, value)
    return most


def _twice(name: str, gap: Any) -> str:
    return f"the conditions contradict each other: {name} follows from them twice, {gap:.6g} apart (follower units)"


def _no_hold(name: str) -> str:
    return f"{name} cannot be met: no one motion of this kind reaches it; leave it free, or change what is given there"


def _open(name: str) -> str:
    return f"{name} is not determined by the conditions; give it a value"
