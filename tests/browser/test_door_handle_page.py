"""The door-handle workbook in JupyterLab: what the page shows against what camkit computes in this process."""

import base64
import io
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import BrowserContext, Locator, Page, expect

from camkit import ArmLoad, DoorHandleCam, ahp, deg, door_handle_study, mm, profile_csv
from camkit.cam.measures import groove_gap
from camkit.decision import CHOOSERS
from camkit.files import from_json
from camkit.geometry import rotated
from camkit.machines.door_handle import CURVE_TABLE, DOOR_HANDLE_SPACE, WORSE_CURVE
from camkit.motion import LAWS
from camkit.quantities import declarations
from camkit.render.draw import colour
from camkit.units import in_unit
from camkit.views import default_views, mechanism, pressure_angle
from lab import LabServer, eventually, kernel_value, open_notebook, run_all, screenshot, table_of_measures

START = DoorHandleCam(lift_load=ArmLoad(torque=10))
MEASURES = (*WORSE_CURVE.values(), groove_gap, *CURVE_TABLE)
TURN = 75 * deg


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its four panels."""

    page: Page
    explorer: Locator
    criteria: Locator
    importance: Locator
    finder: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)

    def row(self, name: str) -> Locator:
        """The row of one quantity in the explorer."""
        return self.explorer.locator(".camkit-knob").filter(
            has=self.page.locator("span[title]", has_text=re.compile(rf"(^|\s){name}$"))
        )

    def box(self, name: str) -> Locator:
        return self.row(name).get_by_role("spinbutton")

    def slider(self, name: str) -> Locator:
        return self.row(name).get_by_role("slider")

    def type(self, name: str, text: str) -> None:
        self.box(name).fill(text)
        self.box(name).press("Enter")


@pytest.fixture(scope="module")
def book(context: BrowserContext, server: LabServer) -> Iterator[Workbook]:
    """The notebook opened and run once for all tests of this file."""
    page = context.new_page()
    open_notebook(page, "01_door_handle_cam.ipynb")
    run_all(page)
    panels = page.locator(".camkit-panel")
    titles = ("cam angle shown", "What makes up the effort", "Effort against radius", "free quantities")
    yield Workbook(page, *(panels.filter(has_text=title) for title in titles))
    page.close()
    server.end_kernels()


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook, request: pytest.FixtureRequest) -> Iterator[None]:
    """Each test begins with the paper's design and judgements; what a failed one showed is kept in .browser/."""
    for panel in (book.explorer, book.criteria, book.importance):
        panel.get_by_role("button", name="Reset").click()
    eventually(
        lambda: (
            book.value("[app.design == app.start, criteria.judgements.above, importance.judgements.above]")
            == [True, [5, 5, 1], [1]]
        )
    )
    shows(book, START)
    failed = request.session.testsfailed
    yield
    if request.session.testsfailed > failed:
        screenshot(book.page, Path(__file__).parents[2] / ".browser" / f"{request.node.name}.png")


def drag(page: Page, handle: Locator, dx: float) -> None:
    """Drags a slider's handle with the mouse, in steps as a hand would."""
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y, steps=8)
    page.mouse.up()


def shows(book: Workbook, design: DoorHandleCam) -> None:
    """The boxes and the table of measures show ``design``, computed here."""
    study, first, now = door_handle_study(START), START.analyse(), design.analyse()
    for name in ("lift_arm", "lift_start_angle", "relief_arm", "relief_cam_angle"):
        shown = f"{in_unit(getattr(design, name), declarations(design)[name].unit):.6g}"
        expect(book.box(name.replace("_", " "))).to_have_value(shown)
    cells = book.explorer.locator(".camkit-tables tr:has(td)")
    expected = table_of_measures(MEASURES, now, first, study.at_most, study.at_least)
    expect(cells).to_have_text(expected)


def picture(panel: Locator) -> np.ndarray:
    """The picture that a panel shows, ``(height, width, 3)``."""
    data = panel.locator("img.camkit-image").evaluate(
        """async (image) => {
            await image.decode();
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
            canvas.getContext('2d').drawImage(image, 0, 0);
            return canvas.toDataURL('image/png').split(',')[1];
        }"""
    )
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)


def drawn(book: Workbook, name: str, axes: int, points: Any, colour: str, within: int = 1) -> np.ndarray:
    """At which of ``points`` (data of the axes, ``(2, n)``) the picture of ``name`` in the kernel shows ``colour``."""
    panel = {"app": book.explorer, "criteria": book.criteria, "finder": book.finder}[name]
    data = np.transpose(points).tolist()
    x, y = np.transpose(book.value(f"{name}.picture.axes[{axes}].transData.transform({data})")).round().astype(int)
    image = picture(panel)
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    near = np.abs(image - wanted).max(-1) < 50
    steps = range(-within, within + 1)
    return np.any([near[len(image) - 1 - y + dy, x + dx] for dx in steps for dy in steps], axis=0)


def profile_points(design: DoorHandleCam, turn: float) -> np.ndarray:
    """Points of the profile on the machine, mm, the cam turned by ``turn``: what lies under cranks is left out."""
    analysis = design.analyse()
    i = np.argmin(abs(analysis.cam_angle - turn))
    points = rotated(analysis.profile, analysis.cam_angle[i]) / mm
    points = points[:, ~analysis.undercut]
    clear = np.ones(points.shape[1], dtype=bool)
    for pivot, centre in analysis.cranks.values():
        along = pivot / mm + np.linspace(0, 1, 30)[:, None] * (centre[:, i] - pivot) / mm
        clear &= np.linalg.norm(points[:, :, None] - along.T[:, None, :], axis=0).min(-1) > 8
    return points[:, clear][:, ::20]


def test_dragging_a_slider_moves_box_table_and_picture(book: Workbook) -> None:
    # Authority: every number computed here by camkit from the arm length that the slider shows.
    slider = book.slider("lift arm")

    drag(book.page, slider, -70)

    arm = float(slider.get_attribute("aria-valuetext"))
    assert 40 < arm < 49
    design = START.replace(lift_arm=arm * mm)
    shows(book, design)
    assert book.value("app.design.lift_arm") == pytest.approx(arm * mm, rel=1e-9)
    views = default_views(START.analyse())
    cam, angle = views.index(mechanism), views.index(pressure_angle)
    eventually(lambda: drawn(book, "app", cam, profile_points(design, TURN), colour("position")).all())
    assert drawn(book, "app", cam, profile_points(START, TURN), colour("position")).mean() < 0.5
    lift = design.analyse().lift
    curve = np.array([lift.cam_angle, lift.pressure_angle])[:, 420::30] / deg
    eventually(lambda: drawn(book, "app", angle, curve, colour("position")).all())


def test_a_typed_number_counts_to_its_last_digit(book: Workbook) -> None:
    book.type("lift arm", "48.0912")
    shows(book, START.replace(lift_arm=48.0912 * mm))
    assert book.value("app.design.lift_arm") == 48.0912 * mm
    assert float(book.slider("lift arm").get_attribute("aria-valuetext")) == pytest.approx(48.09, abs=0.011)


@pytest.mark.parametrize(
    ("name", "typed", "field", "value"),
    [
        ("lift arm", "-5", "lift_arm", -5 * mm),
        ("relief arm", "250", "relief_arm", 250 * mm),
        ("relief cam angle", "190", "relief_cam_angle", 190 * deg),
    ],
)
def test_what_cannot_be_built_is_a_sentence_in_place_of_the_picture(
    book: Workbook, name: str, typed: str, field: str, value: float
) -> None:
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the sentence is what is compared
        START.replace(**{field: value}).analyse()
    picture, table = book.explorer.locator("img.camkit-image"), book.explorer.locator(".camkit-tables")
    before = book.box(name).input_value()

    book.type(name, typed)

    expect(book.explorer.get_by_role("alert")).to_have_text(f"This cannot be built: {refused.value}.")
    expect(picture).to_be_hidden()
    expect(table).to_be_hidden()
    assert book.value("app.design == app.start")

    book.type(name, before)

    expect(book.explorer.get_by_role("alert")).to_have_count(0)
    expect(picture).to_be_visible()
    shows(book, START)


def test_another_motion_law_from_the_menu(book: Workbook) -> None:
    law = next(law for law in LAWS if law.name == "modified sine")
    book.row("motion law").get_by_role("combobox").select_option(law.name)
    shows(book, START.replace(motion_law=law))
    assert book.value("app.design.motion_law.name") == law.name


def test_turning_the_handle_turns_cam_and_cranks(book: Workbook) -> None:
    book.type("cam angle shown", "120")
    try:
        analysis = START.analyse()
        i = np.argmin(abs(analysis.cam_angle - 120 * deg))
        for place, name in enumerate(("lift", "relief")):
            pivot, centre = (point / mm for point in (analysis.cranks[name][0], analysis.cranks[name][1][:, i]))
            arm = pivot[:, None] + np.linspace(0.3, 0.7, 9) * (centre - pivot)[:, None]
            eventually(lambda arm=arm, i=place: drawn(book, "app", 0, arm, colour("series", i)).all())
        eventually(lambda: drawn(book, "app", 0, profile_points(START, 120 * deg), colour("position")).all())
        assert drawn(book, "app", 0, profile_points(START, TURN), colour("position")).mean() < 0.5
        shows(book, START)
    finally:
        book.type("cam angle shown", f"{TURN / deg:g}")


def front_here(book: Workbook, weights: Any) -> tuple[np.ndarray, np.ndarray]:
    """The designs of the kernel's front and their objectives under ``weights``, computed here, beaten ones out."""
    x = np.array(book.value("finder.found.x"))
    f = door_handle_study(START, weights=weights).evaluate(x).f
    beaten = [any((g <= row).all() and (g < row).any() for g in f) for row in f]
    order = np.argsort(f[~np.array(beaten), 0], kind="stable")
    return x[~np.array(beaten)][order], f[~np.array(beaten)][order]


def wins(book: Workbook, weights: Any, importance: Any, rule: str) -> None:
    """The panel names the winner that is chosen here."""
    x, f = front_here(book, weights)
    i = CHOOSERS[rule](f, importance)
    goals = f"effort {f[i, 0]:.4g}, minimum convex radius of curvature, pitch curve, worse curve {-f[i, 1] / mm:.4g} mm"
    arm, start, share = x[i] / (mm, deg, deg)
    arms = f"lift arm {arm:.6g} mm, lift start angle {start:.6g} deg, relief cam angle {share:.6g} deg"
    expect(book.finder).to_contain_text(
        re.compile(rf"winner: design {i}, {i + 1}(st|nd|rd|th) of {len(f)}: {re.escape(goals)}")
    )
    expect(book.finder).to_contain_text(arms)


def test_a_judgement_changes_weights_front_and_winner(book: Workbook) -> None:
    # Authority: ahp() and the choosers, called here with the judgements on the page.
    for _ in range(3):
        book.criteria.get_by_role("slider").nth(0).press("ArrowRight")

    judged = ahp([2, 5, 1])
    expect(book.criteria.locator("td b")).to_have_text([f"{w:.4f}" for w in judged.weights])
    assert book.value("criteria.judgements.consistency_ratio") == pytest.approx(judged.consistency_ratio, abs=1e-12)
    rows = -np.arange(3.0)
    ends = 100 * judged.weights
    eventually(lambda: drawn(book, "criteria", 0, [ends - 0.7, rows], colour("position"), within=0).all())
    assert not drawn(book, "criteria", 0, [ends + 0.7, rows], colour("position"), within=0).any()
    wins(book, judged.weights, None, "crowding distance")


def test_what_matters_more_decides_the_winner(book: Workbook) -> None:
    rule = book.finder.get_by_label("choose by")
    rule.select_option("weighted sum")
    try:
        for judgement in (3, 9):
            while book.importance.locator(".widget-readout").inner_text() != str(judgement):
                book.importance.get_by_role("slider").press("ArrowLeft")
            wins(book, ahp([5, 5, 1]).weights, ahp([judgement]).weights, "weighted sum")
    finally:
        rule.select_option("crowding distance")


def test_judgements_that_contradict_each_other_are_named(book: Workbook) -> None:
    slider = book.criteria.get_by_role("slider").nth(1)
    slider.press("End")
    judged = ahp([5, 1 / 9, 1])
    assert judged.consistency_ratio > 0.1
    said = f"consistency ratio {judged.consistency_ratio:.2f}, above 0.10"
    expect(book.criteria.get_by_role("alert")).to_contain_text(said)
    expect(book.criteria.locator("td b")).to_have_text([f"{w:.4f}" for w in judged.weights])


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
    status, bar = finder.locator(".camkit-status"), finder.locator(".progress-bar")
    stop = finder.get_by_role("button", name="Stop")

    finder.get_by_role("button", name="Optimise").click()

    expect(status).to_have_text(re.compile(r"^generation \d+ of 10000: \d+ of 100 feasible, \d+ on the front, hyper"))
    seen, width = status.inner_text(), bar.evaluate("bar => bar.getBoundingClientRect().width")
    expect(status).not_to_have_text(seen)
    eventually(lambda: bar.evaluate("bar => bar.getBoundingClientRect().width") > width)
    book.type("lift arm", "47")  # the page is alive, and the search leaves the design in the sliders alone
    shows(book, START.replace(lift_arm=47 * mm))

    stop.click()
    expect(status).to_contain_text("(stopped)")
    expect(finder.get_by_role("button", name="Optimise")).to_be_enabled()
    expect(stop).to_be_disabled()
    x, f = front_here(book, ahp([5, 5, 1]).weights)
    assert len(x) > 10
    np.testing.assert_allclose(book.value("finder.front.f"), f, rtol=1e-12)
    expect(status).to_contain_text(f"(stopped): 100 of 100 feasible, {len(x)} on the front")
    wins(book, ahp([5, 5, 1]).weights, None, "crowding distance")


def front_design(book: Workbook, i: int) -> DoorHandleCam:
    x = book.value(f"finder.front.x[{i}]")
    return START.replace(**dict(zip(DOOR_HANDLE_SPACE, x, strict=True)))


def test_the_slider_under_the_front_loads_a_design(book: Workbook) -> None:
    pick = book.finder.get_by_role("slider")
    drag(book.page, pick, -30)
    i = int(float(pick.get_attribute("aria-valuetext")))
    shows(book, front_design(book, i))
    assert book.value(f"app.design == finder.front[{i}]")


@pytest.mark.parametrize("share", [0.1, 0.8])
def test_a_click_on_the_front_loads_the_design_that_was_hit(book: Workbook, share: float) -> None:
    f = np.array(book.value("finder.front.f"))
    aim = int(share * (len(f) - 1))
    shown = np.column_stack([f[:, 0], -f[:, 1] / mm])
    pixels = np.array(book.value(f"finder.picture.axes[0].transData.transform({shown.tolist()})"))
    width, height = book.value("finder.picture.figure.canvas.get_width_height()")
    image = book.finder.locator("img.camkit-image")
    box = image.bounding_box()
    assert box
    at = np.round([pixels[aim, 0] / width * box["width"], (1 - pixels[aim, 1] / height) * box["height"]])

    image.click(position={"x": at[0], "y": at[1]})

    hit = [at[0] / box["width"] * width, (1 - at[1] / box["height"]) * height]
    nearest = int(np.argmin(np.linalg.norm(pixels - hit, axis=1)))
    expect(book.finder.get_by_role("slider")).to_have_attribute("aria-valuetext", str(nearest))
    shows(book, front_design(book, nearest))


def download(book: Workbook, panel: Locator, button: str) -> tuple[str, str]:
    """Name and text of what a button downloads."""
    with book.page.expect_download() as expected:
        panel.get_by_role("button", name=button).click()
    return expected.value.suggested_filename, Path(expected.value.path()).read_text(encoding="utf-8")


def upload(book: Workbook, panel: Locator, button: str, text: str) -> None:
    with book.page.expect_file_chooser() as expected:
        panel.get_by_role("button", name=button).click()
    expected.value.set_files({"name": "saved.json", "mimeType": "application/json", "buffer": text.encode()})


def test_a_saved_design_comes_back(book: Workbook) -> None:
    book.type("relief arm", "71.25")
    changed = START.replace(relief_arm=71.25 * mm)
    shows(book, changed)
    name, text = download(book, book.explorer, "Save design")
    assert name == "DoorHandleCam.json"
    assert json.loads(text)["design"]["relief_arm [mm]"] == 71.25
    assert from_json(text) == changed

    book.explorer.get_by_role("button", name="Reset").click()
    shows(book, START)
    upload(book, book.explorer, "Load design", text)
    shows(book, changed)


def test_a_damaged_file_is_refused_in_a_sentence(book: Workbook) -> None:
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the sentence is what is compared
        from_json('{"schema": "camkit/1", "design": ')
    upload(book, book.explorer, "Load design", '{"schema": "camkit/1", "design": ')
    expect(book.explorer.get_by_role("alert")).to_have_text(f"This file cannot be used: {refused.value}.")
    shows(book, START)


def test_the_profile_downloads_as_a_table(book: Workbook) -> None:
    book.type("lift arm", "48")
    changed = START.replace(lift_arm=48 * mm)
    shows(book, changed)
    name, text = download(book, book.explorer, "Profile as CSV")
    assert name == "DoorHandleCam.csv"
    assert text == profile_csv(changed.analyse())
    table = np.genfromtxt(io.StringIO(text), delimiter=",", names=True, dtype=None, encoding="utf-8")
    radius = np.hypot(table["pitch_x_mm"], table["pitch_y_mm"])[table["stretch"] == "lift"]
    assert radius.min() == pytest.approx(changed.base_radius / mm, abs=1e-6)


def test_a_saved_study_comes_back_with_judgements_and_front(book: Workbook) -> None:
    book.criteria.get_by_role("slider").nth(0).press("ArrowRight")
    weights = [f"{w:.4f}" for w in ahp([4, 5, 1]).weights]
    expect(book.criteria.locator("td b")).to_have_text(weights)
    x, _ = front_here(book, ahp([4, 5, 1]).weights)
    name, text = download(book, book.finder, "Save study")
    assert name == "study.json"

    book.criteria.get_by_role("button", name="Reset").click()
    expect(book.criteria.locator("td b")).to_have_text([f"{w:.4f}" for w in ahp([5, 5, 1]).weights])
    upload(book, book.finder, "Load study", text)
    expect(book.criteria.locator("td b")).to_have_text(weights)
    expect(book.finder.locator(".camkit-status")).to_have_text(f"loaded: {len(x)} designs on the front")
    np.testing.assert_allclose(book.value("finder.front.x"), x, rtol=1e-12)


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
    run_all(book.page)
    assert book.value("__import__('os').getpid()") != kernel
    expect(finder.get_by_role("button", name="Resume")).to_be_enabled()
    book.value("[globals().update(seen=[]), finder.progress.observe(lambda now: seen.append(now.new), 'value')]")
    finder.get_by_role("button", name="Resume").click()

    expect(status).to_have_text(re.compile(r"^generation \d+ of 10000: "))
    eventually(lambda: len(book.value("seen")) > 2)
    seen = [number for number in book.value("seen") if number]  # an empty bar comes first
    assert seen[0] == reached < seen[1]
