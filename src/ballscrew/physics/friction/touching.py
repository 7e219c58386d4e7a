"""The flanks that the most loaded ball touches: what a picture shows of the loads of all balls.

Elementwise: numbers, arrays, and values that are recorded.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.quantities import Angle, Force, Mask
from ballscrew.physics.solvers.load_distribution import BallLoads

#: Halves whose loads differ by no more than this share carry alike.
ALIKE = 1e-9


class FlankPair(NamedTuple):
    """A pair of flanks: the load of a ball on it, the contact angle, and whether the ball touches it."""

    load: Force
    angle: Angle
    touches: Mask


class MostLoadedBall(NamedTuple):
    """Loads and contact angles of one ball on the forward and on the backward flanks."""

    forward_load: Force
    backward_load: Force
    forward_angle: Angle
    backward_angle: Angle


def most_loaded_ball(loads: BallLoads) -> MostLoadedBall:
    """The ball with the largest load on a pair of flanks, the first of several."""
    names = MostLoadedBall._fields
    first, *others = loads.kinds
    result = MostLoadedBall(*(getattr(first, name) for name in names))
    if loads.one_by_one:
        place = np.argmax(_larger(result), axis=-1)
        return MostLoadedBall(*(_at(part, place) for part in result))
    for kind in others:
        other = MostLoadedBall(*(getattr(kind, name) for name in names))
        is_larger = _larger(other) > (1 + ALIKE) * _larger(result)
        result = MostLoadedBall(*(where(is_larger, b, a) for a, b in zip(result, other, strict=True)))
    return result


def touched(ball: MostLoadedBall, axial_load: Force, nominal_angle: Angle) -> tuple[FlankPair, FlankPair]:
    """The flanks that carry the load, and the other ones; where a ball touches none, the first as it would touch it."""
    sides = (ball.forward_load, ball.forward_angle), (ball.backward_load, ball.backward_angle)
    carries = axial_load >= 0
    values = [
        tuple(where(carries, one, other) for one, other in zip(here, there, strict=True))
        for here, there in (sides, sides[::-1])
    ]
    (load, angle), (other_load, other_angle) = values
    xp = namespace(load, angle, other_load, other_angle)
    touches, other_touches = (load > 0) & xp.isfinite(angle), (other_load > 0) & xp.isfinite(other_angle)
    idle = xp.logical_not(touches | other_touches)
    first = FlankPair(where(idle, 0.0, load), where(idle, nominal_angle, angle), touches | idle)
    return first, FlankPair(other_load, other_angle, other_touches)


def _larger(ball: MostLoadedBall) -> Force:
    return namespace(ball.forward_load, ball.backward_load).maximum(ball.forward_load, ball.backward_load)


def _at(values: Any, place: Any) -> Any:
    """What each ball has, at a place of its own for each point."""
    if not isinstance(place, np.ndarray | np.integer):  # on a tape
        return np.take_along_axis(values, place, axis=-1)
    return np.take_along_axis(np.asarray(values), np.asarray(place)[..., None], axis=-1)[..., 0]
