"""Motion programs as files: alone as JSON, as tables for CAD, and as the rows of a controller; all are read back."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit import TranslatingRollerCam, read_motion
from camkit.files import electronic_cam_csv, from_json, motion_csv, read, read_json, to_json, write
from camkit.motion import (
    LAWS,
    Cycloidal,
    Dwell,
    FormError,
    ModifiedSine,
    MotionProgram,
    Poly345,
    Poly4567,
    Return,
    Rise,
    SimpleHarmonic,
    motion_from_table,
)
from camkit.units import deg, mm, rpm


def stroke(law=None, lift=20 * mm):
    """120 deg up, 60 deg of dwell, 120 deg down, 60 deg of dwell."""
    law = law or Cycloidal()
    up, back = Rise(120 * deg, lift, law), Return(120 * deg, lift, law)
    return MotionProgram((up, Dwell(60 * deg), back, Dwell(60 * deg)))


def indexer(law=None):
    return MotionProgram((Rise(120 * deg, 60 * deg, law or ModifiedSine()), Dwell(240 * deg)), advance=60 * deg)


def cells(text, delimiter=","):
    heading, *rows = csv.reader(io.StringIO(text), delimiter=delimiter)
    return heading, rows


def columns(text):
    heading, rows = cells(text)
    return dict(zip(heading, np.array(rows, dtype=float).T, strict=True))


# ---------------------------------------------------------------- JSON


@pytest.mark.parametrize(
    "program",
    [
        stroke(),
        indexer(),
        stroke().replace(start=3 * mm),
        FormError(amplitude=1e-5, waves=7).on(indexer()),
        motion_from_table(np.arange(0, 360, 5) * deg, 5 * mm * (1 - np.cos(np.arange(0, 360, 5) * deg))),
    ],
    ids=["stroke", "indexer", "started", "formed", "table"],
)
def test_a_program_alone_comes_back(program, tmp_path):
    assert from_json(to_json(program)) == program
    assert read_json(to_json(program), MotionProgram).remarks == ()
    write(program, tmp_path / "motion.json")
    assert read(tmp_path / "motion.json", MotionProgram, tell=pytest.fail) == program


def test_only_a_motion_that_goes_on_says_its_advance():
    """So that files of cams, and of earlier ones, are what they were."""
    assert "advance" not in to_json(stroke())
    assert "advance" not in to_json(TranslatingRollerCam())
    assert '"advance": 1.0471975511965976' in to_json(indexer())


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: read_json(to_json(indexer()), TranslatingRollerCam), "holds a motion program; a translating"),
        (lambda: read_json(to_json(TranslatingRollerCam()), MotionProgram), "a motion program is wanted here"),
        (lambda: read_json(to_json(indexer()).replace('"advance"', '"advanced"')), "'advanced', which a motion"),
        (lambda: read_json(to_json(indexer()).replace('"advance": 1.', '"advance": 2.')), "that must be its advance"),
        (lambda: read_json(to_json(stroke()).replace('"program"', '"design"')), "a design is wanted here"),
        (lambda: to_json(stroke(lift=np.array([[0.01], [0.02]]))), "this is a population; one motion"),
        (lambda: to_json(stroke(lambda u: (u, 1 + 0 * u, 0 * u, 0 * u))), "which no file can hold: define it"),
    ],
)  # fmt: skip
def test_what_is_no_file_of_a_program(ask, sentence):
    with pytest.raises(ValueError, match=sentence):
        ask()


# ---------------------------------------------------------------- tables


def test_the_program_as_a_table():
    """20 mm, cycloidal in 120 deg: at its middle v = 2 h / beta and a = 0."""
    found = columns(motion_csv(stroke()))
    assert list(found) == ["cam angle [deg]", "s [mm]", "v [mm/rad]", "a [mm/rad^2]", "j [mm/rad^3]"]
    assert len(found["s [mm]"]) == 361
    row = [values[60] for values in found.values()]
    assert row[:4] == pytest.approx([60, 10, 19.0986, 0], abs=5e-5)
    assert row[2] == pytest.approx(40 / (120 * deg), rel=1e-11)
    assert row[3] == 0
    for name, values in zip("svaj", stroke()(np.arange(361) * deg), strict=True):
        given = next(found[key] for key in found if key.startswith(name))
        assert given[:-1] == pytest.approx(values[:-1] / mm, rel=1e-11, abs=1e-10)


def test_the_last_row_repeats_the_first():
    found = columns(motion_csv(stroke(), 90))
    for name, values in found.items():
        assert values[-1] == (360 if "angle" in name else values[0])
    assert len(columns(motion_csv(stroke(), 90, repeated=False))["s [mm]"]) == 90
    on = columns(motion_csv(indexer(), 90, unit="deg"))
    assert on["s [deg]"][[0, -1]] == pytest.approx([0, 60])
    assert on["j [deg/rad^3]"][-1] == on["j [deg/rad^3]"][0] > 0
    part = MotionProgram((Rise(100 * deg, 1.0, Cycloidal()),))
    assert len(columns(motion_csv(part, 10, repeated=False, unit="m"))["s [m]"]) == 11


def test_whole_degrees():
    """Also where the motion does not end at one."""
    assert columns(motion_csv(stroke(), step=1 * deg))["cam angle [deg]"] == pytest.approx(np.arange(361))
    part = MotionProgram((Rise(100.5 * deg, 1.0, Cycloidal()),))
    assert columns(motion_csv(part, step=1 * deg))["cam angle [deg]"] == pytest.approx([*range(101), 100.5])
    assert columns(motion_csv(stroke(), step=7 * deg))["cam angle [deg]"][-2:] == pytest.approx([357, 360])


def test_a_decimal_comma():
    heading, rows = cells(motion_csv(stroke(), 360, decimal=","), ";")
    assert heading[0] == "cam angle [deg]"
    assert rows[60][:4] == ["60", "10", "19,098593171", "0"]
    assert "." not in motion_csv(stroke(), 100, decimal=",")


def test_by_time_at_a_speed():
    speed = 300 * rpm
    found, by_angle = columns(motion_csv(stroke(), 36, speed=speed)), columns(motion_csv(stroke(), 36))
    assert list(found)[1:4] == ["time [s]", "s [mm]", "v [mm/s]"]
    assert found["time [s]"][-1] == pytest.approx(0.2)
    assert found["a [mm/s^2]"] == pytest.approx(by_angle["a [mm/rad^2]"] * speed**2)
    assert found["j [mm/s^3]"] == pytest.approx(by_angle["j [mm/rad^3]"] * speed**3)


def test_no_number_is_the_noise_of_rounding():
    """What is 0 says 0, never -0 nor 1e-17."""
    for text in (motion_csv(stroke()), electronic_cam_csv(stroke(), "poly7", 10 * deg)):
        assert "-0," not in text
        sizes = [abs(float(cell)) for row in cells(text)[1] for cell in row if not cell.startswith("P")]
        assert min(size for size in sizes if size) > 1e-6


def test_a_controllers_rows():
    text = electronic_cam_csv(stroke(Poly345()), "poly5", None)
    assert text.splitlines() == [
        "X [deg],Y [mm],V [mm/deg],A [mm/deg^2],way",
        "0,0,0,0,POLY5",
        "120,20,0,0,POLY5",
        "180,20,0,0,POLY5",
        "300,0,0,0,POLY5",
        "360,0,0,0,POLY5",
    ]
    heading, rows = cells(electronic_cam_csv(stroke(), "poly7", 60 * deg, unit="um", master="rad", decimal=","), ";")
    assert heading == ["X [rad]", "Y [um]", "V [um/rad]", "A [um/rad^2]", "J [um/rad^3]", "way"]
    assert rows[1] == ["1,0471975512", "10000", "19098,593171", "0", "-85943,6692696", "POLY7"]
    assert [row[0] for row in rows[2:4]] == ["2,09439510239"] * 2
    assert cells(electronic_cam_csv(stroke(), "linear", 60 * deg))[0] == ["X [deg]", "Y [mm]", "way"]
    assert cells(electronic_cam_csv(stroke(), "cubic", 60 * deg))[1][1] == ["60", "10", "0.333333333333", "CUBIC"]


# ---------------------------------------------------------------- read back

decimals = st.sampled_from(".,")
laws = st.sampled_from([law for law in LAWS if law.continuity >= 2])
X = np.linspace(0.01, 6.27, 301)


def near(found, expected, share):
    """Of ``s, v, a`` within shares of their peaks."""
    for k, part in enumerate(share):
        assert abs(found[k] - expected[k]).max() <= part * abs(expected[k]).max(), "svaj"[k]


@given(
    laws, decimals, st.booleans(), st.sampled_from([180, 240, 360, 720]), st.booleans(), st.sampled_from([None, 30.0])
)
@settings(max_examples=25, deadline=None)
def test_a_table_is_read_back(law, decimal, repeated, steps, goes_on, speed):
    program, unit = (indexer(law), "deg") if goes_on else (stroke(law), "mm")
    text = motion_csv(program, steps, unit=unit, decimal=decimal, repeated=repeated, speed=speed)
    motion = read_motion(text.encode(), advance=program.advance)
    assert motion.advance == program.advance
    assert motion.periodic
    near(motion(X), program(X), (1e-4, 5e-3))


@given(laws, decimals, st.sampled_from(["cubic", "poly5", "poly7"]), st.booleans(), st.sampled_from(["deg", "rad"]),
       st.sampled_from([2.0, 5.0, 7.0]))  # fmt: skip
@settings(max_examples=40, deadline=None)
def test_a_controllers_rows_are_read_back(law, decimal, way, goes_on, master, step):
    """Exactly: to what its polynomials are, and twelve digits."""
    program, unit = (indexer(law), "deg") if goes_on else (stroke(law), "mm")
    text = electronic_cam_csv(program, way, step * deg, unit=unit, master=master, decimal=decimal)
    motion = read_motion(text.encode())
    assert motion.advance == pytest.approx(program.advance, abs=1e-10)
    assert motion.periodic
    near(motion(X), program(X), {"cubic": (5e-5, 2e-3), "poly5": (2e-7, 2e-5, 2e-3), "poly7": (1e-7, 1e-6, 1e-5)}[way])


@given(laws, decimals)
@settings(max_examples=10, deadline=None)
def test_straight_lines_are_read_as_points_of_a_smooth_curve(law, decimal):
    motion = read_motion(electronic_cam_csv(stroke(law), "linear", 2 * deg, decimal=decimal).encode())
    near(motion(X), stroke(law)(X), (1e-4, 5e-3))


@pytest.mark.parametrize(("law", "way"), [(Poly345(), "poly5"), (Poly4567(), "poly7"), (SimpleHarmonic(), "poly7")])
def test_what_jumps_is_read_back_as_it_is(law, way):
    """Two rows of one angle: at the joints of simple harmonic motion the acceleration jumps."""
    motion = read_motion(electronic_cam_csv(stroke(law), way, 5 * deg).encode())
    near(motion(X), stroke(law)(X), (1e-10, 1e-9, 1e-6))


def test_an_indexer_is_read_back_and_goes_on():
    motion = read_motion(electronic_cam_csv(indexer(), "poly5", 5 * deg, unit="deg").encode())
    assert motion.advance / deg == pytest.approx(60, abs=1e-9)
    assert "it goes on by 60 deg with each turn" in motion.remarks[0]
    assert motion(800 * deg).s / deg == pytest.approx(indexer()(800 * deg).s / deg, abs=1e-6)


def test_a_table_that_does_not_come_back_asks_for_its_advance():
    text = motion_csv(indexer(), unit="deg").encode()
    with pytest.raises(ValueError, match="must come back to it, or say by its advance how far"):
        read_motion(text)
    motion = read_motion(text, advance=60 * deg)
    assert "60 deg further with each" in motion.remarks[0]
    levels = np.sort(motion.row_levels)
    assert levels[[0, -1]] / deg == pytest.approx([0, 60], abs=1e-9)
    angles, speeds = motion.row_differences(1)
    assert speeds == pytest.approx(indexer()(angles).v, abs=2e-3)
    with pytest.raises(ValueError, match="only rows of a whole turn can go on by an advance"):
        read_motion(motion_csv(MotionProgram((Rise(2.0, 1.0, Cycloidal()),)), unit="deg").encode(), advance=1.0)


@pytest.mark.parametrize("first", [-50, 30, 130])
def test_a_table_may_begin_anywhere_in_the_turn(first):
    """Its cam angles count modulo a turn, and the level with them."""
    x = np.arange(first, first + 361) * deg
    motion = motion_from_table(x, indexer()(x).s, "deg", advance=60 * deg)
    phi = np.linspace(-7, 14, 200)
    assert motion(phi).s == pytest.approx(indexer()(phi).s, abs=1e-4)


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: motion_csv(stroke(), 0), "the number of steps"),
        (lambda: motion_csv(stroke(), step=1e-5), "the table would have 628319 rows; there can be at most 20000"),
        (lambda: motion_csv(stroke(), step=-1.0), "the step of the table"),
        (lambda: motion_csv(stroke(), decimal=";"), "the decimal sign is ';'; it must be a point or a comma"),
        (lambda: motion_csv(stroke(), unit="furlong"), "furlong"),
        (lambda: motion_csv(stroke(), unit="kg"), "the unit of the follower is 'kg'; it must be one of a length"),
        (lambda: electronic_cam_csv(stroke(), unit="mm^2"), r"the unit of the follower is 'mm\^2'"),
        (lambda: motion_csv(stroke(), speed=0.0), "the speed"),
        (lambda: motion_csv(stroke(lift=np.array([[0.01], [0.02]]))), "the program is a population"),
        (lambda: motion_csv("stroke"), "the argument program is 'stroke'; it must be a MotionProgram"),
        (lambda: electronic_cam_csv(stroke(), "spline"), "the way of the controller is 'spline'"),
        (lambda: electronic_cam_csv(stroke(), master="mm"), "the unit of the master is 'mm'"),
    ],
)
def test_refusals(ask, sentence):
    with pytest.raises(ValueError, match=sentence):
        ask()
