r"""Speeds of balls behind one another, and the forces between those that touch, at one moment.

Each ball would travel at the natural speed of its place. Its contacts resist any other by a force that is linear in the
difference and ends where they slide, :math:`h = \min(\max(c (v - w), -l), l)`; a ball that no race drives resists
motion by a dry friction f. A ball is never faster than the one that it touches in front. The speeds are those with the
least power:

.. math:: \min \sum_j f_j |w_j| - \int h_j \mathrm{d} w_j, \quad w_{j+1} \ge w_j

This is an isotonic regression, and pooling adjacent violators is exact: neighbours that would run into each other are
one block with one speed, at which the forces of its balls add up to nothing. That sum is a broken line that falls with
the speed; its root is found by a walk from break to break. The forces between neighbours are the multipliers of the
constraints: sums of h over the balls behind.

Where balls at rest leave the forces between them open, they are the least ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.pooled_row import pooled_row


class Pushed(NamedTuple):
    """Speeds of balls in a row, the last one first, and what each presses the next one with."""

    speed: list[float]
    #: Force between each ball and the one before it; the last is zero.
    force: list[float]
    #: Force of the races on each ball along the path.
    drive: list[float]


class Driven(NamedTuple):
    """Balls in a row, from behind: their natural speeds, slopes and limits of their drive, and their dry friction."""

    speed: Sequence[float]
    slope: Sequence[float]
    limit: Sequence[float]
    resistance: Sequence[float]


def compiled_pushed_balls(balls: NDArray[np.float64], touches: NDArray[np.bool_]) -> NDArray[np.float64]:
    """The same as :func:`pushed_balls` by a kernel, as arrays, with the fields in rows."""
    return pooled_row(np.concatenate([balls, touches[None].astype(float)]))


def pushed_balls(balls: Driven, touches: Sequence[bool]) -> Pushed:
    """The speeds of balls that touch the one before them or do not; the last entry of ``touches`` does not count."""
    count = len(balls.speed)
    starts, speeds = [0] * count, [0.0] * count  # blocks: where they begin, and their speeds
    blocks = 0
    for ball in range(count):
        start, speed = ball, _block_speed(balls, ball, ball + 1, balls.speed[ball])
        while blocks and start and touches[start - 1] and speeds[blocks - 1] > speed:
            blocks -= 1
            start = starts[blocks]
            speed = _block_speed(balls, start, ball + 1, speeds[blocks])
        starts[blocks], speeds[blocks] = start, speed
        blocks += 1
    speed, force, drive = [0.0] * count, [0.0] * count, [0.0] * count
    end = count
    for block in range(blocks - 1, -1, -1):
        for ball in range(starts[block], end):
            speed[ball] = speeds[block]
        _share_forces(balls, starts[block], end, speeds[block], force, drive)
        end = starts[block]
    return Pushed(speed, force, drive)


def _block_speed(balls: Driven, start: int, end: int, guess: float) -> float:
    """The speed at which the forces on the balls of a block add up to nothing."""
    w = guess
    while True:
        above = below = up = down = 0.0  # the sum just above and just below w, and how fast it falls there
        next_up, next_down = math.inf, -math.inf
        for j in range(start, end):
            k, limit, f = balls.slope[j], balls.limit[j], balls.resistance[j]
            if k > 0:
                slack = limit / k
                low, high = balls.speed[j] - slack, balls.speed[j] + slack
                force = limit if w <= low else -limit if w >= high else k * (balls.speed[j] - w)
                above += force
                below += force
                if w < low:
                    next_up = min(next_up, low)
                elif w < high:
                    next_up = min(next_up, high)
                    up += k
                if w > high:
                    next_down = max(next_down, high)
                elif w > low:
                    next_down = max(next_down, low)
                    down += k
            if f > 0:
                above += f if w < 0 else -f
                below -= f if w > 0 else -f
                if w < 0:
                    next_up = min(next_up, 0.0)
                elif w > 0:
                    next_down = max(next_down, 0.0)
        if above > 0:
            root = w + above / up if up > 0 else math.inf
            if root <= next_up:
                return root
            w = next_up
        elif below < 0:
            root = w + below / down if down > 0 else -math.inf
            if root >= next_down:
                return root
            w = next_down
        else:
            return w


def _share_forces(balls: Driven, start: int, end: int, w: float, force: list[float], drive: list[float]) -> None:
    """Forces between the balls of a block, and of the races on them, at its speed."""
    # what a ball must at least be pushed with, so that those in front of it can be in balance
    least = 0.0
    for j in range(end - 1, start - 1, -1):
        k, limit = balls.slope[j], balls.limit[j]
        drive[j] = min(max(k * (balls.speed[j] - w), -limit), limit) if k > 0 else 0.0
        force[j] = least
        least = max(least - drive[j] - _friction(balls.resistance[j], w, 1.0), 0.0)
    pushed = 0.0
    for j in range(start, end - 1):
        pushed = max(pushed + drive[j] + _friction(balls.resistance[j], w, -1.0), force[j])
        force[j] = pushed
    force[end - 1] = 0.0


def _friction(resistance: float, w: float, way: float) -> float:
    """Dry friction on a ball; at rest, where it may have any value within its limits, the greatest ``way``."""
    if w == 0:
        return way * resistance
    return -resistance if w > 0 else resistance
