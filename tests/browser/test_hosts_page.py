"""An instrument for everybody: by keys alone, by what a screen reader hears, by touch, with large letters."""

import nbformat
import pytest

from lab import STORED, open_notebook, run_all

CELL = """
from camkit import ArmLoad, DoorHandleCam, deg, explore
explore(DoorHandleCam(lift_load=ArmLoad(torque=10)), turn=75 * deg)
"""
CONTROLS = ".camkit-page :is(button, canvas, input, select, summary, [tabindex])"
PANEL = "document.querySelector('.camkit-page').parentElement.camkit"
COUNT = "() => window.jupyterapp.shell.currentWidget.content.widgets.length"
MODE = "() => window.jupyterapp.shell.currentWidget.content.mode"
ROLES = {"button", "slider", "textbox", "combobox", "tab", "searchbox", "image", "DisclosureTriangle", "img"}


@pytest.fixture(scope="module")
def instrument(server, browser):
    """The page of a notebook with one instrument, that has drawn."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(CELL), nbformat.v4.new_code_cell("1 + 1")])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "hosts.ipynb")
    context = browser.new_context(base_url=server.url, viewport={"width": 1366, "height": 768}, has_touch=True)
    context.request.get(f"/api/me?token={server.token}")
    page = context.new_page()
    open_notebook(page, "hosts.ipynb")
    run_all(page, pictures=True)
    page.wait_for_selector(".camkit-page canvas")
    page.wait_for_function(f"() => {PANEL}.outputs && !{PANEL}.frame")
    page.wait_for_function(f"() => ({STORED})().flat().some(Boolean)")  # then the focus is taken and given back
    page.evaluate("() => document.querySelectorAll('.camkit-page details').forEach((group) => { group.open = true; })")
    yield page
    context.close()


def test_letters_and_arrows_in_a_control_are_not_jupyterlabs(instrument):
    """In command mode `b` inserts a cell, `z` takes one back, and an arrow leaves the cell."""
    page, cells = instrument, instrument.evaluate(COUNT)
    kinds = set()
    for handle in page.query_selector_all(CONTROLS):
        if not handle.is_visible() or handle.is_disabled():  # a disabled one takes no focus
            continue
        kinds.add(handle.evaluate("(e) => e.localName + (e.type ?? '')"))
        handle.evaluate("(e) => e.focus()")
        for key in ("b", "z", "ArrowUp"):
            handle.evaluate(
                """(e, key) => e.dispatchEvent(new KeyboardEvent('keydown',
                    { key, keyCode: { b: 66, z: 90, ArrowUp: 38 }[key], bubbles: true, cancelable: true }))""",
                key,
            )
        assert page.evaluate("(e) => document.activeElement === e", handle)
    assert kinds >= {"buttonbutton", "canvas", "inputrange", "inputtext", "summary"}
    assert page.evaluate(COUNT) == cells


def test_real_keys_stay_in_a_slider_a_menu_and_a_picture(instrument):
    page, cells = instrument, instrument.evaluate(COUNT)
    for control in ("input[type=range]", "select", "canvas", "summary", "button"):
        page.locator(f".camkit-page {control}").first.focus()
        for key in ("b", "ArrowUp", "z"):
            page.keyboard.press(key)
        assert page.evaluate("() => document.activeElement.closest('.camkit-page') !== null"), control
        assert page.evaluate(COUNT) == cells, control


def test_a_screen_reader_hears_a_name_of_every_control(instrument):
    session = instrument.context.new_cdp_session(instrument)
    root = session.send("DOM.getDocument")["root"]["nodeId"]
    panel = session.send("DOM.querySelector", {"nodeId": root, "selector": ".camkit-page"})["nodeId"]
    nodes = [n for n in session.send("Accessibility.queryAXTree", {"nodeId": panel})["nodes"] if not n["ignored"]]
    heard = [(n["role"]["value"], n.get("name", {}).get("value", "")) for n in nodes]
    controls = [(role, name) for role, name in heard if role in ROLES]
    assert len(controls) > 30
    assert not [role for role, name in controls if not name.strip()]
    names = [name for role, name in controls if role in ("slider", "textbox")]
    assert len(names) == len(set(names))  # none is heard twice
    assert {"slider", "textbox", "button", "tab"} <= {role for role, _ in controls}


def test_a_finger_moves_the_mechanism_and_a_slider_and_scrolls_elsewhere(instrument):
    page, session = instrument, instrument.context.new_cdp_session(instrument)

    def swipe(selector, dx, dy):
        box = page.locator(selector).first.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        for k, kind in enumerate(["touchStart", *["touchMove"] * 8, "touchEnd"]):
            at = [] if kind == "touchEnd" else [{"x": x + dx * k / 8, "y": y + dy * k / 8}]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})

    actions = "(s) => getComputedStyle(document.querySelector(s)).touchAction"
    assert page.evaluate(actions, ".camkit-middle canvas") == "none"
    assert page.evaluate(actions, ".camkit-left input[type=range]") == "pan-y"
    window = page.evaluate(f"() => {PANEL}.charts[0].ends.x.low")
    swipe(".camkit-middle canvas", 60, 30)
    page.wait_for_function(f"(before) => {PANEL}.charts[0].ends.x.low !== before && !{PANEL}.frame", arg=window)
    value = page.evaluate(f"() => {PANEL}.values[0]")
    swipe(".camkit-left input[type=range]", 40, 0)
    page.wait_for_function(f"(before) => {PANEL}.values[0] !== before", arg=value)


LAPPING = """() => {
    const found = [];
    const seen = (e) => {
        const r = e?.getBoundingClientRect();
        return r?.width && r.height && getComputedStyle(e).visibility === "visible" ? r : null;
    };
    const lap = (p, q) => Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1
        && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 1;
    const pairs = (said, rects) => rects.forEach((p, i) => {
        if (rects.slice(i + 1).some((q) => lap(p, q))) found.push(said); });
    const parts = ["bar-top", "chips", "left", "middle", "right-side", "play", "tabs"]
        .map((name) => [name, seen(document.querySelector(`.camkit-${name}`))]).filter(([, r]) => r);
    pairs("parts", parts.map(([, r]) => r));
    for (const bar of document.querySelectorAll(".camkit-bar-top, .camkit-row"))
        pairs(bar.textContent.slice(0, 40), [...bar.children].map(seen).filter(Boolean));
    const page = document.querySelector(".camkit-page").getBoundingClientRect();
    const beyond = (r) => r.right > page.right + 1 || r.bottom > page.bottom + 1;
    found.push(...parts.filter(([, r]) => beyond(r)).map(([name]) => `${name} beyond the page`));
    return found; }"""


def test_letters_of_150_percent_lie_over_nothing(instrument):
    page = instrument
    page.evaluate("() => { document.documentElement.style.fontSize = '24px'; }")
    try:
        page.wait_for_function(f"() => {PANEL}.letter > 19 && !{PANEL}.frame")
        page.wait_for_timeout(300)
        assert page.evaluate(LAPPING) == []
    finally:
        page.evaluate("() => { document.documentElement.style.fontSize = ''; }")
