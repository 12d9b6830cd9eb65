"""Sheets in tabs of the instrument: in JupyterLab, and in the file that lives without Python."""

import nbformat
import numpy as np
import pytest

from camkit import ArmLoad, DoorHandleCam, door_handle_study, quick_front
from camkit.quantities import quantities_of, value_of
from camkit.views.front import shown_objectives
from lab import eventually, kernel_value, open_notebook, run_all

SOURCE = """
import numpy as np
from camkit import ArmLoad, DoorHandleCam, Judgements, ahp_panel, door_handle_study, explore, quick_front
from camkit.panels.kit.drawn import LivePicture, nearest
from camkit.panels.kit.parts import Banner
from camkit.panels.kit.sheet import Panel
from camkit.quantities import quantities_of, value_of
from camkit.views.front import ShownFront, pareto, shown_objectives

study = door_handle_study(DoorHandleCam(lift_load=ArmLoad(torque=10)))
front = quick_front(study)
app = explore(study.start, at_most=study.at_most, at_least=study.at_least)
judged = ahp_panel(Judgements(["effort", "least radius"], [1]), "What matters?")


class FrontSheet(Panel):
    def __init__(self):
        self.banner, self.picture = Banner(), LivePicture((pareto,), "front", 7.6, 4.6)
        self.points = shown_objectives(front).T
        designs = [front[i] for i in range(len(front))]
        designs = [[value_of(design, path) for path in quantities_of(design)] for design in designs]
        self.picture.offer(self.points, designs)
        self.picture.on_click(lambda view, at, pixel: app.load(front[nearest(self.points, at, pixel)]))
        self.picture.show(ShownFront(front))
        super().__init__(self.banner, self.picture)


app.add_tab("Judgements", judged)
app.add_tab("Front", FrontSheet())
"""
STUDY = door_handle_study(DoorHandleCam(lift_load=ArmLoad(torque=10)))
FRONT = quick_front(STUDY)


def values(design):
    return [value_of(design, path) for path in quantities_of(design)]


def on_front(page, panel, k):
    """Where a design of the front stands on the page."""
    x, y = shown_objectives(FRONT)[:, k]
    return page.evaluate(
        f"""([x, y]) => {{ const parts = [...{panel}.sheets[1].parts.values()].map((p) => p.part);
            const [chart] = parts.find((part) => part.charts).charts;
            chart.canvas.scrollIntoView({{ block: "center" }});
            const box = chart.canvas.getBoundingClientRect();
            return [box.left + chart.x(x), box.top + chart.y(y)]; }}""",
        [float(x), float(y)],
    )


def look_and_choose(page, panel):
    """Hover over a point of the front and click it: a ghost, then the design, one step for Undo."""
    page.get_by_role("tab", name="Front").click()
    page.wait_for_function(f"() => {panel}.sheets[1].shown().pictures[0]?.marks.length")
    k = len(FRONT) // 2
    page.mouse.move(*on_front(page, panel, k))
    page.wait_for_function(f"() => {panel}.looked")
    ghost = page.evaluate(f"() => [...{panel}.looked.values]")
    near = FRONT.f - FRONT.f[k]
    alike = np.abs(near / np.ptp(FRONT.f, axis=0)).max(1) < 0.02  # points that lie over each other
    assert any(np.allclose(ghost[: len(values(FRONT[i]))], values(FRONT[i]), rtol=1e-12) for i in np.flatnonzero(alike))
    told = page.locator(".camkit-dock .camkit-tip:visible").inner_text().split("\n")[0]
    assert told in [f"design {i}" for i in np.flatnonzero(alike)]  # as everywhere: the front counts from 0
    before = page.evaluate(f"() => {panel}.history.past.length")
    page.mouse.down()
    page.mouse.up()
    page.wait_for_function(f"() => {panel}.history.past.length === {before + 1}")
    return page.evaluate(f"() => [...{panel}.values]")[: len(values(STUDY.start))]


def test_a_front_in_a_tab_shows_a_ghost_and_loads_a_design(page, server, tmp_path):
    export = f"app.to_html({str(tmp_path / 'cam.html')!r})"
    cells = [nbformat.v4.new_code_cell(source) for source in (SOURCE + "app", export)]
    notebook = nbformat.v4.new_notebook(cells=cells)
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    nbformat.write(notebook, server.root / "docks.ipynb")
    open_notebook(page, "docks.ipynb")
    run_all(page)
    page.wait_for_selector(".camkit-page canvas")
    panel = "document.querySelector('.camkit-page').parentElement.camkit"
    page.wait_for_function(f"() => {panel}.sheets.length === 2")
    chosen = look_and_choose(page, panel)
    eventually(
        lambda: (
            kernel_value(page, "[value_of(app.design, path) for path in quantities_of(app.design)]")
            == pytest.approx(chosen, rel=1e-14)
        )
    )
    page.get_by_role("tab", name="Judgements").click()
    slider = page.get_by_role("slider", name="effort against least radius")
    for _ in range(3):
        slider.press("ArrowLeft")
    eventually(lambda: kernel_value(page, "judged.judgements.above") == [4.0])
    page.wait_for_function(f"() => {panel}.sheets[0].shown().body.heard >= 1")
    page.evaluate(f"() => {{ window.old = {panel}.sheets[0]; }}")
    assert kernel_value(page, "app.add_tab('Judgements', ahp_panel(judged.judgements))") is None
    page.wait_for_function(f"() => window.old.ended && {panel}.sheets.length === 2")

    alone = page.context.new_page()
    alone.goto((tmp_path / "cam.html").as_uri())
    alone.wait_for_function("() => globalThis.camkit?.outputs && camkit.sheets.length === 2")
    assert look_and_choose(alone, "camkit") == pytest.approx(chosen, rel=1e-14)
    assert alone.get_by_role("tab", name="Judgements").is_visible()
    alone.close()
    assert (tmp_path / "cam.html").stat().st_size < 500_000
