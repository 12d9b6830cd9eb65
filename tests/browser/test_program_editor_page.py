"""The editor of a motion program in JupyterLab: handles that follow the pointer, rows and verdicts that follow them."""

import nbformat
import pytest
from playwright.sync_api import Locator, Page, expect

from lab import LabServer, cell_output, eventually, in_picture, kernel_value, open_notebook, run_all

SOURCE = """
from camkit import Cycloidal, Dwell, MotionProgram, Return, Rise, SimpleHarmonic, deg, edit_program, mm
editor = edit_program(MotionProgram((Dwell(45 * deg), Rise(90 * deg, 20 * mm, Cycloidal()), Dwell(45 * deg),
                                     Return(120 * deg, 20 * mm, SimpleHarmonic()), Dwell(60 * deg))))
heard = []
editor.on_change(lambda program: heard.append(float(program.edges[2]) / deg))
editor"""


@pytest.fixture(scope="module")
def page(window: Page, server: LabServer) -> Page:
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SOURCE)])
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
