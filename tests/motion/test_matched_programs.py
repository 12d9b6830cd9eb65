"""What matched programs share with all motion programs, and what holds of them whatever their numbers are."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.interpolate import BSpline

from camkit import Study, TranslatingRollerCam, minimise
from camkit.cam.conjugate import opposite
from camkit.cam.measures import max_pressure_angle
from camkit.files import from_json, read_json, to_json
from camkit.motion import (
    Boundary,
    Cycloidal,
    Dwell,
    FormError,
    FreePolynomial,
    MatchedProgram,
    MotionProgram,
    OpenMove,
    Polynomial,
    Return,
    Rise,
    ShapedLaw,
    SimpleHarmonic,
    Through,
    Uniform,
    matched,
)
from camkit.program import CannotRecord, record
from camkit.quantities import choices_of, members, quantities_of, value_of, with_quantities
from camkit.units import deg, inch, mm, rpm

BELT = 22 * inch / (58 * rpm)
X = np.linspace(0, 2 * np.pi, 181)


def conveyor(first=60 * deg, velocity=BELT):
    belt = Uniform(velocity, 1.1 * inch, name="hold")
    return MatchedProgram((Polynomial(first, name="up"), belt, Polynomial(name="back"), Dwell(60 * deg)))


def lobe(points, form, jerk="free"):
    part = Polynomial(150 * deg, points, form, name="lobe")
    return MatchedProgram((part, Dwell(60 * deg), Polynomial()), (Boundary(0.0, j=jerk), Boundary(5 * mm), Boundary()))


def least_by_splines(order, knots, rows, values, n=60):
    """Of quintic or septic splines on a fine grid that meet linear conditions the one with the least integral.

    Rows are (place, order of the derivative), whose differences or values are given.
    """
    degree = 2 * order - 1
    grid = np.unique(np.concatenate([np.linspace(a, b, n + 1) for a, b in pairwise(knots)]))
    inner = np.repeat(knots[1:-1], order - 1)  # what is given there may break the higher derivatives
    t = np.sort(np.concatenate([[grid[0]] * degree, grid, inner, [grid[-1]] * degree]))
    basis = BSpline(t, np.eye(len(t) - degree - 1), degree)
    x, w = np.polynomial.legendre.leggauss(order)
    half = np.diff(grid) / 2
    at = (grid[:-1, None] + half[:, None] * (x + 1)).ravel()
    bent = basis(at, order) * np.sqrt((half[:, None] * w).ravel())[:, None]
    given_rows = np.array([basis(place, k) for place, k in rows])
    scale = np.abs(given_rows).max(1)
    given_rows, wanted = given_rows / scale[:, None], np.array(values) / scale
    u, size, vh = np.linalg.svd(given_rows)
    rank = int((size > 1e-11 * size[0]).sum())
    first = vh[:rank].T @ ((u[:, :rank].T @ wanted) / size[:rank])
    null = vh[rank:].T
    c = first + null @ np.linalg.lstsq(bent @ null, -bent @ first, rcond=None)[0]
    return BSpline(t, c, degree), float(np.sum((bent @ c) ** 2))


@pytest.mark.parametrize(("order", "jerk"), [(3, "free"), (4, 0.0)])
def test_it_is_the_least_of_fine_splines_that_meet_the_same(order, jerk):
    """Rest at 0, 8 mm at 60 deg, 12 mm with 3 mm/rad at 100 deg, rest at 20 mm at 170 deg."""
    rest = {"v": 0.0, "a": 0.0, "j": jerk}
    parts = (Polynomial(100 * deg, (Through(0.6, s=8 * mm),), "spline"), Polynomial(70 * deg))
    boundaries = (
        Boundary(0.0, **rest),
        Boundary(12 * mm, 3 * mm, j="match" if order == 4 else "free"),
        Boundary(20 * mm, **rest),
    )
    program = MatchedProgram(parts, boundaries)
    assert program.order == order
    ends = [(x, k) for x in (0.0, 170 * deg) for k in range(order)]
    rows = [*ends, (60 * deg, 0), (100 * deg, 0), (100 * deg, 1)]
    values = [0.0] * order + [20.0] + [0.0] * (order - 1) + [8.0, 12.0, 3.0]
    found, _ = least_by_splines(order, [0, 60 * deg, 100 * deg, 170 * deg], rows, values, 12)
    phi = np.linspace(0, 170 * deg, 400)[1:-1]
    assert_allclose(program(phi).s / mm, found(phi), atol=2e-6)
    assert_allclose(program(phi).v / mm, found(phi, 1), atol=2e-5)
    assert_allclose(program(phi).a / mm, found(phi, 2), atol=5e-4)


ANGLES = st.floats(25, 90)
LEVELS = st.floats(-20, 20)


@settings(max_examples=60, deadline=None)
@given(
    angles=st.tuples(ANGLES, ANGLES, ANGLES),
    levels=st.tuples(LEVELS, LEVELS, LEVELS),
    slope=st.floats(-20, 20),
    place=st.floats(0.2, 0.8),
    jerk=st.sampled_from(["free", "match"]),
    form=st.sampled_from(["spline", "polynomial"]),
)
def test_it_closes_reaches_what_is_given_and_is_smooth(angles, levels, slope, place, jerk, form):
    first, top, inside = (level * mm for level in levels)
    parts = (
        Polynomial(angles[0] * deg, (Through(place, s=inside),), form),
        Uniform(slope * mm, angle=angles[1] * deg),
        Polynomial(angles[2] * deg),
        Polynomial(),
    )
    boundaries = (Boundary(first, j=jerk), Boundary(j=jerk), Boundary(j=jerk), Boundary(top, 0.0, j=jerk))
    program = MatchedProgram(parts, boundaries)
    assert program(angles[0] * place * deg).s == pytest.approx(inside, abs=1e-9)
    assert_allclose(program.levels[3], top, atol=1e-12)
    assert_allclose(program([0.0, 2 * np.pi]).s, first, atol=1e-11)
    assert program((angles[0] + angles[1] / 2) * deg).v == pytest.approx(slope * mm)
    edges = program.edges[1:-1]
    for k in range(3 if jerk == "free" else 4):
        before, after = (program(edges + side)[k] for side in (-1e-9, 1e-9))
        assert_allclose(before, after, atol=1e-6 * max(1, abs(program(X)[min(k + 1, 3)]).max()))


def test_a_population_is_its_members():
    rng = np.random.default_rng(1)
    first, velocity = rng.uniform(50, 70, (40, 1)) * deg, BELT * rng.uniform(0.9, 1.1, (40, 1))
    first[3] = 6.0
    many = conveyor(first, velocity)
    assert many.possible[:, 0].tolist() == [i != 3 for i in range(40)]
    assert np.isnan(many(X).s[3]).all()
    assert_allclose(members(many, [7])(X).s, many(X).s[[7]])
    tops = many.peaks()
    for i in (0, 7, 39):
        one = conveyor(first[i, 0], velocity[i, 0])
        assert_allclose([values[i] for values in many(X)], one(X), atol=1e-15)
        assert tops.acceleration.value[i] == pytest.approx(one.peaks().acceleration.value)


STEP = Polynomial(80 * deg)


@pytest.mark.parametrize(
    "make",
    [
        lambda h: MatchedProgram(
            (STEP, STEP, Dwell(1.0), Polynomial()), (Boundary(0.0), Boundary(h), Boundary(0.02), Boundary())
        ),
        lambda h: MatchedProgram((STEP, Uniform(h, angle=0.7), Polynomial(), Dwell(1.0))),
        lambda h: MatchedProgram((STEP, Uniform(travel=h, angle=0.7), Polynomial(), Dwell(1.0))),
        lambda h: MatchedProgram((STEP, Rise(0.7, h, SimpleHarmonic()), Polynomial(), Dwell(1.0))),
        lambda h: MatchedProgram((STEP, Uniform(0.6, angle=0.7), Polynomial(), Dwell(1.0)), advance=100 * h),
        lambda h: MatchedProgram(
            (STEP.replace(through=(Through(0.4, s=h),), form="spline"), Dwell(1.0), Polynomial()),
            (Boundary(0.0), Boundary(h / 3), Boundary()),
        ),
    ],
    ids=["level", "velocity", "travel", "lift", "advance", "point"],
)
def test_a_population_whose_angles_are_those_of_one(make):
    levels = np.array([[10.0], [12.0], [np.nan], [14.0]]) * mm
    many = make(levels)
    assert many.possible[:, 0].tolist() == [True, True, False, True]
    for i in (0, 1, 3):
        one = make(float(levels[i, 0]))(X)
        for found, wanted in zip(many(X), one, strict=True):
            assert_allclose(found[i], wanted, rtol=1e-9, atol=1e-12)
    assert np.isnan(many(X).s[2]).all()


CAM = TranslatingRollerCam(motion=conveyor(), base_radius=120 * mm)


def test_paths_are_those_of_parts_and_boundaries():
    quantities = quantities_of(CAM)
    mine = {path.removeprefix("motion."): q.unit for path, q in quantities.items() if path.startswith("motion.")}
    assert mine == {
        "up_start.s": "mm", "up.angle": "deg", "hold.velocity": "mm/rad", "hold.travel": "mm", "dwell.angle": "deg",
    }  # fmt: skip
    moved = with_quantities(CAM, {"motion.up.angle": 65 * deg})
    assert moved.motion.segments[2].angle / deg == pytest.approx(217.6)
    with pytest.raises(ValueError, match=r"it takes up what the other parts leave of the turn"):
        value_of(CAM, "motion.back.angle")
    with pytest.raises(ValueError, match="it is set to 'match'"):
        with_quantities(CAM, {"motion.hold_start.v": 0.1})
    pointed = CAM.replace(motion=lobe((Through(0.5, s=20 * mm),), "spline"))
    assert "motion.lobe.point1.s" in quantities_of(pointed)
    assert with_quantities(pointed, {"motion.lobe.form": "polynomial"}).motion.parts[0].form == "polynomial"
    assert "motion.polynomial.form" not in choices_of(CAM)


@pytest.mark.parametrize(
    ("motion", "changes"),
    [
        (conveyor(), {"up.angle": 66 * deg, "hold.velocity": 0.08}),
        (lobe((Through(0.5, s=20 * mm), Through(0.7, v=-5 * mm)), "spline"), {"lobe.point1.share": 0.4}),
        (lobe((Through(0.4, s=20 * mm, v=0.0),), "polynomial", "match"), {"lobe.point1.s": 25 * mm}),
        (
            MatchedProgram(
                (Polynomial(100 * deg), OpenMove(80 * deg, ShapedLaw(Cycloidal())), Dwell(180 * deg)),
                (Boundary(0.0), Boundary(12 * mm, 0.0, 0.0), Boundary()),
            ),
            {"polynomial.angle": 90 * deg, "open_move.law.c1": 0.1},
        ),
    ],
    ids=["conveyor", "spline", "polynomial", "open move"],
)
def test_a_recorded_program_does_the_same(motion, changes):
    cam = CAM.replace(motion=motion)
    program = record(lambda cam: {f"motion{k}": y for k, y in enumerate(cam.motion(X))}, cam)
    start = {path: value_of(cam, path) for path in program.inputs}
    for changed in ({}, {f"motion.{path}": value for path, value in changes.items()}):
        found, there = program(start | changed), with_quantities(cam, changed).motion(X)
        assert program.refusal(start | changed) == ""
        for k in range(4):
            assert_allclose(found[f"motion{k}"], there[k], atol=1e-12 * max(1.0, abs(there[k]).max()))


def test_an_open_move_whose_law_may_end_anyhow_says_why_it_is_not_recorded():
    law = FreePolynomial(start=(0, 0, 0), end=(1, 0.5, 0))
    parts = (Polynomial(100 * deg), OpenMove(80 * deg, law), Polynomial())
    motion = MatchedProgram(parts, (Boundary(0.0), Boundary(), Boundary(8 * mm)))
    assert motion.segments[1].motion(np.array(1.0)).v == pytest.approx(0.5 * motion.segments[1].lift / (80 * deg))
    assert all(boundary.lawful for boundary in motion.transitions())
    with pytest.raises(CannotRecord, match="whether the law of an open move comes to rest at its ends follows from"):
        record(lambda cam: {"s": cam.motion(X).s}, CAM.replace(motion=motion))


def test_a_recorded_program_refuses_in_the_same_words():
    program = record(lambda cam: {"s": cam.motion(X).s}, CAM)
    start = {path: value_of(CAM, path) for path in program.inputs} | {"motion.up.angle": 350 * deg}
    with pytest.raises(ValueError, match="the other parts take") as refusal:
        with_quantities(CAM, {"motion.up.angle": 350 * deg})
    assert program.refusal(start) == str(refusal.value)
    assert np.isnan(program(start)["s"]).all()


def test_a_file_gives_back_what_was_saved():
    move = (Polynomial(100 * deg), OpenMove(80 * deg, SimpleHarmonic()), Dwell(180 * deg))
    for motion in (
        conveyor(),
        lobe((Through(angle=1.0, s=20 * mm, name="tip"),), "spline"),
        MatchedProgram(move, (Boundary(0.0, name="zero"), Boundary(12 * mm, 0.0, "free"), Boundary(a="free"))),
    ):
        cam = CAM.replace(motion=motion)
        assert from_json(to_json(cam)) == cam
        assert read_json(to_json(cam)).remarks == ()
    damaged = to_json(CAM).replace('"match"', '"mash"', 1)
    with pytest.raises(ValueError, match="it must be a finite number, 'match' or 'free'"):
        from_json(damaged)


def test_a_study_finds_the_best_edge():
    peak = max_pressure_angle
    free = {"motion.up.angle": (45 * deg, 90 * deg)}
    study = Study(CAM, free, [peak], angles=181)
    found = minimise(study)
    best = value_of(found.design, "motion.up.angle")
    tried = [float(peak(with_quantities(CAM, {"motion.up.angle": x * deg}).analyse(181))) for x in range(45, 91, 3)]
    assert float(peak(found.design.analyse(181))) <= min(tried) + 1e-9
    assert 45 * deg <= best <= 90 * deg
    assert all(boundary.lawful for boundary in found.design.motion.transitions())


def test_an_error_of_form_rides_on_it_and_the_second_cam_of_a_pair_takes_it_downwards():
    made = FormError(amplitude=0.01 * mm, waves=12).on(conveyor())
    assert_allclose(made(X).s - conveyor()(X).s, 0.01 * mm * np.cos(12 * X), atol=1e-15)
    moved = with_quantities(CAM.replace(motion=made), {"motion.form.amplitude": 0.0, "motion.up.angle": 65 * deg})
    assert_allclose(moved.motion(X).s, conveyor(65 * deg)(X).s, atol=1e-15)
    assert from_json(to_json(moved)) == moved
    for motion in (conveyor(), lobe((Through(0.5, s=20 * mm),), "spline")):
        for down, up in zip(opposite(motion)(X), motion(X), strict=True):
            assert_allclose(down, -up, atol=1e-14)


def test_a_rough_program_becomes_smooth_and_keeps_its_angles_and_levels():
    law = SimpleHarmonic()
    rough = MotionProgram(
        (Rise(60 * deg, 8 * mm, law), Rise(80 * deg, 12 * mm, law), Return(100 * deg, 20 * mm, law), Dwell(120 * deg))
    )
    assert not any(boundary.lawful for boundary in rough.transitions())
    smooth = matched(rough)
    assert all(boundary.lawful for boundary in smooth.transitions())
    assert smooth.part_names == rough.names
    assert_allclose(smooth.edges, rough.edges)
    assert_allclose(smooth.levels, rough.levels, atol=1e-15)
    assert smooth(140 * deg).v == pytest.approx(0, abs=1e-15)  # it turns back there
    assert smooth(X).s.max() <= 20 * mm * (1 + 1e-12)
    part = matched(MotionProgram((Rise(2.0, 0.02, Cycloidal()), Dwell(1.0))))
    assert_allclose(part([0.0, 2.0]).v, 0, atol=1e-15)


def test_a_rough_motion_that_goes_on_stays_one_and_keeps_its_error_of_form():
    law = SimpleHarmonic()
    for advance, rest in ((0.5, 0.0), (0.5, 0.3), (-0.5, 0.0)):
        move = Rise if advance > 0 else Return
        after = Rise(2 * np.pi - 1, rest, law) if rest else Dwell(2 * np.pi - 1)
        rough = MotionProgram((move(1.0, 0.5, law), after), advance=advance + rest)
        smooth = matched(rough)
        assert smooth.advance == rough.advance
        assert_allclose(smooth.levels, rough.levels, atol=1e-15)
        assert all(boundary.lawful for boundary in smooth.transitions())
    made = FormError(amplitude=1e-5, waves=5).on(MotionProgram((Rise(1.0, 0.02, law), Dwell(1.0))))
    assert matched(made).form == made.form


def test_a_moved_joint_takes_from_its_neighbour_in_every_program():
    law = Cycloidal()
    plain = MotionProgram((Rise(2.0, 0.02, law), Dwell(1.0), Return(2.0, 0.02, law)))
    assert_allclose(plain.with_edge(1, 2.5).edges, [0, 2.5, 3, 5])
    assert_allclose(plain.with_edge(2, 2.5).edges, [0, 2, 2.5, 5])
    with pytest.raises(ValueError, match="transition 1 is to be at 180 deg; it can lie between 0 deg and 171"):
        plain.with_edge(1, np.pi)


POLY = Polynomial(1.0)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: conveyor().with_boundary(0, Boundary()), "the level where up ends is not determined"),
        (
            lambda: conveyor().with_boundary(1, Boundary(v=0.05)),
            "contradict each other: the velocity where hold begins",
        ),
        (lambda: conveyor().with_boundary(3, Boundary(s=0.1)), "contradict each other: the level where .* 0.1 apart"),
        (lambda: conveyor().with_part(3, Dwell(300 * deg)), "the other parts take 377.4 deg of the turn"),
        (lambda: conveyor().replace(boundaries=(Boundary(),)), "1 transitions and 4 parts"),
        (lambda: MatchedProgram(()), "the program is empty"),
        (lambda: MatchedProgram((POLY, 3)), "part 2 of the program is 3"),
        (lambda: MatchedProgram((Polynomial(), Polynomial())), "polynomial and polynomial2 have no angle"),
        (lambda: MatchedProgram((POLY, Dwell(1.0)), rest="x"), "given to x; the parts are polynomial, dwell"),
        (lambda: MatchedProgram((POLY, POLY), (Boundary(0.0), Boundary())), "name the part that takes the rest"),
        (lambda: MatchedProgram((POLY,) * 101), "at most 100"),
        (lambda: MatchedProgram((Polynomial(1.0, name="rest"), Dwell(1.0))), "is called rest"),
        (lambda: Uniform(0.1, -0.1), "a travel of -0.1"),
        (lambda: Uniform(0.1, 0.1, 1.0), "give two of them"),
        (lambda: Through(0.5), "gives nothing"),
        (lambda: Through(s=1.0), "a share or an angle"),
        (lambda: Boundary(s="fee"), "the s of a boundary is 'fee'"),
        (lambda: Polynomial(1.0, form="cubic"), "the form of the polynomial is 'cubic'"),
        (lambda: lobe((Through(0.5, s=0.01), Through(0.4, s=0.02)), "spline"), "one after the other"),
        (
            lambda: MatchedProgram((Polynomial(2.0, (Through(0.5, v=0.1),), name="lobe"), Dwell(2 * np.pi - 2))),
            "the velocity inside lobe cannot be met",
        ),
        (lambda: conveyor().with_part(9, POLY), "the place of the part is 9; it must be a whole number of at most 3"),
        (
            lambda: conveyor().with_boundary(-1, Boundary()),
            "the place of the boundary is -1; it must be a whole number",
        ),
        (lambda: matched(3), "it must be a MotionProgram"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, words):
    with pytest.raises(ValueError, match=words):
        make()


def test_letters_of_rows_stay_those_of_their_law():
    cam = CAM.replace(motion=MotionProgram((Rise(1.0, 0.02, ShapedLaw(Cycloidal())), Dwell(1.0))))
    assert all(len(q.symbol) < 12 for q in quantities_of(cam).values())
