"""Designs to be looked at, many more than one array could hold: of a grid, or of a table."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import prod
from typing import Self

import numpy as np

from ..quantities import counted
from ..quantities.kinds import numbers, shown
from ..quantities.types import Array
from ..study.free import Menu
from ..study.study import Study

MOST_LINES, MOST_DESIGNS = 100_000, 10**12


@dataclass(frozen=True)
class Designs:
    """Designs ``begin`` to ``end`` of many."""

    begin: int
    end: int

    @property
    def count(self) -> int:
        """How many they are."""
        return self.end - self.begin

    @property
    def rows(self) -> Array:
        """Their free values, ``(p, n_free)``."""
        raise NotImplementedError

    @property
    def name(self) -> str:
        """What tells them from others of the same study."""
        raise NotImplementedError

    def part(self, begin: int, end: int) -> Self:
        """Some of them."""
        return replace(self, begin=begin, end=end)

    def cut(self, count: int) -> Iterator[Self]:
        """All of them, so many at a time."""
        for begin in range(self.begin, self.end, count):
            yield self.part(begin, min(begin + count, self.end))


@dataclass(frozen=True)
class Grid(Designs):
    """All combinations of values of each free quantity, that of the last one running fastest."""

    axes: tuple[Array, ...]

    @classmethod
    def over(cls, study: Study, lines: object) -> Grid:
        """Over a study's bounds, with so many values along each free quantity; of a menu all options."""
        given = lines if isinstance(lines, (tuple, list)) else [lines] * len(study.free)
        if len(given) != len(study.free):
            raise ValueError(f"there are {len(given)} numbers of designs for {len(study.free)} free quantities")
        axes = []
        for (name, free), n in zip(study.free.items(), given, strict=True):
            if not isinstance(free, Menu):
                low, high = free
                axes.append(np.linspace(low, high, counted(n, f"values of the {name}", most=MOST_LINES)))
                continue
            if n != len(free.names) and given is lines:
                raise ValueError(f"the {name} has {len(free.names)} options, all of which are looked at; given is {n}")
            axes.append(np.arange(len(free.names), dtype=float))
        count = prod(map(len, axes))
        if count > MOST_DESIGNS:
            raise ValueError(f"these are {count:.3g} designs; there can be up to {MOST_DESIGNS:.0g}")
        return cls(0, count, tuple(axes))

    @property
    def rows(self) -> Array:
        """Their free values."""
        places = np.unravel_index(np.arange(self.begin, self.end), [len(axis) for axis in self.axes])
        return np.stack([axis[place] for axis, place in zip(self.axes, places, strict=True)], axis=-1)

    @property
    def name(self) -> str:
        """How many values there are of each."""
        return f"a grid of {' x '.join(str(len(axis)) for axis in self.axes)}"


@dataclass(frozen=True)
class Table(Designs):
    """Rows of a table of free values."""

    values: Array

    @property
    def rows(self) -> Array:
        """Their free values."""
        return self.values

    def part(self, begin: int, end: int) -> Self:
        """Some of them."""
        return replace(self, begin=begin, end=end, values=self.values[begin - self.begin : end - self.begin])

    @property
    def name(self) -> str:
        """That of the table and the digest of its numbers."""
        return f"a table, {hashlib.sha256(self.values.tobytes()).hexdigest()}"


def designs_of(study: Study, given: object) -> Designs:
    """The designs that are to be looked at; ``ValueError`` in a sentence for what are none."""
    if not isinstance(given, np.ndarray) and not (isinstance(given, (list, tuple)) and np.ndim(given[:1]) > 1):
        return Grid.over(study, given)
    x = numbers(given, "the designs")
    if x.ndim != 2 or x.shape[1] != len(study.free) or not len(x):
        raise ValueError(f"the designs are {shown(given)}; they must be a table with {len(study.free)} columns")
    return Table(0, len(x), x)
