"""What a page says of designs around the one in hand: slopes of a measure, and where on each track limits are kept."""

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import deg, mm
from camkit.cam import max_pressure_angle, min_profile_radius
from camkit.quantities import quantities_of, value_of, with_quantities, words
from camkit.render.reasons import reason_of
from test_living_page import DRAWN, Evil, Truth, evil_view, opened  # noqa: F401

ROLLER = MACHINES["roller"]
LIMITS = {"at_most": {max_pressure_angle: 30 * deg}, "at_least": {min_profile_radius: 5 * mm}}
BARS = """() => [...document.querySelectorAll(".camkit-slope")].map((bar) =>
    [bar.firstChild.textContent, bar.lastChild.textContent.slice(2)])"""


def slope(design, path, step, measure):
    """By how much a measure grows for a step of a quantity, from both sides, or the one that can be built."""
    found = []
    for by in (-step, step):
        try:
            moved = with_quantities(design, {path: value_of(design, path) + by}).analyse()
        except ValueError:
            continue
        found.append((measure.one(moved) - measure.one(design.analyse())) * np.sign(by))
    return np.mean(found)


def test_a_measure_says_its_formula_its_source_its_test_and_what_each_slider_does_to_it(opened):  # noqa: F811
    page = opened(ROLLER, measures=[max_pressure_angle], **LIMITS)
    card, chip = (
        page.locator(".camkit-why"),
        page.locator(".camkit-chips [role=button]", has_text="maximum pressure angle"),
    )
    assert not card.is_visible()
    chip.focus()
    page.wait_for_selector(".camkit-slope")
    why = reason_of(max_pressure_angle, ROLLER.analyse())
    said = card.inner_text()
    assert said.startswith("maximum pressure angle ")
    assert "tan α = (v - σ e) / h" in said
    assert why["source"] in said
    assert why["test"] in said
    assert said.index("What 1 %") < said.index("Formula, in SI units") < said.index("Source") == said.rindex("Source:")
    bars, expected = dict(page.evaluate(BARS)), {}
    for path, quantity in quantities_of(ROLLER).items():
        step = 0.01 * (quantity.high - quantity.low) * quantity.factor
        if abs(by := slope(ROLLER, path, step, max_pressure_angle)) > 1e-9:
            expected[words(path)] = by / deg
    assert set(bars) == set(expected)
    for name, text in bars.items():
        assert float(text.partition(" ")[0]) == pytest.approx(expected[name], rel=6e-3)
    sizes = [abs(expected[name]) for name in bars]
    assert sizes == sorted(sizes, reverse=True)
    page.keyboard.press("Escape")
    assert not card.is_visible()
    page.get_by_role("tab", name="Numbers").click()
    page.locator(".camkit-numbers tr[tabindex]").first.hover()
    page.wait_for_selector(".camkit-slope")
    assert card.is_visible()
    assert not page.heard


def kept(design):
    analysis = design.analyse()
    return max_pressure_angle.one(analysis) <= 30 * deg and min_profile_radius.one(analysis) >= 5 * mm


def test_what_can_be_built_is_painted_on_each_track(opened):  # noqa: F811
    page = opened(ROLLER, **LIMITS)
    page.wait_for_function(
        "() => camkit.rows[0].spans.length && camkit.rows[1].spans.length && camkit.rows[2].spans.length"
    )
    kinds = set()
    for k, path in list(enumerate(quantities_of(ROLLER)))[:3]:
        spans = page.evaluate(f"camkit.rows[{k}].spans")
        assert [a["high"] for a in spans[:-1]] == [b["low"] for b in spans[1:]]
        for span in spans:
            for share in (0.1, 0.5, 0.9):
                value = span["low"] + share * (span["high"] - span["low"])
                try:
                    kind = 1 + kept(with_quantities(ROLLER, {path: value}))
                except ValueError:
                    kind = 0
                assert kind == span["kind"]
                kinds.add(kind)
        title = page.evaluate(f"camkit.rows[{k}].slider.title")
        assert ("all limits kept from" in title) == any(span["kind"] == 2 for span in spans)
        assert page.locator(".camkit-left .camkit-track").nth(k).locator("span").count() == len(spans)
    assert kinds == {0, 1, 2}


def test_painting_gives_way_to_a_move_and_what_it_painted_before_is_pale(opened):  # noqa: F811
    page = opened(ROLLER, **LIMITS)
    page.wait_for_function("() => camkit.rows[0].spans.length && camkit.rows[1].spans.length")
    page.wait_for_function("() => !camkit.painting.steps")
    before = page.evaluate("camkit.rows[1].spans")
    moved = page.evaluate("""async () => {
        const row = camkit.rows[0], steps = [];
        for (let k = 1; k <= 8; k++) {
            row._take(row.value + 1e-5, false);
            await new Promise((next) => setTimeout(next, 60));
            steps.push(camkit.painting.steps);
        }
        const pale = getComputedStyle(camkit.rows[1].track).opacity;
        row.moved(row.value, true);
        return [steps, pale]; }""")
    assert moved == [[None] * 8, "0.3"]
    page.wait_for_function("() => !camkit.frame && camkit.painting.steps")
    page.wait_for_function("() => !camkit.painting.steps")
    assert page.evaluate("camkit.painted.get(1).startsWith(String(camkit.values[0]))")
    assert page.evaluate("camkit.rows[1].spans[0].low") == before[0]["low"]
    assert page.evaluate("getComputedStyle(camkit.rows[1].track).opacity") == "1"
