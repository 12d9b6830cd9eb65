"""What every panel does with numbers as people type them, however large: a sentence, and never another design."""

from __future__ import annotations

import re

import ipywidgets as w
import numpy as np
import pytest
import sheets
from hand import at, move, sliders
from try_everything import try_everything

from camkit import (
    DoorHandleCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    Study,
    TranslatingFlatCam,
    TranslatingRollerCam,
    deg,
    door_handle_study,
    explore,
    mm,
)
from camkit.cam.force_closure import ContactPair
from camkit.cam.measures import max_pressure_angle
from camkit.cam.undercut import undercut_in_words
from camkit.decision import Judgements, side_by_side
from camkit.linkage.universal_joint import DoubleUniversalJoint
from camkit.machines.cabin_door import CabinDoorLinkage
from camkit.machines.cam_lever import CAM_LEVER_MEASURES, CamLever
from camkit.machines.high_speed_cam import HighSpeedCam
from camkit.machines.high_speed_measures import HIGH_SPEED_MEASURES, high_speed_study
from camkit.machines.shaft import UniversalJointShaft
from camkit.machines.valve_cam import ValveCam
from camkit.machines.valve_measures import VALVE_MEASURES
from camkit.motion import Cycloidal, Dwell, HalfCycloidalStart, MotionProgram, Return, Rise, ShapedLaw
from camkit.panels import (
    Instrument,
    ahp_panel,
    compare_fronts,
    contour_panel,
    cycle_time_panel,
    edit_program,
    live_pareto_panel,
    optimise_panel,
    pareto_panel,
    presets,
    shortlist,
    tolerance_panel,
)
from camkit.panels.kit.inputs import Amount, Number, Whole
from camkit.panels.kit.sheet import Sheet
from camkit.quantities import Measure, PeakMeasure, certain, quantities_of, value_of
from camkit.render import picture
from camkit.study.sweep import Sweep
from camkit.study.tolerances import Tolerances
from camkit.units.typed import typed_number
from camkit.views import contact_force, contact_pressure, curvature, efficiency, mechanism, pressure_angle
from camkit.views.beside import Beside, cams_beside, curves_beside
from camkit.views.defaults import VIEW_OF, default_views
from camkit.views.overlay import Kept, measures_overlaid
from camkit.views.sweep import limit_sweep
from camkit.views.tolerances import sobol_bars

# ---------------------------------------------------------------- numbers as people type them


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("48.09", 48.09), ("48,09", 48.09), (" 12 ", 12), ("1e3", 1000), ("1E-3", 0.001), ("2,5e2", 250), ("-3", -3),
        ("−3,5", -3.5), ("–3", -3), ("+7", 7), (".5", 0.5), (",5", 0.5), ("5.", 5), ("5,", 5), ("0,125", 0.125),
        ("1,5", 1.5), ("1234,5", 1234.5), ("1,2345", 1.2345), ("1.234", 1.234), ("\u00a012\u00a0", 12), ("0", 0),
        ("-0,000", 0), ("1e300", 1e300),
    ],
)  # fmt: skip
def test_a_number_is_read_as_it_is_meant(typed, meant):
    assert typed_number(typed) == meant


@pytest.mark.parametrize(
    "typed",
    [
        "", "  ", "1/2", "2 in", "60,5mm", "abc", "12abc", "--5", "+-5", "1.234,5", "1,234.5", "1,234,567", "1.234.567",
        "1 234", "1_000", "0x10", "∞", "inf", "nan", "1e", "e3", ".", ",", "-", "1,,5", "½", "٣", "１２", "1e999",
        "1e-999", "1\n2", "5%", "1,234", "-12,500", "9" * 41, "$5", "1'000",
    ],
)  # fmt: skip
def test_what_is_no_number_is_refused_in_a_sentence(typed):
    with pytest.raises(ValueError, match=r"is no number|may be|for a computer") as refusal:
        typed_number(typed)
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 130


# ---------------------------------------------------------------- every box of every panel

TYPED = ("1e160", "-1e300", "0")
LEVER = (mechanism, pressure_angle, curvature, contact_force)
PANELS = {
    "door handle": (DoorHandleCam(), (), DoorHandleCam.measures),
    "arm with roller": (OscillatingRollerCam(), (*LEVER, efficiency), OscillatingRollerCam.measures),
    "arm with face": (OscillatingFlatCam(), LEVER, OscillatingFlatCam.measures),
    "slide with roller": (TranslatingRollerCam(groove=False), LEVER, TranslatingRollerCam.measures),
    "slide with face": (TranslatingFlatCam(), (mechanism, curvature), TranslatingFlatCam.measures),
    "high speed": (HighSpeedCam(), (), HIGH_SPEED_MEASURES),
    "lever": (CamLever(), (), CAM_LEVER_MEASURES),
    "valve": (ValveCam(), (), VALVE_MEASURES),
    "linkage": (CabinDoorLinkage(), (), CabinDoorLinkage.measures),
    "shaft": (UniversalJointShaft(), (), UniversalJointShaft.measures),
    "joint": (DoubleUniversalJoint(), (), DoubleUniversalJoint.measures),
}


def inside(widget, kind):
    found = [widget] if isinstance(widget, kind) else []
    return found + [inner for child in getattr(widget, "children", ()) for inner in inside(child, kind)]


def press(panel, words):
    next(button for button in inside(panel, w.Button) if button.description == words).click()


def said_by(panel):
    if isinstance(panel, Sheet):
        return sheets.alert(panel)
    return panel.message if isinstance(panel, Instrument) else sentence(panel.banner)


def sentence(box):
    return "" if box.layout.display == "none" else box.value


def assert_shows_its_design(app):
    assert app.values == [value_of(app.design, path) for path in quantities_of(app.design)]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*encountered in:RuntimeWarning")
@pytest.mark.parametrize("name", PANELS)
def test_no_number_makes_a_panel_show_another_design(name):
    design, views, measures = PANELS[name]
    app = explore(design, *views, measures=measures)
    for path, quantity in quantities_of(design).items():
        for typed in TYPED:
            before = app.design
            move(app, path, float(typed))
            taken = value_of(app.design, path) == float(typed) * quantity.factor
            assert taken or app.design is before
            app.load(app.design)
            assert_shows_its_design(app)
        app.load(design)
        assert app.design == design
        assert_shows_its_design(app)


@pytest.mark.parametrize("error", [OverflowError("math range error"), np.linalg.LinAlgError("Singular matrix")])
def test_what_cannot_be_computed_brings_the_last_design_back(error, monkeypatch):
    app = explore(DoorHandleCam(), pressure_angle, free=["lift_arm", "friction.coefficient"])
    move(app, "lift_arm", 48.5)
    good, analyse = app.design, DoorHandleCam.analyse

    def broken(self, n=721):
        if self != good:
            raise error
        return analyse(self)

    monkeypatch.setattr(DoorHandleCam, "analyse", broken)
    move(app, "lift_arm", 47.0)
    assert app.design is good
    assert_shows_its_design(app)
    assert f"so the last one stays: {'a number in it' if error.args[1:] else error}" in app.message


def test_a_design_of_another_make_that_cannot_be_built_leaves_the_last_one():
    app = explore(HighSpeedCam(rise_law=Cycloidal()))
    start = app.design
    app.load(HighSpeedCam(rise_law=ShapedLaw(c=(50.0, 0.0, 0.0, 0.0))))
    assert "the last one stays" in app.message
    assert app.design is start
    assert_shows_its_design(app)
    move(app, "roller_radius", at(app, "roller_radius") - 1)
    assert (app.message, app.design == start) == ("", False)
    assert_shows_its_design(app)


@pytest.mark.parametrize("error", [KeyError("k"), TypeError("no sum"), MemoryError(), ZeroDivisionError("by 0")])
def test_what_a_measure_raises_leaves_the_last_design_and_is_said(error, monkeypatch):
    def number(analysis):
        if not certain(analysis.cam.base_radius <= 31 * mm):
            raise error
        return 1.0

    app = explore(TranslatingRollerCam(groove=False), mechanism, measures=[Measure("number", "mm", number)])
    good = app.design
    app.load(good.replace(base_radius=35 * mm))
    said = f"the last one stays: the number cannot be computed: {type(error).__name__}"
    assert said in app.message
    assert str(error).strip("'") in app.message
    assert app.design is good
    assert_shows_its_design(app)


def test_a_measure_of_several_numbers_is_refused_where_one_is_wanted():
    def several(values):
        return Measure("a", "mm", lambda analysis: np.array(values))

    cam = TranslatingRollerCam()
    told = r"^the a gives 3 numbers for one design; a measure gives one for each design$"
    for use in (
        lambda a: explore(cam, measures=[a]),
        lambda a: side_by_side({"one": cam}, [a]),
        lambda a: measures_overlaid(Kept({"A": cam.analyse()}, (a,))),
        lambda a: Study(cam, ["base_radius"], [a]).evaluate([[0.03]]),
    ):
        with pytest.raises(ValueError, match=told):
            use(several([1.0, 2.0, 3.0]))
        use(several([1.0]))
    assert explore(cam, measures=[several([0.002])]).rows()[0][1:] == (0.002, 0.002)


def panel_to_follow(name):
    """A panel with a function that changes what it shows."""
    if name == "ahp":
        judged = ahp_panel(Judgements(("a", "b"), [1]), "judgements")
        return judged, lambda number: setattr(judged.boxes[0, 1], "value", str(number))
    if name == "app":
        app = explore(TranslatingFlatCam(), mechanism, free=["base_radius"])
        return app, lambda number: move(app, "base_radius", at(app, "base_radius") + number)
    panel = edit_program(
        MotionProgram((Rise(2.0, 20 * mm, Cycloidal()), Dwell(1.0), Return(2.0, 20 * mm, Cycloidal())))
    )
    box = panel.rows[0].angle
    return panel, lambda number: setattr(box, "value", box.value + number)


@pytest.mark.parametrize("name", ["app", "ahp", "program"])
def test_a_follower_with_a_slip_leaves_the_panel_whole_and_is_said(name):
    """An error of Python in somebody's own function, not a number's: all that the panel shows is of the new design."""
    panel, change = panel_to_follow(name)
    seen, slip = [], [True]

    def slips(*_):
        if slip[0]:
            {}["arm"]

    panel.on_change(slips)
    panel.on_change(lambda *given: seen.append(given))
    before = panel.summary()
    change(3)
    assert len(seen) == 1
    assert "What follows this panel cannot be computed: KeyError: 'arm'." in said_by(panel)
    assert panel.summary() != before
    with pytest.raises(AssertionError, match="KeyError"):
        try_everything(panel)
    slip[0] = False
    change(2)
    assert said_by(panel) == ""


def plane_study():
    return door_handle_study(space=SPACE)


def one_goal():
    return plane_study().replace(minimise=plane_study().minimise[:1])


SPACE = {"lift_arm": (45 * mm, 55 * mm), "lift_start_angle": (0.3, 0.46)}


def other_panels(app):
    """Every panel that belongs to a door handle's, by name."""
    fast = explore(HighSpeedCam(), mechanism, free=["rise_angle"])
    program = (Rise(2.0, 20 * mm, Cycloidal()), Dwell(1.0), Return(2.0, 20 * mm, Cycloidal()))
    return {
        "survey": lambda: contour_panel(
            app, {"door": one_goal()}, {"angle": 0.7, "efficiency": 0.2, "force": 0.1}, steps=7
        ),
        "tolerate": lambda: tolerance_panel(app, door_handle_study(space=SPACE)),
        "live front": lambda: live_pareto_panel(app, plane_study()),
        "search": lambda: pareto_panel(app, plane_study(), free=["lift_arm"]),
        "improve": lambda: optimise_panel(fast, high_speed_study()),
        "shorten": lambda: cycle_time_panel(fast, high_speed_study(), 2.0, 40 * deg, 120 * deg),
        "program": lambda: edit_program(MotionProgram(program)),
    }


def assert_no_number_breaks_the_sheet(panel):
    boxes = sheets.parts(panel, (Amount, Number, Whole))
    assert boxes
    for box in boxes:
        first, unit = box.value, box.declared.factor if isinstance(box, Number) else 1.0
        for typed in TYPED:
            sheets.do(panel, box, value=float(typed) * unit)
            taken = box.value == pytest.approx(float(typed) * unit)
            assert taken or (box.value == first and sheets.alert(panel)), (typed, box.value)
            sheets.do(panel, box, value=first)
        panel.settle()
        assert "cannot" not in sheets.alert(panel)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*encountered in:RuntimeWarning")
@pytest.mark.parametrize("name", ["survey", "tolerate", "live front", "search", "improve", "shorten", "program"])
def test_no_number_breaks_a_panel_beside_the_explorer(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    app = explore(DoorHandleCam(), mechanism, free=["lift_arm", "lift_load.torque"])
    panel = other_panels(app)[name]()
    assert_no_number_breaks_the_sheet(panel)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*encountered in:RuntimeWarning")
def test_no_number_in_the_explorer_breaks_what_follows_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    app = explore(DoorHandleCam(), mechanism, free=["lift_arm", "lift_load.torque", "lift_load.speed"])
    space = {"lift_arm": (40 * mm, 50 * mm), "relief_cam_angle": (50 * deg, 75 * deg)}  # some of it is feasible
    study = door_handle_study(space=space)
    kept, made = shortlist(app, study), live_pareto_panel(app, plane_study(), space)
    panels = [
        contour_panel(app, one_goal(), {"angle": 0.7, "efficiency": 0.2, "force": 0.1}, steps=7),
        tolerance_panel(app, study),
        made,
    ]
    compare_fronts(app, given={"quick": made.front})
    presets(app, {"arm": {"long": lambda cam: cam.replace(lift_arm=60 * mm)}})
    for path in sliders(app):
        for typed in TYPED:
            move(app, path, float(typed))
            kept.keep()
            for panel in panels:
                panel.settle()
            app.load(app.start)
            for panel in panels:
                panel.settle()
                assert said_by(panel) == ""
    assert app.design == app.start


# ---------------------------------------------------------------- what pictures and tables say


def test_a_sixth_tolerance_has_a_name_and_a_colour():
    lengths = ("lift_arm", "relief_arm", "lift_centre_distance", "relief_centre_distance", "roller_radius")
    widths = dict.fromkeys(lengths, 0.3 * mm) | {"lift_start_angle": 0.5 * deg}
    made = Tolerances(door_handle_study(), widths, parts=64)
    (ax,) = picture(made, sobol_bars).axes
    told = [text.get_text() for text in ax.get_legend().get_texts()]
    assert told == [*(name.replace("_", " ") for name in made.half_widths), "together"]
    colours = {handle.get_color() for handle in ax.get_legend().get_lines()}
    assert len(colours) == 7
    bars = {line.get_gid(): line.get_xdata() for line in ax.lines if line.get_gid()}
    shares = [np.ptp(bars[f"{name} 0"]) if len(bars[f"{name} 0"]) else 0.0 for name in made.half_widths]
    alone = np.clip(made.indices.first[0], 0, 1)
    expected = 100 * alone[list(made.names).index("lift_start_angle")] / max(alone.sum(), 1)
    assert shares[-1] == pytest.approx(expected)
    assert shares[-1] > 10


def test_five_limits_are_swept_and_five_cams_stand_beside_each_other():
    limits = {
        Measure(f"limit {i}", "", lambda a, i=i: np.ravel(a.cam.base_radius / mm - 10 * i)): 0.5 for i in range(1, 6)
    }
    study = Study(TranslatingFlatCam(), {"base_radius": (10 * mm, 60 * mm)}, (max_pressure_angle,), at_most=limits)
    drawn = [mark for mark in limit_sweep(Sweep(study, n=9)).marks if mark.role == "series"]
    assert [mark.label for mark in drawn] == [m.name for m in limits]
    assert [mark.index for mark in drawn] == [0, 1, 2, 3, 4]

    cams = {f"cam {i}": OscillatingRollerCam(roller_radius=(4 + i) * mm).analyse() for i in range(5)}
    peak = PeakMeasure("force", "N", lambda a: abs(a.contact_force), angle=lambda a: a.cam_angle)
    drawn = picture(Beside(cams, peak), cams_beside, curves_beside)
    assert {t.get_text() for t in drawn.axes[0].texts} >= set(cams)
    assert {line.get_gid() for line in drawn.axes[1].lines} >= {f"{name} curve" for name in cams}


def test_a_measure_without_a_limit_has_no_verdict():
    endless = Measure("endless", "mm", lambda a: np.inf)
    table = side_by_side({"a": TranslatingFlatCam(), "b": TranslatingFlatCam(base_radius=40 * mm)}, (endless,))
    assert table.lines[-1].texts == ("inf mm", "inf mm")
    assert table.lines[-1].missed == (False, False)
    assert "not met" not in table.markdown() + table.html()


def band(ax):
    """The limits that a picture of the pressure angle draws, deg."""
    return sorted({abs(y) for patch in ax.patches for _, y in patch.get_xy()})


def test_the_limit_that_is_drawn_is_that_of_the_panel():
    cam = TranslatingRollerCam(groove=False)
    app = explore(cam, pressure_angle, at_most={max_pressure_angle: 25 * deg})
    assert band(app.figure().axes[0]) == pytest.approx([25])
    assert band(explore(cam, pressure_angle).figure().axes[0]) == []
    assert band(picture(cam, pressure_angle, limits={max_pressure_angle: 30 * deg}).axes[0]) == pytest.approx([30])
    door = door_handle_study()
    panel = explore(DoorHandleCam(), pressure_angle, at_most=door.at_most)
    assert band(panel.figure().axes[0]) == pytest.approx([45])


# ---------------------------------------------------------------- undercut


def test_a_sound_cam_is_not_spoken_of():
    for cam in (TranslatingRollerCam(groove=False), OscillatingRollerCam(), TranslatingFlatCam(), ValveCam()):
        assert undercut_in_words(cam.analyse()) == ""
    for design in (UniversalJointShaft(), CabinDoorLinkage()):
        assert undercut_in_words(design.analyse()) == ""


def test_the_sentence_says_what_is_undercut_where_and_by_how_much():
    """The flat face's radius of curvature is ``r_0 + s + a``: its least value by brute force."""
    cam = TranslatingFlatCam(base_radius=8 * mm)
    angle = np.linspace(0, 2 * np.pi, 200_001)
    s, _, a, _ = cam.motion(angle)
    radius = 8 * mm + s + a
    said = undercut_in_words(cam.analyse())
    found = re.fullmatch(
        r"profile undercut at ([\d.]+) to ([\d.]+) deg: radius of curvature ([\d.]+) mm too small", said
    )
    assert found
    first, last = (float(end) * deg for end in found.groups()[:2])
    within, room = (angle > first) & (angle < last), cam.analyse().cam_angle[1] + 0.5 * deg  # a step, and three digits
    assert radius[within].min() == pytest.approx(radius.min(), abs=1e-9)  # there are two
    assert (radius[(angle > first + room) & (angle < last - room)] < 0).all()
    assert np.interp([first - room, last + room], angle, radius).min() > 0
    assert float(found[3]) == pytest.approx(-radius.min() / mm, rel=0.005)


def test_a_knife_edge_is_not_undercut():
    """A speed that drops to 0 makes a convex corner, into which an edge without a radius fits."""
    motion = MotionProgram(
        (Rise(90 * deg, 10 * mm, HalfCycloidalStart()), Dwell(90 * deg), Return(180 * deg, 10 * mm, Cycloidal()))
    )
    cam = TranslatingRollerCam(motion, roller_radius=2 * mm)
    assert "profile undercut" in undercut_in_words(cam.replace(groove=False).analyse())
    for groove in (True, False):
        assert undercut_in_words(cam.replace(roller_radius=0, groove=groove).analyse()) == ""


def test_walls_that_merge_are_told():
    """350 deg with a rise of 5 mm: a groove 16 mm wide ends 5 mm outside its start, and no flank is too sharp."""
    cam = TranslatingRollerCam(MotionProgram((Rise(350 * deg, 5 * mm, Cycloidal()),)))
    assert undercut_in_words(cam.analyse()) == "walls merge: two parts of the groove overlap by 7.36 mm"
    for sound in (cam.replace(groove=False), cam.replace(roller_radius=3 * mm)):
        assert undercut_in_words(sound.analyse()) == ""


def test_a_groove_says_which_side_is_too_sharp():
    said = undercut_in_words(DoorHandleCam(roller_radius=12 * mm).analyse())
    assert re.search(r"relief groove undercut at [\d.]+ to [\d.]+ deg: roller 12 mm, convex radius", said)
    assert re.search(r"; relief groove undercut at [\d.]+ to [\d.]+ deg: roller 12 mm, concave radius", said)
    assert undercut_in_words(DoorHandleCam().analyse()) == (
        "relief groove undercut at 20.6 to 26.1 deg: roller 5 mm, concave radius 2.67 mm"
    )


def test_the_views_that_nobody_chose_follow_what_a_menu_brings(monkeypatch):
    """A contact is another curve; what cannot be drawn through them leaves the last design with its views."""
    app = explore(OscillatingRollerCam(), free=["contact", "roller_radius"])
    first, pair = app.views, ContactPair()
    assert contact_pressure not in first
    app.load(app.design.replace(contact=pair))
    assert app.views == default_views(app.analysis) == (*first, contact_pressure)
    assert [p["name"] for p in app.structure["pictures"]][-1] == "contact_pressure"
    app.load(app.start)
    assert app.views == first

    def broken(analysis):
        raise ValueError("no such picture")

    monkeypatch.setitem(VIEW_OF, "contact_pressure", broken)
    app = explore(OscillatingRollerCam(), free=["contact", "roller_radius"])  # the other one has recorded it
    app.load(app.design.replace(contact=pair))
    assert app.views == first
    assert app.design.contact == app.start.contact
    assert "so the last one stays: no such picture" in app.message
    move(app, "roller_radius", at(app, "roller_radius") + 1)
    assert app.message == ""


def test_views_that_somebody_chose_stay():
    app = explore(OscillatingRollerCam(), mechanism, free=["contact"])
    app.load(app.design.replace(contact=ContactPair()))
    assert app.views == (mechanism,)
