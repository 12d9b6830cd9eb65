"""The shaft's workbook in JupyterLab: what the page shows against what camkit computes in this process."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import BrowserContext, Locator, Page, expect

from camkit import deg, kW, mm, rpm
from camkit.linkage.universal_joint import DOUBLE_UNIVERSAL_JOINT_MEASURES, DoubleUniversalJoint
from camkit.machines.shaft import TUBE_NUMBERS, UniversalJointShaft, lightest_shaft, shaft_study
from camkit.render.draw import colour
from lab import LabServer, eventually, kernel_value, open_notebook, run_all, table_of_measures

START = UniversalJointShaft()


@dataclass(frozen=True)
class Workbook:
    """The opened notebook and its two panels."""

    page: Page
    tube: Locator
    joints: Locator

    def value(self, expression: str) -> Any:
        return kernel_value(self.page, expression)

    def row(self, panel: Locator, name: str) -> Locator:
        label = self.page.locator("span[title]", has_text=re.compile(rf"\s{name}$"))
        return panel.locator(".camkit-knob").filter(has=label)

    def type(self, panel: Locator, name: str, text: str) -> None:
        box = self.row(panel, name).get_by_role("spinbutton")
        box.fill(text)
        box.press("Enter")

    def press(self, words: str) -> None:
        self.tube.get_by_role("button", name=words).click()


@pytest.fixture(scope="module")
def book(context: BrowserContext, server: LabServer) -> Iterator[Workbook]:
    page = context.new_page()
    open_notebook(page, "12_universal_joint_shaft.ipynb")
    run_all(page)
    panels = page.locator(".camkit-panel")
    # a panel inside a panel: the outer one, with the buttons, comes first
    yield Workbook(page, panels.filter(has_text="allowable twist").first, panels.filter(has_text="second angle").first)
    page.close()
    server.end_kernels()


@pytest.fixture(autouse=True)
def _from_the_start(book: Workbook) -> None:
    book.press("Reset")
    shows(book, START)


def shows(book: Workbook, design: UniversalJointShaft) -> None:
    """Boxes and table show ``design``, computed here."""
    for name in ("outer_diameter", "inner_diameter"):
        box = book.row(book.tube, name.replace("_", " ")).get_by_role("spinbutton")
        expect(box).to_have_value(f"{getattr(design, name) / mm:.6g}")
    expected = table_of_measures(TUBE_NUMBERS, design.analyse(), START.analyse(), shaft_study().at_most, {})
    expect(book.tube.locator(".camkit-tables tr:has(td)")).to_have_text(expected)


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


def drawn(book: Workbook, points: np.ndarray, colour: str) -> np.ndarray:
    """At which of ``points`` (mm, ``(2, n)``) the plane of both diameters shows ``colour``."""
    x, y = np.transpose(book.value(f"app.picture.axes[0].transData.transform({np.transpose(points).tolist()})"))
    image, steps = picture(book.tube), range(-1, 2)
    rows, columns = len(image) - 1 - y.round().astype(int), x.round().astype(int)
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    near = np.abs(image - wanted).max(-1) < 60
    return np.any([near[rows + i, columns + j] for i in steps for j in steps], axis=0)


def twist_curve(design: UniversalJointShaft) -> np.ndarray:
    """Where the twist is just allowed, mm: in closed form; what lies under names and marks is left out."""
    d = np.array([86.0, 88.5, 91.0, 93.5, 106.0, 108.0])
    return np.array([design.stiff_diameter(d * mm) / mm, d])


def test_typed_power_moves_the_twist_limits_curve(book: Workbook) -> None:
    eventually(lambda: drawn(book, twist_curve(START), colour("series", 1)).all())
    book.type(book.tube, "power", "300")
    changed = START.replace(power=300 * kW)
    shows(book, changed)
    eventually(lambda: drawn(book, twist_curve(changed), colour("series", 1)).all())
    assert not drawn(book, twist_curve(START), colour("series", 1)).all()


def test_a_slider_moves_the_tube(book: Workbook) -> None:
    slider = book.row(book.tube, "outer diameter").get_by_role("slider")
    slider.focus()
    for _ in range(5):
        slider.press("ArrowRight")
    D = float(slider.get_attribute("aria-valuetext"))
    assert D > 128.64
    shows(book, START.replace(outer_diameter=D * mm))
    assert book.value("app.design.outer_diameter") == pytest.approx(D * mm, rel=1e-9)


def test_a_material_from_the_menu(book: Workbook) -> None:
    book.tube.get_by_label("material").select_option(label="EN AW-6082 T6")
    changed = START.made_of("EN AW-6082 T6")
    shows(book, changed)
    assert book.value("app.design.density") == 2700
    expect(book.row(book.tube, "density").get_by_role("spinbutton")).to_have_value("2700")


def test_buttons_put_a_tube_into_the_sliders(book: Workbook) -> None:
    book.press("lightest, by formula")
    shows(book, lightest_shaft())
    book.press("nearest GB/T 17395 tube")
    shows(book, START.replace(outer_diameter=133 * mm, inner_diameter=103 * mm))


def test_an_offer_that_cannot_be_made_is_a_sentence(book: Workbook) -> None:
    book.press("lightest EN 10210 tube")
    alert = book.tube.get_by_role("alert").first
    expect(alert).to_contain_text("This cannot be offered: none of the 3 standard tubes within 108 to 140 mm outside")
    shows(book, START)


def test_the_joints_follow_their_sliders(book: Workbook) -> None:
    book.type(book.joints, "phase", "90")
    first = DoubleUniversalJoint(
        first_angle=15 * deg,
        second_angle=12 * deg,
        speed=1000 * rpm,
        torque=START.torque,
        inertia=START.analyse().inertia,
    )
    now = first.replace(phase=90 * deg).analyse()
    cells = book.joints.locator(".camkit-tables tr:has(td) td:nth-child(2)")
    expect(cells).to_have_text([m.text(float(m(now))) for m in DOUBLE_UNIVERSAL_JOINT_MEASURES])
