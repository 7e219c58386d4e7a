"""Claims of the page on warming up, by the tables that it shows."""

import math

import numpy as np
import pytest

import ballscrew as bs
import warm_up_tables as tables


@pytest.mark.parametrize("rpm", tables.SPEEDS)
def test_a_cooled_nut_has_more_preload_or_no_steady_state(rpm):
    """What the page confirms: at every speed, for balls that conduct as computed, three times and a third."""
    middle = tables.network(rpm).ball_conductance
    for factor in (1.0, 3.0, 1 / 3):
        preloads = [
            tables.results(tables.network(rpm, nut_conductance=cooling, ball_conductance=factor * middle), rpm)[
                "preload"
            ]
            for cooling in (2.0, tables.BOLTED, 40.0, tables.COOLED)
        ]
        known = [preload for preload in preloads if not math.isnan(preload)]
        assert known == sorted(known)
        assert preloads[: len(known)] == known  # once there is none, more cooling brings none back


@pytest.mark.parametrize("rpm", tables.SPEEDS)
def test_effects_one_after_the_other(rpm):
    """Thinner oil takes heat away, and the preload brings some back."""
    nothing, oil, both, _ = (tables.results(tables.network(rpm, variant), rpm) for variant in tables.VARIANTS)
    assert nothing["preload"] == oil["preload"] == tables.PRELOAD < both["preload"]
    assert oil["torque"] < nothing["torque"]
    assert oil["torque"] < both["torque"]
    assert oil["growth"] < nothing["growth"]
    # without any effect the heat is that of the start
    assert nothing["margin"] == pytest.approx(1.0, abs=1e-9)


def test_a_short_stroke_warms_the_shaft_where_it_is():
    """The rise beyond a stroke of 150 mm, as the page has it."""
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=tables.PRELOAD))
    oil = bs.Lubricant.from_grade("ISO VG 100", tables.AIR.ambient)
    speed = 1000 * math.tau / 60
    duty = bs.to_and_fro(bs.FrictionModel.reference(), screw, oil, axial_load=0.0, screw_speed=speed, stroke=0.15)
    found = bs.warm_up(duty, tables.AIR, time=3 * 3600.0, outputs=2)
    rise = found.shaft_temperature[-1] - tables.AIR.ambient
    shares = np.interp([0.8, 0.9], found.places, rise) / np.max(rise)
    assert shares == pytest.approx([0.26, 0.10], abs=0.01)


def test_bands_hold_the_middle():
    low, high = tables.bands(500, "oil and preload", samples=32).steady["preload"]
    assert low < tables.results(tables.network(500), 500)["preload"] < high
