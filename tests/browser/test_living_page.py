"""A design as one file: what the page computes and draws is what the package computes, and names stay names."""

import gzip
import itertools
import re
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from every_machine import MACHINES

from camkit import deg, door_handle_study, mm
from camkit.program import CannotRecord
from camkit.quantities import Design, Measure, measures_of, quantities_of, quantity, value_of, with_quantities
from camkit.render import to_html
from camkit.render.living import living
from camkit.render.page_parts import script
from camkit.render.positions import given_to, positions_of
from camkit.views import default_views, mechanism, pressure_angle
from camkit.views.picture import Axes, Contour, Line, Picture, Points, Text
from lab import numbers_in, numbers_of, shown_by

MOST_BYTES = 500_000
DRAWN = "() => globalThis.camkit?.outputs && !camkit.frame"
DRAG = """([share, k]) => { const slider = document.querySelectorAll(".camkit-left input[type=range]")[k];
    slider.value = Number(slider.min) + share * (slider.max - slider.min);
    for (const kind of ["input", "change"]) slider.dispatchEvent(new Event(kind)); }"""


@cache
def page_of(design):
    """The page of a design, which many tests open, and which of its pictures stand still."""
    page = living(design)
    return page.html(), {picture["name"] for picture in page.structure["pictures"] if picture["still"]}


def html_of(design):
    return page_of(design)[0]


@pytest.fixture
def opened(reader, tmp_path):
    """Opens the page of a design; gives it with its own errors and what it asks for from outside."""
    heard = []
    hear = {
        "pageerror": lambda error: heard.append(str(error)),
        "request": lambda r: heard.append(r.url) if not r.url.startswith(("file:", "blob:")) else None,
    }
    for kind, act in hear.items():
        reader.on(kind, act)

    def open_page(design, *views, **options):
        path = tmp_path / "design.html"
        if views or options:
            to_html(design, *views, path=path, **options)
        else:
            path.write_text(html_of(design), encoding="utf-8")
        reader.set_viewport_size({"width": 934, "height": 612})
        reader.goto(path.as_uri())
        reader.heard = heard
        reader.wait_for_function(DRAWN)
        return reader

    yield open_page
    for kind, act in hear.items():
        reader.remove_listener(kind, act)


def same(found, expected, name):
    """Whether arrays are equal, gaps included, to a share of the largest number."""
    found = np.array([float(x.replace("Infinity", "inf")) for x in found])
    expected = np.ravel(np.asarray(expected, dtype=float))
    if len(found) != len(expected):  # one value for all places
        found, expected = np.broadcast_arrays(found, expected)
    size = abs(expected[np.isfinite(expected)]).max(initial=0.0)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * size, err_msg=name)


def compare(shown, design, views, measures, limits=None):
    """What a page shows against what the package draws and measures for its values."""
    paths = list(quantities_of(design))
    now = with_quantities(design, dict(zip(paths, shown["values"], strict=False)))
    analysis, given = now.analyse(), shown["values"][len(paths) :]
    names = list(dict.fromkeys(name for view in views for name in positions_of(view)))
    position = dict(zip(names, given, strict=True))
    for view, drawn in zip(views, shown["pictures"], strict=True):
        picture = view(analysis, **given_to(view, {"limits": limits, **position}))
        marks = {mark["key"]: mark for mark in drawn["marks"]}
        assert drawn["name"] == view.__name__
        for mark in picture.marks:
            found = marks.pop(mark.key)
            for part in ("x", "y", "low", "high", "radius"):
                if part in found:
                    same(found[part], getattr(mark, part), f"{view.__name__} {mark.key} {part}")
            if isinstance(mark, Text) and found["words"]:
                assert found["words"] == mark.words
        assert not marks
    assert numbers_of(shown) == numbers_in(now, measures)


PLACES = """() => camkit.structure.measures.map((m) => [m.name, camkit.places.of(m)?.chart.picture.name])
    .filter(([, picture]) => picture)"""
CURVES = {
    "skid": ["skid"],
    "pressure angle": ["pressure_angle", "pressure_angles"],
    "radius": ["curvature", "radius_of_curvature"],
    "contact pressure": ["contact_pressure", "hertz_pressure", "stress_over_event"],
    "Hertz pressure": ["hertz_pressure"],
    "contact force": ["contact_force"],
    "camshaft torque": ["camshaft_torque"],
    "torque": ["cam_torque", "torques"],
    "force": ["forces"],
    "stress": ["contact_stress", "stress_over_way", "stress_over_event"],
    "wear": ["wear", "wear_over_way"],
    "acceleration": ["acceleration"],
    "": [],
}
"""By words in its name: the curves that a measure is of."""


@pytest.mark.parametrize("name", MACHINES)
def test_a_page_shows_what_the_package_computes(name, opened):
    design = MACHINES[name]
    still = page_of(design)[1]
    assert still <= {"plane_of_sizes", "section"}  # a search stands behind them
    views = [view for view in default_views(design.analyse()) if view.__name__ not in still]
    page = opened(design, *(views if still else ()))
    compare(shown_by(page), design, views, measures_of(design))
    for measure, picture in page.evaluate(PLACES):
        assert picture in next(made_of for words, made_of in CURVES.items() if words in measure), measure
    seen = 0
    for k in range(4):
        page.evaluate(DRAG, [0.35 + 0.1 * k, k])
        page.wait_for_function(DRAWN)
        shown = shown_by(page)
        if not shown["sentence"]:
            compare(shown, design, views, measures_of(design))
            seen += 1
    assert seen
    if "elevation" in page.evaluate("camkit.structure.positions.map((position) => position.name)"):
        page.evaluate("for (let k = 0; k < 40; k++) camkit.positions.orbit(0, 0.1)")
        assert page.evaluate("camkit.rows.at(-1).value") == pytest.approx(np.pi / 2)
    assert not page.heard


def test_a_page_is_small_and_asks_for_nothing():
    for design in MACHINES.values():
        page = html_of(design)
        assert len(page.encode()) < MOST_BYTES
        assert "http" not in page.replace("http-equiv", "")


def test_a_page_refuses_in_the_words_of_the_package(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    before = shown_by(page)
    box = page.get_by_label("lift arm, mm, number")
    box.fill("400")
    box.press("Enter")
    page.wait_for_function("() => camkit.sentence && !camkit.frame")
    shown = shown_by(page)
    with pytest.raises(ValueError) as refused:  # noqa: PT011
        design.replace(lift_arm=400 * mm)
    assert shown["sentence"] == str(refused.value)
    assert str(refused.value) in page.locator(".camkit-over").inner_text()
    assert shown["pictures"] == before["pictures"]  # the last good one
    page.keyboard.press("Control+z")
    page.wait_for_function("() => !camkit.sentence && !camkit.frame")
    assert shown_by(page) == before


GUILTY = """() => [...document.querySelectorAll(".camkit-guilty")].map((row) =>
    row.querySelector("label, span").textContent.trim())"""


def test_what_a_design_cannot_be_built_with_is_marked(opened):
    page = opened(MACHINES["door handle"])
    for name, value in (("lift start angle", "24"), ("lift arm", "400")):
        box = page.get_by_label(f"{name}, {'deg' if 'angle' in name else 'mm'}, number")
        box.fill(value)
        box.press("Enter")
        page.wait_for_function(DRAWN)
    assert [row.partition(" l")[0] for row in page.evaluate(GUILTY)] == ["lift arm"]
    assert page.locator(".camkit-over").is_visible()
    assert page.get_by_label("lift arm, mm", exact=True).get_attribute("aria-invalid") == "true"
    box = page.get_by_label("lift start angle, deg, number")
    box.fill("25")  # which is none the worse: the arm stays the guilty one
    box.press("Enter")
    page.wait_for_function(DRAWN)
    assert [row.partition(" l")[0] for row in page.evaluate(GUILTY)] == ["lift arm"]
    page.evaluate("camkit.positions.turnTo(30)")
    page.wait_for_function(DRAWN)
    assert [row.partition(" l")[0] for row in page.evaluate(GUILTY)] == ["lift arm"]
    for _ in range(2):
        page.keyboard.press("Control+z")
    page.wait_for_function("() => !camkit.sentence && !camkit.frame")
    assert page.evaluate(GUILTY) == []
    page.keyboard.press("Control+y")  # nobody has touched a slider
    page.wait_for_function("() => camkit.sentence && !camkit.frame")
    assert [row.partition(" l")[0] for row in page.evaluate(GUILTY)] == ["lift arm"]


def test_a_menu_whose_choice_is_refused_is_marked_until_nothing_is_said(opened):
    page = opened(MACHINES["roller"])
    page.evaluate("""() => {
        const host = { changed() {}, choose() { other.say("This law cannot stand here."); }, reset() {} };
        window.other = new camkit.constructor(document.body.appendChild(document.createElement("div")),
            { ...camkit.structure, files: [] }, camkit.engine, host);
        document.querySelectorAll("details").forEach((group) => { group.open = true; }); }""")
    menu = page.get_by_role("combobox", name="motion rise law")
    before = menu.input_value()
    menu.select_option("modified sine")
    assert page.evaluate(GUILTY) == ["motion rise law"]
    assert menu.input_value() == before
    page.evaluate("other.say('')")
    assert page.evaluate(GUILTY) == []


TWO = """() => {
    const told = [], host = { changed: (values) => told.push(values[0]), name() {} };
    const other = new camkit.constructor(document.body.appendChild(document.createElement("div")),
        { ...camkit.structure, files: [] }, camkit.engine, host);
    Object.assign(window, { told, other });
    const first = other.values[0], once = { once: true };
    const shown = () => new Promise((next) => other.root.addEventListener("camkit-shown", next, once));
    return (async () => {
        await shown();
        for (const factor of [1.001, 1.002]) { other._moved(0, factor * first, false); await shown(); }
        other.frame = 1; // the next picture is late
        other.load([1.003 * first, ...other.values.slice(1, other.history.count)]);
        await new Promise((next) => setTimeout(next, 400));
        return told.map((value) => value / first);
    })(); }"""


def test_what_somebody_else_chooses_is_not_undone_by_a_drag_of_before(opened):
    assert opened(MACHINES["door handle"]).evaluate(TWO) == pytest.approx([1.001])


def test_what_is_pinned_is_the_design_that_is_drawn(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    box = page.get_by_label("lift arm, mm, number")
    box.fill("400")
    box.press("Enter")
    page.wait_for_function("() => camkit.sentence && !camkit.frame")
    page.get_by_role("button", name="Pin to compare").click()
    assert page.evaluate("camkit.ghost.values[0]") == design.lift_arm


def test_only_a_kernel_shows_named_designs_of_another_make(opened):
    page = opened(MACHINES["door handle"])
    page.evaluate("() => { const here = [...camkit.inputs]; camkit.names.hear([['here', here], ['there', null]]); }")
    asks = "camkit.names.list.querySelectorAll('[data-asks]')"
    assert page.evaluate(f"[...{asks}].map((button) => button.textContent)") == ["there"]


def test_words_in_small_pictures_do_not_cross(opened):
    page = opened(MACHINES["high speed"])
    several = [spots for spots in page.evaluate("camkit.charts.map((chart) => chart.spots ?? [])") if len(spots) > 1]
    assert several
    for spots in several:
        for (left, right, up), (other, end, at) in itertools.combinations(spots, 2):
            assert right <= other or end <= left or abs(up - at) >= 10


FRAME = "() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)))"


def test_what_others_choose_and_what_is_typed(opened):
    page = opened(MACHINES["door handle"])
    steps = """() => { const design = [...camkit.values.slice(0, camkit.history.count)];
        for (let k = 1; k <= 60; k++) { design[0] *= 1.0001; camkit.load(design); }
        camkit.preview(design.slice(2));
        return [camkit.history.past.length, Boolean(camkit.looked), design[0]]; }"""
    past, looked, arm = page.evaluate(steps)  # somebody's slider; a design of another law
    assert (past, looked) == (1, False)
    box = page.get_by_label("lift arm, mm, number")
    box.fill("47")
    page.keyboard.press("Control+z")
    assert page.evaluate("camkit.values[0]") == arm  # what is typed is the box's
    page.keyboard.press("Escape")
    chip = page.locator(".camkit-chips [role=button]").first
    chip.focus()
    before = page.locator(".camkit-why h2").inner_text()
    page.keyboard.press("Control+z")
    page.wait_for_function("(before) => document.querySelector('.camkit-why h2').textContent !== before", arg=before)
    assert page.evaluate("camkit.values[0]") == MACHINES["door handle"].lift_arm
    page.evaluate("camkit.structure.first = { [camkit.structure.measures[0].name]: 0 }")
    page.get_by_role("tab", name="Numbers").click()
    page.evaluate(FRAME)
    start = page.locator(".camkit-numbers td:nth-child(3)")
    assert start.first.inner_text().startswith("0")  # where the kernel began
    late = "camkit.charts[1].how.older"
    page.get_by_role("tab", name="Curves").click()
    page.evaluate("camkit.redraw({ 1: { ...camkit.charts[1].picture, still: 'no' } }, camkit.outputs, camkit.inputs)")
    page.evaluate(FRAME)
    assert page.evaluate(late) is False
    box.fill("400")
    box.press("Enter")
    page.wait_for_function("() => camkit.sentence && !camkit.frame")
    assert page.evaluate(late) is True
    assert page.evaluate("camkit.root.className").endswith("camkit-refused")
    page.evaluate("camkit.end()")
    assert "camkit-refused" not in page.evaluate("camkit.root.className")
    assert not page.heard


def test_a_text_that_is_no_number_is_refused_in_place(opened):
    page = opened(MACHINES["door handle"])
    box = page.get_by_label("lift arm, mm, number")
    for text in ("abc", "1 kg", ""):
        box.fill(text)
        box.press("Enter")
        assert page.locator(".camkit-refusal:not(:empty)").count() == 1
        assert page.evaluate("camkit.values[0]") == 0.05
    box.fill("1 7/8 in")
    box.press("Enter")
    assert page.evaluate("camkit.values[0]") == pytest.approx(1.875 * 0.0254, rel=1e-12)
    assert page.locator(".camkit-refusal:not(:empty)").count() == 0


def test_it_turns_and_one_line_runs_through_the_curves(opened):
    page = opened(MACHINES["door handle"])
    turn = len(quantities_of(MACHINES["door handle"]))
    page.get_by_role("button", name="Play").click()
    page.wait_for_function(f"() => camkit.values[{turn}] > 0.3")
    page.get_by_role("button", name="Pause").click()
    page.wait_for_function("() => !camkit.playing && !camkit.frame")
    shown = shown_by(page)
    compare(
        shown,
        MACHINES["door handle"],
        default_views(MACHINES["door handle"].analyse()),
        measures_of(MACHINES["door handle"]),
    )
    cursor = page.evaluate("camkit.charts[2].how.cursor")
    assert cursor == pytest.approx(np.rad2deg(shown["values"][turn]))


UNNAMED = """() => [...document.querySelectorAll("button, canvas, input, select, [tabindex]")]
    .filter((e) => !e.getAttribute("aria-label") && !e.textContent.trim()).map((e) => e.outerHTML)"""


def test_keys_and_a_screen_reader_find_everything(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    assert page.evaluate(UNNAMED) == []
    assert "pitch curve" in page.locator(".camkit-middle canvas").get_attribute("aria-label")
    page.locator(".camkit-curve canvas").nth(1).focus()
    for _ in range(2):
        page.keyboard.press("Shift+ArrowRight")
    page.wait_for_function("() => camkit.charts[2].how.cursor > 19.9 && !camkit.frame")
    curve = page.get_by_role("slider", name="Pressure angle")
    assert curve.get_attribute("aria-valuenow") == "20"
    lift, relief = (np.interp(20, m.x, m.y) for m in pressure_angle(design.analyse()).marks)
    assert curve.get_attribute("aria-valuetext").startswith(
        f"at 20; Pressure angle  [°]; lift {lift:.4g}; relief {relief:.4g};"
    )
    page.locator(".camkit-middle canvas").focus()
    wide = "(camkit.charts[0].ends.x.high - camkit.charts[0].ends.x.low)"
    before = page.evaluate(wide)
    page.keyboard.press("+")
    page.wait_for_function(DRAWN)
    assert page.evaluate(wide) == pytest.approx(0.8 * before)


def test_the_scale_only_makes_room_while_it_turns_and_the_pinned_design_turns_too(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    page.get_by_role("button", name="Pin to compare").click()
    box = page.get_by_label("lift arm, mm, number")
    box.fill("48")
    box.press("Enter")
    ends = page.evaluate("""async () => {
        const ends = [], k = camkit.structure.quantities.length;
        for (let angle = 0; angle <= 3; angle += 0.1) {
            camkit.rows[k]._take(angle, false);
            await new Promise((resolve) => camkit.root.addEventListener("camkit-shown", resolve, { once: true }));
            const { x, y } = camkit.charts[0].window;
            ends.push([-x.low, x.high, -y.low, y.high]);
        }
        return ends; }""")
    assert (np.diff(ends, axis=0) >= 0).all()
    pinned = page.evaluate("Array.from(camkit.ghost.values)")
    assert pinned[0] == design.lift_arm
    assert pinned[-1] == pytest.approx(2.9)


TURNED = """async () => {
    const k = camkit.structure.quantities.length, chart = camkit.charts[2];
    const move = async (row, value) => {
        camkit.rows[row]._take(value, false);
        await new Promise((resolve) => camkit.root.addEventListener("camkit-shown", resolve, { once: true }));
        return { list: chart.list, words: chart.heading.names.map((name) => name.words) };
    };
    await move(k, 0.4);
    const second = await move(k, 0.5), third = await move(k, 0.6);
    const copied = chart.canvas.toDataURL();
    chart.from = null;
    chart.draw(camkit.outputs, chart.how);
    const anew = chart.canvas.toDataURL(), other = await move(0, 0.048);
    return [second.list === third.list, copied === anew, third.list === other.list, third.words];
}"""


def test_curves_are_drawn_once_while_only_the_mechanism_turns(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    once, copied, other, words = page.evaluate(TURNED)
    assert once  # they are copied from where they were drawn beside the canvas ...
    assert copied  # ... and look as if they were drawn anew
    assert not other  # the shape has changed
    lift, relief = (np.interp(np.rad2deg(0.6), m.x, m.y) for m in pressure_angle(design.analyse()).marks)
    assert words == [f"lift {lift:.4g}", f"relief {relief:.4g}"]


def test_trouble_is_named_where_it_is_and_symbols_have_lowered_indices(opened):
    design = MACHINES["door handle"]
    page = opened(design)
    (trouble,) = page.evaluate("camkit.shown().pictures[0].troubles")
    cuts = [mark for mark in mechanism(design.analyse()).marks if mark.role == "trouble"]
    places = np.concatenate([np.transpose([cut.x, cut.y]) for cut in cuts])
    assert trouble["words"] == "undercut"
    assert np.nanmin(np.hypot(*(places - [trouble["x"], trouble["y"]]).T)) < 1e-9
    assert page.evaluate("[...document.querySelectorAll('.camkit-row sub')].some((e) => e.textContent === 'T')")


def test_a_tab_chooses_what_stands_at_the_right_and_others_can_be_added(opened):
    page = opened(MACHINES["door handle"])
    page.evaluate("""() => { const mine = document.createElement("p");
        mine.textContent = "a page of my own";
        window.told = 0;
        camkit.addTab("Mine", mine, () => { window.told += 1; }, true); }""")
    curves, numbers = page.locator(".camkit-curves"), page.locator(".camkit-numbers")
    width = page.locator(".camkit-right-side").bounding_box()["width"]
    assert (curves.is_visible(), numbers.is_visible(), page.evaluate("told")) == (True, False, 0)
    page.get_by_role("tab", name="Curves").focus()
    page.keyboard.press("ArrowLeft")  # round to the last one
    assert page.get_by_role("tabpanel", name="Mine").is_visible()
    assert (curves.is_visible(), page.evaluate("told")) == (False, 1)
    assert page.locator(".camkit-right-side").bounding_box()["width"] > width + 50
    page.evaluate("camkit.showTab('Numbers')")
    page.wait_for_function("() => !camkit.frame")
    assert page.locator(".camkit-numbers tr").count() > 3
    assert page.get_by_role("tab", selected=True).inner_text() == "Numbers"


def test_on_a_narrow_screen_everything_stands_below_the_mechanism_that_stays(opened):
    page = opened(MACHINES["door handle"])
    page.set_viewport_size({"width": 420, "height": 800})
    page.wait_for_selector(".camkit-narrow")
    page.get_by_label("handle angle, deg", exact=True).scroll_into_view_if_needed()
    page.evaluate("scrollBy(0, 200)")
    trouble, chip, middle = (
        page.locator(part).bounding_box()
        for part in (".camkit-trouble", ".camkit-chip.camkit-free >> nth=0", ".camkit-middle")
    )
    assert 0 <= trouble["y"] < trouble["y"] + trouble["height"] <= chip["y"] < chip["y"] + chip["height"] <= middle["y"]
    assert middle["y"] < 150
    assert middle["y"] + middle["height"] < 0.65 * 800  # there is room for sliders below
    assert page.locator(".camkit-left").bounding_box()["y"] < 0
    assert page.evaluate("document.documentElement.scrollWidth") == 420
    assert page.evaluate("getComputedStyle(document.querySelector('.camkit-curve canvas')).touchAction") == "pan-y"


def test_a_touch_that_the_page_takes_for_scrolling_lets_go(opened):
    page = opened(MACHINES["door handle"])
    page.evaluate("""() => {
        const { canvas } = camkit.charts[0];
        canvas.setPointerCapture = () => {};
        for (const [kind, clientX] of [["down", 400], ["cancel", 400], ["move", 480]])
            canvas.dispatchEvent(new PointerEvent(`pointer${kind}`, { pointerId: 7, clientX, clientY: 300 })); }""")
    assert page.evaluate("camkit.charts[0].zoomed") is None


EVIL = (
    "<img src=x onerror=\"window.ran=1\" class='evil'>'\"</script><script>window.ran=1</script><!--"
    "\u2028\u2029${window.ran=1}`\\"
)


@dataclass(frozen=True)
class Evil(Design):
    """A design whose every name is a piece of a page."""

    x: float = quantity(EVIL, 1, 0.1, 4, "mm", EVIL)

    def analyse(self, n=5):
        return Made(self)


@dataclass(frozen=True)
class Made:
    cam: Evil


def evil_view(analysis):
    x = analysis.cam.x
    marks = (
        Points("a", [x], [2 * x], label=EVIL),
        Line(EVIL, [x, 2 * x], [x, x], label=f"{EVIL} {x:.3g}"),
        Text("t", x, x, f"{EVIL} {x:.3g}"),
    )
    return Picture.of(Axes(title=EVIL, xlabel=EVIL, ylabel=EVIL, xticks={0.001: EVIL}), *marks)


def test_names_that_are_pieces_of_a_page_stay_names(opened):
    evil_view.__name__ = EVIL
    size = Measure(EVIL, "mm", lambda analysis: analysis.cam.x)
    page = opened(Evil(), evil_view, measures=[size], at_most={size: 2 * mm})
    page.get_by_role("tab", name="Numbers").click()
    page.evaluate(DRAG, [0.9, 0])
    page.wait_for_function(DRAWN)
    shown = shown_by(page)
    assert shown["pictures"][0]["name"] == EVIL
    assert page.locator(".evil").count() == 0
    assert page.evaluate("window.ran") is None
    assert not page.heard
    assert EVIL in page.locator(".camkit-numbers").inner_text()


def view_in_words(analysis):
    x = analysis.cam.x / mm
    ticks = {k: f"{k * x:.1f}" for k in np.arange(3)}
    axes = Axes(title=f"size {x:.1f}", xlabel=f"along {x:.1f}  [deg]", ylabel="y", yticks=ticks, grid=np.False_)
    return Picture.of(axes, Line("a", [0, x], [0, 2]))


def test_axes_say_numbers_of_the_design(opened):
    page = opened(Evil(), view_in_words)
    for k in (0.0, 1.0):
        page.evaluate(DRAG, [k, 0])
        page.wait_for_function(DRAWN)
        x = page.evaluate("camkit.values[0]") / mm
        assert (
            page.locator("canvas").get_attribute("aria-label") == f"size {x:.1f}; along {x:.1f}  [°] from 0 to {x:.3g}"
        )
    assert page.evaluate("camkit.charts[0].axes.grid") is False
    assert not page.heard


def place_in_words(analysis):
    return Picture.of(Axes(xticks={analysis.cam.x: "here"}), Line("a", [0, analysis.cam.x], [0, 2]))


def test_ticks_where_the_design_says_are_those_of_the_stored_one():
    (picture,) = living(Evil(), [place_in_words]).structure["pictures"]
    assert "a number" in picture["still"]
    assert picture["axes"]["xticks"] == {0.001: "here"}


def test_a_limit_is_kept_as_everywhere_in_the_package(opened):
    near, far = (Measure(name, "mm", lambda analysis: analysis.cam.x) for name in ("near", "far"))
    page = opened(Evil(), evil_view, measures=[near, far], at_most={near: (1 - 1e-10) * mm, far: (1 - 1e-7) * mm})
    assert page.locator(".camkit-chip.camkit-ok").inner_text().startswith("near")
    assert page.locator(".camkit-chips .camkit-bad").inner_text().startswith("far")


def test_a_long_name_leaves_room_for_its_number(opened):
    name = "minimum convex radius of curvature, pitch curve, worse curve of all that there are"
    page = opened(Evil(), evil_view, measures=[long := Measure(name, "mm", lambda a: a.cam.x)], at_most={long: 5 * mm})
    chip = page.locator(".camkit-chips .camkit-chip")
    box, inner = chip.bounding_box(), chip.locator(".camkit-name").bounding_box()
    assert inner["width"] < box["width"] / 1.2 < 0.5 * 934
    assert chip.locator(".camkit-name").evaluate("name => name.scrollWidth > name.clientWidth")  # it ends in dots
    small = chip.locator("small").bounding_box()
    assert small["x"] + small["width"] < box["x"] + box["width"]
    assert chip.inner_text() == f"{name} 1 mm ≤ 5 mm" == chip.get_attribute("aria-label")
    chip.focus()
    assert name in page.locator(".camkit-why").inner_text()


def test_what_is_undercut_is_said_once(opened):
    study = door_handle_study(MACHINES["door handle"])
    page = opened(study.start, at_most=study.at_most, at_least=study.at_least)
    margin = next(measure for measure in study.at_least if measure.name.startswith("undercut margin"))
    assert float(margin.one(study.start.analyse())) < 0
    words = study.start.analyse().trouble.replace(" deg", " °")
    assert page.locator(".camkit-trouble").inner_text() == words
    assert page.get_by_text("undercut margin").count() == 0
    sound = study.start.replace(relief_cam_angle=60 * deg)
    assert not sound.analyse().trouble
    assert float(margin.one(sound.analyse())) > 0
    page.evaluate("(values) => camkit.load(values)", [value_of(sound, path) for path in quantities_of(sound)])
    page.wait_for_function(DRAWN)
    assert not page.locator(".camkit-trouble").is_visible()
    page.wait_for_function("() => document.querySelector('.camkit-chips').textContent.includes('undercut margin')")


def test_who_hears_the_verdict_is_not_told_that_every_limit_is_kept(opened):
    study = door_handle_study(MACHINES["door handle"])
    limits = {m: v for m, v in study.at_least.items() if m.name.startswith(("undercut margin", "base radius"))}
    page = opened(study.start, at_least=limits)
    page.wait_for_function("() => document.querySelector('.camkit-said').textContent")
    words = study.start.analyse().trouble.replace(" deg", " °")
    assert page.locator(".camkit-said").text_content() == f"{words}; every other limit is kept"


def test_chips_below_the_first_line_are_counted_and_shown_by_a_press(opened):
    names = [f"length of a very long part, number {k}" for k in range(5)]
    page = opened(Evil(), evil_view, measures=[Measure(name, "mm", lambda analysis: analysis.cam.x) for name in names])
    chips, more = page.locator(".camkit-chips"), page.get_by_role("button", name="more")
    seen = "chips => [...chips.children].filter(chip => chip.offsetTop < chips.offsetTop + chips.clientHeight).length"
    page.wait_for_function(DRAWN)
    assert more.inner_text() == f"+{5 - chips.evaluate(seen)} more"
    more.click()
    assert chips.evaluate(seen) == 5
    page.get_by_role("button", name="fewer").click()
    assert more.is_visible()
    chips.locator("> *").last.focus()  # by a key: then it has to be seen
    assert chips.evaluate(seen) == 5
    page.get_by_role("button", name="fewer").click()
    page.set_viewport_size({"width": 2000, "height": 800})
    page.wait_for_function("() => document.querySelector('.camkit-others').hidden")


def test_a_number_under_the_pointer_has_its_unit_and_a_point_its_number(opened):
    page = opened(MACHINES["roller"])
    tip = page.locator(".camkit-tip")
    page.locator(".camkit-middle canvas").hover()
    assert re.fullmatch(r"x \S+ mm, y \S+ mm\nCtrl .*", tip.inner_text())
    page.locator(".camkit-play").hover()
    k = page.evaluate("camkit.charts.findIndex((chart) => chart.picture.name === 'pressure_angle')")
    page.locator("canvas").nth(k).hover()
    assert re.fullmatch(r"at \S+ °(\n.* \S+ °)+", tip.inner_text())


def test_a_program_holds_no_word_of_the_design():
    packed = living(Evil(), [evil_view]).packed
    assert set(gzip.decompress(packed).decode()) <= set('0123456789.,-+e[]"NaInfity')


@dataclass(frozen=True)
class Truth(Evil):
    """A design that cannot be recorded."""

    def analyse(self, n=5):
        assert self.x > 0
        return Made(self)


WIDGET = """([source, structure, answer, arrays]) => {
    const state = { structure, program: new DataView(new ArrayBuffer(0)), message: "", values: [], tabs: [], page: {} },
        heard = window.heard = [];
    const model = { get: (name) => state[name], set: (told) => { window.told = told.values; }, save_changes() {},
                    off: (name, act) => { if (heard.includes(act)) heard.splice(heard.indexOf(act), 1); },
                    send: (asked) => { if (asked.compute) questions.push(asked); },
                    on: (name, act) => { if (name === "msg:custom") heard.push(act); } };
    window.questions = [];
    window.answer = () => heard.forEach((act) => act({ ...answer, answer: questions.at(-1).number },
        arrays.map((values) => new DataView(Float64Array.from(values).buffer))));
    const el = document.body.appendChild(document.createElement("div"));
    return import(URL.createObjectURL(new Blob([source], { type: "text/javascript" })))
        .then((widget) => widget.default().render({ model, el })).then(() => { window.camkit = el.camkit; }); }"""
ASKED = "() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(() => next(questions.length))))"


def test_a_kernel_that_computes_is_asked_one_question_at_a_time(browser):
    shown = living(Truth(), [evil_view])
    answer = shown.show(Truth())
    arrays = [np.asarray(array).tolist() for array in answer.pop("arrays")]
    page = browser.new_page()
    page.evaluate(WIDGET, [script("widget.js"), shown.structure | {"files": []}, answer, arrays])
    asked = [page.evaluate(ASKED)]
    for share in (0.2, 0.4, 0.6):  # the first is not answered yet
        page.evaluate(DRAG, [share, 0])
        asked.append(page.evaluate(ASKED))
    page.evaluate("answer()")
    asked.append(page.evaluate(ASKED))
    page.evaluate("answer()")
    asked.append(page.evaluate(ASKED))
    assert asked == [1, 1, 1, 1, 2, 2]
    assert page.evaluate("questions[1].compute[0]") == page.evaluate("camkit.values[0]")
    for share in (0.7, 0.8):
        page.evaluate(DRAG, [share, 0])
        page.evaluate(ASKED)
    page.evaluate("answer()")
    page.evaluate(ASKED)  # the kernel hears of what has been answered, not of what is asked now
    assert page.evaluate("told[0]") == page.evaluate("questions[2].compute[0]") != page.evaluate("camkit.values[0]")
    page.evaluate(
        "void camkit.engine.run(Float64Array.from(camkit.inputs), true).then(() => { window.answered = true; })"
    )
    page.evaluate(DRAG, [0.9, 0])
    page.evaluate(ASKED)
    for _ in range(3):
        page.evaluate("answer()")
        page.evaluate(ASKED)
    assert page.evaluate("answered")
    assert page.evaluate("questions.at(-1).compute[0]") == page.evaluate("camkit.values[0]")
    listening = page.evaluate("heard.length")
    page.evaluate("camkit.end()")
    assert page.evaluate("heard.length") == listening - 1
    page.close()


def test_what_cannot_be_recorded_is_no_page(tmp_path):
    with pytest.raises(CannotRecord, match="a truth value"):
        to_html(Truth(), evil_view, path=tmp_path / "truth.html")


def odd_view(analysis):
    x, places = analysis.cam.x, np.linspace(0, 1, 4)
    return Picture.of(
        Axes(title=f"of {x / mm:.3g}", xlabel=f"at {x / mm:.3g} [constructor]"),
        Contour("level", places, places, np.add.outer(places, places), [1.0]),
        Line("line", [0.0, x], [1.0, 1.0], steps=False),
    )


def wide_view(analysis):
    return Picture.of(Axes(title="wide"), Text("t", 0.0, 0.0, f"{analysis.cam.x / mm:8.3f}"))


def test_texts_of_axes_have_their_numbers_and_what_a_page_cannot_write_stands_still(opened):
    page = opened(Evil(), odd_view, wide_view, measures=[])
    page.evaluate(DRAG, [1.0, 0])
    page.wait_for_function(DRAWN)
    assert page.evaluate("camkit.charts[0].describe()").startswith("of 4; at 4 [constructor] from ")
    level, line = shown_by(page)["pictures"][0]["marks"]
    assert (level["kind"], line["x"]) == ("line", ["0", "0.004"])
    assert "written as" in page.evaluate("camkit.structure.pictures[1].still")
    box = page.locator(".camkit-left .camkit-box input")
    for text in ("1e400", "NaN", "Infinity", "\u0661\u0662", "\uff11\uff12", "9" * 10_000):
        box.fill(text)
        box.press("Enter")
        assert page.locator(".camkit-refusal:not(:empty)").count() == 1
    assert page.evaluate("camkit.values[0]") == 4 * mm
    assert not page.heard
