"""The motion programs that a design holds, and the same design with another one."""

from __future__ import annotations

from typing import Any

from ...motion import MotionProgram
from ...quantities import Analysable, Declared, declared_in
from ...quantities.declaration import Quantity


def motions_in(design: object, path: str = "") -> dict[str, MotionProgram]:
    """Every motion program of a design by its path.

    >>> from camkit import TranslatingRollerCam
    >>> list(motions_in(TranslatingRollerCam()))
    ['motion']
    """
    if isinstance(design, MotionProgram):
        return {path: design}
    branches = design.branches() if isinstance(design, Declared) else {}
    found = (motions_in(part, f"{path}.{name}".lstrip(".")) for name, part in branches.items())
    return {at: motion for each in found for at, motion in each.items()}


def with_motion(design: Any, path: str, motion: MotionProgram) -> Any:
    """The design with another motion program at a path."""
    name, _, below = path.partition(".")
    return design.changed({name: with_motion(design.branches()[name], below, motion) if below else motion})


def unit_of(design: Analysable, path: str) -> str:
    """The unit of the follower that the motion program at a path moves."""
    start = declared_in(design).get(f"{path}.start")
    return start.unit if isinstance(start, Quantity) else ""
