"""Truth: Hertz's preload, Weibull's pairs, and the arithmetic of life."""

import math

import pytest

from ballscrew.physics.equations import life

RELATIVE = 1e-13


def halves(F, P):
    relieved = life.relieved_half_load(P, life.preload_release(F, P))
    return F + relieved, relieved


def test_a_life_is_a_million_at_the_rating():
    assert life.basic_life(50e3, 50e3) == 1e6
    assert life.basic_life(50e3, 5e3) == pytest.approx(1e9, rel=RELATIVE)


def test_preload_of_the_standard():
    # P (1 + F/(2.83 P))^1.5 and the axial load less; its 2.83 is 2√2 rounded
    P = 1000.0
    for F in (0.0, 500.0, 1500.0, 2800.0):
        first, second = halves(F, P)
        assert first == pytest.approx(P * (1 + F / (2.83 * P)) ** 1.5, rel=1e-3)
        assert first - second == pytest.approx(F, rel=RELATIVE, abs=1e-9)


def test_preload_against_hertz():
    # Two springs Q = δ^1.5 braced by 1: exact at both ends, and between them the straight line errs by less than 4 %.
    for x in (0.0, 0.25, 0.5, 0.75, 1.0):
        F = (1 + x) ** 1.5 - (1 - x) ** 1.5
        assert halves(F, 1.0)[0] == pytest.approx((1 + x) ** 1.5, rel=0.04 if 0 < x < 1 else RELATIVE)


def test_a_half_is_set_free_at_the_square_root_of_eight():
    P = 700.0
    F = math.sqrt(8) * P
    assert life.preload_release(F, P) == pytest.approx(1, rel=RELATIVE)
    assert halves(F * 1.0001, P) == (F * 1.0001, 0.0)
    assert halves(0.0, P) == (P, P)
    below, above = halves(F * (1 - 1e-9), P), halves(F * (1 + 1e-9), P)
    assert below == pytest.approx(above, rel=1e-8, abs=1e-5)


def test_a_life_without_limit_adds_nothing():
    assert life.combined_life(1e7, math.inf) == pytest.approx(1e7, rel=RELATIVE)
    # nine of ten: the survivors of two lives, each of Weibull's slope 10/9, are the product
    L_1, L_2 = 2e6, 5e6
    L = life.combined_life(L_1, L_2)
    survivors = 0.9 ** ((L / L_1) ** (10 / 9)) * 0.9 ** ((L / L_2) ** (10 / 9))
    assert survivors == pytest.approx(0.9, rel=RELATIVE)


def test_time_is_revolutions_over_speed():
    # a million revolutions at 1000 rpm take 1000 min
    assert life.running_time(1e6, 1000 * math.tau / 60) == pytest.approx(60e3, rel=RELATIVE)


def test_static_safety():
    assert life.static_safety(100e3, 40e3) == 2.5
