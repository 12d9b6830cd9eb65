"""Windup of the camshaft, against reference values of the full nonlinear equations, and a stiff shaft."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import rpm
from camkit.dynamics import Camshaft
from train_cases import GIVEN, VALUES, A, differs, flat

SHAFT = Camshaft(GIVEN["wind"]["kt"], GIVEN["wind"]["J"], GIVEN["wind"]["ct"])


def test_reference_values():
    windup, expected = SHAFT.windup(flat().analyse(), A), VALUES["windup"]
    assert_allclose(windup.range, [expected["theta_least"], expected["theta_most"]], rtol=1e-7)
    share = windup.speed / (600 * rpm)
    assert_allclose([share.min(), share.max()], [expected["speed_least"], expected["speed_most"]], rtol=0, atol=1e-7)
    response = windup.response
    assert_allclose([response.max_force, response.least_force], [expected["most"], expected["least"]], rtol=1e-7)
    assert differs(response, windup.angle, expected["theta_at"]) < 1e-9
    assert differs(response, response.contact_force, expected["N_at"]) < 1e-4
    assert abs(windup.cam_torque).max() == pytest.approx(expected["torque_peak"], rel=1e-6)


def test_it_keeps_the_equation_of_the_shaft():
    windup = SHAFT.windup(flat().analyse(), A)
    n, speed = len(windup.angle), 600 * rpm
    wave = 1j * np.arange(n // 2 + 1) * speed
    theta = np.fft.rfft(windup.angle)
    bent, turned = (np.fft.irfft(theta * wave**k, n) for k in (2, 1))
    left = SHAFT.inertia * bent + SHAFT.damping * turned + SHAFT.stiffness * windup.angle + windup.cam_torque
    assert abs(left).max() < 1e-5 * abs(windup.cam_torque).max()
    assert_allclose(windup.speed, speed + turned, rtol=1e-9)


def test_a_stiff_shaft_does_not_wind_up():
    stiff = Camshaft(5e6, 0.002, 10.0).windup(flat().analyse(), A)
    assert_allclose(stiff.response.contact_force, A.follow(flat().analyse()).contact_force, rtol=0, atol=0.1)


def test_refusals():
    with pytest.raises(ValueError, match="does not settle at 600 rpm; a shaft of 20 N m/rad is too soft"):
        Camshaft(20.0, 0.002, 0.0).windup(flat().analyse(), A)
    with pytest.raises(ValueError, match="the train has a mass at the cam"):
        SHAFT.windup(flat().analyse(), replace(A, cam_side_mass=0.1))
    with pytest.raises(ValueError, match="is a population"):
        SHAFT.windup(flat(mass=np.array([[1.0], [2.0]])).analyse(), A)
    with pytest.raises(ValueError, match=r"the stiffness .* is -1 N m/rad"):
        Camshaft(-1.0)
