"""What a person did last: kept when a page says so, offered to the next one, and never taken or lost by itself."""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from uuid import uuid4

import pytest
import traitlets

from camkit import DoorHandleCam, Measure, TranslatingRollerCam, mm
from camkit.cam import max_pressure_angle, min_profile_radius
from camkit.panels import explore
from camkit.panels.kit import kept_designs, running
from camkit.panels.kit.changes import numbers_of
from camkit.panels.kit.kept_designs import KeptDesigns, Last
from camkit.panels.kit.search_files import FOLDER
from camkit.quantities import choices_of, quantities_of, value_of
from camkit.views import mechanism

KINDS = "TranslatingRollerCam-*.designs"


@pytest.fixture(autouse=True)
def beside(tmp_path, monkeypatch):
    """The folder of a notebook."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(monkeypatch):
    """A run of a cell: the panel that it makes, and what the panel sends to its page."""

    def made(cell="cell", design=None):
        place = running.Place(cell, uuid4().hex)
        monkeypatch.setattr("camkit.panels.kit.keeper.here", lambda: place)
        app = explore(design or TranslatingRollerCam(groove=False), mechanism, measures=[max_pressure_angle])
        app.sent = []
        monkeypatch.setattr(app, "send", lambda content, buffers=(): app.sent.append(content))
        return app

    return made


def say(app, **session):
    """What the page says of its session."""
    app._handle_custom_msg({"session": session}, [])


def offered(app):
    say(app, hello=True)
    return next(content["offer"] for content in reversed(app.sent) if "offer" in content)


def leave(app, radius, **page):
    """A person drags the base radius and lets go; then the page says how it was left."""
    paths = list(quantities_of(app.design))
    app.values = [radius if path == "base_radius" else value_of(app.design, path) for path in paths]
    app.page = {**page, "number": app.page.get("number", 0) + 1}


def files():
    return sorted(FOLDER.glob(KINDS))


def test_a_design_that_was_left_is_offered_and_not_taken(run):
    first = run()
    assert offered(first) == ""
    leave(first, 48.1 * mm, at=[0.5])
    again = run()
    assert offered(again) == "Continue with your last design, base radius 48.1 mm?"
    assert again.design == again.start
    say(again, **{"continue": True})
    assert again.design == first.design
    assert again.page["at"] == [0.5]
    assert {"stand": again.page} in again.sent
    assert offered(again) == ""
    assert offered(run()).startswith("Continue with")


def test_no_is_an_answer_for_good(run):
    leave_first = run()
    offered(leave_first)
    leave(leave_first, 48 * mm)
    again = run()
    offered(again)
    say(again, **{"continue": False})
    assert again.sent[-1]["offer"] == ""
    assert again.design == again.start
    assert offered(run()) == ""
    leave(again, 51 * mm)
    last = run()
    assert offered(last) == "Continue with your last design, base radius 51 mm?"
    say(last, **{"continue": False})
    assert last.sent[-1]["offer"] == ""  # what was refused is not offered by and by


def test_a_design_that_cannot_be_shown_any_more_stays_kept(run, monkeypatch):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    again = run()
    offer = offered(again)

    def fails(analysis):
        raise ArithmeticError("too far away")

    monkeypatch.setattr(again, "measures", (Measure("too far", "mm", fails),))
    say(again, **{"continue": True})
    assert again.design == again.start
    assert again.message.startswith("This design cannot be computed and drawn")
    assert again.sent[-1]["offer"] == offer
    leave(again, 51 * mm)
    last = run()
    offered(last)
    assert last.keeper.offers[-1][1].base_radius == 48 * mm


def test_the_page_hears_which_names_there_are_when_one_is_refused(run):
    app = run()
    offered(app)
    say(app, keep=["one", app.values])
    say(app, keep=["other", app.values])
    for wrong in ({"keep": ["never", [-1.0] * len(app.values)]}, {"rename": ["one", "other"]}, {"forget": "none"}):
        app.sent.clear()
        app.message = ""
        say(app, **wrong)
        assert app.message
        assert [name for name, _ in app.sent[-1]["named"]] == ["one", "other"]


def test_what_was_not_answered_is_not_lost(run):
    first, second = run(), run()
    offered(first)
    leave(first, 48 * mm)
    offered(second)
    leave(second, 51 * mm)
    third = run()
    assert offered(third) == "Continue with your last design, base radius 51 mm?"
    say(third, **{"continue": False})
    assert third.sent[-1]["offer"] == "Continue with your last design, base radius 48 mm?"


def test_without_a_page_nothing_is_read_or_written(run, monkeypatch):
    app = run()
    leave(app, 48 * mm)
    app.design = app.design.replace(base_radius=51 * mm)
    assert not FOLDER.exists()
    offered(app)
    assert not FOLDER.exists()  # a page that opens writes nothing either
    monkeypatch.setattr(kept_designs, "read", lambda file: pytest.fail("a file is read"))
    run()


def test_a_published_page_keeps_nothing(run, monkeypatch):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    before = files()[0].read_bytes()
    monkeypatch.setenv("VOILA_BASE_URL", "/")
    app = run()
    assert offered(app) == ""
    leave(app, 51 * mm)
    say(app, keep=["mine", app.values])
    assert files()[0].read_bytes() == before
    assert [name for name, _ in app.sent[-1]["named"]] == ["mine"]  # as long as the page is open


def test_each_cell_each_notebook_and_each_panel_has_its_own(run, monkeypatch):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    assert offered(run(cell="another")) == ""
    place = running.Place("cell", uuid4().hex)
    monkeypatch.setattr("camkit.panels.kit.keeper.here", lambda: place)
    pair = [explore(first.start, mechanism, measures=[]) for _ in range(2)]
    assert pair[0].keeper.file == first.keeper.file != pair[1].keeper.file
    monkeypatch.setenv("JPY_SESSION_NAME", "/somewhere/other.ipynb")
    assert offered(run()) == ""


def test_a_design_has_a_name_until_it_is_removed(run):
    app = run()
    offered(app)
    leave(app, 48 * mm)
    say(app, keep=["flat", app.values])
    leave(app, 51 * mm)
    again = run()
    offered(again)
    ((name, values),) = again.sent[-1]["named"]
    assert (name, values) == ("flat", pytest.approx([*numbers_of(app.design.replace(base_radius=48 * mm)).values()]))
    say(again, show="flat")
    assert again.design.base_radius == 48 * mm
    say(again, rename=["flat", "low"])
    assert json.loads(files()[0].read_text())["named"].keys() == {"low"} == again.keeper.named.keys()
    say(again, forget="low")
    assert json.loads(files()[0].read_text())["named"] == {}
    wrongs = ({"show": "flat"}, {"keep": ["", again.values]}, {"keep": 5}, {"keep": ["a", [0.1]]}, {"forget": []})
    for wrong in (*wrongs, {"rename": ["flat", "low"]}, {"else": 1}):
        say(again, **wrong)
        assert again.message.endswith(".")
        again.message = ""


def test_a_name_keeps_what_the_page_shows_and_what_can_be_built(run):
    app = run()
    offered(app)
    wide, cannot = (dict(numbers_of(app.design), base_radius=radius) for radius in (52 * mm, -1.0))
    say(app, keep=["wide", list(wide.values())])  # the page's last move is still on its way
    assert app.keeper.named["wide"].base_radius == 52 * mm != app.design.base_radius
    say(app, keep=["other", app.values])
    say(app, keep=["never", list(cannot.values())])
    say(app, rename=["wide", "other"])
    assert app.message == "Another design is called 'other' already."
    assert app.keeper.named.keys() == {"wide", "other"}
    page = app.html()
    assert '"named":[["wide",' in page
    path, choice = next(iter(choices_of(app.design).items()))
    app._handle_custom_msg({"choose": [path, next(name for name in choice.named if name != choice.default)]}, [])
    offered(app)
    assert app.sent[-1]["named"] == [("wide", None), ("other", None)]  # another make
    assert '"named":[]' in app.html()


def test_names_of_two_kernels_are_both_kept(run):
    panels = [run() for _ in range(2)]
    for app, name in zip(panels, ("one", "other"), strict=True):
        offered(app)
        say(app, keep=[name, app.values])
    assert json.loads(files()[0].read_text())["named"].keys() == {"one", "other"}


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"[" * 100_000, b"\xff\xfe", b'{"last": 5, "named": {}}', b'{"last": [], "named": {}, "__proto__": 1}',
     b'{"last": [{"panel": 1, "design": "", "page": {}}], "named": {}}', b'{"last": [], "named": {"a": 5}}',
     b" " * (kept_designs.LONGEST + 1)],
    ids=range(9),
)  # fmt: skip
def test_a_damaged_file_is_said_and_left_as_it_is(run, content):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    files()[0].write_bytes(content)
    app = run()
    assert offered(app) == ""
    assert app.message == f"Your last design is not kept: the file {files()[0].name} beside the notebook is damaged; " \
        "delete it to keep designs again."  # fmt: skip
    leave(app, 51 * mm)
    assert app.design.base_radius == 51 * mm
    assert files()[0].read_bytes() == content


@pytest.mark.parametrize("text", ["{}", '{"schema": "camkit/1", "design": {"kind": "DoorHandleCam"}}', "<script>"])
def test_a_design_that_cannot_be_used_is_not_offered(run, text):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    kept = kept_designs.read(files()[0].name)
    files()[0].write_text(replace(kept, last=(Last("another", text),)).text())
    app = run()
    assert offered(app) == ""
    assert app.message.startswith("A design that was kept here cannot be used: ")


def test_nothing_is_read_or_written_through_a_link(run, tmp_path):
    first = run()
    offered(first)
    leave(first, 48 * mm)
    secret = tmp_path / "secret"
    secret.write_text("mine")
    place = files()[0]
    place.unlink()
    place.symlink_to(secret)
    app = run()
    assert offered(app) == ""
    assert app.message.startswith("Your last design is not kept: ")
    leave(app, 51 * mm)
    assert secret.read_text() == "mine"
    assert place.is_symlink()


def test_a_full_disk_is_said_once_and_what_was_kept_stays(run, monkeypatch):
    app = run()
    offered(app)
    leave(app, 48 * mm)
    before = files()[0].read_bytes()

    def full(path, content):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(kept_designs, "write_whole", full)
    leave(app, 51 * mm)
    assert app.message == "Your last design is not kept: no space left on device."
    leave(app, 52 * mm)
    assert app.message == ""
    assert app.design.base_radius == 52 * mm
    assert files()[0].read_bytes() == before
    assert not list(FOLDER.glob("*.part"))


def test_many_who_write_at_once_leave_a_whole_file(beside):
    file = kept_designs.file_of("Cam", "cell")
    add = """
import sys
from dataclasses import replace
from pathlib import Path
from camkit.panels.kit.kept_designs import update
for k in range(5):
    update(Path(sys.argv[1]), lambda kept: replace(kept, named={**kept.named, f"{sys.argv[2]} {k}": ""}))
"""
    root = Path(__file__).parents[2]
    with ThreadPoolExecutor(3) as pool:
        ends = pool.map(
            lambda name: subprocess.run([sys.executable, "-c", add, str(file), name], cwd=beside,
                                        env=os.environ | {"PYTHONPATH": str(root)}).returncode, "abc")  # fmt: skip
        assert [*ends] == [0, 0, 0]
    assert len(kept_designs.read(file).named) == 15


def test_there_is_room_for_so_many_names(run):
    app = run()
    offered(app)
    for k in range(kept_designs.MOST_NAMED):
        app.keeper.named[f"design {k}"] = app.design
    say(app, keep=["one more", app.values])
    assert app.message == "50 designs have a name, and no more can be kept; remove one first."
    many = {str(k): "" for k in range(kept_designs.MOST_NAMED + 1)}
    with pytest.raises(ValueError, match="would be too large"):
        kept_designs.update(kept_designs.file_of("Cam"), lambda kept: KeptDesigns(named=many))


def test_instruments_of_one_page_share_a_design():
    """A link goes both ways; what one of them refuses, both do without."""
    one, other = (
        explore(TranslatingRollerCam(groove=False), mechanism, measures=[measure])
        for measure in (max_pressure_angle, min_profile_radius)
    )
    link = traitlets.link((one, "design"), (other, "design"))
    leave(one, 48 * mm)
    assert other.design is one.design
    assert other.values == one.values
    leave(other, 51 * mm)
    assert one.design is other.design
    assert one.rows()[0][1] == max_pressure_angle.one(other.design.analyse())
    one.design = one.design.replace(base_radius=52 * mm)
    assert other.values == one.values
    leave(one, -1.0)
    assert other.design.base_radius == 52 * mm
    link.unlink()
    leave(one, 54 * mm)
    assert other.design.base_radius == 52 * mm
    with pytest.raises(ValueError, match="the design is"):
        traitlets.link((one, "design"), (explore(DoorHandleCam()), "design"))


def test_what_a_linked_instrument_cannot_show_is_said():
    """One of them has a measure that is not defined everywhere; the other goes on, and says so."""

    def known(analysis):
        if analysis.cam.base_radius > 50 * mm:
            raise ValueError("the table of known cams ends at 50 mm")
        return analysis.cam.base_radius

    cam = TranslatingRollerCam(groove=False, base_radius=40 * mm)
    one = explore(cam, mechanism, measures=[max_pressure_angle])
    other = explore(cam, mechanism, measures=[Measure("known", "mm", known)])
    traitlets.link((one, "design"), (other, "design"))
    leave(one, 60 * mm)
    assert one.design.base_radius == 60 * mm
    assert other.design.base_radius == 40 * mm
    assert one.message.startswith("What follows this panel cannot be shown everywhere: ")
    assert "the table of known cams ends at 50 mm" in one.message
    leave(one, 45 * mm)
    assert other.design is one.design
    assert one.message == ""
