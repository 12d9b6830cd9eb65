"""What stands in a report, as texts and pictures, whichever way it is laid out."""

from __future__ import annotations

import platform
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np

from ...quantities import Choice, Measure, choices_of, declared_in, label, text_of, value_of
from ...quantities.extras import extra
from ...quantities.markup import letters
from ...units import in_unit
from ...views.defaults import default_views
from .blank import Blank
from .faults import faults, has_profile
from .figure import figure
from .inches import picture_in, unit_in, words_in
from .reported import Limit, Reported, abs_of
from .title import TitleBlock

MOST_PICTURES = 12
"""So many curves at most stand in a report beside the drawing."""
DRAWN, CURVE, SMALL_CURVE = (4.6, 3.9), (3.75, 2.65), (3.75, 2.3)
"""Width and height of the drawing and of a curve among few and among many, inches; they are printed smaller."""
WIDTH, WIDTH_ASKED, HEIGHT = 80.0, 70.0, 84.0
"""Of the room for the drawing, mm: beside measures, beside these and what is asked of them, and how high at most."""
BARE = Blank(bore=0)
"""What is drawn where nobody says what the cam is cut from."""
FEW = 6
"""So many curves are few."""
BESIDE, BESIDE_ASKED = 20, 14
"""So many measures have room beside the drawing, and where there are limits beside them."""
_DEGREES = re.compile(r"(?<=\d) deg\b(?![/^])")
_POWER = re.compile(r"(?<=[A-Za-z])\^[-+]?[\d.]+")


class Drawn(NamedTuple):
    """A picture: its title, for whoever cannot see it, and SVG."""

    title: str
    svg: str

    @property
    def ratio(self) -> float:
        """Its height by its width."""
        found = re.search(r"viewBox=.0 0 ([\d.]+) ([\d.]+)", self.svg)
        return float(found[2]) / float(found[1]) if found else 1.0


class Input(NamedTuple):
    """A quantity or a choice of the design; the symbol's letter and its index."""

    letter: str
    below: str
    name: str
    value: str
    unit: str | None
    """``None``: a choice, which has none."""
    meaning: str


class Measured(NamedTuple):
    """A measure; ``asked`` says what is wanted of it, and ``kept`` whether it is: "kept", "missed" or nothing."""

    name: str
    value: str
    unit: str
    asked: str
    kept: str


class Note(NamedTuple):
    """A heading with pairs of what and how."""

    heading: str
    rows: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Report:
    """All that is printed."""

    title: str
    about: tuple[tuple[str, str], ...]
    verdict: str
    good: bool | None
    """Whether all limits are kept; ``None``: there are none."""
    faults: tuple[str, ...]
    drawing: Drawn | None
    curves: tuple[Drawn, ...]
    measures: tuple[Measured, ...]
    inputs: tuple[Input, ...]
    notes: tuple[Note, ...]
    versions: str
    remarks: tuple[str, ...]

    @property
    def mark(self) -> str:
        """What the verdict is: "good", "bad", or "open" where nothing was asked."""
        return {True: "good", False: "bad", None: "open"}[self.good]

    @property
    def asks(self) -> bool:
        """Whether something is asked of a measure."""
        return any(row.asked for row in self.measures)

    @property
    def width(self) -> float:
        """Of the drawing, mm."""
        return WIDTH_ASKED if self.asks else WIDTH

    @property
    def beside(self) -> int:
        """How many measures stand beside the drawing; all, where little would be left."""
        room = BESIDE_ASKED if self.asks else BESIDE
        return room if self.drawing and len(self.measures) > room + 2 else len(self.measures)


def report_of(told: Reported, title: TitleBlock, lengths: str, blank: Blank = BARE) -> Report:
    """The report of a design, with lengths in ``"mm"`` or ``"in"``."""
    kind = type(told.design).__name__
    wrong = dict.fromkeys((*title.faults, *faults(told.design)))
    good, verdict = _verdict(told, lengths, bool(wrong))
    drawing, curves, left_out = _pictures(told, blank, lengths)
    return Report(
        title.name(kind),
        _about(told, title),
        verdict,
        good,
        tuple(plainly(words_in(fault, lengths)) for fault in wrong),
        drawing,
        curves,
        tuple(_measured(told, lengths)),
        tuple(_inputs(told.design, lengths)),
        _notes(told, lengths),
        f"camkit {version('camkit')}, numpy {np.__version__}, Python {platform.python_version()}",
        left_out,
    )


def plainly(text: str) -> str:
    """A text with numbers, its units as they are printed.

    >>> plainly("45 deg, 3 mm^2, 4 um")
    '45°, 3 mm², 4 µm'
    """
    text = _DEGREES.sub("°", re.sub(r"\bum\b", "µm", text))
    return _POWER.sub(lambda power: letters(power[0]), text)


def _about(told: Reported, title: TitleBlock) -> tuple[tuple[str, str], ...]:
    """The lines of the title block that say something."""
    chosen = {path: c for path, c in choices_of(told.design).items() if path.endswith("material")}
    materials = (f"{c.text(value_of(told.design, path))} ({label(path, c)})" for path, c in chosen.items())
    kind = TitleBlock().name(type(told.design).__name__)
    rows = (
        ("number", title.number),
        ("kind", kind if title.title else ""),
        ("author", title.author),
        ("material", title.material or ", ".join(materials)),
        ("date", title.day),
    )
    return tuple((name, text) for name, text in rows if text)


def _verdict(told: Reported, lengths: str, faulty: bool) -> tuple[bool | None, str]:
    """Whether the design is feasible, and in a sentence why."""
    missed, count = told.missed, len(told.limits)
    if missed:
        values = told.values
        said = "; ".join(f"{m.name} {_text(m, values[m], lengths)}, {_asked((m, v, s), lengths)}" for m, v, s in missed)
        return False, f"Infeasible: misses {len(missed)} of {count} limits. {said[:1].upper()}{said[1:]}."
    if faulty:
        return False, "Cannot be made as it is."
    if told.wasteful:
        return False, "Infeasible: too many of the parts that are made of it miss a limit."
    if not count:
        return None, "No limits were given."
    return True, f"Feasible: keeps {'its limit' if count == 1 else f'all {count} limits'}."


def _text(measure: Measure, value: float, lengths: str) -> str:
    """A measure's value with its unit, as it is printed in a line."""
    number, unit = _number(value, measure.unit, "~measure", lengths)
    return f"{number}{'' if unit == '°' else ' '}{unit}".rstrip()


def _number(value: float, unit: str, form: str, lengths: str) -> tuple[str, str]:
    """A number (SI) and its unit as they are printed; a dash for one that there is not."""
    if not np.isfinite(value):
        return "–", ""
    unit = unit_in(unit, lengths)
    return text_of(in_unit(value, unit), form).replace("-", "−"), "°" if unit == "deg" else plainly(unit)


def _asked(limit: Limit, lengths: str) -> str:
    measure, value, sense = limit
    return f"{'at most' if sense > 0 else 'at least'} {_text(measure, value, lengths)}"


def _measured(told: Reported, lengths: str) -> list[Measured]:
    """The table of measures: those that were asked for come first."""
    missed, rows = told.missed, []
    for measure, value in told.values.items():
        goals = ["small" if m.sign > 0 else "large" for m in told.objectives if abs_of(m) == measure]
        limits = [limit for limit in told.limits if limit[0] == measure]
        asked = ", ".join([*goals, *(_asked(limit, lengths) for limit in limits)])
        kept = "missed" if any(limit in missed for limit in limits) else "kept" if limits else ""
        rows.append(Measured(measure.name, *_number(value, measure.unit, "~measure", lengths), asked, kept))
    return rows


def _inputs(design: object, lengths: str) -> list[Input]:
    """The quantities and choices of a design, in its order."""
    rows = []
    for path, declared in declared_in(design).items():
        letter, _, index = declared.symbol.partition("_")
        value: Any = value_of(design, path)
        number = (
            (declared.text(value), None)
            if isinstance(declared, Choice)
            else _number(value, declared.unit, "~.6g", lengths)
        )
        meaning = plainly(words_in(declared.meaning, lengths))
        rows.append(Input(letters(letter), letters(index), label(path, declared), number[0], number[1], meaning))
    return rows


def _notes(told: Reported, lengths: str) -> tuple[Note, ...]:
    """What was asked, what the workshop makes of it, and what was decided, if anything was."""
    decided = [*told.decision.lines(), *_another(told)] if told.decision else []
    sections = (("Study", told.asked()), ("Made within tolerances", told.made()), ("Decision", decided))
    return tuple(
        Note(heading, tuple((name, plainly(words_in(said, lengths))) for name, said in rows))
        for heading, rows in sections
        if rows
    )


def _another(told: Reported) -> list[tuple[str, str]]:
    """Whether the design in hand is not the one that was chosen."""
    assert told.decision is not None and told.study is not None
    chosen, here = (told.study.x_of(design) for design in (told.decision.design, told.design))
    return [] if np.allclose(chosen, here, rtol=1e-9, atol=0) else [("note", "this report is of another design")]


def _pictures(told: Reported, blank: Blank, lengths: str) -> tuple[Drawn | None, tuple[Drawn, ...], tuple[str, ...]]:
    """The drawing, the curves, and what was left out."""
    with extra("the report"):
        from ...render.positions import given_to, made_by
        from ...render.printed import printed
    views = told.views or default_views(told.analysis)
    limits = {measure: value for measure, value, _ in told.limits}
    made = [picture_in(made_by(v, told.analysis, given_to(v, {"limits": limits})), lengths) for v in views]
    drawing = _drawing(told, blank, lengths)
    if drawing and made and made[0].axes.equal:  # the cam once more
        made = made[1:]
    first, shown = (0 if drawing else 1), made[: MOST_PICTURES + 1]
    size = CURVE if len(shown) - first <= FEW else SMALL_CURVE
    drawn = [Drawn(p.axes.title, printed(p, *(DRAWN if i < first else size))) for i, p in enumerate(shown)]
    left: Sequence[str] = [picture.axes.title for picture in made[len(shown) :]]
    remarks = (f"{len(left)} of {len(made)} pictures are left out: {', '.join(left)}",) if left else ()
    return drawing or next(iter(drawn), None), tuple(drawn[first:]), remarks


def _drawing(told: Reported, blank: Blank, lengths: str) -> Drawn | None:
    """The cam to scale; of what has none nothing."""
    if not has_profile(told.analysis):
        return None
    drawn = figure(told.analysis, WIDTH_ASKED if told.asks else WIDTH, HEIGHT, blank=blank, unit=lengths)
    return Drawn("The cam to scale", drawn)


class Fit(NamedTuple):
    """How close a report is set: letters and what is free above and below a row, points."""

    pages: int
    size: float
    row: float
    columns: int
    """Of inputs; in one they begin on the second page."""
    meanings: bool = True
    """Whether it is said what an input means."""
    inputs: int = 1000
    """So many at most."""


FITS = (
    *(Fit(1, size, row, 2) for size, row in ((9, 2.2), (8.5, 1.8))),
    *(Fit(2, size, row, 1) for size, row in ((9, 2.5), (8.5, 2.2), (8, 1.6))),
    *(Fit(2, size, row, 2) for size, row in ((9, 2.2), (8.5, 1.8), (8, 1.5), (7.5, 1.2))),
    *(Fit(2, 7.5, 1.2, 2, False, most) for most in (1000, 120, 90, 60, 30, 0)),
)
"""From the loosest to the closest: in the end inputs are left out."""


def shortened(report: Report, fit: Fit) -> Report:
    """The report with as many inputs as fit; which are left out is said."""
    left = len(report.inputs) - fit.inputs
    remarks = () if fit.meanings else ("For want of room it is not said what each input means",)
    if left <= 0:
        return replace(report, remarks=(*report.remarks, *remarks))
    first = report.inputs[fit.inputs].name
    said = f"{left} of {len(report.inputs)} inputs are left out, from the {first} on; the design's file has them"
    return replace(report, inputs=report.inputs[: fit.inputs], remarks=(*report.remarks, *remarks, said))
