"""A ball between its grooves, in the section across its path: circles, and where they touch and end.

The middle of the ball is the origin. The first axis lies along the screw, positive towards the flank of the nut that a
positive load presses on; the second one points away from the axis of the screw. Everything is elementwise: numbers,
arrays, and values that are recorded.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Force, Length, Ratio

#: A place in the section.
Place: TypeAlias = "tuple[Length, Length]"
#: How far the grooves go up the ball, of its radius, or of the height of its contacts: catalogues do not say.
LAND, LAND_OF_CONTACT = 0.35, 0.6


def land_height(ball_radius: Length, steepest: Angle) -> Length:
    """How far from the middle of the ball its grooves end; ``steepest`` is the largest contact angle of its flanks."""
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
        """Where the two flanks of a groove meet that are each other's mirror image."""
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
