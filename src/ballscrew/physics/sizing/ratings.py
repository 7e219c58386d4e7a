"""Load ratings of a screw by its geometry."""
# ruff: noqa: D102  (members of a protocol are described where a row has them)

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from ballscrew.basis.arrays import namespace
from ballscrew.basis.errors import plain
from ballscrew.basis.quantities import Angle, Count, Force, Length, Ratio
from ballscrew.physics.components.screw import RATING_CONFORMITY, BallScrew, dynamic_load_rating
from ballscrew.physics.equations import geometry, rating


class Ratings(NamedTuple):
    """Load ratings of one nut body, or one half."""

    dynamic: Force
    static: Force


class Rated(Protocol):
    """The geometry that ratings follow from: that of a row of a catalogue."""

    @property
    def ball_circle(self) -> Any: ...
    @property
    def ball_diameter(self) -> Any: ...
    @property
    def contact_angle(self) -> Any: ...
    @property
    def lead_angle(self) -> Any: ...
    @property
    def balls_per_turn(self) -> Any: ...
    @property
    def loaded_turns(self) -> Any: ...
    @property
    def spacer_balls(self) -> Any: ...
    @property
    def rating_conformity(self) -> Any: ...


class RatedGeometry(NamedTuple):
    """A geometry that is no row: numbers, arrays, or values that are recorded."""

    ball_circle: Length
    ball_diameter: Length
    contact_angle: Angle
    lead_angle: Angle
    #: Balls that find room in a turn, spacer balls counted, too.
    balls_per_turn: Count
    loaded_turns: Ratio
    spacer_balls: bool = False
    rating_conformity: Ratio = RATING_CONFORMITY


def rated_geometry_of(screw: BallScrew) -> RatedGeometry:
    """The geometry that the ratings of a screw follow from: so many turns as its loaded balls take. Elementwise."""
    d_m, d_w, phi = screw.pitch_circle_diameter, screw.ball_diameter, screw.lead_angle
    xp = namespace(d_m, d_w, phi)
    in_a_turn = xp.floor(xp.pi * (d_m / d_w) / xp.cos(phi))
    turns = screw.loaded_balls / in_a_turn
    return RatedGeometry(d_m, d_w, screw.contact_angle, phi, in_a_turn, turns, screw.nut.spacer_balls)


def ratings_of(row: Rated) -> Ratings:
    """Dynamic and static axial load rating of a row by its geometry; those printed in its catalogue play no part.

    Of a turn with spacer balls half of the balls carry. Elementwise: numbers, arrays, and values that are recorded.
    """
    balls = row.balls_per_turn / 2 if row.spacer_balls else row.balls_per_turn
    d_m, d_w, alpha = row.ball_circle, row.ball_diameter, row.contact_angle
    phi, f = row.lead_angle, row.rating_conformity
    # the standard leaves the lead out of the curvature
    k_0 = rating.static_load_factor(geometry.curvature_ratio(d_w, d_m, alpha, lead_angle=0.0), f)
    return Ratings(
        dynamic=plain(dynamic_load_rating(d_m, d_w, alpha, phi, balls, row.loaded_turns, f)),
        static=plain(rating.static_load_rating(k_0, balls, row.loaded_turns, d_w, alpha, phi)),
    )


def load_ratings(screw: BallScrew) -> Ratings:
    """Dynamic and static axial load rating of one nut body, or one half, by the geometry. Elementwise.

    Returns :class:`Ratings` of ``screw``: ``dynamic`` is C_a and ``static`` C_0a, both in N, by the formulas of
    ISO3408-5. What a catalogue prints is in its row, ``ballscrew.catalogue()[name].dynamic_load_rating``.
    """
    return ratings_of(rated_geometry_of(screw))
