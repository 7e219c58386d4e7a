"""Truth: the paper's printed forms, virtual work, and the classical efficiency of a screw."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import transmission

from .numbers import AXIAL_LOAD, CURVATURE_RATIO, LEAD, LOADED_BALLS, PITCH_CIRCLE_DIAMETER

RELATIVE = 1e-13


@pytest.mark.equation("Olaru2005 §2.1 (9)")
def test_contact_load_of_the_paper():
    # reference sheet: mpmath, 40 digits
    Q = transmission.contact_load(AXIAL_LOAD, LOADED_BALLS, math.pi / 4, 0.0)
    assert pytest.approx(1.01015254455221075e2, rel=RELATIVE) == Q
    helix = transmission.contact_load(AXIAL_LOAD, LOADED_BALLS, math.pi / 4, math.atan(0.005 / (math.pi * 0.04)))
    assert helix == pytest.approx(1.01095183654347451e2, rel=RELATIVE)


@pytest.mark.parametrize("alpha", [0.5, math.pi / 4, 1.2])
@pytest.mark.parametrize("phi", [0.0, 0.04, 0.3])
def test_contact_loads_carry_the_axial_load(alpha, phi):
    # The contact normal lies in the plane across the path: radial, and along a binormal that leans by the lead angle.
    radial, binormal = np.array([1.0, 0.0, 0.0]), np.array([0.0, -math.sin(phi), math.cos(phi)])
    normal = math.cos(alpha) * radial + math.sin(alpha) * binormal
    Q = transmission.contact_load(4000.0, 56, alpha, phi)
    assert 56 * Q * normal[2] == pytest.approx(4000.0, rel=RELATIVE)


def test_ideal_torque_is_virtual_work():
    # reference sheet: mpmath, 40 digits
    torque = transmission.ideal_torque(AXIAL_LOAD, LEAD)
    assert torque == pytest.approx(3.18309886183790672, rel=RELATIVE)
    assert torque * 2 * math.pi == pytest.approx(AXIAL_LOAD * LEAD, rel=RELATIVE)


@pytest.mark.equation("Olaru2005 §7 (35)")
def test_ideal_torque_as_printed():
    # reference sheet: mpmath, 40 digits
    R_s = PITCH_CIRCLE_DIAMETER / 2 * (1 - CURVATURE_RATIO)
    torque = transmission.ideal_torque_printed(AXIAL_LOAD, R_s, LEAD, PITCH_CIRCLE_DIAMETER)
    assert torque == pytest.approx(3.00444234285048098, rel=RELATIVE)
    assert torque == pytest.approx(AXIAL_LOAD * R_s * LEAD / (math.pi * PITCH_CIRCLE_DIAMETER), rel=RELATIVE)


@pytest.mark.equation("Olaru2005 §7 (36)")
def test_efficiency_of_the_paper():
    # reference sheet: mpmath, 40 digits
    eta = transmission.efficiency(3.00444234285048098, 1.89357790432876407e-1)
    assert eta == pytest.approx(9.40710820173268375e-1, rel=RELATIVE)


@pytest.mark.equation("Olaru2005 §7 (36)")
def test_efficiency_of_a_catalogue_example():
    # HIWIN S99TE20-1610: lead angle 4.4 degrees, friction angle 0.286 degrees, efficiency 0.938, back-driving 0.934
    phi, rho = math.radians(4.4), math.radians(0.286)
    F, d_m = 1000.0, 0.0414
    friction_torque = F * d_m / 2 * (math.tan(phi + rho) - math.tan(phi))
    eta = transmission.efficiency(transmission.ideal_torque(F, math.pi * d_m * math.tan(phi)), friction_torque)
    assert eta == pytest.approx(0.938, abs=1e-3)
    assert transmission.back_driving_efficiency(eta) == pytest.approx(0.934, abs=1e-3)


@pytest.mark.parametrize("phi", [0.01, 0.04, 0.3])
@pytest.mark.parametrize("rho", [0.0, 0.003, 0.1])
def test_classical_efficiencies_balance_a_block_on_an_inclined_plane(phi, rho):
    # the reaction leans from the normal by the friction angle, against the motion
    load = 1000.0
    up, down = load * math.tan(phi + rho), load * math.tan(phi - rho)
    work = load * math.tan(phi)
    assert transmission.classical_efficiency(phi, rho) == pytest.approx(work / up, rel=RELATIVE)
    assert transmission.classical_back_driving_efficiency(phi, rho) == pytest.approx(down / work, rel=RELATIVE, abs=0)


def test_classical_back_driving_lies_a_little_above():
    # reference sheet: the friction of the thread grows with its force, that of a torque does not
    phi = math.atan(0.005 / (math.pi * 0.04))
    rho = math.atan(math.tan(phi) + 2 * 0.2 / (4000.0 * 0.04)) - phi
    eta = transmission.classical_efficiency(phi, rho)
    found = transmission.classical_back_driving_efficiency(phi, rho)
    assert 0 < found - transmission.back_driving_efficiency(eta) < 2e-5
    # both lock where the friction angle is the lead angle
    assert transmission.classical_back_driving_efficiency(phi, phi) == 0


def test_holding_torque_is_what_friction_leaves_of_the_load():
    assert transmission.holding_torque(3.18, 0.2) == pytest.approx(2.98, rel=RELATIVE)
    assert transmission.holding_torque(0.1, 0.2) == pytest.approx(-0.1, rel=RELATIVE)
    eta = transmission.efficiency(3.18, 0.2)
    assert transmission.holding_torque(3.18, 0.2) / 3.18 == pytest.approx(
        transmission.back_driving_efficiency(eta), rel=RELATIVE
    )


def test_the_friction_coefficient_of_a_vendors_example():
    """HIWIN: lead angle 4.4°, efficiency 0.938, friction angle 0.286°, which is its line µ = 0.005.

    The digits printed leave 0.05° of lead angle and 0.0005 of efficiency open: 0.006° of friction angle.
    """
    mu = transmission.friction_coefficient(math.radians(4.4), 0.938)
    assert math.degrees(transmission.friction_angle(mu)) == pytest.approx(0.286, abs=6e-3)
    assert mu == pytest.approx(0.005, abs=1e-4)


@pytest.mark.parametrize("angle", [0.5, 4.4, 20.0])
@pytest.mark.parametrize("mu", [0.001, 0.01, 0.2])
def test_friction_coefficient_and_classical_efficiency_are_inverse(angle, mu):
    phi = math.radians(angle)
    eta = transmission.classical_efficiency(phi, transmission.friction_angle(mu))
    assert transmission.friction_coefficient(phi, eta) == pytest.approx(mu, rel=1e-12)
