"""The decision notebook in JupyterLab: judging by keyboard, brushing, the tray; the page against the package."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from camkit import ArmLoad, DoorHandleCam, ahp, deg, door_handle_study
from camkit.decision import CHOOSERS, achievement, judgement_ranges, side_by_side, weighted_sum
from camkit.machines.door_handle import DOOR_HANDLE_SPACE, WORSE_CURVE
from camkit.views.decision import triangle
from lab import OWN_SHEETS, eventually, kernel_value, on_page, open_notebook, run_all

ANGLE, FORCE, TORQUE, _, RADIUS, _ = WORSE_CURVE.values()
PAPER, SPACE = DoorHandleCam(lift_load=ArmLoad(torque=10)), DOOR_HANDLE_SPACE
STUDY = door_handle_study(PAPER).replace(minimise=(ANGLE, FORCE, -RADIUS))


@pytest.fixture(scope="module")
def page(window: Page) -> Page:
    """The notebook opened and run once."""
    open_notebook(window, "16_decision.ipynb")
    run_all(window)
    return window


def panel(page: Page, words: str) -> Any:
    return page.locator(OWN_SHEETS).filter(has_text=words)


# Where a point of one of a sheet's pictures stands in the window.
PLACE = """(root, [name, x, y]) => {
    const charts = [...root.parentElement.camkit.parts.values()].flatMap(({ part }) => part.charts ?? []);
    const chart = charts.find(({ list }) => list?.name === name), box = chart.canvas.getBoundingClientRect();
    return [box.left + chart.x(x), box.top + chart.y(y)];
}"""


def drawn(sheet: Any, name: str) -> dict[str, Any]:
    """The marks that the page has drawn in one of a sheet's pictures, by key."""
    pictures = sheet.evaluate("root => root.parentElement.camkit.shown().pictures.filter(Boolean)")
    (marks,) = [picture["marks"] for picture in pictures if picture["name"] == name]
    return {mark["key"]: mark for mark in marks}


def front(page: Page) -> np.ndarray:
    """Objectives of the kernel's front, computed here."""
    return STUDY.evaluate(np.array(kernel_value(page, "finder.front.x"))).f


def decided(page: Page, judgements: list[Any]) -> None:
    """Weights, winners and how far the judgements may move are on the page as the package has them."""
    f, weights = front(page), ahp(judgements).weights
    expect(panel(page, "What matters more?").locator("td.camkit-bold")).to_have_text([f"{w:.4f}" for w in weights])
    decision = panel(page, "load the winner by")
    for rule, choose in CHOOSERS.items():
        i = choose(f, weights)
        row = decision.locator("tr").filter(has=page.locator("td:first-child", has_text=re.compile(f"^{rule}$")))
        told = [str(i), *(m.text(m.sign * v) for m, v in zip(STUDY.minimise, f[i], strict=True))]
        for k, text in enumerate(told, start=1):
            expect(row.locator("td").nth(k)).to_have_text(on_page(text))
    first = judgement_ranges(f, judgements)[0]
    expect(decision).to_contain_text(f"from {first.low:.3g} to {first.high:.3g} (now {first.judged:.3g})")


def test_judging_by_keyboard_moves_weights_and_winners(page: Page) -> None:
    decided(page, [2, 1, None])
    judge = panel(page, "What matters more?")
    slider = judge.get_by_role("slider").nth(0)
    slider.press("ArrowLeft")
    decided(page, [3, 1, None])
    box = judge.get_by_placeholder("not judged").nth(2)
    expect(box).to_have_value("")
    box.fill("1/3")
    box.press("Enter")
    decided(page, [3, 1, 1 / 3])
    box.fill("")
    box.press("Enter")
    decided(page, [3, 1, None])
    box = judge.get_by_placeholder("not judged").nth(0)
    box.fill("two")
    box.press("Enter")
    expect(judge.get_by_role("alert")).to_contain_text("'two' is no number above 0")
    expect(box).to_have_value("3")
    judge.get_by_role("button", name="Reset").click()
    decided(page, [2, 1, None])


def test_a_drag_along_an_axis_brushes_the_front(page: Page) -> None:
    decision = panel(page, "load the winner by")
    decision.get_by_role("group", name="Designs of the front").scroll_into_view_if_needed()
    (x, y0), (_, y1) = (decision.evaluate(PLACE, ["brushed designs", 1, share]) for share in (0.25, 0.7))
    page.mouse.move(x, y0)
    page.mouse.down()
    page.mouse.move(x, y1, steps=6)
    page.mouse.up()

    forces = front(page)[:, 1]
    low, high = (forces.min() + share * np.ptp(forces) for share in (0.25, 0.7))
    expect(decision).to_contain_text(re.compile(r"\d+ of 168 designs kept"))
    expect(decision).not_to_contain_text("168 of 168 designs kept")
    eventually(lambda: kernel_value(page, "panel.designs.bands[1][1]") > forces.min() + 0.68 * np.ptp(forces))
    band = kernel_value(page, "panel.designs.bands[1]")
    np.testing.assert_allclose(band, (low, high), atol=0.02 * np.ptp(forces))
    inside = int(((band[0] <= forces) & (forces <= band[1])).sum())
    expect(decision).to_contain_text(f"{inside} of 168 designs kept")
    heights = (np.array(band) - forces.min()) / np.ptp(forces)
    eventually(lambda: np.allclose(as_list(drawn(decision, "brushed designs")["band 1"]["y"])[1:3], heights))
    assert len(as_list(drawn(decision, "front winners")["kept"]["x"])) == inside
    decision.get_by_role("button", name="Keep all").click()
    expect(decision).to_contain_text("168 of 168 designs kept")
    eventually(lambda: "band 1" not in drawn(decision, "brushed designs"))


def test_a_click_on_a_line_loads_its_design_and_one_on_the_map_its_winner(page: Page) -> None:
    decision = panel(page, "load the winner by")
    decision.get_by_role("group", name="Designs of the front").scroll_into_view_if_needed()
    page.mouse.click(*decision.evaluate(PLACE, ["brushed designs", 0, 1.0]))
    f = front(page)
    eventually(lambda: kernel_value(page, f"app.design == finder.front[{f[:, 0].argmax()}]"))
    eventually(lambda: len(as_list(drawn(decision, "brushed designs")["in the sliders"]["x"])) > 1)
    decision.get_by_role("group", name="Winners by weight").scroll_into_view_if_needed()
    weights = np.array([0.1, 0.1, 0.8])
    page.mouse.click(*decision.evaluate(PLACE, ["winners by weight", *triangle(weights).tolist()]))
    eventually(lambda: kernel_value(page, f"app.design == finder.front[{weighted_sum(f, weights)}]"))


def as_list(values: Any) -> list[float]:
    """An array of the page, which comes as an object."""
    return list(values.values()) if isinstance(values, dict) else values


def reference(decision: Any) -> list[float]:
    """Where the reference point is drawn."""
    mark = drawn(decision, "front winners")["reference"]
    return [as_list(mark[name])[0] for name in "xy"]


def test_a_reference_point_that_is_dragged_or_moved_by_keys_picks_the_nearest_design(page: Page) -> None:
    decision = panel(page, "load the winner by")
    decision.get_by_role("group", name="Winners on the front").scroll_into_view_if_needed()
    f = front(page)
    start, (low, high) = reference(decision), (f[:, :2].min(0), f[:, :2].max(0))
    np.testing.assert_allclose(start, [low[0] / deg, low[1]], rtol=1e-9)  # the ideal
    there = [(low[0] + 0.6 * (high[0] - low[0])) / deg, low[1] + 0.2 * (high[1] - low[1])]
    page.mouse.move(*decision.evaluate(PLACE, ["front winners", *start]))
    page.mouse.down()
    page.mouse.move(*decision.evaluate(PLACE, ["front winners", *there]), steps=8)

    def nearest(wish: list[float]) -> int:
        return achievement(f, [wish[0] * deg, wish[1], f[:, 2].min()])

    eventually(lambda: np.allclose(reference(decision), there, rtol=5e-3))
    eventually(lambda: kernel_value(page, f"app.design == finder.front[{nearest(reference(decision))}]"))  # held
    page.mouse.up()
    picked = reference(decision)
    for key, k in (("ArrowRight", 0), ("ArrowUp", 1)):
        before = reference(decision)
        decision.get_by_role("group", name="Winners on the front").locator("canvas").press(key)
        eventually(lambda before=before, k=k: reference(decision)[k] > before[k])
    eventually(lambda: kernel_value(page, f"app.design == finder.front[{nearest(reference(decision))}]"))
    assert reference(decision)[0] > picked[0]
    assert reference(decision)[1] > picked[1]


def test_the_bands_handles_are_called_after_the_axis_and_move_with_the_keys(page: Page) -> None:
    decision = panel(page, "load the winner by")
    axis = decision.get_by_role("combobox", name="keep of the")
    for measure in (FORCE, ANGLE):
        axis.select_option(label=measure.name)
        for end in ("least", "greatest"):
            expect(decision.get_by_role("slider", name=f"{measure.name}, {measure.unit}, {end}")).to_have_count(1)
        expect(decision.get_by_role("slider")).to_have_count(2)
    handle = decision.get_by_role("slider", name=f"{ANGLE.name}, {ANGLE.unit}, greatest", exact=True)
    handle.focus()
    handle.press("ArrowLeft")
    expect(decision).not_to_contain_text("168 of 168 designs kept")
    name = f"{ANGLE.name}, {ANGLE.unit}, greatest"  # the same, whatever is counted
    expect(decision.get_by_role("slider", name=name, exact=True)).to_have_count(1)
    decision.get_by_role("button", name="Keep all").click()
    expect(decision).to_contain_text("168 of 168 designs kept")


def test_the_tray_exports_what_it_shows(page: Page) -> None:
    tray = panel(page, "Keep this design")
    panel(page, "load the winner by").get_by_role("button", name="knee").click()
    tray.get_by_role("button", name="Remove").nth(1).click()
    expect(tray.get_by_role("button", name="Remove")).to_have_count(2)
    designs = kernel_value(page, "{p: [getattr(d, n) for n in space] for p, d in kept.designs.items()}")
    assert list(designs) == ["A", "C"]
    named = {f"design {p}": PAPER.replace(**dict(zip(SPACE, x, strict=True))) for p, x in designs.items()}
    table = side_by_side(named, (ANGLE, FORCE, RADIUS, TORQUE), STUDY)
    cells = []
    for line in table.lines:
        missed = [f"{text} not met" if bad else text for text, bad in zip(line.texts, line.missed, strict=True)]
        cells += [line.name, *missed, line.limit]
    expect(tray.locator("td")).to_have_text([*map(on_page, cells)])

    for button, name, content in (
        ("Save as Markdown", "designs.md", table.markdown()),
        ("Save as HTML", "designs.html", table.html()),
    ):
        with page.expect_download() as expected:
            tray.get_by_role("button", name=button).click()
        assert expected.value.suggested_filename == name
        text = Path(expected.value.path()).read_text(encoding="utf-8")
        assert content in text
    assert "data:image/png;base64,iVBOR" in text
    assert "http" not in text

    tray.get_by_role("button", name="Load").nth(0).click()
    eventually(lambda: kernel_value(page, "app.design == kept.designs['A']"))
