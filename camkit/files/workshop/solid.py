"""Cams, links and tubes as solids for CAD: STEP files, read back and compared with the exact flanks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...quantities.extras import extra
from ...units import mm, um
from .arcs import distances
from .bars import BAR, Round, Tube, tubes_of
from .blank import Blank
from .faults import marked
from .prisms import Part, parts
from .skeleton import tube_callout
from .subject import DRAWN, analysis_of, design_of
from .title import TitleBlock
from .written import Made, Written, length_unit, new_file, written

if TYPE_CHECKING:
    from OCP.TopoDS import TopoDS_Solid

SAME = 1e-9
"""By how much, of the whole, a volume that is read may differ from that which was written."""


def write_step(
    cam: object,
    path: str | Path,
    *,
    tolerance: float = 1 * um,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
    link: Round = BAR,
) -> Written:
    """Write a cam, a linkage or a shaft as solids for CAD; it needs the extra ``step``.  What is in it: see `step`."""
    path = new_file(path, "a STEP file", (".step", ".stp"))
    return written(step(cam, tolerance=tolerance, unit=unit, title=title, blank=blank, link=link), path)


def step(
    cam: object,
    *,
    tolerance: float = 1 * um,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
    link: Round = BAR,
) -> Made:
    """A cam as a STEP file (AP214): one solid, its flanks cylinders that keep the tolerance (m).

    ``cam`` is a design, an analysis or a panel.  The cam's axis is z; its disk stands on the plane z = 0, with angle 0
    along x; a groove is a pocket from above, the hub is below.  The cams of a pair are an assembly on one shaft.

    Of a linkage the links as bars, ``CRANK``, ``COUPLER`` and ``ROCKER``, at the first position of its analysis, in the
    frame of its tables; ``link`` is their diameter, or an outer and an inner one (m).  Of a shaft its tube, along x
    from the first joint.

    Raises ``ValueError`` in a sentence for a drum, an open profile, a bore that comes through the cam, and
    ``ModuleNotFoundError`` where Open CASCADE is not installed.
    """
    unit, kind = length_unit(unit), type(design_of(cam)).__name__
    if isinstance(analysis := analysis_of(cam), DRAWN):
        return tubes_step(tubes_of(analysis, link), kind, unit=unit, title=title, remarks=tube_callout(analysis))
    with extra("a STEP file", "step"):
        import OCP  # noqa: F401

        from .open_cascade import solid
        from .step_file import Named, step_file

        made = parts(cam, blank, tolerance)
        solids = [Named(part.name, solid(part.added, part.cut), part.height) for part in made]
    title = marked(title, cam)
    lines = title.lines(kind, unit, f"flanks within {tolerance / um:.3g} um")
    return _cams_read(step_file(title.marked(kind), solids, unit, title, lines), made, blank.thickness)


def _cams_read(data: bytes, made: Sequence[Part], top: float) -> Made:
    """The file with what is found on reading it: sound solids of the right volumes, and how far flanks lie off."""
    from .open_cascade import outlines

    away, solids = [], _solids_read(data, [part.volume for part in made])
    for part, one in zip(made, solids, strict=True):
        edges = outlines(one, part.height + top)
        for flank in part.flanks:
            points = np.hstack([stretch.finer(2).points for stretch in flank.stretches])
            away.append(np.min([distances(edge, points) for edge in edges], axis=0).max())
    above = f"the second cam stands {made[-1].height / mm:.4g} mm above the first on the shaft"
    return Made(data, _what(solids), float(max(away)), (above,) if made[1:] else ())


def _solids_read(data: bytes, volumes: Sequence[float]) -> list[TopoDS_Solid]:
    """The solids in a file, where they stand; ``ValueError`` unless they are valid and have these volumes (m^3)."""
    from .open_cascade import solids_of, valid, volume
    from .step_file import read_step

    solids = [one for part in read_step(data)[1] for one in solids_of(part.shape)]
    found = [volume(one) for one in solids]
    if not all(map(valid, solids)) or not np.allclose(found, volumes, rtol=SAME, atol=0):
        raise ValueError(
            f"Open CASCADE reads {len(solids)} solids of {sum(found) / mm**3:.6g} mm3 where there were to be "
            f"{len(volumes)} valid ones of {sum(volumes) / mm**3:.6g} mm3; another tolerance may help"
        )
    return solids


def _what(solids: Sequence[TopoDS_Solid]) -> str:
    from .open_cascade import faces_of, volume

    faces, whole = sum(len(faces_of(one)) for one in solids), sum(map(volume, solids))
    return f"{len(solids)} solid{'s' * (len(solids) != 1)} of {faces} faces, {whole / mm**3:.6g} mm3"


def tubes_step(
    tubes: Sequence[Tube],
    kind: str,
    *,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    remarks: Sequence[str] = (),
) -> Made:
    """Bars and tubes in space as a STEP file: an assembly of named solids; the deviation is that of their ends.

    ``kind`` is the name of the design's class, the title where there is none; ``remarks`` stand in the file's head.
    """
    unit = length_unit(unit)
    for tube in tubes:
        _refuse(tube)
    with extra("a STEP file", "step"):
        from .open_cascade import flat_centres, round_bar
        from .step_file import Named, step_file

        solids = [Named(tube.name, round_bar(*tube[1:])) for tube in tubes]
    *lines, made = title.lines(kind, unit)
    data = step_file(title.marked(kind), solids, unit, title, [*lines, *remarks, made])
    read = _solids_read(data, [_tube_volume(tube) for tube in tubes])
    ends = [np.stack([tube.start, tube.end], axis=1) for tube in tubes]
    away = [
        np.linalg.norm(at[:, :, None] - flat_centres(one)[:, None], axis=0).min(1).max()
        for at, one in zip(ends, read, strict=True)
    ]
    return Made(data, _what(read), float(max(away)), tuple(remarks))


def _tube_volume(tube: Tube) -> float:
    return float(np.pi / 4 * (tube.outer**2 - tube.inner**2) * np.linalg.norm(tube.end - tube.start))


def _refuse(tube: Tube) -> None:
    length = float(np.linalg.norm(np.asarray(tube.end) - tube.start))
    if not (0 <= tube.inner < tube.outer and 0 < length < np.inf):
        raise ValueError(
            f"{tube.name} is {length / mm:.4g} mm long, {tube.outer / mm:.4g} mm outside and {tube.inner / mm:.4g} mm "
            "inside in diameter; a tube has a length, and is larger outside than inside"
        )
