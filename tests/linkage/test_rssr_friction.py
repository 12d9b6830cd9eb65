"""Friction of the RSSR linkage against the equilibrium of every link, solved as it stands, and the power it takes."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import root

from camkit.linkage import RSSR, LinkageFriction, RockerLoad
from camkit.units import deg, mm

LINKAGES = (
    RSSR(100 * mm, 180 * mm, 110 * mm, 120 * mm, 80 * mm, 0.0, 90 * deg),
    RSSR(60 * mm, 140 * mm, 110 * mm, 40 * mm, -30 * mm, 90 * mm, 55 * deg),
    RSSR(50 * mm, 130 * mm, 90 * mm, 0.0, 0.0, 120 * mm, 0.0),
)
FAR = 9.0
SWEEP = np.linspace(15, 105, 7) * deg
FRICTION = LinkageFriction(0.2, 8 * mm, 60 * mm, 0.15, 12 * mm, 0.1, 10 * mm, 90 * mm)
HEAVY = RockerLoad(30, 400 * mm, 300 * mm, 20 * deg, 10 * deg, 75 * deg, torque=12)
few = settings(max_examples=40, deadline=None)
share = st.floats(0, 0.25).map(lambda x: round(x, 3))
frictions = st.builds(
    LinkageFriction,
    crank_coefficient=share,
    ball_coefficient=share,
    rocker_coefficient=share,
    crank_spacing=st.sampled_from([40 * mm, 200 * mm]),
    rocker_spacing=st.sampled_from([60 * mm, 1.0]),
)
loads = st.builds(
    RockerLoad, mass=st.sampled_from([0.0, 20.0]), lean=st.sampled_from([0.0, 0.3, 1.5]), torque=st.floats(-30, 30)
)


def analysed(linkage, load, friction, i=0, sense=1, branch=1):
    return linkage.analyse(SWEEP[i], branch, load, friction, turning=sense)


def by_equilibrium(linkage, load, friction, angle, sense, branch, start):
    """Force of the coupler on the rocker and crank torque: eight balances of three bodies, solved numerically.

    Velocities are differences of places.
    """
    h = 1e-6
    here, *near = (linkage.analyse(angle + x, branch, load) for x in (0, -h, h))
    b, c = here.crank_joint[:, 0], here.rocker_joint[:, 0]
    vb, vc = (sense * (near[1].chain[:, i, 0] - near[0].chain[:, i, 0]) / (2 * h) for i in (1, 2))
    rate = sense * (near[1].rocker_angle[0] - near[0].rocker_angle[0]) / (2 * h)
    k1, k3, weight = linkage.crank_axis, linkage.rocker_axis, here.weight[:, 0]
    root1, root3, centre = linkage.crank_root, linkage.rocker_root, here.centre_of_gravity[:, 0]
    across, along = np.cross(c - b, vc - vb) / linkage.coupler**2, (c - b) / linkage.coupler

    def rubs(force, slip):
        ball = friction.ball_coefficient * friction.ball_radius * np.linalg.norm(force)
        return ball * slip / np.linalg.norm(slip)

    def hinge(k, mu, pin, spacing, force, moment, turning):
        moment = moment - k * (k @ moment)
        couple = np.cross(moment, k) / spacing
        bears = np.linalg.norm(force / 2 + couple) + np.linalg.norm(force / 2 - couple)
        return -np.sign(turning) * mu * pin * bears

    def unbalanced(x):
        at_b, at_c, spin, torque = x[:3], x[3:6], x[6], x[7]  # forces on the coupler
        turning = across + spin * along
        on_crank, on_rocker = rubs(at_b, turning - sense * k1), rubs(at_c, turning - rate * k3)
        force1, force3 = at_b, at_c - weight  # of the frame
        moment1 = np.cross(b - root1, at_b) - on_crank
        moment3 = np.cross(c - root3, at_c) - on_rocker - np.cross(centre - root3, weight)
        f = friction
        h1 = hinge(k1, f.crank_coefficient, f.crank_pin, f.crank_spacing, force1, moment1, sense)
        h3 = hinge(k3, f.rocker_coefficient, f.rocker_pin, f.rocker_spacing, force3, moment3, rate)
        return np.concatenate(
            [at_b + at_c, np.cross(c - b, at_c) - on_crank - on_rocker, [k1 @ -moment1 + torque + h1],
             [k3 @ -moment3 - load.torque + h3]]
        )  # fmt: skip

    found = root(unbalanced, np.concatenate([start, -start, [0.1, 1.0]]), tol=1e-12)
    return -found.x[3:6], found.x[7], found.x[6], abs(found.fun).max()


@few
@given(
    st.sampled_from(LINKAGES), loads, frictions, st.integers(0, 6), st.sampled_from([1, -1]), st.sampled_from([1, -1])
)
def test_every_body_is_in_equilibrium(linkage, load, friction, i, sense, branch):
    assume(not friction.none)
    a = analysed(linkage, load, friction, i, sense, branch)
    assume(not a.rubbing.jams[0] and np.linalg.norm(a.push[:, 0]) > 1)
    push, torque, spin, missed = by_equilibrium(linkage, load, friction, SWEEP[i], sense, branch, a.push[:, 0])
    assume(missed < 1e-8)  # the solver of eight equations has found its way
    assert_allclose(a.push[:, 0], push, rtol=1e-5, atol=1e-5)
    assert a.crank_torque[0] == pytest.approx(torque, rel=1e-5, abs=1e-6)
    if friction.ball_coefficient > 0:
        assert (a.coupler_direction * a.rubbing.coupler_turning).sum(0)[0] == pytest.approx(spin, abs=1e-4)


@few
@given(st.sampled_from(LINKAGES), loads, frictions, st.sampled_from([1, -1]), st.sampled_from([1, -1]))
def test_power_in_is_power_out_and_what_the_joints_take(linkage, load, friction, sense, branch):
    a = linkage.analyse(SWEEP[::sense], branch, load, friction)
    moves = ~a.rubbing.jams
    taken = a.rubbing.driving_torque - a.sense * a.resisting_torque * a.ratio
    assert_allclose(taken[moves], a.rubbing.loss[moves], atol=1e-9)
    assert (a.rubbing.loss >= 0).all()
    assert np.isinf(a.crank_torque[~moves]).all()


def test_the_spin_is_that_of_the_least_loss():
    a = LINKAGES[1].analyse(SWEEP, 1, HEAVY, FRICTION)
    u, r = a.coupler_direction, a.rubbing
    spins = np.linspace(-2, 2, 4001)[:, None]
    loss = sum(np.linalg.norm(slip[:, None] + spins * u[:, None], axis=0) for slip in (r.crank_slip, r.rocker_slip))
    assert abs(spins[np.argmin(loss, axis=0), 0]).max() < 2e-3


@pytest.mark.parametrize("linkage", LINKAGES)
def test_little_friction_is_none_and_a_reversal_turns_its_sign(linkage):
    plain = linkage.analyse(SWEEP, 1, HEAVY)
    for sense in (1, -1):
        little = np.array([[1e-6], [2e-6]])
        rubs = FRICTION.replace(crank_coefficient=little, ball_coefficient=little, rocker_coefficient=little)
        tiny = linkage.analyse(SWEEP, 1, HEAVY, rubs, turning=sense).crank_torque
        assert_allclose(tiny[0], plain.crank_torque, atol=1e-3)
        first, second = sense * (tiny - plain.crank_torque)
        assert (first > 0).all()
        assert_allclose(second, 2 * first, rtol=1e-3)
    forth, back = (linkage.analyse(angles, 1, HEAVY, FRICTION) for angles in (SWEEP, SWEEP[::-1]))
    assert (forth.crank_torque > back.crank_torque[::-1]).all()
    assert_allclose(back.at(SWEEP[3]).crank_torque, back.crank_torque[3], rtol=1e-9)
    assert_allclose(forth.frictionless.crank_torque, plain.crank_torque)


def test_a_hand_sum():
    """A planar parallelogram: 10 N m at 0.1 m pull with 100 N; each hinge and each ball joint takes 1 mm of it."""
    linkage = RSSR(100 * mm, 200 * mm, 100 * mm, 0.0, 0.0, 200 * mm, 0.0)
    rubs = LinkageFriction(0.1, 10 * mm, FAR, 0.1, 10 * mm, 0.1, 10 * mm, FAR)
    both = (linkage.analyse(90 * deg, branch, RockerLoad(mass=0, torque=10), rubs) for branch in (1, -1))
    a = min(both, key=lambda a: abs(a.rocker_angle[0] - np.pi / 2))
    # the coupler does not turn: of each link both joints rub with 1 mm, against its own 100 mm
    force = 10 / 0.098
    assert abs(a.push[0, 0]) == pytest.approx(force, rel=2e-4)
    assert a.crank_torque == pytest.approx(0.102 * force, rel=2e-4)
    assert a.rubbing.efficiency == pytest.approx(0.098 / 0.102, rel=2e-4)


def test_self_locking_and_jams():
    """More and more friction: what the load drives comes to rest, then the crank cannot drive the load either."""
    linkage, load = LINKAGES[0], RockerLoad(mass=0, torque=10)
    mu = np.array([[0.0], [0.1], [0.5], [4.0], [20.0]])
    rubs = LinkageFriction(mu, 10 * mm, 100 * mm, mu, 10 * mm, mu, 10 * mm, 100 * mm)
    drives, helps = (linkage.analyse(60 * deg, 1, load, rubs, turning=sense) for sense in (-1, 1))
    assert drives.resisting_torque[0] * drives.ratio[0, 0] * -1 > 0
    assert list(drives.rubbing.jams[:, 0]) == [False, False, False, False, True]
    assert np.isposinf(drives.rubbing.driving_torque[4:]).all()
    torque, efficiency = helps.rubbing.driving_torque[:, 0], helps.rubbing.efficiency[:, 0]
    assert torque[0] < torque[1] < torque[2] < 0 < torque[3] < torque[4] < np.inf
    assert efficiency[0] == pytest.approx(1)
    assert 1 > efficiency[1] > efficiency[2] > 0 > efficiency[3]
    assert drives.rubbing.efficiency[4, 0] == 0
    jammed = linkage.analyse(SWEEP[::-1], 1, load, LinkageFriction(rocker_coefficient=50.0, ball_coefficient=20.0))
    assert jammed.trouble.startswith("friction jams the linkage, at a crank angle of ")
    assert linkage.analyse(SWEEP, 1, load, FRICTION).trouble == linkage.analyse(SWEEP, 1, load).trouble == ""
    assert all(low < high for low, high in pairwise(drives.rubbing.driving_torque[:, 0]))


def test_a_population_is_each_of_its_members():
    mu = np.array([[0.0], [0.1], [0.2]])
    together = LINKAGES[1].analyse(SWEEP, -1, HEAVY, FRICTION.replace(ball_coefficient=mu))
    for i, each in enumerate(mu[:, 0]):
        one = LINKAGES[1].analyse(SWEEP, -1, HEAVY, FRICTION.replace(ball_coefficient=float(each)))
        assert_allclose(together.crank_torque[i], one.crank_torque, rtol=1e-12)
        assert_allclose(together.rocker_bearing_moment[:, i], one.rocker_bearing_moment, rtol=1e-9, atol=1e-9)


def test_refusals():
    with pytest.raises(ValueError, match=r"^the way the crank turns is 0; it must be \+1 or -1"):
        LINKAGES[0].analyse(1.0, turning=0)
    with pytest.raises(ValueError, match=r"^the friction is 0.1; it must be a LinkageFriction$"):
        LINKAGES[0].analyse(1.0, friction=0.1)
