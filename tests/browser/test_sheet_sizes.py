"""Sheets by themselves, as a laptop's notebook shows them: each fits into its window, and nothing is cut off."""

import json

import numpy as np
import pytest
from playwright.sync_api import expect

from camkit import (
    ArmLoad,
    Cycloidal,
    DoorHandleCam,
    Dwell,
    Judgements,
    MotionProgram,
    Return,
    Rise,
    Session,
    ahp_panel,
    choose_panel,
    deg,
    door_handle_study,
    edit_program,
    explore,
    mm,
    pareto_panel,
    shortlist,
    tolerance_panel,
)
from camkit.panels.kit.inputs import Amount, Whole
from camkit.panels.kit.parts import Button
from camkit.panels.kit.sheet import Sheet
from camkit.panels.workshop import WorkshopPanel
from camkit.search import front_of
from camkit.study import AnalysisCurve

PAGE = """<!doctype html><meta charset=utf-8><style>{style} body {{ margin: 0; }}</style><div id=sheet></div>
<script type=module>
const packed = (v) => Array.isArray(v) ? v.map(packed) : v === null || typeof v !== "object" ? v
  : "base64" in v ? new DataView(Uint8Array.from(atob(v.base64), (c) => c.charCodeAt(0)).buffer)
  : Object.fromEntries(Object.entries(v).map(([name, part]) => [name, packed(part)]));
const state = packed({state}), el = document.getElementById("sheet"), sent = [];
const model = {{ get: (name) => state[name], on() {{}}, off() {{}}, send: (message) => sent.push(message) }};
const widget = await import(URL.createObjectURL(new Blob([{script}], {{ type: "text/javascript" }})));
await widget.default().render({{ model, el }});
Object.assign(globalThis, {{ sheet: el.camkit, sent }});
</script>"""
STUDY = door_handle_study(
    DoorHandleCam(lift_arm=45 * mm, lift_start_angle=27 * deg, relief_cam_angle=45 * deg, lift_load=ArmLoad(torque=10))
)
CUT = """() => [...document.querySelectorAll(".camkit-sheet :is(button, label > span, summary, th, td)")]
    .filter((e) => e.offsetParent && e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== "inline")
    .map((e) => e.textContent)"""


def instrument():
    return explore(STUDY.start, at_most=STUDY.at_most, at_least=STUDY.at_least)


def decision():
    """A choice among three wishes of a front."""
    study = STUDY.replace(minimise=(*STUDY.minimise, *STUDY.at_most))
    lows, highs = np.array(study.bounds)
    x = lows + (highs - lows) * np.random.default_rng(1).random((300, len(lows)))
    judged = ahp_panel(Judgements([m.name for m in study.minimise], [2, 1, None]))
    finder = pareto_panel(instrument(), {"three wishes": study}, importance=judged)
    finder.load(Session(study, study.start, front=front_of(study.evaluate(x), study)))
    return choose_panel(finder)


def tray():
    app = instrument()
    kept = shortlist(app, study=STUDY)
    for arm in (45, 50, 52):
        app.design = app.design.replace(lift_arm=arm * mm)
        kept.keep()
    return kept


def tolerances():
    curves = [
        AnalysisCurve("lift.pressure_angle", "deg", "pressure angle"),
        AnalysisCurve("lift.contact_force", "N", "contact force"),
        AnalysisCurve("lift.curvature", "1/mm", "curvature"),
    ]
    return tolerance_panel(instrument(), STUDY, curves=curves)


def editor():
    moves = Rise(100 * deg, 20 * mm, Cycloidal()), Dwell(40 * deg), Return(100 * deg, 20 * mm, Cycloidal())
    return edit_program(MotionProgram((*moves, Dwell(120 * deg))))


def workshop():
    return WorkshopPanel(instrument())


def opened(browser, sheet, width, height):
    """A page of a sheet alone, without a kernel."""
    page = browser.new_page(viewport={"width": width, "height": height})
    page.heard = []
    page.on("pageerror", lambda error: page.heard.append(str(error)))
    state = {**sheet.stored(), "setting": sheet.setting}
    written = (json.dumps(part).replace("</", "<\\/") for part in (state, str(sheet._esm)))
    state, script = written
    page.set_content(PAGE.format(style=sheet._css, state=state, script=script))
    page.wait_for_function("() => globalThis.sheet && !sheet.frame")
    return page


@pytest.mark.parametrize("make", [decision, tray, tolerances, editor, workshop])
def test_a_sheet_fits_into_a_laptops_notebook(browser, make, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    sheet = make()
    page = opened(browser, sheet, 934, 600)
    assert page.locator(".camkit-sheet").bounding_box()["height"] <= 600
    assert page.evaluate(CUT) == []
    assert all(box["height"] >= 140 for box in map(lambda c: c.bounding_box(), page.locator("canvas:visible").all()))
    page.set_viewport_size({"width": 500, "height": 900})
    page.wait_for_function("() => !sheet.frame && !document.querySelector('.camkit-wide')")
    assert page.evaluate("document.documentElement.scrollWidth") <= 500
    assert page.heard == []
    page.close()


def test_a_sheet_by_itself_has_units_to_choose_from(browser):
    page = opened(browser, tolerances(), 934, 600)
    cells = """() => [...document.querySelectorAll("td")].map((cell) => cell.textContent)
        .filter((words) => / (°|deg|rad)$/.test(words))"""
    degrees = page.evaluate(cells)
    assert degrees
    assert all(text.endswith(" °") for text in degrees)  # as an instrument writes them
    axes = "() => sheet.shown().pictures.map(({ window: { y } }) => y.high)"
    before = page.evaluate(axes)
    page.get_by_label("units of this sheet").select_option("mm, rad, N")
    page.wait_for_function("() => !sheet.frame")
    radians = page.evaluate(cells)
    assert all(text.endswith(" rad") for text in radians)
    numbers = ([float(text.split()[0]) for text in texts] for texts in (degrees, radians))
    np.testing.assert_allclose(
        *(np.array(some) * unit for some, unit in zip(numbers, (deg, 1), strict=True)), rtol=1e-3
    )
    assert page.evaluate(axes) != before
    assert page.heard == []
    page.close()


def test_a_sheet_without_units_offers_none(boxes):
    assert boxes.get_by_label("units of this sheet").count() == 1  # its lift is in mm
    boxes.evaluate("() => sheet.own.use('inch, deg, lbf') || sheet.measure()")
    assert boxes.get_by_label("lift, inch").input_value() == "0.19685"
    boxes.evaluate("() => sheet.own.use('mm, deg, N') || sheet.measure()")
    page = opened(boxes.context.browser, ahp_panel(Judgements(["speed", "price"], [2])), 934, 600)
    assert page.get_by_label("units of this sheet").count() == 0
    page.close()


@pytest.fixture
def boxes(browser):
    """A slider, a box and a button, whose kernel does not answer."""
    whole, lift = Whole(3, 0, 9, "design", slider=True), Amount(description="lift", unit="mm", value=5.0)
    page = opened(browser, Sheet(whole, lift, Button("Go", lambda: None)), 934, 600)
    yield page
    assert page.heard == []
    page.close()


def test_what_is_moved_and_put_back_before_the_kernel_answers_is_said(boxes):
    slider, box = boxes.get_by_role("slider"), boxes.get_by_role("textbox")
    slider.fill("5")
    slider.fill("3")
    for lift in ("7", "5"):
        box.fill(lift)
        box.press("Enter")
    assert boxes.evaluate("sent.map(({ value }) => value)") == [5]
    assert boxes.evaluate("[...sheet.waiting.values()].map(({ done }) => done.value)") == [3, 5]


def test_two_views_of_a_sheet_count_together(boxes):
    boxes.evaluate("""() => {
        const root = document.body.appendChild(document.createElement("div"));
        globalThis.other = new sheet.constructor(root, sheet.model);
        globalThis.answer = () => { sheet.model.get("body").heard = sent.at(-1).count; sheet.show(); other.show(); };
    }""")
    first, second = boxes.get_by_role("button").all()
    for button in (first, first, first, second, first):
        button.click()
        boxes.evaluate("answer()")
    assert boxes.evaluate("sent.map(({ count }) => count)") == [1, 2, 3, 4, 5]


def test_a_sheet_that_has_left_the_page_is_not_drawn_again(boxes):
    drawn = """() => {
        let times = 0;
        sheet.draw = () => { times++; };
        sheet.theme.system.dispatchEvent(new Event("change"));
        return times;
    }"""
    assert boxes.evaluate(drawn) == 1
    boxes.evaluate("sheet.end()")
    assert boxes.evaluate(drawn) == 0


def test_a_map_is_folded_where_there_is_no_room(browser, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    sheet = decision()
    page = opened(browser, sheet, 934, 600)
    pictures = page.locator("canvas:visible")
    expect(pictures).to_have_count(2)
    page.get_by_text("Who wins at which weights", exact=True).first.click()
    expect(pictures).to_have_count(4)
    expect(page.get_by_text("stays while one judgement moves alone").first).to_be_visible()
    page.close()
    page = opened(browser, sheet, 1920, 1080)
    expect(page.locator("canvas:visible")).to_have_count(4)
    assert page.locator(".camkit-sheet").bounding_box()["height"] <= 1080
    page.close()
