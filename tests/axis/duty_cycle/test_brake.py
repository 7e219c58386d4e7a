"""The brake of an axis against the weight that hangs on it: by hand, whatever friction there is."""

import math
from types import SimpleNamespace

import pytest

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.duty_cycle.brake import brake_of
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.motion.profiles import Trapezoid

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
MOTION = Trapezoid(stroke=0.3, speed=0.2, acceleration=2.0)
GRAVITY, MASS, RATIO = 9.80665, 100.0, 2.0
#: Torque of the weight about the motor, no friction.
WEIGHT = MASS * GRAVITY * ROW.lead / (2 * math.pi) / RATIO


def upright(driven, *, process_force=0.0, **options):
    axis = Axis(mass=MASS, inclination=math.pi / 2, transmission_ratio=RATIO)
    screw = ROW.screw(nut=bs.DoubleNut(preload=1000.0)) if isinstance(driven, bs.FrictionModel) else ROW.screw()
    found = duty(driven, screw, OIL, axis=axis, motion=MOTION)
    return brake_of(found, process_force=process_force, **options)


@pytest.mark.parametrize("driven", [0.9, bs.FrictionModel.reference(), bs.FrictionModel.corrected()])
def test_a_rated_brake_holds_the_weight_without_any_help_of_friction(driven):
    brake = upright(driven)
    assert brake.load_torque == pytest.approx(WEIGHT, rel=1e-12)
    assert brake.brake_torque == pytest.approx(2 * WEIGHT, rel=1e-12)
    assert upright(driven, brake_factor=1.5).brake_torque == pytest.approx(1.5 * WEIGHT, rel=1e-12)


def test_cold_hot_and_dry_change_what_holds_the_axis_and_not_the_rated_brake():
    brake = upright(bs.FrictionModel.reference())
    held = {one.condition: one.holding_torque for one in brake.conditions}
    assert set(held) == {"as in the case", "cold", "hot", "dry"}
    assert len({round(torque, 6) for torque in held.values()}) > 1
    assert [one.load_torque for one in brake.conditions] == pytest.approx([WEIGHT] * 4, rel=1e-12)
    # the least help of friction counts, and none of it goes into the rated torque
    assert brake.holding_torque == max(held.values()) < WEIGHT
    assert min(held.values()) < brake.holding_torque


def test_what_rubs_beside_the_screw_does_so_at_the_temperature_of_each_condition():
    class Warmed:
        """A drag that falls with the temperature of its oil; of that of the case where none is given."""

        def __call__(self, state):
            torque = 0.1 * (400.0 - (313.15 if state.temperature is None else state.temperature)) / 100.0
            return SimpleNamespace(contributions={"drag": torque + 0 * state.screw_speed}, validity={})

    axis = Axis(mass=MASS, inclination=math.pi / 2, transmission_ratio=RATIO)
    screw = ROW.screw(nut=bs.DoubleNut(preload=1000.0))
    bare, more = (
        brake_of(duty(bs.FrictionModel.reference(), screw, OIL, axis=axis, motion=MOTION, also=also))
        for also in ({}, {"wiper": Warmed()})
    )
    wanted = {"as in the case": 0.08685, "cold": 0.12185, "hot": 0.06685, "dry": 0.08685}
    for one, other in zip(bare.conditions, more.conditions, strict=True):
        drag = wanted[one.condition] / RATIO
        assert other.running_torque - one.running_torque == pytest.approx(drag, rel=1e-9)
        assert other.breakaway_torque - one.breakaway_torque == pytest.approx(drag, rel=1e-9)


def test_friction_of_one_efficiency_helps_by_what_the_balance_of_power_gives():
    """Raised at η, the screw takes load/η: what it loses, (1/η − 1) of the load, holds when it is let go."""
    (alone,) = upright(0.9).conditions
    assert alone.running_torque == pytest.approx(WEIGHT * (1 / 0.9 - 1), rel=1e-12)
    assert alone.holding_torque == pytest.approx(WEIGHT * (2 - 1 / 0.9), rel=1e-12)
    assert alone.safety == pytest.approx(1 / 0.9 - 1, rel=1e-12)


def test_a_motor_that_holds_without_current_keeps_the_axis_at_rest_and_spares_no_brake():
    """Friction of one efficiency holds 1/0.9 − 1 of the load; in motion a detent gives back what it takes."""
    rest = 2 - 1 / 0.9
    barely, little = (upright(0.9, motor_torque=share * rest * WEIGHT) for share in (1.001, 0.999))
    assert (barely.starts, barely.falls, little.starts) == (False, True, True)
    assert barely.brake_torque == little.brake_torque == pytest.approx(2 * WEIGHT, rel=1e-12)
    assert barely.conditions[0].safety == pytest.approx(1 + 0.001 * rest, rel=1e-12)


def test_a_process_force_adds_to_the_weight():
    arm = ROW.lead / (2 * math.pi) / RATIO
    assert upright(0.9, process_force=500.0).load_torque == pytest.approx(WEIGHT + 500.0 * arm, rel=1e-12)
    # one that holds the weight up leaves the brake the rest
    assert upright(0.9, process_force=-500.0).load_torque == pytest.approx(WEIGHT - 500.0 * arm, rel=1e-12)
    relieved = upright(0.9, process_force=-MASS * GRAVITY)
    assert (relieved.falls, relieved.brake_torque) == (False, 0.0)


def test_an_axis_that_friction_holds_in_all_conditions_needs_no_brake():
    locks = upright(0.45)
    assert (locks.starts, locks.falls, locks.brake_torque, locks.holding_torque) == (False, False, 0.0, 0.0)
