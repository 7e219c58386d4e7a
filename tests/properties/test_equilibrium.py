"""Laws of forces, moments and energy. Each holds for any screw, oil and operating point."""

import dataclasses
import math

import numpy as np
from hypothesis import given

from ballscrew.physics.equations import equilibrium, kinematics
from ballscrew.physics.laws.frame import bearing_frame, helix_frame
from support.strategies import (
    all_models,
    balanced_models,
    both_models,
    cases,
    close,
    constant_friction,
    corrected,
    moving,
    moving_cases,
    olaru2005,
    powers,
    screws,
    torque_scale,
    with_ball_force,
    without_losses_of_rolling,
)
from support.strategies import ball_forces as braking


def with_braking(model, ball_to_ball_force):
    return with_ball_force(model, ball_to_ball_force)


def contact_moments(r):
    """Sum of the moments that the ball feels, ball-to-ball included."""
    sides = (r.screw, r.nut)
    return sum(s.curvature_friction_moment + s.elastic_resistance_moment for s in sides) + r.ball_chain.moment


@given(cases, balanced_models, braking)
def test_action_is_reaction(case, model, ball_to_ball_force):
    """Screw and nut torque differ by what pushes the balls along: M_S − M_N = z F_B L."""
    r = case(with_braking(model, ball_to_ball_force))
    expected = case.screw.loaded_balls * r.net_braking_force * r.frame.path_radius
    assert close(r.screw_torque - r.nut_torque, expected, scale=torque_scale(r))


@given(cases, balanced_models)
def test_without_braking_both_torques_are_equal(case, model):
    """No force between the balls, no difference between the torques: F_B = 0 gives M_S = M_N."""
    r = case(with_braking(model, 0.0))
    assert close(r.screw_torque, r.nut_torque, scale=torque_scale(r))


@given(cases, braking)
def test_defect_of_the_printed_torques(case, ball_to_ball_force):
    """The paper leaves the contact moments off the races: action and reaction miss each other by −z M cos α."""
    r = case(with_braking(olaru2005, ball_to_ball_force))
    z, alpha = case.screw.loaded_balls, case.screw.contact_angle
    pushing = z * r.net_braking_force * r.frame.path_radius
    defect = -z * contact_moments(r) * math.cos(alpha)
    assert close(r.screw_torque - r.nut_torque, pushing + defect, scale=torque_scale(r))


@given(cases, balanced_models, braking)
def test_energy(case, model, ball_to_ball_force):
    """All power that friction takes from the screw is dissipated at the balls: M_S ω = Σ P."""
    r = case(with_braking(model, ball_to_ball_force))
    assert close(r.screw_torque * r.screw_speed, r.friction_power)
    assert close(sum(r.dissipation.values()), r.friction_power)


@given(cases, braking)
def test_energy_by_mechanism(case, ball_to_ball_force):
    """The torque of each mechanism, times the speed, is the dissipation of that mechanism."""
    r = case(with_braking(corrected, ball_to_ball_force))
    assert r.contributions.keys() == r.dissipation.keys()
    for mechanism, torque in r.contributions.items():
        assert close(torque * r.screw_speed, r.dissipation[mechanism], scale=torque_scale(r) * r.screw_speed), mechanism
        # measured against the whole, a small part could hide: each also closes by itself
        assert close(torque * r.screw_speed, r.dissipation[mechanism], relative=1e-11), mechanism


@given(moving_cases)
def test_the_printed_torque_falls_short_of_the_dissipation(case):
    """The paper's torque lacks the moments of the contacts on the screw, z (M_C + M_ER) cos α."""
    r = case(olaru2005)
    moment = r.screw.curvature_friction_moment + r.screw.elastic_resistance_moment
    # and (21) is balanced by a straight chain, which leaves out that the chain turns with the screw
    chain = r.ball_chain.moment * (1 - r.frame.curvature_ratio) / 2
    missing = case.screw.loaded_balls * (moment + chain) * math.cos(case.screw.contact_angle)
    assert close((r.screw_torque + missing) * r.screw_speed, r.friction_power)


@given(cases, all_models, braking)
def test_contributions_sum_to_the_torque(case, model, ball_to_ball_force):
    """The parts are the whole: contributions sum to the screw torque."""
    r = case(with_braking(model, ball_to_ball_force))
    assert close(sum(r.contributions.values()), r.screw_torque, scale=torque_scale(r))


@given(cases, all_models, braking)
def test_ball_in_equilibrium(case, model, ball_to_ball_force):
    """Forces along the path and moments about the ball's centre vanish, Olaru2005 §3 (22) and (23)."""
    r = case(with_braking(model, ball_to_ball_force))
    s, n = r.screw, r.nut
    forces = (s.sliding_force, n.sliding_force, s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force)
    net = equilibrium.force_imbalance(*forces, s.pressure_force, n.pressure_force, r.ball_chain.braking_force)
    size = sum(map(abs, forces)) + s.pressure_force + n.pressure_force + r.ball_chain.braking_force
    assert close(net, 0, scale=size)
    moments = contact_moments(r) - r.ball_chain.moment
    turning = equilibrium.moment_imbalance(*forces, moments, r.ball_chain.moment, case.screw.ball_diameter)
    assert close(turning, 0, scale=size * case.screw.ball_diameter)


@given(cases, both_models)
def test_nothing_rolls_for_free(case, model):
    """Friction brakes: no contribution to the screw torque is negative where the offset is in its range."""
    r = case(model)
    for mechanism, torque in r.contributions.items():
        if mechanism != "curvature" or np.all(r.validity["pure_rolling_offset"]):
            assert torque >= 0, mechanism


@given(moving_cases, powers(0.3, 3.0))
def test_slip_torque_is_proportional_to_friction(case, factor):
    """Where nothing but sliding is lost, the torque is proportional to the friction coefficient."""
    for preset in (olaru2005, corrected):
        model = without_losses_of_rolling(preset)
        once, more = (case(dataclasses.replace(model, friction=constant_friction(mu))) for mu in (0.1, 0.1 * factor))
        if np.all(once.converged):
            assert close(more.screw_torque, factor * once.screw_torque, relative=1e-11)
            assert close(more.friction_power, factor * once.friction_power, relative=1e-11)


@given(screws(), moving)
def test_rotations_add_up_to_the_screw(screw, screw_speed):
    """The ball travels, the screw overtakes it: ω_c + ω_s = ω, in a bearing and on a helix."""
    for frame in (bearing_frame(screw), helix_frame(screw)):
        v = frame.entrainment_speed(screw_speed)
        orbit = kinematics.orbital_rotation(v, frame.nut_contact_radius)
        overtaking = kinematics.screw_relative_rotation(v, frame.screw_contact_radius)
        assert close(orbit + overtaking, screw_speed)


@given(cases, all_models)
def test_back_driving_efficiency(case, model):
    """Same friction, opposite direction of the power: η_b = 2 − 1/η, and M_Sa − M_S drives."""
    r = case(model)
    assert close(r.back_driving_efficiency, 2 - 1 / r.efficiency, scale=2 + 1 / r.efficiency)
    driven = (r.ideal_torque - r.screw_torque) / r.ideal_torque
    assert close(r.back_driving_efficiency, driven, scale=1 + 1 / r.efficiency)
    # at rest friction holds either way
    assert close(r.drive_torque, r.ideal_torque / (r.efficiency if case.screw_speed > 0 else 1.0))


@given(cases, balanced_models)
def test_efficiency_is_that_of_the_wedge(case, model):
    """η = tan φ / tan(φ + ρ′), where tan(φ + ρ′) = tan φ + 2 M_S / (F d_m)."""
    r = case(model)
    slope = math.tan(case.screw.lead_angle)
    tilted = slope + 2 * r.screw_torque / (case.axial_load * case.screw.pitch_circle_diameter)
    assert close(r.efficiency, slope / tilted)
