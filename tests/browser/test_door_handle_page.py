"""The door-handle workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from playwright.sync_api import Locator, Page, expect

from camkit import ArmLoad, DoorHandleCam, ahp, deg, door_handle_study, mm
from camkit.decision import CHOOSERS
from camkit.machines.door_handle import DOOR_HANDLE_SPACE
from camkit.quantities import quantities_of, value_of
from lab import (
    OWN_SHEETS,
    eventually,
    kernel_value,
    marks_of,
    open_notebook,
    run_all,
    type_number,
)

START = DoorHandleCam(lift_load=ArmLoad(torque=10))
PANEL = "document.querySelector('.camkit-page').parentElement.camkit"


@dataclass(frozen=True)
class Workbook:
    """The opened notebook: an instrument, two sheets of judgements, and a search."""

    page: Page
    criteria: Locator
    importance: Locator
    finder: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)


@pytest.fixture(scope="module")
def book(window: Page) -> Workbook:
    """The notebook opened and run once for all tests of this file."""
    open_notebook(window, "01_door_handle_cam.ipynb")
    run_all(window, timeout=300)
    sheets = window.locator(OWN_SHEETS)
    titles = ("What makes up the effort", "Effort against radius", "free quantities")
    return Workbook(window, *(sheets.filter(has_text=title) for title in titles))


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    """Each test begins with the paper's design and judgements."""
    for sheet in (book.criteria, book.importance):
        sheet.get_by_role("button", name="Reset").click()
    book.value("app.load(app.start)")
    eventually(
        lambda: book.value("[criteria.judgements.above, importance.judgements.above]") == [[5, 5, 1], [1]],
    )
    shows(book, START)


def shows(book: Workbook, design: DoorHandleCam) -> None:
    """The instrument stands at ``design``, and the kernel knows it."""
    values = pytest.approx([float(value_of(design, path)) for path in quantities_of(design)], rel=1e-12)
    eventually(lambda: book.page.evaluate(f"() => Array.from({PANEL}.values)")[: len(quantities_of(design))] == values)
    eventually(lambda: book.value("list(app.values)") == values)


def front_here(book: Workbook, weights: Any) -> tuple[np.ndarray, np.ndarray]:
    """The designs of the kernel's front and their objectives under ``weights``, computed here, beaten ones out."""
    x = np.array(book.value("finder.found.x"))
    f = door_handle_study(START, weights=weights).evaluate(x).f
    beaten = [any((g <= row).all() and (g < row).any() for g in f) for row in f]
    order = np.argsort(f[~np.array(beaten), 0], kind="stable")
    return x[~np.array(beaten)][order], f[~np.array(beaten)][order]


def wins(book: Workbook, weights: Any, importance: Any, rule: str) -> None:
    """The sheet names and draws the winner that is chosen here."""
    x, f = front_here(book, weights)
    i = CHOOSERS[rule](f, importance)
    goals = f"effort {f[i, 0]:.4g}, minimum convex radius of curvature, pitch curve, worse curve {-f[i, 1] / mm:.4g} mm"
    arm, start, share = x[i] / (mm, deg, deg)
    arms = f"lift arm {arm:.6g} mm, lift start angle {start:.6g} °, relief cam angle {share:.6g} °"
    expect(book.finder).to_contain_text(re.compile(rf"winner: design {i} of 0 to {len(f) - 1}: {re.escape(goals)}"))
    expect(book.finder).to_contain_text(arms)
    at = np.array([f[:, 0], -f[:, 1] / mm])
    eventually(lambda: np.shape(marks_of(book.finder)["front"]) == at.shape)
    assert_allclose(marks_of(book.finder)["front"], at, rtol=1e-9)
    assert_allclose(np.ravel(marks_of(book.finder)["winner"]), at[:, i], rtol=1e-9)


def weights_of(sheet: Locator, weights: Any) -> None:
    """The table of judgements ends with these weights."""
    expect(sheet.locator("td.camkit-bold")).to_have_text([f"{w:.4f}" for w in weights])


def test_the_rule_is_the_weighted_sum_where_objectives_are_judged(book: Workbook) -> None:
    assert book.finder.get_by_label("choose by").evaluate("menu => menu.selectedOptions[0].text") == "weighted sum"
    wins(book, ahp([5, 5, 1]).weights, ahp([1]).weights, "weighted sum")


def test_a_judgement_changes_weights_front_and_winner(book: Workbook) -> None:
    # Authority: ahp() and the choosers, called here with the judgements on the page.
    rule = book.finder.get_by_label("choose by")
    rule.select_option(label="crowding distance")
    try:
        for _ in range(3):
            book.criteria.get_by_role("slider").nth(0).press("ArrowRight")
        judged = ahp([2, 5, 1])
        weights_of(book.criteria, judged.weights)
        assert book.value("criteria.judgements.consistency_ratio") == pytest.approx(judged.consistency_ratio, abs=1e-12)
        wins(book, judged.weights, None, "crowding distance")
    finally:
        rule.select_option(label="weighted sum")


def test_what_matters_more_decides_the_winner(book: Workbook) -> None:
    slider = book.importance.get_by_role("slider")
    for judgement, presses in ((3, 2), (9, 6)):
        for _ in range(presses):
            slider.press("ArrowLeft")
        expect(slider).to_have_attribute("aria-valuetext", str(judgement))
        wins(book, ahp([5, 5, 1]).weights, ahp([judgement]).weights, "weighted sum")


def test_judgements_that_contradict_each_other_are_named(book: Workbook) -> None:
    book.criteria.get_by_role("slider").nth(1).press("End")
    judged = ahp([5, 1 / 9, 1])
    assert judged.consistency_ratio > 0.1
    said = f"consistency ratio {judged.consistency_ratio:.2f}, above 0.10"
    expect(book.criteria.get_by_role("alert").filter(has_text=said)).to_be_visible()
    weights_of(book.criteria, judged.weights)


def test_a_bound_that_cannot_be_is_refused_where_it_stands(book: Workbook) -> None:
    low = book.finder.get_by_label("lift arm, from, mm")
    before = low.input_value()
    for typed, said in (("many", "'many'"), ("70 mm", "This cannot be searched: the bounds of the lift arm are 70 mm")):
        low.fill(typed)
        low.press("Enter")
        expect(book.finder.get_by_role("alert").filter(has_text=said)).to_be_visible()
    low.fill(before)
    low.press("Enter")
    expect(book.finder.get_by_role("alert").filter(has_text=re.compile("."))).to_have_count(0)


@pytest.fixture
def endless(book: Workbook) -> Iterator[None]:
    """Far more generations than anybody waits for; a search that still runs at the end is stopped."""
    generations = book.finder.get_by_label("generations")
    settings = generations.input_value()
    generations.fill("10000")
    generations.press("Enter")
    yield
    if book.finder.get_by_role("button", name="Stop").is_enabled():
        book.finder.get_by_role("button", name="Stop").click()
    expect(book.finder.get_by_role("button", name="Optimise")).to_be_enabled()
    generations.fill(settings)
    generations.press("Enter")


@pytest.mark.usefixtures("endless")
def test_a_search_shows_its_progress_and_stops(book: Workbook) -> None:
    finder = book.finder
    status, bar = finder.locator(".camkit-status"), finder.locator("progress")
    stop = finder.get_by_role("button", name="Stop")

    finder.get_by_role("button", name="Optimise").click()

    expect(status).to_have_text(re.compile(r"^generation \d+ of 10000: \d+ of 100 feasible, \d+ on the front"))
    expect(finder.get_by_text(re.compile(r"^\d+ (s|min) left$"))).to_be_visible()
    seen, reached = status.inner_text(), bar.evaluate("bar => bar.value")
    expect(status).not_to_have_text(seen)
    eventually(lambda: bar.evaluate("bar => bar.value") > reached)
    type_number(book.page, "lift arm, mm", "47")  # the page is alive, and the search leaves the design alone
    shows(book, START.replace(lift_arm=47 * mm))

    stop.click()
    expect(status).to_contain_text("(stopped)")
    expect(finder.get_by_role("button", name="Optimise")).to_be_enabled()
    expect(stop).to_be_disabled()
    x, f = front_here(book, ahp([5, 5, 1]).weights)
    assert len(x) > 10
    assert_allclose(book.value("finder.front.f"), f, rtol=1e-12)
    expect(status).to_contain_text(f"(stopped): 100 of 100 feasible, {len(x)} on the front")
    wins(book, ahp([5, 5, 1]).weights, ahp([1]).weights, "weighted sum")


def front_design(book: Workbook, i: int) -> DoorHandleCam:
    x = book.value(f"finder.front.x[{i}]")
    return START.replace(**dict(zip(DOOR_HANDLE_SPACE, x, strict=True)))


def test_the_slider_under_the_front_loads_a_design(book: Workbook) -> None:
    pick = book.finder.get_by_role("slider")
    pick.press("Home")
    pick.press("ArrowRight")
    shows(book, front_design(book, 1))
    assert book.value("app.design == finder.front[1]")


@pytest.mark.parametrize("share", [0.1, 0.8])
def test_a_click_on_the_front_loads_the_design_that_was_hit_in_one_step_to_undo(book: Workbook, share: float) -> None:
    f = np.array(book.value("finder.front.f"))
    points = np.column_stack([f[:, 0], -f[:, 1] / mm])
    aim = int(share * (len(f) - 1))
    book.finder.locator("canvas").scroll_into_view_if_needed()
    on_page = book.finder.evaluate(
        """(root, points) => {
            const parts = [...root.parentElement.camkit.parts.values()].map((known) => known.part);
            const [chart] = parts.find((part) => part.charts).charts, box = chart.canvas.getBoundingClientRect();
            return points.map(([x, y]) => [box.left + chart.x(x), box.top + chart.y(y)]);
        }""",
        points.tolist(),
    )
    steps = book.page.evaluate(f"() => {PANEL}.history.past.length")

    book.page.mouse.click(*np.round(on_page[aim]))

    nearest = int(np.argmin(np.linalg.norm(np.array(on_page) - np.round(on_page[aim]), axis=1)))
    shows(book, front_design(book, nearest))
    assert book.page.evaluate(f"() => {PANEL}.history.past.length") == steps + 1
    book.page.locator(".camkit-page").get_by_role("button", name="Undo").click()
    shows(book, START)


def test_a_saved_study_comes_back_with_judgements_and_front(book: Workbook) -> None:
    book.criteria.get_by_role("slider").nth(0).press("ArrowRight")
    weights_of(book.criteria, ahp([4, 5, 1]).weights)
    x, _ = front_here(book, ahp([4, 5, 1]).weights)
    with book.page.expect_download() as saved:
        book.finder.get_by_role("button", name="Save study").click()
    assert saved.value.suggested_filename == "study.json"

    book.criteria.get_by_role("button", name="Reset").click()
    weights_of(book.criteria, ahp([5, 5, 1]).weights)
    with book.page.expect_file_chooser() as chosen:
        book.finder.get_by_role("button", name="Load study").click()
    chosen.value.set_files(saved.value.path())
    weights_of(book.criteria, ahp([4, 5, 1]).weights)
    expect(book.finder.locator(".camkit-status")).to_have_text(f"loaded: {len(x)} designs on the front")
    assert_allclose(book.value("finder.front.x"), x, rtol=1e-12)


RESTART = """async () => {
    await window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.restart();
}"""


@pytest.mark.usefixtures("endless")
def test_a_stopped_search_goes_on_in_a_new_kernel(book: Workbook) -> None:
    """Stop, another kernel, the notebook run again, Resume: the search goes on from its generation."""
    finder, status = book.finder, book.finder.locator(".camkit-status")
    finder.get_by_role("button", name="Optimise").click()
    expect(status).to_have_text(re.compile(r"^generation \d{2,} of 10000: "))
    finder.get_by_role("button", name="Stop").click()
    expect(status).to_contain_text("(stopped)")
    kernel, reached = book.value("[__import__('os').getpid(), finder.progress.value]")

    book.page.evaluate(RESTART)
    run_all(book.page, timeout=300)
    assert book.value("__import__('os').getpid()") != kernel
    expect(finder.get_by_role("button", name="Resume")).to_be_enabled()
    book.value("[globals().update(seen=[]), finder.progress.observe(lambda now: seen.append(now.new), 'value')]")
    finder.get_by_role("button", name="Resume").click()

    expect(status).to_have_text(re.compile(r"^generation \d+ of 10000: "))
    eventually(lambda: len(book.value("seen")) > 2)
    seen = [number for number in book.value("seen") if number]  # an empty bar comes first
    assert seen[0] == reached < seen[1]
