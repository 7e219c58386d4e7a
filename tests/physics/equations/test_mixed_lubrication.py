"""Truth: the load shares as printed, and Greenwood and Tripp's pressure from two rough surfaces."""

import math

import numpy as np
import pytest

from ballscrew.physics.equations import friction

RELATIVE = 1e-12
NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)


def printed(lam):
    return 1 - 1.21 * lam**0.64 / (1 + 0.37 * lam**1.26)


def mean_overlap(lam, power=2.5):
    """The integral over the Gaussian heights s > lam of (s - lam)^power."""
    upper = lam + 12.0
    s = (lam + upper) / 2 + (upper - lam) / 2 * NODES
    density = np.exp(-(s**2) / 2) / math.sqrt(2 * math.pi)
    return float(np.sum((upper - lam) / 2 * WEIGHTS * (s - lam) ** power * density))


def test_zhou_and_hoeprich_share():
    # ZhouHoeprich1991: exp(-B lambda^C)
    assert friction.asperity_load_share_zhou_hoeprich(0.0, 1.42, 0.8) == 1.0
    assert friction.asperity_load_share_zhou_hoeprich(1.0, 1.42, 0.8) == pytest.approx(math.exp(-1.42), rel=RELATIVE)
    assert friction.asperity_load_share_zhou_hoeprich(32.0, 1.0, 0.2) == pytest.approx(math.exp(-2), rel=RELATIVE)
    assert friction.asperity_load_share_zhou_hoeprich(1e3, 1.42, 0.8) == pytest.approx(0.0, abs=1e-100)


@pytest.mark.parametrize("lam", [0.0, 0.05, 0.5, 0.8, 1.0, 1.5, 1.9, 1.99, 1.9996])
def test_balan_share_as_printed(lam):
    assert friction.asperity_load_share_balan(lam) == pytest.approx(printed(lam), rel=RELATIVE)


@pytest.mark.parametrize("lam", [2.0, 2.01, 2.25, 2.54, 3.0, 10.0])
def test_balan_share_ends_at_two(lam):
    assert friction.asperity_load_share_balan(lam) == 0.0


def test_balan_share_as_printed_is_no_share_beyond_two():
    assert 2.9e-4 < printed(2.0) < 3.0e-4
    assert printed(2.013) < 0 < printed(2.012)
    assert printed(2.532) < 0 < printed(2.533)
    assert printed(10.0) > 0.3


def test_balan_share_never_rises():
    share = friction.asperity_load_share_balan(np.linspace(0.0, 6.0, 6001))
    assert np.all(np.diff(share) <= 0)
    assert share[0] == 1.0


@pytest.mark.parametrize(
    ("lam", "exact"),
    # the integral F_5/2 of GreenwoodTripp1970 by adaptive quadrature; the fit is up to 11 % low
    [(0.0, 0.61664), (0.5, 0.24040), (1.0, 0.08056), (1.5, 0.02286), (2.0, 0.00542)],
)
def test_asperity_contact_integral(lam, exact):
    assert mean_overlap(lam) == pytest.approx(exact, rel=1e-3)
    assert friction.asperity_contact_integral(lam) == pytest.approx(exact, rel=0.11)


def test_asperity_contact_integral_ends_at_four():
    assert friction.asperity_contact_integral(3.99) > 0
    assert friction.asperity_contact_integral(4.0) == 0.0
    assert friction.asperity_contact_integral(5.0) == 0.0


@pytest.mark.parametrize("lam", [0.0, 1.0, 2.0])
def test_asperity_pressure_is_that_of_two_rough_surfaces(lam):
    # Two surfaces with N summits of radius beta per area. Summits whose axes lie r apart overlap by s - r^2/4 beta,
    # with s the overlap on one axis, and touch as a sphere of radius beta/2 with Hertz's 4/3 E* (beta/2)^1/2 w^3/2.
    E, N, beta, sigma = 2.26e11, 4e10, 2e-6, 5e-7

    def load_of_a_pair(w):
        return 4 / 3 * (E / 2) * math.sqrt(beta / 2) * w**1.5

    def load_of_a_summit(s):
        r = np.sqrt(4 * beta * s) * (1 + NODES) / 2
        dr = np.sqrt(4 * beta * s) * WEIGHTS / 2
        return float(np.sum(N * 2 * math.pi * r * load_of_a_pair(np.maximum(s - r**2 / (4 * beta), 0)) * dr))

    upper = lam + 12.0
    heights = (lam + upper) / 2 + (upper - lam) / 2 * NODES
    density = np.exp(-(heights**2) / 2) / math.sqrt(2 * math.pi)
    loads = np.array([load_of_a_summit((h - lam) * sigma) for h in heights])
    pressure = float(np.sum((upper - lam) / 2 * WEIGHTS * N * loads * density))
    assert friction.asperity_pressure(mean_overlap(lam), E, N, beta, sigma) == pytest.approx(pressure, rel=1e-6)


def test_greenwood_and_tripp_share():
    assert friction.asperity_load_share_greenwood_tripp(2e8, 1e9) == pytest.approx(0.2, rel=RELATIVE)
    assert friction.asperity_load_share_greenwood_tripp(2e9, 1e9) == 1.0
    assert friction.asperity_load_share_greenwood_tripp(2e8, 0.0) == 1.0
    assert friction.asperity_load_share_greenwood_tripp(0.0, 1e9) == 0.0


def test_load_sharing_friction_coefficient():
    # Balan2015 (A1) with its own coefficients, 0.11 and 0.03
    assert friction.load_sharing_friction_coefficient(1.0, 0.11, 0.03) == 0.11
    assert friction.load_sharing_friction_coefficient(0.0, 0.11, 0.03) == 0.03
    assert friction.load_sharing_friction_coefficient(0.25, 0.11, 0.03) == pytest.approx(0.05, rel=RELATIVE)
