"""The RSSR linkage against brute-force geometry, special cases with other formulas, and published figures."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from camkit import Measure, Study, minimise
from camkit.geometry import inclination
from camkit.linkage.rssr import RSSR
from camkit.papers.cabin_door import adams_linkage
from camkit.quantities import quantities_of, with_quantities
from camkit.units import deg, mm

EXAMPLE = RSSR(100 * mm, 180 * mm, 110 * mm, 120 * mm, 80 * mm, axis_distance=0.0, axis_angle=90 * deg)

# A slow machine, or draws of which many cannot turn round, say nothing about the linkage.
few = settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)
length = st.floats(40, 200).map(lambda x: round(x, 1) * mm)
offset = st.floats(-200, 200).map(lambda x: round(x, 1) * mm)
linkages = st.builds(
    RSSR,
    crank=length,
    coupler=st.floats(60, 400).map(lambda x: round(x, 1) * mm),
    rocker=length,
    crank_offset=offset,
    rocker_offset=offset,
    axis_distance=st.floats(0, 200).map(lambda x: round(x, 1) * mm),
    axis_angle=st.floats(-180, 180).map(lambda x: round(x, 1) * deg),
)
short_cranks = linkages.map(lambda linkage: linkage.replace(crank=0.15 * linkage.crank))
angles = st.floats(0, 360).map(lambda x: round(x, 1) * deg)
branches = st.sampled_from([1, -1])


def rocker_joint(linkage, phi3):
    """The rocker's ball joint by turning vectors: the axis leans by -L about x, the rocker turns about it."""
    lean = Rotation.from_rotvec([-linkage.axis_angle, 0, 0])
    turn = Rotation.from_rotvec(phi3 * lean.apply([0, 0, 1]))
    root = np.array([linkage.axis_distance, 0, 0]) + linkage.rocker_offset * lean.apply([0, 0, 1])
    return root + turn.apply([linkage.rocker, 0, 0])


def crank_joint(linkage, phi1):
    return Rotation.from_rotvec([0, 0, phi1]).apply([linkage.crank, 0, 0]) + np.array([0, 0, linkage.crank_offset])


@st.composite
def assembled(draw, sizes=linkages, margin=1e-3):
    """A linkage and a crank angle at which its coupler fits, well clear of its limits."""
    linkage, phi1, phi3 = draw(sizes), draw(angles), draw(angles)
    coupler = np.linalg.norm(rocker_joint(linkage, phi3) - crank_joint(linkage, phi1))
    assume(coupler > 10 * mm)
    linkage = linkage.replace(coupler=float(coupler))
    assume(linkage.discriminant(phi1) > margin)
    return linkage, phi1


def brute_force_rocker_angles(linkage, phi1):
    """Every rocker angle at which both ball joints are a coupler apart, by sampling and root finding."""
    lean = Rotation.from_rotvec([-linkage.axis_angle, 0, 0]).as_matrix()
    root = np.array([linkage.axis_distance, 0, 0]) + linkage.rocker_offset * lean[:, 2]
    other = crank_joint(linkage, phi1)

    def gap(phi3):
        across = np.multiply.outer(np.cos(phi3), lean[:, 0]) + np.multiply.outer(np.sin(phi3), lean[:, 1])
        return np.linalg.norm(root + linkage.rocker * across - other, axis=-1) - linkage.coupler

    grid = np.linspace(0, 2 * np.pi, 721)
    return [brentq(gap, grid[i], grid[i + 1], xtol=1e-13) for i in np.flatnonzero(np.diff(np.sign(gap(grid))))]


def same_angle(a, b):
    return np.mod(a - b + np.pi, 2 * np.pi) - np.pi


# The specification's figures, l = (100, 180, 110), s = (120, 80) mm, axes crossing at 90 deg.


def test_closure_of_the_example():
    assert EXAMPLE.closure(0.0) == pytest.approx((1.2, -1, 0.47727273), abs=5e-9)
    assert EXAMPLE.analyse(0.0).discriminant == pytest.approx(2.21221074, abs=5e-9)


@pytest.mark.parametrize(
    ("crank_angle", "branch", "rocker_angle", "alpha1", "alpha2"),
    [
        (0, 1, 237.596379, 63.612200, 34.278908),
        (0, -1, 22.014763, None, 34.278908),
        (60, 1, 195.880281, 43.007712, 44.173619),
    ],
)
def test_angles_of_the_example(crank_angle, branch, rocker_angle, alpha1, alpha2):
    analysis = EXAMPLE.analyse(crank_angle * deg, branch)
    assert np.degrees(analysis.rocker_angle) == pytest.approx(rocker_angle, abs=5e-7)
    assert np.degrees(analysis.rocker_pressure_angle) == pytest.approx(alpha2, abs=6e-7)
    if alpha1:
        assert np.degrees(analysis.crank_pressure_angle) == pytest.approx(alpha1, abs=6e-7)


def test_limits_of_the_example():
    assert np.degrees(EXAMPLE.limit_angles()) == pytest.approx([265.623052, 274.376948], abs=5e-7)
    assert np.degrees(EXAMPLE.possible_crank_angles()) == pytest.approx(np.array([[-85.623052, 265.623052]]), abs=5e-7)
    assert not EXAMPLE.full_turn


def test_the_possible_angles_of_linkages_whose_limits_merge():
    parallelogram = RSSR(100 * mm, 100 * mm, 100 * mm, 0, 0, axis_distance=100 * mm, axis_angle=0.0)
    folded_once = RSSR(300 * mm, 100 * mm, 300 * mm, 0, 0, axis_distance=100 * mm, axis_angle=0.0)
    assembled_once = RSSR(300 * mm, 100 * mm, 100 * mm, 0, 0, axis_distance=100 * mm, axis_angle=45 * deg)
    for turns in (parallelogram, folded_once):
        assert turns.possible_crank_angles() == pytest.approx(np.array([[0, 2 * np.pi]]))
    assert assembled_once.possible_crank_angles().shape == (0, 2)
    folded_inside = RSSR(
        100 * mm, 150 * mm, 50 * mm, 0, 0, axis_distance=100 * mm, axis_angle=0.0
    )  # plane: cosine rule
    assert np.degrees(folded_inside.possible_crank_angles()) == pytest.approx(np.array([[60, 300]]), abs=1e-5)
    stretched_at_0 = RSSR(100 * mm, 150 * mm, 50 * mm, 0, 0, axis_distance=300 * mm, axis_angle=0.0)
    assert stretched_at_0.possible_crank_angles().shape == (0, 2)


def test_the_possible_angles_are_those_at_which_it_can_be_assembled():
    random, declared = np.random.default_rng(3), quantities_of(EXAMPLE)
    everywhere = 2 * np.pi * np.arange(3600) / 3600
    for _ in range(300):
        values = {path: random.uniform(q.low, q.high) * q.factor for path, q in declared.items()}
        linkage = with_quantities(EXAMPLE, values)
        ranges = linkage.possible_crank_angles()
        assert np.diff(ranges).sum() / (2 * np.pi) == pytest.approx(linkage.assembles(everywhere).mean(), abs=2e-3)


# Brute force, identities and finite differences.


@few
@given(linkages, angles)
def test_both_branches_are_what_root_finding_finds(linkage, phi1):
    assume(abs(linkage.discriminant(phi1)) > 1e-3)
    found = brute_force_rocker_angles(linkage, phi1)
    if linkage.discriminant(phi1) < 0:
        assert found == []
        return
    both = [linkage.analyse(phi1, branch).rocker_angle[0] for branch in (1, -1)]
    assert np.sort(both) == pytest.approx(np.sort(found), abs=1e-9)


@few
@given(assembled(), branches)
def test_joints_lie_on_their_circles_one_coupler_apart(position, branch):
    linkage, phi1 = position
    a = linkage.analyse(phi1, branch)
    assert a.crank_joint.shape == a.rocker_joint.shape == (3, 1)
    assert a.crank_joint[:, 0] == pytest.approx(crank_joint(linkage, phi1), abs=1e-15)
    assert a.rocker_joint[:, 0] == pytest.approx(rocker_joint(linkage, a.rocker_angle[0]), abs=1e-15)
    assert np.linalg.norm(a.rocker_joint - a.crank_joint) == pytest.approx(linkage.coupler, abs=1e-9 * mm)
    lengths = np.linalg.norm(np.diff(a.chain[..., 0]), axis=0)
    assert lengths == pytest.approx([linkage.crank, linkage.coupler, linkage.rocker], abs=1e-12)


@few
@given(assembled(), branches)
def test_pressure_angles(position, branch):
    linkage, phi1 = position
    a = linkage.analyse(phi1, branch)
    cosine = linkage.crank / linkage.coupler * np.sqrt(a.discriminant)
    assert np.cos(a.rocker_pressure_angle) == pytest.approx(cosine, abs=1e-12)
    between = inclination(a.crank_motion, a.rocker_motion)
    assert a.crank_pressure_angle + a.rocker_pressure_angle >= between - 1e-12
    h = 1e-6  # the coupler against the way that each joint really goes
    for motion, angle in ((crank_joint, a.crank_pressure_angle), (rocker_joint, a.rocker_pressure_angle)):
        at = phi1 if motion is crank_joint else a.rocker_angle[0]
        way = motion(linkage, at + h) - motion(linkage, at - h)
        cosine = abs(way @ a.coupler_direction[:, 0]) / np.linalg.norm(way)
        assert np.cos(angle) == pytest.approx(cosine, abs=1e-8)
    assert a.crank_transmission_angle + a.crank_pressure_angle == pytest.approx(np.pi / 2)
    assert a.rocker_transmission_angle + a.rocker_pressure_angle == pytest.approx(np.pi / 2)


@few
@given(assembled(margin=0.05), branches)
def test_ratio_and_acceleration_ratio_are_derivatives(position, branch):
    linkage, phi1 = position
    h = 1e-5
    around = phi1 + h * np.array([-2, -1, 0, 1, 2])
    a = linkage.analyse(around, branch)
    first = a.rocker_angle @ [1, -8, 0, 8, -1] / (12 * h)
    second = a.ratio @ [1, -8, 0, 8, -1] / (12 * h)
    size = 1 + abs(a.ratio[2]) ** 3 + abs(a.acceleration_ratio[2])
    assert a.ratio[2] == pytest.approx(first, abs=1e-9 * size)
    assert a.acceleration_ratio[2] == pytest.approx(second, abs=1e-9 * size)


@few
@given(assembled())
def test_branches_are_mirror_images(position):
    """Seen in the plane y = 0 the offsets and the angles change their sign, and one branch becomes the other."""
    linkage, phi1 = position
    mirrored = linkage.replace(crank_offset=-linkage.crank_offset, rocker_offset=-linkage.rocker_offset)
    here, there = linkage.analyse(phi1, 1), mirrored.analyse(-phi1, -1)
    assert same_angle(there.rocker_angle, -here.rocker_angle) == pytest.approx(0, abs=1e-9)
    assert there.ratio == pytest.approx(here.ratio)
    assert there.acceleration_ratio == pytest.approx(-here.acceleration_ratio)


@few
@given(short_cranks, branches)
def test_the_rocker_angle_never_jumps(linkage, branch):
    assume(linkage.full_turn)
    turns = np.linspace(0, 6 * np.pi, 2161)
    angle = linkage.analyse(turns, branch).rocker_angle
    assert 0 <= angle[0] < 2 * np.pi
    assert abs(np.diff(angle)).max() < np.pi
    whole_turns = (angle[720] - angle[0]) / (2 * np.pi)
    assert whole_turns == pytest.approx(round(whole_turns), abs=1e-9)


@few
@given(linkages)
def test_limit_angles_part_the_possible_from_the_impossible(linkage):
    limits = linkage.limit_angles()
    assert len(limits) in (0, 2, 4)
    assert linkage.discriminant(limits) == pytest.approx(0, abs=1e-9)
    turn = np.linspace(0, 2 * np.pi, 7201)
    possible = np.zeros(turn.shape, bool)
    for low, high in linkage.possible_crank_angles():
        assert -np.pi * 2 < low < high <= low + 2 * np.pi
        possible |= np.mod(turn - low, 2 * np.pi) <= high - low
    clear = abs(linkage.discriminant(turn)) > 1e-6
    np.testing.assert_array_equal(possible[clear], (linkage.discriminant(turn) > 0)[clear])
    assume(abs(linkage.discriminant(turn)).min() > 1e-4)
    assert linkage.full_turn == (linkage.discriminant(turn) > 0).all()


def test_a_linkage_can_be_analysed_at_its_limits():
    ends = EXAMPLE.limit_angles()
    for branch in (1, -1):
        a = EXAMPLE.analyse(ends, branch)
        assert np.degrees(a.rocker_pressure_angle) == pytest.approx(90, abs=1e-4)
        assert (abs(a.ratio) > 1e5).all()
    both = [EXAMPLE.analyse(ends, branch).rocker_angle for branch in (1, -1)]
    assert same_angle(*both) == pytest.approx(0, abs=1e-6)


def test_the_sweep_between_its_crank_angles_counts():
    """From 260 to 280 deg there is no assembly in between, which the two ends alone do not show."""
    ends = np.array([260, 280]) * deg
    a = EXAMPLE.analyse(ends)
    assert a.discriminant.min() > 0.01
    fine = EXAMPLE.discriminant(np.linspace(*ends, 20001)).min()
    assert a.min_discriminant == pytest.approx(fine, abs=1e-9)
    assert fine < 0
    sweep = EXAMPLE.analyse(np.linspace(0, 90, 30) * deg)
    assert sweep.min_discriminant == pytest.approx(
        EXAMPLE.discriminant(np.linspace(0, 90, 20001) * deg).min(), abs=1e-9
    )


def test_a_whole_turn_more_changes_no_sweep():
    """From 200 to 300 deg the least discriminant is at 270 deg, from 560 to 660 deg a turn later."""
    for turns in (-2, -1, 0, 1, 3):
        a = EXAMPLE.replace(coupler=200 * mm).analyse(np.array([200, 300]) * deg + 2 * np.pi * turns)
        fine = a.linkage.discriminant(np.linspace(200, 300, 20001) * deg).min()
        assert a.min_discriminant == pytest.approx(fine, abs=1e-9)
        assert fine < a.discriminant.min() - 0.01


def test_positions_too_few_to_measure_a_turn_are_refused():
    """At its ends alone the rocker stands still, and a study would find a swing of 0."""
    turning = EXAMPLE.replace(crank=20 * mm)
    np.testing.assert_array_equal(turning.analyse(61).crank_angle[[0, -1]], [0, 2 * np.pi])
    with pytest.raises(ValueError, match=r"^the number of crank angles is 2; it must be a whole number of at least 61"):
        turning.analyse(2)


# Special cases that have formulas of their own.

crossing = linkages.map(lambda linkage: linkage.replace(axis_distance=0.0))
planar = st.builds(
    RSSR,
    crank=length,
    coupler=length,
    rocker=length,
    crank_offset=st.just(0.0),
    rocker_offset=st.just(0.0),
    axis_distance=length,
    axis_angle=st.just(0.0),
)


@few
@given(assembled(planar))
def test_a_planar_four_bar_by_the_meeting_of_two_circles(position):
    linkage, phi1 = position
    found = [linkage.analyse(phi1, branch).rocker_joint[:2, 0] for branch in (1, -1)]
    joint = linkage.crank * np.array([np.cos(phi1), np.sin(phi1)])
    line = np.array([linkage.axis_distance, 0]) - joint
    distance = np.hypot(*line)
    along = (linkage.coupler**2 - linkage.rocker**2 + distance**2) / (2 * distance)
    across = np.sqrt(linkage.coupler**2 - along**2)
    meeting = [joint + (along * line + side * across * np.array([-line[1], line[0]])) / distance for side in (1, -1)]
    apart = np.linalg.norm(np.subtract.outer(found, meeting).diagonal(axis1=1, axis2=3), axis=-1)
    assert np.sort(apart, axis=None)[:2] == pytest.approx(0, abs=1e-9)
    assert apart.min(0) == pytest.approx(0, abs=1e-9)


@few
@given(planar)
def test_a_planar_crank_turns_fully_by_grashof(linkage):
    """Grashof: with shortest + longest less than the others, crank or frame must be the shortest."""
    links = np.array([linkage.crank, linkage.coupler, linkage.rocker, linkage.axis_distance])
    s, p, q, l = np.sort(links)
    assume(abs(s + l - p - q) > 0.1 * mm)
    assume(np.sum(links == s) == 1)
    can_turn = s + l < p + q and s in (linkage.crank, linkage.axis_distance)
    assert bool(linkage.full_turn) == can_turn
    reach = links @ [[1, -1, -1, 1], [1, 1, 1, -1]][0] < 0, abs(links[0] - links[3]) > abs(links[1] - links[2])
    assert can_turn == (reach[0] and reach[1])


def test_a_parallelogram_may_fold_and_still_goes_round():
    parallelogram = RSSR(50 * mm, 120 * mm, 50 * mm, 0.0, 0.0, axis_distance=120 * mm, axis_angle=0.0)
    turn = np.linspace(0, 2 * np.pi, 73)
    assert not parallelogram.full_turn
    assert parallelogram.analyse(turn).min_discriminant == pytest.approx(0, abs=1e-12)


@few
@given(assembled(crossing), branches, st.floats(0.3, 3), st.floats(0.3, 3))
def test_a_spherical_four_bar_where_the_axes_cross(position, branch, first, second):
    """Both joints move on spheres about the crossing, a constant angle apart: radii do not matter, angles do."""
    linkage, phi1 = position
    a = linkage.analyse(phi1, branch)
    one, other = np.hypot(linkage.crank, linkage.crank_offset), np.hypot(linkage.rocker, linkage.rocker_offset)
    cosine = (one**2 + other**2 - linkage.coupler**2) / (2 * one * other)
    b, c = a.crank_joint[:, 0] / one, a.rocker_joint[:, 0] / other
    assert b @ c == pytest.approx(cosine, abs=1e-9)
    one, other = first * one, second * other
    scaled = linkage.replace(
        crank=first * linkage.crank,
        crank_offset=first * linkage.crank_offset,
        rocker=second * linkage.rocker,
        rocker_offset=second * linkage.rocker_offset,
        coupler=np.sqrt(one**2 + other**2 - 2 * one * other * cosine),
    ).analyse(phi1, branch)
    assert same_angle(scaled.rocker_angle, a.rocker_angle) == pytest.approx(0, abs=1e-8)
    assert scaled.ratio == pytest.approx(a.ratio, rel=1e-7)


def test_a_universal_joint_is_a_quarter_turn_on_a_sphere():
    """Arms at 90 deg to their axes and to each other, axes at an angle: ``tan(phi_3) tan(phi_1) = -1 / cos L``.

    (Hooke's joint with both angles from the common normal of the axes.)
    """
    arm, bend = 30 * mm, 20 * deg
    joint = RSSR(arm, np.sqrt(2) * arm, arm, 0.0, 0.0, axis_distance=0.0, axis_angle=bend)
    phi1 = np.linspace(5, 85, 17) * deg
    a = joint.analyse(phi1)
    assert np.tan(a.rocker_angle) * np.tan(phi1) == pytest.approx(-1 / np.cos(bend) * np.ones(17))
    speed = np.cos(bend) / (1 - np.sin(phi1) ** 2 * np.sin(bend) ** 2)
    assert a.ratio == pytest.approx(speed)
    assert joint.full_turn


# Published figures.

ADAMS = {0: (1.71, 1.16), 1: (1.69, 1.13), 5: (1.61, 1.02), 20: (1.39, 0.683), 60: (None, 0.0103)}
"""ADAMS run beside Mech. Mach. Theory 142 (2019) 106163: crank turn [deg] -> alpha_c [rad], inverse torque ratio."""


def rocker_turned(turned):
    """``alpha_c`` of that RSSR, rad, without any linkage of ours: ``|D - A + C| = B``, solved near 1.71 rad.

    Crank A = 201.6318 from the origin turns clockwise about e1 by ``turned`` (rad); frame D = 403.1627; rocker
    C = 201.6318 from the end of D turns about x; coupler B = 350 between their ends, all mm.
    """
    theta = np.radians(7.294)
    e1 = np.array([0.009243, -0.951003, 0.309043])
    d = 403.1627 * np.array([0.524328, 0.835662, -0.163552])
    a = 201.6318 * np.array([-0.379646, 0.400777, 0.833815])
    a = Rotation.from_rotvec(-turned * e1 / np.linalg.norm(e1)).apply(a)

    def gap(alpha):
        c = [-np.sin(theta), np.cos(theta) * np.cos(alpha), np.cos(theta) * np.sin(alpha)]
        return np.linalg.norm(d - a + 201.6318 * np.array(c)) - 350

    return brentq(gap, 0.8, 2.2, xtol=1e-14)


@pytest.mark.parametrize("turned", ADAMS)
def test_an_adams_run(turned):
    """The vectors turned directly against the linkage that camkit makes of them, and against what is printed."""
    linkage, crank_zero, rocker_zero = adams_linkage()
    a = linkage.analyse(crank_zero - turned * deg)
    alpha_c = rocker_turned(turned * deg)
    h = 1e-5
    slope = (rocker_turned(turned * deg + h) - rocker_turned(turned * deg - h)) / (2 * h)
    assert same_angle(a.rocker_angle[0], rocker_zero) == pytest.approx(alpha_c, abs=1e-9)
    assert -a.ratio[0] == pytest.approx(slope, abs=1e-8)  # the crank turns clockwise
    printed_angle, printed_ratio = ADAMS[turned]
    assert printed_angle is None or float(f"{alpha_c:.2f}") == printed_angle
    assert float(f"{-slope:.3g}") == printed_ratio


def test_the_adams_run_by_other_hands():
    """Angles and slopes of the same equation, computed apart."""
    turned = np.radians(list(ADAMS))
    assert [rocker_turned(t) for t in turned[:4]] == pytest.approx([1.7073, 1.6872, 1.6123, 1.3921], abs=6e-5)
    slopes = [(rocker_turned(t + 1e-5) - rocker_turned(t - 1e-5)) / 2e-5 for t in turned]
    assert slopes == pytest.approx([-1.1646, -1.1328, -1.0174, -0.6828, -0.01026], abs=6e-5)


def test_the_printed_closure_holds_at_right_angles_only():
    """Liu, Geng print ``s_0 s_3 cos L`` over ``l_3`` alone; ours has ``l_1 l_3`` below it (lengths in m)."""

    def printed_gap(linkage, phi1):
        phi3 = linkage.analyse(phi1).rocker_angle[0]
        a, b, k = linkage.closure(phi1)
        last = linkage.crank_offset * linkage.rocker_offset * np.cos(linkage.axis_angle) / linkage.rocker
        return a * np.sin(phi3) + b * np.cos(phi3) + k + last / linkage.crank - last

    assert printed_gap(EXAMPLE, 1.0) == pytest.approx(0, abs=1e-12)
    assert abs(printed_gap(EXAMPLE.replace(axis_angle=80 * deg), 1.0)) > 0.1


# Populations and refusals.


def test_a_population_is_its_members():
    rng = np.random.default_rng(2)
    p, sweep = 40, np.linspace(15, 105, 30) * deg
    columns = rng.uniform([60, 60, 60, -50, -50, 0], [150, 250, 150, 150, 150, 60], (p, 6)).T[..., None] * mm
    axis_angle = rng.uniform(20, 160, (p, 1)) * deg
    together = RSSR(*columns, axis_angle=axis_angle)
    a = together.analyse(sweep)
    can = a.buildable[:, 0]
    assert 5 < can.sum() < 35
    assert np.isfinite(a.discriminant).all()
    assert np.isfinite(a.min_discriminant).all()
    names = ("rocker_angle", "crank_pressure_angle", "ratio", "acceleration_ratio", "crank_torque", "coupler_force")
    vectors = ("crank_joint", "rocker_joint", "rocker_bearing_force", "rocker_bearing_moment", "crank_bearing_moment")
    for name in names:
        assert getattr(a, name).shape == (p, 30)
    for name in vectors:
        assert getattr(a, name).shape == (3, p, 30)
    for i in range(p):
        one = RSSR(*(float(c[i, 0]) for c in columns), axis_angle=float(axis_angle[i, 0]))
        limits = together.limit_angles()[i]
        assert limits[np.isfinite(limits)] == pytest.approx(one.limit_angles(), abs=1e-9)
        assert together.full_turn[i] == one.full_turn
        if not can[i]:
            assert np.isnan([getattr(a, name)[i] for name in names]).all()
            with pytest.raises(ValueError, match="cannot be assembled"):
                one.analyse(sweep)
            continue
        alone = one.analyse(sweep)
        assert alone.min_discriminant == pytest.approx(a.min_discriminant[i])
        for name in names:
            assert getattr(a, name)[i] == pytest.approx(getattr(alone, name), rel=1e-9, abs=1e-12)
        for name in vectors:
            assert getattr(a, name)[:, i] == pytest.approx(getattr(alone, name), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("field", ["crank", "coupler", "rocker", "axis_distance"])
def test_a_member_with_an_impossible_size_is_nan_and_disturbs_nobody(field):
    size = getattr(EXAMPLE, field)
    a = EXAMPLE.replace(**{field: np.array([[size], [-10 * mm], [np.nan]])}).analyse([0, 60 * deg])
    assert np.isfinite(a.rocker_angle[0]).all()
    assert np.isnan(a.rocker_angle[1:]).all()


def test_a_population_of_one_is_not_refused():
    a = EXAMPLE.replace(crank=np.array([[100 * mm]])).analyse(270 * deg)
    assert np.isnan(a.rocker_angle).all()


@pytest.mark.parametrize(
    ("linkage", "crank_angle", "sentence"),
    [
        (
            EXAMPLE,
            270 * deg,
            "at a crank angle of 270 deg the linkage cannot be assembled; possible are -85.623 to 265.62 deg",
        ),
        (
            EXAMPLE,
            np.linspace(180, 360, 181) * deg,
            "at a crank angle of 266 deg the linkage cannot be assembled; possible are -85.623 to 265.62 deg",
        ),
        (
            EXAMPLE.replace(coupler=290 * mm),
            0.0,
            "at a crank angle of 0 deg the linkage cannot be assembled; possible are 215.56 to 324.44 deg",
        ),
        (
            EXAMPLE.replace(
                axis_distance=100 * mm, axis_angle=0.0, rocker=65 * mm, coupler=60 * mm, rocker_offset=0.12
            ),
            0.0,
            "at a crank angle of 0 deg the linkage cannot be assembled; "
            "possible are 2.8651 to 77.364 and 282.64 to 357.13 deg",
        ),
        (
            EXAMPLE.replace(coupler=600 * mm),
            0.0,
            "the coupler of 600 mm cannot be assembled at any crank angle; "
            "from crank to rocker it is 20.19 to 292.22 mm",
        ),
        (EXAMPLE, [], "the crank angles must be one or more finite numbers"),
        (EXAMPLE, [0.0, np.nan], "the crank angles must be one or more finite numbers"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(linkage, crank_angle, sentence):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011
        linkage.analyse(crank_angle)
    assert str(refusal.value) == sentence


def test_other_refusals():
    with pytest.raises(ValueError, match=r"^the branch is 2; it must be \+1 or -1$"):
        EXAMPLE.analyse(0.0, branch=2)
    with pytest.raises(
        ValueError,
        match=r"^the crank \(crank: axis to ball joint\) is -5 mm; it must be a finite number above 0 mm$",
    ):
        RSSR(crank=-5 * mm)
    with pytest.raises(ValueError, match="axis distance"):
        RSSR(axis_distance=-1 * mm)


def test_a_bare_linkage_in_a_study_turns_all_the_way_round():
    """The swing over a turn at 20 and 60 mm of crank; one of 100 mm cannot turn round."""
    whole = Measure("swing", "deg", lambda a: np.ptp(a.rocker_angle, axis=-1))
    study = Study(RSSR(), {"crank": (20 * mm, 60 * mm)}, (whole,))
    evaluation = study.evaluate([[20 * mm], [60 * mm], [100 * mm]])
    assert evaluation.f[:, 0] / deg == pytest.approx([23.462, 67.520, np.inf], abs=1e-3)
    assert evaluation.feasible.tolist() == [True, True, False]
    best = minimise(study)
    assert (best.x[0] / mm, best.f / deg) == pytest.approx((20, 23.462), abs=1e-3)
    a = RSSR(crank=20 * mm).analyse(73)
    assert a.crank_angle == pytest.approx(np.arange(73) * 5 * deg)
    assert a.rocker_angle == pytest.approx(RSSR(crank=20 * mm).analyse(np.arange(73) * 5 * deg).rocker_angle)
    with pytest.raises(ValueError, match=r"^the crank cannot sweep from 0 to 360 deg: the linkage can be assembled"):
        RSSR().analyse()


@pytest.mark.parametrize("angles", ["a", None, [[1], [1, 2]], [], np.nan])
def test_crank_angles_that_are_no_numbers_are_refused(angles):
    with pytest.raises(ValueError, match=r"^the crank angles must be one or more finite numbers$"):
        RSSR().analyse(angles)
