"""Filters of a moving log: what they leave alone, and the cutoff that the noise asks for."""

import numpy as np
import pytest

from ballscrew.evidence.moving_logs.equation import kinematics, low_pass, noise_cutoff
from support.moving_logs import record

STEP = 1e-3
TIME = STEP * np.arange(8000)


def test_a_slow_wave_has_its_derivatives():
    path = 0.1 * np.sin(2 * np.pi * 2.0 * TIME)
    found = kinematics(path, STEP)
    inner, omega = slice(500, -500), 4 * np.pi
    np.testing.assert_allclose(found.speed[inner], (0.1 * omega * np.cos(omega * TIME))[inner], atol=1e-6 * 0.1 * omega)
    np.testing.assert_allclose(found.acceleration[inner], (-(omega**2) * path)[inner], atol=1e-5 * 0.1 * omega**2)


def test_the_filter_has_no_delay_and_half_the_power_at_its_cutoff():
    for frequency, gain in ((2.0, 1.0), (20.0, 0.5), (80.0, 0.0)):
        wave = np.sin(2 * np.pi * frequency * TIME)
        found = low_pass(wave, 20.0, STEP)[1000:-1000]
        # run twice, a Butterworth filter has 1/2 of the amplitude at its cutoff
        np.testing.assert_allclose(found, gain * wave[1000:-1000], atol=2e-3)


@pytest.mark.parametrize("resolution", [2e-8, 2e-7, 2e-6])
def test_noise_is_found_and_more_of_it_is_filtered_more(resolution):
    cutoff, found = noise_cutoff(record(resolution=resolution)["position"], STEP)
    less, _ = noise_cutoff(record(resolution=resolution / 10)["position"], STEP)
    # half a step of noise, and the rounding to steps
    assert found == pytest.approx(np.hypot(0.5, 12**-0.5) * resolution, rel=0.1)
    assert 5.0 < cutoff < less < 400.0


def test_the_noise_left_in_the_speed_is_as_said():
    random = np.random.default_rng(2)
    found = kinematics(1e-6 * random.standard_normal(TIME.size), STEP, cutoff=50.0)
    assert np.std(found.speed[200:-200]) == pytest.approx(found.speed_noise, rel=0.2)
