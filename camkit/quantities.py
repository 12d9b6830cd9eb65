"""A parameter is declared once: symbol, default, range, unit and meaning.

Sliders, optimiser bounds, tables, saved files and the refusal of bad numbers all read the same
declaration, which sits on the field of the design that it describes:

>>> @dataclass(frozen=True)
... class Lever(Design):
...     arm: float = quantity("l", 50, 20, 90, "mm", "pivot to roller centre")
>>> Lever().arm
0.05
>>> Lever(arm=-0.01)
Traceback (most recent call last):
    ...
ValueError: the arm l (pivot to roller centre) is -10 mm; it must be a finite number above 0 mm

A design is a frozen dataclass.  Its fields hold one number each, or arrays of shape ``(p, 1)`` for a
population of ``p`` designs: one number that cannot be built is refused in a sentence, a member of a
population that cannot be built becomes ``nan`` and disturbs nobody else.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from .markup import Html, html, table
from .units import factor, in_unit


@dataclass(frozen=True)
class Quantity:
    """The declaration of one number of a design; ``default, low, high, above, at_least`` are in ``unit``."""

    symbol: str
    default: float
    low: float
    high: float
    unit: str
    meaning: str
    above: float | None = 0.0
    at_least: float | None = None

    @property
    def factor(self) -> float:
        """SI value of one unit."""
        return factor(self.unit)

    @property
    def possible(self) -> str:
        """The hard limit in words."""
        unit = f" {self.unit}" if self.unit else ""
        if self.at_least is not None:
            return f"a finite number of at least {self.at_least:g}{unit}"
        if self.above is not None:
            return f"a finite number above {self.above:g}{unit}"
        return "a finite number"

    def allows(self, value: Any) -> Any:
        """Whether ``value`` (SI) can be built, element by element."""
        ok = np.isfinite(value)
        if self.at_least is not None:
            return ok & (value >= self.at_least * self.factor)
        if self.above is not None:
            return ok & (value > self.above * self.factor)
        return ok

    def text(self, value: float) -> str:
        """``value`` (SI) as a person reads it."""
        return f"{in_unit(value, self.unit):.6g} {self.unit}".rstrip()


@dataclass(frozen=True)
class Choice:
    """The declaration of a field that is one of several named options (each has a ``name``)."""

    symbol: str
    default: Any
    options: tuple[Any, ...]
    meaning: str


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
) -> Any:
    """A dataclass field for one number, all arguments in ``unit``.

    ``low`` and ``high`` are what a slider offers.  What is possible at all is ``above`` (strictly,
    0 unless said otherwise; ``None``: any finite number) or ``at_least``.
    """
    declared = Quantity(symbol, default, low, high, unit, meaning, above, at_least)
    return field(default=default * declared.factor, metadata={"declared": declared})


def choice(symbol: str, default: Any, options: Sequence[Any], meaning: str) -> Any:
    """A dataclass field that is one of ``options``."""
    return field(default=default, metadata={"declared": Choice(symbol, default, tuple(options), meaning)})


def declarations(design: Any) -> dict[str, Quantity | Choice]:
    """The declared fields of a design or a design class, in order."""
    return {f.name: f.metadata["declared"] for f in dataclasses.fields(design) if "declared" in f.metadata}


def fails(ok: Any) -> bool:
    """True if ``ok`` is one false answer; a population's answers are a mask and never fail as a whole."""
    return np.ndim(ok) == 0 and not ok


def counted(n: Any, what: str, least: int = 2) -> int:
    """``n`` if it is a whole number of at least ``least``; a ``ValueError`` in a sentence otherwise."""
    if isinstance(n, bool) or not isinstance(n, (int, np.integer)) or n < least:
        raise ValueError(f"the number of {what} is {n!r}; it must be a whole number of at least {least}")
    return int(n)


def words(name: str) -> str:
    """A field's name as it is read: ``lift_arm`` -> ``lift arm``, ``load.mass`` -> ``load mass``."""
    return name.replace("_", " ").replace(".", " ")


class Design:
    """What every design shares: its numbers are checked, can be replaced, and show as a table."""

    measures: ClassVar[tuple[Measure, ...]] = ()
    """Every measure of such a design, for tables and files."""

    def __post_init__(self) -> None:
        for name, declared in declarations(self).items():
            value = getattr(self, name)
            if isinstance(declared, Quantity):
                self._check(name, declared, value)
            elif not hasattr(value, "name"):
                options = ", ".join(option.name for option in declared.options)
                raise ValueError(f"the {words(name)} is {value!r}; it must be one of {options} or another like them")

    def _check(self, name: str, declared: Quantity, value: Any) -> None:
        """Refuse one number that cannot be built; drop the members of a population that cannot."""
        subject = f"the {words(name)}" if name == declared.symbol else f"the {words(name)} {declared.symbol}"
        if not isinstance(value, (int, float, np.ndarray, np.number)) or isinstance(value, bool):
            raise ValueError(f"{subject} is {value!r}; it must be {declared.possible}")
        ok = declared.allows(value)
        if fails(ok):
            raise ValueError(
                f"{subject} ({declared.meaning}) is {declared.text(float(value))}; it must be {declared.possible}"
            )
        self.keep(ok)

    def keep(self, ok: Any) -> None:
        """Members of a population for which ``ok`` does not hold become ``nan`` in every number that is a column.

        A number that all members share stays one, so that what follows from it is worked out once.
        """
        if np.all(ok):
            return
        numbers = [name for name, declared in declarations(self).items() if isinstance(declared, Quantity)]
        for name in [n for n in numbers if np.ndim(getattr(self, n))] or numbers:
            object.__setattr__(self, name, np.where(ok, getattr(self, name), np.nan))

    def replace(self, **changes: Any) -> Any:
        """The same design with some fields changed (and checked again)."""
        unknown = set(changes) - {f.name for f in dataclasses.fields(self)}  # type: ignore[arg-type]
        if unknown:
            raise ValueError(
                f"{type(self).__name__} has no {', '.join(sorted(unknown))}; "
                f"it has {', '.join(f.name for f in dataclasses.fields(self))}"  # type: ignore[arg-type]
            )
        return dataclasses.replace(self, **changes)  # type: ignore[type-var]

    def _repr_mimebundle_(self, **wanted: Any) -> dict[str, str]:
        """In a notebook: declared numbers in their units, six digits, as a table and as plain text."""
        shown = (f"{words(name)} {_shown(getattr(self, name), d)}" for name, d in declarations(self).items())
        return {"text/plain": f"{type(self).__name__}: {', '.join(shown)}", "text/html": self._repr_html_()}

    def _repr_html_(self) -> str:
        rows = [
            (_left(words(name)), html("<i>{}</i>", d.symbol), _shown(getattr(self, name), d), _left(d.meaning))
            for name, d in declarations(self).items()
        ]
        return table((), rows, type(self).__name__)


def _left(text: str) -> Html:
    """A cell whose text begins at its left edge."""
    return html("<div style='text-align:left'>{}</div>", text)


def _shown(value: Any, declared: Quantity | Choice) -> str:
    if isinstance(declared, Choice):
        return str(value.name)
    return declared.text(value) if np.ndim(value) == 0 else f"{np.size(value)} values in {declared.unit}"


@dataclass(frozen=True)
class Measure:
    """A number per design: a name, a unit to show it in, and a function of an analysis that gives SI.

    Two measures are the same if they have the same name and unit, so names are unique within a mechanism.
    ``-measure`` is the same number with the other sign, for what is to be made as large as possible.

    >>> tall = Measure("height", "mm", lambda analysis: analysis["height"])
    >>> tall({"height": 0.05}), (-tall)({"height": 0.05})
    (0.05, -0.05)
    """

    name: str
    unit: str
    function: Callable[[Any], Any] = field(repr=False, compare=False)
    sign: int = 1

    def __call__(self, analysis: Any) -> Any:
        return self.sign * self.function(analysis)

    def __neg__(self) -> Measure:
        return dataclasses.replace(self, sign=-self.sign)

    @property
    def label(self) -> str:
        """Name and unit, for an axis or a heading."""
        return f"{self.name}  [{self.unit}]" if self.unit else self.name

    def text(self, value: float) -> str:
        """``value`` (SI) as a person reads it."""
        shown = in_unit(float(value), self.unit)
        return f"{shown:{'.0f' if 1e4 <= abs(shown) < 1e6 else '.4g'}} {self.unit}".rstrip()


@dataclass(frozen=True)
class PeakMeasure(Measure):
    """The largest value of a curve: ``function`` gives the curve, its points last; the measure is their maximum.

    A search then sees every point and not only the largest, which jumps from one to another.  ``-PeakMeasure`` of
    the negative curve is a least value.  ``angle`` says at which cam angle each point of the curve stands.

    >>> lowest = -PeakMeasure("least height", "mm", lambda analysis: -analysis["height"])
    >>> float(lowest({"height": np.array([0.05, 0.02, 0.04])}))
    0.02
    """

    angle: Callable[[Any], Any] | None = field(default=None, repr=False, compare=False)

    def curve(self, analysis: Any) -> Any:
        """The value at every point, before the sign."""
        return self.function(analysis)

    def __call__(self, analysis: Any) -> Any:
        return self.sign * self.function(analysis).max(-1)
