"""What must hold of Sobol' indices whatever the function."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Triangular, Uniform
from ballscrew.engine.uncertainty.sensitivity import sensitivity
from ballscrew.engine.uncertainty.sobol import (
    sobol_indices,
)

#: Standard errors that an estimate may be off; of so many estimates one beyond four is rare.
FAR = 4
coefficients = st.lists(st.floats(-3, 3), min_size=1, max_size=5)


def error(*estimates):
    """The standard error of a sum of estimates, taken for independent, from their 95 % intervals."""
    return math.hypot(*((e.high - e.low) / (2 * 1.96) for e in estimates))


def curve(shares, powers):
    """One monotone function of each share."""
    return np.array([share**power for share, power in zip(shares, powers, strict=True)])


@given(slopes=coefficients, products=st.floats(-3, 3), data=st.data())
@settings(max_examples=40)
def test_shares_of_the_variance(slopes, products, data):
    powers = data.draw(st.lists(st.floats(0.5, 3), min_size=len(slopes), max_size=len(slopes)))
    found = sobol_indices(
        lambda shares: slopes @ curve(shares, powers) + products * np.prod(shares - 0.3, axis=0), len(slopes), 2**9
    )
    assert sum(e.value for e in found.first_order) <= 1 + FAR * error(*found.first_order) + 1e-9
    assert sum(e.value for e in found.total) >= 1 - FAR * error(*found.total) - 1e-9 or found.deviation == 0
    for first_order, total in zip(found.first_order, found.total, strict=True):
        assert total.value >= first_order.value - FAR * error(first_order, total) - 1e-9
        assert total.value >= 0
    left = [share for _, share in found.known]
    assert left == sorted(left, reverse=True)
    assert all(0 <= share <= 1 for share in left)


@given(slopes=coefficients)
@settings(max_examples=40)
def test_of_a_sum_both_indices_are_the_shares_of_its_terms(slopes):
    found = sobol_indices(lambda shares: slopes @ shares, len(slopes), 2**9)
    variance = sum(slope**2 for slope in slopes)
    assume(found.deviation > 0)
    for slope, first_order, total in zip(slopes, found.first_order, found.total, strict=True):
        for estimate in (first_order, total):
            assert estimate.value == pytest.approx(slope**2 / variance, abs=FAR * error(estimate) + 1e-9)


@given(offset=st.floats(-100, 100), factor=st.floats(0.01, 100))
@settings(max_examples=20)
def test_indices_have_no_unit(offset, factor):
    def function(shares):
        return shares[0] + shares[1] * shares[2]

    plain = sobol_indices(function, 3, 2**7)
    changed = sobol_indices(lambda shares: offset + factor * function(shares), 3, 2**7)
    for one, other in zip((*plain.first_order, *plain.total), (*changed.first_order, *changed.total), strict=True):
        assert other == pytest.approx(one, abs=1e-6)
    assert changed.deviation == pytest.approx(factor * plain.deviation, rel=1e-6)


SPREAD = 1e-3
NARROW = {
    "axial_load": lambda x: Normal(x, SPREAD * x),
    "viscosity": lambda x: LogNormal(x, 1 + SPREAD),
    "contact_angle": lambda x: Uniform(x * (1 - SPREAD), x * (1 + SPREAD)),
    "screw_roughness": lambda x: Triangular(x * (1 - SPREAD), x, x * (1 + 2 * SPREAD)),
}


@pytest.mark.parametrize("output", ["screw_torque", pytest.param("efficiency", marks=pytest.mark.long)])
def test_where_little_varies_all_methods_are_the_tangent(output, seed_screw, seed_oil, model):
    """The only thing that the three share is the model."""
    parts = {"axial_load": 4000.0, "viscosity": seed_oil.viscosity}
    centre = {name: parts.get(name) or getattr(seed_screw, name) for name in NARROW}
    by_method = {
        method: sensitivity(
            model,
            seed_screw,
            seed_oil,
            distributions={n: made(centre[n]) for n, made in NARROW.items()},
            axial_load=4000.0,
            screw_speed=62.83,
            output=output,
            method=method,
        )
        for method in ("sobol", "morris", "local")
    }
    sobol, morris, local = by_method.values()
    assert sobol.deviation == pytest.approx(local.deviation, rel=0.01)
    assert sobol.mean == pytest.approx(local.mean, rel=1e-4)
    for name in NARROW:
        assert sobol.first_order[name].value == pytest.approx(local.first_order[name].value, abs=0.01)
        assert sobol.total[name].value == pytest.approx(local.first_order[name].value, abs=0.01)
        assert morris.effect[name].value == pytest.approx(abs(local.effect[name].value), rel=0.01)
        assert morris.measures["effect_deviation"][name].value < 0.01 * local.deviation
        assert sobol.left_if_known(name) == pytest.approx(local.left_if_known(name), abs=0.01)
    assert {m: found.inputs[0] for m, found in by_method.items()} == dict.fromkeys(by_method, local.inputs[0])
