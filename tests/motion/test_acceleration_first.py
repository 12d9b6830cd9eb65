"""Laws and lobes from their acceleration: worked values, quadrature, a least-squares solve, the spline of scipy."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from camkit import MotionProgram, OscillatingRollerCam, Return, Rise, TranslatingRollerCam, deg, mm
from camkit.files import from_json, to_json
from camkit.motion import AccelerationTable, Dwell, ModifiedTrapezoid, Parabolic, lobe_by_acceleration
from camkit.motion.families.acceleration import pieces_of
from camkit.quantities import quantities_of, with_quantities

TOLD = json.loads((Path(__file__).parents[1] / "data" / "motion_from_acceleration.json").read_text())
SHAPES = ("lines", "steps", "spline")
U, A = (0, 8, 30, 38, 46, 72, 80), (0, 1, 1, 0, -1, -1, 0)
every_shape = pytest.mark.parametrize("shape", SHAPES)


def motion_of(law, angle, lift):
    """Position, velocity and acceleration of a rise, in units of the lift per rad."""
    rise = MotionProgram((Rise(angle * deg, lift, law),))
    return lambda x: np.array(rise(x * deg))[:3]


def test_a_rise_by_lines():
    rise = TOLD["rise"]
    u, a = zip(*rise["nodes"], strict=True)
    law = AccelerationTable(u, a)
    assert law.scales * rise["lift"] / (80 * deg) ** 2 == pytest.approx(rise["scales"], rel=1e-9)
    motion = motion_of(law, 80, rise["lift"])
    for angle, right in rise["values"].items():
        assert motion(float(angle)) == pytest.approx(right, rel=1e-9, abs=1e-9)


def test_a_lobe_of_three_zones():
    valve = TOLD["valve"]
    at, a = (np.array(column, dtype=float) for column in zip(*valve["nodes"], strict=True))
    rise, back = lobe_by_acceleration(at * deg, a, valve["lift"])
    nose = at[0] + rise.angle / deg
    assert nose == pytest.approx(valve["nose_deg"], abs=1e-9)
    rest = (360 - at[-1] + at[0]) * deg
    program = MotionProgram((rise, back, Dwell(rest)))
    for angle, right in valve["values"].items():
        assert np.array(program((float(angle) - at[0]) * deg))[:3] == pytest.approx(right, rel=1e-9, abs=1e-9)
    for law in (rise.law, back.law):  # their tables are scaled before, all zones alike
        assert law.scales == pytest.approx(law.scales[[0, 0]])
    assert program.transitions()[0].order is None
    for zone, x in zip(((-60, -50), (-20, 10), (57, 63)), valve["scales"], strict=True):
        middle = np.mean(zone)
        assert program((middle - at[0]) * deg).a == pytest.approx(x * np.interp(middle, at, a), rel=1e-9)


@every_shape
@pytest.mark.parametrize("ends", [(0.0, 0.0), (0.4, 0.0), (0.3, 0.8)])
def test_velocity_and_position_are_the_integrals(shape, ends):
    law = AccelerationTable((0, 0.1, 0.3, 0.6, 0.8, 1), (0.3, 1.4, 0.6, -0.5, -1, -0.2), shape, *ends)
    assert (law(0.0).s, law(0.0).v) == pytest.approx((0, ends[0]), abs=1e-14)
    assert (law(1.0).s, law(1.0).v) == (1, ends[1])
    x, w = np.polynomial.legendre.leggauss(4)
    s, v = 0.0, ends[0]
    for low, high in zip((0.0, *law.kinks), (*law.kinks, 1.0), strict=True):
        u, h = (high + low) / 2 + (high - low) / 2 * x, (high - low) / 2
        s += v * 2 * h + h * (w * law(u).a * (high - u)).sum()
        v += h * (w * law(u).a).sum()
        assert law(high - 1e-13)[:2] == pytest.approx((s, v), abs=1e-10)


@every_shape
def test_the_least_differing_scales_are_taken(shape):
    u, a = np.linspace(0, 1, 9), (0, 1, 0.2, -0.3, 0.4, 0.9, -0.8, -1, 0)
    law = AccelerationTable(u, a, shape, 0.1, 0.2)
    pieces = pieces_of(u, np.array(a, dtype=float), shape)
    zone = pieces.zones.astype(int)
    zone = np.unique(zone[pieces.dv != 0], return_inverse=True)[1]
    pieces = [part[pieces.dv != 0] for part in (pieces.dv, pieces.ds + pieces.dv * (1 - pieces.start - pieces.width))]
    C = np.array([np.bincount(zone, part) for part in pieces])
    n = C.shape[1]
    kkt = np.block([[np.eye(n) - 1 / n, C.T], [C, np.zeros((2, 2))]])
    x = np.linalg.solve(kkt, [*np.zeros(n), 0.1, 0.9])[:n]
    assert n == 4
    assert law.scales == pytest.approx(x, rel=1e-9)


def test_a_constant_acceleration_each_way_is_the_parabolic_law():
    u = np.linspace(0, 1, 41)
    law = AccelerationTable((0, 0.5, 1), (7, -3, 0), "steps")
    for found, right in zip(law(u), Parabolic()(u), strict=True):
        np.testing.assert_allclose(found, right, atol=1e-12)
    assert law.continuity == 1
    assert law.peaks() == pytest.approx((2, 4, np.inf))


def test_a_table_of_a_law_is_that_law_as_closely_as_it_is_dense():
    u = np.linspace(0, 1, 301)
    for shape, near in (("lines", 1e-4), ("spline", 1e-4)):
        law = AccelerationTable(u, ModifiedTrapezoid()(u).a, shape)
        x = np.linspace(0, 1, 1001)
        assert np.abs(law(x).a - ModifiedTrapezoid()(x).a).max() < 5e-3
        assert np.abs(law(x).s - ModifiedTrapezoid()(x).s).max() < near
        assert law.continuity == 2


heights = st.floats(-3, 3).map(lambda x: round(x, 3))


@given(st.lists(heights, min_size=3, max_size=9), st.lists(st.floats(0.1, 2), min_size=9, max_size=9))
@settings(max_examples=60, deadline=None)
def test_the_spline_is_that_of_scipy_and_pieces_have_one_sign(a, widths):
    u = np.concatenate([[0.0], np.cumsum(widths[: len(a) - 1])])
    u = u / u[-1]
    right = PchipInterpolator(u, a)
    pieces = pieces_of(u, np.array(a), "spline")
    for share in (0.0, 0.3, 0.7, 1.0):
        t = share * pieces.width
        here = pieces.c[0] + t * (pieces.c[1] + t * (pieces.c[2] + t * pieces.c[3]))
        np.testing.assert_allclose(here, right(pieces.start + t), atol=1e-9)
        assert (here * np.sign(pieces.dv) >= -1e-9).all()


@given(st.lists(st.floats(0.2, 2), min_size=8, max_size=8), st.sampled_from(SHAPES))
@settings(max_examples=40, deadline=None)
def test_any_rise_and_fall_of_acceleration_leads_up_by_one(a, shape):
    law = AccelerationTable(np.linspace(0, 1, 10), (0, *a[:4], *(-x for x in a[4:]), 0), shape)
    assert law(1.0)[:2] == (1, 0)
    assert law(1 - 1e-9)[:2] == pytest.approx((1, 0), abs=1e-7)
    assert (law.scales > 0).all()
    assert (law(np.linspace(0, 1, 101)).v > -1e-12).all()


@every_shape
def test_a_population_is_its_members(shape):
    x = np.array([[0.7], [1.1], [1.6]])
    many = AccelerationTable(U, (0, x, 1, 0.2 * x, -1, -x, 0), shape, 0.1 * x, 0.2)
    u = np.linspace(0, 1, 9)
    for i, one in enumerate(x[:, 0].tolist()):
        alone = AccelerationTable(U, (0, one, 1, 0.2 * one, -1, -one, 0), shape, 0.1 * one, 0.2)
        for found, right in zip(many(u), alone(u), strict=True):
            np.testing.assert_allclose(found[i], right, rtol=1e-12, atol=1e-12)
        for found, right in zip(many(u**2 * x / 2), alone(u**2 * one / 2), strict=True):
            np.testing.assert_allclose(found[i], right, rtol=1e-12, atol=1e-12)
        for found, right in zip(many.peaks(), alone.peaks(), strict=True):
            assert found[i, 0] == pytest.approx(right, rel=1e-9)


def test_a_member_whose_zones_cannot_be_scaled_is_no_motion():
    x = np.array([[0.5], [-3.0], [np.nan], [2.0]])
    law = AccelerationTable(U, (0, x, 1, 0, -1, -1, 0))
    assert np.isfinite(law(np.linspace(0, 1, 5))).all(axis=(0, 2)).tolist() == [True, False, False, True]


def test_its_numbers_are_quantities_and_it_comes_back_from_a_file():
    law = AccelerationTable(U, A, "spline", 0.0, 0.0)
    cam = with_quantities(TranslatingRollerCam(), {"motion.rise.law": law})
    paths = [path for path in quantities_of(cam) if path.startswith("motion.rise.law.")]
    assert [path.rpartition(".")[2] for path in paths] == [*(f"a{i}" for i in range(7)), "start", "end"]
    assert from_json(to_json(cam)) == cam
    rise, back = lobe_by_acceleration(np.array([0, 20, 40, 80, 120, 140, 160]) * deg, (0, 1, 0, -1, 0, 1, 0), 10 * deg)
    valve = OscillatingRollerCam(MotionProgram((rise, back, Dwell(200 * deg))))
    assert from_json(to_json(valve)) == valve


def test_a_symmetric_lobe_by_steps():
    rise, back = lobe_by_acceleration(np.array([0, 20, 60, 80]) * deg, (2, -3, 2, 0), 8 * mm, "steps")
    assert (rise.angle, back.angle) == pytest.approx((40 * deg, 40 * deg))
    assert isinstance(back, Return)
    right = MotionProgram((Rise(40 * deg, 8 * mm, Parabolic()),))
    phi = np.linspace(0, 40, 9) * deg
    np.testing.assert_allclose(MotionProgram((rise,))(phi).s, right(phi).s, atol=1e-15)


def test_a_lobe_of_five_zones_keeps_its_ends():
    at, a = np.array([0, 10, 20, 25, 40, 55, 70, 80, 90, 110, 120]), (0, 3, 0, -0.3, 0, -2, -2, 0, 0.5, 2.5, 0)
    rise, back = lobe_by_acceleration(at * deg, a, 8 * mm)
    program = MotionProgram((rise, back, Dwell(240 * deg)))
    assert all(joint.lawful for joint in program.transitions())
    assert program.levels == pytest.approx([0, 8 * mm, 0, 0], abs=1e-18)


@pytest.mark.parametrize(
    ("build", "sentence"),
    [
        (lambda: AccelerationTable((0, 1), (1, 1)), "the acceleration table has too few zones of one sign; two"),
        (lambda: AccelerationTable((0, 1), (0, 0)), "the acceleration table has too few zones of one sign; two"),
        (
            lambda: AccelerationTable((0, 0.5, 1), (-1, 1, 0), "steps"),
            "the least scale of a zone of the acceleration table is -4; each must be above 0",
        ),
        (
            lambda: AccelerationTable(range(28), [(-1) ** k for k in range(28)]),
            "the places u of the acceleration table is range(0, 28); it must be a tuple",
        ),
        (
            lambda: AccelerationTable([*range(28)], [(-1) ** k for k in range(28)]),
            "the acceleration table has more than 12 zones of one sign; it can have 12 at most",
        ),
        (lambda: AccelerationTable((0, 1, 2), (1, -1)), "the acceleration table has 3 u and 2 a; it needs"),
        (lambda: AccelerationTable((0, 2, 1), (1, 0, -1)), "the acceleration table has places that do not"),
        (lambda: AccelerationTable((0,), (1,)), "the acceleration table has 1 rows; it must have from 2 to 400"),
        (lambda: AccelerationTable((0, 1, 2), (1, "b", -1)), "the acceleration 2 of the table is 'b'; it must be"),
        (lambda: AccelerationTable(U, A, "curves"), "the acceleration table is joined by 'curves'; it can be"),
        (lambda: AccelerationTable(U, A, start=np.inf), "the velocity at the start of the acceleration table is inf"),
        (lambda: lobe_by_acceleration(U, A, 0.01), "the acceleration of the lobe has too few zones of one sign"),
        (lambda: lobe_by_acceleration((0, 1, 2), A, 0.01), "the lobe has 3 angles and 7 accelerations; it needs"),
        (lambda: lobe_by_acceleration(U, A, -1), "the lift of the lobe is -1; it must be a finite number above 0"),
        (lambda: lobe_by_acceleration(U, A, 1, "spline"), "the acceleration of the lobe is joined by 'spline'"),
        (
            lambda: lobe_by_acceleration((0, 1, 2, 3), (-1, 1, -1, 0), 1, "steps"),
            "the acceleration of the lobe does not lead up to one nose and back from it",
        ),
        (
            lambda: lobe_by_acceleration((0, 3, 6, 9, 10, 11, 12, 13), (2, -1, 7, -1, 5, -1, 3, 0), 1, "steps"),
            "the least scale of a zone of the lobe is -0.287699 times the mean; each must be above 0",
        ),
    ],
)
def test_refusals(build, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011  its beginning is compared
        build()
    assert str(refusal.value).startswith(sentence)
