"""The files of a design that a page saves and opens."""

from __future__ import annotations

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


def _page(order: Order) -> Made:
    return Made(_panel(order).html().encode(), "the page, which computes by itself")


def _picture(kind: str) -> Export:
    def drawn(order: Order) -> Made:
        from ...render.still import saved

        return Made(saved(_panel(order).figure(), kind), "the pictures of the page")

    return Export(f"picture-{kind}", f"-picture.{kind}", f"Picture ({kind.upper()})", "for a text or a talk", drawn)


def _panel(order: Order) -> Saved:
    return order.cam  # type: ignore[return-value]


PAGE = (
    Export("html", ".html", "Living page (HTML)", "for colleagues: it computes without Python", _page),
    _picture("svg"),
    _picture("pdf"),
)
"""What only a page can save, beside the files for the workshop."""


def files_of(app: Saved) -> list[tuple[str, str]]:
    """What can be saved of what is shown: by what it is asked for, and what it is called."""
    return [(each.key, each.words) for each in _exports(Order(app))]


def file_of(app: Saved, kind: str, order: Order | None = None) -> tuple[str, bytes]:
    """A file of what is shown, with its name; a fault of the design is marked in it.

    ``ValueError`` for a kind that there is not.
    """
    order = order or Order(app)
    known = {each.key: each for each in _exports(order)}
    if kind not in known:
        raise ValueError(f"{shown(kind)} is no kind of file here; there are {', '.join(known)}")
    title = replace(order.title, faults=faults(app.design, blank=order.blank))
    made = known[kind].make(replace(order, title=title))
    return f"{order.kind}{known[kind].ending}", made.data


def _exports(order: Order) -> tuple[Export, ...]:
    first, *others = exports_of(order)
    return (first, *PAGE, *others)


def remarked(found: designs.Read) -> str:
    """What a panel says of a file that it has loaded; nothing if there is nothing to remark."""
    return f"The file is loaded, but {'; and '.join(found.remarks)}." if found.remarks else ""
