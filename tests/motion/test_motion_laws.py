"""One contract for every law: ends, derivatives, continuity, peaks; then what each family promises besides."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camkit import motion
from camkit.motion import (
    HALF_LAWS,
    LAWS,
    ConstantVelocity,
    Cycloidal,
    Degree9,
    DoubleHarmonic,
    EighthOrder,
    FreePolynomial,
    Freudenstein,
    Gutman,
    HalfCycloidalEnd,
    HalfCycloidalStart,
    Mirrored,
    ModifiedConstantVelocity,
    ModifiedSine,
    ModifiedTrapezoid,
    Parabolic,
    Poly345,
    Poly4567,
    Poly56789,
    PowerPolynomial,
    SimpleHarmonic,
    Skewed,
    SplineLaw,
    SumOfSines,
    TableLaw,
)
from camkit.motion.families.shaped import SPLINE, ShapedLaw

ROWS = np.linspace(0, 1, 41)
DWELL_LAWS = [
    *LAWS,
    ConstantVelocity(),
    ConstantVelocity(0.1, "parabolic"),
    ConstantVelocity(0.5),
    Degree9((0.1, -0.2, 0.3, 0.05)),
    FreePolynomial((0, 0), (1, 0)),
    FreePolynomial((0, 0, 0, 0), (1, 0, 0, 0)),
    SplineLaw((0.3, 0.5, 0.8), (0.2, 0.45, 0.9)),
    SplineLaw((0.3, 0.6), (0.2, 0.7), (0, 0, 0), (0, 0, 0)),
    TableLaw(ROWS, np.round(Cycloidal()(ROWS).s, 4), 1e-4),
    Skewed(Cycloidal(), 0.35),
    Skewed(ModifiedTrapezoid(), 0.6),
    Skewed(SimpleHarmonic(), 0.45),
    Skewed(Parabolic(), 0.4),
    Gutman(),
    Freudenstein(),
    SumOfSines(0.1, -0.03),
    ModifiedConstantVelocity(),
    ModifiedConstantVelocity(0.0),
    ModifiedConstantVelocity(0.6),
    PowerPolynomial((4, 5, 7, 9)),
    PowerPolynomial((3.5, 4.2, 6)),
    PowerPolynomial((5, 7, 9, 11, 13)),
    Mirrored(Skewed(Cycloidal(), 0.35)),
    ShapedLaw(Cycloidal(), (0.1, -0.05), SPLINE),
    ShapedLaw(Poly4567(), (0.02, -0.01, 0.03, 0.0, -0.02, 0.01, 0.03), SPLINE),
]
MOVING_LAWS = [
    *HALF_LAWS,
    FreePolynomial((0, 0.3, 1, -2), (1, 1.5, -3, 4)),
    FreePolynomial((0,), (1,)),
    FreePolynomial((0, None, 0), (1, 2, None)),
    SplineLaw((0.5,), (0.4,), (0.5, 0.0), (1.0, 0.0)),
    SplineLaw((0.4,), (0.4,), (0.0,), (1.0,)),
    DoubleHarmonic(),
    EighthOrder(),
    Mirrored(DoubleHarmonic()),
    Mirrored(EighthOrder()),
    PowerPolynomial((3, 4, 6, 7.5), (0.5, 1, 2)),
    PowerPolynomial((2, 3, 6)),
]
EVERY_LAW = DWELL_LAWS + MOVING_LAWS


def named(law):
    return law.name


every_law = pytest.mark.parametrize("law", EVERY_LAW, ids=named)
dwell_law = pytest.mark.parametrize("law", DWELL_LAWS, ids=named)


def pieces(law):
    return [(low, high) for low, high in pairwise((0.0, *law.kinks, 1.0)) if high - low > 1e-9]


def dense_search(law, k):
    n = 200_000 // len(pieces(law))
    return max(np.abs(law(np.linspace(low, high - 1e-10, n))[k]).max() for low, high in pieces(law))


def jumps(law, k):
    """The jumps of derivative k where the law meets dwells and at its kinks."""
    ends = [law(0.0)[k], law(1.0)[k] - (k == 0)]
    return np.abs(ends + [law(u + 1e-12)[k] - law(u - 1e-12)[k] for u in law.kinks])


@every_law
def test_runs_from_0_to_1(law):
    assert law(0.0).s == pytest.approx(0, abs=1e-12)
    assert law(1.0).s == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("law", [law for law in EVERY_LAW if not isinstance(law, ShapedLaw)], ids=named)
def test_is_a_value(law):
    assert isinstance(law.name, str)
    assert law.name
    again = eval(repr(law), vars(motion).copy())
    assert law == again
    assert hash(law) == hash(again)


@every_law
@pytest.mark.parametrize("k", [1, 2, 3])
def test_derivatives(law, k):
    for low, high in pieces(law):
        u, h = low + (high - low) * np.linspace(0.05, 0.95, 19), 0.002 * (high - low)
        f = [law(u + i * h)[k - 1] for i in (-2, -1, 1, 2)]
        slope = (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h)  # fourth order
        size = max(np.abs(law(u)[k]).max(), 1.0)
        noise = 1e-13 * max(np.abs(law(u)[k - 1]).max(), 1.0) / h
        assert np.allclose(law(u)[k], slope, rtol=0, atol=1e-5 * size + noise)


@dwell_law
def test_stated_continuity(law):
    peaks = (1.0, *(peak if np.isfinite(peak) else 10.0 for peak in law.peaks()))
    for k in range(min(law.continuity, 3) + 1):
        assert abs(law(0.0)[k]) < 1e-9 * peaks[k]
        assert abs(law(1.0)[k] - (k == 0)) < 1e-6 * peaks[k]  # jerk of a spline near s = 1 has seven digits
    if law.continuity < 3:
        assert max(abs(law(0.0)[law.continuity + 1]), abs(law(1.0)[law.continuity + 1])) > 1e-3
    else:
        snap = abs(law(1e-6).j) / 1e-6
        assert (snap < 0.1) == (law.continuity == 4)


@every_law
def test_continuous_inside_up_to_acceleration(law):
    known_to_break = isinstance(law, Parabolic) or "parabolic" in repr(law).lower()
    for u in law.kinks:
        below, above = law(u - 1e-12), law(u + 1e-12)
        for k in range(2 if known_to_break else 3):
            assert below[k] == pytest.approx(above[k], abs=1e-6)


@every_law
@pytest.mark.parametrize("k", [1, 2, 3])
def test_stated_peaks(law, k):
    stated = law.peaks()[k - 1]
    if np.isinf(stated):
        assert max(jumps(law, i).max() for i in range(k)) > 0.1
    else:
        assert stated == pytest.approx(dense_search(law, k), rel=1e-6)


@every_law
def test_shapes_and_the_outside(law):
    assert np.ndim(law(0.3).j) == 0
    assert all(x.shape == (2, 3) for x in law(np.full((2, 3), 0.4)))
    assert all(np.isnan(x).all() for x in law([-0.1, 1.1, np.nan, np.inf]))
    assert law(1 + 1e-12).s == law(1.0).s


@pytest.mark.parametrize(
    "law",
    [
        *LAWS,
        ConstantVelocity(),
        ConstantVelocity(0.1, "parabolic"),
        Gutman(),
        Freudenstein(),
        ModifiedConstantVelocity(),
    ],
    ids=named,
)
def test_symmetric(law):
    u = np.linspace(0, 0.499, 50)
    s, v, a, j = law(u)
    mirror = law(1 - u)
    assert law(0.5).s == pytest.approx(0.5, abs=1e-15)
    assert np.allclose(mirror.s, 1 - s, atol=1e-14)
    assert np.allclose(mirror.v, v, atol=1e-13)
    assert np.allclose(mirror.a, -a, atol=1e-12)
    assert np.allclose(mirror.j, j, atol=1e-11)


@pytest.mark.parametrize(
    ("law", "same"),
    [
        (ConstantVelocity(0.5), Cycloidal()),
        (ConstantVelocity(0.5, "parabolic"), Parabolic()),
        (FreePolynomial(), Poly345()),
        (FreePolynomial((0, 0, 0, 0), (1, 0, 0, 0)), Poly4567()),
        (Degree9(), Poly345()),
        (SplineLaw((), ()), Poly345()),
        (SplineLaw((), (), (0, 0, 0), (0, 0, 0)), Poly4567()),
        (Skewed(ModifiedSine(), 0.5), ModifiedSine()),
        (SumOfSines(0, 0), Cycloidal()),
        (SumOfSines(1 / 16), Gutman()),
        (ModifiedConstantVelocity(0), ModifiedSine()),
        (PowerPolynomial(), Poly345()),
        (PowerPolynomial((4, 5, 6, 7)), Poly4567()),
        (PowerPolynomial((5, 6, 7, 8, 9)), Poly56789()),
        (PowerPolynomial((3, 4, 5), (0.5, -2)), FreePolynomial((0, 0, 0), (1, 0.5, -2))),
        (PowerPolynomial((2, 3), (1.5,)), FreePolynomial((0, 0), (1, 1.5))),
        (Mirrored(HalfCycloidalStart()), HalfCycloidalEnd()),
        (Mirrored(Poly345()), Poly345()),
        (TableLaw((0, 1), (0, 1)), Poly345()),
        (TableLaw(ROWS, ROWS, 1.0), Poly345()),
    ],
    ids=str,
)
def test_known_special_cases(law, same):
    u = np.linspace(0, 1, 100)
    for found, expected in zip(law(u), same(u), strict=True):
        assert np.allclose(found, expected, rtol=0, atol=1e-3 if isinstance(law, TableLaw) else 1e-9)


@pytest.mark.parametrize("n", [1, 2, 4, 7, 40])
def test_a_shaped_law_is_moved_by_its_coefficients_at_even_knots(n):
    c = tuple(0.05 * np.cos(3.0 * np.arange(n)))
    law, knots = ShapedLaw(ModifiedSine(), c, SPLINE), np.arange(1, n + 1) / (n + 1)
    assert np.allclose(law(knots).s - ModifiedSine()(knots).s, c, atol=1e-12)
    plain = ShapedLaw(Poly345(), (0.0,) * n, SPLINE)
    assert np.array_equal(plain(knots), Poly345()(knots))
    many = ShapedLaw(ModifiedSine(), tuple(x * columns for x in c), SPLINE)(u6)
    for row, x in enumerate(columns[:, 0]):
        alone = ShapedLaw(ModifiedSine(), tuple(float(x) * y for y in c), SPLINE)(u6)
        assert np.allclose([part[row] for part in many], alone, rtol=1e-12, atol=1e-12)


def test_skewing_puts_the_inflection_where_it_is_asked_for():
    law = Skewed(Cycloidal(), 0.3)
    assert law(0.3).s == pytest.approx(0.3)
    assert law(0.3).v == pytest.approx(2.0)
    assert law(0.3).a == pytest.approx(0.0, abs=1e-12)
    assert law(0.15).a == pytest.approx(2 * np.pi / 0.6)


def test_a_half_law_is_half_of_the_whole():
    u = np.linspace(0, 1, 11)
    assert np.allclose(HalfCycloidalStart()(u).s, 2 * Cycloidal()(u / 2).s)


numbers = st.floats(-5, 5)
four = st.tuples(numbers, numbers, numbers, numbers)


@given(four, four)
@settings(max_examples=50, deadline=None)
def test_a_free_polynomial_has_the_ends_it_is_given(start, end):
    law = FreePolynomial(start, end)
    assert np.allclose(law(0.0), start, atol=1e-8)
    assert np.allclose(law(1.0), end, atol=1e-8)


def test_a_free_polynomial_has_the_least_degree():
    assert np.ptp(FreePolynomial((0, None, 0), (1, 0))(np.linspace(0, 1, 9)).j) < 1e-12  # a cubic
    assert FreePolynomial((0, None, 0), (1, 0)).continuity == 0
    assert FreePolynomial((0.1,), (1,)).continuity == -1


@given(st.lists(st.floats(0.05, 0.95), min_size=1, max_size=6, unique_by=lambda u: round(20 * u)), st.randoms())
@settings(max_examples=30, deadline=None)
def test_a_spline_passes_through_its_points(knots, random):
    knots = sorted(knots)
    positions = [random.uniform(0, 1) for _ in knots]
    law = SplineLaw(knots, positions, (0.5, -1.0), (0.0, 2.0))
    assert np.allclose(law(knots).s, positions, atol=1e-9)
    assert np.allclose([*law(0.0)[1:3], *law(1.0)[1:3]], [0.5, -1.0, 0.0, 2.0], atol=1e-6)


@pytest.mark.parametrize("tolerance", [0.0, 1e-6, 1e-4, 1e-3, 1e-2])
def test_a_table_is_met_within_its_tolerance(tolerance):
    u = np.linspace(0, 1, 61) ** 1.2
    law = TableLaw(u, np.round(Cycloidal()(u).s, 5), tolerance)
    assert law.error == pytest.approx(np.abs(law(u).s - law.s).max(), abs=1e-15)
    assert law.error <= max(tolerance, 1e-12)


def test_smoothing_a_rounded_table_recovers_the_acceleration():
    u = np.linspace(0, 1, 181)
    table = np.round(Cycloidal()(u).s, 4)
    rough, smooth = TableLaw(u, table, 0.0), TableLaw(u, table, 1e-4)
    error = [np.abs(law(u).a - Cycloidal()(u).a).max() for law in (rough, smooth)]
    assert error[0] > 1
    assert error[1] < 0.1


u6 = np.linspace(0, 1, 7)
columns = np.array([[0.1], [0.2], [0.4]])


@pytest.mark.parametrize(
    "law_of",
    [
        lambda x: Degree9((x, 2 * x, -x, 0.5)),
        lambda x: FreePolynomial((0, x, 0), (1, 0, -x)),
        lambda x: SplineLaw((0.3, 0.7), (x, 2 * x)),
        lambda x: SplineLaw((0.3,), (0.2,), (x, 0), (0, 0)),
        lambda x: ConstantVelocity(x),
        lambda x: ConstantVelocity(x, "parabolic"),
        lambda x: Skewed(Cycloidal(), x),
        lambda x: Skewed(ModifiedTrapezoid(), x),
        lambda x: Skewed(ConstantVelocity(x), 0.4),
        lambda x: SumOfSines(x, -x / 4),
        lambda x: ModifiedConstantVelocity(x),
        lambda x: Mirrored(ModifiedConstantVelocity(x)),
        lambda x: PowerPolynomial((3 + x, 5, 6 - x)),
        lambda x: PowerPolynomial((2.5, 3 + x, 5), (x, -2 * x)),
    ],
)
@pytest.mark.parametrize("u", [u6, np.stack([u6, u6**2, 1 - u6])])
def test_a_population_equals_its_members(law_of, u):
    together = law_of(columns)(u)
    for row, x in enumerate(columns[:, 0]):
        alone = law_of(float(x))(u if u.ndim == 1 else u[row])
        for many, one in zip(together, alone, strict=True):
            assert many.shape == (3, 7)
            assert np.allclose(many[row], one, rtol=1e-12, atol=1e-12)
        for many, one in zip(law_of(columns).peaks(), law_of(float(x)).peaks(), strict=True):
            assert many[row, 0] == pytest.approx(one, rel=1e-9)


def test_a_population_has_nan_where_a_member_cannot_be():
    bad = np.array([[0.2], [-1.0], [np.nan]])
    powers = PowerPolynomial((3, 4 + bad, 4.1 + 0 * bad)), PowerPolynomial((2.7 + 2 * np.abs(bad - 0.2), 3))
    for law in (ConstantVelocity(bad), Skewed(Cycloidal(), bad), ModifiedConstantVelocity(bad), powers[1]):
        assert np.isfinite(law(u6).s).all(axis=-1).tolist() == [True, False, False]
    assert np.isnan(powers[0](u6).s).all(axis=-1).tolist() == [True, True, True]


@pytest.mark.parametrize(
    ("build", "sentence"),
    [
        (
            lambda: ConstantVelocity(0.0),
            "the blend of the constant velocity law is 0; it must be above 0 and at most 0.5",
        ),
        (
            lambda: ConstantVelocity("long"),
            "the blend of the constant velocity law is 'long'; it must be above 0 and at most 0.5",
        ),
        (
            lambda: ConstantVelocity(0.2, "cubic"),
            "the blend has the shape 'cubic'; it can be cycloidal or parabolic",
        ),
        (
            lambda: Skewed(Cycloidal(), 1.0),
            "the inflection of the skewed law is 1; it must lie between 0 and 1",
        ),
        (
            lambda: Skewed(HalfCycloidalStart(), 0.4),
            "the half cycloidal from rest law is not symmetric; only a symmetric law can be skewed",
        ),
        (
            lambda: Skewed("cycloidal", 0.4),
            "the law to be skewed is 'cycloidal'; it must be a motion law such as Cycloidal()",
        ),
        (
            lambda: ModifiedConstantVelocity(1.0),
            "the share of constant velocity is 1; it must be at least 0 and below 1",
        ),
        (
            lambda: Mirrored(Cycloidal),
            "the law to be mirrored is the class Cycloidal; it must be a motion law such as Cycloidal()",
        ),
        (
            lambda: PowerPolynomial(()),
            "the polynomial has 0 exponents; it must have from 1 to 8",
        ),
        (
            lambda: PowerPolynomial((3, 1, 5)),
            "the exponent 2 of the polynomial is 1; it must be a finite number above 1",
        ),
        (
            lambda: PowerPolynomial((3, 5, 4)),
            "the exponent 3 of the polynomial is 4 after 5; each must be above the one before",
        ),
        (
            lambda: PowerPolynomial((3, "4", 5)),
            "the exponent 2 of the polynomial is '4'; it must be a finite number above 1 and at most 60",
        ),
        (
            lambda: PowerPolynomial((3, 4), (0, 1)),
            "the polynomial has 2 values v, a, j at its end and 2 exponents; it can have one value fewer than "
            "exponents, and three at most",
        ),
        (
            lambda: PowerPolynomial((3, 4), (np.inf,)),
            "v at the end of the polynomial is inf; it must be a finite number",
        ),
        (
            lambda: SumOfSines(np.nan),
            "the third (share of the third harmonic) is nan; it must be a finite number",
        ),
        (
            lambda: FreePolynomial((None, 0), (None, 0)),
            "the free polynomial is given v(0), v(1); that does not determine a polynomial: add an s",
        ),
        (
            lambda: FreePolynomial((), ()),
            "the free polynomial is given nothing; that does not determine a polynomial: add an s",
        ),
        (
            lambda: FreePolynomial((0, np.inf), (1,)),
            "v at the start of the free polynomial is inf; it must be a finite number",
        ),
        (
            lambda: FreePolynomial((0,), (1, 0, 0, 0, 0)),
            "the end of the free polynomial has 5 values; it can have s, v, a, j at most",
        ),
        (
            lambda: Degree9((1, 2, 3)),
            "the degree 9 law has 3 coefficients c; it must have four",
        ),
        (
            lambda: Degree9((1, 2, 3, np.nan)),
            "the coefficient c3 of the degree 9 law is nan; it must be a finite number",
        ),
        (
            lambda: Degree9((1, 2, 3, 1e300)),
            "the coefficient c3 of the degree 9 law is 1e+300; it must be a finite number of a size of at most 600",
        ),
        (
            lambda: ShapedLaw(Poly345(), (0, 0, 0, 0, 0)),
            "the shaped law has 5 coefficients c; it must have four",
        ),
        (
            lambda: ShapedLaw(Poly345(), (), SPLINE),
            "the shaped law has 0 coefficients c; it must have from 1 to 40",
        ),
        (
            lambda: ShapedLaw(Poly345(), (0, 1e150, 0, 0)),
            "the coefficient c1 of the shaped law is 1e+150; it must be a finite number of a size of at most 600",
        ),
        (
            lambda: ShapedLaw(Poly345(), (0, 0, "x", 0), SPLINE),
            "the coefficient c2 of the shaped law is 'x'; it must be a finite number",
        ),
        (
            lambda: FreePolynomial((0, 1e150), (1, 0)),
            "v at the start of the free polynomial is 1e+150; it must be a finite number of a size of at most 4000",
        ),
        (
            lambda: SplineLaw((0.4,), (1e150,)),
            "a value of the spline is 1e+150; it must be a finite number of a size of at most 1500",
        ),
        (
            lambda: SplineLaw((0.4,), (0.5,), (0, 1e150), (0, 0)),
            "a value of the spline is 1e+150; it must be a finite number of a size of at most 20000",
        ),
        (
            lambda: TableLaw((0, 0.5, 1), (0, -1e150, 1)),
            "the table has the s -1e+150; it must be a finite number of a size of at most 1500",
        ),
        (
            lambda: SplineLaw((0.6, 0.4), (0.5, 0.5)),
            "the knots of the spline are 0.6, 0.4; they must increase strictly between 0 and 1",
        ),
        (
            lambda: SplineLaw((0.4, 1.0), (0.5, 0.5)),
            "the knots of the spline are 0.4, 1; they must increase strictly between 0 and 1",
        ),
        (
            lambda: SplineLaw((0.4,), (0.5, 0.5)),
            "the spline has 1 knots and 2 positions; it needs one position for each knot",
        ),
        (
            lambda: SplineLaw((0.4,), (0.5,), (0,), (0, 0)),
            "the spline has 1 values at its start and 2 at its end; it can have v, or v, a, or v, a, j at both",
        ),
        (
            lambda: SplineLaw((0.4,), (np.nan,)),
            "a value of the spline is nan; it must be a finite number",
        ),
        (
            lambda: TableLaw((0, 0.6, 0.5, 1), (0, 0.2, 0.4, 1)),
            "the table does not increase in u at row 3 (0.5 after 0.6); every u must be above the one before",
        ),
        (
            lambda: TableLaw((0, 1), (0, 0.5)),
            "the table runs from (0, 0) to (1, 0.5); it must run from (0, 0) to (1, 1)",
        ),
        (
            lambda: TableLaw((0, 1), (0, 0.5, 1)),
            "the table has 2 u and 3 s; it needs as many of each, and two at least",
        ),
        (
            lambda: TableLaw((0, 0.5, 1), (0, np.nan, 1)),
            "the table holds a value that is not finite; every u and s must be a finite number",
        ),
        (
            lambda: TableLaw((0, 1), (0, 1), -1),
            "the tolerance of the table is -1; it must be 0 or more",
        ),
    ],
)
def test_refusals(build, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011  the whole sentence is compared
        build()
    assert str(refusal.value) == sentence


@pytest.mark.parametrize(("exponents", "k"), [((1.2, 1.5, 5), 2), ((2.2, 2.5, 5), 3)])
def test_the_lowest_of_two_broken_exponents_rules_at_the_start(exponents, k):
    assert PowerPolynomial(exponents)(0.0)[k] == np.inf
    assert PowerPolynomial(exponents)(1e-9)[k] > 1e3


def test_powers_of_a_population_that_cannot_be_have_a_continuity():
    assert PowerPolynomial((np.array([[np.nan], [np.nan]]), 4, 5)).continuity == 2
