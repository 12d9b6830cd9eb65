"""The plain studies behind one that frees menus: one for each combination of options.

A row of free values has a column for each quantity and each menu.  A quantity that the chosen options do not have, such
as a coefficient of another law, is no variable then: its column holds the middle of its bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from ..quantities import Analysable, D, Design, Measure, declared_in, value_of, with_quantities, words
from ..quantities.types import Array
from .free import Menu

if TYPE_CHECKING:
    from .study import Evaluation, Study

Places = tuple[int | None, ...]
"""The place of an option in each menu; of a menu of sizes it may be left open."""
S = TypeVar("S", bound="Study[Any]")


@dataclass(frozen=True)
class Plain(Generic[S]):
    """The study of some options: what is free besides them.  ``why`` says why they cannot be studied, if so."""

    study: S
    names: dict[str, str]
    """The options by their menus; menus that the design does not have with them are left out."""
    row: Array
    """Free values of the whole study where this one has none, ``(n_free,)``."""
    columns: Array
    """Which of the whole study's columns the free quantities of this one are, ``(n,)``."""
    open: tuple[tuple[int, Menu], ...]
    """The menus whose sizes are free, with their columns; their quantities come last."""
    why: str = ""

    @property
    def name(self) -> str:
        """What it is called among others."""
        return ", ".join(self.names.values())

    def x(self, rows: Array) -> Array:
        """Its free values of rows ``(p, n_free)`` of the whole study."""
        sizes = (menu.sizes[rows[:, at].astype(int)] for at, menu in self.open if menu.sizes is not None)
        return np.hstack([rows[:, self.columns], *sizes])

    def rows(self, x: Array) -> Array:
        """Rows of the whole study of its free values ``(p, n)``."""
        rows = np.tile(self.row, (len(x), 1))
        rows[:, self.columns] = x[:, : len(self.columns)]
        at = len(self.columns)
        for column, menu in self.open:
            rows[:, column] = menu.nearest(x[:, at : at + len(menu.paths)])
            at += len(menu.paths)
        return rows


class Options(Generic[S]):
    """The options of a study's menus."""

    def __init__(self, study: S) -> None:
        self.study = study
        self.menus = {i: menu for i, menu in enumerate(study.free.values()) if isinstance(menu, Menu)}
        self._made: dict[Places, Plain[S]] = {}

    @property
    def count(self) -> int:
        """How many combinations of options there are."""
        return prod(len(menu.names) for menu in self.menus.values())

    def each(self) -> Iterator[Plain[S]]:
        """The study of each combination of options; one where some make no difference."""
        for places in product(*(range(len(menu.names)) for menu in self.menus.values())):
            made = self.plain(places)
            if all(place == made.row[i] for place, i in zip(places, self.menus, strict=True)):
                yield made

    def at(self, x: Array) -> Plain[S]:
        """The study of the options of one design ``(n_free,)``."""
        row = self.settled(x[None])[0]
        return self.plain(tuple(int(row[i]) for i in self.menus))

    def plain(self, places: Places) -> Plain[S]:
        """The study of the options at some places."""
        if places not in self._made:
            self._made[places] = self._plain(places)
        return self._made[places]

    def _plain(self, places: Places) -> Plain[S]:
        study, names, why, open_ = self.study, {}, "", []
        design, row = study.start, self._middle.copy()
        try:
            for place, (i, menu) in zip(places, self.menus.items(), strict=True):
                if not declared_in(design).keys() >= {*menu.paths}:
                    continue
                if place is None:
                    open_.append((i, menu))
                else:
                    name, option = menu.names[place], menu.values[place]
                    row[i], names[menu.name] = place, name
                    design = with_quantities(design, dict(zip(menu.paths, option, strict=True)))
            design = ready(design, study.free)
        except ValueError as refusal:
            why = str(refusal)
        known = declared_in(design)
        free = {name: b for name, b in study.free.items() if not isinstance(b, Menu) and name in known}
        columns = np.array([i for i, name in enumerate(study.free) if name in free], dtype=int)
        for _, menu in open_:
            assert menu.sizes is not None
            free |= dict(zip(menu.paths, zip(menu.sizes.min(0), menu.sizes.max(0), strict=True), strict=True))
        made = Plain(study, names, row, columns, tuple(open_), why)
        return replace(made, study=study.as_plain(design, free, made))

    @cached_property
    def _middle(self) -> Array:
        """The middle of the bounds, and the first option of each menu."""
        return np.array([0.0 if isinstance(b, Menu) else sum(b) / 2 for b in self.study.free.values()])

    def groups(self, rows: Array) -> Iterator[tuple[Array, Plain[S]]]:
        """Rows ``(p, n_free)`` with the same options: which they are, and their study; sizes make no difference."""
        apart = [i for i, menu in self.menus.items() if menu.sizes is None]
        places, group = np.unique(rows[:, apart].astype(int), axis=0, return_inverse=True)
        for number, place in enumerate(places):
            chosen = dict(zip(apart, place.tolist(), strict=True))
            yield np.flatnonzero(group.ravel() == number), self.plain(tuple(map(chosen.get, self.menus)))

    def settled(self, x: Array) -> Array:
        """``x`` ``(p, n_free)`` with every place whole and within its menu, and with nothing of what is no variable."""
        rows = x.copy()
        for i, menu in self.menus.items():
            rows[:, i] = np.clip(np.rint(np.nan_to_num(x[:, i])), 0, len(menu.names) - 1)
        for at, made in self.groups(rows):
            kept = [*made.columns, *(i for i, _ in made.open)]
            settled = np.tile(made.row, (len(at), 1))
            settled[:, kept] = rows[np.ix_(at, kept)]
            rows[at] = settled
        return rows

    def one(self, rows: Array) -> tuple[Plain[S], Array]:
        """The study of rows that have the same options, and its free values; ``ValueError`` if they have different."""
        groups = [made for _, made in self.groups(rows)]
        if len(groups) != 1:
            raise ValueError("the designs have different options and are no one population; take them one by one")
        if groups[0].why:
            raise ValueError(f"with {groups[0].name} there is no such design: {groups[0].why}")
        return groups[0], groups[0].x(rows)

    def evaluate(self, rows: Array) -> Evaluation:
        """Objectives and limits of designs ``(p, n_free)``, one call for those with the same options."""
        from .study import Evaluation

        def judged(study: S, x: Array) -> Array:
            found = study.evaluate(x)
            return np.hstack([found.f, found.g])

        n = len(self.study.minimise)
        told = self.table(rows, n + len(self.study.limits), judged, np.inf)
        return Evaluation(rows, told[:, :n], told[:, n:])

    def table(self, rows: Array, columns: int, of: Callable[[S, Array], Array], lacking: float) -> Array:
        """What plain studies say ``of`` rows ``(p, n_free)``, ``(p, columns)``; ``lacking`` of what is no design."""
        found = np.full((len(rows), columns), lacking)
        for at, made in self.groups(rows):
            with suppress(ValueError):  # what cannot be built with these options is infeasible
                found[at] = lacking if made.why else of(made.study, made.x(rows[at]))
        return found

    def x_of(self, design: Analysable) -> Array:
        """The free values of a design, ``(n_free,)``."""
        known, x = declared_in(design), self._middle.copy()
        for i, (name, free) in enumerate(self.study.free.items()):
            if isinstance(free, Menu):
                x[i] = free.place_of(design, self.study.free)
            elif name in known:
                x[i] = value_of(design, name)
        return self.settled(x[None])[0]


def measured(study: Study, measures: Sequence[Measure], x: Array) -> Array:
    """What measures say of ``p`` designs ``(p, n_free)``, ``(p, n_measures)``, SI; ``nan`` of what is no design."""
    if study.menus:
        return study.options.table(study.rows(x), len(measures), lambda made, x: measured(made, measures, x), np.nan)
    analysis = study.analysis(x) if len(measures) else None
    values = [np.broadcast_to(np.asarray(m(analysis), dtype=float), len(x)) for m in measures]
    return np.stack(values, axis=-1) if values else np.zeros((len(x), 0))


def refuse_menus(study: Study[Any], what: str) -> None:
    """``ValueError`` in a sentence if the study frees a menu, which ``what`` cannot take."""
    for menu in study.menus:
        raise ValueError(f"the {words(menu.name)} is free as a menu; {what} takes quantities between bounds alone")


def ready(design: D, free: Iterable[Any]) -> D:
    """``design`` made ready for free paths, but for those below a menu that is free; see `Design.ready_for`."""
    paths = [p for name in free for p in (name if isinstance(name, tuple) else str(name).split(", "))]
    own = [path for path in paths if not any(path.startswith(f"{owner}.") for owner in paths)]
    return design.ready_for(own) if isinstance(design, Design) else design


def copied(study: S, start: Any, free: Any) -> S:
    """``study`` of another start that frees something else, perhaps nothing."""
    made = object.__new__(type(study))
    known = {f.name: getattr(study, f.name) for f in fields(study)}
    made.__dict__.update(known | {"start": start, "free": free})
    return made
