"""The editor of a motion program in JupyterLab: handles that follow the pointer, rows and verdicts that follow them."""

import nbformat
import pytest
from playwright.sync_api import BrowserContext, Locator, Page, ViewportSize, expect

from lab import LabServer, cell_output, eventually, in_picture, kernel_value, open_notebook, run_all

SOURCE = """
from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, edit_program, mm
editor = edit_program(MotionProgram((Dwell(45 * deg), Rise(90 * deg, 20 * mm, Cycloidal()), Dwell(45 * deg),
                                     Return(120 * deg, 20 * mm, SimpleHarmonic()), Dwell(60 * deg))))
heard = []
editor.on_change(lambda program: heard.append(float(program.edges[2]) / deg))
editor"""
SIZE: ViewportSize = {"width": 1400, "height": 900}
CONVEYOR = """
from camkit.motion import MatchedProgram, Polynomial, Uniform
from camkit.units import inch, rpm
belt = Uniform(22 * inch / (58 * rpm), 1.1 * inch)
conveyor = edit_program(MatchedProgram((Polynomial(60 * deg), belt, Polynomial(), Dwell(60 * deg))))
conveyor"""


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Page:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in (SOURCE, CONVEYOR)])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    nbformat.write(notebook, server.root / "editor.ipynb")
    open_notebook(window, "editor.ipynb")
    run_all(window)
    return window


@pytest.fixture
def editor(page: Page) -> Locator:
    output = cell_output(page, 0)
    output.get_by_role("button", name="Reset").click()
    eventually(lambda: kernel_value(page, "editor.program == editor.start"))
    for k, angle in enumerate(("45", "90", "45", "120", "60"), 1):
        expect(segment(output, k).get_by_role("textbox", name="angle, deg")).to_have_value(angle)
    return output


def segment(editor: Locator, k: int) -> Locator:
    return editor.get_by_role("group", name=f"segment {k}", exact=True)


def test_a_handle_follows_the_pointer_and_the_rows_follow_the_handle(page: Page, editor: Locator) -> None:
    page.mouse.move(*in_picture(editor, 135, 20))
    page.mouse.down()
    for i in range(1, 41):
        page.mouse.move(*in_picture(editor, 135 + i / 2, 20 + i / 20))
    page.mouse.move(*in_picture(editor, 155, 24))
    eventually(lambda: kernel_value(page, "float(editor.program.edges[2])/deg") == pytest.approx(155, abs=0.5))
    shown = "() => document.querySelector('.camkit-sheet').parentElement.camkit.shown().pictures[0].marks"
    handles = f"{shown}.find((mark) => mark.key === 'handles').x[2]"
    page.wait_for_function(f"{handles} > 154")  # while it is still held
    page.mouse.up()
    expect(segment(editor, 2).get_by_role("textbox", name="angle, deg")).to_have_value(
        f"{kernel_value(page, 'float(editor.rows[1].angle.value)'):.12g}"
    )
    assert kernel_value(
        page, "[float(s.lift) / mm for s in (editor.program.segments[1], editor.program.segments[3])]"
    ) == (pytest.approx([24, 24], abs=0.5))
    assert kernel_value(page, "len(heard)") <= 42  # none twice
    page.mouse.move(*in_picture(editor, 120, 10))
    assert kernel_value(page, "float(editor.program.edges[2]) / deg") > 150  # it was let go


def test_verdicts_follow_the_law_and_a_program_that_cannot_be_is_said(page: Page, editor: Locator) -> None:
    expect(editor.get_by_role("status").first).to_have_text("✗ The motion is not smooth at 180°, 300°.")
    expect(editor.locator(".camkit-transition .camkit-missed").first).to_contain_text("180°: acceleration step")
    segment(editor, 4).get_by_role("combobox", name="law").select_option("cycloidal")
    expect(editor.locator(".camkit-missed")).to_have_count(0)
    box = segment(editor, 2).get_by_role("textbox", name="angle, deg")
    box.fill("390")
    box.press("Enter")
    expect(editor.get_by_role("alert").filter(has_text="the others it can be 356 °")).to_be_visible()
    expect(editor.locator("canvas").first).to_be_visible()
    box.fill("80°")
    box.press("Enter")
    expect(segment(editor, 3).get_by_role("textbox", name="angle, deg")).to_have_value("55")
    assert kernel_value(page, "editor.program.segments[1].angle / deg") == pytest.approx(80)


def test_undo_and_what_makes_a_transition_smooth(page: Page, editor: Locator) -> None:
    editor.get_by_role("button", name="Make it smooth").first.click()
    expect(editor.get_by_role("status").first).to_contain_text("continuous all around")
    expect(editor.get_by_role("button", name="Make it smooth")).to_have_count(0)
    editor.get_by_role("button", name="Undo").click()
    expect(editor.get_by_role("status").first).to_contain_text("not smooth at 180°, 300°")
    assert kernel_value(page, "editor.program == editor.start")


def test_a_laws_number_is_typed_below_it(page: Page, editor: Locator) -> None:
    segment(editor, 2).get_by_role("combobox", name="law").select_option("constant velocity with blends")
    box = editor.get_by_role("textbox", name="blend")
    expect(box).to_have_value("0.25")
    box.fill("0,4")
    box.press("Enter")
    eventually(lambda: kernel_value(page, "editor.program.segments[1].law.blend") == 0.4)
    segment(editor, 2).get_by_role("combobox", name="law").select_option("cycloidal")
    expect(box).to_have_count(0)


def test_segments_come_and_go(page: Page, editor: Locator) -> None:
    segment(editor, 1).get_by_role("button", name="remove this segment").click()
    expect(segment(editor, 5)).to_have_count(0)
    expect(segment(editor, 1).get_by_role("textbox", name="lift, mm")).to_have_value("20")
    expect(segment(editor, 1).get_by_role("textbox", name="angle, deg")).to_have_value("135")
    segment(editor, 4).get_by_role("button", name="insert a segment after this one").click()
    expect(segment(editor, 5).get_by_role("combobox", name="kind")).to_have_value("1")
    expect(segment(editor, 5).get_by_role("textbox", name="angle, deg")).to_have_value("30")
    expect(segment(editor, 5).get_by_role("textbox", name="lift")).to_be_hidden()


SMOOTH = "✓ Position, velocity and acceleration are continuous all around."


def test_a_conveyors_segment_5_deg_longer_leaves_every_transition_smooth(page: Page, editor: Locator) -> None:
    conveyor = cell_output(page, 1)
    angle = segment(conveyor, 1).get_by_role("textbox", name="angle, deg")
    expect(segment(conveyor, 3)).to_contain_text("222.6 °")
    expect(segment(conveyor, 3)).to_contain_text("closes the turn")
    expect(segment(conveyor, 3).get_by_role("textbox")).to_have_count(0)  # nothing that would be refused
    angle.fill("65")
    angle.press("Enter")
    expect(segment(conveyor, 3)).to_contain_text("217.6 °")
    expect(conveyor.get_by_role("status").first).to_have_text(SMOOTH)
    expect(conveyor.locator(".camkit-missed")).to_have_count(0)
    assert kernel_value(page, "[t.lawful for t in conveyor.program.transitions()]") == [True] * 4
    conveyor.get_by_role("button", name="Undo").click()
    expect(angle).to_have_value("60")


def test_what_holds_at_a_transition_is_chosen_and_typed(page: Page, editor: Locator) -> None:
    conveyor = cell_output(page, 1)
    first = conveyor.locator(".camkit-transition:visible").first
    first.get_by_role("combobox", name="a", exact=True).select_option("free")
    expect(conveyor.get_by_role("status").first).to_have_text("✗ The motion is not smooth at 60°.")
    conveyor.get_by_role("button", name="Make it smooth").click()
    expect(conveyor.get_by_role("status").first).to_have_text(SMOOTH)
    last = conveyor.locator(".camkit-transition:visible").last
    level = last.get_by_role("textbox", name="position given")
    level.fill("1 in")
    level.press("Enter")
    eventually(lambda: kernel_value(page, "float(conveyor.program.start) / mm") == pytest.approx(25.4))
    conveyor.get_by_role("combobox", name="values").select_option("in time")
    speed = conveyor.get_by_role("textbox", name="speed, rpm")
    speed.fill("58")
    speed.press("Enter")
    expect(segment(conveyor, 2).get_by_role("textbox", name="velocity, m/s")).to_have_value("0.5588")


def test_a_program_goes_to_the_clipboard_as_code(page: Page, editor: Locator, context: BrowserContext) -> None:
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    editor.get_by_role("button", name="Copy as code").click()
    expect(editor.get_by_text("The program is copied as lines of Python.")).to_be_visible()
    eventually(lambda: page.evaluate("navigator.clipboard.readText()").startswith("from camkit.motion import"))


@pytest.mark.parametrize("k", [0, 1])
def test_fields_picture_and_verdict_are_on_one_screen(page: Page, editor: Locator, k: int) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    output = cell_output(page, k)
    output.scroll_into_view_if_needed()
    box = output.locator(".camkit-sheet").bounding_box()
    page.set_viewport_size(SIZE)
    assert box is not None
    assert box["height"] < 768 - 28 - 31 - 33 - 24  # what JupyterLab keeps of it


CUT = """(root) => {
    const pen = document.createElement('canvas').getContext('2d'), arrow = 16;
    return [...root.querySelectorAll('select')].filter((menu) => menu.offsetParent).filter((menu) => {
        const style = getComputedStyle(menu), words = menu.selectedOptions[0]?.text ?? '';
        pen.font = style.font;
        const beside = parseFloat(style.paddingLeft) + parseFloat(style.paddingRight);
        const taken = beside + (style.appearance !== 'none') * arrow;
        return pen.measureText(words).width > menu.clientWidth - taken;
    }).map((menu) => menu.selectedOptions[0].text);
}"""
"""The words in menus that are cut."""


@pytest.mark.parametrize("width", [1366, 1920])
def test_no_words_in_a_menu_are_cut(page: Page, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 768})
    output = cell_output(page, 1)
    expect(output.get_by_role("combobox", name="kind").nth(1)).to_be_visible()
    assert output.evaluate(CUT) == []
    page.set_viewport_size(SIZE)
