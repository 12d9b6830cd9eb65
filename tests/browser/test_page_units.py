"""The units of a page: every number in those that a person chooses, and none of the design moved by it."""

import re

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import deg, inch, mm
from camkit.quantities import measures_of, quantities_of
from camkit.render.living import living
from camkit.render.positions import given_to
from camkit.units import convert, factor
from camkit.views import default_views
from lab import shown_by
from test_living_page import DRAWN, opened, same  # noqa: F401

IMPERIAL = {"mm": "inch", "cm": "inch", "m": "ft", "N": "lbf", "kN": "lbf", "kg": "lb", "MPa": "psi", "GPa": "psi"}


def shown_in(unit, others):
    return re.sub(r"[A-Za-z%]+", lambda name: others.get(name[0], name[0]), unit)


def ratio(label, others):
    """How many of the shown unit one of an axis's own is."""
    unit = re.search(r"\[(.*)\]$", label)
    unit = unit[1].removeprefix("10^6 ") if unit else ""
    return convert(1, unit, shown_in(unit, others)) if unit not in ("", "-") else 1


def choose(page, name):
    page.get_by_label("units").select_option(name)
    page.wait_for_function(DRAWN)


@pytest.mark.parametrize("name", ["door handle", "valve", "lever", "cabin door"])
def test_every_number_is_in_the_units_that_are_chosen(name, opened):  # noqa: F811
    design, others = MACHINES[name], IMPERIAL | {"deg": "rad"}
    page = opened(design)
    before = shown_by(page)
    choose(page, "inch, rad, lbf")
    shown, analysis = shown_by(page), design.analyse()
    assert shown["values"] == before["values"]
    position = living(design).first
    for view, drawn in zip(default_views(analysis), shown["pictures"], strict=True):
        picture = view(analysis, **given_to(view, position))
        across, up = (ratio(label, others) for label in (picture.axes.xlabel, picture.axes.ylabel))
        by = {"x": across, "y": up, "radius": across, "low": up, "high": up}
        for mark in drawn["marks"]:
            for part in by.keys() & mark:
                times = across if mark.get("along") == "y" else by[part]
                same(mark[part], times * np.asarray(getattr(picture[mark["key"]], part)), f"{mark['key']} {part}")
    for measure, text in zip(measures_of(design), shown["measures"], strict=True):
        number = re.match(r"[-\d.e+]+|nan|inf", text)[0]
        expected = measure.one(analysis) / factor(shown_in(measure.unit, others))
        assert float(number) == pytest.approx(expected, rel=1e-3, abs=1e-12, nan_ok=True)
    for row, (path, quantity) in zip(_rows(page), quantities_of(design).items(), strict=False):
        low, high, value = (float(number) for number in row)
        assert low == pytest.approx(
            convert(quantity.low, quantity.unit, shown_in(quantity.unit, others)), abs=high / 200
        )
        assert high == pytest.approx(convert(quantity.high, quantity.unit, shown_in(quantity.unit, others)))
        given = before["values"][list(quantities_of(design)).index(path)] / quantity.factor
        assert value == pytest.approx(
            convert(given, quantity.unit, shown_in(quantity.unit, others)), rel=1e-5, abs=1e-9
        )
    choose(page, page.locator("select[aria-label=units] option").first.inner_text())
    assert shown_by(page) == before
    assert not page.heard


def _rows(page):
    return page.evaluate("camkit.quantities.rows.map((r) => [r.slider.min, r.slider.max, r.box.value])")


def test_a_typed_number_is_in_the_shown_unit_unless_it_has_one(opened):  # noqa: F811
    page = opened(MACHINES["door handle"])
    choose(page, "inch, deg, lbf")
    box = page.get_by_label("lift arm, inch, number")
    for text, value in (("2", 2 * inch), ("48.09 mm", 48.09 * mm), ("1 7/8", 1.875 * inch)):
        box.fill(text)
        box.press("Enter")
        assert page.evaluate("camkit.values[0]") == pytest.approx(value, rel=1e-12)
    box.fill("400 mm")
    box.press("Enter")
    page.wait_for_function("() => camkit.sentence && !camkit.frame")
    assert "mm" in page.evaluate("camkit.sentence")  # as the package says it
    assert re.search(r"\d inch", page.locator(".camkit-over").inner_text())
    assert "mm" not in page.locator(".camkit-over").inner_text()
    choose(page, "mm, rad, N")
    page.get_by_label("cam angle, rad, number", exact=True).fill("1")
    page.get_by_label("cam angle, rad, number", exact=True).press("Enter")
    assert page.evaluate("camkit.positions.angle") == pytest.approx(1 / deg)
    assert "mm" in page.locator(".camkit-over").inner_text()


def test_texts_keep_what_is_no_number_with_a_unit(opened):  # noqa: F811
    page = opened(MACHINES["door handle"])
    choose(page, "inch, deg, lbf")
    for text, shown in (
        ("arm 50.8 mm long", "arm 2 inch long"),
        ("between 25.4 and 50.8 mm, at 30 deg", "between 1 and 2 inch, at 30 °"),
        ("of 3 parts, mm or m; design 3, 50.8 mm", "of 3 parts, mm or m; design 3, 2 inch"),
        ("M8 x 50.8 mm", "M8 x 2 inch"),
        ("50.8 × 25.4 mm", "2 × 1 inch"),
        ("1000 N mm", "8.851 lbf inch"),
        ("M3 mm", "M3 mm"),
    ):
        found = page.evaluate("(text) => camkit.units.words(text)", text)
        assert found == shown
