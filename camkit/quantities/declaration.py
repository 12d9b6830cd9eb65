"""A parameter is declared once: symbol, default, range, unit and meaning; what has such parameters checks them."""

from __future__ import annotations

import dataclasses
import re
import sys
import warnings
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..units import factor, in_unit
from .kinds import listed, number, one_number, refuse_fields, refuse_kinds, shown, whole
from .known import certain, text_if, text_of, unless
from .markup import words
from .types import Array, Value

OURS = __name__.partition(".")[0]
BEYOND = 1000
"""How many times larger than all that a slider offers a number may be, unless its declaration says ``at_most``."""
BELOW = 1e-12
"""Such a share of the largest that a slider offers is the least size of a number that is above 0 and never below."""
MANY = 8
"""So many options of a choice are named in a sentence."""
FAR = 4
"""A number is far out of its range if it is at least so many times larger than its end, or smaller."""


class UnitRemark(UserWarning):
    """A number looks as if its unit had been left out, such as ``base_radius=30`` in place of ``30 * mm``."""


_silent: ContextVar[bool] = ContextVar("_silent", default=False)


@contextmanager
def unremarked() -> Iterator[None]:
    """Within this context no `UnitRemark` is made: the numbers come from a panel, a file or a search."""
    token = _silent.set(True)
    try:
        yield
    finally:
        _silent.reset(token)


def _level() -> int:
    """How many calls away the one stands that is not camkit's own."""
    frame, level = sys._getframe(1), 1
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] in (OURS, "dataclasses"):
        frame, level = frame.f_back, level + 1
    return level


@dataclass(frozen=True)
class Quantity:
    """The declaration of one number of a design; ``default, low, high, above, at_least, at_most`` are in ``unit``.

    The default is in the range from ``low`` to ``high``, which a slider offers and a study searches.
    ``at_most`` limits the size of the number, to both sides of 0; where it is not given, `BEYOND` times the larger of
    ``low, high`` does: a thousand times what a slider offers is a slip, and nothing overflows before.
    What may not be below 0 is 0 or at least `BELOW` times that largest: one can divide by it without overflow.
    ``name`` is what people call it, if its field, in a part with a name of its own, says less (see `label`).
    What is ``asked`` of the mechanism, such as a swing, is no size that a workshop makes.
    """

    symbol: str
    default: float
    low: float
    high: float
    unit: str
    meaning: str
    above: float | None = 0.0
    at_least: float | None = None
    at_most: float | None = None
    name: str = ""
    asked: bool = False

    def __post_init__(self) -> None:
        refuse_kinds(self)
        self.factor  # noqa: B018  refuses what is no unit
        told = f"{self.default:g} {self.unit}".rstrip()
        offered = f"from {self.low:g} to {self.high:g} {self.unit}".rstrip()
        if not self.low < self.high:
            raise ValueError(f"the range of {self.symbol} goes {offered}; the first must be below the second")
        if not self.low <= self.default <= self.high:
            raise ValueError(f"the default of {self.symbol} is {told}; it must be in the range {offered}")
        if not self.allows(self.default * self.factor):
            raise ValueError(f"the default of {self.symbol} is {told}; it must be {self.possible}")

    @cached_property
    def factor(self) -> float:
        """SI value of one unit."""
        return factor(self.unit)

    @cached_property
    def most(self) -> float:
        """The largest size that the number may have, in ``unit``."""
        return self._top * BEYOND if self.at_most is None else self.at_most

    @cached_property
    def _top(self) -> float:
        return max(abs(self.low), abs(self.high))

    @cached_property
    def _most(self) -> float:
        return self.most * self.factor

    @cached_property
    def _least(self) -> float:
        return self._top * BELOW * self.factor if self.above == 0 else -np.inf

    @property
    def possible(self) -> str:
        """The hard limit in words; the largest size is named where the declaration gives it."""
        return self._possible(self.at_most is not None)

    def possible_for(self, value: Value) -> str:
        """The hard limit in words for somebody who wanted ``value`` (SI): the size too, if that is missed."""
        least = f"at least {self._top * BELOW:.6g} {self.unit}".rstrip()
        tiny, huge = (value > 0) & (value < self._least), np.isfinite(value) & (np.abs(value) > self._most)
        if self.at_least is not None:
            return self._possible(huge) + text_if(tiny, f" and {least} unless it is 0")
        return text_if(tiny, f"a finite number of {least}", self._possible(huge))

    def _possible(self, most: bool | Array) -> str:
        unit = f" {self.unit}" if self.unit else ""
        upto = f"at most {self.most:.6g}{unit}"
        if self.at_least is not None:
            return f"a finite number of at least {self.at_least:g}{unit}" + text_if(most, f" and {upto}")
        if self.above is not None:
            return f"a finite number above {self.above:g}{unit}" + text_if(most, f" and {upto}")
        return "a finite number" + text_if(most, f" of a size of {upto}")

    def allows(self, value: object) -> Any:
        """Whether ``value`` (SI) can be built, element by element."""
        if (read := number(value)) is None:
            return False
        ok = (read >= -self._most) & (read <= self._most)
        if self.at_least is not None:
            return ok & (read >= self.at_least * self.factor) & ((read >= self._least) | (read <= 0))
        if self.above is not None:
            return ok & (read > self.above * self.factor) & (read >= self._least)
        return ok

    def text(self, value: Value) -> str:
        """``value`` (SI) as a person reads it."""
        read = in_unit(one_number(value, f"the number {self.symbol}"), self.unit)
        return f"{text_of(read, '~.6g')} {self.unit}".rstrip()

    def unit_left_out(self, value: float) -> bool:
        """Whether ``value`` (SI) is as round as people type, far out of the range, and within it if in the unit."""
        low, top, far = self._range
        size = abs(value)
        if low / far <= size <= top * far or not low / 2 <= size * self.factor <= 2 * top:
            return False
        return float(f"{size:.5g}") == size

    @cached_property
    def _range(self) -> tuple[float, float, float]:
        """The ends of the range by size (from 0: a twentieth of the top), SI, and how far out of it is far."""
        top = self._top * self.factor
        low = min(abs(self.low), abs(self.high)) * self.factor if self.low * self.high > 0 else top / 20
        return low, top, max(FAR, self.factor**0.5, self.factor**-0.5)

    def remark(self, name: str, value: Value) -> None:
        """A `UnitRemark` if ``value`` (SI) is one number that looks as if its unit had been left out."""
        if _silent.get() or isinstance(value, np.ndarray) or not self.unit_left_out(value):
            return
        factors = re.sub(r"\bin\b", "inch", self.unit.replace(" ", "*").replace("^", "**"))
        meant = "/100" if self.unit == "%" else f"*{factors}"
        said = f"the {words(name)} is {self.text(value)}, numbers being in SI units; did you mean {value:g}{meant}?"
        warnings.warn(UnitRemark(said), stacklevel=_level())


@dataclass(frozen=True)
class Choice:
    """The declaration of a field that is one of several options.

    Each option has a ``name``; or ``options`` maps names to plain values, such as ``{"clockwise": -1, ...}``.
    """

    symbol: str
    default: object
    options: Sequence[object] | Mapping[str, object]
    meaning: str

    def __post_init__(self) -> None:
        refuse_kinds(self)
        if not len(self.options):
            raise ValueError("the choice has no options; it must have one or more")
        if isinstance(self.options, Mapping):
            object.__setattr__(self, "named", dict(self.options))
            object.__setattr__(self, "options", tuple(self.options.values()))

    @cached_property
    def named(self) -> dict[str, Any]:
        """The options by their names."""
        options: tuple[Any, ...] = tuple(self.options)
        return {option.name: option for option in options}

    def text(self, value: Value) -> str:
        """What the option ``value``, or another like them, is called."""
        if self._plain:
            return next((name for name, option in self.named.items() if option == value), shown(value))
        return str(getattr(value, "name", shown(value)))

    def option(self, wanted: object) -> object:
        """The option that is ``wanted`` by its name or as it is; anything else is left to whom it is for."""
        return self.named.get(wanted, wanted) if isinstance(wanted, str) else wanted

    @cached_property
    def _plain(self) -> bool:
        """Whether the options are plain values, of which there can be no others."""
        return not all(hasattr(option, "name") for option in self.options)

    @cached_property
    def _common(self) -> frozenset[str]:
        """What every option can be asked for."""
        asked = (frozenset(n for n in dir(o) if n[0] != "_") for o in self.options)
        bases = (base for o in self.options for base in type(o).__mro__ if base.__module__.startswith(__package__))
        return frozenset.intersection(*asked).difference(*map(dir, bases))

    def allows(self, value: object) -> bool:
        """Whether ``value`` is one of the options or, where they are more than plain values, another like them."""
        if self._plain:
            return isinstance(value, Hashable) and value in self.options
        if isinstance(value, type):
            return False
        return type(value) in self._types or all(hasattr(value, name) for name in self._common)

    def same_as(self, value: object) -> object:
        """The plain option that equals ``value``, whose type may be another, such as numpy's; else ``value`` itself."""
        return next(option for option in self.options if option == value) if self._plain else value

    @property
    def offered(self) -> str:
        """The names of the options, the first of them where they are many."""
        names = list(self.named)
        return ", ".join(names[:MANY]) + f" and {len(names) - MANY} more" * (len(names) > MANY)

    @property
    def possible(self) -> str:
        """What can be chosen, in words."""
        if self._plain and self.options != tuple(self.named):
            return f"one of {', '.join(f'{option!r} ({name})' for name, option in self.named.items())}"
        return f"one of {self.offered}{'' if self._plain else ' or another like them'}"

    @cached_property
    def _types(self) -> frozenset[type]:
        return frozenset(map(type, self.options))


def quantity(
    symbol: str,
    default: float,
    low: float,
    high: float,
    unit: str,
    meaning: str,
    *,
    above: float | None = 0.0,
    at_least: float | None = None,
    at_most: float | None = None,
    name: str = "",
    asked: bool = False,
) -> Any:
    """A dataclass field for one number, all arguments in ``unit``.

    ``low`` and ``high`` are what a slider offers.  What is possible at all is ``above`` (strictly,
    0 unless said otherwise; ``None``: any finite number) or ``at_least``, and a size of ``at_most`` (a thousand
    times what a slider offers, unless said otherwise).  ``name`` and ``asked``: see `Quantity`.
    """
    declared = Quantity(symbol, default, low, high, unit, meaning, above, at_least, at_most, name, asked)
    return field(default=default * declared.factor, metadata={"declared": declared})


def choice(
    symbol: str, default: object, options: Sequence[object] | Mapping[str, object], meaning: str, **says: object
) -> Any:
    """A dataclass field that is one of ``options``, which have a ``name`` or are mapped from names.

    ``says`` what the options leave to their owner, such as the letter of numbers in a row, by the name of their field.
    """
    options = options if isinstance(options, Mapping) else listed(options, "the tuple of options", "option")
    return field(default=default, metadata={"declared": Choice(symbol, default, options, meaning), "says": says})


def row(declared: Callable[[int], tuple[str, Quantity]], **default: Any) -> Any:
    """A dataclass field for several numbers: ``declared(i)`` is the name and the declaration of the one at ``i``."""
    return field(metadata={"row": declared}, **default)


def numbered(name: str, declared: Quantity, first: int = 0) -> Callable[[int], tuple[str, Quantity]]:
    """For a `row` whose numbers are alike: ``c0``, ``c1`` and so on; symbols count from ``first``.

    >>> numbered("c", Quantity("c", 0, -1, 1, "", "shapes the law", above=None))(1)[1].symbol
    'c_1'
    """
    letter, called = declared.symbol, declared.name
    return cache(
        lambda i: (f"{name}{i}", replace(declared, symbol=f"{letter}_{i + first}", name=called and f"{called} {i + 1}"))
    )


def declarations(design: object) -> dict[str, Quantity | Choice]:
    """The declared fields of a design or a design class, in order; not those of what it holds (`declared_in`)."""
    kind = design if isinstance(design, type) else type(design)
    if not dataclasses.is_dataclass(kind):
        raise ValueError(f"the design is {shown(design)}; it must be a design, such as a cam, or a class of designs")
    return dict(_declared(kind))


@cache
def _declared(kind: type) -> dict[str, Quantity | Choice]:
    return {f.name: f.metadata["declared"] for f in dataclasses.fields(kind) if "declared" in f.metadata}


def counted(n: int, what: str, least: int = 2, most: int = 1_000_000) -> int:
    """``n`` if it is a whole number from ``least`` to ``most``; a ``ValueError`` in a sentence otherwise."""
    return whole(n, f"the number of {what}", least, most)


class Declared:
    """What has quantities of its own, as a design has, or a part of one: they are checked and can be replaced."""

    __dataclass_fields__: ClassVar[dict[str, dataclasses.Field[Any]]]

    def __post_init__(self) -> None:
        for name, entry in _declared(type(self)).items():  # type: ignore[arg-type]
            value = getattr(self, name)
            if isinstance(entry, Quantity):
                self._check(name, entry, value)
            elif not entry.allows(value):
                raise ValueError(f"the {words(name)} is {shown(value)}; it must be {entry.possible}")
            elif (option := entry.same_as(value)) is not value:
                object.__setattr__(self, name, option)

    def _check(self, name: str, declared: Quantity, given: object) -> None:
        """Refuse one number that cannot be built; drop the members of a population that cannot."""
        value = number(given)
        if value is None:
            column = ", or a column of them of the shape (p, 1)" if isinstance(given, np.ndarray) else ""
            raise ValueError(f"the {words(name)} is {shown(given)}; it must be {declared.possible}{column}")
        if value is not given:
            object.__setattr__(self, name, value)
        ok = declared.allows(value)
        if refuse := unless(ok):
            refuse(
                f"the {words(name)} ({declared.meaning}) is {declared.text(value)}; "
                f"it must be {declared.possible_for(value)}"
            )
        if type(value) is float:
            declared.remark(name, value)
        else:
            self._keep(ok)

    def _keep(self, ok: ArrayLike) -> None:
        """Members of a population for which ``ok`` does not hold become ``nan`` in every number that is a column.

        A number that all members share stays one, so that what follows from it is worked out once.
        """
        if certain(ok):
            return
        numbers = [name for name, declared in declarations(self).items() if isinstance(declared, Quantity)]
        for name in [n for n in numbers if np.ndim(getattr(self, n))] or numbers:
            object.__setattr__(self, name, np.where(ok, getattr(self, name), np.nan))

    def replace(self, **changes: object) -> Self:
        """The same design with some fields changed (and checked again)."""
        refuse_fields(self, changes)
        with unremarked():
            changed = dataclasses.replace(self, **changes)
        for name, declared in declarations(self).items():
            if name in changes and isinstance(declared, Quantity):
                declared.remark(name, getattr(changed, name))
        return changed

    def branches(self) -> Mapping[str, Declared]:
        """The parts that have quantities of their own, by the names that their paths begin with."""
        parts = ((f.name, getattr(self, f.name)) for f in dataclasses.fields(self))
        return {name: part for name, part in parts if isinstance(part, Declared) and dataclasses.is_dataclass(part)}

    def changed(self, changes: Mapping[str, object]) -> Self:
        """The same with other fields and `branches`."""
        return self.replace(**changes)

    def following(self) -> dict[str, str]:
        """Paths below this that follow from the others, and why: they are no quantities."""
        return {}

    def declares(self) -> Mapping[str, Any]:
        """Declarations of fields (of each `row` its function) that depend on the values of others."""
        return {}
