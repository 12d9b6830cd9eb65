"""A report as one page of HTML, which needs no other file and no network, and prints on A4."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from importlib.resources import files

from ...quantities.markup import Html, attribute, html, joined
from .report_texts import FITS, Drawn, Fit, Input, Measured, Report, shortened
from .written import Made

PAGE = (
    '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
    "<title>{title}</title><style>{style}</style></head>\n<body {density}>{body}</body></html>\n"
)
MM = 25.4 / 72
"""Of a point."""
PAPER, SURE = 265.0, 0.96
"""What a page has room for between its margins, mm, and the share of it that may be filled by estimate."""
BROAD, NARROW, HALF, WHOLE = 50, 36, 48, 95
"""About so many letters of 9 points stand in a line beside the drawing, there beside limits, in half a page, in a
note."""


def page(report: Report) -> Made:
    """The report as HTML, as loose as two printed pages have room for by estimate; what has none is said."""
    for fit in FITS:
        above, below = heights(shortened(report, fit), fit)
        parts = (above, below) if fit.columns == 1 else ((above + below) / fit.pages,)
        if max(parts) <= SURE * PAPER:
            break
    report = shortened(report, fit)
    style = Html(files(__package__).joinpath("report.css").read_text(encoding="utf-8"))
    density = attribute("style", f"--size: {fit.size}pt; --row: {0.4 * fit.row:.2f}pt; --drawing: {report.width}mm")
    body = joined([_head(report), _first(report), _others(report), _inputs(report, fit), _notes(report)], "\n")
    made = html(PAGE, title=report.title, style=style, density=density, body=body)
    return Made(made.encode(), "a report as a page of HTML", remarks=report.remarks)


def heights(report: Report, fit: Fit) -> tuple[float, float]:
    """About how high what stands above the inputs is, and they with all below, mm."""
    line, row = 1.15 * MM * fit.size, MM * (1.15 * fit.size + 0.8 * fit.row)
    letters, heading = 9 / fit.size, 2.2 * line + 3

    def lines(text: str, most: float) -> int:
        return -(-len(text) // int(most * letters))

    beside, others = report.measures[: report.beside], report.measures[report.beside :]
    width, drawn = NARROW if report.asks else BROAD, report.width * report.drawing.ratio if report.drawing else 0
    first = max(drawn, row * (1 + sum(lines(each.name, width) for each in beside)))
    curves = 45 * -(-len(report.curves) // 3)
    further = heading + row * (1 + sum(lines(each.name, HALF) for each in others) / 2) if others else 0
    warned = sum(4 + line * lines(said, WHOLE) for said in (*report.faults, report.verdict))
    said = [each.name + each.meaning * fit.meanings if fit.columns > 1 else "" for each in report.inputs]
    inputs = heading + row * sum(max(1, lines(text, HALF)) for text in said) / fit.columns
    notes = sum(
        heading + line * sum(max(lines(what, 36), lines(how, WHOLE)) + 0.1 for what, how in note.rows)
        for note in report.notes
    )
    return 24 + warned + first + curves + further, inputs + notes + 10 * (1 + len(report.remarks))


def _head(report: Report) -> Html:
    """The title block, what is wrong, and the verdict."""
    faults = joined(html('<p class="fault" role="alert"><b>Faulty:</b> {}</p>', fault) for fault in report.faults)
    verdict = html("<p {}>{}</p>", attribute("class", f"verdict {report.mark}"), report.verdict)
    return html("<header><h1>{}</h1>{}</header>{}{}", report.title, _pairs(report.about), faults, verdict)


def _pairs(rows: Sequence[tuple[str, str]]) -> Html:
    return html("<dl>{}</dl>", joined(html("<dt>{}</dt><dd>{}</dd>", name, said) for name, said in rows))


def _image(drawn: Drawn) -> Html:
    """A picture within the page; as an image it can neither run nor fetch anything."""
    data = base64.b64encode(drawn.svg.encode()).decode("ascii")
    return html('<img {} src="data:image/svg+xml;base64,{}">', attribute("alt", drawn.title), data)


def _first(report: Report) -> Html:
    """The drawing with measures beside it, and the curves."""
    measures = _measures(report.measures[: report.beside], report.asks)
    curves = joined(map(_image, report.curves))
    below = html('<div class="curves">{}</div>', curves) if curves else Html()
    if report.drawing is None:
        return html('<div class="first bare">{}</div>{}', measures, below)
    return html('<div class="first">{}{}</div>{}', _image(report.drawing), measures, below)


def _measures(rows: Sequence[Measured], asked: bool) -> Html:
    more = Html('<th scope="col">asked</th><th></th>') if asked else Html()
    head = html('<tr><th scope="col">measure</th><th scope="col" class="number">value</th><th></th>{}</tr>', more)
    return html('<table class="measures">{}{}</table>', head, joined(_measure(row, asked) for row in rows))


def _measure(row: Measured, asked: bool) -> Html:
    more = (
        html('<td class="asked">{}</td><td {}>{}</td>', row.asked, attribute("class", row.kept), row.kept)
        if asked
        else Html()
    )
    return html("<tr {}><td>{}</td>{}{}</tr>", _degrees(row), row.name, _amount(row), more)


def _degrees(row: Measured | Input) -> Html:
    return attribute("class", "degrees" if row.unit == "°" else "")


def _amount(row: Measured | Input) -> Html:
    """The cells of a number and its unit, or of a choice."""
    if row.unit is None:
        return html('<td class="number" colspan="2">{}</td>', row.value)
    return html('<td class="number">{}</td><td class="unit">{}</td>', row.value, row.unit)


def _others(report: Report) -> Html:
    """The measures that have no room beside the drawing."""
    rows = report.measures[report.beside :]
    half = (len(rows) + 1) // 2
    tables = joined(_measures(part, False) for part in (rows[:half], rows[half:]) if part)
    return (
        html('<section class="whole"><h2>Further measures</h2><div class="two">{}</div></section>', tables)
        if rows
        else Html()
    )


def _inputs(report: Report, fit: Fit) -> Html:
    """The inputs, in one column with their meaning beside them or in two."""
    if not report.inputs:
        return Html()
    half = -(-len(report.inputs) // fit.columns)
    parts = [report.inputs[:half], report.inputs[half:]]
    tables = joined(
        html('<table {}>{}</table>', attribute("class", f"inputs {'beside' if fit.columns == 1 else ''}"),
             joined(_input(row, fit) for row in part))
        for part in parts if part
    )  # fmt: skip
    turned, form = ("turned", "one") if fit.columns == 1 else ("", "two")
    return html("<h2 {}>Inputs</h2><div {}>{}</div>", attribute("class", turned), attribute("class", form), tables)


def _input(row: Input, fit: Fit) -> Html:
    symbol = html("<i>{}</i>{}", row.letter, html("<sub>{}</sub>", row.below) if row.below else Html())
    said = row.meaning if fit.meanings else ""
    if fit.columns == 1:
        name, beside = html("{}", row.name), html('<td class="means">{}</td>', said)
    else:
        name, beside = html('{} <span class="means">{}</span>', row.name, said), Html()
    return html("<tr {}><td>{}</td><td>{}</td>{}{}</tr>", _degrees(row), symbol, name, _amount(row), beside)


def _notes(report: Report) -> Html:
    """Study, tolerances and decision, what was left out, and the versions."""
    notes = joined(
        html('<section class="notes"><h2>{}</h2>{}</section>', note.heading, _pairs(note.rows)) for note in report.notes
    )
    remarks = joined(html('<p class="remark">{}.</p>', remark) for remark in report.remarks)
    return html("{}{}<footer><span>{}</span><span>{}</span></footer>", notes, remarks, report.versions, report.title)
