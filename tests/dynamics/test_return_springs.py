"""Real return springs: a published spring, each number by its own formula, and springs tried in their machine."""

import numpy as np
import pytest

from camkit import (
    Cycloidal,
    Dwell,
    MotionProgram,
    MPa,
    OscillatingRollerCam,
    Return,
    Rise,
    TranslatingRollerCam,
    deg,
    mm,
    rpm,
    with_quantities,
)
from camkit.cam import jump_speed
from camkit.data.spring_wires import spring_wires
from camkit.dynamics import (
    ElasticFollower,
    HelicalSpring,
    contact_loss_speed,
    fitted,
    near_surge,
    return_springs,
    spring_agreement,
    spring_duty,
)
from camkit.quantities import measures_of
from train_cases import VALUES, A, flat

CAM = flat()
GRID = {"coils": np.array([20, 25, 31.5, 40]) * mm, "active_coils": [4.0, 6.5, 9.0, 12.0]}


def test_a_spring_between_preload_and_top():
    spring = HelicalSpring(2 * mm, 16 * mm, 6, 8)
    duty = spring_duty(spring, 50.0, 10 * mm)
    most = 50 + 79.3e9 * 0.002**4 / (8 * 0.016**3 * 6) * 0.01
    wahl = (4 * 8 - 1) / (4 * 8 - 4) + 0.615 / 8
    high = wahl * 8 * most * 0.016 / (np.pi * 0.002**3)
    assert duty.largest_force == pytest.approx(most) == pytest.approx(50 + 64.53, abs=0.01)
    assert (duty.max_stress, duty.alternating_stress) == pytest.approx((high, high * (1 - 50 / most) / 2))
    assert duty.mean_stress + duty.alternating_stress == pytest.approx(duty.max_stress)
    assert duty.preload_length == pytest.approx(duty.free_length - 50 / spring.rate)
    left = duty.free_length - most / spring.rate - spring.solid_length
    assert left / (most / spring.rate) == pytest.approx(0.15) == duty.clash_margin
    assert 6 * duty.pitch + 2 * spring.wire == pytest.approx(duty.free_length)


def test_wires():
    wires, music = spring_wires(), spring_wires("ASTM A228")
    assert (np.diff(wires.diameter) > 0).all()
    assert (np.diff(wires.strength) < 0).all()
    assert music.strength[music.diameter == 0.002] == pytest.approx(2211e6 / 2**0.145)
    # music wire is at least as strong as the medium grade of patented wire, and not a third stronger
    assert ((music.strength / wires.strength[: len(music.strength)] - 1) < 0.35).all()
    with pytest.raises(ValueError, match="the spring wire 'gold' is not known; there are EN 10270-1 SM, ASTM A228"):
        spring_wires("gold")


def test_harmonics_near_surge():
    near = near_surge(HelicalSpring(), CAM.analyse())
    assert near.ratio == pytest.approx(VALUES["surge"]["nearest_harmonic"])
    few = near_surge(HelicalSpring(), CAM.replace(load=CAM.load.replace(speed=304.1582 * 2 * np.pi / 3)).analyse())
    assert dict(zip(few.number.tolist(), few.amplitude, strict=True))[5] == pytest.approx(
        VALUES["surge"]["lift_harmonics"]["5"], rel=1e-6
    )


def test_a_spring_holds_the_rigid_follower_to_the_margin_and_no_weaker_one_does():
    found = return_springs(CAM.analyse(), margin=0.2, **GRID)
    for i in (0, len(found) // 2, len(found) - 1):
        held = fitted(CAM, found[i], found.preload[i])
        held = held.replace(load=held.load.replace(mass=2 + found[i].active_mass / 3))
        assert jump_speed(held.analyse()) == pytest.approx(1.2 * 600 * rpm, rel=1e-3) or found.preload[i] == 0


@pytest.mark.parametrize("train", [None, A], ids=["rigid", "elastic"])
def test_springs_are_judged_one_by_one_as_all_at_once(train):
    found, wires = return_springs(CAM.analyse(), train, **GRID), spring_wires()
    assert found.serve.any()
    assert not found.serve.all()
    assert (np.diff(found.duty.largest_force[found.serve]) >= 0).all()
    assert found.serve.sum() == np.argmin([*found.serve, False])
    for i in range(0, len(found), 7):
        spring, shear = found[i], wires.shear[wires.diameter == found.wire[i]][0]
        duty = spring_duty(spring, found.preload[i], 20 * mm)
        assert 4 <= spring.index <= 12
        assert duty.max_stress == pytest.approx(found.duty.max_stress[i])
        good = duty.max_stress <= shear and duty.alternating_stress <= 241e6 and duty.slenderness <= 5.26
        assert found.serve[i] == (good and spring.surge_frequency >= 15 * 10)
    assert "springs serve, the weakest first" in found._repr_html_()


def test_a_spring_holds_the_elastic_train_to_the_margin():
    found = return_springs(CAM.analyse(), A, **GRID)
    for i in (0, 3):
        speed = contact_loss_speed(fitted(CAM, found[i], found.preload[i]).analyse(), A)
        assert speed == pytest.approx(1.15 * 600 * rpm, rel=1e-3)


def test_room_for_a_spring():
    found = return_springs(CAM.analyse(), max_outside=30 * mm, max_length=90 * mm, **GRID)
    assert (found.wire + found.coil)[found.serve].max() <= 30 * mm
    assert found.duty.free_length[found.serve].max() <= 90 * mm


def test_rates_of_load_and_spring_are_compared():
    train = A.replace(spring=HelicalSpring())
    machine = ElasticFollower(CAM, train)
    assert spring_agreement in measures_of(machine)
    assert spring_agreement(machine.analyse(61)) == pytest.approx(VALUES["spring"]["rate"] / 5e3)
    assert spring_agreement(fitted(machine, HelicalSpring(), 300.0).analyse(61)) == pytest.approx(1)


def test_return_spring_refusals():
    for bad, said in [
        ({"margin": -0.1}, "the speed margin is -0.1"),
        ({"coils": [1.0]}, "there are no springs with an index from 4 to 12 in the grid"),
        ({"wire": "gold"}, "the spring wire 'gold' is not known"),
    ]:
        with pytest.raises(ValueError, match=said):
            return_springs(CAM.analyse(), **bad)
    with pytest.raises(ValueError, match="the follower is on an arm"):
        return_springs(OscillatingRollerCam().analyse())
    with pytest.raises(ValueError, match="the cam is at rest"):
        return_springs(CAM.replace(load=CAM.load.replace(speed=0.0)).analyse())
    with pytest.raises(ValueError, match="the preload of the spring is -1; it must be at least 0"):
        spring_duty(HelicalSpring(), -1.0, 0.01)
    with pytest.raises(ValueError, match="it must be below the coil's 4 mm"):
        HelicalSpring(4 * mm, 4 * mm)
    with pytest.raises(ValueError, match="it must be a design that can be analysed"):
        fitted(TranslatingRollerCam().motion, HelicalSpring(), 1.0)


def test_a_long_stroke_at_speed_asks_for_shot_peened_springs():
    """Stress and surge are bound to each other by the stroke: Zimmerli's 241 MPa are too little, 398 MPa are not."""
    push, back = Rise(110 * deg, 40 * mm, Cycloidal()), Return(100 * deg, 40 * mm, Cycloidal())
    cam = TranslatingRollerCam(MotionProgram((push, Dwell(20 * deg), back, Dwell(130 * deg))), 45 * mm, 12 * mm)
    cam = with_quantities(cam.replace(groove=False), {"load.mass": 0.5, "load.speed": 650 * rpm})
    wound, peened = (return_springs(cam.analyse(), margin=0.1, peened=way) for way in (False, True))
    assert not wound.serve.any()
    assert "the alternating stress is endured shot-peened only" in wound.why_not
    serves = peened.duty.alternating_stress[peened.serve]
    assert serves.size
    assert (serves > 241 * MPa).all()
    assert (serves <= 398 * MPa).all()
    assert repr(peened) == f"{serves.size} of 6441 springs serve, the weakest first"
