"""Truth: the laws of shear at their limits, and between them by hand."""

import math

import pytest

from ballscrew.physics.equations import friction

RELATIVE = 1e-13


def test_film_shear_rate():
    assert friction.film_shear_rate(0.05, 2e-7) == pytest.approx(2.5e5, rel=RELATIVE)
    assert friction.film_shear_rate(0.0, 2e-7) == 0.0


def test_limiting_shear_stress():
    assert friction.limiting_shear_stress(1e9, 0.07) == pytest.approx(7e7, rel=RELATIVE)


def test_eyring_stress_at_a_rate_with_a_plain_answer():
    # Eyring1936: the rate is tau_E/eta sinh(tau/tau_E)
    tau_E, eta, tau = 5e6, 50.0, 2e7
    rate = tau_E / eta * math.sinh(tau / tau_E)
    assert friction.eyring_shear_stress(eta, rate, tau_E) == pytest.approx(tau, rel=RELATIVE)
    assert friction.eyring_shear_stress(eta, -rate, tau_E) == pytest.approx(-tau, rel=RELATIVE)


def test_bair_winer_stress_at_a_rate_with_a_plain_answer():
    # BairWiner1979: the rate is -tau_L/eta ln(1 - tau/tau_L)
    tau_L, eta = 7e7, 50.0
    rate = tau_L / eta * math.log(2)
    assert friction.bair_winer_shear_stress(eta, rate, tau_L) == pytest.approx(tau_L / 2, rel=RELATIVE)


@pytest.mark.parametrize("law", [friction.eyring_shear_stress, friction.bair_winer_shear_stress])
def test_every_oil_is_newtonian_at_low_rates(law):
    assert law(0.1, 1e-3, 5e6) == pytest.approx(1e-4, rel=1e-10)
    assert law(0.1, 0.0, 5e6) == 0.0


def test_bair_winer_stays_below_its_limit():
    assert friction.bair_winer_shear_stress(1e4, 1e7, 7e7) == pytest.approx(7e7, rel=RELATIVE)
    assert friction.bair_winer_shear_stress(1e4, math.inf, 7e7) == 7e7
    assert friction.eyring_shear_stress(1e4, 1e7, 5e6) < 7e7


def test_film_friction_coefficient():
    assert friction.film_friction_coefficient(4e7, 1e9) == pytest.approx(0.04, rel=RELATIVE)
