"""The files of a design that a page saves and opens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from ...files import designs, faults
from ...files.workshop.exports import Export, Order, exports_of
from ...files.workshop.written import Made
from ...quantities.kinds import shown

if TYPE_CHECKING:
    from ...render.still import Still


class Saved(Protocol):
    """A panel whose design is saved, with what follows from it."""

    design: Any
    analysis: Any

    def html(self) -> str:
        """The page that computes without Python."""

    def figure(self) -> Still:
        """The views of the design."""


def living_page(html: Callable[[], str]) -> Export:
    """The page that computes without Python."""

    def page(order: Order) -> Made:
        return Made(html().encode(), "the page, which computes by itself")

    return Export("html", ".html", "", "Living page (HTML)", "for colleagues: it computes without Python", page)


def _picture(app: Saved, kind: str) -> Export:
    def drawn(order: Order) -> Made:
        from ...render.still import saved

        return Made(saved(app.figure(), kind), "the pictures of the page")

    ending, words = f"-picture.{kind}", f"Picture ({kind.upper()})"
    return Export(f"picture-{kind}", ending, "Records", words, "for a text or a talk", drawn)


def _order(app: Saved) -> Order:
    """With what only a page can save, beside the files for the workshop."""
    return Order(app, more=(living_page(app.html), _picture(app, "svg"), _picture(app, "pdf")))


def files_of(app: Saved) -> list[tuple[str, str, str]]:
    """What can be saved of what is shown: by what it is asked for, what it is called, and under which heading."""
    return [(each.key, each.words, each.group) for each in exports_of(_order(app))]


def file_of(app: Saved, kind: str) -> tuple[str, bytes]:
    """A file of what is shown, with its name; a fault of the design is marked in it.

    ``ValueError`` for a kind that there is not.
    """
    order = _order(app)
    known = {each.key: each for each in exports_of(order)}
    if kind not in known:
        raise ValueError(f"{shown(kind)} is no kind of file here; there are {', '.join(known)}")
    title = replace(order.title, faults=faults(order.design, blank=order.blank))
    made = known[kind].make(replace(order, title=title))
    return f"{order.kind}{known[kind].ending}", made.data


def remarked(found: designs.Read) -> str:
    """What a panel says of a file that it has loaded; nothing if there is nothing to remark."""
    return f"The file is loaded, but {'; and '.join(found.remarks)}." if found.remarks else ""
