"""The spatial linkage in JupyterLab: what the page shows against what camkit computes in this process."""

from functools import partial

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from camkit.linkage.measures import SWEEP, max_pressure_angle, room_in
from camkit.machines.cabin_door import HOUSING, ninety_degree_study
from camkit.quantities import quantities_of
from camkit.units import deg, mm
from camkit.views import default_views, linkage_in_space
from lab import Instrument, kernel_value, open_notebook, run_all
from test_living_page import compare

STUDY = ninety_degree_study()
START = STUDY.start
PRACTICAL = STUDY.design(np.array([120, 120, 120, 99, 99]) * mm)
MEASURES = (max_pressure_angle, room_in(HOUSING), *SWEEP[1:])
LIMITS = {max_pressure_angle: 50 * deg, **STUDY.at_least}
_, *CURVES = default_views(START.analyse())
IN_SPACE = partial(linkage_in_space, inside=HOUSING)
IN_SPACE.__name__ = "linkage_in_space"


@pytest.fixture(scope="module")
def app(window: Page) -> Instrument:
    """The notebook opened and run once for all tests of this file."""
    open_notebook(window, "10_spatial_linkage.ipynb")
    run_all(window)
    return Instrument(window)


@pytest.fixture(autouse=True)
def _from_the_practical_linkage(app: Instrument) -> None:
    kernel_value(app.page, "app.load(practical)")
    app.shows(PRACTICAL, MEASURES)


def test_typed_sizes_and_loads_change_numbers_and_pictures(app: Instrument) -> None:
    app.type("crank, mm", "110")
    app.type("load mass, kg", "45.5")
    design = PRACTICAL.replace(crank=110 * mm, load=START.load.replace(mass=45.5))
    app.shows(design, MEASURES)
    compare(app.shown(), design, [IN_SPACE, *CURVES], MEASURES, LIMITS)


def test_the_mouse_turns_the_view(app: Instrument) -> None:
    before = app.shown()["values"][len(quantities_of(START)) :]
    canvas = app.root.locator(".camkit-middle canvas")
    canvas.scroll_into_view_if_needed()
    frame = canvas.bounding_box()
    assert frame
    x, y = frame["x"] + 0.5 * frame["width"], frame["y"] + 0.5 * frame["height"]
    app.page.mouse.move(x, y)
    app.page.mouse.down()
    app.page.mouse.move(x + 90, y + 30, steps=9)
    app.page.mouse.up()
    shown = app.shown()
    after = shown["values"][len(quantities_of(START)) :]
    assert after[0] == before[0]
    assert all(abs(now - then) > 5 * deg for now, then in zip(after[1:], before[1:], strict=True))
    compare(shown, PRACTICAL, [IN_SPACE, *CURVES], MEASURES, LIMITS)


def test_what_cannot_be_assembled_is_a_sentence(app: Instrument) -> None:
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the sentence is what is compared
        PRACTICAL.replace(coupler=50 * mm).analyse()
    app.type("coupler, mm", "50")
    expect(app.root.locator(".camkit-over")).to_contain_text(str(refused.value).replace("deg", "°"))
    app.type("coupler, mm", "120")
    app.shows(PRACTICAL, MEASURES)
    assert not app.shown()["sentence"]
