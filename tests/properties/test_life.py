"""How preload shares a load, and how two lives make one."""

import pytest
from hypothesis import given

from ballscrew.physics.equations import life
from support.strategies import floats, powers

forces = powers(1.0, 1e6)
lives = powers(1e3, 1e12)


def halves(F, P):
    relieved = life.relieved_half_load(P, life.preload_release(F, P))
    return F + relieved, relieved


@given(forces, forces, floats(1.0, 2.0))
def test_more_load_presses_more_and_relieves_more(F, P, more):
    (first, second), (first_more, second_more) = halves(F, P), halves(F * more, P)
    slack = 1e-12 * (F + P)
    assert first_more >= first - slack
    assert second_more <= second + slack
    assert first >= max(F, P) - slack
    assert -slack <= second <= P + slack


@given(forces, forces, powers(1e-3, 1e3))
def test_preload_scales_with_the_forces(F, P, unit):
    assert halves(F * unit, P * unit) == pytest.approx(
        [unit * load for load in halves(F, P)], rel=1e-9, abs=1e-9 * unit * P
    )


@given(lives, lives)
def test_lives_combine_in_any_order_to_less_than_the_shorter(first, second):
    both = life.combined_life(first, second)
    assert both == pytest.approx(life.combined_life(second, first), rel=1e-13)
    assert both <= min(first, second) * (1 + 1e-12)
    assert both >= min(first, second) * 2 ** (-0.9) * (1 - 1e-12)
