"""A click on a chip of the verdict goes to where its number stands: the angle, the curve, what is undercut."""

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import deg
from camkit.cam import base_radius, max_pressure_angle, min_convex_radius, peak_force
from test_living_page import DRAWN, opened  # noqa: F401

CAM = MACHINES["roller"]
SEEN = """(k) => { const frame = camkit.charts[k].canvas.parentElement, box = frame.getBoundingClientRect(),
    side = document.querySelector(".camkit-right-side").getBoundingClientRect();
    return box.top >= side.top - 1 && box.bottom <= side.bottom + 1; }"""

LASTING = """() => { const wait = window.setTimeout;
    window.setTimeout = (act, time, ...given) => time > 500 ? 0 : wait(act, time, ...given); }"""
"""A ring stays until it has been looked at."""


def names(page):
    return page.evaluate("camkit.charts.map((chart) => chart.picture.name)")


def angle(page):
    page.wait_for_function(DRAWN)
    return page.evaluate("camkit.positions.angle")


def chip(page, words):
    return page.locator(".camkit-chips [role=button]", has_text=words)


def test_a_click_on_a_chip_turns_to_the_worst_place_and_shows_its_curve(opened):  # noqa: F811
    measures = [max_pressure_angle, peak_force, min_convex_radius, base_radius]
    page, analysis = opened(CAM, measures=measures, at_most={max_pressure_angle: 30 * deg}), CAM.analyse()
    page.get_by_role("tab", name="Numbers").click()
    page.get_by_role("button", name="more").click()
    chip(page, "maximum pressure angle").click()
    worst = analysis.highest(lambda at: abs(at.pressure_angle))
    assert angle(page) == pytest.approx(float(worst.cam_angle) / deg, abs=0.5)
    assert page.get_by_role("tab", selected=True).inner_text() == "Curves"
    k = names(page).index("pressure_angle")
    assert page.evaluate(SEEN, k)
    flashed = page.locator(".camkit-curve.camkit-flash")
    assert flashed.count() == 1
    assert flashed.evaluate(f"frame => frame.firstChild === camkit.charts[{k}].canvas")
    ring = page.locator(".camkit-ring").bounding_box()
    box = page.evaluate(
        f"(() => {{ const c = camkit.charts[{k}], b = c.canvas.getBoundingClientRect();"
        " return [b.left + c.x(camkit.positions.angle), b.top]; })()"
    )
    assert ring["x"] + ring["width"] / 2 == pytest.approx(box[0], abs=1.5)
    assert not page.locator(".camkit-why").is_visible()
    page.wait_for_function("() => !document.querySelector('.camkit-ring, .camkit-flash')")
    chip(page, "peak contact force").focus()
    assert page.locator(".camkit-why").is_visible()  # as before
    page.keyboard.press("Enter")
    force = analysis.highest(lambda at: abs(at.contact_force))
    assert angle(page) == pytest.approx(float(force.cam_angle) / deg, abs=0.5)
    chip(page, "minimum convex radius").click()  # one over a curvature
    sharp = analysis.sharpest(1)
    assert angle(page) == pytest.approx(float(sharp.cam_angle) / deg, abs=0.5)
    here = angle(page)
    page.mouse.move(470, 300)
    chip(page, "base radius").click()  # it stands at no angle: Why
    assert page.locator(".camkit-why").is_visible()
    assert angle(page) == here
    assert not page.heard


def test_a_click_on_trouble_turns_to_it_and_rings_what_is_undercut(opened):  # noqa: F811
    design = MACHINES["door handle"]
    page = opened(design)
    said = page.locator(".camkit-trouble")
    words = said.inner_text()
    assert words == design.analyse().trouble.replace(" deg", " °")
    said.click()
    told = np.mean([float(end) for end in words.partition(" at ")[2].partition(" °")[0].split(" to ")])
    assert angle(page) == pytest.approx(told, abs=0.01)
    page.get_by_label("units").select_option("mm, rad, N")
    page.evaluate("camkit.positions.turnTo(0)")
    page.wait_for_function(DRAWN)
    page.evaluate(LASTING)
    said.click()
    assert angle(page) == pytest.approx(told, abs=0.01)  # of the design, whatever unit is shown
    (trouble,) = page.evaluate("camkit.shown().pictures[0].troubles.slice(0, 1)")
    ring, canvas = (
        page.locator(".camkit-middle .camkit-ring").first.bounding_box(),
        page.locator(".camkit-middle canvas"),
    )
    box = canvas.bounding_box()
    place = page.evaluate(f"[camkit.charts[0].x({trouble['x']}), camkit.charts[0].y({trouble['y']})]")
    middle = np.array([ring["x"] + ring["width"] / 2 - box["x"], ring["y"] + ring["height"] / 2 - box["y"]])
    np.testing.assert_allclose(middle, place, atol=1.5)
