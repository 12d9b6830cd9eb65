"""A program of G-code that mills or grinds a cam, for LinuxCNC or a plain control as Fanuc's.

The tool's centre runs along lines and arcs (G1, G2, G3) within a tolerance of the exact path; the control corrects the
tool's length and not its radius.  The program is read back (see `nc`) before it is given away.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from textwrap import wrap
from typing import NamedTuple

import numpy as np

from ...quantities.kinds import one_number, refuse_arguments, refuse_fields
from ...quantities.types import Array
from ...units import in_unit, mm, um
from .arcs import ArcPath
from .blank import Blank
from .faults import marked
from .leads import Run, run
from .milling import CLIMB, FANUC, LINUXCNC, Milling
from .readback import Wanted, deviation
from .subject import Subject, subjects
from .title import TitleBlock
from .toolpath import ToolPath, path_of
from .written import LENGTHS, Made, Written, length_unit, new_file, written

FINEST, COARSEST = 0.5 * um, 100 * um
"""Tolerances that a program can be asked for."""
SHARE = 0.7
"""Of the tolerance, for the arcs; the rest is for rounding."""
FLAT = 0.01 * um
"""An arc that rises less above its chord is a line."""
LARGEST = 10.0
"""Arcs of a larger radius (m) are lines, each of which rises by less than `RISE` above the arc."""
RISE = 0.05 * um
UNTITLED, PLATE = TitleBlock(), Blank()
ENDINGS = ".ngc", ".nc", ".tap", ".cnc", ".gcode", ".txt"
WIDTH = 66
"""Letters of a comment in one line: controls cut longer ones off."""


class Dialect(NamedTuple):
    """What differs between controls."""

    head: tuple[str, ...]
    """Before everything."""
    modes: str
    """All that may have been left from another program."""
    tool: str
    """Corrects the tool's length."""
    decimals: dict[str, int]
    """Of a coordinate, by the unit."""


_MODES = "G17 G90 G94 G40 G49 G80 G54"
DIALECTS = {
    LINUXCNC: Dialect(("%",), f"{_MODES} G91.1", "G43", {"mm": 5, "in": 6}),
    FANUC: Dialect(("%", "O1000"), _MODES, "G43 H1", {"mm": 4, "in": 5}),
}


def gcode(
    cam: object,
    *,
    unit: str = "mm",
    title: TitleBlock = UNTITLED,
    blank: Blank = PLATE,
    tolerance: float = 1 * um,
    **milling: float | str,
) -> Made:
    """`write_gcode` without a file.

    >>> from camkit import TranslatingFlatCam
    >>> made = gcode(TranslatingFlatCam(), tool_radius=8 * mm, title=TitleBlock(date="2026-11-30"))
    >>> print(made.data.decode().splitlines()[1])
    (- TRANSLATING FLAT CAM)
    """
    unit = length_unit(unit)
    refuse_fields(Milling(), milling)
    how = Milling(**milling)  # type: ignore[arg-type]
    said = f"be a length from {FINEST / um:g} to {COARSEST / um:g} um"
    within = one_number(tolerance, "the tolerance", said, lambda x: FINEST <= x <= COARSEST)
    jobs = [_job(subject, how, blank, within) for subject in subjects(cam)]
    program = "\n".join(_program(jobs, how, unit, marked(title, cam), within)) + "\n"
    off = deviation(program, [want for job in jobs for want in _wanted(job, how)], within)
    return Made(program.encode("ascii"), _what(jobs, how), off, tuple(_remarks(jobs, how)))


def write_gcode(
    cam: object,
    path: str | Path,
    *,
    unit: str = "mm",
    title: TitleBlock = UNTITLED,
    blank: Blank = PLATE,
    tolerance: float = 1 * um,
    **milling: float | str,
) -> Written:
    """Write a program of G-code that mills or grinds the profile of a cam, or its groove.

    ``cam`` is a design, an analysis or a panel; ``milling`` are quantities and choices of `Milling`, such as
    ``tool_radius``, ``feed``, ``depth``, ``direction`` and ``dialect``.  The cam's axis is X0 Y0, the direction of its
    angle 0 is X, and Z0 is the top of the blank.  The path keeps the ``tolerance`` (m); where a hollow is too narrow
    for the tool, it goes as far as it can without cutting into the cam, and a remark says what stays.  A cutter of the
    roller's radius makes a groove in one go, a smaller one runs along both walls.  The cams of a pair follow each
    other in one program, with a stop between them.

    >>> from camkit import TranslatingRollerCam, mm
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "groove.ngc"
    >>> done = write_gcode(TranslatingRollerCam(), path, tool_radius=8 * mm, dialect="Fanuc")
    >>> path.read_text().splitlines()[:2], done.deviation < 1 * um
    (['%', 'O1000'], True)
    """
    refuse_arguments(write_gcode, locals())
    path = new_file(path, "a program of G-code", ENDINGS)
    return written(gcode(cam, unit=unit, title=title, blank=blank, tolerance=tolerance, **milling), path)


class _Job(NamedTuple):
    """One cam that is cut."""

    subject: Subject
    path: ToolPath
    runs: tuple[Run, ...]
    levels: tuple[float, ...]


def _job(subject: Subject, how: Milling, blank: Blank, tolerance: float) -> _Job:
    path = path_of(subject, how.tool_radius)
    groove = path.walls[0].layer == "GROOVE"
    depth = how.depth or (blank.groove_depth if groove else blank.thickness)
    clockwise = [within != (how.direction == CLIMB) for within in path.inside]
    runs = tuple(run(path, k, SHARE * tolerance, how.lead_in, clockwise[k]) for k in range(len(path.contours)))
    return _Job(subject, path, runs, how.levels(depth))


def _wanted(job: _Job, how: Milling) -> Iterator[Wanted]:
    """The passes of one cam as they follow each other."""
    for level in job.levels:
        for k, each in enumerate(job.runs):
            yield Wanted(job.path, k, each.led, level, how.feed)


def _what(jobs: Sequence[_Job], how: Milling) -> str:
    arcs = sum(int((abs(each.path.bulges) > 0).sum()) for job in jobs for each in job.runs)
    passes = sum(len(job.levels) for job in jobs)
    times, tool = f"{passes} pass{'es' * (passes > 1)}", f"tool of radius {how.tool_radius / mm:.4g} mm"
    return f"{how.dialect}, {times} of {arcs} arcs, {tool}"


def _remarks(jobs: Sequence[_Job], how: Milling) -> Iterator[str]:
    for job in jobs:
        named = f"{job.subject.name}: " if job.subject.name else ""
        yield from (f"{named}{each}" for each in (*map(str, job.path.uncut), *job.path.remarks))
        if not all(each.closed for each in job.path.contours) and not job.path.one_pass:
            yield f"{named}the profile is open, as the motion does not go around: the path is, too"
        if job.path.walls[0].layer == "GROOVE":
            yield f"{named}the tool goes down into the solid: it must cut at its centre"
        elif how.lead_in and not all(each.led for each in job.runs):
            yield f"{named}there is no room for a lead-in: the tool goes down on the path"
    if how.dialect == FANUC:
        yield "a control with increments of 0.001 mm or 0.0001 in (IS-B) rounds coordinates: up to 0.7 or 1.8 um more"


# ---------------------------------------------------------------- the text


class Writes(NamedTuple):
    """How a control writes lengths."""

    unit: str
    decimals: int

    def __call__(self, length: float) -> str:
        """A length (m), with its point: a control may take a number without one for increments."""
        return f"{length / LENGTHS[self.unit]:z.{self.decimals}f}".rstrip("0")

    def rounded(self, points: Array) -> Array:
        """Where points (m) lie as they are written."""
        return np.round(points / LENGTHS[self.unit], self.decimals) * LENGTHS[self.unit]

    def speed(self, speed: float) -> str:
        """A feed (m/s), per minute."""
        return f"F{60 * speed / LENGTHS[self.unit]:.2f}".rstrip("0")


def _program(jobs: Sequence[_Job], how: Milling, unit: str, title: TitleBlock, tolerance: float) -> Iterator[str]:
    dialect = DIALECTS[how.dialect]
    writes = Writes(unit, dialect.decimals[unit])
    yield from dialect.head
    sheet = title.lines(jobs[0].subject.kind, unit, f"path within {tolerance / um:g} um")
    for line in (*sheet, *_about(jobs, how, unit)):
        yield from comment(line)
    yield f"{'G20' if unit == 'in' else 'G21'} {dialect.modes}"
    if how.dialect == LINUXCNC:
        yield f"G64 P{writes(tolerance)}"
    yield "T1 M6"
    for number, job in enumerate(jobs):
        if number:
            yield from ("M5", *comment(f"stop: a new blank for the {job.subject.name}"), "M0")
        yield from _started(how)
        yield from _cut(job, how, writes, 1000 * (number + 1))
    yield from ("M5", "M30", "%")


def _about(jobs: Sequence[_Job], how: Milling, unit: str) -> Iterator[str]:
    """What whoever sets the machine up must know."""
    radius = _length(how.tool_radius, unit)
    yield f"tool T1 - radius {radius}, diameter {_length(2 * how.tool_radius, unit)}, the path is that of its centre"
    yield "X0 Y0 - cam axis, X - direction of angle 0 of the cam, Z0 - top of the blank"
    yield f"seen from above the cam turns {jobs[0].subject.turns}, the spindle clockwise; milling is {how.direction}"
    yield f"nothing may stand {_length(how.safe_height, unit)} above the top"
    yield from _remarks(jobs, how)


def _length(length: float, unit: str) -> str:
    return f"{length / LENGTHS[unit]:.5g} {unit}"


def _started(how: Milling) -> Iterator[str]:
    if how.spindle_speed:
        yield f"S{in_unit(how.spindle_speed, 'rpm'):.0f} M3"
    else:
        yield from (*comment("stop: turn the spindle on, clockwise"), "M0")


def _cut(job: _Job, how: Milling, writes: Writes, first: int) -> Iterator[str]:
    """All passes of one cam, each with a number from the ``first`` on."""
    up = f"Z{writes(how.safe_height)}"
    yield f"G0 {DIALECTS[how.dialect].tool} {up}"
    ways = [list(_ways(each.path, writes)) for each in job.runs]
    for level in job.levels:
        for each, (start, *others) in zip(job.runs, ways, strict=True):
            x, y = each.path.corners[:, 0]
            first += 1
            yield f"N{first} G0 X{writes(x)} Y{writes(y)}"
            yield f"G1 Z{writes(level)} {writes.speed(how.plunge_feed)}"
            yield from (f"{start} {writes.speed(how.feed)}", *others, f"G0 {up}")


def _ways(path: ArcPath, writes: Writes) -> Iterator[str]:
    """The lines and arcs of an open path from rounded place to rounded place, none of them without a length."""
    for start, end, bulge in zip(path.starts.T, path.ends.T, path.bulges, strict=True):
        chord = np.hypot(*(end - start))
        rise, radius = chord * abs(bulge) / 2, chord * (1 + bulge**2) / (4 * max(abs(bulge), 1e-12))
        if rise < FLAT or radius > LARGEST:
            steps, arc = max(1, int(np.ceil(np.sqrt(rise / RISE)))), np.stack([start, end], axis=1)
            yield from _lines(ArcPath("", arc, np.array([bulge]), False).points(steps), writes)
        else:
            one, other = writes.rounded(start), writes.rounded(end)
            if (one != other).any():
                across = np.array([one[1] - other[1], other[0] - one[0]])
                i, j = (other - one) / 2 + (1 - bulge**2) / (4 * bulge) * across
                turn = "G3" if bulge > 0 else "G2"
                yield f"{turn} X{writes(other[0])} Y{writes(other[1])} I{writes(i)} J{writes(j)}"


def _lines(points: Array, writes: Writes) -> Iterator[str]:
    places = writes.rounded(points)
    for one, other in pairwise(places.T):
        if (one != other).any():
            yield f"G1 X{writes(other[0])} Y{writes(other[1])}"


# ---------------------------------------------------------------- comments

_PLAIN = re.compile(r"[^A-Z0-9 .,+\-=/*?]")


def comment(text: str) -> Iterator[str]:
    """Lines that hold a text as comments, which no control takes for code.

    Capital letters, digits and few signs are left; what cannot be written so becomes a question mark.  LinuxCNC acts on
    comments that begin with a word such as ``MSG,`` or ``LOGOPEN,``: the sign before each keeps it from that.

    >>> list(comment("Kurvenscheibe (\u00fc) M3"))
    ['(- KURVENSCHEIBE  U  M3)']
    """
    letters = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c)).upper()
    said = _PLAIN.sub("?", re.sub(r"[\s()\[\]{}:;%]", " ", letters))
    return (f"(- {line})" for line in wrap(said, WIDTH) or [""])
