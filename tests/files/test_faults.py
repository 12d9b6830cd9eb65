"""What is wrong with a design is said before it is made, and of a sound one nothing is."""

import numpy as np
import pytest

from camkit import (
    Cycloidal,
    DoorHandleCam,
    Dwell,
    MotionProgram,
    Return,
    Rise,
    Study,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    ValveCam,
    cam,
    deg,
    machines,
    mm,
)
from camkit.cam import ConjugatePair, max_pressure_angle, peak_force
from camkit.files import Blank, TitleBlock, faults
from camkit.files.workshop.drawing import drawing
from camkit.files.workshop.dxf import dxf
from camkit.files.workshop.faults import marked
from camkit.files.workshop.gcode import gcode
from camkit.files.workshop.tables import table
from camkit.motion import HalfHarmonicStart

LAW = Cycloidal()
STEEP = MotionProgram((Rise(60 * deg, 25 * mm, LAW), Dwell(20 * deg), Return(60 * deg, 25 * mm, LAW), Dwell(220 * deg)))
SECTOR = MotionProgram((Rise(120 * deg, 20 * mm, LAW), Dwell(20 * deg)))
CORNER = MotionProgram((Rise(180 * deg, 20 * mm, HalfHarmonicStart()), Return(180 * deg, 20 * mm, LAW)))
ROLLER = TranslatingRollerCam()


def designs():
    """Every kind of design that can be exported."""
    for wing in (cam, machines):
        for name in wing.__all__:
            kind = getattr(wing, name)
            if isinstance(kind, type) and hasattr(kind, "analyse"):
                yield pytest.param(kind, id=name)


@pytest.mark.parametrize("kind", [*designs()])
def test_designs_as_they_come_are_sound_but_for_the_published_handle(kind):
    said = faults(kind())
    assert len(said) == (kind is DoorHandleCam)
    assert all("undercut" in fault for fault in said)


def test_a_flat_face_that_the_cam_would_have_to_undercut():
    """A face 25 mm in 60 deg on a base circle of 20 mm: case 17 of the users."""
    (said,) = faults(TranslatingFlatCam(STEEP, 20 * mm))
    assert said.startswith("profile undercut at 32 to 57 deg")


def test_a_cut_that_the_curvature_alone_does_not_show():
    """Where only the envelope crosses itself, it is the follower's cuts that are told."""
    (said,) = faults(TranslatingFlatCam(base_radius=10 * mm))
    assert "undercut" in said


def test_an_analysis_and_a_design_have_the_same_faults():
    design = DoorHandleCam()
    assert faults(design.analyse(181)) == faults(design)


def test_a_pair_names_the_cam_that_is_at_fault():
    sharp = TranslatingRollerCam(STEEP, base_radius=20 * mm, roller_radius=25 * mm, groove=False)
    (said,) = faults(ConjugatePair(sharp, distance=140 * mm))
    assert said.startswith("first profile undercut at ")


def test_a_plate_that_stays_open_but_not_a_groove_which_has_ends_of_its_own():
    (said,) = faults(TranslatingRollerCam(SECTOR, groove=False))
    assert said == "the profile is open: the motion covers 140 deg; a return and a dwell close the turn"
    assert faults(TranslatingRollerCam(SECTOR, groove=True)) == ()


def test_a_follower_with_mass_is_struck_where_its_speed_jumps_and_the_cam_turns():
    struck = TranslatingRollerCam(CORNER, base_radius=60 * mm)
    (said,) = [fault for fault in faults(struck) if "struck" in fault]
    assert said == "the follower is struck by a force without end at 180 deg, where its speed jumps"
    still = struck.replace(load=struck.load.replace(speed=0.0))
    assert not [fault for fault in faults(still) if "struck" in fault]


def test_a_bore_that_reaches_the_profile():
    least = np.hypot(*ROLLER.analyse().profile).min()
    assert faults(ROLLER, blank=Blank(bore=2 * least - 0.1 * mm)) == ()
    (said,) = faults(ROLLER, blank=Blank(bore=2 * least + 0.1 * mm))
    assert said.startswith("the bore with its keyway reaches")


def test_a_groove_that_goes_through_the_cam():
    through = Blank(thickness=6 * mm, groove_depth=6 * mm)
    (said,) = faults(ROLLER, blank=through)
    assert said == "the groove depth is 6 mm; it must be below the thickness, 6 mm"
    assert faults(ROLLER.replace(groove=False), blank=through) == ()
    assert faults(ROLLER, blank=through.replace(groove_depth=5.9 * mm)) == ()


def test_limits_of_a_study_that_are_missed():
    value = max_pressure_angle.one(ROLLER.analyse())
    study = Study(ROLLER, ["base_radius"], (peak_force,), at_most={max_pressure_angle: value - 1 * deg})
    (said,) = faults(ROLLER, study)
    assert said == (
        f"the maximum pressure angle is {max_pressure_angle.text(value)}; it must be at most "
        f"{max_pressure_angle.text(value - 1 * deg)}"
    )
    assert faults(ROLLER, study.replace(at_most={max_pressure_angle: value})) == ()
    assert (
        faults(ROLLER.replace(base_radius=ROLLER.base_radius + 20 * mm), study) == ()
    )  # the design's, not the start's


def test_a_yield_below_what_is_asked():
    """A limit that the nominal design just keeps is missed by half of the parts."""
    value = max_pressure_angle.one(ROLLER.analyse())
    study = Study(ROLLER, ["base_radius"], (peak_force,), at_most={max_pressure_angle: value})
    half = {"base_radius": 0.2 * mm}
    (said,) = faults(ROLLER, study, half)
    share = float(said.removeprefix("the yield is ").partition(" %")[0])
    assert share == pytest.approx(50, abs=5)
    assert "at least 99 %" in said
    loose = study.replace(at_most={max_pressure_angle: value + 5 * deg})
    assert faults(ROLLER, loose, half) == ()
    assert faults(ROLLER, study.under(half, 0.9))[0].endswith("parts miss a limit)")


def test_a_shaft_has_limits_and_no_profile():
    assert faults(UniversalJointShaft()) == ()
    assert (
        faults(UniversalJointShaft(), machines.shaft_study()) != ()
        or machines.shaft_study().evaluate(machines.shaft_study().x_of(UniversalJointShaft())).feasible.all()
    )


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"cam": 3}, "a design or its analysis can be exported"),
        ({"cam": TranslatingRollerCam(base_radius=np.array([[0.03], [0.04]]))}, "a population"),
        ({"cam": ROLLER, "study": "mine"}, "the argument study"),
        ({"cam": ROLLER, "study": machines.valve_study()}, "ValveCam"),
        ({"cam": ROLLER, "tolerances": 3}, "the argument tolerances"),
    ],
)
def test_what_cannot_be_judged_is_refused_in_a_sentence(given, said):
    with pytest.raises(ValueError, match=said):
        faults(**given)


def test_a_valve_cam_is_judged_all_around():
    assert faults(ValveCam()) == ()


UNDERCUT = TranslatingFlatCam(base_radius=10 * mm)
WRITERS = {
    "drawing": lambda: drawing(UNDERCUT, ".svg"),
    "program": lambda: gcode(UNDERCUT, tool_radius=2 * mm),
    "table": lambda: table(UNDERCUT, "polar"),
    "dxf": lambda: dxf(UNDERCUT),
}


@pytest.mark.parametrize("writer", WRITERS)
def test_a_file_of_an_undercut_cam_says_so_whoever_asks_for_it(writer):
    text = WRITERS[writer]().data.decode(errors="replace").upper()
    assert "FAULTY" in text
    assert "UNDERCUT" in text


def test_a_file_of_a_sound_cam_says_nothing():
    assert b"FAULTY" not in dxf(TranslatingRollerCam()).data
    assert marked(TitleBlock(), TranslatingRollerCam()) == TitleBlock()
