"""Worked examples of catalogues for the torque of a motor, by their own rules, within 0.5 %."""

import math

import pytest

import duty_examples

#: Their sources round in between: 0.5 %.
AS_PRINTED = 5e-3
EXAMPLES = [pytest.param(example, id=example.name) for example in duty_examples.EXAMPLES]


@pytest.mark.parametrize("example", EXAMPLES)
def test_torques_as_printed(example):
    if example.printed_rms is not None:
        assert example.rule.torque_rms == pytest.approx(example.printed_rms, rel=AS_PRINTED)
    assert example.rule.torque_peak == pytest.approx(example.printed_peak, rel=AS_PRINTED)


def test_mean_load_and_life_as_printed():
    *_, mean, turns = duty_examples.THK_LIFE
    life = duty_examples.life_of_thk()
    assert life.mean_load == pytest.approx(mean, rel=AS_PRINTED)
    assert life.revolutions_of_the_worse == pytest.approx(turns, rel=AS_PRINTED)
    # both flanks carry it, so that one or the other fails sooner: Weibull's 2^-0.9
    assert life.revolutions == pytest.approx(2**-0.9 * life.revolutions_of_the_worse, rel=1e-12)


def test_the_root_mean_square_of_a_trapezoid_in_closed_form():
    """Constant torques in each phase, so that the quadrature has nothing to lose."""
    example = duty_examples.EXAMPLES[0]
    axis, motion, arm = example.axis, example.motion, example.lead / (2 * math.pi)
    rubs = axis.resting_guide_friction

    def torque(acceleration):
        load = axis.mass * acceleration + rubs
        friction = abs(load) * arm * (1 / example.efficiency - 1)
        return load * arm + friction + axis.inertia * acceleration / arm

    time = motion.speed / motion.acceleration
    cruise = motion.stroke / motion.speed - time
    squares = time * (torque(motion.acceleration) ** 2 + torque(-motion.acceleration) ** 2) + cruise * torque(0.0) ** 2
    rms = math.sqrt(squares / (2 * time + cruise + motion.dwell))
    assert example.duty.torque_rms == pytest.approx(rms, rel=1e-12)
