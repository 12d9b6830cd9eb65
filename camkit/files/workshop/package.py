"""One button, to the workshop: a zip with every file that can be made of a design, and a text that says what for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...quantities.kinds import refuse_arguments
from ...quantities.markup import plain
from ...study.spread import Source
from ...study.study import Study
from ...units import mm
from .blank import Blank
from .exports import Export, Order, exports_of
from .faults import YIELD, faults, has_profile
from .subject import subjects
from .title import TitleBlock
from .written import Made, Written, new_file, written, zipped

README = "README.txt"
FRAME = "The cam's axis is the origin, angle 0 of the cam the x axis; angles are in degrees. The cam turns {}."
UNROLLED = (
    "Drawings are of the drum unrolled at its mean radius, seen from outside; angles are in degrees. The drum turns {}."
)


def to_workshop(
    cam: object,
    path: str | Path,
    *,
    study: Study | None = None,
    tolerances: Mapping[str | Source, object] | None = None,
    least_yield: float = YIELD,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
    tool_radius: float = 5 * mm,
    insist: bool = False,
) -> Written:
    """Write a zip with all that can be made of a design, an analysis or a panel, and a README.txt that says what for.

    Each file is read back; the largest deviation (m) of all is returned.  What needs a library that is not installed is
    named with what to install.  A design with `faults` is refused in a sentence; with ``insist`` it is written, and
    every sheet says what is wrong.

    >>> from tempfile import TemporaryDirectory
    >>> from camkit import DoorHandleCam
    >>> with TemporaryDirectory() as folder:
    ...     to_workshop(DoorHandleCam(), f"{folder}/cam.zip")
    Traceback (most recent call last):
        ...
    ValueError: it is not sent to the workshop: relief groove undercut at 20.6 to 26.1 deg: roller 5 mm, concave \
radius 2.67 mm; insist=True writes it nevertheless, marked FAULTY on every sheet
    """
    refuse_arguments(to_workshop, locals())
    path = new_file(path, "what goes to the workshop", (".zip",))
    order = Order(cam, unit, title, blank, tool_radius, study, tolerances)
    return written(package(order, faults(order.design, study, tolerances, least_yield, blank), insist), path)


def package(
    order: Order, found: Sequence[str] = (), insist: bool = False, told: Callable[[str], object] = lambda said: None
) -> Made:
    """The zip of an order with the faults that were found, and the largest deviation of all that is in it.

    ``told`` hears of each file before it is made: ``"Profile (DXF), 2 of 20"``.
    """
    if found and not insist:
        raise ValueError(
            f"it is not sent to the workshop: {'; '.join(found)}; insist=True writes it nevertheless, marked FAULTY on "
            "every sheet"
        )
    order = replace(order, title=replace(order.title, faults=(*order.title.faults, *found)))
    made, lacking = _made(order, told)
    files = {f"{order.kind}{export.ending}": each.data for export, each in made}
    away = [each.deviation for _, each in made if np.isfinite(each.deviation)]
    data = zipped({README: _readme(order, made, lacking).encode(), **files})
    return Made(data, f"{len(files)} files and {README}", max(away, default=np.nan), (*found, *lacking))


def _made(order: Order, told: Callable[[str], object]) -> tuple[list[tuple[Export, Made]], list[str]]:
    """What could be made of an order, and why the rest could not, in sentences."""
    made, lacking = [], []
    exports = exports_of(order)
    for k, export in enumerate(exports, 1):
        told(f"{export.words}, {k} of {len(exports)}")
        try:
            made.append((export, export.make(order)))
        except (ValueError, ModuleNotFoundError) as refusal:
            lacking.append(f"{export.words} ({export.ending}): {refusal}")
    return made, lacking


def _readme(order: Order, made: Sequence[tuple[Export, Made]], lacking: Sequence[str]) -> str:
    """What each file is for, and how far it is off."""
    lines = [*map(plain, order.title.lines(order.kind, order.unit)), *_frame(order), "", "FILES"]
    for export, each in made:
        told = (f"{export.words}, {export.use}", str(each), *each.remarks)
        lines += ["", f"{order.kind}{export.ending}", *(f"  {plain(line)}" for line in told)]
    if lacking:
        lines += ["", "NOT MADE", "", *(f"  {plain(line)}" for line in lacking)]
    return "\n".join(lines) + "\n"


def _frame(order: Order) -> list[str]:
    """Where the drawings of a cam stand, and which way it turns."""
    if not has_profile(order.analysis):
        return []
    first, *_ = subjects(order.analysis)
    return [(UNROLLED if first.drum else FRAME).format(first.turns)]
