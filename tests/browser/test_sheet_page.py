"""Sheets in JupyterLab: what a person does with each kind of part, and what the kernel and the page make of it."""

import re

import nbformat
import pytest
from playwright.sync_api import Locator, Page, expect

from lab import LabServer, cell_output, eventually, kernel_value, open_notebook, run_all

SOURCE = """
import time
from camkit.panels.kit.drawn import LivePicture
from camkit.panels.kit.inputs import Amount, Check, Menu, Number, Scale, Span, Typed, Whole
from camkit.panels.kit.parts import Banner, Button, Group, Progress, Table, Words, row
from camkit.panels.kit.sheet import Panel
from camkit.quantities import Quantity
from camkit.views.picture import Axes, Line, Picture

heard, pressed = [], []


def wave(size):
    return Picture.of(Axes(title="a wave"), Line("wave", [0.0, 1.0], [0.0, size]))


class OneOfEach(Panel):
    def __init__(self):
        self.banner, self.numbers = Banner(), Table()
        self.arm = Number("arm", Quantity("l", 40, 10, 90, "mm", "an arm", above=0), 0.04, self.moved)
        self.menu = Menu(["first", "second"], "problem")
        self.bare = Menu(["one", "two"], tooltip="law")
        self.scale = Scale([("1/3", 1 / 3), ("1", 1.0), ("3", 3.0)], "a against b", value=1.0)
        self.starts, self.population = Whole(3, 1, 9, "starts"), Whole(20, 4, 1000, "population", slider=True)
        self.check, self.amount = Check(description="groove"), Amount(description="lift", unit="mm", value=5.0)
        self.typed = Typed(description="name", value="a")
        self.span = Span(description="band", min=0.0, max=4.0, value=(1.0, 2.0))
        self.button = Button("Press", lambda: pressed.append(1))
        self.fails = Button("Fail", lambda: 1 / 0)
        self.picture = LivePicture((wave,), "what waves")
        self.picture.show(1.0)
        self.numbers.put(("a", "b"), [(1, 2)])
        group = Group(self.amount, self.typed, description="segment 1")
        inputs = self.arm, self.menu, self.bare, self.scale, self.starts, self.population, self.check, self.span
        shown = row(self.button, self.fails), Progress(value=1, max=4), self.banner, self.numbers, self.picture
        super().__init__(row(*inputs), group, *shown, heading="One of each")

    def moved(self):
        heard.append(self.arm.value)
        time.sleep(0.15)  # slower than a hand
        self.picture.show(self.arm.value)

    def summary(self):
        return "one of each"


sheet = OneOfEach()
sheet"""
SHEET = "document.querySelector('.camkit-sheet').parentElement.camkit"


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Page:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SOURCE)])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "sheet.ipynb")
    open_notebook(window, "sheet.ipynb")
    run_all(window)
    return window


@pytest.fixture
def sheet(page: Page) -> Locator:
    return cell_output(page, 0).locator(".camkit-sheet")


def quiet(page: Page) -> None:
    """Wait until all that was done is answered."""
    page.wait_for_function(f"() => {SHEET}.waiting.size === 0 && {SHEET}.answered >= {SHEET}.asked")


def test_every_part_has_a_name_of_its_own(page: Page, sheet: Locator) -> None:
    wanted = [
        ("slider", "arm, mm"), ("textbox", "arm, mm, number"), ("combobox", "problem"), ("combobox", "law"),
        ("slider", "a against b"), ("textbox", "starts"), ("slider", re.compile("population")), ("checkbox", "groove"),
        ("slider", "band, least"), ("slider", "band, greatest"), ("textbox", "lift, mm"), ("textbox", "name"),
        ("button", "Press"), ("group", "segment 1"), ("group", "what waves"), ("group", "table"),
        ("progressbar", "progress"), ("heading", "One of each"),
    ]  # fmt: skip
    for role, name in wanted:
        exact = isinstance(name, str)
        expect(sheet.get_by_role(role, name=name, exact=exact)).to_have_count(1)  # type: ignore[arg-type]
    expect(sheet.get_by_role("img")).to_have_attribute("aria-label", re.compile("wave"))
    sheet.get_by_role("img").hover()
    expect(sheet.locator(".camkit-tip")).to_have_text(re.compile(r"x [\d.]+\s+y [\d.]+"))
    for control in sheet.locator("input, select, button, canvas").all():
        assert control.get_attribute("data-lm-suppress-shortcuts") == "true", control.evaluate("e => e.outerHTML")


def test_a_fast_drag_never_queues_and_the_last_value_is_shown(page: Page, sheet: Locator) -> None:
    slider = sheet.get_by_role("slider", name="arm, mm", exact=True)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    most = 0
    for i in range(60):
        page.mouse.move(x + 30 - abs(i - 30), y)
        most = max(most, page.evaluate(f"() => {SHEET}.waiting.size + {SHEET}.asked - {SHEET}.answered"))
    held = float(slider.input_value())
    quiet(page)
    assert float(slider.input_value()) == held  # the kernel, far behind, has not moved it back
    page.mouse.up()
    quiet(page)
    assert most <= 2  # one under way and the newest
    moves = kernel_value(page, "heard")
    assert moves[-1] == pytest.approx(held / 1000, rel=1e-12)
    assert 1 <= len(moves) < 40
    drawn = f"() => {SHEET}.shown().pictures[0].marks.find((mark) => mark.key === 'wave').y.at(-1)"
    eventually(lambda: page.evaluate(drawn) == pytest.approx(moves[-1], rel=1e-12))
    expect(sheet.get_by_role("textbox", name="arm, mm, number")).to_have_value(f"{held:.6g}")


def test_a_text_that_is_being_typed_outlives_the_answers_to_what_was_done_before(page: Page, sheet: Locator) -> None:
    box = sheet.get_by_role("textbox", name="arm, mm, number", exact=True)
    slider = sheet.get_by_role("slider", name="arm, mm", exact=True)
    answered = page.evaluate(f"() => {SHEET}.answered")
    slider.press("ArrowRight")
    box.fill("33")
    page.wait_for_function(f"() => {SHEET}.answered > {answered}")
    quiet(page)
    expect(box).to_have_value("33")
    box.press("Enter")
    eventually(lambda: kernel_value(page, "sheet.arm.value") == pytest.approx(0.033))


BOXES = [
    ("arm, mm, number", "48,5", "sheet.arm.value", 0.0485), ("arm, mm, number", "2 in", "sheet.arm.value", 0.0508),
    ("starts", "7", "sheet.starts.value", 7), ("lift, mm", "0.5 cm", "sheet.amount.value", 5.0),
    ("lift, mm", "12,5", "sheet.amount.value", 12.5), ("name", "1/5", "sheet.typed.value", "1/5"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "typed", "value", "meant"), BOXES)
def test_enter_takes_what_is_in_a_box(
    page: Page, sheet: Locator, name: str, typed: str, value: str, meant: float | str
) -> None:
    box = sheet.get_by_role("textbox", name=name, exact=True)
    box.fill(typed)
    box.press("Enter")
    eventually(lambda: kernel_value(page, value) == (meant if isinstance(meant, str) else pytest.approx(meant)))
    expect(box).to_be_focused()


@pytest.mark.parametrize(
    ("name", "typed", "why"),
    [
        ("arm, mm, number", "abc", "'abc' is no number"),
        ("starts", "10", "a whole number from 1 to 9"),
        ("lift, mm", "x", "'x' is no number"),
    ],
)
def test_what_is_no_number_is_refused_in_place(page: Page, sheet: Locator, name: str, typed: str, why: str) -> None:
    asked = page.evaluate(f"() => {SHEET}.asked")
    box = sheet.get_by_role("textbox", name=name, exact=True)
    box.fill(typed)
    box.press("Enter")
    expect(sheet.get_by_role("alert").filter(has_text=why)).to_be_visible()
    assert page.evaluate(f"() => {SHEET}.asked") == asked  # nobody was asked


def test_all_can_be_done_by_keys_alone(page: Page, sheet: Locator) -> None:
    cells = "window.jupyterapp.shell.currentWidget.content.widgets.length"
    for role, name, key, value, wanted in (
        ("slider", "a against b", "ArrowRight", "sheet.scale.value", 3.0),
        ("slider", "band, least", "End", "list(sheet.span.value)", [2.0, 4.0]),
        ("slider", "population", "ArrowRight", "sheet.population.value", 21),
        ("combobox", "problem", "ArrowDown", "sheet.menu.value", "second"),
        ("checkbox", "groove", "Space", "sheet.check.value", True),
        ("button", "Press", "Enter", "len(pressed)", 1),
        ("button", "Press", "b", "len(pressed)", 1),  # no key of JupyterLab
    ):
        control = sheet.get_by_role(role, name=name).first  # type: ignore[arg-type]
        control.focus()
        control.press(key)
        eventually(lambda value=value, wanted=wanted: kernel_value(page, value) == wanted)  # type: ignore[misc]
    assert page.evaluate(cells) == 1
    sheet.get_by_role("slider", name="arm, mm", exact=True).focus()
    met = ["arm, mm"]
    for _ in range(16):
        page.keyboard.press("Tab")
        met.append(page.evaluate("document.activeElement.ariaLabel || document.activeElement.textContent"))
    wanted = {"a against b", "band, least", "band, greatest", "lift, mm", "name", "Press", "Fail", "table"}
    assert wanted <= set(met)


def test_an_error_is_said_and_the_sheet_lives_on(page: Page, sheet: Locator) -> None:
    sheet.get_by_role("button", name="Fail").click()
    expect(sheet.get_by_role("alert").filter(has_text="Division by zero.")).to_be_visible()
    before = kernel_value(page, "len(pressed)")
    sheet.get_by_role("button", name="Press").click()
    eventually(lambda: kernel_value(page, "len(pressed)") == before + 1)
