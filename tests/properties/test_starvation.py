"""Laws of starvation: a full bath of oil never rolls more easily, and one rule tells where the torques differ."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.duty_cycle.brake import brake_of
from ballscrew.axis.duty_cycle.drive_sizing import MotorCheck
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.inlet import Inlet
from support.screws import screw

MODEL = FrictionModel.reference()
SCREW = screw(pitch_circle_diameter=0.0414, ball_diameter=0.00635, loaded_balls=75)
CELSIUS = 273.15


def result(temperature, load, speed, grade="ISO VG 100", model=MODEL):
    oil = bs.Lubricant.from_grade(grade, temperature + CELSIUS)
    return model(SCREW, oil, axial_load=load, screw_speed=speed)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-20.0, 90.0), st.floats(100.0, 30e3), st.floats(0.1, 400.0), st.sampled_from(["ISO VG 32", "ISO VG 220"])
)
def test_a_full_bath_never_has_the_smaller_torque_where_the_heat_of_the_inlet_is_known(temperature, load, speed, grade):
    """Beyond, under loads that no screw of this size bears in such cold, a thick film may rub less than none."""
    found = result(temperature, load, speed, grade)
    if found.validity["inlet_heating"]:
        assert found.flooded_torque >= found.screw_torque * (1 - 1e-9)
    else:
        assert found.flooded_torque >= 0.7 * found.screw_torque


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(
    st.floats(-20.0, 90.0), st.floats(100.0, 30e3), st.floats(0.1, 400.0), st.sampled_from(["ISO VG 32", "ISO VG 220"])
)
def test_the_record_stands_exactly_where_the_torques_differ_by_more_than_a_tenth(temperature, load, speed, grade):
    found = result(temperature, load, speed, grade)
    bath = result(temperature, load, speed, grade, dataclasses.replace(MODEL, inlet=Inlet(replenishment_constant=0.0)))
    assert found.flooded_torque == pytest.approx(bath.screw_torque, rel=1e-12)
    said = [record for record in found.warning_records if record.id == validity.STARVED]
    # also where the little that is late is taken for nothing without asking for the other torque
    low, high = sorted((float(found.screw_torque), float(bath.screw_torque)))
    assert bool(said) == bool(high > 1.1 * low)
    assert not [record for record in bath.warning_records if record.id == validity.STARVED]
    assert bath.flooded_torque == bath.screw_torque


def test_an_inlet_without_oil_has_no_film_and_the_friction_of_rest():
    """Film and rolling force are of one inlet: where it leaves nothing of the one, it leaves nothing of the other."""
    braced = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=3605.0))
    oil = bs.Lubricant.from_grade("ISO VG 220", CELSIUS - 20)

    def torque(speed, model=MODEL):
        return model(braced, oil, axial_load=0.0, screw_speed=speed)

    starved, rest = torque(100.0), torque(0.0)
    film = starved.minimum_film_parameter / torque(100.0, MODEL.in_full_bath).minimum_film_parameter
    assert starved.contributions["hydrodynamic_rolling"] < 1e-6 * starved.screw_torque
    assert film < 1e-4
    assert starved.screw_torque == pytest.approx(rest.screw_torque, rel=0.01)
    # a track that leaves a half of the rolling force has the film of a full one, to the last bit
    inlet = torque(100.0, dataclasses.replace(MODEL, inlet=Inlet(inlet_film_ratio=10.0, replenishment_constant=0.0)))
    assert inlet.minimum_film_parameter == torque(100.0, MODEL.in_full_bath).minimum_film_parameter


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


ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
NUTS = (bs.SingleNut(), bs.DoubleNut(preload=3605.0), bs.OversizeBallNut(preload=2000.0))
MOTION = Trapezoid(stroke=0.3, speed=0.2, acceleration=4.0, dwell=0.5)
UPRIGHT = Axis(mass=150.0, inclination=np.pi / 2, inertia=3e-3)


#: A cycle whose screw can be starved has states where either condition turns, one in a full bath its own alone: other
#: nodes, which integrate friction near rest to 1e-4, and another polynomial through them, with its largest value 2e-6
#: off.
OF_NODES, OF_TURNS = 1e-4, 1e-5


def cycle(temperature, nut, constant, grade="ISO VG 100"):
    model = dataclasses.replace(MODEL, inlet=Inlet(replenishment_constant=constant))
    oil = bs.Lubricant.from_grade(grade, temperature + CELSIUS)
    return duty(model, ROW.screw(nut=nut), oil, axis=UPRIGHT, motion=MOTION)


@pytest.mark.slow
@pytest.mark.parametrize("nut", NUTS, ids=lambda nut: type(nut).__name__)
def test_the_torque_that_a_motor_is_judged_by_is_never_below_that_of_either_condition(nut):
    for temperature in (-10.0, 5.0, 25.0, 60.0):
        starved, bath = cycle(temperature, nut, 3e-8), cycle(temperature, nut, 0.0)
        motor = Motor(rated_torque=5.0, peak_torque=15.0, largest_speed=300.0)
        checks = {one.name: one.value for one in MotorCheck(starved, motor).checks}
        if starved.starved:
            for found, integral, largest in ((starved, 1e-12, 1e-12), (bath, OF_NODES, OF_TURNS)):
                assert checks["motor_rms_torque"] >= found.torque_rms * (1 - integral)
                assert checks["motor_peak_torque"] >= found.torque_peak * (1 - largest)
        full = bath.driven.along(starved.axial_load, starved.screw_speed, starved.states.temperature)
        ratio = np.max((full.torque / starved.screw.torque)[starved.states.direction != 0])
        assert starved.starved == (ratio > 1.1)
        assert not bath.starved
        assert bath.flooded is bath
        assert starved.flooded.torque_peak == pytest.approx(bath.torque_peak, rel=OF_TURNS)


@pytest.mark.slow
@pytest.mark.parametrize("nut", NUTS, ids=lambda nut: type(nut).__name__)
def test_an_axis_that_is_let_go_has_the_smaller_friction_where_it_is_starved(nut):
    """So that a brake, and whether the load drives, are judged by it with the inlet as it is given."""
    starved, bath = (brake_of(cycle(-5.0, nut, constant)) for constant in (3e-8, 0.0))
    for one, other in zip(starved.conditions, bath.conditions, strict=True):
        assert one.running_torque <= other.running_torque * (1 + 1e-9)
        assert one.breakaway_torque == pytest.approx(other.breakaway_torque, rel=1e-9)
    assert starved.holding_torque >= bath.holding_torque
    assert starved.brake_torque >= bath.brake_torque
