"""Where on a sheet each part of a drawing stands, and at which scale: as large as the sheet allows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...quantities import quantities_of, value_of
from ...quantities.tree import label
from ...study.tolerances import general_tolerances
from ...units import deg, mm
from .blank import Blank
from .contours import contours
from .dimensions import Words
from .front import CLEAR, ROUND, SIDE, Front, section_marks
from .radii import Table, draw_table, flank_radii, radii_table
from .section import ABOVE, depth, draw_detail, draw_section, section_height
from .sheet import Facts, border, scale_bar, sheet_size, title_block
from .subject import Subject
from .svg import RED, Box, Paper
from .title import TitleBlock
from .unrolled import ABOVE as ABOVE_DRUM
from .unrolled import BELOW as BELOW_DRUM
from .unrolled import BESIDE, Unrolled
from .view import BEND, SCALES, View, scale_text, write_notes

STRIP = 58.0
"""Height of what stands above the title block: notes, and the detail of the bore, mm."""
BAR = 12.0
"""Height of the scale bar with its words, mm."""


@dataclass(frozen=True)
class Plan:
    """What is drawn, on which sheets, in whose words."""

    subjects: tuple[Subject, ...]
    words: Words
    title: TitleBlock
    blank: Blank
    sheet: str
    scale: float | None
    zone: float

    @property
    def size(self) -> tuple[float, float]:
        return sheet_size(self.sheet)


class Sheet(NamedTuple):
    """A sheet, and what of it shows a cam: ``None`` on a sheet with the table alone."""

    paper: Paper
    seen: Front | Unrolled | None = None
    view: View | None = None
    corner: tuple[float, float] = (0.0, 0.0)
    """Where on the right its lowest line of words ends, mm."""


class Rooms(NamedTuple):
    """The parts of a sheet within its border."""

    views: Box
    notes: Box
    detail: Box
    table: Box | None
    """``None``: the table has a sheet of its own."""


def seen_of(subject: Subject, blank: Blank, words: Words, zone: float = 0.0) -> Front | Unrolled:
    """The view of a cam: of a drum what is unrolled."""
    kind = Unrolled if subject.drum else Front
    return kind(subject, contours(subject), blank, words, zone)


def sheets_of(plan: Plan) -> list[Sheet]:
    """All sheets: on A3 one for each cam, on A4 two, the second with its table."""
    apart = plan.sheet != "A3"
    count = len(plan.subjects) * (1 + apart)
    found: list[Sheet] = []
    for subject in plan.subjects:
        seen = seen_of(subject, plan.blank, plan.words, plan.zone)
        table = radii_table(subject, seen.curves, plan.words.unit)
        found.append(_cam_sheet(plan, seen, None if apart else table, (len(found) + 1, count)))
        if apart:
            found.append(_table_sheet(plan, subject, table, (len(found) + 1, count)))
    return found


def _named(plan: Plan, subject: Subject) -> str:
    return ", ".join(filter(None, (plan.title.name(subject.kind), subject.name)))


def _begun(plan: Plan, subject: Subject, scale: str, number: tuple[int, int]) -> tuple[Paper, Box, Box]:
    """A sheet with border and title block: paper, what is within the border, and the title block."""
    paper = Paper(*plan.size)
    inner = border(paper)
    facts = Facts(_named(plan, subject), scale, plan.words, "ISO 2768-m", "{} / {}".format(*number))
    block = title_block(paper, inner, plan.title, facts)
    if plan.title.faults:
        paper.stamp("FAULTY")
    return paper, inner, block


def _table_sheet(plan: Plan, subject: Subject, table: Table, number: tuple[int, int]) -> Sheet:
    paper, inner, block = _begun(plan, subject, "–", number)
    box = Box(inner.left + 4, inner.top + 4, inner.right - 4, block.top - 4)
    low = paper.paragraph((box.left, box.top), _faults(plan), box.width, ink=RED)
    box = box._replace(top=low)
    if not draw_table(paper, box, table):
        raise ValueError(f"the table of radii has {table.rows} rows, more than a sheet {plan.sheet} has room for")
    return Sheet(paper)


def _cam_sheet(plan: Plan, seen: Front | Unrolled, table: Table | None, number: tuple[int, int]) -> Sheet:
    """The drawing of one cam, with its table if that stands on the same sheet."""
    trial = Paper(*plan.size)
    inner = border(trial)
    rooms = _rooms(plan, inner, table)
    scale = _scale(seen, plan, rooms.views)
    paper, *_ = _begun(plan, seen.subject, scale_text(scale), number)
    view = _views(paper, seen, plan, scale, rooms.views)
    if table is not None and rooms.table is not None and not draw_table(paper, rooms.table, table):
        raise ValueError(f"the table of radii has {table.rows} rows, more than a sheet {plan.sheet} has room for")
    _notes(paper, plan, seen, rooms.notes)
    if plan.blank.keyway is not None and isinstance(seen, Front):
        _detail(paper, plan, rooms.detail)
    low = rooms.views.bottom - 3
    scale_bar(paper, (rooms.views.left + 4, low), scale, plan.words.unit)
    return Sheet(paper, seen, view, (rooms.views.right, low + 1.4))


def _rooms(plan: Plan, inner: Box, table: Table | None) -> Rooms:
    """On A4 the views stand above notes and detail, on A3 to the left of table, notes and detail."""
    block = Box(inner.right - 180, inner.bottom - 40, inner.right, inner.bottom)
    left = block.left if table is not None else inner.left
    detail = 74.0 if plan.blank.keyway is not None else 0.0
    if table is None:
        strip = Box(inner.left + 4, block.top - STRIP, inner.right - 4, block.top - 3)
        views = Box(inner.left + 3, inner.top + 3, inner.right - 3, strip.top)
        in_table = None
    else:
        in_table = Box(left + 4, inner.top + 4, inner.right - 4, inner.top + 142)
        strip = Box(left + 4, in_table.bottom + 4, inner.right - 4, block.top - 3)
        views = Box(inner.left + 3, inner.top + 3, left - 3, inner.bottom - 2)
    return Rooms(
        views,
        Box(strip.left, strip.top, strip.right - detail, strip.bottom),
        Box(strip.right - detail, strip.top, strip.right, strip.bottom),
        in_table,
    )


class Margins(NamedTuple):
    """Around a view, for its words, marks and section, mm."""

    left: float
    right: float
    above: float
    below: float


def _margins(seen: Front | Unrolled, blank: Blank, scale: float) -> Margins:
    if isinstance(seen, Unrolled):
        return Margins(2.0, BESIDE, ABOVE_DRUM, BELOW_DRUM)
    left, right, *_ = seen.extent
    middle = (left + right) / 2 / mm
    notes = seen.notes(View(Paper(0, 0), (0.0, 0.0), 1.0))
    sides = [[note.width for note in notes if (note.place[0] >= middle) == side] for side in (False, True)]
    before, after = (max(SIDE, BEND + 3 + max(widths, default=0.0)) for widths in sides)
    return Margins(before, after, ROUND, ROUND + section_height(blank, scale))


def _scale(seen: Front | Unrolled, plan: Plan, room: Box) -> float:
    """The one that was asked for, or the largest standard one at which the views have room."""
    fits = (scale for scale in SCALES if _fits(seen, plan, room, scale))
    if plan.scale is None:
        if largest := next(fits, None):
            return largest
        raise ValueError("the cam is too large for a drawing at 1:1000")
    if not _fits(seen, plan, room, plan.scale):
        largest = next(fits, 0.0)
        raise ValueError(
            f"the scale is {scale_text(plan.scale)}, for which a sheet {plan.sheet} is too small; the largest standard "
            f"one that has room is {scale_text(largest)}"
        )
    return plan.scale


def _fits(seen: Front | Unrolled, plan: Plan, room: Box, scale: float) -> bool:
    left, right, low, high = (value / mm * scale for value in seen.extent)
    margins = _margins(seen, plan.blank, scale)
    wide, tall = right - left + margins.left + margins.right, high - low + margins.above + margins.below + BAR
    return wide <= room.width and tall <= room.height


def _views(paper: Paper, seen: Front | Unrolled, plan: Plan, scale: float, room: Box) -> View:
    """Front view and section in the middle of their room, with the words beside them."""
    left, right, low, high = (value / mm * scale for value in seen.extent)
    margins = _margins(seen, plan.blank, scale)
    spare = room.width - (right - left) - margins.left - margins.right
    spare_high = room.height - (high - low) - margins.above - margins.below - BAR
    x = room.left + margins.left + spare / 2 - left
    y = room.top + margins.above + spare_high / 3 + high
    view = View(paper, (x, y), scale)
    box = seen.draw(view)
    if isinstance(seen, Front):
        top = box.bottom + ROUND + spare_high / 3
        write_notes(
            paper, seen.notes(view), Box(room.left, room.top, room.right, top), box, (y - CLEAR[0], y + CLEAR[1])
        )
        _section(seen, view, box, plan, top)
    else:
        seen.dimension(view, box)
    return view


def _section(seen: Front, front: View, box: Box, plan: Plan, top: float) -> None:
    """The section A-A below the front view from a height on, if the cut meets the cam on both sides of the axis."""
    walls = _walls(seen)
    if walls is None:
        return
    way = 1 if plan.words.first_angle else -1  # seen from above, or from below: the front face is at the lower edge
    section_marks(front, box, way > 0)
    deep = front.length(depth(plan.blank))
    view = View(front.paper, (front.centre[0], top + ABOVE + (deep if way > 0 else 0.0)), front.scale)
    draw_section(view, plan.blank, walls, plan.words, way)
    view.paper.text((view.centre[0], top + 4.5), "A–A", 4.5, "middle", bold=True)


def _walls(seen: Front) -> list[list[float]] | None:
    """The radii that the section meets at 0 and at 180 deg, m; ``None``: it meets the cam on one side only."""
    radii = np.array(list(flank_radii(seen.curves, np.array([0.0, np.pi])).values()))
    if seen.rim:
        return [[*sorted(r for r in side if np.isfinite(r)), seen.rim] for side in radii.T]
    return [list(side) for side in radii.T] if np.isfinite(radii).all() else None


def _detail(paper: Paper, plan: Plan, box: Box) -> None:
    """The bore with its keyway, as large as there is room."""
    scale = draw_detail(paper, box, plan.blank, plan.words)
    angle = plan.blank.key_angle / deg
    place = f", keyway at {angle:z.4g}°" if angle else ""
    paper.text((box.left + 4, box.top + 4.5), f"Bore ({scale_text(scale)}){place}", 3.5, bold=True)


def _notes(paper: Paper, plan: Plan, seen: Front | Unrolled, box: Box) -> None:
    """What is wrong in red, what the drawing is to be read by, and the sizes of the mechanism."""
    faults = _faults(plan)
    lines = [*_to_be_read(plan, seen), *_sizes(plan, seen.subject)]
    for size in (2.8, 2.5, 2.2, 2.0, 1.8):
        trial = Paper(*plan.size)
        if trial.paragraph((box.left, box.top), [*faults, *lines], box.width, size) <= box.bottom:
            break
    y = paper.paragraph((box.left, box.top), faults, box.width, size, RED)
    paper.paragraph((box.left, y), lines, box.width, size)


def _faults(plan: Plan) -> list[str]:
    return [f"FAULTY: {fault}" for fault in plan.title.faults]


def _to_be_read(plan: Plan, seen: Front | Unrolled) -> list[str]:
    unit = {"in": "inches"}.get(plan.words.unit, plan.words.unit)
    if isinstance(seen, Unrolled):
        lines = [f"Lengths in {unit}. The surface of the drum is unrolled at its mean radius, seen from outside."]
        lines.append(f"The drum turns {seen.subject.turns}.")
    else:
        lines = [f"Lengths in {unit}. Angles run counter-clockwise from 0°; the cam turns {seen.subject.turns}."]
    if seen.zone:
        wide = plan.words.length(seen.zone)
        lines.append(f"The profile lies in a zone {wide} wide, half of it to each side of the profile that is drawn.")
    if isinstance(seen, Front) and (limits := plan.words.limits(plan.blank)):
        lines.append(f"Limits of {'; '.join(limits)}.")
    for path, declared in quantities_of(seen.subject.design).items():
        if path.rpartition(".")[2] == "cam_roughness":
            lines.append(f"Surface of the profile: R_q {declared.text(value_of(seen.subject.design, path))}.")
    return lines


def _sizes(plan: Plan, subject: Subject) -> list[str]:
    """The sizes of the mechanism with the tolerances that were given."""
    declared, words = quantities_of(subject.design), plan.words
    found = []
    for path in general_tolerances(subject.design):
        value, half = value_of(subject.design, path), words.tolerances.get(path, 0.0)
        if declared[path].unit == "mm":
            said = f"{words.length(value)}{words.plus_minus(half)}"
        else:
            said = f"{value / deg:z.6g}°" + (f" ±{half / deg:.3g}°" if half else "")
        found.append(f"{label(path, declared[path])} {said}")
    return [f"Sizes of the mechanism: {'; '.join(found)}."] if found else []
