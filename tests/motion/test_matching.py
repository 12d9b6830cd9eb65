"""Matched programs against published values, closed forms and independent minimisers; mm, rad in the tables.

The values are those of two independent solutions (Hermite elements, and a dense null space of Legendre polynomials).
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit.motion import Boundary, Dwell, MatchedProgram, OpenMove, Poly345, Polynomial, Through, Uniform
from camkit.units import deg, inch, mm, rpm

BELT = 22 * inch / (58 * rpm)
JERK = "match"


def conveyor(first=60 * deg, velocity=BELT, jerk="free"):
    """A carriage that goes with a belt for 1.1 in and comes back."""
    parts = (
        Polynomial(first, name="up"),
        Uniform(velocity, 1.1 * inch, name="hold"),
        Polynomial(name="back"),
        Dwell(60 * deg),
    )
    return MatchedProgram(parts, (Boundary(s=0.0, j=jerk), *(Boundary(j=jerk) for _ in range(3))))


def dense(program, n=72001):
    """Cam angles (deg) and s, v, a, j there in mm."""
    phi = np.linspace(0, 360, n)
    return phi, *(1000 * values for values in program(phi * deg))


CONVEYORS = {
    "60": (
        dict(),
        (47.8103650232517, 134.1833995416987, -81.639409232423, 131.83041307499494, -121.92616253281317),
        {
            30: (8.851303201281, 45.353020827218344, 131.7839215794945),
            150: (131.22227517140826, -25.88274315818349, -108.5261085280364),
            200: (78.0528827907536, -81.27194335553192, -9.745033339934071),
            280: (1.3582537040186082, -11.045324382295059, 56.23535744275804),
        },
    ),
    "65": (
        dict(first=65 * deg),
        (51.5821445830059, 135.97701586601528, -84.23824885274797, 121.7485846444507, -126.89964276362498),
        {
            30: (7.634635932530129, 39.71636697959411, 120.38802419087389),
            150: (134.10439287879245, -21.21576769479253, -116.8877947503398),
            200: (81.80019002383715, -83.44340300039353, -14.855360708165842),
            280: (1.4529778677469096, -11.80083470623451, 59.91028485946984),
        },
    ),
    "60, jerk matched": (
        dict(jerk=JERK),
        (48.14607524546041, 146.51655264606063, -101.77341314204494, 164.73020359703176, -156.46538763491247),
        {
            30: (7.513770381350895, 45.94624783562097, 164.72990197436744),
            150: (144.69036818481771, -23.806815622377314, -153.39021041918303),
            200: (79.68462204091907, -101.77266950949388, 0.5764152698642955),
            280: (0.4128437583483162, -4.440430797427606, 34.141935871989496),
        },
    ),
}


@pytest.mark.parametrize("case", CONVEYORS)
def test_a_conveyor(case):
    """22 in/s at 58 rpm held for 1.1 in: 92.002533 mm/rad for 17.4 deg."""
    how, (held, top, slowest, most, least), values = CONVEYORS[case]
    program = conveyor(**how)
    _, s, v, a, _ = dense(program)
    assert program.segments[1].angle / deg == pytest.approx(17.4, rel=1e-12)
    assert program.levels[1] / mm == pytest.approx(held, rel=1e-6)
    assert s.max() == pytest.approx(top, rel=1e-6)
    assert v.min() == pytest.approx(slowest, rel=1e-6)
    assert a.max() == pytest.approx(most, rel=1e-6)
    assert a.min() == pytest.approx(least, rel=1e-6)
    for angle, wanted in values.items():
        assert_allclose(np.array(program(angle * deg)[:3]) / mm, wanted, rtol=1e-6)


def test_where_the_conveyor_is_fastest():
    phi, s, _, a, _ = dense(conveyor(), 720001)
    assert phi[s.argmax()] == pytest.approx(137.10391690508618, abs=1e-3)
    assert phi[a.argmax()] == pytest.approx(30.563080771987906, abs=1e-3)


@pytest.mark.parametrize("jerk", ["free", JERK])
def test_nothing_jumps_where_parts_meet(jerk):
    for first in (55, 60, 65):
        for boundary in conveyor(first * deg, jerk=jerk).transitions():
            assert max(abs(boundary.s), abs(boundary.v), abs(boundary.a)) < 1e-12 * (1 if jerk == "free" else 100)
            assert boundary.lawful
            assert boundary.order == (3 if jerk == "free" else None)


def test_a_moved_edge_takes_from_its_neighbour():
    moved = conveyor().with_edge(1, 65 * deg)
    assert_allclose([segment.angle / deg for segment in moved.segments], [65, 17.4, 217.6, 60])
    assert_allclose(moved.levels, conveyor(65 * deg).levels, atol=1e-15)
    later = conveyor().with_edge(2, 80 * deg)  # the held stretch keeps its angle, so both its ends move
    assert_allclose([segment.angle / deg for segment in later.segments], [62.6, 17.4, 220, 60])
    with pytest.raises(ValueError, match=r"transition 1 is to be at 300 deg; it can lie between 0 deg and 282\.6 deg"):
        conveyor().with_edge(1, 300 * deg)


def lobe(share=0.5, form="polynomial"):
    """20 mm somewhere within 150 deg and back."""
    return MatchedProgram((Polynomial(150 * deg, (Through(share, s=20 * mm),), form, name="lobe"), Dwell(210 * deg)))


def test_up_and_down_as_one_polynomial():
    """64, -192, 192, -64 times 20 mm; at 20 rad/s 28.0133 m/s^2."""
    program = lobe()
    assert_allclose(program.segments[0].motion(np.array(0.5)).s, 20 * mm)
    u = np.linspace(0, 1, 101)
    wanted = 20 * mm * np.polyval([-64, 192, -192, 64, 0, 0, 0], u)
    assert_allclose(program(150 * deg * u).s, wanted, atol=1e-16)
    phi = np.linspace(0, 150, 3001) * deg
    assert abs(program.in_time(phi, 20.0).a).max() == pytest.approx(28.013281, rel=1e-7)
    assert not program.overshoots()


def test_through_a_point_aside_it_overshoots_and_says_so():
    program, u = lobe(0.4), np.linspace(0, 1, 101)
    c = np.array([-72.33796296296296, 217.01388888888889, -217.01388888888889, 72.33796296296296, 0, 0, 0])
    assert_allclose(program(150 * deg * u).s, 20 * mm * np.polyval(c, u), atol=1e-15)
    (found,) = program.overshoots()
    top = 20 * mm * np.polyval(c, np.linspace(0, 1, 100001)).max()
    assert (found.part, found.form) == ("lobe", "polynomial")
    assert found.by == pytest.approx(top - 20 * mm, rel=1e-6)
    assert found.other_by == pytest.approx(dense(lobe(0.4, "spline"))[1].max() * mm - 20 * mm, rel=1e-5)
    assert found.text("mm") == "lobe overshoots by 2.606 mm at 75°; as a spline it does by 1.598 mm"


def test_up_and_down_as_a_spline():
    program = lobe(form="spline")
    _, s, v, a, _ = dense(program)
    assert_allclose(np.array(program(37.5 * deg)[:3]) / mm, (7.916666666666666, 25.46479089470325, 19.45366725932884))
    assert a.min() == pytest.approx(-77.8146690373154, rel=1e-6)
    assert v.max() == pytest.approx(26.48071759732089, rel=1e-6)
    assert s.max() == pytest.approx(20)
    assert a.max() == pytest.approx(53.49758496315435, rel=1e-6)


@pytest.mark.parametrize(("jerk", "top", "values"), [
    ("free", 0.84375, {25: (0.08130098175793898, 0.474609375, 1.4502994189248966), 50: (np.pi / 8, 0.84375, 0)}),
    (JERK, 0.984375, {25: (0.05541505596236878, 0.415283203125, 1.9035179873389265), 50: (np.pi / 8, 0.984375, 0)}),
])  # fmt: skip
def test_an_indexer(jerk, top, values):
    """45 deg in 100 deg, every turn."""
    boundaries = (Boundary(s=0.0, j=jerk), Boundary(j=jerk))
    program = MatchedProgram((Polynomial(100 * deg), Dwell(260 * deg)), boundaries, advance=45 * deg)
    assert program.peaks().velocity.value == pytest.approx(top, rel=1e-9)
    for angle, wanted in values.items():
        assert_allclose(program(angle * deg)[:3], wanted, atol=1e-12)
    x = np.linspace(0, 2 * np.pi, 50)[1:-1]
    assert_allclose(program(2 * np.pi + x).s, program(x).s + np.pi / 4)


@pytest.mark.parametrize(("jerk", "least"), [("free", 0.3890625), (JERK, 0.35390625)])
def test_a_rotary_knife(jerk, least):
    """180 deg a turn, at 0.6 of the shaft's speed for 40 deg."""
    boundaries = (Boundary(s=0.0, j=jerk), Boundary(j=jerk))
    program = MatchedProgram((Uniform(0.6, angle=40 * deg), Polynomial()), boundaries, advance=180 * deg)
    assert program([200 * deg]).v == pytest.approx(least)
    assert program(np.linspace(0, 2 * np.pi, 3601)).v.min() == pytest.approx(least)
    if jerk == "free":
        assert_allclose(program(120 * deg)[:2], (1.1915962760295669, 0.48134765625))
    assert all(boundary.lawful for boundary in program.transitions())


@pytest.mark.parametrize(("jerk", "at_60"), [
    ("free", (15.110439, 4.224916, -41.75609924178275)), (JERK, (17.718300, 6.461587, -74.082633)),
])  # fmt: skip
def test_a_waypoint(jerk, at_60):
    """Rest, 8 mm at 60, rest at 20 mm at 140, dwell to 200 and back: what is left open is smooth by itself."""
    parts = (Polynomial(60 * deg), Polynomial(80 * deg), Dwell(60 * deg), Polynomial(160 * deg))
    start = Boundary(0.0, 0.0, 0.0, 0.0 if jerk == JERK else "free")
    boundaries = (start, Boundary(8 * mm, j=jerk), Boundary(20 * mm, j=jerk), Boundary(j=jerk))
    program = MatchedProgram(parts, boundaries)
    for motion in (program.segments[0].motion(np.array(1.0)), program.segments[1].motion(np.array(0.0))):
        assert_allclose(np.array(motion[1:]) / mm, at_60, rtol=1e-6)
    if jerk == "free":
        jerks = [[segment.motion(np.array(u)).j / mm for u in (0.0, 1.0)] for segment in program.segments[:2]]
        wanted = [[99.38573613422543, -41.75609924178275], [-41.75609924178186, 69.40785260424384]]
        assert_allclose(jerks, wanted, rtol=1e-6)


def test_a_reversal():
    """a = -(20 h / 3) (1/b1^2 - 1/(b1 b2) + 1/b2^2) where it turns back."""
    parts = (Polynomial(120 * deg), Polynomial(180 * deg), Dwell(60 * deg))
    program = MatchedProgram(parts, (Boundary(0.0), Boundary(25 * mm, 0.0), Boundary(0.0)))
    b1, b2 = 120 * deg, 180 * deg
    wanted = -20 * 25 / 3 * (1 / b1**2 - 1 / (b1 * b2) + 1 / b2**2)
    assert wanted == pytest.approx(-29.552012)
    assert program(120 * deg).a / mm == pytest.approx(wanted)
    phi, _, _, a, _ = dense(program, 360001)
    assert a.min() == pytest.approx(-32.681162, rel=1e-6)
    assert phi[a.argmin()] == pytest.approx(109.733172, abs=2e-3)


def test_from_one_velocity_to_another():
    """12 mm/rad for 60 deg, -8 mm/rad for 50 deg, 90 and 160 deg between them."""
    parts = (Uniform(12 * mm, angle=60 * deg), Polynomial(90 * deg), Uniform(-8 * mm, angle=50 * deg), Polynomial())
    program = MatchedProgram(parts)
    assert_allclose(np.array(program.levels[:4]) / mm, (0, 12.566370614359162, 14.944987021106993, 7.963670013129664))
    for angle, wanted in {
        105: (18.66441733896714, 1.0892641914005128, -19.09859317102746),
        280: (-4.74481125340681, -7.097086107662744, 10.742958658702957),
    }.items():
        assert_allclose(np.array(program(angle * deg)[:3]) / mm, wanted, rtol=1e-9)
    _, s, v, a, _ = dense(program)
    assert_allclose((s.max(), s.min()), (18.69569290252312, -6.606782023619869), rtol=1e-7)
    assert v.min() == pytest.approx(-10.10117720392622, rel=1e-7)
    assert_allclose((a.max(), a.min()), (17.92193765842398, -19.372414841402307), rtol=1e-7)
    whole = sum(segment.angle * (jerks_of(segment) ** 2).mean() for segment in program.segments)
    assert whole == pytest.approx(2280.9982589889514, rel=1e-6)


def jerks_of(segment):
    """In mm at a hundred thousand shares, midway."""
    u = (np.arange(100_000) + 0.5) / 100_000
    return np.broadcast_to(segment.motion(u).j / mm, u.shape)


def test_rest_to_rest_gives_the_polynomials_of_the_books():
    """3-4-5; 4-5-6-7 where the jerk is matched; and where it is matched elsewhere alone 7u^3 - 21u^5 + 21u^6 - 6u^7."""
    u, parts = np.linspace(0, 1, 101), (Polynomial(2.0), Dwell(1.0), Polynomial(1.0), Dwell(2 * np.pi - 4))
    for up, down, law in (
        ("free", "free", [6, -15, 10, 0, 0, 0]),
        (JERK, "free", [-20, 70, -84, 35, 0, 0, 0, 0]),
        ("free", JERK, [-6, 21, -21, 0, 7, 0, 0, 0]),
    ):
        program = MatchedProgram(
            parts, (Boundary(0.0, j=up), Boundary(0.03, j=up), Boundary(j=down), Boundary(0.0, j=down))
        )
        assert_allclose(program(2 * u).s, 0.03 * np.polyval(law, u), atol=1e-15)


def test_an_open_move_finds_its_lift():
    parts = (Polynomial(100 * deg), OpenMove(80 * deg, Poly345()), Dwell(180 * deg))
    program = MatchedProgram(parts, (Boundary(0.0), Boundary(12 * mm, 0.0, 0.0), Boundary()))
    assert_allclose(program.levels, [0, 12 * mm, 0, 0], atol=1e-15)
    assert program(140 * deg).s == pytest.approx(6 * mm)
