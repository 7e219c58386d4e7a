"""Results in the terms of catalogues, against their definitions."""

import math

import numpy as np
import pytest

import ballscrew as bs

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OIL = bs.Lubricant.from_grade("ISO VG 68", 313.15)
REFERENCE = bs.FrictionModel.reference()


def result(load, **nut):
    screw = ROW.screw(nut=bs.DoubleNut(**nut)) if nut else ROW.screw()
    return REFERENCE(screw, OIL, axial_load=load, screw_speed=10.0)


def test_friction_angle_by_its_definition():
    """tan φ / tan(φ + ρ) = η; without the branch of the efficiency, so also where the load drives."""
    driven, drives = result(np.array([0.0, 5000.0])), result(np.array([0.0, -5000.0]))
    phi = float(ROW.screw().lead_angle)
    assert math.isnan(driven.friction_angle[0])
    assert math.tan(phi) / math.tan(phi + driven.friction_angle[1]) == pytest.approx(driven.efficiency[1], rel=1e-12)
    assert drives.friction_angle[1] == pytest.approx(driven.friction_angle[1], rel=1e-12)
    assert np.tan(driven.friction_angle[1]) == pytest.approx(driven.friction_coefficient[1], rel=1e-12)


def test_drag_coefficients_by_their_definitions():
    """JIS: T = K_p F_pr P_h / 2π; Rexroth: T = c F_pr d; seals count in neither."""
    plain = result(0.0, preload=4326.0)
    sealed = result(0.0, preload=4326.0, losses={"seals": bs.Seals(0.4)})
    torque = float(plain.screw_torque)
    assert plain.preload_torque_coefficient * 4326.0 * ROW.lead / (2 * math.pi) == pytest.approx(torque, rel=1e-12)
    assert plain.diameter_drag_coefficient * 4326.0 * ROW.ball_circle == pytest.approx(torque, rel=1e-12)
    assert sealed.preload_torque_coefficient == pytest.approx(plain.preload_torque_coefficient, rel=1e-12)


def test_what_has_no_meaning_is_not_a_number():
    assert math.isnan(result(1000.0, preload=4326.0).preload_torque_coefficient)
    assert math.isnan(result(0.0, preload=0.0).diameter_drag_coefficient)
    assert math.isnan(result(1000.0).preload_torque_coefficient)
    assert math.isnan(result(0.0, preload=4326.0).friction_coefficient)
