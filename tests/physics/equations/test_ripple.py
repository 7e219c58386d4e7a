"""Truth: the kinematics of rolling, the conservation of balls, and the Fourier series of a row of balls."""

import math

import numpy as np
import pytest

from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import ball_chain, kinematics, nut_losses
from ballscrew.physics.laws.frame import bearing_frame, helix_frame

from .numbers import SCREWS

RELATIVE = 1e-12


@pytest.mark.implausible
@pytest.mark.parametrize("place", [bearing_frame, helix_frame])
@pytest.mark.parametrize("name", SCREWS)
def test_orders_are_those_of_rolling(name, place):
    """Each is a speed of the equations of rolling over that of the screw."""
    d_m, d_w, alpha, f = SCREWS[name]
    frame, omega = place(BallScrew(d_m, 0.01, d_w, 50, alpha, f, f)), 62.8
    v = frame.entrainment_speed(omega)
    around = kinematics.orbital_rotation(v, frame.nut_contact_radius)
    along = kinematics.orbital_speed(around, frame.path_radius)
    relative = kinematics.screw_relative_rotation(v, frame.screw_contact_radius)
    gamma, L = frame.curvature_ratio, frame.path_radius
    assert ball_chain.cage_order(gamma) == pytest.approx(around / omega, rel=RELATIVE)
    assert ball_chain.over_balls_order(gamma) == pytest.approx(relative / omega, rel=RELATIVE)
    assert ball_chain.cage_order(gamma) + ball_chain.over_balls_order(gamma) == pytest.approx(1.0, rel=RELATIVE)
    turns = nut_losses.ball_turns(L, gamma, d_w)
    assert ball_chain.ball_spot_order(turns) == pytest.approx(
        2 * kinematics.ball_rotation(v, d_w) / omega, rel=RELATIVE
    )
    advance, pitch = nut_losses.path_advance(L, gamma), 1.03 * d_w
    assert ball_chain.ball_pass_order(advance, pitch) == pytest.approx(
        2 * math.pi * along / omega / pitch, rel=RELATIVE
    )


def test_loaded_balls_share_the_room_of_a_circuit():
    # 16 ball diameters loaded, 10 in the return, which is full, and one ball of room
    pitch = ball_chain.loaded_ball_pitch(16.0, 27.0, 26 - 1, 1.0)
    assert 16.0 / pitch + (27.0 - 16.0) == pytest.approx(25, rel=RELATIVE)
    assert ball_chain.loaded_ball_pitch(16.0, 26.0, 26, 1.0) == pytest.approx(1.0, rel=RELATIVE)


def test_a_ball_comes_back_once_in_a_circulation():
    """In a full circuit that is the way round over the way of a ball for each turn."""
    advance, d_w, balls = 9.4e-3, 6e-3, 26
    order = ball_chain.circulation_order(ball_chain.ball_pass_order(advance, d_w), balls)
    assert order == pytest.approx(2 * math.pi * advance / (balls * d_w), rel=RELATIVE)


def amplitudes(loads, harmonics):
    """Amplitudes of the sum of the loads of a row of balls, over its mean, as the row moves on by one pitch."""
    whole = np.fft.rfft(loads) / len(loads)
    return [2 * abs(whole[m]) / abs(whole[0]) for m in harmonics]


@pytest.mark.parametrize("balls", [5.25, 16.4, 17.5, 17.0])
def test_harmonics_of_a_row_with_sharp_ends(balls):
    places = np.arange(30)[:, None] + (np.arange(20_000) + 0.5) / 20_000
    found = amplitudes(np.sum(places <= balls, axis=0), (1, 2, 3))
    expected = [abs(ball_chain.ball_pass_harmonic(m, balls)) for m in (1, 2, 3)]
    np.testing.assert_allclose(found, expected, atol=2e-5)
    assert (max(expected) < 1e-12) == (balls == 17.0)


@pytest.mark.parametrize("rise", [0.5, 1.0, 1.7])
def test_harmonics_of_a_row_whose_load_rises(rise):
    balls = 16.4
    places = np.arange(30)[:, None] + (np.arange(20_000) + 0.5) / 20_000
    ramp = np.clip(np.minimum(places, balls - places) / rise, 0.0, 1.0)
    found = amplitudes(np.sum(ramp, axis=0), (1, 2))
    expected = [abs(ball_chain.ball_pass_harmonic(m, balls - rise) * np.sinc(m * rise)) for m in (1, 2)]
    np.testing.assert_allclose(found, expected, atol=1e-6)
