"""How a panel shows itself: at once with its picture, or in a page that runs the cell first without it."""

import asyncio
import threading
from types import SimpleNamespace

import pytest
from IPython.core.events import EventManager, available_events

from camkit import Judgements, TranslatingRollerCam, ahp_panel, edit_program, explore, mm, presets
from camkit.panels.kit import displayed
from camkit.panels.kit.running import Place
from camkit.views import pressure_angle

LIVE = "application/vnd.jupyter.widget-view+json"


@pytest.fixture
def cell(monkeypatch):
    """A page runs cells: ``run(place, panels)`` gives what it is shown, as it is when no cell runs any more."""
    events = EventManager(None, available_events)
    shell = SimpleNamespace(events=events)
    monkeypatch.setattr(displayed, "get_ipython", lambda: shell)
    monkeypatch.setattr(displayed, "LATER", displayed.Later())
    monkeypatch.setattr(displayed, "REST", 0.0)
    monkeypatch.setattr(displayed, "BETWEEN", 0.0)
    shown, first = [], []

    def display(data, **options):
        assert options["raw"]
        assert options["display_id"]
        k = len(shown)
        shown.append(set(data))
        return SimpleNamespace(update=lambda data, **_: shown.__setitem__(k, set(data)))

    async def runs(cells):
        for place, panels in cells:
            monkeypatch.setattr(displayed, "here", lambda place=place: place)
            events.trigger("pre_run_cell", None)
            for panel in panels:
                panel._ipython_display_()
            events.trigger("post_run_cell", None)
        first.extend(shown)
        for _ in range(50):
            await asyncio.sleep(0)
        return first, shown

    monkeypatch.setattr(displayed, "display", display)
    return lambda *cells: asyncio.run(runs(cells))


def panels():
    app = explore(TranslatingRollerCam(), pressure_angle)
    return [app, ahp_panel(Judgements(["a", "b"], [2])), presets(app, buttons={"itself": lambda cam: cam})]


def test_a_page_gets_the_panels_first_and_their_pictures_when_no_cell_runs(cell):
    first, last = cell(*((Place(str(k), "run"), [panel]) for k, panel in enumerate(panels())))
    assert first == [{LIVE, "text/plain"}] * 3
    assert last == [{LIVE, "text/plain", "image/png"}] * 3


def test_pictures_wait_while_a_person_moves_something(monkeypatch):
    app, made, events = panels()[0], [], EventManager(None, available_events)
    monkeypatch.setattr(displayed, "get_ipython", lambda: SimpleNamespace(events=events))
    monkeypatch.setattr(displayed, "LATER", later := displayed.Later())

    async def moves():
        later.add(Place("a", "run"), lambda: made.append("picture"))
        events.trigger("post_run_cell", None)
        before = later.timer
        app._handle_msg({"content": {"data": {"method": "update", "state": {"values": app.values}}}, "buffers": []})
        assert before.cancelled()
        assert later.timer.when() > before.when()
        events.trigger("pre_run_cell", None)
        app._handle_msg({"content": {"data": {"method": "request_state"}}, "buffers": []})
        assert later.timer is None  # the end of the cell begins anew

    asyncio.run(moves())
    assert not made


def test_a_cell_waits_until_what_pages_say_is_heard(monkeypatch):
    hearing, order, begun, enough = displayed.Hearing(), [], threading.Event(), threading.Event()

    def speak():
        with hearing.word():
            begun.set()
            assert enough.wait(5)
            order.append("heard")

    for patience, expected in ((5.0, ["heard", "cell"]), (0.05, ["cell"])):
        monkeypatch.setattr(displayed, "PATIENCE", patience)
        order.clear(), begun.clear(), enough.clear()
        thread = threading.Thread(target=speak)
        thread.start()
        assert begun.wait(5)
        if patience > 1:
            threading.Timer(0.1, enough.set).start()
        hearing.wait()
        order.append("cell")
        assert order == expected  # a function that never ends is not waited for
        enough.set()
        thread.join()


def test_a_page_that_runs_a_cell_does_not_wait_for_itself(monkeypatch):
    hearing = displayed.Hearing()
    monkeypatch.setattr(displayed.time, "sleep", lambda _: pytest.fail("it waits"))
    with hearing.word():
        hearing.wait()


def test_a_cell_that_runs_again_asks_for_its_new_pictures_alone(cell):
    app, judged, _ = panels()
    _, last = cell((Place("a", "first"), [app]), (Place("b", "first"), [judged]), (Place("a", "second"), [app, app]))
    assert ["image/png" in each for each in last] == [False, True, True, True]


@pytest.mark.parametrize("error", [ValueError("a curve reaches too far"), RuntimeError("somebody's own view")])
def test_a_panel_that_cannot_be_drawn_has_no_picture_and_the_others_have(cell, monkeypatch, error):
    app, judged, _ = panels()

    def impossible():
        raise error

    monkeypatch.setattr(app, "drawing", lambda: impossible)
    _, last = cell((Place("a", "run"), [app, judged]))
    assert ["image/png" in each for each in last] == [False, True]


def test_the_picture_is_of_the_design_that_the_numbers_beside_it_are_of():
    app, _, offers = panels()
    editor = edit_program(app.design.motion)
    before = [(panel.drawing(), panel.still()) for panel in (app, offers, editor)]
    app.design = app.design.replace(base_radius=80 * mm)
    editor.rows[0].angle.value -= 10
    editor.rows[1].angle.value += 10
    assert all(draw() == still for draw, still in before)
    assert all(panel.still() != still for panel, (_, still) in zip((app, offers, editor), before, strict=True))


def test_where_no_page_runs_the_cell_all_is_there_at_once():
    for panel in panels():
        with pytest.raises(NotImplementedError):
            panel._ipython_display_()
        assert set(panel._repr_mimebundle_()[0]) == {LIVE, "text/plain", "image/png"}


def test_a_published_page_waits_for_no_picture(monkeypatch):
    monkeypatch.setenv("VOILA_BASE_URL", "/")
    assert [set(panel._repr_mimebundle_()[0]) for panel in panels()] == [{LIVE, "text/plain"}] * 3
