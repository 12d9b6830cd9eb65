"""What a person did outlives a reload, a kernel and a saved notebook; an earlier design is offered and never taken."""

from pathlib import Path

import nbformat
import pytest
from playwright.sync_api import expect

from camkit.quantities import measures_of
from camkit.views import default_views
from lab import eventually, kernel_value, load_notebook, open_notebook, run_all, screenshot
from test_instrument_page import LIMITS, PAGE, START, STUDY, of_page, settled
from test_living_page import DRAG, compare

REPOSITORY = Path(__file__).parents[2]
SAVE = "() => window.jupyterapp.commands.execute('docmanager:save')"
RESTART = "() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.restart()"
SHUT_DOWN = "() => window.jupyterapp.shell.currentWidget.sessionContext.shutdown()"
STAND = f"""() => {{
    const {{ values, history, ghost, tabs, units }} = {PAGE}, plain = (steps) => steps.map((step) => step.values);
    const pinned = ghost && [...ghost.values];
    return [units.name, [...values], plain(history.past), plain(history.future), pinned, tabs.shown.name];
}}"""
ARM = "lift arm, mm"
ASKS = ".camkit-page [data-asks]"


@pytest.fixture
def notebook(page, server, request):
    """A notebook of one cell, of which nothing is kept yet, and what runs it."""
    name = f"{request.node.name.split('[')[0]}.ipynb"
    written = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(START)])
    written.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3 (ipykernel)", "language": "python"}
    nbformat.write(written, server.root / name)
    open_notebook(page, name)
    return name


def run(page):
    run_all(page)
    page.wait_for_selector(".camkit-page canvas")
    settled(page)


def step(page, times):
    """A person moves a slider by its keys."""
    for _ in range(times):
        page.get_by_label(ARM, exact=True).press("ArrowRight")
        settled(page)


def work(page):
    """A person moves, takes it back, pins a design, turns the mechanism and looks at the numbers."""
    step(page, 3)
    page.get_by_role("button", name="Undo").click()
    page.get_by_role("button", name="Pin to compare").click()
    step(page, 1)
    page.locator(".camkit-play input[type=range]").first.press("ArrowRight")
    page.get_by_role("tab", name="Numbers").click()
    settled(page)
    page.get_by_label("units", exact=True).select_option("mm, rad, N")
    eventually(lambda: kernel_value(page, "[app.page.get('tab'), app.page.get('units')]") == ["Numbers", "mm, rad, N"])
    return page.evaluate(STAND)


def test_a_reload_brings_back_the_page_as_it_was(page, notebook):
    run(page)
    before = work(page)
    page.evaluate(SAVE)
    load_notebook(page, notebook)  # the kernel is the same
    page.wait_for_selector(".camkit-page canvas")
    page.wait_for_function(f"() => {PAGE}?.ghost")
    settled(page)
    assert page.evaluate(STAND) == before
    assert kernel_value(page, "app.keeper.live") is True  # and before that it has answered what the page asked
    expect(page.locator(".camkit-offer:visible")).to_have_count(0)  # it is there already
    step(page, 1)
    eventually(lambda: kernel_value(page, "app.design.lift_arm") == page.evaluate(f"{PAGE}.values[0]"))


def test_a_saved_notebook_reopens_with_a_page_that_computes(page, notebook, server):
    run(page)
    before = work(page)
    page.evaluate(SAVE)
    server.end_kernels()
    load_notebook(page, notebook)
    page.wait_for_selector(".camkit-page canvas")
    page.wait_for_function(f"() => {PAGE}?.ghost")
    settled(page)
    assert kernel_value(page, "'app' in globals()") is False  # no cell ran
    assert page.evaluate(STAND) == before
    expect(page.locator(".camkit-note")).to_contain_text("No kernel knows this page: it computes by itself")
    page.get_by_role("tab", name="Curves").click()
    page.evaluate(DRAG, [0.4, 3])
    page.get_by_label("units").select_option("mm, deg, N")  # those of the package's pictures
    settled(page)
    compare(of_page(page), STUDY.start, default_views(STUDY.start.analyse()), measures_of(STUDY.start), LIMITS)
    assert [control.is_disabled() for control in page.locator(ASKS).all()] == [True] * page.locator(ASKS).count() != []
    page.get_by_role("button", name="Play").click()
    turned = page.evaluate(f"{PAGE}.values.at(-1)")
    eventually(lambda: page.evaluate(f"{PAGE}.values.at(-1)") != turned)
    state = nbformat.read(server.root / notebook, as_version=4).metadata.widgets
    assert "camkit/1" not in str(state)  # no file of a design


def test_a_kernel_that_restarts_is_said_in_a_sentence(page, notebook):
    run(page)
    step(page, 2)
    page.evaluate(RESTART)
    expect(page.locator(".camkit-note")).to_contain_text("No kernel knows this page: it computes by itself")
    assert [control.is_disabled() for control in page.locator(ASKS).all()] == [True] * page.locator(ASKS).count() != []
    step(page, 1)
    assert page.evaluate(f"{PAGE}.values[0]") == pytest.approx(0.0503)


def test_a_kernel_that_is_shut_down_is_said_in_a_sentence(page, notebook, server):
    run(page)
    step(page, 2)
    expect(page.locator(".camkit-note:visible")).to_have_count(0)
    page.evaluate(SHUT_DOWN)
    expect(page.locator(".camkit-note")).to_contain_text("No kernel knows this page: it computes by itself")
    step(page, 1)
    assert page.evaluate(f"{PAGE}.values[0]") == pytest.approx(0.0503)


def test_an_earlier_design_is_offered_and_taken_by_a_click_alone(page, notebook):
    run(page)
    before = work(page)
    page.evaluate(RESTART)
    run(page)  # all cells
    offer = page.locator(".camkit-offer")
    expect(offer).to_contain_text("Continue with your last design, lift arm 50.3 mm?")
    screenshot(page, REPOSITORY / ".browser" / "offer.png")
    assert kernel_value(page, "app.design == app.start") is True
    assert page.evaluate(f"{PAGE}.values[0]") == 0.05
    offer.get_by_role("button", name="Continue").click()
    page.wait_for_function(f"() => {PAGE}?.ghost && {PAGE}.values[0] > 0.05")
    settled(page)
    assert page.evaluate(STAND) == before
    assert kernel_value(page, "app.design.lift_arm") == pytest.approx(0.0503)
    expect(page.locator(".camkit-offer:visible")).to_have_count(0)
    run(page)
    page.locator(".camkit-offer").get_by_role("button", name="No").click()
    expect(page.locator(".camkit-offer:visible")).to_have_count(0)
    assert kernel_value(page, "app.design == app.start") is True


def test_a_notebook_that_nobody_ran_here_shows_pictures(page):
    open_notebook(page, "05_cam_size.ipynb")
    expect(page.locator(".jp-RenderedImage img").first).to_be_visible()
    assert page.locator(".camkit-page").count() == 0
    assert page.get_by_text("Error displaying widget").count() == 0


def test_whoever_saves_a_page_hears_that_jupyterlab_has_to_trust_it(page, notebook):
    run(page)
    with page.expect_download() as saved:
        page.get_by_label("Export").select_option("html")
    assert saved.value.suggested_filename == "DoorHandleCam.html"
    expect(page.locator(".camkit-note")).to_contain_text("Trust HTML")
