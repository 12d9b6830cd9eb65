"""The button "To the workshop" in JupyterLab: a form, what is wrong in a sentence, and a zip that opens."""

import io
import os
import zipfile
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import expect

from camkit import TranslatingRollerCam, mm
from camkit.files import from_json
from lab import Instrument, eventually, kernel_value, open_notebook, run_all, screenshot

SOURCE = """
from camkit import TranslatingRollerCam, deg, explore
from camkit.cam import max_pressure_angle

app = explore(TranslatingRollerCam(), at_most={max_pressure_angle: 25 * deg})
app"""
HOSTILE = "<img src=x onerror=alert(1)> 凸轮"


@pytest.fixture
def app(page, server):
    page.set_viewport_size({"width": 1366, "height": 768})
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(SOURCE)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "workshop.ipynb")
    open_notebook(page, "workshop.ipynb")
    run_all(page)
    page.wait_for_selector(".camkit-page canvas")
    return Instrument(page)


def look(page, name):
    """Keep a picture, where somebody asks for it."""
    if folder := os.environ.get("CAMKIT_LOOK"):
        screenshot(page, Path(folder) / f"{name}.png")


def opened(download):
    with zipfile.ZipFile(io.BytesIO(Path(download.path()).read_bytes())) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def type_in(dock, name, text):
    box = dock.get_by_label(name, exact=True)
    box.fill(text)
    box.press("Enter")


def test_from_the_button_to_the_zip(page, app):
    assert kernel_value(page, "len(app.tabs)") == 0  # it costs nothing before somebody asks
    look(page, "bar")
    page.get_by_label("Export").select_option("workshop")
    page.get_by_role("tab", name="Workshop", selected=True).wait_for()
    dock = page.locator(".camkit-dock:visible")
    dock.get_by_text("Nothing is wrong with it.").wait_for()
    expect(dock.get_by_role("checkbox")).to_have_count(0)
    type_in(dock, "title", HOSTILE)
    type_in(dock, "author", "M. Curie")
    type_in(dock, "bore, mm, number", "20")
    dock.get_by_role("combobox", name="keyway").select_option("DIN 6885-1")
    dock.get_by_role("combobox", name="unit").select_option("inch")
    eventually(lambda: kernel_value(page, "app.tabs[0]['sheets'][0].blank.bore") == pytest.approx(20 * mm))
    look(page, "form")
    assert dock.evaluate("dock => dock.scrollWidth <= dock.clientWidth")
    with page.expect_download() as saved:
        dock.get_by_role("button", name="To the workshop").click()
    assert saved.value.suggested_filename == "TranslatingRollerCam.zip"
    files = opened(saved.value)
    assert from_json(files["TranslatingRollerCam.json"]) == TranslatingRollerCam()
    text = files["README.txt"].decode()
    assert HOSTILE in text
    assert "lengths in inches" in text
    assert "M. Curie" in text
    dock.get_by_text(f"{len(files) - 1} files and README.txt").wait_for()
    look(page, "made")

    type_in(dock, "hub diameter, mm, number", "21")  # the keyway would not have room in it
    dock.get_by_text("There is no such blank: the hub diameter is 21 mm").wait_for()
    page.evaluate("document.body.dataset.jpThemeLight = 'false'")
    look(page, "dark")
    page.evaluate("document.body.dataset.jpThemeLight = 'true'")

    expect(dock.get_by_role("button", name="To the workshop")).to_be_disabled()
    type_in(dock, "hub diameter, mm, number", "0")
    dock.get_by_text("There is no such blank").wait_for(state="hidden")
    app.type("base radius, mm", "20")
    dock.get_by_text("the maximum pressure angle is").wait_for()
    look(page, "faulty")
    button, insist = dock.get_by_role("button", name="To the workshop"), dock.get_by_role("checkbox")
    expect(button).to_be_disabled()
    insist.focus()
    page.keyboard.press("Space")
    expect(button).to_be_enabled()
    button.focus()
    with page.expect_download() as saved:
        page.keyboard.press("Enter")
    assert "FAULTY: the maximum pressure angle is" in opened(saved.value)["README.txt"].decode()
    assert page.locator(".camkit-page canvas").first.is_visible()


def test_the_menu_says_in_plain_words_what_there_is(page, app):
    menu = page.get_by_label("Export")
    words = menu.locator("option").all_inner_texts()
    assert words[:4] == ["Export", "To the workshop: all files in a zip …", "Design (JSON)", "Living page (HTML)"]
    assert {"Profile or skeleton (DXF)", "Picture (SVG)"} <= set(words)
    with page.expect_download() as saved:
        menu.select_option(label="Profile or skeleton (DXF)")
    assert saved.value.suggested_filename == "TranslatingRollerCam.dxf"
