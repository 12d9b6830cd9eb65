"""The instrument of a cam with an elastic train: the kernel computes, and the train moves as the cam turns."""

import nbformat
import pytest
from playwright.sync_api import expect

from lab import Instrument, eventually, kernel_value, open_notebook, run_all

START = """
from camkit import TranslatingRollerCam, deg, explore, rpm
from camkit.cam import SlideLoad
from camkit.dynamics import ElasticFollower, ElasticTrain, contact_margin
load = SlideLoad(mass=2.0, speed=600 * rpm, spring_rate=5e3, preload=300.0)
machine = ElasticFollower(TranslatingRollerCam(groove=False, load=load), ElasticTrain(8e5, 100.0, 20.0))
app = explore(machine, free=["cam.load.speed", "train.stiffness"], at_least={contact_margin: 0.1}, turn=80 * deg)
app
"""
PAGE = "document.querySelector('.camkit-page').parentElement.camkit"


def marks(shown, picture):
    """The marks of a picture by their key."""
    return {mark["key"]: mark for mark in shown["pictures"][picture]["marks"]}


def title(window, picture):
    return window.evaluate(f"() => {PAGE}.charts[{picture}].heading.title")


def test_a_train_moves_leaves_its_cam_and_misses_its_limit(window, server):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(START)])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "at_speed.ipynb")
    open_notebook(window, "at_speed.ipynb")
    run_all(window)
    window.wait_for_selector(".camkit-page canvas")
    instrument, chip = Instrument(window), window.locator(".camkit-chips .camkit-chip").first
    first = instrument.shown()
    assert title(window, 0).startswith("Cam and train  (deflection × ")
    expect(chip).to_have_class("camkit-chip camkit-ok")

    window.evaluate(f"() => {PAGE}.positions.turnTo(130)")  # the spring, the load and the cam are elsewhere
    eventually(lambda: marks(instrument.shown(), 0)["train spring"]["y"] != marks(first, 0)["train spring"]["y"])
    before = instrument.shown()
    assert marks(before, 1)["elastic"]["y"] == marks(first, 1)["elastic"]["y"]

    instrument.type("cam speed, rpm", "800")
    eventually(lambda: "gap" in title(window, 0))
    shown = instrument.shown()
    assert title(window, 1).startswith("Dynamic factor ")
    assert title(window, 3).startswith("Gap: up to ")
    assert marks(shown, 1)["elastic"]["y"] != marks(before, 1)["elastic"]["y"]
    expect(chip).to_have_class("camkit-chip camkit-bad")
    eventually(lambda: kernel_value(window, "app.design.cam.load.speed") == pytest.approx(83.7758041, rel=1e-8))

    instrument.reset()
    expect(chip).to_have_class("camkit-chip camkit-ok")
