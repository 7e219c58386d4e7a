"""A ball between its grooves, in the section across its path: circles, and where they touch and end.

The middle of the ball is the origin. The first axis lies along the screw, positive towards the flank of the nut that a
positive load presses on; the second one points away from the axis of the screw. Everything is elementwise: numbers,
arrays, and values that are recorded.

Of the loads of all balls a picture shows the flanks that the most loaded one touches.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.quantities import Angle, Force, Length, Mask, Ratio
from ballscrew.physics.solvers.load_distribution import BallLoads

#: A place in the section.
Place: TypeAlias = "tuple[Length, Length]"
#: How far the grooves go up the ball, of its radius, or of the height of its contacts: catalogues do not say.
LAND, LAND_OF_CONTACT = 0.35, 0.6


def land_height(ball_radius: Length, steepest: Angle) -> Length:
    """Distance of the grooves' ends from the ball's middle; ``steepest`` is the largest contact angle of its flanks."""
    xp = namespace(ball_radius, steepest)
    return ball_radius * xp.minimum(LAND, LAND_OF_CONTACT * xp.cos(steepest))


def contact_width(of_most_loaded: Length, load: Force, largest_load: Force) -> Length:
    """Half width of a contact from that of the contact with the largest load: as the cube root of the load (Hertz)."""
    return of_most_loaded * (load / largest_load) ** (1 / 3)


class Arc(NamedTuple):
    """One flank of a groove as an arc that touches the ball."""

    radius: Length
    middle: Place
    #: Unit vector from the middle of the ball to the contact.
    normal: tuple[Ratio, Ratio]
    contact: Place
    #: 1 for the nut, which is outside of the balls, -1 for the screw.
    outward: int
    #: 1 for an arc to the right of the bottom, -1 to the left.
    side: int

    @classmethod
    def of(cls, ball_radius: Length, conformity: Ratio, angle: Angle, *, loaded: bool, outward: int) -> Arc:
        """The arc of a pair of flanks at a contact angle, on the side that a positive load presses on or the other."""
        xp = namespace(ball_radius, conformity, angle)
        side = outward if loaded else -outward
        normal = (side * xp.sin(angle), outward * xp.cos(angle))
        radius = 2 * conformity * ball_radius
        lever = ball_radius - radius
        x, y = normal
        return cls(radius, (lever * x, lever * y), normal, (ball_radius * x, ball_radius * y), outward, side)

    @property
    def bottom(self) -> Place:
        """Point where the two flanks of a groove meet that are each other's mirror image."""
        x, y = self.middle
        xp = namespace(self.radius, x)
        return 0.0, y + self.outward * xp.sqrt(self.radius**2 - x**2)

    def edge(self, land: Length) -> Place:
        """End of the groove, so far from the middle of the ball."""
        x, y = self.middle
        xp = namespace(self.radius, y, land)
        height = self.outward * land
        return x + self.side * xp.sqrt(xp.maximum(self.radius**2 - (height - y) ** 2, 0.0)), height

    def around(self, half_width: Length) -> tuple[Place, Place]:
        """The ends of a stretch of the arc to both sides of the contact, the one nearer to the bottom first."""
        xp = namespace(half_width, self.radius)
        turn = xp.minimum(half_width / self.radius, 1.0)
        clockwise, counter = (self._turned(xp.cos(turn), sign * xp.sin(turn)) for sign in (-1.0, 1.0))
        return (clockwise, counter) if self.side != self.outward else (counter, clockwise)

    def _turned(self, cosine: Ratio, sine: Ratio) -> Place:
        """The place of the arc whose normal is that of the contact, turned."""
        (x, y), (u, v) = self.middle, self.normal
        return x + self.radius * (u * cosine - v * sine), y + self.radius * (v * cosine + u * sine)


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
    """Values of each ball, at a place of its own for each point."""
    if not isinstance(place, np.ndarray | np.integer):  # on a tape
        return np.take_along_axis(values, place, axis=-1)
    return np.take_along_axis(np.asarray(values), np.asarray(place)[..., None], axis=-1)[..., 0]
