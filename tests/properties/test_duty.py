"""Laws of mechanics over a cycle of any axis: energy, raising and lowering, what the parts sum to."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.duty_cycle.brake import brake_of
from ballscrew.axis.duty_cycle.drive_sizing import CycleLife, MotorCheck, VendorRule
from ballscrew.axis.duty_cycle.duty import duty
from ballscrew.axis.duty_cycle.duty_band import duty_band, numbers_of_cycle
from ballscrew.axis.motion.profiles import SCurve, Segment, Segments, Sine, Trapezoid
from ballscrew.basis.errors import InputError
from support.equations import mechanical_energy
from support.strategies import MODELS, floats, powers

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
NUTS = (
    bs.SingleNut(),
    bs.DoubleNut(preload=3605.0),
    bs.OversizeBallNut(preload=2000.0),
    bs.DoubleNut(preload=3605.0, losses={"seals": bs.Seals(0.3)}),
)
#: Models that keep virtual work, and efficiencies, each with a nut that it knows.
MECHANICS = st.sampled_from(
    [(0.9, NUTS[0]), (0.4, NUTS[0]), (MODELS["corrected"], NUTS[1]), *((MODELS["reference"], nut) for nut in NUTS)]
)


@st.composite
def motions(draw):
    """Any motion, closed or not."""
    stroke, speed, acceleration = draw(powers(0.02, 2.0)), draw(powers(0.01, 1.0)), draw(powers(0.1, 20.0))
    force = draw(floats(-2000, 2000))
    match draw(st.sampled_from(["trapezoid", "s-curve", "sine", "segments"])):
        case "trapezoid":
            dwell, returns = draw(floats(0, 3)), draw(st.booleans())
            return Trapezoid(
                stroke=stroke, speed=speed, acceleration=acceleration, dwell=dwell, force=force, returns=returns
            )
        case "s-curve":
            return SCurve(stroke=stroke, speed=speed, acceleration=acceleration, jerk=draw(powers(1, 1000)))
        case "sine":
            return Sine(stroke=stroke, frequency=speed / stroke / math.pi, return_force=force)
        case _:
            return Segments(
                segments=(
                    Segment(distance=stroke, speed=speed, force=force),
                    Segment(duration=1.0),
                    Segment(duration=stroke / speed, speed=-speed, force=-force),
                ),
                acceleration=acceleration,
            )


@st.composite
def axes(draw):
    """Any axis, inclined and geared."""
    return Axis(
        mass=draw(powers(1, 2000)),
        inclination=draw(floats(-math.pi / 2, math.pi / 2)),
        counterweight=draw(floats(0, 300)),
        counterforce=draw(floats(0, 500)),
        guide_friction_coefficient=draw(floats(0, 0.2)),
        guide_seal_force=draw(floats(0, 50)),
        inertia=draw(powers(1e-5, 1e-1)),
        bearing_torque=draw(floats(0, 0.5)),
        transmission_ratio=draw(powers(0.5, 10)),
        transmission_efficiency=draw(floats(0.8, 1.0)),
    )


@pytest.mark.slow
@settings(max_examples=25)
@given(axes(), motions(), MECHANICS)
def test_energy_of_a_cycle(axis, motion, mechanics):
    """Drawn less returned is what is stored, lost and done; every loss is one."""
    model, nut = mechanics
    found = duty(model, ROW.screw(nut=nut), OIL, axis=axis, motion=motion)
    scale = found.energy_drawn + found.energy_returned
    balance = found.energy_drawn - found.energy_returned
    balance -= mechanical_energy(found) + found.energy_lost + found.energy_of_process
    assert abs(balance) < 1e-9 * scale
    assert found.energy_stored == pytest.approx(mechanical_energy(found), abs=1e-9 * scale)
    assert min(found.energy_lost_by.values()) >= -1e-9 * scale
    assert np.sum(list(found.parts.values()), axis=0) == pytest.approx(found.torque, rel=1e-12, abs=1e-12)


@settings(max_examples=15)
@given(axes(), MECHANICS)
def test_lowering_asks_for_less_than_raising(axis, mechanics):
    upright = dataclasses.replace(axis, inclination=math.pi / 2, counterweight=0.0, counterforce=0.0)
    model, nut = mechanics
    screw = ROW.screw(nut=nut)
    way = {"duration": 1.0, "speed": 0.1}
    up, down = (
        duty(model, screw, OIL, axis=upright, motion=Segments(segments=(Segment(**way | {"speed": speed}),)))
        for speed in (0.1, -0.1)
    )
    assert down.torque[1] < up.torque[1]


@settings(max_examples=15)
@given(axes(), motions())
def test_a_brake_takes_the_torque_of_rests(axis, motion):
    """It changes nothing in motion, and no energy."""
    free = duty(0.9, ROW.screw(), OIL, axis=axis, motion=motion)
    held = duty(0.9, ROW.screw(), OIL, axis=dataclasses.replace(axis, brake_holds=True), motion=free.states)
    rests = free.states.direction == 0
    assert held.torque[~rests] == pytest.approx(free.torque[~rests], rel=1e-15)
    assert np.all(np.abs(held.torque[rests]) <= 1e-12 * (1 + np.abs(free.torque[rests])))
    assert held.torque_rms <= free.torque_rms
    assert held.energy_drawn == free.energy_drawn


UPRIGHT = Axis(mass=100.0, inclination=math.pi / 2, inertia=1e-3)
SHORT = Trapezoid(stroke=0.3, speed=0.2, acceleration=2.0)


def test_power_off():
    """A self-locking screw stays, a good one falls with the acceleration that its friction leaves."""
    locks = brake_of(duty(0.4, ROW.screw(), axis=UPRIGHT, motion=SHORT))
    assert not locks.falls
    assert locks.holding_torque == locks.brake_torque == 0.0
    falls = brake_of(duty(0.9, ROW.screw(), axis=UPRIGHT, motion=SHORT))
    (alone,) = falls.conditions
    arm = ROW.lead / (2 * math.pi)
    pull = 100 * 9.80665 * arm * (2 - 1 / 0.9)
    assert falls.falls
    assert falls.holding_torque == pytest.approx(pull, rel=1e-12)
    assert alone.acceleration == pytest.approx(pull / (100 * arm**2 + 1e-3) * arm, rel=1e-12)
    assert alone.speed_after_stroke == pytest.approx(math.sqrt(2 * alone.acceleration * 0.3), rel=1e-12)


def test_a_level_axis_needs_no_brake():
    level = brake_of(duty(MODELS["reference"], ROW.screw(), OIL, axis=Axis(mass=100.0), motion=SHORT))
    assert not level.falls
    assert {found.acceleration for found in level.conditions} == {0.0}
    assert {found.condition for found in level.conditions} == {"as in the case", "cold", "hot", "dry"}


def test_a_steady_fall_is_one():
    """At the steady speed friction and weight are equal."""
    light = dataclasses.replace(UPRIGHT, mass=37.0)
    of_case = duty(MODELS["reference"], ROW.screw(nut=bs.DoubleNut(preload=3605.0)), OIL, axis=light, motion=SHORT)
    slow = [found for found in brake_of(of_case).conditions if 0 < found.steady_speed < math.inf]
    assert slow
    for found in slow:
        motion = Segments(segments=(Segment(duration=1.0, speed=-found.steady_speed, temperature=found.temperature),))
        falling = duty(of_case.driven.model, of_case.driven.screw, OIL, axis=light, motion=motion)
        assert falling.torque[1] == pytest.approx(0.0, abs=1e-5 * abs(found.load_torque))


def test_life_of_a_preloaded_nut_is_shorter():
    axis = Axis(mass=100.0)
    found = duty(0.9, ROW.screw(), axis=axis, motion=SHORT)
    lives = [CycleLife(found, nut, preload, 38e3).revolutions for nut, preload in ((NUTS[0], 0.0), (NUTS[1], 3605.0))]
    assert lives[1] < lives[0] < math.inf


def test_a_motor_that_fits_and_one_that_does_not():
    found = duty(0.9, ROW.screw(), axis=UPRIGHT, motion=SHORT)
    fastest, peak = float(np.max(found.motor_speed)), found.torque_peak
    fits = Motor(rated_torque=1.01 * found.torque_rms, peak_torque=1.01 * peak, largest_speed=1.01 * fastest)
    assert all(check.holds for check in MotorCheck(found, fits).checks)
    weak = dataclasses.replace(fits, curve=((0.0, 1.01 * peak), (1.01 * fastest, 0.5 * peak)))
    rms, torque, speed = MotorCheck(found, weak).checks
    assert (rms.holds, torque.holds, speed.holds) == (True, False, True)
    slow = dataclasses.replace(fits, largest_speed=0.9 * fastest)
    _, beyond, _ = MotorCheck(found, slow).checks
    assert math.isinf(beyond.utilisation)
    needed, ends = (f"{float(f'{speed * 30 / math.pi:.4g}'):g} rpm" for speed in (fastest, 0.9 * fastest))
    assert beyond.text == f"the motor has no torque above {ends}, where its curve ends; the cycle needs {needed}"
    heated = dataclasses.replace(fits, torque_constant=0.5, resistance=2.0)
    cycle = found.states.cycle_time
    assert MotorCheck(found, heated).copper_loss == pytest.approx(2.0 * found.torque_rms**2 / 0.25 * cycle, rel=1e-12)


@pytest.mark.slow
def test_a_band_of_a_cycle():
    """Its numbers are those of the duty for its own friction, and a wider input makes a wider band."""
    axis = dataclasses.replace(UPRIGHT, transmission_efficiency=0.9, transmission_ratio=2.0, bearing_torque=0.1)
    found = duty(MODELS["reference"], ROW.screw(nut=NUTS[1]), OIL, axis=axis, motion=SHORT)
    own = numbers_of_cycle(found, found.screw.torque[None, :])
    for name in ("torque_rms", "torque_peak", "energy_drawn", "energy_returned", "energy_lost"):
        assert own[name][0] == pytest.approx(getattr(found, name), rel=1e-12)
    bands = [
        duty_band(found, distributions={"nut.preload": bs.Normal(3605.0, spread)}, samples=256)["energy_lost"]
        for spread in (100.0, 500.0)
    ]
    widths = [(each.band.high - each.band.low) / each.median for each in bands]
    assert widths[0] * 4 < widths[1] < widths[0] * 6
    assert all(each.band.low < each.value < each.band.high for each in bands)
    with pytest.raises(InputError, match="model"):
        duty_band(duty(0.9, ROW.screw(), axis=axis, motion=SHORT), distributions={})


def test_an_oil_without_a_temperature():
    """It has one viscosity; a recorded motion and power off take it."""
    plain = bs.Lubricant(viscosity=0.088)
    found = duty(MODELS["reference"], ROW.screw(nut=NUTS[1]), plain, axis=UPRIGHT, motion=SHORT)
    assert math.isfinite(found.torque_rms)
    assert {one.condition for one in brake_of(found).conditions} == {"as in the case", "dry"}


def test_a_machine_upside_down_is_the_same():
    """Positive motion downwards, with a counterweight: every torque changes its sign, and its time."""
    balanced = dataclasses.replace(UPRIGHT, counterweight=60.0, counterforce=100.0, guide_seal_force=20.0)
    turned = dataclasses.replace(balanced, inclination=-math.pi / 2)
    up, down = (duty(0.9, ROW.screw(), axis=axis, motion=SHORT) for axis in (balanced, turned))
    assert down.torque_rms == pytest.approx(up.torque_rms, rel=1e-12)
    assert down.energy_drawn == pytest.approx(up.energy_drawn, rel=1e-12)
    assert brake_of(down).brake_torque == pytest.approx(brake_of(up).brake_torque, rel=1e-12)


def test_power_fails_in_motion():
    """Friction falls from creep on (Stribeck): an axis that would stay at rest may go on falling."""
    light = dataclasses.replace(UPRIGHT, mass=33.0)
    found = duty(MODELS["reference"], ROW.screw(nut=NUTS[1]), OIL, axis=light, motion=SHORT)
    for one in brake_of(found).conditions[:3]:
        speeds = np.geomspace(0.01, float(np.max(found.screw_speed)), 200)
        load = np.full_like(speeds, found.axis.gravity_force)
        warm = np.full_like(speeds, one.temperature or 313.15)
        least = float(np.min(found.driven.along(load, -speeds, warm).torque))
        assert one.running_torque == pytest.approx(least, rel=5e-3)
        assert one.goes_on == (one.running_torque < abs(one.load_torque))
    # another temperature moves the least of the Stribeck curve to another speed, and hardly changes it
    given, cold, hot, _ = (one.running_torque for one in brake_of(found).conditions)
    assert (cold, hot) == pytest.approx((given, given), rel=0.02)


def test_elements_beside_the_screw_count_everywhere():
    """In the torque, with the motor off and by the rule; not under the name of another part."""

    class Rubs:
        """A constant drag."""

        def __call__(self, state):
            return SimpleNamespace(friction_effort=0.3, contributions={"wiper": 0.3})

    bare, more = (
        duty(0.9, ROW.screw(), axis=UPRIGHT, motion=SHORT, also=also) for also in (None, {"wiper of the shaft": Rubs()})
    )
    moving = bare.states.direction != 0
    assert (more.torque - bare.torque)[moving] == pytest.approx(0.3 * bare.states.direction[moving], rel=1e-9)
    assert brake_of(more).holding_torque == pytest.approx(brake_of(bare).holding_torque - 0.3, rel=1e-9)
    by_rule = VendorRule(more, 0.9).torque - VendorRule(bare, 0.9).torque
    assert by_rule == pytest.approx(0.3 * bare.states.direction, rel=1e-9, abs=1e-12)
    with pytest.raises(InputError, match=r"duty\.also"):
        duty(0.9, ROW.screw(), axis=UPRIGHT, motion=SHORT, also={"gravity": Rubs()})


def test_loads_that_are_no_number_have_no_life():
    axis = dataclasses.replace(UPRIGHT, mass=1e308, counterweight=1e308)
    with np.errstate(all="ignore"):
        found = duty(0.9, ROW.screw(), axis=axis, motion=SHORT)
        assert math.isnan(CycleLife(found, NUTS[0], 0.0, 38e3).revolutions)
        assert brake_of(found).falls


@pytest.mark.parametrize(
    ("build", "named"),
    [
        (lambda: duty(1.2, ROW.screw(), axis=UPRIGHT, motion=SHORT), "model.efficiency"),
        (lambda: duty(math.nan, ROW.screw(), axis=UPRIGHT, motion=SHORT), "model.efficiency"),
        (lambda: duty(MODELS["reference"], ROW.screw(), axis=UPRIGHT, motion=SHORT), "duty.lubricant"),
        (lambda: dataclasses.replace(UPRIGHT, transmission_efficiency=0.4), "axis.transmission_efficiency"),
        (lambda: Motor(rated_torque=1, peak_torque=2, largest_speed=9, curve=((0, 5), (9, 5))), "motor.curve"),
        (lambda: Motor(rated_torque=1, peak_torque=2, largest_speed=9, curve=((0, 2), (5, 2))), "motor.curve"),
        (lambda: Segment(distance=0.1, speed=-0.1, acceleration=1.0), "segment.speed"),
        (lambda: Segment(duration=1.0, speed=0.1, acceleration=1.0), "segment.acceleration"),
    ],
)
def test_what_contradicts_is_refused(build, named):
    with pytest.raises(InputError, match=named):
        build()
