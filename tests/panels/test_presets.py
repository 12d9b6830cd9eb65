"""Menus and buttons over an explorer: each puts another design into its sliders, or says why not."""

from functools import partial
from operator import methodcaller

import pytest
from hand import at, move
from sheets import do
from try_everything import try_everything

from camkit import explore, kW, mm
from camkit.machines.shaft import (
    MATERIALS,
    UniversalJointShaft,
    lightest_shaft,
    lightest_tube,
    nearest_tube,
    shaft_study,
    standard_tubes,
    tube_area,
)
from camkit.panels.presets import Presets, presets
from camkit.views import utilisation

SEAMLESS = standard_tubes("GB/T 17395")


@pytest.fixture
def panel() -> Presets:
    app = explore(UniversalJointShaft(), utilisation, measures=(tube_area,))
    buttons = {
        "lightest": lightest_shaft,
        "snap": partial(nearest_tube, tubes=SEAMLESS),
        "EN": lambda shaft: lightest_tube(shaft_study(shaft), standard_tubes()),
    }
    return presets(app, {"material": {name: methodcaller("made_of", name) for name in MATERIALS}}, buttons)


def said(panel: Presets) -> str:
    return panel.banner.text


def chosen(menu) -> str | None:
    return None if menu.index is None else menu.options[menu.index][0]


def choose(panel: Presets, name: str, option: str) -> None:
    menu = panel.menus[name]
    do(panel.sheet, menu, value=[words for words, _ in menu.options].index(option))


def test_a_menu_changes_the_design_and_the_sliders(panel) -> None:
    menu = panel.menus["material"]
    assert chosen(menu) == "20Cr"
    choose(panel, "material", "EN AW-6082 T6")
    assert panel.explorer.design == UniversalJointShaft().made_of("EN AW-6082 T6")
    assert at(panel.explorer, "density") == 2700
    assert at(panel.explorer, "elastic_modulus") == 70


def test_a_menu_shows_which_option_the_design_is(panel) -> None:
    menu = panel.menus["material"]
    panel.explorer.load(UniversalJointShaft(power=100 * kW).made_of("40Cr"))
    assert chosen(menu) == "40Cr"
    move(panel.explorer, "density", 7000)
    assert chosen(menu) is None
    assert panel.explorer.design.density == 7000
    move(panel.explorer, "density", 7850)
    assert chosen(menu) == "40Cr"


def test_the_other_numbers_stay_when_the_material_changes(panel) -> None:
    move(panel.explorer, "power", 200)
    choose(panel, "material", "42CrMo")
    assert panel.explorer.design == UniversalJointShaft(power=200 * kW).made_of("42CrMo")


def test_a_button_snaps_to_the_nearest_tube(panel) -> None:
    panel.buttons["snap"].click()
    design = panel.explorer.design
    assert (design.outer_diameter / mm, design.inner_diameter / mm) == pytest.approx((133, 101))
    assert at(panel.explorer, "outer_diameter") == 133
    panel.buttons["snap"].click()
    assert panel.explorer.design == design


def test_a_button_takes_the_optimum(panel) -> None:
    panel.buttons["lightest"].click()
    assert panel.explorer.design == lightest_shaft()
    assert "4776 mm^2" in panel.explorer.summary()


def test_an_offer_that_cannot_be_made_is_a_sentence_and_the_design_stays(panel) -> None:
    before = panel.explorer.design
    panel.buttons["EN"].click()
    assert "This cannot be offered: none of the 3 standard tubes within 108 to 140 mm outside" in said(panel)
    assert panel.explorer.design == before
    move(panel.explorer, "power", 250)
    assert said(panel) == ""


def test_every_control_can_be_moved(panel) -> None:
    assert try_everything(panel) == 15


def test_it_has_the_explorers_picture(panel) -> None:
    data, _ = panel._repr_mimebundle_()
    assert data["text/plain"] == panel.explorer.summary()
    assert data["image/png"]


def test_a_menu_with_an_option_that_cannot_be_made_is_shown_and_refuses_it_in_a_sentence() -> None:
    app = explore(UniversalJointShaft(), utilisation, measures=(tube_area,))
    panel = presets(
        app, {"bore": {"none": lambda shaft: shaft.replace(inner_diameter=-1 * mm), "as it is": lambda s: s}}
    )
    assert chosen(panel.menus["bore"]) == "as it is"
    choose(panel, "bore", "none")
    assert "This cannot be offered: the inner diameter" in said(panel)
    assert chosen(panel.menus["bore"]) == "as it is"
