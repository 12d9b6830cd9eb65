"""Static forces: every link in equilibrium, power in = power out, and the weight from the height of its centre."""

import numpy as np
import pytest

from camkit.linkage.load import RockerLoad
from camkit.linkage.rssr import RSSR
from camkit.units import deg, mm

SWEEP = np.linspace(15, 105, 31) * deg
LOADS = {
    "torque": RockerLoad(mass=0, torque=25),
    "upright door": RockerLoad(mass=30, reach=400 * mm, rise=-250 * mm, torque=0),
    "heeling ship": RockerLoad(30, 400 * mm, 300 * mm, mass_angle=20 * deg, lean=10 * deg, downhill=75 * deg),
    "hatch": RockerLoad(40, 350 * mm, 50 * mm, mass_angle=-50 * deg, lean=90 * deg, downhill=-120 * deg, torque=-6),
    "hanging": RockerLoad(12, 200 * mm, lean=160 * deg, downhill=10 * deg, torque=3),
}
LINKAGES = {
    "crossing": RSSR(100 * mm, 180 * mm, 110 * mm, 120 * mm, 80 * mm, 0.0, 90 * deg),
    "skew": RSSR(60 * mm, 140 * mm, 110 * mm, 40 * mm, -30 * mm, 90 * mm, 55 * deg),
    "planar": RSSR(50 * mm, 130 * mm, 90 * mm, 0.0, 0.0, 120 * mm, 0.0),
}
every_case = pytest.mark.parametrize("load", LOADS.values(), ids=LOADS)
every_linkage = pytest.mark.parametrize("linkage", LINKAGES.values(), ids=LINKAGES)
both_branches = pytest.mark.parametrize("branch", [1, -1])


def at(analysis, vector):
    """A vector of the design at every crank angle."""
    return np.broadcast_to(np.reshape(vector, (3, 1)), (3, analysis.crank_angle.size))


def moment(point, about, force):
    return np.cross(point - about, force, axis=0)


@every_case
@every_linkage
@both_branches
def test_every_link_is_in_equilibrium(linkage, load, branch):
    a = linkage.analyse(SWEEP, branch, load)
    push = a.coupler_force * (a.rocker_joint - a.crank_joint) / linkage.coupler  # of the coupler on the rocker
    size = 1 + abs(a.coupler_force).max() + abs(a.weight).max()

    rocker_forces = push + a.weight + a.rocker_bearing_force
    assert rocker_forces == pytest.approx(0, abs=1e-12 * size)
    crank_forces = -push + a.crank_bearing_force
    assert crank_forces == pytest.approx(0, abs=1e-12 * size)

    # about a point that belongs to neither link
    about = at(a, [0.3, -0.2, 0.1])
    rocker_axis, crank_axis = at(a, linkage.rocker_axis), at(a, linkage.crank_axis)
    rocker_moments = (
        moment(a.rocker_joint, about, push)
        + moment(a.centre_of_gravity, about, a.weight)
        + moment(at(a, linkage.rocker_root), about, a.rocker_bearing_force)
        + a.rocker_bearing_moment
        - load.torque * rocker_axis
    )
    assert rocker_moments == pytest.approx(0, abs=1e-12 * size)
    crank_moments = (
        moment(a.crank_joint, about, -push)
        + moment(at(a, linkage.crank_root), about, a.crank_bearing_force)
        + a.crank_bearing_moment
        + a.crank_torque * crank_axis
    )
    assert crank_moments == pytest.approx(0, abs=1e-12 * size)

    # a turning joint carries no moment about its own axis
    assert (a.rocker_bearing_moment * rocker_axis).sum(0) == pytest.approx(0, abs=1e-12 * size)
    assert (a.crank_bearing_moment * crank_axis).sum(0) == pytest.approx(0, abs=1e-12 * size)


@every_case
@every_linkage
def test_power_in_is_power_out(linkage, load):
    a = linkage.analyse(SWEEP, 1, load)
    assert a.crank_torque == pytest.approx(a.resisting_torque * a.ratio, abs=1e-10)


@every_case
@every_linkage
@both_branches
def test_the_crank_works_against_height_and_constant_torque(linkage, load, branch):
    """Work of the crank over a short turn is what the centre of gravity gains in height, and the torque's work."""
    h = 1e-5
    a, before, after = (linkage.analyse(SWEEP + shift, branch, load) for shift in (0, -h, h))
    up = -a.weight
    lifted = (up * (after.centre_of_gravity - before.centre_of_gravity)).sum(0)
    turned = after.rocker_angle - before.rocker_angle
    assert a.crank_torque == pytest.approx((lifted + load.torque * turned) / (2 * h), abs=1e-6)


@every_linkage
def test_the_hinge_leans_and_slopes_as_declared(linkage):
    load = LOADS["heeling ship"]
    a = linkage.analyse(SWEEP, 1, load)
    assert np.linalg.norm(a.weight, axis=0) == pytest.approx(30 * 9.81)
    up = -a.weight[:, 0] / (30 * 9.81)
    assert np.arccos(up @ linkage.rocker_axis) == pytest.approx(10 * deg)
    everywhere = np.linspace(0, 2 * np.pi, 3601)
    height = up @ linkage.rocker_direction(everywhere)
    assert everywhere[np.argmin(height)] == pytest.approx(75 * deg, abs=1e-3)
    root = linkage.rocker_root[:, None]
    along = linkage.rocker_axis @ (a.centre_of_gravity - root)
    assert along == pytest.approx(300 * mm)
    assert np.linalg.norm(a.centre_of_gravity - root, axis=0) == pytest.approx(500 * mm)


def test_an_upright_hinge_feels_no_weight_but_its_bearing_does():
    a = LINKAGES["crossing"].analyse(SWEEP, 1, LOADS["upright door"])
    assert a.coupler_force == pytest.approx(0, abs=1e-9)
    assert a.crank_torque == pytest.approx(0, abs=1e-9)
    assert np.linalg.norm(a.rocker_bearing_force, axis=0) == pytest.approx(30 * 9.81)
    assert np.linalg.norm(a.rocker_bearing_moment, axis=0) == pytest.approx(30 * 9.81 * 0.4)


def test_a_hand_sum():
    """Planar parallelogram, crank and rocker upright: 10 N m on a rocker of 0.1 m is a pull of 100 N."""
    linkage = RSSR(100 * mm, 200 * mm, 100 * mm, 0.0, 0.0, 200 * mm, 0.0)
    a = min(
        (linkage.analyse(90 * deg, branch, LOADS["torque"].replace(torque=10)) for branch in (1, -1)),
        key=lambda a: abs(a.rocker_angle - np.pi / 2),
    )
    assert a.rocker_angle == pytest.approx(np.pi / 2)
    assert a.coupler_force == pytest.approx(-100)  # the rocker's joint is pulled towards -x
    assert a.crank_torque == pytest.approx(10)


def test_a_population_of_loads():
    linkage = LINKAGES["skew"]
    heel = np.array([[0.0], [10.0], [20.0]]) * deg
    together = linkage.analyse(SWEEP, 1, RockerLoad(lean=heel, rise=100 * mm))
    for i, lean in enumerate(heel[:, 0]):
        one = linkage.analyse(SWEEP, 1, RockerLoad(lean=float(lean), rise=100 * mm))
        assert together.crank_torque[i] == pytest.approx(one.crank_torque)
        assert together.rocker_bearing_moment[:, i] == pytest.approx(one.rocker_bearing_moment)


def test_a_load_refuses_a_mass_below_nothing():
    with pytest.raises(ValueError, match=r"^the mass \(.*\) is -1 kg; it must be a finite number of at least 0 kg$"):
        RockerLoad(mass=-1)
