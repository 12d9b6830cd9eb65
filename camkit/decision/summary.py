"""Several designs side by side: their measures, where they differ, which is best; as Markdown and as a page of HTML."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quantities import Measure, declared_in, refuse_design, value_of, words
from ..quantities.kinds import refuse_arguments
from ..quantities.markup import Html, attribute, html, markdown, table
from ..study.limits import keeps
from ..study.study import Study

NOT_MET = "not met"
BOLD = "Bold: the best of a line."


@dataclass(frozen=True)
class Line:
    """One number of all designs as text; ``best`` and ``missed`` say for which it is best and misses its limit."""

    name: str
    texts: tuple[str, ...]
    best: tuple[bool, ...]
    missed: tuple[bool, ...]
    limit: str = ""


@dataclass(frozen=True)
class SideBySide:
    """Designs in columns, their numbers in lines; shows as a table in a notebook."""

    names: tuple[str, ...]
    lines: tuple[Line, ...]

    def markdown(self, title: str = "Designs side by side") -> str:
        """The table as Markdown, the best of each line in bold."""
        head = ["", *map(markdown, self.names), "limit"]
        rows = [[markdown(line.name), *_cells(line, _bold, _missed), markdown(line.limit)] for line in self.lines]
        rule = ["---", *["---:"] * (len(head) - 1)]
        lines = "\n".join(f"| {' | '.join(row)} |" for row in (head, rule, *rows))
        return f"# {markdown(title)}\n\n{lines}\n\n{BOLD}\n"

    def html(self) -> Html:
        """The table alone."""
        rows = [(line.name, *_cells(line, _bold_html, _missed_html), line.limit) for line in self.lines]
        return table(("", *self.names, "limit"), rows)

    def page(self, title: str = "Designs side by side", png: bytes = b"") -> str:
        """A page of HTML that needs no other file: the table and, inside it, a picture."""
        data = base64.b64encode(png).decode("ascii")
        alt = f"{title}: {', '.join(self.names)}"
        picture = html('<p><img {} src="data:image/png;base64,{}"></p>', attribute("alt", alt), data) if png else Html()
        return html(_PAGE, title=title, style=PAGE_STYLE, picture=picture, table=self.html(), note=BOLD)

    def _repr_html_(self) -> str:
        return self.html()


_PAGE = (
    '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>{style}'
    "</head><body><h1>{title}</h1>{picture}{table}<p>{note}</p></body></html>\n"
)
PAGE_STYLE = Html(
    "<style>body{font:16px/1.4 sans-serif;color:#1f2933;margin:2em auto;max-width:80em;padding:0 1em}"
    "img{max-width:100%}table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "th,td{text-align:right;padding:.25em .8em;border-bottom:1px solid #e4e7eb}"
    "th:first-child,td:first-child{text-align:left}.camkit-missed{color:#D55E00;font-weight:600}</style>"
)


def _cells(line: Line, shown: Callable[[str, bool], str], missed: Callable[[str], str]) -> list[str]:
    """A line's numbers as a kind of text shows them, the best ones and those that miss a limit in its own way."""
    cells = [shown(text, best) for text, best in zip(line.texts, line.best, strict=True)]
    return [missed(cell) if no else cell for cell, no in zip(cells, line.missed, strict=True)]


def _bold(text: str, best: bool) -> str:
    return f"**{markdown(text)}**" if best else markdown(text)


def _missed(cell: str) -> str:
    return f"{cell} ({NOT_MET})"


def _bold_html(text: str, best: bool) -> Html:
    return html("<b>{}</b>" if best else "{}", text)


def _missed_html(cell: str) -> Html:
    return html("{} <span class='camkit-missed'>{}</span>", cell, NOT_MET)


def side_by_side(
    designs: Mapping[str, Any],
    measures: Sequence[Measure] = (),
    study: Study | None = None,
    analyses: Sequence[object] | None = None,
) -> SideBySide:
    """Designs of one kind in columns: first the quantities in which they differ, then their measures.

    ``study`` (objectives and limits) comes first among the measures; it says what is better, small or large, and what
    must be kept.  A measure of which it says nothing has no best.  ``analyses`` are the designs', if there are any yet.

    >>> from camkit import UniversalJointShaft
    >>> thin, thick = UniversalJointShaft(outer_diameter=0.12), UniversalJointShaft(outer_diameter=0.13)
    >>> table = side_by_side({"thin": thin, "thick": thick}, UniversalJointShaft.measures[:1])
    >>> table.lines[0].name, table.lines[0].texts
    ('outer diameter', ('120 mm', '130 mm'))

    Raises ``ValueError`` for designs of several kinds.
    """
    refuse_arguments(side_by_side, locals())
    for name, design in designs.items():
        refuse_design(design, str(name))
    if analyses is not None and len(analyses) != len(designs):
        raise ValueError(f"there are {len(analyses)} analyses of {len(designs)} designs; there must be one of each")
    kinds = sorted({type(design).__name__ for design in designs.values()})
    if len(kinds) > 1:
        raise ValueError(f"the designs are {' and '.join(kinds)}; designs of one kind can be set side by side")
    analyses = [design.analyse() for design in designs.values()] if analyses is None else analyses
    senses, limits = _senses(study), {m: (v, k) for m, v, k in study.limits} if study else {}
    every = dict.fromkeys([*senses, *(m if m.sign > 0 else -m for m in measures)])
    lines = [*_differences(list(designs.values())), *(_measured(m, analyses, senses, limits) for m in every)]
    return SideBySide(tuple(map(str, designs)), tuple(lines))


def _senses(study: Study | None) -> dict[Measure, int]:
    """Measures of a study with +1 if small, -1 if large is better."""
    if study is None:
        return {}
    goals = {(m if m.sign > 0 else -m): m.sign for m in study.minimise}
    return goals | {m: sense for m, _, sense in study.limits if m not in goals}


def _differences(designs: Sequence[object]) -> list[Line]:
    """Quantities that are not the same in all designs."""
    trees = [declared_in(design) for design in designs]
    lines = []
    for name in dict.fromkeys(path for tree in trees for path in tree):
        texts = tuple(
            tree[name].text(value_of(design, name)) if name in tree else ""
            for design, tree in zip(designs, trees, strict=True)
        )
        if len(set(texts)) > 1:
            lines.append(Line(words(name), texts, *((False,) * len(texts),) * 2))
    return lines


def _measured(
    measure: Measure,
    analyses: Sequence[object],
    senses: Mapping[Measure, int],
    limits: Mapping[Measure, tuple[float, int]],
) -> Line:
    """A measure of all designs; those that read like the best are best, unless all read alike."""
    values = np.array([measure.one(analysis) for analysis in analyses])
    texts = tuple(measure.text(value) for value in values)
    sense, differ = senses.get(measure, 0), len(set(texts)) > 1 and np.isfinite(values).any()
    leader = texts[int(np.nanargmin(sense * values))] if sense and differ else None
    value, side = limits.get(measure, (np.inf, 1))
    limit = f"{'at most' if side > 0 else 'at least'} {measure.text(value)}" if measure in limits else ""
    # A number that is not there keeps no limit, as in a study; without a limit there is none to miss.
    missed = tuple(measure in limits and not keeps(v, value, side) for v in values)
    return Line(measure.name, texts, tuple(text == leader for text in texts), missed, limit)
