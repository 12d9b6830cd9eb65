"""What a study may free: quantities between bounds, and menus of options.

A menu is at one path, or at several that move together; each of its options has a value for every path.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from ..quantities import Choice, Declared, Paths, Quantity, declared_in, value_of, with_quantities, words
from ..quantities.kinds import number, shown
from ..quantities.tree import a_design
from ..quantities.types import Array

Free = Mapping[Any, Any]
"""What is free by path: bounds, or options of a menu."""


def is_number(value: object) -> bool:
    """Whether ``value`` is one number."""
    known = number(value)
    return known is not None and np.ndim(known) == 0


def refuse_bounds(declared: Mapping[str, Quantity], space: Mapping[str, Any]) -> None:
    """``ValueError`` in a sentence for bounds that are no two possible numbers, the first below the second."""
    for name, bounds in space.items():
        ordered = isinstance(bounds, (tuple, list)) or np.ndim(bounds) == 1
        if not ordered or len(bounds) != 2 or not all(map(is_number, bounds)):
            sizes = "; sizes to choose from stand in braces" if ordered and len(bounds) > 2 else ""
            raise ValueError(f"the bounds of the {words(name)} are {shown(bounds)}; they must be two numbers{sizes}")
        _check_bounds(name, declared[name], *bounds)


def _check_bounds(name: str, declared: Quantity, low: float, high: float) -> None:
    told = f"the bounds of the {words(name)} are {declared.text(low)} and {declared.text(high)}"
    if not (np.isfinite([low, high]).all() and low < high):
        raise ValueError(f"{told}; they must be finite, the first below the second")
    if not (declared.allows(low) and declared.allows(high)):
        possible = declared.possible_for(low if declared.allows(high) else high)
        raise ValueError(f"{told}; each must be {possible}")
    declared.remark(name, float(low))
    declared.remark(name, float(high))


@dataclass(frozen=True)
class Menu:
    """A menu that a study frees: options by their ``names``, each a value (SI) or an option for every one of ``paths``.

    Among free values it is the place of an option, from 0 in the order of the menu: a number without a unit, whose
    ``text`` is the option's name.
    """

    paths: tuple[str, ...]
    names: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]
    of_sizes: bool
    """Whether all paths are quantities."""

    unit: ClassVar[str] = ""
    factor: ClassVar[float] = 1.0

    @property
    def name(self) -> str:
        """How a study names it: by its paths."""
        return ", ".join(self.paths)

    symbol = name

    @property
    def options(self) -> dict[str, tuple[Any, ...]]:
        """The values of the options, by their names."""
        return dict(zip(self.names, self.values, strict=True))

    @property
    def meaning(self) -> str:
        """Its options."""
        return f"one of {', '.join(self.names)}"

    @cached_property
    def sizes(self) -> Array | None:
        """Its values ``(n_options, n_paths)``, SI, of a menu of sizes."""
        return np.array(self.values, dtype=float) if self.of_sizes else None

    def text(self, place: Any) -> str:
        """The name of the option at a place."""
        return self.names[int(np.clip(np.rint(float(place)), 0, len(self.names) - 1))]

    def nearest(self, values: Array) -> Array:
        """The places of the options that are nearest to ``values`` ``(p, n_paths)`` of their numbers, ``(p,)``."""
        assert self.sizes is not None
        scale = np.abs(self.sizes).max(0)
        away = (values[:, None] - self.sizes) / np.where(scale > 0, scale, 1)
        return np.asarray((away**2).sum(-1).argmin(1))

    def place_of(self, design: object, free: Iterable[str]) -> int:
        """The place of the option that ``design`` has, whatever it has for what is ``free`` in it.

        Of numbers the nearest; else the first where it has none of them.
        """
        known = declared_in(design)
        if not known.keys() >= {*self.paths}:
            return 0
        here = [value_of(design, path) for path in self.paths]
        if self.sizes is not None:
            return int(self.nearest(np.array([here], dtype=float))[0])
        below = [[name.removeprefix(f"{p}.") for name in free if name.startswith(f"{p}.")] for p in self.paths]
        for place, option in enumerate(self.values):
            if all(map(_alike, here, option, below)):
                return place
        return 0


def _alike(value: Any, option: Any, free: Sequence[str]) -> bool:
    """Whether ``value`` is the option but for what is free in it."""
    if isinstance(option, Declared) and type(value) is type(option):
        same = [path for path in free if path in declared_in(option) and path in declared_in(value)]
        value = with_quantities(value, {path: value_of(option, path) for path in same})
    return bool(value == option)


def freed(start: object, given: Free | Sequence[Any]) -> dict[str, tuple[float, float] | Menu]:
    """What a study frees, in order: the bounds of quantities, and menus; ``ValueError`` in a sentence for what is none.

    A tuple of paths stands for ranges as they are declared, and for the options of menus with which the parts of the
    design go together: a half law that would strike at a dwell is tried where it is named.  A quantity has two bounds,
    or a set of sizes; a choice has a tuple of options; both may have a mapping from names to options.  A tuple of paths
    that move together has options with a value for each of them, or with one for all.
    """
    for name in given:
        if not all(isinstance(path, str) for path in (name if isinstance(name, tuple) else (name,))):
            raise ValueError(f"the study frees {shown(name)}; it must be a path, or a tuple of paths")
    wanted = given if isinstance(given, Mapping) else dict.fromkeys(given)
    free: dict[str, Any] = {}
    menus: list[Menu] = []
    for key, value in wanted.items():
        paths = value.paths if isinstance(value, Menu) else key if isinstance(key, tuple) else (key,)
        if not paths or len({*paths}) < len(paths):
            raise ValueError(f"the study frees {shown(key)}; it must be paths, each of them once")
        declared = declared_with(start, menus, paths)
        if len(paths) == 1 and isinstance(declared[paths[0]], Quantity) and not isinstance(value, (Menu, Mapping, set)):
            quantity = declared[paths[0]]
            bounds = (quantity.low * quantity.factor, quantity.high * quantity.factor) if value is None else value
            refuse_bounds(declared, {key: bounds})
            free[key] = (float(bounds[0]), float(bounds[1]))
        else:
            value = _suited(start, declared) if value is None else value
            menus.append(value if isinstance(value, Menu) else _menu(declared, value))
            free[menus[-1].name] = menus[-1]
    every = [path for name, value in free.items() for path in (value.paths if isinstance(value, Menu) else (name,))]
    for path in (path for i, path in enumerate(every) if path in every[:i]):
        raise ValueError(f"the study frees {shown(path)} twice; each quantity can be free once")
    return free


def declared_with(start: object, menus: Iterable[Menu], paths: Sequence[str]) -> dict[str, Any]:
    """The declarations of ``paths`` in ``start``, or in what an option of one of the ``menus`` makes of it."""
    found = declared_in(start)
    if not found.keys() >= {*paths}:
        found = {**brought_by(start, menus), **found}
    for path in paths:
        if path not in found:
            Paths(start, (path,), Quantity)  # refuses it
    return {path: found[path] for path in paths}


def brought_by(start: object, menus: Iterable[Menu]) -> dict[str, Any]:
    """The declarations of what options of ``menus`` make of ``start``, by path."""
    found: dict[str, Any] = {}
    for menu in menus:
        for option in () if menu.of_sizes else menu.values:
            with suppress(ValueError):  # an option that this start cannot have
                found |= declared_in(with_quantities(start, dict(zip(menu.paths, option, strict=True))))
    return found


def _menu(declared: Mapping[str, Any], given: Any) -> Menu:
    """A menu at some paths, of options as `freed` takes them."""
    paths = tuple(declared)
    told = words(", ".join(paths))
    if isinstance(given, (set, frozenset)):
        given = sorted(given) if all(map(is_number, given)) else [*given]
    if not isinstance(given, (Mapping, Sequence, np.ndarray)) or isinstance(given, str):
        raise ValueError(f"the options of the {told} are {shown(given)}; they must be a tuple of options, or be named")
    if not len(given):
        raise ValueError(f"there is no option of the {told}; there must be one or more")
    options: dict[str, tuple[Any, ...]] = {}
    for wanted in given:
        option = _option(declared, given[wanted] if isinstance(given, Mapping) else wanted)
        name = str(wanted) if isinstance(given, Mapping) else _named(declared, option)
        if option in options.values():
            raise ValueError(f"{shown(name)} is twice among the options of the {told}; each can be there once")
        if name in options:
            raise ValueError(f"two options of the {told} are called {shown(name)}; give them names: {{name: option}}")
        options[name] = option
    of_sizes = all(isinstance(d, Quantity) for d in declared.values())
    return Menu(paths, tuple(options), tuple(options.values()), of_sizes)


def _suited(start: object, declared: Mapping[str, Any]) -> dict[str, Any] | None:
    """The options of a menu with which the parts of ``start`` go together, by name; all where none of them does."""
    first = next(iter(declared.values()))
    if not isinstance(first, Choice):
        return None
    return {name: option for name, option in first.named.items() if _suits(start, declared, option)} or first.named


def _suits(start: object, paths: Iterable[str], option: Any) -> bool:
    """Whether the parts of ``start`` go together with an option; what it cannot have is left to the study."""
    with suppress(ValueError):
        return _go_together(a_design(with_quantities(start, dict.fromkeys(paths, option))))
    return True


def _go_together(part: Declared) -> bool:
    """Whether a part, and each that it holds, says of what it is made of that this is ``suited`` to each other."""
    suited = getattr(part, "suited", None)
    return (suited is None or suited()) and all(map(_go_together, part.branches().values()))


def _option(declared: Mapping[str, Any], given: Any) -> tuple[Any, ...]:
    """One option: a value for each path, or one for all."""
    several = isinstance(given, (tuple, list, np.ndarray)) and len(declared) > 1
    values = [*given] if several else [given] * len(declared)
    if len(values) != len(declared):
        raise ValueError(
            f"the option {shown(given)} has {len(values)} values for the {words(', '.join(declared))}; "
            f"it must have {len(declared)}, or one for all"
        )
    return tuple(_value(path, d, v) for (path, d), v in zip(declared.items(), values, strict=True))


def _value(path: str, declared: Quantity | Choice, given: Any) -> Any:
    if isinstance(declared, Choice):
        option = declared.option(given)
        if not declared.allows(option) or (isinstance(option, str) and option not in declared.options):
            raise ValueError(f"{shown(given)} is no option of the {words(path)}; there are {declared.offered}")
        return declared.same_as(option)
    if not is_number(given) or not declared.allows(given):
        value = declared.text(given) if is_number(given) else shown(given)
        raise ValueError(f"one option of the {words(path)} is {value}; it must be {declared.possible}")
    declared.remark(path, float(given))
    return float(given)


def _named(declared: Mapping[str, Any], option: tuple[Any, ...]) -> str:
    texts = [d.text(v) for d, v in zip(declared.values(), option, strict=True)]
    return " x ".join(dict.fromkeys(texts) if len({*texts}) == 1 else texts)
