"""A design as a page that computes: its views and measures are recorded once, and the page runs them as sliders move.

What the page shows is plain JSON, its texts included; what it computes is a program (`camkit.program`), whose outputs
the JSON names by their numbers.
"""

from __future__ import annotations

import base64
import gzip
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np

from ..motion import Law
from ..program import CannotRecord, Program, record, unrecorded
from ..program.page import numbers
from ..program.texts import Template
from ..program.texts import numbers as numbers_in
from ..quantities import (
    Analysable,
    Measure,
    Paths,
    Quantity,
    choices_of,
    label,
    measures_of,
    quantities_of,
    refuse_design,
    value_of,
    words,
)
from ..quantities.applied import a_new_file, applied
from ..quantities.kinds import refuse_arguments
from ..quantities.known import known
from ..study.limits import KEPT, refuse_limits
from ..units import deg, factor, known_units
from ..views.defaults import default_views
from ..views.picture import Mark, Picture, View
from .contours import outlined
from .page_parts import PAGE, STYLE, in_html, look, script
from .positions import VIEWPOINT, given_to, made_by, name_of, positions_of, turn_range
from .reasons import reason_of

SIZE = np.array([400.0, 300.0])
"""For which a picture that does not compute chooses its contours' names, pixels."""
WORDS = ("key", "role", "stroke", "mark", "fill", "anchor", "along", "log")
"""Of marks and axes: words that say how, and are never shown."""

Json = object
"""What JSON can hold."""


@dataclass
class Outputs:
    """The outputs of a recording so far, and how a page finds a value among them."""

    found: dict[str, Any] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)

    def at(self, value: object) -> Json:
        """A plain number as it is, an array or what is recorded by the number of its output, a text by its name."""
        if isinstance(value, (np.bool_, np.integer)):
            return value.item()
        if value is None or isinstance(value, (bool, int)) or (type(value) is float and np.isfinite(value)):
            return value
        if isinstance(value, str):
            self.texts[name := f"text {len(self.texts)}"] = value
            return {"text": name}
        if isinstance(value, Mapping):
            return {key if isinstance(key, str) else float(key): self.at(entry) for key, entry in value.items()}
        if isinstance(value, (list, tuple)):
            if any(part is None or isinstance(part, (str, list, tuple)) for part in value):
                return [self.at(part) for part in value]
            value = np.stack(value) if len(value) else np.empty(0)
        self.found[str(len(self.found))] = np.asarray(value, dtype=float) if known(value) else value
        return {"at": len(self.found) - 1}

    def picture(self, picture: Picture, name: str, why: str = "") -> Json:
        """A picture by the name of its view, and ``why`` it does not compute if it does not."""
        marks = [*map(self._mark, outlined(picture, SIZE))]
        return {"name": name, "still": why, "axes": self._parts(picture.axes), "marks": marks}

    def _mark(self, mark: Mark) -> Json:
        return {"kind": type(mark).__name__.lower(), **self._parts(mark)}

    def _parts(self, thing: Any) -> dict[str, Json]:
        parts = ((f.name, getattr(thing, f.name)) for f in fields(thing))
        return {name: value if name in WORDS and isinstance(value, str) else self.at(value) for name, value in parts}


@dataclass(frozen=True)
class Living:
    """What a page shows of a design, and the program that it runs; without one somebody else has to `show` it others.

    ``first`` is where the mechanism stands first, ``free`` are the paths that have a control (all of them).
    """

    design: Analysable
    views: tuple[View, ...]
    measures: tuple[Measure, ...]
    limits: Mapping[Measure, tuple[tuple[float, int], ...]]
    """Of a measure: value in SI and sense (1 for at most, -1 for at least), of one limit or two."""
    first: Mapping[str, float]
    free: Sequence[str] | None = None
    _last: list[tuple[Analysable, object]] = field(default_factory=list, init=False, repr=False, compare=False)
    """The last design that was asked for, and its analysis."""

    def show(self, design: Analysable, **position: float) -> dict[str, Json]:
        """Pictures, positions and measures of a design that stands at a position, and the arrays that they name."""
        outputs = Outputs()
        return _plainly(self._shown(self.analysis_of(design), position, outputs), outputs)

    def analysis_of(self, design: Analysable) -> object:
        """The analysis of a design, made once as long as no other is asked for."""
        if not self._last or self._last[0][0] != design:
            self._last[:] = [(design, design.analyse())]
        return self._last[0][1]

    def show_still(self, design: Analysable) -> dict[str, Json]:
        """The pictures that do not compute, by their number, and the arrays that they name."""
        outputs, analysis = Outputs(), self.analysis_of(design)
        pictures: Any = self.structure["pictures"]
        still = {k: picture["still"] for k, picture in enumerate(pictures) if picture["still"]}
        shown = {str(k): self._picture(self.views[k], analysis, self.first, outputs, why) for k, why in still.items()}
        return _plainly({"pictures": shown}, outputs)

    def _shown(self, now: object, position: Mapping[str, float], outputs: Outputs) -> dict[str, Json]:
        """Everything that follows from the analysis of a design, which may be recorded."""
        return {
            "pictures": [self._seen(view, now, position, outputs) for view in self.views],
            "positions": [outputs.at(row) for row in _position_rows(now, self.first)],
            "measures": [
                {**_measure(m, m.of(now, 1), limit, outputs), "why": self._reasons[m]} for m, limit in self._limited()
            ],
            "trouble": outputs.at(_trouble(now)),
        }

    @cached_property
    def _reasons(self) -> dict[Measure, dict[str, Json]]:
        """Why each measure is what it is."""
        analysis = self.design.analyse()
        return {measure: reason_of(measure, analysis) for measure in (*self.measures, *self.limits)}

    def _limited(self) -> Iterator[tuple[Measure, tuple[float, int] | None]]:
        """Each measure with its limit, if it has one; those that have two once more, after all."""
        yield from ((m, self.limits[m][0] if m in self.limits else None) for m in self.measures)
        yield from ((m, second) for m, limits in self.limits.items() for second in limits[1:])

    def _seen(self, view: View, now: object, position: Mapping[str, float], outputs: Outputs) -> Json:
        """What a view shows now; of the first design, and why, where that cannot be recorded."""
        try:
            return self._picture(view, now, position, outputs)
        except Exception as error:
            why = str(unrecorded(error) or error)
        return self._picture(view, self.design.analyse(), self.first, outputs, why)

    def _picture(
        self, view: View, analysis: object, position: Mapping[str, float], outputs: Outputs, why: str = ""
    ) -> Json:
        asked = {"limits": {measure: limits[-1][0] for measure, limits in self.limits.items()}, **position}
        with applied(f"the view {name_of(view).replace('_', ' ')}", analysis):
            return outputs.picture(made_by(view, analysis, given_to(view, asked)), name_of(view), why)

    @cached_property
    def _recorded(self) -> tuple[dict[str, Json], Program | None, str]:
        """What is shown, the program, and why there is none."""
        shown: dict[str, Json] = {}

        def show(design: Analysable, **position: float) -> dict[str, Any]:
            outputs = Outputs()
            shown.update(self._shown(design.analyse(), position, outputs))
            return outputs.found | outputs.texts

        try:
            program = record(show, self.design, self.first)
        except Exception as error:  # what is wrong without recording too is raised again
            return self.show(self.design, **self.first) | {"arrays": [], "refusals": []}, None, str(error)
        return _with_texts(shown, _templates(program)) | {"refusals": _refusals(program)}, program, ""

    @cached_property
    def structure(self) -> dict[str, Json]:
        """What the page shows, as plain JSON, its texts included; arrays are named by the number of an output."""
        return _structure(self.design, self.free) | self._recorded[0]

    @property
    def program(self) -> Program | None:
        """What the page runs: of the quantities of the design and its positions."""
        return self._recorded[1]

    @cached_property
    def packed(self) -> bytes:
        """The program as JSON, packed by gzip: numbers, and no word of the design; or nothing."""
        if not self.program:
            return b""
        text = numbers(self.program, steady=len(self.program.inputs) - len(self.first))
        return gzip.compress(text.encode(), 6, mtime=0)

    def html(self, docks: Sequence[Json] = (), named: Sequence[Json] = ()) -> str:
        """One file, without any outside address: ``docks`` are the sheets in its tabs, ``named`` designs with a name.

        `CannotRecord` where there is no program.
        """
        if not self.program:
            raise CannotRecord(f"this design is computed by its kernel; no page can do that ({self._recorded[2]})")
        parts = {
            "style": STYLE,
            "structure": in_html(self.structure | {"docks": docks, "named": named}),
            "program": base64.b64encode(self.packed).decode("ascii"),
            "script": script("page.js"),
        }
        page = (PAGE / "page.html").read_text(encoding="utf-8")
        return re.sub(r"\{\{(\w+)\}\}", lambda place: parts[place[1]], page)


def living(
    design: Analysable,
    views: Sequence[View] = (),
    measures: Sequence[Measure] | None = None,
    at_most: Mapping[Measure, float] | None = None,
    at_least: Mapping[Measure, float] | None = None,
    free: Sequence[str] | None = None,
    position: Mapping[str, float] | None = None,
) -> Living:
    """``design`` through ``views`` (those of what its analysis offers), with ``measures`` (all of them) and limits."""
    refuse_design(design, "the design of the page")
    refuse_limits(at_most or {}, at_least or {})
    analysis = design.analyse()
    views = tuple(views) or default_views(analysis)
    measures = limited(measures_of(design) if measures is None else measures, at_most, at_least)
    limits = {m: ((float(v), 1),) for m, v in (at_most or {}).items()}
    limits |= {m: (*limits.get(m, ()), (float(v), -1)) for m, v in (at_least or {}).items()}
    return Living(design, views, measures, limits, _first_positions(analysis, views) | dict(position or {}), free)


def limited(
    measures: Sequence[Measure], at_most: Mapping[Measure, float] | None, at_least: Mapping[Measure, float] | None
) -> tuple[Measure, ...]:
    """``measures``, and those that have a limit: a limit that nobody sees would seem to be kept."""
    return tuple(dict.fromkeys((*measures, *(at_most or {}), *(at_least or {}))))


def _plainly(shown: dict[str, Json], outputs: Outputs) -> dict[str, Json]:
    """What is shown, with its texts, and beside it the arrays that it names."""
    arrays = [np.ravel(value) for value in outputs.found.values()]
    return _with_texts(shown, outputs.texts) | {"arrays": arrays}


def plain_picture(picture: Picture, name: str) -> dict[str, Json]:
    """A picture by the name of its view as a page draws it: plain JSON, its arrays as bytes of float64."""
    outputs = Outputs()
    shown = _plainly({"picture": outputs.picture(picture, name)}, outputs)
    return {**shown, "arrays": [np.asarray(array, dtype=float).tobytes() for array in shown["arrays"]]}  # type: ignore[attr-defined]


def _with_texts(shown: dict[str, Json], texts: Mapping[str, Json]) -> dict[str, Json]:
    """``shown`` with texts in the place of their names."""
    return {name: _worded(part, texts) for name, part in shown.items()}


def _worded(shown: Json, texts: Mapping[str, Json]) -> Json:
    if isinstance(shown, dict):
        return texts[shown["text"]] if "text" in shown else {name: _worded(part, texts) for name, part in shown.items()}
    return [_worded(part, texts) for part in shown] if isinstance(shown, list) else shown


def _templates(program: Program) -> dict[str, Json]:
    """Texts as the page fills them: plain ones as they are, others in pieces."""
    places = _places(program)
    return {
        name: _pieces(template, places) if [*numbers_in(template)] else "".join(map(str, template))
        for name, template in program.texts.items()
    }


def _refusals(program: Program) -> Json:
    """In order: the output that must be 1, and the sentence that refuses the design if it is not."""
    places = _places(program)
    return [{"at": places[ok], "words": _pieces(sentence, places)} for ok, sentence in program.refusals.items()]


def _places(program: Program) -> dict[str | int, int]:
    return {name: place for place, name in enumerate(program.outputs)}


def _pieces(template: Template, places: Mapping[str | int, int]) -> list[Json]:
    """Of a text: words, and an output with its format, or with the pieces that are there if it holds."""
    return [
        piece
        if isinstance(piece, str)
        else [places[piece[0]], piece[1] if isinstance(piece[1], str) else _pieces(piece[1], places)]
        for piece in template
    ]


def _trouble(analysis: object) -> str:
    """What the analysis says is wrong with the design, if it can be recorded."""
    try:
        return str(getattr(analysis, "trouble", ""))
    except Exception as error:
        if unrecorded(error) is None:
            raise
    return ""


def _first_positions(analysis: object, views: Sequence[View]) -> dict[str, float]:
    """Where the mechanism stands first, and from where it is seen, for the positions that the views ask for."""
    names = dict.fromkeys(name for view in views for name in positions_of(view))
    seen = {name: declared.default * deg for name, declared in VIEWPOINT.items()}
    return {name: seen[name] if name in seen else float(turn_range(analysis)[1]) for name in names}


def _position_rows(analysis: object, first: Mapping[str, float]) -> Iterator[Json]:
    """The controls of the positions: how the angle is called, and from where to where it goes."""
    for name, value in first.items():
        if name == "turn":
            label, low, high = turn_range(analysis)
        else:
            label, low, high = name, VIEWPOINT[name].low * deg, VIEWPOINT[name].high * deg
        yield {"name": name, "label": words(label), "low": low, "high": high, "value": value}


def _measure(measure: Measure, value: object, limit: tuple[float, int] | None, outputs: Outputs) -> dict[str, Json]:
    row: dict[str, Json] = {
        "name": measure.name,
        "unit": measure.unit,
        "factor": factor(measure.unit),
        "value": outputs.at(value),
        **({"inTrouble": True} if measure.in_trouble else {}),
    }
    return row | ({"limit": limit[0], "sense": limit[1]} if limit else {})


def _structure(design: Analysable, free: Sequence[str] | None) -> dict[str, Json]:
    """What the page says of the design: its quantities, in the order of the program's inputs, and what is chosen."""
    shown = None if free is None else set(Paths(design, free).declared)
    laws = {path for path in choices_of(design) if isinstance(value_of(design, path), Law)}
    return {
        "name": re.sub(r"(?<=[a-z])(?=[A-Z][a-z])", " ", type(design).__name__).capitalize(),
        "quantities": [
            _quantity(path, d, value_of(design, path))
            | {"free": shown is None or path in shown, "shapes": path.rpartition(".")[0] in laws}
            for path, d in quantities_of(design).items()
        ],
        "choices": [
            {"path": path, "name": words(path), "options": list(d.named), "chosen": d.text(value_of(design, path))}
            for path, d in choices_of(design).items()
            if shown is None or path in shown
        ],
        "kept": KEPT,
        "look": look(),
        "units": known_units(),
    }


def group_of(path: str, declared: Quantity) -> str:
    """Among what a quantity stands on a page, in words."""
    size = "size" if declared.unit in ("mm", "m", "um", "deg", "") else "power, speed, material"
    return words(path.rpartition(".")[0]) or size


def _quantity(path: str, declared: Quantity, value: float) -> dict[str, Json]:
    own = ("symbol", "unit", "low", "high", "meaning", "factor")
    return {
        "group": group_of(path, declared),
        "name": label(path, declared),
        "value": value,
        **{name: getattr(declared, name) for name in own},
    }


def to_html(
    design: Analysable,
    *views: View,
    path: str | PathLike[str],
    measures: Sequence[Measure] | None = None,
    at_most: Mapping[Measure, float] | None = None,
    at_least: Mapping[Measure, float] | None = None,
) -> None:
    """Write ``design`` as one HTML file that computes without Python: sliders, ``views``, ``measures``, limits.

    Without ``views`` it shows what the analysis offers, without ``measures`` all of them.  Choices stay as they are.
    The file asks for nothing from outside.  `CannotRecord` where the analysis cannot be recorded.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from camkit import TranslatingRollerCam
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     to_html(TranslatingRollerCam(), path=Path(folder) / "cam.html")
    ...     (Path(folder) / "cam.html").stat().st_size < 500_000
    True
    """
    refuse_arguments(to_html, locals())
    a_new_file(path).write_text(living(design, views, measures, at_most, at_least).html(), encoding="utf-8")
