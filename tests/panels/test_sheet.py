"""Sheets: what the page is told, and what comes of what a person does there."""

import json
import threading

import numpy as np
import pytest

from camkit.panels.kit.drawn import LivePicture, nearest
from camkit.panels.kit.inputs import Amount, Check, Download, Menu, Number, Scale, Span, Typed, Upload, Whole
from camkit.panels.kit.parts import Banner, Button, Group, Progress, Table, Words, bold, row
from camkit.panels.kit.sheet import Panel, picture_of
from camkit.quantities import Quantity
from camkit.views.picture import Axes, Line, Picture


class OneOfEach(Panel):
    """A sheet with every kind of part."""

    def __init__(self):
        self.said = []
        self.banner, self.numbers = Banner(), Table()
        self.arm = Number("arm", Quantity("l", 40, 10, 90, "mm", "an arm", above=0), 0.04, self.moved, self.said.append)
        self.menu = Menu([("first", 1), ("second", 2)], "problem")
        self.scale = Scale([("1/3", 1 / 3), ("1", 1.0), ("3", 3.0)], "a against b", value=1.0)
        self.whole = Whole(3, 1, 9, "starts")
        self.check, self.amount, self.typed = Check(), Amount(unit="mm"), Typed()
        self.span = Span(min=0.0, max=4.0, value=(1.0, 2.0))
        self.button = Button("Divide", lambda: 1 / 0)
        self.save = Download("Save", "x.txt", "text/plain", lambda: "all", self.banner.show_message)
        self.load = Upload("Load", self.said.append)
        self.picture = LivePicture((wave,), "a wave")
        self.picture.on_click(lambda view, at, pixel: self.said.append((view, *at)))
        inputs = row(self.arm, self.menu, self.scale, self.whole, self.check, self.amount, self.typed, self.span)
        words = Words(value=["plain", [bold("bold"), " after"]])
        files = Group(self.button, self.save, self.load, Progress(value=1, max=4))
        super().__init__(inputs, words, files, self.banner, self.numbers, self.picture, heading="One of each")

    def moved(self):
        self.picture.show(self.arm.value)

    def summary(self):
        return "one of each"


def wave(size):
    x = np.linspace(0, 1, 5)
    return Picture.of(Axes(title="a wave"), Line("wave", x, size * np.sin(x)))


@pytest.fixture
def sheet():
    made = OneOfEach()
    made.picture.show(1.0)
    return made


def do(sheet, part, **done):
    """As the page says it; the state of the part that it is answered with."""
    count = sheet.body["heard"] + 1
    buffers = done.pop("buffers", [])
    sheet._handle_custom_msg({"part": part.number, "count": count, **done}, buffers)
    assert sheet.body["heard"] == count
    return told(sheet, part)


def test_views_that_ask_at_once_are_all_answered(sheet):
    for count in (4, 3):
        sheet._handle_custom_msg({"part": sheet.check.number, "count": count, "value": count == 4}, [])
    assert sheet.body["heard"] == 4
    assert told(sheet, sheet.check)["value"] is False


def told(sheet, part):
    def find(state):
        if state["id"] == part.number:
            return state
        return next(filter(None, map(find, state.get("children", ()))), None)

    return find(sheet.body)


def test_all_that_a_sheet_tells_is_plain_json_and_its_pictures_are_bytes(sheet):
    json.dumps([sheet.body, sheet.setting])
    (shown,) = getattr(sheet, picture_of(sheet.picture))
    y = np.frombuffer(shown["arrays"][shown["picture"]["marks"][0]["y"]["at"]])
    np.testing.assert_array_equal(y, np.sin(np.linspace(0, 1, 5)))


@pytest.mark.parametrize(
    ("name", "given", "value"),
    [
        ("arm", 0.05, 0.05),
        ("menu", 1, 2),
        ("scale", 0, 1 / 3),
        ("whole", 7, 7),
        ("check", True, True),
        ("amount", 2.5, 2.5),
        ("typed", "1/5", "1/5"),
        ("span", [3.0, 0.5], (0.5, 3.0)),
    ],
)
def test_what_a_person_says_is_the_value_and_is_heard_once(sheet, name, given, value):
    part, heard = getattr(sheet, name), []
    part.observe(lambda change: heard.append(change.new), "value")
    do(sheet, part, value=given)
    assert part.value == value
    assert heard == [value]


def test_a_number_that_is_far_too_large_is_refused_and_the_last_one_stays(sheet):
    do(sheet, sheet.arm, value=-5.0)
    assert sheet.arm.value == 0.04
    assert sheet.said == ["The arm stays as before: -5000 mm was typed; it must be a finite number above 0 mm."]
    for nothing in (float("nan"), float("inf")):
        do(sheet, sheet.arm, value=nothing)
        assert sheet.arm.value == 0.04


@pytest.mark.parametrize(
    "done", [{}, {"value": None}, {"value": "x"}, {"value": 17}, {"value": [1]}, {"does": "click", "at": "here"}]
)
def test_nonsense_from_a_page_is_answered_and_leaves_the_sheet_alive(sheet, done):
    for part in sheet.top.inside():
        do(sheet, part, **done)
    do(sheet, sheet.whole, value=5)
    assert sheet.whole.value == 5
    do(sheet, sheet.whole, value=99)
    assert (sheet.whole.value, sheet.banner.text) == (5, "The starts is 99; it must be a whole number from 1 to 9.")
    sheet._handle_custom_msg({"part": 10**9, "count": 77}, [])
    assert sheet.body["heard"] == 77


def test_an_error_is_said_in_the_banner(sheet):
    do(sheet, sheet.button)
    assert sheet.banner.text == "Division by zero."
    assert told(sheet, sheet.banner)["visible"]


def test_what_changes_together_is_told_once(sheet):
    bodies = []
    sheet.observe(lambda change: bodies.append(change.new), "body")
    with sheet.held():
        sheet.whole.value, sheet.typed.value = 4, "x"
        sheet.numbers.put(("a",), [(1,), (bold(2),), ([bold(3), " mm"],)])
    assert len(bodies) == 1
    assert told(sheet, sheet.numbers)["rows"] == [["1"], [bold(2)], [[bold(3), " mm"]]]
    assert sheet.numbers.text == "a\n1\n2\n3 mm"


def test_threads_do_not_wait_for_each_other_and_are_told_together(sheet):
    entered, go_on = threading.Event(), threading.Event()

    def work():
        with sheet.held():
            sheet.typed.value = "from a thread"
            entered.set()
            go_on.wait(10)

    thread = threading.Thread(target=work)
    thread.start()
    assert entered.wait(10)
    late = threading.Timer(5, go_on.set)  # for one who waits
    late.start()
    before = sheet.body
    sheet.whole.value = 4
    assert not go_on.is_set()
    assert sheet.body == before
    late.cancel()
    go_on.set()
    thread.join(10)
    assert (told(sheet, sheet.whole)["value"], told(sheet, sheet.typed)["value"]) == (4, "from a thread")


def test_files_go_out_and_come_in(sheet, monkeypatch):
    sent = []
    monkeypatch.setattr(sheet.save, "send", sent.append)
    sheet.save.click()
    assert sent == [{"name": "x.txt", "mime": "text/plain", "text": "all"}]
    do(sheet, sheet.load, buffers=[memoryview(b"content")])
    assert sheet.said == [b"content"]


def test_a_click_has_its_place_in_user_units(sheet):
    do(sheet, sheet.picture, does="click", view=0, at=[0.25, -1.0], pixel=[0.01, 0.02])
    assert sheet.said == [(0, 0.25, -1.0)]


def test_a_picture_that_cannot_be_drawn_leaves_the_last_one(sheet):
    before = getattr(sheet, picture_of(sheet.picture))
    with pytest.raises(OverflowError, match="farther than can be drawn"):
        sheet.picture.show(1e40)
    assert getattr(sheet, picture_of(sheet.picture)) is before
    assert sheet.picture.shown[0]["wave"].y[-1] == pytest.approx(np.sin(1))


def test_a_picture_that_stays_is_not_sent_again(sheet, monkeypatch):
    other = LivePicture(sheet.picture.views, "another")
    other.show(1.0)
    sheet.top.children = (*sheet.top.children, other)
    sent = []
    monkeypatch.setattr(sheet, "send_state", lambda key=None: sent.extend([key] if isinstance(key, str) else key))
    other.show(2.0)
    assert set(sent) == {picture_of(other), "body"}
    sent.clear()
    with sheet.held():
        sheet.picture.show(2.0)
        other.show(3.0)
    assert set(sent) == {picture_of(sheet.picture), picture_of(other), "body"}
    assert getattr(sheet, picture_of(other)) is other.data


def test_nothing_is_nearest_to_a_place_far_from_all():
    points = np.array([[0.0, 0.0], [1.0, 1.0]])
    assert nearest(points, np.array([0.9, 0.9]), np.array([0.01, 0.01]), within=30) == 1
    assert nearest(points, np.array([0.5, 0.5]), np.array([0.01, 0.01]), within=30) is None
    assert nearest(np.empty((0, 2)), np.zeros(2), np.ones(2)) is None


def test_a_sheet_is_one_widget_and_carries_a_picture_and_numbers_without_a_kernel(sheet):
    data, _ = sheet._repr_mimebundle_()
    assert data["text/plain"] == "one of each"
    assert data["image/png"]
    assert not [
        name
        for name in sheet.keys
        if "model" in name.lower() and name not in ("_model_module", "_model_name", "_model_module_version")
    ]
