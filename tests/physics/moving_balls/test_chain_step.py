"""One moment of the chain: against a dual solved by non-negative least squares, and by the conditions of an optimum."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear, nnls

from ballscrew.physics.moving_balls.chain import Driven, compiled_pushed_balls, pushed_balls

#: Chains of random balls.
SEEDS = range(100)


def random_balls(seed, *, limits=True, drags=True):
    """Balls that touch in rows of some length; a fifth of them is not driven at all."""
    generator = np.random.default_rng(seed)
    count = int(generator.integers(2, 60))
    slope = generator.uniform(0.5, 2.0, count)
    speed = 1 + 0.1 * generator.standard_normal(count)
    limit = generator.uniform(0.02, 0.1, count) if limits else np.full(count, 1e9)
    resistance = np.zeros(count)
    if drags:
        idle = generator.random(count) < 0.2
        slope[idle], limit[idle], speed[idle] = 0.0, 0.0, 0.0
        resistance[idle] = generator.uniform(0.0, 0.05, int(np.sum(idle)))
        resistance[generator.random(count) < 0.1] += 0.02
    touches = generator.random(count) < 0.8
    touches[-1] = False
    return Driven(speed, slope, limit, resistance), touches


def solved(balls, touches):
    return (np.array(each) for each in pushed_balls(Driven(*(each.tolist() for each in balls)), touches.tolist()))


def pushes_of(touches):
    """A column for each pair that touches: it pushes the one ball forward and the other back."""
    count = len(touches)
    pairs = np.flatnonzero(touches[:-1])
    push = np.zeros((count, len(pairs)))
    push[pairs + 1, np.arange(len(pairs))] = 1.0
    push[pairs, np.arange(len(pairs))] = -1.0
    return push, pairs


@pytest.mark.parametrize("seed", SEEDS)
def test_the_step_is_that_of_the_dual(seed):
    # linear creep: the least power is a quadratic programme, whose dual is a least-squares problem of pushes >= 0
    balls, touches = random_balls(seed, limits=False, drags=False)
    speed, force, _ = solved(balls, touches)
    push, pairs = pushes_of(touches)
    root = np.sqrt(balls.slope)
    found = nnls(push / root[:, None], -root * balls.speed)[0] if pairs.size else np.zeros(0)
    assert speed == pytest.approx(balls.speed + push @ found / balls.slope, abs=1e-9)
    assert force[pairs] == pytest.approx(found, abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_dry_friction_is_that_of_the_dual(seed):
    # dry friction is a further unknown of the dual, between its limits
    balls, touches = random_balls(seed, limits=False, drags=False)
    drag = np.random.default_rng(seed).uniform(0.0, 2.0, len(touches))
    speed, force, _ = solved(balls._replace(resistance=drag), touches)
    push, pairs = pushes_of(touches)
    root = np.sqrt(balls.slope)
    columns = np.hstack([push, np.eye(len(touches))]) / root[:, None]
    low = np.concatenate([np.zeros(pairs.size), -drag])
    high = np.concatenate([np.full(pairs.size, np.inf), drag])
    dual = lsq_linear(columns, -root * balls.speed, (low, high), method="bvls", tol=1e-14, max_iter=2000).x
    assert speed == pytest.approx(balls.speed + (columns @ dual) / root, abs=1e-9)
    if np.all(speed != 0):  # where a ball is held at rest, the forces are open
        assert force[pairs] == pytest.approx(dual[: pairs.size], abs=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_step_is_an_optimum(seed):
    # with limits of the drive, and balls without any: the conditions of the least power, which is convex
    balls, touches = random_balls(seed)
    speed, force, drive = solved(balls, touches)
    assert np.all(force >= 0)
    assert np.all(force[~touches] == 0)
    pressing = np.flatnonzero(force > 0)
    assert np.all(speed[pressing + 1] == speed[pressing])  # complementary: who presses does not part
    together = np.flatnonzero(touches)
    assert np.all(speed[together + 1] >= speed[together])
    assert drive == pytest.approx(np.clip(balls.slope * (balls.speed - speed), -balls.limit, balls.limit), abs=1e-15)
    friction = -(drive + np.concatenate([[0.0], force[:-1]]) - force)
    moving = speed != 0
    assert friction[moving] == pytest.approx(-np.sign(speed[moving]) * balls.resistance[moving], abs=1e-12)
    assert np.all(np.abs(friction[~moving]) <= balls.resistance[~moving] + 1e-12)


@pytest.mark.compiles
@pytest.mark.parametrize("seed", SEEDS)
def test_the_kernel_takes_the_same_steps(seed):
    # 1e-12 is asked for; every operation rounds alike, so that nothing differs
    balls, touches = random_balls(seed)
    found = compiled_pushed_balls(np.array(balls), touches)
    for by_kernel, one in zip(found, solved(balls, touches), strict=True):
        assert np.array_equal(by_kernel, one)


def test_forces_at_rest_are_the_least():
    # a ball that slides pushes against two that stand: the first holds all it can, the second the rest
    balls = Driven([1.0, 0.0, 0.0, 0.0], [10.0, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0], [0.0, 0.3, 0.3, 0.3])
    found = pushed_balls(balls, [True, True, True, False])
    assert found.speed == [0.0] * 4
    assert found.force == pytest.approx([0.5, 0.2, 0.0, 0.0], abs=1e-15)


def test_a_drive_that_ends_lets_its_ball_slide():
    # two balls, of which the one in front has less friction than the difference of speeds asks for
    found = pushed_balls(Driven([2.0, 1.0], [1.0, 1.0], [10.0, 0.1], [0.0, 0.0]), [True, False])
    assert found.speed == pytest.approx([1.9, 1.9], abs=1e-15)
    assert found.force == pytest.approx([0.1, 0.0], abs=1e-15)
