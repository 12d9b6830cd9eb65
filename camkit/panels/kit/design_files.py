"""The files of a design that a page saves and opens."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from ...files import designs, profiles
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


def _drawn(app: Saved, kind: str) -> bytes:
    from ...render.still import saved

    return saved(app.figure(), kind)


FILES: dict[str, Callable[[Saved], bytes]] = {
    "json": lambda app: designs.to_json(app.design).encode(),
    "html": lambda app: app.html().encode(),
    "svg": lambda app: _drawn(app, "svg"),
    "pdf": lambda app: _drawn(app, "pdf"),
    "csv": lambda app: profiles.profile_csv(app.analysis).encode(),
    "dxf": lambda app: profiles.profile_dxf(app.analysis).encode(),
}
"""What a page can save of a design, by the ending of the file's name."""
OF_PROFILES = ("csv", "dxf")
"""Of these, what only a design with a profile has."""


def files_of(analysis: object) -> list[str]:
    """What can be saved of a design with this analysis."""
    return [kind for kind in FILES if kind not in OF_PROFILES or hasattr(analysis, "profile")]


def file_of(app: Saved, kind: str) -> bytes:
    """A file of what is shown; ``ValueError`` for a kind that there is not."""
    if kind not in (known := files_of(app.analysis)):
        raise ValueError(f"{shown(kind)} is no kind of file here; there are {', '.join(known)}")
    return FILES[kind](app)


def remarked(found: designs.Read) -> str:
    """What a panel says of a file that it has loaded; nothing if there is nothing to remark."""
    return f"The file is loaded, but {'; and '.join(found.remarks)}." if found.remarks else ""
