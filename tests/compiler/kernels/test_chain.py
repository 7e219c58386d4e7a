"""Chains of springs by a kernel, against dense matrices (analytic)."""

import numpy as np
import pytest

from ballscrew.compiler.kernels.chain import Chains, balanced_chains, chain_kernel
from ballscrew.compiler.tracing.grid import verbatim_program

LINKS, CHAINS = 7, 21
RNG = np.random.default_rng(1)
STIFF, FORCE = RNG.uniform(0.5, 2.0, (LINKS, CHAINS)), RNG.uniform(-1.0, 1.0, CHAINS)


def springs(x, stiffness):
    """Springs that harden."""
    return {"force": stiffness * (x + x**2 * x), "slope": stiffness * (1 + 3 * x**2)}


def solved(bars, steps=50, chains=slice(None)):
    kernel = chain_kernel(verbatim_program(2, springs), ["points", "rows" if bars.shape[-1] == 1 else "points"])
    force = FORCE[chains]
    some = bars[:, chains] if bars.shape[-1] > 1 else bars
    start, tolerance = np.zeros((LINKS, force.size)), np.full(force.size, 1e-14)
    at = Chains(start, some, 0.25 * force, 0.75 * force, tolerance, 1e-16)
    return balanced_chains(kernel, [STIFF[:, chains]], at, steps)


@pytest.mark.compiles
@pytest.mark.parametrize("bars", [RNG.uniform(0.1, 9.0, (LINKS - 1, CHAINS)), RNG.uniform(0.1, 9.0, (LINKS - 1, 1))])
def test_forces_balance_at_each_link(bars):
    found = solved(bars)
    assert found.settled.all()
    x, left = found.displacement, -springs(found.displacement, STIFF)["force"]
    left[0] += 0.25 * FORCE
    left[-1] += 0.75 * FORCE
    passed = bars * np.diff(x, axis=0)
    left[:-1] += passed
    left[1:] -= passed
    assert np.max(np.abs(left)) < 1e-13
    assert np.allclose(found.force, FORCE, rtol=1e-12)
    one = solved(bars, chains=slice(20, 21))
    assert np.array_equal(one.displacement[:, 0], x[:, 20])


@pytest.mark.compiles
def test_what_has_not_settled_is_said():
    found = solved(RNG.uniform(0.1, 9.0, (LINKS - 1, CHAINS)), steps=1)
    assert not found.settled.any()
    assert np.all(found.imbalance > 1e-14)
