"""The live notebooks as pages without code, served by Voilà: `make app`."""

import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import Browser, Page, expect

from camkit import ArmLoad, DoorHandleCam
from camkit.cam.measures import groove_gap
from camkit.machines.door_handle import CURVE_TABLE, WORSE_CURVE
from camkit.quantities import quantities_of, with_quantities
from lab import OWN_SHEETS, Instrument, copy_notebooks, numbers_in, numbers_of, screenshot, voila_server
from test_hostile_names_page import DESIGN

REPOSITORY = Path(__file__).parents[2]
DOOR_HANDLE = "01_door_handle_cam.ipynb"
OTHERS = ("04_motion_program.ipynb", "05_cam_size.ipynb", "15_live_front.ipynb")
"""A program that is edited, cams beside each other, a front that follows the sliders: those that run quickest."""

HOSTILE = "explore(Evil(), view, measures=(first, second, limited), at_most={limited: 1 * mm})"
ASKED: list[str] = []
"""What all pages have asked for."""
ERRORS = "[data-mime-type='application/vnd.jupyter.error'], [data-mime-type='application/vnd.jupyter.stderr']"


@pytest.fixture(scope="module")
def opened(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], Page]]:
    """The page of a notebook, which is asked for once."""
    folder = tmp_path_factory.mktemp("voila")
    copy_notebooks(REPOSITORY / "notebooks", folder / "notebooks")
    cells = [nbformat.v4.new_code_cell(cell) for cell in (DESIGN, HOSTILE)]
    nbformat.write(nbformat.v4.new_notebook(cells=cells), folder / "notebooks" / "hostile.ipynb")
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    with voila_server(folder, REPOSITORY) as address:

        @cache
        def page_of(name: str) -> Page:
            page = context.new_page()
            page.on("request", lambda request: ASKED.append(request.url))
            page.goto(f"{address}/voila/render/{name}" if name else address, wait_until="commit", timeout=120_000)
            return page

        yield page_of
        context.close()


def test_the_first_page_has_a_card_for_each_notebook(opened: Callable[[str], Page]) -> None:
    page = opened("")
    names = sorted(path.name for path in (REPOSITORY / "notebooks").glob("*.ipynb"))[1:]
    expect(page.locator("li")).to_have_count(len(names) + 2)  # the course, and the page of this test
    course, *cards = page.locator("li").all()
    assert course.locator("a").get_attribute("href").endswith("/tree/course")
    for card, name in zip(cards, names, strict=False):
        assert card.locator("a").get_attribute("href").endswith(f"/render/{name}")
        assert card.locator("p").inner_text()
        expect(card.locator("img")).to_have_js_property("complete", True)
        assert card.locator("img").evaluate("image => image.naturalWidth") > 100
    screenshot(page, REPOSITORY / ".browser" / "cards.png")
    course.locator("a").click()
    lessons = sorted(path.name for path in (REPOSITORY / "notebooks/course").glob("*.ipynb"))
    expect(page.locator("li")).to_have_count(len(lessons))
    for card, name in zip(page.locator("li").all(), lessons, strict=True):
        assert card.locator("a").get_attribute("href").endswith(f"/render/course/{name}")
    screenshot(page, REPOSITORY / ".browser" / "lessons.png")


def test_a_page_says_what_is_loading_and_asks_nothing_from_outside(opened: Callable[[str], Page]) -> None:
    page = opened(OTHERS[1])  # for the first time
    address, _ = page.url.split("voila/render")
    loading = page.locator("#loading")
    expect(loading).to_contain_text("How large does a cam have to be?")
    expect(loading.locator("#loading_text")).to_have_text(re.compile("Python is starting|This page is read"))
    assert loading.locator("img").get_attribute("src") == "/voila/files/images/cards/05_cam_size.png"
    expect(page.locator(".camkit-page canvas").first).to_be_visible(timeout=120_000)
    assert any("voila/render" in url for url in ASKED)
    assert not [url for url in ASKED if not url.startswith((address, "data:", "blob:"))]


@pytest.mark.parametrize("name", [DOOR_HANDLE, *OTHERS])
def test_a_live_notebook_is_a_page_with_its_panels_and_its_prose(opened: Callable[[str], Page], name: str) -> None:
    page = opened(name)
    notebook = nbformat.read(REPOSITORY / "notebooks" / name, as_version=4)
    shown = sum("widget-view" in str(cell.get("outputs")) for cell in notebook.cells)
    try:
        panels = f"document.querySelectorAll({f'{OWN_SHEETS}, .camkit-page'!r}).length"  # a cell may show two
        page.wait_for_function(f"() => {panels} >= {shown}", timeout=120_000)
        expect(page.locator("h1").first).to_contain_text(notebook.cells[0].source.splitlines()[0].lstrip("# "))
        expect(page.locator(ERRORS)).to_have_count(0)
        expect(page.get_by_text("There was an error")).to_have_count(0)
        expect(page.get_by_text("import ")).to_have_count(0)  # the code is left out
    except AssertionError:
        screenshot(page, REPOSITORY / ".browser" / f"voila_{name}.png")
        raise


def test_a_slider_of_the_page_moves_picture_and_numbers(opened: Callable[[str], Page]) -> None:
    app = Instrument(opened(DOOR_HANDLE))
    start, before = DoorHandleCam(lift_load=ArmLoad(torque=10)), app.shown()["values"]
    app.slider("lift arm, mm").press("ArrowRight")
    shown = app.shown()
    paths = list(quantities_of(start))
    place = paths.index("lift_arm")
    assert shown["values"][place] > before[place]
    design = with_quantities(start, dict(zip(paths, shown["values"], strict=False)))  # the notebook ends with a winner
    measures = (*WORSE_CURVE.values(), groove_gap, *CURVE_TABLE)
    assert numbers_of(shown) == numbers_in(design, measures)


def test_names_that_are_pieces_of_a_page_stay_names(opened: Callable[[str], Page]) -> None:
    page = opened("hostile.ipynb")
    expect(page.locator(".camkit-page label").first).to_contain_text("<img src=x", timeout=120_000)
    assert page.evaluate("window.ran") is None
    assert page.locator(".evil, img[src=x]").count() == 0
