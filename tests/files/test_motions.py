"""Motion read from files: every dialect of a table written and read back, and what cannot be read refused."""

import io
import sys
import zipfile
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from camkit import Cycloidal, Dwell, MotionProgram, Poly345, Return, Rise, read_motion
from camkit.files import TableQuestion
from camkit.motion import Poly4567
from camkit.units import deg, inch, mm

TABLES = Path(__file__).parents[1] / "data" / "tables"
ANGLES = np.arange(0.0, 360, 5)


def lifts(angle):
    return 10 - 10 * np.cos(angle * deg) + 2 * np.sin(2 * angle * deg)


def text(x=ANGLES, y=None, heading="angle [deg];lift [mm]\n", row="{:.2f};{:.5f}\n"):
    return heading + "".join(row.format(*pair) for pair in zip(x, lifts(x) if y is None else y, strict=True))


def read(told, **answers):
    return read_motion(told.encode(), **answers)


def test_a_lobe_of_a_european_file():
    motion = read_motion(TABLES / "lobe_european.csv")
    assert motion.remarks[0].startswith("semicolons and decimal commas, angles in deg (of the cam), levels in mm, 141")
    assert motion(0.0).s / mm == pytest.approx(8.5, abs=1e-3)
    assert motion(0.0).a / mm == pytest.approx(-34.17, rel=0.02)
    assert motion.peaks().velocity.value / mm == pytest.approx(11.948, abs=2e-3)


def test_a_turn_of_a_controller():
    motion = read_motion(str(TABLES / "controller_turn.csv"))
    assert "SPLINE" in motion.remarks[0]
    assert [x / mm for x in motion(0.0)[1:3]] == pytest.approx([3.0, 10.0], abs=1e-4)
    assert motion.transitions()[-1].order is None
    x = np.linspace(0, 2 * np.pi, 36001)
    s = motion(x).s / mm
    assert (s.min(), s.max()) == pytest.approx((-0.409, 20.409), abs=5e-4)
    assert x[np.argmin(s)] / deg == pytest.approx(360 - 15.05, abs=0.02)


def test_a_rise_that_does_not_end_at_rest():
    motion = read_motion(TABLES / "segment.txt")
    size = [12 * mm / (30 * deg) ** k for k in (1, 2, 3)]
    Cv, Ca, Cj = (peak.value / each for peak, each in zip(motion.peaks(), size, strict=True))
    assert (Cv, Ca, Cj) == pytest.approx((1.5, 6.0, 12.0), rel=1e-4)


def test_bytes_and_paths_are_alike(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(text(), encoding="utf-8")
    assert read_motion(path) == read_motion(path.read_bytes()) == read_motion(str(path))


ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
DIALECTS = st.tuples(
    st.sampled_from(
        [(";", "."), (";", ","), ("\t", "."), ("\t", ","), ("|", "."), ("|", ","), (",", "."), (" ", "."), (" ", ",")]
    ),
    st.sampled_from(ENCODINGS),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["", "Prüfstand 3\n", "Ventil: Einlass\nErstellt 2024-05-12\n\n"]),
    st.sampled_from(["", "Ende\n", "\nrows: all\n"]),
    st.booleans(),
)


@settings(max_examples=60, deadline=None)
@given(DIALECTS)
def test_every_dialect_is_read_back(dialect):
    (delimiter, decimal), encoding, end, above, below, spaced = dialect
    heading = f"angle_deg{delimiter}lift_mm\n"
    row = f"{{:.2f}}{delimiter}{{:.5f}}{delimiter if spaced and delimiter != ' ' else ''}\n"
    body = text(heading="", row=row).replace(".", decimal)
    data = (above + heading + body + below).replace("\n", end).encode(encoding)
    motion = read_motion(data)
    assert_allclose(motion(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)
    assert motion.remarks[0].startswith(
        f"{ {';': 'semi', '|': 'bars', ',': 'commas', ' ': 'blanks'}.get(delimiter, 'tabs') }"
    )
    assert motion(0.0).v / mm == pytest.approx(4, abs=1e-3)


@pytest.mark.parametrize(
    ("heading", "x", "y", "size"),
    [
        ("cam angle [rad];lift [mm]\n", ANGLES * deg, lifts(ANGLES), mm),
        ("crank angle [deg];lift [mm]\n", 2 * ANGLES, lifts(ANGLES), mm),
        ("Kurbelwinkel [°KW];Ventilhub [mm]\n", 2 * ANGLES, lifts(ANGLES), mm),
        ("angle;lift in\n", ANGLES, lifts(ANGLES) / 25.4, mm),
        ("cam deg;lift (thousandths)\n", ANGLES, lifts(ANGLES) / 0.0254, mm),
        ("Nockenwinkel [Grad];Hub [µm]\n", ANGLES, lifts(ANGLES) * 1000, mm),
        ("angle [deg];rocker [deg]\n", ANGLES, lifts(ANGLES), deg),
        ("angle [0.1 deg];lift [mm]\n", ANGLES * 10, lifts(ANGLES), mm),
        ("", ANGLES * 100, lifts(ANGLES), mm),
        ("", ANGLES * deg, lifts(ANGLES), mm),
        ("lift [mm];angle [deg]\n", lifts(ANGLES), ANGLES, mm),
    ],
)
def test_units_are_those_of_the_heading(heading, x, y, size):
    motion = read(text(x, y, heading, "{:.6f};{:.6f}\n"))
    assert_allclose(motion(ANGLES * deg).s / size, lifts(ANGLES), atol=1e-4)


def test_angles_run_as_they_like():
    for x in (ANGLES - 180, np.roll(ANGLES, 30), ANGLES[::-1], np.append(ANGLES, 360.0)):
        assert_allclose(read(text(x))(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)


LAYOUTS = {
    "from 0": ANGLES,
    "from the nose": ANGLES - 180,
    "around the end of the turn": np.roll(ANGLES, 30),
    "backwards": ANGLES[::-1],
    "first row again": np.append(ANGLES, 360.0),
}
ANGLE_HEADS = {
    "cam angle [deg]": 1.0,
    "phi [rad]": deg,
    "crank angle [deg]": 2.0,
    "Kurbelwinkel [°KW]": 2.0,
    "winkel [°]": 1,
}
LIFT_HEADS = {
    "lift [mm]": mm,
    "lift [in]": inch,
    "lift (thousandths)": inch / 1000,
    "Hub [µm]": 1e-6,
    "stroke [cm]": 10 * mm,
    "s [m]": 1.0,
}
"""Headings, and what a degree of the cam and a length of 1 are in them."""


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([*LAYOUTS]),
    st.sampled_from([*ANGLE_HEADS]),
    st.sampled_from([*LIFT_HEADS]),
    st.sampled_from([("; ", ","), (",", "."), ("\t", ","), None]),
    st.booleans(),
    st.sampled_from(["", "2 cylinders, no. 7\n"]),
)
def test_what_is_written_in_any_unit_and_order_is_read_back(layout, angle, lift, way, swapped, above):
    """By text and by workbook (`None`), angle first or lift first."""
    x = LAYOUTS[layout] * ANGLE_HEADS[angle]
    y = lifts(LAYOUTS[layout]) * mm / LIFT_HEADS[lift]
    order = slice(None, None, -1 if swapped else 1)
    lines = [[angle, lift][order], *([float(a), float(b)][order] for a, b in zip(x, y, strict=True))]
    if way is None:
        data = workbook([*([word] for word in above.split("\n") if word), *lines])
    else:
        cells = [lines[0], *([f"{cell:.9f}".replace(".", way[1]) for cell in line] for line in lines[1:])]
        data = (above + "".join(f"{a}{way[0]}{b}\n" for a, b in cells)).encode()
    motion = read_motion(data)
    found = motion(ANGLES * deg)
    assert_allclose(found.s / mm, lifts(ANGLES), atol=2e-5)
    assert_allclose(found.v / mm, 10 * np.sin(ANGLES * deg) + 4 * np.cos(2 * ANGLES * deg), atol=5e-3)
    assert f"{len(x)} rows" in motion.remarks[0]
    assert motion.transitions()[-1].order is None
    assert motion.bad_rows == ()


def test_a_line_above_the_heading_says_nothing_of_columns():
    swapped = "".join(f"{lifts(x):.5f},{x:.1f}\n" for x in ANGLES)
    motion = read(f"2 cylinders, no. 7\ns [mm],cam angle [deg]\n{swapped}")
    assert_allclose(motion(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)
    both = "".join(f"{lifts(x):.5f};{x:.1f};0\n" for x in ANGLES)
    motion = read(f"Hub;Winkel;Geschw.\nmm;°;mm\n{both}")
    assert_allclose(motion(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)


def test_a_lobe_around_the_end_of_the_turn_is_whole():
    told = (TABLES / "lobe_european.csv").read_text(encoding="utf-8-sig").replace(",", ".").splitlines()[3:]
    x, y = np.array([line.split(";") for line in told], dtype=float).T
    whole = read(text(x, y, ""))
    for turned in (np.append(x[70:], x[:70] + 360), np.append(x[70:], x[:71] + 360)):
        found = read(text(turned, np.append(y[70:], y[: len(turned) - 71]), ""))
        assert "rows from 290 deg on around the end of the turn" in found.remarks[0]
        assert_allclose(found(ANGLES * deg).a, whole(ANGLES * deg).a, rtol=0, atol=1e-12)
    with pytest.raises(ValueError, match=r"between rows 141 and 142 .* rows are missing"):
        read(text(np.append(x + 70, np.arange(240, 300)), np.append(y, np.zeros(60)), ""))


def test_what_is_left_open_is_asked_and_answered():
    crank = text(2 * ANGLES, lifts(ANGLES), "angle;lift\n")
    with pytest.raises(ValueError, match="angle_unit='crank deg'"):
        read(crank)
    assert_allclose(read(crank, angle_unit="crank deg")(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)
    shares = text(np.linspace(0, 1, 11), np.linspace(0, 1, 11) ** 2, "", "{:.2f};{:.4f}\n")
    with pytest.raises(ValueError, match="say angle_unit='deg' or angle_unit='rad'"):
        read(shares)
    assert read(shares, angle_unit="rad", lift_unit="in")(1.0).s == pytest.approx(inch, rel=1e-3)
    columns = "".join(f"{i};{x:.1f};{lifts(x):.5f}\n" for i, x in enumerate(ANGLES))
    with pytest.raises(ValueError, match=r"3 columns .* say columns=\(1, 2\)"):
        read(columns)
    assert_allclose(read(columns, columns=(2, 3))(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)
    with pytest.raises(TableQuestion) as asked:
        read("first;second;third\n" + columns)
    assert asked.value.argument == "columns"
    assert asked.value.options == {
        "angle in column 2 (second, 0 to 355), lift in column 3 (third, -0.6825 to 20.6825)": (2, 3),
        "angle in column 1 (first, 0 to 71), lift in column 3 (third, -0.6825 to 20.6825)": (1, 3),
        "angle in column 2 (second, 0 to 355), lift in column 1 (first, 0 to 71)": (2, 1),
        "angle in column 1 (first, 0 to 71), lift in column 2 (second, 0 to 355)": (1, 2),
    }
    lines = "".join(f"{i};{x};{lifts(x):.5f};0\n" for i, x in enumerate(ANGLES))
    headed = f"No.;Cam angle;Lift;Velocity [mm/deg]\n{lines}"
    assert_allclose(read(headed)(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)
    commas = text(row="{:.2f}, {:.5f}\n").replace(".", ",")
    with pytest.raises(ValueError, match=r"4 columns \(commas and decimal points\)"):
        read(commas)
    assert_allclose(read(commas.replace(", ", " "))(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)


def controller(law, degree, angles=(), crank=1):
    """Rows of a controller for a rise, a dwell, a return and a dwell; two of each where a segment ends."""
    h = 20 * mm
    program = MotionProgram((Rise(120 * deg, h, law), Dwell(60 * deg), Return(120 * deg, h, law), Dwell(60 * deg)))
    x = np.sort([0.0, *np.repeat([120.0, 180.0, 300.0], 2), 360.0, *angles])
    side = 1e-9 * np.where(np.append(np.diff(x), 1) == 0, -1, np.where(np.diff(x, prepend=-1) == 0, 1, 0))
    per = deg / crank
    values = [value * per**k / mm for k, value in enumerate(program(np.clip(x * deg + side, 0, 2 * np.pi)))]
    lines = np.column_stack([x * crank, *values[: degree // 2 + 1]])
    return program, "".join(";".join(f"{cell:.12g}" for cell in line) + f";POLY{degree}\n" for line in lines)


@pytest.mark.parametrize(("law", "degree"), [(Poly345(), 5), (Poly4567(), 7)])
def test_a_controllers_polynomials_are_exact(law, degree):
    program, told = controller(law, degree)
    motion, x = read(told), np.linspace(0.001, 6.28, 500)
    assert motion.criterion.startswith(f"polynomials of degree {degree} between the rows")
    for found, expected in zip(motion(x), program(x), strict=True):
        assert_allclose(found, expected, rtol=0, atol=1e-6 * abs(expected).max())
    assert all(joint.lawful for joint in motion.transitions())
    crank = read(controller(law, degree, crank=2)[1], angle_unit="crank deg")
    assert_allclose(crank(x).a, program(x).a, rtol=0, atol=1e-6 * abs(program(x).a).max())


@pytest.mark.parametrize(("step", "error"), [(10, 1.4e-6), (5, 2.2e-8)])
def test_between_a_controllers_rows_a_cycloid_is_nearly_met(step, error):
    """The printed errors of degree 5, mm: ``h^6 |s^(6)| / 46080``."""
    program, told = controller(Cycloidal(), 5, np.setdiff1d(np.arange(0, 360, step), [0, 120, 180, 300]))
    x = np.linspace(0, 2 * np.pi, 7201)
    found = abs(read(told)(x).s - program(x).s).max() / mm
    assert found == pytest.approx(error, rel=0.05)


def test_columns_of_derivatives_are_taken_when_they_are_named():
    program, told = controller(Poly345(), 5)
    plain = told.replace(";POLY5", "")
    with pytest.raises(ValueError, match="4 columns"):
        read(plain)
    x = np.linspace(0, 6, 50)
    assert_allclose(read(plain, columns=(1, 2, 3, 4))(x).a, program(x).a, rtol=0, atol=1e-8)
    with pytest.raises(ValueError, match="row 3 leaps to another level"):
        read(told.replace("120;20;", "120;19;", 1))
    with pytest.raises(ValueError, match="must not fall"):
        read(told.replace("180;", "100;"))


def workbook(rows, *more, formula=None):
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    if formula:
        book.active[formula] = "=1+1"
    for name, lines in more:
        page = book.create_sheet(name)
        for row in lines:
            page.append(row)
    out = io.BytesIO()
    book.save(out)
    return out.getvalue()


ROWS = [["Lobe"], [], [None, "angle [deg]", "lift [mm]"], *([None, x, round(lifts(x), 5)] for x in ANGLES.tolist())]


def test_a_workbook_is_read():
    motion = read_motion(workbook(ROWS))
    assert motion.remarks[0].startswith("the sheet Sheet, angles in deg")
    assert_allclose(motion(ANGLES * deg).s / mm, lifts(ANGLES), atol=2e-5)


def test_without_openpyxl_a_sentence_says_what_to_install(monkeypatch):
    data = workbook(ROWS)
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(ModuleNotFoundError, match=r"a workbook needs openpyxl, .* pip install 'camkit\[lab\]'"):
        read_motion(data)


def test_of_two_tables_one_is_asked_for():
    data = workbook(ROWS, ("more", ROWS))
    with pytest.raises(ValueError, match="the workbook has tables in 'Sheet', 'more'; say sheet="):
        read_motion(data)
    assert read_motion(data, sheet="more").remarks[0].startswith("the sheet more")
    with pytest.raises(ValueError, match="the workbook has no sheet 'other'"):
        read_motion(data, sheet="other")


def packed(**files):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return out.getvalue()


GOOD = text()
HOSTILE = {
    "nothing": (b"", "the file is empty"),
    "blanks": (b" \n\n ", "the file is empty"),
    "words": (b"no table here\nnor here", "no rows of two numbers or more"),
    "JSON": (b'{"schema": "camkit/1", "design": {}}', "the file is JSON"),
    "a page": (b"<html>1;2</html>", "a page of HTML or XML"),
    "a picture": (b"\x89PNG\r\n\x1a\n" + bytes(100), "a PNG picture"),
    "an old workbook": (b"\xd0\xcf\x11\xe0" + bytes(100), "an Excel workbook of the old kind"),
    "binary": (bytes(range(256)) * 9, "no text and no workbook"),
    "too large": (b"1;2\n" * 2_600_000, "more than 10 million bytes"),
    "too many lines": (b"1;2\n" * 60_000, "the file has 60000 lines; a table of a motion has at most 50000"),
    "one row": (b"0;1\n", "the table has 1 rows"),
    "not a number": (
        GOOD.replace("20.00;", "20.00;nan\n20.00;", 1).encode(),
        "line 6 of the table is no row",
    ),
    "the last not": (GOOD.encode() + b"360;inf\n", "line 74 of the table is no row"),
    "the first not": (GOOD.replace("0.00;0.00000", "0;nan", 1).encode(), "line 2 of the table is no row"),
    "one missing": (GOOD.replace("20.00;", "20.00;\n20.50;", 1).encode(), "line 6 of the table is no row"),
    "a formula": (GOOD.replace("20.00;", "20.00;=A1\n20.00;", 1).encode(), "line 6 of the table is no row"),
    "huge": (GOOD.replace("20.00;", "1e99;", 1).encode(), "line 6 of the table holds a number that no cam can have"),
    "infinite": (GOOD.replace("20.00;", "1e999;", 1).encode(), "line 6 of the table holds a number that no cam can"),
    "unsorted": (
        GOOD.replace("20.00;", "90.00;", 1).encode(),
        "row 6 of the table has the cam angle 25 deg",
    ),
    "twice": (GOOD.replace("20.00;", "15.00;", 1).encode(), "row 5 of the table has the cam angle 15 deg after 15 deg"),
    "beyond a turn": (text(ANGLES * 1.3).encode(), "span 461.5 deg, more than a turn of the cam"),
    "damaged workbook": (workbook(ROWS)[:900], "the workbook cannot be read"),
    "archive": (packed(a="b"), "the workbook cannot be read"),
    "bomb": (packed(a=bytes(110_000_000)), "unpacked it has more than 100 million bytes"),
    "formulas": (workbook([[f"={i}", f"={i}+1"] for i in range(9)]), "formulas count by the values"),
    "a cell of formula": (workbook(ROWS, formula="C9"), "line 9 of the table is no row of 2 numbers"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_what_is_no_table_is_refused_in_a_sentence(case):
    data, why = HOSTILE[case]
    with pytest.raises(ValueError, match=why) as refusal:
        read_motion(data)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("answers", "why"),
    [
        ({"delimiter": "x"}, "delimiter is 'x'; it must be one of"),
        ({"decimal": ",", "delimiter": ","}, "both a comma"),
        ({"columns": (1, 9)}, r"columns is \(1, 9\); it must be two numbers from 1 to 2"),
        ({"angle_unit": "mm"}, "angle_unit is 'mm'; it must be one of 'deg', 'rad', 'crank deg'"),
        ({"lift_unit": "kg"}, "lift_unit is 'kg'"),
        ({"tolerance": -1.0}, "the tolerance is -1"),
    ],
)
def test_answers_are_checked(answers, why):
    with pytest.raises(ValueError, match=why):
        read(GOOD, **answers)
