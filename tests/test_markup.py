"""Names stay names: in HTML, Markdown, CSV and pictures, in every table and panel."""

from __future__ import annotations

import csv
import io
import json
import re
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

import ipywidgets as w
import numpy as np
import pytest
from hand import move

import camkit
from camkit import Judgements, Study
from camkit.decision import side_by_side
from camkit.files.profiles import table_csv
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise
from camkit.panels import (
    Instrument,
    ahp_panel,
    choose_panel,
    compare_fronts,
    contour_panel,
    edit_program,
    explore,
    live_pareto_panel,
    pareto_panel,
    presets,
    shortlist,
    tolerance_panel,
)
from camkit.panels.kit.sheet import Sheet
from camkit.papers.published import Comparison, Row, Table
from camkit.quantities import Design, Measure, quantity
from camkit.quantities.markup import Html, attribute, csv_cell, escaped, html, joined, letters, markdown, table
from camkit.render import picture
from camkit.render.artists import plain
from camkit.search.nsga2 import nsga2
from camkit.units import deg, mm
from camkit.views.picture import Axes, Picture, Points

EVIL = "<img src=x onerror='ran()'>\"</script>\n<b>$\\frac$ | `x` {0} &amp; $"
ALLOWED = {"table", "caption", "tr", "th", "td", "b", "i", "sub", "span", "div", "br"}
ATTRIBUTES = {"style", "class", "title", "data-name", "role"}


class Elements(HTMLParser):
    """Which elements and attributes a piece of HTML makes, and its text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.text = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        self.text += "".join(value or "" for _, value in attrs)

    def handle_data(self, data):
        self.text += data


def assert_harmless(text: str) -> None:
    made = Elements(text)
    assert made.tags <= ALLOWED, text
    assert made.attributes <= ATTRIBUTES, text


# ---------------------------------------------------------------- the helper


def test_what_is_escaped_is_read_back_letter_by_letter():
    assert Elements(escaped(EVIL)).text == EVIL
    assert Elements(f"<i {attribute('title', EVIL)}></i>").text == EVIL
    assert escaped("an arm's end") == "an arm's end"
    assert Elements(escaped(EVIL)).tags == set()


def test_what_turns_the_direction_of_writing_is_left_out():
    turned = "arm\u202e(mm)\u2066\u200b \ufeffmra"
    assert escaped(turned) == "arm(mm) mra"
    assert attribute("title", turned) == "title='arm(mm) mra'"
    assert markdown(turned) == "arm(mm) mra"
    assert escaped("naïve Größe, α²") == "naïve Größe, α²"


def test_only_html_is_not_escaped_again():
    inner = html("<b>{}</b>", "a < b")
    assert isinstance(inner, Html)
    assert html("<i>{}{name}</i>", inner, name="&") == "<i><b>a &lt; b</b>&amp;</i>"
    assert joined([inner, "<"], "<br>") == "<b>a &lt; b</b><br>&lt;"
    assert escaped(inner + "<u>") == "&lt;b&gt;a &amp;lt; b&lt;/b&gt;&lt;u&gt;"  # a sum is any text again
    assert escaped(3.5) == "3.5"


def test_a_table_escapes_its_head_cells_and_caption():
    told = table((EVIL, "x"), [(EVIL, html("<b>{}</b>", EVIL)), (1, 2.5)], EVIL, "text-align:left")
    assert_harmless(told)
    assert Elements(told).text.replace("text-align:left", "") == EVIL * 2 + "x" + EVIL * 2 + "12.5"


def test_markdown_shows_a_name_in_one_cell():
    cell = markdown(EVIL)
    assert "\n" not in cell
    assert "<" not in cell
    assert "$" not in cell
    assert "|" not in cell.replace("\\|", "")
    assert "`" not in cell.replace("\\`", "")
    assert markdown("[a](javascript:b)") == "\\[a\\](javascript:b)"
    assert markdown("back\\|slash") == "back\\\\\\|slash"


@pytest.mark.parametrize(
    ("text", "cell"),
    [
        ("=1+1", "'=1+1"), ("+1+1", "'+1+1"), ("@SUM(A1)", "'@SUM(A1)"), ("-a", "'-a"), ("-3.5", "-3.5"),
        ("+2", "+2"), ("\t=1", "' =1"), ("\r=1", "' =1"), (" =1", "' =1"), ("＝1", "'＝1"), ("a\nb", "a b"),
        ("=cmd|'/c calc'!A1", "'=cmd|'/c calc'!A1"), ("a=b", "a=b"), ("", ""),
        ("x;=1+1", "x;'=1+1"), ('x; "=1"', "x;' \"=1\""), ("x;y", "x;y"), ("\ufeff=1+1", "'=1+1"), ("a\u202eb", "ab"),
        ("\u200b-\u2066a", "'-a"),
    ],
)  # fmt: skip
def test_a_spreadsheet_takes_no_cell_for_a_formula(text, cell):
    assert csv_cell(text) == cell


def test_every_cell_of_a_csv_file_is_safe():
    told = table_csv({"=head": ["=1", "a,b\n"], "x": [1.0, -2.0]})
    assert list(csv.reader(io.StringIO(told))) == [
        ["'=head", "x"],
        ["'=1", "1.000000"],
        ["a,b ", "-2.000000"],
    ]


# ---------------------------------------------------------------- tables


def test_every_attribute_with_a_name_in_it_is_made_by_the_helper():
    """What is escaped for an element may hold quotes."""
    sources = [path for path in Path(camkit.__file__).parent.rglob("*.py") if path.name != "markup.py"]
    found = re.compile(r"<[^>]*=[\"']\{")
    assert [path.name for path in sources if found.search(path.read_text(encoding="utf-8"))] == []


def test_tables_and_comparisons_escape_every_word():
    assert_harmless(Table((EVIL, "b"), [(EVIL, 1.0)], EVIL)._repr_html_())
    rows = [Row(EVIL, EVIL, "3.14", 3.5, EVIL), Row(EVIL, EVIL, "3.14", 3.14, EVIL)]
    told = Comparison(EVIL, EVIL, rows, EVIL)._repr_html_()
    assert_harmless(told)
    assert "<b>off by" in told


@dataclass(frozen=True)
class Evil(Design):
    """A design whose every word is hostile, on a plane of two numbers."""

    x: float = quantity(EVIL, 1, 0.1, 4, "mm", EVIL)
    y: float = quantity(EVIL, 2, 0.1, 4, "mm", EVIL)

    def analyse(self, n: int = 361) -> EvilAnalysis:
        return EvilAnalysis(self)


@dataclass(frozen=True)
class EvilAnalysis:
    """What is measured of it."""

    cam: Evil

    @property
    def cam_angle(self):
        return np.linspace(0, 1, 5)


def evil_measure(i: int, function) -> Measure:
    return Measure(f"{EVIL} {i}", "mm", function)


FIRST = evil_measure(1, lambda a: np.ravel(a.cam.x + a.cam.y) if np.ndim(a.cam.x) else a.cam.x + a.cam.y)
SECOND = evil_measure(
    2, lambda a: np.ravel(a.cam.y * 3 - 2 * a.cam.x) if np.ndim(a.cam.x) else a.cam.y * 3 - 2 * a.cam.x
)
LIMITED = evil_measure(3, lambda a: np.ravel(a.cam.x * 2) if np.ndim(a.cam.x) else a.cam.x * 2)
MEASURES = (FIRST, SECOND, LIMITED)


class EvilLaw(Cycloidal):
    """A law with a hostile name."""

    name = EVIL


def study(start=None, weights=None, reference=None, space=None) -> Study:
    free = space or {"x": (0.5 * mm, 3 * mm), "y": (0.5 * mm, 3 * mm)}
    return Study(start or Evil(), free, (FIRST, SECOND), at_most={LIMITED: 5 * mm})


def evil_view(analysis):
    point = Points("point", analysis.cam.x, analysis.cam.y, label=EVIL)
    return Picture.of(Axes(title=EVIL, xlabel=EVIL, ylabel=EVIL), point)


def widgets(box: w.Widget) -> list[w.Widget]:
    return [box, *(inner for child in getattr(box, "children", ()) for inner in widgets(child))]


def assert_panel_harmless(panel, at_least: int = 1) -> None:
    """No HTML of the panel makes an element, and the name is told where it belongs."""
    pages = [widget for widget in widgets(panel) if isinstance(widget, Sheet | Instrument)]  # which make text nodes
    shown = [page.structure if isinstance(page, Instrument) else [page.body, page.heading] for page in pages]
    told = json.dumps(shown).count("onerror")
    texts = [widget.value for widget in widgets(panel) if isinstance(widget, w.HTML)]
    for text in texts:
        assert_harmless(text)
    assert told + sum("onerror" in text for text in texts) >= at_least
    assert not any(getattr(widget, "description_allow_html", False) for widget in widgets(panel))


@pytest.fixture(scope="module")
def explorer():
    return explore(Evil(), evil_view, measures=MEASURES, at_most={LIMITED: 1 * mm})


@pytest.fixture(scope="module")
def front():
    return nsga2(study(), 24, 8, seed=1)


def test_a_design_escapes_its_declarations():
    assert_harmless(Evil()._repr_html_())
    assert Evil()._repr_html_().count("onerror") == 4


def test_side_by_side_is_safe_as_html_and_as_markdown():
    told = side_by_side({EVIL: Evil(), "b": Evil(x=2 * mm)}, MEASURES, study())
    assert_harmless(told.html())
    page = Elements(told.page(EVIL, b"png"))
    assert page.tags <= ALLOWED | {"html", "head", "meta", "title", "style", "body", "h1", "p", "img"}
    assert "onerror" not in page.attributes
    lines = told.markdown(EVIL).splitlines()
    assert not any("<" in line for line in lines)
    assert {line.replace("\\|", "").count("|") for line in lines if line.startswith("|")} == {5}


def test_the_explorer_and_what_belongs_to_it(explorer):
    assert_panel_harmless(explorer, 3)
    move(explorer, "x", -1)
    assert_panel_harmless(explorer, 3)
    explorer.load(Evil())
    kept = shortlist(explorer, study())
    kept.keep()
    assert_panel_harmless(kept)
    assert_panel_harmless(tolerance_panel(explorer, study()), 3)
    assert_panel_harmless(presets(explorer, {EVIL: {EVIL: lambda design: design}}, {EVIL: lambda design: design}))


def test_judgements_and_fronts(explorer, front, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a search is kept beside the notebook
    judged = ahp_panel(Judgements([EVIL, "b"], [3]), EVIL)
    assert_panel_harmless(judged, 3)
    judged.boxes[0, 1].value = EVIL
    assert_panel_harmless(judged, 4)
    space = {"x": (0.5 * mm, 3 * mm), "y": (0.5 * mm, 3 * mm)}
    found = pareto_panel(explorer, {EVIL: study()}, space, ["x", "y"], population=24, generations=4)
    found.run()
    found.wait(60)
    assert_panel_harmless(found, 3)
    assert_panel_harmless(choose_panel(found), 2)
    assert_panel_harmless(live_pareto_panel(explorer, {EVIL: study()}, space))
    assert_panel_harmless(compare_fronts(explorer, given={EVIL: front}))


def test_the_survey_and_the_program(explorer):
    plane = Study(
        explorer.start, {"x": (0.5 * mm, 3 * mm), "y": (0.5 * mm, 3 * mm)}, (FIRST,), at_most={LIMITED: 5 * mm}
    )
    assert_panel_harmless(contour_panel(explorer, {EVIL: plane}, {"first": 1.0}, steps=7))
    segments = (Rise(90 * deg, 10 * mm, EvilLaw()), Dwell(90 * deg), Return(180 * deg, 10 * mm, EvilLaw()))
    assert_panel_harmless(edit_program(MotionProgram(segments)), 2)


# ---------------------------------------------------------------- pictures


def test_a_picture_draws_dollars_as_dollars():
    drawn = picture(EvilAnalysis(Evil()), evil_view)
    assert drawn._repr_png_()
    assert drawn.axes[0].get_title(loc="left").count(r"\$") == EVIL.count("$")


LETTERS = json.loads((Path(__file__).parent / "data" / "page" / "numbers.json").read_text())["letters"]


@pytest.mark.parametrize(("symbol", "shown"), LETTERS)
def test_symbols_have_the_letters_that_the_page_gives_them(symbol, shown):
    assert letters(symbol) == shown
    assert plain(symbol) == shown


def test_powers_of_units_are_raised():
    assert letters("a  [m/s^2]") == "a  [m/s²]"
    assert letters("[N^0.5 mm^-0.5]") == "[N⁰·⁵ mm⁻⁰·⁵]"
