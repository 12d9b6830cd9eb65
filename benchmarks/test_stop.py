"""From a click on Stop to the words that the search has stopped, in real headless Chromium."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Page, expect

STOPS = 9

CELLS = [
    """
from camkit import DoorHandleCam, explore, pareto_panel
from camkit.machines import lift_curve_study
from camkit.machines.door_handle import LIFT_SPACE
from camkit.views import mechanism

app = explore(DoorHandleCam(), mechanism)
pareto_panel(app, {"lift curve": lift_curve_study()}, generations=10000)"""
]

WATCH = """([button, status]) => {
    window.camkitStop = new Promise(resolve => {
        let clicked;
        button.addEventListener('click', (event) => { clicked = event.timeStamp; }, {capture: true, once: true});
        new MutationObserver((_, observer) => {
            if (clicked === undefined || !status.textContent.includes('(stopped)')) return;
            observer.disconnect();
            resolve(performance.now() - clicked);
        }).observe(status, {childList: true, characterData: true, subtree: true});
    });
}"""


def stopped_after(page: Page) -> float:
    """Milliseconds from the click to the words."""
    stop, status = page.get_by_role("button", name="Stop"), page.locator(".camkit-status")
    page.get_by_role("button", name="Optimise").click()
    expect(status).to_contain_text("of 10000", timeout=30_000)
    expect(status).not_to_contain_text("stopped")
    page.evaluate(WATCH, [stop.element_handle(), status.element_handle()])
    stop.click()
    took = float(page.evaluate("camkitStop"))
    expect(page.get_by_role("button", name="Optimise")).to_be_enabled()
    return took


def test_stop_takes_effect(benchmark: Any, page: Page, report: Callable[[str, str], None]) -> None:
    took: list[float] = []
    benchmark.pedantic(lambda: took.append(stopped_after(page)), rounds=STOPS)
    report("click on Stop to (stopped) (median; most)", f"{statistics.median(took):.0f} ms; {max(took):.0f} ms")
    benchmark.extra_info.update(median_ms=statistics.median(took), most_ms=max(took))
