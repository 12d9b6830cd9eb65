"""A design is a tree: the paths of the quantities and choices in it, their values, and other values for them.

``motion.rise.law.c0`` is the coefficient c0 of the law of the segment ``rise`` of the design's ``motion``.  A part
names its own quantities, whoever holds it; where their unit is the owner's business (the lift of a segment is a length
or an angle), or the letter of numbers in a row, the owner's field says so in its metadata ``says``.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cache
from types import MethodType
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np

from .declaration import Choice, Declared, Quantity
from .kinds import shown
from .markup import words

T = TypeVar("T")
"""A design, or a part of one."""
NEAR, FEW = 3, 12
"""So many paths near a wrong one are named, and as many as there are where they are few."""


class Leaf(NamedTuple):
    """A quantity or a choice where it stands: in a field, or ``at`` a place of a field that is a row."""

    declared: Quantity | Choice
    field: str
    at: int | None = None

    def value(self, part: Declared) -> Any:
        """What ``part`` has there."""
        held = getattr(part, self.field)
        return held if self.at is None else held[self.at]


@cache
def _lettered(declared: Quantity, letter: object) -> Quantity:
    """One number of a row, with another letter in its symbol; what owners say of fields that are no rows is none."""
    if not isinstance(letter, str):
        return declared
    return replace(declared, symbol=f"{letter}_{declared.symbol.partition('_')[2]}")


def _leaves(part: Declared, said: Mapping[str, Any]) -> dict[str, Leaf]:
    """The quantities and choices of one part by name; ``said``: what its owners say of fields that leave it to them."""
    found, own = {}, part.declares()
    for f in dataclasses.fields(part):
        if "declared" in f.metadata:
            by_owner = said.get(f.name) if f.metadata.get("by_owner") else None
            found[f.name] = Leaf(own.get(f.name) or by_owner or f.metadata["declared"], f.name)
        elif "row" in f.metadata:
            named = own.get(f.name) or f.metadata["row"]
            values = enumerate(getattr(part, f.name))
            rows = ((i, *named(i)) for i, v in values if v is not None)
            found |= {name: Leaf(_lettered(q, said.get(f.name)), f.name, i) for i, name, q in rows}
    return found


def _said(part: Declared, branch: str, said: Mapping[str, Any]) -> Mapping[str, Any]:
    """What the owners of a branch say."""
    more = (f.metadata.get("says", {}) for f in dataclasses.fields(part) if f.name == branch)
    return {**said, **next(more, {})}


def _walk(part: Declared, said: Mapping[str, Any]) -> Iterator[tuple[str, Leaf]]:
    """All below one part, in the order of its fields, with their paths from it."""
    leaves, branches, hidden = _leaves(part, said), part.branches(), part.following()
    own = [f.name for f in dataclasses.fields(part)]
    for name in (*(branch for branch in branches if branch not in own), *own):
        here = [(path, leaf) for path, leaf in leaves.items() if leaf.field == name]
        below = _walk(branches[name], _said(part, name, said)) if name in branches else ()
        for path, leaf in (*here, *((f"{name}.{path}", leaf) for path, leaf in below)):
            if path not in hidden:
                yield path, leaf


def a_design(design: object) -> Declared:
    """``design``; ``ValueError`` for what is no design, nor a part of one."""
    if not isinstance(design, Declared) or not dataclasses.is_dataclass(design):
        raise ValueError(f"the design is {shown(design)}; it must be a design, such as a cam, or a part of one")
    return design


def _leaves_of(design: object) -> dict[str, Leaf]:
    """All of a design by path, in order; ``ValueError`` for what is no design, nor a part of one."""
    return dict(_walk(a_design(design), {}))


def label(path: str, declared: Quantity | Choice) -> str:
    """What stands at a path is called where it is shown: by its path, or by the name of its declaration.

    A load, a motion and a law add nothing to a name, nor does what it begins with: "cam speed" of a cam; which of
    several it is they do.

    >>> from camkit import TranslatingRollerCam
    >>> quantities = quantities_of(TranslatingRollerCam())
    >>> [label(path, quantities[path]) for path in ("roller_radius", "load.mass", "motion.rise.angle")]
    ['roller radius', 'follower mass', 'motion rise angle']
    """
    name = declared.name if isinstance(declared, Quantity) else ""
    owners = [word for word in words(path.rpartition(".")[0]).split() if word not in ("load", "motion", "law")]
    said = owners[:-1] if owners and name.startswith(f"{owners[-1]} ") else owners
    return " ".join((*said, name)) if name else words(path)


def declared_in(design: object) -> dict[str, Quantity | Choice]:
    """The declarations of a design and of all that it holds, by path and in order."""
    return {path: leaf.declared for path, leaf in _leaves_of(design).items()}


def quantities_of(design: object) -> dict[str, Quantity]:
    """The numbers among them.

    >>> from camkit import TranslatingRollerCam
    >>> list(quantities_of(TranslatingRollerCam()))[:4]
    ['motion.rise.angle', 'motion.rise.lift', 'motion.dwell.angle', 'motion.return.angle']
    """
    return {path: declared for path, declared in declared_in(design).items() if isinstance(declared, Quantity)}


def choices_of(design: object) -> dict[str, Choice]:
    """The choices among them, such as a motion law, a follower or a direction of rotation."""
    return {path: declared for path, declared in declared_in(design).items() if isinstance(declared, Choice)}


def value_of(design: object, path: str) -> Any:
    """The value of a quantity (SI) or of a choice."""
    return Paths(design, (path,)).values(design)[0]


def with_quantities(design: T, values: Mapping[str, object]) -> T:
    """The design with other values by path: numbers, columns ``(p, 1)``, and options of choices or their names.

    All that changes in one part changes at once, and what its constructor refuses is refused.  Choices come first where
    they bring quantities; one that the changed design does not have is refused too.

    >>> from camkit import TranslatingRollerCam
    >>> from camkit.quantities import value_of
    >>> cam = with_quantities(TranslatingRollerCam(), {"motion.rise.law": "modified sine", "rotation": "clockwise"})
    >>> value_of(cam, "motion.rise.law").name, cam.rotation
    ('modified sine', -1)
    >>> with_quantities(cam, {"motion.rise.lifts": 0.02})
    Traceback (most recent call last):
        ...
    ValueError: 'motion.rise.lifts' is no path of TranslatingRollerCam; near it are motion.rise.lift, motion.rise.law, \
motion.rise.angle
    """
    if not isinstance(values, Mapping):
        raise ValueError(f"the values are {shown(values)}; they must be a mapping from paths to values")
    declared = declared_in(design)
    above = [p for p in values if any(str(other).startswith(f"{p}.") for other in values)]
    chosen = {p: v for p, v in values.items() if isinstance(declared.get(p), Choice)}
    if chosen and (above or not declared.keys() >= values.keys()):
        first = {p: v for p, v in chosen.items() if not any(p.startswith(f"{other}.") for other in above)}
        changed = Paths(design, first).put(design, list(first.values()))
        return with_quantities(changed, {p: v for p, v in values.items() if p not in first})
    changed = Paths(design, values).put(design, list(values.values()))
    if chosen:
        Paths(changed, values)  # a choice may have taken away one that was there
    return changed


@dataclass(frozen=True)
class _Change:
    """What is put into one part: at which place of the values each of its leaves stands, and what into its branches."""

    leaves: list[tuple[int, Leaf]] = field(default_factory=list)
    branches: dict[str, _Change] = field(default_factory=dict)

    def plan(self, path: str, place: int, leaf: Leaf) -> None:
        """Put the value at ``place`` into ``leaf``, which is at ``path`` from here."""
        branch, _, below = path.partition(".")
        if below:
            self.branches.setdefault(branch, _Change()).plan(below, place, leaf)
        else:
            self.leaves.append((place, leaf))

    def put(self, part: Any, values: Sequence[Any]) -> Any:
        """``part`` with the values."""
        changes: dict[str, Any] = {}
        for place, leaf in self.leaves:
            value = values[place]
            if isinstance(leaf.declared, Choice):
                value = leaf.declared.option(value)
            if leaf.at is not None:
                held = changes.get(leaf.field, getattr(part, leaf.field))
                value = (*held[: leaf.at], value, *held[leaf.at + 1 :])
            changes[leaf.field] = value
        if self.branches:
            branches = part.branches()
            changes |= {name: change.put(branches[name], values) for name, change in self.branches.items()}
        return part.changed(changes)


class Paths:
    """Some paths of a design, looked up once: to be read from and put into many designs of the same make.

    ``declared`` are their declarations in order.  Raises ``ValueError`` for a path that the design does not have.
    """

    def __init__(self, design: object, paths: Iterable[str], kind: type = object) -> None:
        if isinstance(paths, str) or not isinstance(paths, Iterable):
            raise ValueError(f"the paths are {shown(paths)}; they must be a tuple of paths")
        self._kind = type(design)
        every = {p: leaf for p, leaf in _leaves_of(design).items() if isinstance(leaf.declared, kind)}
        self.declared: dict[str, Any] = {}
        self._change, self._leaves = _Change(), []
        for place, path in enumerate(paths):
            if not isinstance(path, str) or path not in every:
                raise ValueError(_unknown(design, path, every, kind))
            self.declared[path] = every[path].declared
            self._change.plan(path, place, every[path])
            self._leaves.append((path.split(".")[:-1], every[path]))

    def values(self, design: object) -> list[Any]:
        """The values that ``design`` has; ``ValueError`` for one of another kind, or one that lacks a path."""
        if not isinstance(design, self._kind):
            raise ValueError(f"the design is {shown(design)}; it must be a {self._kind.__name__}")
        for path, why in ((path, _followed(design, path)) for path in self.declared):
            if why:
                raise ValueError(f"{shown(path)} is no path of this {type(design).__name__}: {why}")
        try:
            return [leaf.value(_part(design, way)) for way, leaf in self._leaves]
        except (AttributeError, LookupError):
            paths = ", ".join(self.declared)
            raise ValueError(f"this {type(design).__name__} is made in another way: it lacks one of {paths}") from None

    def put(self, design: T, values: Sequence[object]) -> T:
        """``design``, of the same make, with other values in the order of the paths."""
        return cast(T, self._change.put(design, values)) if self._leaves else design


def _part(design: Any, way: Sequence[str]) -> Any:
    for branch in way:
        design = design.branches()[branch]
    return design


def _unknown(design: object, path: object, known: Iterable[str], kind: type) -> str:
    """Why a path is refused, in a sentence."""
    what = {Quantity: "quantity", Choice: "choice"}.get(kind, "path")
    said = f"{shown(path)} is no {what} of {type(design).__name__}"
    if isinstance(path, str) and (why := _followed(design, path)):
        return f"{said}: {why}"
    paths = list(known)
    near = get_close_matches(path, paths, NEAR, 0.5) if isinstance(path, str) else []
    if near:
        return f"{said}; near it are {', '.join(near)}"
    return f"{said}; there are {', '.join(paths[:FEW])}" + f" and {len(paths) - FEW} more" * (len(paths) > FEW)


def _followed(design: Any, path: str) -> str:
    """Why the quantity at ``path`` follows from others, if it does."""
    part, way = design, path.split(".")
    for i, branch in enumerate(way):
        if why := part.following().get(".".join(way[i:])):
            return str(why)
        part = part.branches().get(branch)
        if not isinstance(part, Declared):
            break
    return ""


def members(value: Any, rows: np.ndarray | Sequence[int]) -> Any:
    """Some members of a population: ``value`` with those rows of every column in it; what all share stays.

    >>> members((1.0, np.array([[2.0], [3.0], [4.0]])), [2, 0])
    (1.0, array([[4.],
           [2.]]))
    """
    if isinstance(value, np.ndarray):
        return value[rows] if value.ndim == 2 else value
    if isinstance(value, tuple):
        return tuple(members(part, rows) for part in value)
    if isinstance(value, MethodType):
        return MethodType(value.__func__, members(value.__self__, rows))
    if not dataclasses.is_dataclass(value) or isinstance(value, type):
        return value
    some = object.__new__(type(value))
    some.__dict__.update({f.name: members(getattr(value, f.name), rows) for f in dataclasses.fields(value)})
    return some
