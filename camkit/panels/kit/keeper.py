"""`Keeper`: keeps what a person did last in a panel, and offers what they did there before.

It is told so by a page alone: a notebook that is run without one neither reads nor writes a file.
"""

from __future__ import annotations

import uuid
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

from ...files import designs
from ...quantities import declared_in, value_of, words
from ...quantities.kinds import shown
from ...search.checkpoint import why
from .changes import alike, numbers_of, with_numbers
from .kept_designs import MOST, MOST_NAMED, KeptDesigns, Last, file_of, notebook, published, read, update
from .running import Place, here

TOLD = 2
"""How many quantities an offer names."""
LONGEST_NAME = 60
_made: Counter[tuple[Place, str]] = Counter()
"""Panels of each run of a cell, by what they show."""


class Kept(Protocol):
    """A panel whose designs are kept."""

    start: Any
    design: Any
    page: dict[str, object]
    """How the page stands beside its design, which the page alone reads."""
    message: str

    def load(self, design: object) -> None:
        """Show a design, or say why not."""

    def send(self, content: Mapping[str, object]) -> None:
        """To the page."""


class Keeper:
    """What a person did last in ``panel``, and the designs they named, kept from the first time its page speaks."""

    def __init__(self, panel: Kept) -> None:
        self._panel, self._id, self.live = panel, uuid.uuid4().hex, False
        self.file = _file_for(type(panel.start))
        self.offers: list[tuple[Last, Any]] = []
        self._answered: set[str] = set()
        self.named: dict[str, Any] = {}
        """Designs by name."""
        self._said = ""

    def answer(self, asked: object) -> None:
        """``hello`` when a page opens, ``continue`` or not; of a name ``keep``, ``rename``, ``forget`` or ``show``."""
        for what, act in self._answers.items():
            if isinstance(asked, Mapping) and what in asked:
                try:
                    act(asked[what])
                finally:  # the page hears what there is, whatever is refused
                    self._tell()
                return
        raise ValueError(f"the page asks {shown(asked)}, which nobody knows here")

    @property
    def _answers(self) -> Mapping[str, Callable[[Any], object]]:
        return {
            "hello": lambda _: self._hello(),
            "continue": self._continue,
            "keep": lambda asked: self._keep_as(*asked),
            "rename": lambda names: self._rename(*names),
            "forget": self._forget,
            "show": lambda name: self._panel.load(self._known(name)),
        }

    def keep(self) -> None:
        """The design that is shown is what a person did last, if there is a page."""
        self._update(lambda kept: replace(kept, last=self._with_last(kept.last)))

    def _with_last(self, others: tuple[Last, ...]) -> tuple[Last, ...]:
        mine = Last(self._id, designs.to_json(self._panel.design), self._panel.page)
        return (mine, *(last for last in self._unanswered(others) if last.panel != self._id))[:MOST]

    def _unanswered(self, others: tuple[Last, ...]) -> tuple[Last, ...]:
        return tuple(last for last in others if last.panel not in self._answered)

    def _update(self, change: Callable[[KeptDesigns], KeptDesigns]) -> None:
        if self.live:
            self._safely(lambda: update(self.file, change))

    def _safely(self, act: Callable[[], object]) -> None:
        """What goes wrong with a file is said once, and stops nothing."""
        try:
            act()
        except OSError as error:
            self._say(f"Your last design is not kept: {why(error)}.")
        except ValueError as error:
            self._say(f"Your last design is not kept: {error}.")

    def _say(self, sentence: str) -> None:
        if sentence != self._said:
            self._panel.message = self._said = sentence

    # ------------------------------------------------------------ what the page asks

    def _hello(self) -> None:
        """The first page finds what was kept; every page hears of it."""
        if not self.live and not published():
            self.live = True
            self._safely(self._find)

    def _find(self) -> None:
        kept, panel = read(self.file), self._panel
        self.named = {name: found for name, text in kept.named.items() if (found := self._read(text))} | self.named
        known = ((last, self._read(last.design)) for last in kept.last)
        self.offers = [(last, found) for last, found in known if found is not None and found != panel.start]

    def _read(self, text: str) -> Any:
        """The design of a file, or nothing where it is damaged or of another kind."""
        try:
            return designs.from_json(text, type(self._panel.start))
        except ValueError as refusal:
            self._say(f"A design that was kept here cannot be used: {refusal}.")

    def _tell(self) -> None:
        offer = f"Continue with your last design, {self._differs(self.offers[0][1])}?" if self.offers else ""
        self._panel.send({"offer": offer, "named": self._known_here})

    @property
    def _known_here(self) -> list[tuple[str, list[float] | None]]:
        """Each name, and the quantities of its design if the page can show it by them alone."""
        now = self._panel.design
        return [(name, [*numbers_of(d).values()] if alike(now, d) else None) for name, d in self.named.items()]

    @property
    def alike(self) -> list[tuple[str, list[float] | None]]:
        """Named designs that differ from the one shown in their quantities alone."""
        return [(name, values) for name, values in self._known_here if values is not None]

    def _differs(self, design: object) -> str:
        """What a design has otherwise than the one that the panel began with."""
        start, told = self._panel.start, []
        for path, declared in declared_in(design).items():
            value: Any = value_of(design, path)
            if path not in declared_in(start) or value_of(start, path) != value:
                told.append(f"{words(path)} {declared.text(value)}")
        more = f" and {len(told) - TOLD} more" if len(told) > TOLD else ""
        return f"{', '.join(told[:TOLD])}{more}" or "of another make"

    def _continue(self, yes: object) -> None:
        """Go on with what is offered, or refuse it for good; what cannot be shown stays offered."""
        if not self.offers:
            return
        last, design = self.offers[0]
        if yes:
            self._panel.load(design)
            if self._panel.design != design:
                return
        self._answered.add(last.panel)
        if yes:
            self.offers.clear()
            self._panel.page = dict(last.page)
            self._panel.send({"stand": last.page})
        else:
            self.offers.pop(0)
            self._update(lambda kept: replace(kept, last=self._unanswered(kept.last)))

    def _known(self, name: object) -> Any:
        if name not in self.named:
            raise ValueError(f"no design is called {shown(name)} here; there are {', '.join(self.named) or 'none'}")
        return self.named[str(name)]

    def _keep_as(self, name: object, values: Sequence[float]) -> None:
        """The design with these values of its quantities: those of the page, which may be newer than the panel's."""
        kept = self._name(name)
        if len(self.named) >= MOST_NAMED and kept not in self.named:
            raise ValueError(f"{MOST_NAMED} designs have a name, and no more can be kept; remove one first")
        design = with_numbers(self._panel.design, values)
        design.analyse()  # what cannot be built is not kept
        self._put({**self.named, kept: design})

    def _rename(self, old: object, name: object) -> None:
        self._known(old)
        if (new := self._name(name)) in self.named:
            raise ValueError(f"another design is called {shown(new)} already")
        self._put({new if n == old else n: design for n, design in self.named.items()})

    def _name(self, name: object) -> str:
        if not isinstance(name, str) or not name.strip() or len(name) > LONGEST_NAME:
            raise ValueError(f"{shown(name)} is no name for a design; it has up to {LONGEST_NAME} letters")
        return name

    def _forget(self, name: object) -> None:
        self._known(name)
        self._put({n: design for n, design in self.named.items() if n != name})

    def _put(self, named: dict[str, Any]) -> None:
        """Other names; what another kernel has changed in the file stays."""
        gone = self.named.keys() - named.keys()
        fresh = {n: designs.to_json(design) for n, design in named.items() if design is not self.named.get(n)}
        self.named = named
        self._update(lambda kept: replace(kept, named={n: t for n, t in kept.named.items() if n not in gone} | fresh))


def _file_for(kind: type) -> Path:
    """Of a panel that is made now: the first of its kind in this run of its cell, or the second, and so on."""
    place = here()
    _made[place, kind.__name__] += 1
    return file_of(kind.__name__, notebook(), place.cell, str(_made[place, kind.__name__]))
