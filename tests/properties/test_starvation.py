"""Laws of starvation: a full bath of oil never rolls more easily, and one rule tells where the torques differ."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.components.lubrication import Inlet
from ballscrew.friction import starvation
from ballscrew.friction.model import FrictionModel

MODEL = FrictionModel.reference()
SCREW = bs.BallScrew(
    pitch_circle_diameter=0.0414, lead=0.01, ball_diameter=0.00635, loaded_balls=75, contact_angle=np.pi / 4,
    screw_conformity=0.54, nut_conformity=0.54,
)  # fmt: skip
CELSIUS = 273.15


def result(temperature, load, speed, grade="ISO VG 100", model=MODEL):
    oil = bs.Lubricant.from_grade(grade, temperature + CELSIUS)
    return model(SCREW, oil, axial_load=load, screw_speed=speed)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-20.0, 90.0), st.floats(100.0, 30e3), st.floats(0.1, 400.0), st.sampled_from(["ISO VG 32", "ISO VG 220"])
)
def test_a_full_bath_never_has_the_smaller_torque(temperature, load, speed, grade):
    found = result(temperature, load, speed, grade)
    assert found.flooded_torque >= found.screw_torque * (1 - 1e-9)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-20.0, 90.0), st.floats(100.0, 30e3), st.floats(0.1, 400.0), st.sampled_from(["ISO VG 32", "ISO VG 220"])
)
def test_the_record_stands_exactly_where_the_torques_differ_by_more_than_a_tenth(temperature, load, speed, grade):
    found = result(temperature, load, speed, grade)
    bath = result(temperature, load, speed, grade, dataclasses.replace(MODEL, inlet=Inlet(replenishment_constant=0.0)))
    assert found.flooded_torque == pytest.approx(bath.screw_torque, rel=1e-12)
    said = [record for record in found.warning_records if record.id == starvation.STARVED]
    # also where the little that is late is taken for nothing without asking for the other torque
    assert bool(said) == bool(bath.screw_torque > 1.1 * found.screw_torque)
    assert not [record for record in bath.warning_records if record.id == starvation.STARVED]
    assert bath.flooded_torque == bath.screw_torque


def test_of_an_array_the_point_is_named_that_starves_the_most():
    found = result(np.array([60.0, 0.0, -10.0]), 3e3, 100.0)
    (record,) = found.starvation
    ratio = found.flooded_torque / found.screw_torque
    assert ratio.argmax() == 2
    assert record.value == found.flooded_torque[2]
    assert record.limit == found.screw_torque[2]


def test_a_model_whose_inlet_is_always_full_has_one_torque():
    paper = FrictionModel.corrected()
    found = result(-10.0, 3e3, 100.0, model=paper)
    assert found.flooded_torque == found.screw_torque
    assert found.starvation == []
