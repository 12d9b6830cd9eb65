"""What stands on a sheet: words, tables, buttons, rows.  Each part is data; the page draws it and says what is done.

A part is no widget: a sheet with hundreds of them is one widget.  What a part shows are its traits that are tagged for
the page; what a person does reaches `Part.take`.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypedDict

import traitlets

NUMBERS = itertools.count()
"""Every part of a kernel has its own."""

Piece = str | Mapping[str, object]
"""Words, or some that look otherwise: ``{"words": "kept", "look": "bold"}``, or behind a bar in the colour of a
series: ``{"words": "design 3", "series": 3}``."""
Line = Piece | Sequence[Piece]


class Message(TypedDict, total=False):
    """What the page says of a part."""

    part: int
    count: int
    value: Any
    does: str
    view: int
    at: Sequence[float]
    pixel: Sequence[float]
    buffers: Sequence[memoryview]


class Part(traitlets.HasTraits):
    """One thing on a sheet."""

    kind = ""
    visible = traitlets.Bool(True).tag(page=True)
    tooltip = traitlets.Unicode("").tag(page=True)

    def __init__(self, **given: object) -> None:
        self.number = next(NUMBERS)
        self.changed: Callable[[], None] = lambda: None
        super().__init__(**given)

    def notify_change(self, change: traitlets.Bunch) -> None:
        """Whoever observes hears of it, and so does the page."""
        super().notify_change(change)
        self.changed()

    def described(self) -> dict[str, object]:
        """What the page shows, as plain JSON."""
        shown = {name: getattr(self, name) for name in self.trait_names(page=True)}
        return {"kind": self.kind, "id": self.number, **shown}

    def inside(self) -> Iterator[Part]:
        """This part and all that stand in it."""
        yield self

    def take(self, message: Message) -> None:
        """What a person has done with it."""


class Words(Part):
    """Lines of text; a ``role`` of "status" is read aloud when there is time, of "alert" at once."""

    kind = "words"
    value = traitlets.List().tag(page=True)  # type: ignore[var-annotated]
    look = traitlets.Unicode("").tag(page=True)
    role = traitlets.Unicode("").tag(page=True)

    def say(self, *lines: Line) -> None:
        """Other lines; those that are empty are left out."""
        self.value = [line for line in lines if line]

    @property
    def text(self) -> str:
        """The lines as plain text."""
        return "\n".join(map(plain, self.value))


class Banner(Words):
    """A sentence that appears when something is impossible; empty otherwise."""

    def __init__(self) -> None:
        super().__init__(look="banner", role="alert", visible=False)

    def show_message(self, sentence: str, role: str = "alert") -> None:
        """Show ``sentence``, or nothing."""
        self.role = role
        self.say(sentence)
        self.visible = bool(sentence)


class Table(Part):
    """Rows of cells under a head; a cell is a text, looks otherwise (see `Piece`), or is a list of such pieces."""

    kind = "table"
    head = traitlets.List().tag(page=True)  # type: ignore[var-annotated]
    rows = traitlets.List().tag(page=True)  # type: ignore[var-annotated]

    def put(self, head: Sequence[object] = (), rows: Sequence[Sequence[object]] = ()) -> None:
        """Another table; without a head there is none to see."""
        self.head = [_cell(cell) for cell in head]
        self.rows = [[_cell(cell) for cell in row] for row in rows]

    @property
    def text(self) -> str:
        """The rows as plain text, cells parted by two blanks."""
        return "\n".join("  ".join(map(plain, row)) for row in (self.head, *self.rows))


class Progress(Part):
    """How far something is: ``value`` of ``max``."""

    kind = "progress"
    value = traitlets.Int(0).tag(page=True)
    max = traitlets.Int(1).tag(page=True)


class Button(Part):
    """Pressing it calls ``act()``."""

    kind = "button"
    description = traitlets.Unicode("").tag(page=True)
    disabled = traitlets.Bool(False).tag(page=True)
    primary = traitlets.Bool(False).tag(page=True)
    look = traitlets.Unicode("").tag(page=True)
    """"icon": its description is a sign, and its tooltip what is read aloud."""

    def __init__(self, description: str, act: Callable[[], object], **given: object) -> None:
        self.act = act
        super().__init__(description=description, **given)

    def click(self) -> None:
        """As if it were pressed."""
        if not self.disabled:
            self.act()

    def take(self, message: Message) -> None:
        """It is pressed."""
        self.click()


def icon(sign: str, act: Callable[[], object], meaning: str) -> Button:
    """A button of one sign."""
    return Button(sign, act, tooltip=meaning, look="icon")


class Group(Part):
    """Parts below each other, or beside each other in a row that goes on in the next line where the page is narrow."""

    kind = "group"
    children = traitlets.Tuple()
    row = traitlets.Bool(False).tag(page=True)
    look = traitlets.Unicode("").tag(page=True)
    description = traitlets.Unicode("").tag(page=True)
    """What is read aloud before each part in it."""
    open = traitlets.Bool(False).tag(page=True)
    """Of one that folds: it is unfolded when this becomes true."""

    def __init__(self, *children: Part, row: bool = False, **given: object) -> None:
        super().__init__(children=children, row=row, **given)

    def described(self) -> dict[str, object]:
        """With all that stands in it."""
        return {**super().described(), "children": [child.described() for child in self.children]}

    def inside(self) -> Iterator[Part]:
        """This group and all that stand in it."""
        yield self
        for child in self.children:
            yield from child.inside()


def row(*children: Part, **given: object) -> Group:
    """Parts beside each other."""
    return Group(*children, row=True, **given)


def bold(words: object) -> Piece:
    """Words that stand out."""
    return {"words": str(words), "look": "bold"}


def plain(line: Line) -> str:
    """A line, or a cell, as plain text.

    >>> plain(["the ", bold("winner"), ": 3"])
    'the winner: 3'
    """
    if isinstance(line, str):
        return line
    return str(line["words"]) if isinstance(line, Mapping) else "".join(map(plain, line))


def _cell(cell: object) -> object:
    return cell if isinstance(cell, Mapping | list) else str(cell)
