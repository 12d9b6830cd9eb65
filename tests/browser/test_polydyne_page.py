"""A button makes the cam under the sliders a polydyne cam; Undo takes it back, and what cannot be is said."""

from pathlib import Path

from playwright.sync_api import expect

from lab import eventually, kernel_value, screenshot
from test_instrument_page import PAGE, settled, shown

SHOTS = Path(__file__).parents[2] / ".browser"
SOURCE = """
from camkit import SlideLoad, TranslatingFlatCam, deg, explore, mm, rpm
from camkit.dynamics import ElasticFollower, ElasticTrain, dwell_vibration
from camkit.motion import Dwell, MotionProgram, Poly56789, Return, Rise
up, down = Rise(120 * deg, 20 * mm, Poly56789()), Return(120 * deg, 20 * mm, Poly56789())
motion = MotionProgram((up, Dwell(60 * deg), down, Dwell(60 * deg)))
cam = TranslatingFlatCam(motion, 80 * mm, load=SlideLoad(mass=2, speed=600 * rpm, spring_rate=5e3, preload=300))
app = explore(ElasticFollower(cam, ElasticTrain(damping=0, ground_damping=20)), measures=[dwell_vibration])
app
"""
NAMES = f"{PAGE}.structure.pictures.map((picture) => picture.name)"
MADE = "type(app.design.cam.motion).__name__ == 'PolydyneProgram'"
PLAIN = "type(app.design.cam.motion).__name__ == 'MotionProgram'"
__all__ = ["shown"]


def test_a_cam_becomes_a_polydyne_cam_and_back(shown):
    page = shown(SOURCE, "polydyne.ipynb")
    page.locator(".camkit-left details", has_text="cam motion").first.evaluate("group => { group.open = true; }")
    button = page.get_by_role("button", name="Make it a polydyne cam")
    screenshot(page, SHOTS / "polydyne_before.png")
    button.click()
    eventually(lambda: kernel_value(page, MADE) is True)
    page.wait_for_function(f"() => {NAMES}.includes('vibration_beside_plain')")
    settled(page)
    assert page.evaluate(f"{PAGE}.judged[0].now") < 1e-9 < page.evaluate(f"{PAGE}.judged[0].then")
    expect(page.get_by_role("button", name="Fit it to this train")).to_be_visible()
    speed = page.get_by_label("cam motion design speed, rpm", exact=True)
    screenshot(page, SHOTS / "polydyne_after.png")
    speed.press("ArrowRight")
    eventually(lambda: kernel_value(page, "app.design.cam.motion.design_speed > app.design.cam.load.speed") is True)
    for _ in range(2):
        page.get_by_role("button", name="Undo").click()
        settled(page)
    eventually(lambda: kernel_value(page, PLAIN) is True)
    expect(button).to_be_visible()
    page.get_by_role("button", name="Redo").click()
    eventually(lambda: kernel_value(page, MADE) is True)
    page.get_by_role("button", name="Back to the cam as wanted").click()
    eventually(lambda: kernel_value(page, PLAIN) is True)

    kernel_value(
        page, "app.load(__import__('camkit').with_quantities(app.design, {'cam.motion.rise.law': 'cycloidal'}))"
    )
    settled(page)
    expect(button).to_be_visible()
    button.click()
    expect(page.locator(".camkit-note")).to_contain_text("The third derivative of the wanted motion jumps at")
    screenshot(page, SHOTS / "polydyne_refused.png")
    assert kernel_value(page, PLAIN) is True
