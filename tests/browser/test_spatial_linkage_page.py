"""The spatial linkage in JupyterLab: what the page shows against what camkit computes in this process."""

import base64
import io
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import BrowserContext, Locator, Page, expect

from camkit.linkage.measures import SWEEP, max_pressure_angle, room_in
from camkit.machines.cabin_door import HOUSING, CabinDoorLinkage, ninety_degree_study
from camkit.render.draw import colour
from camkit.units import deg, mm
from camkit.views.space import scene_of
from lab import LabServer, eventually, kernel_value, open_notebook, run_all, table_of_measures

STUDY = ninety_degree_study()
START = STUDY.start
PRACTICAL = STUDY.design(np.array([120, 120, 120, 99, 99]) * mm)
MEASURES = (max_pressure_angle, room_in(HOUSING), *SWEEP[1:])
AT_MOST, AT_LEAST = {max_pressure_angle: 50 * deg}, STUDY.at_least


@pytest.fixture(scope="module")
def page(context: BrowserContext, server: LabServer) -> Iterator[Page]:
    """The notebook opened and run once for all tests of this file."""
    page = context.new_page()
    open_notebook(page, "10_spatial_linkage.ipynb")
    run_all(page)
    yield page
    page.close()
    server.end_kernels()


@pytest.fixture
def panel(page: Page) -> Locator:
    return page.locator(".camkit-panel").filter(has_text="crank angle shown")


def box(panel: Locator, name: str) -> Locator:
    row = panel.locator(".camkit-knob").filter(
        has=panel.page.locator("span[title]", has_text=re.compile(rf"\s{name}$"))
    )
    return row.get_by_role("spinbutton")


def put(panel: Locator, name: str, text: str) -> None:
    box(panel, name).fill(text)
    box(panel, name).press("Enter")


def shows(panel: Locator, design: CabinDoorLinkage) -> None:
    """The table of measures shows ``design``, computed here."""
    rows = table_of_measures(MEASURES, design.analyse(), START.analyse(), AT_MOST, AT_LEAST)
    expect(panel.locator(".camkit-tables tr:has(td)")).to_have_text(rows)


def drawn(panel: Locator, points: Any, colour: str) -> bool:
    """Whether the picture shows ``colour`` at all of ``points``, ``(2, n)``, of the view in space."""
    data = panel.locator("img.camkit-image").evaluate(
        """async (image) => {
            await image.decode();
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
            canvas.getContext('2d').drawImage(image, 0, 0);
            return canvas.toDataURL('image/png').split(',')[1];
        }"""
    )
    image = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)
    at = kernel_value(panel.page, f"app.picture.axes[0].transData.transform({np.transpose(points).tolist()})")
    x, y = np.round(np.transpose(at)).astype(int)
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return bool((np.abs(image[len(image) - 1 - y, x] - wanted).max(-1) < 50).all())


def crank_seen(design: CabinDoorLinkage, turn: float, azimuth: float, elevation: float) -> np.ndarray:
    """Points along the crank on the picture of the view in space, computed here."""
    scene = scene_of(design.linkage, [HOUSING], azimuth, elevation)
    start, end = design.linkage.analyse(turn, design.branch).chain[:, :2, 0].T / mm
    return scene.seen(start[:, None] + np.linspace(0.3, 0.7, 7) * (end - start)[:, None])[:2]


def test_a_typed_size_and_load_change_numbers_and_picture(panel: Locator) -> None:
    shows(panel, PRACTICAL)
    put(panel, "crank", "110")
    put(panel, "load mass", "45.5")
    design = PRACTICAL.replace(crank=110 * mm, load=START.load.replace(mass=45.5))
    shows(panel, design)
    eventually(lambda: drawn(panel, crank_seen(design, 60 * deg, -60 * deg, 25 * deg), colour("position")))
    put(panel, "crank", "120")
    put(panel, "load mass", "30")
    shows(panel, PRACTICAL)


def test_the_crank_slider_ends_at_the_limits(panel: Locator) -> None:
    low, high = np.array(PRACTICAL.analyse().turn_range) / deg
    slider = panel.locator(".camkit-knob").filter(has_text="crank angle shown").get_by_role("slider")
    assert float(slider.get_attribute("aria-valuemin") or "") == pytest.approx(low, abs=0.11)
    assert float(slider.get_attribute("aria-valuemax") or "") == pytest.approx(high, abs=0.11)
    slider.press("End")
    eventually(lambda: abs(float(box(panel, "crank angle shown").input_value()) - high) < 1)
    turn = PRACTICAL.analyse().turn_range[1]
    eventually(lambda: drawn(panel, crank_seen(PRACTICAL, turn, -60 * deg, 25 * deg), colour("position")))
    expect(panel.get_by_role("alert")).to_have_count(0)
    put(panel, "crank angle shown", "60")


def test_the_mouse_turns_the_view(panel: Locator) -> None:
    image = panel.locator("img.camkit-image")
    image.scroll_into_view_if_needed()
    frame = image.bounding_box()
    assert frame
    x, y = frame["x"] + 0.2 * frame["width"], frame["y"] + 0.5 * frame["height"]
    panel.page.mouse.move(x, y)
    panel.page.mouse.down()
    panel.page.mouse.move(x + 90, y + 30, steps=9)
    panel.page.mouse.up()
    azimuth, elevation = -60 - 90 / frame["width"] * 360, 25 + 30 / frame["width"] * 360
    eventually(lambda: abs(float(box(panel, "azimuth").input_value()) - azimuth) < 0.5)
    eventually(lambda: abs(float(box(panel, "elevation").input_value()) - elevation) < 0.5)
    seen = kernel_value(panel.page, "[app.positions[name].value for name in ('azimuth', 'elevation')]")
    eventually(lambda: drawn(panel, crank_seen(PRACTICAL, 60 * deg, *seen), colour("position")))
    shows(panel, PRACTICAL)
    put(panel, "azimuth", "-60")
    put(panel, "elevation", "25")


def test_what_cannot_be_assembled_is_a_sentence(panel: Locator) -> None:
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the sentence is what is compared
        PRACTICAL.replace(coupler=50 * mm).analyse()
    put(panel, "coupler", "50")
    expect(panel.get_by_role("alert")).to_have_text(f"This cannot be built: {refused.value}.")
    put(panel, "coupler", "120")
    expect(panel.get_by_role("alert")).to_have_count(0)
    shows(panel, PRACTICAL)
