"""What a cam's solid is put together from: right prisms along the cam's axis, added and cut away.

The cam's disk lies between the heights 0 and its thickness; it is seen from above, so that its profile stands as in
the drawing.  A groove is open upwards, the hub stands below.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...units import mm
from .arcs import ArcPath, arc_path
from .blank import Blank
from .contours import Contour, contours
from .plan import bore_path, circle
from .subject import Subject, subjects


class Prism(NamedTuple):
    """A right prism on a closed ``outline`` with ``holes``, from the height ``low`` to ``high``, m."""

    outline: ArcPath
    holes: tuple[ArcPath, ...]
    low: float
    high: float

    @property
    def volume(self) -> float:
        """Its area times its height, m^3."""
        return (area(self.outline) - sum(map(area, self.holes))) * (self.high - self.low)


class Part(NamedTuple):
    """One cam: what is added, what is cut from it, how high it stands on the shaft, m, and its exact flanks."""

    name: str
    added: tuple[Prism, ...]
    cut: tuple[Prism, ...]
    height: float
    flanks: tuple[Contour, ...]

    @property
    def volume(self) -> float:
        """Of what is added less what is cut, m^3."""
        return sum(prism.volume for prism in self.added) - sum(prism.volume for prism in self.cut)


def parts(cam: object, blank: Blank, tolerance: float) -> tuple[Part, ...]:
    """The cams of a design or its analysis; both of a pair stand on one shaft, the hub of the second on the first.

    Their flanks are arcs within ``tolerance`` (m).  ``ValueError`` for a cam that is no disk, whose profile is open, or
    that has no room for its bore.
    """
    height = blank.thickness + (blank.hub_length if blank.hub_diameter else 0.0)
    made = enumerate(subjects(cam))
    return tuple(_part(subject, blank, tolerance, number * height) for number, subject in made)


def _part(subject: Subject, blank: Blank, tolerance: float, height: float) -> Part:
    flanks = _flanks(subject)
    groove = flanks[0].layer == "GROOVE"
    _room(flanks, blank)
    around, *islands = (arc_path(flank, tolerance) for flank in flanks)
    bore = (bore_path(blank),) if blank.bore else ()
    outline = circle(outer_diameter(flanks, blank) / 2) if groove else around
    hub = (Prism(circle(blank.hub_diameter / 2), bore, -blank.hub_length, 0.0),) if blank.hub_diameter else ()
    pocket = (Prism(around, tuple(islands), blank.thickness - blank.groove_depth, blank.thickness),) if groove else ()
    return Part(subject.name, (Prism(outline, bore, 0.0, blank.thickness), *hub), pocket, height, flanks)


def _flanks(subject: Subject) -> tuple[Contour, ...]:
    """The closed contours that are cut: the profile, or the walls of the groove, the outer one first."""
    if subject.drum:
        raise ValueError(
            f"{subject.kind} is a drum, whose flanks are no prisms: its STL or 3MF file has it in space, and its table "
            "both edges of every flank"
        )
    cut = [contour for contour in contours(subject) if contour.layer in ("CAM", "GROOVE")]
    if not all(contour.closed for contour in cut):
        raise ValueError(
            f"the profile of {subject.kind} does not go around the cam, so that no solid follows from it; its DXF file "
            "has the open profile"
        )
    if cut[0].layer == "CAM" and len(cut) > 1:
        raise ValueError(f"of {subject.kind} the tool leaves {len(cut)} pieces; a solid is made of one")
    return tuple(sorted(cut, key=lambda contour: -np.hypot(*contour.points).max()))


def _room(flanks: tuple[Contour, ...], blank: Blank) -> None:
    """Refuse a bore that comes through a flank, and a groove through the cam."""
    least = min(np.hypot(*flank.points).min() for flank in flanks)
    if blank.reach / 2 >= least:
        raise ValueError(
            f"the bore with its keyway reaches {blank.reach / 2 / mm:.4g} mm from the axis; the nearest flank of the "
            f"cam is at {least / mm:.4g} mm"
        )
    if flanks[0].layer == "GROOVE" and blank.groove_depth >= blank.thickness:
        raise ValueError(
            f"the groove depth is {blank.groove_depth / mm:.4g} mm; it must be below the thickness, "
            f"{blank.thickness / mm:.4g} mm"
        )


def outer_diameter(flanks: tuple[Contour, ...], blank: Blank) -> float:
    """Of the disk that holds a groove, m."""
    largest = 2 * float(max(np.hypot(*flank.points).max() for flank in flanks))
    if 0 < blank.outer_diameter <= largest:
        raise ValueError(
            f"the outer diameter is {blank.outer_diameter / mm:.4g} mm; the groove takes {largest / mm:.4g} mm"
        )
    return blank.outer_diameter or largest + 2 * blank.groove_depth


def area(path: ArcPath) -> float:
    """Within a closed path, m^2: the polygon of its corners, and ``c^2 (t - sin t) / (8 sin^2(t / 2))`` under each arc.

    >>> round(area(circle(1.0)) / np.pi, 12)
    1.0
    """
    (x, y), (u, v), turn = path.starts, path.ends, 4 * np.arctan(path.bulges)
    bent = abs(turn) > 1e-3
    safe = np.where(bent, turn, 1.0)
    rise = np.where(bent, (safe - np.sin(safe)) / (8 * np.sin(safe / 2) ** 2), turn / 12 * (1 + turn**2 / 30))
    return float(((x * v - u * y) / 2 + ((u - x) ** 2 + (v - y) ** 2) * rise).sum())
