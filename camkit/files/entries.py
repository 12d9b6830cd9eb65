"""The entries of a saved file: a design, a law or a program as a JSON object that says its kind.

Numbers stand in the units of their declarations.  What a file gives is checked against the declaration or the
annotation of its field before anything is built of it, whatever the constructor itself would take.
"""

from __future__ import annotations

import inspect
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields, is_dataclass
from functools import lru_cache
from types import NoneType, UnionType
from typing import Any, TypeGuard, Union, get_args, get_origin, get_type_hints

import numpy as np

from ..motion import Boundary, FormError, Law, MotionProgram, Part, Segment, Through, UserLaw
from ..quantities import Choice, Design, Quantity, declarations, declared_in, unremarked, with_quantities, words
from ..quantities.kinds import kind_words, shown
from ..units import factor, in_unit
from .functions import function_at, place_of
from .renamed import Given, Renaming, fields_renamed, is_earlier

OF_PROGRAMS = (MotionProgram, Segment, Part, Boundary, Through)
"""Programs and what they are made of: their numbers have no unit of their own."""
MOST_ROWS = 5000
"""Entries of a list: rows of a table, designs of a front; fewer where a field's metadata says ``most``.

Metadata ``in_all=(what, most)`` says how many the lists of such fields may have together in a design."""
MOST_THINGS = 500
"""Entries that are objects themselves, such as the segments of a program."""


UNSAID = ("name", "advance")
"""Keyword-only fields that a file leaves out where they are empty or 0, as most are."""


def key(name: str, declared: object) -> str:
    """A field's name in a file: with its unit."""
    return f"{name} [{declared.unit}]" if isinstance(declared, Quantity) and declared.unit else name


def exact_in_unit(value: float, unit: str) -> float:
    """``value`` (SI) in ``unit``: fifteen digits, or more where those give it back more exactly.

    >>> exact_in_unit(0.04809, "mm"), exact_in_unit(0.3, "deg")
    (48.09, 17.188733853924695)
    """
    plain, si = in_unit(float(value), unit), factor(unit)
    near = float(value) / si
    tried = (plain, near, float(np.nextafter(near, -np.inf)), float(np.nextafter(near, np.inf)))
    return min(tried, key=lambda number: abs(number * si - value))


def entry_of(thing: object, where: str = "value") -> object:
    """A value as JSON knows it; ``where`` names it in the refusal of what no file can hold."""
    if isinstance(thing, (np.generic, np.ndarray)) and np.ndim(thing) == 0:
        return thing.item()
    if thing is None or isinstance(thing, (bool, int, float, str)):
        return thing
    if isinstance(thing, (tuple, list, np.ndarray)):
        return [entry_of(value, where) for value in thing]
    name, known = type(thing).__name__, kinds()
    if name in known and is_dataclass(thing):
        _refuse_namesake(type(thing), known[name], where)
        declared = _declarations(type(thing))
        values = {f.name: getattr(thing, f.name) for f in fields(thing) if f.init and not _unsaid(thing, f)}
        if isinstance(thing, UserLaw):
            values["function"] = place_of(thing.function, where)
        return {"kind": name} | {
            key(n, declared.get(n)): field_entry(v, declared.get(n), f"{words(n)} of the {kind_words(type(thing))}")
            for n, v in values.items()
        }
    what = (
        kind_words(type(thing), article=True)
        if is_dataclass(thing) or not callable(thing)
        else "a function of one's own"
    )
    raise ValueError(f"the {where} is {what}, which no file can hold")


def _may_be_unsaid(of: Field[Any]) -> bool:
    return of.kw_only and of.name in UNSAID


def _unsaid(thing: object, of: Field[Any]) -> bool:
    value = getattr(thing, of.name)
    return _may_be_unsaid(of) and not np.ndim(value) and value in ("", 0.0)


def _declarations(kind: type) -> dict[str, Quantity | Choice]:
    """The declarations of a class by field; those of a program have no unit of their own, and stand in SI."""
    return {} if issubclass(kind, OF_PROGRAMS) else declarations(kind)


def _refuse_namesake(kind: type, read: type, where: str) -> None:
    """A class of one's own under the name of another, which a file would be read as."""
    if kind is not read:
        other = "camkit's" if _ours(read) else "another one of your own, made later"
        raise ValueError(
            f"the {where} is a {kind.__name__} of your own, which would be read again as {other}: give your class a "
            "name of its own, or make the thing anew"
        )


def field_entry(value: Any, declared: object, where: str) -> object:
    """The value of a field as JSON knows it: a number in the unit of its declaration, an option by its name."""
    if isinstance(declared, Quantity):
        if np.ndim(value):
            raise ValueError("this is a population; one design can be saved")
        return exact_in_unit(value, declared.unit)
    if isinstance(declared, Choice) and value in declared.options and not _has_fields(value):
        return declared.text(value)
    return entry_of(value, where)


def _has_fields(value: Any) -> bool:
    """Whether there is more to write of an option than its name, which may stand for another one day."""
    return type(value).__name__ in kinds() and bool(fields(value))


def kinds() -> dict[str, type]:
    """Every class that a file may name; of two with one name camkit's own, else the newest."""
    every = [*OF_PROGRAMS, FormError, *(kind for base in (Design, Law, *OF_PROGRAMS) for kind in _below(base))]
    known = [kind for kind in every if "__dataclass_fields__" in vars(kind) and not inspect.isabstract(kind)]
    return {k.__name__: k for k in sorted(known, key=_ours) if not k.__name__.startswith("_")}


def _below(kind: type) -> Iterator[type]:
    inner: type
    for inner in kind.__subclasses__():
        yield inner
        yield from _below(inner)


def _ours(kind: type) -> bool:
    return kind.__module__.partition(".")[0] == __name__.partition(".")[0]


@dataclass(frozen=True)
class Reading:
    """Reads the entries of one file; ``missing`` names the fields that took their default, ``remarks`` say more."""

    missing: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    renaming: Renaming = field(default_factory=Renaming)
    held: Counter[str] = field(default_factory=Counter)
    """How many entries one design has so far in lists that take long to work out."""

    def thing(self, entry: object, hint: object = object, most: int = MOST_ROWS) -> object:
        """What `entry_of` wrote; ``hint`` is the annotation of the field that it is for."""
        if isinstance(entry, list):
            most = min(most, MOST_THINGS) if any(isinstance(value, dict) for value in entry) else most
            if len(entry) > most:
                raise ValueError(f"the file has a list of {len(entry)} entries; there can be at most {most}")
            return tuple(self.thing(value) for value in entry)
        if not isinstance(entry, dict):
            return entry
        kind = self._kind(entry, hint)
        inner = {k: v for k, v in entry.items() if k != "kind"}
        where = kind.__name__ if is_earlier(kind.__name__, inner) else ""
        given = self.renaming.entries(where, inner)
        for before, today in fields_renamed(where).items():
            if not any(now in given or _says(entry, now) for now in today):
                self.missing.append(f"{before!r} of the {kind_words(kind)}")
        deeper = {k: g for k, g in given.items() if g.name != k and "." in k.partition(" [")[0]}
        _refuse_both(entry, deeper)
        values = self._fields(kind, {k: g for k, g in given.items() if k not in deeper}, deeper)
        try:
            with unremarked():  # a file's numbers have their units
                return self._with(kind(**values), deeper)
        except (TypeError, AttributeError, IndexError, ArithmeticError):
            raise ValueError(f"the file is damaged: no {kind_words(kind)} can be built of what it says") from None

    def _kind(self, entry: Mapping[str, object], hint: object) -> type:
        """The class that an entry names: a known one, or one that its field is annotated with."""
        known, name = kinds() | {k.__name__: k for k in _classes(hint)}, entry.get("kind")
        if not isinstance(name, str):
            said = (
                f"{shown(name)} for 'kind', where a name belongs"
                if "kind" in entry
                else f"{shown(entry)} without a kind"
            )
            raise ValueError(f"the file is damaged: it says {said}")
        now = name if name in known else self.renaming.name("kind", name)
        if now not in known:
            raise ValueError(f"the file names a {shown(name)}, which this camkit does not know")
        return known[now]

    def _with(self, thing: object, entries: Mapping[str, Given]) -> object:
        """``thing`` with what were fields of its own and stand deeper in it today, in the order of the file."""
        for k, given in entries.items():
            found = {key(path, declared): (path, declared) for path, declared in declared_in(thing).items()}
            if k in found:
                path, declared = found[k]
                value = self.declared(given, declared)
                try:
                    thing = with_quantities(thing, {path: value})
                except ValueError as refusal:
                    raise ValueError(f"the file says {shown(given.value)} for {given.name!r}: {refusal}") from None
            else:
                thing = self._plain(thing, k, given)
        return thing

    def _plain(self, thing: Any, path: str, given: Given) -> Any:
        """``thing`` with a field at ``path`` that is neither a quantity nor a choice, such as a table."""
        branch, _, below = path.partition(".")
        if below and branch in thing.branches():
            return thing.changed({branch: self._plain(thing.branches()[branch], below, given)})
        plain = {f.name: f for f in fields(thing) if f.init and not f.metadata}
        if path not in plain:
            raise _unknown(given.name, type(thing))
        kind: type = type(thing)
        return thing.changed({path: self._field(given, plain[path], None, _hints(kind)[path])})

    def _fields(self, kind: type, entries: Mapping[str, Given], deeper: Iterable[str]) -> dict[str, object]:
        declared = _declarations(kind)
        named = {key(f.name, declared.get(f.name)): f for f in fields(kind) if f.init}
        for wrong in entries.keys() - named.keys():
            raise _unknown(entries[wrong].name, kind)
        for lacking in [n for n, f in named.items() if n not in entries and not _may_be_unsaid(f)]:
            if not any(path.startswith(f"{lacking}.") for path in deeper):
                self.lacks(lacking, kind_words(kind), named[lacking])
        hints = _hints(kind)
        return {
            named[k].name: self._field(given, named[k], declared.get(named[k].name), hints.get(named[k].name, object))
            for k, given in entries.items()
        }

    def lacks(self, name: str, kind: str, of: Field[object]) -> None:
        """A field that is not in the file takes its default, if it has one."""
        if of.default is MISSING and of.default_factory is MISSING:
            raise ValueError(f"the file lacks {name!r} of the {kind}")
        self.missing.append(f"{name!r} of the {kind}")

    def _field(self, given: Given, of: Field[object], declared: object, hint: object) -> object:
        if isinstance(declared, (Quantity, Choice)):
            return self.declared(given, declared)
        if get_origin(hint) is Callable:
            return function_at(given.value)
        value = self.thing(given.value, hint, of.metadata.get("most", MOST_ROWS))
        if "in_all" in of.metadata and isinstance(given.value, list):
            self._count(len(given.value), *of.metadata["in_all"])
        if not fits(value, hint):
            raise ValueError(f"the file says {shown(given.value)} for {given.name!r}; {_wanted(hint)} belongs there")
        return value

    def declared(self, given: Given, declared: Quantity | Choice) -> object:
        """What a file gives for a quantity (SI) or a choice."""
        if isinstance(declared, Choice):
            return self._choice(given.value, given.name, declared)
        if not is_number(given.value):
            raise ValueError(f"the file says {shown(given.value)} for {given.name!r}; it must be {declared.possible}")
        return given.value * given.times * declared.factor + 0.0

    def _count(self, entries: int, what: str, most: int) -> None:
        """``entries`` more in lists of which a design can have ``most`` together, however many lists there are."""
        self.held[what] += entries
        if self.held[what] > most:
            raise ValueError(f"the file has more than {most} {what} in all; they would take too long to work out")

    def _choice(self, entry: object, name: str, declared: Choice) -> object:
        """An option by its name, or something of one's own that has all that the options have in common."""
        for name_of_it, option in declared.named.items():
            if name_of_it == entry or (type(option) is type(entry) and option == entry):
                return option
        value = self.thing(entry) if isinstance(entry, dict) else None
        if value is None or not declared.allows(value):
            raise ValueError(f"the file says {shown(entry)} for {name!r}; there are {declared.offered}")
        return value


def _unknown(name: str, kind: type) -> ValueError:
    return ValueError(f"the file has {shown(name)}, which {kind_words(kind, article=True)} does not have")


def _refuse_both(entry: Mapping[str, object], deeper: Mapping[str, Given]) -> None:
    """What stands both under an earlier name and, deeper in the file, where it stands today."""
    for path, given in deeper.items():
        if _says(entry, path):
            raise ValueError(f"the file has {shown(given.name)} and {shown(path)}, which are one and the same")


def _says(entry: object, path: str) -> bool:
    """Whether a file says what stands at ``path`` within ``entry``; of a program it says everything."""
    if not isinstance(entry, dict) or "segments" in entry:
        return isinstance(entry, dict)
    plain, bracket, unit = path.partition(" [")
    step, dot, below = plain.partition(".")
    return step in entry and _says(entry[step], below + bracket + unit) if dot else path in entry


def is_number(value: object) -> TypeGuard[float]:
    """Whether a file gives a number; true and false are none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


@lru_cache(maxsize=256)
def _hints(kind: type) -> dict[str, object]:
    """The annotations of a class; of one's own classes those that can be found out, ``Any`` being anything."""
    try:
        hints = get_type_hints(kind)
    except (NameError, TypeError, AttributeError):  # names that are no longer known where the class was made
        return {}
    return hints if _ours(kind) else {name: object if hint is Any else hint for name, hint in hints.items()}


def fits(value: object, hint: object) -> bool:
    """Whether a value of a file is of the kind that an annotation names; ``Any`` stands for a number.

    >>> fits(((0.0, 1.0),), tuple[tuple[float, float], ...]), fits(((),), tuple[tuple[float, float], ...])
    (True, False)
    """
    origin: object = get_origin(hint)
    inner = get_args(hint)
    if hint in (Any, float):
        return is_number(value)
    if hint in (int, bool, str, NoneType):
        return type(value) is hint
    if origin in (Union, UnionType):
        return any(fits(value, each) for each in inner)
    if origin is tuple and inner[-1:] != (...,):
        return isinstance(value, tuple) and len(value) == len(inner) and all(map(fits, value, inner))
    if origin in (tuple, list):
        return isinstance(value, tuple) and all(fits(each, inner[0]) for each in value)
    if hint in (tuple, list):
        return isinstance(value, tuple)
    return isinstance(hint, type) and isinstance(value, hint)


def _classes(hint: object) -> list[type]:
    """The classes of ours or one's own that an annotation names."""
    return [h for h in (hint, *get_args(hint)) if isinstance(h, type) and is_dataclass(h)]


def _wanted(hint: Any) -> str:
    """What an annotation names, in words."""
    said = {Any: "a number", float: "a number", int: "a whole number", bool: "true or false", str: "a text"}
    if isinstance(hint, type) and hint not in said and get_origin(hint) is None:
        return kind_words(hint, article=True)
    if get_origin(hint) is tuple and get_args(hint)[-1:] == (...,):
        inner = get_args(hint)[0]
        return "a list of pairs of numbers" if get_origin(inner) is tuple else "a list of values"
    options = [said[each] for each in get_args(hint) if each in said] if get_origin(hint) in (Union, UnionType) else []
    return said.get(hint, " or ".join(options) or "something else")
