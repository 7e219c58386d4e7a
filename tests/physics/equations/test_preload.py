"""Truth: a catalogue's worked examples and tables, and the algebra of two braced halves."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from ballscrew.physics.equations import geometry, nut_losses, transmission
from ballscrew.physics.laws.nut_losses import DOUBLE_NUT_DRAG, OVERSIZE_BALL_DRAG

DATA = Path(__file__).parents[2] / "data"
RELATIVE = 1e-13
#: The limits of a table have two decimals; so far off may their mean, or one of them, be.
HALF_DIGIT = 0.00501


def rows(name):
    with (DATA / name).open(encoding="utf-8", newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def row_id(row):
    return f"{row['nominal_diameter_mm']:g}x{row['lead_mm']:g}-{row['circuits']:g}"


def jis_torque(force, pitch_circle_diameter, lead):
    K_p = nut_losses.preload_torque_coefficient(geometry.lead_angle(lead, pitch_circle_diameter), 0.05, 0.5)
    return nut_losses.preload_torque(K_p, force, lead)


# -- published drag torques -----------------------------------------------------------------------


def test_worked_example_of_a_catalogue():
    # THK, BNFN 4010-5: pitch circle 41.75 mm, lead 10 mm, preload 3000 N
    assert jis_torque(3000.0, 0.04175, 0.010) * 1e3 == pytest.approx(865, abs=0.5)


def test_short_form_of_the_rule():
    # NSK and others print 0.014 F sqrt(d_m P_h)
    torque = jis_torque(1000.0, 0.04, 0.005)
    factor = torque / (1000.0 * math.sqrt(0.04 * 0.005))
    assert factor == pytest.approx(0.05 / (2 * math.sqrt(math.pi)), rel=RELATIVE)
    assert factor == pytest.approx(0.014, abs=5e-4)


@pytest.mark.parametrize("percent", [7, 10])
@pytest.mark.parametrize("row", rows("rexroth_double_nut.csv"), ids=row_id)
def test_double_nuts_of_a_catalogue(row, percent):
    assert_middle(row, percent, DOUBLE_NUT_DRAG)


@pytest.mark.parametrize("row", rows("rexroth_single_nut.csv"), ids=row_id)
def test_oversize_ball_nuts_of_a_catalogue(row):
    assert_middle(row, 5, OVERSIZE_BALL_DRAG)
    # at 2 % the table has only the largest torque, and that is the rule's own
    largest = nut_losses.diameter_drag_torque(0.02 * row["dynamic_load_rating_N"], size(row), OVERSIZE_BALL_DRAG)
    assert largest == pytest.approx(row["no_load_torque_2pct_max_Nm"], abs=HALF_DIGIT)


def size(row):
    return row["nominal_diameter_mm"] * 1e-3


def assert_middle(row, percent, coefficient):
    torque = nut_losses.diameter_drag_torque(percent / 100 * row["dynamic_load_rating_N"], size(row), coefficient)
    limits = [row[f"no_load_torque_{percent}pct_{limit}_Nm"] for limit in ("min", "max")]
    assert torque == pytest.approx(sum(limits) / 2, abs=HALF_DIGIT)


# -- first principles -----------------------------------------------------------------------------


@pytest.mark.parametrize("friction_torque", [0.0, 0.01, 0.2])
@pytest.mark.parametrize("lead", [0.005, 0.040])
def test_two_braced_halves_have_twice_the_friction_of_one(friction_torque, lead):
    force = 1500.0
    eta = transmission.efficiency(transmission.ideal_torque(force, lead), friction_torque)
    K_p = nut_losses.preload_torque_coefficient_of_halves(eta, transmission.back_driving_efficiency(eta))
    assert K_p == pytest.approx(2 * (1 / eta - 1), rel=RELATIVE, abs=1e-15)
    assert nut_losses.preload_torque(K_p, force, lead) == pytest.approx(2 * friction_torque, rel=1e-12, abs=1e-15)


def test_inclined_plane_of_a_catalogue():
    # HIWIN S99TE20-1610: lead angle 4.4 degrees, friction angle 0.286 degrees, efficiency 0.938, back-driving 0.934
    phi, rho = math.radians(4.4), math.radians(0.286)
    eta, eta_b = transmission.classical_efficiency(phi, rho), transmission.classical_back_driving_efficiency(phi, rho)
    assert eta == pytest.approx(0.938, abs=1e-3)
    assert eta_b == pytest.approx(0.934, abs=1e-3)
    # of the two printed efficiencies, with their digits
    K_p = nut_losses.preload_torque_coefficient_of_halves(eta, eta_b)
    assert K_p == pytest.approx(1 / 0.938 - 0.934, abs=1.1e-3 + 1e-3)


# -- two halves -----------------------------------------------------------------------------------


def external_load(force, x):
    return nut_losses.forward_half_load(force, x) - nut_losses.backward_half_load(force, x)


def test_without_load_both_halves_carry_the_preload():
    assert nut_losses.forward_half_load(1500.0, 0.0) == 1500.0
    assert nut_losses.backward_half_load(1500.0, 0.0) == 1500.0


def test_the_relieved_half_lifts_off():
    assert nut_losses.backward_half_load(1500.0, 1.0) == 0.0
    assert nut_losses.backward_half_load(1500.0, 1.7) == 0.0
    assert external_load(1500.0, 1.0) == pytest.approx(nut_losses.lift_off_load(1500.0), rel=RELATIVE)
    # catalogues: about three times the preload, or 2.83
    assert nut_losses.lift_off_load(1.0) == pytest.approx(2.83, abs=0.005)


def test_halves_are_springs_of_power_three_halves():
    # F_f^(2/3) + F_b^(2/3) = 2 F_pr^(2/3) while both carry
    x = np.linspace(0.0, 1.0, 11)
    both = nut_losses.forward_half_load(900.0, x) ** (2 / 3) + nut_losses.backward_half_load(900.0, x) ** (2 / 3)
    np.testing.assert_allclose(both, 2 * 900.0 ** (2 / 3), rtol=RELATIVE)


def test_two_halves_are_twice_as_stiff_as_one():
    step = 1e-6
    stiffness = external_load(900.0, step) / step
    assert stiffness == pytest.approx(2 * 1.5 * 900.0, rel=1e-9)
