"""The power of a model's torque against what its parts dissipate, and the warning where they differ."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005.case import OIL, SCREW
from support.strategies import MODELS

SPEEDS = np.array([0.0, 1.0, 10.0, 60.0, 200.0])


def record_of(r):
    return next((record for record in r.warning_records if record.id == "model.power_balance"), None)


def test_the_printed_model_states_the_size_of_its_imbalance():
    r = MODELS["olaru2005"](SCREW, OIL, axial_load=4000.0, screw_speed=SPEEDS)
    power = sum(r.dissipation.values())
    largest = np.max(np.abs(r.screw_torque * SPEEDS - power)[1:] / power[1:])
    record = record_of(r)
    assert record.value == pytest.approx(largest, rel=1e-12)
    assert 0.05 < largest < 0.06
    assert f"by up to {100 * largest:.1f}%" in record.text
    assert "negative" not in record.text
    assert [text for text in r.warnings if text.startswith("power_balance: ")]


def test_a_negative_torque_on_the_nut_is_named():
    r = MODELS["olaru2005"](SCREW, OIL, axial_load=500.0, screw_speed=SPEEDS[:2])
    assert r.nut_torque[0] < 0
    assert "the torque on the nut falls below zero" in record_of(r).text


@pytest.mark.parametrize("name", ["corrected", "reference"])
def test_models_in_balance_say_nothing(name):
    for lead in (0.005, 0.02):
        screw = bs.BallScrew(0.04, lead, 3.175e-3, 56, math.pi / 4, 0.53, 0.53)
        assert record_of(MODELS[name](screw, OIL, axial_load=4000.0, screw_speed=SPEEDS)) is None
